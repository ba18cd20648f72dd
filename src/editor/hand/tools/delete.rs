//! The tool that deletes vertices.

use std::cell::RefCell;
use std::sync::Arc;

use super::tool::{Context, Effect, Tool, pointer_label};
use crate::document::{Curve, CurveId, quoted};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::same_shape::{LastSameShape, Removal, removal};
use crate::editor::view::scene::Mark;

/// A vertex of a curve, and what deleting it would do.
type Told = (Arc<Curve>, usize, Option<String>);

/// Delete the vertices that are clicked.
#[derive(Debug, Default)]
pub struct DeleteTool {
    last_shape: LastSameShape,
    /// What deleting the vertex that was looked at last would do while the others stay.
    last_told: RefCell<Option<Told>>,
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
        match self.told(context) {
            Some(told) => format!("Click to delete the vertex. {told}"),
            None => "Click a vertex to delete it; Esc ends".into(),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let told = pointer_label(self.told(context), context);
        told.into_iter().collect()
    }
}

impl DeleteTool {
    /// What a click would do to the curve, or why it cannot.
    fn told(&self, context: &Context) -> Option<String> {
        let (id, index) = context.hits.vertex(context.place()?)?;
        let curve = context.document.curve(id)?;
        if context.settings.vertices_stay {
            return self.told_of_plain(id, curve, index);
        }
        let same = self.last_shape.of(curve, -1);
        Some(same.map_or_else(|refused| refused, |same| same.told(context.document.unit())))
    }

    /// The same where the other vertices stay, found anew only for another vertex.
    fn told_of_plain(&self, id: CurveId, curve: &Arc<Curve>, index: usize) -> Option<String> {
        let mut last = self.last_told.borrow_mut();
        if let Some((of, vertex, told)) = last.as_ref()
            && Arc::ptr_eq(of, curve)
            && *vertex == index
        {
            return told.clone();
        }
        let told = match removal(id, curve, &[index], (true, None)) {
            Ok(removal) => removal.told,
            Err(refused) => Some(refused),
        };
        *last = Some((curve.clone(), index, told.clone()));
        told
    }

    fn delete(&self, curve: CurveId, index: usize, context: &Context) -> Vec<Effect> {
        let Some(found) = context.document.curve(curve) else {
            return Vec::new();
        };
        let name = quoted(&found.name);
        let way = (context.settings.vertices_stay, context.document.unit());
        let edit = removal(curve, found, &[index], way);
        match edit {
            Ok(Removal { edit, told, adds }) => {
                let told = match told {
                    Some(told) => format!("Vertex {index} of {name} deleted. {told}"),
                    None => format!("Vertex {index} of {name} deleted"),
                };
                vec![
                    Effect::Select(Vec::new()),
                    Effect::Activate(curve),
                    Effect::Apply("Delete vertex".into(), vec![edit]),
                    match adds {
                        true => Effect::Warn(told),
                        false => Effect::Say(told),
                    },
                ]
            }
            Err(refused) => vec![Effect::Say(refused)],
        }
    }
}
