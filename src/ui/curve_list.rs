//! The list of curves, and of references below them.

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    Align2, Color32, Context, CursorIcon, Id, Key, Rect, Response, Role, ScrollArea, Sense, Stroke,
    StrokeKind, TextEdit, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::action::Action;
use super::keyboard::{self, Typing};
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::document::{Colour, Curve, CurveId, Edit, Reference};
use crate::editor::{Command, Editor, MenuOf, told};

/// The list's own state: the name that is being typed.
#[derive(Default)]
pub struct CurveList {
    renaming: Option<Renaming>,
    /// The active curve or reference whose row was brought into sight.
    in_sight: Option<CurveId>,
}

struct Renaming {
    curve: CurveId,
    text: String,
    is_new: bool,
}

/// The field of the name that is being typed.
fn field_id() -> Id {
    Id::unique("name of a curve")
}

impl CurveList {
    /// Open the field for another name of the active curve or reference.
    pub fn rename_active(&mut self, context: &Context, editor: &Editor) {
        if let Some(active) = editor.active() {
            self.begin_renaming(context, editor, active);
        }
    }

    /// Show the list with its heading.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        heading_ui(ui, editor, commands);
        if editor.document().is_empty() {
            widgets::note(
                ui,
                "No curves yet. Draw one with D, or open a file or an example.",
            );
            return;
        }
        let mut renamed = None;
        // Room for the bar is always kept.
        let width = ui.available_width() - ui.spacing().scroll.allocated_width();
        ScrollArea::vertical()
            .auto_shrink([false, false])
            .show(ui, |ui| {
                ui.set_max_width(width);
                ui.spacing_mut().item_spacing.y = 0.0;
                for row in rows(editor) {
                    if self.row_ui(ui, editor, &row) {
                        renamed = Some(row.id);
                    }
                }
                self.in_sight = editor.active();
            });
        // The field takes the keyboard after the row that was clicked has had it.
        if let Some(curve) = renamed {
            self.begin_renaming(ui.ctx(), editor, curve);
        }
    }

    /// Open the field for a name; from now on keys are the field's.
    fn begin_renaming(&mut self, context: &Context, editor: &Editor, curve: CurveId) {
        let text = editor.document().name(curve).map(str::to_owned);
        self.renaming = text.map(|text| Renaming {
            curve,
            text,
            is_new: true,
        });
        if let Some(renaming) = &self.renaming {
            select_all(context, &renaming.text);
        }
        keyboard::claim(context, field_id(), Typing::Text, Rect::NOTHING);
        context.memory_mut(|memory| memory.request_focus(field_id()));
    }

    /// Show a row; returns whether a double-click renames it.
    fn row_ui(&mut self, ui: &mut Ui, editor: &mut Editor, row: &Row) -> bool {
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click_and_drag());
        row.paint(ui, rect, &response);
        if row.active && self.in_sight != Some(row.id) {
            ui.scroll_to_rect(rect, None);
        }
        row.reorder(ui, editor, rect, &response);
        let renames = response.double_clicked();
        if response.clicked() && !renames {
            editor.activate(row.id);
        }
        if response.secondary_clicked() {
            editor.ask_for_menu(MenuOf::Item(row.id));
        }
        let inner = rect.shrink2(vec2(2.0 * STEP, 0.0));
        let builder = UiBuilder::new().max_rect(inner).id_salt(row.id);
        ui.scope_builder(builder, |ui| {
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                row.switches_ui(ui, editor, rect);
            });
        });
        let name = Rect::from_min_max(
            inner.min + vec2(6.0 * STEP, 0.0),
            inner.max - vec2(2.0 * ROW + STEP, 0.0),
        );
        let is_renamed = self
            .renaming
            .as_ref()
            .is_some_and(|renaming| renaming.curve == row.id);
        if is_renamed {
            self.renaming_ui(ui, editor, name);
        } else {
            row.name_ui(ui, name, response);
        }
        renames
    }

    fn renaming_ui(&mut self, ui: &mut Ui, editor: &mut Editor, rect: Rect) {
        let Some(renaming) = &mut self.renaming else {
            return;
        };
        let field = TextEdit::singleline(&mut renaming.text)
            .id(field_id())
            .align(Align2::LEFT_CENTER)
            .min_size(rect.size())
            .desired_width(rect.width());
        let response = ui.put(rect, field).accessible_name("Curve name");
        keyboard::claim(ui.ctx(), field_id(), Typing::Text, rect);
        if renaming.is_new {
            ui.scroll_to_rect(rect, None);
        }
        if std::mem::take(&mut renaming.is_new) || !response.lost_focus() {
            return;
        }
        let is_cancelled = ui.input(|input| input.key_pressed(Key::Escape));
        if let Some(Renaming { curve, text, .. }) = self.renaming.take()
            && !is_cancelled
        {
            told(editor.change(Edit::Rename { curve, name: text }));
        }
    }
}

/// Select the whole name: typing replaces it.
fn select_all(context: &Context, text: &str) {
    let mut state = TextEditState::load(context, field_id()).unwrap_or_default();
    let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(context, field_id());
}

fn reorder(editor: &mut Editor, curve: CurveId, place: usize) {
    told(editor.apply("Reorder curves", vec![Edit::Reorder { curve, place }]));
}

fn heading_ui(ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.strong("Curves");
        widgets::at_right(ui, |ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (icon, command) in [
                (Icon::Trash2, Command::DeleteCurve),
                (Icon::CopyPlus, Command::Duplicate),
            ] {
                let name = command.label_now(editor);
                let button = IconButton::new(icon, &name).enabled(command.is_enabled(editor));
                if button.tooltip(command.tooltip()).show(ui).clicked() {
                    commands.push(command.into());
                }
            }
            let place = editor.active().and_then(|active| {
                let own = rows(editor).into_iter().find(|row| row.id == active)?;
                Some((active, own.place, own.last))
            });
            let down = place
                .filter(|(_, place, last)| place < last)
                .map(|(id, place, _)| (id, place + 1));
            let up = place.and_then(|(id, place, _)| Some((id, place.checked_sub(1)?)));
            for (icon, name, to) in [
                (Icon::ArrowDown, "Move curve down", down),
                (Icon::ArrowUp, "Move curve up", up),
            ] {
                let response = IconButton::new(icon, name).enabled(to.is_some()).show(ui);
                if let (true, Some((curve, place))) = (response.clicked(), to) {
                    reorder(editor, curve, place);
                }
            }
        });
    });
}

/// A row of the list: a curve or a reference.
struct Row {
    id: CurveId,
    is_reference: bool,
    name: String,
    colour: Option<Colour>,
    visible: bool,
    locked: bool,
    /// Its place among the curves, or among the references.
    place: usize,
    /// The last place there.
    last: usize,
    active: bool,
}

/// The rows of all curves, then of all references.
fn rows(editor: &Editor) -> Vec<Row> {
    let (document, active) = (editor.document(), editor.active());
    let (curves, references) = (document.curves(), document.references());
    let counts = [curves.len(), references.len()];
    let row =
        |id, is_reference: bool, place, (name, colour): (&str, _), [visible, locked]: [bool; 2]| {
            Row {
                id,
                is_reference,
                name: name.to_owned(),
                colour,
                visible,
                locked,
                place,
                last: counts[usize::from(is_reference)].saturating_sub(1),
                active: active == Some(id),
            }
        };
    let curves = curves.enumerate().map(|(place, (id, curve))| {
        let Curve { name, colour, .. } = &**curve;
        row(
            id,
            false,
            place,
            (name, *colour),
            [curve.visible, curve.locked],
        )
    });
    let references = references.enumerate().map(|(place, (id, reference))| {
        let Reference { name, colour, .. } = &**reference;
        let state = [reference.visible, reference.locked];
        row(id, true, place, (name, *colour), state)
    });
    curves.chain(references).collect()
}

impl Row {
    /// What screen readers and tooltips call it.
    fn noun(&self) -> &'static str {
        match self.is_reference {
            true => "reference",
            false => "curve",
        }
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let tokens = Tokens::of(ui);
        widgets::row_background(ui, rect, response, self.active);
        let centre = rect.left_center() + vec2(4.0 * STEP, 0.0);
        let swatch = Rect::from_center_size(centre, Vec2::splat(3.0 * STEP));
        let own = self.colour.map(theme::of_document);
        if self.is_reference {
            let colour = own.unwrap_or_else(|| tokens.of_reference(self.id));
            widgets::icon(ui, swatch, Icon::SplinePointer, colour);
        } else {
            let colour = own.unwrap_or_else(|| tokens.of_curve(self.id));
            swatch_in(ui, swatch, colour);
        }
        let label = format!("{} {}", self.noun(), self.name);
        response
            .widget_info(|| WidgetInfo::selected(Role::ListItem, true, self.active, label.clone()));
    }

    /// Show the name; a tooltip shows all of one that does not fit.
    fn name_ui(&self, ui: &Ui, rect: Rect, response: Response) {
        let tokens = Tokens::of(ui);
        let colour = match (self.active, self.visible) {
            (true, _) => tokens.strong_text,
            (false, true) => tokens.text,
            (false, false) => tokens.faint_text,
        };
        if widgets::label_in(ui, rect, &self.name, colour) {
            response.on_hover_text(&self.name);
        }
    }

    /// A row can be dragged to another place.
    fn reorder(&self, ui: &Ui, editor: &mut Editor, rect: Rect, response: &Response) {
        if response.drag_started() {
            response.dnd_set_drag_payload(self.id);
        }
        if response.dragged() {
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
        let tokens = Tokens::of(ui);
        if let Some(dragged) = response.dnd_hover_payload::<CurveId>()
            && *dragged != self.id
        {
            ui.painter().rect_stroke(
                rect,
                RADIUS,
                Stroke::new(1.5, tokens.accent),
                StrokeKind::Inside,
            );
        }
        if let Some(dragged) = response.dnd_release_payload::<CurveId>()
            && *dragged != self.id
        {
            reorder(editor, *dragged, self.place);
        }
    }

    fn switches_ui(&self, ui: &mut Ui, editor: &mut Editor, row: Rect) {
        let tokens = Tokens::of(ui);
        let is_hovered = ui.rect_contains_pointer(row);
        // Switches in their default state are hidden until the row is hovered.
        let faint = if is_hovered || self.active {
            tokens.faint_text
        } else {
            Color32::TRANSPARENT
        };
        let (icon, colour) = match self.locked {
            true => (Icon::Lock, tokens.text),
            false => (Icon::LockOpen, faint),
        };
        let label = format!("Lock {}", self.name);
        let button = IconButton::new(icon, &label).colour(colour);
        if button
            .tooltip("Protect the shape from edits")
            .show(ui)
            .clicked()
        {
            told(editor.change(Edit::SetLocked {
                curve: self.id,
                locked: !self.locked,
            }));
        }
        let (icon, colour) = match self.visible {
            true => (Icon::Eye, faint),
            false => (Icon::EyeOff, tokens.text),
        };
        let label = format!("Show {}", self.name);
        let tooltip = format!("Show or hide the {}", self.noun());
        let button = IconButton::new(icon, &label).colour(colour);
        if button.tooltip(tooltip).show(ui).clicked() {
            told(editor.change(Edit::SetVisible {
                curve: self.id,
                visible: !self.visible,
            }));
        }
    }
}

/// Paint a colour as a small square.
pub fn swatch_in(ui: &Ui, rect: Rect, colour: Color32) {
    let outline = Stroke::new(1.0, Tokens::of(ui).outline);
    ui.painter()
        .rect(rect, 2, colour, outline, StrokeKind::Inside);
}
