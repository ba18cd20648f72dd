//! What an export could not hold.

use std::fmt;

use super::format::Format;
use crate::document::{Curve, quoted};
use crate::geometry::{PolygonKind, rounded_up};

/// Hold a written file's bytes and what is lost with them.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// What the file does not hold.
    pub losses: LossReport,
}

/// List what a file does not hold of the curves written to it. Shown as one line a loss.
#[derive(Clone, Debug, PartialEq)]
pub struct LossReport {
    /// The file's format.
    pub format: Format,
    /// The losses, each with the name of its curve.
    pub losses: Vec<(String, Loss)>,
    /// Whether it does not hold what the project says that this program does not know.
    pub project_keys: bool,
}

/// Something that a file does not hold of a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum Loss {
    /// The name, which was changed to one that the format allows.
    Name {
        /// The name written.
        written: String,
    },
    /// The curve's own colour.
    Colour,
    /// That the curve is hidden.
    Hidden,
    /// That the curve is locked.
    Locked,
    /// The targets of the ends.
    Targets,
    /// What its file said of it that this program does not know.
    UnknownKeys,
    /// That the curve is periodic; it is written as an open one that ends where it begins.
    Periodic,
    /// The weights of a polygon that is drawn as plain lines.
    PolygonWeights {
        /// The polygon.
        kind: PolygonKind,
    },
    /// Digits: the float vertices that can be had back from the written polygon are off.
    Digits {
        /// The polygon written.
        kind: PolygonKind,
        /// By how much the worst one is off.
        distance: f64,
        /// A bound of how far the curve is off.
        curve: f64,
    },
    /// The way back: no usable float polygon can be had from the written polygon.
    NoWayBack {
        /// The polygon written.
        kind: PolygonKind,
    },
}

impl LossReport {
    /// Begin a report without losses.
    pub fn new(format: Format) -> Self {
        Self {
            format,
            losses: Vec::new(),
            project_keys: false,
        }
    }

    /// Whether nothing is lost.
    pub fn is_empty(&self) -> bool {
        self.losses.is_empty() && !self.project_keys
    }

    /// Add a loss of one curve.
    pub fn add(&mut self, curve: &Curve, loss: Loss) {
        self.losses.push((curve.name.clone(), loss));
    }

    /// Add a loss of one curve where `is_lost`.
    pub fn add_if(&mut self, is_lost: bool, curve: &Curve, loss: Loss) {
        if is_lost {
            self.add(curve, loss);
        }
    }
}

impl fmt::Display for LossReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, loss)) in self.losses.iter().enumerate() {
            if index > 0 {
                writeln!(formatter)?;
            }
            let format = self.format;
            let name = quoted(name);
            match loss {
                Loss::Name { written } => write!(
                    formatter,
                    "{name}: the name is written as {}, which {format} allows",
                    quoted(written)
                ),
                Loss::Digits {
                    kind,
                    distance,
                    curve,
                } => write!(
                    formatter,
                    "{name}: converted back from the {kind} polygon written, the float vertices are off by up to {}, the curve by up to {}",
                    rounded_up(*distance),
                    rounded_up(*curve)
                ),
                Loss::NoWayBack { kind } => write!(
                    formatter,
                    "{name}: the {kind} polygon written cannot be converted back to a float polygon"
                ),
                Loss::Periodic => write!(
                    formatter,
                    "{name}: written as an open curve that ends where it begins, not as a periodic one"
                ),
                Loss::PolygonWeights { kind } => write!(
                    formatter,
                    "{name}: the {kind} polygon is drawn without its weights"
                ),
                Loss::Colour => write!(formatter, "{name}: the {format} does not hold its colour"),
                Loss::Hidden => {
                    write!(
                        formatter,
                        "{name}: the {format} does not hold that it is hidden"
                    )
                }
                Loss::Locked => {
                    write!(
                        formatter,
                        "{name}: the {format} does not hold that it is locked"
                    )
                }
                Loss::Targets => {
                    write!(
                        formatter,
                        "{name}: the {format} does not hold the targets of its ends"
                    )
                }
                Loss::UnknownKeys => {
                    write!(
                        formatter,
                        "{name}: the {format} does not hold its unknown keys"
                    )
                }
            }?;
        }
        if self.project_keys {
            if !self.losses.is_empty() {
                writeln!(formatter)?;
            }
            let format = self.format;
            write!(
                formatter,
                "the {format} does not hold the project's unknown keys"
            )?;
        }
        Ok(())
    }
}
