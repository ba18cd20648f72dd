//! Vertices on a curve, and vertices by quasi-interpolation.

use glam::DVec3;

use super::error::ApproximationError;
use super::knots::UniformKnots;
use crate::geometry::conversion::quasi_interpolation::greville_factors;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::float_polygon::FloatPolygon;

/// Placing of the vertices of an approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placing {
    /// On the curve (paper, section 5): this keeps the shape but not the place, as turns of the polygon
    /// shrink by about sinc(h/2)^{n+1}, h the turning of a leg.
    OnCurve,
    /// By quasi-interpolation: each vertex is the blossom of the curve's own Taylor polynomial of degree
    /// n at the knots of the vertex,
    ///
    ///   P = Σ a_k h^{2k} C^{(2k)},   Σ a_k x^{2k} = (x/2 / sinh(x/2))^{n+1},   2k ≤ n,
    ///
    /// at the middle of its knots, h their distance. Keeps place and shape: the error is of order
    /// h^{n+1}.
    Quasi,
}

/// Corrections of quasi-interpolation at the vertex where they grow most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections {
    /// The vertex, counted from 0.
    pub vertex: usize,
    /// The last correction |a_k h^{2k} C^{(2k)}| over the first one, |a_1 h² C″|. Above 1 they grow: the step
    /// is too long for the degree, and the vertices lie anywhere.
    pub growth: f64,
}

/// Place the vertices of a float polygon near a curve.
///
/// Quasi-interpolation expands the curve at each vertex's own parameter; where the curve is not defined
/// there, beyond its ends, at the end of the approximated part instead, which is of the same order but
/// less accurate.
///
/// # Errors
/// [`ApproximationError::NotFinite`] where the curve has no point or derivatives;
/// [`ApproximationError::Polygon`] if coordinates leave the range of numbers.
pub fn float_polygon(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    placing: Placing,
) -> Result<FloatPolygon, ApproximationError> {
    Ok(placed(curve, knots, placing)?.0)
}

/// Place vertices as [`float_polygon`] does, and watch the corrections.
pub(super) fn placed(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    placing: Placing,
) -> Result<(FloatPolygon, Option<Corrections>), ApproximationError> {
    let mut corrections: Option<Corrections> = None;
    let vertices: Result<Vec<DVec3>, ApproximationError> = match placing {
        Placing::OnCurve => (0..knots.count())
            .map(|index| {
                let parameter = knots.vertex_parameter(index);
                let values = curve.derivatives(parameter, 0);
                finite(index, parameter, values).map(|values| values[0])
            })
            .collect(),
        Placing::Quasi => {
            let degree = knots.degree();
            let factors = greville_factors(degree, degree / 2, knots.step());
            let factors: Vec<f64> = factors.into_iter().map(|factor| factor.value()).collect();
            (0..knots.count())
                .map(|vertex| {
                    let terms = blossom_terms(curve, knots, &factors, vertex)?;
                    if let Some(growth) = growth(&terms)
                        && corrections.is_none_or(|known| growth > known.growth)
                    {
                        corrections = Some(Corrections { vertex, growth });
                    }
                    Ok(terms.into_iter().sum())
                })
                .collect()
        }
    };
    let polygon = FloatPolygon::new(knots.degree(), vertices?, None, knots.is_periodic())?;
    Ok((polygon, corrections))
}

/// The last correction over the first one, if there are two or more.
fn growth(terms: &[DVec3]) -> Option<f64> {
    let [_, first, .., last] = terms else {
        return None;
    };
    Some(last.length() / first.length()).filter(|growth| growth.is_finite())
}

/// The terms of the blossom of the curve's Taylor polynomial at the knots of a vertex.
fn blossom_terms(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    factors: &[f64],
    index: usize,
) -> Result<Vec<DVec3>, ApproximationError> {
    let parameter = knots.vertex_parameter(index);
    // Of the derivatives at the middle of the knots only the even ones count.
    let last = 2 * (factors.len() - 1);
    let there = finite(index, parameter, curve.derivatives(parameter, last));
    let values = match there {
        Ok(values) => values,
        Err(_) => {
            let [from, to] = knots.interval();
            let end = parameter.clamp(from, to);
            let values = finite(index, end, curve.derivatives(end, knots.degree()))?;
            continued(&values, parameter - end)
        }
    };
    let even = values.iter().step_by(2).zip(factors);
    Ok(even.map(|(value, factor)| *value * *factor).collect())
}

/// The derivatives of a Taylor polynomial at a distance from where it was expanded.
fn continued(values: &[DVec3], distance: f64) -> Vec<DVec3> {
    let derivative = |order: usize| {
        let above = values[order..].iter().enumerate().skip(1).rev();
        // Horner's rule with the factorials in the steps.
        let sum = above.fold(DVec3::ZERO, |sum, (k, value)| {
            (sum + *value) * (distance / k as f64)
        });
        values[order] + sum
    };
    (0..values.len()).map(derivative).collect()
}

fn finite(
    vertex: usize,
    parameter: f64,
    values: Vec<DVec3>,
) -> Result<Vec<DVec3>, ApproximationError> {
    if values.iter().all(|value| value.is_finite()) {
        Ok(values)
    } else {
        Err(ApproximationError::NotFinite { vertex, parameter })
    }
}
