//! The points of a fit on the canvas: their marks and whiskers, and a click that switches one.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::fitted_points::{FittedPoints, nearest};
use super::{Operating, OperationInProgress};
use crate::document::Curve;
use crate::editor::hand::tools::{Context, ToolKind};
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::scene::{HoverScene, Mark};
use crate::editor::view::{REACH, Viewport, Whiskers};
use crate::geometry::{Progress, significant};
use crate::operations::fit;

impl OperationInProgress {
    /// The points that are fitted; `None` for operations that fit none.
    pub fn fitted_points(&self) -> Option<&FittedPoints> {
        Some(&self.points).filter(|_| self.fits_points())
    }

    /// The scale at which whiskers are drawn.
    pub fn whisker_scale(&self, whiskers: &Whiskers) -> f64 {
        let largest = self.points.farthest().map_or(0.0, |(_, distance)| distance);
        whiskers.scale_for(self.input.points(), largest)
    }

    /// Bring the points up to date with other values.
    pub(super) fn update_points(&mut self) {
        if self.fits_points()
            && let Ok(left_out) = fit::left_out(&self.input, &self.values)
        {
            self.points.left_out = left_out;
            self.points.curves = fit::curves(&self.input, &self.values);
            self.points.expectation = fit::expectation(&self.input, &self.values);
        }
    }

    /// The point that a click would switch: before the operation is applied whatever the tool, afterwards with the
    /// select tool. A vertex that is nearer comes first.
    pub(in crate::editor) fn point_at(
        &self,
        place: DVec2,
        tool: ToolKind,
        context: &Context<'_>,
    ) -> Option<usize> {
        if !self.fits_points() || (self.is_applied() && tool != ToolKind::Select) {
            return None;
        }
        let viewport = context.viewport;
        let distance = |point: DVec3| {
            let at = viewport.to_screen(viewport.flatten(point));
            at.distance(place)
        };
        let points = self.input.points().iter().copied().map(distance);
        let near = points
            .enumerate()
            .filter(|(_, distance)| *distance <= REACH);
        let (index, nearest) = near.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let document = context.hits.shown.document();
        let vertex = context.hits.vertex(place).and_then(|(id, vertex)| {
            let vertices = document.curve(id)?.polygon.vertices();
            vertices.get(vertex).copied()
        });
        let is_first = vertex.is_none_or(|vertex| nearest <= distance(vertex));
        is_first.then_some(index)
    }

    /// The point under the pointer that a click would switch.
    pub(in crate::editor) fn point_under_pointer(
        &self,
        tool: ToolKind,
        context: &Context<'_>,
    ) -> Option<usize> {
        self.point_at(context.hits.shown.pointer?, tool, context)
    }

    /// The points as the canvas shows them, with whiskers, and the one under the pointer.
    pub(in crate::editor) fn point_marks(
        &self,
        viewport: &Viewport,
        whiskers: &Whiskers,
        hovered: Option<usize>,
    ) -> Vec<Mark> {
        if !self.fits_points() {
            return Vec::new();
        }
        let seen = |point: DVec3| viewport.flatten(point);
        let points = self.input.points();
        let mut marks = Vec::new();
        if whiskers.shown {
            let scale = self.whisker_scale(whiskers);
            let all = points.iter().zip(&self.points.nearest).enumerate();
            let kept = all.filter(|(index, _)| !self.points.leaves_out(*index));
            let lines = kept.map(|(_, (point, nearest))| {
                Whiskers::whisker([*point, nearest.point], scale).map(seen)
            });
            marks.push(Mark::Whiskers {
                lines: lines.collect(),
                beyond: false,
            });
        }
        let of_kind = |left_out: bool| {
            let all = points.iter().enumerate();
            let own = all.filter(|(index, _)| self.points.leaves_out(*index) == left_out);
            own.map(|(_, point)| seen(*point)).collect()
        };
        marks.push(Mark::Points {
            kept: of_kind(false),
            left_out: of_kind(true),
            hovered: hovered
                .and_then(|index| points.get(index))
                .map(|it| seen(*it)),
        });
        let farthest = self.points.farthest().filter(|_| whiskers.shown);
        let farthest = farthest.and_then(|(index, distance)| Some((points.get(index)?, distance)));
        marks.extend(farthest.map(|(point, distance)| Mark::Extreme {
            at: seen(*point),
            text: format!("largest distance {}", significant(distance, 4)),
        }));
        marks
    }

    /// What a click on a point would do, with its number and distance.
    pub(in crate::editor) fn point_hover(
        &self,
        viewport: &Viewport,
        index: usize,
    ) -> Option<HoverScene> {
        let point = self.input.points().get(index)?;
        let mut lines = vec![format!("Point {index}")];
        let distance = self.points.nearest.get(index);
        lines.extend(distance.map(|it| format!("distance {}", significant(it.distance, 4))));
        let does = match (
            fit::counts(&self.input, index),
            self.points.leaves_out(index),
        ) {
            (false, _) => "Weight 0: does not count",
            (true, false) => "Click leaves it out",
            (true, true) => "Left out: click takes it back",
        };
        lines.push(does.to_owned());
        Some(HoverScene::Handle {
            at: viewport.flatten(*point),
            text: lines.join("\n"),
        })
    }

    fn fits_points(&self) -> bool {
        *self.operation == fit::OPERATION
    }
}

impl Operating<'_> {
    /// Leave a point out, or take it back: one change of values. A point of weight 0 stays as it is.
    pub(super) fn switch_point(&mut self, index: usize) {
        let Some(current) = self.current().filter(|it| fit::counts(&it.input, index)) else {
            return;
        };
        let given = fit::with_point_switched(&current.input, &current.values, index);
        self.keep_values();
        let set = given.and_then(|given| self.set_values(&[given]));
        if let Err(error) = set {
            *self.message = Message::of(&Err(Refusal(error.to_string())));
        }
    }

    /// Whether the operation fits points that are all in sight.
    pub(super) fn sees_points(&self) -> bool {
        let (viewport, view) = (&self.view.pane.viewport, self.view.pane.viewport.view_box());
        self.current().is_some_and(|current| {
            let mut points = current.input.points().iter();
            current.fits_points() && points.all(|point| view.holds(viewport.flatten(*point)))
        })
    }

    /// Measure how far the points are from the curves that are shown.
    pub(super) fn measure_points(&mut self) {
        let Some(current) = self.current().filter(|it| it.fits_points()) else {
            return;
        };
        let document = self.workspace.document();
        let made = current.made_curves(document).into_iter();
        let curves: Vec<Arc<Curve>> = made.filter_map(|id| document.curve(id).cloned()).collect();
        // Points of a piece that has no curve yet have no distance.
        let curves = match curves.len() < current.points.curves {
            true => Vec::new(),
            false => curves,
        };
        let points = current.input.points().to_vec();
        let job = move |progress: &Progress| nearest(&points, &curves, progress);
        if let Some(current) = self.current_mut() {
            current.points.nearest.clear();
        }
        let measuring = &mut self.operations.measuring;
        measuring.start((), job, Some(self.patience));
        self.take_distances();
    }

    /// Take the distances of the points once they are measured.
    pub(super) fn take_distances(&mut self) {
        if let Some(nearest) = self.operations.measuring.take_result()
            && let Some(current) = self.current_mut()
        {
            current.points.nearest = nearest;
        }
    }
}
