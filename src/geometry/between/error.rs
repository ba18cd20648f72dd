//! Why there is no segment between two ends.

use thiserror::Error;

use crate::geometry::approximation::ApproximationError;
use crate::geometry::error::PolygonError;
use crate::geometry::fairing::harmonising::HarmonyError;
use crate::geometry::fairing::joint_correction::CorrectionError;
use crate::geometry::references::ReferenceError;
use crate::geometry::wording::significant;

/// Why there is no segment between two ends.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BetweenError {
    /// Both ends are at one point.
    #[error("both ends are at the same point: move one of them")]
    NoChord,
    /// The ends are too far from each other, or too near to each other, for numbers of double precision.
    #[error("the ends are {distance:e} apart: distances from 1e-100 to 1e100 are needed")]
    ChordOutOfRange {
        /// The larger coordinate of the chord.
        distance: f64,
    },
    /// A direction is no direction.
    #[error("an end has a direction of length 0: give it a direction")]
    NoDirection,
    /// The segment would have an inflection, which curves of this kind do not have.
    #[error(
        "the ends ask for an inflection, which {kind} does not have: use a clothoid (α = −1) or any monotone curve"
    )]
    Inflection {
        /// The kind.
        kind: String,
    },
    /// The radius of curvature of a superspiral need not be monotone.
    #[error("the superspiral {}, {}, {} need not have monotone curvature: a > 0 and c > b > 0 are needed", .values[0], .values[1], .values[2])]
    NotMonotone {
        /// The numbers a, b and c.
        values: [f64; 3],
    },
    /// The chord does not fit the directions.
    #[error("there is no segment of {kind} here: turning by {}°, it has its chord {} from the direction at the start, and here it is {}°", degrees(*.turning), chord_angles(*.reach), degrees(*.angle))]
    OutOfReach {
        /// The kind.
        kind: String,
        /// The angle that it turns by, in radians.
        turning: f64,
        /// The angles between the direction at the start and the chord that there are.
        reach: [f64; 2],
        /// The requested angle.
        angle: f64,
    },
    /// There is a segment, and it has another curvature.
    #[error("the curvature at the {end} would be {}, and {} is asked for: leave this curvature free, or α if it is given, or give both ends a curvature", significant(*.found, 6), significant(*.asked, 6))]
    OtherCurvature {
        /// The end.
        end: &'static str,
        /// The segment's curvature.
        found: f64,
        /// The requested value.
        asked: f64,
    },
    /// The requested curvature turns the other way.
    #[error("the curvature {} at the {end} is that of a turn to the {}, and between these ends every such segment turns to the {} there: give it the other sign, or turn a direction", significant(*.asked, 6), side(*.asked), side(-.asked))]
    OtherTurn {
        /// The end.
        end: &'static str,
        /// The requested value.
        asked: f64,
    },
    /// No α gives the curvature.
    #[error("no log-aesthetic segment between these ends has the curvature {} at the {end}: for α from −10 to 10 it is {} to {}", significant(*.asked, 6), significant(.range[0], 6), significant(.range[1], 6))]
    CurvatureOutOfReach {
        /// The end.
        end: &'static str,
        /// The requested value.
        asked: f64,
        /// The possible range.
        range: [f64; 2],
    },
    /// No curve with monotone curvature has these curvatures at its ends.
    #[error("no curve with monotone curvature has these ends: the circles of curvature at the ends would have to lie {} (Kneser), and their centres are {} apart, with radii {} and {}", if *.turns { "one inside the other" } else { "beside each other" }, significant(*.distance, 4), significant(.radii[0], 4), significant(.radii[1], 4))]
    NotNested {
        /// Whether the curvatures have one sign.
        turns: bool,
        /// The distance of the centres of curvature.
        distance: f64,
        /// The radii of curvature.
        radii: [f64; 2],
    },
    /// No curve with monotone curvature has these curvatures with these angles to the chord.
    #[error("no curve with monotone curvature joins these ends without turning round once more: its angle to the chord is larger where its curvature is stronger (Vogt), and here it is {}° at the start, with curvature {}, and {}° at the end, with curvature {}: give the end with the larger angle the stronger curvature, or turn a direction", degrees(.angles[0]), significant(.curvatures[0], 6), degrees(.angles[1]), significant(.curvatures[1], 6))]
    OtherLean {
        /// The angles to the chord at the start and at the end, in radians.
        angles: [f64; 2],
        /// The curvatures there.
        curvatures: [f64; 2],
    },
    /// No segments that meet were found.
    #[error(
        "there are no log-aesthetic segments with {alpha} between these ends that have these curvatures: try another α, or any monotone curve"
    )]
    NoPair {
        /// The α that were tried, in words.
        alpha: String,
    },
    /// No clothoid was found.
    #[error("no clothoid without a loop joins these ends: turn a direction towards the other end")]
    NoClothoid,
    /// The computation was ended early.
    #[error("cancelled")]
    Cancelled,
    /// A curve of this kind cannot be made.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The segment cannot be approximated.
    #[error(transparent)]
    Approximation(#[from] ApproximationError),
    /// A vertex would leave the range of numbers.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// The ends cannot be made exact.
    #[error(transparent)]
    Correction(#[from] CorrectionError),
    /// The polygon cannot be harmonised.
    #[error(transparent)]
    Harmony(#[from] HarmonyError),
}

/// Angles from one to another, or the one that all are but for what is not shown.
fn chord_angles(angles: [f64; 2]) -> String {
    let [low, high] = angles.map(degrees);
    if low == high {
        format!("almost exactly {low}°, as a circular arc has,")
    } else {
        format!("{low}° to {high}°")
    }
}

fn side(curvature: f64) -> &'static str {
    if curvature > 0.0 { "left" } else { "right" }
}

fn degrees(radians: f64) -> String {
    significant(radians.to_degrees(), 4)
}
