//! What a number measures.

/// Dimension of a number, which decides the units that it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// A plain number without a unit.
    #[default]
    Number,
    /// A length, in the document's unit.
    Length,
    /// A curvature: one over a length in the document's unit.
    Curvature,
    /// An angle, typed and shown in degrees.
    Angle,
    /// A parameter of a curve; a typed angle counts in radians.
    Parameter,
}

impl Quantity {
    /// Convert a stored value to the shown one: angles from radians to degrees.
    pub fn shown(self, stored: f64) -> f64 {
        match self {
            Self::Angle => stored.to_degrees(),
            _ => stored,
        }
    }

    /// Convert a typed value to the stored one: angles from degrees to radians.
    pub fn stored(self, typed: f64) -> f64 {
        match self {
            Self::Angle => typed.to_radians(),
            _ => typed,
        }
    }

    /// Name the quantity with its article, and the unit if it is fixed: "an angle in degrees".
    pub fn noun(self) -> &'static str {
        match self {
            Self::Number => "a number",
            Self::Length => "a length",
            Self::Curvature => "a curvature",
            Self::Angle => "an angle in degrees",
            Self::Parameter => "a parameter u",
        }
    }
}
