//! The three polygons of one curve, by name.

use std::fmt;

/// One of the polygons that hold the same curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PolygonKind {
    /// Uniform, unclamped knots: the S-polygon in float format, Batten's own.
    #[default]
    Float,
    /// Clamped knots: the S-polygon in closed format.
    Clamped,
    /// One Bézier polygon a segment, neighbours sharing their joint.
    Bezier,
}

impl PolygonKind {
    /// Every kind, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Float, Self::Clamped, Self::Bezier];

    /// Name the kind as files and the command line spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Clamped => "clamped",
            Self::Bezier => "bezier",
        }
    }

    /// Find the kind that is spelled `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl fmt::Display for PolygonKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}
