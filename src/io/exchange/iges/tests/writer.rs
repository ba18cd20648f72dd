use std::f64::consts::TAU;

use glam::DVec3;

use super::super::write;
use super::*;
use crate::io::exchange::drawing::{Conic, Item, Kind, Space};

/// Numbers that need all their digits.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn number(&mut self) -> f64 {
        let ratio = self.bits() as f64 / u64::MAX as f64 - 0.5;
        ratio * 10.0_f64.powi((self.bits() % 40) as i32 - 20)
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

fn item(kind: Kind, shapes: Vec<Shape>) -> Item {
    Item::new(kind, shapes)
}

fn nurbs(random: &mut Random, degree: usize, count: usize, is_rational: bool) -> Nurbs {
    let mut knots: Vec<f64> = (0..count + degree + 1).map(|_| random.number()).collect();
    knots.sort_by(f64::total_cmp);
    Nurbs {
        degree,
        knots,
        points: (0..count).map(|_| random.point()).collect(),
        weights: is_rational.then(|| (0..count).map(|_| random.number().abs()).collect()),
        periodic: random.bits() & 1 == 0,
    }
}

/// Write and read; lines in the file and their texts aside, the items must be the same.
fn back(drawing: &Drawing) -> Drawing {
    let bytes = write(drawing, "näme").unwrap();
    assert!(
        bytes
            .split(|byte| *byte == b'\n')
            .all(|line| line.is_empty() || line.len() == 80)
    );
    let mut read = read(&bytes).unwrap();
    assert_eq!(read.remarks, Vec::<String>::new());
    for item in &mut read.items {
        item.at = 0;
    }
    read
}

#[test]
fn splines_lines_polylines_and_points_come_back_bit_for_bit() {
    let mut random = Random(88_172_645_463_325_252);
    let mut drawing = Drawing {
        unit: Some(25.4),
        ..Drawing::default()
    };
    for degree in 1..12 {
        for is_rational in [false, true] {
            let shape = Shape::Nurbs(nurbs(&mut random, degree, 2 * degree + 3, is_rational));
            drawing.items.push(item(Kind::Spline, vec![shape]));
        }
    }
    let points: Vec<DVec3> = (0..9).map(|_| random.point()).collect();
    let chain = |count, closed| Shape::Polyline {
        points: points[..count].to_vec(),
        closed,
    };
    drawing.items.push(item(Kind::Line, vec![chain(2, false)]));
    drawing
        .items
        .push(item(Kind::Polyline, vec![chain(2, false)]));
    drawing
        .items
        .push(item(Kind::Polyline, vec![chain(9, false)]));
    drawing
        .items
        .push(item(Kind::Polyline, vec![chain(9, true)]));
    drawing
        .items
        .push(item(Kind::Point, vec![Shape::Point(points[0])]));
    let spline = Shape::Nurbs(nurbs(&mut random, 3, 7, true));
    drawing.items.push(item(
        Kind::Polycurve,
        vec![chain(2, false), spline, chain(4, false)],
    ));
    for (index, item) in drawing.items.iter_mut().enumerate() {
        item.name = Some(format!("name {index}, «{}»;", "x".repeat(5 * index)));
        item.group = [
            vec!["7".to_owned()],
            vec!["a".to_owned(), "b, c".to_owned()],
            vec![],
        ][index % 3]
            .as_slice()
            .into();
        item.colour = [
            None,
            Some([255, 0, 0]),
            Some([1, 2, 254]),
            Some([77, 0, 128]),
        ][index % 4];
        item.space = [Space::Model, Space::Edge][index % 2];
    }
    let read = back(&drawing);
    assert_eq!((read.unit, &read.other), (drawing.unit, &drawing.other));
    for (read, written) in read.items.iter().zip(&drawing.items) {
        assert_eq!(read, written);
    }
    assert_eq!(read.items.len(), drawing.items.len());
}

#[test]
fn conics_come_back_within_rounding() {
    let tilted = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    let across = DVec3::new(2.0, 1.0, -2.0) / 3.0;
    let flat = (DVec3::X, DVec3::Y);
    let mut written = Vec::new();
    for (x, y) in [flat, (tilted, across), (DVec3::Y, DVec3::X)] {
        for (a, b) in [(3.0, 3.0), (3.0, 1.0), (1.0e-3, 2.0), (5.0e7, 4.0e7)] {
            for (from, to) in [(0.0, TAU), (1.0, 2.0), (-3.0, 2.5), (6.0, 7.0)] {
                for centre in [DVec3::ZERO, DVec3::new(100.0, -7.0, 3.0)] {
                    written.push(Conic {
                        centre,
                        x: x * a,
                        y: y * b,
                        from,
                        to,
                    });
                }
            }
        }
    }
    // Conjugate half-axes.
    written.push(Conic {
        centre: DVec3::ONE,
        x: DVec3::X,
        y: DVec3::new(1.0, 2.0, 0.0),
        from: 0.3,
        to: 4.0,
    });
    let items = written
        .iter()
        .map(|conic| item(Kind::Arc, vec![Shape::Conic(conic.clone())]));
    let drawing = Drawing {
        items: items.collect(),
        ..Drawing::default()
    };
    for (item, conic) in back(&drawing).items.iter().zip(&written) {
        assert!(matches!(item.shapes[0], Shape::Conic(_)));
        let size = conic.x.length() + conic.y.length();
        let given = Shape::Conic(conic.clone());
        for ratio in [0.0, 0.3, 0.5, 1.0] {
            let gap = (point_at(&item.shapes[0], ratio) - point_at(&given, ratio)).length();
            assert!(
                gap < 3e-15 * size + 1e-15 * conic.centre.length(),
                "{gap} {conic:?} {:?}",
                item.shapes
            );
        }
    }
}

#[test]
fn units_are_written_by_flag_and_others_refused() {
    for millimetres in [
        25.4,
        1.0,
        304.8,
        1_609_344.0,
        1000.0,
        1.0e6,
        0.0254,
        0.001,
        10.0,
        2.54e-5,
    ] {
        let drawing = Drawing {
            unit: Some(millimetres),
            ..Drawing::default()
        };
        let line = Shape::Polyline {
            points: vec![DVec3::ZERO, DVec3::X],
            closed: false,
        };
        let drawing = Drawing {
            items: vec![item(Kind::Line, vec![line])],
            ..drawing
        };
        assert_eq!(back(&drawing).unit, Some(millimetres));
    }
    let yards = Drawing {
        unit: Some(914.4),
        ..Drawing::default()
    };
    assert!(
        write(&yards, "a")
            .unwrap_err()
            .reason
            .contains("no unit of 914.4 mm")
    );
}

#[test]
fn damaged_items_are_refused_by_name() {
    let mut random = Random(1);
    let good = nurbs(&mut random, 3, 5, true);
    let spoiled = |spoil: fn(&mut Nurbs)| {
        let mut nurbs = good.clone();
        spoil(&mut nurbs);
        nurbs
    };
    for (nurbs, reason) in [
        (
            spoiled(|it| it.knots.truncate(8)),
            "5 points and 8 knots do not fit degree 3",
        ),
        (spoiled(|it| it.knots.reverse()), "the knots do not rise"),
        (
            spoiled(|it| it.points[0].x = f64::NAN),
            "its numbers are not finite",
        ),
        (
            spoiled(|it| it.weights = Some(vec![1.0])),
            "1 weights do not fit 5 points",
        ),
    ] {
        let mut item = item(Kind::Spline, vec![Shape::Nurbs(nurbs)]);
        item.name = Some("keel".to_owned());
        let drawing = Drawing {
            items: vec![item],
            ..Drawing::default()
        };
        let error = write(&drawing, "a").unwrap_err().reason;
        assert_eq!(error, format!("item 1 (spline \"keel\"): {reason}"));
    }
}
