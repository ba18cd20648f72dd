//! Fairness in numbers: bending energy and variation of the curvature.

use super::graph_moments::GraphMoments;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::parametric_curve::ParametricCurve;
use crate::geometry::quadrature::{quadrature, settled_quadrature};

/// Relative precision of the fairness figures.
const TOLERANCE: f64 = 1e-9;

/// Roundings of the terms that a curvature is made of that a quadrature may differ by from that of
/// its halves.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// Most corrections of an estimate that is too large.
const MOST_ESTIMATES: usize = 4;

/// Share of one segment in the fairness of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentFairness {
    /// The arc length.
    length: f64,
    /// ∫κ² ds, `None` where it does not settle.
    bending: Option<f64>,
    /// ∫(dκ/ds)² ds, likewise.
    variation: Option<f64>,
    /// The logarithmic curvature graph.
    pub(super) graph: GraphMoments,
}

/// Hold the fairness of a curve in numbers that do not depend on its size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fairness {
    /// The arc length.
    pub length: f64,
    /// The bending energy ∫κ² ds times the length: (2π)² of a circle. `None` where it is infinite,
    /// as at a cusp or the corners of a polyline, or is lost in rounding.
    pub bending_energy: Option<f64>,
    /// The variation ∫(dκ/ds)² ds times the cube of the length. `None` as for the bending energy,
    /// and below degree 3, where the curvature jumps.
    pub variation: Option<f64>,
}

/// The integrands over a segment, with their rounding errors.
const LENGTH: usize = 0;
const BENDING: usize = 1;
const VARIATION: usize = 2;
const BENDING_TERMS: usize = 3;
const VARIATION_TERMS: usize = 4;

impl SegmentFairness {
    /// Measure all segments of a float polygon's curve.
    pub fn all(polygon: &FloatPolygon) -> Vec<Self> {
        let planar = polygon.is_planar();
        let segments = 0..polygon.segments();
        segments
            .map(|segment| Self::new(polygon, segment, planar))
            .collect()
    }

    /// Measure one piece of a curve by adaptive Gauss–Legendre quadrature to a relative tolerance of
    /// 1e-9; `planar` is [`ParametricCurve::is_planar`], which takes time of its own.
    ///
    /// # Panics
    /// If the curve has no piece with this number.
    pub fn new(curve: &dyn ParametricCurve, piece: usize, planar: bool) -> Self {
        let functions = |t: f64| integrands(curve, piece, t, planar);
        let whole = quadrature(0.0, 1.0, &functions);
        let mut estimate = whole;
        let allowed = |estimate: &[f64; 5]| {
            let mut allowed = estimate.map(|value| TOLERANCE * value);
            allowed[BENDING] = allowed[BENDING].max(ROUNDINGS * estimate[BENDING_TERMS]);
            allowed[VARIATION] = allowed[VARIATION].max(ROUNDINGS * estimate[VARIATION_TERMS]);
            // These only need a size.
            allowed[BENDING_TERMS] = f64::INFINITY;
            allowed[VARIATION_TERMS] = f64::INFINITY;
            allowed
        };
        let mut found = settled_quadrature([0.0, 1.0], whole, allowed(&estimate), &functions);
        for _ in 1..MOST_ESTIMATES {
            let mut sizes = found.values.iter().zip(&estimate);
            if sizes.all(|(found, estimate)| 2.0 * found >= *estimate) {
                break;
            }
            estimate = found.values;
            found = settled_quadrature([0.0, 1.0], whole, allowed(&estimate), &functions);
        }
        let allowed = allowed(&found.values);
        let settled = |index: usize| {
            let is_settled = found.disagreement[index] <= 2.0 * allowed[index];
            Some(found.values[index]).filter(|_| is_settled)
        };
        Self {
            length: found.values[LENGTH],
            bending: settled(BENDING),
            variation: settled(VARIATION),
            graph: GraphMoments::of(curve, piece, [0.0, 1.0], planar),
        }
    }
}

/// The speed, and with it κ², (dκ/ds)² and the squares of the terms that they are made of.
fn integrands(curve: &dyn ParametricCurve, piece: usize, t: f64, planar: bool) -> [f64; 5] {
    let jet = curve.piece_jet(piece, t);
    let speed = jet.speed();
    let curvature = jet.curvature_of(planar);
    let slope = jet.curvature_slope(planar);
    // In space a straight line has no osculating plane.
    let slope = if curvature == 0.0 && slope.is_nan() {
        0.0
    } else {
        slope
    };
    // Derivatives are differences of legs, and rounded like these.
    let bend = (jet.second.length() + speed) / speed;
    let change = (jet.third.length() + speed) / speed;
    let curvature_terms = bend / speed;
    let slope_terms = (change + 3.0 * bend * bend) / (speed * speed);
    [
        speed,
        speed * curvature * curvature,
        speed * slope * slope,
        speed * curvature_terms * curvature_terms,
        speed * slope_terms * slope_terms,
    ]
}

impl Fairness {
    /// Put the fairness of all pieces of a curve together; `continuity` tells how many derivatives
    /// are continuous where they meet.
    pub fn of(segments: &[SegmentFairness], continuity: usize) -> Self {
        let length: f64 = segments.iter().map(|segment| segment.length).sum();
        let sum = |part: fn(&SegmentFairness) -> Option<f64>, power: i32, least: usize| {
            let sum: Option<f64> = segments.iter().map(part).sum();
            let figure = sum.map(|sum| sum * length.powi(power));
            figure
                .filter(|figure| figure.is_finite() && (continuity >= least || segments.len() < 2))
        };
        Self {
            length,
            bending_energy: sum(|segment| segment.bending, 1, 1),
            variation: sum(|segment| segment.variation, 3, 2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::harmony::tests::LogAesthetic;

    #[test]
    fn bending_energy_and_variation_of_a_log_aesthetic_curve_are_those_of_their_formulas() {
        for (alpha, lambda) in [(-1.0, 0.5), (1.0, 0.5), (2.0, 3.0), (-0.5, 0.9)] {
            let curve = LogAesthetic { alpha, lambda };
            let segment = SegmentFairness::new(&curve, 0, true);
            let found = Fairness::of(&[segment], 9);
            // ∫(1 + Λαs)^p ds from 0 to 1.
            let power = |p: f64| {
                let base = 1.0 + lambda * alpha;
                if p == -1.0 {
                    base.ln() / (lambda * alpha)
                } else {
                    (base.powf(p + 1.0) - 1.0) / (lambda * alpha * (p + 1.0))
                }
            };
            let bending = power(-2.0 / alpha);
            let variation = lambda * lambda * power(-2.0 / alpha - 2.0);
            assert!((found.length - 1.0).abs() <= 1e-12);
            for (found, exact) in [
                (found.bending_energy, bending),
                (found.variation, variation),
            ] {
                let found = found.expect("it settles");
                assert!(
                    (found / exact - 1.0).abs() <= 1e-11,
                    "{alpha}: {found} {exact}"
                );
            }
        }
    }
}
