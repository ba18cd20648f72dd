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
use crate::editor::{Command, Editor, told};

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

/// What a row asks for.
enum Asked {
    Activate(CurveId),
    Menu(CurveId),
    Rename(CurveId),
    Lock(CurveId, bool),
    Show(CurveId, bool),
    Renamed(CurveId, String),
    Reorder(CurveId, usize),
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
        let mut asked = None;
        // Room for the bar is always kept.
        let width = ui.available_width() - ui.spacing().scroll.allocated_width();
        ScrollArea::vertical()
            .auto_shrink([false, false])
            .show(ui, |ui| {
                ui.set_max_width(width);
                ui.spacing_mut().item_spacing.y = 0.0;
                for row in rows(editor) {
                    if let Some(more) = self.row_ui(ui, &row) {
                        asked = Some(more);
                    }
                }
                self.in_sight = editor.active();
            });
        match asked {
            Some(Asked::Activate(curve)) => editor.activate(curve),
            Some(Asked::Menu(curve)) => editor.ask_for_menu_of(curve),
            Some(Asked::Rename(curve)) => self.begin_renaming(ui.ctx(), editor, curve),
            Some(Asked::Lock(curve, locked)) => told(editor.set_locked(curve, locked)),
            Some(Asked::Show(curve, visible)) => told(editor.set_visible(curve, visible)),
            Some(Asked::Renamed(curve, name)) => told(editor.rename(curve, name)),
            Some(Asked::Reorder(curve, place)) => reorder(editor, curve, place),
            None => {}
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

    fn row_ui(&mut self, ui: &mut Ui, row: &Row) -> Option<Asked> {
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click_and_drag());
        row.paint(ui, rect, &response);
        if row.active && self.in_sight != Some(row.id) {
            ui.scroll_to_rect(rect, None);
        }
        let mut asked = row.reorder(ui, rect, &response);
        if response.clicked() {
            asked = Some(Asked::Activate(row.id));
        }
        if response.double_clicked() {
            asked = Some(Asked::Rename(row.id));
        }
        if response.secondary_clicked() {
            asked = Some(Asked::Menu(row.id));
        }
        let inner = rect.shrink2(vec2(2.0 * STEP, 0.0));
        let builder = UiBuilder::new().max_rect(inner).id_salt(row.id);
        ui.scope_builder(builder, |ui| {
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                asked = row.switches_ui(ui, rect).or(asked.take());
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
            asked = self.renaming_ui(ui, name).or(asked);
        } else {
            row.name_ui(ui, name, response);
        }
        asked
    }

    fn renaming_ui(&mut self, ui: &mut Ui, rect: Rect) -> Option<Asked> {
        let renaming = self.renaming.as_mut()?;
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
            return None;
        }
        let Renaming { curve, text, .. } = self.renaming.take()?;
        let called_off = ui.input(|input| input.key_pressed(Key::Escape));
        (!called_off).then_some(Asked::Renamed(curve, text))
    }
}

/// Select the whole name: what is typed takes its place.
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
                let name = editor.label(command);
                let button = IconButton::new(icon, &name).enabled(editor.is_enabled(command));
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
    let [last_curve, last_reference] = [curves.len(), references.len()].map(|it| it.max(1) - 1);
    let curves = curves.enumerate().map(|(place, (id, curve))| {
        let Curve {
            name,
            colour,
            visible,
            locked,
            ..
        } = &**curve;
        Row {
            id,
            is_reference: false,
            name: name.clone(),
            colour: *colour,
            visible: *visible,
            locked: *locked,
            place,
            last: last_curve,
            active: active == Some(id),
        }
    });
    let references = references.enumerate().map(|(place, (id, reference))| {
        let Reference {
            name,
            colour,
            visible,
            locked,
            ..
        } = &**reference;
        Row {
            id,
            is_reference: true,
            name: name.clone(),
            colour: *colour,
            visible: *visible,
            locked: *locked,
            place,
            last: last_reference,
            active: active == Some(id),
        }
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
        if self.active || response.hovered() {
            let fill = if self.active {
                tokens.selection
            } else {
                tokens.button[0]
            };
            ui.painter().rect_filled(rect, RADIUS, fill);
        }
        if response.has_focus() {
            widgets::focus_ring(ui, rect);
        }
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

    /// The name; of one that does not fit, all of it is told on hovering.
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
    fn reorder(&self, ui: &Ui, rect: Rect, response: &Response) -> Option<Asked> {
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
        let curve = *response.dnd_release_payload::<CurveId>()?;
        (curve != self.id).then_some(Asked::Reorder(curve, self.place))
    }

    fn switches_ui(&self, ui: &mut Ui, row: Rect) -> Option<Asked> {
        let tokens = Tokens::of(ui);
        let is_hovered = ui.rect_contains_pointer(row);
        // Switches at rest stay out of sight, unless they tell something.
        let faint = if is_hovered || self.active {
            tokens.faint_text
        } else {
            Color32::TRANSPARENT
        };
        let Self {
            id: curve,
            name,
            visible,
            locked,
            ..
        } = self;
        let mut asked = None;
        let (icon, colour) = if *locked {
            (Icon::Lock, tokens.text)
        } else {
            (Icon::LockOpen, faint)
        };
        let label = format!("Lock {name}");
        let button = IconButton::new(icon, &label)
            .colour(colour)
            .tooltip("Protect the shape from edits");
        if button.show(ui).clicked() {
            asked = Some(Asked::Lock(*curve, !locked));
        }
        let (icon, colour) = if *visible {
            (Icon::Eye, faint)
        } else {
            (Icon::EyeOff, tokens.text)
        };
        let label = format!("Show {name}");
        let button = IconButton::new(icon, &label)
            .colour(colour)
            .tooltip(format!("Show or hide the {}", self.noun()));
        if button.show(ui).clicked() {
            asked = Some(Asked::Show(*curve, !visible));
        }
        asked
    }
}

/// Paint a colour as a small square.
pub fn swatch_in(ui: &Ui, rect: Rect, colour: Color32) {
    let outline = Stroke::new(1.0, Tokens::of(ui).outline);
    ui.painter()
        .rect(rect, 2, colour, outline, StrokeKind::Inside);
}
