//! What an export writes, and what it would lose, worked out before the user starts it.

use super::Client;
use crate::document::{CurveId, Document};
use crate::editor::reply::Refusal;
use crate::geometry::Progress;
use crate::io::{Export, ExportChoice, LossReport};
use crate::operations::{lowered, told_of_lowered};

/// What an export would write and lose.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportForecast {
    /// How many curves and references are written, without those that are left out.
    pub counts: [usize; 2],
    /// The size of the file in bytes.
    pub bytes: usize,
    /// What becomes of curves of other degrees, and what the format cannot hold: a line each.
    pub losses: Vec<String>,
    /// What changes by rounding alone: a line each.
    pub rounding: Vec<String>,
}

/// A request to foresee an export.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::editor) struct ExportRequest {
    pub choice: ExportChoice,
    pub selected: Vec<CurveId>,
    /// The revision and the opening of the document.
    pub state: [u64; 2],
}

/// Foresees exports beside the frame.
pub(in crate::editor) type Forecasting = Client<ExportRequest, Result<ExportForecast, Refusal>>;

/// What is written of a document, with what is told of it.
pub(super) struct Exported {
    pub(super) export: Export,
    pub(super) counts: [usize; 2],
    /// What becomes of curves of other degrees.
    pub(super) told: Vec<String>,
    /// What changes by rounding alone.
    pub(super) rounding: LossReport,
}

/// Write what is chosen of a document.
///
/// # Errors
/// [`Refusal`] if nothing is chosen, or it cannot be written so.
pub(super) fn exported(
    choice: &ExportChoice,
    document: &Document,
    selected: &[CurveId],
    progress: &Progress,
) -> Result<Exported, Refusal> {
    let refused = |error: &dyn std::fmt::Display| Refusal(error.to_string());
    let chosen = choice
        .chosen(document, selected)
        .map_err(|it| refused(&it))?;
    let all = [chosen.curves().count(), chosen.references().count()];
    let (lower, told) = match choice.most_degree {
        None => (chosen, Vec::new()),
        Some(most) => {
            let lower = lowered(&chosen, most, choice.tolerance, progress);
            let (lower, told) = lower.map_err(|it| refused(&it))?;
            (lower, told_of_lowered(&told))
        }
    };
    let mut export = choice.write(&lower).map_err(|it| refused(&it))?;
    export.losses.add_matches(document, |curve| {
        chosen_names(&lower).any(|name| name == curve.name)
    });
    let rounding = export.losses.take_rounding(&lower);
    let left_out = export.losses.left_out();
    let counts = [0, 1].map(|kind| all[kind] - left_out[kind].min(all[kind]));
    Ok(Exported {
        export,
        counts,
        told,
        rounding,
    })
}

fn chosen_names(document: &Document) -> impl Iterator<Item = &str> {
    document.curves().map(|(_, curve)| curve.name.as_str())
}

impl ExportRequest {
    /// Work out what a document loses so; `None` if `progress` is cancelled.
    pub(super) fn forecast(
        &self,
        document: &Document,
        progress: &Progress,
    ) -> Option<Result<ExportForecast, Refusal>> {
        let exported = exported(&self.choice, document, &self.selected, progress);
        if progress.is_cancelled() {
            return None;
        }
        Some(exported.map(|it| {
            let [losses, rounding] = [&it.export.losses, &it.rounding].map(|it| it.to_string());
            let losses = losses.lines().map(str::to_owned);
            ExportForecast {
                counts: it.counts,
                bytes: it.export.bytes.len(),
                losses: it.told.into_iter().chain(losses).collect(),
                rounding: rounding.lines().map(str::to_owned).collect(),
            }
        }))
    }
}
