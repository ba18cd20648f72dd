//! Copy and paste, as the text of a project: other programs and other windows can read it.

use std::sync::Arc;

use glam::DVec3;

use super::Editor;
use super::files::count_curves;
use super::report::Request;
use crate::document::{Curve, CurveId, free_name};
use crate::geometry::FloatPolygon;
use crate::io::Format;

/// How far copies are put from what they copy, in screen points, right and down.
const OFFSET: f64 = 24.0;

impl Editor {
    /// Add the curves of a text as one step: a project or a CSV table, as files hold them. An
    /// error becomes the message, and nothing is changed.
    pub fn paste_text(&mut self, text: &str) {
        self.message = None;
        let project = Format::Batten.read(text.as_bytes());
        let read = match &project {
            Ok(_) => project,
            // Text that begins like a project is judged as one.
            Err(_) if text.trim_start().starts_with('{') => project,
            Err(_) => Format::Csv.read(text.as_bytes()),
        };
        match read {
            Ok(curves) if curves.is_empty() => self.say("There are no curves on the clipboard"),
            Ok(curves) => {
                let count = curves.len();
                self.add_copies("Paste", curves);
                self.say(format!("{} pasted", count_curves(count)));
            }
            Err(error) => {
                self.fail(format!(
                    "The clipboard holds no curve that can be read: {error}"
                ));
            }
        }
    }

    /// Make the text of the selected vertices, a curve for each curve that has some, or of the
    /// active curve if none is selected.
    pub(super) fn copy(&mut self) -> Option<Request> {
        let selected = |(id, _): &(CurveId, &Arc<Curve>)| self.selection.of_curve(*id).count() > 0;
        let parts = self.document().curves().filter(selected);
        let parts: Result<Vec<Curve>, _> = parts
            .map(|(id, curve)| self.selected_part(id, curve))
            .collect();
        let copied = match parts {
            Ok(parts) if parts.is_empty() => vec![Curve::clone(&self.active_curve()?.1)],
            Ok(parts) => parts,
            Err(error) => {
                self.fail(format!("The selection is no curve of its own: {error}"));
                return None;
            }
        };
        let export = Format::Batten.write(&copied, None);
        match export.map(|export| String::from_utf8_lossy(&export.bytes).into_owned()) {
            Ok(text) => Some(Request::CopyText(text)),
            Err(error) => {
                self.fail(error.to_string());
                None
            }
        }
    }

    /// Add copies a little aside, named anew and unlocked.
    pub(super) fn add_copies(&mut self, label: &str, curves: Vec<Curve>) {
        let offset = OFFSET * self.viewport.pixel() * DVec3::new(1.0, -1.0, 0.0);
        let mut names: Vec<String> = self
            .document()
            .curves()
            .map(|(_, c)| c.name.clone())
            .collect();
        let mut copies = Vec::new();
        for curve in curves {
            let mut copy = curve.clone();
            copy.locked = false;
            copy.visible = true;
            copy.name = free_name(&curve.name, |name| names.iter().any(|taken| taken == name));
            names.push(copy.name.clone());
            let vertices = curve.polygon.vertices().iter().enumerate();
            let moved: Vec<(usize, DVec3)> =
                vertices.map(|(i, vertex)| (i, *vertex + offset)).collect();
            if copy.polygon.move_vertices(moved).is_ok() {
                for end in crate::geometry::End::BOTH {
                    let target = copy.targets.get(end).map(|mut target| {
                        target.point += offset;
                        target
                    });
                    copy.targets.set(end, target);
                }
            }
            copies.push(copy);
        }
        self.add_curves(label, copies);
    }

    /// The curve of the selected vertices: its degree is lowered if they are too few.
    fn selected_part(
        &self,
        id: CurveId,
        curve: &Curve,
    ) -> Result<Curve, crate::geometry::PolygonError> {
        let polygon = &curve.polygon;
        let indices: Vec<usize> = self.selection.of_curve(id).collect();
        if indices.len() == polygon.vertices().len() {
            return Ok(curve.clone());
        }
        let vertices: Vec<DVec3> = indices.iter().map(|index| polygon.vertex(*index)).collect();
        let weights = polygon
            .is_rational()
            .then(|| indices.iter().map(|index| polygon.weight(*index)).collect());
        let degree = polygon.degree().min(indices.len().saturating_sub(1)).max(1);
        let part = FloatPolygon::new(degree, vertices, weights, false)?;
        Ok(Curve::new(curve.name.clone(), part))
    }
}
