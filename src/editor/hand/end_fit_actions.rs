//! Doing what the end-fit panel asks for: the seven steps by button.

use std::fmt::Display;

use crate::document::{Curve, CurveId, Edit, quoted};
use crate::editor::Editor;
use crate::editor::hand::end_fit::{EndFitAction, EndFitReport, LastAction};
use crate::editor::hand::tools::ToolKind;
use crate::editor::reply::{Note, Refusal, Reply};
use crate::editor::view::layers::Layer;
use crate::geometry::end_correction::{
    EndDifference, EndOverlap, EndTarget, LoopOutcome, align_end, correct_in_turn, translate_end,
};
use crate::geometry::joint_correction::correct_jointly;
use crate::geometry::{End, FloatPolygon, counted, figure};

/// What a correction came to.
struct Correction {
    label: String,
    polygon: FloatPolygon,
    note: Note,
    /// How many passes of steps 2 to 6 it made.
    passes: usize,
    largest_move: Option<(f64, usize)>,
}

impl Editor {
    /// Collect the figures of the seven steps, if the end-fit tool is used and the active curve
    /// has ends.
    pub fn end_fit(&mut self) -> Option<EndFitReport> {
        if self.hand.tool() != ToolKind::EndFit {
            return None;
        }
        let (id, curve) = self.active_curve()?;
        if curve.polygon.is_periodic() {
            return None;
        }
        self.analyses.update(self.workspace.document());
        let last = self.last_end_fit_action().cloned();
        let settings = &self.hand.tools.end_fit.settings;
        Some(settings.report(self.analyses.get(id)?, last.as_ref()))
    }

    /// What the last action of the end-fit panel came to, unless something else happened since.
    pub(in crate::editor) fn last_end_fit_action(&self) -> Option<&LastAction> {
        let last = self.hand.tools.end_fit.last.as_ref()?;
        let counts = self.hand.tool() == ToolKind::EndFit
            && Some(last.curve) == self.active()
            && last.revision == self.workspace.revision()
            && self.workspace.preview().is_none();
        counts.then_some(last)
    }

    /// Do one thing of the end-fit panel, which tells what it came to; what is being tried out is
    /// ended.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be done; nothing is changed then.
    pub fn end_fit_action(&mut self, action: EndFitAction) -> Reply {
        self.interrupt();
        self.message = None;
        let (id, curve) = self.active_curve().ok_or("There is no curve")?;
        if curve.polygon.is_periodic() {
            return self.tell(Err(Refusal(format!(
                "{} is periodic and has no ends: open it first",
                quoted(&curve.name)
            ))));
        }
        let passes = self.last_end_fit_action().map_or(0, |last| last.passes);
        let revision = self.workspace.revision();
        let correction = self.correction(action, &curve);
        let (made, largest_move) = match &correction {
            Some(Ok(correction)) => (correction.passes, correction.largest_move),
            _ => (0, None),
        };
        let (reply, before) = match correction {
            Some(correction) => {
                let reply = correction.and_then(|correction| self.corrected(id, correction));
                let before = reply.is_ok().then(|| curve.clone());
                (reply, before)
            }
            None => (self.set_up(action, id, &curve), None),
        };
        if reply.is_ok() && self.workspace.revision() == revision {
            // What is only looked at otherwise leaves what was told before.
            return reply;
        }
        let changed = before.is_some();
        self.hand.tools.end_fit.last = Some(LastAction {
            curve: id,
            revision: self.workspace.revision(),
            reply: reply.clone(),
            passes: passes + if changed { made } else { 0 },
            largest_move: largest_move.filter(|_| changed),
            before,
        });
        reply
    }

    /// Do what corrects nothing: choose what is worked on, or set the target.
    fn set_up(&mut self, action: EndFitAction, id: CurveId, curve: &Curve) -> Reply {
        let settings = &mut self.hand.tools.end_fit.settings;
        let end = settings.end;
        let target = curve.targets.get(end);
        let jet = curve.polygon.end_jet(end);
        let (label, target) = match action {
            EndFitAction::Choose(end) => {
                settings.end = end;
                settings.picking = false;
                return Ok(Note::silent());
            }
            EndFitAction::ShowClosed(closed) => {
                settings.closed = closed;
                if !closed {
                    self.view.layers.set(Layer::Float, true);
                }
                return Ok(Note::silent());
            }
            EndFitAction::PickFromCurve => {
                settings.picking = !settings.picking;
                return Ok(Note::silent());
            }
            EndFitAction::SetTolerance(tolerance) => {
                if !(tolerance > 0.0 && tolerance.is_finite()) {
                    return Err("The tolerance must be a length greater than 0".into());
                }
                settings.tolerance = Some(tolerance);
                return Ok(Note::silent());
            }
            EndFitAction::TargetActual => {
                let (point, direction) = (jet.point, jet.tangent());
                ("Set target", Some(EndTarget { point, direction }))
            }
            EndFitAction::SetPoint(point) => {
                let direction = target.map_or(jet.tangent(), |target| target.direction);
                ("Set target point", Some(EndTarget { point, direction }))
            }
            EndFitAction::SetDirection(direction) => {
                let point = target.map_or(jet.point, |target| target.point);
                let label = match direction {
                    Some(_) => "Set target direction",
                    None => "Free target direction",
                };
                (label, Some(EndTarget { point, direction }))
            }
            EndFitAction::TurnRound => ("Turn target round", target.map(EndTarget::turned)),
            _ => ("Clear target", None),
        };
        let edit = Edit::SetTarget {
            curve: id,
            end,
            target,
        };
        self.make(label, vec![edit], false)
    }

    /// Work out a correction, if the action is one.
    fn correction(
        &self,
        action: EndFitAction,
        curve: &Curve,
    ) -> Option<Result<Correction, Refusal>> {
        let settings = &self.hand.tools.end_fit.settings;
        let tolerance = settings.tolerance_for(curve);
        Some(match action {
            EndFitAction::Translate => translated(curve, settings.end),
            EndFitAction::Rotate => rotated(curve, settings.end),
            EndFitAction::Repeat => repeated(curve, tolerance),
            EndFitAction::BothAtOnce => jointly_corrected(curve),
            _ => return None,
        })
    }

    fn corrected(&mut self, curve: CurveId, correction: Correction) -> Reply {
        let polygon = correction.polygon;
        let edit = Edit::SetPolygon { curve, polygon };
        self.make(&correction.label, vec![edit], false)?;
        Ok(correction.note)
    }
}

fn refused(error: impl Display) -> Refusal {
    Refusal(error.to_string())
}

/// Step 5: translate the terminal vertices by the difference vector.
fn translated(curve: &Curve, end: End) -> Result<Correction, Refusal> {
    let target = curve.targets.get(end).ok_or("Set a target point first")?;
    let difference = EndDifference::between(&curve.polygon, end, &target);
    let polygon = translate_end(&curve.polygon, end, difference.vector).map_err(refused)?;
    Ok(Correction {
        label: format!("Translate {}", end.name()),
        polygon,
        note: Note::silent(),
        // Without a direction there is no step 6: this was a whole pass.
        passes: usize::from(target.direction.is_none()),
        largest_move: None,
    })
}

/// Step 6: rotate the terminal vertices by the difference angle about the actual end.
fn rotated(curve: &Curve, end: End) -> Result<Correction, Refusal> {
    let target = curve.targets.get(end).and_then(|target| target.direction);
    let direction = target.ok_or("Set a target direction first")?;
    Ok(Correction {
        label: format!("Rotate {}", end.name()),
        polygon: align_end(&curve.polygon, end, direction).map_err(refused)?,
        note: Note::silent(),
        passes: 1,
        largest_move: None,
    })
}

/// Step 7: repeat steps 2 to 6 on every end that has a target.
fn repeated(curve: &Curve, tolerance: f64) -> Result<Correction, Refusal> {
    let targets = curve.targets.list();
    if targets.is_empty() {
        return Err("Set a target first".into());
    }
    let outcome = correct_in_turn(&curve.polygon, &targets, tolerance).map_err(refused)?;
    if !outcome.converged {
        return Err(Refusal(why_not(&curve.polygon, &outcome)));
    }
    let passes = outcome.passes();
    let left = outcome.residuals.last().copied().unwrap_or_default();
    let text = match passes {
        0 => "Already within the tolerance".to_owned(),
        _ => format!(
            "Within the tolerance after {}: {left:.1e} is left",
            counted(passes, "pass", "passes")
        ),
    };
    Ok(Correction {
        label: "Repeat end correction".to_owned(),
        polygon: outcome.polygon,
        note: Note::told(text),
        passes,
        largest_move: None,
    })
}

/// Correct both ends at once. An end without a target keeps its point and direction.
fn jointly_corrected(curve: &Curve) -> Result<Correction, Refusal> {
    if curve.targets.list().is_empty() {
        return Err("Set a target first".into());
    }
    let kept = |end: End| {
        let jet = curve.polygon.end_jet(end);
        EndTarget {
            point: jet.point,
            direction: jet.tangent(),
        }
    };
    let targets = End::BOTH.map(|end| (end, curve.targets.get(end).unwrap_or_else(|| kept(end))));
    let correction = correct_jointly(&curve.polygon, &targets).map_err(refused)?;
    Ok(Correction {
        label: "Correct both ends".to_owned(),
        polygon: correction.polygon,
        note: Note::told("Both ends are met"),
        passes: 0,
        largest_move: Some((correction.largest_move, correction.largest_at)),
    })
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
