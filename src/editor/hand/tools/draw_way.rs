//! The ways in which the draw tool makes a curve of clicks.

use crate::geometry::{FloatPolygon, PolygonError};
use glam::DVec3;

/// How the draw tool makes a curve of clicks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DrawWay {
    /// The curve starts and ends on clicks, the others are vertices.
    #[default]
    OnClicks,
    /// All clicks are vertices.
    Vertices,
    /// The fair curve through all clicks.
    ThroughPoints,
    /// The clicks are the points of a reference.
    Points,
}

impl DrawWay {
    /// All ways, in the order of the key that changes them.
    pub const ALL: [Self; 4] = [
        Self::OnClicks,
        Self::Vertices,
        Self::ThroughPoints,
        Self::Points,
    ];

    /// The name, also in settings.
    pub fn label(self) -> &'static str {
        match self {
            Self::OnClicks => "On clicks",
            Self::Vertices => "Vertices",
            Self::ThroughPoints => "Through points",
            Self::Points => "Points",
        }
    }

    /// What it does.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::OnClicks => {
                "The curve starts and ends on clicks; those between are vertices (T changes)"
            }
            Self::Vertices => "All clicks are vertices of the float S-polygon (T changes)",
            Self::ThroughPoints => "The fair curve through all clicks (T changes)",
            Self::Points => "Points to fit a curve to, as a reference (T changes)",
        }
    }

    /// Whether the curve ends on clicks, not the polygon.
    pub fn ends_on_clicks(self) -> bool {
        self != Self::Vertices
    }

    /// Whether what is drawn passes all clicks, so that they can follow an edge.
    pub fn passes_points(self) -> bool {
        matches!(self, Self::ThroughPoints | Self::Points)
    }

    /// The way with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|way| way.label() == name)
    }

    /// The next way, round and round.
    pub(super) fn next(self) -> Self {
        match self {
            Self::OnClicks => Self::Vertices,
            Self::Vertices => Self::ThroughPoints,
            Self::ThroughPoints => Self::Points,
            Self::Points => Self::OnClicks,
        }
    }

    /// Make a polygon of clicks, of this degree; vertices too few for it get the highest that they have.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`] and the functions that make the others.
    pub(super) fn polygon(
        self,
        degree: usize,
        clicks: &[DVec3],
        periodic: bool,
    ) -> Result<FloatPolygon, PolygonError> {
        match self {
            Self::OnClicks if !periodic => FloatPolygon::through_ends(degree, clicks),
            Self::ThroughPoints => FloatPolygon::through_points(degree, clicks, periodic),
            // A row of points is joined by straight lines.
            Self::Points => FloatPolygon::new(1, clicks.to_vec(), None, periodic),
            Self::OnClicks | Self::Vertices => {
                let highest = clicks.len().saturating_sub(1).max(1);
                FloatPolygon::new(degree.min(highest), clicks.to_vec(), None, periodic)
            }
        }
    }
}
