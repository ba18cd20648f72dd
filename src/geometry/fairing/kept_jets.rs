//! Points and derivatives at ends kept while some vertices move: a linear system, so that the other vertices
//! move in proportion. Half a drag makes half the change, and none jumps.

use std::collections::BTreeSet;
use std::ops::Range;

use glam::DVec3;

use super::jet_weights::JetWeights;
use crate::geometry::continuity::Continuity;
use crate::geometry::end::End;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::pivoted_cholesky::PivotedCholesky;

/// How far a vertex may go for each unit of the given moves; beyond, its neighbours seem to be dragged, the other way.
/// One dragged vertex of a curve without weights needs up to 2.5, but for the middle ones where few vertices are left:
/// by degree 4 at G1 and G2 (4), 5 at G2 and G3 (7), 6 and 8 at G3 (12, 4).
const FARTHEST: f64 = 2.6;

/// What counts as dependent among conditions of length 1. A pivot below would lose half of all digits.
const DEPENDENT: f64 = 1e-14;

/// Keep the point and the first derivatives at ends of an open curve, up to the order of each end's continuity, where
/// the curve was `before` some of its vertices moved.
///
/// The moved vertices and the `held` ones stay. Of the others, the n terminal vertices of each end and up to n
/// more inwards move by δ with the least Σ|δ|² + Σ|Δδ|² under Σ w⁽ʳ⁾δ = −Σ w⁽ʳ⁾d, with the moves d and the
/// weights w⁽ʳ⁾ of the vertices in the derivative r. An end that is not listed keeps the point and first
/// derivative that it has now.
///
/// `None` if no vertex moved, if the others cannot keep what is asked, or only by more than 2.6 times the moves.
pub fn with_kept_jets(
    polygon: &FloatPolygon,
    before: &FloatPolygon,
    kept: &[(End, Continuity)],
    held: &[usize],
) -> Option<FloatPolygon> {
    let moved = polygon.moved_vertices(before);
    if moved.is_empty() || polygon.is_periodic() {
        return None;
    }
    let fixed: BTreeSet<usize> = moved.iter().chain(held).copied().collect();
    let near: BTreeSet<usize> = kept
        .iter()
        .flat_map(|(end, _)| near(polygon, *end))
        .collect();
    let free: Vec<usize> = near.difference(&fixed).copied().collect();
    let conditions = conditions(polygon, kept, &free)?;
    let answer = Answer::new(polygon, &conditions, &free)?;

    let by = |index: usize| polygon.vertex(index) - before.vertex(index);
    let moves: Vec<(usize, DVec3)> = moved.iter().map(|index| (*index, by(*index))).collect();
    let farthest = answer.farthest(&conditions, &moved);
    if farthest > FARTHEST {
        return None;
    }
    let sums = conditions.iter().map(|condition| condition.sum(&moves));
    let changes = answer.moves(&sums.collect::<Vec<_>>());
    let mut whole = polygon.clone();
    let places = free.iter().zip(changes);
    let places: Vec<_> = places
        .map(|(index, change)| (*index, polygon.vertex(*index) + change))
        .collect();
    whole.move_vertices(places).ok()?;
    Some(whole)
}

/// The terminal vertices of an end and up to as many more inwards, before those of the other end.
fn near(polygon: &FloatPolygon, end: End) -> Range<usize> {
    let [own, other] = [end, end.other()].map(|end| polygon.terminal_vertices(end));
    let more = polygon.degree();
    match end {
        End::Start => 0..(own.end + more).min(other.start).max(own.end),
        End::Finish => own.start.saturating_sub(more).max(other.end).min(own.start)..own.end,
    }
}

/// Keep a sum Σ weight · vertex.
struct Condition {
    /// The weights of the free vertices, of length 1.
    free: Vec<f64>,
    /// Those of the vertices whose moves count.
    given: Vec<(usize, f64)>,
}

impl Condition {
    /// `None` if the free vertices have no weight.
    fn new(weights: Vec<(usize, f64)>, free: &[usize]) -> Option<Self> {
        let own: Vec<f64> = free.iter().map(|it| weight(&weights, *it)).collect();
        let length = dot(&own, &own).sqrt();
        let given = weights.iter().map(|(index, own)| (*index, own / length));
        (length > 0.0).then(|| Self {
            free: own.iter().map(|weight| weight / length).collect(),
            given: given.collect(),
        })
    }

    /// The condition by which moves of other vertices count for nothing.
    fn without_given(self) -> Self {
        Self {
            given: Vec::new(),
            ..self
        }
    }

    /// What given moves change.
    fn sum(&self, moves: &[(usize, DVec3)]) -> DVec3 {
        let terms = moves.iter();
        terms
            .map(|(index, by)| weight(&self.given, *index) * *by)
            .sum()
    }
}

fn weight(weights: &[(usize, f64)], index: usize) -> f64 {
    let own = weights.iter().find(|(vertex, _)| *vertex == index);
    own.map_or(0.0, |(_, weight)| *weight)
}

/// The conditions at both ends on the free vertices; `None` if one has no weight on them.
fn conditions(
    polygon: &FloatPolygon,
    kept: &[(End, Continuity)],
    free: &[usize],
) -> Option<Vec<Condition>> {
    let mut conditions = Vec::new();
    for end in End::BOTH {
        let listed = kept.iter().find(|(other, _)| *other == end);
        let terminal = polygon.terminal_vertices(end);
        if listed.is_none() && !free.iter().any(|index| terminal.contains(index)) {
            continue;
        }
        let continuity = listed.map_or(Continuity::G1, |(_, continuity)| *continuity);
        let weights = JetWeights::at(polygon, end.parameter(polygon));
        for order in 0..=(continuity as usize).min(polygon.degree()) {
            let condition = Condition::new(weights.terms(order).collect(), free)?;
            conditions.push(match listed {
                Some(_) => condition,
                None => condition.without_given(),
            });
        }
    }
    Some(conditions)
}

/// The moves of the free vertices that make each condition's sum 1 and the others' 0.
struct Answer {
    /// For each condition one number for each free vertex.
    columns: Vec<Vec<f64>>,
}

impl Answer {
    /// δ = Q⁻¹Aᵀ(AQ⁻¹Aᵀ)⁻¹b, with Q of the squares and differences.
    fn new(polygon: &FloatPolygon, conditions: &[Condition], free: &[usize]) -> Option<Self> {
        let last = polygon.vertices().len() - 1;
        let square = |row: usize, column: usize| match free[row].abs_diff(free[column]) {
            0 => {
                1.0 + [free[row] > 0, free[row] < last]
                    .map(f64::from)
                    .iter()
                    .sum::<f64>()
            }
            1 => -1.0,
            _ => 0.0,
        };
        let factor = PivotedCholesky::new(free.len(), square, DEPENDENT)?;
        let solved: Vec<Vec<f64>> = conditions
            .iter()
            .map(|condition| factor.solve(&condition.free))
            .collect();
        let count = conditions.len();
        let entry = |row: usize, column: usize| dot(&conditions[row].free, &solved[column]);
        let gram = PivotedCholesky::new(count, entry, DEPENDENT)?;
        if gram.rank() < count {
            return None;
        }
        let columns = (0..count).map(|condition| {
            let one: Vec<f64> = (0..count).map(|it| f64::from(it == condition)).collect();
            let factors = gram.solve(&one);
            let moves = (0..free.len()).map(|vertex| {
                let terms = factors.iter().zip(&solved);
                terms.map(|(factor, column)| factor * column[vertex]).sum()
            });
            moves.collect()
        });
        Some(Self {
            columns: columns.collect(),
        })
    }

    /// The moves that take the sums back.
    fn moves(&self, sums: &[DVec3]) -> Vec<DVec3> {
        let count = self.columns.first().map_or(0, Vec::len);
        let of_vertex = |vertex: usize| {
            let terms = self.columns.iter().zip(sums);
            terms.map(|(column, sum)| -column[vertex] * *sum).sum()
        };
        (0..count).map(of_vertex).collect()
    }

    /// The largest move of a free vertex if none of the `moved` ones goes farther than 1.
    fn farthest(&self, conditions: &[Condition], moved: &[usize]) -> f64 {
        let count = self.columns.first().map_or(0, Vec::len);
        let of_vertex = |vertex: usize| -> f64 {
            let by_one = |index: &usize| {
                let terms = self.columns.iter().zip(conditions);
                let move_of: f64 = terms
                    .map(|(column, condition)| column[vertex] * weight(&condition.given, *index))
                    .sum();
                move_of.abs()
            };
            moved.iter().map(by_one).sum()
        };
        (0..count).map(of_vertex).fold(0.0, f64::max)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave of N vertices.
    fn wave(degree: usize, count: usize, weights: bool) -> FloatPolygon {
        let vertices = (0..count).map(|index| {
            let at = index as f64;
            DVec3::new(at, (0.7 * at).sin(), 0.2 * (0.4 * at).cos())
        });
        let weights = weights.then(|| (0..count).map(|it| 1.0 + 0.3 * (it % 3) as f64).collect());
        FloatPolygon::new(degree, vertices.collect(), weights, false).expect("a polygon")
    }

    fn moved(polygon: &FloatPolygon, index: usize, by: DVec3) -> FloatPolygon {
        let mut moved = polygon.clone();
        let place = polygon.vertex(index) + by;
        moved.move_vertices([(index, place)]).expect("a place");
        moved
    }

    #[test]
    fn derivatives_stay_and_moves_are_in_proportion() {
        let by = DVec3::new(0.3, 0.4, -0.2);
        let mut kept_all = 0;
        for (degree, end, continuity, weights) in (3..=8)
            .flat_map(|degree| End::BOTH.map(|end| (degree, end)))
            .flat_map(|(degree, end)| Continuity::ALL.map(|it| (degree, end, it)))
            .flat_map(|(a, b, c)| [false, true].map(|weights| (a, b, c, weights)))
        {
            let before = wave(degree, 3 * degree, weights);
            for index in before.terminal_vertices(end) {
                let kept = |by: DVec3| {
                    let moved = moved(&before, index, by);
                    with_kept_jets(&moved, &before, &[(end, continuity)], &[])
                };
                let (Some(whole), Some(half)) = (kept(by), kept(0.5 * by)) else {
                    continue;
                };
                kept_all += 1;
                assert_eq!(whole.vertex(index), before.vertex(index) + by);
                let weights = JetWeights::at(&before, end.parameter(&before));
                let [now, then] = [&whole, &before].map(|it| weights.jet(it.vertices()));
                for order in 0..=continuity as usize {
                    let missed = (now[order] - then[order]).length();
                    assert!(
                        missed <= 1e-12,
                        "{degree} {end:?} {continuity:?} {index}: {missed}"
                    );
                }
                for vertex in 0..before.vertices().len() {
                    let [all, part] =
                        [&whole, &half].map(|it| it.vertex(vertex) - before.vertex(vertex));
                    assert!((0.5 * all - part).length() <= 1e-13);
                    assert!(all.length() <= FARTHEST * by.length() * (1.0 + 1e-12));
                }
            }
        }
        // All but those that leave too few vertices, or would send others far.
        println!("{kept_all}");
        assert!(kept_all >= 350, "{kept_all}");
    }

    #[test]
    fn a_short_curve_keeps_both_ends() {
        let before = wave(4, 9, false);
        let moved = moved(&before, 3, DVec3::new(0.0, 0.5, 0.0));
        let kept = with_kept_jets(&moved, &before, &[(End::Start, Continuity::G2)], &[6]);
        let kept = kept.expect("there are enough vertices");
        assert_eq!(kept.vertex(6), before.vertex(6));
        let [now, then] = [&kept, &before].map(|it| it.end_jet(End::Finish));
        assert!((now.point - then.point).length() <= 1e-13);
        assert!((now.first - then.first).length() <= 1e-13);
    }

    #[test]
    fn none_where_too_few_vertices_are_left() {
        let before = wave(3, 9, false);
        let moved = moved(&before, 0, DVec3::Y);
        let kept = |held: &[usize]| {
            with_kept_jets(&moved, &before, &[(End::Start, Continuity::G1)], held).is_some()
        };
        assert!(kept(&[]));
        assert!(!kept(&[1]));
        assert!(with_kept_jets(&before, &before, &[(End::Start, Continuity::G1)], &[]).is_none());
    }
}
