//! What matches do to curves: to those that are matched anew, and to those that follow others.

use crate::document::{CurveId, Document, Edit, quoted};
use crate::editor::same_shape::feature_change;
use crate::geometry::distance::SideDeviation;
use crate::geometry::{FloatPolygon, Progress, largest_curvature, rounded_up, significant};

/// A curve that moves by less than this share of its size moves by rounding.
const STILL: f64 = 1e-9;

/// A smallest radius that becomes so many times smaller is told.
const SHARPER: f64 = 1.25;

/// Curves with more segments are not compared: to prove their features would stop the hand.
const COMPARED: usize = 400;

/// The curves that edits match with others.
pub(super) fn newly_matched(edits: &[Edit]) -> Vec<CurveId> {
    let matched = edits.iter().filter_map(|edit| match edit {
        Edit::SetMatch(matched) => Some(matched.curve),
        _ => None,
    });
    matched.collect()
}

/// Say what new matches do to their curves, a line each, and whether that is more than a move.
pub(super) fn matched(curves: &[CurveId], documents: [&Document; 2]) -> (String, bool) {
    let mut bends = false;
    let told = curves.iter().filter_map(|id| {
        let [before, after] = polygons(*id, documents)?;
        let moved = moved(before, after).filter(|_| !stays(before, after))?;
        let name = quoted(documents[1].name(*id)?);
        let changes = changes(before, after);
        let advice = match changes.is_empty() {
            true => "",
            false => ": match up to less, or refine first",
        };
        bends |= !changes.is_empty();
        let mut told = vec![format!("The match moves {name} by up to {moved}")];
        told.extend(changes);
        if !are_compared(before, after) {
            told.push("features not compared".to_owned());
        }
        Some(told.join("; ") + advice)
    });
    let told = told.collect::<Vec<_>>().join("\n");
    (told, bends)
}

/// Say which curves follow others in a step and change their features or bends, a line each.
pub(super) fn followers(documents: [&Document; 2], matched: &[CurveId]) -> String {
    let [before, after] = documents;
    let has_changed = |id: CurveId| {
        before.curve(id) != after.curve(id) || before.reference(id) != after.reference(id)
    };
    let following = after.curves().filter(|(id, _)| {
        let mut own = after.matches().filter(|it| it.curve == *id);
        !matched.contains(id) && own.any(|it| has_changed(it.source))
    });
    let told = following.filter_map(|(id, curve)| {
        let [before, after] = polygons(id, documents)?;
        let changes = match stays(before, after) {
            true => Vec::new(),
            false => changes(before, after),
        };
        (!changes.is_empty())
            .then(|| format!("{} follows: {}", quoted(&curve.name), changes.join("; ")))
    });
    told.collect::<Vec<_>>().join("\n")
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
fn changes(before: &FloatPolygon, after: &FloatPolygon) -> Vec<String> {
    let features = are_compared(before, after)
        .then(|| feature_change(before, after))
        .flatten();
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
    features.into_iter().chain(radii).chain(leaves).collect()
}
