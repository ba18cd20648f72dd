//! Tests with small files and closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::{read, write};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape, Space};

/// A file with one edge in a compound for each curve and range, and `more` shapes behind the edges.
fn file(curves: &[(&str, &str)], locations: &str, references: &[&str]) -> String {
    let mut text =
        format!("DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\n{locations}\n");
    text += &format!("Curve2ds 1\n1 0 0 1 0\nCurves {}\n", curves.len());
    for (curve, _) in curves {
        text += &format!("{curve}\n");
    }
    text += "Polygon3D 0\nPolygonOnTriangulations 0\nSurfaces 0\nTriangulations 0\n\n";
    text += &format!("TShapes {}\n", curves.len() + 1);
    for (index, (_, range)) in curves.iter().enumerate() {
        text += &format!(
            "Ed\n 1e-07 1 1 0\n1  {} 0 {range}\n0\n\n0101000\n*\n",
            index + 1
        );
    }
    text + &format!("Co\n\n1100000\n{} *\n\n+1 0\n", references.join(" "))
}

fn curve(curve: &str, range: &str) -> (Kind, Shape) {
    let drawing = read(file(&[(curve, range)], "Locations 0", &["+2 0"]).as_bytes()).unwrap();
    assert_eq!((&drawing.remarks, drawing.items.len()), (&Vec::new(), 1));
    let item = drawing.items.into_iter().next().unwrap();
    assert_eq!(item.space, Space::Model);
    (item.kind, item.shapes.into_iter().next().unwrap())
}

fn spline(text: &str, range: &str) -> Nurbs {
    match curve(text, range) {
        (Kind::Spline | Kind::Bezier, Shape::Nurbs(nurbs)) => nurbs,
        other => panic!("{other:?}"),
    }
}

/// The point of a quadratic segment.
fn quadratic(nurbs: &Nurbs, t: f64) -> DVec3 {
    let basis = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t];
    let weight = |index: usize| nurbs.weights.as_ref().map_or(1.0, |weights| weights[index]);
    let sum = (0..3).fold(DVec3::ZERO.extend(0.0), |sum, index| {
        sum + (nurbs.points[index] * weight(index)).extend(weight(index)) * basis[index]
    });
    sum.truncate() / sum.w
}

#[test]
fn lines_and_conics_are_taken_over_their_range() {
    let points = vec![DVec3::new(1.0, 2.0, 4.0), DVec3::new(1.0, 2.0, 5.0)];
    let line = (
        Kind::Line,
        Shape::Polyline {
            points,
            closed: false,
        },
    );
    assert_eq!(curve("1 1 2 3 0 0 1", "1 2"), line);
    let centre = DVec3::new(1.0, 2.0, 3.0);
    let conic = |x: f64, y: f64, from, to| {
        Shape::Conic(Conic {
            centre,
            x: DVec3::X * x,
            y: DVec3::Y * y,
            from,
            to,
        })
    };
    let frame = "1 2 3 0 0 1 1 0 0 0 1 0";
    let circle = format!("2 {frame} 2.5");
    let ellipse = format!("3 {frame} 3 1");
    let half = format!("0 {PI:?}");
    assert_eq!(curve(&circle, &half), (Kind::Arc, conic(2.5, 2.5, 0.0, PI)));
    assert_eq!(
        curve(&circle, "0 6.28318530717959"),
        (Kind::Circle, conic(2.5, 2.5, 0.0, TAU))
    );
    assert_eq!(
        curve(&ellipse, "0 6.28318530717959"),
        (Kind::Ellipse, conic(3.0, 1.0, 0.0, TAU))
    );
}

#[test]
fn parabolas_and_hyperbolas_are_quadratic_segments() {
    let parabola = spline("4 0 0 0 0 0 1 1 0 0 0 1 0 0.5", "-1 2");
    let hyperbola = spline("5 0 0 0 0 0 1 1 0 0 0 1 0 2 3", "-1 0.5");
    for index in 0..=20 {
        let t = f64::from(index) / 20.0;
        // y² = 2·x and x²/4 − y²/9 = 1
        let (p, q) = (quadratic(&parabola, t), quadratic(&hyperbola, t));
        assert!((p.y * p.y - 2.0 * p.x).abs() < 1e-14);
        assert!((q.x * q.x / 4.0 - q.y * q.y / 9.0 - 1.0).abs() < 1e-14);
    }
    let end = DVec3::new(2.0 * 0.5_f64.cosh(), 3.0 * 0.5_f64.sinh(), 0.0);
    assert_eq!(parabola.points[0], DVec3::new(0.5, -1.0, 0.0));
    assert!((hyperbola.points[2] - end).length() < 1e-15);
}

#[test]
fn splines_keep_their_knots_and_are_cut() {
    let text = "7 0 0  2 4 3  0 0 0  1 1 0  2 0 0  3 1 0\n 0 3 1 1 2 3";
    let whole = spline(text, "0 2");
    assert_eq!(whole.knots, [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]);
    let cut = spline(text, "0 1");
    assert_eq!(cut.knots, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    assert_eq!(
        cut.points,
        [
            DVec3::ZERO,
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(1.5, 0.5, 0.0)
        ]
    );
    let trimmed = spline(&format!("8 0 1.5\n{text}"), "0 1");
    assert_eq!(trimmed, cut);
    let bezier = spline("6 1 2 1 0 0  1  1 1 0  2  0 1 0  1", "0 1");
    assert_eq!(
        (bezier.degree, bezier.weights),
        (2, Some(vec![1.0, 2.0, 1.0]))
    );
}

/// A square as a periodic spline of degree 1, and its smooth sister of degree 2.
#[test]
fn periodic_splines_are_completed_also_across_the_seam() {
    let poles = "1 0 0  0 1 0  -1 0 0  0 -1 0";
    let square = format!("7 0 1  1 4 5  {poles}\n 0 1 1 1 2 1 3 1 4 1");
    let whole = spline(&square, "0 4");
    assert_eq!(whole.knots, [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(
        (whole.points.len(), whole.points[0], whole.points[4]),
        (5, DVec3::X, DVec3::X)
    );
    assert!(whole.periodic);
    let across = spline(&square, "3.5 4.5");
    let ends = [
        DVec3::new(0.5, -0.5, 0.0),
        DVec3::X,
        DVec3::new(0.5, 0.5, 0.0),
    ];
    assert_eq!(
        (across.points.as_slice(), across.periodic),
        (&ends[..], false)
    );
    let before = spline(&square, "-0.5 0.5");
    assert_eq!(before.points, ends);
    let smooth = spline(
        &format!("7 0 1  2 4 5  {poles}\n 0 1 1 1 2 1 3 1 4 1"),
        "0 4",
    );
    assert_eq!((smooth.points.len(), smooth.knots.len()), (6, 9));
}

#[test]
fn locations_are_composed_and_inverted() {
    let locations = "Locations 3\n1\n0 -1 0 10\n1 0 0 20\n0 0 1 30\n1\n1 0 0 1\n\
        0 1 0 2\n0 0 1 3\n2  2 1 1 1 2 -1 0";
    let line = ("1 0 0 0 1 0 0", "0 1");
    let drawing = read(file(&[line], locations, &["+2 1", "+2 3"]).as_bytes()).unwrap();
    let end = |index: usize| match &drawing.items[index].shapes[0] {
        Shape::Polyline { points, .. } => points[1],
        _ => panic!(),
    };
    assert_eq!(end(0), DVec3::new(10.0, 21.0, 30.0));
    // (1, 0, 0) moved to (2, 2, 3), turned to (8, 22, 33), moved back.
    assert_eq!(end(1), DVec3::new(7.0, 20.0, 30.0));
}

#[test]
fn edges_of_faces_are_boundaries_and_drawn_once() {
    let text = "CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 1\n1 0 0 0 1 0 0\n\
        Polygon3D 0\nPolygonOnTriangulations 0\nSurfaces 1\n1 0 0 0 0 0 1 1 0 0 0 1 0\nTriangulations 0\n\
        TShapes 5\nEd\n 1e-07 1 1 0\n1  1 0 0 2\n2 1 1 0 0 2\n3 1 2CN 1 0 0 2\n4CN 1 0 1 0\n0\n\n0101000\n*\n\
        Wi\n\n0101000\n+5 0 -5 0 *\nFa\n0  1e-07 1 0\n2  1\n0101000\n+4 0 *\n\
        Fa\n0  1e-07 1 0\n\n0101000\n+4 0 *\n\
        Sh\n\n0101000\n+3 0 -2 0 *\n\n+1 0\n";
    let drawing = read(text.as_bytes()).unwrap();
    assert_eq!(drawing.remarks, Vec::<String>::new());
    assert_eq!(drawing.items.len(), 1);
    assert_eq!(
        (drawing.items[0].space, drawing.items[0].at),
        (Space::Edge, 12)
    );
}

fn item(kind: Kind, shapes: Vec<Shape>) -> Item {
    Item::new(kind, shapes)
}

fn samples() -> Drawing {
    let rational = Nurbs {
        degree: 2,
        knots: vec![-0.1, 0.0, 1.0 / 3.0, 1.0, 1.5, 1.5, 1.5],
        points: (1..5)
            .map(|index| DVec3::new(0.1, 1.0 / 3.0, 1e-9) * f64::from(index * index))
            .collect(),
        weights: Some(vec![1.0, 0.1, 2.0 / 3.0, 7.0]),
        periodic: false,
    };
    let corners: Vec<DVec3> = (0..5)
        .map(|index| DVec3::new(0.1, 0.7, -1.3).powf(2.0) * f64::from(index * index))
        .collect();
    let corners: Vec<DVec3> = corners
        .iter()
        .map(|it| it.with_y((it.x * 7.0).sin()))
        .collect();
    let chain = |count: usize, closed| Shape::Polyline {
        points: corners[..count].to_vec(),
        closed,
    };
    let conic = Conic {
        centre: DVec3::ONE,
        x: DVec3::Y * 2.0,
        y: DVec3::Z,
        from: 0.0,
        to: FRAC_PI_2,
    };
    let shapes = [
        (Kind::Spline, vec![Shape::Nurbs(rational.clone())]),
        (Kind::Line, vec![chain(2, false)]),
        (Kind::Polyline, vec![chain(5, false)]),
        (Kind::Polyline, vec![chain(5, true)]),
        (Kind::Point, vec![Shape::Point(corners[3])]),
        (Kind::Ellipse, vec![Shape::Conic(conic)]),
        (
            Kind::Polycurve,
            vec![Shape::Nurbs(rational), chain(3, false)],
        ),
    ];
    Drawing {
        items: shapes
            .into_iter()
            .map(|(kind, shapes)| item(kind, shapes))
            .collect(),
        unit: Some(1.0),
        ..Drawing::default()
    }
}

#[test]
fn items_come_back_bit_for_bit() {
    let drawing = samples();
    let mut back = read(&write(&drawing, "a").unwrap()).unwrap();
    for item in &mut back.items {
        item.at = 0;
    }
    assert_eq!(back, drawing);
}

#[test]
fn what_the_format_cannot_hold_is_refused_by_name() {
    let inches = Drawing {
        unit: Some(25.4),
        ..Drawing::default()
    };
    assert!(
        write(&inches, "a")
            .unwrap_err()
            .reason
            .contains("millimetres, not in units of 25.4 mm")
    );
    let steep = Nurbs {
        degree: 26,
        knots: [[0.0; 27], [1.0; 27]].concat(),
        points: vec![DVec3::ONE; 27],
        weights: None,
        periodic: false,
    };
    let drawing = Drawing {
        items: vec![item(Kind::Spline, vec![Shape::Nurbs(steep)])],
        ..Drawing::default()
    };
    let reason = write(&drawing, "a").unwrap_err().reason;
    assert_eq!(
        reason,
        "item 1 (spline): OpenCascade takes degrees up to 25, not 26"
    );
}

#[test]
fn damage_has_its_line_and_reason() {
    for (curve, reason) in [
        ("1 0 0 0 1 x 0", "a number is expected, not \"x\""),
        ("12 0", "curve type 12 is unknown"),
        ("7 0 0 2 999999999 4 0 0 0", "a count of 999999999"),
        ("7 0 0 200 3 4 0 0 0", "degree 200"),
        ("1 0 0 0 1 inf 0", "a number is expected, not \"inf\""),
    ] {
        let error = read(file(&[(curve, "0 1")], "Locations 0", &["+2 0"]).as_bytes()).unwrap_err();
        assert!(
            error.at >= Some(8) && error.reason.contains(reason),
            "{error:?}"
        );
    }
    for (curve, range, reason) in [
        (
            "1 0 0 0 1 0 0",
            "1 0",
            "line 15: edge: its parameters 1 to 0 do not rise",
        ),
        ("1 0 0 0 1 0 0", "-2e100 2e100", "it is infinite"),
        (
            "9 1 0 0 1 1 0 0 0 1 0 0",
            "0 1",
            "an offset curve is no spline",
        ),
        (
            "7 0 0 1 2 2 0 0 0 1 0 0 0 2 1 1",
            "0 1",
            "2 points and 3 knots do not fit degree 1",
        ),
    ] {
        let drawing = read(file(&[(curve, range)], "Locations 0", &["+2 0"]).as_bytes()).unwrap();
        assert!(
            drawing.items.is_empty() && drawing.remarks[0].contains(reason),
            "{:?}",
            drawing.remarks
        );
    }
    assert!(
        read(b"Open CASCADE Topology V4 (c)\n")
            .unwrap_err()
            .reason
            .contains("binary")
    );
    assert!(read(b"ISO-10303-21;").is_err());
}

#[test]
fn cut_off_file_keeps_its_edges() {
    let line = ("1 0 0 0 1 0 0", "0 1");
    let text = file(&[line, line], "Locations 0", &["+2 0"]);
    let cut = text.rfind("0101000").unwrap();
    let drawing = read(&text.as_bytes()[..cut]).unwrap();
    assert_eq!(drawing.items.len(), 1);
    assert!(
        drawing.remarks[0].contains("the edges before are kept"),
        "{:?}",
        drawing.remarks
    );
}

#[test]
fn damage_among_the_curves_leaves_those_before_it() {
    let spline = (
        "7 0 0  2 4 3  0 0 0  1 1 0  2 0 0  3 1 0\n 0 3 1 1 2 3",
        "0 2",
    );
    let line = ("1 0 0 0 1 0 0", "0 1");
    let text = file(
        &[spline, line, spline],
        "Locations 0",
        &["+4 0", "+3 0", "+2 0"],
    );
    // A letter in the last curve.
    let last = text.rfind("3 1 0\n").expect("a point");
    let damaged = [&text[..last], "x", &text[last + 1..]].concat();
    let drawing = read(damaged.as_bytes()).expect("two edges");
    assert_eq!(drawing.items.len(), 2, "{:?}", drawing.remarks);
    let told = drawing.remarks.join("; ");
    assert!(
        told.contains("is expected, not \"x\"; the curves behind number 2 are missing"),
        "{told}"
    );
    // A file that ends there.
    let drawing = read(&text.as_bytes()[..last]).expect("a spline");
    let kinds: Vec<Kind> = drawing.items.iter().map(|item| item.kind).collect();
    assert_eq!(kinds, [Kind::Spline], "{:?}", drawing.remarks);
    assert!(drawing.remarks[0].contains("the curves before are kept whole"));
}

/// Each compound holds the one before twice: 2⁶⁰ lines.
#[test]
fn exponential_compounds_are_cut_off() {
    let mut text = file(&[("1 0 0 0 1 0 0", "0 1")], "Locations 0", &["+62 0"]);
    text = text
        .replace("TShapes 2", "TShapes 62")
        .replace("\n\n+1 0\n", "\n");
    for index in 2..62 {
        text += &format!("Co\n\n1100000\n+{0} 0 +{0} 0 *\n", 63 - index);
    }
    let drawing = read((text + "\n+1 0\n").as_bytes()).unwrap();
    assert!(drawing.items.len() > 100_000);
    assert!(drawing.remarks[0].contains("the rest is left out"));
}

struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

#[test]
fn damaged_files_never_panic() {
    let periodic = "7 0 1  2 4 5  1 0 0  0 1 0  -1 0 0  0 -1 0\n 0 1 1 1 2 1 3 1 4 1";
    let locations = "Locations 2\n1\n0 -1 0 10\n1 0 0 20\n0 0 1 30\n2  1 2 0";
    let curves = [
        (periodic, "0.5 4.2"),
        ("8 0 1 5 0 0 0 0 0 1 1 0 0 0 1 0 2 3", "0 1"),
        ("6 0 1 0 0 0 1 1 1", "0 1"),
    ];
    let samples = [
        write(&samples(), "a").unwrap(),
        file(&curves, locations, &["+2 1", "+3 2", "+4 0"]).into_bytes(),
    ];
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    for index in 0..3000 {
        let mut bytes = samples[index % 2].clone();
        for _ in 0..=random.below(3) {
            let at = random.below(bytes.len());
            let end = (at + random.below(80)).min(bytes.len());
            match random.below(5) {
                0 => bytes[at] = random.below(256) as u8,
                1 if random.below(4) == 0 => bytes.truncate(at.max(1)),
                2 => drop(bytes.drain(at..end.min(bytes.len() - 1))),
                3 => {
                    let piece = bytes[at..end].to_vec();
                    bytes.splice(at..at, piece);
                }
                _ => bytes[at] = b"0123456789 +-*e"[random.below(15)],
            }
        }
        if let Ok(drawing) = read(&bytes) {
            let _ = write(&drawing, "a");
        }
    }
}
