//! LWPOLYLINE and POLYLINE.

use std::f64::consts::PI;

use glam::DVec3;

use super::{assert_near, at, drawing, entities, items, remark, shapes};
use crate::io::exchange::drawing::{Kind, Shape};

fn points(points: &[(f64, f64, f64)]) -> Vec<DVec3> {
    points
        .iter()
        .map(|&(x, y, z)| DVec3::new(x, y, z))
        .collect()
}

#[test]
fn a_light_polyline_is_a_chain_at_its_elevation() {
    let text = "0 LWPOLYLINE; 90 3; 70 1; 38 5; 10 0; 20 0; 10 1; 20 0; 10 1; 20 1";
    let points = points(&[(0.0, 0.0, 5.0), (1.0, 0.0, 5.0), (1.0, 1.0, 5.0)]);
    assert_eq!(
        shapes(text),
        [Shape::Polyline {
            points,
            closed: true
        }]
    );
    assert_eq!(items(text)[0].kind, Kind::Polyline);
}

#[test]
fn bulges_are_arcs_between_chains() {
    let text =
        "0 LWPOLYLINE; 90 4; 70 0; 10 0; 20 0; 42 1; 10 2; 20 0; 10 3; 20 0; 10 3; 20 1; 42 -1";
    let shapes = shapes(text);
    let [
        Shape::Conic(arc),
        Shape::Polyline {
            points: chain,
            closed: false,
        },
    ] = shapes.as_slice()
    else {
        panic!("{shapes:?}");
    };
    assert_near(at(arc, arc.from), 0.0, 0.0, 0.0);
    assert_near(at(arc, PI / 2.0), 1.0, -1.0, 0.0);
    assert_near(at(arc, arc.to), 2.0, 0.0, 0.0);
    assert_eq!(
        *chain,
        points(&[(2.0, 0.0, 0.0), (3.0, 0.0, 0.0), (3.0, 1.0, 0.0)])
    );
}

#[test]
fn a_closed_polyline_has_the_bulge_of_its_last_corner() {
    let shapes = shapes("0 LWPOLYLINE; 70 1; 10 0; 20 0; 10 2; 20 0; 42 -1");
    let [Shape::Polyline { .. }, Shape::Conic(arc)] = shapes.as_slice() else {
        panic!("{shapes:?}");
    };
    assert_near(at(arc, arc.to / 2.0), 1.0, -1.0, 0.0);
    assert_near(at(arc, arc.to), 0.0, 0.0, 0.0);
}

#[test]
fn a_quarter_bulge_keeps_its_radius() {
    let bulge = (PI / 8.0).tan();
    let shapes = shapes(&format!(
        "0 LWPOLYLINE; 10 1; 20 0; 42 {bulge:?}; 10 0; 20 1"
    ));
    let [Shape::Conic(arc)] = shapes.as_slice() else {
        panic!("{shapes:?}");
    };
    assert_near(arc.centre, 0.0, 0.0, 0.0);
    assert!((arc.to - PI / 2.0).abs() < 1e-15);
}

#[test]
fn an_extrusion_tilts_arcs_and_chains() {
    let text = "0 LWPOLYLINE; 38 4; 210 0; 220 0; 230 -1; 10 0; 20 0; 42 1; 10 2; 20 0; 10 2; 20 5";
    let shapes = shapes(text);
    let [Shape::Conic(arc), Shape::Polyline { points, .. }] = shapes.as_slice() else {
        panic!("{shapes:?}");
    };
    assert_near(at(arc, PI / 2.0), -1.0, -1.0, -4.0);
    assert_near(points[1], -2.0, 5.0, -4.0);
}

#[test]
fn heavy_polylines_are_flat_or_in_space() {
    let vertices = "0 VERTEX; 10 0; 20 0; 30 1; 0 VERTEX; 10 1; 20 0; 30 2; 42 1; 0 SEQEND;";
    let flat = shapes(&format!(
        "0 POLYLINE; 66 1; 10 0; 20 0; 30 9; 70 0; {vertices}"
    ));
    let expected = points(&[(0.0, 0.0, 9.0), (1.0, 0.0, 9.0)]);
    assert_eq!(
        flat,
        [Shape::Polyline {
            points: expected,
            closed: false
        }]
    );
    let tall = shapes(&format!("0 POLYLINE; 66 1; 70 9; {vertices}"));
    let expected = points(&[(0.0, 0.0, 1.0), (1.0, 0.0, 2.0)]);
    assert_eq!(
        tall,
        [Shape::Polyline {
            points: expected,
            closed: true
        }]
    );
}

#[test]
fn the_frame_of_a_fitted_spline_is_left_out() {
    let vertex = |x: i32, flags: i32| format!("0 VERTEX; 10 {x}; 20 0; 70 {flags};");
    let vertices = [vertex(0, 16), vertex(1, 8), vertex(2, 8), vertex(3, 16)].concat();
    let shapes = shapes(&format!("0 POLYLINE; 70 4; {vertices} 0 SEQEND"));
    let points = points(&[(1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]);
    assert_eq!(
        shapes,
        [Shape::Polyline {
            points,
            closed: false
        }]
    );
}

#[test]
fn meshes_are_no_curves() {
    for flags in [16, 64] {
        let text =
            format!("0 POLYLINE; 70 {flags}; 0 VERTEX; 10 0; 20 0; 0 SEQEND; 0 POINT; 10 1; 20 1");
        let drawing = drawing(&entities(&text));
        assert_eq!(drawing.other[0].kind, "POLYLINE mesh");
        assert_eq!((drawing.items.len(), drawing.other.len()), (1, 1));
    }
}

#[test]
fn damaged_polylines_are_remarked_on() {
    let alone = "0 LWPOLYLINE; 10 1; 20 1";
    assert_eq!(
        remark(alone),
        "line 6: LWPOLYLINE skipped: it has 1 of at least 2 corners"
    );
    let half = "0 LWPOLYLINE; 10 1; 20 1; 10 2; 10 3; 20 3";
    assert_eq!(
        remark(half),
        "line 6: LWPOLYLINE skipped: a corner has no y"
    );
    let vertex = "0 POLYLINE; 0 VERTEX; 10 1; 20 1; 0 VERTEX; 10 1; 20 ?; 0 SEQEND";
    assert_eq!(
        remark(vertex),
        "line 18: POLYLINE skipped: group 20 holds \"?\", no finite number"
    );
    let few = drawing(&entities("0 LWPOLYLINE; 90 3; 10 1; 20 1; 10 2; 20 2"));
    assert_eq!(few.remarks, ["line 6: LWPOLYLINE says 3 corners and has 2"]);
    let open = drawing(&entities(
        "0 POLYLINE; 0 VERTEX; 10 1; 20 1; 0 VERTEX; 10 1; 20 2; 0 POINT; 10 1; 20 1",
    ));
    assert_eq!(
        open.remarks,
        ["line 6: POLYLINE has no SEQEND; it ends at its last VERTEX"]
    );
    assert_eq!(open.items.len(), 2);
}
