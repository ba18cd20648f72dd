//! Symmetric curves: what an edit does to one half, the other half follows.

use std::sync::Arc;

use glam::DVec3;

use super::curve::{Curve, EndTargets};
use super::document::Document;
use super::error::EditError;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, FloatPolygon, Symmetry};

/// A polygon with other numbers of vertices is symmetric still if no vertex is farther from the image of its partner
/// than this share of a leg: an approximation is, an insertion on one side is not.
const OF_LEG: f64 = 0.05;

/// Moves that differ by no more than this share of the coordinates are one.
const ROUNDING: f64 = 1e-14;

/// Fewer vertices are symmetric about many planes by chance.
const LEAST: usize = 4;

impl Curve {
    /// The vertices that move with one: itself first, then its images where the curve is symmetric.
    pub fn dependents(&self, vertex: usize) -> Vec<usize> {
        match self.symmetry {
            Some(symmetry) => symmetry.dependents(vertex, self.polygon.vertices().len()),
            None => vec![vertex],
        }
    }

    /// Add the images of moved vertices, where the curve is symmetric.
    pub fn with_images(&self, moves: &[(usize, DVec3)]) -> Vec<(usize, DVec3)> {
        match self.symmetry {
            Some(symmetry) => symmetry.with_images(moves, self.polygon.vertices().len()),
            None => moves.to_vec(),
        }
    }

    /// The polygon whose half at an end leads, where the curve is symmetric.
    ///
    /// # Errors
    /// [`EditError::Polygon`] if numbers overflow.
    pub fn led_by(&self, polygon: FloatPolygon, end: End) -> Result<FloatPolygon, EditError> {
        let Some(symmetry) = self.symmetry else {
            return Ok(polygon);
        };
        let parameter = match end {
            End::Start => 0.0,
            End::Finish => polygon.segments() as f64,
        };
        let completed = symmetry.completed_from(&polygon, parameter);
        completed.map_err(|error| self.refused(error))
    }

    /// Make the curve symmetric by the mean of both halves. A locked vertex locks its partners, and a target of one
    /// end is set at the other.
    ///
    /// # Errors
    /// [`EditError`] if a locked vertex would move.
    pub fn with_symmetry(&self, symmetry: Symmetry) -> Result<Self, EditError> {
        let completed = symmetry.completed(&self.polygon, |_| true);
        let polygon = completed.map_err(|error| self.refused(error))?;
        self.check_held(&polygon)?;
        let mut curve = Self {
            polygon,
            symmetry: Some(symmetry),
            ..self.clone()
        };
        curve.lock_partners();
        let unset = EndTargets::default();
        curve.mirror_targets(&unset);
        Ok(curve)
    }

    /// Let what changed of the curve change its image too.
    pub(super) fn kept_symmetric(
        &self,
        symmetry: Symmetry,
        before: Option<&Self>,
    ) -> Result<Self, EditError> {
        let mut curve = self.clone();
        let (symmetry, leads_all) = match before {
            Some(before) if before.polygon == self.polygon => (Some(symmetry), true),
            Some(before) if before.polygon.has_numbers_of(&self.polygon) => {
                match moved_along(symmetry, [&before.polygon, &self.polygon]) {
                    Some(moved) => (Some(moved), true),
                    None => (Some(symmetry), false),
                }
            }
            _ => (found_again(symmetry, &self.polygon), true),
        };
        curve.symmetry = symmetry;
        if let Some(symmetry) = symmetry {
            let leads = |index| {
                leads_all || before.is_none_or(|it| differs(&it.polygon, &self.polygon, index))
            };
            let completed = symmetry.completed(&self.polygon, leads);
            curve.polygon = completed.map_err(|error| self.refused(error))?;
            self.check_held(&curve.polygon)?;
            curve.lock_partners();
            let unset = EndTargets::default();
            curve.mirror_targets(before.map_or(&unset, |it| &it.targets));
        }
        Ok(curve)
    }

    fn lock_partners(&mut self) {
        let locked = self.locked_vertices.iter();
        self.locked_vertices = locked.flat_map(|it| self.dependents(it)).collect();
    }

    /// Give an end the image of the other end's target, if that is the one that differs.
    fn mirror_targets(&mut self, before: &EndTargets) {
        let finish_leads = self.targets.start == before.start
            && self.targets.finish != before.finish
            || self.targets.start.is_none() && before.start.is_none();
        let leader = if finish_leads {
            End::Finish
        } else {
            End::Start
        };
        self.mirror_target(leader);
    }

    /// Give the other end the image of an end's target, where the curve is symmetric.
    pub(super) fn mirror_target(&mut self, end: End) {
        if let Some(symmetry) = self.symmetry.filter(|_| !self.polygon.is_periodic()) {
            let planar = self.polygon.is_planar();
            let image = |it: EndTarget| symmetry.mirror().target(it, planar).turned(planar);
            let target = self.targets.get(end).map(image);
            self.targets.set(end.other(), target);
        }
    }
}

impl Document {
    /// List the curves that an edit since an earlier state made asymmetric, though they were symmetric.
    pub fn asymmetric_since<'a>(&'a self, before: &'a Self) -> impl Iterator<Item = &'a Curve> {
        self.curves().filter_map(|(id, curve)| {
            let then = before.curve(id)?;
            let is_lost = then.symmetry.is_some() && curve.symmetry.is_none();
            (is_lost && then.polygon != curve.polygon).then_some(&**curve)
        })
    }

    /// Let both halves of symmetric curves have what an edit did to one.
    ///
    /// A curve that was moved, turned or scaled as a whole takes its axis along. One that is no longer symmetric because
    /// its vertices have other numbers, as one that was cut, loses the rule.
    pub(super) fn keep_symmetries(&mut self, before: &Self) -> Result<(), EditError> {
        for index in 0..self.curves.len() {
            let (id, curve) = &self.curves[index];
            let Some(symmetry) = curve.symmetry else {
                continue;
            };
            let then = before.curve(*id);
            if then.is_some_and(|then| Arc::ptr_eq(then, curve)) {
                continue;
            }
            let kept = curve.kept_symmetric(symmetry, then.map(|it| &**it))?;
            if kept != **curve {
                self.curves[index].1 = Arc::new(kept);
            }
        }
        Ok(())
    }
}

/// The rule of a polygon that was moved, turned or scaled as a whole, about its plane now; the old one where the
/// polygon is symmetric still. `None` if only some vertices moved.
fn moved_along(symmetry: Symmetry, [before, after]: [&FloatPolygon; 2]) -> Option<Symmetry> {
    if symmetry.holds(after) {
        return Some(symmetry);
    }
    let translated = translation([before, after]).and_then(|by| symmetry.translated(by));
    if let Some(translated) = translated.filter(|it| it.holds(after)) {
        return Some(translated);
    }
    let count = after.vertices().len();
    let moved = (0..count)
        .filter(|index| differs(before, after, *index))
        .count();
    // The vertex about which a polygon turns stays.
    let is_whole = moved == count || (count > LEAST && moved == count - 1);
    let moved = symmetry
        .following(after)
        .filter(|_| is_whole && count >= LEAST);
    moved.filter(|it| it.holds(after))
}

/// The vector by which all vertices moved, if it is one; the median of the rounded ones.
fn translation([before, after]: [&FloatPolygon; 2]) -> Option<DVec3> {
    let pairs = before.vertices().iter().zip(after.vertices());
    let moves: Vec<DVec3> = pairs.map(|(before, after)| *after - *before).collect();
    let median = |axis: usize| {
        let mut moves: Vec<f64> = moves.iter().map(|by| by[axis]).collect();
        moves.sort_by(f64::total_cmp);
        moves.get(moves.len() / 2).copied().unwrap_or_default()
    };
    let by = DVec3::from_array([0, 1, 2].map(median));
    let far = after.vertices().iter().map(|it| it.abs().max_element());
    let rounding = ROUNDING * far.fold(by.length(), f64::max);
    let is_one = moves.iter().all(|it| it.distance(by) <= rounding);
    is_one.then_some(by)
}

/// The rule of a polygon with other numbers, or of a copy; `None` if it is not symmetric.
fn found_again(symmetry: Symmetry, polygon: &FloatPolygon) -> Option<Symmetry> {
    let renumbered = symmetry.renumbered(polygon);
    let size = polygon.size();
    let legs = polygon
        .vertices()
        .windows(2)
        .map(|leg| leg[0].distance(leg[1]));
    let mean = legs.sum::<f64>() / (polygon.vertices().len() - 1) as f64;
    let is_near = |it: &Symmetry| it.mismatch(polygon) <= OF_LEG * mean.min(size);
    let own = || renumbered.following(polygon).filter(|it| it.holds(polygon));
    Some(renumbered).filter(is_near).or_else(own)
}

fn differs(before: &FloatPolygon, after: &FloatPolygon, index: usize) -> bool {
    before.vertex(index) != after.vertex(index) || before.weight(index) != after.weight(index)
}
