//! The curves whose features are kept: what a change of the document adds to them, proved.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec3;

use crate::document::{Curve, CurveId, Document, quoted};
use crate::editor::selection::Selection;
use crate::geometry::FloatPolygon;
use crate::geometry::features::SegmentFeatures;
use crate::geometry::vertex_moves::MoveProver;

/// The most segments of a curve that are proved anew in every frame.
const MOST_SEGMENTS: usize = 256;

/// Distances that differ by less than this share of the polygon's length are the same.
const SIMILAR: f64 = 1e-9;

/// Polygons are similar if the distances of vertices up to so many steps apart are.
const RIGID: usize = 3;

/// The features of a curve's segments, if they are proved already.
pub(super) type KnownFeatures<'a> =
    &'a dyn Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>;

/// The curves that have changed since a drag began, with what is proved of them as they were.
#[derive(Debug, Default)]
pub(super) struct KeptCurves {
    curves: BTreeMap<CurveId, Kept>,
}

/// A curve as it was, and the vertices of it that have been elsewhere since.
#[derive(Debug)]
struct Kept {
    before: Arc<Curve>,
    proved: Vec<SegmentFeatures>,
    vertices: BTreeSet<usize>,
    prover: MoveProver,
}

/// Why features are not kept.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Obstacle {
    /// Some are added to this curve.
    Added(CurveId, String),
    /// A vertex of this curve cannot be there: nothing is known of it then.
    Misplaced(CurveId, String),
    /// Nothing can be proved of a curve, in words.
    Unprovable(String),
}

impl KeptCurves {
    /// Prove that nothing is added to the curves of `before` by what makes `after` of it: to those that
    /// were moved and to those that follow them. `known` is of
    /// curves as they were.
    ///
    /// # Errors
    /// The first [`Obstacle`] found.
    pub(super) fn prove(
        &mut self,
        before: &Document,
        after: &Document,
        known: KnownFeatures,
    ) -> Result<(), Obstacle> {
        for (id, now) in after.curves() {
            let Some(then) = before.curve(id).filter(|then| !Arc::ptr_eq(then, now)) else {
                continue;
            };
            let moved = now.polygon.moved_vertices(&then.polygon);
            if moved.is_empty() {
                continue;
            }
            let kept = self.kept(id, then, &moved, known).map_err(|reason| {
                let name = quoted(&then.name);
                Obstacle::Unprovable(format!("features of {name} cannot be kept: {reason}"))
            })?;
            let vertices = kept.vertices.iter();
            let places: Vec<_> = vertices.map(|index| now.polygon.vertex(*index)).collect();
            match kept.prover.rise(&places) {
                Ok(rise) if rise.is_none() => {}
                Ok(rise) => return Err(Obstacle::Added(id, rise.text())),
                Err(error) => return Err(Obstacle::Misplaced(id, error.to_string())),
            }
        }
        Ok(())
    }

    /// What proves moves of these vertices of a curve: made anew for vertices that had not moved yet.
    fn kept(
        &mut self,
        id: CurveId,
        before: &Arc<Curve>,
        moved: &[usize],
        known: KnownFeatures,
    ) -> Result<&mut Kept, String> {
        let last = self.curves.remove(&id);
        let last = last.filter(|kept| Arc::ptr_eq(&kept.before, before));
        let has_moved = |kept: &Kept| moved.iter().all(|it| kept.vertices.contains(it));
        let kept = match last {
            Some(kept) if has_moved(&kept) => kept,
            Some(mut kept) => {
                kept.vertices.extend(moved);
                Kept::new(before, kept.proved, kept.vertices)?
            }
            None => {
                let proved = known(id, before)
                    .or_else(|| SegmentFeatures::of_curve(&before.polygon, |_| true));
                let moved = moved.iter().copied().collect();
                Kept::new(before, proved.unwrap_or_default(), moved)?
            }
        };
        Ok(self.curves.entry(id).or_insert(kept))
    }
}

impl Kept {
    fn new(
        before: &Arc<Curve>,
        proved: Vec<SegmentFeatures>,
        vertices: BTreeSet<usize>,
    ) -> Result<Self, String> {
        let prover = MoveProver::new(&before.polygon, &proved, vertices.iter().copied().collect())
            .map_err(|error| error.to_string())?;
        let segments = prover.dependent().len();
        if segments > MOST_SEGMENTS {
            return Err(format!(
                "{segments} segments would be proved in every frame, at most {MOST_SEGMENTS} can be: drag fewer vertices"
            ));
        }
        Ok(Self {
            before: before.clone(),
            proved,
            vertices,
            prover,
        })
    }
}

/// Whether a curve moved as a whole, without a change of shape.
pub(super) fn moves_whole(before: &Document, after: &Document) -> bool {
    let mut curves = after.curves();
    curves.any(|(id, now)| {
        let then = before.curve(id).filter(|then| !Arc::ptr_eq(then, now));
        then.is_some_and(|then| {
            let moved = now.polygon.moved_vertices(&then.polygon);
            moved.len() == now.polygon.vertices().len() && is_similar(&then.polygon, &now.polygon)
        })
    })
}

/// Whether distances between near vertices all have the same share of the length of their polygon.
fn is_similar(before: &FloatPolygon, now: &FloatPolygon) -> bool {
    let [old, new] = [before, now].map(|it| it.vertices());
    let legs = |vertices: &[DVec3], step: usize| -> Vec<f64> {
        let pairs = vertices.iter().zip(vertices.iter().skip(step));
        pairs.map(|(a, b)| a.distance(*b)).collect()
    };
    let [old_length, new_length] = [old, new].map(|it| legs(it, 1).iter().sum::<f64>());
    let rounding = SIMILAR * old_length * new_length;
    (1..=RIGID).all(|step| {
        let [old, new] = [old, new].map(|it| legs(it, step));
        let mut pairs = old.iter().zip(&new);
        pairs.all(|(old, new)| (new * old_length - old * new_length).abs() <= rounding)
    })
}

/// Whether a vertex is elsewhere that is neither among those of a selection nor an image of one.
pub(super) fn moves_others(before: &Document, after: &Document, selection: &Selection) -> bool {
    let mut curves = after.curves();
    curves.any(|(id, now)| {
        let then = before.curve(id).filter(|then| !Arc::ptr_eq(then, now));
        let moved = then.map(|then| now.polygon.moved_vertices(&then.polygon));
        let mut moved = moved.into_iter().flatten();
        moved.any(|index| {
            let mut own = now.dependents(index).into_iter();
            !own.any(|index| selection.contains((id, index)))
        })
    })
}
