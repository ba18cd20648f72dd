//! The rows of the table of vertices.

use eframe::egui::{Align2, Id, Rect, Role, Sense, Ui, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::cell_entry::Cell;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::vertex_columns::Column;
use super::widgets;
use crate::document::Curve;

/// The width of the column of vertex numbers.
const NUMBER: f32 = 44.0;

/// The width of the column of locks.
const LOCK: f32 = 24.0;

/// The width before the columns of numbers.
pub const HEAD: f32 = NUMBER + LOCK;

/// The size of a lock.
const SIGN: f32 = 12.0;

/// Dragging takes weights down to this: 0 is none.
const LEAST_WEIGHT: f64 = 0.01;

/// The identity of the table's focus: one for all cells, so that the keyboard stays when
/// another cell is gone to, and when a row scrolls out of sight.
pub fn id() -> Id {
    Id::unique("vertex table")
}

/// An action of the user in a row.
pub enum RowAction {
    /// Select a vertex, alone or in addition.
    Select { vertex: usize, add: bool },
    /// Lock or unlock a vertex.
    Lock { vertex: usize, locked: bool },
    /// Give a cell the keyboard, and edit it.
    Focus { cell: Cell, edit: bool },
    /// Drag or set the number of a cell.
    Field(Cell, FieldEvent),
}

/// The data that the rows share.
pub struct Rows<'a> {
    /// The curve.
    pub curve: &'a Curve,
    /// The columns beside the vertices' numbers.
    pub columns: &'a [Column],
    /// The width of each.
    pub width: f32,
    /// The selected vertices, in rising order.
    pub selected: &'a [usize],
    /// The vertex that is hovered, here or elsewhere.
    pub hovered: Option<usize>,
    /// How much of the model a point of the canvas spans.
    pub pixel: f64,
    /// Whether the curve's numbers can be edited.
    pub can_edit: bool,
}

impl Rows<'_> {
    /// Paint the background of a row.
    pub fn paint(&self, ui: &Ui, vertex: usize, rect: Rect) {
        let tokens = Tokens::of(ui);
        if self.is_selected(vertex) {
            ui.painter().rect_filled(rect, RADIUS, tokens.selection);
        } else if self.hovered == Some(vertex) || ui.rect_contains_pointer(rect) {
            ui.painter().rect_filled(rect, RADIUS, tokens.button[0]);
        }
    }

    fn is_selected(&self, vertex: usize) -> bool {
        self.selected.binary_search(&vertex).is_ok()
    }

    /// Show a vertex's number: pressing it selects the vertex.
    pub fn number_ui(&self, ui: &mut Ui, vertex: usize) -> Option<RowAction> {
        let (_, rect) = ui.allocate_space(vec2(NUMBER, ROW));
        let response = ui.interact(rect, id().with(("number", vertex)), Sense::click());
        let tokens = Tokens::of(ui);
        let selected = self.is_selected(vertex);
        let colour = if selected {
            tokens.strong_text
        } else {
            tokens.faint_text
        };
        let inner = rect.with_max_x(rect.right() - 1.5 * STEP);
        widgets::number_in(ui, inner, &vertex.to_string(), colour);
        if response.has_focus() {
            widgets::focus_ring(ui, rect);
        }
        response.widget_info(|| {
            let name = format!("vertex {vertex}");
            WidgetInfo::selected(Role::Button, true, selected, name)
        });
        let add = ui.input(|input| input.modifiers.shift || input.modifiers.command);
        response
            .clicked()
            .then_some(RowAction::Select { vertex, add })
    }

    /// Show whether a vertex is locked: pressing the lock changes it. An open lock shows where the
    /// pointer is.
    pub fn lock_ui(&self, ui: &mut Ui, vertex: usize, row: Rect) -> Option<RowAction> {
        let (_, rect) = ui.allocate_space(vec2(LOCK, ROW));
        let response = ui.interact(rect, id().with(("lock", vertex)), Sense::click());
        let response = response.on_hover_text(if self.is_locked(vertex) {
            "Unlock the vertex"
        } else {
            "Lock the vertex in place"
        });
        let tokens = Tokens::of(ui);
        let shown = match (self.is_locked(vertex), response.hovered()) {
            (true, _) => Some((Icon::Lock, tokens.float)),
            (false, true) => Some((Icon::LockOpen, tokens.text)),
            (false, false) if ui.rect_contains_pointer(row) || response.has_focus() => {
                Some((Icon::LockOpen, tokens.faint_text))
            }
            (false, false) => None,
        };
        if let Some((icon, colour)) = shown {
            let (text, font) = (char::from(icon), theme::icon_font(SIGN));
            ui.painter()
                .text(rect.center(), Align2::CENTER_CENTER, text, font, colour);
        }
        if response.has_focus() {
            widgets::focus_ring(ui, rect);
        }
        let locked = self.is_locked(vertex);
        response.widget_info(|| {
            let name = format!("vertex {vertex} locked");
            WidgetInfo::selected(Role::CheckBox, true, locked, name)
        });
        let locked = !locked;
        let action = RowAction::Lock { vertex, locked };
        response.clicked().then_some(action)
    }

    fn is_locked(&self, vertex: usize) -> bool {
        self.curve.locked_vertices.contains(vertex)
    }

    /// Show a cell in which nothing is typed.
    pub fn cell_ui(&self, ui: &mut Ui, cell: Cell, rect: Rect) -> Option<RowAction> {
        let value = cell.column.value(&self.curve.polygon, cell.vertex)?;
        let (shown, speed) = cell.column.shown(value, self.pixel);
        let name = name(cell);
        let mut field = NumberField::new(&name, value, shown)
            .speed(speed)
            .quantity(cell.column.quantity());
        if cell.column == Column::Weight {
            field = field.range(value.min(LEAST_WEIGHT)..=f64::MAX);
        }
        let field = field
            .flat()
            .read_only(!self.can_edit || self.is_locked(cell.vertex));
        let (response, event) = field.resting_ui(ui, rect, id().with(cell_key(cell)));
        let edit = response.double_clicked();
        let focus = response
            .clicked()
            .then_some(RowAction::Focus { cell, edit });
        event.map(|event| RowAction::Field(cell, event)).or(focus)
    }
}

fn cell_key(cell: Cell) -> (usize, Column) {
    (cell.vertex, cell.column)
}

/// The name of a cell for screen readers.
pub fn name(cell: Cell) -> String {
    format!("vertex {} {}", cell.vertex, cell.column.name())
}

/// Show the names of the columns.
pub fn heading_ui(ui: &mut Ui, columns: &[Column], width: f32) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let colour = Tokens::of(ui).faint_text;
        let mut cell = |text: &str, width: f32| {
            let (rect, _) = ui.allocate_exact_size(vec2(width, 5.0 * STEP), Sense::hover());
            let at = rect.right_center() - vec2(1.5 * STEP, 0.0);
            ui.painter()
                .text(at, Align2::RIGHT_CENTER, text, theme::small_font(), colour);
        };
        cell("vertex", NUMBER);
        cell("", LOCK);
        for column in columns {
            cell(column.name(), width);
        }
    });
}
