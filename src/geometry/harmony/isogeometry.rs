//! Second-order isogeometry: whether the discrete curvature of a polygon does what the curvature of
//! its curve does.

use super::events::{Event, SequenceEvent};
use crate::geometry::features::{Extremum, ExtremumKind, Feature, Features, Root};

/// Numbers of events of a curvature or torsion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EventCounts {
    /// Extrema.
    pub extrema: usize,
    /// Changes of sign: of the curvature of a planar curve, inflections.
    pub sign_changes: usize,
}

/// Compare the extrema and changes of sign of a polygon's discrete curvature, or torsion, with the
/// proved ones of its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isogeometry {
    /// Those of the polygon, at all of its inner vertices.
    pub polygon: EventCounts,
    /// Those of the curve.
    pub curve: EventCounts,
    /// Result of the comparison.
    pub verdict: Match,
}

/// Say whether two sequences of extrema and changes of sign agree in number and order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Match {
    /// They do.
    Agrees,
    /// They do not, and this is the first that has no counterpart.
    Differs(Mismatch),
    /// Unknown: the features on this piece of the curve are undecided.
    Undecided([f64; 2]),
}

/// Hold an extremum or change of sign without a counterpart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mismatch {
    /// The polygon has it at this vertex, and the curve does not.
    OfPolygon {
        /// The event.
        event: Event,
        /// The vertex, counted from 0; of a change of sign between vertices the one before.
        vertex: usize,
    },
    /// The curve has it at this parameter, and the polygon does not.
    OfCurve {
        /// The event.
        event: Event,
        /// The parameter.
        u: f64,
    },
}

/// The sequence of a polygon, and how it belongs to its curve.
pub(super) struct PolygonEvents {
    /// In the order of vertices.
    pub(super) events: Vec<SequenceEvent>,
    /// Offset from a vertex's number to its parameter on the curve.
    pub(super) shift: f64,
    /// The number of vertices of a periodic polygon: its sequence goes round.
    pub(super) period: Option<f64>,
    /// Reach of a vertex along the curve, in parameters.
    pub(super) reach: f64,
}

/// Event of the curve at a parameter.
#[derive(Clone, Copy)]
struct CurveEvent {
    event: Event,
    u: f64,
}

impl Isogeometry {
    /// Compare the discrete curvature with the proved features of the curve.
    pub(super) fn of_curvature(polygon: &PolygonEvents, features: &Features) -> Self {
        let kinds = [Feature::CurvatureExtremum, Feature::Inflection];
        let curve = curve_events(&features.curvature_extrema, &features.inflections);
        Self::compare(polygon, &curve, doubt(features, kinds))
    }

    /// Compare the discrete torsion with the proved features of the curve.
    pub(super) fn of_torsion(polygon: &PolygonEvents, features: &Features) -> Self {
        let kinds = [Feature::TorsionExtremum, Feature::TorsionZero];
        let curve = curve_events(&features.torsion_extrema, &features.torsion_zeros);
        Self::compare(polygon, &curve, doubt(features, kinds))
    }

    fn compare(polygon: &PolygonEvents, curve: &[CurveEvent], doubt: Option<[f64; 2]>) -> Self {
        let own = polygon.along_the_curve();
        let verdict = match doubt {
            Some(piece) => Match::Undecided(piece),
            None if agrees(&own, curve, polygon.period.is_some()) => Match::Agrees,
            None => first_mismatch(&own, curve, polygon),
        };
        Self {
            polygon: count(own.iter().map(|event| event.event)),
            curve: count(curve.iter().map(|event| event.event)),
            verdict,
        }
    }
}

impl PolygonEvents {
    /// The sequence in the order of parameters.
    fn along_the_curve(&self) -> Vec<CurveEvent> {
        let place = |at: f64| match self.period {
            Some(period) => (at + self.shift).rem_euclid(period),
            None => at + self.shift,
        };
        let events = self.events.iter();
        let mut events: Vec<CurveEvent> = events
            .map(|event| CurveEvent {
                event: event.event,
                u: place(event.at),
            })
            .collect();
        events.sort_by(|a, b| a.u.total_cmp(&b.u));
        events
    }

    /// The vertex at or before a parameter of the sequence.
    fn vertex(&self, u: f64) -> usize {
        let at = u - self.shift;
        // The shift is exact to a half, and so is their sum.
        self.period.map_or(at, |period| at.rem_euclid(period)) as usize
    }
}

/// The first piece of the curve on which features of some kinds are not known.
fn doubt(features: &Features, kinds: [Feature; 2]) -> Option<[f64; 2]> {
    let doubts = features.undecided.iter();
    let doubts = doubts.filter(|doubt| kinds.contains(&doubt.quantity));
    let cusps = features.cusps.iter().map(|cusp| cusp.u);
    let pieces = doubts.map(|doubt| doubt.u).chain(cusps);
    pieces.min_by(|a, b| a[0].total_cmp(&b[0]))
}

fn curve_events(extrema: &[Extremum], roots: &[Root]) -> Vec<CurveEvent> {
    let at = |event, [low, high]: [f64; 2]| CurveEvent {
        event,
        u: 0.5 * (low + high),
    };
    let turned = |kind| match kind {
        ExtremumKind::Maximum => ExtremumKind::Minimum,
        ExtremumKind::Minimum => ExtremumKind::Maximum,
    };
    let extrema = extrema.iter().flat_map(|extremum| {
        let kinds = [extremum.kind, turned(extremum.kind)];
        let kinds = kinds.into_iter().cycle().take(extremum.count);
        kinds.map(|kind| at(Event::Extremum(kind), extremum.u))
    });
    let roots = roots
        .iter()
        .flat_map(|root| std::iter::repeat_n(at(Event::SignChange, root.u), root.count));
    let mut events: Vec<CurveEvent> = extrema.chain(roots).collect();
    events.sort_by(|a, b| a.u.total_cmp(&b.u));
    events
}

fn count(events: impl Iterator<Item = Event>) -> EventCounts {
    let mut counts = EventCounts::default();
    for event in events {
        match event {
            Event::Extremum(_) => counts.extrema += 1,
            Event::SignChange => counts.sign_changes += 1,
        }
    }
    counts
}

/// Whether two sequences are the same; those that go round may begin anywhere.
fn agrees(polygon: &[CurveEvent], curve: &[CurveEvent], round: bool) -> bool {
    let count = polygon.len();
    let is_turned = |by: usize| {
        let turned = polygon.iter().cycle().skip(by);
        turned.zip(curve).all(|(a, b)| a.event == b.event)
    };
    let turns = if round { count.max(1) } else { 1 };
    count == curve.len() && (0..turns).any(is_turned)
}

/// Walk along two sequences that differ, and find the first of either without a counterpart: the
/// next of the other is of another kind, or farther away than the curve feels a vertex.
fn first_mismatch(own: &[CurveEvent], curve: &[CurveEvent], polygon: &PolygonEvents) -> Match {
    let near =
        |a: &CurveEvent, b: &CurveEvent| a.event == b.event && (a.u - b.u).abs() <= polygon.reach;
    let alike = own
        .iter()
        .zip(curve)
        .take_while(|(a, b)| near(a, b))
        .count();
    let of_polygon = |event: &CurveEvent| Mismatch::OfPolygon {
        event: event.event,
        vertex: polygon.vertex(event.u),
    };
    let of_curve = |event: &CurveEvent| Mismatch::OfCurve {
        event: event.event,
        u: event.u,
    };
    match (own.get(alike), curve.get(alike)) {
        (Some(a), Some(b)) if b.u < a.u => Match::Differs(of_curve(b)),
        (Some(a), _) => Match::Differs(of_polygon(a)),
        (None, Some(b)) => Match::Differs(of_curve(b)),
        // Sequences without a difference agree.
        (None, None) => Match::Agrees,
    }
}
