//! Tables of other programs from a shell: airfoils, columns, GPS tracks.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::folder::*;

/// The airfoils, all in Selig order.
fn airfoils() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/airfoils");
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let is_table = |path: &PathBuf| path.extension().is_some_and(|it| it == "dat");
    let mut airfoils: Vec<PathBuf> = entries.filter(is_table).collect();
    airfoils.sort();
    assert_eq!(airfoils.len(), 20);
    airfoils
}

/// The lines of a table that are two numbers, without those that repeat the one before.
fn rows(text: &str) -> Vec<[f64; 2]> {
    let row = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split_whitespace().map(|it| it.parse().ok()).collect();
        numbers?.try_into().ok()
    };
    let mut rows: Vec<[f64; 2]> = text.lines().filter_map(row).collect();
    rows.dedup();
    rows
}

fn points(inspected: &Value) -> Vec<[f64; 2]> {
    let references = inspected["references"].as_array().unwrap();
    assert_eq!(references.len(), 1);
    let points = references[0]["points"].as_array().unwrap().iter();
    let point = |point: &Value| [0, 1].map(|axis| point[axis].as_f64().unwrap());
    points.map(point).collect()
}

#[test]
fn airfoils_are_the_same_points_in_either_order() {
    let folder = Folder::new();
    for path in airfoils() {
        let name = path.display();
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        let expected = rows(&text);
        let path = path.to_str().unwrap();
        let (_, told) = folder.done(&["convert", path, "selig.batten"]);
        assert!(told.contains("an airfoil in Selig order"), "{name}: {told}");
        assert_eq!(points(&folder.inspect(&[path])), expected, "{name}");
        // The other order: both sides from the leading edge.
        let first = |a: &usize, b: &usize| expected[*a][0].total_cmp(&expected[*b][0]);
        let nose = (0..expected.len()).min_by(first).unwrap();
        let upper = expected[..=nose].iter().rev();
        let lower = &expected[nose..];
        let side = |rows: &mut dyn Iterator<Item = &[f64; 2]>| {
            let lines = rows.map(|[x, y]| format!("  {x:?}  {y:?}\n"));
            lines.collect::<String>()
        };
        let counts = format!("  {}.  {}.", nose + 1, lower.len());
        let [upper, lower] = [side(&mut upper.clone()), side(&mut lower.iter())];
        let lednicer = format!("title\n{counts}\n\n{upper}\n{lower}");
        fs::write(folder.path("lednicer.dat"), lednicer).unwrap();
        let (_, told) = folder.done(&["convert", "lednicer.dat", "selig.batten"]);
        let order = "lednicer.dat: “title”: an airfoil in Lednicer order\n";
        assert_eq!(told, format!("batten: {order}"), "{name}");
        assert_eq!(
            points(&folder.inspect(&["lednicer.dat"])),
            expected,
            "{name}"
        );
    }
}

#[test]
fn a_table_is_fitted_converted_and_inspected_in_one_step() {
    let airfoil = airfoils().remove(0);
    let text = fs::read(&airfoil).unwrap();
    for extension in ["dat", "txt", "xyz", "pts", "csv"] {
        let file = format!("foil.{extension}");
        let folder = Folder::new().with(&file, &text);
        let points = points(&folder.inspect(&[&file]));
        folder.done(&["convert", &file, "foil.batten"]);
        assert_eq!(
            points.len(),
            self::points(&folder.inspect(&["foil.batten"])).len()
        );
        let other = match extension {
            "csv" => "back.dat",
            _ => "back.csv",
        };
        folder.done(&["convert", &file, other]);
        assert_eq!(self::points(&folder.inspect(&[other])), points);
        if extension == "dat" {
            folder.done(&["apply", "fit", &file, "fair.batten", "--tolerance", "0.01"]);
            let fitted = folder.inspect(&["fair.batten"]);
            assert_eq!(fitted["curves"].as_array().unwrap().len(), 1);
        }
    }
}

#[test]
fn a_column_of_weights_counts_in_a_fit_and_is_kept() {
    let row = |index: usize| {
        let x = 0.1 * index as f64;
        let (off, weight) = if index == 10 {
            (0.4, "0")
        } else {
            (0.0, "2.5")
        };
        format!("{index};{x};{};{weight}\n", x * x + off)
    };
    let rows: String = (0..24).map(row).collect();
    let table = format!("station;x;y;trust\n{rows}");
    let folder = Folder::new().with("scan.csv", &table);
    let fit = ["apply", "fit", "scan.csv", "out.batten", "--extrema", "0"];
    for column in ["trust", "4"] {
        let (report, _) =
            folder.done(&[&fit[..], &["--outliers", "keep", "--weights", column]].concat());
        let report: Value = serde_json::from_str(&report).expect("JSON");
        assert_eq!(report["outlying_points"], json!([10]), "{report}");
        assert!(
            report["deviation"].as_f64().is_some_and(|it| it < 1e-4),
            "{report}"
        );
        assert!(
            report["largest"].as_f64().is_some_and(|it| it > 0.1),
            "{report}"
        );
    }
    let kept = std::fs::read_to_string(folder.path("out.batten")).expect("a file");
    let kept: Value = serde_json::from_str(&kept).expect("JSON");
    let weights = kept["references"][0]["weights"]
        .as_array()
        .expect("weights");
    assert_eq!(
        (weights.len(), &weights[9], &weights[10]),
        (24, &json!(2.5), &json!(0.0))
    );
    // A project tells the weights itself.
    folder.done(&[
        "apply",
        "fit",
        "out.batten",
        "again.batten",
        "--curve",
        "points 1",
        "--extrema",
        "0",
        "--outliers",
        "keep",
    ]);
    let (_, losses) = folder.done(&["convert", "again.batten", "out.csv"]);
    assert!(
        losses.contains("“points 1”: weights of points aren't stored"),
        "{losses}"
    );
    folder.refused(
        &["apply", "fit", "scan.csv", "out.batten", "--weights", "5"],
        "scan.csv: line 1: the table has no column 5: it has 1 “station”, 2 “x”, 3 “y”, 4 “trust”",
    );
    let bad = Folder::new().with("scan.csv", table.replace("9;0.9;0.81;2.5", "9;0.9;0.81;-1"));
    let problem =
        "line 11, reference 1 “points 1”: point 9 has no weight that can be used: from 0 to 1e100";
    bad.refused(
        &[&fit[..], &["--weights", "trust"]].concat(),
        &format!("scan.csv: {problem}"),
    );
}

#[test]
fn columns_are_chosen_wherever_a_table_is_read() {
    let table = "station;half breadth [mm];height [mm]\n1;0;2\n2;1,5;4\n3;5;5\n";
    let folder = Folder::new().with("hull.csv", table);
    for arguments in [
        &["inspect", "hull.csv"][..],
        &["convert", "hull.csv", "out.batten"],
        &["apply", "fit", "hull.csv", "out.batten"],
    ] {
        folder.refused(
            arguments,
            "hull.csv: line 1: which columns are x and y? There are 1 “station”, 2 “half breadth [mm]”, 3 “height [mm]”: name them x and y, or choose them with --columns, as in --columns 1,2",
        );
        for columns in ["2,3", "half breadth [mm],height [mm]"] {
            folder.done(&[arguments, &["--columns", columns]].concat());
        }
    }
    let inspected = folder.inspect(&["hull.csv", "--columns", "2,3"]);
    assert_eq!(inspected["unit"], json!("mm"));
    assert_eq!(points(&inspected), [[0.0, 2.0], [1.5, 4.0], [5.0, 5.0]]);
    folder.refused(
        &["inspect", "hull.csv", "--columns", "2,4"],
        "hull.csv: line 1: the table has no column 4: it has 1 “station”, 2 “half breadth [mm]”, 3 “height [mm]”",
    );
    folder.misused(
        &["inspect", "hull.csv", "--columns", "2"],
        "2 or 3 different columns",
    );
    folder.done(&["example", "arc", "arc.batten"]);
    folder.refused(
        &["inspect", "arc.batten", "--columns", "1,2"],
        "arc.batten: columns can only be chosen in a table of points",
    );
}

#[test]
fn tables_are_told_by_more_extensions() {
    let rows = "0\t0\n1.5\t2\n3\t1\n";
    let mut folder = Folder::new().with("a.survey", rows);
    for file in ["a.tsv", "a.asc", "a.xy"] {
        folder = folder.with(file, rows);
        let inspected = folder.inspect(&[file]);
        assert_eq!(points(&inspected), [[0.0, 0.0], [1.5, 2.0], [3.0, 1.0]]);
    }
    folder.done(&["convert", "a.xy", "b.tsv"]);
    let written = fs::read_to_string(folder.path("b.tsv")).unwrap();
    assert_eq!(
        written,
        "# name=points 1\nx\ty\n0.0\t0.0\n1.5\t2.0\n3.0\t1.0\n"
    );
    let output = folder.run(&["inspect", "a.survey"]);
    let (_, told) = texts(&output);
    let hint = ".tiff, or name its format with --from-format\n";
    assert!(told.ends_with(hint), "{told}");
    let inspected = folder.inspect(&["a.survey", "--from-format", "dat"]);
    assert_eq!(points(&inspected).len(), 3);
}

#[test]
fn a_track_is_read_in_metres() {
    let track = r#"<gpx><trk><name>Bay</name><trkseg>
<trkpt lat="54" lon="10"/><trkpt lat="54" lon="10.001"/><trkpt lat="54.001" lon="10.001"/>
</trkseg></trk></gpx>"#;
    let folder = Folder::new().with("bay.gpx", track);
    let inspected = folder.inspect(&["bay.gpx"]);
    assert_eq!(inspected["unit"], json!("m"));
    assert_eq!(points(&inspected).len(), 3);
    folder.done(&["convert", "bay.gpx", "bay.batten"]);
    folder.refused(
        &["convert", "bay.batten", "out.gpx"],
        "out.gpx: GPX files can be read but not written: the formats that can be written are .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json",
    );
}

/// The number of points and the distance of the polyline that `batten points` tells.
fn told(message: &str) -> (usize, f64) {
    let line = message.lines().last().unwrap();
    let words: Vec<&str> = line.split(' ').collect();
    let within = words.iter().position(|word| *word == "within").unwrap();
    (
        words[1].parse().unwrap(),
        words[within + 1].parse().unwrap(),
    )
}

#[test]
fn a_section_goes_back_to_its_solver() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/airfoils/ah6407.dat");
    let folder = Folder::new().with("foil.dat", fs::read(path).unwrap());
    folder.done(&[
        "apply",
        "fit",
        "foil.dat",
        "fair.batten",
        "--tolerance",
        "0.005",
    ]);
    for spacing in ["arc-length", "cosine", "parameter"] {
        let arguments = [
            "points",
            "fair.batten",
            "out.dat",
            "--count",
            "60+1",
            "--spacing",
            spacing,
        ];
        let (out, message) = folder.done(&arguments);
        assert_eq!((out.as_str(), told(&message).0), ("", 61));
        let text = fs::read_to_string(folder.path("out.dat")).unwrap();
        assert_eq!(text.lines().next(), Some("AH-6-40-7 AIRFOIL"));
        assert_eq!(rows(&text).len(), 61);
        let (_, remarks) = folder.done(&["convert", "out.dat", "back.csv"]);
        assert!(
            remarks.contains("“AH-6-40-7 AIRFOIL”: an airfoil in Selig order"),
            "{remarks}"
        );
    }
    let mut counts = Vec::new();
    for tolerance in ["1e-3", "1/10000", "1e-5"] {
        let arguments = ["points", "fair.batten", "out.csv", "--tolerance", tolerance];
        let (count, within) = told(&folder.done(&arguments).1);
        let text = fs::read_to_string(folder.path("out.csv")).unwrap();
        assert!(
            text.starts_with("# name=AH-6-40-7 AIRFOIL\nx,y\n"),
            "{text}"
        );
        assert_eq!(text.lines().count(), count + 2);
        let bound = if tolerance == "1/10000" {
            1e-4
        } else {
            tolerance.parse().unwrap()
        };
        assert!(
            within <= bound && within > 0.3 * bound,
            "{tolerance}: {within}"
        );
        counts.push(count);
    }
    assert!(
        counts.is_sorted() && counts[2] > 5 * counts[0],
        "{counts:?}"
    );
    // A tenth of the tolerance takes the root of ten times the points.
    let ratio = counts[2] as f64 / counts[1] as f64;
    assert!((ratio - 10_f64.sqrt()).abs() < 0.3, "{counts:?}");
    for spacing in ["arc-length", "cosine", "parameter"] {
        let spread = |density: [&str; 2]| {
            let arguments = ["points", "fair.batten", "out.dat", "--spacing", spacing];
            let (_, message) = folder.done(&[&arguments, &density[..]].concat());
            told(&message)
        };
        let (count, within) = spread(["--tolerance", "1e-4"]);
        let fewer = spread(["--count", &(count - 1).to_string()]);
        assert!(
            within <= 1e-4 && fewer.1 > 1e-4,
            "{spacing}: {within} {fewer:?}"
        );
        assert!(count >= counts[1], "{spacing}: {count} {counts:?}");
    }
}

#[test]
fn convert_writes_the_same_points() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "arc.batten"]);
    for (count, tolerance, name) in [
        (["--count", "9"], ["--points", "9"], "dat"),
        (["--tolerance", "1e-3"], ["--chord", "1e-3"], "csv"),
    ] {
        let [one, other] = ["a", "b"].map(|it| format!("{it}.{name}"));
        folder.done(&[&["points", "arc.batten", &one], &count[..]].concat());
        folder.done(&[&["convert", "arc.batten", &other], &tolerance[..]].concat());
        let [one, other] = [one, other].map(|it| fs::read_to_string(folder.path(&it)).unwrap());
        assert_eq!(one, other);
    }
    folder.misused(
        &[
            "convert",
            "arc.batten",
            "b.csv",
            "--points",
            "9",
            "--chord",
            "1",
        ],
        "cannot be used with",
    );
}

#[test]
fn points_need_a_number_or_a_tolerance_and_one_curve() {
    let line =
        |name: &str, y: f64| json!({"name": name, "degree": 1, "vertices": [[0, 0], [1, y]]});
    let two = project(json!([line("a", 1.0), line("b", 2.0)]));
    let folder = Folder::new().with("two.batten", two);
    folder.done(&["example", "arc", "arc.batten"]);
    let points = |more: &[&'static str]| [&["points", "two.batten", "out.dat"], more].concat();
    folder.misused(&points(&[]), "--count N, or --tolerance T");
    // Formats that hold no tables get a polyline.
    folder.done(&["points", "arc.batten", "out.dxf", "--count", "9"]);
    let drawn = folder.inspect(&["out.dxf"]);
    assert_eq!(drawn["references"].as_array().map(Vec::len), Some(1));
    folder.misused(
        &points(&["--count", "1"]),
        "a whole number from 2 to 1000000",
    );
    folder.misused(
        &points(&["--count", "2.5"]),
        "a whole number from 2 to 1000000",
    );
    folder.misused(&points(&["--tolerance", "0"]), "a number above 0");
    folder.misused(
        &points(&["--tolerance", "1", "--count", "9"]),
        "cannot be used with",
    );
    folder.refused(
        &points(&["--count", "9"]),
        "two.batten: choose one with --curve: there are “a”, “b”",
    );
    folder.done(&points(&["--count", "9", "--curve", "b"]));
    folder.refused(
        &["points", "arc.batten", "out.dat", "--tolerance", "1e-30"],
        "arc.batten: “arc” would take more than 100 000 points within 1e-30: allow more",
    );
    // A reference has points too.
    folder.done(&[
        "points",
        "out.dat",
        "-",
        "--to-format",
        "csv",
        "--count",
        "3",
    ]);
}
