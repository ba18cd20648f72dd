//! The edit of a number in a table.

use super::draft::{Accepted, Draft, Fault};
use super::vertex_columns::Cell;
use crate::document::CurveId;
use crate::editor::{Editor, told};
use crate::geometry::FloatPolygon;
use crate::geometry::expressions::LengthUnit;

/// The edit of a number, with its curve and its cell.
pub struct Entry {
    /// The curve it is typed for.
    pub curve: CurveId,
    /// The cell it is typed into.
    pub cell: Cell,
    /// The text so far.
    pub draft: Draft,
    /// Whether it is yet to be shown.
    pub is_new: bool,
    /// How many vertices the curve has had so far.
    count: usize,
}

impl Entry {
    /// Begin to type a number into a cell: from the number as it stands, or with another text in
    /// its place. `None` if there is no such vertex.
    pub fn new(
        curve: CurveId,
        polygon: &FloatPolygon,
        cell: Cell,
        text: Option<&str>,
    ) -> Option<Self> {
        let before = cell.column.value(polygon, cell.vertex)?;
        let draft = match text {
            None => Draft::of(before),
            Some(text) => Draft::instead_of(before, text),
        };
        Some(Self {
            curve,
            cell,
            draft,
            is_new: true,
            count: polygon.vertices().len(),
        })
    }

    /// The numbers that the field accepts, as far as it knows.
    pub fn accepted(&self, unit: Option<LengthUnit>) -> Accepted {
        Accepted {
            quantity: self.cell.column.quantity(),
            unit,
            range: f64::MIN..=f64::MAX,
        }
    }

    /// Give the number to the vertex it was typed for. If that vertex is gone or has changed
    /// meanwhile, nothing is changed.
    ///
    /// # Errors
    /// Why the number cannot be taken.
    pub fn take_over(&self, editor: &mut Editor) -> Result<(), Fault> {
        let Some(value) = self.draft.value(&self.accepted(editor.document().unit()))? else {
            return Ok(());
        };
        let Cell { vertex, column } = self.cell;
        let Some(curve) = editor.document().curve(self.curve) else {
            return Ok(());
        };
        let polygon = &curve.polygon;
        let is_same = polygon.vertices().len() == self.count
            && column.value(polygon, vertex) == Some(self.draft.before);
        if !is_same {
            return Ok(());
        }
        curve.check_editable().map_err(|error| error.to_string())?;
        let tried = column.check(polygon, vertex, value);
        tried.map_err(|error| error.to_string())?;
        let edit = column.edit((self.curve, polygon), vertex, value);
        told(editor.apply(column.label(), vec![edit]));
        Ok(())
    }
}
