//! The layers' switches over the canvas, each in its layer's colour, and the comb's scale and density.

use eframe::egui::{
    Align2, Context, Frame, Margin, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::action::Action;
use super::help::{self, Topic};
use super::number_field::NumberField;
use super::theme::{RADIUS, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{figures, gizmo, icons, keyboard};
use crate::editor::{CombSettings, CombsOf, Command, Editor, Layer, RULER};

/// The side of a layer's switch.
const SIDE: f32 = 28.0;

/// The width that the comb's controls take.
const COMB: f32 = 252.0 + OF + STEP;

/// The width of the choice of curves that have a comb.
const OF: f32 = 80.0;

/// Show the strip in the upper left corner of the canvas, within the first pane; where it is narrow, the comb's controls
/// stand below the layers.
pub fn layer_strip_ui(
    context: &Context,
    canvas: Rect,
    editor: &mut Editor,
    commands: &mut Vec<Action>,
) {
    let pane = editor.view().panes().next();
    let pane = pane.map(|pane| pane.viewport.size.x as f32);
    let right = match pane.filter(|pane| *pane < canvas.width()) {
        Some(pane) => canvas.left() + pane,
        None => gizmo::place(canvas).map_or(canvas.right(), |gizmo| gizmo.left()),
    };
    let width = right - canvas.left() - RULER as f32 - 3.0 * STEP;
    let is_narrow = width < Layer::ALL.len() as f32 * SIDE + COMB;
    // Beside the ruler.
    let corner = canvas.min + vec2(RULER as f32 + STEP, 2.0 * STEP);
    let place = (Align2::LEFT_TOP, corner);
    widgets::overlay(context, "layers", place, |ui| {
        let tokens = Tokens::of(ui);
        let frame = Frame::NONE
            .fill(tokens.panel)
            .stroke(Stroke::new(1.0, tokens.outline))
            .corner_radius(RADIUS)
            .inner_margin(Margin::symmetric(4, 2));
        frame.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                for layer in Layer::ALL {
                    switch_ui(ui, editor, layer, commands);
                }
                if !is_narrow {
                    divider_ui(ui);
                    comb_ui(ui, editor, commands);
                }
            });
            if is_narrow {
                ui.horizontal(|ui| comb_ui(ui, editor, commands));
            }
            help::mark(ui, ui.min_rect(), Topic::Layers);
        });
    });
}

fn switch_ui(ui: &mut Ui, editor: &Editor, layer: Layer, commands: &mut Vec<Action>) {
    let command = Command::ToggleLayer(layer);
    let shown = editor.sight().layers().shows(layer);
    let tokens = Tokens::of(ui);
    let own = tokens.named(layer.row().colour);
    let colours = [if shown { own } else { tokens.faint_text }; 2];
    let (size, icon) = (Vec2::splat(SIDE), icons::of_layer(layer));
    let (rect, response) = widgets::pressable_icon(ui, size, icon, colours, false);
    if shown {
        // A bar below the icon of a layer that is shown: hue is not the only cue.
        let edge = rect.shrink2(vec2(2.0 * STEP, 1.0));
        let edge = [edge.left_bottom(), edge.right_bottom()];
        ui.painter().line_segment(edge, Stroke::new(2.0, own));
    }
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, shown, layer.label()));
    let name = keyboard::with_key(layer.label(), command.shortcut());
    let tooltip = format!("{name}\n{}", command.tooltip());
    if response.on_hover_text(tooltip).clicked() {
        commands.push(command.into());
    }
}

fn divider_ui(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(3.0 * STEP, SIDE), Sense::hover());
    let stroke = Stroke::new(1.0, Tokens::of(ui).outline);
    ui.painter()
        .vline(rect.center().x, rect.y_range().shrink(STEP), stroke);
}

/// The comb's scale and density; they keep their place while no comb is shown.
fn comb_ui(ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
    let shown = editor.sight().layers().shows(Layer::Comb);
    ui.spacing_mut().item_spacing.x = STEP;
    ui.add_enabled_ui(shown, |ui| {
        caption_ui(ui, "Comb", 38.0);
        combs_ui(ui, editor, commands);
        scale_ui(ui, editor);
        let reset = IconButton::new(Icon::RotateCcw, "Reset comb scale");
        let reset = reset.tooltip(Command::ResetComb.tooltip());
        if reset.show(ui).clicked() {
            commands.push(Command::ResetComb.into());
        }
        caption_ui(ui, "Teeth", 38.0);
        density_ui(ui, editor);
    });
}

/// The choice of curves that have a comb.
fn combs_ui(ui: &mut Ui, editor: &Editor, commands: &mut Vec<Action>) {
    let of = editor.view().combs_of;
    let all = CombsOf::ALL.map(|of| (of, of.name().to_owned()));
    let (chosen, response) = widgets::drop_down(ui, "Combs of", OF, &of, all);
    let tooltip = Command::ShowCombs(of).tooltip();
    response.on_hover_text(tooltip);
    if let Some(of) = chosen {
        commands.push(Command::ShowCombs(of).into());
    }
}

fn caption_ui(ui: &mut Ui, text: &str, width: f32) {
    let (rect, _) = ui.allocate_exact_size(vec2(width, ROW), Sense::hover());
    widgets::label_in(ui, rect, text, Tokens::of(ui).faint_text);
}

fn scale_ui(ui: &mut Ui, editor: &mut Editor) {
    let mut comb = editor.view().comb();
    let whole = editor.sight().whole_comb_scale();
    let percent = whole.map_or(0.0, |whole| 100.0 * comb.scale / whole);
    let shown = whole.map_or("–".to_owned(), |_| {
        figures::significant(percent, 3) + " %"
    });
    let field = NumberField::new("Comb scale", percent, shown).width(76.0);
    let field = field.range(1e-9..=1e9).speed(0.02 * percent.max(1e-9));
    let help = "Length of the longest tooth, in percent of the curve's size";
    let changed = ui.add_enabled_ui(whole.is_some(), |ui| field.help(help).changed(ui));
    if let (Some(percent), Some(whole)) = (changed.inner, whole) {
        comb.scale = percent / 100.0 * whole;
        editor.view_mut().set_comb(comb);
    }
}

fn density_ui(ui: &mut Ui, editor: &mut Editor) {
    let mut comb = editor.view().comb();
    let (least, most) = CombSettings::DENSITY.into_inner();
    let density = comb.density as f64;
    let field = NumberField::new("Comb density", density, comb.density.to_string()).width(44.0);
    let field = field.range(least as f64..=most as f64).speed(0.25);
    if let Some(density) = field.help("Teeth of the comb per segment").changed(ui) {
        comb.density = density.round().max(0.0) as usize;
        editor.view_mut().set_comb(comb);
    }
}
