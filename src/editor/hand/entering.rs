//! What can be typed on the canvas while a tool is in use, and the leg that a tool draws.

use glam::DVec2;

use crate::editor::hand::drawing_plane::{DrawingPlane, Leg, LegLocks};
use crate::editor::hand::hand::Hand;
use crate::editor::hand::tools::{Context, DrawSettings, ToolKind, Transformation};
use crate::editor::hand::typed_point::{EntryError, read_number};
use crate::editor::view::viewport::Viewport;
use crate::geometry::FloatPolygon;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;

/// What the tool in use takes from the keyboard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A point, by the names of the two axes that it is drawn along.
    Point([&'static str; 2]),
    /// An angle in degrees.
    Angle,
    /// A factor.
    Factor,
}

impl Hand {
    /// Find what can be typed on the canvas with the tool in use.
    pub fn entry(&self, viewport: &Viewport) -> Option<Entry> {
        match self.tool() {
            ToolKind::Draw | ToolKind::AddVertex | ToolKind::Insert => {
                Some(Entry::Point(DrawingPlane::of(viewport).names()))
            }
            ToolKind::Rotate => Some(Entry::Angle),
            ToolKind::Scale => Some(Entry::Factor),
            _ => None,
        }
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
        let (from, to) = self.tools.drawing()?.leg(context);
        Some(Leg::between(from?, to?, &context.drawing_plane()))
    }

    /// The locked length and angle of the leg, while a tool sets vertices.
    pub fn leg_locks(&self) -> Option<LegLocks> {
        Some(self.tools.drawing()?.locks())
    }

    /// Lock the length of the leg, a positive number, its angle, or none.
    pub fn lock_leg(&mut self, locks: LegLocks) {
        let is_usable = |length: &f64| *length > 0.0 && length.is_finite();
        let locks = LegLocks {
            length: locks.length.filter(is_usable),
            degrees: locks.degrees.filter(|degrees| degrees.is_finite()),
        };
        if let Some(tool) = self.tools.drawing_mut() {
            tool.set_locks(locks);
        }
    }

    /// The settings of the draw tool, while it is in use.
    pub fn draw_settings(&self) -> Option<DrawSettings> {
        Some(self.tools.draw()?.settings())
    }

    /// Change the settings of the draw tool.
    pub fn set_draw_settings(&mut self, settings: DrawSettings) {
        if let Some(tool) = self.tools.draw_mut() {
            tool.set_settings(settings);
        }
    }

    /// The degree of the curve that a tool draws, or adds vertices to.
    pub fn drawn_degree(&self, context: &Context) -> Option<usize> {
        if let Some(tool) = self.tools.draw() {
            return Some(tool.degree(context));
        }
        self.tools.drawing()?;
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
        self.tools.drawing()?.proposal(context)
    }

    /// The pivot of the rotate or scale tool in use, in the view plane.
    pub fn pivot(&self, context: &Context) -> Option<DVec2> {
        self.tools.transform()?.pivot(context)
    }

    /// Put the pivot somewhere, or let it follow the selection again.
    pub fn set_pivot(&mut self, pivot: Option<DVec2>) {
        if let Some(tool) = self.tools.transform_mut()
            && pivot.is_none_or(|pivot| pivot.is_finite())
        {
            tool.set_pivot(pivot);
        }
    }
}
