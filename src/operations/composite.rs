//! Two curves that became one: where their vertices, ends, locks and matches go.

use super::error::OperationError;
use super::locks::halved;
use super::matches::{handed_over, without_match};
use crate::document::{
    Curve, CurveId, Document, Edit, EditError, EndMatch, MatchPlace, ParameterSpan, Renumbering,
    quoted,
};
use crate::geometry::approximation::merging::Track;
use crate::geometry::{End, FloatPolygon};

/// A curve with its identity.
pub(super) type Part<'a> = (CurveId, &'a Curve);

/// How the second curve lies in the composite.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    /// Whether it comes after the first.
    pub(super) follows: bool,
    /// Whether it runs the other way.
    pub(super) turned: bool,
}

/// The composite, with what it was made of.
pub(super) struct Composite<'a> {
    pub(super) document: &'a Document,
    pub(super) parts: [Part<'a>; 2],
    pub(super) ends: [End; 2],
    pub(super) layout: Layout,
    pub(super) polygon: &'a FloatPolygon,
    /// The second part in its direction and degree, where it was.
    pub(super) second: &'a FloatPolygon,
    /// How often the segments of each part were halved.
    pub(super) halvings: [usize; 2],
    /// Where points of both parts, the second in its direction, are on the composite; `None` where it has the
    /// vertices of both.
    pub(super) tracks: Option<&'a [Track; 2]>,
}

impl Composite<'_> {
    /// The numbers of the first vertices of both parts, which are the parameters of their starts; 0 where the
    /// composite has none of their vertices.
    fn offsets(&self) -> [usize; 2] {
        if self.tracks.is_some() {
            return [0; 2];
        }
        let length =
            |part: &FloatPolygon, halvings: usize| (part.segments() << halvings) + part.degree();
        let [of_first, of_second] = self.halvings;
        let count = self.polygon.vertices().len();
        if self.layout.follows {
            [0, count - length(self.second, of_second)]
        } else {
            [count - length(&self.parts[0].1.polygon, of_first), 0]
        }
    }

    /// By how much the parameters of a part run faster on the composite.
    fn pace(&self, part: usize) -> f64 {
        (1_usize << self.halvings[part]) as f64
    }

    /// Where a parameter of a part, the second in its direction, is on the composite.
    fn place(&self, part: usize, u: f64) -> f64 {
        let is_first = (part == 0) == self.layout.follows;
        match self.tracks {
            Some(tracks) => tracks[usize::from(!is_first)].at(u),
            None => self.offsets()[part] as f64 + self.pace(part) * u,
        }
    }

    pub(super) fn farthest_move(&self) -> f64 {
        let [_, offset] = self.offsets();
        let after = self.polygon.vertices().iter().skip(offset);
        let pairs = self.second.vertices().iter().zip(after);
        pairs.fold(0.0, |most, (a, b)| most.max(a.distance(*b)))
    }

    /// The first curve becomes the composite. Locks, targets and matches stay with their vertices,
    /// ends and places.
    pub(super) fn edits(&self) -> Vec<Edit> {
        let [(id, first), (other, second)] = self.parts;
        let [first_offset, second_offset] = self.offsets();
        let joined = self.ends[0];
        let own = |end| self.document.match_of(other, end);
        let mut edits: Vec<Edit> = Vec::new();
        edits.extend(without_match(self.document, id, joined));
        for end in End::BOTH {
            edits.extend(without_match(self.document, other, end));
        }
        let locked = &first.locked_vertices;
        let [of_first, of_second] = self.halvings;
        let locked = locked
            .renumbered(|vertex| Some(first_offset + halved(&first.polygon, of_first, vertex)));
        let segments = first.polygon.segments();
        let span = |old: [usize; 2]| {
            let old = old.map(|u| u as f64);
            let new = old.map(|u| self.place(0, u));
            ParameterSpan { old, new }
        };
        let spans = match self.tracks {
            Some(_) => (0..segments).map(|it| span([it, it + 1])).collect(),
            None => vec![span([0, segments])],
        };
        let inside = self.place(0, joined.parameter(&first.polygon));
        edits.push(Edit::Renumber {
            curve: id,
            polygon: self.polygon.clone(),
            renumbering: Renumbering::of_parameters(first, self.polygon, spans)
                .with_locked_vertices(locked)
                .with_end(joined, MatchPlace::Parameter(inside)),
        });
        let kept = second.locked_vertices.carried(&second.polygon, self.second);
        let kept = kept.iter();
        let kept = kept.map(|vertex| second_offset + halved(self.second, of_second, vertex));
        let kept: Vec<usize> = kept.collect();
        if !kept.is_empty() {
            edits.push(Edit::SetVerticesLocked {
                curve: id,
                vertices: kept,
                locked: true,
            });
        }
        // The free end of the second curve takes the place of the first one's joined end.
        let free = self.ends[1].other();
        let planar = second.polygon.is_planar();
        let target = second.targets.get(free);
        let target = target.map(|target| {
            if self.layout.turned {
                target.turned(planar)
            } else {
                target
            }
        });
        if target != first.targets.get(joined) {
            edits.push(Edit::SetTarget {
                curve: id,
                end: joined,
                target,
            });
        }
        let own = own(free).filter(|matched| matched.source != id);
        edits.extend(own.map(|matched| {
            Edit::SetMatch(EndMatch {
                curve: id,
                end: joined,
                reversed: matched.reversed != self.layout.turned,
                ..*matched
            })
        }));
        edits.extend(self.followers());
        edits.push(Edit::Remove(other));
        edits
    }

    /// The matches at places of the second curve, which are places of the composite then.
    fn followers(&self) -> Vec<Edit> {
        let [(id, _), (other, second)] = self.parts;
        let joined = self.ends[0];
        let length = second.polygon.segments() as f64;
        let within = |u: f64| {
            let u = if self.layout.turned { length - u } else { u };
            MatchPlace::Parameter(self.place(1, u))
        };
        let place = |place: MatchPlace| {
            Some(match place {
                MatchPlace::End(end) if end != self.ends[1] => MatchPlace::End(joined),
                MatchPlace::End(End::Start) => within(0.0),
                MatchPlace::End(End::Finish) => within(length),
                MatchPlace::Parameter(u) => within(u),
            })
        };
        // What the first curve followed of the second is part of the same curve now.
        let is_own = |edit: &Edit| matches!(edit, Edit::SetMatch(matched) if matched.curve == id);
        let mut followers = handed_over(self.document, [other, id], self.layout.turned, place);
        followers.retain(|edit| !is_own(edit));
        followers
    }
}

/// Remove the matches from some edits that would let curves follow each other in a circle; the texts name those
/// that no curve had before.
///
/// # Errors
/// [`OperationError::MatchCircle`] if there is such a match and `drops` is false.
pub(super) fn without_circles(
    document: &Document,
    edits: Vec<Edit>,
    drops: bool,
) -> Result<(Vec<Edit>, Vec<String>), OperationError> {
    let mut after = document.clone();
    let (mut kept, mut dropped) = (Vec::new(), Vec::new());
    for edit in edits {
        match (after.apply(edit.clone()), &edit) {
            (Err(EditError::MatchCycle { name, source_name }), Edit::SetMatch(matched)) => {
                if !drops {
                    return Err(OperationError::MatchCircle { name, source_name });
                }
                let (curve, end) = (matched.curve, matched.end);
                if after.match_of(curve, end).is_some() {
                    let remove = Edit::RemoveMatch { curve, end };
                    after.apply(remove.clone())?;
                    kept.push(remove);
                } else {
                    let [name, source] = [name, source_name].map(|name| quoted(&name));
                    dropped.push(format!("{name} does not follow {source}, which follows it"));
                }
            }
            (result, _) => {
                result?;
                kept.push(edit);
            }
        }
    }
    Ok((kept, dropped))
}
