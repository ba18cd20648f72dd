//! The end-fit panel: the target, and the seven steps with their figures and buttons.

use eframe::egui::{Align2, Button, Rect, RichText, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::end_fit_target::target_ui;
use super::figures::angle;
use super::message::sentence;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets::above_noise;
use super::{document_unit, figures, icons, widgets};
use crate::editor::{Editor, EndFitAction, EndFitReport, Layer, Refusal, told};
use crate::geometry::end_correction::EndOverlap;
use crate::geometry::parameters::Quantity;
use crate::geometry::{End, counted};
use crate::operations::LargestMove;

/// The width of the field for the tolerance.
const FIELD: f32 = 96.0;

/// The height of the place for the last action's message.
const OUTCOME: f32 = 15.0 * STEP;

/// The indentation of what belongs to a step.
const INDENT: f32 = 28.0;

/// The width of a step's button.
const BUTTON: f32 = 76.0;

/// Show the panel: the steps, and below them the last action's message.
pub fn end_fit_panel_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(report) = editor.hand().end_fit(editor.workspace(), editor.view()) else {
        empty_ui(ui, editor);
        return;
    };
    let is_closed = !editor.sight().layers().shows(Layer::Float);
    let pixel = editor.view().viewport().pixel();
    // Each end of each curve has fields of its own, so that no text goes to another end.
    let id = (editor.active(), report.end);
    let panel = |ui: &mut Ui| {
        let end = ends_ui(ui, report.end).or(both_ui(ui, &report));
        let event = target_ui(ui, &report, pixel);
        if let Some(refusal) = &report.refusal {
            widgets::note(ui, &sentence(refusal));
        }
        ui.add_space(STEP);
        let step = steps_ui(ui, &report, is_closed);
        step.or(end).map(FieldEvent::Set).or(event)
    };
    let room = ui.available_rect_before_wrap();
    // The place for the message is always there, so that nothing moves when one comes.
    let footer = ROW + 2.0 * STEP + OUTCOME;
    let (above, below) = room.split_top_bottom_at_y(room.bottom() - footer);
    let event = inside(ui, above, |ui| {
        widgets::scrolling(ui, "end fit", |ui| ui.push_id(id, panel).inner)
    });
    let last = inside(ui, below, |ui| {
        let last = last_step_ui(ui, &report);
        widgets::scrolling(ui, "end fit outcome", |ui| outcome_ui(ui, &report));
        last
    });
    if let Some(event) = last.map(FieldEvent::Set).or(event) {
        event.send(
            editor,
            |editor, action| action.preview(editor),
            |editor, action| told(editor.end_fit_action(action)),
        );
    }
}

/// Show contents in a part of the panel, and nothing of them beside it.
fn inside<R>(ui: &mut Ui, part: Rect, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let shown = ui.scope_builder(UiBuilder::new().max_rect(part), |ui| {
        ui.shrink_clip_rect(part);
        contents(ui)
    });
    shown.inner
}

fn empty_ui(ui: &mut Ui, editor: &Editor) {
    ui.strong("End fit");
    let active = editor.active().and_then(|id| editor.document().curve(id));
    let text = match active {
        Some(curve) if curve.polygon.is_periodic() => {
            "A periodic curve has no ends. Open it first (Curve menu)."
        }
        Some(_) => "This curve cannot be corrected.",
        None => "Select an open curve to correct its ends.",
    };
    widgets::note(ui, text);
}

fn ends_ui(ui: &mut Ui, chosen: End) -> Option<EndFitAction> {
    let mut action = None;
    ui.horizontal(|ui| {
        ui.strong("End fit");
        widgets::at_right(ui, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            for (end, name) in [(End::Finish, "End"), (End::Start, "Start")] {
                let button = Button::selectable(chosen == end, name);
                if ui.add_sized(vec2(56.0, ROW), button).clicked() {
                    action = Some(EndFitAction::Choose(end));
                }
            }
        });
    });
    action
}

/// Show the seven steps.
fn steps_ui(ui: &mut Ui, report: &EndFitReport, is_closed: bool) -> Option<EndFitAction> {
    let has_point = report.target.is_some();
    let has_direction = report.target_direction().is_some() && report.actual.direction.is_some();
    let is_in_place = has_point && report.difference.length() <= report.tolerance;
    let is_aligned = report.angle.abs() <= 1e-9;
    let count = counted(report.terminal, "vertex", "vertices");
    // The button of a correction: its label, its name for screen readers and its help.
    let button = |[label, name, help]: [&'static str; 3], is_ready: bool, action: EndFitAction| {
        move |ui: &mut Ui| {
            let button = Button::new(label).min_size(vec2(BUTTON, ROW));
            let response = ui.add_enabled(is_ready && report.can_move(), button);
            let response = response.accessible_name(name).on_hover_text(help);
            response.clicked().then_some(action)
        }
    };
    step_ui(ui, 1, "Shape float S-polygon", false, |_| ());
    let closed = step_ui(ui, 2, "Closed S-polygon", false, |ui| {
        closed_ui(ui, is_closed)
    });
    let is_met = is_in_place && is_aligned && report.is_met();
    step_ui(ui, 3, "Difference to target", is_met, |_| ());
    indented(ui, |ui| difference_ui(ui, report));
    step_ui(ui, 4, "Back to float", false, |_| ());
    let translate = [
        "Translate",
        "Translate terminal vertices",
        "Translate the terminal vertices, as one body, by the difference vector",
    ];
    let translate = button(translate, has_point, EndFitAction::Translate);
    let translated = step_ui(ui, 5, &format!("Move {count}"), is_in_place, translate);
    let rotate = [
        "Rotate",
        "Rotate terminal vertices",
        "Rotate the terminal vertices about the end point by the difference angle",
    ];
    let rotate = button(rotate, has_direction, EndFitAction::Rotate);
    // In their order: a tick below an open step would say that it is done.
    let is_turned = has_direction && is_aligned && is_in_place;
    let rotated = step_ui(ui, 6, &format!("Turn {count}"), is_turned, rotate);
    let rest = indented(ui, |ui| repeat_ui(ui, report));
    let actions = [closed, translated, rotated];
    rest.or(actions.into_iter().flatten().next())
}

/// One step's row: its number, its title with a check mark once it is done, and its button.
fn step_ui<R>(
    ui: &mut Ui,
    number: usize,
    title: &str,
    is_done: bool,
    button: impl FnOnce(&mut Ui) -> R,
) -> R {
    ui.add_space(0.5 * STEP);
    let row = ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.set_min_height(ROW);
        let (rect, response) = ui.allocate_exact_size(vec2(INDENT, ROW), Sense::hover());
        let tokens = Tokens::of(ui);
        let badge = Rect::from_center_size(rect.left_center() + vec2(9.0, 0.0), vec2(18.0, 18.0));
        let (state, colour) = match is_done {
            true => ("done", tokens.good),
            false => ("open", tokens.faint_text),
        };
        widgets::outline(ui, badge, 1.0, colour);
        let (align, font) = (Align2::CENTER_CENTER, theme::small_font());
        widgets::text_in(ui, badge, align, number, font, tokens.text);
        let name = format!("step {number}: {state}");
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &name));
        ui.label(RichText::new(title).color(tokens.strong_text));
        if is_done {
            ui.add_space(1.5 * STEP);
            ui.label(icons::text(Icon::Check).color(tokens.good));
        }
        widgets::at_right(ui, button)
    });
    row.inner
}

/// Put contents below the title of their step.
fn indented<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let row = ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.add_space(INDENT);
        let contents = ui.vertical(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0 * STEP, 0.5 * STEP);
            contents(ui)
        });
        contents.inner
    });
    row.inner
}

/// Show which S-polygon is shown.
fn closed_ui(ui: &mut Ui, is_closed: bool) -> Option<EndFitAction> {
    ui.spacing_mut().item_spacing.x = 0.0;
    let mut action = None;
    for (name, wanted) in [("Closed", true), ("Float", false)] {
        let response = ui.add(Button::selectable(is_closed == wanted, name));
        let name = format!("Show {} S-polygon", name.to_lowercase());
        if response.accessible_name(name).clicked() && is_closed != wanted {
            action = Some(EndFitAction::ShowClosed(wanted));
        }
    }
    action
}

/// Show the difference, always in as many rows.
fn difference_ui(ui: &mut Ui, report: &EndFitReport) {
    let noise = report.noise;
    let plain = |value: f64| figures::significant(value, 6);
    let length = |value| document_unit::length(ui.ctx(), plain(value));
    let length = |value| above_noise(value, noise.length, length);
    let d = report.target.map(|_| report.difference);
    let mut pairs = vec![
        ("Δx", d.map(|d| length(d.x))),
        ("Δy", d.map(|d| length(d.y))),
    ];
    if !report.planar {
        pairs.push(("Δz", d.map(|d| length(d.z))));
    }
    pairs.push(("Length", d.map(|d| length(d.length()))));
    let turn = d.map(|_| above_noise(report.angle, noise.angle, angle));
    pairs.push(("Angle", turn));
    let asked = report.target.zip(report.missing);
    let curvature = asked.filter(|(target, _)| target.curvature.is_some());
    let curvature =
        curvature.map(|(_, missing)| above_noise(missing.curvature, noise.curvature, plain));
    pairs.push(("Δκ", curvature));
    if !report.planar {
        let plane = asked.filter(|(target, _)| target.normal.is_some());
        let plane = plane.map(|(_, missing)| above_noise(missing.plane, noise.angle, angle));
        pairs.push(("Plane", plane));
    }
    let slope = asked.filter(|(target, _)| target.slope.is_some());
    let slope = slope.map(|(_, missing)| above_noise(missing.slope, noise.slope, plain));
    pairs.push(("Δdκ/ds", slope));
    let none = || ("–".to_owned(), None);
    let pairs: Vec<_> = pairs
        .into_iter()
        .map(|(name, it)| (name, it.unwrap_or_else(none)))
        .collect();
    widgets::figure_pairs(ui, &pairs);
}

/// Step 7, which is always in reach.
fn last_step_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    ui.set_max_width(ui.available_width() - ui.spacing().scroll.allocated_width());
    let is_met = report.targets > 0 && report.within;
    step_ui(ui, 7, "Refine and repeat", is_met, |ui| {
        let button = Button::new("Repeat").min_size(vec2(BUTTON, ROW));
        let help = "Repeat steps 2 to 6 on both ends until within the tolerance";
        let bends = bends(report);
        let instead = if bends {
            BENDS
        } else {
            "Set a target first, on a curve that is not locked"
        };
        let response = ui.add_enabled(is_ready(report) && !bends, button);
        let response = response.on_hover_text(help).on_disabled_hover_text(instead);
        response.clicked().then_some(EndFitAction::Repeat)
    })
}

/// Why the steps do not do what is required.
const BENDS: &str = "“Both ends at once” meets curvatures, also of one end; steps 5 and 6 do not.";

/// Whether the target requires more than the steps do: they move and turn.
fn bends(report: &EndFitReport) -> bool {
    report.target.is_some_and(|target| {
        target.curvature.is_some() || target.slope.is_some() || target.normal.is_some()
    })
}

/// The usual correction: both ends at once.
fn both_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    let width = ui.available_width();
    let both = ui.add_enabled_ui(is_ready(report), |ui| {
        ui.add_sized(vec2(width, ROW), Button::new("Both ends at once"))
    });
    let help = "Meet all targets at once, with the smallest moves of vertices";
    let both = both.inner.on_hover_text(help).clicked();
    both.then_some(EndFitAction::BothAtOnce)
}

/// Whether there are targets to meet, and vertices that may move.
fn is_ready(report: &EndFitReport) -> bool {
    report.targets > 0 && report.can_move()
}

/// Below step 6: the error that is left, and the tolerance.
fn repeat_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    let length = |ui: &Ui, value| document_unit::length(ui.ctx(), figures::significant(value, 4));
    let none = || ("–".to_owned(), None);
    let largest = report.largest_move.map(|LargestMove { distance, vertex }| {
        format!("{} at vertex {vertex}", length(ui, distance))
    });
    widgets::figure_row(
        ui,
        "Largest move",
        &largest.unwrap_or_else(|| "–".to_owned()),
    );
    let (distance, turn) = match report.targets {
        0 => (none(), none()),
        _ => (
            above_noise(report.remaining_distance, report.noise.length, |it| {
                length(ui, it)
            }),
            above_noise(report.remaining_angle, report.noise.angle, angle),
        ),
    };
    let tooltip = "The error of the end that is farther from its target";
    let remaining = (format!("{}  {}", distance.0, turn.0), distance.1.or(turn.1));
    widgets::quiet_row(ui, "Remaining error", &remaining).on_hover_text(tooltip);
    let tolerance = widgets::form_row(ui, "Tolerance", |ui| {
        let text = figures::significant(report.tolerance, 4);
        let field = NumberField::new("tolerance", report.tolerance, text);
        let field = field.range(0.0..=f64::MAX).quantity(Quantity::Length);
        let typed = field.width(FIELD).typed(ui);
        let passes = counted(report.passes, "pass", "passes");
        ui.label(RichText::new(passes).color(Tokens::of(ui).faint_text));
        typed
    });
    tolerance.inner.map(EndFitAction::SetTolerance)
}

/// Warn where the groups of vertices of both ends overlap.
fn overlap_ui(ui: &mut Ui, overlap: EndOverlap) {
    let text = match overlap {
        EndOverlap::None => return,
        EndOverlap::Partial { shared } => format!(
            "Both ends share {}. Repeating converges slowly, if at all: use “Both ends at once”.",
            counted(shared, "vertex", "vertices")
        ),
        EndOverlap::OneSegment => {
            "Too few vertices to move each end on its own: use “Both ends at once”.".to_owned()
        }
    };
    let warning = Tokens::of(ui).warning;
    widgets::remark_with_icon(ui, Icon::Info, &text, warning);
}

/// Show the last action's message, and below it whether ends that are not met yet share vertices.
fn outcome_ui(ui: &mut Ui, report: &EndFitReport) {
    let tokens = Tokens::of(ui);
    let message = match &report.outcome {
        None => None,
        Some(Ok(note)) if note.warns => Some((&note.text, Icon::TriangleAlert, tokens.warning)),
        Some(Ok(note)) => Some((&note.text, Icon::Check, tokens.good)),
        Some(Err(Refusal(reason))) => Some((reason, Icon::TriangleAlert, tokens.error)),
    };
    match message {
        Some((text, icon, colour)) if !text.is_empty() => {
            widgets::remark_with_icon(ui, icon, text, colour);
        }
        None if report.target.is_none() => {
            let text = "No target yet: click its place beside the end, or “Use current end”.";
            widgets::note(ui, text);
        }
        _ => {}
    }
    // A refusal says the same.
    let has_failed = matches!(report.outcome, Some(Err(_)));
    if has_failed {
        return;
    }
    if bends(report) && !report.is_met() {
        widgets::note(ui, BENDS);
    } else if is_ready(report) && !report.within {
        overlap_ui(ui, report.overlap);
    }
}
