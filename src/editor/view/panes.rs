//! The panes of the canvas: one, two or four views of the model at once.

use std::cmp::Ordering;

use glam::DVec2;

use crate::editor::view::pane::Pane;
use crate::editor::view::pane_layout::PaneLayout;
use crate::editor::view::scene::Scene;
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;
use crate::editor::view::viewport::Viewport;

/// One pane as it is painted.
#[derive(Clone, Copy, Debug)]
pub struct PaneView<'a> {
    /// Its upper left corner on the canvas, in screen points.
    pub corner: DVec2,
    /// How it sees the model.
    pub viewport: &'a Viewport,
    /// What it shows.
    pub scene: &'a Scene,
    /// Whether the hand is in it, or was last.
    pub is_used: bool,
}

impl View {
    /// How the panes of the canvas lie.
    pub fn pane_layout(&self) -> PaneLayout {
        self.layout
    }

    /// The panes, row by row.
    pub fn panes(&self) -> impl Iterator<Item = PaneView<'_>> {
        let boxes = self.layout.boxes(self.canvas).into_iter();
        let panes = boxes.zip(self.panes_in_order()).enumerate();
        panes.map(|(place, ([corner, _], pane))| PaneView {
            corner,
            viewport: &pane.viewport,
            scene: &pane.scene,
            is_used: place == self.used,
        })
    }

    pub(super) fn panes_in_order(&self) -> impl Iterator<Item = &Pane> {
        let (before, after) = self.other_panes.split_at(self.used);
        before.iter().chain([&self.pane]).chain(after)
    }

    pub(super) fn pane_mut(&mut self, place: usize) -> Option<&mut Pane> {
        match place.cmp(&self.used) {
            Ordering::Less => self.other_panes.get_mut(place),
            Ordering::Equal => Some(&mut self.pane),
            Ordering::Greater => self.other_panes.get_mut(place - 1),
        }
    }

    /// The upper left corner of the pane in use, in screen points of the canvas.
    pub(in crate::editor) fn pane_corner(&self) -> DVec2 {
        let boxes = self.layout.boxes(self.canvas);
        boxes.get(self.used).map_or(DVec2::ZERO, |it| it[0])
    }

    /// Use the pane at a place on the canvas, the nearest one in a gap. With `stays` it is the one that counts while the
    /// pointer is elsewhere.
    pub(in crate::editor) fn use_pane_at(&mut self, at: DVec2, stays: bool) {
        let boxes = self.layout.boxes(self.canvas).into_iter();
        let away = |[corner, size]: [DVec2; 2]| at.distance(at.clamp(corner, corner + size));
        let distances = boxes.map(away).enumerate();
        if let Some((place, _)) = distances.min_by(|a, b| a.1.total_cmp(&b.1)) {
            self.use_pane(place);
        }
        if stays {
            self.chosen_pane = self.used;
        }
    }

    /// Use the pane that was last pressed or zoomed: the pointer has left the canvas.
    pub(in crate::editor) fn use_chosen_pane(&mut self) {
        self.use_pane(self.chosen_pane);
    }

    fn use_pane(&mut self, place: usize) {
        if place != self.used && place <= self.other_panes.len() {
            let before = std::mem::take(&mut self.pane);
            self.other_panes.insert(self.used, before);
            self.pane = self.other_panes.remove(place);
            self.used = place;
        }
    }

    /// Do something with each pane in turn as if it were in use, with the one in use last.
    pub(in crate::editor) fn each_pane(&mut self, mut change: impl FnMut(&mut Self)) {
        self.each_other_pane(&mut change);
        change(self);
    }

    /// Do something with each pane but the one in use, as if it were in use.
    pub(in crate::editor) fn each_other_pane(&mut self, mut change: impl FnMut(&mut Self)) {
        let used = self.used;
        for place in (0..=self.other_panes.len()).filter(|place| *place != used) {
            self.use_pane(place);
            change(self);
        }
        self.use_pane(used);
    }

    /// Lay the panes out anew. A view that the new layout has too stays; the others show everything.
    pub(in crate::editor) fn lay_out(&mut self, layout: PaneLayout, shown: Shown<'_>) {
        if layout == self.layout {
            return;
        }
        let (viewport, target) = (self.pane.viewport, self.pane.target);
        let mut present = Some(std::mem::take(&mut self.pane));
        let orientations = layout.orientations(viewport.orientation);
        let place = orientations
            .iter()
            .position(|it| *it == viewport.orientation);
        let panes = orientations
            .into_iter()
            .enumerate()
            .map(|(at, orientation)| {
                let kept = present.take_if(|_| Some(at) == place);
                kept.unwrap_or_else(|| {
                    let viewport = Viewport {
                        orientation,
                        ..viewport
                    };
                    // As if it had shown everything: it does once it has its size.
                    let fitted = Some((viewport, shown.workspace.revision()));
                    Pane {
                        viewport,
                        target,
                        fitted,
                        ..Pane::default()
                    }
                })
            });
        self.other_panes = panes.collect();
        self.used = place.unwrap_or(0);
        self.chosen_pane = self.used;
        self.pane = self.other_panes.remove(self.used);
        self.layout = layout;
        self.size_panes(shown);
    }

    /// Give each pane its part of the canvas.
    pub(super) fn size_panes(&mut self, shown: Shown<'_>) {
        let boxes = self.layout.boxes(self.canvas);
        self.each_pane(|view| {
            if let Some([_, size]) = boxes.get(view.used) {
                view.set_pane_size(*size, shown);
            }
        });
        self.even_scales(shown);
    }
}
