//! An inflection of a changed curve where the curve before turned: it came from elsewhere.

use glam::DVec3;

use crate::geometry::features::{Feature, Features, Turning};
use crate::geometry::float_polygon::FloatPolygon;

/// An inflection may slide along what turns by so much, in radians: on a flat side far, round a nose not at all.
const SLIDES: f64 = 0.2;

/// Find an inflection of a planar curve that lies where the curve before it turned, away from its own inflections and
/// its ends; `None` if there is none.
///
/// The curve before turns by more than 0.2 radians from the point nearest to the inflection to each of them.
pub(super) fn displaced_inflection(
    [before, after]: [&FloatPolygon; 2],
    features: [&Features; 2],
) -> Option<DVec3> {
    let [own, new] = features.map(inflections);
    if new.is_empty() || !before.is_planar() {
        return None;
    }
    let turning = Turning::new(before);
    let length = before.segments() as f64;
    let own: Vec<f64> = match before.is_periodic() {
        true => [-length, 0.0, length]
            .iter()
            .flat_map(|round| own.iter().map(move |u| u + round))
            .collect(),
        false => [0.0].into_iter().chain(own).chain([length]).collect(),
    };
    let angles: Vec<f64> = own.iter().map(|u| turning.angle(*u)).collect();
    let points = new.into_iter().map(|u| after.point(u));
    let mut points = points.filter(|point| {
        let u = before.nearest(*point).u;
        let next = own.partition_point(|own| *own < u);
        let beside = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let beside = beside.filter_map(|index| angles.get(index));
        let angle = turning.angle(u);
        let turns = beside.map(|own| (angle - own).abs());
        turns.fold(f64::INFINITY, f64::min) > SLIDES
    });
    points.next()
}

/// The parameters of the inflections of a curve, in their order.
fn inflections(features: &Features) -> Vec<f64> {
    let places = features.places(Feature::Inflection).into_iter();
    places.map(|([from, to], _)| 0.5 * (from + to)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon along an S that turns by a right angle to either side, with one corner out of line.
    fn bent(moved: usize, by: f64) -> FloatPolygon {
        let angle = |leg: usize| 0.1 * (leg as f64 - 15.0).abs();
        let mut point = DVec3::ZERO;
        let legs = (0..31).map(|leg| {
            point += DVec3::new(angle(leg).cos(), angle(leg).sin(), 0.0);
            point
        });
        let mut vertices: Vec<DVec3> = legs.collect();
        vertices[moved].y += by;
        FloatPolygon::new(3, vertices, None, false).expect("a polygon")
    }

    #[test]
    fn only_inflections_where_the_curve_turned_count() {
        let before = bent(15, 0.0);
        let own = Features::proved(&before, |_| true).expect("a proof");
        for (moved, displaced) in [(15, false), (16, false), (8, true), (23, true), (0, false)] {
            let after = bent(moved, 0.3);
            let new = Features::proved(&after, |_| true).expect("a proof");
            let found = displaced_inflection([&before, &after], [&own, &new]);
            assert_eq!(found.is_some(), displaced, "vertex {moved}");
            let near = found.is_none_or(|it| it.distance(before.vertex(moved)) < 3.0);
            assert!(near, "vertex {moved}");
        }
    }
}
