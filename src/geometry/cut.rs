//! Cutting a polynomial in Bernstein form in two.

/// Cut a polynomial, given by its Bernstein coefficients, by de Casteljau's algorithm: `before`
/// becomes the part before the cut, and `coefficients` the part behind it. `mean` computes
/// (1 − t) a + t b, t being where to cut.
#[inline(always)]
pub(super) fn cut<T: Clone>(coefficients: &mut [T], before: &mut [T], mean: impl Fn(&T, &T) -> T) {
    for (size, first) in (1..=coefficients.len()).rev().zip(before) {
        first.clone_from(&coefficients[0]);
        for index in 1..size {
            coefficients[index - 1] = mean(&coefficients[index - 1], &coefficients[index]);
        }
    }
}
