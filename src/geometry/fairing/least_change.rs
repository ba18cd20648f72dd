//! Least change: what the user holds goes where it is dragged, and all else moves as little and as evenly as possible.
//!
//! The moves are linear in the drag: they are the answer to a drag of the size of the polygon, scaled.

use glam::DVec3;
use thiserror::Error;

use super::jet_weights::JetWeights;
use super::objective::Objective;
use super::problem::Problem;
use crate::geometry::conversion::ClampedPolygon;
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

/// The order of the differences of the moves that are kept small: a move spreads without corners.
pub(super) const ORDER: usize = 2;

/// The least weight of the moves themselves: it keeps equations regular where all vertices follow. Less would amplify
/// rounding there, more would let moves fade within 30 vertices.
const LEAST_STIFFNESS: f64 = 1e-6;

/// The weights λ and ν of the curve's own moves where a closed vertex beside an end is dragged, which turns or bends the
/// end. It acts on the curve like a lever: by degree 5 the curve moves at most 1.4 times as far, without these weights
/// 29 times, and float vertices up to 86 times. The exact edit, where all other closed vertices stay, moves the curve
/// half as far as the vertex, but float vertices 195 times, and by degree 7 9 450 times instead of 350.
const LEVER_WEIGHTS: [f64; 2] = [1e4, 0.1];

/// The residual of a condition, in units of the drag, up to which it counts as met: singular equations leave far more,
/// regular ones rounding.
const MET: f64 = 1e-9;

/// What the user drags.
#[derive(Clone, Debug, PartialEq)]
pub enum Dragged {
    /// Vertices of the float polygon, with their new places.
    Vertices(Vec<(usize, DVec3)>),
    /// A vertex of the closed S-polygon, and by how much.
    Clamped(usize, DVec3),
    /// The point of the curve at a parameter, and by how much.
    Point(f64, DVec3),
}

/// How far a change reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach<'a> {
    /// How many vertices beside a held one follow on each side.
    pub span: usize,
    /// The weight μ ≥ 0 of the vertices' own moves beside their second differences.
    pub stiffness: f64,
    /// The vertices that stay.
    pub locked: &'a [usize],
}

/// Why a drag has no answer.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LeastChangeError {
    /// Too few vertices follow for what is held.
    #[error("too few vertices are free to follow: let more follow, or unlock some")]
    NoFreedom,
    /// The curve has no such vertex, or a vertex would leave the range of numbers.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

/// Drag vertices or a point, with the smallest sum of squares Σ|Δ²m|² + μ Σ|m|² of the moves m of the vertices in reach.
///
/// For a closed vertex beside an end λ ∫(|C − C⁰|² + ν |C″ − C⁰″|²) du is added. All other vertices stay, and so do the points and directions of the ends in reach. A closed vertex that is an end's
/// point takes that end along, the one beside it turns the end's direction. Where dragged vertices leave too few others
/// for an end, that is released; for a point of the curve or a closed vertex only the direction of the nearer end is.
/// The moves are linear in the drag, and a drag of 0 changes no bit.
///
/// # Errors
/// [`LeastChangeError`].
pub fn least_change(
    polygon: &FloatPolygon,
    dragged: &Dragged,
    reach: &Reach,
) -> Result<FloatPolygon, LeastChangeError> {
    let change = Change::new(polygon, dragged, reach)?;
    let by = change.by(dragged);
    let longest = by.iter().map(|by| by.abs().max_element());
    let drag = longest.fold(0.0, f64::max);
    let mut changed = polygon.clone();
    if drag > 0.0 {
        // A polygon of one point has no size.
        let unit = Some(polygon.size()).filter(|size| *size > 0.0);
        let share = drag / unit.unwrap_or(drag);
        let far: Vec<DVec3> = by.iter().map(|by| *by / share).collect();
        let moves = change.moves(&far)?.into_iter();
        let moves = moves.map(|(vertex, by)| (vertex, polygon.vertex(vertex) + share * by));
        changed.move_vertices(moves)?;
    }
    if let Dragged::Vertices(places) = dragged {
        // To the bit.
        changed.move_vertices(places.iter().copied())?;
    }
    Ok(changed)
}

/// Measure how many times as far as what is dragged the vertices move, at most.
///
/// # Errors
/// As [`least_change`].
pub fn magnification(
    polygon: &FloatPolygon,
    dragged: &Dragged,
    reach: &Reach,
) -> Result<f64, LeastChangeError> {
    let change = Change::new(polygon, dragged, reach)?;
    let size = polygon.size();
    let mut most = 0.0_f64;
    for axis in [DVec3::X, DVec3::Y] {
        let by = vec![size * axis; change.held.len().max(1)];
        let moves = change.moves(&by)?;
        let farthest = moves.iter().map(|(_, by)| by.length());
        most = farthest.fold(most, f64::max);
    }
    Ok(if size > 0.0 { most / size } else { 1.0 })
}

/// Vertices that move, and by how much.
type Moves = Vec<(usize, DVec3)>;

/// A change to solve for.
struct Change<'a> {
    polygon: &'a FloatPolygon,
    /// The vertices that are dragged.
    held: Vec<usize>,
    /// The closed vertex that is dragged.
    clamped: Option<usize>,
    /// The weights of the vertices in the point that is dragged.
    weights: Vec<(usize, f64)>,
    stiffness: f64,
    /// The weights λ and ν.
    curve_weights: [f64; 2],
    /// Which vertices follow.
    follows: Vec<bool>,
    /// What the ends in reach keep.
    ends: Vec<(End, EndTarget)>,
}

impl<'a> Change<'a> {
    fn new(
        polygon: &'a FloatPolygon,
        dragged: &Dragged,
        reach: &Reach,
    ) -> Result<Self, PolygonError> {
        let mut change = Self {
            polygon,
            held: Vec::new(),
            clamped: None,
            weights: Vec::new(),
            stiffness: reach.stiffness.max(LEAST_STIFFNESS),
            curve_weights: [0.0; 2],
            follows: vec![false; polygon.vertices().len()],
            ends: Vec::new(),
        };
        match dragged {
            Dragged::Vertices(places) => {
                change.held = places.iter().map(|(vertex, _)| *vertex).collect();
            }
            Dragged::Clamped(index, _) => {
                change.clamped = Some(*index);
                change.weights = clamped_weights(polygon, *index)?;
            }
            Dragged::Point(u, _) => change.weights = JetWeights::at(polygon, *u).of_value(),
        }
        let levers = 1..polygon.degree();
        let mut distances = End::BOTH
            .into_iter()
            .filter_map(|end| change.held_from(end));
        if !polygon.is_periodic() && distances.any(|distance| levers.contains(&distance)) {
            change.curve_weights = LEVER_WEIGHTS;
        }
        for vertex in &change.held {
            polygon.check_index(*vertex)?;
        }
        let near = change.weights.iter().map(|(vertex, _)| *vertex);
        for vertex in near.chain(change.held.iter().copied()) {
            let follows = &mut change.follows;
            mark_near(follows, vertex, reach.span, polygon.is_periodic());
        }
        let mut ends = End::BOTH.to_vec();
        ends.retain(|end| {
            let mut terminal = polygon.terminal_vertices(*end);
            !polygon.is_periodic() && terminal.any(|vertex| change.follows[vertex])
        });
        change.ends = ends
            .into_iter()
            .map(|end| (end, change.kept(end)))
            .collect();
        for vertex in reach.locked.iter().chain(&change.held) {
            if let Some(follows) = change.follows.get_mut(*vertex) {
                *follows = false;
            }
        }
        Ok(change)
    }

    /// By how much each held vertex, or the point, is dragged.
    fn by(&self, dragged: &Dragged) -> Vec<DVec3> {
        match dragged {
            Dragged::Vertices(places) => {
                let places = places.iter();
                places
                    .map(|(vertex, place)| *place - self.polygon.vertex(*vertex))
                    .collect()
            }
            Dragged::Clamped(_, by) | Dragged::Point(_, by) => vec![*by],
        }
    }

    /// How far from an end a closed vertex is held.
    fn held_from(&self, end: End) -> Option<usize> {
        let last = self.polygon.vertices().len() - 1;
        let index = self.clamped?;
        match end {
            End::Start => Some(index),
            End::Finish => last.checked_sub(index),
        }
    }

    /// The present point of an end, and the direction where it is kept.
    fn kept(&self, end: End) -> EndTarget {
        let kept = EndTarget::keeping(&self.polygon.end_jet(end));
        match self.held_from(end) {
            Some(1) => EndTarget {
                direction: None,
                ..kept
            },
            _ => kept,
        }
    }

    /// Solve for the moves of all vertices that move.
    fn moves(&self, by: &[DVec3]) -> Result<Moves, LeastChangeError> {
        let mut ends = self.ends.clone();
        for (end, target) in &mut ends {
            if self.held_from(*end) == Some(0) {
                target.point += by.iter().sum::<DVec3>();
            }
        }
        loop {
            let (moves, lost) = self.moves_with(by, &ends)?;
            match lost {
                None => return Ok(moves),
                Some(lost) => self.release(&mut ends, lost)?,
            }
        }
    }

    /// Release a condition of an end, one that is missed first.
    fn release(
        &self,
        ends: &mut Vec<(End, EndTarget)>,
        lost: Lost,
    ) -> Result<(), LeastChangeError> {
        let held = !self.held.is_empty();
        let place = match lost {
            Lost::End(place) if held => place,
            _ if held => return Err(LeastChangeError::NoFreedom),
            _ => {
                let nearer = self.nearer();
                let is_nearer =
                    |(end, target): &(End, EndTarget)| *end == nearer && target.direction.is_some();
                let place = ends.iter().position(is_nearer);
                place.ok_or(LeastChangeError::NoFreedom)?
            }
        };
        match ends.get_mut(place) {
            Some((_, target)) if target.direction.is_some() => target.direction = None,
            _ => drop(ends.remove(place)),
        }
        Ok(())
    }

    /// The end that is nearer to what is held.
    fn nearer(&self) -> End {
        let middle: f64 = self
            .weights
            .iter()
            .map(|(it, weight)| *it as f64 * weight)
            .sum();
        match 2.0 * middle < (self.polygon.vertices().len() - 1) as f64 {
            true => End::Start,
            false => End::Finish,
        }
    }

    /// Solve with some conditions at the ends; returns one that cannot be met, too.
    fn moves_with(
        &self,
        by: &[DVec3],
        ends: &[(End, EndTarget)],
    ) -> Result<(Moves, Option<Lost>), LeastChangeError> {
        let polygon = self.polygon;
        let mut begun = polygon.clone();
        let held = self.held.iter().zip(by);
        begun.move_vertices(held.map(|(vertex, by)| (*vertex, polygon.vertex(*vertex) + *by)))?;
        let planar = polygon.is_planar() && by.iter().all(|by| by.z == 0.0);
        let mut problem = Problem::new(&begun, planar, |vertex| self.follows[vertex]);
        problem.moved_from(polygon.vertices());
        for (end, target) in ends {
            problem.hold(end.parameter(polygon), target, None);
        }
        let drag: DVec3 = by.iter().sum();
        let point = |polygon: &FloatPolygon| -> DVec3 {
            let terms = self.weights.iter();
            terms
                .map(|(vertex, weight)| *weight * polygon.vertex(*vertex))
                .sum()
        };
        let place = point(polygon) + drag;
        if !self.weights.is_empty() {
            problem.hold_point(self.weights.clone(), place);
        }
        let least = Objective::Disturbance {
            order: ORDER,
            fidelity: self.stiffness,
            curve: self.curve_weights,
        };
        let found = match problem.freedoms() {
            0 => None,
            _ => problem.meet(least, begun.vertices(), 1),
        };
        let after = match found {
            Some(found) => problem.polygon(&found.vertices)?,
            None => begun.clone(),
        };
        let met = MET * polygon.size().max(drag.length());
        let misses = |(end, target): &(End, EndTarget)| {
            let jet = after.end_jet(*end);
            // A far drag may turn the end round: only the line of its direction is a condition.
            let off = target.direction.map(|it| jet.first.cross(it).length());
            jet.point.distance(target.point).max(off.unwrap_or(0.0)) > met
        };
        let lost = ends.iter().position(misses).map(Lost::End);
        let misses = !self.weights.is_empty() && point(&after).distance(place) > met;
        let lost = lost.or(misses.then_some(Lost::Point));
        let moves = after.vertices().iter().zip(polygon.vertices());
        let moves = moves.map(|(after, before)| *after - *before).enumerate();
        let moves = moves.filter(|(_, by)| *by != DVec3::ZERO);
        Ok((moves.collect(), lost))
    }
}

/// A condition that cannot be met.
#[derive(Clone, Copy)]
enum Lost {
    /// That of an end, by its place among them.
    End(usize),
    /// That of the point that is dragged.
    Point,
}

/// Mark a vertex and those up to `span` places from it.
pub(super) fn mark_near(near: &mut [bool], vertex: usize, span: usize, periodic: bool) {
    let count = near.len();
    let span = span.min(count);
    for offset in 0..=2 * span {
        let place = vertex + offset;
        if periodic {
            near[(place + count * 2 - span) % count] = true;
        } else if let Some(place) = place.checked_sub(span).filter(|place| *place < count) {
            near[place] = true;
        }
    }
}

/// The weights with which the float vertices enter a vertex of the closed S-polygon.
///
/// Beside an end all n + 1 vertices of its segment are listed, some with the weight 0: all of them follow. Without some
/// of them the conditions at the end would leave too little freedom, and throw the curve.
///
/// # Errors
/// [`PolygonError`] if the closed polygon has no such vertex.
fn clamped_weights(
    polygon: &FloatPolygon,
    index: usize,
) -> Result<Vec<(usize, f64)>, PolygonError> {
    polygon.check_index(index)?;
    let (degree, count) = (polygon.degree(), polygon.vertices().len());
    // Only the first and last n − 1 vertices differ: they are made of the first and the last segment's n + 1 float
    // vertices.
    let reach = (2 * degree).min(count);
    let (window, entering) = if index < degree {
        (0..reach, 0..degree + 1)
    } else if index + degree >= count {
        (count - reach..count, count - degree - 1..count)
    } else {
        return Ok(vec![(index, 1.0)]);
    };
    let mut weights = Vec::with_capacity(entering.len());
    // One conversion tells the weights of three vertices, one by each coordinate.
    for three in entering.clone().step_by(3) {
        let unit = window.clone().map(|other| {
            let is = |vertex: usize| f64::from(u8::from(other == vertex));
            DVec3::new(is(three), is(three + 1), is(three + 2))
        });
        let unit = FloatPolygon::new(degree, unit.collect(), None, false)?;
        let clamped = ClampedPolygon::from_float(&unit);
        let vertex = clamped.vertices().get(index - window.start);
        let values = vertex.map_or([0.0; 3], DVec3::to_array);
        let values = (three..entering.end).zip(values);
        weights.extend(values.map(|(vertex, value)| (vertex, value * polygon.weight(vertex))));
    }
    let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
    weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    Ok(weights)
}
