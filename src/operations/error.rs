//! Why an operation cannot run.

use thiserror::Error;

use super::inputs::Inputs;
use crate::document::{EditError, quoted};
use crate::geometry::approximation::merging::MergeError;
use crate::geometry::approximation::{ApproximationError, FitError};
use crate::geometry::between::BetweenError;
use crate::geometry::expressions::ExpressionMistake;
use crate::geometry::fairing::bridging::BridgeError;
use crate::geometry::fairing::harmonising::HarmonyError;
use crate::geometry::fairing::joint_correction::CorrectionError;
use crate::geometry::parameters::OutOfRange;
use crate::geometry::references::{ReferenceError, ReferenceTextError};
use crate::geometry::{End, MAX_DEGREE, PolygonError};

/// Why an operation cannot run on an input, or with some values.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OperationError {
    /// The input is not what the operation wants.
    #[error("{}", .needed.request())]
    Inputs {
        /// What it wants.
        needed: Inputs,
    },
    /// The curve cannot be changed, or not so.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// What was asked for makes no curve.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// The ends cannot be corrected at once.
    #[error(transparent)]
    Correction(#[from] CorrectionError),
    /// There is no segment between the ends.
    #[error(transparent)]
    Between(#[from] BetweenError),
    /// The curve cannot be harmonised.
    #[error(transparent)]
    Harmony(#[from] HarmonyError),
    /// There is no bridge between two ends.
    #[error(transparent)]
    Bridge(#[from] BridgeError),
    /// Two curves cannot be merged.
    #[error(transparent)]
    Merge(#[from] MergeError),
    /// A curve with locked vertices was to be merged.
    #[error("{} has locked vertices, and merging makes new ones: unlock them, or choose Chain", quoted(.name))]
    LockedInMerge {
        /// The curve.
        name: String,
    },
    /// The curve has no approximation.
    #[error(transparent)]
    Approximation(#[from] ApproximationError),
    /// The points have no fit.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// One of several pieces of points has no fit.
    #[error("piece {piece}, points {first} to {last}: {error}")]
    Piece {
        /// The number of the piece, from 1.
        piece: usize,
        /// Its first point, from 0.
        first: usize,
        /// Its last point.
        last: usize,
        /// Why it has none.
        error: FitError,
    },
    /// A reference has no such part.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// A reference cannot be read.
    #[error(transparent)]
    ReferenceText(#[from] ReferenceTextError),
    /// Points were given to what needs a smooth curve.
    #[error("points have no derivatives, so they cannot be approximated: fit a curve to them")]
    PointsOnly,
    /// A curve was to be joined with itself.
    #[error(
        "both curves are the same: close the curve to join its two ends, or move one copy away"
    )]
    JoinedWithItself,
    /// The joined curve would follow itself through another curve.
    #[error("{} would follow {}, which follows it: “Drop match” (--drop-match) drops that match", quoted(.name), quoted(.source_name))]
    MatchCircle {
        /// The curve that would follow.
        name: String,
        /// The curve that it would follow.
        source_name: String,
    },
    /// Two parameters exclude each other.
    #[error("{first} and {second} cannot both be given")]
    Exclude {
        /// The one, as it is shown.
        first: &'static str,
        /// The other, as it is shown.
        second: &'static str,
    },
    /// A parameter means nothing without another one.
    #[error("{given} needs {needed}")]
    Needs {
        /// The one, as it is shown.
        given: &'static str,
        /// The other, as it is shown.
        needed: &'static str,
    },
    /// A curve with a matched end was to be replaced by its mirror image.
    #[error("the {} follows {}: release the match, or mirror a copy (--copy)", .end.name(), quoted(.source_name))]
    MirroredMatch {
        /// The matched end.
        end: End,
        /// What it follows.
        source_name: String,
    },
    /// A direction is a vector of length 0.
    #[error("{label}: a vector of length 0 has no direction")]
    NoDirection {
        /// The parameter, as it is shown.
        label: &'static str,
    },
    /// The steps of the end fit meet points and directions only.
    #[error(
        "{label}: the steps meet points and directions only: use “Both ends at once” (--method joint)"
    )]
    NotBySteps {
        /// The parameter that asks for more, as it is shown.
        label: &'static str,
    },
    /// There is no lower degree.
    #[error("the degree is 1 already, the lowest that there is")]
    LowestDegree,
    /// There is no higher degree for the curve.
    #[error("the degree is {degree} already, the highest that {}", who_can_have(*.degree))]
    HighestDegree {
        /// The degree.
        degree: usize,
    },
    /// The curve is too small to be computed with.
    #[error("the curve is {size:e} in size: scale it up first")]
    TooSmall {
        /// Its size.
        size: f64,
    },
    /// No end has a target, or not the one that was chosen.
    #[error("{}", no_target(*.end))]
    NoTarget {
        /// The end that was chosen.
        end: Option<End>,
    },
    /// The target leaves the direction free.
    #[error("the target of the {} has no direction: set a target direction first", .end.name())]
    NoTargetDirection {
        /// The end.
        end: End,
    },
    /// A parameter that the operation does not have.
    #[error("there is no parameter “{name}”")]
    NoSuchParameter {
        /// The name given.
        name: String,
    },
    /// A value of another kind than the parameter's.
    #[error("{label}: {needed} {verb} needed")]
    WrongKind {
        /// The parameter, as it is shown.
        label: &'static str,
        /// What it takes.
        needed: String,
        /// "is" or "are".
        verb: &'static str,
    },
    /// A text that is no number.
    #[error("{label}: {needed} {verb} needed: {mistake}")]
    NotANumber {
        /// The parameter, as it is shown.
        label: &'static str,
        /// What it takes.
        needed: String,
        /// "is" or "are".
        verb: &'static str,
        /// What is wrong, with its column in the text.
        mistake: Box<ExpressionMistake>,
    },
    /// A value of a parameter that a planar curve has no use for.
    #[error("{label}: only a curve in space has this, and the curve lies in the plane z = 0")]
    OnlyInSpace {
        /// The parameter, as it is shown.
        label: &'static str,
    },
    /// A value out of the parameter's range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The result is no longer wanted.
    #[error("cancelled")]
    Cancelled,
}

/// Below the highest of all only periodic curves have a highest degree.
fn who_can_have(degree: usize) -> &'static str {
    if degree >= MAX_DEGREE {
        "there is"
    } else {
        "a periodic curve of so few segments can have"
    }
}

fn no_target(end: Option<End>) -> String {
    match end {
        Some(end) => format!("the {} has no target: set one first", end.name()),
        None => "no end of the curve has a target: set one first, or give “Correct ends” what you want by values".to_owned(),
    }
}
