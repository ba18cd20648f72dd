//! The columns of the vertex table: their numbers, and the edits that change them.

use eframe::egui::{Checkbox, Ui};
use glam::DVec3;
use lucide_icons::Icon;

use super::theme::Tokens;
use super::{figures, icons, widgets};
use crate::document::{Curve, CurveId, Edit};
use crate::geometry::parameters::Quantity;
use crate::geometry::{FloatPolygon, PolygonError};

/// What one column of fields holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Column {
    /// A coordinate: 0 x, 1 y, 2 z.
    Axis(usize),
    /// The weight.
    Weight,
}

impl Default for Column {
    fn default() -> Self {
        Self::Axis(0)
    }
}

/// A place in the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cell {
    /// The row.
    pub vertex: usize,
    /// The column.
    pub column: Column,
}

impl Cell {
    /// Its name for screen readers.
    pub fn name(self) -> String {
        format!("vertex {} {}", self.vertex, self.column.name())
    }
}

impl Column {
    /// The name of the column.
    pub fn name(self) -> &'static str {
        match self {
            Self::Axis(0) => "x",
            Self::Axis(1) => "y",
            Self::Axis(_) => "z",
            Self::Weight => "weight",
        }
    }

    /// What its numbers measure.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Axis(_) => Quantity::Length,
            Self::Weight => Quantity::Number,
        }
    }

    /// What undo calls a change.
    pub fn label(self) -> &'static str {
        match self {
            Self::Axis(_) => "Move vertex",
            Self::Weight => "Set weight",
        }
    }

    /// The number that a vertex has in this column, if there is such a vertex.
    pub fn value(self, polygon: &FloatPolygon, vertex: usize) -> Option<f64> {
        let place = polygon.vertices().get(vertex)?;
        Some(match self {
            Self::Axis(axis) => place[axis],
            Self::Weight => polygon.weight(vertex),
        })
    }

    /// The edit that gives a vertex another number.
    pub fn edit(self, curve: (CurveId, &FloatPolygon), vertex: usize, value: f64) -> Edit {
        let (curve, polygon) = curve;
        match self {
            Self::Axis(axis) => Edit::MoveVertices {
                curve,
                moves: vec![(vertex, moved(polygon, vertex, axis, value))],
            },
            Self::Weight => Edit::SetWeight {
                curve,
                vertex,
                weight: value,
            },
        }
    }

    /// Try whether a vertex can have a number.
    ///
    /// # Errors
    /// Why the polygon would not be one.
    pub fn check(
        self,
        polygon: &FloatPolygon,
        vertex: usize,
        value: f64,
    ) -> Result<(), PolygonError> {
        let mut tried = polygon.clone();
        match self {
            Self::Axis(axis) => {
                tried.move_vertices([(vertex, moved(polygon, vertex, axis, value))])
            }
            Self::Weight => tried.set_weight(vertex, value),
        }
    }

    /// How a number is shown when one point of the canvas spans `pixel`, and by how much it
    /// changes when it is dragged by one point.
    pub fn shown(self, value: f64, pixel: f64) -> (String, f64) {
        match self {
            Self::Axis(_) => (figures::coordinate(value, pixel), pixel),
            Self::Weight => (figures::to_resolution(value, 1e-5), 0.01),
        }
    }
}

fn moved(polygon: &FloatPolygon, vertex: usize, axis: usize, value: f64) -> DVec3 {
    let mut place = polygon.vertices().get(vertex).copied().unwrap_or_default();
    place[axis] = value;
    place
}

/// The columns that are shown though a curve does without them.
#[derive(Clone, Copy, Debug, Default)]
pub struct MoreColumns {
    z: bool,
    weights: bool,
}

impl MoreColumns {
    /// List a curve's columns.
    pub fn of(self, polygon: &FloatPolygon) -> Vec<Column> {
        let axes = if self.z || !polygon.is_planar() { 3 } else { 2 };
        let mut columns: Vec<Column> = (0..axes).map(Column::Axis).collect();
        if self.weights || polygon.is_rational() {
            columns.push(Column::Weight);
        }
        columns
    }

    /// Show the switches, and why the numbers cannot be edited if that is so.
    pub fn show(&mut self, ui: &mut Ui, curve: &Curve) {
        let polygon = &curve.polygon;
        widgets::form_row(ui, "Columns", |ui| {
            let z = (
                "z",
                "Show heights: a height other than 0 makes a space curve",
                "This curve is in space",
            );
            switch_ui(ui, &mut self.z, !polygon.is_planar(), z);
            let weights = (
                "Weights",
                "Show weights: a weight other than 1 makes the curve rational",
                "This curve is rational",
            );
            switch_ui(ui, &mut self.weights, polygon.is_rational(), weights);
            if let Some((icon, state)) = protection(curve) {
                widgets::at_right(ui, |ui| {
                    widgets::caption(ui, state);
                    ui.label(icons::text(icon).color(Tokens::of(ui).faint_text));
                });
            }
        });
    }
}

fn switch_ui(ui: &mut Ui, chosen: &mut bool, needed: bool, words: (&str, &str, &str)) {
    let (name, tooltip, why) = words;
    let mut shown = *chosen || needed;
    let response = ui.add_enabled(!needed, Checkbox::new(&mut shown, name));
    let response = response.accessible_name(format!("Column {name}"));
    if response.clicked() {
        *chosen = shown;
    }
    response.on_hover_text(tooltip).on_disabled_hover_text(why);
}

fn protection(curve: &Curve) -> Option<(Icon, &'static str)> {
    match (curve.locked, curve.visible) {
        (true, _) => Some((Icon::Lock, "Locked")),
        (false, false) => Some((Icon::EyeOff, "Hidden")),
        (false, true) => None,
    }
}
