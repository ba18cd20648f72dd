//! Asking for menus: a click with the second button selects what the menu is about, the menu key takes what is selected.

use glam::DVec2;

use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::hand::menu_request::{MenuRequest, MenuSubject};
use crate::editor::selection::VertexId;
use crate::editor::view::hit::REACH;
use crate::geometry::End;

/// How near to a leg a click must be to be about it, in screen points.
const LEG_REACH: f64 = 0.5 * REACH;

impl Editor {
    /// Ask for a menu about what lies at a place on the canvas. What is not selected is selected first.
    pub(in crate::editor) fn ask_for_menu_at(&mut self, at: DVec2) {
        if self.previewed_operation().is_some() {
            return;
        }
        self.view.analyse(self.workspace.document());
        let subject = self.select_at(at);
        self.ask_for_menu(subject);
    }

    /// Ask for a menu at the pointer.
    pub fn ask_for_menu(&mut self, subject: MenuSubject) {
        self.hand.menu = Some(MenuRequest { subject, at: None });
    }

    /// Ask for a menu about a row of the list of curves, which becomes active.
    pub fn ask_for_menu_of(&mut self, id: CurveId) {
        self.activate(id);
        let subject = self.item(id);
        self.ask_for_menu(subject);
    }

    /// Ask for a menu about what is selected, beside it: the menu key.
    pub fn ask_for_menu_of_selection(&mut self) {
        if self.previewed_operation().is_some() {
            return;
        }
        let viewport = self.view.viewport;
        let vertex = self.hand.selection.vertices().next();
        let (subject, place) = match (vertex, self.active()) {
            (Some((curve, index)), _) => {
                let curve = self.document().curve(curve);
                let vertex = curve.and_then(|curve| curve.polygon.vertices().get(index));
                (MenuSubject::Vertex, vertex.copied())
            }
            (None, Some(active)) => {
                let shape = self.document().shape(active);
                let middle = shape.map(|shape| shape.jet(0.5 * shape.pieces() as f64).point);
                (self.item(active), middle)
            }
            (None, None) => (MenuSubject::Canvas, None),
        };
        let size = viewport.size;
        let seen = place.map(|place| viewport.to_screen(viewport.flatten(place)));
        let seen = seen.filter(|at| at.is_finite());
        let at = seen.map_or(0.5 * size, |at| at.clamp(DVec2::ZERO, size));
        self.hand.menu = Some(MenuRequest {
            subject,
            at: Some(at),
        });
    }

    /// Take the menu that is asked for, to show it.
    pub fn take_menu(&mut self) -> Option<MenuRequest> {
        self.hand.menu.take()
    }

    fn item(&self, id: CurveId) -> MenuSubject {
        match self.document().reference(id) {
            Some(_) => MenuSubject::Reference,
            None => MenuSubject::Curve,
        }
    }

    /// Select what lies at a place unless it is selected, and tell what it is.
    fn select_at(&mut self, at: DVec2) -> MenuSubject {
        let hits = self.context().hits;
        if let Some(vertex) = hits.vertex(at) {
            self.select_for_menu(&[vertex]);
            return MenuSubject::Vertex;
        }
        if let Some((curve, end)) = self.end_at(at) {
            self.activate(curve);
            self.hand.tools.end_fit.settings.end = end;
            return MenuSubject::End;
        }
        if let Some(leg) = hits.leg(at, LEG_REACH) {
            let curve = self.document().curve(leg.curve);
            let count = curve.map_or(1, |curve| curve.polygon.vertices().len());
            let ends = [leg.index, (leg.index + 1) % count];
            self.select_for_menu(&ends.map(|index| (leg.curve, index)));
            return MenuSubject::Leg;
        }
        let clamped = hits.clamped_vertex(at).map(|(curve, _)| curve);
        let Some(hit) = clamped.or(hits.curve(at).map(|hit| hit.curve)) else {
            return MenuSubject::Canvas;
        };
        self.activate(hit);
        self.item(hit)
    }

    /// Select vertices of a curve, which becomes active, unless all of them are selected.
    fn select_for_menu(&mut self, vertices: &[VertexId]) {
        let selection = &mut self.hand.selection;
        if !vertices.iter().all(|vertex| selection.contains(*vertex)) {
            selection.set(vertices.iter().copied());
        }
        if let Some((curve, _)) = vertices.first() {
            selection.activate(*curve);
        }
        self.document_changed();
        self.operating().leave_stale();
    }

    /// The end of an open curve that is seen at a place; the nearest of several.
    fn end_at(&self, at: DVec2) -> Option<(CurveId, End)> {
        let hits = self.context().hits;
        let viewport = &self.view.viewport;
        let open = hits
            .curves()
            .filter(|(_, curve)| !curve.polygon.is_periodic());
        let ends = open.flat_map(|(id, curve)| {
            End::BOTH.map(|end| {
                let place = curve.polygon.end_jet(end).point;
                let seen = viewport.to_screen(viewport.flatten(place));
                (seen.distance(at), (id, end))
            })
        });
        let near = ends.filter(|(distance, _)| *distance <= REACH);
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, end)| end)
    }
}
