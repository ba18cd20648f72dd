//! The table of tools, and the tools: state machines from gestures to effects.

mod draw;
mod drawing;
mod end_fit;
mod end_fit_drags;
mod end_fit_subject;
mod measure;
mod reference_drags;
mod select;
mod tool;
mod transform;
mod transformed;
mod vertices;

pub use draw::DrawSettings;
pub use drawing::DrawingTool;
pub use tool::{Context, Cursor, Effect, Tool};
pub use transform::NOTHING_TO_TRANSFORM;
pub use transformed::{Action as Transformation, Transformed};

use draw::DrawTool;
use end_fit::EndFitTool;
use measure::MeasureTool;
use select::SelectTool;
use transform::{Transform, TransformTool};
use vertices::{AddVertexTool, DeleteTool, InsertTool};

/// Hold every tool, and which of them is in use.
#[derive(Debug)]
pub struct Tools {
    used: ToolKind,
    select: SelectTool,
    add_vertex: AddVertexTool,
    insert: InsertTool,
    delete: DeleteTool,
    draw: DrawTool,
    rotate: TransformTool,
    scale: TransformTool,
    measure: MeasureTool,
    /// The end-fit tool: its panel works on it too.
    pub end_fit: EndFitTool,
}

impl Default for Tools {
    fn default() -> Self {
        Self {
            used: ToolKind::default(),
            select: SelectTool::default(),
            add_vertex: AddVertexTool::default(),
            insert: InsertTool::default(),
            delete: DeleteTool,
            draw: DrawTool::default(),
            rotate: TransformTool::new(Transform::Rotate),
            scale: TransformTool::new(Transform::Scale),
            measure: MeasureTool::default(),
            end_fit: EndFitTool::default(),
        }
    }
}

impl Tools {
    /// Which tool is in use.
    pub fn kind(&self) -> ToolKind {
        self.used
    }

    /// Use another tool, or the same anew: it begins in its first state.
    pub fn choose(&mut self, kind: ToolKind) {
        let mut end_fit = std::mem::take(&mut self.end_fit);
        end_fit.reset();
        *self = Self {
            used: kind,
            end_fit,
            draw: DrawTool::with(self.draw.settings()),
            measure: self.measure.kept(),
            ..Self::default()
        };
    }

    /// The tool in use.
    pub fn used(&self) -> &dyn Tool {
        match self.used {
            ToolKind::Select => &self.select,
            ToolKind::AddVertex => &self.add_vertex,
            ToolKind::Insert => &self.insert,
            ToolKind::Delete => &self.delete,
            ToolKind::Draw => &self.draw,
            ToolKind::Rotate => &self.rotate,
            ToolKind::Scale => &self.scale,
            ToolKind::Measure => &self.measure,
            ToolKind::EndFit => &self.end_fit,
        }
    }

    /// The tool in use, to be worked with.
    pub fn used_mut(&mut self) -> &mut dyn Tool {
        match self.used {
            ToolKind::Select => &mut self.select,
            ToolKind::AddVertex => &mut self.add_vertex,
            ToolKind::Insert => &mut self.insert,
            ToolKind::Delete => &mut self.delete,
            ToolKind::Draw => &mut self.draw,
            ToolKind::Rotate => &mut self.rotate,
            ToolKind::Scale => &mut self.scale,
            ToolKind::Measure => &mut self.measure,
            ToolKind::EndFit => &mut self.end_fit,
        }
    }

    /// What is measured, while another tool is used.
    pub fn measurement(&self) -> Option<&dyn Tool> {
        let stays = self.used != ToolKind::Measure && self.measure.has_measured();
        stays.then_some(&self.measure)
    }

    /// Take a measurement away that stays. Returns whether there was one.
    pub fn dismiss_measurement(&mut self) -> bool {
        self.measure.dismiss()
    }

    /// The tool in use, if it sets vertices.
    pub fn drawing(&self) -> Option<&dyn DrawingTool> {
        match self.used {
            ToolKind::AddVertex => Some(&self.add_vertex),
            ToolKind::Insert => Some(&self.insert),
            ToolKind::Draw => Some(&self.draw),
            _ => None,
        }
    }

    /// The tool in use, if it sets vertices, to be worked with.
    pub fn drawing_mut(&mut self) -> Option<&mut dyn DrawingTool> {
        match self.used {
            ToolKind::AddVertex => Some(&mut self.add_vertex),
            ToolKind::Insert => Some(&mut self.insert),
            ToolKind::Draw => Some(&mut self.draw),
            _ => None,
        }
    }

    /// The draw tool, if it is in use.
    pub fn draw(&self) -> Option<&DrawTool> {
        (self.used == ToolKind::Draw).then_some(&self.draw)
    }

    /// The draw tool, if it is in use, to be set up.
    pub fn draw_mut(&mut self) -> Option<&mut DrawTool> {
        (self.used == ToolKind::Draw).then_some(&mut self.draw)
    }

    /// The rotate or the scale tool, if one of them is in use.
    pub fn transform(&self) -> Option<&TransformTool> {
        match self.used {
            ToolKind::Rotate => Some(&self.rotate),
            ToolKind::Scale => Some(&self.scale),
            _ => None,
        }
    }

    /// The rotate or the scale tool, if one of them is in use, to be set up.
    pub fn transform_mut(&mut self) -> Option<&mut TransformTool> {
        match self.used {
            ToolKind::Rotate => Some(&mut self.rotate),
            ToolKind::Scale => Some(&mut self.scale),
            _ => None,
        }
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
    pub letter: char,
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
}

/// Every tool, in the order of the rail, which is that of [`ToolKind`]'s variants.
static TOOLS: &[ToolRow] = &[
    row(ToolKind::Select, 'v', "Select and move", "mouse-pointer-2")
        .help("Select vertices and drag them"),
    row(ToolKind::AddVertex, 'a', "Add vertex", "git-branch-plus")
        .help("Add a vertex before the first or after the last")
        .starting_group(),
    row(
        ToolKind::Insert,
        'i',
        "Insert vertex",
        "git-commit-horizontal",
    )
    .help("Insert a vertex into a leg of the float S-polygon"),
    row(ToolKind::Delete, 'x', "Delete vertex", "eraser").help("Delete the vertices you click"),
    row(ToolKind::Draw, 'd', "Draw polygon", "waypoints")
        .help("Draw a new float S-polygon, click by click"),
    row(ToolKind::Rotate, 'r', "Rotate", "rotate-cw")
        .help("Rotate the selection about a movable pivot")
        .starting_group()
        .with_panel(),
    row(ToolKind::Scale, 's', "Scale", "scaling")
        .help("Scale the selection about a movable pivot")
        .with_panel(),
    row(ToolKind::Measure, 'm', "Measure", "ruler")
        .help("Measure a distance and its direction")
        .starting_group(),
    row(ToolKind::EndFit, 'e', "End fit", "goal")
        .help("Correct an end point and end tangent by the seven steps")
        .with_panel(),
];

/// A tool without a panel, in the group of the row before it.
const fn row(tool: ToolKind, letter: char, label: &'static str, icon: &'static str) -> ToolRow {
    ToolRow {
        tool,
        letter,
        label,
        help: "",
        icon,
        starts_group: false,
        has_panel: false,
    }
}

impl ToolRow {
    const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
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
    pub fn letter(self) -> char {
        self.row().letter
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::geometry::End;

    #[test]
    fn every_tool_has_a_help_text_and_a_key_of_its_own() {
        let keys: BTreeSet<char> = TOOLS.iter().map(|row| row.letter).collect();
        assert_eq!(keys.len(), TOOLS.len());
        for row in TOOLS {
            let length = row.help.chars().count();
            assert!(length > 0 && length <= 100, "{}", row.label);
        }
    }

    #[test]
    fn a_tool_that_is_chosen_begins_anew_and_the_end_fit_keeps_its_end() {
        let mut tools = Tools::default();
        tools.end_fit.settings.end = End::Start;
        tools.end_fit.settings.tolerance = Some(0.5);
        tools.end_fit.settings.picking = true;
        for kind in ToolKind::ALL {
            tools.choose(kind);
            assert_eq!(tools.kind(), kind);
            assert_eq!(tools.used().undo_label(), None);
            let transforms = matches!(kind, ToolKind::Rotate | ToolKind::Scale);
            assert_eq!(tools.transform().is_some(), transforms);
        }
        let settings = &tools.end_fit.settings;
        assert_eq!((settings.end, settings.tolerance), (End::Start, Some(0.5)));
        assert!(!settings.picking);
    }
}
