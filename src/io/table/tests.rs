//! Tables, as Batten and as other programs write them.

use super::*;
use crate::document::Colour;
use crate::geometry::FloatPolygon;
use crate::geometry::references::{Placement, PointList, ReferenceCurve, ReferenceForm};
use crate::io::loss::{Export, Loss};

fn curve(name: &str, vertices: &[[f64; 3]], weights: Option<Vec<f64>>, periodic: bool) -> Curve {
    let vertices = vertices.iter().map(|vertex| DVec3::from_array(*vertex));
    let polygon = FloatPolygon::new(2, vertices.collect(), weights, periodic);
    Curve::new(name, polygon.unwrap())
}

fn planar() -> Curve {
    let vertices = [
        [0.1, 1e-300, 0.0],
        [-2.5e7, 1.0 / 3.0, 0.0],
        [3.0, -1e100, 0.0],
    ];
    curve("arc", &vertices, None, false)
}

fn spatial() -> Curve {
    let vertices = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 2.0, 5.0],
    ];
    curve("a \"b\", c=d\n", &vertices, None, true)
}

fn rational() -> Curve {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    curve("weighted", &vertices, Some(vec![1.0, 0.1, 1e-100]), false)
}

fn written(curves: &[Curve], polygon: PolygonKind) -> Result<Export, WriteError> {
    TABLE.write(&Document::from_curves(curves.to_vec()), Some(polygon))
}

#[test]
fn the_layout_is_as_described() {
    let check = |curve: Curve, expected: &str| {
        let bytes = written(&[curve], PolygonKind::Float).unwrap().bytes;
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    };
    check(
        planar(),
        "# degree=2 polygon=float periodic=false name=arc\nx,y\n0.1,1e-300\n-25000000.0,0.3333333333333333\n3.0,-1e100\n",
    );
    check(
        rational(),
        "# degree=2 polygon=float periodic=false name=weighted\nx,y,z,weight\n0.0,0.0,0.0,1.0\n1.0,0.0,0.0,0.1\n1.0,1.0,0.0,1e-100\n",
    );
    check(
        spatial(),
        "\"# degree=2 polygon=float periodic=true name=\"\"a \\\"\"b\\\"\", c=d\\n\"\"\"\nx,y,z\n0.0,0.0,1.0\n1.0,0.0,0.0\n1.0,1.0,0.0\n0.0,2.0,5.0\n",
    );
}

#[test]
fn tables_come_back_exactly() {
    let curves = [planar(), spatial(), rational()];
    let export = written(&curves, PolygonKind::Float).unwrap();
    assert!(export.losses.is_empty(), "{}", export.losses);
    assert_eq!(read(&export.bytes).unwrap().curves, curves.map(Arc::new));
}

#[test]
fn what_a_table_does_not_hold_is_reported() {
    let mut changed = spatial();
    changed.name = "c".to_owned();
    changed.colour = Some(Colour([1, 2, 3]));
    changed.visible = false;
    changed.locked = true;
    changed.targets.start = Some(crate::geometry::end_correction::EndTarget::default());
    let losses = written(&[changed], PolygonKind::Bezier).unwrap().losses;
    let losses: Vec<Loss> = losses.losses.into_iter().map(|(_, loss)| loss).collect();
    let expected = [
        Loss::Periodic,
        Loss::Colour,
        Loss::Targets,
        Loss::Hidden,
        Loss::Locked,
    ];
    assert_eq!(losses, expected);
    assert!(matches!(
        written(&[], PolygonKind::Float),
        Err(WriteError::NoCurves { .. })
    ));
}

#[test]
fn tables_of_other_programs_are_read() {
    let check = |text: &str, expected: &[[f64; 3]], weights: Option<Vec<f64>>| {
        let curves = read(text.as_bytes()).unwrap().curves;
        assert_eq!(
            curves,
            [curve("curve 1", expected, weights, false).into()],
            "{text:?}"
        );
    };
    let plane = [[0.0, 1.0, 0.0], [2.0, 3.0, 0.0], [4.0, 5.0, 0.0]];
    // Marks, line ends, blank lines, padding and upper case are a spreadsheet's.
    check(
        "\u{feff}# degree=2,,\r\n\r\nX,Y,\r\n0,1\r\n2, 3 ,\r\n,,\r\n4,5",
        &plane,
        None,
    );
    check(" #degree=2\n y , x \n1,0\n3,2\n5,4\n", &plane, None);
    check(
        "# degree=2\nx,y,weight\n0,1,1\n2,3,2\n4,5,3\n",
        &plane,
        Some(vec![1.0, 2.0, 3.0]),
    );
    check(
        "# degree=2 polygon=bezier\nx,y\n0,0\n1,1\n2,0\n",
        &[[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [3.0, -1.0, 0.0]],
        None,
    );
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    let check = |text: &str, expected: &str| {
        let message = read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(message, expected, "{text:?}");
    };
    let hint = "the table does not say which curve its vertices make: put a line like “# degree=3 polygon=float periodic=false name=curve” above the line with the column names";
    check("", "the file is empty");
    check("\n \n", "the file is empty");
    check(
        ",,\n",
        "there are no points: no line has two numbers or more",
    );
    check("\n\nx,y,weight\n0,0,1\n", &format!("line 3: {hint}"));
    check(
        "\n\nx,y\n0,0\n",
        "line 3, reference 1 “points 1”: 1 point makes no line: at least 2 are needed",
    );
    check(
        "# degree=2 name=hull",
        "line 1, curve 1 “hull”: the table has no columns: put a line with their names, for example “x,y”, above its numbers",
    );
    check(
        "# degree=2\n\n0,1\n",
        "line 3: the table has no columns: put a line with their names, for example “x,y”, above its numbers",
    );
    check(
        "# degree=2\nx/y\n",
        "line 2: “x/y” is not a column name that can stand here: the columns are x,y or x,y,z, then weight, each once and separated by commas, semicolons or tabs",
    );
    check(
        "# degree=2\nx,x\n",
        "line 2: “x” is not a column name that can stand here: the columns are x,y or x,y,z, then weight, each once and separated by commas, semicolons or tabs",
    );
    check(
        "# degree=2\nx,z\n",
        "line 2: the column y is missing: the columns x and y are needed",
    );
    let rows = "\nx,y\n0,0\n1,0\n\n";
    check(
        &format!("# degree=2{rows}2,3,4\n"),
        "line 6: 3 values for 2 columns",
    );
    check(
        &format!("# degree=2{rows}2\n"),
        "line 6: 1 value for 2 columns",
    );
    check(
        &format!("# degree=2{rows}2,two\n"),
        "line 6: “two” in column y is not a number",
    );
    for value in ["NaN", "inf", "-infinity", "1e999"] {
        check(
            &format!("# degree=2{rows}2,{value}\n"),
            &format!("line 6: “{value}” is not a finite number: only finite numbers can be used"),
        );
    }
    check(
        &format!("# degree=2 name=hull{rows}2,1e200\n"),
        "line 6, curve 1 “hull”, vertex 2: coordinate y is 1e200, and only finite numbers up to 1e100 can be used",
    );
    check(
        "# degree=1\nx,y,weight\n0,0,1\n1,1,-2\n",
        "line 4, curve 1 “curve 1”, vertex 1: weight -2.0 cannot be used: weights are positive numbers from 1e-100 to 1e100",
    );
    check(
        &format!("# degree=0{rows}"),
        "line 1, curve 1 “curve 1”: degree 0 is out of range: a degree from 1 to 25 is needed",
    );
    check(
        &format!("# degree=26{rows}"),
        "line 1, curve 1 “curve 1”: degree 26 is out of range: a degree from 1 to 25 is needed",
    );
    check(
        &format!("# degree=1{rows}\n# degree=2 name=b{rows}"),
        "line 7, curve 2 “b”: 2 vertices are too few: an open curve of degree 2 needs at least 3",
    );
    check(
        &format!("# degree=1 polygon=clamped periodic=true{rows}"),
        "line 1, curve 1 “curve 1”: a periodic curve cannot be given by its clamped polygon, which starts and ends somewhere: give its float polygon, or make it open",
    );
    check(
        "# degree=2 vertices=1000000000\nx,y\n",
        "line 1: “vertices=1000000000” is not known here: a line above a table holds degree=…, polygon=…, periodic=… and, last, name=…",
    );
}

#[test]
fn text_that_is_not_utf8_is_refused_with_its_place() {
    let error = read(b"# degree=2\nx,\xff").unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 2, column 3: the file is not text in UTF-8 here: save it as UTF-8"
    );
}

/// Check the values of a table's only curve, and what is told of it.
fn check_table(text: &str, expected: &[[f64; 3]], told: &str) {
    let reading = read(text.as_bytes()).unwrap();
    let expected = [curve("curve 1", expected, None, false).into()];
    assert_eq!(reading.curves, expected, "{text:?}");
    assert_eq!(reading.remarks.to_string(), told, "{text:?}");
}

#[test]
fn tables_of_spreadsheets_in_every_country_are_read() {
    let values = [[0.0, 1.5, 0.0], [2.25, -3.0, 0.0], [4.0, 5.125, 0.0]];
    let check = |text: &str, told: &str| check_table(text, &values, told);
    check("# degree=2\nx,y\n0,1.5\n2.25,-3\n4,5.125\n", "");
    check(
        "# degree=2\nx;y\n0;1.5\n2.25;-3\n4;5.125\n",
        "read with semicolons between columns",
    );
    check(
        "# degree=2;;\r\n;;\r\nX;Y;\r\n0;1,5;\r\n2,25;-3;\r\n4;5,125\r\n",
        "read with semicolons between columns and decimal commas",
    );
    check(
        "\u{feff}# degree=2\t\nx\ty\n0\t1,5\n 2,25\t-3 \n4\t5,125",
        "read with tabs between columns and decimal commas",
    );
    check(
        "# degree=2\nx\ty\n0\t1.5\n2.25\t-3\n4\t5.125\n",
        "read with tabs between columns",
    );
    check(
        "# degree=2\nx,y\n0,\"1,5\"\n\"2,25\",-3\n4,\"5,125\"\n",
        "read with decimal commas",
    );
}

#[test]
fn every_name_survives_every_separator() {
    let named = curve(
        "a;b\tc,d \"e\"",
        &[[0.0; 3], [1.0; 3], [2.0; 3]],
        None,
        false,
    );
    let bytes = written(std::slice::from_ref(&named), PolygonKind::Float)
        .unwrap()
        .bytes;
    let text = String::from_utf8(bytes).unwrap();
    let (header, rows) = text.split_once('\n').unwrap();
    for separator in [",", ";", "\t"] {
        let text = format!("{header}\n{}", rows.replace(',', separator));
        assert_eq!(
            read(text.as_bytes()).unwrap().curves[0],
            named.clone().into()
        );
    }
}

#[test]
fn numbers_with_doubtful_commas_are_refused() {
    let check = |text: &str, expected: &str| {
        let message = read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(message, expected, "{text:?}");
    };
    check(
        "# degree=1\nx;y\n0;0\n1,234;10\n",
        "line 4: “1,234” can be read with a decimal comma or with a comma between thousands: write the table's decimals with points",
    );
    check(
        "# degree=1\nx;y\n0,5;0\n1,25;2.5\n",
        "line 4: “2.5” has another decimal mark than the numbers before it: write all decimals with points, or all with commas",
    );
    check(
        "# degree=1\nx,y\n0,5,0\n1,25,2,5\n",
        "line 3: 3 values for 2 columns",
    );
}

#[test]
fn comments_are_passed_over_and_told() {
    let values = [[0.0, 1.0, 0.0], [2.0, 3.0, 0.0], [4.0, 5.0, 0.0]];
    check_table(
        "# drawn by \"me, on\n#\n# degree=2\n# the columns\nx,y\n0,1\n #,\"none\n2,3\n\"# a, b\"\n4,5\n",
        &values,
        "5 lines are taken as comments, the first is line 1",
    );
    check_table(
        "# degree=2\nx,y\n0,1\n2,3\n4,5\n# end",
        &values,
        "line 6 is taken as a comment",
    );
    // The lines after a comment keep their numbers.
    let error = read(b"# one\n# degree=1\n# \"two\nx,y\n0,a\n").unwrap_err();
    assert_eq!(error.place.line, Some(5));
}

#[test]
fn a_table_whose_curve_is_not_told_is_refused() {
    let problem = |text: &str| read(text.as_bytes()).unwrap_err().problem;
    assert_eq!(problem("# points\n0\n1\n"), Problem::NoPoints);
    assert_eq!(
        problem("x,y,weight\n0,0,1\n1,1,1\n"),
        Problem::NoTableHeader
    );
    let misspelled = Problem::UnknownKey("degre=1".to_owned());
    assert_eq!(problem("# degre=1\nx;y\n0;0\n1;1\n"), misspelled);
    assert_eq!(
        problem("# polygon=bezier\nx,y\n0,0\n1,1\n"),
        Problem::NoDegree
    );
}

/// Check the points of a table's only list of them.
fn check_points(text: &str, name: &str, expected: &[[f64; 3]]) {
    let reading = read(text.as_bytes()).unwrap();
    assert_eq!(reading.curves, [], "{text:?}");
    let points = expected.iter().copied().map(DVec3::from_array).collect();
    let list = ReferenceForm::Points(PointList::new(points).unwrap());
    let expected = Reference::new(name, ReferenceCurve::of(list).unwrap());
    assert_eq!(reading.references, [expected.into()], "{text:?}");
}

#[test]
fn a_table_without_a_degree_holds_points() {
    let planar = [[0.0, 1.5, 0.0], [2.25, -3.0, 0.0]];
    for text in [
        "# points\nx,y\n0,1.5\n2.25,-3\n",
        "x,y\n0,1.5\n2.25,-3\n",
        "0,1.5\n2.25,-3\n",
        "0\t1,5\n2,25\t-3\n",
        "Y;X\n1,5;0\n-3;2,25\n",
        "#\n# res=0.1\n0,1.5\n# half\n2.25,-3",
    ] {
        check_points(text, "points 1", &planar);
    }
    check_points("# name=scan\n0,1.5\n2.25,-3\n", "scan", &planar);
    let spatial = [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0], [6.0, 7.0, 8.0]];
    check_points("x,y,z\n0,1,2\n3,4,5\n6,7,8\n", "points 1", &spatial);
    let error = read(b"x,y\n0,1\n2,1e200\n").unwrap_err().to_string();
    assert!(
        error.starts_with("line 3, reference 1 “points 1”: point 1"),
        "{error}"
    );
}

#[test]
fn curves_and_points_stand_in_one_file() {
    let list = PointList::new(vec![DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)]).unwrap();
    let turned = Placement::new(glam::DQuat::from_rotation_z(0.5), 2.0, DVec3::X).unwrap();
    let placed = ReferenceCurve::of(ReferenceForm::Points(list.clone())).unwrap();
    let scan = Reference::new("scan", placed.placed(turned));
    let circle = ReferenceCurve::from_text("circle:radius=2").unwrap();
    let circle = Reference::new("round", circle);
    let document = Document::from_curves([planar()]).with_references([scan, circle.clone()]);
    let export = TABLE.write(&document, None).unwrap();
    assert_eq!(
        export.losses.to_string(),
        "“round”: references aren't stored in the CSV table"
    );
    let reading = read(&export.bytes).unwrap();
    assert_eq!(reading.curves, [planar().into()]);
    let [read] = &reading.references[..] else {
        panic!("{:?}", reading.references);
    };
    let ReferenceForm::Points(points) = read.curve.form() else {
        panic!("{read:?}");
    };
    let expected = list.points().iter().map(|point| turned.point(*point));
    assert_eq!(points.points(), expected.collect::<Vec<_>>());
    assert_eq!(read.name, "scan");
    let alone = TABLE.write(&Document::default().with_references([circle]), None);
    assert!(matches!(alone, Err(WriteError::NoCurves { .. })));
}

/// Check the remarks and the lists of points of a table, each with its name.
fn check_lists(text: &str, expected: &[(&str, &[[f64; 2]])], told: &str) {
    let reading = read(text.as_bytes()).unwrap();
    let lists = reading.references.iter().map(|reference| {
        let points = reference.points().unwrap();
        let points = points.iter().map(|point| [point.x, point.y]).collect();
        (reference.name.as_str(), points)
    });
    let lists: Vec<(&str, Vec<[f64; 2]>)> = lists.collect();
    let expected: Vec<(&str, Vec<[f64; 2]>)> = expected
        .iter()
        .map(|(name, points)| (*name, points.to_vec()))
        .collect();
    assert_eq!(lists, expected, "{text:?}");
    assert_eq!(reading.remarks.to_string(), told, "{text:?}");
}

const POINTS: &[[f64; 2]] = &[[0.0, 1.5], [2.25, -3.0], [4.0, 5.0]];

#[test]
fn tables_of_other_programs_hold_points_with_titles_and_other_columns() {
    let check = |text: &str, name: &str, told: &str| check_lists(text, &[(name, POINTS)], told);
    check(
        "  wing, root\n\n 0.0 1.5\n 2.25  -3\n 4 5\n",
        "wing, root",
        "",
    );
    check("wing \"root\n0 1.5\r2.25 -3\r4 5", "wing \"root", "");
    check(
        "wing\troot\n0\t1.5\n2.25\t-3\n4\t5\n",
        "wing root",
        "read with tabs between columns",
    );
    check("0.0D+00 1.5d0\n2.25D0 -3\n.4D1 5\n", "points 1", "");
    check(
        "0 1,5\n2,25 -3\n4 5\n",
        "points 1",
        "read with decimal commas",
    );
    check("# x y\n0 1.5\n2.25 -3\n4 5\n", "points 1", "");
    check("X/c Y/c\n0 1.5\n2.25 -3\n4 5\n", "points 1", "");
    check(
        "name;Y [mm];station;X [mm];note\nA;1,5;7;0;\nB;-3;8;2,25;here\nC;5;9;4;\n",
        "points 1",
        "read with semicolons between columns and decimal commas",
    );
    check("P1 0 1.5\nP2 2.25 -3\nP3 4 5\n", "points 1", "");
    check(
        "a,b\n0,1.5\n2.25,-3\n4,5\n",
        "points 1",
        "x and y are the columns 1 “a” and 2 “b”",
    );
    check(
        "scan\ntaken on Monday\n1 2 3 4\n0 1.5\n2.25 -3\nlast 7\n4 5\n\nwww.scan.example\n",
        "scan",
        "lines 2 to 3, 6 and 9 were skipped (no point)",
    );
    check(
        "0 1.5\n0 1.5\n2.25 -3\n1e999 0\n4 5\n4 5\n",
        "points 1",
        "lines 2 and 6 were left out (the same point as before)\nline 4 was left out (the number “1e999” is too large)",
    );
    // A blank line below every row divides nothing.
    check("0 1.5\n\n2.25 -3\n\n4 5\n", "points 1", "");
}

#[test]
fn the_unit_of_the_columns_is_that_of_the_document() {
    let unit = |text: &str| {
        let reading = read(format!("{text}\n0,1\n2,3\n").as_bytes());
        reading.map(|it| (it.unit, it.remarks.to_string()))
    };
    let none = String::new();
    for text in ["x [mm],y [mm]", "X(mm),y", "x,y_mm", "x/mm,y/mm"] {
        let millimetres = Some(LengthUnit::Millimetre);
        assert_eq!(unit(text), Ok((millimetres, none.clone())), "{text}");
    }
    assert_eq!(unit("x/c,y/c"), Ok((None, none.clone())));
    let told = "the unit “ft” is not known: mm, cm, m and in are".to_owned();
    assert_eq!(unit("x [ft],y [ft]"), Ok((None, told)));
    let mixed = unit("x [mm],y [m]").unwrap_err().to_string();
    let expected =
        "line 1: the columns are in millimetres and in metres: give all coordinates in one unit";
    assert_eq!(mixed, expected);
}

#[test]
fn blank_lines_divide_points() {
    check_lists(
        "keel\n0 1.5\n2.25 -3\n4 5\n\n0 1\n2 3\n\nstem\n1 1\n2 2\n\n7 7\n",
        &[
            ("keel", POINTS),
            ("keel, block 2", &[[0.0, 1.0], [2.0, 3.0]]),
            ("stem", &[[1.0, 1.0], [2.0, 2.0]]),
        ],
        "line 13 was skipped (no point)",
    );
}

#[test]
fn a_text_between_rows_divides_nothing_but_whole_airfoils() {
    let six = [POINTS, POINTS].concat();
    let keel = "0 1.5\n2.25 -3\n4 5\n";
    for text in ["stem", "3 #VALUE!", "** page break **", "mean 3.5"] {
        check_lists(
            &format!("keel\n{keel}{text}\n{keel}"),
            &[("keel", &six)],
            "line 5 was skipped (no point)",
        );
    }
    check_lists(
        &format!("keel\n\n{keel}end\n\nstem\n{keel}end"),
        &[("keel", POINTS), ("stem", POINTS)],
        "lines 6 and 12 were skipped (no point)",
    );
    check_lists(
        &format!("keel\n\n{keel}stem\n\n{keel}"),
        &[("keel", POINTS), ("stem", POINTS)],
        "",
    );
}

#[test]
fn rows_with_blanks_alone_are_read_beside_others() {
    for separator in ["\t", ",", ";"] {
        let rows: String = (0..300)
            .map(|row| format!("{row}.5{separator}{row}\n"))
            .collect();
        let reading = read(format!("keel\n{rows}300.5  300\n").as_bytes()).unwrap();
        let points = reading.references[0].points().unwrap();
        assert_eq!(points.len(), 301, "{separator:?}");
        assert_eq!(points[300], DVec3::new(300.5, 300.0, 0.0));
    }
}

#[test]
fn later_blocks_with_names_of_columns_have_titles() {
    let rows = "x,y\n0,1.5\n2.25,-3\n4,5\n";
    for between in ["\nstem\n", "stem\n", "\nstem\n\n", "end\n\nstem\n"] {
        let text = format!("keel\n{rows}{between}{rows}");
        let told = match between.starts_with("end") {
            true => "line 6 was skipped (no point)",
            false => "",
        };
        check_lists(&text, &[("keel", POINTS), ("stem", POINTS)], told);
    }
    let curve = format!("# degree=1 name=line\nx,y\n0,0\n1,1\n\nstem\n{rows}");
    let reading = read(curve.as_bytes()).unwrap();
    assert_eq!(reading.references[0].name, "stem");
    assert_eq!(reading.curves[0].name, "line");
}

#[test]
fn a_line_below_the_names_of_columns_has_units() {
    for (text, unit) in [
        ("x,y\nmm,mm\n", LengthUnit::Millimetre),
        ("keel\nx,y\n[in],[in]\n", LengthUnit::Inch),
        ("x,y,c\nm,m,[deg]\n", LengthUnit::Metre),
        ("x,y,c\nmm,mm,Pa\n", LengthUnit::Millimetre),
    ] {
        let more = if text.contains("c\n") { ",7" } else { "" };
        let rows = POINTS.iter().map(|[x, y]| format!("{x},{y}{more}\n"));
        let text = text.to_owned() + &rows.collect::<String>();
        let reading = read(text.as_bytes()).unwrap();
        assert_eq!(reading.unit, Some(unit), "{text}");
        assert_eq!(reading.remarks.to_string(), "", "{text}");
        assert_eq!(reading.references[0].points().unwrap().len(), 3);
    }
    for units in ["ft,ft", "[ft],[ft]"] {
        let text = format!("x,y\n{units}\n0,1.5\n2.25,-3\n4,5\n");
        let told = "the unit “ft” is not known: mm, cm, m and in are";
        check_lists(&text, &[("points 1", POINTS)], told);
    }
    check_lists("x,y\nkeel\n0,1.5\n2.25,-3\n4,5\n", &[("keel", POINTS)], "");
    let mixed = read(b"# unit=mm\n# unit=mm\n# unit=in\n0,1\n2,3\n").unwrap_err();
    let expected =
        "line 3: the columns are in millimetres and in inches: give all coordinates in one unit";
    assert_eq!(mixed.to_string(), expected);
}

#[test]
fn ambiguous_columns_are_named_and_can_be_chosen() {
    let text = b"t;width;height\n0;1;2\n1;3;5\n";
    let error = read(text).unwrap_err();
    let expected = "line 1: which columns are x and y? There are 1 “t”, 2 “width”, 3 “height”: name them x and y, or choose them";
    assert_eq!(error.to_string(), expected);
    for choice in ["2,3", "width,Height"] {
        let choice: ColumnChoice = choice.parse().unwrap();
        let reading = read_chosen(text, &choice).unwrap();
        let points = reading.references[0].points().unwrap();
        let expected = [DVec3::new(1.0, 2.0, 0.0), DVec3::new(3.0, 5.0, 0.0)];
        assert_eq!(points[..], expected);
    }
    assert!(read(b"0 1 2 3\n4 5 6 7\n").is_err());
    let choice: ColumnChoice = "1,2".parse().unwrap();
    let curve = b"# degree=1\nx,y\n0,0\n1,1\n";
    let refused = read_chosen(curve, &choice).unwrap_err();
    assert_eq!(refused.problem, Problem::NoChoice);
}

#[test]
fn a_number_that_becomes_0_is_told() {
    let told = "line 3 was read as 0 in part (the number “1e-400” is too small)";
    check_table(
        "# degree=2\nx,y\n0,1e-400\n1,0.0e-400\n2,0\n",
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        told,
    );
    let told = told.replace("line 3", "line 1");
    check_lists(
        "0 1e-400\n1 1\n",
        &[("points 1", &[[0.0, 0.0], [1.0, 1.0]])],
        &told,
    );
}

#[test]
fn old_titles_are_latin_1() {
    let reading = read(b"G\xf6 114\n0 1\n2 3\n").unwrap();
    assert_eq!(reading.references[0].name, "Gö 114");
    let told = reading.remarks.to_string();
    assert_eq!(told, "the text is not UTF-8 and was read as Latin-1");
}

#[test]
fn an_airfoil_in_lednicer_order_is_read_around_the_section() {
    let around: &[[f64; 2]] = &[
        [1.0, 0.01],
        [0.5, 0.1],
        [0.1, 0.05],
        [0.0, 0.0],
        [0.1, -0.04],
        [0.5, -0.05],
        [1.0, 0.0],
    ];
    let rows = |points: &[[f64; 2]]| -> String {
        points.iter().map(|[x, y]| format!(" {x}  {y}\n")).collect()
    };
    let selig = format!("foil\n{}", rows(around));
    check_lists(
        &selig,
        &[("foil", around)],
        "“foil”: an airfoil in Selig order",
    );
    let mut upper = around[..4].to_vec();
    upper.reverse();
    let [upper, lower] = [rows(&upper), rows(&around[3..])];
    let told = "“foil”: an airfoil in Lednicer order";
    for text in [
        format!("foil\n 4. 4.\n\n{upper}\n{lower}"),
        format!("foil\n 4 4\n{upper}{lower}"),
        format!("foil\n4.0 4.0\n{upper}\n{lower}\n"),
    ] {
        check_lists(&text, &[("foil", around)], told);
    }
    let uncounted = format!("{told} without its line of counts: both sides make one section");
    for text in [
        format!("foil\n\n{upper}\n{lower}"),
        format!("foil\n{upper}\n\n{lower}\n"),
        format!("foil\n{upper}{lower}"),
        format!("foil\n{lower}\n{upper}"),
    ] {
        check_lists(&text, &[("foil", around)], &uncounted);
    }
    let two = format!("foil\n 4. 4.\n\n{upper}\n{lower}\nnext\n 4. 4.\n\n{upper}\n{lower}");
    let both = [("foil", around), ("next", around)];
    let told_both = format!("{told}\n{}", told.replace("“foil”", "“next”"));
    check_lists(&two, &both, &told_both);
    let two = two.replace("\nnext", "next");
    check_lists(&two, &both, &told_both);
    let two = format!("{selig}next\n{}", rows(around));
    check_lists(&two, &both, &told_both.replace("Lednicer", "Selig"));
    let two = two.replacen("0.1 ", "bad row\n 0.1 ", 1);
    let skipped = format!(
        "{}\nline 4 was skipped (no point)",
        told_both.replace("Lednicer", "Selig")
    );
    check_lists(&two, &both, &skipped);
    // What is no airfoil does not take those below along.
    let three = format!("foil\n0 0\n1 1\n2 0\n{two}");
    let lists = read(three.as_bytes()).unwrap().references;
    let counts = lists.iter().map(|it| it.points().unwrap().len());
    assert_eq!(counts.collect::<Vec<_>>(), [10, 7]);
    // Waterlines of a hull in metres may look alike.
    let hull = |row: &[f64; 2]| row.map(|value| 10.0 * value);
    let [side, other] = [&around[..4], &around[3..]].map(|side| side.iter().map(hull).collect());
    let (mut side, other): (Vec<_>, Vec<_>) = (side, other);
    side.reverse();
    check_lists(
        &format!("hull\n{}\n{}", rows(&side), rows(&other)),
        &[("hull", &side), ("hull, block 2", &other)],
        "the two blocks may be the sides of an airfoil: a line “4. 4.” above the points makes one section of them",
    );
    let told = format!(
        "line 2: the counts are not those of the two sides, which the blank line divides\n{told}"
    );
    let text = format!("foil\n 5. 4.\n\n{upper}\n{lower}");
    check_lists(&text, &[("foil", around)], &told);
}

#[test]
fn a_point_table_keeps_titles_and_digits() {
    let points = |count: usize| {
        let points = (0..count).map(|i| DVec3::new(0.1 * i as f64, -1.0 / 3.0, 1e-300));
        let list = PointList::new(points.collect()).unwrap();
        ReferenceCurve::of(ReferenceForm::Points(list)).unwrap()
    };
    let names = ["NACA 0012", "23012", "x y", "# so", " padded", "two\nlines"];
    let references = names.map(|name| Reference::new(name, points(4)));
    let document = Document::from_curves([planar()])
        .with_references(references.clone())
        .with_unit(Some(LengthUnit::Inch));
    let export = crate::io::POINT_TABLE.write(&document, None).unwrap();
    let told = export.losses.to_string();
    assert_eq!(told, "“arc”: curves aren't stored in the point table");
    let text = String::from_utf8(export.bytes.clone()).unwrap();
    assert!(text.starts_with("# unit=in\nNACA 0012\n  0.0  "), "{text}");
    let reading = crate::io::POINT_TABLE.read(&export.bytes).unwrap();
    assert_eq!(reading.references, references.map(Arc::new), "{text}");
    assert_eq!(reading.unit, Some(LengthUnit::Inch));
    let none = crate::io::POINT_TABLE.write(&Document::from_curves([planar()]), None);
    assert!(matches!(none, Err(WriteError::NoPoints { .. })));
}

/// The points of the only list in a file.
fn points_of(bytes: &[u8]) -> Vec<[f64; 2]> {
    let reading = TABLE.read(bytes).unwrap();
    let [list] = &reading.references[..] else {
        panic!("{} lists", reading.references.len());
    };
    let ReferenceForm::Points(points) = list.curve.form() else {
        panic!("no points");
    };
    let points = points.points().iter();
    points.map(|point| [point.x, point.y]).collect()
}

#[test]
fn marks_between_thousands_are_no_decimal_marks() {
    let expected = [[1000.5, 2.0], [-1_234_567.25, 3.5], [0.5, 4.0]];
    for text in [
        "Station;Höhe\n1.000,5;2,0\n-1.234.567,25;3,5\n0,5;4,0\n",
        "x;y\n1,000.5;2.0\n-1,234,567.25;3.5\n0.5;4.0\n",
        "x;y\n1\u{a0}000,5;2,0\n-1\u{a0}234\u{a0}567,25;3,5\n0,5;4,0\n",
        "x,y\n1'000.5,2.0\n-1'234'567.25,3.5\n0.5,4.0\n",
        "x\ty\n1.000,5\t2,0\n\u{2212}1.234.567,25\t3,5\n0,5\t4,0\n",
    ] {
        assert_eq!(points_of(text.as_bytes()), expected, "{text}");
    }
    let mixed = "x;y\n1.000,5;2,0\n1.000;3,0\n";
    assert!(TABLE.read(mixed.as_bytes()).is_err());
}

#[test]
fn columns_that_are_empty_or_count_the_rows_are_no_coordinates() {
    let expected = [[0.1, 0.3], [42.5, 10.0], [84.0, 20.0]];
    for text in [
        "Nr.;Station;Höhe;Bemerkung\n1;0,1;0,3;\n2;42,5;10,0;\n3;84;20;\n",
        "index,a,b\n0,0.1,0.3\n1,42.5,10\n2,84,20\n",
    ] {
        assert_eq!(points_of(text.as_bytes()), expected, "{text}");
    }
}

#[test]
fn listings_of_other_programs_are_read() {
    let expected = [[0.5, -1.0], [1500.25, 2.0], [2.0, 3.0]];
    for text in [
        "at point X=0.5 Y=-1.0 Z=0\nat point X=1500.25 Y= 2.0 Z=0\nat point X= 2.0 Y= 3.0 Z=0\n",
        "% x y\n 0.5 -1.0\n 1500.25 2.0\n 2.0 3.0\n",
        "//X Y\n 0.5 -1.0\n 1500.25 2.0\n 2.0 3.0\n",
        "TITLE = \"wing\"\nVARIABLES = \"X\" \"Y\"\nZONE T=\"a\", I=3, F=POINT\n0.5D0 -1.0D0\n1500.25 2\n2 3\n",
    ] {
        assert_eq!(points_of(text.as_bytes()), expected, "{text}");
        let units = text.encode_utf16().flat_map(u16::to_le_bytes);
        let bytes: Vec<u8> = [0xff, 0xfe].into_iter().chain(units).collect();
        assert_eq!(points_of(&bytes), expected, "{text} in UTF-16");
    }
}

#[test]
fn latitude_and_longitude_are_read_as_those_of_a_track() {
    let positions = [[54.0, 10.0], [54.0, 10.01], [54.02, 10.01]];
    let track = positions.map(|[lat, lon]| format!("<rtept lat=\"{lat}\" lon=\"{lon}\"/>"));
    let track = format!("<gpx><rte>{}</rte></gpx>", track.concat());
    let track = crate::io::GPX.read(track.as_bytes()).unwrap();
    let expected = track.references[0].points();
    for (names, is_swapped) in [("lat,lon", false), ("Longitude [deg],Latitude [deg]", true)] {
        let rows = positions.map(|[lat, lon]| match is_swapped {
            false => format!("{lat},{lon}\n"),
            true => format!("{lon},{lat}\n"),
        });
        let text = format!("{names}\n{}", rows.concat());
        let reading = TABLE.read(text.as_bytes()).unwrap();
        assert_eq!(reading.references[0].points(), expected, "{text}");
        assert_eq!(reading.unit, Some(LengthUnit::Metre));
        assert_eq!(reading.remarks, track.remarks, "{text}");
    }
    let west = "Latitude (N),Longitude (W)\n54,-10\n54,-10.01\n54.02,-10.01\n";
    let reading = TABLE.read(west.as_bytes()).unwrap();
    assert_eq!(reading.references[0].points(), expected);
    // Two lists of one file lie in one plane.
    let two = "lat,lon\n54,10\n54,10.01\n\n54.01,10\n54.01,10.01\n";
    let reading = TABLE.read(two.as_bytes()).unwrap();
    let middle = reading.references.iter().filter_map(|it| it.points());
    let middle: DVec3 = middle.flatten().sum();
    assert!(middle.length() < 1.0, "{middle}");
    // Columns that are chosen are taken as they are.
    let choice = "lon,lat".parse().unwrap();
    let reading = TABLE.read_columns(two.as_bytes(), Some(&choice)).unwrap();
    assert_eq!(reading.references[0].points().unwrap()[1].x, 10.01);
    let error = |text: &str| TABLE.read(text.as_bytes()).unwrap_err().to_string();
    let needed = "line 3: a point needs a latitude, a number from -90 to 90";
    assert_eq!(error("lat,lon\n1,2\n91,2\n"), needed);
    let mixed = error("# unit=mm\nlat,lon\n1,2\n2,2\n");
    assert!(
        mixed.contains("the columns are in millimetres and in metres"),
        "{mixed}"
    );
}

#[test]
fn easting_and_northing_are_x_and_y() {
    let text = "id,Northing (m),Easting (m),Elevation,remark\n7,2,1,3,a\n9,5,4,6,b\n";
    check_points(text, "points 1", &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(
        TABLE.read(text.as_bytes()).unwrap().unit,
        Some(LengthUnit::Metre)
    );
    assert_eq!(
        points_of(b"easting northing depth\n1 2 3\n4 5 6\n"),
        [[1.0, 2.0], [4.0, 5.0]]
    );
}

#[test]
fn a_row_without_a_number_and_a_line_of_a_spreadsheet_are_no_titles() {
    let expected = [("points 1", &[[1.0, 2.0], [3.0, 5.0]][..])];
    let skipped = "line 1 was skipped (no point)";
    check_lists("nan nan\n1 2\n3 5\n", &expected, skipped);
    check_lists("0.5,NaN\n1,2\n3,5\n", &expected, skipped);
    check_lists(
        "x,y\nNaN,NaN\n1,2\n3,5\n",
        &expected,
        "line 2 was skipped (no point)",
    );
    check_lists(
        "sep=;\nx;y\n1;2\n3;5\n",
        &expected,
        "read with semicolons between columns\nline 1 is taken as a comment",
    );
}

#[test]
fn points_in_brackets_are_read() {
    let expected = [[0.5, -1.0], [1.25, 2.0], [2.0, 3.0]];
    for text in [
        "(0.5, -1.0)\n(1.25, 2.0)\n(2.0, 3.0)\n",
        "[\n  [0.5, -1.0],\n  [1.25, 2.0],\n  [2.0, 3.0]\n]\n",
        "[(0.5, -1.0),\n(1.25, 2.0),\n(2.0, 3.0)]\n",
        "{0,5; -1,0};\n{1,25; 2,0};\n{2,0; 3,0};\n",
        "0.5, -1.0,\n1.25, 2.0,\n2.0, 3.0,\n",
    ] {
        assert_eq!(points_of(text.as_bytes()), expected, "{text}");
    }
}

#[test]
fn units_behind_numbers_are_read_where_all_agree() {
    let told = "numbers are read with the unit “mm” behind them";
    let expected = [("points 1", &[[12.5, 3.0], [13.0, 4.0]][..])];
    check_lists("12.5 mm,3 mm\n13 mm,4 mm\n", &expected, told);
    check_lists("x,y\n12.5mm,3mm\n13mm,4mm\n", &expected, told);
    let reading = read(b"a,b\n12.5 mm,3\n13 mm,4\n").unwrap();
    assert_eq!(reading.unit, Some(LengthUnit::Millimetre));
    check_lists(
        "12.5 ft;3 ft\n13 ft;4 ft\n",
        &expected,
        "read with semicolons between columns\nnumbers are read with the unit “ft” behind them\nthe unit “ft” is not known: mm, cm, m and in are",
    );
    // Where units differ, a cell is no number.
    let mixed = "x,y\n12.5,3\n13,4\n14 mm,5\n";
    check_lists(mixed, &expected, "line 4 was skipped (no point)");
    let error = read(b"1 mm,2 in\n2 mm,3 in\n").unwrap_err().to_string();
    assert!(
        error.contains("the columns are in millimetres and in inches"),
        "{error}"
    );
}

#[test]
fn tables_without_bounds_are_refused_with_their_line() {
    let told = |text: &str| read(text.as_bytes()).expect_err("too much").to_string();
    let wide = "1,".repeat(20_000);
    assert!(
        told(&format!("x,y\n1,2\n{wide}\n")).starts_with("line 3: the line has more than 16384")
    );
    // As many columns as are known are only too many to guess from.
    let known = "1,".repeat(16_000) + "1";
    let told_of_known = told(&format!("{known}\n{known}\n"));
    assert!(told_of_known.ends_with("30 and 15971 more: name them x and y, or choose them"));
    let many = "0 0\n1 1\n\n".repeat(150_001);
    assert!(told(&many).starts_with("line 450003: the file has more than 150000 lists of points"));
}

#[test]
fn text_behind_rows_takes_no_points() {
    let plain: &[[f64; 2]] = &[[1.0, 2.0], [3.0, 4.0], [5.0, 9.0]];
    let below: &[[f64; 2]] = &plain[1..];
    let taken = "line 1 is taken for the title “1 2 start”, though it begins with numbers";
    check_lists("1 2 start\n3 4\n5 9\n", &[("1 2 start", below)], taken);
    // The decimals of a title are none of the rows'.
    let told = "line 1 is taken for the title “1,5 2,5 RIB”, though it begins with numbers";
    let halves: &[[f64; 2]] = &[[3.5, 4.5], [5.5, 9.5]];
    check_lists(
        "1,5 2,5 RIB\n3.5 4.5\n5.5 9.5\n",
        &[("1,5 2,5 RIB", halves)],
        told,
    );
    for text in [
        "x,y\n1,2,start\n3,4\n5,9\n",
        "# x y\n1 2 start\n3 4 # end\n5 9\n",
    ] {
        check_lists(text, &[("points 1", plain)], "");
    }
    // A title is above, or others have labels.
    check_lists("FOIL\n1 2 TE\n3 4\n5 9\n", &[("FOIL", plain)], "");
    check_lists("x y label\n1 2 a\n3 4 b\n5 9\n", &[("points 1", plain)], "");
}

#[test]
fn points_of_meshes_and_solvers_are_read_by_their_names() {
    let points: &[[f64; 2]] = &[[0.0, 0.5], [1.0, 1.0], [2.0, 4.0]];
    for text in [
        "Point(1) = {0, 0.5, 0};\nPoint(2) = {1, 1, 0};\nPoint(3) = {2, 4, 0};\n",
        "VARIABLES = \"Y\" \"X\"\n0.5 0\n1 1\n4 2\n",
        "variables = cp, x, y\nZONE I=3\n9 0 0.5\n8 1 1\n7 2 4\n",
    ] {
        check_lists(text, &[("points 1", points)], "");
    }
    // The fourth number is no coordinate, or x would be none.
    let text = "Point(1) = {0, 0, 0, 1};\nPoint(2) = {1, 1, 0, 1};\n";
    assert!(read(text.as_bytes()).is_err(), "which columns are x and y?");
}

#[test]
fn decimal_commas_may_stand_between_runs_of_blanks() {
    let points: &[[f64; 2]] = &[[1.25, 2.5], [2.5, 3.75], [3.5, 4.5]];
    for text in [
        "1,25  2,5\n2,5  3,75\n3,5  4,5\n",
        "   1,25    2,5\n   2,5    3,75\n   3,5     4,5\n",
    ] {
        let reading = read(text.as_bytes()).unwrap();
        assert_eq!(points_of(text.as_bytes()), points, "{:?}", reading.remarks);
    }
}

#[test]
fn what_formats_lose_of_references_is_named() {
    let points = [0.0, 1.0, 4.0].map(|x| DVec3::new(x, x * x, 0.0)).to_vec();
    let list = PointList::new(points).unwrap().apart();
    let curve = ReferenceCurve::of(ReferenceForm::Points(list)).unwrap();
    let mut scan = Reference::new("scan", curve).in_group(Group::from("Deck"));
    (scan.visible, scan.locked) = (false, true);
    scan.colour = Some(Colour([1, 2, 3]));
    let document = Document::from_curves([planar()]).with_references([scan]);
    let of_tables = [Loss::Colour, Loss::Apart, Loss::Hidden, Loss::Locked];
    let of_others = &of_tables[2..];
    let step = crate::io::formats::find("step").unwrap();
    for (format, expected) in [
        (&TABLE, &of_tables[..]),
        (&crate::io::POINT_TABLE, &of_tables),
        (step, of_others),
    ] {
        let losses = format.write(&document, None).unwrap().losses;
        let of_scan = losses.losses.iter().filter(|(name, _)| name == "scan");
        let of_scan: Vec<&Loss> = of_scan.map(|(_, loss)| loss).collect();
        for loss in expected {
            assert!(of_scan.contains(&loss), "{}: {losses}", format.name);
        }
    }
}
