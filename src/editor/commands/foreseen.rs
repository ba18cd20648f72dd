//! Forecasts of commands: the deviation that they would cause.

use crate::editor::Editor;
use crate::editor::jobs::foreseeing::Candidate;
use crate::operations::{Deviation, Operation, elevate_degree, reduce_degree};

/// The operations whose deviation menus show beforehand.
static FORESEEN: [&Operation; 2] = [&elevate_degree::OPERATION, &reduce_degree::OPERATION];

impl Editor {
    /// Forecast for the active curve, so that [`Editor::foreseen`] knows it. Called while a menu shows it.
    pub fn foresee(&mut self) {
        self.foreseeing.receive();
        let curve = self.sight().shown.settled_active().cloned();
        let Some(curve) = curve.filter(|curve| !self.foreseeing.is_about(curve)) else {
            return;
        };
        let candidates = FORESEEN.into_iter().filter_map(|operation| {
            let input = self.input_of(operation).ok()?;
            let values = operation.values(&input, []).ok()?;
            Some((operation, input, values))
        });
        let candidates: Vec<Candidate> = candidates.collect();
        self.foreseeing
            .foresee(curve, candidates, &mut self.patience);
    }

    /// How far an operation would move the active curve with the values that it begins with. `None` if that
    /// is not known, not yet, or the operation cannot be done, and where several curves are selected.
    pub fn foreseen(&self, operation: &Operation) -> Option<Deviation> {
        let curve = self.sight().shown.settled_active()?;
        let is_alone = !self.hand.selection.has_several_items();
        let deviation = self.foreseeing.deviation(curve, operation);
        deviation.filter(|_| is_alone)
    }
}
