//! Where polylines cross themselves.

use glam::DVec2;

use super::float_polygon::FloatPolygon;

/// The legs of a polyline along a segment of a curve: loops are seen that span a few of them.
const SAMPLES: usize = 32;

/// Legs that come nearer to each other than this share of the polyline's size touch.
const TOUCHING: f64 = 1e-12;

/// Find a point near where a curve crosses itself in the plane z = 0, by a polyline of 32 legs a segment; `None` if that
/// does not cross itself.
pub fn curve_crossing(polygon: &FloatPolygon) -> Option<DVec2> {
    crossing(&points_of(polygon).collect::<Vec<DVec2>>())
}

/// Whether planar curves that go on from one to the next cross themselves or each other.
pub fn cross(curves: &[&FloatPolygon]) -> bool {
    let points = curves.iter().flat_map(|polygon| points_of(polygon));
    crossing(&points.collect::<Vec<DVec2>>()).is_some()
}

/// Find a point where a curve of the plane crosses itself, if none of those that it was made of does. `None` for a curve in
/// space.
pub fn new_crossing(before: &[&FloatPolygon], after: &FloatPolygon) -> Option<DVec2> {
    let crosses = |polygon: &FloatPolygon| match polygon.is_planar() {
        true => curve_crossing(polygon),
        false => None,
    };
    let at = crosses(after)?;
    let is_new = before.iter().all(|polygon| crosses(polygon).is_none());
    is_new.then_some(at)
}

/// Find a point where a polyline crosses itself: the first one found from the side of the least x. Legs that only
/// touch, but for rounding, do not cross. `None` if it does not cross itself.
pub(super) fn crossing(points: &[DVec2]) -> Option<DVec2> {
    let touching = TOUCHING
        * points
            .iter()
            .fold(0.0, |size: f64, it| size.max(it.abs().max_element()));
    let legs = points.windows(2);
    let mut legs: Vec<[DVec2; 2]> = legs.map(|leg| [leg[0], leg[1]]).collect();
    legs.sort_by(|a, b| low(a).total_cmp(&low(b)));
    let mut near: Vec<[DVec2; 2]> = Vec::new();
    for leg in legs {
        near.retain(|other| other[0].x.max(other[1].x) >= low(&leg));
        if let Some(crossing) = near
            .iter()
            .find_map(|other| crossing_of(&leg, other, touching))
        {
            return Some(crossing);
        }
        near.push(leg);
    }
    None
}

fn points_of(polygon: &FloatPolygon) -> impl Iterator<Item = DVec2> {
    let samples = polygon.segments() * SAMPLES;
    let places = (0..=samples).map(|sample| sample as f64 / SAMPLES as f64);
    places.map(|u| polygon.point(u).truncate())
}

fn low(leg: &[DVec2; 2]) -> f64 {
    leg[0].x.min(leg[1].x)
}

/// Where two legs cross, each with its ends on both sides of the other and farther from it than `touching`.
fn crossing_of([a, b]: &[DVec2; 2], [c, d]: &[DVec2; 2], touching: f64) -> Option<DVec2> {
    let (leg, other) = (*b - *a, *d - *c);
    let [from_c, from_d] = [leg.perp_dot(*c - *a), leg.perp_dot(*d - *a)];
    let [from_a, from_b] = [other.perp_dot(*a - *c), other.perp_dot(*b - *c)];
    let are_apart = |from: f64, other: f64, leg: DVec2| {
        let least = touching * leg.length();
        from * other < 0.0 && from.abs() > least && other.abs() > least
    };
    let crosses = are_apart(from_c, from_d, leg) && are_apart(from_a, from_b, other);
    crosses.then(|| a.lerp(*b, from_a / (from_a - from_b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|it| DVec2::from(*it)).collect()
    }

    #[test]
    fn legs_cross_where_they_pass_each_other_and_not_where_they_touch() {
        let bow = points(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        assert_eq!(crossing(&bow), Some(DVec2::ONE));
        let ring = points(&[(0.0, 0.0), (2.0, 0.0), (1.0, 2.0), (0.0, 0.0)]);
        assert_eq!(crossing(&ring), None);
        let rounded = points(&[
            (1.0, 1e-17),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (1.0, 2e-17),
        ]);
        assert_eq!(crossing(&rounded), None);
        let back = points(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)]);
        assert_eq!(crossing(&back), None);
        let spiral =
            (0..4000).map(|it| 0.001 * f64::from(it) * DVec2::from_angle(0.1 * f64::from(it)));
        assert_eq!(crossing(&spiral.collect::<Vec<DVec2>>()), None);
    }
}
