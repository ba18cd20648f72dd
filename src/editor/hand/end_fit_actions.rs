//! Doing what the end-fit panel asks for: the seven steps by button.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Edit, quoted};
use crate::editor::Editor;
use crate::editor::hand::end_fit::{EndFitAction, EndFitReport};
use crate::editor::hand::tools::ToolKind;
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::layers::Layer;
use crate::geometry::end_correction::{
    EndDifference, EndOverlap, EndTarget, LoopOutcome, align_end, correct_in_turn, translate_end,
};
use crate::geometry::joint_correction::correct_jointly;
use crate::geometry::{End, FloatPolygon, counted, figure};

impl Editor {
    /// Collect the figures of the seven steps, if the end-fit tool is in the hand and the active
    /// curve has ends.
    pub fn end_fit(&mut self) -> Option<EndFitReport> {
        if self.hand.tool != ToolKind::EndFit {
            return None;
        }
        let (id, curve) = self.active_curve()?;
        if curve.polygon.is_periodic() {
            return None;
        }
        self.analyses.update(self.workspace.document());
        Some(self.hand.end_fit.report(self.analyses.get(id)?))
    }

    /// Do one thing of the end-fit panel; a drag that goes on is called off.
    pub fn end_fit_action(&mut self, action: EndFitAction) {
        self.interrupt();
        self.message = None;
        let Some((id, curve)) = self.active_curve() else {
            return;
        };
        if curve.polygon.is_periodic() {
            let text = format!(
                "{} is periodic and has no ends: open it first",
                quoted(&curve.name)
            );
            self.message = Message::of(&Err(Refusal(text)));
            return;
        }
        let end = self.hand.end_fit.end;
        let target = curve.targets.get(end);
        let jet = curve.polygon.end_jet(end);
        match action {
            EndFitAction::Choose(end) => {
                self.hand.end_fit.end = end;
                self.hand.end_fit.picking = false;
            }
            EndFitAction::ShowClosed(closed) => {
                self.hand.end_fit.closed = closed;
                if !closed {
                    self.view.layers.set(Layer::Float, true);
                }
            }
            EndFitAction::TargetActual => {
                let target = EndTarget {
                    point: jet.point,
                    direction: jet.tangent(),
                };
                self.set_target(id, "Set target", Some(target));
            }
            EndFitAction::SetPoint(point) => {
                let direction = target.map_or(jet.tangent(), |target| target.direction);
                self.set_target(id, "Set target point", Some(EndTarget { point, direction }));
            }
            EndFitAction::SetDirection(direction) => {
                let point = target.map_or(jet.point, |target| target.point);
                let label = if direction.is_some() {
                    "Set target direction"
                } else {
                    "Free target direction"
                };
                self.set_target(id, label, Some(EndTarget { point, direction }));
            }
            EndFitAction::ClearTarget => self.set_target(id, "Clear target", None),
            EndFitAction::PickFromCurve => self.hand.end_fit.picking = !self.hand.end_fit.picking,
            EndFitAction::Picked(picked) => {
                self.hand.end_fit.picking = false;
                self.set_target(id, "Pick target", Some(picked));
            }
            EndFitAction::TurnRound => {
                self.set_target(id, "Turn target round", target.map(EndTarget::turned));
            }
            EndFitAction::Translate => self.translate(id, &curve, target),
            EndFitAction::Rotate => self.rotate(id, &curve, target),
            EndFitAction::Repeat => self.repeat(id, &curve),
            EndFitAction::BothAtOnce => self.both_at_once(id, &curve),
            EndFitAction::SetTolerance(tolerance) => {
                if tolerance > 0.0 && tolerance.is_finite() {
                    self.hand.end_fit.tolerance = Some(tolerance);
                } else {
                    self.outcome("The tolerance must be a length greater than 0", true);
                }
            }
        }
    }

    fn set_target(&mut self, curve: CurveId, label: &str, target: Option<EndTarget>) {
        self.hand.end_fit.begin_anew();
        let end = self.hand.end_fit.end;
        let edit = Edit::SetTarget { curve, end, target };
        if let Err(error) = self.workspace.apply(label, vec![edit]) {
            self.outcome(error.to_string(), true);
        }
        self.document_changed();
    }

    /// Step 5: translate the terminal vertices by the difference vector.
    fn translate(&mut self, id: CurveId, curve: &Arc<Curve>, target: Option<EndTarget>) {
        let Some(target) = target else {
            self.outcome("Set a target point first", true);
            return;
        };
        let end = self.hand.end_fit.end;
        let difference = EndDifference::between(&curve.polygon, end, &target);
        let label = format!("Translate {}", end.name());
        match translate_end(&curve.polygon, end, difference.vector) {
            Ok(polygon) => {
                let done = self.corrected(id, curve, &label, polygon);
                // Without a direction there is no step 6: this was a whole pass.
                self.hand.end_fit.passes += usize::from(done && target.direction.is_none());
            }
            Err(error) => self.outcome(error.to_string(), true),
        }
    }

    /// Step 6: rotate the terminal vertices by the difference angle about the actual end.
    fn rotate(&mut self, id: CurveId, curve: &Arc<Curve>, target: Option<EndTarget>) {
        let Some(direction) = target.and_then(|target| target.direction) else {
            self.outcome("Set a target direction first", true);
            return;
        };
        let end = self.hand.end_fit.end;
        let label = format!("Rotate {}", end.name());
        match align_end(&curve.polygon, end, direction) {
            Ok(polygon) => {
                let done = self.corrected(id, curve, &label, polygon);
                self.hand.end_fit.passes += usize::from(done);
            }
            Err(error) => self.outcome(error.to_string(), true),
        }
    }

    /// Step 7: repeat steps 2 to 6 on every end that has a target.
    fn repeat(&mut self, id: CurveId, curve: &Arc<Curve>) {
        let targets = curve.targets.list();
        if targets.is_empty() {
            self.outcome("Set a target first", true);
            return;
        }
        let tolerance = self.hand.end_fit.tolerance_for(curve);
        match correct_in_turn(&curve.polygon, &targets, tolerance) {
            Ok(outcome) if outcome.converged && outcome.passes() == 0 => {
                self.outcome("Already within the tolerance", false);
            }
            Ok(outcome) if outcome.converged => {
                let passes = outcome.passes();
                let total = self.hand.end_fit.passes + passes;
                let left = outcome.residuals.last().copied().unwrap_or_default();
                if !self.corrected(id, curve, "Repeat end correction", outcome.polygon) {
                    return;
                }
                self.hand.end_fit.passes = total;
                let passes = if passes == 1 {
                    "1 pass".into()
                } else {
                    format!("{passes} passes")
                };
                self.outcome(
                    format!("Within the tolerance after {passes}: {left:.1e} is left"),
                    false,
                );
            }
            Ok(outcome) => self.outcome(why_not(&curve.polygon, &outcome), true),
            Err(error) => self.outcome(error.to_string(), true),
        }
    }

    /// Correct both ends at once. An end without a target keeps its point and direction.
    fn both_at_once(&mut self, id: CurveId, curve: &Arc<Curve>) {
        if curve.targets.list().is_empty() {
            self.outcome("Set a target first", true);
            return;
        }
        let kept = |end: End| {
            let jet = curve.polygon.end_jet(end);
            EndTarget {
                point: jet.point,
                direction: jet.tangent(),
            }
        };
        let targets =
            End::BOTH.map(|end| (end, curve.targets.get(end).unwrap_or_else(|| kept(end))));
        match correct_jointly(&curve.polygon, &targets) {
            Ok(correction) => {
                let (moved, at) = (correction.largest_move, correction.largest_at);
                if self.corrected(id, curve, "Correct both ends", correction.polygon) {
                    self.hand.end_fit.largest_move = Some((moved, at));
                    self.outcome("Both ends are met", false);
                }
            }
            Err(error) => self.outcome(error.to_string(), true),
        }
    }

    /// Put the corrected polygon in place; `false`, with the reason as outcome, if it cannot be.
    fn corrected(
        &mut self,
        id: CurveId,
        before: &Arc<Curve>,
        label: &str,
        polygon: FloatPolygon,
    ) -> bool {
        let passes = self.hand.end_fit.passes;
        self.hand.end_fit.begin_anew();
        self.hand.end_fit.passes = passes;
        let edit = Edit::SetPolygon { curve: id, polygon };
        let done = self.workspace.apply(label, vec![edit]);
        match &done {
            Ok(()) => self.hand.end_fit.ghost = Some((id, before.clone())),
            Err(error) => self.outcome(error.to_string(), true),
        }
        self.document_changed();
        done.is_ok()
    }

    fn outcome(&mut self, text: impl Into<String>, failed: bool) {
        self.hand.end_fit.outcome = Some((text.into(), failed));
    }
}

/// Say why the loop was given up.
fn why_not(polygon: &FloatPolygon, outcome: &LoopOutcome) -> String {
    let passes = outcome.passes();
    let left = figure(outcome.residuals.last().copied().unwrap_or_default());
    let reason = match EndOverlap::of(polygon) {
        EndOverlap::None => "the ends do not settle".to_owned(),
        EndOverlap::Partial { shared } => {
            let shared = counted(shared, "vertex", "vertices");
            format!("the ends share {shared}, and correcting one keeps spoiling the other")
        }
        EndOverlap::OneSegment => {
            "the curve is one segment, and both ends depend on almost the same vertices".to_owned()
        }
    };
    format!(
        "Stopped after {passes} passes, {left} off: {reason}. Nothing was changed. Use “both ends at once”."
    )
}
