//! Overlays of the canvas: the advice for an empty document, the offer of the tour, and files about to drop.

use eframe::egui::{
    Align2, Area, Button, Context, FontId, Frame, Id, LayerId, Order, Rect, RichText, Stroke,
    StrokeKind, TextWrapMode, Vec2, pos2,
};

use super::action::Action;
use super::theme::{RADIUS, ROW, STEP, Tokens};
use super::{gizmo, keyboard, widgets};
use crate::editor::{Command, Editor, NamedView};

/// The width of the card that offers the tour.
const TOUR: f32 = 280.0;

/// Show the first steps in an empty document.
pub fn empty_ui(context: &Context, canvas: Rect) {
    let area = Area::new(Id::unique("empty document"))
        .order(Order::Background)
        .pivot(Align2::CENTER_CENTER)
        .fixed_pos(canvas.center())
        .interactable(false);
    area.show(context, |ui| {
        let tokens = Tokens::of(ui);
        ui.spacing_mut().item_spacing.y = STEP;
        ui.vertical_centered(|ui| {
            ui.label(RichText::new("Nothing here yet").color(tokens.strong_text));
            for line in [
                "D draws a curve, click by click",
                "Ctrl+O opens a file; files can also be dropped here",
                "File > Examples has curves to start from",
            ] {
                ui.label(RichText::new(line).color(tokens.faint_text));
            }
        });
    });
}

/// Warn that a planar drawing is not seen from above, with the way back.
pub fn orbited_ui(context: &Context, canvas: Rect, commands: &mut Vec<Action>) {
    let top = gizmo::name_place(canvas).map_or(canvas.top(), |name| name.bottom());
    let at = pos2(canvas.right() - 2.0 * STEP, top + STEP);
    let place = (Align2::RIGHT_TOP, at);
    let clicked = widgets::overlay(context, "orbited", place, |ui| {
        let tokens = Tokens::of(ui);
        let key = Command::View(NamedView::Xy).shortcut();
        let key = key.map(keyboard::shortcut_text).unwrap_or_default();
        let text = RichText::new(format!("Not from above · {key}")).color(tokens.strong_text);
        let badge = Button::new(text).wrap_mode(TextWrapMode::Extend);
        let badge = badge.stroke(Stroke::new(1.0, tokens.accent));
        let help = "The drawing is planar: view it from above";
        ui.add(badge).on_hover_text(help).clicked()
    });
    if clicked.inner {
        commands.push(Command::View(NamedView::Xy).into());
    }
}

/// Say that the evolute is hidden because it would cover the canvas, and offer to show it.
pub fn hidden_evolute_ui(context: &Context, canvas: Rect, editor: &mut Editor) {
    let top = gizmo::name_place(canvas).map_or(canvas.top(), |name| name.bottom());
    // Below the badge of a view that is not from above.
    let at = pos2(canvas.right() - 2.0 * STEP, top + 2.0 * STEP + ROW);
    let clicked = widgets::overlay(context, "hidden evolute", (Align2::RIGHT_TOP, at), |ui| {
        let tokens = Tokens::of(ui);
        let text = RichText::new("Evolute hidden · Show").color(tokens.strong_text);
        let badge = Button::new(text).wrap_mode(TextWrapMode::Extend);
        let badge = badge.stroke(Stroke::new(1.0, tokens.outline));
        let help = "The lines of the evolute would cover the canvas: show them nevertheless";
        ui.add(badge).on_hover_text(help).clicked()
    });
    if clicked.inner {
        editor.view_mut().evolute.is_wanted = true;
    }
}

/// Offer the tour of the paper in the lower right corner. Returns whether the user answered.
pub fn tour_ui(context: &Context, canvas: Rect, commands: &mut Vec<Action>) -> bool {
    let at = canvas.right_bottom() - Vec2::splat(2.0 * STEP);
    let shown = widgets::overlay(context, "tour", (Align2::RIGHT_BOTTOM, at), |ui| {
        let frame = Frame::popup(ui.style()).inner_margin(2.0 * STEP);
        let shown = frame.show(ui, |ui| {
            ui.set_max_width(TOUR);
            ui.label("New to Batten? A tour of seven pages opens curves and explains them.");
            ui.horizontal(|ui| {
                widgets::at_right(ui, |ui| {
                    let starts = widgets::primary_button(ui, "Start the tour").clicked();
                    if starts {
                        commands.push(Action::Paper);
                    }
                    starts | ui.button("Not now").clicked()
                })
            })
        });
        shown.inner.inner
    });
    shown.inner
}

/// Explain the effect of dropping while files hover over the window.
pub fn drop_ui(context: &Context, canvas: Rect) {
    if context.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    let tokens = Tokens::of_theme(context.global_style().visuals.dark_mode);
    let layer = LayerId::new(Order::Foreground, Id::unique("drop"));
    let painter = context.layer_painter(layer);
    let rect = canvas.shrink(2.0 * STEP);
    let stroke = Stroke::new(2.0, tokens.accent);
    painter.rect(rect, 2 * RADIUS, tokens.veil, stroke, StrokeKind::Inside);
    let font = FontId::proportional(13.0);
    let text = "Drop a project to open it, or tables to add their curves";
    let (at, align) = (rect.center(), Align2::CENTER_CENTER);
    painter.text(at, align, text, font, tokens.strong_text);
}
