//! What can be typed on the canvas while a tool is used, and the leg that is drawn.

use crate::editor::Editor;
use crate::editor::hand::drawing_plane::{DrawingPlane, Leg, LegLocks};
use crate::editor::hand::tools::{DrawSettings, ToolKind, Transformation};
use crate::editor::hand::typed_point::{EntryError, TypedPoint, read_number};
use crate::editor::reply::Refusal;
use crate::geometry::FloatPolygon;
use crate::geometry::parameters::Quantity;

/// What the tool in the hand takes that is typed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A point, by the names of the two axes that it is drawn along.
    Point([&'static str; 2]),
    /// An angle in degrees.
    Angle,
    /// A factor.
    Factor,
}

impl Editor {
    /// What can be typed on the canvas now.
    pub fn entry(&self) -> Option<Entry> {
        match self.hand.tool() {
            ToolKind::Draw | ToolKind::AddVertex | ToolKind::Insert => {
                let plane = DrawingPlane::of(&self.view.viewport);
                Some(Entry::Point(plane.names()))
            }
            ToolKind::Rotate => Some(Entry::Angle),
            ToolKind::Scale => Some(Entry::Factor),
            _ => None,
        }
    }

    /// Show what a text would do as far as it can be read: the vertex that it would set, or the rotation or scaling.
    /// Without one that is the vertex at the pointer, or nothing. Returns whether that is something else than before.
    pub fn type_entry(&mut self, text: &str) -> bool {
        if let Some(Entry::Angle | Entry::Factor) = self.entry() {
            let typed = self.typed_transformation(text).ok();
            // A drag and what is typed would say different things: the drag goes as soon as typing begins.
            let interrupts = !text.is_empty() && self.hand.is_dragging();
            let shows = self
                .hand
                .tools
                .transform()
                .is_some_and(|tool| tool.shows_typed());
            return (shows || typed.is_some() || interrupts) && self.type_transformation(typed);
        }
        let is_point = matches!(self.entry(), Some(Entry::Point(_)));
        let typed = TypedPoint::read(text, self.document().unit())
            .ok()
            .filter(|_| is_point);
        let before = std::mem::replace(&mut self.hand.typed, typed);
        before != typed
    }

    /// Do what was typed: set a vertex, rotate or scale. It ends a drag that goes on.
    ///
    /// # Errors
    /// [`EntryError`] if the text means nothing, or nothing can be done; nothing is changed then.
    pub fn enter(&mut self, text: &str) -> Result<(), EntryError> {
        let unit = self.document().unit();
        match self.entry() {
            Some(Entry::Point(_)) => self.enter_point(TypedPoint::read(text, unit)?),
            Some(Entry::Angle | Entry::Factor) => {
                let transformation = self.typed_transformation(text)?;
                self.type_transformation(None);
                self.enter_transformation(transformation)
            }
            None => Ok(()),
        }
    }

    /// The rotation or the scaling that a text says.
    fn typed_transformation(&self, text: &str) -> Result<Transformation, EntryError> {
        let unit = self.document().unit();
        match self.entry() {
            Some(Entry::Angle) => {
                let angle = read_number(text, Quantity::Angle, unit)?;
                Ok(Transformation::Rotate(angle.to_radians()))
            }
            _ => Ok(Transformation::Scale(read_number(
                text,
                Quantity::Number,
                unit,
            )?)),
        }
    }

    fn enter_transformation(&mut self, transformation: Transformation) -> Result<(), EntryError> {
        let refused = self.transform(transformation).err();
        let Some(Refusal(reason)) = refused else {
            return Ok(());
        };
        // It is told beside the field.
        self.message = None;
        Err(EntryError::Refused(reason))
    }

    fn enter_point(&mut self, typed: TypedPoint) -> Result<(), EntryError> {
        if self.previewed_operation().is_some() {
            self.operating().interrupt();
        }
        self.view.analyse(self.workspace.document());
        let mut tools = std::mem::take(&mut self.hand.tools);
        let entered = tools
            .drawing_mut()
            .map(|tool| tool.enter(typed, &self.context()));
        self.hand.tools = tools;
        let effects = entered.transpose()?.unwrap_or_default();
        self.hand.typed = None;
        self.message = None;
        self.take_effects(effects, false);
        self.hand.gestures.reset();
        Ok(())
    }

    /// The leg that is drawn, to what is typed or to the pointer, if there is one.
    pub fn leg(&self) -> Option<Leg> {
        let context = self.context();
        let (from, to) = self.hand.tools.drawing()?.leg(&context);
        Some(Leg::between(from?, to?, &context.drawing_plane()))
    }

    /// What is locked of the leg that is drawn, while a tool sets vertices.
    pub fn leg_locks(&self) -> Option<LegLocks> {
        Some(self.hand.tools.drawing()?.locks())
    }

    /// Lock the length of the leg that is drawn, a positive number, its angle, or none.
    pub fn lock_leg(&mut self, locks: LegLocks) {
        let is_usable = |length: &f64| *length > 0.0 && length.is_finite();
        let locks = LegLocks {
            length: locks.length.filter(is_usable),
            degrees: locks.degrees.filter(|degrees| degrees.is_finite()),
        };
        if let Some(tool) = self.hand.tools.drawing_mut() {
            tool.set_locks(locks);
        }
    }

    /// How the draw tool makes curves, while it is in the hand.
    pub fn draw_settings(&self) -> Option<DrawSettings> {
        Some(self.hand.tools.draw()?.settings())
    }

    /// Let the draw tool make curves otherwise.
    pub fn set_draw_settings(&mut self, settings: DrawSettings) {
        if let Some(tool) = self.hand.tools.draw_mut() {
            tool.set_settings(settings);
        }
    }

    /// The degree of the curve that is drawn, or that vertices are added to.
    pub fn drawn_degree(&self) -> Option<usize> {
        let context = self.context();
        if let Some(tool) = self.hand.tools.draw() {
            return Some(tool.degree(&context));
        }
        let proposed = self.proposal().map(|polygon| polygon.degree());
        let active = || Some(self.active_curve()?.1.polygon.degree());
        self.hand.tools.drawing()?;
        proposed.or_else(active)
    }

    /// The degree of the curve that a click would make, if that is another one because there are too few vertices.
    pub fn degree_so_far(&self) -> Option<usize> {
        let degree = self.proposal()?.degree();
        (Some(degree) != self.drawn_degree()).then_some(degree)
    }

    /// The polygon that there would be if the vertex was set now that is drawn.
    pub(in crate::editor) fn proposal(&self) -> Option<FloatPolygon> {
        if self.previewed_operation().is_some()
            || self.hand.gestures.is_panning()
            || self.hand.gestures.is_orbiting()
        {
            return None;
        }
        self.hand.tools.drawing()?.proposal(&self.context())
    }
}
