//! The layers' switches, each in its layer's colour, and the comb's scale and density.

use eframe::egui::{Color32, Role, Sense, Stroke, Ui, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{figures, icons, keyboard};
use crate::editor::{CombSettings, Command, Editor, Layer};
use crate::geometry::noun;

/// Show the layers.
pub fn layer_list_ui(ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing.y = 0.0;
    // The safe region's switch stands beside the tools, with that which keeps features.
    let listed = Layer::ALL.into_iter();
    for layer in listed.filter(|layer| *layer != Layer::SafeRegion) {
        row_ui(ui, editor, layer, commands);
    }
    if editor.layers().shows(Layer::Comb) {
        ui.add_space(STEP);
        comb_ui(ui, editor, commands);
    }
}

/// The colour of a layer.
fn colour(tokens: &Tokens, layer: Layer) -> Color32 {
    match layer {
        Layer::Float => tokens.float,
        Layer::Clamped => tokens.clamped,
        Layer::Curve => tokens.curve,
        Layer::Evolute => tokens.evolute,
        Layer::Comb => tokens.comb,
        Layer::Targets => tokens.target,
        Layer::Grid => tokens.joints,
        Layer::Features => tokens.rising,
        Layer::SafeRegion => tokens.good,
    }
}

fn row_ui(ui: &mut Ui, editor: &Editor, layer: Layer, commands: &mut Vec<Action>) {
    let shown = editor.layers().shows(layer);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    let tokens = Tokens::of(ui);
    if response.hovered() {
        ui.painter()
            .rect_filled(rect, super::theme::RADIUS, tokens.button[0]);
    }
    if response.has_focus() {
        widgets::focus_ring(ui, rect);
    }
    let text = if shown {
        tokens.text
    } else {
        tokens.faint_text
    };
    let mut left = rect.with_max_x(rect.left() + 6.0 * STEP);
    let own = colour(tokens, layer);
    widgets::icon(
        ui,
        left,
        icons::of_layer(layer),
        if shown { own } else { tokens.faint_text },
    );
    left = rect
        .with_min_x(left.right() + STEP)
        .with_max_x(rect.right() - 12.0 * STEP);
    widgets::label_in(ui, left, layer.label(), text);
    let switch = rect.with_min_x(rect.right() - ROW);
    if let Some(shortcut) = Command::ToggleLayer(layer).shortcut() {
        let at = rect.with_max_x(switch.left() - STEP);
        widgets::number_in(
            ui,
            at,
            &keyboard::shortcut_text(shortcut),
            tokens.faint_text,
        );
    }
    let eye = if shown { Icon::Eye } else { Icon::EyeOff };
    widgets::icon(
        ui,
        switch,
        eye,
        if shown {
            tokens.text
        } else {
            tokens.faint_text
        },
    );
    if shown {
        // A stroke in the layer's own colour beside the icon: hue is not the only cue.
        let edge = [
            rect.left_top() + vec2(0.0, STEP),
            rect.left_bottom() - vec2(0.0, STEP),
        ];
        ui.painter().line_segment(edge, Stroke::new(2.0, own));
    }
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, shown, layer.label()));
    if response
        .on_hover_text(Command::ToggleLayer(layer).tooltip())
        .clicked()
    {
        commands.push(Command::ToggleLayer(layer).into());
    }
}

/// The comb's scale and density, while there is a comb.
fn comb_ui(ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
    let mut comb = editor.view().comb();
    widgets::form_row(ui, "Comb scale", |ui| {
        let shown = figures::significant(comb.scale, 4);
        let field = NumberField::new("Comb scale", comb.scale, shown)
            .range(1e-12..=1e15)
            .speed(0.02 * comb.scale.max(1e-12))
            .width(96.0);
        if let FieldEvent::Typed(value) | FieldEvent::Preview(value) = field.show(ui).1 {
            comb.scale = value;
            editor.view_mut().set_comb(comb);
        }
        let reset = IconButton::new(Icon::RotateCcw, "Reset comb scale");
        if reset
            .tooltip(Command::ResetComb.tooltip())
            .show(ui)
            .clicked()
        {
            commands.push(Command::ResetComb.into());
        }
    });
    widgets::form_row(ui, "Comb density", |ui| {
        let shown = comb.density.to_string();
        let (least, most) = CombSettings::DENSITY.into_inner();
        let field = NumberField::new("Comb density", comb.density as f64, shown)
            .range(least as f64..=most as f64)
            .speed(0.25)
            .width(96.0);
        if let FieldEvent::Typed(value) | FieldEvent::Preview(value) = field.show(ui).1 {
            comb.density = value.round().max(0.0) as usize;
            editor.view_mut().set_comb(comb);
        }
        let noun = noun(comb.density, "tooth", "teeth");
        widgets::caption(ui, &format!("{noun} per segment"));
    });
}
