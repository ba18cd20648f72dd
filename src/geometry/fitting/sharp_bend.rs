//! Bends of a curve that its points do not show.

use glam::DVec2;

use crate::geometry::conversion::BezierPolygon;
use crate::geometry::features::{Feature, Features};
use crate::geometry::float_polygon::FloatPolygon;

/// The points on each side of a bend whose circles tell its curvature. With more, a nose would excuse a spike beside it.
const BESIDE: usize = 3;

/// At an end they all lie on one side.
const AT_END: usize = 5;

/// A bend that is so many times as sharp as the circles is not theirs: a smooth nose between two points reaches twice.
const SHARPER: f64 = 4.0;

/// The curvature times the size of the curve that a bend must have to be seen: that of half a circle as large.
const SEEN: f64 = 2.0;

/// A bend that is so many times as sharp is a cusp. Of 100 real sections with one to three extrema the sharpest bend is
/// 38 times as sharp as its points show, and told; cusps are thousands of times as sharp.
const CUSP: f64 = 200.0;

/// A bend that is much sharper than the circles through three points beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharpBend {
    /// Its place.
    pub at: DVec2,
    /// Its curvature, without the sign.
    pub curvature: f64,
    /// The largest curvature of the circles.
    pub shown: f64,
}

/// Find the bend of a curve that is sharpest beside its points, if nobody would draw it through them.
///
/// `points` are in their order along the curve, with the parameters where it is nearest to them. `known` are the ends
/// whose curvature is asked for.
pub(super) fn sharp_bend(
    polygon: &FloatPolygon,
    features: &Features,
    points: &[(DVec2, f64)],
    known: [bool; 2],
) -> Option<SharpBend> {
    let ends = [0.0, polygon.segments() as f64];
    let ends = ends.into_iter().zip(known);
    let ends = ends.filter(|(_, known)| !known && !polygon.is_periodic());
    let extrema = features.places(Feature::CurvatureExtremum).into_iter();
    let places = extrema.map(|([low, high], _)| 0.5 * (low + high));
    let bends = places.chain(ends.map(|(u, _)| u)).map(|u| {
        let jet = polygon.jet(u);
        SharpBend {
            at: jet.point.truncate(),
            curvature: jet.curvature(),
            shown: shown(u, points),
        }
    });
    let size = BezierPolygon::from_float(polygon).size();
    let is_sharp = |it: &SharpBend| it.curvature > SHARPER * it.shown && it.curvature * size > SEEN;
    let ratio = |it: &SharpBend| it.curvature / it.shown;
    bends
        .filter(is_sharp)
        .max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// Whether a curve has a bend that no eye tells from a cusp, where its points show none; arguments as for
/// [`sharp_bend`].
pub(super) fn has_cusp(
    polygon: &FloatPolygon,
    features: &Features,
    points: &[(DVec2, f64)],
    known: [bool; 2],
) -> bool {
    let bend = sharp_bend(polygon, features, points, known);
    let least = 1.0 / BezierPolygon::from_float(polygon).size();
    bend.is_some_and(|bend| bend.curvature > CUSP * bend.shown.max(least))
}

/// The largest curvature of the circles through three points that follow each other, beside a parameter.
fn shown(u: f64, points: &[(DVec2, f64)]) -> f64 {
    let next = points.partition_point(|(_, place)| *place < u);
    let mut from = next.saturating_sub(BESIDE);
    let mut to = (next + BESIDE).min(points.len());
    if from == 0 {
        to = to.max(AT_END).min(points.len());
    }
    if to == points.len() {
        from = from.min(points.len().saturating_sub(AT_END));
    }
    let beside = points.get(from..to).unwrap_or_default();
    let mut beside: Vec<DVec2> = beside.iter().map(|(point, _)| *point).collect();
    beside.dedup();
    let circles = beside.windows(3).map(|three| match three {
        [a, b, c] => {
            let sides = a.distance(*b) * b.distance(*c) * c.distance(*a);
            2.0 * (*b - *a).perp_dot(*c - *a).abs() / sides.max(f64::MIN_POSITIVE)
        }
        _ => 0.0,
    });
    circles.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic whose legs run out along a line and back beside it, with points on both sides of the turn.
    fn turn(width: f64) -> (FloatPolygon, Vec<(DVec2, f64)>) {
        let out = [0.0, 1.0, 2.0, 3.0, 4.0].map(|x| (x, 0.0));
        let back = [4.0, 3.0, 2.0, 1.0, 0.0].map(|x| (x, width));
        let vertices = [out, back].concat();
        let polygon = FloatPolygon::planar(3, &vertices).expect("a polygon");
        let segments = polygon.segments();
        // None lies in the turn.
        let places = (0..=2 * segments).map(|step| 0.5 * step as f64);
        let middle = 0.5 * segments as f64;
        let places = places.filter(|u| (u - middle).abs() > 1.0);
        let points = places.map(|u| (polygon.point(u).truncate(), u));
        let points = points.collect();
        (polygon, points)
    }

    #[test]
    fn a_turn_between_two_points_is_a_cusp_only_if_no_eye_sees_its_radius() {
        for (width, is_cusp) in [(1.0, false), (0.2, false), (1e-3, true), (1e-6, true)] {
            let (polygon, points) = turn(width);
            let features = Features::new(&polygon);
            let found = has_cusp(&polygon, &features, &points, [false; 2]);
            assert_eq!(found, is_cusp, "{width}");
        }
    }
}
