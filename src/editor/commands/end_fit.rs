//! The actions of the end-fit panel: the seven steps by button.

use crate::document::{Curve, CurveId, Edit, EndMatch, History, quoted};
use crate::editor::Editor;
use crate::editor::hand::end_fit::{EndFitAction, EndFitSettings, MATCH_END};
use crate::editor::operating::EndFitStep;
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::view::layers::{Layer, Layers};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{Continuity, End};
use crate::operations::{Operation, Value, correct_ends, rotate_end, translate_end};

const CHANGE_MATCH: &str = "Change match";
const FLIP_MATCH: &str = "Flip match";
const CHANGE_TARGET: &str = "Change target";

/// The steps that match an end.
const MATCHING: [&str; 3] = [MATCH_END, CHANGE_MATCH, FLIP_MATCH];

impl Editor {
    /// Do one thing of the end-fit panel, which tells what it came to; what is being tried out is
    /// ended.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be done; nothing is changed then.
    pub fn end_fit_action(&mut self, action: EndFitAction) -> Reply {
        let lost = self.interrupt().lost;
        self.message = Message::of(&Ok(lost));
        let (id, curve) = self.active_curve().ok_or("There is no curve")?;
        if curve.polygon.is_periodic() {
            return self.tell(Err(Refusal(format!(
                "{} is periodic and has no ends: open it first",
                quoted(&curve.name)
            ))));
        }
        let revision = self.workspace.revision();
        let end = self.hand.settings.end_fit.end;
        let mut step = EndFitStep {
            action,
            end,
            passes: 0,
        };
        let reply = match correction(action, &self.hand.settings.end_fit, &curve) {
            Some((operation, values)) => {
                step.passes = self
                    .hand
                    .last_end_fit_action(&self.workspace)
                    .map_or(0, |last| last.passes);
                let input = self.input_of(operation);
                let mut operating = self.operating();
                operating.apply_at_once(operation, input, &values, Some(step))
            }
            None => {
                let settings = &mut self.hand.settings.end_fit;
                let layers = &mut self.view.layers;
                let history = self.workspace.history();
                let edits = set_up(action, (id, &curve), history, settings, layers);
                edits.and_then(|edits| match edits {
                    Some((label, edits)) => self.make(label, edits, false),
                    None => Ok(Note::silent()),
                })
            }
        };
        let is_pending = self.previewed_operation().is_some();
        // An action that changed nothing leaves the last one.
        if !is_pending && (reply.is_err() || self.workspace.revision() != revision) {
            self.operating().keep_end_fit_action(step, &reply);
        }
        // The last lines of the panel may lie below its edge.
        if !is_pending && reply.as_ref().is_ok_and(|note| note.warns) {
            self.message = Message::of(&reply);
        }
        reply
    }
}

/// Change a setting of the end fit, or return the edits that set the target or the match, with a label.
fn set_up(
    action: EndFitAction,
    (id, curve): (CurveId, &Curve),
    history: &History,
    settings: &mut EndFitSettings,
    layers: &mut Layers,
) -> Result<Option<(&'static str, Vec<Edit>)>, Refusal> {
    let document = history.document();
    let end = settings.end;
    let matched = document.match_of(id, end).copied();
    // What the target was picked from, if it still is that.
    let picked = settings.picked.filter(|picked| {
        let is_own = (picked.curve, picked.end) == (id, end);
        let is_there = picked.target(document).is_some();
        is_own && matched.is_none() && curve.targets.get(end).is_some() && is_there
    });
    match action {
        EndFitAction::Choose(end) => {
            settings.end = end;
            settings.picking = false;
            return Ok(None);
        }
        EndFitAction::ShowClosed(closed) => {
            settings.closed = closed;
            if !closed {
                layers.set(Layer::Float, true);
            }
            return Ok(None);
        }
        EndFitAction::PickFromCurve => {
            settings.picking = !settings.picking;
            return Ok(None);
        }
        EndFitAction::SetTolerance(tolerance) => {
            if !(tolerance > 0.0 && tolerance.is_finite()) {
                return Err("The tolerance must be a length greater than 0".into());
            }
            settings.tolerance = Some(tolerance);
            return Ok(None);
        }
        EndFitAction::SetContinuity(continuity) => {
            let old = std::mem::replace(&mut settings.continuity, continuity);
            let at = |continuity: Continuity, matched: EndMatch| EndMatch {
                continuity,
                ..matched
            };
            if let Some(matched) = matched {
                let edits = rematch(history, at(continuity, matched));
                return Ok(Some((CHANGE_MATCH, edits)));
            }
            // A target that is as it was picked gets what the place has up to the level.
            let target = |level: Continuity| at(level, picked?).target(document);
            let is_as_picked = curve.targets.get(end) == target(old);
            let target = target(continuity).filter(|_| is_as_picked);
            let set = target.map(|target| Edit::SetTarget {
                curve: id,
                end,
                target: Some(target),
            });
            return Ok(set.map(|set| (CHANGE_TARGET, vec![set])));
        }
        EndFitAction::KeepMatched(live) => {
            settings.live = live;
            if !live {
                let remove = Edit::RemoveMatch { curve: id, end };
                return Ok(matched.map(|_| ("Remove match", vec![remove])));
            }
            // A target that was picked before is matched now.
            let kept = picked.map(|picked| EndMatch {
                continuity: settings.continuity,
                ..picked
            });
            return Ok(kept.map(|kept| (MATCH_END, vec![Edit::SetMatch(kept)])));
        }
        EndFitAction::TurnRound if matched.is_some() => {
            let turned = matched.map(|matched| EndMatch {
                reversed: !matched.reversed,
                ..matched
            });
            return Ok(turned.map(|turned| (FLIP_MATCH, rematch(history, turned))));
        }
        _ => {}
    }
    let (label, target) = action.target(curve, end);
    let mut edits = Vec::new();
    if action == EndFitAction::ClearTarget && matched.is_some() {
        edits.push(Edit::RemoveMatch { curve: id, end });
    }
    edits.push(Edit::SetTarget {
        curve: id,
        end,
        target,
    });
    Ok(Some((label, edits)))
}

/// The edits that change a match. They begin from the curve before it was matched, if nothing else came in between:
/// what a match in the wrong sense made of it does not count.
fn rematch(history: &History, matched: EndMatch) -> Vec<Edit> {
    let id = matched.curve;
    let [now, before] = [history.document(), history.before(&MATCHING)]
        .map(|document| document.curve(id).map(|curve| &curve.polygon));
    let begun = before.filter(|before| {
        now.is_some_and(|now| now != *before && now.vertices().len() == before.vertices().len())
    });
    let begin = begun.map(|polygon| Edit::SetPolygon {
        curve: id,
        polygon: polygon.clone(),
    });
    begin.into_iter().chain([Edit::SetMatch(matched)]).collect()
}

impl EndFitAction {
    /// Preview the target that a field of the end-fit panel sets while it is dragged.
    pub fn preview(self, editor: &mut Editor) {
        let end = editor.hand.settings.end_fit.end;
        if let Some((curve, found)) = editor.active_curve() {
            let (_, target) = self.target(&found, end);
            let edit = Edit::SetTarget { curve, end, target };
            editor.preview("Set target", vec![edit]);
        }
    }

    /// The target that an action sets at an end, with the label of the step.
    fn target(self, curve: &Curve, end: End) -> (&'static str, Option<EndTarget>) {
        let planar = curve.polygon.is_planar();
        let jet = curve.polygon.end_jet(end);
        let actual = |level: Continuity| level.target(&jet, planar);
        let before = curve.targets.get(end);
        let target = before.unwrap_or(actual(Continuity::G1));
        // Curvature is that of a direction, and slope that of a curvature.
        let directed = EndTarget {
            direction: target.direction.or(actual(Continuity::G1).direction),
            ..target
        };
        let set = |fixed: bool, labels: [&'static str; 2]| labels[usize::from(fixed)];
        match self {
            Self::TargetActual => ("Set target", Some(actual(Continuity::G1))),
            Self::SetTarget(target) => ("Set target", Some(target)),
            Self::SetPoint(point) => ("Set target point", Some(EndTarget { point, ..target })),
            Self::SetDirection(Some(direction)) => {
                let direction = Some(direction);
                let turned = EndTarget {
                    direction,
                    ..target
                };
                ("Set target direction", Some(turned))
            }
            Self::SetDirection(None) => {
                let free = EndTarget {
                    point: target.point,
                    ..EndTarget::default()
                };
                ("Free target direction", Some(free))
            }
            Self::SetCurvature(curvature) => {
                let slope = target.slope.filter(|_| curvature.is_some());
                let curved = EndTarget {
                    curvature,
                    slope,
                    ..directed
                };
                let labels = ["Free target curvature", "Set target curvature"];
                (set(curvature.is_some(), labels), Some(curved))
            }
            Self::SetNormal(normal) => {
                let labels = ["Free target plane", "Set target plane"];
                let turned = EndTarget { normal, ..directed };
                (set(normal.is_some(), labels), Some(turned))
            }
            Self::SetSlope(slope) => {
                let actual = || actual(Continuity::G2).curvature;
                let curvature = match slope {
                    Some(_) => target.curvature.or_else(actual),
                    None => target.curvature,
                };
                let sloped = EndTarget {
                    curvature,
                    slope,
                    ..directed
                };
                let labels = ["Free target slope", "Set target slope"];
                (set(slope.is_some(), labels), Some(sloped))
            }
            Self::TurnRound => ("Flip direction", before.map(|it| it.turned(planar))),
            _ => ("Clear target", None),
        }
    }
}

/// An operation and values of its parameters.
type Correction = (&'static Operation, Vec<(&'static str, Value)>);

/// The operation that an action stands for, if it is one, with its values.
fn correction(
    action: EndFitAction,
    settings: &EndFitSettings,
    curve: &Curve,
) -> Option<Correction> {
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
