//! Curves of any degree as chains of cubic Béziers, for formats that hold no others.

use std::ops::Range;

use glam::{DVec2, DVec3};
use kurbo::{
    BezPath, CubicBez, CurveFitSample, ParamCurve, ParamCurveFit, ParamCurveNearest, Point, Vec2,
    fit_to_bezpath, fit_to_bezpath_opt,
};

use super::drawing::Nurbs;
use crate::geometry::cubics::{ChainFeatures, Cubic, fair_chain};
use crate::geometry::features::{Feature, Features};
use crate::geometry::{BezierPolygon, FloatPolygon};
use crate::io::loss::CubicDifference;

/// How far a chain may be from its curve, by the size of the curve.
const WITHIN: f64 = 1e-4;

/// The samples of a Bézier, and of a segment of the curve, by which the chain is measured.
const SAMPLES: usize = 32;

/// A fit whose measured distance is so many times the tolerance has failed: the fit itself only estimates it.
const LOOSE: f64 = 2.0;

/// The accuracy of nearest points, by the tolerance.
const ACCURACY: f64 = 1e-3;

/// A chain of cubic Béziers along a planar curve.
pub(super) struct Cubics {
    /// The chain, with inner knots of multiplicity 3.
    pub(super) chain: Nurbs,
    /// Its difference from the curve.
    pub(super) difference: CubicDifference,
}

impl Cubics {
    /// Find few Béziers within a length, or 1e-4 of its size, of a planar curve, whose joints lie on the
    /// curve, with its tangents there. They keep its features where such a chain is found.
    pub(super) fn along(polygon: &FloatPolygon, within: Option<f64>) -> Self {
        let size = BezierPolygon::from_float(polygon).size();
        let tolerance = within.unwrap_or(WITHIN * size);
        let features = Features::new(polygon);
        let mut chain = fair_chain(polygon, &features, tolerance)
            .unwrap_or_else(|| nearest_chain(polygon, tolerance));
        let is_closed = polygon.is_periodic();
        if let (true, Some([start, ..])) = (is_closed, chain.first().copied())
            && let Some([.., end]) = chain.last_mut()
        {
            *end = start;
        }
        let written = ChainFeatures::of(&chain, is_closed);
        let count = chain.len();
        let inner = (0..=count).flat_map(|knot| [knot as f64; 3]);
        let knots = [0.0].into_iter().chain(inner).chain([count as f64]);
        let start = chain.first().map(|[start, ..]| *start);
        let others = chain.iter().flat_map(|[_, others @ ..]| *others);
        Self {
            difference: CubicDifference {
                count,
                off: farthest(polygon, &chain, ACCURACY * tolerance),
                inflections: [features.count(Feature::Inflection), written.inflections],
                curvature_extrema: [
                    features.count(Feature::CurvatureExtremum),
                    written.curvature_extrema,
                ],
                jumps: written.jumps,
            },
            chain: Nurbs {
                degree: 3,
                knots: knots.collect(),
                points: start
                    .into_iter()
                    .chain(others)
                    .map(|it| it.extend(0.0))
                    .collect(),
                weights: None,
                periodic: false,
            },
        }
    }
}

/// Few Béziers within a length. Their curvature jumps at the joints.
fn nearest_chain(polygon: &FloatPolygon, tolerance: f64) -> Vec<Cubic> {
    let scale = unit_scale(polygon);
    let source = Source { polygon, scale };
    let off = |chain: &[Cubic]| farthest(polygon, chain, ACCURACY * tolerance);
    let fewest = source.chain(&fit_to_bezpath_opt(&source, scale * tolerance));
    let missed = off(&fewest);
    if missed <= LOOSE * tolerance {
        return fewest;
    }
    // The fewest may miss the curve by far: the other fit halves it until all is near.
    let halved = source.chain(&fit_to_bezpath(&source, scale * tolerance));
    match off(&halved) < missed {
        true => halved,
        false => fewest,
    }
}

/// The power of two that gives a curve a size from 1 to 2: fits and nearest points of `kurbo` count in lengths, and do not
/// end, or are wrong, where these are large.
fn unit_scale(polygon: &FloatPolygon) -> f64 {
    (-polygon.size().log2().floor()).exp2()
}

/// A curve over 0 to 1, of a size from 1 to 2.
struct Source<'a> {
    polygon: &'a FloatPolygon,
    /// A power of two.
    scale: f64,
}

impl Source<'_> {
    /// The cubics of a path of the scaled curve.
    fn chain(&self, path: &BezPath) -> Vec<Cubic> {
        let cubics = path.segments().map(|segment| {
            let cubic = segment.to_cubic();
            let points = [cubic.p0, cubic.p1, cubic.p2, cubic.p3];
            points.map(|it| DVec2::new(it.x, it.y) / self.scale)
        });
        cubics.collect()
    }

    /// The point and the derivative.
    fn at(&self, t: f64) -> [DVec2; 2] {
        let segments = self.polygon.segments() as f64;
        // The end of a periodic curve is not its start on the way there.
        let jet = self.polygon.jet((t * segments).min(segments.next_down()));
        [jet.point, segments * jet.first].map(|it| self.scale * it.truncate())
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
fn farthest(polygon: &FloatPolygon, chain: &[Cubic], accuracy: f64) -> f64 {
    let scale = unit_scale(polygon);
    let segments: Vec<CubicBez> = chain
        .iter()
        .map(|cubic| {
            let [a, b, c, d] = cubic.map(|it| vector(scale * it).to_point());
            CubicBez::new(a, b, c, d)
        })
        .collect();
    let share = |sample: usize| sample as f64 / SAMPLES as f64;
    let of_chain = segments
        .iter()
        .flat_map(|segment| (0..=SAMPLES).map(move |sample| segment.eval(share(sample))));
    let of_chain = of_chain.map(|at| {
        let at = DVec3::new(at.x, at.y, 0.0) / scale;
        polygon.nearest(at).distance
    });
    let of_curve = (0..=SAMPLES * polygon.segments()).map(|sample| {
        let at = scale * polygon.point(share(sample));
        let at = Point::new(at.x, at.y);
        let squares = segments
            .iter()
            .map(|segment| segment.nearest(at, scale * accuracy).distance_sq);
        squares.fold(f64::INFINITY, f64::min).sqrt() / scale
    });
    of_chain.chain(of_curve).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave with five bends.
    fn wave() -> FloatPolygon {
        let heights = [
            0.0, 3.0, 8.0, -6.0, -9.0, 7.0, 10.0, 2.0, -8.0, -4.0, 5.0, 6.0,
        ];
        let points: Vec<(f64, f64)> = (0..).map(|it| 10.0 * f64::from(it)).zip(heights).collect();
        FloatPolygon::planar(5, &points).expect("a polygon")
    }

    #[test]
    fn features_are_kept_and_the_curvature_does_not_jump() {
        let polygon = wave();
        for within in [None, Some(0.1), Some(1e-4)] {
            let found = Cubics::along(&polygon, within).difference;
            let [before, now] = found.inflections;
            assert!(before >= 2 && now == before, "{found:?}");
            let [before, now] = found.curvature_extrema;
            assert!(before >= 3 && now == before, "{found:?}");
            assert!(
                !found.jumps && found.off <= within.unwrap_or(0.02),
                "{found:?}"
            );
        }
        let nearest = ChainFeatures::of(&nearest_chain(&polygon, 1e-3), false);
        assert!(nearest.jumps, "{nearest:?}");
    }

    #[test]
    fn features_that_are_not_kept_are_counted() {
        // A circle has one curvature extremum at most, by rounding of the weight; cubics near it have more.
        let corner = 0.5_f64.sqrt();
        let square = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let bezier = BezierPolygon::new(2, square.to_vec(), Some(vec![1.0, corner, 1.0]));
        let arc = bezier.and_then(|it| it.to_float()).expect("an arc");
        let found = Cubics::along(&arc, Some(1e-6)).difference;
        assert_eq!(found.inflections, [0, 0]);
        let [before, now] = found.curvature_extrema;
        assert!(now > before, "{found:?}");
        let told = format!("; curvature extrema: {before} before, {now} as written");
        assert!(found.to_string().contains(&told), "{found}");
    }

    #[test]
    fn curves_of_any_size_are_fitted() {
        let ring = [
            (10.0, 0.0),
            (8.7, 5.0),
            (5.0, 8.7),
            (0.0, 10.0),
            (-5.0, 8.7),
            (-8.7, 5.0),
        ];
        let far = |far: f64, scale: f64| {
            let vertices: Vec<(f64, f64)> = ring
                .iter()
                .chain(&[(far, 0.0), (-5.0, -8.7), (0.0, -10.0), (5.0, -8.7)])
                .map(|(x, y)| (scale * x, scale * y))
                .collect();
            FloatPolygon::planar(5, &vertices).expect("a polygon")
        };
        for (polygon, most) in [
            (far(1e11, 1.0), 5e-4),
            (far(1e10, 1.0), 5e-4),
            (far(-10.0, 1e9), 2e-4),
            (far(-10.0, 1e-9), 2e-4),
        ] {
            let size = polygon.size();
            let chain = nearest_chain(&polygon, 1e-4 * size);
            let off = farthest(&polygon, &chain, 1e-6 * size);
            assert!(off <= most * size, "{off} {size}");
        }
    }

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
            assert!(
                found.difference.off <= 2.0 * WITHIN * size,
                "{degree}: {}",
                found.difference.off
            );
            assert!(
                (2..=24).contains(&found.difference.count),
                "{degree}: {}",
                found.difference.count
            );
            let points = &found.chain.points;
            assert_eq!(found.chain.knots.len(), points.len() + 4);
            let ends = [0.0, polygon.segments() as f64].map(|u| polygon.point(u));
            assert!(points[0].distance(ends[0]) <= 1e-9 * size);
            assert!(points[points.len() - 1].distance(ends[1]) <= 1e-9 * size);
        }
    }
}
