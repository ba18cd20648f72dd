//! Keeping features while dragging: every place is proved, and what would add a feature stays at the
//! last place that did not.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};

use crate::document::{Curve, CurveId, Document, Edit, quoted};
use crate::geometry::FloatPolygon;
use crate::geometry::features::SegmentFeatures;
use crate::geometry::vertex_moves::{FeatureRise, MoveError, MoveProver};

/// How long a frame tries places on the way to one that is not safe.
const BUDGET: Duration = Duration::from_millis(3);

/// The most halvings of that way.
const HALVINGS: usize = 10;

/// The most segments that are proved anew in every frame.
const MOST_SEGMENTS: usize = 256;

/// The angles in degrees at which a single vertex that is held back tries to go on aside.
const ASIDE: [f64; 6] = [20.0, -20.0, 45.0, -45.0, 70.0, -70.0];

/// Follow a drag, and let no feature be added by it.
#[derive(Debug, Default)]
pub struct Keeping {
    curves: BTreeMap<CurveId, Kept>,
    /// Why the vertices are not where the pointer has them.
    held_back: Option<String>,
}

/// The vertices of one curve that are dragged.
#[derive(Debug)]
struct Kept {
    before: Arc<Curve>,
    vertices: Vec<usize>,
    prover: MoveProver,
    /// The last places that were proved to add nothing.
    good: Vec<DVec3>,
}

/// The places of some vertices of a curve.
type Places = (CurveId, Vec<(usize, DVec3)>);

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
    /// the drag began. `proved` gives the features of a curve's segments, if they are known.
    pub fn keep(
        &mut self,
        edits: Vec<Edit>,
        settled: &Document,
        proved: impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    ) -> Vec<Edit> {
        self.held_back = None;
        let mut wanted: Vec<Places> = Vec::new();
        let mut others = Vec::new();
        for edit in edits {
            match places(&edit, settled) {
                Some(places) => wanted.push(places),
                None => others.push(edit),
            }
        }
        for (id, moves) in &wanted {
            if let Err(reason) = self.prepare(*id, moves, settled, &proved) {
                let curve = settled.curve(*id).map(|curve| quoted(&curve.name));
                let name = curve.unwrap_or_default();
                self.held_back = Some(format!("features of {name} cannot be kept: {reason}"));
                return others;
            }
        }
        let wanted: BTreeMap<CurveId, Vec<DVec3>> = wanted
            .into_iter()
            .map(|(id, moves)| (id, moves.into_iter().map(|(_, place)| place).collect()))
            .collect();
        self.go(&wanted);
        others.extend(wanted.keys().filter_map(|id| self.edit(*id)));
        others
    }

    /// Prepare for the vertices of a curve that are dragged, unless it is done.
    fn prepare(
        &mut self,
        id: CurveId,
        moves: &[(usize, DVec3)],
        settled: &Document,
        proved: &impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>>,
    ) -> Result<(), String> {
        let Some(before) = settled.curve(id) else {
            return Err("the curve is gone".to_owned());
        };
        let same = |kept: &Kept| {
            let vertices = moves.iter().map(|(index, _)| *index);
            Arc::ptr_eq(&kept.before, before) && vertices.eq(kept.vertices.iter().copied())
        };
        if self.curves.get(&id).is_some_and(same) {
            return Ok(());
        }
        let polygon = &before.polygon;
        let known = proved(id, before);
        let known = known.or_else(|| SegmentFeatures::of_curve(polygon, |_| true));
        let vertices: Vec<usize> = moves.iter().map(|(index, _)| *index).collect();
        let prover = MoveProver::new(polygon, &known.unwrap_or_default(), vertices.clone())
            .map_err(|error: MoveError| error.to_string())?;
        let segments = prover.dependent().len();
        if segments > MOST_SEGMENTS {
            return Err(format!(
                "{segments} segments would be proved in every frame, at most {MOST_SEGMENTS} can be: drag fewer vertices"
            ));
        }
        let good = vertices.iter().map(|index| polygon.vertex(*index));
        let kept = Kept {
            before: before.clone(),
            good: good.collect(),
            vertices,
            prover,
        };
        self.curves.insert(id, kept);
        Ok(())
    }

    /// Go to places if they are safe, otherwise as far towards them as can be proved in time.
    fn go(&mut self, wanted: &BTreeMap<CurveId, Vec<DVec3>>) {
        let begin = Instant::now();
        let Err(rise) = self.go_all_the_way(wanted) else {
            return;
        };
        let from: BTreeMap<CurveId, Vec<DVec3>> = wanted
            .keys()
            .filter_map(|id| Some((*id, self.curves.get(id)?.good.clone())))
            .collect();
        let (mut holds, mut fails) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            if begin.elapsed() > BUDGET {
                break;
            }
            let share = 0.5 * (holds + fails);
            match self.go_all_the_way(&between(&from, wanted, share)) {
                Ok(()) => holds = share,
                Err(_) => fails = share,
            }
        }
        self.slide(wanted, begin);
        let added = rise.map_or_else(
            || "it cannot be there".to_owned(),
            |rise| format!("beyond: {}", rise.text()),
        );
        self.held_back = Some(added);
    }

    /// Prove that nothing is added at these places, and let them be the good ones.
    ///
    /// # Errors
    /// What is added; nothing if it cannot be told.
    fn go_all_the_way(
        &mut self,
        places: &BTreeMap<CurveId, Vec<DVec3>>,
    ) -> Result<(), Option<FeatureRise>> {
        for (id, places) in places {
            if let Some(kept) = self.curves.get_mut(id) {
                match kept.prover.rise(places) {
                    Ok(rise) if rise.is_none() => {}
                    Ok(rise) => return Err(Some(rise)),
                    Err(_) => return Err(None),
                }
            }
        }
        for (id, places) in places {
            if let Some(kept) = self.curves.get_mut(id) {
                kept.good.clone_from(places);
            }
        }
        Ok(())
    }

    /// Let a single vertex go along the border, nearer to where the pointer has it.
    fn slide(&mut self, wanted: &BTreeMap<CurveId, Vec<DVec3>>, begin: Instant) {
        let Some((id, [wanted])) = wanted
            .first_key_value()
            .filter(|_| wanted.len() == 1)
            .map(|(id, places)| (*id, places.as_slice()))
        else {
            return;
        };
        let Some([good]) = self.curves.get(&id).map(|kept| kept.good.as_slice()) else {
            return;
        };
        let (good, left) = (*good, *wanted - *good);
        for degrees in ASIDE {
            if begin.elapsed() > BUDGET {
                return;
            }
            let angle = degrees.to_radians();
            // The foot of the way that is left on this direction: nearer than where it starts.
            let by = angle.cos() * DVec2::from_angle(angle).rotate(left.truncate());
            let place = good + by.extend(0.0);
            if self.go_all_the_way(&[(id, vec![place])].into()).is_ok() {
                return;
            }
        }
    }

    /// The edit that puts a curve's vertices at the last good places.
    fn edit(&self, curve: CurveId) -> Option<Edit> {
        let kept = self.curves.get(&curve)?;
        let moves = kept.vertices.iter().copied().zip(kept.good.iter().copied());
        Some(Edit::MoveVertices {
            curve,
            moves: moves.collect(),
        })
    }
}

/// Go a share of the way from some places to others.
fn between(
    from: &BTreeMap<CurveId, Vec<DVec3>>,
    to: &BTreeMap<CurveId, Vec<DVec3>>,
    share: f64,
) -> BTreeMap<CurveId, Vec<DVec3>> {
    let of_curve = |(id, to): (&CurveId, &Vec<DVec3>)| {
        let from = from.get(id)?;
        let pairs = from.iter().zip(to);
        let places = pairs.map(|(from, to)| from.lerp(*to, share));
        Some((*id, places.collect()))
    };
    to.iter().filter_map(of_curve).collect()
}

/// Where an edit puts which vertices, if that is all it does.
fn places(edit: &Edit, settled: &Document) -> Option<Places> {
    match edit {
        Edit::MoveVertices { curve, moves } => Some((*curve, moves.clone())),
        Edit::SetPolygon { curve, polygon } => {
            let before = &settled.curve(*curve)?.polygon;
            let shape = |polygon: &FloatPolygon| {
                let weights = polygon.weights().map(<[f64]>::to_vec);
                let count = polygon.vertices().len();
                (polygon.degree(), polygon.is_periodic(), count, weights)
            };
            if shape(before) != shape(polygon) {
                return None;
            }
            // All vertices: which of them move may differ from frame to frame.
            let moves = polygon.vertices().iter().copied().enumerate();
            Some((*curve, moves.collect()))
        }
        _ => None,
    }
}
