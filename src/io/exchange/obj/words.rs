//! Words that reading and writing share.

/// The start of a comment that gives the unit.
pub const UNIT: &str = "# unit:";
/// The group of what is in no group, by the format's definition.
pub const DEFAULT_GROUP: &str = "default";
