//! What every tool is: a state machine from gestures to effects.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::settings::ToolSettings;
use super::transformation::Transformation;
use crate::document::{Curve, CurveId, Document, Edit, quoted};
use crate::editor::hand::alignment::{self, Aligning};
use crate::editor::hand::drawing_plane::DrawingPlane;
use crate::editor::hand::following::{Followers, Following};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Modifiers;
use crate::editor::hand::snapping::{self, Carried, Snap, by_fifteen_degrees};
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::selection::{Selection, VertexId};
use crate::editor::view::Look;
use crate::editor::view::layers::Layer;
use crate::editor::view::scene::Mark;
use crate::editor::view::sight::Sight;
use crate::editor::view::viewport::Viewport;
use crate::geometry::FloatPolygon;

/// Distance of a label below the pointer, in screen points: the readout of a drag is above.
const LABEL_BELOW: f64 = 72.0;

/// The most names of items that a message lists.
const MOST_NAMES: usize = 3;

/// The state that a tool reads. A tool changes nothing itself: it returns [`Effect`]s.
pub struct Context<'a> {
    /// The document, a running gesture's preview included.
    pub document: &'a Document,
    /// The document as it was when the running gesture began.
    pub before: &'a Document,
    /// The selection.
    pub selection: &'a Selection,
    /// How the model is mapped to the canvas.
    pub viewport: &'a Viewport,
    /// Finds the item at a place.
    pub hits: Sight<'a>,
    /// The modifier keys that are held.
    pub modifiers: Modifiers,
    /// The axis of the model (0 x, 1 y, 2 z) whose key is held: drags keep to it.
    pub axis: Option<usize>,
    /// Whether snapping is on; Ctrl turns it round.
    pub snapping: bool,
    /// Whether alignment lines are left out of what attracts.
    pub ignores_lines: bool,
    /// Whether edges of pictures are left out of what attracts.
    pub ignores_edges: bool,
    /// How far an arrow key moves the selection.
    pub nudge_step: f64,
    /// How the neighbours of dragged vertices follow.
    pub following: Following,
    /// The features that the running drag adds, in words.
    pub added: Option<&'a str>,
    /// Why the running drag is held back, in words.
    pub held_back: Option<&'a str>,
    /// The settings of the tools.
    pub settings: &'a ToolSettings,
    /// Where the pointer is, in the view plane.
    pub pointer: Option<DVec2>,
    /// Where the pointer has rested on the canvas before a press.
    pub rested: Option<DVec2>,
    /// The point that is being typed, as far as the text is one.
    pub typed: Option<TypedPoint>,
}

/// A request of a tool to the editor.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Begin a gesture with this label.
    Begin(String),
    /// Show what these edits make of the document that the gesture began with.
    Preview(Vec<Edit>),
    /// End the gesture and keep it as one step.
    Commit,
    /// End the gesture and restore.
    Abort,
    /// Make edits as one step.
    Apply(String, Vec<Edit>),
    /// Select just these vertices.
    Select(Vec<VertexId>),
    /// Select these vertices too.
    SelectMore(Vec<VertexId>),
    /// Turn round whether a vertex is selected.
    ToggleSelected(VertexId),
    /// Select just these curves and references, with those of their vertices that are selected.
    SelectItems(Vec<CurveId>),
    /// Turn round whether a curve or a reference is selected.
    ToggleItem(CurveId),
    /// Make a curve or a reference the active one, of those that are selected or alone.
    Activate(CurveId),
    /// Change how the model is seen.
    Look(Look),
    /// Change the settings of the tools.
    Set(Box<ToolSettings>),
    /// Tell the user something.
    Say(String),
    /// Tell the user of something done that may not be wanted.
    Warn(String),
    /// Take the select tool.
    Finish,
}

impl Effect {
    /// Show what edits make, or say why they cannot be made.
    pub fn preview(edits: Result<Vec<Edit>, impl std::fmt::Display>) -> Self {
        match edits {
            Ok(edits) => Self::Preview(edits),
            Err(error) => Self::Say(error.to_string()),
        }
    }
}

/// A tool in the hand.
pub trait Tool: std::fmt::Debug + Send {
    /// Take a gesture, and return its effects.
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect>;

    /// Whether a gesture works on the vertices that it hits: then an open preview of an operation, which
    /// may number them otherwise, ends first.
    fn begins(&self, _gesture: Gesture, _context: &Context) -> bool {
        false
    }

    /// The hint for the status bar: what a click or drag does now, in a sentence.
    fn hint(&self, context: &Context) -> String;

    /// The marks that the tool draws.
    fn marks(&self, _context: &Context) -> Vec<Mark> {
        Vec::new()
    }

    /// The shape of the pointer while it rests here.
    fn cursor(&self, _context: &Context) -> Cursor {
        Cursor::Crosshair
    }

    /// What undo takes back before it takes back a step of the document: the last point of what
    /// is not finished.
    fn undo_label(&self) -> Option<&'static str> {
        None
    }

    /// Take back the last point of an unfinished drawing.
    fn undo(&mut self) {}

    /// What redo sets again before it redoes a step of the document.
    fn redo_label(&self) -> Option<&'static str> {
        None
    }

    /// Set the point again that undo took back.
    fn redo(&mut self) {}

    /// Which followers the wheel sets while something is dragged.
    fn wheel_turns(&self, _following: &Following) -> Option<Followers> {
        None
    }

    /// The entry that the tool takes on the canvas.
    fn entry(&self, _viewport: &Viewport) -> Option<Entry> {
        None
    }

    /// Show what a typed angle or factor does, or take that back. It takes the place of a drag.
    fn type_number(&mut self, _typed: Option<Transformation>, _context: &Context) -> Vec<Effect> {
        Vec::new()
    }

    /// Set the vertex that was typed.
    ///
    /// # Errors
    /// [`EntryError`] if it counts from a vertex that there is not, or nothing can be set there.
    fn enter(&mut self, _typed: TypedPoint, _: &Context) -> Result<Vec<Effect>, EntryError> {
        Ok(Vec::new())
    }

    /// The points that an unfinished drawing has so far.
    fn drawn(&self) -> &[DVec3] {
        &[]
    }

    /// The leg that is drawn: from the vertex before to the one that would be set now, at what is
    /// typed or at the pointer. The first is missing while there is none, the second while nothing
    /// says where it would be.
    fn leg(&self, _context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        (None, None)
    }

    /// The polygon that there would be if the vertex was set now; none while the document shows it
    /// already, or there is too little for one.
    fn proposal(&self, _context: &Context) -> Option<FloatPolygon> {
        None
    }
}

/// An entry on the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A point, by the names of the two axes that it is drawn along.
    Point([&'static str; 2]),
    /// An angle in degrees.
    Angle,
    /// A factor.
    Factor,
}

impl Entry {
    /// A point of the plane that is drawn in.
    pub(super) fn point(viewport: &Viewport) -> Self {
        Self::Point(DrawingPlane::of(viewport).names())
    }
}

/// A shape of the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cursor {
    /// The arrow.
    #[default]
    Default,
    /// An open hand: a press would push the view.
    Grab,
    /// A closed hand.
    Grabbing,
    /// A cross: a click sets a point.
    Crosshair,
    /// Four arrows: a drag moves the item here.
    Move,
    /// A pointing hand: a click switches the item here.
    Point,
}

impl Context<'_> {
    /// The movement in space of what is pushed by a vector of the view plane: along the axis
    /// whose key is held; otherwise within the view plane or, for a planar curve in a view turned
    /// against the model, within the curve's plane.
    pub fn movement(&self, by: DVec2, planar: bool) -> DVec3 {
        match self.axis {
            Some(axis) => self.viewport.movement_along(axis, by),
            None => self.viewport.movement(by, planar),
        }
    }

    /// The curves, of those that some vertices belong to, that lie in the plane z = 0.
    pub fn planar_curves(&self, vertices: &[(VertexId, DVec3)]) -> BTreeSet<CurveId> {
        let curves: BTreeSet<CurveId> = vertices.iter().map(|((curve, _), _)| *curve).collect();
        let is_planar = |id: &CurveId| {
            let curve = self.before.curve(*id);
            curve.is_some_and(|curve| curve.polygon.is_planar())
        };
        curves.into_iter().filter(is_planar).collect()
    }

    /// Keep an angle in radians to multiples of 15° while Shift is held.
    pub fn angle(&self, free: f64) -> f64 {
        match self.modifiers.shift {
            true => by_fifteen_degrees(free),
            false => free,
        }
    }

    /// Keep a factor to tenths, at `least` of them, while Shift is held.
    pub fn factor(&self, free: f64, least: f64) -> f64 {
        match self.modifiers.shift {
            true => (10.0 * free).round().max(least) / 10.0,
            false => free,
        }
    }

    /// Change the settings of the tools.
    pub fn set(&self, change: impl FnOnce(&mut ToolSettings)) -> Effect {
        let mut settings = self.settings.clone();
        change(&mut settings);
        Effect::Set(Box::new(settings))
    }

    /// Where the pointer is on the canvas.
    pub fn place(&self) -> Option<DVec2> {
        Some(self.viewport.to_screen(self.pointer?))
    }

    /// The plane in which clicks set points.
    pub fn drawing_plane(&self) -> DrawingPlane {
        DrawingPlane::of(self.viewport)
    }

    /// Map a place on the canvas to the view plane.
    pub fn model(&self, place: DVec2) -> DVec2 {
        self.viewport.to_model(place)
    }

    /// Let a place of the view plane snap, if snapping is on and something is near.
    pub fn snapped(&self, place: DVec2, carried: &Carried) -> DVec2 {
        let point = self.snapped_point(place, carried);
        point.map_or(place, |point| self.viewport.flatten(point))
    }

    /// The point of the model that a place of the view plane snaps to, if snapping is on and
    /// something is near.
    pub fn snapped_point(&self, place: DVec2, carried: &Carried) -> Option<DVec3> {
        self.snap(place, carried).map(|snap| snap.point)
    }

    /// The snap of a place of the view plane, if snapping is on and something is near.
    pub fn snap(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        let near = || {
            self.item_snap(place, carried)
                .or_else(|| self.on_line_or_grid(place, carried))
        };
        self.snaps().then(near).flatten()
    }

    /// The snap of a point that is drawn: as others, and where the curve passes its points to the edges of pictures,
    /// before alignment lines and the grid. Ctrl turns edges off.
    pub fn drawn_snap(&self, place: DVec2) -> Option<Snap> {
        let carried = Carried::default();
        let follows = self.settings.draw.way.passes_points();
        if !follows {
            return self.snap(place, &carried);
        }
        let item = || self.item_snap(place, &carried);
        let found = (self.snapping && !self.modifiers.ctrl).then(item).flatten();
        let found = found.or_else(|| self.edge_snap(place));
        found.or_else(|| self.snap(place, &carried))
    }

    /// What a measured place snaps to, whether snapping is on or not: points, and edges of pictures where no curve is.
    pub fn measured_snap(&self, place: DVec2) -> Option<Snap> {
        if self.modifiers.ctrl {
            return None;
        }
        let is_on_curve = self.hits.curve(self.viewport.to_screen(place)).is_some();
        let edge = || (!is_on_curve).then(|| self.edge_snap(place)).flatten();
        self.object_snap(place, &Carried::default()).or_else(edge)
    }

    /// The strongest edge of a picture near a place, unless edges are switched off.
    fn edge_snap(&self, place: DVec2) -> Option<Snap> {
        if self.ignores_edges || self.modifiers.ctrl {
            return None;
        }
        let edge = self.hits.picture_edge(place)?;
        let point = self.viewport.grounded(edge);
        Some(Snap::to(point, "Edge of picture"))
    }

    /// The point, the intersection or the place on a reference near a place of the view plane.
    fn item_snap(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        self.object_snap(place, carried)
            .or_else(|| self.on_reference(place, carried))
    }

    /// Whether snapping is on: Ctrl turns it round.
    pub fn snaps(&self) -> bool {
        self.snapping != self.modifiers.ctrl
    }

    /// The point or the intersection nearest to a place of the view plane, if one is near.
    pub fn object_snap(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        let point = snapping::snap_to_point(place, self.before, carried, self.viewport);
        let takes = |id| !carried.takes_along(id);
        let intersection = self
            .hits
            .intersection(self.viewport.to_screen(place), takes);
        let intersection = intersection.map(|point| Snap::to(point, "Intersection"));
        let distance = |snap: &Snap| self.viewport.flatten(snap.point).distance(place);
        let both = point.into_iter().chain(intersection);
        both.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// The alignment lines near a place, with the crossing of the grid on them; otherwise that of the grid.
    fn on_line_or_grid(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        let grid = self.on_grid(place, carried);
        let Some(lines) = self.lined_up(place, carried) else {
            return grid;
        };
        let grid = grid.filter(|grid| lines.is_on_line(self.viewport.flatten(grid.point)));
        Some(match grid {
            Some(grid) => Snap {
                point: grid.point,
                name: format!("{}, Grid", lines.name),
                ..lines
            },
            None => lines,
        })
    }

    /// The alignment lines near a place of the view plane, as far as they are on.
    fn lined_up(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        alignment::line_up(place, &self.aligning(carried))
    }

    /// The line of a direction that a dragged one snaps to near a place of it, if snapping is on.
    pub fn line_snap(&self, place: DVec2, along: DVec2, carried: &Carried) -> Option<Snap> {
        let line = || alignment::line_along(place, along, &self.aligning(carried));
        let grid = || snapping::snap_to_grid_line(place, along, self.viewport);
        self.snaps().then(|| line().or_else(grid)).flatten()
    }

    fn aligning<'b>(&'b self, carried: &'b Carried) -> Aligning<'b> {
        Aligning {
            document: self.before,
            active: self.selection.active(),
            carried,
            viewport: self.viewport,
            lines: !self.ignores_lines,
            guides: self.hits.layers().shows(Layer::Guides),
        }
    }

    /// The crossing of the grid near a place of the view plane, as far as what is carried along can lie on it.
    fn on_grid(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        let is_turned = self.viewport.orientation.axes().is_none();
        let grid = || snapping::snap_to_grid(place, self.viewport);
        (!(carried.is_off_ground && is_turned)).then(grid).flatten()
    }

    /// Mark and name the snap of a place of the view plane, if there is one.
    pub fn snap_marks(&self, place: DVec2, carried: &Carried) -> Vec<Mark> {
        let snap = self.snap(place, carried);
        let mut marks = Vec::new();
        if let Some(snap) = snap {
            marks.extend(snap.line_marks());
            marks.extend(named_snap(self.viewport.flatten(snap.point), snap.name));
        }
        marks
    }

    /// The point of a reference that is seen near a place of the view plane.
    fn on_reference(&self, place: DVec2, carried: &Carried) -> Option<Snap> {
        let place = self.viewport.to_screen(place);
        let hit = self.hits.reference(place, carried.item)?;
        let reference = self.document.reference(hit.curve)?;
        if reference.picture.is_some() {
            return None;
        }
        let point = self.document.shape(hit.curve)?.jet(hit.u).point;
        let name = snapping::reference_name(hit.curve, self.document);
        Some(Snap::to(point, name))
    }

    /// The vertices that a transformation takes: the selected ones that can be moved, or all of the selected curves if
    /// none is selected. What is hidden is left out, and of several curves those that cannot move as a whole.
    pub fn transformed(&self) -> Vec<(VertexId, DVec3)> {
        let mut taken = self.places(self.chosen());
        if self.selection.is_of_whole_items() {
            let items = self.selection.items().into_iter();
            let staying = items.filter(|id| self.reason_to_stay(*id).is_some());
            let staying: BTreeSet<CurveId> = staying.collect();
            taken.retain(|((curve, _), _)| !staying.contains(curve));
        }
        taken
    }

    /// Why a curve or a reference cannot move as a whole, in a word or two.
    fn reason_to_stay(&self, item: CurveId) -> Option<&'static str> {
        let curve = self.before.curve(item).map(|it| (it.visible, it.locked));
        let reference = self.before.reference(item);
        let state = curve.or_else(|| reference.map(|it| (it.visible, it.locked)));
        let locks = self.before.curve(item).map(|it| &it.locked_vertices);
        match state? {
            (false, _) => Some("hidden"),
            (true, true) => Some("locked"),
            (true, false) => locks
                .is_some_and(|locks| !locks.is_empty())
                .then_some("has locked vertices"),
        }
    }

    /// Name the selected curves and references that stay where they are, with the reasons.
    fn staying_items(&self) -> Option<String> {
        let items = self.selection.items().into_iter();
        let staying = items.filter_map(|id| {
            let name = quoted(self.before.name(id)?);
            Some(format!("{name} ({})", self.reason_to_stay(id)?))
        });
        let mut staying: Vec<String> = staying.collect();
        let more = staying.len().saturating_sub(MOST_NAMES);
        staying.truncate(MOST_NAMES);
        let named = staying.join(", ");
        match (staying.len(), more) {
            (0, _) => None,
            (1, 0) => Some(format!("{named} stays")),
            (_, 0) => Some(format!("{named} stay")),
            _ => Some(format!("{named} and {more} more stay")),
        }
    }

    /// Say how many of the vertices that a transformation or a drag of the selection would take stay where
    /// they are because they are locked, if any are; of several curves and references, which ones stay and why.
    pub fn staying(&self) -> Option<String> {
        if self.selection.is_of_whole_items() {
            return self.staying_items();
        }
        let is_visible = |(curve, _): &VertexId| {
            let curve = self.before.curve(*curve);
            curve.is_some_and(|curve| curve.visible)
        };
        let chosen: Vec<VertexId> = self.chosen().into_iter().filter(is_visible).collect();
        match chosen.len() - self.places(chosen.iter().copied()).len() {
            0 => None,
            1 => Some("1 locked vertex stays".to_owned()),
            count => Some(format!("{count} locked vertices stay")),
        }
    }

    /// The vertices that are selected, or all of the selected curves if none is.
    fn chosen(&self) -> Vec<VertexId> {
        if self.selection.is_empty() {
            let items = self.selection.items().into_iter();
            let curves = items.filter_map(|id| Some((id, self.before.curve(id)?)));
            let all = curves.flat_map(|(id, curve)| {
                (0..curve.polygon.vertices().len()).map(move |index| (id, index))
            });
            all.collect()
        } else {
            self.selection.vertices().collect()
        }
    }

    /// Look up where vertices were when the gesture began; locked ones and those of locked and of
    /// hidden curves are left out.
    pub fn places(&self, vertices: impl IntoIterator<Item = VertexId>) -> Vec<(VertexId, DVec3)> {
        let mut last: Option<(CurveId, Option<&Arc<Curve>>)> = None;
        let place = |(curve, index): VertexId| {
            // Vertices come curve by curve, and finding a curve takes time.
            let known = last.filter(|(id, _)| *id == curve);
            let (_, found) =
                *last.insert(known.unwrap_or_else(|| (curve, self.before.curve(curve))));
            let found = found?;
            found.check_editable().ok()?;
            found.check_vertices_unlocked([index]).ok()?;
            let vertex = found.polygon.vertices().get(index)?;
            Some(((curve, index), *vertex))
        };
        vertices.into_iter().filter_map(place).collect()
    }
}

/// Mark a place that something snapped to, with its name.
pub(super) fn named_snap(at: DVec2, name: String) -> [Mark; 2] {
    [Mark::Snap(at), Mark::Name(at, name)]
}

/// Say beside the pointer, below what is told of the place there, what a click would do.
pub(super) fn pointer_label(told: Option<String>, context: &Context) -> Option<Mark> {
    let (told, pointer) = told.zip(context.pointer)?;
    let below = DVec2::new(0.0, -LABEL_BELOW * context.viewport.pixel());
    Some(Mark::Label(pointer + below, told))
}

/// Turn moved vertices into edits, one a curve.
pub fn move_edits(moved: impl IntoIterator<Item = (VertexId, DVec3)>) -> Vec<Edit> {
    let mut edits: Vec<(CurveId, Vec<(usize, DVec3)>)> = Vec::new();
    for ((curve, index), place) in moved {
        match edits.iter_mut().rfind(|(other, _)| *other == curve) {
            Some((_, moves)) => moves.push((index, place)),
            None => edits.push((curve, vec![(index, place)])),
        }
    }
    let edit = |(curve, moves)| Edit::MoveVertices { curve, moves };
    edits.into_iter().map(edit).collect()
}
