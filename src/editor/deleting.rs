//! Removing vertices and curves: never one by a command that is meant for the other.

use super::Editor;
use super::command::Command;
use super::polygon_edits::without;
use crate::document::{Edit, quoted};
use crate::geometry::counted;

impl Editor {
    /// Remove the selected vertices; `false`, with the reason as message, if that cannot be.
    pub(super) fn delete(&mut self, verb: &str, done: &str) -> bool {
        let edits = match self.deletion() {
            Ok(edits) => edits,
            Err(reason) => {
                self.fail(reason);
                return false;
            }
        };
        let count = counted(self.selection.vertices().len(), "vertex", "vertices");
        let made = self.apply(&format!("{verb} {count}"), edits);
        if made {
            self.selection.clear();
            self.say_done(format!("{count} {done}"));
        }
        made
    }

    /// The edits that remove the selected vertices. A curve is never removed that way.
    fn deletion(&self) -> Result<Vec<Edit>, String> {
        if self.selection.is_empty() {
            let Some((_, curve)) = self.active_curve() else {
                return Err("There is no curve".into());
            };
            return Err(format!(
                "No vertex is selected. To remove {} as a whole, use “{}”",
                quoted(&curve.name),
                Command::DeleteCurve.label()
            ));
        }
        let mut edits = Vec::new();
        for (id, curve) in self.document().curves() {
            let indices: Vec<usize> = self.selection.of_curve(id).collect();
            if indices.is_empty() {
                continue;
            }
            curve
                .check_editable()
                .map_err(|refused| refused.to_string())?;
            if indices.len() == curve.polygon.vertices().len() {
                return Err(format!(
                    "The selection holds all vertices of {}. To remove it as a whole, use “{}”",
                    quoted(&curve.name),
                    Command::DeleteCurve.label()
                ));
            }
            let polygon = without(&curve.polygon, &indices).map_err(|error| {
                format!("{}: {error}; lower its degree first", quoted(&curve.name))
            })?;
            edits.push(Edit::SetPolygon { curve: id, polygon });
        }
        Ok(edits)
    }

    pub(super) fn delete_curve(&mut self) {
        let Some((id, curve)) = self.active_curve() else {
            return;
        };
        if let Err(locked) = curve.check_unlocked() {
            return self.fail(locked.to_string());
        }
        if self.apply("Delete curve", vec![Edit::Remove(id)]) {
            self.say_done(format!("{} deleted", quoted(&curve.name)));
        }
    }
}
