//! What a click with *Pick from curve* takes of another curve.

use glam::DVec2;

use super::end_fit_subject::Subject;
use super::tool::{Context, named_snap};
use crate::document::{CurveId, Document, EndMatch, MatchPlace};
use crate::editor::hand::end_fit::{nearest_other_end, other_ends};
use crate::editor::view::scene::Mark;
use crate::geometry::{Continuity, figure};

/// A place of another curve that is picked.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndPick {
    /// How the end is matched to it.
    pub(super) matched: EndMatch,
}

impl EndPick {
    /// Find what a click at a place on the canvas picks: an end that is near, or the point that is hit. Curves come
    /// before lists of points.
    pub(super) fn at(place: DVec2, subject: &Subject, context: &Context) -> Option<Self> {
        let document = context.document;
        let found = [false, true].into_iter().find_map(|takes_points| {
            let takes = |id| takes_points == is_points(id, document) && id != subject.id;
            let own = (subject.id, subject.end);
            let end =
                nearest_other_end(document, own, context.model(place), context.viewport, takes);
            end.or_else(|| on_curve(place, subject, takes, context))
        });
        let continuity = context.settings.end_fit.continuity;
        let matched = EndMatch {
            continuity,
            ..found?
        };
        Some(Self { matched })
    }

    /// Refuse what has no answer: a point has no direction.
    ///
    /// # Errors
    /// The reason.
    pub(super) fn check(&self, document: &Document) -> Result<(), String> {
        let is_too_much = self.matched.continuity > Continuity::G0;
        match is_too_much && is_points(self.matched.source, document) {
            true => Err("Points have no direction: pick them with G0".to_owned()),
            false => Ok(()),
        }
    }

    /// Name the curve and what is taken of it, at the place.
    pub(super) fn marks(&self, context: &Context) -> Vec<Mark> {
        let document = context.document;
        let Some(target) = self.matched.target(document) else {
            return Vec::new();
        };
        let name = document.name(self.matched.source).unwrap_or_default();
        let place = match self.matched.place {
            MatchPlace::End(end) => end.name().to_owned(),
            MatchPlace::Parameter(u) => format!("u {}", figure(u)),
        };
        let levels = Continuity::ALL.into_iter();
        let taken = levels.filter(|level| *level <= self.matched.continuity);
        let taken: Vec<&str> = taken.map(Continuity::label).collect();
        let taken = self.check(document).err().unwrap_or(taken.join(", "));
        let at = context.viewport.flatten(target.point);
        named_snap(at, format!("{name}, {place}: {taken}")).into()
    }
}

/// Mark the ends that can be picked, and name what a click would take.
pub(super) fn pick_marks(subject: Option<&Subject>, context: &Context) -> Vec<Mark> {
    let own = context.selection.active();
    let ends = other_ends(context.document, own);
    let ends = ends.map(|(_, _, jet)| Mark::Snap(context.viewport.flatten(jet.point)));
    let picked = subject
        .zip(context.place())
        .and_then(|(subject, place)| EndPick::at(place, subject, context));
    let named = picked.into_iter().flat_map(|picked| picked.marks(context));
    ends.chain(named).collect()
}

/// The point of another curve under a place, passed in the sense that turns the end less.
fn on_curve(
    place: DVec2,
    subject: &Subject,
    takes: impl Fn(CurveId) -> bool,
    context: &Context,
) -> Option<EndMatch> {
    let at = context.model(place);
    let passes = context.hits.passes(place, takes).into_iter();
    let hit = passes.min_by(|a, b| a.point.distance(at).total_cmp(&b.point.distance(at)))?;
    let place = MatchPlace::Parameter(hit.u);
    let along = place.jet(context.document.shape(hit.curve)?)?.first;
    let own = subject.curve.polygon.end_jet(subject.end).first;
    Some(EndMatch {
        curve: subject.id,
        end: subject.end,
        source: hit.curve,
        place,
        continuity: Continuity::default(),
        reversed: own.dot(along) < 0.0,
    })
}

/// Whether an item is a list of points.
fn is_points(id: CurveId, document: &Document) -> bool {
    document
        .reference(id)
        .is_some_and(|reference| reference.points().is_some())
}
