//! Context menus: a click with the second button selects what it hits, the menu key takes the selection.

use glam::{DVec2, DVec3};

use crate::document::{CurveId, Document};
use crate::editor::hand::hand::Hand;
use crate::editor::hand::menu_request::{MenuRequest, MenuSubject};
use crate::editor::hand::tools::Context;
use crate::editor::selection::VertexId;
use crate::editor::view::hit::REACH;
use crate::editor::view::viewport::Viewport;
use crate::geometry::End;

/// How near to a leg a click must be to hit it, in screen points.
const LEG_REACH: f64 = 0.5 * REACH;

/// How much nearer than a vertex an end must be to be hit instead, in screen points.
const BESIDE: f64 = 1.0;

/// The item that a click for a menu hits.
#[derive(Clone, Debug)]
pub(in crate::editor) struct MenuTarget {
    subject: MenuSubject,
    /// The curve or reference that becomes active.
    item: Option<CurveId>,
    /// The vertices that are selected, unless all of them are.
    vertices: Vec<VertexId>,
    end: Option<End>,
}

impl MenuTarget {
    fn new(subject: MenuSubject, item: Option<CurveId>) -> Self {
        Self {
            subject,
            item,
            vertices: Vec::new(),
            end: None,
        }
    }

    /// Find what lies at a place on the canvas: a vertex, an end, a leg, a curve or nothing.
    pub(in crate::editor) fn at(at: DVec2, context: &Context) -> Self {
        let (hits, document) = (context.hits, context.document);
        let vertex = hits.vertex(at);
        let end = end_at(at, context);
        // A vertex beside an end does not take its menu.
        let is_beside_end = |(curve, index): &VertexId| {
            let place = document.curve(*curve).map(|it| it.polygon.vertex(*index));
            let away = place.map(|place| distance(place, at, context.viewport));
            away.zip(end)
                .is_some_and(|(away, (end, _))| end + BESIDE < away)
        };
        if let Some(vertex) = vertex.filter(|vertex| !is_beside_end(vertex)) {
            return Self {
                vertices: vec![vertex],
                ..Self::new(MenuSubject::Vertex, None)
            };
        }
        if let Some((_, (curve, end))) = end {
            return Self {
                end: Some(end),
                ..Self::new(MenuSubject::End, Some(curve))
            };
        }
        if let Some(leg) = hits.leg(at, LEG_REACH) {
            let curve = document.curve(leg.curve);
            let count = curve.map_or(1, |curve| curve.polygon.vertices().len());
            let ends = [leg.index, (leg.index + 1) % count];
            return Self {
                vertices: ends.map(|index| (leg.curve, index)).into(),
                ..Self::new(MenuSubject::Leg, None)
            };
        }
        let clamped = hits.clamped_vertex(at).map(|(curve, _)| curve);
        match clamped.or(hits.curve(at).map(|hit| hit.curve)) {
            Some(hit) => Self::of_item(document, hit),
            None => Self::new(MenuSubject::Canvas, None),
        }
    }

    /// A whole curve or reference.
    pub(in crate::editor) fn of_item(document: &Document, id: CurveId) -> Self {
        let subject = match document.reference(id) {
            Some(_) => MenuSubject::Reference,
            None => MenuSubject::Curve,
        };
        Self::new(subject, Some(id))
    }

    /// The curve or reference that the menu makes active.
    pub(in crate::editor) fn item(&self) -> Option<CurveId> {
        self.item
    }
}

impl Hand {
    /// Ask for a menu at the pointer.
    pub fn ask_for_menu(&mut self, subject: MenuSubject) {
        self.menu = Some(MenuRequest { subject, at: None });
    }

    /// Take the requested menu, to show it.
    pub fn take_menu(&mut self) -> Option<MenuRequest> {
        self.menu.take()
    }

    /// Select the item that a click for a menu hits, unless it is selected, and ask for the menu.
    pub(in crate::editor) fn ask_for_menu_about(&mut self, target: MenuTarget) {
        let selection = &mut self.selection;
        let mut vertices = target.vertices.iter();
        if !vertices.all(|vertex| selection.contains(*vertex)) {
            selection.set(target.vertices.iter().copied());
        }
        if let Some((curve, _)) = target.vertices.first() {
            selection.focus(*curve);
        }
        if let Some(end) = target.end {
            self.settings.end_fit.end = end;
        }
        self.ask_for_menu(target.subject);
    }

    /// Ask for a menu about the selection, beside it: the menu key.
    pub(in crate::editor) fn ask_for_menu_of_selection(
        &mut self,
        document: &Document,
        viewport: &Viewport,
    ) {
        let vertex = self.selection.vertices().next();
        let (subject, place) = match (vertex, self.selection.active()) {
            (Some((curve, index)), _) => {
                let curve = document.curve(curve);
                let vertex = curve.and_then(|curve| curve.polygon.vertices().get(index));
                (MenuSubject::Vertex, vertex.copied())
            }
            (None, Some(active)) => {
                let shape = document.shape(active);
                let middle = shape.map(|shape| shape.jet(0.5 * shape.pieces() as f64).point);
                (MenuTarget::of_item(document, active).subject, middle)
            }
            (None, None) => (MenuSubject::Canvas, None),
        };
        let size = viewport.size;
        let seen = place.map(|place| viewport.to_screen(viewport.flatten(place)));
        let seen = seen.filter(|at| at.is_finite());
        let at = seen.map_or(0.5 * size, |at| at.clamp(DVec2::ZERO, size));
        self.menu = Some(MenuRequest {
            subject,
            at: Some(at),
        });
    }
}

/// How far a point is seen from a place on the canvas.
fn distance(point: DVec3, at: DVec2, viewport: &Viewport) -> f64 {
    viewport.to_screen(viewport.flatten(point)).distance(at)
}

/// The end of an open curve that is seen at a place, and how far from it: that of the active curve, or the nearest of
/// several.
fn end_at(at: DVec2, context: &Context) -> Option<(f64, (CurveId, End))> {
    let curves = context.hits.curves();
    let open = curves.filter(|(_, curve)| !curve.polygon.is_periodic());
    let ends = open.flat_map(|(id, curve)| {
        End::BOTH.map(|end| {
            let place = curve.polygon.end_jet(end).point;
            (distance(place, at, context.viewport), (id, end))
        })
    });
    let near = ends.filter(|(distance, _)| *distance <= REACH);
    let is_other = |(_, (id, _)): &(f64, (CurveId, End))| context.selection.active() != Some(*id);
    near.min_by(|a, b| {
        let by_activity = is_other(a).cmp(&is_other(b));
        by_activity.then(a.0.total_cmp(&b.0))
    })
}
