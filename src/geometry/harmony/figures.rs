//! The harmony figures of a polygon.

use super::events::{Event, SequenceEvent};
use super::flow::{VertexFlow, VertexSequence};
use crate::geometry::float_polygon::FloatPolygon;

/// Hold a figure with the vertex that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexFigure {
    /// The figure.
    pub value: f64,
    /// The vertex's number, counted from 0.
    pub vertex: usize,
}

/// Hold how evenly the flow of a polygon's vertices runs: each figure at the vertex where it is
/// worst, `None` where there are too few vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HarmonyFigures {
    /// The largest |Δ² log leg|, natural logarithms, at the vertex where the middle leg begins;
    /// infinite at a leg without length.
    pub legs: Option<VertexFigure>,
    /// The largest |Δ² turning angle| in radians.
    pub turns: Option<VertexFigure>,
    /// The largest |Δ² torsion angle| in radians of a polygon in space, at the vertex where the
    /// middle leg begins.
    pub torsions: Option<VertexFigure>,
    /// Number of extrema of the discrete curvature; a plateau counts once.
    pub curvature_extrema: usize,
    /// The sharpest of them, with its |Δ²K|.
    pub sharpest: Option<VertexFigure>,
}

impl HarmonyFigures {
    /// Collect the figures of a flow; `events` are those of its discrete curvature.
    pub(super) fn of(flow: &VertexFlow, events: &[SequenceEvent]) -> Self {
        let extrema = events
            .iter()
            .filter(|event| matches!(event.event, Event::Extremum(_)));
        let vertices: Vec<usize> = extrema.map(|event| event.at as usize).collect();
        let sharpness = flow.curvatures.second_differences();
        // Both are in the order of vertices.
        let mut rest = vertices.iter().peekable();
        let at_extrema = sharpness.filter(|(vertex, _)| {
            while rest.next_if(|next| *next < vertex).is_some() {}
            rest.peek() == Some(&vertex)
        });
        Self {
            legs: largest(flow.legs.map(f64::ln).second_differences()),
            turns: worst(&flow.turns),
            torsions: flow.torsion_angles.as_ref().and_then(worst),
            curvature_extrema: vertices.len(),
            sharpest: largest(at_extrema),
        }
    }
}

/// How uneven a polygon is: the largest second differences of its turning angles, in radians, and of the logarithms of
/// its legs, added up. `None` of one with too few vertices for either; infinite at a leg without length.
pub fn unevenness(polygon: &FloatPolygon) -> Option<f64> {
    let flow = VertexFlow::of(polygon);
    let legs = largest(flow.legs.map(f64::ln).second_differences());
    let (turns, legs) = worst(&flow.turns).zip(legs)?;
    Some(turns.value + legs.value)
}

fn worst(sequence: &VertexSequence) -> Option<VertexFigure> {
    largest(sequence.second_differences())
}

/// The first of the numbers that are largest in magnitude; one that is none counts as infinite.
fn largest(numbers: impl Iterator<Item = (usize, f64)>) -> Option<VertexFigure> {
    numbers.fold(None, |largest: Option<VertexFigure>, (vertex, number)| {
        let value = if number.is_nan() {
            f64::INFINITY
        } else {
            number.abs()
        };
        let is_larger = largest.is_none_or(|largest| value > largest.value);
        if is_larger {
            Some(VertexFigure { value, vertex })
        } else {
            largest
        }
    })
}
