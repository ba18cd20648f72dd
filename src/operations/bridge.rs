//! What joining two curves and closing one share.

use std::f64::consts::PI;

use super::error::OperationError;
use super::outcome::{Annotation, Figure};
use super::parameter::{Kind, Parameter};
use super::value::Value;
use crate::geometry::fairing::bridging::{BridgeError, Bridged, MAX_BRIDGE, largest_jump};
use crate::geometry::parameters::Quantity;
use crate::geometry::{BezierPolygon, FloatPolygon, largest_curvature, significant};

/// How many vertices a bridge has.
pub(super) const BRIDGE: Parameter = Parameter {
    name: "bridge",
    label: "Bridge vertices",
    help: "Vertices of the bridge; automatic: the number that makes legs and angles most even",
    kind: Kind::optional_count(MAX_BRIDGE, false, |_| "automatic"),
};

/// Refuse what was cancelled as every operation does.
///
/// # Errors
/// [`OperationError`].
pub(super) fn found(result: Result<Bridged, BridgeError>) -> Result<Bridged, OperationError> {
    result.map_err(|error| match error {
        BridgeError::Cancelled => OperationError::Cancelled,
        error => error.into(),
    })
}

/// Tell how many vertices a bridge has, how smooth the curve is over it, and what features it has.
pub(super) fn figures(found: &Bridged) -> Vec<Figure> {
    let jump = largest_jump(&found.polygon, &found.bridge);
    vec![
        Figure::count("bridge", "Bridge vertices", found.bridge.len()),
        Figure {
            name: "largest_jump",
            label: "Largest jump of a derivative (relative)",
            value: Value::Real(jump),
            quantity: Quantity::Number,
        },
        Figure::count(
            "bridge_extrema",
            "Curvature extrema on the bridge",
            found.counts.extrema,
        ),
        Figure::count(
            "bridge_inflections",
            "Inflections on the bridge",
            found.counts.inflections,
        ),
        Figure::count("iterations", "Iterations", found.iterations),
        Figure::length("bridge_length", "Length of the bridge", found.length),
    ]
}

/// Say that segments were halved, and what could not be proved.
pub(super) fn remarks(found: &Bridged) -> Vec<String> {
    let halved = (found.halvings > 0).then(|| {
        let pieces = 1_usize << found.halvings;
        format!("Each segment became {pieces}, so that the bridge fits into the gap")
    });
    let undecided = (found.undecided > 0).then(|| {
        format!(
            "Features of the bridge that could not be decided: {}",
            found.undecided
        )
    });
    halved.into_iter().chain(undecided).collect()
}

/// How many times as much a bridge may bend as the parts do anywhere, or as the turns at its ends need over the gap:
/// between two arcs four lengths apart it is 5.4 times, across a gap of 1 % with a corner of 3° 13 times.
const SHARPEST: f64 = 6.0;

/// A bridge that bends more than so many times as sharply as its ends, or as the turn over the gap needs, is seen as a
/// knuckle.
const SHARPER: f64 = 3.0;

/// A gap of at most this share of the parts' size is short: across a longer one a bend is a matter of taste, and seen,
/// unless it is so many times sharper still.
const SHORT: f64 = 0.05;
const CUSP: f64 = 4.0;

/// Say why a bridge between two parts is no use: it goes a long way round, or is bent sharply across a short gap.
pub(super) fn fault(found: &Bridged, parts: [&FloatPolygon; 2]) -> Option<String> {
    if found.is_long {
        let [length, gap] = [found.length, found.gap].map(|it| significant(it, 3));
        return Some(format!("A bridge is {length} long, the gap {gap}"));
    }
    let sizes = parts.map(|part| BezierPolygon::from_float(part).size());
    let most = match found.gap > SHORT * sizes[0].max(sizes[1]) {
        true => CUSP * SHARPEST,
        false => SHARPEST,
    };
    bent(found, parts, most)
}

/// Say that a bridge is bent so sharply that it is no use, however long the gap.
pub(super) fn spike(found: &Bridged, parts: [&FloatPolygon; 2]) -> Option<String> {
    bent(found, parts, SHARPEST)
}

/// Say that a bridge bends more than so many times as sharply as it needs to.
fn bent(found: &Bridged, parts: [&FloatPolygon; 2], most: f64) -> Option<String> {
    let bends = Bends::of(found, parts);
    (bends.largest > most * bends.of_parts.max(bends.over_gap)).then(|| {
        let radius = significant(1.0 / bends.largest, 3);
        format!("A bridge is bent to a radius of {radius}")
    })
}

/// Say that a bridge is bent more sharply than its parts and the gap make one expect.
pub(super) fn knuckle(found: &Bridged, parts: [&FloatPolygon; 2]) -> Option<String> {
    let bends = Bends::of(found, parts);
    (bends.largest > SHARPER * bends.at_ends.max(bends.over_gap)).then(|| {
        let radius = significant(1.0 / bends.largest, 3);
        format!("The bridge is bent to a radius of {radius}, sharper than its ends")
    })
}

/// Curvatures of a bridge and beside it.
struct Bends {
    /// The largest of the bridge.
    largest: f64,
    /// The largest of its parts.
    of_parts: f64,
    /// The larger one of the places where it begins and ends.
    at_ends: f64,
    /// The one that turns the ends over the gap.
    over_gap: f64,
}

impl Bends {
    fn of(found: &Bridged, parts: [&FloatPolygon; 2]) -> Self {
        let own = parts.map(|part| largest_curvature(part, [0.0, part.segments() as f64]));
        let [end, start] = joint(found);
        let ends = [end, start].map(|u| found.polygon.jet(u));
        let way = ends[1].point - ends[0].point;
        let turns = ends.map(|jet| jet.tangent().map_or(PI, |it| it.angle_between(way)));
        // Over no way there is no angle.
        let turns = turns.into_iter().filter(|turn| turn.is_finite());
        let at_ends = ends.map(|jet| jet.curvature());
        Self {
            largest: largest_curvature(&found.polygon, [end, start]),
            of_parts: own[0].max(own[1]),
            at_ends: at_ends[0].max(at_ends[1]),
            over_gap: turns.sum::<f64>() / found.gap,
        }
    }
}

/// Annotate the vertices of a bridge.
pub(super) fn annotations(found: &Bridged) -> Vec<Annotation> {
    let vertices = found.bridge.clone();
    vertices
        .map(|vertex| Annotation::Point(found.polygon.vertex(vertex)))
        .collect()
}

/// The parameters between which the curve depends on the bridge, or on both parts.
pub(super) fn joint(found: &Bridged) -> [f64; 2] {
    let degree = found.polygon.degree();
    [found.bridge.start.saturating_sub(degree), found.bridge.end].map(|u| u as f64)
}
