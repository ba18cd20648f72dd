//! The distance of a curve from another curve or from a reference.

use glam::DVec3;

use crate::analysis::item::Item;
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::{Differentiable, FloatPolygon, Progress};

/// The distance of a curve from another one, or of points from a curve: true distances, to the nearest point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// The largest distance.
    pub largest: f64,
    /// The mean: over the arc length of the curve, or over the points.
    pub mean: f64,
    /// The parameter of the curve where the largest is.
    pub u: f64,
    /// The parameter of the other curve there, or the number of the point.
    pub t: f64,
    /// The two places between which the largest is, the first one on the curve.
    pub places: [DVec3; 2],
}

impl Distance {
    /// Measure the distance of a curve from another curve or a reference, or of a list of points from the
    /// curve. `None` for an empty list, and after a cancellation.
    pub fn measure(polygon: &FloatPolygon, other: &Item, progress: &Progress) -> Option<Self> {
        match other {
            Item::Curve(other) => {
                let end = other.polygon.segments() as f64;
                Self::between(polygon, &other.polygon, [0.0, end], progress)
            }
            Item::Reference(other) => match other.points() {
                Some(points) => Self::of_points(polygon, &points, progress),
                None => Self::between(polygon, &other.curve, other.curve.interval(), progress),
            },
        }
    }

    fn between(
        polygon: &FloatPolygon,
        other: &dyn Differentiable,
        reach: [f64; 2],
        progress: &Progress,
    ) -> Option<Self> {
        let [from, to] = reach;
        let segments = polygon.segments() as f64;
        let beside = |u: f64| from + (to - from) * u / segments;
        let found = MeasuredDeviation::measure(polygon, other, &beside, reach, progress).ok()?;
        Some(Self {
            largest: found.largest,
            mean: found.mean,
            u: found.u,
            t: found.t,
            places: [polygon.point(found.u), other.derivatives(found.t, 0)[0]],
        })
    }

    fn of_points(polygon: &FloatPolygon, points: &[DVec3], progress: &Progress) -> Option<Self> {
        let nearest = points
            .iter()
            .map(|point| (!progress.is_cancelled()).then(|| polygon.nearest(*point)));
        let nearest: Vec<_> = nearest.collect::<Option<_>>()?;
        let sum: f64 = nearest.iter().map(|nearest| nearest.distance).sum();
        let places = nearest.iter().zip(points).enumerate();
        let (index, (found, point)) =
            places.max_by(|(_, (a, _)), (_, (b, _))| a.distance.total_cmp(&b.distance))?;
        Some(Self {
            largest: found.distance,
            mean: sum / points.len() as f64,
            u: found.u,
            t: index as f64,
            places: [found.point, *point],
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::document::Curve;

    #[test]
    fn a_cancelled_measurement_has_no_distance() {
        let line =
            |y: f64| FloatPolygon::planar(2, &[(0.0, y), (1.0, y), (2.0, y)]).expect("a polygon");
        let other = Item::Curve(Arc::new(Curve::new("line".to_owned(), line(1.0))));
        let progress = Progress::default();
        let measured = Distance::measure(&line(0.0), &other, &progress);
        assert!(measured.is_some_and(|distance| distance.largest == 1.0));
        progress.cancel();
        assert_eq!(Distance::measure(&line(0.0), &other, &progress), None);
    }
}
