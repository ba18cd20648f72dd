//! The curve and the end that the end-fit tool works on, and the handles there are.

use glam::DVec2;

use super::tool::Context;
use crate::document::{Curve, CurveId, Document, Edit, EditError, quoted};
use crate::editor::hand::snapping::Carried;
use crate::editor::view::end_marks::{ARROW, RING};
use crate::editor::view::hit::REACH;
use crate::editor::view::osculating_circle::{FARTHEST, OsculatingCircle};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, figure};

/// What of the tool's own handles is under a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Handle {
    Target,
    Direction,
    Ring,
    Body,
    Circle,
    OtherEnd(End),
}

/// The curve that the tool works on, as it was when the gesture began.
pub(super) struct Subject<'a> {
    pub(super) id: CurveId,
    pub(super) curve: &'a Curve,
    pub(super) end: End,
    pub(super) point: DVec2,
    pub(super) target: Option<EndTarget>,
}

impl<'a> Subject<'a> {
    /// The subject as it is now.
    pub(super) fn now(context: &Context<'a>) -> Result<Self, String> {
        Self::of(context, context.document)
    }

    /// The subject as it was when the gesture began.
    pub(super) fn before(context: &Context<'a>) -> Result<Self, String> {
        Self::of(context, context.before)
    }

    fn of(context: &Context<'a>, document: &'a Document) -> Result<Self, String> {
        let end = context.settings.end_fit.end;
        let found = context
            .selection
            .active()
            .and_then(|id| Some((id, document.curve(id)?)));
        let Some((id, curve)) = found else {
            return Err("Select the curve whose ends to correct".into());
        };
        if curve.polygon.is_periodic() {
            return Err(format!(
                "{} is periodic and has no ends: open it in the Curve menu",
                quoted(&curve.name)
            ));
        }
        curve
            .check_visible()
            .map_err(|refused| refused.to_string())?;
        Ok(Self {
            id,
            curve,
            end,
            point: context.viewport.flatten(curve.polygon.end_jet(end).point),
            target: curve.targets.get(end),
        })
    }

    /// The place of the target direction's handle.
    fn direction_tip(&self, context: &Context) -> Option<DVec2> {
        let target = self.target?;
        let view = context.viewport;
        let direction = view.flatten(target.direction?).try_normalize()?;
        Some(view.flatten(target.point) + ARROW * context.viewport.pixel() * direction)
    }

    pub(super) fn handle(&self, place: DVec2, context: &Context) -> Option<Handle> {
        let near = |model: DVec2| context.viewport.to_screen(model).distance(place) <= REACH;
        if self.direction_tip(context).is_some_and(near) {
            return Some(Handle::Direction);
        }
        if self
            .target
            .is_some_and(|target| near(context.viewport.flatten(target.point)))
        {
            // Where the end has met its target it is the end that is taken, but for Alt; the other way
            // round where the end follows its target.
            let follows = context.following.follows_targets();
            return Some(
                if self.is_met(context) && context.modifiers.alt == follows {
                    Handle::Body
                } else {
                    Handle::Target
                },
            );
        }
        if near(self.point) {
            return Some(Handle::Body);
        }
        // The ring comes before the vertices that it crosses: there are others to take.
        let from_end = context.viewport.to_screen(self.point).distance(place);
        if (from_end - RING).abs() <= 0.75 * REACH {
            return Some(Handle::Ring);
        }
        let terminal = self.curve.polygon.terminal_vertices(self.end);
        let mut vertices = self.curve.polygon.vertices()[terminal].iter();
        if vertices.any(|vertex| near(context.viewport.flatten(*vertex))) {
            return Some(Handle::Body);
        }
        let circle = self.circle(context);
        if circle.is_some_and(|circle| near_chain(&circle, place, context)) {
            return Some(Handle::Circle);
        }
        let other = self.end.other();
        let other_end = self.curve.polygon.end_jet(other).point;
        near(context.viewport.flatten(other_end)).then_some(Handle::OtherEnd(other))
    }

    /// The target's osculating circle, as it is seen.
    fn circle(&self, context: &Context) -> Option<Vec<DVec2>> {
        let target = self.target?;
        let circle = OsculatingCircle::of(&target, self.curve, self.end)?;
        Some(circle.chain_within(context.viewport, FARTHEST))
    }

    /// Whether the end lies on its target, as far as the eye can tell.
    pub(super) fn is_met(&self, context: &Context) -> bool {
        let target = self
            .target
            .map(|target| context.viewport.flatten(target.point));
        target.is_some_and(|target| target.distance(self.point) <= context.viewport.pixel())
    }

    pub(super) fn is_planar(&self) -> bool {
        self.curve.polygon.is_planar()
    }

    /// Refuse if the target is what a match makes it, or the end cannot follow it where it should.
    pub(super) fn check_target(&self, context: &Context) -> Result<(), EditError> {
        let mut tried = context.document.clone();
        let (curve, end, target) = (self.id, self.end, self.target);
        tried.apply(Edit::SetTarget { curve, end, target })?;
        match context.following.follows_targets() {
            true => self.curve.check_editable(),
            false => Ok(()),
        }
    }

    /// The target's curvature and radius, in words.
    pub(super) fn curvature(&self) -> String {
        let curvature = self.target.and_then(|target| target.curvature);
        let curvature = curvature.unwrap_or_default();
        format!(
            "κ = {}, radius {}",
            figure(curvature),
            figure(1.0 / curvature.abs())
        )
    }

    /// Refuse if the terminal vertices cannot be moved as one body.
    pub(super) fn check_movable(&self) -> Result<(), EditError> {
        let terminal = self.curve.polygon.terminal_vertices(self.end);
        self.curve.check_editable()?;
        self.curve.check_vertices_unlocked(terminal)
    }

    /// What does not attract the end's target: the target itself, and the curve's own vertices.
    pub(super) fn carried(&self) -> Carried {
        let all = 0..self.curve.polygon.vertices().len();
        Carried {
            vertices: all.map(|index| (self.id, index)).collect(),
            target: Some((self.id, self.end)),
            item: None,
            guide: None,
            is_off_ground: !self.is_planar(),
        }
    }

    pub(super) fn with_target(&self, target: EndTarget) -> Edit {
        Edit::SetTarget {
            curve: self.id,
            end: self.end,
            target: Some(target),
        }
    }
}

fn near_chain(chain: &[DVec2], place: DVec2, context: &Context) -> bool {
    let at = context.model(place);
    let reach = 0.75 * REACH * context.viewport.pixel();
    chain.windows(2).any(|ends| {
        let along = ends[1] - ends[0];
        let share = (at - ends[0]).dot(along) / along.length_squared();
        ends[0].lerp(ends[1], share.clamp(0.0, 1.0)).distance(at) <= reach
    })
}
