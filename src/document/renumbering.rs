//! Renumbering: where the vertices, locks and places of a curve go when an edit gives it another number of
//! vertices, another degree or another direction.

use super::curve::Curve;
use super::end_match::{EndMatch, MatchPlace};
use super::locked_vertices::LockedVertices;
use crate::geometry::{End, FloatPolygon};

/// Map the numbers of a curve's vertices and its parameters to those of the polygon that replaces its own.
///
/// [`Edit::Renumber`](super::Edit::Renumber) applies it to the curve's locks and to the matches at its places; a map
/// that reverses the curve also swaps its targets and matched ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Renumbering {
    locked_vertices: LockedVertices,
    spans: Vec<ParameterSpan>,
    /// The places of the old start and the old end.
    ends: [MatchPlace; 2],
    /// The number of segments of the new polygon, and whether it is periodic.
    segments: f64,
    is_periodic: bool,
}

/// A range of old parameters u with the new parameters of its limits; linear between them.
///
/// `new` falls where the curve is reversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterSpan {
    /// The old parameters, rising.
    pub old: [f64; 2],
    /// Their new values. On a periodic curve they may lie past the last segment.
    pub new: [f64; 2],
}

impl ParameterSpan {
    /// Shift a range of parameters.
    pub fn shifted(old: [f64; 2], by: f64) -> Self {
        let new = old.map(|u| u + by);
        Self { old, new }
    }

    /// Map a parameter; `None` outside of the range. A pure shift is exact to one rounding.
    fn place(&self, u: f64) -> Option<f64> {
        let Self {
            old: [from, to],
            new: [new_from, new_to],
        } = *self;
        if !(from..=to).contains(&u) {
            return None;
        }
        Some(if new_to - new_from == to - from {
            u + (new_from - from)
        } else {
            new_from + (u - from) / (to - from) * (new_to - new_from)
        })
    }
}

impl Renumbering {
    /// Map the parameters of a curve to those of a polygon with the same shape, or with a part of it.
    ///
    /// Places outside of all spans are gone. A lock goes with a vertex that the new polygon has too: the same point
    /// with the same weight. Ends stay ends; on a periodic polygon they become parameters.
    pub fn of_parameters(curve: &Curve, to: &FloatPolygon, spans: Vec<ParameterSpan>) -> Self {
        let is_turned = is_turned(&spans);
        let mut renumbering = Self {
            locked_vertices: curve.locked_vertices.carried(&curve.polygon, to),
            spans,
            ends: End::BOTH.map(|end| MatchPlace::End(if is_turned { end.other() } else { end })),
            segments: to.segments() as f64,
            is_periodic: to.is_periodic(),
        };
        if to.is_periodic() {
            let old = [0.0, curve.polygon.segments() as f64];
            for (end, u) in End::BOTH.into_iter().zip(old) {
                if let Some(place) = renumbering.place(MatchPlace::Parameter(u)) {
                    renumbering = renumbering.with_end(end, place);
                }
            }
        }
        renumbering
    }

    /// Map the vertices of a curve by their numbers; `number` gives the new number of an old vertex, `None` if it is
    /// gone. Numbers rise.
    ///
    /// A place keeps its position between the Greville abscissae u = i − (n − 1)/2 of the vertices that remain, so
    /// segments whose vertices all remain keep their places exactly. Places past an end go to the end.
    pub fn of_vertices(
        curve: &Curve,
        to: &FloatPolygon,
        number: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let kept = 0..curve.polygon.vertices().len();
        let kept: Vec<(usize, usize)> = kept.filter_map(|i| Some((i, number(i)?))).collect();
        let spans = vertex_spans(&curve.polygon, to, &kept);
        let locked_vertices = curve.locked_vertices.renumbered(number);
        Self::of_parameters(curve, to, spans).with_locked_vertices(locked_vertices)
    }

    /// Map a curve to itself, run through the other way.
    pub fn reversed(curve: &Curve) -> Self {
        let polygon = &curve.polygon;
        let (last, segments) = (polygon.vertices().len() - 1, polygon.segments() as f64);
        let span = ParameterSpan {
            old: [0.0, segments],
            new: [segments, 0.0],
        };
        let locked = &curve.locked_vertices;
        let locked = locked.renumbered(|vertex| last.checked_sub(vertex));
        Self::of_parameters(curve, polygon, vec![span]).with_locked_vertices(locked)
    }

    /// Lock other vertices of the new polygon instead.
    pub fn with_locked_vertices(self, locked_vertices: LockedVertices) -> Self {
        Self {
            locked_vertices,
            ..self
        }
    }

    /// Put an end of the curve at another place, such as a parameter where curves are joined.
    pub fn with_end(mut self, end: End, place: MatchPlace) -> Self {
        match (end, &mut self.ends) {
            (End::Start, [old, _]) | (End::Finish, [_, old]) => *old = place,
        }
        self
    }

    /// The vertices of the new polygon that are locked.
    pub fn locked_vertices(&self) -> &LockedVertices {
        &self.locked_vertices
    }

    /// Find a place of the old curve on the new one; `None` if it is gone.
    pub fn place(&self, place: MatchPlace) -> Option<MatchPlace> {
        let [start, finish] = self.ends;
        match place {
            MatchPlace::End(End::Start) => Some(start),
            MatchPlace::End(End::Finish) => Some(finish),
            MatchPlace::Parameter(u) => {
                let new = self.spans.iter().find_map(|span| span.place(u))?;
                let inside = 0.0..=self.segments;
                Some(MatchPlace::Parameter(match self.is_periodic {
                    true if !inside.contains(&new) => new.rem_euclid(self.segments),
                    true => new,
                    false => new.clamp(0.0, self.segments),
                }))
            }
        }
    }

    /// Whether the new curve runs the other way.
    pub fn is_turned(&self) -> bool {
        is_turned(&self.spans)
    }

    /// Map a match at a place of the curve; `None` if the place is gone.
    pub(super) fn of_source(&self, matched: &EndMatch) -> Option<EndMatch> {
        let place = self.place(matched.place)?;
        let reversed = matched.reversed != self.is_turned();
        Some(EndMatch {
            place,
            reversed,
            ..*matched
        })
    }

    /// Map a match of one of the curve's own ends.
    pub(super) fn of_end(&self, matched: &EndMatch) -> EndMatch {
        if !self.is_turned() {
            return *matched;
        }
        EndMatch {
            end: matched.end.other(),
            reversed: !matched.reversed,
            ..*matched
        }
    }
}

fn is_turned(spans: &[ParameterSpan]) -> bool {
    let first = spans.first();
    first.is_some_and(
        |ParameterSpan {
             new: [from, to], ..
         }| to < from,
    )
}

/// The spans between the Greville abscissae of the vertices that remain, over all of the old curve. Neighbouring
/// spans with the same shift are one.
fn vertex_spans(
    from: &FloatPolygon,
    to: &FloatPolygon,
    kept: &[(usize, usize)],
) -> Vec<ParameterSpan> {
    let [before, after] = [from, to].map(|polygon| polygon.vertices().len() as f64);
    let offset = |polygon: &FloatPolygon| 0.5 * (polygon.degree() as f64 - 1.0);
    let [old_offset, new_offset] = [offset(from), offset(to)];
    let last = from.segments() as f64;
    // A periodic polygon goes on before its first vertex and behind its last.
    let turns: &[f64] = match from.is_periodic() {
        true => &[-1.0, 0.0, 1.0],
        false => &[0.0],
    };
    let mut points: Vec<[f64; 2]> = Vec::new();
    for turn in turns {
        points.extend(kept.iter().map(|(old, new)| {
            let old = *old as f64 + turn * before - old_offset;
            let new = *new as f64 + turn * after - new_offset;
            [old, new]
        }));
    }
    // Before the first and behind the last of them parameters are shifted.
    let ends = [points.first().copied(), points.last().copied()];
    let [Some([first, _]), Some([end, _])] = ends else {
        return Vec::new();
    };
    let shifted = |u: f64, [old, new]: [f64; 2]| [u, u + (new - old)];
    if first > 0.0 {
        let point = shifted(0.0, points[0]);
        points.insert(0, point);
    }
    if end < last {
        points.extend(points.last().map(|point| shifted(last, *point)));
    }
    let mut spans: Vec<ParameterSpan> = Vec::new();
    for pair in points.windows(2) {
        let [[old_from, new_from], [old_to, new_to]] = [pair[0], pair[1]];
        if old_to < 0.0 || old_from > last {
            continue;
        }
        let slope_one = new_to - new_from == old_to - old_from;
        match spans.last_mut() {
            Some(span) if slope_one && span.new[1] - span.new[0] == span.old[1] - span.old[0] => {
                (span.old[1], span.new[1]) = (old_to, new_to);
            }
            _ => spans.push(ParameterSpan {
                old: [old_from, old_to],
                new: [new_from, new_to],
            }),
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(degree: usize, count: usize, periodic: bool) -> FloatPolygon {
        let vertices = (0..count).map(|i| {
            let angle = i as f64;
            glam::DVec3::new(angle.cos(), angle.sin(), 0.0)
        });
        FloatPolygon::new(degree, vertices.collect(), None, periodic).expect("a polygon")
    }

    fn parameter(renumbering: &Renumbering, u: f64) -> Option<f64> {
        match renumbering.place(MatchPlace::Parameter(u)) {
            Some(MatchPlace::Parameter(u)) => Some(u),
            Some(MatchPlace::End(end)) => panic!("{end:?} is no parameter"),
            None => None,
        }
    }

    /// Where the vertices of a segment all remain, side by side, its places are the same points afterwards.
    #[test]
    fn places_of_segments_that_stay_are_the_same_points() {
        for (degree, count, periodic) in [(1, 5, false), (3, 9, false), (4, 9, true), (5, 12, true)]
        {
            let curve = Curve::new("a", polygon(degree, count, periodic));
            let from = &curve.polygon;
            for index in 0..=count {
                let mut vertices = from.vertices().to_vec();
                vertices.insert(index, glam::DVec3::ZERO);
                let to = FloatPolygon::new(degree, vertices, None, periodic).expect("a polygon");
                let inserted =
                    Renumbering::of_vertices(&curve, &to, |i| Some(i + usize::from(i >= index)));
                let back = Curve::new("b", to.clone());
                let removed = Renumbering::of_vertices(&back, from, |i| match i {
                    i if i == index => None,
                    i => Some(i - usize::from(i > index)),
                });
                let mut stayed = 0;
                for segment in 0..from.segments() {
                    let u = segment as f64 + 0.375;
                    let new = parameter(&inserted, u).expect("a place");
                    let own = (segment..=segment + degree).map(|i| i % count);
                    let own: Vec<usize> = own.collect();
                    let is_split = own
                        .windows(2)
                        .any(|pair| pair[1] == index && pair[0] + 1 == index)
                        || own
                            .windows(2)
                            .any(|pair| index == count && pair == [count - 1, 0])
                        || own
                            .windows(2)
                            .any(|pair| index == 0 && pair == [count - 1, 0]);
                    if is_split {
                        continue;
                    }
                    stayed += 1;
                    assert_eq!(from.point(u), to.point(new), "{degree} {count} {index} {u}");
                    assert_eq!(parameter(&removed, new), Some(u));
                }
                assert!(stayed > 0);
            }
        }
    }

    #[test]
    fn another_degree_keeps_the_place_among_the_vertices() {
        let curve = Curve::new("a", polygon(3, 9, false));
        let to = polygon(4, 9, false);
        let renumbering = Renumbering::of_vertices(&curve, &to, Some);
        // Greville abscissae are i − 1 at degree 3 and i − 3/2 at degree 4.
        assert_eq!(parameter(&renumbering, 3.0), Some(2.5));
        assert_eq!(
            parameter(&renumbering, 0.0),
            Some(0.0),
            "the end is the end"
        );
        assert_eq!(parameter(&renumbering, 6.0), Some(5.0));
    }

    #[test]
    fn places_that_are_cut_off_are_gone_and_ends_stay_ends() {
        let curve = Curve::new("a", polygon(3, 9, false));
        let part = ParameterSpan {
            old: [2.0, 4.0],
            new: [0.0, 2.0],
        };
        let to = polygon(3, 5, false);
        let renumbering = Renumbering::of_parameters(&curve, &to, vec![part]);
        assert_eq!(parameter(&renumbering, 1.9), None);
        assert_eq!(parameter(&renumbering, 2.5), Some(0.5));
        for end in End::BOTH {
            let place = MatchPlace::End(end);
            assert_eq!(renumbering.place(place), Some(place));
        }
    }

    #[test]
    fn the_ends_of_a_curve_that_is_made_periodic_become_parameters() {
        let curve = Curve::new("a", polygon(3, 9, false));
        let to = polygon(3, 9, true);
        let same = ParameterSpan::shifted([0.0, 6.0], 0.0);
        let renumbering = Renumbering::of_parameters(&curve, &to, vec![same]);
        let places = End::BOTH.map(|end| renumbering.place(MatchPlace::End(end)));
        let expected = [0.0, 6.0].map(|u| Some(MatchPlace::Parameter(u)));
        assert_eq!(places, expected);
    }

    #[test]
    fn a_reversed_curve_has_its_places_mirrored() {
        let curve = Curve::new("a", polygon(3, 9, false));
        let renumbering = Renumbering::reversed(&curve);
        assert!(renumbering.is_turned());
        assert_eq!(parameter(&renumbering, 1.5), Some(4.5));
        let start = renumbering.place(MatchPlace::End(End::Start));
        assert_eq!(start, Some(MatchPlace::End(End::Finish)));
    }
}
