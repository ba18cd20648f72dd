//! Arc length.

use super::float_polygon::FloatPolygon;
use super::polygon_figures::Range;
use super::vector;

/// Nodes and weights of Gauss–Legendre quadrature with 16 points on \[−1, 1\]: the positive
/// half; the other half mirrors it.
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
];

/// Halvings after which an interval is taken as it is: it is then 2⁻⁴⁰ of a segment.
const DEEPEST: usize = 40;

/// Halvings of one segment after which all remaining intervals are taken as they are. Cusps take
/// a hundred or two.
const MOST_HALVINGS: usize = 500;

/// Roundings that a quadrature may differ by from that of its halves.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// One segment being measured.
struct Measurement<'a> {
    polygon: &'a FloatPolygon,
    segment: usize,
    /// How much a length may err for an interval of the whole segment.
    allowed: f64,
    halvings: usize,
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
        let mut measurement = Measurement {
            polygon: self,
            segment,
            allowed: 0.0,
            halvings: 0,
        };
        let whole = measurement.quadrature(from, to);
        let rounding = ROUNDINGS * self.greatest_term(segment) * (to - from).abs();
        measurement.allowed = rounding.max(tolerance * whole);
        measurement.halved(from, to, whole, 0)
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

impl Measurement<'_> {
    fn halved(&mut self, from: f64, to: f64, whole: f64, depth: usize) -> f64 {
        let middle = 0.5 * (from + to);
        let left = self.quadrature(from, middle);
        let right = self.quadrature(middle, to);
        let difference = (left + right - whole).abs();
        let allowed = self.allowed * 0.5_f64.powi(depth as i32);
        // Where numbers overflow, halving would go on for ever.
        let hopeless =
            !difference.is_finite() || depth == DEEPEST || self.halvings == MOST_HALVINGS;
        if difference <= allowed || hopeless {
            return left + right;
        }
        self.halvings += 1;
        self.halved(from, middle, left, depth + 1) + self.halved(middle, to, right, depth + 1)
    }

    fn quadrature(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let speed = |t: f64| self.polygon.segment_speed(self.segment, t);
        let sum = NODES.iter().map(|(node, weight)| {
            weight * (speed(middle - half * node) + speed(middle + half * node))
        });
        half * sum.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_rational_curve_far_from_the_origin_is_not_halved_for_its_rounding() {
        let measured = |far: f64| {
            let vertices =
                (0..8).map(|i| DVec3::new(far + 10.0 * f64::from(i), f64::from(i * i), 0.0));
            let weights = (0..8).map(|i| 1.0 + 0.3 * f64::from(i % 3)).collect();
            let polygon = FloatPolygon::new(3, vertices.collect(), Some(weights), false).unwrap();
            let mut measurement = Measurement {
                polygon: &polygon,
                segment: 0,
                allowed: ROUNDINGS * polygon.greatest_term(0),
                halvings: 0,
            };
            let whole = measurement.quadrature(0.0, 1.0);
            let length = measurement.halved(0.0, 1.0, whole, 0);
            (length, measurement.halvings)
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
