//! Doing what the end-fit panel asks for: the seven steps by button.

use crate::document::{Curve, CurveId, Edit, quoted};
use crate::editor::Editor;
use crate::editor::hand::end_fit::{EndFitAction, EndFitReport, LastAction};
use crate::editor::hand::tools::ToolKind;
use crate::editor::reply::{Note, Refusal, Reply};
use crate::editor::trial::Trial;
use crate::editor::view::layers::Layer;
use crate::geometry::End;
use crate::geometry::end_correction::EndTarget;
use crate::operations::{Operation, Report, Value, correct_ends, rotate_end, translate_end};

impl Editor {
    /// Collect the figures of the seven steps, if the end-fit tool is used and the active curve
    /// has ends.
    pub fn end_fit(&self) -> Option<EndFitReport> {
        if self.hand.tool() != ToolKind::EndFit {
            return None;
        }
        let (id, curve) = self.active_curve()?;
        if curve.polygon.is_periodic() {
            return None;
        }
        let last = self.last_end_fit_action();
        let settings = &self.hand.tools.end_fit.settings;
        Some(settings.report(self.analyses.get(id)?, last))
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
        let revision = self.workspace.revision();
        let (reply, passes) = match self.correction(action, &curve) {
            Some((operation, values)) => {
                let passes = self.last_end_fit_action().map_or(0, |last| last.passes);
                (self.operate(operation, &values), passes)
            }
            None => (self.set_up(action, id, &curve), 0),
        };
        if self.is_trying() {
            self.hand.tools.end_fit.awaited = Some((action, passes));
        } else if reply.is_err() || self.workspace.revision() != revision {
            // What is only looked at otherwise leaves what was told before.
            self.keep_end_fit_action(action, passes, &reply);
        }
        reply
    }

    /// Keep what an action came to, for the panel; so many passes were made before it.
    pub(in crate::editor) fn keep_end_fit_action(
        &mut self,
        action: EndFitAction,
        passes: usize,
        reply: &Reply,
    ) {
        let Some((curve, found)) = self.active_curve() else {
            return;
        };
        let report = self.trial().and_then(Trial::report);
        let report = report.filter(|_| reply.is_ok());
        let made = report.map_or(0, |report| passes_of(action, &found, report));
        let joint = action == EndFitAction::BothAtOnce;
        // The figures of the steps say what these two came to.
        let silent = matches!(action, EndFitAction::Translate | EndFitAction::Rotate);
        let reply = match reply {
            Ok(_) if silent => Ok(Note::silent()),
            reply => reply.clone(),
        };
        let largest_move = report.and_then(|report| report.largest_move);
        self.hand.tools.end_fit.last = Some(LastAction {
            curve,
            revision: self.workspace.revision(),
            passes: passes + made,
            largest_move: largest_move.filter(|_| joint),
            reply,
        });
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
                (
                    "Set target",
                    Some(EndTarget {
                        point,
                        direction,
                        ..EndTarget::default()
                    }),
                )
            }
            EndFitAction::SetPoint(point) => {
                let direction = target.map_or(jet.tangent(), |target| target.direction);
                (
                    "Set target point",
                    Some(EndTarget {
                        point,
                        direction,
                        ..EndTarget::default()
                    }),
                )
            }
            EndFitAction::SetDirection(direction) => {
                let point = target.map_or(jet.point, |target| target.point);
                let label = match direction {
                    Some(_) => "Set target direction",
                    None => "Free target direction",
                };
                (
                    label,
                    Some(EndTarget {
                        point,
                        direction,
                        ..EndTarget::default()
                    }),
                )
            }
            EndFitAction::TurnRound => (
                "Turn target round",
                target.map(|target| target.turned(curve.polygon.is_planar())),
            ),
            _ => ("Clear target", None),
        };
        let edit = Edit::SetTarget {
            curve: id,
            end,
            target,
        };
        self.make(label, vec![edit], false)
    }

    /// The operation that an action stands for, if it is one, with its values.
    fn correction(&self, action: EndFitAction, curve: &Curve) -> Option<Correction> {
        let settings = &self.hand.tools.end_fit.settings;
        let end = Value::Choice(usize::from(settings.end == End::Finish));
        let tolerance = Value::Real(settings.tolerance_for(curve));
        Some(match action {
            EndFitAction::Translate => (&translate_end::OPERATION, vec![("end", end)]),
            EndFitAction::Rotate => (&rotate_end::OPERATION, vec![("end", end)]),
            EndFitAction::BothAtOnce | EndFitAction::Repeat => {
                let method = usize::from(action == EndFitAction::Repeat);
                let method = ("method", Value::Choice(method));
                (
                    &correct_ends::OPERATION,
                    vec![method, ("tolerance", tolerance)],
                )
            }
            _ => return None,
        })
    }
}

/// An operation and values of its parameters.
type Correction = (&'static Operation, Vec<(&'static str, Value)>);

/// How many passes of steps 2 to 6 an action made.
fn passes_of(action: EndFitAction, curve: &Curve, report: &Report) -> usize {
    match action {
        // Without a direction there is no step 6: this was a whole pass.
        EndFitAction::Translate => {
            let targets = curve.targets.list();
            usize::from(targets.iter().all(|(_, target)| target.direction.is_none()))
        }
        EndFitAction::Rotate => 1,
        EndFitAction::Repeat => match report.figure("passes") {
            Some(Value::Whole(passes)) => passes,
            _ => 0,
        },
        _ => 0,
    }
}
