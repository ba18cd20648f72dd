//! The mirror image of a curve, in its place or as a copy.

use glam::DVec3;

use super::copied_matches::match_own_copies;
use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Copying, Deviation, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, CurveId, Document, Edit, EndTargets};
use crate::geometry::{End, FloatPolygon, Mirror, Progress};

const AXIS: Parameter = Parameter {
    name: "axis",
    label: "Axis",
    help: "The mirror line through the origin; z: half a turn",
    kind: Kind::Choice {
        options: &[
            Choice::new("y", "Y"),
            Choice::new("x", "X"),
            Choice::new("z", "Z, half a turn"),
        ],
        default: 0,
    },
};

pub(super) const FROM: Parameter = Parameter {
    name: "from",
    label: "From",
    help: "A point of another mirror line",
    kind: Kind::list(2..=2, |_| "the axis counts"),
};

pub(super) const TO: Parameter = Parameter {
    name: "to",
    label: "To",
    help: "A second point of that line",
    kind: Kind::list(2..=2, |_| "the axis counts"),
};

pub(super) const PLANE: Parameter = Parameter {
    name: "plane",
    label: "Plane",
    help: "The mirror plane through the origin, in space",
    kind: Kind::Choice {
        options: &[
            Choice::new("none", "The axis counts"),
            Choice::new("xy", "XY"),
            Choice::new("xz", "XZ"),
            Choice::new("yz", "YZ"),
        ],
        default: 0,
    },
};

const COPY: Parameter = Parameter {
    name: "copy",
    label: "Copy",
    help: "Keep the curve, and add its mirror image, matched to images of what the curve follows",
    kind: Kind::Switch { default: false },
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "mirror",
    label: "Mirror",
    help: "Make the mirror image of the curve, with its ends, targets and locks",
    inputs: Inputs::One,
    each: true,
    parameters: &[AXIS, FROM, TO, PLANE, COPY],
    check: check_editable,
    unused,
    run,
};

/// The images by axis and by plane: which coordinates change their signs.
const BY_AXIS: [[bool; 3]; 3] = [
    [true, false, false],
    [false, true, false],
    [true, true, false],
];
const BY_PLANE: [Option<[bool; 3]>; 4] = [
    None,
    Some([false, false, true]),
    Some([false, true, false]),
    Some([true, false, false]),
];

/// A line or a plane takes the place of the axis.
pub(super) fn unused(values: &Values) -> &'static [&'static str] {
    let has_line = [&FROM, &TO].iter().any(|it| !values.list(it).is_empty());
    match (values.choice(&PLANE, &BY_PLANE), has_line) {
        (Some(_), false) => &["axis"],
        (None, true) => &["axis"],
        _ => &[],
    }
}

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let mirror = plane_or_line(values, values.choice(&AXIS, &BY_AXIS))?;
    let image = image(curve, &mirror)?;
    let mut outcome = Outcome::unchanged(Deviation::Unmeasured);
    outcome.edits = match values.switch(&COPY) {
        true => {
            let name = input.document().free_name(&curve.name);
            let copy = Curve {
                name,
                extras: Default::default(),
                ..image
            };
            outcome.copied = Some(Copying::Mirrored(mirror));
            vec![Edit::Add(Box::new(copy))]
        }
        false => {
            check_free(input, id)?;
            in_place(input.document(), id, curve, image)
        }
    };
    match_own_copies(&mut outcome, input)?;
    Ok(outcome)
}

/// The map by the plane or the line that the values name, or else by an axis.
///
/// # Errors
/// [`OperationError`] if they contradict each other, or a line has no direction.
pub(super) fn plane_or_line(values: &Values, by_axis: [bool; 3]) -> Result<Mirror, OperationError> {
    let plane = values.choice(&PLANE, &BY_PLANE);
    let [from, to] = [&FROM, &TO].map(|parameter| match *values.list(parameter) {
        [x, y] => Some(DVec3::new(x, y, 0.0)),
        _ => None,
    });
    let exclude = |first, second| Err(OperationError::Exclude { first, second });
    match (from, to, plane) {
        (None, None, None) => Ok(Mirror::Signs(by_axis)),
        (None, None, Some(signs)) => Ok(Mirror::Signs(signs)),
        (Some(_), _, Some(_)) => exclude(FROM.label, PLANE.label),
        (_, Some(_), Some(_)) => exclude(TO.label, PLANE.label),
        (Some(from), Some(to), None) => {
            let label = TO.label;
            Mirror::through(from, to).ok_or(OperationError::NoDirection { label })
        }
        (Some(_), None, None) => Err(OperationError::Needs {
            given: FROM.label,
            needed: TO.label,
        }),
        (None, Some(_), None) => Err(OperationError::Needs {
            given: TO.label,
            needed: FROM.label,
        }),
    }
}

/// The mirror image, with the order of its vertices kept.
fn image(curve: &Curve, mirror: &Mirror) -> Result<Curve, OperationError> {
    let polygon = &curve.polygon;
    let vertices = polygon.vertices().iter().map(|it| mirror.point(*it));
    let weights = polygon.weights().map(<[f64]>::to_vec);
    let image = FloatPolygon::new(
        polygon.degree(),
        vertices.collect(),
        weights,
        polygon.is_periodic(),
    )?;
    let planar = polygon.is_planar();
    let mut targets = EndTargets::default();
    for (end, target) in curve.targets.list() {
        targets.set(end, Some(mirror.target(target, planar)));
    }
    Ok(Curve {
        polygon: image,
        targets,
        ..curve.clone()
    })
}

/// Refuse a curve that follows another one, unless that is mirrored too: it would go back to it.
pub(super) fn check_free(input: &Operands, id: CurveId) -> Result<(), OperationError> {
    let document = input.document();
    let matched = End::BOTH
        .into_iter()
        .filter_map(|end| document.match_of(id, end))
        .find(|matched| !input.goes_along(matched.source));
    match matched {
        Some(matched) => Err(OperationError::MirroredMatch {
            end: matched.end,
            source_name: document.name(matched.source).unwrap_or_default().to_owned(),
        }),
        None => Ok(()),
    }
}

/// Put the image in the curve's place, locked vertices with it.
fn in_place(document: &Document, curve: CurveId, before: &Curve, image: Curve) -> Vec<Edit> {
    let locks: Vec<usize> = before.locked_vertices.iter().collect();
    let locked = |locked: bool| Edit::SetVerticesLocked {
        curve,
        vertices: locks.clone(),
        locked,
    };
    let polygon = image.polygon;
    let mut edits = vec![
        locked(false),
        Edit::SetPolygon { curve, polygon },
        locked(true),
    ];
    if locks.is_empty() {
        edits.retain(|edit| matches!(edit, Edit::SetPolygon { .. }));
    }
    // The target of a matched end is that of the match.
    let targets = image.targets.list().into_iter();
    let targets = targets.filter(|(end, _)| document.match_of(curve, *end).is_none());
    edits.extend(targets.map(|(end, target)| Edit::SetTarget {
        curve,
        end,
        target: Some(target),
    }));
    edits
}
