//! Entries typed on the canvas for the tool in use, and the leg that a tool draws.

use glam::DVec2;

use crate::document::CurveId;
use crate::editor::hand::drawing_plane::{Leg, LegLocks};
use crate::editor::hand::hand::Hand;
use crate::editor::hand::tools::{
    Context, DrawSettings, Entry, ToolKind, Transformation, drawn_degree, pivot,
};
use crate::editor::hand::typed_point::{EntryError, read_number};
use crate::editor::view::Look;
use crate::editor::view::viewport::Viewport;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;
use crate::geometry::{FloatPolygon, MAX_DEGREE};

impl Hand {
    /// The entry that the tool in use takes on the canvas.
    pub fn entry(&self, viewport: &Viewport) -> Option<Entry> {
        self.tools.used().entry(viewport)
    }

    /// Whether the tool in use sets vertices.
    fn sets_vertices(&self) -> bool {
        matches!(self.entry(&Viewport::default()), Some(Entry::Point(_)))
    }

    /// Read a typed rotation or scaling.
    pub(in crate::editor) fn typed_transformation(
        &self,
        text: &str,
        unit: Option<LengthUnit>,
    ) -> Result<Transformation, EntryError> {
        match self.tool() {
            ToolKind::Rotate => {
                let angle = read_number(text, Quantity::Angle, unit)?;
                Ok(Transformation::Rotate(angle.to_radians()))
            }
            _ => {
                let factor = read_number(text, Quantity::Number, unit)?;
                Ok(Transformation::Scale(factor))
            }
        }
    }

    /// Find the leg that a tool draws, to the typed point or to the pointer.
    pub fn leg(&self, context: &Context) -> Option<Leg> {
        let (from, to) = self.tools.used().leg(context);
        Some(Leg::between(from?, to?, &context.drawing_plane()))
    }

    /// Let the view follow a typed point. In an empty document the first two points of a drawing set the size of the
    /// view.
    pub(in crate::editor) fn look_at_typed(&self, context: &Context) -> Option<Look> {
        let tool = self.tools.used();
        let (_, point) = tool.leg(context);
        let point = point.filter(|_| self.typed.is_some())?;
        Some(match tool.drawn() {
            [] if context.document.is_empty() => Look::Begin(vec![point]),
            [first] if context.document.is_empty() => Look::Begin(vec![*first, point]),
            _ => Look::Include(point),
        })
    }

    /// Select a curve or a reference beside others, or take it back.
    pub fn toggle_item(&mut self, item: CurveId) {
        self.selection.toggle_item(item);
    }

    /// Select just these curves and references.
    pub fn select_items(&mut self, items: impl IntoIterator<Item = CurveId>) {
        self.selection.set_items(items);
    }

    /// The locked length and angle of the leg, while a tool sets vertices.
    pub fn leg_locks(&self) -> Option<LegLocks> {
        self.sets_vertices().then_some(self.settings.locks)
    }

    /// Lock the length of the leg, a positive number, its angle, or none.
    pub fn lock_leg(&mut self, locks: LegLocks) {
        let is_usable = |length: &f64| *length > 0.0 && length.is_finite();
        let locks = LegLocks {
            length: locks.length.filter(is_usable),
            degrees: locks.degrees.filter(|degrees| degrees.is_finite()),
        };
        if self.sets_vertices() {
            self.settings.locks = locks;
        }
    }

    /// The settings of the draw tool.
    pub fn draw_settings(&self) -> DrawSettings {
        self.settings.draw
    }

    /// Change the settings of the draw tool. The degree is kept within what there is.
    pub fn set_draw_settings(&mut self, settings: DrawSettings) {
        let degree = settings.degree.map(|degree| degree.clamp(1, MAX_DEGREE));
        self.settings.draw = DrawSettings { degree, ..settings };
    }

    /// The degree of the curve that a tool draws, or adds vertices to.
    pub fn drawn_degree(&self, context: &Context) -> Option<usize> {
        if self.tool() == ToolKind::Draw {
            return Some(drawn_degree(context));
        }
        if !self.sets_vertices() {
            return None;
        }
        let proposed = self.proposal(context).map(|polygon| polygon.degree());
        let active = || {
            let active = context.document.curve(self.selection.active()?)?;
            Some(active.polygon.degree())
        };
        proposed.or_else(active)
    }

    /// The degree of the curve that a click would make now, where too few vertices lower it.
    pub fn degree_so_far(&self, context: &Context) -> Option<usize> {
        let degree = self.proposal(context)?.degree();
        (Some(degree) != self.drawn_degree(context)).then_some(degree)
    }

    /// The polygon that a click would make now.
    pub(in crate::editor) fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        if self.gestures.is_panning() || self.gestures.is_orbiting() {
            return None;
        }
        self.tools.used().proposal(context)
    }

    /// The pivot of the rotate or scale tool in use, in the view plane.
    pub fn pivot(&self, context: &Context) -> Option<DVec2> {
        self.transforms().then(|| pivot(context)).flatten()
    }

    /// Put the pivot somewhere, or let it follow the selection again.
    pub fn set_pivot(&mut self, pivot: Option<DVec2>) {
        if self.transforms() && pivot.is_none_or(|pivot| pivot.is_finite()) {
            self.settings.pivot = pivot;
        }
    }

    /// Let the pivot follow the selection again, as where the view is turned: it lies in the view plane.
    pub(in crate::editor) fn forget_pivot(&mut self) {
        self.settings.pivot = None;
        self.settings.turned = None;
    }

    fn transforms(&self) -> bool {
        matches!(self.tool(), ToolKind::Rotate | ToolKind::Scale)
    }
}
