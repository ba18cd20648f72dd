//! Raising and lowering the degree.

use std::cmp::Ordering;

use super::kept_ends::with_ends;
use crate::geometry::control_polygon::check_degree;
use crate::geometry::conversion::approximation::Approximation;
use crate::geometry::conversion::exact_polygon::ExactPolygon;
use crate::geometry::conversion::quasi_interpolation::{NewKnots, quasi_interpolated};
use crate::geometry::end::End;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

impl FloatPolygon {
    /// Raise or lower the degree, keeping the segments and their parameters.
    ///
    /// Raising one segment is exact. A curve of more segments has fewer continuous derivatives
    /// at its knots than a uniform curve of higher degree: raising it exactly would double the
    /// knots, so it can only be approximated. So can lowering, unless the curve happens to be of
    /// the lower degree, which then is found again. The approximation is a local one, each vertex
    /// taken from the curve's derivatives in the middle of its knots, and keeps smooth polygons
    /// smooth. Then the vertices move as little as brings the ends of an open curve, and from
    /// degree 2 on its end tangents, back to where they were; where they are too few for that, the
    /// ends stay off by up to the deviation. Rational curves are changed in homogeneous coordinates.
    ///
    /// # Errors
    /// [`PolygonError::DegreeOutOfRange`] if `degree` is not 1 … 25;
    /// [`PolygonError::TooFewVertices`] if a periodic curve has fewer than `degree` + 1 segments;
    /// [`PolygonError::WeightLost`] if the result has a weight that is not positive;
    /// [`PolygonError::Overflow`] if it leaves the range of numbers.
    pub fn with_degree(&self, degree: usize) -> Result<Approximation, PolygonError> {
        check_degree(degree)?;
        if degree == self.degree() {
            return Ok(Approximation::exact(self.clone()));
        }
        if degree > self.degree() && self.segments() == 1 && !self.is_periodic() {
            return Ok(Approximation::exact(self.raised_segment(degree)?));
        }
        // One direction of an open curve stands for both, so that rounding favours neither.
        if !self.is_periodic() && self.runs_backwards() {
            let last = self.segments() + degree - 1;
            let changed = self.reversed().with_degree(degree);
            let mut changed = changed.map_err(|error| error.counted_backwards(last))?;
            changed.polygon = changed.polygon.reversed();
            return Ok(changed);
        }
        let polygon = quasi_interpolated(
            self,
            &NewKnots {
                degree,
                start: 0.0,
                step: 1.0,
                segments: self.segments(),
                periodic: self.is_periodic(),
            },
        )?;
        let polygon = if self.is_periodic() {
            polygon
        } else {
            with_ends(polygon, End::BOTH.map(|end| self.end_jet(end)))
        };
        Ok(Approximation {
            deviation: self.deviation(&polygon)?,
            polygon,
            exact: false,
        })
    }

    /// Whether the numbers of the vertices, read from the last one, come first in their order.
    fn runs_backwards(&self) -> bool {
        let numbers = |index: usize| self.vertex(index).extend(self.weight(index)).to_array();
        let count = self.vertices().len();
        let forward = (0..count).flat_map(numbers);
        let backward = (0..count).rev().flat_map(numbers);
        let order = forward.zip(backward).map(|(a, b)| a.total_cmp(&b));
        order.into_iter().find(|order| order.is_ne()) == Some(Ordering::Greater)
    }

    fn raised_segment(&self, degree: usize) -> Result<Self, PolygonError> {
        let mut raised = ExactPolygon::from_float(self);
        while raised.degree() < degree {
            raised = raised.raised()?;
        }
        raised.to_float()
    }
}
