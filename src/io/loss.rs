//! The losses of an export.

use std::fmt;

use crate::document::{Curve, Document, Group, Reference, quoted};
use crate::geometry::{End, PolygonKind, counted, rounded_up};

/// Hold the bytes of a file to write, and their losses.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The losses of the format.
    pub losses: LossReport,
}

/// List the losses of a written file. Shown as one line a loss.
#[derive(Clone, Debug, PartialEq)]
pub struct LossReport {
    /// The name of the file's format.
    pub format: &'static str,
    /// The losses, each with the name of its curve or its reference.
    pub losses: Vec<(String, Loss)>,
    /// Whether the unknown keys of the project are lost.
    pub project_keys: bool,
}

/// Something that a file does not hold of a curve or a reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Loss {
    /// The name, which was changed to one that the format allows.
    Name {
        /// The name written.
        written: String,
    },
    /// The name: the format has none beside that of the group.
    NoName,
    /// The group, or the names of its path that the format does not allow.
    Group {
        /// The group written, if the format has groups.
        written: Option<Group>,
    },
    /// The curve's own colour.
    Colour,
    /// That the curve is hidden.
    Hidden,
    /// That the curve is locked.
    Locked,
    /// Which vertices are locked.
    LockedVertices,
    /// The targets of the ends.
    Targets,
    /// A reference as a whole.
    Reference,
    /// How much each point of a reference counts.
    PointWeights,
    /// A curve as a whole.
    Curve,
    /// That an end is kept matched to another curve.
    Match {
        /// The end.
        end: End,
        /// The name of the other curve.
        source: String,
    },
    /// Its unknown keys.
    UnknownKeys,
    /// That the curve is periodic; it is written as an open one that ends where it begins.
    Periodic,
    /// The weights of a polygon that is drawn as plain lines.
    PolygonWeights {
        /// The polygon.
        kind: PolygonKind,
    },
    /// The curve itself: it is written as a chain of cubic Béziers.
    Cubics {
        /// Their number.
        count: usize,
        /// How far the chain is off, measured.
        off: f64,
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
    pub fn new(format: &'static str) -> Self {
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

    /// Add losses of one curve.
    pub fn extend(&mut self, curve: &Curve, losses: impl IntoIterator<Item = Loss>) {
        for loss in losses {
            self.add(curve, loss);
        }
    }

    /// Add what every format but Batten's own loses of a curve.
    pub fn add_attributes(&mut self, curve: &Curve) {
        self.add_if(curve.colour.is_some(), curve, Loss::Colour);
        let has_locks = !curve.locked_vertices.is_empty();
        self.add_if(has_locks, curve, Loss::LockedVertices);
        let has_targets = !curve.targets.list().is_empty();
        self.add_if(has_targets, curve, Loss::Targets);
        self.add_if(!curve.extras.is_empty(), curve, Loss::UnknownKeys);
    }

    /// Add the loss of the group of a curve or a reference of which a file holds other names.
    pub fn add_group(&mut self, name: &str, group: &Group, written: Group) {
        if *group != written {
            let written = Some(written).filter(|written| !written.is_none());
            self.losses.push((name.to_owned(), Loss::Group { written }));
        }
    }

    /// Add that a curve is not written.
    pub fn add_curve(&mut self, curve: &Curve) {
        self.add(curve, Loss::Curve);
    }

    /// Add that a reference is not written.
    pub fn add_reference(&mut self, reference: &Reference) {
        self.losses.push((reference.name.clone(), Loss::Reference));
    }

    /// Add what every format but Batten's own loses of a list of points.
    pub fn add_point_weights(&mut self, reference: &Reference) {
        if reference.weights().is_some() {
            self.losses
                .push((reference.name.clone(), Loss::PointWeights));
        }
    }

    /// Add the matches of a document's curves, of those that are written: every format but Batten's own
    /// loses them.
    pub fn add_matches(&mut self, document: &Document, is_written: impl Fn(&Curve) -> bool) {
        for matched in document.matches() {
            let pair = document
                .curve(matched.curve)
                .zip(document.name(matched.source));
            if let Some((curve, source)) = pair.filter(|(curve, _)| is_written(curve)) {
                let (end, source) = (matched.end, source.to_owned());
                self.add(curve, Loss::Match { end, source });
            }
        }
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
        let format = self.format;
        let lost = |what: &str| format!("{what} stored in the {format}");
        let of_curves = self.losses.iter().map(|(name, loss)| {
            let text = match loss {
                Loss::Name { written } => {
                    let written = quoted(written);
                    format!("the name is written as {written}, which {format} allows")
                }
                Loss::NoName => lost("the name of a curve in a group isn't"),
                Loss::Group { written: None } => lost("the group isn't"),
                Loss::Group {
                    written: Some(written),
                } => {
                    let written = quoted(&written.to_string());
                    format!("the group is written as {written}, which {format} allows")
                }
                Loss::Digits {
                    kind,
                    distance,
                    curve,
                } => format!(
                    "converted back from the {kind} polygon written, the float vertices are off by up to {}, the curve by up to {}",
                    rounded_up(*distance),
                    rounded_up(*curve)
                ),
                Loss::NoWayBack { kind } => {
                    format!("the {kind} polygon written cannot be converted back to a float polygon")
                }
                Loss::Cubics { count, off } => {
                    let cubics = counted(*count, "cubic Bézier", "cubic Béziers");
                    format!("written as {cubics}, up to {} off", rounded_up(*off))
                }
                Loss::Periodic => {
                    "written as an open curve that ends where it begins"
                        .to_owned()
                }
                Loss::PolygonWeights { kind } => {
                    format!("the {kind} polygon is drawn without its weights")
                }
                Loss::Reference => lost("references aren't"),
                Loss::PointWeights => lost("weights of points aren't"),
                Loss::Curve => lost("curves aren't"),
                Loss::Colour => lost("the colour isn't"),
                Loss::Hidden => lost("visibility isn't"),
                Loss::Locked => lost("the lock isn't"),
                Loss::LockedVertices => lost("vertex locks aren't"),
                Loss::Targets => lost("end targets aren't"),
                Loss::Match { end, source } => {
                    let (end, source) = (end.name(), quoted(source));
                    lost(&format!("the match of its {end} to {source} isn't"))
                }
                Loss::UnknownKeys => lost("unknown keys aren't"),
            };
            format!("{}: {text}", quoted(name))
        });
        let of_project = self
            .project_keys
            .then(|| lost("the project's unknown keys aren't"));
        let lines: Vec<String> = of_curves.chain(of_project).collect();
        formatter.write_str(&lines.join("\n"))
    }
}
