//! The outcome of an operation: its edits, figures and marks.

use glam::DVec3;

use super::atlas::Atlas;
use super::error::OperationError;
use super::handle::Handle;
use super::locks;
use super::matches;
use super::operands::Operands;
use super::value::Value;
use crate::document::{
    CurveId, Document, Edit, EditError, MatchPlace, ParameterSpan, Renumbering, quoted,
};
use crate::geometry::approximation::LevelComparison;
use crate::geometry::fairing::requirement::{Check, Requirement};
use crate::geometry::parameters::Quantity;
use crate::geometry::{Approximation, End, FloatPolygon, Mirror, Progress};

/// Hold the outcome of an operation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Whether all requirements hold; if not, edits are those of the best that was found, if
    /// there is one. [`Operation::run`](super::Operation::run) decides.
    pub reached: bool,
    /// The largest miss of a requirement as a length; `None` if only features are asked for, or nothing.
    /// [`Operation::run`](super::Operation::run) measures it.
    pub residual: Option<f64>,
    /// What is asked of curves as they are after the edits.
    pub requirements: Vec<(CurveId, Vec<Requirement>)>,
    /// The edits to make, in this order.
    pub edits: Vec<Edit>,
    /// How far the curve moves.
    pub deviation: Deviation,
    /// Whether vertices get other numbers, so that moves of vertices mean nothing.
    pub renumbered: bool,
    /// The operation's own figures.
    pub figures: Vec<Figure>,
    /// Where the curve stands for another one: the levels of both.
    pub equivalence: Option<Vec<LevelComparison>>,
    /// What the user may not want: sentences without a full stop at the end.
    pub warnings: Vec<String>,
    /// What else is to say: sentences without a full stop at the end.
    pub remarks: Vec<String>,
    /// What to draw on the canvas.
    pub annotations: Vec<Annotation>,
    /// The parameters of the curve between which it was joined; on a periodic curve the second may
    /// lie beyond the end.
    pub joint: Option<[f64; 2]>,
    /// Points on the canvas that set parameters when they are dragged.
    pub handles: Vec<Handle>,
    /// A plane of two parameters to choose from.
    pub atlas: Option<Atlas>,
    /// How the added curves are copies of the one that the operation works on.
    pub copied: Option<Copying>,
}

/// How copies are made of curves.
#[derive(Clone, Debug, PartialEq)]
pub enum Copying {
    /// Each curve has a mirror image.
    Mirrored(Mirror),
    /// Each curve has moved copies, which stand in a row with those of the others.
    Moved,
}

/// How far a curve moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Deviation {
    /// It is the same curve, but for the rounding of numbers to doubles.
    #[default]
    Exact,
    /// Its points move by no more than this length: a proved bound.
    AtMost(f64),
    /// Its largest distance from what it stands for is this, as samples show, to 1e-3 of itself.
    Measured(f64),
    /// The largest distance of the points that it was drawn through is this, outliers aside.
    FromPoints(f64),
    /// It is another curve; the distance is not measured.
    Unmeasured,
}

impl Deviation {
    /// The deviation of an approximation.
    pub(super) fn of(approximation: &Approximation) -> Self {
        if approximation.exact {
            Self::Exact
        } else {
            Self::AtMost(approximation.deviation)
        }
    }

    /// The bound on a curve that is moved by up to a length afterwards.
    pub(super) fn plus(self, length: f64) -> Self {
        match self {
            Self::Exact => Self::AtMost(length),
            Self::AtMost(before) | Self::Measured(before) => Self::AtMost(before + length),
            Self::FromPoints(before) => Self::FromPoints(before + length),
            Self::Unmeasured => Self::Unmeasured,
        }
    }

    /// The larger of two.
    pub(super) fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Unmeasured, _) | (_, Self::Unmeasured) => Self::Unmeasured,
            (Self::AtMost(a), Self::AtMost(b)) => Self::AtMost(a.max(b)),
            (Self::Measured(a), Self::AtMost(b) | Self::Measured(b))
            | (Self::AtMost(a), Self::Measured(b)) => Self::Measured(a.max(b)),
            (Self::Exact, other) => other,
            (this, Self::Exact) => this,
            (Self::FromPoints(length), _) | (_, Self::FromPoints(length)) => {
                Self::FromPoints(length)
            }
        }
    }
}

/// A figure that belongs to one operation only.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its key in JSON.
    pub name: &'static str,
    /// What the panel calls it.
    pub label: &'static str,
    /// The figure.
    pub value: Value,
    /// Its unit.
    pub quantity: Quantity,
}

impl Figure {
    /// Count items.
    pub(super) fn count(name: &'static str, label: &'static str, count: usize) -> Self {
        Self::new(name, label, Value::Whole(count), Quantity::Number)
    }

    /// Report a length.
    pub(super) fn length(name: &'static str, label: &'static str, length: f64) -> Self {
        Self::new(name, label, Value::Real(length), Quantity::Length)
    }

    /// List the numbers of items, counted from 0.
    pub(super) fn indices(name: &'static str, label: &'static str, indices: &[usize]) -> Self {
        let value = Value::Indices(indices.to_vec());
        Self::new(name, label, value, Quantity::Number)
    }

    /// Report rows of numbers under names.
    pub(super) fn table(
        name: &'static str,
        label: &'static str,
        columns: &'static [&'static str],
        rows: Vec<Vec<f64>>,
    ) -> Self {
        Self::new(
            name,
            label,
            Value::Table { columns, rows },
            Quantity::Number,
        )
    }

    /// Report an end of a first curve and one of a second.
    pub(super) fn ends(name: &'static str, label: &'static str, ends: [End; 2]) -> Self {
        Self::new(name, label, Value::Ends(ends), Quantity::Number)
    }

    /// Report a word.
    pub(super) fn word(name: &'static str, label: &'static str, word: &'static str) -> Self {
        Self::new(name, label, Value::Word(word), Quantity::Number)
    }

    /// Report an angle, in radians.
    pub(super) fn angle(name: &'static str, label: &'static str, radians: f64) -> Self {
        Self::new(name, label, Value::Real(radians), Quantity::Angle)
    }

    fn new(name: &'static str, label: &'static str, value: Value, quantity: Quantity) -> Self {
        Self {
            name,
            label,
            value,
            quantity,
        }
    }
}

/// Something to draw on the canvas, in model space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Annotation {
    /// A point, such as one where a curve is cut.
    Point(DVec3),
    /// An arrow, such as one from an end to its target.
    Arrow {
        /// Where it begins.
        from: DVec3,
        /// Where its tip is.
        to: DVec3,
    },
}

impl Outcome {
    /// Give a curve another polygon with the same numbers of vertices.
    pub(super) fn reshaped(curve: CurveId, polygon: FloatPolygon, deviation: Deviation) -> Self {
        Self {
            edits: vec![Edit::SetPolygon { curve, polygon }],
            ..Self::unchanged(deviation)
        }
    }

    /// Give a curve a polygon of other vertices, with the spans of parameters that both have. Locked vertices that
    /// remain stay locked; remarks count the locks and the matches at places of the curve that are lost.
    pub(super) fn renumbered(
        input: &Operands,
        polygon: FloatPolygon,
        spans: Vec<ParameterSpan>,
        deviation: Deviation,
    ) -> Result<Self, OperationError> {
        let (id, curve) = input.curve()?;
        let renumbering = Renumbering::of_parameters(curve, &polygon, spans);
        let lost = locks::lost(curve, &[&polygon]);
        let cut_off = matches::cut_off(input.document(), id, &renumbering);
        Ok(Self {
            renumbered: true,
            remarks: lost.into_iter().chain(cut_off).collect(),
            edits: vec![Edit::Renumber {
                curve: id,
                polygon,
                renumbering,
            }],
            ..Self::unchanged(deviation)
        })
    }

    /// Let what is matched to an end of the renumbered curve follow the place where that end was: `u` of its new
    /// polygon.
    pub(super) fn keep_followers(
        &mut self,
        input: &Operands,
        end: End,
        u: f64,
    ) -> Result<(), OperationError> {
        let (id, document) = (input.curve()?.0, input.document());
        for edit in &mut self.edits {
            if let Edit::Renumber { renumbering, .. } = edit {
                let was = MatchPlace::Parameter(u);
                *renumbering = renumbering.clone().with_end(end, was);
            }
        }
        let matches = document.matches();
        let stays = matches.filter(|it| it.source == id && it.place == MatchPlace::End(end));
        self.remarks.extend(stays.filter_map(|it| {
            let name = quoted(document.name(it.curve)?);
            Some(format!(
                "{name} follows the place where the {} was",
                end.name()
            ))
        }));
        Ok(())
    }

    /// Change nothing.
    pub(super) fn unchanged(deviation: Deviation) -> Self {
        Self {
            deviation,
            ..Self::default()
        }
    }

    /// Check the requirements on a document that has the edits; `None` if `progress` is cancelled. One on a curve
    /// that does not exist fails.
    pub(super) fn check(&self, after: &Document, progress: &Progress) -> Option<Check> {
        let mut check = Check {
            holds: true,
            residual: None,
        };
        for (id, requirements) in &self.requirements {
            check = check.and(match after.curve(*id) {
                Some(curve) => Check::of(requirements, &curve.polygon, progress)?,
                None => Check {
                    holds: false,
                    residual: None,
                },
            });
        }
        Some(check)
    }

    /// Whether there is something to keep: what was asked for, or the best that was found.
    pub fn is_useful(&self) -> bool {
        self.reached || !self.edits.is_empty()
    }

    /// Make the edits in a copy of a document.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; never for the document that the
    /// operation ran on.
    pub fn applied_to(&self, document: &Document) -> Result<Document, EditError> {
        document.edited(self.edits.iter().cloned())
    }
}
