//! The list of curves, and of references below them.

use eframe::egui::{
    Align2, Color32, Context, CursorIcon, Id, Key, Rect, Response, Role, Sense, TextEdit, Ui,
    UiBuilder, Vec2, WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::action::Action;
use super::draft;
use super::keyboard::{self, Typing};
use super::theme::{ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::document::{Colour, CurveId, Edit};
use crate::editor::{Command, Editor, MenuOf, told};

/// The list's own state: the name that is being typed.
#[derive(Default)]
pub struct CurveList {
    renaming: Option<Renaming>,
    /// Whether only the heading is shown.
    is_collapsed: bool,
    /// The curve or reference whose row the list scrolled to when it became active.
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

    /// The height that the heading and all rows take.
    pub fn height(&self, ui: &Ui, editor: &Editor) -> f32 {
        if self.is_collapsed {
            return ROW;
        }
        let document = editor.document();
        let rows = document.all_ids().count();
        // The note of an empty list wraps to two lines.
        ROW + ui.spacing().item_spacing.y + ROW * rows.max(2) as f32
    }

    /// Show the list with its heading.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        heading_ui(ui, &mut self.is_collapsed, editor, commands);
        if self.is_collapsed {
            return;
        }
        if editor.document().is_empty() {
            let text = "No curves yet. Draw one with D, or open a file or an example.";
            widgets::note(ui, text);
            return;
        }
        let renamed = widgets::scrolling(ui, "curves", |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let mut renamed = None;
            for item in Item::all(editor) {
                if self.row_ui(ui, editor, &item) {
                    renamed = Some(item.id);
                }
            }
            self.in_sight = editor.active();
            renamed
        });
        // The field takes the keyboard after the row that was clicked has had it.
        if let Some(curve) = renamed {
            self.begin_renaming(ui.ctx(), editor, curve);
        }
    }

    /// Open the field for a name; from now on keys are the field's.
    fn begin_renaming(&mut self, context: &Context, editor: &Editor, curve: CurveId) {
        let text = editor.document().name(curve).map(str::to_owned);
        self.renaming = text.map(|text| {
            draft::select_all(context, field_id(), &text);
            Renaming {
                curve,
                text,
                is_new: true,
            }
        });
        keyboard::claim(context, field_id(), Typing::Text, Rect::NOTHING);
        context.memory_mut(|memory| memory.request_focus(field_id()));
    }

    /// Show a row; returns whether a double-click renames it.
    fn row_ui(&mut self, ui: &mut Ui, editor: &mut Editor, item: &Item) -> bool {
        let (rect, response) = widgets::row(ui, Sense::click_and_drag(), item.active);
        item.paint(ui, rect, &response);
        if item.active && self.in_sight != Some(item.id) {
            ui.scroll_to_rect(rect, None);
        }
        item.reorder(ui, editor, rect, &response);
        let renames = response.double_clicked();
        if response.clicked() && !renames {
            match ui.input(|input| input.modifiers.command) && !item.active {
                true => {
                    let document = editor.document().clone();
                    editor.hand_mut().toggle_curve(item.id, &document);
                }
                false => editor.activate(item.id),
            }
        }
        if response.secondary_clicked() {
            editor.ask_for_menu(MenuOf::Item(item.id));
        }
        let inner = rect.shrink2(vec2(2.0 * STEP, 0.0));
        let builder = UiBuilder::new().max_rect(inner).id_salt(item.id);
        ui.scope_builder(builder, |ui| {
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                item.switches_ui(ui, editor, rect);
            });
        });
        let low = inner.min + vec2(6.0 * STEP, 0.0);
        let name = Rect::from_min_max(low, inner.max - vec2(2.0 * ROW + STEP, 0.0));
        let renaming = self.renaming.as_ref().map(|renaming| renaming.curve);
        match renaming == Some(item.id) {
            true => self.renaming_ui(ui, editor, name),
            false => item.name_ui(ui, name, response),
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

fn reorder(editor: &mut Editor, curve: CurveId, place: usize) {
    told(editor.apply("Reorder curves", vec![Edit::Reorder { curve, place }]));
}

fn heading_ui(
    ui: &mut Ui,
    is_collapsed: &mut bool,
    editor: &mut Editor,
    commands: &mut Vec<Action>,
) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let (icon, name) = match *is_collapsed {
            true => (Icon::ChevronRight, "Expand curve list"),
            false => (Icon::ChevronDown, "Collapse curve list"),
        };
        if IconButton::new(icon, name).show(ui).clicked() {
            *is_collapsed = !*is_collapsed;
        }
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
            let items = Item::all(editor);
            let active = items.iter().find(|item| item.active);
            let count = active.map_or(0, |active| {
                let is_same = |it: &&Item| it.is_reference == active.is_reference;
                items.iter().filter(is_same).count()
            });
            let place = active.map(|active| active.place);
            for (icon, name, to) in [
                (
                    Icon::ArrowDown,
                    "Move curve down",
                    place.map(|place| place + 1),
                ),
                (
                    Icon::ArrowUp,
                    "Move curve up",
                    place.and_then(|place| place.checked_sub(1)),
                ),
            ] {
                let to = active.zip(to.filter(|to| *to < count));
                let response = IconButton::new(icon, name).enabled(to.is_some()).show(ui);
                if let (true, Some((active, place))) = (response.clicked(), to) {
                    reorder(editor, active.id, place);
                }
            }
        });
    });
}

/// What a curve and a reference have in common.
pub struct Item {
    /// Its identity.
    pub id: CurveId,
    is_reference: bool,
    /// Its name.
    pub name: String,
    /// Its own colour; `None` takes the theme's.
    pub colour: Option<Colour>,
    /// Whether it is drawn.
    pub visible: bool,
    /// Whether its shape is protected from edits.
    pub locked: bool,
    /// Its place among the curves, or among the references.
    place: usize,
    active: bool,
}

impl Item {
    /// List all curves, then all references.
    fn all(editor: &Editor) -> Vec<Self> {
        let (document, active) = (editor.document(), editor.active());
        let curves = document.curves().enumerate();
        let curves = curves.map(|(place, (id, curve))| Self {
            id,
            is_reference: false,
            name: curve.name.clone(),
            colour: curve.colour,
            visible: curve.visible,
            locked: curve.locked,
            place,
            active: active == Some(id),
        });
        let references = document.references().enumerate();
        let references = references.map(|(place, (id, reference))| Self {
            id,
            is_reference: true,
            name: reference.name.clone(),
            colour: reference.colour,
            visible: reference.visible,
            locked: reference.locked,
            place,
            active: active == Some(id),
        });
        curves.chain(references).collect()
    }

    /// The active curve or reference.
    pub fn active(editor: &Editor) -> Option<Self> {
        Self::all(editor).into_iter().find(|item| item.active)
    }

    /// The colour that it is shown in.
    pub fn shown_colour(&self, tokens: &Tokens) -> Color32 {
        tokens.of_item(Some(self.id), self.colour, self.is_reference)
    }

    /// What screen readers and tooltips call it.
    fn noun(&self) -> &'static str {
        match self.is_reference {
            true => "reference",
            false => "curve",
        }
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let colour = self.shown_colour(Tokens::of(ui));
        let centre = rect.left_center() + vec2(4.0 * STEP, 0.0);
        let swatch = Rect::from_center_size(centre, Vec2::splat(3.0 * STEP));
        match self.is_reference {
            true => widgets::icon(ui, swatch, Icon::SplinePointer, colour),
            false => widgets::swatch(ui, swatch, colour),
        }
        let label = format!("{} {}", self.noun(), self.name);
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, self.active, &label));
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
        let hovering = response.dnd_hover_payload::<CurveId>();
        if hovering.is_some_and(|dragged| *dragged != self.id) {
            widgets::outline(ui, rect, 1.5, Tokens::of(ui).accent);
        }
        let dropped = response.dnd_release_payload::<CurveId>();
        if let Some(dropped) = dropped.filter(|dropped| **dropped != self.id) {
            reorder(editor, *dropped, self.place);
        }
    }

    fn switches_ui(&self, ui: &mut Ui, editor: &mut Editor, row: Rect) {
        let tokens = Tokens::of(ui);
        // Switches in their default state are hidden until the row is hovered.
        let faint = match ui.rect_contains_pointer(row) || self.active {
            true => tokens.faint_text,
            false => Color32::TRANSPARENT,
        };
        let mut switch = |icon, verb: &str, colour, tooltip: String, edit| {
            let label = format!("{verb} {}", self.name);
            let button = IconButton::new(icon, &label)
                .colour(colour)
                .tooltip(tooltip);
            if button.show(ui).clicked() {
                told(editor.change(edit));
            }
        };
        let (icon, colour) = match self.locked {
            true => (Icon::Lock, tokens.text),
            false => (Icon::LockOpen, faint),
        };
        let (curve, locked, visible) = (self.id, !self.locked, !self.visible);
        let tooltip = "Protect the shape from edits".to_owned();
        switch(
            icon,
            "Lock",
            colour,
            tooltip,
            Edit::SetLocked { curve, locked },
        );
        let (icon, colour) = match self.visible {
            true => (Icon::Eye, faint),
            false => (Icon::EyeOff, tokens.text),
        };
        let tooltip = format!("Show or hide the {}", self.noun());
        switch(
            icon,
            "Show",
            colour,
            tooltip,
            Edit::SetVisible { curve, visible },
        );
    }
}
