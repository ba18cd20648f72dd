//! What the text formats share: a curve by any of its polygons, there and back.

use glam::DVec3;

use super::error::Problem;
use super::loss::Loss;
use crate::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, PolygonKind};

/// How far, in units of the largest coordinate, the curve may move when a clamped polygon is
/// converted to the float polygon: decimal rounding to ten digits may not be refused, a curve
/// that is visibly another one must be.
const UNSTABLE: f64 = 1e-9;

/// Hold the vertices by which a curve is written.
pub struct Written {
    /// The vertices.
    pub vertices: Vec<DVec3>,
    /// The weights of a rational curve.
    pub weights: Option<Vec<f64>>,
    /// Whether they are those of a periodic curve.
    pub periodic: bool,
    /// What is lost by writing them.
    pub losses: Vec<Loss>,
}

/// Take the vertices of one of a curve's polygons. The clamped and the Bézier polygon of a
/// periodic curve are those of the open curve that runs round once from u = 0.
pub fn written(float: &FloatPolygon, kind: PolygonKind) -> Written {
    let (vertices, weights) = match kind {
        PolygonKind::Float => (float.vertices().to_vec(), float.weights()),
        PolygonKind::Clamped => {
            let clamped = ClampedPolygon::from_float(float);
            return converted(float, kind, clamped.vertices(), clamped.weights());
        }
        PolygonKind::Bezier => {
            let bezier = BezierPolygon::from_float(float);
            return converted(float, kind, bezier.vertices(), bezier.weights());
        }
    };
    Written {
        vertices,
        weights: weights.map(<[f64]>::to_vec),
        periodic: float.is_periodic(),
        losses: Vec::new(),
    }
}

/// Make the float polygon of a curve that is given by one of its polygons.
///
/// # Errors
/// [`Problem`] if the vertices do not make a curve, or none that a float polygon can hold.
pub fn build(
    kind: PolygonKind,
    degree: usize,
    vertices: Vec<DVec3>,
    weights: Option<Vec<f64>>,
    periodic: bool,
) -> Result<FloatPolygon, Problem> {
    if periodic && kind != PolygonKind::Float {
        return Err(Problem::PeriodicKind { kind });
    }
    match kind {
        PolygonKind::Float => Ok(FloatPolygon::new(degree, vertices, weights, periodic)?),
        PolygonKind::Bezier => Ok(BezierPolygon::new(degree, vertices, weights)?.to_float()?),
        PolygonKind::Clamped => {
            let given = ClampedPolygon::new(degree, vertices, weights)?;
            let float = given.to_float()?;
            let distance = moved(&given, &ClampedPolygon::from_float(&float));
            let scale = given.vertices().iter().map(|v| v.abs().max_element());
            // Written so that a distance that is not a number is refused too.
            if distance <= UNSTABLE * scale.fold(0.0, f64::max) {
                Ok(float)
            } else {
                Err(Problem::Unstable { kind, distance })
            }
        }
    }
}

fn converted(
    float: &FloatPolygon,
    kind: PolygonKind,
    vertices: &[DVec3],
    weights: Option<&[f64]>,
) -> Written {
    let (vertices, weights) = (vertices.to_vec(), weights.map(<[f64]>::to_vec));
    let mut losses = Vec::new();
    if float.is_periodic() {
        losses.push(Loss::Periodic);
    }
    match build(
        kind,
        float.degree(),
        vertices.clone(),
        weights.clone(),
        false,
    ) {
        Ok(back) => {
            let open = float.unrolled();
            let pairs = open.vertices().iter().zip(back.vertices());
            let distance = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            if distance > 0.0 {
                losses.push(Loss::Digits { kind, distance });
            }
        }
        Err(_) => losses.push(Loss::NoWayBack { kind }),
    }
    Written {
        vertices,
        weights,
        periodic: false,
        losses,
    }
}

/// Measure how far the vertices, and by the same scale the weights, of two polygons differ.
fn moved(before: &ClampedPolygon, after: &ClampedPolygon) -> f64 {
    let pairs = before.vertices().iter().zip(after.vertices());
    let points = pairs.map(|(a, b)| a.distance(*b));
    let size = before.vertices().iter().map(|v| v.length());
    let size = size.fold(0.0, f64::max);
    let pairs = before.weights().into_iter().flatten();
    let pairs = pairs.zip(after.weights().into_iter().flatten());
    let weights = pairs.map(|(a, b)| size * (a - b).abs() / a);
    // `f64::max` would pass over what is not a number.
    points.chain(weights).fold(
        0.0,
        |worst, distance| {
            if distance <= worst { worst } else { distance }
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(degree: usize, count: usize, weighted: bool) -> FloatPolygon {
        let vertices = (0..count).map(|i| {
            let i = i as f64;
            DVec3::new(3.0 * i, 5.0 * (0.7 * i).sin(), 0.3 * i * i)
        });
        let weights = weighted.then(|| (0..count).map(|i| 1.0 + 0.1 * (i % 3) as f64).collect());
        FloatPolygon::new(degree, vertices.collect(), weights, false).unwrap()
    }

    #[test]
    fn every_polygon_leads_back_to_the_curve() {
        for kind in PolygonKind::ALL {
            for (degree, count) in [(1, 2), (2, 9), (3, 4), (5, 14)] {
                for weighted in [false, true] {
                    let float = wave(degree, count, weighted);
                    let Written {
                        vertices, weights, ..
                    } = written(&float, kind);
                    let back = build(kind, degree, vertices, weights, false).unwrap();
                    for u in [0.0, 0.4, float.segments() as f64] {
                        let distance = float.point(u).distance(back.point(u));
                        assert!(
                            distance < 1e-12 * float.size(),
                            "{kind} {degree}: {distance}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn lost_digits_are_measured() {
        let float = wave(9, 10, false);
        let losses = written(&float, PolygonKind::Clamped).losses;
        let [Loss::Digits { distance, .. }] = losses[..] else {
            panic!("{losses:?}");
        };
        assert!((1e-12..1e-5).contains(&distance), "{distance}");
        assert_eq!(written(&float, PolygonKind::Float).losses, []);
    }

    #[test]
    fn a_periodic_polygon_is_opened() {
        let float = wave(3, 8, false);
        let periodic = FloatPolygon::new(3, float.vertices().to_vec(), None, true).unwrap();
        let result = written(&periodic, PolygonKind::Clamped);
        assert_eq!(result.losses.first(), Some(&Loss::Periodic));
        assert!(!result.periodic);
        let ends = (
            result.vertices[0],
            result.vertices[result.vertices.len() - 1],
        );
        assert!(ends.0.distance(ends.1) < 1e-12);
        assert_eq!(
            build(PolygonKind::Bezier, 3, result.vertices, None, true),
            Err(Problem::PeriodicKind {
                kind: PolygonKind::Bezier
            }),
        );
    }

    #[test]
    fn a_degree_that_loses_the_curve_is_refused() {
        // (2n − 1)!! is 5.8e31 for degree 25: sixteen digits cannot carry that.
        let vertices = wave(25, 26, false).vertices().to_vec();
        let result = build(PolygonKind::Clamped, 25, vertices, None, false);
        assert!(
            matches!(result, Err(Problem::Unstable { .. })),
            "{result:?}"
        );
    }
}
