//! Arc length.

use super::float_polygon::FloatPolygon;
use super::parametric_curve::ParametricCurve;
use super::polygon_figures::Range;
use super::quadrature::{quadrature, settled_quadrature};
use super::vector;

/// Roundings that a quadrature may differ by from that of its halves.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// Measure the arc length of a curve from one parameter to another that is not less, both in \[0, m\],
/// to the relative `tolerance` of each piece.
///
/// Each piece is integrated as [`FloatPolygon::arc_length`] does. 0 if the parameters are not in order.
pub fn arc_length_between(curve: &dyn ParametricCurve, from: f64, to: f64, tolerance: f64) -> f64 {
    let pieces = curve.pieces();
    let first = (from.max(0.0) as usize).min(pieces - 1);
    let parts = (first..pieces).map_while(|piece| {
        let start = (from - piece as f64).max(0.0);
        let end = (to - piece as f64).min(1.0);
        (start < end).then_some((piece, start, end))
    });
    let lengths = parts.map(|(piece, start, end)| {
        let speed = |t: f64| [vector::length(curve.piece_jet(piece, t).first)];
        let whole = quadrature(start, end, &speed);
        let allowed = [tolerance.max(ROUNDINGS) * whole[0]];
        settled_quadrature([start, end], whole, allowed, &speed).values[0]
    });
    lengths.sum()
}

impl FloatPolygon {
    /// Measure the arc length of the whole curve to the relative `tolerance`.
    ///
    /// Each segment is integrated by Gauss–Legendre quadrature with 16 points and halved until
    /// the halves agree with the whole. At cusps, where the speed has a kink, halving goes on
    /// until the interval no longer counts.
    pub fn arc_length(&self, tolerance: f64) -> f64 {
        (0..self.segments())
            .map(|segment| self.segment_arc_length(segment, 0.0, 1.0, tolerance))
            .sum()
    }

    /// Measure the arc length of one segment between two local parameters, to the relative
    /// `tolerance`.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment_arc_length(&self, segment: usize, from: f64, to: f64, tolerance: f64) -> f64 {
        let speed = |t: f64| [self.segment_speed(segment, t)];
        let whole = quadrature(from, to, &speed);
        let rounding = ROUNDINGS * self.greatest_term(segment) * (to - from).abs();
        let allowed = [rounding.max(tolerance * whole[0])];
        settled_quadrature([from, to], whole, allowed, &speed).values[0]
    }

    /// Bound the speed of a polynomial curve on a segment, and with it what rounding does to it,
    /// by the longest leg of the segment's polygon. The speed of a rational curve is a
    /// difference in which the coordinates themselves cancel as far as the weights differ.
    fn greatest_term(&self, segment: usize) -> f64 {
        let vertices = segment..segment + self.degree();
        let legs =
            vertices.map(|index| vector::length(self.vertex(index + 1) - self.vertex(index)));
        let greatest_leg = legs.fold(0.0, f64::max);
        if !self.is_rational() {
            return greatest_leg;
        }
        let window = segment..=segment + self.degree();
        let weights = window.clone().map(|index| self.weight(index));
        let ratio = Range::of(weights).map_or(1.0, |range| range.high / range.low);
        let farthest = window.map(|index| vector::length(self.vertex(index)));
        let cancelled = (ratio - 1.0) * farthest.fold(0.0, f64::max);
        (greatest_leg * ratio + cancelled) * self.degree() as f64
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use glam::DVec3;

    use super::*;

    #[test]
    fn a_rational_curve_far_from_the_origin_is_not_halved_for_its_rounding() {
        let measured = |far: f64| {
            let vertices =
                (0..8).map(|i| DVec3::new(far + 10.0 * f64::from(i), f64::from(i * i), 0.0));
            let weights = (0..8).map(|i| 1.0 + 0.3 * f64::from(i % 3)).collect();
            let polygon = FloatPolygon::new(3, vertices.collect(), Some(weights), false).unwrap();
            let evaluations = Cell::new(0);
            let speed = |t: f64| {
                evaluations.set(evaluations.get() + 1);
                [polygon.segment_speed(0, t)]
            };
            let whole = quadrature(0.0, 1.0, &speed);
            let allowed = [ROUNDINGS * polygon.greatest_term(0)];
            let length = settled_quadrature([0.0, 1.0], whole, allowed, &speed).values[0];
            // An interval is halved with twice 16 evaluations.
            (length, evaluations.get() / 32)
        };
        let (near, _) = measured(0.0);
        for far in [1e3, 1e6, 1e9] {
            let (length, halvings) = measured(far);
            assert!(
                (length - near).abs() < 1e-14 * far * near,
                "{far}: {length} is not {near}"
            );
            assert!(halvings < 10, "{far}: {halvings} halvings");
        }
    }
}
