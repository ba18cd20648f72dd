//! The name of the snap, beside the pointer.

use super::snapping::Carried;
use super::tools::{Context, ToolKind};
use crate::editor::view::scene::Mark;

/// Name the snap of a click with a tool that sets points, and show the lines that it keeps to.
pub fn snap_name(tool: ToolKind, context: &Context) -> Vec<Mark> {
    let sets_points = matches!(
        tool,
        ToolKind::Draw | ToolKind::AddVertex | ToolKind::Measure
    );
    // With Shift they keep to a direction instead.
    let (Some(at), carried) = (context.pointer, Carried::default()) else {
        return Vec::new();
    };
    if !sets_points || context.modifiers.shift {
        return Vec::new();
    }
    let snap = match tool {
        // The measure tool snaps without the switch.
        ToolKind::Measure => context.measured_snap(at),
        ToolKind::Draw => context.drawn_snap(at),
        _ => context.snap(at, &carried),
    };
    let marks = snap.map(|snap| {
        let name = Mark::Name(context.viewport.flatten(snap.point), snap.name.clone());
        snap.line_marks().chain([name]).collect()
    });
    marks.unwrap_or_default()
}
