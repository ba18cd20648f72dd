//! Tables, as Batten and as other programs write them.

use super::*;
use crate::document::Colour;
use crate::geometry::FloatPolygon;
use crate::geometry::references::Placement;
use crate::io::loss::Export;

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
    assert_eq!(read(&export.bytes).unwrap().curves, curves);
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
            [curve("curve 1", expected, weights, false)],
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
    check(",,\n", hint);
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
    let expected = [curve("curve 1", expected, None, false)];
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
        assert_eq!(read(text.as_bytes()).unwrap().curves[0], named);
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
    for text in [
        "a,b\n0,0\n1,1\n",
        "# points\n0\n1\n",
        "x,y,weight\n0,0,1\n1,1,1\n",
    ] {
        assert_eq!(problem(text), Problem::NoTableHeader, "{text:?}");
    }
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
    assert_eq!(reading.references, [expected], "{text:?}");
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
    assert_eq!(reading.curves, [planar()]);
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
