//! Tests of the writer, by reading back, and of damaged files.

use std::sync::Arc;

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};

use super::evaluation::ends;
use super::tests::{file, set};
use super::{Protocol, read, write};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape};

fn item(kind: Kind, shape: Shape) -> Item {
    Item::new(kind, vec![shape])
}

fn spline(degree: usize, count: usize) -> Nurbs {
    let share = |place: usize| (place as f64 * 0.7).sin() / 3.0;
    let mut knots: Vec<f64> = (0..count + degree + 1)
        .map(|it| it as f64 / 3.0 - 0.1)
        .collect();
    if count > degree + 1 {
        knots[degree + 1] = knots[degree];
    }
    Nurbs {
        degree,
        knots,
        points: (0..count)
            .map(|it| dvec3(it as f64 / 7.0, share(it), -1e-17 * share(it + 1)))
            .collect(),
        weights: None,
        periodic: false,
    }
}

fn clamped(degree: usize, count: usize) -> Nurbs {
    let mut nurbs = spline(degree, count);
    let (first, last) = (nurbs.knots[degree], nurbs.knots[count]);
    nurbs.knots[..degree].fill(first);
    nurbs.knots[count..].fill(last);
    nurbs
}

fn conic(x: DVec3, y: DVec3, from: f64, to: f64) -> Shape {
    let centre = dvec3(1.0 / 3.0, -2.5e-9, 1e22);
    Shape::Conic(Conic {
        centre,
        x,
        y,
        from,
        to,
    })
}

fn line(points: &[DVec3], closed: bool) -> Shape {
    let points = points.to_vec();
    Shape::Polyline { points, closed }
}

/// One item of every sort that the format holds as it is.
fn sorts() -> Vec<Item> {
    let (a, b, c) = (
        DVec3::ZERO,
        dvec3(0.1, 0.2, -0.3),
        dvec3(1e-300, -0.0, 12345.678901234567),
    );
    let rational = Nurbs {
        weights: Some((0..8).map(|it| 1.0 + f64::from(it) / 3.0).collect()),
        ..clamped(3, 8)
    };
    let periodic = Nurbs {
        periodic: true,
        ..spline(3, 9)
    };
    let bezier = Nurbs {
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0],
        ..spline(2, 5)
    };
    let (x, y) = (dvec3(0.3, 0.4, 0.0), dvec3(-0.4, 0.3, 0.0));
    let mut chain = item(Kind::Polycurve, line(&[a, b], false));
    chain.shapes.push(Shape::Nurbs(Nurbs {
        points: vec![b, c, a],
        knots: vec![0.0, 0.0, 0.0, 0.3, 0.3, 0.3],
        degree: 2,
        weights: None,
        periodic: false,
    }));
    vec![
        item(Kind::Spline, Shape::Nurbs(spline(9, 16))),
        item(Kind::Spline, Shape::Nurbs(clamped(25, 30))),
        item(Kind::Spline, Shape::Nurbs(clamped(1, 2))),
        item(Kind::Spline, Shape::Nurbs(rational)),
        item(Kind::Spline, Shape::Nurbs(periodic)),
        item(Kind::Bezier, Shape::Nurbs(bezier)),
        item(Kind::Circle, conic(x, y, 0.0, TAU)),
        item(Kind::Ellipse, conic(x, 2.0 * y, 0.0, TAU)),
        item(Kind::Arc, conic(x, y, -0.7, 1.1)),
        item(Kind::Arc, conic(x, y, 5.0, 7.0)),
        item(Kind::Ellipse, conic(x, 0.5 * y, 0.0, 3.0)),
        item(Kind::Line, line(&[b, c], false)),
        item(Kind::Polyline, line(&[a, b, c], false)),
        item(Kind::Polyline, line(&[a, b, c], true)),
        item(Kind::Point, Shape::Point(b)),
        chain,
    ]
}

fn back(drawing: &Drawing, protocol: Protocol) -> Drawing {
    let bytes = write(drawing, "it's a n\u{e4}me", protocol).unwrap();
    let mut back = read(&bytes).unwrap();
    back.items.iter_mut().for_each(|item| item.at = 0);
    back
}

#[test]
fn every_sort_reads_back_bit_for_bit() {
    for protocol in [Protocol::Ap214, Protocol::Ap242] {
        for item in sorts() {
            let drawing = Drawing {
                unit: Some(1.0),
                items: vec![item],
                ..Drawing::default()
            };
            // Debug output tells -0.0 from 0.0.
            assert_eq!(
                format!("{:?}", back(&drawing, protocol)),
                format!("{drawing:?}")
            );
        }
    }
}

#[test]
fn groups_names_colours_and_units_read_back() {
    let mut items = sorts();
    for (place, item) in items.iter_mut().enumerate() {
        item.group = ["layer".to_owned(), format!("n\u{b0} {}", place % 3)].into();
        item.name = Some(format!("it's {place} \u{1f600}"));
        item.colour = Some([place as u8, 255, 17]);
    }
    items[0].group = Arc::default();
    items[1].colour = None;
    for unit in [1.0, 1000.0, 10.0, 25.4, 304.8, 1e-3, 0.123] {
        let drawing = Drawing {
            unit: Some(unit),
            items: items.clone(),
            ..Drawing::default()
        };
        assert_eq!(
            format!("{:?}", back(&drawing, Protocol::Ap214)),
            format!("{drawing:?}")
        );
    }
}

#[test]
fn whole_turn_from_another_angle_starts_there() {
    let (x, y) = (dvec3(3.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0));
    let Shape::Conic(mut own) = conic(x, y, 1.0, 1.0 + TAU) else {
        panic!()
    };
    own.centre = DVec3::ONE;
    let drawing = Drawing {
        items: vec![item(Kind::Ellipse, Shape::Conic(own.clone()))],
        ..Drawing::default()
    };
    let read = back(&drawing, Protocol::Ap214);
    let Shape::Conic(read) = &read.items[0].shapes[0] else {
        panic!()
    };
    // The whole curve on its principal axes; the start of a closed curve may move.
    let on_curve = |angle: f64| {
        let point = super::evaluation::on_conic(read, angle) - DVec3::ONE;
        (point.x / 3.0).powi(2) + point.y.powi(2)
    };
    for step in 0..8 {
        assert!((on_curve(f64::from(step)) - 1.0).abs() < 1e-14);
    }
}

#[test]
fn sheared_circle_becomes_an_ellipse() {
    let own = Conic {
        centre: DVec3::ONE,
        x: dvec3(2.0, 0.0, 0.0),
        y: dvec3(1.0, 1.0, 0.5),
        from: 0.5,
        to: 2.5,
    };
    let drawing = Drawing {
        items: vec![item(Kind::Arc, Shape::Conic(own.clone()))],
        ..Drawing::default()
    };
    let read = back(&drawing, Protocol::Ap214);
    let (start, end) = ends(&read.items[0].shapes[0]).unwrap();
    let (own_start, own_end) = ends(&Shape::Conic(own)).unwrap();
    assert!(start.distance(own_start) < 1e-14 && end.distance(own_end) < 1e-14);
}

#[test]
fn pieces_that_do_not_join_become_curves_of_their_own() {
    let mut path = item(Kind::Path, line(&[DVec3::ZERO, DVec3::X], false));
    path.shapes.push(line(&[DVec3::X, DVec3::Y], false));
    path.shapes.push(line(&[DVec3::Z, DVec3::ONE], false));
    let drawing = Drawing {
        items: vec![path],
        ..Drawing::default()
    };
    let kinds: Vec<_> = back(&drawing, Protocol::Ap214)
        .items
        .iter()
        .map(|it| it.kind)
        .collect();
    assert_eq!(kinds, [Kind::Polycurve, Kind::Polyline]);
}

#[test]
fn what_the_format_cannot_hold_is_refused_by_name() {
    let refusal = |item: Item| {
        let drawing = Drawing {
            items: vec![item],
            ..Drawing::default()
        };
        write(&drawing, "", Protocol::Ap214).unwrap_err().reason
    };
    let mut high = item(Kind::Spline, Shape::Nurbs(clamped(26, 30)));
    high.name = Some("high".to_owned());
    assert_eq!(
        refusal(high),
        "item 1 'high' (spline): degree 26 is above 25, which OpenCascade and FreeCAD drop"
    );
    let endless = item(Kind::Point, Shape::Point(DVec3::INFINITY));
    assert_eq!(
        refusal(endless),
        "item 1 (point): a coordinate is no finite number"
    );
    assert!(write(&Drawing::default(), "", Protocol::Ap214).is_err());
}

/// A small deterministic generator.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

fn damage(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        let length = random.below(60).min(bytes.len() - at);
        match random.below(6) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => drop(bytes.drain(at..at + length)),
            2 => {
                let piece = bytes[at..at + length].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            3 => drop(bytes.splice(at..at, *b"99999999999")),
            4 if random.below(5) == 0 => bytes.truncate(at.max(1)),
            _ => {
                let digits: Vec<usize> = (0..bytes.len())
                    .filter(|it| bytes[*it].is_ascii_digit())
                    .collect();
                if let Some(place) = digits.get(random.below(digits.len())) {
                    bytes[*place] = b"0123456789(),'#$*.;E-"[random.below(21)];
                }
            }
        }
        if bytes.is_empty() {
            bytes.push(b'#');
        }
    }
    bytes
}

#[test]
fn damaged_files_never_panic() {
    let drawing = Drawing {
        items: sorts(),
        ..Drawing::default()
    };
    let written = write(&drawing, "sorts", Protocol::Ap214).unwrap();
    let composite = set(
        "#30=TRIMMED_CURVE('',#22,(#14,PARAMETER_VALUE(1.)),(#15,PARAMETER_VALUE(2.)),.F.,.CARTESIAN.);\n\
         #31=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#30);\n#32=COMPOSITE_CURVE('',(#31),.F.);\n\
         #33=B_SPLINE_CURVE_WITH_KNOTS('',2,(#10,#11,#12,#10),.U.,.T.,.F.,(3,1,3),(0.,1.,2.),.U.);\n\
         #34=TRIMMED_CURVE('',#33,(#11,PARAMETER_VALUE(1.5)),(#12,PARAMETER_VALUE(0.5)),.T.,.PARAMETER.);",
        "#32,#34",
    );
    let solid = file(super::tests_structure::SHELL);
    let assembly = super::tests_structure::assembled();
    let samples = [
        written,
        composite.into_bytes(),
        solid.into_bytes(),
        assembly.into_bytes(),
    ];
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut read_well = 0;
    for round in 0..2000 {
        let bytes = damage(&samples[round % samples.len()], &mut random);
        if let Ok(drawing) = read(&bytes) {
            read_well += usize::from(!drawing.items.is_empty());
            let _ = write(&drawing, "again", Protocol::Ap214);
        }
    }
    assert!(read_well > 1000, "{read_well}");
}
