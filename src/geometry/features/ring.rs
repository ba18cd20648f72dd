//! Rings over which polynomials are multiplied out.

/// The arithmetic that the numerators are multiplied out in.
pub(super) trait Ring {
    /// Its polynomials.
    type Polynomial: Clone;

    /// Add up products of polynomials, each with a small whole factor. All products that are not 0
    /// must have the same degree.
    fn sum_of_products(
        &mut self,
        terms: &[(i32, &Self::Polynomial, &Self::Polynomial)],
    ) -> Self::Polynomial;
}
