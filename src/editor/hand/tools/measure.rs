//! Measure a distance, its direction and, between two points of a curve, the arc length.

use glam::{DVec2, DVec3};

use super::measured::{Measurement, Place, plotted_figures, reach, ruler};
use super::tool::{Context, Effect, Tool};
use crate::document::MatchPlace;
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{along_axis, snap_to_grid};
use crate::editor::view::scene::{Mark, MeasuredFigure};
use crate::geometry::{End, significant};

/// The digits of figures, and of those that are found to plotting accuracy.
const DIGITS: usize = 8;
const PLOTTED_DIGITS: usize = 5;

/// The measure tool's state: the first point once it is set, while the second follows the pointer. A
/// finished measurement outlives the tool, in its settings.
#[derive(Debug, Default)]
pub struct MeasureTool {
    from: Option<Place>,
    /// Where the drag began that set the first point.
    dragged: Option<DVec2>,
}

impl Place {
    /// A point, with all curves on which it lies.
    fn new(point: DVec3, context: &Context) -> Self {
        let reach = reach(point);
        let curves = context.hits.curves().filter_map(|(id, curve)| {
            let nearest = curve.polygon.nearest(point);
            (nearest.distance <= reach).then_some((id, nearest.u))
        });
        let references = context.document.references();
        let references = references.filter(|(_, it)| it.visible);
        let ends = references.flat_map(|(id, reference)| {
            let ends = [(End::Start, 0.0), (End::Finish, f64::INFINITY)];
            ends.into_iter().filter_map(move |(end, u)| {
                let jet = MatchPlace::End(end).jet(&reference.curve)?;
                let pieces = context.document.shape(id)?.pieces() as f64;
                (jet.point == point).then_some((id, f64::min(u, pieces)))
            })
        });
        let on = curves.chain(ends).collect();
        Self { point, on }
    }
}

impl MeasureTool {
    /// What is meant by a place of the view plane: a vertex or an end, otherwise a point of a curve or the edge of a
    /// picture, otherwise the grid if snapping is on, otherwise the point on the ground. Ctrl lets nothing attract.
    fn place(&self, at: DVec2, context: &Context) -> Place {
        let view = context.viewport;
        if let Some(from) = self.from.as_ref().filter(|_| context.modifiers.shift) {
            let snap = context
                .measured_snap(at)
                .filter(|_| !context.modifiers.ctrl);
            let at = snap.map_or(at, |snap| view.flatten(snap.point));
            let by = along_axis(at - view.flatten(from.point));
            return Place::new(from.point + view.movement(by, true), context);
        }
        let free = |point| Place {
            point,
            on: Vec::new(),
        };
        if context.modifiers.ctrl {
            return free(view.grounded(at));
        }
        if let Some(snap) = context.measured_snap(at) {
            return Place::new(snap.point, context);
        }
        let hit = context.hits.curve(view.to_screen(at));
        let curve = hit.and_then(|hit| Some((hit, context.document.shape(hit.curve)?)));
        if let Some((hit, curve)) = curve {
            return Place {
                point: curve.jet(hit.u).point,
                on: vec![(hit.curve, hit.u)],
            };
        }
        let grid = snap_to_grid(at, view).filter(|_| context.snapping);
        free(grid.map_or_else(|| view.grounded(at), |snap| snap.point))
    }

    /// The measurement while the second point follows the pointer.
    fn figures(&self, context: &Context) -> Option<([DVec3; 2], Vec<MeasuredFigure>)> {
        let from = self.from.as_ref()?;
        let to = self.place(context.pointer?, context);
        let figures = plotted_figures(from, &to, context.hits);
        Some(([from.point, to.point], figures))
    }

    /// Set the first point, by a click or where a drag begins. The measurement before goes.
    fn begin(&mut self, place: DVec2, dragged: Option<DVec2>, context: &Context) -> Vec<Effect> {
        self.from = Some(self.place(context.model(place), context));
        self.dragged = dragged;
        vec![measured(None, context)]
    }
}

/// Keep a measurement, or none.
fn measured(measurement: Option<Measurement>, context: &Context) -> Effect {
    context.set(|settings| settings.measurement = measurement)
}

/// Say figures in full, in one line.
fn told(figures: &[MeasuredFigure]) -> String {
    let text = |figure: &MeasuredFigure| {
        let digits = if figure.is_about {
            PLOTTED_DIGITS
        } else {
            DIGITS
        };
        figure.text(|value| significant(value, digits))
    };
    figures
        .iter()
        .map(text)
        .collect::<Vec<String>>()
        .join("   ")
}

impl Tool for MeasureTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let has_measured = context.settings.measurement.is_some();
        match (self.from.take(), gesture) {
            // A hasty click is a short drag: it sets one point, as a click does.
            (Some(from), Gesture::DragEnd(place))
                if (self.dragged.take()).is_some_and(|origin| is_hasty_click(origin, place)) =>
            {
                self.from = Some(from);
            }
            (Some(from), Gesture::Click(place) | Gesture::DragEnd(place)) => {
                self.from = Some(from);
                let to = self.place(context.model(place), context);
                let active = context.selection.active();
                let between = |from| Measurement::between(&from, &to, context.document, active);
                return vec![measured(self.from.take().map(between), context)];
            }
            (None, Gesture::Click(place)) => return self.begin(place, None, context),
            (None, Gesture::DragStart(place)) => return self.begin(place, Some(place), context),
            (None, Gesture::Key(Key::Escape)) if has_measured => {
                return vec![measured(None, context)];
            }
            (None, Gesture::Key(Key::Escape)) => return vec![Effect::Finish],
            (_, Gesture::Key(Key::Escape) | Gesture::Cancel) => {}
            // The second point is where the drag ends.
            (from, _) => self.from = from,
        }
        Vec::new()
    }

    fn hint(&self, context: &Context) -> String {
        let measurement = context.settings.measurement.as_ref();
        match (self.figures(context), measurement) {
            (Some((_, figures)), _) => format!("{}   Shift locks to an axis", told(&figures)),
            (None, Some(measurement)) => {
                let figures = measurement.figures(context.hits);
                format!("{}   Esc removes it", told(&figures))
            }
            _ => "Click two points, or drag, to measure between them; Esc ends".into(),
        }
    }

    fn undo_label(&self) -> Option<&'static str> {
        self.from.is_some().then_some("first point")
    }

    fn undo(&mut self) {
        self.from = None;
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let snapped = || {
            let at = context.pointer?;
            let place = context.viewport.flatten(self.place(at, context).point);
            (place != at).then_some(Mark::Snap(place))
        };
        let figures = self.figures(context);
        let ruler = figures.map(|(points, figures)| ruler(points, figures, context.hits));
        let stays = self.from.is_none() && context.settings.measurement.is_some();
        let snap = (!stays).then(snapped).flatten();
        ruler.into_iter().flatten().chain(snap).collect()
    }
}
