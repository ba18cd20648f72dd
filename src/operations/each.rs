//! An operation on several items, each by itself and all from the same document.

use std::collections::BTreeSet;

use super::copied_matches::match_copies;
use super::error::OperationError;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::Outcome;
use super::values::Values;
use crate::document::{CurveId, Document, Edit, free_name};
use crate::geometry::Progress;

/// Hold the result for one of several items.
#[derive(Debug)]
pub struct Share {
    /// The curve or the reference, if it is one.
    pub item: Option<CurveId>,
    /// What the operation ran on; `None` if it cannot run on the item.
    pub input: Option<Operands>,
    /// The outcome, or why there is none.
    pub outcome: Result<Outcome, OperationError>,
}

impl Operation {
    /// Run with values that were checked for this input, and on the items beside it with those of the values that
    /// are not their defaults. The first share is that of the input itself.
    ///
    /// What was asked for is reached where it holds once all edits are made: ends that follow another curve move with
    /// that. Added curves get names of their own.
    pub fn run_on_each(
        &self,
        input: &Operands,
        values: &Values,
        progress: &Progress,
    ) -> Vec<Share> {
        let all = 1.0 + input.beside().len() as f64;
        let changed = self.changed_values(input, values);
        let first = self.run(input, values, &progress.part(0.0, 1.0 / all));
        let mut shares = vec![Share {
            item: input.item(),
            input: Some(input.clone()),
            outcome: first,
        }];
        for (index, (item, beside)) in input.beside().iter().enumerate() {
            let (from, to) = ((1 + index) as f64 / all, (2 + index) as f64 / all);
            let part = progress.part(from, to).unshown();
            let outcome = beside.clone().and_then(|beside| {
                let values = self.values(&beside, changed.iter().cloned())?;
                self.run(&beside, &values, &part)
            });
            shares.push(Share {
                item: Some(*item),
                input: beside.clone().ok(),
                outcome,
            });
        }
        name_added(input.document(), &mut shares);
        if shares.len() > 1 {
            match_added(input.document(), &mut shares);
        }
        check_together(input.document(), &mut shares, progress);
        shares
    }

    /// The values that are not the defaults of an input.
    fn changed_values(
        &self,
        input: &Operands,
        values: &Values,
    ) -> Vec<(&'static str, super::Value)> {
        let Ok(defaults) = self.values(input, []) else {
            return Vec::new();
        };
        let changed = self
            .parameters
            .iter()
            .filter(|it| defaults.get(it) != values.get(it));
        changed
            .map(|it| (it.name, values.get(it).clone()))
            .collect()
    }
}

/// Give added curves and references names that neither the document nor one added before has.
fn name_added(document: &Document, shares: &mut [Share]) {
    let mut names: BTreeSet<String> = document.names().map(str::to_owned).collect();
    let outcomes = shares
        .iter_mut()
        .filter_map(|share| share.outcome.as_mut().ok());
    for edit in outcomes.flat_map(|outcome| &mut outcome.edits) {
        let name = match edit {
            Edit::Add(curve) => &mut curve.name,
            Edit::AddReference(reference) => &mut reference.name,
            _ => continue,
        };
        *name = free_name(name, |name| names.contains(name));
        names.insert(name.clone());
    }
}

/// Match the copies that several runs of one operation add, behind all of their edits. The first copies of all curves
/// belong together, then the second, and so on.
fn match_added(document: &Document, shares: &mut [Share]) {
    let mut ids = document.next_ids();
    let mut rows: Vec<Vec<[CurveId; 2]>> = Vec::new();
    let mut copying = None;
    for share in &*shares {
        let Ok(outcome) = &share.outcome else {
            continue;
        };
        let is_added = |edit: &&Edit| matches!(edit, Edit::Add(_) | Edit::AddReference(_));
        let count = outcome.edits.iter().filter(is_added).count();
        let added: Vec<CurveId> = ids.by_ref().take(count).collect();
        if let (Some(by), Some(own)) = (&outcome.copied, share.item) {
            copying = Some(by.clone());
            rows.resize_with(rows.len().max(added.len()), Vec::new);
            for (row, copy) in rows.iter_mut().zip(added) {
                row.push([own, copy]);
            }
        }
    }
    let outcomes = shares.iter_mut().rev();
    let last = outcomes.filter_map(|it| it.outcome.as_mut().ok()).next();
    if let (Some(copying), Some(last)) = (copying, last) {
        match_copies(last, document, &copying, &rows);
    }
}

/// Check the requirements on curves of the document once all edits are made.
fn check_together(document: &Document, shares: &mut [Share], progress: &Progress) {
    if shares.len() < 2 || document.matches().len() == 0 {
        return;
    }
    let outcomes = shares
        .iter()
        .filter_map(|share| share.outcome.as_ref().ok());
    let edits = outcomes.flat_map(|outcome| outcome.edits.iter().cloned());
    let Ok(after) = document.edited(edits) else {
        return;
    };
    for outcome in shares
        .iter_mut()
        .filter_map(|share| share.outcome.as_mut().ok())
    {
        let requirements = outcome.requirements.iter();
        if !requirements
            .clone()
            .all(|(id, _)| document.curve(*id).is_some())
        {
            continue;
        }
        if let Some(check) = outcome.check(&after, progress) {
            outcome.reached &= check.holds;
            outcome.residual = check.residual;
        }
    }
}
