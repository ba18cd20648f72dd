//! Keeping features: every place of a drag is proved, and what would add a feature stays at the last
//! place that did not; a step that would add one is refused.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};

use super::kept_curves::{KeptCurves, KnownFeatures, Obstacle};
use crate::document::{CurveId, Document, Edit, EditError, quoted};

/// The time in which a frame of the window tries places on the way to one that is not safe.
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
    /// The last places of the dragged vertices that were proved to add no feature.
    good: Places,
    /// Why the vertices are not where the pointer has them.
    held_back: Option<String>,
    /// The features that the drag adds where it is not held back.
    added: Option<String>,
    /// Whether a frame must not wait for all places: without a window every one is tried.
    hurries: bool,
}

/// Vertices of a curve with their places.
type Moves = BTreeMap<usize, DVec3>;

/// Vertices of several curves with their places.
type Places = BTreeMap<CurveId, Moves>;

/// The dragged vertices.
struct Drag<'a> {
    /// The document as it was when the drag began.
    settled: &'a Document,
    /// The document that edits would show.
    try_out: &'a dyn Fn(Vec<Edit>) -> Result<Document, EditError>,
    /// The edits besides moves.
    others: &'a [Edit],
    known: KnownFeatures<'a>,
}

impl Keeping {
    /// Try places only as long as a frame of a window may take.
    pub fn hurry(&mut self) {
        self.hurries = true;
    }

    /// Forget the drag.
    pub fn end(&mut self) {
        *self = Self {
            hurries: self.hurries,
            ..Self::default()
        };
    }

    /// Why the vertices are not where the pointer has them, in words.
    pub fn held_back(&self) -> Option<&str> {
        self.held_back.as_deref()
    }

    /// The features that the drag adds, in words.
    pub fn added(&self) -> Option<&str> {
        self.added.as_deref()
    }

    /// Find what a drag that is not held back adds to `settled`, the document as it was when the drag began.
    pub fn find_added(&mut self, after: &Document, settled: &Document, known: KnownFeatures) {
        let proved = self.curves.prove(settled, after, known);
        self.added = match proved {
            Err(Obstacle::Added(_, added)) => Some(added),
            _ => None,
        };
    }

    /// Forget what a drag added.
    pub fn forget_added(&mut self) {
        self.added = None;
    }

    /// Change the edits of a drag so that nothing is added to `settled`, the document as it was when
    /// the drag began, by what `try_out` says that they show.
    pub fn keep(
        &mut self,
        edits: Vec<Edit>,
        settled: &Document,
        try_out: &dyn Fn(Vec<Edit>) -> Result<Document, EditError>,
        known: KnownFeatures,
    ) -> Vec<Edit> {
        self.held_back = None;
        let mut wanted = Places::new();
        let mut others = Vec::new();
        for edit in edits {
            match moves(&edit, settled) {
                // Several edits of a curve count together; of a vertex the last one does.
                Some((curve, moves)) => wanted.entry(curve).or_default().extend(moves),
                None => others.push(edit),
            }
        }
        self.begin(&wanted, settled);
        let drag = Drag {
            settled,
            try_out,
            others: &others,
            known,
        };
        if let Err(Obstacle::Unprovable(reason)) = self.go(&wanted, &drag) {
            self.held_back = Some(reason);
            return others;
        }
        others.extend(edits_of(&self.good));
        others
    }

    /// Whether nothing is added to `settled` by what the drag has come to.
    pub fn allows(&mut self, after: &Document, settled: &Document, known: KnownFeatures) -> bool {
        self.curves.prove(settled, after, known).is_ok()
    }

    /// Say what edits would add to the curves of a document, if they add features or nothing can be
    /// proved.
    pub fn refusal(edits: Vec<Edit>, document: &Document, known: KnownFeatures) -> Option<String> {
        let edited = document.edited(edits).ok()?;
        let obstacle = KeptCurves::default()
            .prove(document, &edited, known)
            .err()?;
        Some(match obstacle {
            Obstacle::Added(curve, added) => {
                let curve = document.curve(curve).map(|curve| quoted(&curve.name));
                format!("it would add to {}: {added}", curve.unwrap_or_default())
            }
            Obstacle::Misplaced(_, reason) | Obstacle::Unprovable(reason) => reason,
        })
    }

    /// Begin where the vertices were, unless the same ones have been dragged in the last frame.
    fn begin(&mut self, wanted: &Places, settled: &Document) {
        let last = std::mem::take(&mut self.good);
        for (id, moves) in wanted {
            let same = last.get(id).filter(|last| last.keys().eq(moves.keys()));
            let good = same.cloned().or_else(|| {
                let polygon = &settled.curve(*id)?.polygon;
                let place = |index: &usize| (*index, polygon.vertex(*index));
                Some(moves.keys().map(place).collect())
            });
            self.good.extend(good.map(|good| (*id, good)));
        }
    }

    /// Go to places if they are safe, otherwise as far towards them as can be proved in time.
    ///
    /// # Errors
    /// [`Obstacle::Unprovable`] if nothing can be proved of a curve.
    fn go(&mut self, wanted: &Places, drag: &Drag) -> Result<(), Obstacle> {
        let begin = Instant::now();
        let (curve, added) = match self.go_all_the_way(wanted, drag) {
            Err(Obstacle::Added(curve, reason) | Obstacle::Misplaced(curve, reason)) => {
                (curve, reason)
            }
            other => return other,
        };
        let from = self.good.clone();
        let (mut holds, mut fails) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            if self.is_late(begin) {
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
    fn go_all_the_way(&mut self, places: &Places, drag: &Drag) -> Result<(), Obstacle> {
        let edits = drag.others.iter().cloned().chain(edits_of(places));
        let tried = (drag.try_out)(edits.collect());
        let tried = tried.map_err(|error| Obstacle::Unprovable(error.to_string()))?;
        self.curves.prove(drag.settled, &tried, drag.known)?;
        self.good.clone_from(places);
        Ok(())
    }

    fn is_late(&self, begin: Instant) -> bool {
        self.hurries && begin.elapsed() > BUDGET
    }

    /// Let a single vertex go along the border, nearer to where the pointer has it.
    fn slide(&mut self, wanted: &Places, drag: &Drag, begin: Instant) {
        let single = |places: &Places| {
            let mut all = places.iter().flat_map(|(id, moves)| {
                moves
                    .iter()
                    .map(move |(vertex, place)| (*id, *vertex, *place))
            });
            all.next().filter(|_| all.next().is_none())
        };
        let Some(((id, vertex, wanted), (.., good))) = single(wanted).zip(single(&self.good))
        else {
            return;
        };
        let left = wanted - good;
        for degrees in ASIDE {
            if self.is_late(begin) {
                return;
            }
            let angle = degrees.to_radians();
            // The foot of the way that is left on this direction: nearer than where it starts.
            let by = angle.cos() * DVec2::from_angle(angle).rotate(left.truncate());
            let place = Moves::from([(vertex, good + by.extend(0.0))]);
            if self.go_all_the_way(&[(id, place)].into(), drag).is_ok() {
                return;
            }
        }
    }
}

/// The edits that put vertices in their places.
fn edits_of(places: &Places) -> impl Iterator<Item = Edit> + '_ {
    places.iter().map(|(curve, moves)| Edit::MoveVertices {
        curve: *curve,
        moves: moves
            .iter()
            .map(|(index, place)| (*index, *place))
            .collect(),
    })
}

/// Go a share of the way from some places to others.
fn between(from: &Places, to: &Places, share: f64) -> Places {
    let of_curve = |(id, to): (&CurveId, &Moves)| {
        let from = from.get(id)?;
        let place =
            |(index, to): (&usize, &DVec3)| Some((*index, from.get(index)?.lerp(*to, share)));
        Some((*id, to.iter().filter_map(place).collect()))
    };
    to.iter().filter_map(of_curve).collect()
}

/// Where an edit puts which vertices, if that is all it does.
fn moves(edit: &Edit, settled: &Document) -> Option<(CurveId, Moves)> {
    match edit {
        Edit::MoveVertices { curve, moves } => Some((*curve, moves.iter().copied().collect())),
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
    use crate::document::Curve;
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
        let kept = keeping.keep(edits.clone(), &document, &try_out, &|_, _| None);
        assert_eq!(keeping.held_back(), None);
        let [kept, wanted] = [kept, edits].map(|edits| document.edited(edits).expect("a document"));
        assert!(kept.is_same(&wanted));
    }
}
