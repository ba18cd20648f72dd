//! The table of a curve's vertices: every coordinate typed or dragged.

use eframe::egui::{Align2, Rect, Role, ScrollArea, Sense, Ui, Vec2, WidgetInfo, vec2};
use glam::DVec3;

use super::number_field::{FieldEvent, NumberField};
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::document::{Curve, CurveId, Edit};
use crate::editor::Editor;

/// The width of the column of vertex numbers.
const NUMBER: f32 = 44.0;

/// The height of the table at least and at most.
const HEIGHTS: (f32, f32) = (6.0 * ROW, 24.0 * ROW);

/// What one column of fields holds.
#[derive(Clone, Copy, PartialEq)]
enum Column {
    Axis(usize),
    Weight,
}

impl Column {
    fn name(self) -> &'static str {
        match self {
            Self::Axis(axis) => ["x", "y", "z"][axis],
            Self::Weight => "weight",
        }
    }
}

/// The table's own state.
#[derive(Default)]
pub struct VertexTable {
    /// What was selected in the last frame: a change from elsewhere is scrolled to.
    selected: Vec<usize>,
    /// The rows that were visible in the last frame.
    visible: std::ops::Range<usize>,
}

/// What a row asks for.
enum Asked {
    Select { vertex: usize, add: bool },
    Field(Column, usize, FieldEvent),
}

impl VertexTable {
    /// Show the table.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, id: CurveId, curve: &Curve) {
        let columns = columns(curve);
        let selected = editor.selected_vertices(id);
        let plots_hover = editor.hovered_vertex();
        let count = curve.polygon.vertices().len();
        let height = (count as f32 * ROW).clamp(0.0, HEIGHTS.1);
        let free = ui.available_height() - ROW - 2.0 * STEP;
        let height = height.min(free.max(HEIGHTS.0));
        let width = ui.available_width() - 3.0 * STEP;
        let column = ((width - NUMBER) / columns.len() as f32).floor();
        heading_ui(ui, &columns, column);
        let mut area = ScrollArea::vertical()
            .id_salt("vertex table")
            .max_height(height)
            .min_scrolled_height(height)
            .auto_shrink([false, true]);
        if let Some(row) = self.row_to_show(&selected) {
            let top = row as f32 * ROW - 0.4 * height;
            area = area.vertical_scroll_offset(top.max(0.0));
        }
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        let mut asked = None;
        let mut hovered = None;
        let mut visible = 0..0;
        area.show_rows(ui, ROW, count, |ui, rows| {
            visible = rows.clone();
            for vertex in rows {
                let row = Row {
                    vertex,
                    curve,
                    columns: &columns,
                    width: column,
                    selected: selected.binary_search(&vertex).is_ok(),
                    hovered: plots_hover == Some(vertex),
                    speed: editor.viewport().pixel(),
                };
                let (is_hovered, more) = row.show(ui);
                if is_hovered {
                    hovered = Some(vertex);
                }
                asked = more.or(asked.take());
            }
        });
        self.visible = visible;
        self.selected = selected;
        if let Some(hovered) = hovered {
            editor.hover_vertex(hovered);
        }
        if let Some(asked) = asked {
            execute(editor, id, curve, asked);
        }
    }

    /// The row that a selection made elsewhere asks to see.
    fn row_to_show(&self, selected: &[usize]) -> Option<usize> {
        let first = *selected.first()?;
        (self.selected != selected && !self.visible.contains(&first)).then_some(first)
    }
}

fn columns(curve: &Curve) -> Vec<Column> {
    let axes = if curve.polygon.is_planar() { 2 } else { 3 };
    let mut columns: Vec<Column> = (0..axes).map(Column::Axis).collect();
    if curve.polygon.weights().is_some() {
        columns.push(Column::Weight);
    }
    columns
}

fn heading_ui(ui: &mut Ui, columns: &[Column], width: f32) {
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
        for column in columns {
            cell(column.name(), width);
        }
    });
}

struct Row<'a> {
    vertex: usize,
    curve: &'a Curve,
    columns: &'a [Column],
    width: f32,
    selected: bool,
    hovered: bool,
    speed: f64,
}

impl Row<'_> {
    /// Show the row; tells whether it is hovered and what it asks for.
    fn show(&self, ui: &mut Ui) -> (bool, Option<Asked>) {
        let width = NUMBER + self.width * self.columns.len() as f32;
        let at = ui.cursor().min;
        let rect = Rect::from_min_size(at, vec2(width, ROW));
        self.paint(ui, rect);
        let mut asked = None;
        ui.push_id(self.vertex, |ui| {
            ui.horizontal(|ui| {
                asked = self.number_ui(ui);
                ui.add_enabled_ui(!self.curve.locked, |ui| {
                    for column in self.columns {
                        let event = self.field_ui(ui, *column);
                        if event != FieldEvent::Idle {
                            asked = Some(Asked::Field(*column, self.vertex, event));
                        }
                    }
                });
            });
        });
        (ui.rect_contains_pointer(rect), asked)
    }

    fn paint(&self, ui: &Ui, rect: Rect) {
        let tokens = Tokens::of(ui);
        if self.selected {
            ui.painter().rect_filled(rect, RADIUS, tokens.selection);
        } else if self.hovered || ui.rect_contains_pointer(rect) {
            ui.painter().rect_filled(rect, RADIUS, tokens.button[0]);
        }
    }

    fn number_ui(&self, ui: &mut Ui) -> Option<Asked> {
        let (rect, response) = ui.allocate_exact_size(vec2(NUMBER, ROW), Sense::click());
        let tokens = Tokens::of(ui);
        let colour = if self.selected {
            tokens.strong_text
        } else {
            tokens.faint_text
        };
        let inner = rect.with_max_x(rect.right() - 1.5 * STEP);
        widgets::number_in(ui, inner, &self.vertex.to_string(), colour);
        if response.has_focus() {
            widgets::focus_ring(ui, rect);
        }
        response.widget_info(|| {
            let name = format!("vertex {}", self.vertex);
            WidgetInfo::selected(Role::Button, true, self.selected, name)
        });
        let add = ui.input(|input| input.modifiers.shift || input.modifiers.command);
        response.clicked().then_some(Asked::Select {
            vertex: self.vertex,
            add,
        })
    }

    fn field_ui(&self, ui: &mut Ui, column: Column) -> FieldEvent {
        let value = value(self.curve, column, self.vertex);
        let (shown, speed) = match column {
            Column::Axis(_) => (
                figures::to_resolution(value, 0.01 * self.speed.max(1e-300)),
                self.speed,
            ),
            Column::Weight => (figures::to_resolution(value, 1e-5), 0.01),
        };
        let name = format!("vertex {} {}", self.vertex, column.name());
        let field = NumberField::new(&name, value, shown)
            .speed(speed)
            .width(self.width)
            .flat();
        field.show(ui).1
    }
}

fn value(curve: &Curve, column: Column, vertex: usize) -> f64 {
    match column {
        Column::Axis(axis) => curve.polygon.vertex(vertex)[axis],
        Column::Weight => curve.polygon.weight(vertex),
    }
}

fn execute(editor: &mut Editor, id: CurveId, curve: &Curve, asked: Asked) {
    let (column, vertex, event) = match asked {
        Asked::Select { vertex, add } => return editor.select_vertex(id, vertex, add),
        Asked::Field(column, vertex, event) => (column, vertex, event),
    };
    let label = match column {
        Column::Axis(_) => "Move vertex",
        Column::Weight => "Set weight",
    };
    let edits = |value: f64| {
        vec![match column {
            Column::Axis(axis) => {
                let mut place: DVec3 = curve.polygon.vertex(vertex);
                place[axis] = value;
                Edit::MoveVertices {
                    curve: id,
                    moves: vec![(vertex, place)],
                }
            }
            Column::Weight => Edit::SetWeight {
                curve: id,
                vertex,
                weight: value,
            },
        }]
    };
    match event {
        FieldEvent::Idle => {}
        FieldEvent::Preview(value) => editor.preview_field(label, edits(value)),
        FieldEvent::Commit => editor.commit_field(),
        FieldEvent::Abort => editor.abort_field(),
        FieldEvent::Typed(value) => {
            editor.apply(label, edits(value));
        }
    }
}
