//! Starting operations: their inputs, and the previews that they interrupt.

use crate::document::{Curve, CurveId, Document};
use crate::editor::Editor;
use crate::editor::operating::{Operating, OperationInProgress};
use crate::editor::reply::{Note, Reply};
use crate::editor::selection::Selection;
use crate::geometry::End;
use crate::operations::{Inputs, Operands, Operation, OperationError, Value};

impl Editor {
    /// The operation that is previewed or was applied last, unless something else was done since.
    pub fn operation(&self) -> Option<&OperationInProgress> {
        self.operations.current(&self.workspace, self.active())
    }

    /// The operation that is previewed.
    pub fn previewed_operation(&self) -> Option<&OperationInProgress> {
        self.operation().filter(|it| !it.is_applied())
    }

    /// The share of the operation's work that is done, from 0 to 1, while it runs beside the frame.
    pub fn operation_progress(&self) -> Option<f64> {
        self.operations.progress()
    }

    /// Change the operation in progress: its values, its preview, its end.
    pub fn operating(&mut self) -> Operating<'_> {
        Operating {
            operations: &mut self.operations,
            workspace: &mut self.workspace,
            hand: &mut self.hand,
            view: &mut self.view,
            patience: &mut self.patience,
            message: &mut self.message,
        }
    }

    /// Preview an operation; one without parameters is applied at once. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`](crate::editor::Refusal) if it cannot run on its input.
    pub fn preview_operation(&mut self, operation: &'static Operation) -> Reply {
        if operation.parameters.is_empty() {
            return self.apply_operation(operation, &[]);
        }
        self.message = None;
        let lost = self.interrupt().lost;
        let input = self.input_of(operation);
        let begun = self.operating().preview(operation, input, &[], None);
        self.tell(lost.before(begun.map(|()| Note::silent())))
    }

    /// Apply an operation with some values; the others have their defaults. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`](crate::editor::Refusal) if it cannot run or does not reach its aim; nothing is changed
    /// then.
    pub fn apply_operation(
        &mut self,
        operation: &'static Operation,
        given: &[(&str, Value)],
    ) -> Reply {
        let lost = self.interrupt().lost;
        let input = self.input_of(operation);
        let reply = self
            .operating()
            .apply_at_once(operation, input, given, None);
        self.tell(lost.before(reply))
    }

    /// The input of an operation: the active curve or reference, and the selected curves; where a second one is
    /// needed and none is selected, the nearest. An operation on each of several items gets all that are selected,
    /// the active one first, if it can run on it.
    ///
    /// # Errors
    /// [`OperationError`] if the operation cannot run on them, whatever its values.
    pub fn input_of(&self, operation: &Operation) -> Result<Operands, OperationError> {
        let (selection, document) = (&self.hand.selection, self.workspace.settled());
        // The panel fits references of points; the vertices of a curve are fitted from a shell.
        let fits =
            |id: &CurveId| operation.inputs != Inputs::Points || document.reference(*id).is_some();
        if operation.each && selection.has_several_items() {
            return each_of(document, operation, selection, fits);
        }
        let active = selection.active().filter(fits);
        let others = self.document().ids().filter(|id| Some(*id) != active);
        let others = others.filter(|id| selection.has_item(*id));
        let mut others: Vec<CurveId> = others.collect();
        if operation.inputs == Inputs::Two && others.is_empty() {
            others.extend(active.and_then(|active| nearest_curve(document, active)));
        }
        let input = Operands::choose(document, operation.inputs, active, &others)?;
        operation.check(&input)?;
        Ok(input)
    }
}

/// The input of an operation on each of the selected items: those of other kinds are left out.
fn each_of(
    document: &Document,
    operation: &Operation,
    selection: &Selection,
    fits: impl Fn(&CurveId) -> bool,
) -> Result<Operands, OperationError> {
    let active = selection.active().filter(|id| selection.has_item(*id));
    let others = document
        .all_ids()
        .filter(|id| selection.has_item(*id) && Some(*id) != active);
    let chosen = active.into_iter().chain(others).filter(fits).map(|id| {
        let input = Operands::choose(document, operation.inputs, Some(id), &[]);
        let checked = input.and_then(|input| operation.check(&input).map(|()| input));
        (id, checked)
    });
    let of_kind = |error: &OperationError| !matches!(error, OperationError::Inputs { .. });
    let mut chosen: Vec<_> = chosen
        .filter(|(_, input)| input.as_ref().err().is_none_or(of_kind))
        .collect();
    if chosen.is_empty() {
        let needed = operation.inputs;
        return Err(OperationError::Inputs { needed });
    }
    let first = chosen.iter().position(|(_, input)| input.is_ok());
    let (_, input) = chosen.remove(first.unwrap_or(0));
    Ok(input?.with_beside(chosen))
}

/// The visible, unlocked open curve whose ends are nearest to those of another one.
fn nearest_curve(document: &Document, id: CurveId) -> Option<CurveId> {
    let own = document.curve(id)?;
    let ends = |curve: &Curve| End::BOTH.map(|end| curve.polygon.end_jet(end).point);
    let apart = |curve: &Curve| {
        let pairs = ends(own).into_iter().flat_map(|one| {
            let others = ends(curve).into_iter();
            others.map(move |other| one.distance(other))
        });
        pairs.fold(f64::INFINITY, f64::min)
    };
    let others = document.curves().filter(|(other, curve)| {
        *other != id && !curve.polygon.is_periodic() && curve.check_editable().is_ok()
    });
    let nearest = others.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    nearest.map(|(other, _)| other)
}
