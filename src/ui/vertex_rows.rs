//! The rows of the table of vertices.

use eframe::egui::{Align2, Id, Rect, Role, Sense, Ui, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::number_field::NumberField;
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::vertex_columns::{Cell, Column};
use super::{document_unit, widgets};
use crate::document::{Curve, CurveId, Edit};
use crate::editor::{Editor, told};
use crate::geometry::parameters::Quantity;

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

/// The data that the rows share.
pub struct Rows<'a> {
    /// The curve's identity.
    pub id: CurveId,
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
    pub fn number_ui(&self, ui: &mut Ui, editor: &mut Editor, vertex: usize) {
        let (_, rect) = ui.allocate_space(vec2(NUMBER, ROW));
        let response = ui.interact(rect, id().with(("number", vertex)), Sense::click());
        let tokens = Tokens::of(ui);
        let selected = self.is_selected(vertex);
        let colour = match selected {
            true => tokens.strong_text,
            false => tokens.faint_text,
        };
        let inner = rect.with_max_x(rect.right() - 1.5 * STEP);
        widgets::number_in(ui, inner, &vertex.to_string(), colour);
        if response.has_focus() {
            widgets::focus_ring(ui, rect);
        }
        let name = format!("vertex {vertex}");
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &name));
        if response.clicked() {
            let add = ui.input(|input| input.modifiers.shift || input.modifiers.command);
            editor.select_vertex(self.id, vertex, add);
        }
    }

    /// Show whether a vertex is locked: pressing the lock changes it. An open lock shows where the
    /// pointer is.
    pub fn lock_ui(&self, ui: &mut Ui, editor: &mut Editor, vertex: usize, row: Rect) {
        let (_, rect) = ui.allocate_space(vec2(LOCK, ROW));
        let response = ui.interact(rect, id().with(("lock", vertex)), Sense::click());
        let is_locked = self.is_locked(vertex);
        let response = response.on_hover_text(match is_locked {
            true => "Unlock the vertex",
            false => "Lock the vertex in place",
        });
        let tokens = Tokens::of(ui);
        let has_focus = response.has_focus();
        let is_near = ui.rect_contains_pointer(row) || has_focus;
        let shown = match (is_locked, response.hovered()) {
            (true, _) => Some((Icon::Lock, tokens.float)),
            (false, true) => Some((Icon::LockOpen, tokens.text)),
            (false, false) => is_near.then_some((Icon::LockOpen, tokens.faint_text)),
        };
        if let Some((icon, colour)) = shown {
            let (text, font) = (char::from(icon), theme::icon_font(SIGN));
            let centre = rect.center();
            let painter = ui.painter();
            painter.text(centre, Align2::CENTER_CENTER, text, font, colour);
        }
        if has_focus {
            widgets::focus_ring(ui, rect);
        }
        let name = format!("vertex {vertex} locked");
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_locked, &name));
        if response.clicked() {
            told(editor.change(Edit::SetVerticesLocked {
                curve: self.id,
                vertices: vec![vertex],
                locked: !is_locked,
            }));
        }
    }

    /// The number of the last vertex.
    pub fn last(&self) -> usize {
        self.curve.polygon.vertices().len().saturating_sub(1)
    }

    fn is_locked(&self, vertex: usize) -> bool {
        self.curve.locked_vertices.contains(vertex)
    }

    /// Show a cell in which nothing is typed. Returns whether to edit it, if it was pressed.
    pub fn cell_ui(
        &self,
        ui: &mut Ui,
        editor: &mut Editor,
        cell: Cell,
        rect: Rect,
    ) -> Option<bool> {
        let Cell { vertex, column } = cell;
        let value = column.value(&self.curve.polygon, vertex)?;
        let (shown, speed) = column.shown(value, self.pixel);
        let can_edit = self.curve.check_editable().is_ok() && !self.is_locked(vertex);
        let name = cell.name();
        let field = NumberField::new(&name, value, shown)
            .speed(speed)
            .quantity(column.quantity());
        let field = match column {
            Column::Axis(_) => field,
            Column::Weight => field.range(value.min(LEAST_WEIGHT)..=f64::MAX),
        };
        let field = field.cell(!can_edit);
        let (response, event) = field.resting_ui(ui, rect, id().with(cell));
        if let Some(event) = event {
            let label = column.label();
            let polygon = (self.id, &self.curve.polygon);
            let edits = |value: f64| vec![column.edit(polygon, vertex, value)];
            event.map(edits).send(
                editor,
                |editor, edits| editor.preview(label, edits),
                |editor, edits| told(editor.apply(label, edits)),
            );
            return None;
        }
        response.clicked().then(|| response.double_clicked())
    }
}

/// Show the names of the columns.
pub fn heading_ui(ui: &mut Ui, columns: &[Column], width: f32) {
    let context = ui.ctx().clone();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let colour = Tokens::of(ui).faint_text;
        let mut cell = |text: &str, width: f32| {
            let (rect, _) = ui.allocate_exact_size(vec2(width, 5.0 * STEP), Sense::hover());
            let rect = rect.with_max_x(rect.right() - 1.5 * STEP);
            widgets::text_in(
                ui,
                rect,
                Align2::RIGHT_CENTER,
                text,
                theme::small_font(),
                colour,
            );
        };
        cell("vertex", NUMBER);
        cell("", LOCK);
        for column in columns {
            let name = column.name().to_owned();
            let name = match column.quantity() {
                Quantity::Length => document_unit::length(&context, name),
                _ => name,
            };
            cell(&name, width);
        }
    });
}
