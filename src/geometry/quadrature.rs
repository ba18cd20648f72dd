//! Gauss–Legendre quadrature of several functions at once, halved until it settles.

use std::array::from_fn;

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

/// Halvings after which an interval is taken as it is: it is then 2⁻⁴⁰ of the whole.
const DEEPEST: usize = 40;

/// Halvings after which all remaining intervals are taken as they are. Cusps take a hundred or
/// two.
const MOST_HALVINGS: usize = 500;

/// Hold integrals, and how they came about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integrals<const COUNT: usize> {
    /// The integrals.
    pub values: [f64; COUNT],
    /// Difference of the last halves from their wholes, all intervals together.
    pub disagreement: [f64; COUNT],
}

/// List the nodes and weights of the quadrature with 16 points between two parameters.
pub(super) fn gauss_legendre(from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    NODES.into_iter().flat_map(move |(node, weight)| {
        let arm = half * node;
        [(middle - arm, half * weight), (middle + arm, half * weight)]
    })
}

/// Integrate some functions between two parameters with 16 points, without a look at the error.
pub(super) fn quadrature<const COUNT: usize>(
    from: f64,
    to: f64,
    functions: &impl Fn(f64) -> [f64; COUNT],
) -> [f64; COUNT] {
    gauss_legendre(from, to).fold([0.0; COUNT], |sums, (parameter, weight)| {
        let values = functions(parameter);
        from_fn(|index| sums[index] + weight * values[index])
    })
}

/// Integrate some functions over \[0, 1\] or a part of it: intervals are halved until the halves
/// agree with the whole, for a first estimate `whole` as far as `allowed` says for all of it, and
/// for parts in proportion.
pub(super) fn settled_quadrature<const COUNT: usize>(
    [from, to]: [f64; 2],
    whole: [f64; COUNT],
    allowed: [f64; COUNT],
    functions: &impl Fn(f64) -> [f64; COUNT],
) -> Integrals<COUNT> {
    let mut halving = Halving {
        functions,
        allowed,
        disagreement: [0.0; COUNT],
        halvings: 0,
    };
    let values = halving.halved(from, to, whole, 0);
    Integrals {
        values,
        disagreement: halving.disagreement,
    }
}

struct Halving<'a, F, const COUNT: usize> {
    functions: &'a F,
    /// Error bound of an integral over the whole interval.
    allowed: [f64; COUNT],
    disagreement: [f64; COUNT],
    halvings: usize,
}

impl<F: Fn(f64) -> [f64; COUNT], const COUNT: usize> Halving<'_, F, COUNT> {
    fn halved(&mut self, from: f64, to: f64, whole: [f64; COUNT], depth: usize) -> [f64; COUNT] {
        let middle = 0.5 * (from + to);
        let left = quadrature(from, middle, self.functions);
        let right = quadrature(middle, to, self.functions);
        let sum: [f64; COUNT] = from_fn(|index| left[index] + right[index]);
        let share = 0.5_f64.powi(depth as i32);
        let differences: [f64; COUNT] = from_fn(|index| (sum[index] - whole[index]).abs());
        let mut pairs = differences.iter().zip(&self.allowed);
        let agrees = pairs.all(|(difference, allowed)| *difference <= allowed * share);
        // Where numbers overflow, halving would go on for ever.
        let endless = differences.iter().any(|difference| !difference.is_finite());
        if agrees || endless || depth == DEEPEST || self.halvings == MOST_HALVINGS {
            for (all, own) in self.disagreement.iter_mut().zip(differences) {
                *all += own;
            }
            return sum;
        }
        self.halvings += 1;
        let left = self.halved(from, middle, left, depth + 1);
        let right = self.halved(middle, to, right, depth + 1);
        from_fn(|index| left[index] + right[index])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_31_are_integrated_exactly() {
        for power in 0..=31 {
            let [integral] = quadrature(-0.5, 1.5, &|x: f64| [x.powi(power)]);
            let exact =
                (1.5_f64.powi(power + 1) - (-0.5_f64).powi(power + 1)) / f64::from(power + 1);
            assert!(
                (integral / exact - 1.0).abs() <= 1e-13,
                "{power}: {integral} {exact}"
            );
        }
    }

    #[test]
    fn what_runs_off_to_infinity_is_not_settled_and_the_rest_is() {
        let functions = |x: f64| [1.0 / x, x.ln(), x];
        let whole = quadrature(0.0, 1.0, &functions);
        let found = settled_quadrature([0.0, 1.0], whole, [1e-9; 3], &functions);
        let settled = found.disagreement.map(|difference| difference <= 1e-9);
        assert_eq!(settled, [false, true, true]);
        assert!((found.values[1] + 1.0).abs() <= 1e-9, "{:?}", found.values);
    }
}
