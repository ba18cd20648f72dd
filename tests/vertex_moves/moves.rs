//! Moves of vertices are proved as the whole curve would be.

use batten::geometry::FloatPolygon;
use batten::geometry::features::Features;
use batten::geometry::vertex_moves::{FeatureRise, MoveError, MoveProver, RegionSearch};
use glam::DVec3;

use crate::common::Random;
use crate::curves::{case, moved, proved};

#[test]
fn segments_proved_anew_make_the_same_whole_as_all_of_them() {
    let mut random = Random(7);
    for number in 0..300 {
        let case = case(number);
        let polygon = &case.polygon;
        let mut prover = MoveProver::new(polygon, &proved(polygon), vec![case.vertex])
            .expect("a planar curve without doubts");
        assert!(prover.dependent().len() <= polygon.degree() + 1);
        assert_eq!(*prover.before(), Features::new(polygon));
        for _ in 0..4 {
            let size = random.between(0.0, 1.0).powi(3);
            let place = polygon.vertices()[case.vertex] + random.vector(size, false);
            let whole = Features::new(&moved(polygon, case.vertex, place));
            let after = prover.features(&[place]).expect("a place in the plane");
            assert_eq!(after, whole, "case {number}");
            let rise = prover.rise(&[place]).expect("a place in the plane");
            assert_eq!(rise, FeatureRise::between(prover.before(), &whole));
        }
    }
}

#[test]
fn several_vertices_move_at_once() {
    let mut random = Random(8);
    for number in 0..60 {
        let polygon = case(number).polygon;
        let vertices = vec![0, 2, polygon.vertices().len() - 1];
        let by = random.vector(0.3, false);
        let places: Vec<DVec3> = vertices
            .iter()
            .map(|index| polygon.vertices()[*index] + by)
            .collect();
        let mut prover = MoveProver::new(&polygon, &proved(&polygon), vertices.clone())
            .expect("a planar curve without doubts");
        let mut whole = polygon.clone();
        let moves = vertices.iter().copied().zip(places.iter().copied());
        whole.move_vertices(moves).expect("places in the plane");
        let after = prover.features(&places).expect("places in the plane");
        assert_eq!(after, Features::new(&whole), "case {number}");
    }
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let space = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.5], [2.0, 1.0, 0.0], [3.0; 3]];
    let space = FloatPolygon::new(3, space.map(DVec3::from).to_vec(), None, false);
    let space = space.expect("a polygon");
    let refused = RegionSearch::new(&space, &proved(&space), 1);
    assert_eq!(refused.err(), Some(MoveError::Space));
    let planar = case(0).polygon;
    let count = planar.vertices().len();
    let refused = MoveProver::new(&planar, &proved(&planar), vec![count]);
    assert!(matches!(refused, Err(MoveError::Polygon(_))));
    let mut prover = MoveProver::new(&planar, &proved(&planar), vec![1]).expect("a planar curve");
    assert_eq!(prover.rise(&[DVec3::Z]), Err(MoveError::Space));
    let beyond = DVec3::new(1e200, 0.0, 0.0);
    assert!(matches!(prover.rise(&[beyond]), Err(MoveError::Polygon(_))));
}
