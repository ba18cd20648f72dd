//! The table of a curve's vertices: every number typed or dragged. It has the keyboard as a
//! whole, and moves it from cell to cell itself.

use std::ops::Range;

use eframe::egui::style::ScrollAnimation;
use eframe::egui::{Event, EventFilter, Rect, Role, ScrollArea, Sense, Ui, Vec2, WidgetInfo, vec2};

use super::cell_entry::Entry;
use super::cell_keys::{self, CellKey, Step};
use super::document_unit;
use super::draft::Remark;
use super::figures;
use super::keyboard::{self, Typing};
use super::theme::{ROW, STEP, Tokens};
use super::vertex_columns::{Cell, MoreColumns};
use super::vertex_rows::{HEAD, Rows, heading_ui, id};
use super::widgets;
use crate::document::{Curve, CurveId};
use crate::editor::Editor;

/// The keys that egui leaves to the table.
const KEYS: EventFilter = EventFilter {
    tab: true,
    horizontal_arrows: true,
    vertical_arrows: true,
    escape: true,
};

/// The table's own state.
#[derive(Default)]
pub struct VertexTable {
    /// The selection in the last frame: a change from elsewhere is scrolled to.
    selected: Vec<usize>,
    /// The rows that were visible in the last frame, and how far they were scrolled.
    visible: Range<usize>,
    offset: f32,
    more: MoreColumns,
    /// The cell that keys are for.
    cell: Cell,
    entry: Option<Entry>,
    /// Whether the cell is to be brought into sight.
    follow: bool,
    remark: Option<(Cell, Remark)>,
}

impl VertexTable {
    /// Show the table in all the room that there is.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, id: CurveId, curve: &Curve) {
        self.more.show(ui, curve);
        let columns = self.more.of(&curve.polygon);
        let selected: Vec<usize> = editor.hand().selection().of_curve(id).collect();
        let width = ui.available_width() - 3.0 * STEP;
        let rows = Rows {
            id,
            curve,
            columns: &columns,
            width: ((width - HEAD) / columns.len() as f32).floor(),
            selected: &selected,
            hovered: editor.sight().hovered_vertex(),
            pixel: editor.view().viewport().pixel(),
        };
        self.keep_cell(&rows);
        let ending = self.take_keys(ui, editor, &rows);
        heading_ui(ui, &columns, rows.width);
        let has_keyboard = has_keyboard(ui);
        let (hovered, place) = self.rows_ui(ui, editor, &rows);
        if let Some(hovered) = hovered.or(has_keyboard.then_some(self.cell.vertex)) {
            editor.view_mut().hover_vertex(hovered);
        }
        if let Some(key) = ending {
            self.end_entry(ui, editor, &rows, key);
        }
        self.selected = selected;
        let typing = match self.entry {
            Some(_) => Typing::Text,
            None => Typing::Cell,
        };
        keyboard::claim(ui.ctx(), self::id(), typing, place);
    }

    /// The cell stays within the table, whatever the curve has become.
    fn keep_cell(&mut self, rows: &Rows<'_>) {
        self.cell.vertex = self.cell.vertex.min(rows.last());
        if !rows.columns.contains(&self.cell.column)
            && let Some(last) = rows.columns.last()
        {
            self.cell.column = *last;
        }
    }

    /// Take the keys that are the table's. Returns the one that ends an edit: it counts after
    /// the text field has taken the text typed before it.
    fn take_keys(&mut self, ui: &mut Ui, editor: &mut Editor, rows: &Rows<'_>) -> Option<CellKey> {
        let has_keyboard = has_keyboard(ui);
        let is_other = |entry: &mut Entry| entry.curve != rows.id;
        if let Some(entry) = self.entry.take_if(|entry| !has_keyboard || is_other(entry)) {
            self.leave(ui, editor, entry);
        }
        if !self::has_keyboard(ui) {
            return None;
        }
        if self.entry.is_some() {
            let key = cell_keys::for_text(ui);
            let is_text = |event: &Event| matches!(event, Event::Text(_));
            let typed = ui.input(|input| input.events.iter().any(is_text));
            self.follow |= typed || key.is_some();
            return key;
        }
        self.idle_keys(ui, editor, rows);
        // The key that ends an edit can come in the frame that begins it.
        self.entry.as_ref().and_then(|_| cell_keys::for_text(ui))
    }

    /// Handle keys while no number is edited.
    fn idle_keys(&mut self, ui: &mut Ui, editor: &mut Editor, rows: &Rows<'_>) {
        for key in cell_keys::for_cell(ui) {
            self.follow = true;
            self.remark = None;
            match key {
                CellKey::Step(step) => self.go(step, rows),
                CellKey::Edit => self.begin(ui, rows, None),
                CellKey::Replace => self.begin(ui, rows, Some("")),
                CellKey::Copy => {
                    let polygon = &rows.curve.polygon;
                    if let Some(value) = self.cell.column.value(polygon, self.cell.vertex) {
                        ui.copy_text(figures::exact(value));
                    }
                }
                CellKey::Paste(text) => {
                    let line = text.trim().lines().next().unwrap_or_default();
                    self.begin(ui, rows, Some(line));
                    if let Some(entry) = self.entry.take() {
                        self.finish(ui, editor, entry);
                    }
                }
                CellKey::Escape => ui.memory_mut(|memory| memory.surrender_focus(id())),
            }
        }
    }

    /// Begin to edit the cell's number: as it stands, or with another text in its place.
    fn begin(&mut self, ui: &Ui, rows: &Rows<'_>, text: Option<&str>) {
        let curve = rows.curve;
        let checked = curve.check_editable();
        let checked = checked.and_then(|()| curve.check_vertices_unlocked([self.cell.vertex]));
        let reason = checked.err().map(|reason| reason.to_string());
        if reason.is_none() {
            self.entry = Entry::new(rows.id, &curve.polygon, self.cell, text);
        }
        self.remark = reason.map(|reason| (self.cell, Remark::new(ui, reason)));
    }

    /// End the edit by a key: take the number, or show why not.
    fn end_entry(&mut self, ui: &mut Ui, editor: &mut Editor, rows: &Rows<'_>, key: CellKey) {
        let Some(entry) = self.entry.take() else {
            return;
        };
        ui.ctx().request_repaint();
        if let CellKey::Step(step) = key
            && self.finish(ui, editor, entry)
        {
            self.go(step, rows);
        }
    }

    /// Apply the number and return whether that succeeds; otherwise the edit goes on.
    fn finish(&mut self, ui: &mut Ui, editor: &mut Editor, mut entry: Entry) -> bool {
        let taken = entry.take_over(editor);
        let is_taken = taken.is_ok();
        if let Err(fault) = taken {
            entry.draft.refuse(fault);
            self.entry = Some(entry);
        }
        ui.ctx().request_repaint();
        is_taken
    }

    /// End the edit because the keyboard left: apply the number, or remark why not.
    fn leave(&mut self, ui: &mut Ui, editor: &mut Editor, entry: Entry) {
        let is_shown = editor.active() == Some(entry.curve);
        if let Err(fault) = entry.take_over(editor)
            && is_shown
        {
            let pixel = editor.view().viewport().pixel();
            let (shown, _) = entry.cell.column.shown(entry.draft.before, pixel);
            let remark = entry.draft.left(ui, &fault, &shown);
            self.remark = Some((entry.cell, remark));
        }
        // After a command the table goes on; after a press the keyboard is where that leads.
        if ui.memory(|memory| memory.focused().is_none()) {
            ui.memory_mut(|memory| memory.request_focus(id()));
        }
    }

    fn go(&mut self, step: Step, rows: &Rows<'_>) {
        let (columns, last) = (rows.columns, rows.last());
        let places = columns.len();
        let mut own = columns.iter();
        let place = own.position(|column| *column == self.cell.column);
        let (place, vertex) = (place.unwrap_or(0), self.cell.vertex);
        let page = self.visible.len().max(2) - 1;
        let (vertex, place) = match step {
            Step::Up => (vertex.saturating_sub(1), place),
            Step::Down => (vertex + 1, place),
            Step::Left => (vertex, place.saturating_sub(1)),
            Step::Right => (vertex, place + 1),
            Step::Next if place + 1 < places => (vertex, place + 1),
            Step::Next if vertex < last => (vertex + 1, 0),
            Step::Previous if place > 0 => (vertex, place - 1),
            Step::Previous if vertex > 0 => (vertex - 1, places),
            Step::Next | Step::Previous => (vertex, place),
            Step::PageUp => (vertex.saturating_sub(page), place),
            Step::PageDown => (vertex + page, place),
            Step::RowStart => (vertex, 0),
            Step::RowEnd => (vertex, places),
            Step::First => (0, place),
            Step::Last => (last, place),
        };
        self.cell.vertex = vertex.min(last);
        if let Some(column) = columns.get(place.min(places.saturating_sub(1))) {
            self.cell.column = *column;
        }
        self.follow = true;
    }

    /// Show the visible rows; returns the hovered one, and the place of the cell that has the keyboard.
    fn rows_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        rows: &Rows<'_>,
    ) -> (Option<usize>, Rect) {
        let follow = std::mem::take(&mut self.follow);
        let height = ui.available_height();
        let mut area = ScrollArea::vertical()
            .id_salt("vertex table")
            .auto_shrink([false, false]);
        if let Some(offset) = self.offset_to_show(rows.selected, height, follow) {
            area = area.vertical_scroll_offset(offset);
        }
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        let top = ui.cursor().min;
        let (mut hovered, mut focused, mut pressed) = (None, None, None);
        let shown = area.show_rows(ui, ROW, rows.last() + 1, |ui, range| {
            self.visible = range.clone();
            for vertex in range {
                let at = ui.cursor().min;
                let width = HEAD + rows.width * rows.columns.len() as f32;
                let rect = Rect::from_min_size(at, vec2(width, ROW));
                if ui.rect_contains_pointer(rect) {
                    hovered = Some(vertex);
                }
                let (cell, more) = self.row_ui(ui, editor, rows, (vertex, rect));
                (focused, pressed) = (focused.or(cell), more.or(pressed));
            }
        });
        self.offset = shown.state.clamped_offset().y;
        if let Some(cell) = focused.filter(|_| follow) {
            ui.scroll_to_rect_animation(cell, None, ScrollAnimation::none());
        }
        let place = focused.unwrap_or_else(|| {
            // Out of sight, but the keyboard stays.
            let nowhere = Rect::from_min_size(top, Vec2::ZERO);
            focus_ui(ui, nowhere);
            nowhere
        });
        if let Some((cell, edit)) = pressed {
            self.cell = cell;
            self.remark = None;
            ui.memory_mut(|memory| memory.request_focus(id()));
            if edit {
                self.begin(ui, rows, None);
            }
        }
        (hovered, place)
    }

    /// How far to scroll, so that a selection made elsewhere or the cell comes into sight.
    fn offset_to_show(&self, selected: &[usize], height: f32, follow: bool) -> Option<f32> {
        if follow {
            let top = self.cell.vertex as f32 * ROW;
            let highest = top + ROW - height;
            let offset = self.offset.min(top).max(highest);
            return (offset != self.offset).then_some(offset);
        }
        let first = *selected.first()?;
        let is_news = self.selected != selected && !self.visible.contains(&first);
        is_news.then_some((first as f32 * ROW - 0.4 * height).max(0.0))
    }

    /// Show a row; returns, if it is in this row, the place of the cell that has the keyboard, and the cell
    /// that was pressed, with whether to edit it.
    fn row_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        rows: &Rows<'_>,
        (vertex, row): (usize, Rect),
    ) -> (Option<Rect>, Option<(Cell, bool)>) {
        rows.paint(ui, vertex, row);
        let (mut focused, mut pressed) = (None, None);
        ui.horizontal(|ui| {
            rows.number_ui(ui, editor, vertex);
            rows.lock_ui(ui, editor, vertex, row);
            for column in rows.columns.iter().copied() {
                let cell = Cell { vertex, column };
                let (_, rect) = ui.allocate_space(vec2(rows.width, ROW));
                let is_here = cell == self.cell;
                if !(is_here && self.entry_ui(ui, rect)) {
                    let edit = rows.cell_ui(ui, editor, cell, rect);
                    pressed = edit.map(|edit| (cell, edit)).or(pressed);
                }
                if is_here {
                    self.cell_focus_ui(ui, rect);
                    focused = Some(rect);
                }
                self.remark_ui(ui, cell, rect);
            }
        });
        (focused, pressed)
    }

    /// Show the number that is being typed, if one is.
    fn entry_ui(&mut self, ui: &mut Ui, rect: Rect) -> bool {
        let Some(entry) = self.entry.as_mut().filter(|_| has_keyboard(ui)) else {
            return false;
        };
        let name = entry.cell.name();
        let accepted = entry.accepted(document_unit::get(ui.ctx()));
        let is_new = std::mem::take(&mut entry.is_new);
        let field = (id(), rect, name.as_str());
        entry.draft.show(ui, field, &accepted, is_new, KEYS);
        true
    }

    /// Outline the cell that keys are for, and take part in the order of Tab.
    fn cell_focus_ui(&self, ui: &mut Ui, rect: Rect) {
        if has_keyboard(ui) {
            widgets::outline(ui, rect, 2.0, Tokens::of(ui).accent);
        }
        if self.entry.is_none() || !has_keyboard(ui) {
            focus_ui(ui, rect);
        }
    }

    fn remark_ui(&mut self, ui: &Ui, cell: Cell, rect: Rect) {
        if let Some((place, remark)) = &self.remark
            && *place == cell
            && !remark.show(ui, id().with("remark"), rect)
        {
            self.remark = None;
        }
    }
}

fn has_keyboard(ui: &Ui) -> bool {
    ui.memory(|memory| memory.has_focus(id()))
}

/// The table's place for the keyboard.
fn focus_ui(ui: &mut Ui, rect: Rect) {
    let response = ui.interact(rect, id(), Sense::focusable_noninteractive());
    response.widget_info(|| WidgetInfo::labeled(Role::Group, true, "Vertex table"));
    ui.memory_mut(|memory| memory.set_focus_lock_filter(id(), KEYS));
}
