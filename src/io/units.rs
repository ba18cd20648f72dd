//! The unit of length through every format.

use super::{DXF, Format, PROJECT, TAB_TABLE, TABLE};
use crate::document::{Curve, Document, Edit};
use crate::geometry::FloatPolygon;
use crate::geometry::expressions::LengthUnit;

fn document(unit: Option<LengthUnit>) -> Document {
    let polygon = FloatPolygon::planar(2, &[(0.0, 0.1), (1.0, 0.0), (2.5, 1.0)]);
    let document = Document::from_curves([Curve::new("arc", polygon.expect("a polygon"))]);
    document.with_unit(unit)
}

fn units() -> impl Iterator<Item = Option<LengthUnit>> {
    let units = LengthUnit::ALL.into_iter().map(Some);
    [None].into_iter().chain(units)
}

fn written(format: &Format, unit: Option<LengthUnit>) -> String {
    let export = format.write(&document(unit), None);
    String::from_utf8(export.expect("a document").bytes).expect("text")
}

#[test]
fn projects_and_tables_keep_it() {
    for unit in units() {
        for format in [&PROJECT, &TABLE, &TAB_TABLE] {
            let text = written(format, unit);
            let reading = format.read(text.as_bytes()).expect("what was written");
            let told = match format.extension() {
                "tsv" => "read with tabs between columns",
                _ => "",
            };
            assert_eq!(reading.remarks.to_string(), told, "{text}");
            assert_eq!(reading.unit, unit, "{text}");
            let back = reading.into_document().expect("a document");
            assert!(back.is_same(&document(unit)));
        }
    }
}

#[test]
fn a_document_without_one_is_written_as_ever() {
    let project = written(&PROJECT, None);
    assert!(project.contains("\"version\": 1") && !project.contains("unit"));
    assert!(written(&TABLE, None).starts_with("# degree=2"));
    let project = written(&PROJECT, Some(LengthUnit::Inch));
    assert!(project.contains("\"version\": 2") && project.contains("\"unit\": \"in\""));
    assert!(written(&TABLE, Some(LengthUnit::Inch)).starts_with("# unit=in\n"));
}

#[test]
fn old_projects_have_none_and_unknown_units_are_refused() {
    let text =
        |unit: &str| format!(r#"{{"format":"batten","version":2,{unit}"curves":[]}}"#).into_bytes();
    let reading = PROJECT.read(&text("")).expect("a project");
    assert_eq!(reading.unit, None);
    let error = PROJECT.read(&text(r#""unit":"ft","#));
    assert_eq!(
        error.expect_err("no unit").to_string(),
        "line 1, column 42: “ft” is not a unit of length: mm, cm, m or in is needed"
    );
}

#[test]
fn a_table_that_went_through_a_spreadsheet_has_it_still() {
    for (first, unit) in [
        ("# unit=cm;;", Some(LengthUnit::Centimetre)),
        ("# unit=furlong", None),
        ("# measured unit=cm", None),
    ] {
        let table = format!("{first}\n# degree=2;;\nx;y\n0;0,5\n1;0\n2;1\n");
        let reading = TABLE.read(table.as_bytes()).expect("a table");
        assert_eq!(reading.unit, unit, "{first}");
        let said = reading.remarks.to_string();
        assert_eq!(
            said.contains("taken as a comment"),
            unit.is_none(),
            "{said}"
        );
    }
}

#[test]
fn drawings_say_it_and_claim_none_that_nobody_said() {
    for (unit, code, metric) in [
        (None, 0, 1),
        (Some(LengthUnit::Inch), 1, 0),
        (Some(LengthUnit::Millimetre), 4, 1),
        (Some(LengthUnit::Centimetre), 5, 1),
        (Some(LengthUnit::Metre), 6, 1),
    ] {
        let text = written(&DXF, unit);
        let mut lines = text.lines().map(str::trim);
        lines.find(|line| *line == "$INSUNITS").expect("the unit");
        let header: Vec<&str> = lines.take(6).collect();
        let [code, metric] = [code, metric].map(|number| number.to_string());
        assert_eq!(header, ["70", &code, "9", "$MEASUREMENT", "70", &metric]);
    }
}

#[test]
fn a_unit_is_an_edit() {
    let changed = document(None).edited([Edit::SetUnit(Some(LengthUnit::Metre))]);
    assert!(
        changed
            .expect("an edit")
            .is_same(&document(Some(LengthUnit::Metre)))
    );
}
