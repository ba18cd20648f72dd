//! Small pieces that the panels share.

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::{
    self, Align, Align2, Area, Color32, ComboBox, Context, EventFilter, FontId, Galley, Id,
    InnerResponse, Key, Layout, Modal, Modifiers, Order, Pos2, Rect, RectAlign, Response, RichText,
    Role, ScrollArea, Sense, Stroke, StrokeKind, Tooltip, Ui, UiBuilder, Vec2, WidgetInfo, pos2,
    text::LayoutJob,
};
use lucide_icons::Icon;

use super::icons;
use super::theme::{self, RADIUS, ROW, STEP, Tokens};

/// The width of the captions at the left of a form's rows.
pub const CAPTION: f32 = 84.0;

/// A square button that shows an icon.
pub struct IconButton<'a> {
    icon: Icon,
    name: &'a str,
    tooltip: String,
    enabled: bool,
    size: f32,
    colour: Option<Color32>,
}

impl<'a> IconButton<'a> {
    /// A button with an icon; `name` is its tooltip and its name for screen readers.
    pub fn new(icon: Icon, name: &'a str) -> Self {
        Self {
            icon,
            name,
            tooltip: name.to_owned(),
            enabled: true,
            size: ROW,
            colour: None,
        }
    }

    /// Set another tooltip than the name.
    pub fn tooltip(mut self, tooltip: impl Into<String>) -> Self {
        self.tooltip = tooltip.into();
        self
    }

    /// Whether it can be pressed.
    pub fn enabled(mut self, enabled: bool) -> Self {
        self.enabled = enabled;
        self
    }

    /// The length of its sides.
    pub fn size(mut self, size: f32) -> Self {
        self.size = size;
        self
    }

    /// The icon's colour at rest.
    pub fn colour(mut self, colour: Color32) -> Self {
        self.colour = Some(colour);
        self
    }

    /// Show the button.
    pub fn show(self, ui: &mut Ui) -> Response {
        ui.add_enabled_ui(self.enabled, |ui| self.enabled_ui(ui))
            .inner
    }

    fn enabled_ui(self, ui: &mut Ui) -> Response {
        let tokens = Tokens::of(ui);
        let colours = [self.colour.unwrap_or(tokens.text), tokens.strong_text];
        let size = Vec2::splat(self.size);
        let (_, response) = pressable_icon(ui, size, self.icon, colours, false);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), self.name));
        response.on_hover_text(self.tooltip)
    }
}

/// Show an icon that can be pressed, in one colour at rest and in another while it is hovered or has the
/// keyboard. Its background shows that, and whether it `is_on`.
pub fn pressable_icon(
    ui: &mut Ui,
    size: Vec2,
    shown: Icon,
    [rest, hot]: [Color32; 2],
    is_on: bool,
) -> (Rect, Response) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let tokens = Tokens::of(ui);
    let is_hot = response.hovered() || response.has_focus();
    if is_on {
        ui.painter().rect_filled(rect, RADIUS, tokens.selection);
    } else if is_hot {
        ui.painter().rect_filled(rect, RADIUS, tokens.button[1]);
    }
    if response.has_focus() {
        focus_ring(ui, rect);
    }
    icon(ui, rect, shown, if is_hot { hot } else { rest });
    (rect, response)
}

/// Show a cell of the status bar: a line at its left, a name, and a text flush right.
pub fn cell(
    ui: &mut Ui,
    size: Vec2,
    sense: Sense,
    [name, text]: [&str; 2],
    font: FontId,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, sense);
    let tokens = Tokens::of(ui);
    let stroke = Stroke::new(1.0, tokens.outline);
    let left = rect.left() - 2.0 * STEP;
    ui.painter().vline(left, rect.y_range(), stroke);
    let small = theme::small_font();
    text_in(
        ui,
        rect,
        Align2::LEFT_CENTER,
        name,
        small,
        tokens.faint_text,
    );
    let is_hot = sense.senses_click() && response.hovered();
    let colour = if is_hot {
        tokens.strong_text
    } else {
        tokens.text
    };
    text_in(ui, rect, Align2::RIGHT_CENTER, text, font, colour);
    if response.has_focus() {
        focus_ring(ui, rect);
    }
    response
}

/// Show contents over the canvas, with one of their corners or edges at a place.
pub fn overlay<R>(
    context: &Context,
    name: &str,
    (pivot, at): (Align2, Pos2),
    contents: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<R> {
    let area = Area::new(Id::unique(name)).order(Order::Middle);
    let area = area.pivot(pivot).fixed_pos(at).constrain(false);
    area.show(context, contents)
}

/// Find where overlays were shown in the last frame.
pub fn overlays(context: &Context) -> Vec<Rect> {
    context.memory(|memory| {
        let areas = memory.areas();
        let layers = memory.layer_ids();
        let shown =
            layers.filter(|layer| layer.order == Order::Middle && areas.visible_last_frame(layer));
        shown
            .filter_map(|layer| memory.area_rect(layer.id))
            .collect()
    })
}

/// Show a list that opens, by its name for screen readers; returns another value that is chosen in it, or by the arrow
/// keys up and down while it has the keyboard.
pub fn drop_down<T: PartialEq>(
    ui: &mut Ui,
    name: &str,
    width: f32,
    chosen: &T,
    all: impl IntoIterator<Item = (T, String)>,
) -> (Option<T>, Response) {
    let mut all: Vec<(T, String)> = all.into_iter().collect();
    let shown = all.iter().position(|(value, _)| value == chosen);
    let text = shown.map_or("", |shown| &all[shown].1).to_owned();
    let list = ComboBox::from_id_salt(name).selected_text(text);
    let mut other = None;
    let list = list.width(width).truncate().show_ui(ui, |ui| {
        for (index, (_, text)) in all.iter().enumerate() {
            let is_chosen = shown == Some(index);
            if ui.selectable_label(is_chosen, text).clicked() {
                other = Some(index);
            }
        }
    });
    let response = list.response.accessible_name(name);
    if response.clicked() {
        response.request_focus();
    }
    let stepped = stepped_by_arrows(ui, &response, shown, all.len());
    let other = other.or(stepped).filter(|other| shown != Some(*other));
    (other.map(|other| all.swap_remove(other).0), response)
}

/// The place to which the arrow keys go from another one in a list that has the keyboard.
fn stepped_by_arrows(ui: &Ui, list: &Response, from: Option<usize>, count: usize) -> Option<usize> {
    if !list.has_focus() {
        return None;
    }
    let filter = EventFilter {
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(list.id, filter));
    let mut pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let [up, down] = [Key::ArrowUp, Key::ArrowDown].map(&mut pressed);
    let place = match (from, up, down) {
        (Some(from), true, _) => from.saturating_sub(1),
        (Some(from), _, true) => from + 1,
        (None, _, true) => 0,
        _ => return None,
    };
    (place < count).then_some(place)
}

/// Paint a colour as a small square.
pub fn swatch(ui: &Ui, rect: Rect, colour: Color32) {
    let outline = Stroke::new(1.0, Tokens::of(ui).outline);
    ui.painter()
        .rect(rect, 2, colour, outline, StrokeKind::Inside);
}

/// Paint an icon into the middle of a box.
pub fn icon(ui: &Ui, rect: Rect, icon: Icon, colour: Color32) {
    let (text, font) = (char::from(icon), theme::icon_font(theme::ICON));
    text_in(ui, rect, Align2::CENTER_CENTER, text, font, colour);
}

/// Outline the widget that has the keyboard.
pub fn focus_ring(ui: &Ui, rect: Rect) {
    outline(ui, rect, 1.0, Tokens::of(ui).accent);
}

/// Outline a box.
pub fn outline(ui: &Ui, rect: Rect, width: f32, colour: Color32) {
    let stroke = Stroke::new(width, colour);
    ui.painter()
        .rect_stroke(rect, RADIUS, stroke, StrokeKind::Inside);
}

/// Write a text into a box, where its alignment puts it.
pub fn text_in(
    ui: &Ui,
    rect: Rect,
    align: Align2,
    text: impl ToString,
    font: FontId,
    colour: Color32,
) {
    let at = align.pos_in_rect(&rect);
    ui.painter().text(at, align, text, font, colour);
}

/// Allocate a row of a list across all the width, with its background.
pub fn row(ui: &mut Ui, sense: Sense, is_selected: bool) -> (Rect, Response) {
    let size = Vec2::new(ui.available_width(), ROW);
    let (rect, response) = ui.allocate_exact_size(size, sense);
    row_background(ui, rect, &response, is_selected);
    (rect, response)
}

/// Paint the background of a row that is selected or hovered, and outline it while it has the keyboard.
pub fn row_background(ui: &Ui, rect: Rect, response: &Response, is_selected: bool) {
    let tokens = Tokens::of(ui);
    if is_selected {
        ui.painter().rect_filled(rect, RADIUS, tokens.selection);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, RADIUS, tokens.button[0]);
    }
    if response.has_focus() {
        focus_ring(ui, rect);
    }
}

/// A caption that is cut short where there is too little room; a tooltip shows all of it.
pub fn remark(ui: &mut Ui, text: &str) -> Response {
    ui.add(egui::Label::new(small(ui, text)).truncate())
}

fn small(ui: &Ui, text: &str) -> RichText {
    let text = RichText::new(text).font(theme::small_font());
    text.color(Tokens::of(ui).faint_text)
}

/// A caption in small, faint type.
pub fn caption(ui: &mut Ui, text: &str) -> Response {
    let text = small(ui, text);
    ui.label(text)
}

/// A line of text that wraps, faint: hints and explanations.
pub fn note(ui: &mut Ui, text: &str) -> Response {
    let tokens = Tokens::of(ui);
    ui.add(egui::Label::new(RichText::new(text).color(tokens.faint_text)).wrap())
}

/// A line of text that wraps, in the colour of warnings: what the user may not want.
pub fn warning(ui: &mut Ui, text: &str) -> Response {
    let tokens = Tokens::of(ui);
    ui.add(egui::Label::new(RichText::new(text).color(tokens.warning)).wrap())
}

/// Show contents in all the room that there is: they neither widen nor narrow the panel around them.
pub fn filling<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let (_, rect) = ui.allocate_space(ui.available_size());
    let mut inside = ui.new_child(UiBuilder::new().max_rect(rect));
    inside.shrink_clip_rect(rect);
    contents(&mut inside)
}

/// Show contents that scroll where they do not fit. Room for the bar is always kept, and the contents
/// get no shorter while the pointer is pressed: nothing moves under it.
pub fn scrolling<R>(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let area = ScrollArea::vertical()
        .id_salt(name)
        .auto_shrink([false, false]);
    let width = ui.available_width() - ui.spacing().scroll.allocated_width();
    let shown = area.show(ui, |ui| {
        ui.set_max_width(width);
        let id = ui.make_persistent_id("height");
        if ui.input(|input| input.pointer.any_down()) {
            let before = ui.data(|data| data.get_temp::<f32>(id));
            ui.set_min_height(before.unwrap_or_default());
        }
        let inner = contents(ui);
        let height = ui.min_rect().height();
        ui.data_mut(|data| data.insert_temp(id, height));
        inner
    });
    shown.inner
}

/// Show rows of equal height in an area that scrolls, as far as they are seen. The row that is `sought` comes into
/// sight.
pub fn scrolling_rows<R>(
    ui: &mut Ui,
    name: &str,
    count: usize,
    sought: Option<usize>,
    contents: impl FnOnce(&mut Ui, Range<usize>) -> R,
) -> R {
    let area = ScrollArea::vertical()
        .id_salt(name)
        .auto_shrink([false, false]);
    let width = ui.available_width() - ui.spacing().scroll.allocated_width();
    let shown = area.show_viewport(ui, |ui, seen| {
        ui.set_height(count as f32 * ROW);
        let (left, top) = (ui.max_rect().left(), ui.max_rect().top());
        let rows = |from: usize, to: usize| {
            let [from, to] = [from, to].map(|row| top + row as f32 * ROW);
            Rect::from_min_max(pos2(left, from), pos2(left + width, to))
        };
        if let Some(row) = sought {
            ui.scroll_to_rect(rows(row, row + 1), None);
        }
        let first = ((seen.min.y / ROW).max(0.0) as usize).min(count);
        let last = (1 + (seen.max.y / ROW).max(0.0) as usize).clamp(first, count);
        let builder = UiBuilder::new().max_rect(rows(first, last));
        let inner = ui.scope_builder(builder, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            contents(ui, first..last)
        });
        inner.inner
    });
    shown.inner
}

/// A section that folds; whether it is open is remembered.
pub fn section<R>(
    ui: &mut Ui,
    title: &str,
    open: bool,
    contents: impl FnOnce(&mut Ui) -> R,
) -> Option<R> {
    let strong = Tokens::of(ui).strong_text;
    let header = egui::CollapsingHeader::new(RichText::new(title).color(strong)).default_open(open);
    header.show_unindented(ui, contents).body_returned
}

/// One row of a form: a caption at the left, the contents beside it.
pub fn form_row<R>(
    ui: &mut Ui,
    name: &str,
    contents: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<R> {
    wide_form_row(ui, name, CAPTION, contents)
}

/// A row as [`form_row`], with a caption of some other width.
pub fn wide_form_row<R>(
    ui: &mut Ui,
    name: &str,
    width: f32,
    contents: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<R> {
    ui.horizontal(|ui| {
        ui.set_min_height(ROW);
        let tokens = Tokens::of(ui);
        let (rect, _) = ui.allocate_exact_size(Vec2::new(width, ROW), Sense::hover());
        label_in(ui, rect, name, tokens.faint_text);
        contents(ui)
    })
}

/// One row of figures: a caption at the left, numbers flush right in tabular figures.
pub fn figure_row(ui: &mut Ui, name: &str, figures: &str) -> Response {
    text_row(ui, name, figures, theme::number_font())
}

/// One row of facts: a caption at the left, words flush right.
pub fn fact_row(ui: &mut Ui, name: &str, fact: &str) -> Response {
    let font = egui::TextStyle::Body.resolve(ui.style());
    text_row(ui, name, fact, font)
}

fn text_row(ui: &mut Ui, name: &str, text: &str, font: FontId) -> Response {
    let tokens = Tokens::of(ui);
    let size = Vec2::new(ui.available_width(), 5.0 * STEP);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    label_in(ui, rect, name, tokens.faint_text);
    text_in(ui, rect, Align2::RIGHT_CENTER, text, font, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{name}: {text}")));
    response
}

/// A figure, and its raw value for the tooltip if it is shown as 0.
pub type Figure = (String, Option<f64>);

/// Write a figure; what is not above rounding noise reads 0.
pub fn above_noise(value: f64, noise: f64, text: impl Fn(f64) -> String) -> Figure {
    match value != 0.0 && value.abs() <= noise {
        true => (text(0.0), Some(value)),
        false => (text(value), None),
    }
}

/// One row of figures whose tooltip has the raw value of what reads 0.
pub fn quiet_row(ui: &mut Ui, name: &str, (text, raw): &Figure) -> Response {
    let response = figure_row(ui, name, text);
    match raw {
        Some(raw) => response.on_hover_text(format!("Rounding: {raw:e}")),
        None => response,
    }
}

/// Rows of two figures each.
pub fn figure_pairs(ui: &mut Ui, pairs: &[(&str, Figure)]) {
    let gap = 4.0 * STEP;
    let width = 0.5 * (ui.available_width() - gap);
    for row in pairs.chunks(2) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for (name, figures) in row {
                ui.allocate_ui(Vec2::new(width, 5.0 * STEP), |ui| {
                    ui.set_width(width);
                    quiet_row(ui, name, figures);
                });
            }
        });
    }
}

/// A remark with its icon, wrapped; its text can be selected.
pub fn remark_with_icon(ui: &mut Ui, icon: Icon, text: &str, colour: Color32) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        ui.label(icons::text(icon).color(colour));
        let text = egui::Label::new(RichText::new(text).color(colour));
        ui.add(text.wrap().selectable(true));
    });
}

/// Write a text at the left of a box. Where there is too little room it ends with an ellipsis; returns
/// whether it does.
pub fn label_in(ui: &Ui, rect: Rect, text: &str, colour: Color32) -> bool {
    let galley = cut_short(ui, text, rect.width(), colour);
    let is_cut = galley.elided;
    let at = rect.left_center() - Vec2::new(0.0, 0.5 * galley.size().y);
    ui.painter_at(rect).galley(at, galley, colour);
    is_cut
}

/// Lay a text out in one line, which ends with an ellipsis where there is too little room.
pub fn cut_short(ui: &Ui, text: &str, width: f32, colour: Color32) -> Arc<Galley> {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, colour);
    job.wrap.max_width = width;
    job.wrap.max_rows = 1;
    job.wrap.break_anywhere = true;
    ui.painter().layout_job(job)
}

/// Write a name at the left of a box. Where there is too little room its middle is left out: names of many curves
/// differ at their ends. Returns whether it is cut.
pub fn name_in(ui: &Ui, rect: Rect, name: &str, colour: Color32) -> bool {
    let fits = |name: &str| !cut_short(ui, name, rect.width(), colour).elided;
    if fits(name) {
        return label_in(ui, rect, name, colour);
    }
    let letters: Vec<char> = name.chars().collect();
    let cut = |kept: usize| -> String {
        let (before, after) = (kept.div_ceil(2), kept / 2);
        let first = letters.iter().take(before);
        let last = letters.iter().skip(letters.len() - after);
        first.chain(['…'].iter()).chain(last).collect()
    };
    // The most letters that fit, by halving.
    let (mut fitting, mut most) = (0, letters.len());
    while most - fitting > 1 {
        let middle = fitting.midpoint(most);
        match fits(&cut(middle)) {
            true => fitting = middle,
            false => most = middle,
        }
    }
    label_in(ui, rect, &cut(fitting), colour);
    true
}

/// Show a tooltip at the right of a widget, whether it is enabled or not.
pub fn tooltip_at_right(response: &Response, text: &str) {
    let mut tooltip = match response.enabled() {
        true => Tooltip::for_enabled(response),
        false => Tooltip::for_disabled(response),
    };
    tooltip.popup = tooltip.popup.align(RectAlign::RIGHT_START);
    tooltip.show(|ui| ui.label(text));
}

/// Write a number at the right of a box.
pub fn number_in(ui: &Ui, rect: Rect, text: &str, colour: Color32) {
    text_in(
        ui,
        rect,
        Align2::RIGHT_CENTER,
        text,
        theme::number_font(),
        colour,
    );
}

/// The frame of a dialog.
pub fn dialog_frame(style: &egui::Style) -> egui::Frame {
    egui::Frame::window(style).inner_margin(4.0 * STEP)
}

/// Show a dialog that stops everything else; returns the answer. Esc answers `closed`; a press beside it does nothing, so
/// that no choice is lost by a slip.
pub fn modal<R>(
    context: &Context,
    name: &str,
    closed: R,
    contents: impl FnOnce(&mut Ui) -> Option<R>,
) -> Option<R> {
    let modal = Modal::new(Id::unique(name)).frame(dialog_frame(&context.global_style()));
    let modal = modal.show(context, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0 * STEP;
        contents(ui)
    });
    let is_in_front = modal.is_top_modal && !modal.any_popup_open;
    let closes =
        is_in_front && context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    modal.inner.or(closes.then_some(closed))
}

/// The button that Enter presses too.
pub fn primary_button(ui: &mut Ui, name: &str) -> Response {
    let tokens = Tokens::of(ui);
    let text = RichText::new(name).color(tokens.strong_text);
    ui.add(egui::Button::new(text).fill(tokens.selection))
}

/// Lay contents out from the right edge of the row.
pub fn at_right<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    ui.with_layout(Layout::right_to_left(Align::Center), contents)
        .inner
}
