//! Doing what the commands say.

use std::sync::Arc;

use super::Editor;
use super::command::Command;
use super::examples;
use super::layers::Layer;
use super::polygon_edits::reinterpreted;
use super::report::{AfterDiscard, Export, Request};
use super::selection::VertexId;
use crate::document::{Curve, CurveId, Edit, quoted};
use crate::geometry::PolygonKind;
use crate::geometry::end_correction::EndTarget;

/// The factor by which the zoom commands change the scale.
const ZOOM: f64 = 1.25;

impl Editor {
    /// The number of built-in examples.
    pub fn examples(&self) -> usize {
        examples::count()
    }

    /// Do what a command says; what only a window can do is returned as a request.
    pub fn execute(&mut self, command: Command) -> Option<Request> {
        if !self.is_enabled(command) {
            return None;
        }
        self.commit_field();
        self.message = None;
        match command {
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            _ => {
                if self.gestures.is_dragging() && !command.only_shows() {
                    self.call_off();
                }
                return self.execute_idle(command);
            }
        }
        None
    }

    /// Whether a command can be given now.
    pub fn is_enabled(&self, command: Command) -> bool {
        let curve = self.active_curve();
        let editable = curve
            .as_ref()
            .is_some_and(|(_, curve)| curve.check_editable().is_ok());
        match command {
            Command::Undo => self.undo_label().is_some(),
            Command::Redo => {
                self.history.redo_label().is_some() && self.tool_state.undo_label().is_none()
            }
            Command::Cut | Command::Delete => curve.is_some(),
            Command::Copy
            | Command::Duplicate
            | Command::DeleteCurve
            | Command::ToggleVisible
            | Command::ToggleLocked => curve.is_some(),
            Command::Reverse => editable,
            Command::TogglePeriodic => editable,
            Command::RaiseDegree => editable && self.can_have_degree(1),
            Command::LowerDegree => editable && self.can_have_degree(-1),
            Command::RaiseCurveDegree => editable && self.can_change_degree(true),
            Command::LowerCurveDegree => editable && self.can_change_degree(false),
            Command::Subdivide | Command::Divide | Command::Round => editable,
            Command::Extend(_) => {
                editable && curve.is_some_and(|(_, curve)| !curve.polygon.is_periodic())
            }
            Command::SelectAll | Command::Fit | Command::FitAll => !self.document().is_empty(),
            Command::SelectNone => !self.selection.is_empty(),
            Command::ExportDxf | Command::ExportCsv(_) => !self.document().is_empty(),
            _ => true,
        }
    }

    /// Whether a switch is on; `None` for commands that are no switches.
    pub fn is_checked(&self, command: Command) -> Option<bool> {
        let curve = self.active_curve().map(|(_, curve)| curve);
        match command {
            Command::ToggleLayer(layer) => Some(self.layers().shows(layer)),
            Command::ToggleSnapping => Some(self.snapping),
            Command::Tool(tool) => Some(self.tool == tool),
            Command::View(view) => Some(self.viewport.orientation == view.orientation()),
            Command::TogglePeriodic => Some(curve.is_some_and(|c| c.polygon.is_periodic())),
            Command::ToggleVisible => Some(curve.is_some_and(|c| c.visible)),
            Command::ToggleLocked => Some(curve.is_some_and(|c| c.locked)),
            _ => None,
        }
    }

    /// What a menu calls the command now: undo and redo name their step.
    pub fn label(&self, command: Command) -> String {
        let named = |label: &str| {
            let mut letters = label.chars();
            let first = letters
                .next()
                .map(|letter| letter.to_lowercase().to_string());
            format!(
                "{} {}{}",
                command.label(),
                first.unwrap_or_default(),
                letters.as_str()
            )
        };
        match command {
            Command::Undo => self.undo_label().map(named),
            Command::Redo => self.history.redo_label().map(named),
            _ => None,
        }
        .unwrap_or_else(|| command.label())
    }

    /// Give a curve another degree; the polygon stays. An error becomes the message.
    pub fn set_degree(&mut self, curve: CurveId, degree: usize) {
        self.reinterpret(curve, &format!("Set degree {degree}"), Some(degree), None);
    }

    /// Make a curve periodic, or open it; the polygon stays. An error becomes the message.
    pub fn set_periodic(&mut self, curve: CurveId, periodic: bool) {
        let label = if periodic {
            "Make periodic"
        } else {
            "Open curve"
        };
        self.reinterpret(curve, label, None, Some(periodic));
    }

    pub(super) fn active_curve(&self) -> Option<(CurveId, Arc<Curve>)> {
        let id = self.selection.active()?;
        Some((id, self.document().curve(id)?.clone()))
    }

    /// What undo would take back: a point of what the tool has not finished comes first.
    fn undo_label(&self) -> Option<&str> {
        let point = self.tool_state.undo_label();
        point.or_else(|| self.history.undo_label())
    }

    fn undo(&mut self) {
        if self.gestures.is_dragging() {
            self.call_off();
            return;
        }
        if self.tool_state.undo_label().is_some() {
            self.tool_state.undo();
            return;
        }
        self.end_fit.begin_anew();
        let before: Vec<CurveId> = self.document().curves().map(|(id, _)| id).collect();
        if let Some(label) = self.history.undo() {
            self.say(format!("Undone: {label}"));
        }
        self.activate_returned(&before);
    }

    fn redo(&mut self) {
        if self.gestures.is_dragging() {
            return;
        }
        self.end_fit.begin_anew();
        let before: Vec<CurveId> = self.document().curves().map(|(id, _)| id).collect();
        if let Some(label) = self.history.redo() {
            self.say(format!("Redone: {label}"));
        }
        self.activate_returned(&before);
    }

    /// Make the first curve active that was not there before: the one that was waited for.
    fn activate_returned(&mut self, before: &[CurveId]) {
        self.document_changed();
        let returned = self
            .document()
            .curves()
            .map(|(id, _)| id)
            .find(|id| !before.contains(id));
        if let Some(returned) = returned {
            self.activate(returned);
        }
    }

    fn execute_idle(&mut self, command: Command) -> Option<Request> {
        match command {
            Command::New => return self.confirmed(AfterDiscard::New),
            Command::Open => return self.confirmed(AfterDiscard::Open),
            Command::OpenExample(index) => return self.confirmed(AfterDiscard::OpenExample(index)),
            Command::Quit => return self.confirmed(AfterDiscard::Quit),
            Command::Import => return Some(Request::Import),
            Command::Save => match self.path.clone() {
                Some(path) => {
                    self.save(&path);
                }
                None => return Some(Request::SaveAs),
            },
            Command::SaveAs => return Some(Request::SaveAs),
            Command::ExportDxf => return Some(self.export_request("dxf", PolygonKind::Float)),
            Command::ExportCsv(polygon) => return Some(self.export_request("csv", polygon)),
            Command::Undo | Command::Redo => {}
            Command::Cut => {
                // What cannot be removed is not copied either.
                let request = self.copy()?;
                return self.delete("Cut", "cut").then_some(request);
            }
            Command::Copy => {
                let request = self.copy()?;
                self.say_copied();
                return Some(request);
            }
            Command::Paste => return Some(Request::Paste),
            Command::Duplicate => self.duplicate(),
            Command::Delete => {
                self.delete("Delete", "deleted");
            }
            Command::DeleteCurve => self.delete_curve(),
            Command::SelectAll => self.select_all(),
            Command::SelectNone => self.selection.clear(),
            Command::Reverse => self.reverse(),
            Command::TogglePeriodic => {
                if let Some((id, curve)) = self.active_curve() {
                    self.set_periodic(id, !curve.polygon.is_periodic());
                }
            }
            Command::RaiseDegree | Command::LowerDegree => {
                if let Some((id, curve)) = self.active_curve() {
                    let degree = curve.polygon.degree();
                    let raised = command == Command::RaiseDegree;
                    self.set_degree(id, if raised { degree + 1 } else { degree - 1 });
                }
            }
            Command::RaiseCurveDegree => self.change_degree(true),
            Command::LowerCurveDegree => self.change_degree(false),
            Command::Subdivide => self.subdivide(),
            Command::Extend(end) => self.extend(end),
            Command::Divide => return Some(Request::Divide),
            Command::Round => return Some(Request::Round),
            Command::ToggleVisible | Command::ToggleLocked => self.toggle_flag(command),
            Command::Fit => self.fit(),
            Command::FitAll => self.fit_all(),
            Command::ZoomIn => self.viewport.zoom(0.5 * self.viewport.size, ZOOM),
            Command::ZoomOut => self.viewport.zoom(0.5 * self.viewport.size, 1.0 / ZOOM),
            Command::View(view) => self.set_orientation(view.orientation()),
            Command::ResetComb => self.reset_comb(),
            Command::ToggleLayer(layer) => self.toggle_layer(layer),
            Command::ToggleSnapping => self.snapping = !self.snapping,
            Command::Tool(tool) => self.take(tool),
            Command::ToggleTheme => return Some(Request::ToggleTheme),
            Command::TogglePlots => return Some(Request::TogglePlots),
            Command::Palette => return Some(Request::Palette),
            Command::Keys => return Some(Request::Keys),
            Command::About => return Some(Request::About),
        }
        None
    }

    fn export_request(&self, extension: &'static str, polygon: PolygonKind) -> Request {
        let stem = self.path.as_deref().and_then(|path| path.file_stem());
        let name = stem.map(|stem| stem.to_string_lossy().into_owned());
        let name = name.or_else(|| Some(self.active_curve()?.1.name.clone()));
        let name = name.unwrap_or_else(|| "curves".into());
        Request::Export(Export {
            extension,
            polygon,
            file_name: format!("{name}.{extension}"),
        })
    }

    fn toggle_layer(&mut self, layer: Layer) {
        let shown = self.layers().shows(layer);
        if matches!(layer, Layer::Float | Layer::Clamped) {
            self.end_fit.closed = false;
        }
        self.layers.set(layer, !shown);
    }

    fn toggle_flag(&mut self, command: Command) {
        let Some((id, curve)) = self.active_curve() else {
            return;
        };
        if command == Command::ToggleVisible {
            self.set_visible(id, !curve.visible);
        } else {
            self.set_locked(id, !curve.locked);
        }
    }

    /// Show or hide a curve, as one step.
    pub fn set_visible(&mut self, curve: CurveId, visible: bool) {
        let label = if visible { "Show curve" } else { "Hide curve" };
        self.apply(label, vec![Edit::SetVisible { curve, visible }]);
    }

    /// Protect a curve's shape or release it, as one step.
    pub fn set_locked(&mut self, curve: CurveId, locked: bool) {
        let label = if locked { "Lock curve" } else { "Unlock curve" };
        self.apply(label, vec![Edit::SetLocked { curve, locked }]);
    }

    fn select_all(&mut self) {
        if let Some((_, curve)) = self.active_curve()
            && let Err(hidden) = curve.check_visible()
        {
            return self.fail(hidden.to_string());
        }
        let all_of = |(id, curve): (CurveId, &Arc<Curve>)| {
            let count = if curve.visible {
                curve.polygon.vertices().len()
            } else {
                0
            };
            (0..count)
                .map(move |index| (id, index))
                .collect::<Vec<VertexId>>()
        };
        let active = self.selection.active();
        let own: Vec<VertexId> = self
            .document()
            .curves()
            .filter(|(id, _)| Some(*id) == active)
            .flat_map(all_of)
            .collect();
        if own.iter().all(|vertex| self.selection.contains(*vertex)) {
            let all: Vec<VertexId> = self.document().curves().flat_map(all_of).collect();
            self.selection.set(all);
        } else {
            self.selection.set(own);
        }
    }

    fn duplicate(&mut self) {
        let Some((_, curve)) = self.active_curve() else {
            return;
        };
        self.add_copies("Duplicate curve", vec![Curve::clone(&curve)]);
    }

    fn reverse(&mut self) {
        let Some((id, curve)) = self.active_curve() else {
            return;
        };
        let polygon = curve.polygon.reversed();
        let mut edits = vec![Edit::SetPolygon { curve: id, polygon }];
        for end in crate::geometry::End::BOTH {
            let target = curve.targets.get(end.other()).map(EndTarget::turned);
            if target != curve.targets.get(end) {
                edits.push(Edit::SetTarget {
                    curve: id,
                    end,
                    target,
                });
            }
        }
        self.apply("Reverse direction", edits);
        self.selection.clear();
    }

    fn can_have_degree(&self, change: isize) -> bool {
        let Some((_, curve)) = self.active_curve() else {
            return false;
        };
        let polygon = &curve.polygon;
        let degree = polygon.degree().checked_add_signed(change);
        degree.is_some_and(|degree| {
            (1..=crate::geometry::MAX_DEGREE).contains(&degree) && degree < polygon.vertices().len()
        })
    }

    fn reinterpret(
        &mut self,
        id: CurveId,
        label: &str,
        degree: Option<usize>,
        periodic: Option<bool>,
    ) {
        let Some(curve) = self.document().curve(id).cloned() else {
            return;
        };
        let polygon = &curve.polygon;
        let degree = degree.unwrap_or(polygon.degree());
        let periodic = periodic.unwrap_or(polygon.is_periodic());
        if degree == polygon.degree() && periodic == polygon.is_periodic() {
            return;
        }
        match reinterpreted(polygon, degree, periodic) {
            Ok(polygon) => {
                self.apply(label, vec![Edit::SetPolygon { curve: id, polygon }]);
            }
            Err(error) => self.fail(format!("{}: {error}", quoted(&curve.name))),
        }
    }
}
