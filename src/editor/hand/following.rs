//! Whether the neighbours of dragged vertices and targets follow, and how far.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::document::{Curve, CurveId, Document, Edit, EditError};
use crate::editor::selection::VertexId;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::following::{Moved, follow_in_harmony, follow_softly, follow_target};
use crate::geometry::fairing::joint_correction::CorrectionError;
use crate::geometry::{End, FloatPolygon, PolygonError, counted, significant};

/// How neighbours follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Follow {
    /// By a falloff.
    Softly,
    /// So that the polygon stays harmonious.
    InHarmony,
}

impl Follow {
    /// Both ways.
    pub const ALL: [Self; 2] = [Self::Softly, Self::InHarmony];

    /// What menus call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Softly => "Soft drag",
            Self::InHarmony => "Live harmony",
        }
    }

    /// The help text.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::Softly => {
                "Let the neighbours of dragged vertices follow, the farther the less; the wheel sets how many"
            }
            Self::InHarmony => {
                "Let the neighbours of dragged vertices follow so that the polygon stays harmonious, with the ends held, and an end its dragged target; the wheel sets how many, with Shift how stiff they are"
            }
        }
    }
}

/// Hold how the neighbours of dragged vertices follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// How they follow, if they do.
    pub follow: Option<Follow>,
    /// How many neighbours follow on each side; the wheel turns it by fractions.
    span: f64,
    /// How much their own moves weigh beside harmony.
    stiffness: f64,
}

impl Default for Following {
    fn default() -> Self {
        Self {
            follow: None,
            span: 5.0,
            stiffness: 1e-4,
        }
    }
}

/// The most neighbours on each side.
const MOST: f64 = 1000.0;

/// The softest and the stiffest.
const STIFFNESS: [f64; 2] = [1e-8, 1e4];

/// How much faster the stiffness changes than the span when the wheel turns.
const STIFFNESS_TURN: i32 = 2;

impl Following {
    /// How many neighbours follow on each side.
    pub fn span(&self) -> usize {
        self.span.round() as usize
    }

    /// How much the neighbours' own moves weigh beside harmony.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Turn a way of following on, or off.
    pub fn toggle(&mut self, follow: Follow) {
        self.follow = Some(follow).filter(|_| self.follow != Some(follow));
    }

    /// Let more or fewer neighbours follow, by a factor as of a zoom, up to `most`; or make them
    /// stiffer.
    pub fn turn(&mut self, factor: f64, stiffer: bool, most: usize) {
        if stiffer {
            let turned = self.stiffness * factor.powi(STIFFNESS_TURN);
            self.stiffness = turned.clamp(STIFFNESS[0], STIFFNESS[1]);
        } else {
            self.span = (self.span * factor).min(most as f64).clamp(1.0, MOST);
        }
    }

    /// Say how the neighbours follow; `None` if they do not.
    pub fn words(&self) -> Option<String> {
        let neighbours = counted(self.span(), "neighbour", "neighbours");
        Some(match self.follow? {
            Follow::Softly => format!("{neighbours} each side"),
            Follow::InHarmony => {
                let stiffness = significant(self.stiffness, 2);
                format!("{neighbours} each side, stiffness {stiffness}")
            }
        })
    }

    /// Turn moved vertices into edits, one a curve, their neighbours following.
    ///
    /// # Errors
    /// [`EditError::Polygon`] if a vertex would leave the range of numbers.
    pub fn edits(
        &self,
        before: &Document,
        moved: impl IntoIterator<Item = (VertexId, DVec3)>,
    ) -> Result<Vec<Edit>, EditError> {
        let mut curves: BTreeMap<CurveId, Vec<(usize, DVec3)>> = BTreeMap::new();
        for ((curve, index), place) in moved {
            curves.entry(curve).or_default().push((index, place));
        }
        let edits = curves.into_iter().map(|(curve, moves)| {
            let Some(follow) = self.follow else {
                return Ok(Edit::MoveVertices { curve, moves });
            };
            self.edit(before, curve, |polygon, locked| match follow {
                Follow::Softly => follow_softly(polygon, &moves, self.span(), locked),
                Follow::InHarmony => {
                    let moved = Moved::Vertices(moves.clone());
                    follow_in_harmony(polygon, &moved, self.span(), self.stiffness, locked)
                }
            })
        });
        edits.collect()
    }

    /// Put a vertex of the closed S-polygon somewhere else: the float S-polygon follows, in harmony
    /// or alone.
    ///
    /// # Errors
    /// As [`Following::edits`].
    pub fn clamped_edit(
        &self,
        before: &Document,
        (curve, index): VertexId,
        place: DVec3,
    ) -> Result<Edit, EditError> {
        self.edit(before, curve, |polygon, locked| match self.follow {
            Some(Follow::InHarmony) => {
                let moved = Moved::Clamped(index, place);
                follow_in_harmony(polygon, &moved, self.span(), self.stiffness, locked)
            }
            Some(Follow::Softly) | None => polygon.with_clamped_vertex(index, place),
        })
    }

    /// Whether the ends of curves follow their targets while these are dragged: in harmony alone, as a
    /// falloff meets no direction.
    pub fn follows_targets(&self) -> bool {
        self.follow == Some(Follow::InHarmony)
    }

    /// Bring an end to a target, its neighbours following in harmony.
    ///
    /// # Errors
    /// [`CorrectionError`] if the target cannot be met.
    pub fn to_target(
        &self,
        curve: &Curve,
        end: End,
        target: &EndTarget,
    ) -> Result<FloatPolygon, CorrectionError> {
        let locked: Vec<usize> = curve.locked_vertices.iter().collect();
        let (span, stiffness) = (self.span(), self.stiffness);
        follow_target(&curve.polygon, end, target, span, stiffness, &locked)
    }

    fn edit(
        &self,
        before: &Document,
        id: CurveId,
        reshape: impl FnOnce(&FloatPolygon, &[usize]) -> Result<FloatPolygon, PolygonError>,
    ) -> Result<Edit, EditError> {
        let curve = before.curve(id).ok_or(EditError::NoSuchCurve)?;
        let locked: Vec<usize> = curve.locked_vertices.iter().collect();
        let polygon = reshape(&curve.polygon, &locked).map_err(|error| EditError::Polygon {
            name: curve.name.clone(),
            error,
        })?;
        Ok(Edit::SetPolygon { curve: id, polygon })
    }
}
