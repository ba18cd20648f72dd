//! What joining two curves and closing one share.

use super::error::OperationError;
use super::outcome::{Annotation, Figure};
use super::parameter::{Kind, Parameter};
use super::value::Value;
use crate::geometry::fairing::bends::Bends;
use crate::geometry::fairing::bridging::{BridgeError, Bridged, MAX_BRIDGE, largest_jump};
use crate::geometry::parameters::Quantity;
use crate::geometry::{BezierPolygon, FloatPolygon, significant};

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
    let pieces = found.halvings.map(|halvings| 1_usize << halvings);
    let halved = match pieces {
        [1, 1] => None,
        [first, second] if first == second => Some(format!("Each segment became {first}")),
        [first, 1] => Some(format!("Each segment of the first curve became {first}")),
        [1, second] => Some(format!("Each segment of the second curve became {second}")),
        [first, second] => Some(format!(
            "Each segment of the first curve became {first}, of the second {second}"
        )),
    };
    let purpose = match found.bridge.is_empty() {
        true => "the parts go on from each other",
        false => "the bridge fits into the gap",
    };
    let count = found.polygon.vertices().len();
    let halved = halved.map(|halved| format!("{halved}, so that {purpose}: {count} vertices"));
    let undecided = (found.undecided > 0).then(|| {
        format!(
            "Features of the bridge that could not be decided: {}",
            found.undecided
        )
    });
    halved.into_iter().chain(undecided).collect()
}

/// How many times as much a bridge may bend as it does at its ends, or as the turns there need over the gap:
/// between two arcs four lengths apart it is 5.4 times, across a gap of 1 % with a corner of 3° 13 times.
const SHARPEST: f64 = 6.0;

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
    bent(found, most)
}

/// A bridge that is so many times as long as its gap goes a detour: half a circle is 1.6 times as long.
const DETOUR: f64 = 2.0;

/// Say that a bridge between the ends of a curve goes a detour, as one between ends that point away from each other does.
pub(super) fn detour(found: &Bridged, curve: &FloatPolygon) -> Option<String> {
    let is_wide = found.gap > SHORT * BezierPolygon::from_float(curve).size();
    (is_wide && found.length > DETOUR * found.gap).then(|| {
        let [length, gap] = [found.length, found.gap].map(|it| significant(it, 3));
        format!("The bridge is {length} long, the gap {gap}: turn the ends towards each other")
    })
}

/// Say that a bridge is bent so sharply that it is no use, however long the gap.
pub(super) fn spike(found: &Bridged) -> Option<String> {
    bent(found, SHARPEST)
}

/// Say that a bridge bends more than so many times as sharply as it needs to.
fn bent(found: &Bridged, most: f64) -> Option<String> {
    let radius = radius(&found.bends);
    (found.bends.excess() > most).then(|| format!("A bridge is bent to a radius of {radius}"))
}

/// Say that a bridge is bent more sharply than its ends and the gap make one expect.
pub(super) fn knuckle(found: &Bridged) -> Option<String> {
    sharper("bridge", &found.bends)
}

/// Say that what connects two ends is bent more sharply than they and the gap make one expect.
pub(super) fn sharper(name: &str, bends: &Bends) -> Option<String> {
    bends.is_knuckle().then(|| {
        let radius = radius(bends);
        let times = significant(bends.excess(), 2);
        format!("The {name} is bent to a radius of {radius}, {times} times as sharply as its ends ask for")
    })
}

/// The smallest radius, as text.
fn radius(bends: &Bends) -> String {
    significant(1.0 / bends.largest, 3)
}

/// Annotate the vertices of a bridge.
pub(super) fn annotations(found: &Bridged) -> Vec<Annotation> {
    let vertices = found.bridge.clone();
    vertices
        .map(|vertex| Annotation::Point(found.polygon.vertex(vertex)))
        .collect()
}
