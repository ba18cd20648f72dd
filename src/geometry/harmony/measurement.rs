//! The harmony of a curve as a whole.

use super::events::{SequenceEvent, events};
use super::fairness::{Fairness, SegmentFairness};
use super::figures::HarmonyFigures;
use super::flow::{VertexFlow, VertexSequence};
use super::isogeometry::{Isogeometry, PolygonEvents};
use super::logarithmic_pieces::{LogarithmicPiece, logarithmic_pieces};
use super::regularity::Regularity;
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;

/// Roundings of a coordinate that a discrete curvature or torsion may be off by.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// Hold the harmony of a float polygon and its curve, in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmony {
    /// Evenness of the polygon.
    pub figures: HarmonyFigures,
    /// Whether the discrete curvature has the extrema and zeros of the curvature.
    pub curvature: Isogeometry,
    /// Whether the discrete torsion has the extrema and zeros of the torsion; `None` in a plane.
    pub torsion: Option<Isogeometry>,
    /// To which order the polygon is regular.
    pub regularity: Regularity,
    /// The fairness of the curve.
    pub fairness: Fairness,
    /// The slope of the logarithmic curvature graph on each monotone piece of the curvature.
    pub slopes: Vec<LogarithmicPiece>,
}

impl Harmony {
    /// Measure the harmony of a polygon with the proved features of its curve.
    pub fn of(polygon: &FloatPolygon, features: &Features) -> Self {
        Self::assemble(polygon, features, &SegmentFairness::all(polygon))
    }

    /// Put the harmony together with the fairness of all segments, in time proportional to the
    /// number of vertices.
    pub fn assemble(
        polygon: &FloatPolygon,
        features: &Features,
        segments: &[SegmentFairness],
    ) -> Self {
        let flow = VertexFlow::of(polygon);
        let around = |events, middle: f64| PolygonEvents {
            events,
            shift: polygon.greville(0) + middle,
            period: polygon.is_periodic().then_some(polygon.segments() as f64),
            reach: 0.5 * (polygon.degree() + 1) as f64,
        };
        let curvatures = around(curvature_events(polygon, &flow.curvatures), 0.0);
        let torsion = flow.torsions.as_ref().map(|torsions| {
            let torsions = around(torsion_events(polygon, torsions), 0.5);
            Isogeometry::of_torsion(&torsions, features)
        });
        Self {
            figures: HarmonyFigures::of(&flow, &curvatures.events),
            curvature: Isogeometry::of_curvature(&curvatures, features),
            torsion,
            regularity: Regularity::of(polygon),
            fairness: fairness(polygon, features, segments),
            slopes: logarithmic_pieces(polygon, polygon.is_planar(), features, segments),
        }
    }

    /// The longest piece, by its parameters, of which a slope is known.
    pub fn longest_slope(&self) -> Option<LogarithmicPiece> {
        let length = |piece: &&LogarithmicPiece| piece.u[1] - piece.u[0];
        let longest =
            |a: &&LogarithmicPiece, b: &&LogarithmicPiece| length(a).total_cmp(&length(b));
        self.slopes.iter().max_by(longest).copied()
    }
}

/// The fairness of the curve; it leaves out the curvature at a cusp.
fn fairness(polygon: &FloatPolygon, features: &Features, segments: &[SegmentFairness]) -> Fairness {
    let fairness = Fairness::of(segments, polygon.degree() - 1);
    if features.cusps.is_empty() {
        return fairness;
    }
    Fairness {
        bending_energy: None,
        variation: None,
        ..fairness
    }
}

/// The extrema and changes of sign of the discrete curvature. Vertices are rounded numbers: what
/// their last digits may make of it is no extremum.
fn curvature_events(polygon: &FloatPolygon, sequence: &VertexSequence) -> Vec<SequenceEvent> {
    let count = polygon.vertices().len();
    let rounding = (0..sequence.values().len()).map(|place| {
        let vertex = sequence.vertex(place) + count;
        let [before, at, after] =
            [vertex - 1, vertex, vertex + 1].map(|i| polygon.vertex(i % count));
        let largest = [before, at, after].map(|vertex| vertex.abs().max_element());
        let chord = 0.5 * before.distance(after);
        ROUNDINGS * largest.into_iter().fold(0.0, f64::max) / chord / chord
    });
    events(sequence, &rounding.collect::<Vec<_>>())
}

/// The extrema and changes of sign of the discrete torsion, likewise.
fn torsion_events(polygon: &FloatPolygon, sequence: &VertexSequence) -> Vec<SequenceEvent> {
    let count = polygon.vertices().len();
    let rounding = (0..sequence.values().len()).map(|place| {
        let vertex = sequence.vertex(place) + count;
        let [before, start, end, after] =
            [vertex - 1, vertex, vertex + 1, vertex + 2].map(|i| polygon.vertex(i % count));
        let largest = [before, start, end, after].map(|vertex| vertex.abs().max_element());
        let legs = [start - before, end - start, after - end];
        let longest = legs.map(|leg| leg.length()).into_iter().fold(0.0, f64::max);
        // D₁ × D₂, by which the torsion is divided twice.
        let normal = legs[1].cross(0.5 * (legs[2] - legs[0])).length();
        let torsion = sequence.values()[place].abs();
        let error = longest / normal * (longest / normal + torsion);
        ROUNDINGS * largest.into_iter().fold(0.0, f64::max) * error
    });
    events(sequence, &rounding.collect::<Vec<_>>())
}
