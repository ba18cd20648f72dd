use std::f64::consts::{PI, TAU};

use super::*;
use crate::io::exchange::drawing::Kind;

fn conic(form: i32, text: &str) -> Drawing {
    drawing(&[Given {
        form,
        ..given(104, text)
    }])
}

#[test]
fn whole_ellipse_has_its_axes() {
    let drawing = conic(1, "4.,0.,9.,0.,0.,-36.,2.,3.,0.,3.,0.");
    let Shape::Conic(it) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(drawing.items[0].kind, Kind::Ellipse);
    assert_eq!(
        (it.centre, it.x, it.y),
        (DVec3::Z * 2.0, DVec3::X * 3.0, DVec3::Y * 2.0)
    );
    assert_eq!((it.from, it.to), (0.0, TAU));
}

#[test]
fn moved_ellipse_arc_runs_anticlockwise() {
    // 4(x − 1)² + 9(y − 2)² = 36
    let drawing = conic(0, "4.,0.,9.,-8.,-36.,4.,0.,-2.,2.,4.,2.");
    let Shape::Conic(it) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(
        (drawing.items[0].kind, it.from, it.to),
        (Kind::Ellipse, PI, TAU)
    );
    assert!((point_at(only_shape(&drawing), 0.5) - DVec3::new(1.0, 0.0, 0.0)).length() < 1e-15);
}

#[test]
fn turned_ellipse_lies_on_its_equation() {
    // 5x² − 6xy + 5y² = 8: half-axes 2 along the diagonal and 1 across.
    let drawing = conic(
        1,
        "5.,-6.,5.,0.,0.,-8.,0.,1.4142135623730951,1.4142135623730951,-.7071067811865476,.7071067811865476",
    );
    for index in 0..=20 {
        let p = point_at(only_shape(&drawing), f64::from(index) / 20.0);
        assert!((5.0 * p.x * p.x - 6.0 * p.x * p.y + 5.0 * p.y * p.y - 8.0).abs() < 1e-14);
    }
    let end = point_at(only_shape(&drawing), 1.0);
    assert!((end - DVec3::new(-0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0)).length() < 1e-15);
}

#[test]
fn parabola_is_one_quadratic_segment() {
    // y = x², also turned: x = y².
    for (text, swapped) in [
        ("1.,0.,0.,0.,-1.,0.,3.,-1.,1.,2.,4.", false),
        ("0.,0.,1.,-1.,0.,0.,3.,1.,-1.,4.,2.", true),
    ] {
        let drawing = conic(3, text);
        let Shape::Nurbs(it) = only_shape(&drawing) else {
            panic!()
        };
        assert_eq!(
            (drawing.items[0].kind, it.degree, &it.weights),
            (Kind::Spline, 2, &None)
        );
        for index in 0..=20 {
            let p = point_at(only_shape(&drawing), f64::from(index) / 20.0);
            let (x, y) = if swapped { (p.y, p.x) } else { (p.x, p.y) };
            assert!((y - x * x).abs() < 1e-14 && (p.z - 3.0).abs() < 1e-14);
        }
        assert_eq!(it.points[1].truncate().max_element(), 0.5);
    }
}

#[test]
fn turned_parabola_lies_on_its_equation() {
    // (x + y)² = x − y from (0, 0) to (6, 2) / 4 · …: s = x + y, d = s².
    let drawing = conic(0, "1.,2.,1.,-1.,1.,0.,0.,0.,0.,3.,-1.");
    let shape = only_shape(&drawing);
    for index in 0..=20 {
        let p = point_at(shape, f64::from(index) / 20.0);
        assert!(((p.x + p.y).powi(2) - p.x + p.y).abs() < 1e-14, "{p}");
    }
    assert!((point_at(shape, 1.0) - DVec3::new(3.0, -1.0, 0.0)).length() < 1e-14);
}

#[test]
fn hyperbola_is_one_rational_segment() {
    let (cosh, sinh) = (1.5_f64.cosh(), 1.5_f64.sinh());
    for side in [1.0, -1.0] {
        // x²/4 − y²/9 = 1
        let (x, y) = (side * 2.0 * cosh, 3.0 * sinh);
        let drawing = conic(2, &format!("9.,0.,-4.,0.,0.,-36.,1.,{x},{},{x},{y}", -y));
        let Shape::Nurbs(it) = only_shape(&drawing) else {
            panic!()
        };
        assert_eq!((drawing.items[0].kind, it.degree), (Kind::Spline, 2));
        for index in 0..=20 {
            let p = point_at(only_shape(&drawing), f64::from(index) / 20.0);
            assert!((p.x * p.x / 4.0 - p.y * p.y / 9.0 - 1.0).abs() < 1e-13 && p.x * side > 0.0);
        }
        let middle = point_at(only_shape(&drawing), 0.5);
        assert!((middle - DVec3::new(2.0 * side, 0.0, 1.0)).length() < 1e-14);
    }
}

#[test]
fn upright_and_turned_hyperbolas_lie_on_their_equations() {
    // y² − x² = 1 and x·y = 1.
    let upright = conic(2, "-1.,0.,1.,0.,0.,-1.,0.,0.,1.,.75,1.25");
    let turned = conic(0, "0.,1.,0.,0.,0.,-1.,0.,.25,4.,2.,.5");
    for index in 0..=20 {
        let ratio = f64::from(index) / 20.0;
        let (p, q) = (
            point_at(only_shape(&upright), ratio),
            point_at(only_shape(&turned), ratio),
        );
        assert!((p.y * p.y - p.x * p.x - 1.0).abs() < 1e-14);
        assert!((q.x * q.y - 1.0).abs() < 1e-14);
    }
    assert!((point_at(only_shape(&turned), 1.0) - DVec3::new(2.0, 0.5, 0.0)).length() < 1e-14);
}

#[test]
fn degenerate_conics_are_skipped_with_their_reason() {
    for (text, reason) in [
        ("0.,0.,0.,1.,1.,0.,0.,0.,0.,1.,1.", "no quadratic terms"),
        ("1.,0.,1.,0.,0.,1.,0.,0.,0.,1.,1.", "no real points"),
        ("1.,0.,0.,0.,0.,-1.,0.,1.,0.,1.,1.", "parallel lines"),
        ("1.,0.,-1.,0.,0.,-1.,0.,-1.,0.,1.,0.", "two branches"),
        ("1.,0.,0.,0.,-1.,0.,0.,1.,1.,1.,1.", "no length"),
    ] {
        let drawing = conic(0, text);
        assert!(
            drawing.items.is_empty() && has_remark(&drawing, reason),
            "{:?}",
            drawing.remarks
        );
    }
}
