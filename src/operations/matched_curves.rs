//! What matches do to curves: to those that are matched anew, and to those that follow others.

use super::end_change::refine_first;
use super::feature_change::{changed_features, feature_counts};
use super::outcome::{Deviation, Outcome};
use crate::document::{CurveId, Document, Edit, quoted};
use crate::geometry::distance::SideDeviation;
use crate::geometry::{FloatPolygon, Progress, largest_curvature, rounded_up, significant};

/// A curve that moves by less than this share of its size moves by rounding.
const STILL: f64 = 1e-9;

/// A correction by less than this share of a curve's size leaves an exact result exact.
const ROUNDING: f64 = 1e-12;

/// A smallest radius that becomes so many times smaller is told.
const SHARPER: f64 = 1.25;

/// Curves with more segments are not compared: to prove their features would stop the hand.
const COMPARED: usize = 400;

/// The curves that edits match with others.
pub fn newly_matched(edits: &[Edit]) -> Vec<CurveId> {
    let matched = edits.iter().filter_map(|edit| match edit {
        Edit::SetMatch(matched) => Some(matched.curve),
        _ => None,
    });
    matched.collect()
}

/// Say what new matches do to their curves, a line each, and whether that is more than a move.
pub fn matched(curves: &[CurveId], documents: [&Document; 2]) -> (String, bool) {
    let mut bends = false;
    let told = curves.iter().filter_map(|id| {
        let [before, after] = polygons(*id, documents)?;
        let moved = moved(before, after).filter(|_| !stays(before, after))?;
        let name = quoted(documents[1].name(*id)?);
        let Changes {
            told: changed,
            bends: is_bent,
        } = changes(before, after);
        let advice = match is_bent {
            false => String::new(),
            true => format!(": match up to less, or {}", refine_first(before)),
        };
        bends |= is_bent;
        let mut told = vec![format!("The match moves {name} by up to {moved}")];
        told.extend(changed);
        if !are_compared(before, after) {
            told.push("features not compared".to_owned());
        }
        Some(told.join("; ") + &advice)
    });
    let told = told.collect::<Vec<_>>().join("\n");
    (told, bends)
}

/// A curve that follows others in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Follower {
    /// Its name, and what becomes of it.
    pub text: String,
    /// Whether it does more than move: its features change, it bends more sharply, or it leaves its plane.
    pub bends: bool,
}

/// Find the curves that follow others in a step and move by it, but for those that are matched anew.
pub fn followers(documents: [&Document; 2], matched: &[CurveId]) -> Vec<Follower> {
    let [before, after] = documents;
    let has_changed = |id: CurveId| {
        before.curve(id) != after.curve(id) || before.reference(id) != after.reference(id)
    };
    let following = after.curves().filter(|(id, _)| {
        let mut own = after.matches().filter(|it| it.curve == *id);
        !matched.contains(id) && own.any(|it| has_changed(it.source))
    });
    let found = following.filter_map(|(id, curve)| {
        let [before, after] = polygons(id, documents)?;
        if stays(before, after) {
            return None;
        }
        let moved = moved(before, after)?;
        let Changes { told, bends } = changes(before, after);
        let name = quoted(&curve.name);
        let parts = std::iter::once(format!("{name} follows, by up to {moved}"));
        let parts: Vec<String> = parts.chain(told).collect();
        Some(Follower {
            text: parts.join("; "),
            bends,
        })
    });
    found.collect()
}

/// Say which followers do more than move, a line each.
pub fn told_of_bent(followers: &[Follower]) -> String {
    let bent = followers.iter().filter(|it| it.bends);
    let lines: Vec<&str> = bent.map(|it| it.text.as_str()).collect();
    lines.join("\n")
}

/// Tell what some edits make of matches and of curves that follow others: which matches are gone or no longer met,
/// how far a curve that they change was corrected afterwards so that it meets its match, and which others follow. That
/// a curve bends or gets other features so is a warning.
pub(super) fn tell(outcome: &mut Outcome, before: &Document, after: &Document) {
    outcome.remarks.extend(lost(before, after));
    let asymmetric = after.asymmetric_since(before);
    let asymmetric = asymmetric.map(|it| format!("{} does not stay symmetric", quoted(&it.name)));
    outcome.remarks.extend(asymmetric);
    let changed: Vec<(CurveId, FloatPolygon)> = outcome.edits.iter().filter_map(changed).collect();
    let mut largest = Some(0.0_f64);
    for (id, polygon) in &changed {
        let Some(now) = after.curve(*id) else {
            continue;
        };
        let by = polygon.deviation(&now.polygon).ok();
        if by.is_some_and(|by| by <= ROUNDING * polygon.size()) {
            continue;
        }
        largest = largest.zip(by).map(|(largest, by)| largest.max(by));
        let moved = moved(polygon, &now.polygon);
        let by = moved.map_or_else(String::new, |moved| format!(", and moved by up to {moved}"));
        let name = quoted(&now.name);
        let is_matched = after.matches().any(|it| it.curve == *id);
        let so_that = match now.symmetry {
            Some(_) if !is_matched => "it stays symmetric",
            _ => "it meets its match",
        };
        let text = format!("{name} was corrected afterwards{by}, so that {so_that}");
        outcome.remarks.push(text);
    }
    outcome.deviation = match largest {
        Some(0.0) => outcome.deviation,
        Some(by) => outcome.deviation.plus(by),
        None => Deviation::Unmeasured,
    };
    let changed: Vec<CurveId> = changed.iter().map(|(id, _)| *id).collect();
    for follower in followers([before, after], &changed) {
        match follower.bends {
            true => outcome.warnings.push(follower.text),
            false => outcome.remarks.push(follower.text),
        }
    }
}

/// The polygon that an edit gives a curve.
fn changed(edit: &Edit) -> Option<(CurveId, FloatPolygon)> {
    match edit {
        Edit::SetPolygon { curve, polygon } | Edit::Renumber { curve, polygon, .. } => {
            Some((*curve, polygon.clone()))
        }
        _ => None,
    }
}

/// Say which matches are gone, and which are no longer met.
fn lost(before: &Document, after: &Document) -> Vec<String> {
    let said = before.matches().filter_map(|matched| {
        let name = quoted(&after.curve(matched.curve)?.name);
        let end = matched.end.name();
        // A curve that is reversed follows with its other end.
        let other = matched.end.other();
        let is_turned = before.match_of(matched.curve, other).is_none()
            && after.match_of(matched.curve, other).is_some();
        match after.match_of(matched.curve, matched.end) {
            None if is_turned => None,
            None => Some(format!("The {end} of {name} is no longer matched")),
            Some(now) if before.meets(matched) && !after.meets(now) => {
                Some(format!("The {end} of {name} does not meet its match now"))
            }
            Some(_) => None,
        }
    });
    said.collect()
}

/// A curve's polygons before and after a step, if it has both.
fn polygons(id: CurveId, documents: [&Document; 2]) -> Option<[&FloatPolygon; 2]> {
    let [before, after] = documents.map(|document| document.curve(id));
    Some([&before?.polygon, &after?.polygon])
}

/// Whether two curves are short enough to be compared at once.
fn are_compared(before: &FloatPolygon, after: &FloatPolygon) -> bool {
    before.segments().max(after.segments()) <= COMPARED
}

/// Whether a curve moves by rounding alone.
fn stays(before: &FloatPolygon, after: &FloatPolygon) -> bool {
    before
        .deviation(after)
        .is_ok_and(|moved| moved <= STILL * before.size())
}

/// How far a curve moves, as text: the distance between both curves, as points that slide along them do not count. Of
/// curves with more segments than are compared a bound, which takes no time.
fn moved(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let measured = are_compared(before, after).then(|| {
        let progress = Progress::default();
        SideDeviation::both_ways([before, after], &progress).ok()
    });
    let bound = || before.deviation(after).ok();
    measured.flatten().or_else(bound).map(rounded_up)
}

/// What of a curve's character changes: its features, its smallest radius, whether it is planar.
struct Changes {
    told: Vec<String>,
    /// Whether it gets more features, bends more sharply, or leaves its plane: fewer features are a gain.
    bends: bool,
}

fn changes(before: &FloatPolygon, after: &FloatPolygon) -> Changes {
    let features = are_compared(before, after).then(|| [before, after].map(feature_counts));
    let adds = features.is_some_and(|[before, now]| (0..2).any(|kind| now[kind] > before[kind]));
    let features = features.and_then(changed_features);
    let radii = [before, after].map(|polygon| {
        let whole = [0.0, polygon.segments() as f64];
        largest_curvature(polygon, whole).recip()
    });
    let [was, now] = radii;
    // A curve that is scaled as a whole bends as before.
    let shrinks = after.size() / before.size().max(f64::MIN_POSITIVE);
    let is_sharper = was * shrinks.min(1.0) > SHARPER * now;
    let radii = is_sharper.then(|| {
        let [was, now] = radii.map(|radius| match radius.is_finite() {
            true => significant(radius, 3),
            false => "∞".to_owned(),
        });
        format!("smallest radius {was} before, {now} now")
    });
    let leaves = before.is_planar() && !after.is_planar();
    let leaves = leaves.then(|| "it leaves its plane".to_owned());
    Changes {
        bends: adds || radii.is_some() || leaves.is_some(),
        told: features.into_iter().chain(radii).chain(leaves).collect(),
    }
}
