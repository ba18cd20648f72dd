//! Units that numbers can be typed in.

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LengthUnit {
    /// 1/1000 of a metre.
    Millimetre,
    /// 1/100 of a metre.
    Centimetre,
    /// The metre.
    Metre,
    /// 25.4 millimetres.
    Inch,
}

impl LengthUnit {
    /// Every unit, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Millimetre, Self::Centimetre, Self::Metre, Self::Inch];

    /// Its symbol: mm, cm, m or in.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
        }
    }

    /// Write the text of a length with the unit behind it, if there is one.
    pub fn behind(unit: Option<Self>, text: String) -> String {
        match unit {
            Some(unit) => format!("{text} {}", unit.symbol()),
            None => text,
        }
    }

    /// Its name: millimetres, centimetres, metres or inches.
    pub fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "millimetres",
            Self::Centimetre => "centimetres",
            Self::Metre => "metres",
            Self::Inch => "inches",
        }
    }

    /// Find a unit by its symbol; `None` if there is none of this symbol.
    pub fn of_symbol(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }

    /// Its length in millimetres.
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Metre => 1000.0,
            Self::Inch => 25.4,
        }
    }
}

/// A unit that can stand after a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) enum Unit {
    Length(LengthUnit),
    Degree,
    Radian,
}

/// The spellings of units.
const UNITS: [(&str, Unit); 10] = [
    ("mm", Unit::Length(LengthUnit::Millimetre)),
    ("cm", Unit::Length(LengthUnit::Centimetre)),
    ("m", Unit::Length(LengthUnit::Metre)),
    ("in", Unit::Length(LengthUnit::Inch)),
    ("inch", Unit::Length(LengthUnit::Inch)),
    ("\"", Unit::Length(LengthUnit::Inch)),
    ("″", Unit::Length(LengthUnit::Inch)),
    ("deg", Unit::Degree),
    ("°", Unit::Degree),
    ("rad", Unit::Radian),
];

impl Unit {
    /// Find the unit with this spelling.
    pub(super) fn written(text: &str) -> Option<Self> {
        let mut units = UNITS.iter();
        units.find(|(name, _)| *name == text).map(|(_, unit)| *unit)
    }

    /// Whether the way in which a unit is written begins so.
    pub(super) fn begins(text: &str) -> bool {
        UNITS.iter().any(|(name, _)| name.starts_with(text))
    }
}
