//! Curves of any degree as chains of cubic Béziers, for formats that hold no others.

use std::ops::Range;

use glam::{DVec2, DVec3};
use kurbo::{
    BezPath, CurveFitSample, ParamCurve, ParamCurveFit, ParamCurveNearest, PathSeg, Point, Vec2,
    fit_to_bezpath_opt,
};

use super::drawing::Nurbs;
use crate::geometry::{BezierPolygon, FloatPolygon};

/// How far a chain may be from its curve, by the size of the curve.
const WITHIN: f64 = 1e-4;

/// The samples of a Bézier, and of a segment of the curve, by which the chain is measured.
const SAMPLES: usize = 32;

/// The accuracy of nearest points, by the tolerance.
const ACCURACY: f64 = 1e-3;

/// A chain of cubic Béziers along a planar curve.
pub(super) struct Cubics {
    /// The chain, with inner knots of multiplicity 3.
    pub(super) chain: Nurbs,
    /// The number of Béziers.
    pub(super) count: usize,
    /// The largest distance between chain and curve, measured at samples of both.
    pub(super) off: f64,
}

impl Cubics {
    /// Find the fewest Béziers within a length, or 1e-4 of its size, of a planar curve, whose joints lie on the curve,
    /// with its tangents there.
    pub(super) fn along(polygon: &FloatPolygon, within: Option<f64>) -> Self {
        let size = BezierPolygon::from_float(polygon).size();
        let tolerance = within.unwrap_or(WITHIN * size);
        let path = fit_to_bezpath_opt(&Source(polygon), tolerance);
        let mut points = path.segments().fold(Vec::new(), |mut points, segment| {
            let cubic = segment.to_cubic();
            if points.is_empty() {
                points.push(cubic.p0);
            }
            points.extend([cubic.p1, cubic.p2, cubic.p3]);
            points
        });
        if let (true, Some(first)) = (polygon.is_periodic(), points.first().copied())
            && let Some(last) = points.last_mut()
        {
            *last = first;
        }
        let count = points.len() / 3;
        let inner = (0..=count).flat_map(|knot| [knot as f64; 3]);
        let knots = [0.0].into_iter().chain(inner).chain([count as f64]);
        Self {
            off: farthest(polygon, &path, ACCURACY * tolerance),
            chain: Nurbs {
                degree: 3,
                knots: knots.collect(),
                points: points
                    .iter()
                    .map(|it| DVec3::new(it.x, it.y, 0.0))
                    .collect(),
                weights: None,
                periodic: false,
            },
            count,
        }
    }
}

/// A curve over 0 to 1.
struct Source<'a>(&'a FloatPolygon);

impl Source<'_> {
    /// The point and the derivative.
    fn at(&self, t: f64) -> [DVec2; 2] {
        let segments = self.0.segments() as f64;
        // The end of a periodic curve is not its start on the way there.
        let jet = self.0.jet((t * segments).min(segments.next_down()));
        [jet.point, segments * jet.first].map(|it| it.truncate())
    }
}

fn vector(vector: DVec2) -> Vec2 {
    Vec2::new(vector.x, vector.y)
}

impl ParamCurveFit for Source<'_> {
    fn sample_pt_tangent(&self, t: f64, _: f64) -> CurveFitSample {
        let (p, tangent) = self.sample_pt_deriv(t);
        CurveFitSample { p, tangent }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        let [point, derivative] = self.at(t);
        (vector(point).to_point(), vector(derivative))
    }

    fn break_cusp(&self, _: Range<f64>) -> Option<f64> {
        None
    }
}

/// How far samples of a curve and of a chain are from the other one.
fn farthest(polygon: &FloatPolygon, path: &BezPath, accuracy: f64) -> f64 {
    let segments: Vec<PathSeg> = path.segments().collect();
    let share = |sample: usize| sample as f64 / SAMPLES as f64;
    let of_chain = segments
        .iter()
        .flat_map(|segment| (0..=SAMPLES).map(move |sample| segment.eval(share(sample))));
    let of_chain = of_chain.map(|at| polygon.nearest(DVec3::new(at.x, at.y, 0.0)).distance);
    let of_curve = (0..=SAMPLES * polygon.segments()).map(|sample| {
        let at = polygon.point(share(sample));
        let at = Point::new(at.x, at.y);
        let squares = segments
            .iter()
            .map(|segment| segment.nearest(at, accuracy).distance_sq);
        squares.fold(f64::INFINITY, f64::min).sqrt()
    });
    of_chain.chain(of_curve).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_is_near_its_curve_and_meets_it_at_its_ends() {
        for (degree, periodic) in [(4, false), (5, true), (9, false), (9, true)] {
            let vertices: Vec<(f64, f64)> = (0..14)
                .map(|index| {
                    let angle = f64::from(index) * std::f64::consts::TAU / 14.0;
                    let radius = 100.0 + 20.0 * (2.0 * angle).cos();
                    (radius * angle.cos(), radius * angle.sin())
                })
                .collect();
            let vertices = vertices
                .iter()
                .map(|(x, y)| DVec3::new(*x, *y, 0.0))
                .collect();
            let polygon = FloatPolygon::new(degree, vertices, None, periodic).expect("a polygon");
            let found = Cubics::along(&polygon, None);
            let size = BezierPolygon::from_float(&polygon).size();
            assert!(found.off <= 2.0 * WITHIN * size, "{degree}: {}", found.off);
            assert!((2..=24).contains(&found.count), "{degree}: {}", found.count);
            let points = &found.chain.points;
            assert_eq!(found.chain.knots.len(), points.len() + 4);
            let ends = [0.0, polygon.segments() as f64].map(|u| polygon.point(u));
            assert!(points[0].distance(ends[0]) <= 1e-9 * size);
            assert!(points[points.len() - 1].distance(ends[1]) <= 1e-9 * size);
        }
    }
}
