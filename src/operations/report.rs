//! What an operation did, in figures.

use std::sync::Arc;

use glam::DVec3;

use serde::Serialize;

use super::features::FeatureComparison;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::value::Value;
use crate::document::Document;
use crate::geometry::Progress;
use crate::geometry::approximation::LevelComparison;

/// Residuals below this share of the size of the curve are rounding, and no reason why something is not reached.
const ROUNDING: f64 = 1e-12;

/// Hold what an operation did: one schema for all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The operation's name.
    pub name: &'static str,
    /// What the step of undo is called.
    pub label: &'static str,
    /// Whether what was asked for is reached.
    pub reached: bool,
    /// Whether there is something to keep: what was asked for, or the best that was found.
    pub useful: bool,
    /// What is left of a target or tolerance, as a length.
    pub residual: Option<f64>,
    /// What of this is only rounding.
    pub rounding: f64,
    /// How far the curve moves.
    pub deviation: Deviation,
    /// The largest move of a vertex; `None` where vertices have no counterparts.
    pub largest_move: Option<LargestMove>,
    /// The operation's own figures.
    pub figures: Vec<Figure>,
    /// Where the curve stands for another one: the levels of both.
    pub equivalence: Option<Vec<LevelComparison>>,
    /// What the user may not want: sentences without a full stop at the end.
    pub warnings: Vec<String>,
    /// What else is to say: sentences without a full stop at the end.
    pub remarks: Vec<String>,
    /// Proved features and harmony before and afterwards; `None` until they are proved.
    pub features: Option<FeatureComparison>,
}

/// The vertex that moves farthest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LargestMove {
    /// How far it moves.
    pub distance: f64,
    /// Its number, counted from 0.
    pub vertex: usize,
}

impl Report {
    /// Whether the user may not want the result: there is a warning, or inflections or curvature
    /// extrema are added.
    pub fn warns(&self) -> bool {
        let features = self.features.as_ref();
        !self.warnings.is_empty() || features.is_some_and(|it| !it.remarks_on_more().is_empty())
    }

    /// Find one of the operation's own figures.
    pub fn figure(&self, name: &str) -> Option<Value> {
        let mut figures = self.figures.iter();
        Some(figures.find(|figure| figure.name == name)?.value.clone())
    }

    /// Return how far the curve moves, as a length: 0 where it is the same; `None` if that is not measured.
    pub(super) fn moved(&self) -> Option<f64> {
        match self.deviation {
            Deviation::Exact => Some(0.0),
            Deviation::AtMost(length)
            | Deviation::Measured(length)
            | Deviation::FromPoints(length) => Some(length),
            Deviation::Unmeasured => None,
        }
    }

    /// Return the largest distance of the result from what it stands for: the figure `largest` of operations that
    /// have one, of others the deviation. `None` if that is not measured or there is no result.
    pub fn largest(&self) -> Option<f64> {
        let largest = match self.figure("largest") {
            Some(Value::Real(length)) => Some(length),
            _ => self.moved(),
        };
        largest.filter(|_| self.useful)
    }

    /// Count the proved curvature extrema of the result, in all curves that are made or changed. `None` if there is
    /// no result, or until they are proved.
    pub fn extrema(&self) -> Option<usize> {
        let features = self.features.as_ref().filter(|_| self.useful)?;
        Some(features.after.iter().map(|it| it.curvature_extrema).sum())
    }

    /// Find the first level in which an approximation has another shape than what it follows.
    pub fn differing_level(&self) -> Option<&LevelComparison> {
        let mut levels = self.equivalence.iter().flatten();
        levels.find(|level| !level.is_equal())
    }

    /// Tell at once what an operation did, without features.
    pub fn new(operation: &Operation, input: &Operands, outcome: &Outcome) -> Self {
        Self {
            name: operation.name,
            label: operation.label,
            reached: outcome.reached,
            useful: outcome.is_useful(),
            residual: outcome.residual,
            rounding: input
                .polygon()
                .map_or(0.0, |polygon| ROUNDING * polygon.size()),
            deviation: outcome.deviation,
            largest_move: largest_move(input, outcome),
            figures: outcome.figures.clone(),
            equivalence: outcome.equivalence.clone(),
            warnings: outcome.warnings.clone(),
            remarks: outcome.remarks.clone(),
            features: None,
        }
    }

    /// Tell what an operation did, features included; `None` if `progress` is cancelled while
    /// they are proved.
    pub fn of(
        operation: &Operation,
        input: &Operands,
        outcome: &Outcome,
        progress: &Progress,
    ) -> Option<Self> {
        let features = FeatureComparison::prove(input, outcome, progress)?;
        let mut report = Self::new(operation, input, outcome);
        report.warnings.extend(features.remarks_on_more());
        report.features = Some(features);
        Some(report)
    }
}

impl Outcome {
    /// The document afterwards; as it was if an edit cannot be made, which [`Operation::run`] has
    /// ruled out.
    pub(super) fn after(&self, input: &Operands) -> Document {
        let document = input.document();
        self.applied_to(document)
            .unwrap_or_else(|_| document.clone())
    }
}

/// Find the vertex that moves farthest, of all curves that an operation changes and that keep the
/// number of their vertices; of equal moves the first counts.
fn largest_move(input: &Operands, outcome: &Outcome) -> Option<LargestMove> {
    if outcome.renumbered {
        return None;
    }
    let after = outcome.after(input);
    let mut largest: Option<LargestMove> = None;
    for (id, before) in input.document().curves() {
        let Some(after) = after.curve(id).filter(|after| !Arc::ptr_eq(before, after)) else {
            continue;
        };
        let [before, after] = [before, after].map(|curve| curve.polygon.vertices());
        if before.len() != after.len() {
            continue;
        }
        for (vertex, (a, b)) in before.iter().zip(after).enumerate() {
            let distance = length(*b - *a);
            if largest.is_none_or(|largest| distance > largest.distance) {
                largest = Some(LargestMove { distance, vertex });
            }
        }
    }
    largest
}

/// The length of a vector, also where its square is beyond the range of numbers.
fn length(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    if largest > 0.0 {
        largest * (vector / largest).length()
    } else {
        0.0
    }
}
