//! The end-fit panel's part about other curves: picking a target from one, and keeping it matched.

use eframe::egui::{Button, Checkbox, Label, RichText, Ui, vec2};
use lucide_icons::Icon;

use super::end_fit_steps::{angle_text, figure_pairs, remark_ui};
use super::theme::{ROW, STEP, Tokens};
use super::widgets::IconButton;
use super::{figures, icons, widgets};
use crate::document::{MatchPlace, quoted};
use crate::editor::{EndFitAction, EndFitReport, MatchReport};
use crate::geometry::Continuity;

/// The width of the buttons beside a match.
const BUTTONS: f32 = 2.0 * ROW + 4.0 * STEP;

/// Show the level that is picked or kept, the match that there is, and the curves that follow.
pub fn match_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    let mut action = level_ui(ui, report);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * STEP;
        let pick = ui.add(Button::new("Pick from curve").selected(report.picking));
        let tooltip = "Then click another curve: the target takes its place and direction there";
        if pick.on_hover_text(tooltip).clicked() {
            action = Some(EndFitAction::PickFromCurve);
        }
        let mut live = report.matched.is_some() || report.live;
        let keep = ui.add(Checkbox::new(&mut live, "Keep matched"));
        let tooltip = "Match the end again whenever the other curve changes";
        if keep.on_hover_text(tooltip).clicked() {
            action = Some(EndFitAction::KeepMatched(live));
        }
    });
    if let Some(matched) = &report.matched {
        action = matched_ui(ui, matched).or(action);
        if !matched.met {
            let why = match &report.refusal {
                Some(_) => "Not met: unlock the curve to match it.",
                None => "Not met: match a lower level, unlock vertices, or add more.",
            };
            let error = Tokens::of(ui).error;
            remark_ui(ui, Icon::TriangleAlert, why, error);
        }
    }
    for (name, end) in &report.followers {
        let text = format!(
            "The {} of {} is matched to this curve",
            end.name(),
            quoted(name)
        );
        widgets::note(ui, &text);
    }
    action
}

fn level_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    let mut action = None;
    let matched = report.matched.as_ref();
    let now = matched.map_or(report.continuity, |it| it.matched.continuity);
    widgets::form_row(ui, "Match", |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for level in Continuity::ALL {
            let button = Button::selectable(now == level, level.name());
            let response = ui.add_sized(vec2(40.0, ROW), button);
            let tooltip = format!("Match up to the {}", level.label());
            if response.on_hover_text(tooltip).clicked() {
                action = Some(EndFitAction::SetContinuity(level));
            }
        }
    });
    action
}

/// The source of a matched end, and the error of each level.
fn matched_ui(ui: &mut Ui, report: &MatchReport) -> Option<EndFitAction> {
    let mut action = None;
    let place = match report.matched.place {
        MatchPlace::End(end) => format!("its {}", end.name()),
        MatchPlace::Parameter(u) => format!("u = {}", figures::significant(u, 5)),
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        let tokens = Tokens::of(ui);
        ui.label(icons::text(Icon::Link).color(tokens.target));
        let text = format!("Matched to {} at {place}", quoted(&report.source));
        let text = RichText::new(text).color(tokens.strong_text);
        let width = ui.available_width() - BUTTONS;
        let label = Label::new(text).truncate();
        ui.allocate_ui(vec2(width, ROW), |ui| {
            ui.set_width(width);
            ui.add(label);
        });
        widgets::at_right(ui, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            if IconButton::new(Icon::X, "Remove match").show(ui).clicked() {
                action = Some(EndFitAction::KeepMatched(false));
            }
            let turn = IconButton::new(Icon::ArrowLeftRight, "Flip match");
            if turn.show(ui).clicked() {
                action = Some(EndFitAction::TurnRound);
            }
        });
    });
    let missing = &report.missing;
    let plain = |value: f64| figures::significant(value, 4);
    figure_pairs(
        ui,
        &[
            ("G0 error", plain(missing.vector.length())),
            ("G1 error", angle_text(missing.angle)),
            ("G2 error", plain(missing.curvature)),
            ("G3 error", plain(missing.slope)),
        ],
    );
    action
}
