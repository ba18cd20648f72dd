//! Matches: which ends follow other curves, and how they are brought there.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use glam::DVec3;

use super::curve::{Curve, CurveId};
use super::document::Document;
use super::end_match::EndMatch;
use super::error::EditError;
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::fairing::joint_correction::{
    Corrector, Disturbance, correct_hastily, correct_jointly,
};
use crate::geometry::fairing::kept_jets::with_kept_jets;
use crate::geometry::fairing::near_end::{correct_near_end, has_ends_apart};
use crate::geometry::references::Placement;
use crate::geometry::{Continuity, End, FloatPolygon, Progress};

/// The largest difference that counts as rounding, in units of the end's size.
const ROUNDING: f64 = 1e-12;

/// What may be left of a match that counts as met, in units of the end's size.
const MET: f64 = 1e-9;

impl EndMatch {
    /// The target that the match sets now; `None` if one of the curves is gone or does not have the place.
    pub fn target(&self, document: &Document) -> Option<EndTarget> {
        let curve = &document.curve(self.curve)?.polygon;
        let source = document.shape(self.source)?;
        if curve.is_periodic() {
            return None;
        }
        let planar = curve.is_planar() && source.is_planar();
        let target = self.continuity.target(&self.place.jet(source)?, planar);
        Some(if self.reversed {
            target.turned(planar)
        } else {
            target
        })
    }
}

impl Document {
    /// List the matches.
    pub fn matches(&self) -> impl ExactSizeIterator<Item = &EndMatch> {
        self.matches.iter()
    }

    /// The match of an end, if it has one.
    pub fn match_of(&self, curve: CurveId, end: End) -> Option<&EndMatch> {
        let mut matches = self.matches.iter();
        matches.find(|matched| (matched.curve, matched.end) == (curve, end))
    }

    /// Refuse if an end is matched: the match sets its target.
    ///
    /// # Errors
    /// [`EditError::MatchedEnd`], or [`EditError::NoSuchCurve`].
    pub fn check_unmatched(&self, curve: CurveId, end: End) -> Result<(), EditError> {
        let found = self.curve(curve).ok_or(EditError::NoSuchCurve)?;
        let Some(matched) = self.match_of(curve, end) else {
            return Ok(());
        };
        let source = self.name(matched.source);
        Err(EditError::MatchedEnd {
            name: found.name.clone(),
            end: end.name(),
            source_name: source.map_or_else(String::new, str::to_owned),
        })
    }

    /// Whether a match is met, but for rounding.
    pub fn meets(&self, matched: &EndMatch) -> bool {
        let curve = self.curve(matched.curve).zip(matched.target(self));
        curve.is_some_and(|(curve, target)| is_met(&curve.polygon, matched.end, &target, MET))
    }

    /// List the matches of an earlier state that are gone though their curve is not, because the
    /// place that they follow is no more.
    pub fn dissolved_since<'a>(
        &'a self,
        before: &'a Self,
    ) -> impl Iterator<Item = (&'a EndMatch, &'a Curve)> {
        let gone = before.matches().filter(|matched| {
            self.match_of(matched.curve, matched.end).is_none() && matched.target(self).is_none()
        });
        gone.filter_map(|matched| Some((matched, self.curve(matched.curve)?.as_ref())))
    }

    /// Add matches, as a file holds them; the curves stay as they are.
    ///
    /// # Errors
    /// [`EditError`] if a curve or place is not there, or curves would follow each other in a
    /// circle.
    pub fn with_matches(
        mut self,
        matches: impl IntoIterator<Item = EndMatch>,
    ) -> Result<Self, EditError> {
        let mut matches = matches.into_iter();
        matches.try_for_each(|matched| self.set_match(matched))?;
        Ok(self)
    }

    pub(super) fn set_match(&mut self, matched: EndMatch) -> Result<(), EditError> {
        let curve = self.curve(matched.curve).ok_or(EditError::NoSuchCurve)?;
        let source_name = self.name(matched.source).ok_or(EditError::NoSuchCurve)?;
        let source_name = || source_name.to_owned();
        if matched.curve == matched.source {
            let name = curve.name.clone();
            return Err(EditError::MatchToItself { name });
        }
        if curve.symmetry.is_some() && self.match_of(matched.curve, matched.end.other()).is_some() {
            let name = curve.name.clone();
            return Err(EditError::SymmetricEnds { name });
        }
        if self.follows(matched.source, matched.curve) {
            return Err(EditError::MatchCycle {
                name: curve.name.clone(),
                source_name: source_name(),
            });
        }
        if matched.target(self).is_none() {
            return Err(EditError::NoMatch {
                name: curve.name.clone(),
                source_name: source_name(),
            });
        }
        self.remove_match(matched.curve, matched.end);
        self.matches.push(matched);
        Ok(())
    }

    pub(super) fn remove_match(&mut self, curve: CurveId, end: End) {
        let is_other = |matched: &EndMatch| (matched.curve, matched.end) != (curve, end);
        self.matches.retain(is_other);
    }

    /// Whether a curve is another one, or follows it directly or by others.
    fn follows(&self, curve: CurveId, other: CurveId) -> bool {
        let mut sources: HashMap<CurveId, Vec<CurveId>> = HashMap::new();
        for matched in self.matches() {
            let own = sources.entry(matched.curve).or_default();
            own.push(matched.source);
        }
        let mut open = vec![curve];
        while let Some(curve) = open.pop() {
            if curve == other {
                return true;
            }
            // Once is enough, if several follow it.
            open.extend(sources.remove(&curve).into_iter().flatten());
        }
        false
    }

    fn sources_of(&self, curve: CurveId) -> impl Iterator<Item = CurveId> + '_ {
        let own = self.matches().filter(move |matched| matched.curve == curve);
        own.map(|matched| matched.source)
    }

    /// The curves with a match that could be met, and is not.
    pub(super) fn unmet(&self) -> BTreeSet<CurveId> {
        let is_free = |id| {
            let curve = self.curve(id);
            curve.is_some_and(|curve| curve.check_editable().is_ok())
        };
        let unmet = self.matches().filter(|matched| !self.meets(matched));
        let curves = unmet.map(|matched| matched.curve);
        curves.filter(|curve| is_free(*curve)).collect()
    }

    /// Let matched ends follow what has changed: the other end of a curve keeps its point and
    /// direction, and locked vertices stay. Locked and hidden curves follow once they no longer are.
    /// Vertices of its own that the step has moved stay too, where the others can keep what the ends had.
    /// Where a match cannot be met the curve stays as it is, and its target tells what is missing; for the
    /// curves in `hasty` that is not tried long.
    pub(super) fn follow(&mut self, before: &Self, hasty: &BTreeSet<CurveId>) {
        let possible = |matched: &EndMatch| matched.target(self).is_some();
        let kept: Vec<EndMatch> = self.matches().filter(|it| possible(it)).copied().collect();
        self.matches = kept;
        for curve in self.followers() {
            let is_reshaped = |source| !self.has_same_shape(source, before);
            let changed =
                self.sources_of(curve).any(is_reshaped) || !self.is_as_correctable(curve, before);
            let [now, then] = [&*self, before].map(|document| {
                let own = document.matches().filter(|matched| matched.curve == curve);
                own.collect::<Vec<_>>()
            });
            if changed || now != then {
                let correct = if hasty.contains(&curve) {
                    correct_hastily
                } else {
                    correct_jointly
                };
                self.carry(curve, before);
                let before = before.curve(curve).map(|curve| &curve.polygon);
                self.correct(curve, before, correct);
            }
        }
    }

    /// The curves that follow others, each after those that it follows.
    fn followers(&self) -> Vec<CurveId> {
        let mut waiting: Vec<CurveId> = self.matches().map(|matched| matched.curve).collect();
        waiting.sort_unstable();
        waiting.dedup();
        let mut ordered = Vec::with_capacity(waiting.len());
        // There are no circles, so that each round finds at least one.
        while !waiting.is_empty() {
            let free = |id: &CurveId| !self.sources_of(*id).any(|source| waiting.contains(&source));
            let (ready, rest): (Vec<_>, Vec<_>) = waiting.iter().partition(|id| free(id));
            if ready.is_empty() {
                break;
            }
            ordered.extend(ready);
            waiting = rest;
        }
        ordered
    }

    /// Whether a curve or a reference has the shape that it had; its name, colour and visibility do not count.
    fn has_same_shape(&self, id: CurveId, before: &Self) -> bool {
        let curves = self.curve(id).zip(before.curve(id));
        let references = self.reference(id).zip(before.reference(id));
        curves.is_some_and(|(now, then)| Arc::ptr_eq(now, then) || now.polygon == then.polygon)
            || references
                .is_some_and(|(now, then)| Arc::ptr_eq(now, then) || now.curve == then.curve)
    }

    /// Whether a curve has all that a correction of its ends depends on as it was: shape, targets and locks.
    fn is_as_correctable(&self, id: CurveId, before: &Self) -> bool {
        let corrected = |curve: &Curve| {
            let locks = (curve.visible, curve.locked, curve.locked_vertices.clone());
            (curve.targets, locks)
        };
        let curves = self.curve(id).zip(before.curve(id));
        self.has_same_shape(id, before)
            && curves.is_some_and(|(now, then)| corrected(now) == corrected(then))
    }

    /// Move a curve along as a whole if both its ends follow what moved so, and nothing else changed.
    fn carry(&mut self, id: CurveId, before: &Self) {
        let carried = self.carried(id, before);
        if let Some((index, polygon)) = self.position(id).zip(carried) {
            let curve = Curve {
                polygon,
                ..Curve::clone(&self.curves[index].1)
            };
            self.curves[index].1 = Arc::new(curve);
        }
    }

    /// The polygon of a curve moved along with the sources of both its ends; `None` if they do not move alike.
    fn carried(&self, id: CurveId, before: &Self) -> Option<FloatPolygon> {
        let curve = self.curve(id)?;
        let is_free = curve.visible && !curve.locked && curve.symmetry.is_none();
        if !is_free || !curve.locked_vertices.is_empty() || !self.is_as_correctable(id, before) {
            return None;
        }
        let motion = |end: End| {
            let matched = self.match_of(id, end)?;
            if before.match_of(id, end) != Some(matched) {
                return None;
            }
            let [now, then] = [self, before].map(|it| it.shape(matched.source));
            Placement::between(then?, now?)
        };
        let [start, finish] = [motion(End::Start)?, motion(End::Finish)?];
        let size = curve.polygon.size();
        let vertices = curve.polygon.vertices().iter();
        let images: Vec<DVec3> = vertices
            .clone()
            .map(|vertex| start.point(*vertex))
            .collect();
        let is_alike = |(vertex, image): (&DVec3, &DVec3)| {
            finish.point(*vertex).distance(*image) <= MET * size
        };
        if !vertices.zip(&images).all(is_alike) {
            return None;
        }
        let mut polygon = curve.polygon.clone();
        polygon.move_vertices(images.into_iter().enumerate()).ok()?;
        Some(polygon)
    }

    /// Give the matched ends of a curve their targets, and bring them there.
    fn correct(&mut self, id: CurveId, before: Option<&FloatPolygon>, correct: Corrector) {
        let Some(curve) = self.curve(id).filter(|curve| curve.visible) else {
            return;
        };
        let mut corrected = Curve::clone(curve);
        let mut matched = Vec::new();
        for end in End::BOTH {
            let target = self.match_of(id, end).and_then(|it| it.target(self));
            if let Some(target) = target {
                corrected.targets.set(end, Some(target));
                corrected.mirror_target(end);
                matched.push((end, target));
            }
        }
        if !curve.locked
            && let Some(polygon) = met(curve, &matched, before, correct)
            && let Some(polygon) = symmetric(curve, polygon, &matched)
        {
            corrected.polygon = polygon;
        }
        if corrected != **curve
            && let Some(index) = self.position(id)
        {
            self.curves[index].1 = Arc::new(corrected);
        }
    }
}

/// Whether an end has what its match asks for, as far as `tolerance`, in units of the end's size.
fn is_met(polygon: &FloatPolygon, end: End, target: &EndTarget, tolerance: f64) -> bool {
    let size = polygon.end_size(end);
    EndDifference::between(polygon, end, target).residual(size) <= tolerance * size
}

/// The polygon whose ends meet their targets; `None` if they do already, or cannot.
fn met(
    curve: &Curve,
    matched: &[(End, EndTarget)],
    before: Option<&FloatPolygon>,
    correct: Corrector,
) -> Option<FloatPolygon> {
    let polygon = &curve.polygon;
    let is_missing = |(end, target): &(End, EndTarget)| !is_met(polygon, *end, target, ROUNDING);
    if !matched.iter().any(is_missing) {
        return None;
    }
    let locked: Vec<usize> = curve.locked_vertices.iter().collect();
    // Where a vertex of its own is dragged, the others stay as they are as far as they can.
    let is_dragged = before.is_some_and(|before| before != polygon && meet(before, matched));
    let least = match is_dragged {
        true => Disturbance::Differences(0),
        false => Disturbance::Turned(1),
    };
    let corrected = || {
        if has_ends_apart(polygon) {
            let mut ends = matched.iter();
            let one = |polygon: FloatPolygon, (end, target): &(End, EndTarget)| {
                correct_near_end(&polygon, (*end, target), least, &locked, correct).ok()
            };
            return ends.try_fold(polygon.clone(), one);
        }
        let targets = with_kept_ends(polygon, matched);
        let corrected = correct(polygon, &targets, least, &locked, &Progress::default());
        corrected.ok().map(|corrected| corrected.polygon)
    };
    let kept = before.and_then(|before| with_kept_matches(polygon, before, matched, &locked));
    let corrected = kept.or_else(corrected)?;
    curve.check_held(&corrected).ok()?;
    Some(corrected)
}

/// The corrected polygon of a symmetric curve, its matched end leading; `None` if that no longer meets its matches.
fn symmetric(
    curve: &Curve,
    polygon: FloatPolygon,
    matched: &[(End, EndTarget)],
) -> Option<FloatPolygon> {
    if curve.symmetry.is_none() {
        return Some(polygon);
    }
    let (end, _) = matched.first()?;
    let polygon = curve.led_by(polygon, *end).ok()?;
    curve.check_held(&polygon).ok()?;
    let meets = |(end, target): &(End, EndTarget)| is_met(&polygon, *end, target, MET);
    matched.iter().all(meets).then_some(polygon)
}

/// The polygon whose ends are as they were before some of its vertices moved, if they met their targets then.
fn with_kept_matches(
    polygon: &FloatPolygon,
    before: &FloatPolygon,
    matched: &[(End, EndTarget)],
    locked: &[usize],
) -> Option<FloatPolygon> {
    let levels = matched.iter().map(|(end, target)| (*end, level(target)));
    let levels: Vec<_> = levels.collect();
    Some(before)
        .filter(|before| meet(before, matched))
        .and_then(|before| with_kept_jets(polygon, before, &levels, locked))
        .filter(|kept| meet(kept, matched))
}

/// Whether all matched ends of a polygon meet their targets.
fn meet(polygon: &FloatPolygon, matched: &[(End, EndTarget)]) -> bool {
    let mut ends = matched.iter();
    ends.all(|(end, target)| is_met(polygon, *end, target, MET))
}

/// The level of continuity that a target asks for.
fn level(target: &EndTarget) -> Continuity {
    match target {
        EndTarget { slope: Some(_), .. } => Continuity::G3,
        EndTarget {
            curvature: Some(_), ..
        } => Continuity::G2,
        EndTarget {
            direction: Some(_), ..
        } => Continuity::G1,
        _ => Continuity::G0,
    }
}

/// The targets of both ends: an end that is not matched keeps its point and direction.
fn with_kept_ends(polygon: &FloatPolygon, matched: &[(End, EndTarget)]) -> Vec<(End, EndTarget)> {
    let kept = |end: End| Continuity::G1.target(&polygon.end_jet(end), polygon.is_planar());
    let target = |end: End| {
        let own = matched.iter().find(|(other, _)| *other == end);
        (end, own.map_or_else(|| kept(end), |(_, target)| *target))
    };
    End::BOTH.map(target).to_vec()
}
