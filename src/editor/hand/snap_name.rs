//! The name of the snap, beside the pointer.

use super::snapping::Carried;
use super::tools::{Context, ToolKind};
use crate::editor::view::scene::Mark;

/// Name the snap of a click with a tool that sets points.
pub fn snap_name(tool: ToolKind, context: &Context) -> Option<Mark> {
    let sets_points = matches!(
        tool,
        ToolKind::Draw | ToolKind::AddVertex | ToolKind::Measure
    );
    // With Shift they keep to a direction instead.
    if !sets_points || context.modifiers.shift {
        return None;
    }
    let (at, carried) = (context.pointer?, Carried::default());
    let snap = match tool {
        // The measure tool snaps without the switch.
        ToolKind::Measure if context.modifiers.ctrl => None,
        ToolKind::Measure => context.object_snap(at, &carried),
        _ => context.snap(at, &carried),
    }?;
    Some(Mark::Name(context.viewport.flatten(snap.point), snap.name))
}
