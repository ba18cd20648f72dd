//! What drags of the end-fit tool make: of targets, and of the terminal vertices as one body.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use super::end_fit_subject::Subject;
use super::tool::{Context, Effect};
use crate::document::{Edit, quoted};
use crate::editor::hand::snapping::along_axis;
use crate::editor::view::hit::REACH;
use crate::editor::view::osculating_circle::OsculatingCircle;
use crate::geometry::FloatPolygon;
use crate::geometry::end_correction::{
    EndDifference, EndTarget, align_end, rotate_end, translate_end,
};

/// The ring snaps to the target direction within this angle.
const SNAP_ANGLE: f64 = 2.5;

pub(super) fn drag_target(wanted: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let Some(target) = subject.target else {
        return Vec::new();
    };
    let from = context.viewport.flatten(target.point);
    let to = if context.modifiers.shift {
        from + along_axis(wanted - from)
    } else {
        context.snapped(wanted, &subject.carried())
    };
    let movement = context.movement(to - from, subject.is_planar());
    let point = target.point + movement;
    dragged(EndTarget { point, ..target }, subject, context)
}

pub(super) fn drag_direction(at: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let Some(target) = subject.target else {
        return Vec::new();
    };
    let view = &context.viewport.orientation;
    let free = (at - view.flatten(target.point)).to_angle();
    let push = DVec2::from_angle(context.angle(free));
    let direction = Some(if subject.is_planar() {
        context.viewport.movement(push, true).normalize_or(DVec3::X)
    } else {
        // The component along the line of sight stays.
        let before = target.direction.and_then(DVec3::try_normalize);
        let height = before.map_or(0.0, |d| view.depth(d));
        let flat = push * (1.0 - height * height).max(0.0).sqrt();
        view.lift(flat) + height * view.towards()
    });
    let target = EndTarget {
        direction,
        ..target
    };
    dragged(target, subject, context)
}

/// Give the target the curvature of the circle that touches its direction and passes through a
/// place of the view plane: κ = 2 n·q / |q|², q the place as seen from the target.
pub(super) fn drag_circle(at: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let circle = subject.target.and_then(|target| {
        Some((
            target,
            OsculatingCircle::of(&target, subject.curve, subject.end)?,
        ))
    });
    let Some((target, circle)) = circle else {
        return Vec::new();
    };
    let Some(curvature) = circle.curvature_through(at, context.viewport) else {
        return Vec::new();
    };
    let planar = subject.is_planar();
    let turned = |normal: DVec3| if curvature < 0.0 { -normal } else { normal };
    let target = EndTarget {
        curvature: Some(if planar { curvature } else { curvature.abs() }),
        normal: if planar {
            target.normal
        } else {
            target.normal.map(turned)
        },
        ..target
    };
    dragged(target, subject, context)
}

/// Show a target that is dragged, and the curve whose end follows it if neighbours follow in harmony.
fn dragged(target: EndTarget, subject: &Subject, context: &Context) -> Vec<Effect> {
    let mut edits = vec![subject.with_target(target)];
    if context.following.follows_targets() {
        let (curve, end) = (subject.id, subject.end);
        match context.following.to_target(subject.curve, end, &target) {
            Ok(polygon) => match subject.curve.led_by(polygon, end) {
                Ok(polygon) => edits.push(Edit::SetPolygon { curve, polygon }),
                Err(error) => return vec![Effect::Say(error.to_string())],
            },
            Err(error) => {
                let name = quoted(&subject.curve.name);
                return vec![Effect::Say(format!("{name} cannot follow: {error}"))];
            }
        }
    }
    vec![Effect::Preview(edits)]
}

pub(super) fn is_near(place: DVec2, target: &EndTarget, context: &Context) -> bool {
    let seen = context.viewport.flatten(target.point);
    seen.distance(place) <= REACH * context.viewport.pixel()
}

/// Translate the terminal vertices, onto a target if they snap to it.
pub(super) fn drag_body(
    free: DVec2,
    snapped: Option<EndTarget>,
    subject: &Subject,
    context: &Context,
) -> Vec<Effect> {
    let (polygon, end) = (&subject.curve.polygon, subject.end);
    let vector = match snapped {
        Some(target) => EndDifference::between(polygon, end, &target).vector,
        None if context.modifiers.shift => context.movement(along_axis(free), subject.is_planar()),
        None => context.movement(free, subject.is_planar()),
    };
    shaped(subject, translate_end(polygon, end, vector))
}

/// The angle that turns the tangent into the target direction, if a free one snaps to it.
pub(super) fn missing_angle(free: f64, subject: &Subject, context: &Context) -> Option<f64> {
    let polygon = &subject.curve.polygon;
    let snaps = !context.modifiers.ctrl
        && context.viewport.orientation.is_from_above()
        && polygon.is_planar();
    let target = subject
        .target
        .filter(|target| snaps && target.direction.is_some())?;
    let missing = EndDifference::between(polygon, subject.end, &target).angle;
    // Angles are the same a whole turn apart: the nearest way counts.
    let between = (missing - free + PI).rem_euclid(TAU) - PI;
    (between.abs() < SNAP_ANGLE.to_radians()).then_some(missing)
}

/// Rotate the terminal vertices, exactly into the target direction if they snap to it.
pub(super) fn drag_ring(
    angle: f64,
    snapped: bool,
    subject: &Subject,
    context: &Context,
) -> Vec<Effect> {
    let (polygon, end) = (&subject.curve.polygon, subject.end);
    let direction = subject.target.and_then(|target| target.direction);
    let turned = match direction.filter(|_| snapped) {
        Some(direction) => align_end(polygon, end, direction),
        None => rotate_end(polygon, end, turned_by(angle, subject, context)),
    };
    shaped(subject, turned)
}

/// The rotation that turns what is seen by an angle: of a planar curve within its plane.
fn turned_by(angle: f64, subject: &Subject, context: &Context) -> DMat3 {
    let towards = context.viewport.orientation.towards();
    if subject.is_planar() {
        let seen_from_below = towards.z < 0.0;
        DMat3::from_rotation_z(if seen_from_below { -angle } else { angle })
    } else {
        DMat3::from_axis_angle(towards, angle)
    }
}

fn shaped<E: std::fmt::Display>(
    subject: &Subject,
    polygon: Result<FloatPolygon, E>,
) -> Vec<Effect> {
    let (curve, end) = (subject.id, subject.end);
    let polygon = polygon.map_err(|error| error.to_string()).and_then(|it| {
        let led = subject.curve.led_by(it, end);
        led.map_err(|error| error.to_string())
    });
    let edits = polygon.map(|polygon| vec![Edit::SetPolygon { curve, polygon }]);
    vec![Effect::preview(edits)]
}
