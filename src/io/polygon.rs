//! A curve by any of its polygons, there and back: shared by the formats.

use glam::DVec3;

use super::error::Problem;
use super::loss::Loss;
use super::reading::{Remark, Remarks};
use crate::document::Curve;
use crate::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, PolygonKind};

/// A curve as a file holds it: by one of its polygons.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FilePolygon {
    /// Which polygon it is.
    pub kind: PolygonKind,
    /// The degree.
    pub degree: usize,
    /// The vertices.
    pub vertices: Vec<DVec3>,
    /// The weights of a rational curve.
    pub weights: Option<Vec<f64>>,
    /// Whether they are those of a periodic curve.
    pub periodic: bool,
}

impl FilePolygon {
    /// Take one of a curve's polygons. The clamped and the Bézier polygon of a periodic curve are
    /// those of the open curve that runs round once from u = 0.
    pub(super) fn of(float: &FloatPolygon, kind: PolygonKind) -> Self {
        let owned = |vertices: &[DVec3], weights: Option<&[f64]>| {
            (vertices.to_vec(), weights.map(<[f64]>::to_vec))
        };
        let (vertices, weights) = match kind {
            PolygonKind::Float => owned(float.vertices(), float.weights()),
            PolygonKind::Clamped => {
                let clamped = ClampedPolygon::from_float(float);
                owned(clamped.vertices(), clamped.weights())
            }
            PolygonKind::Bezier => {
                let bezier = BezierPolygon::from_float(float);
                owned(bezier.vertices(), bezier.weights())
            }
        };
        Self {
            kind,
            degree: float.degree(),
            vertices,
            weights,
            periodic: float.is_periodic() && kind == PolygonKind::Float,
        }
    }

    /// List the losses of holding a curve by this polygon in place of its float polygon.
    pub(super) fn losses(&self, float: &FloatPolygon) -> Vec<Loss> {
        let kind = self.kind;
        let mut losses = Vec::new();
        if kind == PolygonKind::Float {
            return losses;
        }
        if float.is_periodic() {
            losses.push(Loss::Periodic);
        }
        let Ok((back, _)) = self.clone().into_float() else {
            losses.push(Loss::NoWayBack { kind });
            return losses;
        };
        let open = float.unrolled();
        let pairs = open.vertices().iter().zip(back.vertices());
        let distance = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        if distance > 0.0 {
            losses.push(Loss::Digits {
                kind,
                distance,
                curve: open.deviation(&back).unwrap_or(f64::INFINITY),
            });
        }
        losses
    }

    /// Make the float polygon of the curve, and a bound of how far its curve may be from the one
    /// given, where that is more than a few units in the last place.
    ///
    /// # Errors
    /// [`Problem`] if the vertices do not make a curve, or none that a float polygon can hold.
    pub(super) fn into_float(self) -> Result<(FloatPolygon, Option<f64>), Problem> {
        let Self {
            kind,
            degree,
            vertices,
            weights,
            periodic,
        } = self;
        if periodic && kind != PolygonKind::Float {
            return Err(Problem::PeriodicKind { kind });
        }
        let nearest = match kind {
            PolygonKind::Float => {
                let polygon = FloatPolygon::new(degree, vertices, weights, periodic)?;
                return Ok((polygon, None));
            }
            PolygonKind::Bezier => {
                BezierPolygon::new(degree, vertices, weights)?.nearest_float()?
            }
            PolygonKind::Clamped => {
                ClampedPolygon::new(degree, vertices, weights)?.nearest_float()?
            }
        };
        let off_by = (!nearest.is_close).then_some(nearest.deviation);
        Ok((nearest.polygon, off_by))
    }

    /// Make the curve with this number, counted from 1, and this name.
    ///
    /// # Errors
    /// As for [`Self::into_float`].
    pub(super) fn into_curve(
        self,
        number: usize,
        name: &str,
        remarks: &mut Remarks,
    ) -> Result<Curve, Problem> {
        let kind = self.kind;
        let (polygon, off_by) = self.into_float()?;
        if let Some(by) = off_by {
            let curve = (number, name.to_owned());
            remarks.add(Remark::CurveOff { curve, kind, by });
        }
        Ok(Curve::new(name, polygon))
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
                    let (back, off_by) = FilePolygon::of(&float, kind).into_float().unwrap();
                    assert_eq!(off_by, None, "{kind} {degree}");
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
        let losses = |kind| FilePolygon::of(&float, kind).losses(&float);
        let clamped = losses(PolygonKind::Clamped);
        let [Loss::Digits { distance, .. }] = clamped[..] else {
            panic!("{clamped:?}");
        };
        assert!((1e-12..1e-5).contains(&distance), "{distance}");
        assert_eq!(losses(PolygonKind::Float), []);
    }

    #[test]
    fn a_periodic_polygon_is_opened() {
        let float = wave(3, 8, false);
        let periodic = FloatPolygon::new(3, float.vertices().to_vec(), None, true).unwrap();
        let kind = PolygonKind::Clamped;
        let clamped = FilePolygon::of(&periodic, kind);
        assert_eq!(clamped.losses(&periodic).first(), Some(&Loss::Periodic));
        assert!(!clamped.periodic);
        let ends = (
            clamped.vertices[0],
            clamped.vertices[clamped.vertices.len() - 1],
        );
        assert!(ends.0.distance(ends.1) < 1e-12);
        let claimed = FilePolygon {
            periodic: true,
            ..clamped
        };
        assert_eq!(claimed.into_float(), Err(Problem::PeriodicKind { kind }));
    }

    #[test]
    fn what_is_exported_is_read_without_a_visible_loss_at_every_degree() {
        for degree in 1..=25 {
            for count in [degree + 1, degree + 4, degree + 30] {
                let float = wave(degree, count, false);
                for kind in [PolygonKind::Clamped, PolygonKind::Bezier] {
                    let (_, off_by) = FilePolygon::of(&float, kind).into_float().unwrap();
                    assert_eq!(off_by, None, "{kind} {degree} {count}");
                }
            }
        }
    }

    #[test]
    fn a_curve_that_needs_more_digits_is_refused_with_the_figure() {
        // (2n − 1)!! is 5.8e31 for degree 25: sixteen digits cannot carry that.
        let corner = |index: usize| DVec3::new(index as f64, (index % 2) as f64, 0.0);
        for kind in [PolygonKind::Clamped, PolygonKind::Bezier] {
            let given = FilePolygon {
                kind,
                degree: 25,
                vertices: (0..26).map(corner).collect(),
                weights: None,
                periodic: false,
            };
            let result = given.into_float();
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
        let mut given = FilePolygon::of(&float, PolygonKind::Bezier);
        let decimal = |value: f64| (value * 1e9).round() / 1e9;
        for vertex in &mut given.vertices {
            *vertex = DVec3::from_array(vertex.to_array().map(decimal));
        }
        let (back, off_by) = given.into_float().unwrap();
        let off_by = off_by.unwrap();
        assert!((1e-10..1e-8).contains(&off_by), "{off_by:e}");
        // Rounding moved the curve by up to 9e-10 in space.
        assert!(float.deviation(&back).unwrap() <= off_by + 9e-10);
    }
}
