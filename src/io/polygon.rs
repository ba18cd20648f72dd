//! What the text formats share: a curve by any of its polygons, there and back.

use glam::DVec3;

use super::error::Problem;
use super::loss::Loss;
use crate::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, PolygonKind};

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

/// Hold the float polygon of a curve that was given by one of its polygons.
#[derive(Debug, PartialEq)]
pub struct Built {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// A bound of how far its curve may be from the one given, where that is more than a few
    /// units in the last place.
    pub off_by: Option<f64>,
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
) -> Result<Built, Problem> {
    if periodic && kind != PolygonKind::Float {
        return Err(Problem::PeriodicKind { kind });
    }
    let nearest = match kind {
        PolygonKind::Float => {
            let polygon = FloatPolygon::new(degree, vertices, weights, periodic)?;
            let off_by = None;
            return Ok(Built { polygon, off_by });
        }
        PolygonKind::Bezier => BezierPolygon::new(degree, vertices, weights)?.nearest_float()?,
        PolygonKind::Clamped => ClampedPolygon::new(degree, vertices, weights)?.nearest_float()?,
    };
    Ok(Built {
        polygon: nearest.polygon,
        off_by: (!nearest.is_close).then_some(nearest.deviation),
    })
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
        Ok(Built { polygon: back, .. }) => {
            let open = float.unrolled();
            let pairs = open.vertices().iter().zip(back.vertices());
            let distance = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            if distance > 0.0 {
                let curve = open.deviation(&back).unwrap_or(f64::INFINITY);
                losses.push(Loss::Digits {
                    kind,
                    distance,
                    curve,
                });
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::PolygonError;

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
                    let built = build(kind, degree, vertices, weights, false).unwrap();
                    assert_eq!(built.off_by, None, "{kind} {degree}");
                    let back = built.polygon;
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
    fn what_is_exported_is_read_without_a_visible_loss_at_every_degree() {
        for degree in 1..=25 {
            for count in [degree + 1, degree + 4, degree + 30] {
                let float = wave(degree, count, false);
                for kind in [PolygonKind::Clamped, PolygonKind::Bezier] {
                    let vertices = written(&float, kind).vertices;
                    let built = build(kind, degree, vertices, None, false).unwrap();
                    assert_eq!(built.off_by, None, "{kind} {degree} {count}");
                }
            }
        }
    }

    #[test]
    fn a_curve_that_needs_more_digits_is_refused_with_the_figure() {
        // (2n − 1)!! is 5.8e31 for degree 25: sixteen digits cannot carry that.
        let corner = |index: usize| DVec3::new(index as f64, (index % 2) as f64, 0.0);
        for kind in [PolygonKind::Clamped, PolygonKind::Bezier] {
            let vertices = (0..26).map(corner).collect();
            let result = build(kind, 25, vertices, None, false);
            let Err(Problem::Polygon(PolygonError::DigitsLost { distance, .. })) = result else {
                panic!("{result:?}");
            };
            assert!(distance > 25e-6, "{distance}");
        }
    }

    #[test]
    fn what_is_read_with_a_loss_says_how_far_the_curve_may_be_off() {
        // Decimals of eleven digits: off by as much, and said so.
        let float = wave(9, 14, false);
        let vertices = written(&float, PolygonKind::Bezier).vertices;
        let decimal = |value: f64| (value * 1e9).round() / 1e9;
        let vertices = vertices.into_iter();
        let vertices = vertices.map(|v| DVec3::from_array(v.to_array().map(decimal)));
        let built = build(PolygonKind::Bezier, 9, vertices.collect(), None, false).unwrap();
        let off_by = built.off_by.unwrap();
        assert!((1e-10..1e-8).contains(&off_by), "{off_by:e}");
        // Rounding moved the curve by up to 9e-10 in space.
        assert!(float.deviation(&built.polygon).unwrap() <= off_by + 9e-10);
    }
}
