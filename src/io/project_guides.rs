//! The JSON of the guide lines in a project file.

use serde::{Deserialize, Serialize};

use crate::document::GuideLine;

/// The known keys: the places of guide lines by their coordinate.
#[derive(Default, Deserialize, Serialize)]
#[serde(
    default,
    expecting = "the guides of a project, which are a JSON object"
)]
pub(super) struct ProjectGuides {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    x: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    y: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    z: Vec<f64>,
}

impl ProjectGuides {
    /// Write guide lines; `None` if there are none.
    pub(super) fn of(lines: &[GuideLine]) -> Option<Self> {
        let places = |axis| {
            let own = lines.iter().filter(move |line| line.axis == axis);
            own.map(|line| line.at).collect()
        };
        let [x, y, z] = [0, 1, 2].map(places);
        (!lines.is_empty()).then_some(Self { x, y, z })
    }

    /// The guide lines, by their coordinates.
    pub(super) fn into_lines(self) -> Vec<GuideLine> {
        let axes = (0..).zip([self.x, self.y, self.z]);
        let lines = axes.flat_map(|(axis, places)| {
            let places = places.into_iter();
            places.map(move |at| GuideLine { axis, at })
        });
        lines.collect()
    }
}
