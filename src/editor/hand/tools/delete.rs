//! The tool that deletes vertices.

use super::tool::{Context, Effect, Tool};
use crate::document::{CurveId, quoted};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::same_shape::{LastSameShape, removal};

/// Delete the vertices that are clicked.
#[derive(Debug, Default)]
pub struct DeleteTool {
    last_shape: LastSameShape,
}

impl Tool for DeleteTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match gesture {
            Gesture::Click(place) => match context.hits.vertex(place) {
                Some((curve, index)) => self.delete(curve, index, context),
                None => Vec::new(),
            },
            Gesture::Key(Key::Escape) => vec![Effect::Finish],
            _ => Vec::new(),
        }
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        matches!(gesture, Gesture::Click(place) if context.hits.vertex(place).is_some())
    }

    fn hint(&self, context: &Context) -> String {
        let hit = context.place().and_then(|place| context.hits.vertex(place));
        let curve = hit.and_then(|(curve, _)| context.document.curve(curve));
        let curve = curve.filter(|_| !context.settings.vertices_stay);
        match curve.map(|curve| self.last_shape.of(curve, -1)) {
            None => "Click a vertex to delete it; Esc ends".into(),
            Some(Ok(same)) => format!("Click to delete the vertex: {}", same.told()),
            Some(Err(refused)) => refused,
        }
    }
}

impl DeleteTool {
    fn delete(&self, curve: CurveId, index: usize, context: &Context) -> Vec<Effect> {
        let Some(found) = context.document.curve(curve) else {
            return Vec::new();
        };
        let name = quoted(&found.name);
        let edit = removal(curve, found, &[index], context.settings.vertices_stay);
        match edit {
            Ok((edit, told)) => vec![
                Effect::Select(Vec::new()),
                Effect::Activate(curve),
                Effect::Apply("Delete vertex".into(), vec![edit]),
                Effect::Say(match told {
                    Some(told) => format!("Vertex {index} of {name} deleted; {told}"),
                    None => format!("Vertex {index} of {name} deleted"),
                }),
            ],
            Err(refused) => vec![Effect::Say(refused)],
        }
    }
}
