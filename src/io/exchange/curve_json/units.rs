//! The units of the format.

/// The names of units and their millimetres.
pub const UNITS: [(&str, f64); 4] = [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4)];
