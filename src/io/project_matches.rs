//! The JSON of a matched end in a project file.

use serde::{Deserialize, Serialize};

use super::error::Problem;
use super::file_match::{FileMatch, MatchSource};
use super::project_values::{ByName, Number};
use crate::document::MatchPlace;
use crate::geometry::{Continuity, End};

/// The known keys of an end that is matched to a curve or to a reference.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a match, which is a JSON object")]
pub(super) struct ProjectMatch {
    /// The curve whose end is matched, counted from 0.
    curve: Number,
    end: ByName<End>,
    /// The source if it is a curve, counted from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<Number>,
    /// The source if it is a reference, counted from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reference: Option<Number>,
    at: ProjectPlace,
    continuity: ByName<Continuity>,
    #[serde(default)]
    reversed: bool,
}

/// An end, or a parameter u.
#[derive(Deserialize, Serialize)]
#[serde(untagged, expecting = "\"start\", \"end\" or a number is needed")]
enum ProjectPlace {
    End(ByName<End>),
    Parameter(f64),
}

impl TryFrom<ProjectMatch> for FileMatch {
    type Error = Problem;

    fn try_from(matched: ProjectMatch) -> Result<Self, Problem> {
        Ok(Self {
            curve: matched.curve.0,
            end: matched.end.0,
            source: match (matched.source, matched.reference) {
                (Some(curve), None) => MatchSource::Curve(curve.0),
                (None, Some(reference)) => MatchSource::Reference(reference.0),
                _ => return Err(Problem::MatchSource),
            },
            place: match matched.at {
                ProjectPlace::End(end) => MatchPlace::End(end.0),
                ProjectPlace::Parameter(u) => MatchPlace::Parameter(u),
            },
            continuity: matched.continuity.0,
            reversed: matched.reversed,
        })
    }
}

impl From<&FileMatch> for ProjectMatch {
    fn from(matched: &FileMatch) -> Self {
        let (source, reference) = match matched.source {
            MatchSource::Curve(index) => (Some(Number(index)), None),
            MatchSource::Reference(index) => (None, Some(Number(index))),
        };
        Self {
            curve: Number(matched.curve),
            end: ByName(matched.end),
            source,
            reference,
            at: match matched.place {
                MatchPlace::End(end) => ProjectPlace::End(ByName(end)),
                MatchPlace::Parameter(u) => ProjectPlace::Parameter(u),
            },
            continuity: ByName(matched.continuity),
            reversed: matched.reversed,
        }
    }
}
