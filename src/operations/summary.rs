//! A report in words: one line for messages.

use super::features::FeatureCounts;
use super::outcome::Deviation;
use super::report::Report;
use crate::geometry::harmony::Match;
use crate::geometry::{counted, rounded_up, significant};

impl Report {
    /// Say in one line what the operation did: "Trim curve: the curve moves by at most 1.2e-3;
    /// curvature extrema: 2 before, 3 now".
    pub fn summary(&self) -> String {
        match self.details() {
            details if details.is_empty() => self.label.to_owned(),
            details => format!("{}: {details}", self.label),
        }
    }

    /// Say in one line what the operation did, without its name.
    pub fn details(&self) -> String {
        let mut parts = Vec::new();
        if !self.reached {
            parts.push(match self.useful {
                true => "not reached, this is the best found".to_owned(),
                false => "not reached, nothing is changed".to_owned(),
            });
        }
        if self.useful {
            match self.deviation {
                Deviation::Exact => parts.push("exact".to_owned()),
                Deviation::AtMost(bound) => {
                    parts.push(format!("the curve moves by at most {}", rounded_up(bound)));
                }
                Deviation::Measured(length) => {
                    let length = significant(length, 3);
                    parts.push(format!("off the true curve by {length} (sampled)"));
                }
                Deviation::FromPoints(length) => {
                    parts.push(format!("off the points by {}", significant(length, 3)));
                }
                Deviation::Unmeasured => {}
            }
        }
        if let Some(level) = self.differing_level() {
            parts.push(format!("another shape: {} differs", level.name()));
        }
        // What is reached is met within its tolerance.
        let missed = self.residual.filter(|it| *it > self.rounding);
        if let Some(residual) = missed.filter(|_| !self.reached) {
            parts.push(format!("missed by {}", significant(residual, 4)));
        }
        if let Some(features) = self.features.as_ref().filter(|_| self.useful) {
            let [before, after] = [&features.before, &features.after].map(|counts| extrema(counts));
            parts.push(match (before, after) {
                (Some(before), Some(after)) => {
                    format!("curvature extrema: {before} before, {after} now")
                }
                (None, Some(now)) => format!("curvature extrema: {now}"),
                (_, None) => "no curve is left".to_owned(),
            });
            parts.extend(changed_inflections(&features.before, &features.after));
            parts.extend(changed_harmony(&features.before, &features.after));
        }
        let parts = [parts.join("; ")]
            .into_iter()
            .filter(|parts| !parts.is_empty());
        let said = self.warnings.iter().chain(&self.remarks).cloned();
        let sentences: Vec<String> = parts.chain(said).collect();
        sentences.join(". ")
    }
}

/// Say how many inflections there are now, if they are not as many as before.
fn changed_inflections(before: &[FeatureCounts], after: &[FeatureCounts]) -> Option<String> {
    let sum = |curves: &[FeatureCounts]| curves.iter().map(|it| it.inflections).sum::<usize>();
    let said = |curves: &[FeatureCounts]| of_each(curves, |it| it.inflections.to_string());
    (sum(before) != sum(after)).then(|| match before {
        [] => format!("inflections: {}", said(after)),
        _ => format!("inflections: {} before, {} now", said(before), said(after)),
    })
}

/// Say what becomes of the harmony of one curve, if that changes.
fn changed_harmony(before: &[FeatureCounts], after: &[FeatureCounts]) -> Vec<String> {
    let ([before], [after]) = (before, after) else {
        return Vec::new();
    };
    let mut said = Vec::new();
    let [was, is] = [before, after].map(|counts| counts.harmony.curvature.verdict == Match::Agrees);
    match (was, is) {
        (true, false) => said.push("the discrete curvature no longer follows the curve".to_owned()),
        (false, true) => said.push("the discrete curvature follows the curve now".to_owned()),
        _ => {}
    }
    let [was, is] = [before, after].map(|counts| counts.harmony.regularity.order);
    if was != is {
        said.push(format!("regular to order: {was} before, {is} now"));
    }
    said
}

/// Say how many curvature extrema each curve has, if there is one.
fn extrema(counts: &[FeatureCounts]) -> Option<String> {
    let said = |counts: &FeatureCounts| {
        let proved = counts.curvature_extrema;
        match counts.undecided {
            0 => proved.to_string(),
            doubts => {
                let doubts = counted(doubts, "place", "places");
                format!("{proved} ({doubts} undecided)")
            }
        }
    };
    (!counts.is_empty()).then(|| of_each(counts, said))
}

fn of_each(counts: &[FeatureCounts], said: impl Fn(&FeatureCounts) -> String) -> String {
    let said: Vec<String> = counts.iter().map(said).collect();
    said.join(" and ")
}
