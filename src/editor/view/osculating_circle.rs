//! Osculating circles of targets and of hovered places, as they are seen and dragged.

use std::f64::consts::PI;

use glam::{DMat2, DVec2, DVec3};

use crate::document::Curve;
use crate::editor::view::viewport::Viewport;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, Jet};

/// Chords of the circle.
const STEPS: i32 = 128;

/// How far along it from the target a large circle is drawn, in screen points.
pub const FARTHEST: f64 = 1200.0;

/// A circle through a target that touches its direction: in the osculating plane, with the target's
/// curvature.
#[derive(Clone, Copy, Debug)]
pub struct OsculatingCircle {
    point: DVec3,
    /// The unit tangent.
    along: DVec3,
    /// The unit vector to the left of it, towards the centre of a positive curvature.
    across: DVec3,
    curvature: f64,
}

impl OsculatingCircle {
    /// The circle of the target of a curve's end, if that has a direction and a curvature. In space
    /// the plane is the target's, or the actual one.
    pub fn of(target: &EndTarget, curve: &Curve, end: End) -> Option<Self> {
        let along = target.direction?.try_normalize()?;
        let curvature = target.curvature?;
        let normal = if curve.polygon.is_planar() {
            DVec3::Z
        } else {
            let jet = curve.polygon.end_jet(end);
            target.normal.unwrap_or(jet.first.cross(jet.second))
        };
        Some(Self {
            point: target.point,
            along,
            across: normal.cross(along).try_normalize()?,
            curvature,
        })
    }

    /// The osculating circle of a curve; `None` where the curve is straight.
    pub fn of_jet(jet: &Jet) -> Option<Self> {
        let arm = jet.centre_of_curvature()? - jet.point;
        Some(Self {
            point: jet.point,
            along: jet.tangent()?,
            across: arm.try_normalize()?,
            curvature: 1.0 / arm.length(),
        })
    }

    /// The circle as it is seen, or the part of it within `reach` screen points where it is large: a line
    /// where it is straight.
    pub fn chain_within(&self, viewport: &Viewport, reach: f64) -> Vec<DVec2> {
        let reach = reach * viewport.pixel();
        let turn = (reach * self.curvature).clamp(-PI, PI);
        let steps = (-STEPS / 2)..=(STEPS / 2);
        let chord = |step: i32| {
            let share = 2.0 * f64::from(step) / f64::from(STEPS);
            let angle = share * turn;
            // (1 − cos)/κ and sin/κ, which are the arc's height and length where κ is 0.
            let (forth, aside) = if angle.abs() < 1e-6 {
                (share * reach, 0.5 * share * reach * angle)
            } else {
                let half = (0.5 * angle).sin();
                (
                    angle.sin() / self.curvature,
                    2.0 * half * half / self.curvature,
                )
            };
            viewport.flatten(self.point + forth * self.along + aside * self.across)
        };
        steps.map(chord).collect()
    }

    /// The curvature of the circle that touches the direction and passes through a place of the view
    /// plane; `None` where the plane is seen from its edge, or the place is the target.
    pub fn curvature_through(&self, place: DVec2, viewport: &Viewport) -> Option<f64> {
        let axes = [self.along, self.across].map(|axis| viewport.flatten(axis));
        let plane = DMat2::from_cols(axes[0], axes[1]);
        if plane.determinant().abs() < 1e-3 {
            return None;
        }
        let seen = plane.inverse() * (place - viewport.flatten(self.point));
        let curvature = 2.0 * seen.y / seen.length_squared();
        curvature.is_finite().then_some(curvature)
    }
}
