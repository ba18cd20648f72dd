//! The tools: small state machines that take pointer events in model coordinates and return
//! effects.

mod draw;
mod end_fit;
mod measure;
mod select;
mod tool;
mod transform;
mod vertices;

pub use tool::{Context, Cursor, Effect, Tool, move_edits};
pub use transform::{Action as Transformation, NOTHING_TO_TRANSFORM};

use transform::Transform;

/// A tool that can be taken into the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum ToolKind {
    /// Select and move vertices.
    #[default]
    Select,
    /// Add vertices at either end.
    AddVertex,
    /// Insert a vertex into a leg.
    Insert,
    /// Delete vertices.
    Delete,
    /// Draw a new polygon.
    Draw,
    /// Rotate the selection.
    Rotate,
    /// Scale the selection.
    Scale,
    /// Measure distances and angles.
    Measure,
    /// Correct the curve's ends by the seven steps.
    EndFit,
}

impl ToolKind {
    /// Every tool, in the order of the rail.
    pub const ALL: [Self; 9] = [
        Self::Select,
        Self::AddVertex,
        Self::Insert,
        Self::Delete,
        Self::Draw,
        Self::Rotate,
        Self::Scale,
        Self::Measure,
        Self::EndFit,
    ];

    /// Take the tool into the hand, in its first state.
    pub fn take(self) -> Box<dyn Tool> {
        match self {
            Self::Select => Box::new(select::SelectTool::default()),
            Self::AddVertex => Box::new(vertices::AddVertexTool::default()),
            Self::Insert => Box::new(vertices::InsertTool::default()),
            Self::Delete => Box::new(vertices::DeleteTool),
            Self::Draw => Box::new(draw::DrawTool::default()),
            Self::Rotate => Box::new(transform::TransformTool::new(Transform::Rotate)),
            Self::Scale => Box::new(transform::TransformTool::new(Transform::Scale)),
            Self::Measure => Box::new(measure::MeasureTool::default()),
            Self::EndFit => Box::new(end_fit::EndFitTool::default()),
        }
    }

    /// What the tool is called on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Select => "Select and move",
            Self::AddVertex => "Add vertex",
            Self::Insert => "Insert vertex",
            Self::Delete => "Delete vertex",
            Self::Draw => "Draw polygon",
            Self::Rotate => "Rotate",
            Self::Scale => "Scale",
            Self::Measure => "Measure",
            Self::EndFit => "End fit",
        }
    }

    /// One sentence that says what the tool does.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::Select => "Select vertices and drag them",
            Self::AddVertex => "Add a vertex before the first or behind the last",
            Self::Insert => "Insert a vertex into a leg of the float S-polygon",
            Self::Delete => "Delete the vertices that are clicked",
            Self::Draw => "Draw a new float S-polygon, click by click",
            Self::Rotate => "Rotate the selection about a movable pivot",
            Self::Scale => "Scale the selection about a movable pivot",
            Self::Measure => "Measure a distance and its direction",
            Self::EndFit => "Correct an end point and end tangent by the seven steps",
        }
    }

    /// The key that takes the tool into the hand.
    pub fn letter(self) -> char {
        match self {
            Self::Select => 'v',
            Self::AddVertex => 'a',
            Self::Insert => 'i',
            Self::Delete => 'x',
            Self::Draw => 'd',
            Self::Rotate => 'r',
            Self::Scale => 's',
            Self::Measure => 'm',
            Self::EndFit => 'e',
        }
    }
}
