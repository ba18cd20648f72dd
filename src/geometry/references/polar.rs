//! Curves by a radius that depends on the angle.

use crate::geometry::power_series::PowerSeries;

/// Expand r cos t and r sin t.
pub(super) fn polar(radius: &PowerSeries, angle: &PowerSeries) -> [PowerSeries; 2] {
    let (sine, cosine) = angle.sin_cos();
    [radius * &cosine, radius * &sine]
}
