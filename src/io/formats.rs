//! The table of formats, and how a file's name tells its format.

use std::path::Path;

use super::dxf::DXF;
use super::error::FormatError;
use super::exchange::formats::{BREP, CURVE_JSON, GLIF, IGES, OBJ, STEP, STEP_AP242, SVG, THREEDM};
use super::format::{Exporter, Format};
use super::gpx::GPX;
use super::picture::PICTURE;
use super::point_table::POINT_TABLE;
use super::project::PROJECT;
use super::table::{TAB_TABLE, TABLE};

/// Every format, in the order of dialogs and menus.
pub static FORMATS: [&Format; 16] = [
    &PROJECT,
    &TABLE,
    &TAB_TABLE,
    &POINT_TABLE,
    &GPX,
    &DXF,
    &STEP,
    &STEP_AP242,
    &IGES,
    &THREEDM,
    &SVG,
    &GLIF,
    &OBJ,
    &BREP,
    &CURVE_JSON,
    &PICTURE,
];

/// List the formats that can be read: all of them.
pub fn readable() -> impl Iterator<Item = &'static Format> {
    FORMATS.into_iter()
}

/// List the formats of other programs' drawings that can be read.
pub fn drawn() -> impl Iterator<Item = &'static Format> {
    FORMATS.into_iter().filter(|format| format.draws())
}

/// List the formats that can be written.
pub fn writable() -> impl Iterator<Item = &'static Format> {
    FORMATS.into_iter().filter(|format| format.can_write())
}

/// List the exports of all formats in the order of the menu: those with a key first.
pub fn exporters() -> Vec<Exporter> {
    let rows = |format: &'static Format| format.exports.iter().map(move |row| (format, row));
    let rows = FORMATS.into_iter().flat_map(rows);
    let mut exporters: Vec<Exporter> = rows.map(|(format, row)| Exporter { format, row }).collect();
    exporters.sort_by_key(|exporter| exporter.row.key.is_none());
    exporters
}

/// Tell the format of another program's text by its beginning, if that says it: that of the clipboard has no extension.
pub fn of_text(text: &str) -> Option<&'static Format> {
    let text = text.trim_start();
    let mut lines = text.lines().map(str::trim);
    let mut first = lines.next()?;
    // Comments of DXF.
    while first == "999" {
        lines.next();
        first = lines.next()?;
    }
    let extension = match [first, lines.next().unwrap_or_default()] {
        ["0", "SECTION"] => "dxf",
        [first, _] if first.starts_with("ISO-10303-21") => "step",
        [first, _] if first.starts_with('<') => {
            let root = ["svg", "glyph", "gpx"].into_iter().filter_map(|root| {
                let at = text.find(&format!("<{root}"))?;
                Some((at, root))
            });
            let (_, root) = root.min()?;
            if root == "glyph" { "glif" } else { root }
        }
        _ => return None,
    };
    find(extension)
}

/// Find a format by an extension in upper or lower case.
pub fn find(extension: &str) -> Option<&'static Format> {
    FORMATS.into_iter().find(|format| {
        let mut extensions = format.extensions.iter();
        extensions.any(|known| known.eq_ignore_ascii_case(extension))
    })
}

/// Tell the format of a file to read by its extension, in upper or lower case.
///
/// # Errors
/// [`FormatError`] if there is no extension, or it is unknown.
pub fn to_read(path: &Path) -> Result<&'static Format, FormatError> {
    by_extension(path, || extensions(readable()))
}

/// Tell the format of a file to write by its extension, in upper or lower case.
///
/// # Errors
/// [`FormatError`] if there is no extension, it is unknown, or its format is only read.
pub fn to_write(path: &Path) -> Result<&'static Format, FormatError> {
    let known = || extensions(writable());
    let format = by_extension(path, known)?;
    match format.can_write() {
        true => Ok(format),
        false => Err(FormatError::NotWritable {
            format: format.name,
            known: known(),
        }),
    }
}

fn by_extension(path: &Path, known: impl Fn() -> String) -> Result<&'static Format, FormatError> {
    let Some(extension) = path.extension() else {
        return Err(FormatError::NoExtension { known: known() });
    };
    if extension.eq_ignore_ascii_case("dwg") {
        return Err(FormatError::Dwg);
    }
    let format = extension.to_str().and_then(find);
    format.ok_or_else(|| FormatError::UnknownExtension {
        extension: extension.to_string_lossy().into_owned(),
        known: known(),
    })
}

fn extensions(formats: impl Iterator<Item = &'static Format>) -> String {
    let extensions = formats.flat_map(|format| format.extensions);
    let list: Vec<String> = extensions.map(|it| format!(".{it}")).collect();
    list.join(", ")
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::document::{Curve, Document, Reference};
    use crate::geometry::FloatPolygon;
    use crate::geometry::expressions::LengthUnit;
    use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
    use crate::io::Loss;
    use crate::io::loss::DocumentLoss;

    #[test]
    fn the_extension_tells_the_format_in_either_case() {
        for format in FORMATS {
            for extension in [
                format.extension().to_owned(),
                format.extension().to_uppercase(),
            ] {
                let path = Path::new("folder.csv/some.name").with_extension(extension);
                assert_eq!(to_write(&path).is_ok(), format.can_write());
                assert!(to_read(&path).is_ok());
                assert_eq!(
                    find(path.extension().unwrap().to_str().unwrap()),
                    Some(format)
                );
            }
        }
    }

    #[test]
    fn an_unknown_extension_lists_the_known_ones() {
        let check = |path: &str, expected: &str| {
            let error = to_read(Path::new(path)).unwrap_err();
            assert_eq!(error.to_string(), expected);
        };
        let drawings = ".dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json";
        let tables = ".batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy";
        let pictures = ".png, .jpg, .jpeg, .webp, .tif, .tiff";
        let readable = format!("{tables}, .gpx, {drawings}, {pictures}");
        check(
            "a.docx",
            &format!("“.docx” is not a format Batten knows: use one of {readable}"),
        );
        check(
            "a.DWG",
            "DWG files are not read or written: use DXF, which the same programs know",
        );
        check(
            "folder.csv/arc",
            &format!("the name has no extension that tells its format: add one of {readable}"),
        );
        let check = |path: &str, expected: &str| {
            let error = to_write(Path::new(path)).unwrap_err();
            assert_eq!(error.to_string(), expected);
        };
        let writable = format!("{tables}, {drawings}");
        check(
            "a.docx",
            &format!("“.docx” is not a format Batten knows: use one of {writable}"),
        );
        check(
            "a.gpx",
            &format!(
                "GPX files can be read but not written: the formats that can be written are {writable}"
            ),
        );
    }

    #[test]
    fn a_drawing_on_the_clipboard_may_begin_with_comments() {
        let name = |text: &str| of_text(text).map(|format| format.name);
        let drawing = "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n";
        assert_eq!(name(drawing), Some("DXF"));
        let comments = format!("999\nmade by hand\n999\n0\n{drawing}");
        assert_eq!(name(&comments), Some("DXF"));
        assert_eq!(name("999\n998\n997 1\n"), None);
    }

    #[test]
    fn a_unit_that_a_format_has_not_is_told() {
        let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 2.0), (3.0, 0.0)]);
        let curve = Curve::new("sheer", polygon.expect("a polygon"));
        let document = Document::from_curves([curve]);
        let inches = document.clone().with_unit(Some(LengthUnit::Inch));
        for (extension, without, with) in [
            ("glif", None, Some(DocumentLoss::Unit)),
            ("step", Some(DocumentLoss::NoUnit), None),
            ("dxf", None, None),
        ] {
            let format = find(extension).expect("a format");
            for (document, expected) in [(&document, without), (&inches, with)] {
                let export = format.write(document, None).expect("a file");
                let found = export.losses.of_document;
                assert_eq!(found, Vec::from_iter(expected), "{extension}");
            }
        }
    }

    #[test]
    fn what_is_hidden_comes_back_hidden_from_formats_that_hold_it_and_is_told_by_others() {
        let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 2.0), (3.0, 0.0)]);
        let mut curve = Curve::new("sheer", polygon.expect("a polygon"));
        curve.visible = false;
        let points = PointList::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y]).expect("points");
        let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
        let mut reference = Reference::new("scan", points);
        reference.visible = false;
        let document = Document::from_curves([curve]).with_references([reference]);
        let document = document.with_unit(Some(LengthUnit::Millimetre));
        for (extension, holds) in [
            ("3dm", true),
            ("igs", true),
            ("step", false),
            ("obj", false),
        ] {
            let format = find(extension).expect("a format");
            let export = format.write(&document, None).expect("a file");
            let told = export.losses.losses.iter();
            let told = told.filter(|(_, loss)| *loss == Loss::Hidden).count();
            assert_eq!(told, if holds { 0 } else { 2 }, "{extension}");
            let reading = format.read(&export.bytes).expect("a drawing");
            let curves = reading.curves.iter().filter(|it| it.visible).count();
            let references = reading.references.iter().filter(|it| it.visible).count();
            let visible = if holds { 0 } else { 1 };
            assert_eq!((curves, references), (visible, visible), "{extension}");
        }
    }
}
