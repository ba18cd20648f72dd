//! Conditions on a curve's point and derivatives at a parameter.

use glam::DVec3;

use super::dual::{Dual, DualVector, differentiate, slope_numerator};
use super::jet_weights::{JetWeights, ORDERS};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::vector;

/// One scalar condition on a jet.
#[derive(Clone, Copy, Debug)]
pub(super) enum Condition {
    /// A component of a derivative: D·axis = value.
    Component {
        order: usize,
        axis: DVec3,
        value: f64,
    },
    /// The curvature seen along a unit normal: (C′ × C″)·b = κ |C′|³.
    SeenCurvature { normal: DVec3, value: f64 },
    /// The curvature of a space curve: |C′ × C″| = κ |C′|³.
    Curvature { value: f64 },
    /// The slope of the curvature seen along a unit normal:
    /// |C′|² (C′ × C‴)·b − 3 (C′·C″) (C′ × C″)·b = κ′ |C′|⁶.
    SeenSlope { normal: DVec3, value: f64 },
    /// The slope of the curvature of a space curve:
    /// |C′|² (C′ × C″)·(C′ × C‴) − 3 (C′·C″) |C′ × C″|² = κ′ |C′|⁶ |C′ × C″|.
    Slope { value: f64 },
}

impl Condition {
    /// List the conditions of a target, in the plane or in space; with a `speed`, |C′| along its
    /// direction is prescribed too.
    pub(super) fn of(target: &EndTarget, planar: bool, speed: Option<f64>) -> Vec<Self> {
        let axes = &[DVec3::X, DVec3::Y, DVec3::Z][..if planar { 2 } else { 3 }];
        let component = |order, axis: DVec3, value| Self::Component { order, axis, value };
        let points = axes.iter();
        let points = points.map(|axis| component(0, *axis, target.point.dot(*axis)));
        let mut conditions: Vec<Self> = points.collect();
        if let Some(direction) = target.direction.and_then(vector::direction) {
            if planar {
                let across = DVec3::new(-direction.y, direction.x, 0.0);
                conditions.push(component(1, across, 0.0));
            } else {
                let (first, second) = direction.any_orthonormal_pair();
                conditions.extend([first, second].map(|across| component(1, across, 0.0)));
            }
            conditions.extend(speed.map(|speed| component(1, direction, speed)));
        }
        let normal = target.normal.filter(|_| !planar);
        let normal = normal.and_then(vector::direction);
        if let Some(normal) = normal {
            conditions.push(component(1, normal, 0.0));
            conditions.push(component(2, normal, 0.0));
        }
        let seen = if planar { Some(DVec3::Z) } else { normal };
        let magnitude = |value: f64| if planar { value } else { value.abs() };
        match (target.curvature.map(magnitude), seen) {
            (None, _) => {}
            (Some(value), Some(normal)) => conditions.push(Self::SeenCurvature { normal, value }),
            // A straight end has no side on which its curvature could be seen: none may show any.
            (Some(0.0), None) => {
                let seen = axes.iter().map(|axis| (*axis, 0.0));
                conditions
                    .extend(seen.map(|(normal, value)| Self::SeenCurvature { normal, value }));
            }
            (Some(value), None) => conditions.push(Self::Curvature { value }),
        }
        conditions.extend(target.slope.map(|value| match seen {
            Some(normal) => Self::SeenSlope { normal, value },
            None => Self::Slope { value },
        }));
        conditions
    }

    /// Whether it is linear in the vertices.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self, Self::Component { .. })
    }

    /// What is missing (value minus actual for a component, actual minus value times the power of
    /// the speed otherwise), and the gradient of that by the vertices.
    pub(super) fn linearised(
        &self,
        weights: &JetWeights,
        vertices: &[DVec3],
    ) -> (f64, Vec<(usize, DVec3)>) {
        let jet = weights.jet(vertices);
        let mut gradient = [DVec3::ZERO; ORDERS];
        let left = match *self {
            Self::Component { order, axis, value } => {
                gradient[order] = axis;
                jet[order].dot(axis) - value
            }
            _ => {
                let formula = |derivatives| self.formula(derivatives);
                let (left, by_derivative) = differentiate([jet[1], jet[2], jet[3]], formula);
                gradient[1..].copy_from_slice(&by_derivative);
                left
            }
        };
        (left, weights.gradient(&gradient))
    }

    fn formula(&self, derivatives: [DualVector; 3]) -> Dual {
        let [first, second, _] = derivatives;
        let normal = first.cross(second);
        let squared = first.dot(first);
        match *self {
            Self::Component { axis, .. } => first.along(axis),
            Self::SeenCurvature {
                normal: seen,
                value,
            } => normal.along(seen) - squared * squared.sqrt() * value,
            Self::Curvature { value } => normal.length() - squared * squared.sqrt() * value,
            Self::SeenSlope {
                normal: seen,
                value,
            } => slope_numerator(derivatives, Some(seen)) - squared.cubed() * value,
            Self::Slope { value } => {
                slope_numerator(derivatives, None) - squared.cubed() * normal.length() * value
            }
        }
    }
}
