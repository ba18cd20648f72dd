//! Keeping features: every place of a drag is proved, and what would add a feature stays at the last
//! place that did not; a step that would add one is refused.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};

use super::kept_curves::{KeptCurves, Obstacle};
use crate::document::{Curve, CurveId, Document, Edit, EditError, quoted};
use crate::geometry::features::SegmentFeatures;

/// How long a frame tries places on the way to one that is not safe.
const BUDGET: Duration = Duration::from_millis(3);

/// The most halvings of that way.
const HALVINGS: usize = 10;

/// The angles in degrees at which a single vertex that is held back tries to go on aside.
const ASIDE: [f64; 6] = [20.0, -20.0, 45.0, -45.0, 70.0, -70.0];

/// Follow a drag, and let no feature be added by it: to no curve that is dragged, and to none that
/// follows by a match.
#[derive(Debug, Default)]
pub struct Keeping {
    curves: KeptCurves,
    /// The last places of what is dragged that were proved to add nothing.
    good: BTreeMap<CurveId, Moves>,
    /// Why the vertices are not where the pointer has them.
    held_back: Option<String>,
}

/// Vertices of a curve with their places.
type Moves = Vec<(usize, DVec3)>;

/// What a drag works on: the document as it was when it began, what edits would show, the edits besides
/// moves, and what is proved of a curve's segments.
struct Drag<'a, T, P> {
    settled: &'a Document,
    try_out: T,
    others: &'a [Edit],
    proved: P,
}

impl Keeping {
    /// Forget the drag.
    pub fn end(&mut self) {
        *self = Self::default();
    }

    /// Why the vertices are not where the pointer has them, in words.
    pub fn held_back(&self) -> Option<&str> {
        self.held_back.as_deref()
    }

    /// Change the edits of a drag so that nothing is added to `settled`, the document as it was when
    /// the drag began, by what `try_out` says that they show. `proved` gives the features of a curve's
    /// segments, if they are known.
    pub fn keep(
        &mut self,
        edits: Vec<Edit>,
        settled: &Document,
        try_out: impl Fn(Vec<Edit>) -> Result<Document, EditError>,
        proved: impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    ) -> Vec<Edit> {
        self.held_back = None;
        let mut together = BTreeMap::new();
        let mut others = Vec::new();
        for edit in edits {
            match moves(&edit, settled) {
                Some((curve, moves)) => {
                    // Several edits of a curve count together; of a vertex the last one does.
                    let all: &mut BTreeMap<usize, DVec3> = together.entry(curve).or_default();
                    all.extend(moves);
                }
                None => others.push(edit),
            }
        }
        let together = together.into_iter();
        let wanted = together.map(|(curve, moves)| (curve, moves.into_iter().collect()));
        let wanted: BTreeMap<CurveId, Moves> = wanted.collect();
        self.begin(&wanted, settled);
        let drag = Drag {
            settled,
            try_out,
            others: &others,
            proved,
        };
        if let Err(Obstacle::Unprovable(reason)) = self.go(&wanted, &drag) {
            self.held_back = Some(reason);
            return others;
        }
        others.extend(edits_of(&self.good));
        others
    }

    /// Whether nothing is added to `settled` by what the drag has come to.
    pub fn allows(
        &mut self,
        after: &Document,
        settled: &Document,
        proved: impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    ) -> bool {
        self.curves.prove(settled, after, proved).is_ok()
    }

    /// Say what edits would add to the curves of a document, if they add features or nothing can be
    /// proved.
    pub fn refusal(
        edits: Vec<Edit>,
        document: &Document,
        proved: impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    ) -> Option<String> {
        let edited = document.edited(edits).ok()?;
        let obstacle = KeptCurves::default()
            .prove(document, &edited, proved)
            .err()?;
        Some(match obstacle {
            Obstacle::Added(curve, added) => {
                let curve = document.curve(curve).map(|curve| quoted(&curve.name));
                format!("it would add to {}: {added}", curve.unwrap_or_default())
            }
            Obstacle::Unprovable(reason) => reason,
        })
    }

    /// Begin where the vertices were, unless the same ones have been dragged in the last frame.
    fn begin(&mut self, wanted: &BTreeMap<CurveId, Moves>, settled: &Document) {
        let last = std::mem::take(&mut self.good);
        let indices = |moves: &Moves| moves.iter().map(|(index, _)| *index).collect::<Vec<_>>();
        for (id, moves) in wanted {
            let same = last.get(id).filter(|last| indices(last) == indices(moves));
            let good = same.cloned().or_else(|| {
                let polygon = &settled.curve(*id)?.polygon;
                let place = |(index, _): &(usize, DVec3)| (*index, polygon.vertex(*index));
                Some(moves.iter().map(place).collect())
            });
            self.good.extend(good.map(|good| (*id, good)));
        }
    }

    /// Go to places if they are safe, otherwise as far towards them as can be proved in time.
    ///
    /// # Errors
    /// [`Obstacle::Unprovable`] if nothing can be proved of a curve.
    fn go<T, P>(
        &mut self,
        wanted: &BTreeMap<CurveId, Moves>,
        drag: &Drag<T, P>,
    ) -> Result<(), Obstacle>
    where
        T: Fn(Vec<Edit>) -> Result<Document, EditError>,
        P: Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    {
        let begin = Instant::now();
        let (curve, added) = match self.go_all_the_way(wanted, drag) {
            Err(Obstacle::Added(curve, added)) => (curve, added),
            other => return other,
        };
        let from = self.good.clone();
        let (mut holds, mut fails) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            if begin.elapsed() > BUDGET {
                break;
            }
            let share = 0.5 * (holds + fails);
            match self.go_all_the_way(&between(&from, wanted, share), drag) {
                Ok(()) => holds = share,
                Err(_) => fails = share,
            }
        }
        self.slide(wanted, drag, begin);
        let follower = drag.settled.curve(curve);
        let follower = follower.filter(|_| !wanted.contains_key(&curve));
        let whose = follower.map(|curve| format!(" to {}, which follows", quoted(&curve.name)));
        self.held_back = Some(format!("beyond: {added}{}", whose.unwrap_or_default()));
        Ok(())
    }

    /// Prove that nothing is added at these places, and let them be the good ones.
    ///
    /// # Errors
    /// What stands against them.
    fn go_all_the_way<T, P>(
        &mut self,
        places: &BTreeMap<CurveId, Moves>,
        drag: &Drag<T, P>,
    ) -> Result<(), Obstacle>
    where
        T: Fn(Vec<Edit>) -> Result<Document, EditError>,
        P: Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    {
        let edits = drag.others.iter().cloned().chain(edits_of(places));
        let tried = (drag.try_out)(edits.collect());
        let tried = tried.map_err(|error| Obstacle::Unprovable(error.to_string()))?;
        self.curves.prove(drag.settled, &tried, &drag.proved)?;
        self.good.clone_from(places);
        Ok(())
    }

    /// Let a single vertex go along the border, nearer to where the pointer has it.
    fn slide<T, P>(&mut self, wanted: &BTreeMap<CurveId, Moves>, drag: &Drag<T, P>, begin: Instant)
    where
        T: Fn(Vec<Edit>) -> Result<Document, EditError>,
        P: Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    {
        let single = |places: &BTreeMap<CurveId, Moves>| match places.first_key_value() {
            Some((id, moves)) if places.len() == 1 && moves.len() == 1 => Some((*id, moves[0])),
            _ => None,
        };
        let Some(((id, (vertex, wanted)), (_, (_, good)))) = single(wanted).zip(single(&self.good))
        else {
            return;
        };
        let left = wanted - good;
        for degrees in ASIDE {
            if begin.elapsed() > BUDGET {
                return;
            }
            let angle = degrees.to_radians();
            // The foot of the way that is left on this direction: nearer than where it starts.
            let by = angle.cos() * DVec2::from_angle(angle).rotate(left.truncate());
            let place = vec![(vertex, good + by.extend(0.0))];
            if self.go_all_the_way(&[(id, place)].into(), drag).is_ok() {
                return;
            }
        }
    }
}

/// The edits that put vertices in their places.
fn edits_of(places: &BTreeMap<CurveId, Moves>) -> impl Iterator<Item = Edit> + '_ {
    places.iter().map(|(curve, moves)| Edit::MoveVertices {
        curve: *curve,
        moves: moves.clone(),
    })
}

/// Go a share of the way from some places to others.
fn between(
    from: &BTreeMap<CurveId, Moves>,
    to: &BTreeMap<CurveId, Moves>,
    share: f64,
) -> BTreeMap<CurveId, Moves> {
    let of_curve = |(id, to): (&CurveId, &Moves)| {
        let pairs = from.get(id)?.iter().zip(to);
        let places = pairs.map(|((_, from), (index, to))| (*index, from.lerp(*to, share)));
        Some((*id, places.collect()))
    };
    to.iter().filter_map(of_curve).collect()
}

/// Where an edit puts which vertices, if that is all it does.
fn moves(edit: &Edit, settled: &Document) -> Option<(CurveId, Moves)> {
    match edit {
        Edit::MoveVertices { curve, moves } => Some((*curve, moves.clone())),
        Edit::SetPolygon { curve, polygon } => {
            let before = &settled.curve(*curve)?.polygon;
            if !before.has_numbers_of(polygon) || before.weights() != polygon.weights() {
                return None;
            }
            // All vertices: which of them move may differ from frame to frame.
            let moves = polygon.vertices().iter().copied().enumerate();
            Some((*curve, moves.collect()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    #[test]
    fn two_edits_of_one_curve_in_a_frame_are_both_kept() {
        let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 1.2), (3.0, 2.1), (4.0, 3.2)];
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        let document = Document::from_curves([Curve::new("arc", polygon)]);
        let curve = document.ids().next().expect("a curve");
        let moved = |vertex: usize, by: f64| {
            let (x, y) = points[vertex];
            let moves = vec![(vertex, DVec3::new(x, y + by, 0.0))];
            Edit::MoveVertices { curve, moves }
        };
        let edits = vec![moved(0, 1e-3), moved(4, 2e-3), moved(0, -1e-3)];
        let try_out = |edits| document.edited(edits);
        let mut keeping = Keeping::default();
        let kept = keeping.keep(edits.clone(), &document, try_out, |_, _| None);
        assert_eq!(keeping.held_back(), None);
        let [kept, wanted] = [kept, edits].map(|edits| document.edited(edits).expect("a document"));
        assert!(kept.is_same(&wanted));
    }
}
