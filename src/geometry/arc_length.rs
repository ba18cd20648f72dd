//! Arc length.

use super::float_polygon::FloatPolygon;

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
        let whole = self.quadrature(segment, from, to);
        self.halved(segment, (from, to), whole, tolerance * whole, DEEPEST)
    }

    fn halved(
        &self,
        segment: usize,
        (from, to): (f64, f64),
        whole: f64,
        allowed: f64,
        depth: usize,
    ) -> f64 {
        let middle = 0.5 * (from + to);
        let left = self.quadrature(segment, from, middle);
        let right = self.quadrature(segment, middle, to);
        let rounding = 4.0 * f64::EPSILON * whole;
        let error = (left + right - whole).abs();
        // A speed beyond the range of numbers gives an error that is no number: halving on
        // would never end.
        if error <= allowed.max(rounding) || error.is_nan() || depth == 0 {
            return left + right;
        }
        self.halved(segment, (from, middle), left, 0.5 * allowed, depth - 1)
            + self.halved(segment, (middle, to), right, 0.5 * allowed, depth - 1)
    }

    fn quadrature(&self, segment: usize, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let speed = |t: f64| self.segment_derivatives(segment, t, 1)[1].length();
        let sum = NODES.iter().map(|(node, weight)| {
            weight * (speed(middle - half * node) + speed(middle + half * node))
        });
        half * sum.sum::<f64>()
    }
}
