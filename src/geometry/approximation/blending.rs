//! A blend: the quintic that goes on from the end of one curve to the start of another with their tangents and
//! curvatures.
//!
//! Hermite data leave the two speeds free. Those with the least bending and change of curvature are taken, without
//! regard to size: L ∫ κ² ds + L³ ∫ (dκ/ds)² ds / 10. Each inflection of a planar blend counts as much as all of it:
//! a bulb is a little shorter, and wavy.

use glam::DVec3;

use crate::geometry::conversion::BezierPolygon;
use crate::geometry::end::End;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;

/// The degree of a blend.
const DEGREE: usize = 5;

/// The places at which a blend is measured.
const SAMPLES: usize = 48;

/// The weight of the change of curvature beside the bending.
const CHANGE: f64 = 0.1;

/// The speeds tried, by the gap: so many from the first, each larger by the factor.
const SLOWEST: f64 = 0.3;
const FACTOR: f64 = 1.25;
const SPEEDS: usize = 12;

/// The best pair is refined by ever smaller factors, so often.
const REFINEMENTS: usize = 6;

/// Find the blend from the end of the first curve to the start of the second. `None` where the ends have no directions,
/// or coincide.
pub fn blend(first: &FloatPolygon, second: &FloatPolygon) -> Option<FloatPolygon> {
    let jets = [first.end_jet(End::Finish), second.end_jet(End::Start)];
    let planar = first.is_planar() && second.is_planar();
    let gap = jets[0].point.distance(jets[1].point);
    let ends = [Condition::of(&jets[0])?, Condition::of(&jets[1])?];
    let at = |speeds: [f64; 2]| {
        let curve = quintic(&ends, speeds)?;
        let cost = cost(&curve, planar);
        cost.is_finite().then_some((cost, speeds, curve))
    };
    let speed = |step: usize| gap * SLOWEST * FACTOR.powi(step as i32);
    let pairs = (0..SPEEDS).flat_map(|one| (0..SPEEDS).map(move |other| [one, other]));
    let tried = pairs.filter_map(|pair| at(pair.map(speed)));
    let mut best = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut factor = FACTOR.sqrt();
    for _ in 0..REFINEMENTS {
        let [one, other] = best.1;
        let around = [
            [one * factor, other],
            [one / factor, other],
            [one, other * factor],
            [one, other / factor],
        ];
        for found in around.into_iter().filter_map(at) {
            if found.0 < best.0 {
                best = found;
            }
        }
        factor = factor.sqrt();
    }
    Some(best.2)
}

/// The data at an end: point, unit tangent and curvature vector.
struct Condition {
    point: DVec3,
    tangent: DVec3,
    curvature: DVec3,
}

impl Condition {
    fn of(jet: &Jet) -> Option<Self> {
        Some(Self {
            point: jet.point,
            tangent: jet.tangent()?,
            curvature: jet.curvature_vector(),
        })
    }
}

/// The quintic with both ends' data and these speeds there; it speeds up along its tangents at neither end.
fn quintic(ends: &[Condition; 2], speeds: [f64; 2]) -> Option<FloatPolygon> {
    let legs = [0, 1].map(|index: usize| {
        let (end, speed) = (&ends[index], speeds[index]);
        let side = if index == 0 { 1.0 } else { -1.0 };
        let first = side * speed / 5.0 * end.tangent;
        let second = speed * speed / 20.0 * end.curvature;
        [
            end.point,
            end.point + first,
            end.point + 2.0 * first + second,
        ]
    });
    let [[a, b, c], [f, e, d]] = legs;
    let bezier = BezierPolygon::new(DEGREE, vec![a, b, c, d, e, f], None).ok()?;
    bezier.to_float().ok()
}

/// How much a curve bends and changes its curvature, whatever its size, times one more than its inflections.
fn cost(curve: &FloatPolygon, planar: bool) -> f64 {
    let step = 1.0 / SAMPLES as f64;
    let mut sums = [0.0; 3];
    let (mut side, mut inflections) = (0.0, 0);
    for sample in 0..=SAMPLES {
        let jet = curve.jet(sample as f64 * step);
        let outer = sample == 0 || sample == SAMPLES;
        let length = jet.speed() * step * if outer { 0.5 } else { 1.0 };
        let slope = jet.curvature_slope(planar);
        // At an end without curvature its sign is rounding.
        if planar && !outer {
            let curvature = jet.signed_curvature();
            inflections += i32::from(side * curvature < 0.0);
            side = curvature;
        }
        // A curve in space has no slope where it has no curvature.
        let slope = if planar || slope.is_finite() {
            slope
        } else {
            0.0
        };
        let terms = [1.0, jet.curvature().powi(2), slope * slope];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += term * length;
        }
    }
    let [length, bending, change] = sums;
    let energy = length * bending + CHANGE * length.powi(3) * change;
    f64::from(1 + inflections) * energy
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An arc of a circle of radius 10, as near as a cubic float polygon is to one.
    fn arc(from: f64, to: f64) -> FloatPolygon {
        let at = |index: u32| from + (to - from) * f64::from(index) / 11.0;
        let vertices = (0..12).map(|index| {
            let (sine, cosine) = at(index).sin_cos();
            10.0 * DVec3::new(cosine, sine, 0.0)
        });
        FloatPolygon::new(5, vertices.collect(), None, false).expect("a polygon")
    }

    #[test]
    fn a_blend_of_parts_of_a_circle_is_nearly_the_circle() {
        let (first, second) = (arc(0.0, 1.0), arc(1.6, 2.6));
        let found = blend(&first, &second).expect("a blend");
        let radius = first.end_jet(End::Finish).point.length();
        for step in 0..=20 {
            let off = found.point(f64::from(step) / 20.0).length() / radius - 1.0;
            assert!(off.abs() < 1e-4, "{step}: {off}");
        }
    }

    #[test]
    fn a_blend_has_point_direction_and_curvature_of_both_ends() {
        let first = FloatPolygon::planar(3, &[(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (5.0, 1.0)]);
        let first = first.expect("a polygon");
        let second = arc(-2.0, -1.0);
        let found = blend(&first, &second).expect("a blend");
        for (own, other) in [
            (found.end_jet(End::Start), first.end_jet(End::Finish)),
            (found.end_jet(End::Finish), second.end_jet(End::Start)),
        ] {
            let size = second.size();
            assert!(own.point.distance(other.point) < 1e-13 * size);
            assert!(own.first.angle_between(other.first) < 1e-7);
            let off = own.signed_curvature() - other.signed_curvature();
            assert!(off.abs() * size < 1e-9, "{off}");
        }
    }
}
