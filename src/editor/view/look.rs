//! The changes of the view that commands, tools and panels request.

use glam::{DVec2, DVec3};

use crate::document::{CurveId, MatchPlace};
use crate::editor::view::comb::CombSettings;
use crate::editor::view::fitting::middle;
use crate::editor::view::layers::Layer;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::Bounds;
use crate::editor::view::pane_layout::PaneLayout;
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;

/// How much of a segment is shown around a feature, on either side.
const SURROUNDINGS: f64 = 0.6;

/// How much room there is around the first points of a drawing, in units of their extent.
const ROOM: f64 = 1.0;

/// Radians that the view turns by for each screen point of a drag.
const TURN: f64 = 0.008;

/// A change of the view. What shows a part of the model shows it in every pane; a pane turns alone.
#[derive(Clone, Debug, PartialEq)]
pub enum Look {
    /// Fit everything into the canvas, and give the comb a legible scale.
    All,
    /// Fit the first points of a drawing, with room for more.
    Begin(Vec<DVec3>),
    /// Zoom out until a point is in sight.
    Include(DVec3),
    /// Fit the selected vertices, or the active curve where fewer than two are selected.
    Selection,
    /// Fit everything where one of these new curves is out of sight; fit them alone where they would be a
    /// speck.
    New(Vec<CurveId>),
    /// Draw the comb differently.
    Comb(CombSettings),
    /// Give the comb a legible scale.
    ResetComb,
    /// Give the comb a legible scale unless it has one.
    SuitComb,
    /// Show the surroundings of a parameter of the active curve or reference, and the layer of its features.
    Around(f64),
    /// Show the surroundings of a joint of curves, by its place in the list.
    Joint(usize),
    /// Choose a feature of the active curve by the middle of its interval: the canvas shows the shortest
    /// moves that lose it, until the curve changes. A feature that is chosen already is no longer.
    Feature(f64),
    /// Turn the view to an orientation; the middle of the curves stays in place.
    From(Orientation),
    /// Turn the view by a drag of some screen points.
    Orbit(DVec2),
    /// The size of the canvas in screen points. A view that shows everything is fitted again, unless the hand
    /// holds something; otherwise the middle of the view stays where it is.
    Canvas(DVec2),
    /// Show the model in so many panes.
    Panes(PaneLayout),
}

impl View {
    /// Change the view.
    pub(in crate::editor) fn look(&mut self, look: Look, shown: Shown<'_>) {
        match look {
            Look::All => self.fit_all(shown),
            Look::Begin(points) => self.each_pane(|view| view.begin_at(&points)),
            Look::Include(point) => self.each_pane(|view| view.include(point)),
            Look::Selection => self.fit_selection(shown),
            Look::New(curves) => self.each_pane(|view| view.bring_into_sight(&curves, shown)),
            Look::Comb(comb) => self.set_comb(comb),
            Look::ResetComb => self.reset_comb(shown),
            Look::SuitComb => self.suit_comb(shown),
            Look::Around(u) => self.look_around(u, shown),
            Look::Joint(index) => self.look_at_joint(index, shown),
            Look::Feature(u) => self.choose_feature(u, shown),
            Look::From(orientation) => self.look_from(orientation, shown),
            Look::Orbit(by) if by.is_finite() => {
                let turned = self
                    .pane
                    .viewport
                    .orientation
                    .orbited(TURN * by.x, TURN * by.y);
                self.look_from(turned, shown);
            }
            Look::Orbit(_) => {}
            Look::Canvas(size) => self.set_canvas_size(size, shown),
            Look::Panes(layout) => self.lay_out(layout, shown),
        }
    }

    fn begin_at(&mut self, points: &[DVec3]) {
        let mut bounds = Bounds::EMPTY;
        for point in points {
            bounds.add(self.pane.viewport.flatten(*point));
        }
        self.pane.viewport = self.pane.viewport.fitted(&bounds.grown(ROOM));
    }

    fn include(&mut self, point: DVec3) {
        let seen = self.pane.viewport.view_box();
        let at = self.pane.viewport.flatten(point);
        if at.is_finite() && at != at.clamp(seen.low, seen.high) {
            let mut bounds = Bounds::EMPTY;
            for corner in [seen.low, seen.high, at] {
                bounds.add(corner);
            }
            self.pane.viewport = self.pane.viewport.fitted(&bounds);
        }
    }

    fn look_around(&mut self, u: f64, shown: Shown<'_>) {
        let Some(curve) = shown.active().and_then(|id| shown.document().shape(id)) else {
            return;
        };
        let jet = curve.jet(u.clamp(0.0, curve.pieces() as f64));
        let reach = SURROUNDINGS * jet.speed();
        self.each_pane(|view| view.show_around(jet.point, reach));
        self.layers.set(Layer::Features, true);
        self.layers.set(Layer::Curve, true);
    }

    fn look_at_joint(&mut self, index: usize, shown: Shown<'_>) {
        let Some(joint) = self.joints.all().get(index).copied() else {
            return;
        };
        let speed = |(id, end)| {
            let shape = shown.document().shape(id)?;
            Some(MatchPlace::End(end).jet(shape)?.speed())
        };
        let speeds = joint.ends.into_iter().filter_map(speed);
        let reach = SURROUNDINGS * speeds.fold(joint.joint.gap, f64::max);
        self.each_pane(|view| view.show_around(joint.point, reach));
        self.layers.set(Layer::Joints, true);
    }

    fn show_around(&mut self, point: DVec3, reach: f64) {
        let at = self.pane.viewport.flatten(point);
        let mut bounds = Bounds::EMPTY;
        bounds.add(at - reach);
        bounds.add(at + reach);
        self.pane.viewport = self.pane.viewport.fitted(&bounds);
    }

    fn look_from(&mut self, orientation: Orientation, shown: Shown<'_>) {
        let pivot = middle(shown.document());
        self.pane.target = pivot;
        let before = self.pane.viewport.flatten(pivot);
        self.pane.viewport.orientation = orientation;
        self.pane.viewport.centre += self.pane.viewport.flatten(pivot) - before;
    }
}
