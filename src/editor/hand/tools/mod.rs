//! The table of tools, and the tools: state machines from gestures to effects.

mod arrangement;
mod delete;
mod draw;
mod draw_way;
mod end_fit;
mod end_fit_drags;
mod end_fit_subject;
mod end_pick;
mod item_drag;
mod line_drag;
mod measure;
mod measured;
mod move_drag;
mod moving_point;
mod reference_drags;
mod ruler_tool;
mod select;
mod settings;
mod tool;
mod transform;
mod transformation;
mod transformed;
mod vertices;

use crate::editor::hand::gesture::Gesture;

pub use arrangement::Arrangement;
pub use draw_way::DrawWay;
pub use settings::{DrawSettings, ToolSettings};
pub use tool::{Context, Cursor, Effect, Entry, Tool};
pub use transform::NOTHING_TO_TRANSFORM;
pub use transformation::Transformation;
pub use transformed::Transformed;

pub(in crate::editor) use draw::drawn_degree;
pub(in crate::editor) use transform::pivot;

use delete::DeleteTool;
use draw::DrawTool;
use end_fit::EndFitTool;
use measure::MeasureTool;
use ruler_tool::RulerTool;
use select::SelectTool;
use transform::TransformTool;
use vertices::{NewVertex, NewVertexTool};

/// Hold the tool in use.
#[derive(Debug)]
pub struct Tools {
    kind: ToolKind,
    tool: Box<dyn Tool>,
    /// Takes the place of the tool while a guide is dragged from a ruler.
    ruler: Option<RulerTool>,
}

impl Default for Tools {
    fn default() -> Self {
        let kind = ToolKind::default();
        let tool = (kind.row().make)();
        let ruler = None;
        Self { kind, tool, ruler }
    }
}

impl Tools {
    /// Which tool is in use.
    pub fn kind(&self) -> ToolKind {
        self.kind
    }

    /// Use another tool, or the same anew: it begins in its first state.
    pub fn choose(&mut self, kind: ToolKind, settings: &mut ToolSettings) {
        self.kind = kind;
        self.tool = (kind.row().make)();
        self.ruler = None;
        settings.renew();
    }

    /// The tool in use.
    pub fn used(&self) -> &dyn Tool {
        match &self.ruler {
            Some(ruler) => ruler,
            None => &*self.tool,
        }
    }

    /// The tool in use, to be worked with.
    pub fn used_mut(&mut self) -> &mut dyn Tool {
        match &mut self.ruler {
            Some(ruler) => ruler,
            None => &mut *self.tool,
        }
    }

    /// Whether a gesture ends an open preview of an operation first: see [`Tool::begins`].
    pub fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        RulerTool::takes(gesture, context) || self.used().begins(gesture, context)
    }

    /// Let the tool in use take a gesture, or the rulers: a drag from one places a guide, whichever tool is in use.
    pub fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        if RulerTool::takes(gesture, context) {
            self.ruler = Some(RulerTool::default());
        }
        let effects = self.used_mut().gesture(gesture, context);
        self.ruler.take_if(|ruler| !ruler.drags());
        effects
    }
}

/// A tool that can be used.
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

/// A row of the table of tools. Rail, menu, keys, palette and panels read it.
#[derive(Debug)]
pub struct ToolRow {
    /// The tool.
    pub tool: ToolKind,
    /// Its key.
    pub key: char,
    /// Its name on screen.
    pub label: &'static str,
    /// Its tooltip.
    pub help: &'static str,
    /// The Lucide name of its icon.
    pub icon: &'static str,
    /// Whether it begins a group of the rail.
    pub starts_group: bool,
    /// Whether it has a panel of its own.
    pub has_panel: bool,
    /// Makes it, in its first state.
    make: fn() -> Box<dyn Tool>,
}

/// Every tool, in the order of the rail, which is that of [`ToolKind`]'s variants.
static TOOLS: &[ToolRow] = &[
    row(ToolKind::Select, 'v', "Select and move", "mouse-pointer-2")
        .help("Select vertices and drag them")
        .made_by(|| Box::new(SelectTool::default())),
    row(ToolKind::AddVertex, 'a', "Add vertex", "git-branch-plus")
        .help("Add a vertex before the first or after the last")
        .made_by(|| Box::new(NewVertexTool::new(NewVertex::AtEnd)))
        .starting_group()
        .with_panel(),
    row(
        ToolKind::Insert,
        'i',
        "Insert vertex",
        "git-commit-horizontal",
    )
    .help("Insert a vertex into a leg of the float S-polygon")
    .made_by(|| Box::new(NewVertexTool::new(NewVertex::IntoLeg)))
    .with_panel(),
    row(ToolKind::Delete, 'x', "Delete vertex", "eraser")
        .help("Delete the vertices you click")
        .made_by(|| Box::new(DeleteTool::default())),
    row(ToolKind::Draw, 'd', "Draw curve", "waypoints")
        .help("Draw a new curve by the vertices of its float S-polygon")
        .made_by(|| Box::new(DrawTool::default()))
        .with_panel(),
    row(ToolKind::Rotate, 'r', "Rotate", "rotate-cw")
        .help("Rotate the selection about a movable pivot")
        .made_by(|| Box::new(TransformTool::rotate()))
        .starting_group()
        .with_panel(),
    row(ToolKind::Scale, 's', "Scale", "scaling")
        .help("Scale the selection about a movable pivot")
        .made_by(|| Box::new(TransformTool::scale()))
        .with_panel(),
    row(ToolKind::Measure, 'm', "Measure", "ruler")
        .help("Measure a distance and its direction")
        .made_by(|| Box::new(MeasureTool::default()))
        .starting_group(),
    row(ToolKind::EndFit, 'e', "End fit", "goal")
        .help("Correct ends by the seven steps, or match them to other curves")
        .made_by(|| Box::new(EndFitTool::default()))
        .with_panel(),
];

/// A tool without a panel, in the group of the row before it.
const fn row(tool: ToolKind, key: char, label: &'static str, icon: &'static str) -> ToolRow {
    ToolRow {
        tool,
        key,
        label,
        help: "",
        icon,
        starts_group: false,
        has_panel: false,
        make: || Box::new(DeleteTool::default()),
    }
}

impl ToolRow {
    const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    const fn made_by(self, make: fn() -> Box<dyn Tool>) -> Self {
        Self { make, ..self }
    }

    const fn starting_group(self) -> Self {
        Self {
            starts_group: true,
            ..self
        }
    }

    const fn with_panel(self) -> Self {
        Self {
            has_panel: true,
            ..self
        }
    }
}

impl ToolKind {
    /// Every tool, in the order of the rail.
    pub const ALL: [Self; TOOLS.len()] = {
        let mut all = [Self::Select; TOOLS.len()];
        let mut place = 0;
        while place < TOOLS.len() {
            assert!(
                TOOLS[place].tool as usize == place,
                "rows in the order of variants"
            );
            all[place] = TOOLS[place].tool;
            place += 1;
        }
        all
    };

    /// The tool's row of the table.
    pub fn row(self) -> &'static ToolRow {
        &TOOLS[self as usize]
    }

    /// The tool's name on screen.
    pub fn label(self) -> &'static str {
        self.row().label
    }

    /// The tool's key.
    pub fn key(self) -> char {
        self.row().key
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::editor::view::Viewport;
    use crate::geometry::End;

    #[test]
    fn every_tool_has_a_help_text_and_a_key_of_its_own() {
        let keys: BTreeSet<char> = TOOLS.iter().map(|row| row.key).collect();
        assert_eq!(keys.len(), TOOLS.len());
        for row in TOOLS {
            let length = row.help.chars().count();
            assert!(length > 0 && length <= 100, "{}", row.label);
        }
    }

    #[test]
    fn a_tool_that_is_chosen_begins_anew_and_the_end_fit_keeps_its_end() {
        let (mut tools, mut settings) = (Tools::default(), ToolSettings::default());
        settings.end_fit.end = End::Start;
        settings.end_fit.tolerance = Some(0.5);
        settings.end_fit.picking = true;
        for kind in ToolKind::ALL {
            tools.choose(kind, &mut settings);
            assert_eq!(tools.kind(), kind);
            assert_eq!(tools.used().undo_label(), None);
            let typed = tools.used().entry(&Viewport::default());
            let transforms = matches!(typed, Some(Entry::Angle | Entry::Factor));
            assert_eq!(
                transforms,
                matches!(kind, ToolKind::Rotate | ToolKind::Scale)
            );
        }
        let kept = (settings.end_fit.end, settings.end_fit.tolerance);
        assert_eq!(kept, (End::Start, Some(0.5)));
        assert!(!settings.end_fit.picking);
    }
}
