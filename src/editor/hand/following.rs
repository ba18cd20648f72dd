//! Whether the neighbours of dragged vertices and targets follow, and how far.

use std::collections::BTreeMap;

use glam::DVec3;
use thiserror::Error;

use crate::document::{Curve, CurveId, Document, Edit, EditError, quoted};
use crate::editor::selection::VertexId;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::following::{follow_softly, follow_target};
use crate::geometry::fairing::joint_correction::CorrectionError;
use crate::geometry::fairing::least_change::{
    Dragged, LeastChangeError, Reach, least_change, magnification,
};
use crate::geometry::{ClampedPolygon, End, FloatPolygon, counted, significant};

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
                "Let the neighbours of dragged vertices follow with the least change; the wheel sets how many"
            }
        }
    }
}

/// Hold how the neighbours of dragged vertices and points follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// How those of dragged vertices follow, if they do.
    pub follow: Option<Follow>,
    /// Whether the other vertices of the closed S-polygon stay where one of them is dragged.
    pub closed_stay: bool,
    /// How many neighbours of vertices follow on each side; the wheel turns it by fractions.
    span: f64,
    /// The same for a point of the curve or a closed vertex, beside the vertices that it depends on.
    point_span: f64,
    /// How much the neighbours' own moves weigh.
    stiffness: f64,
}

impl Default for Following {
    fn default() -> Self {
        Self {
            follow: None,
            closed_stay: false,
            span: 5.0,
            point_span: 1.0,
            stiffness: 1e-4,
        }
    }
}

/// Followers whose number the wheel sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Followers {
    /// The neighbours of vertices.
    OfVertices,
    /// The vertices near a point of the curve, or near a closed vertex.
    OfPoint,
}

/// A point that is dragged, which vertices of the float polygon follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DraggedPoint {
    /// What it is.
    pub kind: PointKind,
    /// The least number of vertices on each side that follow beside those that it depends on: where they crowd on the
    /// canvas, fewer would make a spike.
    pub least_span: usize,
}

/// What a dragged point is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointKind {
    /// A vertex of the closed S-polygon.
    Clamped(usize),
    /// The point of the curve at a parameter.
    OnCurve(f64),
}

impl PointKind {
    /// Where it is; `None` if the polygon does not have it.
    pub fn place(self, polygon: &FloatPolygon) -> Option<DVec3> {
        match self {
            Self::Clamped(index) => {
                let clamped = ClampedPolygon::from_float(polygon);
                clamped.vertices().get(index).copied()
            }
            Self::OnCurve(u) => Some(polygon.point(u)),
        }
    }

    /// The parameter that it belongs to.
    fn parameter(self, polygon: &FloatPolygon) -> f64 {
        match self {
            Self::OnCurve(u) => u,
            Self::Clamped(index) => polygon.clamped_greville(index),
        }
    }
}

impl DraggedPoint {
    fn by(self, by: DVec3) -> Dragged {
        match self.kind {
            PointKind::Clamped(index) => Dragged::Clamped(index, by),
            PointKind::OnCurve(u) => Dragged::Point(u, by),
        }
    }
}

/// Why a curve does not follow.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FollowError {
    /// The curve cannot be edited so.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// Too few of its vertices are free.
    #[error("{}: {error}", quoted(.name))]
    Least {
        /// The curve's name.
        name: String,
        /// The reason.
        error: LeastChangeError,
    },
}

/// How often a point of a symmetric curve is brought nearer to where it is dragged. Each time less than half is left.
const CORRECTIONS: usize = 8;

/// What may be left then, as a share of the drag.
const LEFT: f64 = 1e-9;

/// A correction that leaves more than this share is held back by the symmetry.
const NEARER: f64 = 0.5;

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

    /// How much the neighbours' own moves weigh.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Turn a way of following on, or off.
    pub fn toggle(&mut self, follow: Follow) {
        self.follow = Some(follow).filter(|_| self.follow != Some(follow));
    }

    /// Let more or fewer vertices follow, by a factor as of a zoom, up to `most`; or make those of vertices stiffer.
    pub(in crate::editor) fn turn(
        &mut self,
        followers: Followers,
        factor: f64,
        stiffer: bool,
        most: usize,
    ) {
        let span = match followers {
            Followers::OfVertices if stiffer => {
                let turned = self.stiffness * factor.powi(STIFFNESS_TURN);
                self.stiffness = turned.clamp(STIFFNESS[0], STIFFNESS[1]);
                return;
            }
            Followers::OfVertices => &mut self.span,
            Followers::OfPoint => &mut self.point_span,
        };
        *span = (*span * factor).min(most as f64).clamp(1.0, MOST);
    }

    /// Say how many vertices follow a point of a curve.
    pub(in crate::editor) fn point_words(
        &self,
        polygon: &FloatPolygon,
        point: DraggedPoint,
    ) -> String {
        let following = polygon.degree() + 1 + 2 * self.span_of(point);
        let following = following.min(polygon.vertices().len());
        format!("{} follow", counted(following, "vertex", "vertices"))
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
    /// [`FollowError`] if a vertex would leave the range of numbers.
    pub(in crate::editor) fn edits(
        &self,
        before: &Document,
        moved: impl IntoIterator<Item = (VertexId, DVec3)>,
    ) -> Result<Vec<Edit>, FollowError> {
        let mut curves: BTreeMap<CurveId, Vec<(usize, DVec3)>> = BTreeMap::new();
        for ((curve, index), place) in moved {
            curves.entry(curve).or_default().push((index, place));
        }
        let edits = curves.into_iter().map(|(curve, moves)| {
            let Some(follow) = self.follow else {
                return Ok(Edit::MoveVertices { curve, moves });
            };
            edit(before, curve, |curve, locked| match follow {
                Follow::Softly => {
                    let moves = curve.with_images(&moves);
                    Ok(follow_softly(&curve.polygon, &moves, self.span(), locked)?)
                }
                Follow::InHarmony => {
                    let dragged = Dragged::Vertices(curve.with_images(&moves));
                    let reach = Reach {
                        span: self.span(),
                        stiffness: self.stiffness,
                        locked,
                    };
                    least_change(&curve.polygon, &dragged, &reach)
                }
            })
        });
        edits.collect()
    }

    /// Drag a point of a curve: the vertices near it follow with the least change. A closed vertex whose others stay
    /// takes the exact change of the float polygon instead.
    ///
    /// # Errors
    /// [`FollowError`].
    pub(in crate::editor) fn point_edit(
        &self,
        before: &Document,
        curve: CurveId,
        point: DraggedPoint,
        by: DVec3,
    ) -> Result<Edit, FollowError> {
        edit(before, curve, |curve, locked| {
            let reshaped = |by: DVec3| -> Result<FloatPolygon, LeastChangeError> {
                let polygon = match point.kind {
                    PointKind::Clamped(index) if self.closed_stay => {
                        let from = point.kind.place(&curve.polygon).unwrap_or_default();
                        curve.polygon.with_clamped_vertex(index, from + by)?
                    }
                    _ => {
                        let reach = self.reach_of(point, locked);
                        least_change(&curve.polygon, &point.by(by), &reach)?
                    }
                };
                Ok(match curve.symmetry {
                    Some(symmetry) => {
                        symmetry.completed_from(&polygon, point.kind.parameter(&polygon))?
                    }
                    None => polygon,
                })
            };
            let polygon = reshaped(by)?;
            match (curve.symmetry, point.kind.place(&curve.polygon)) {
                (Some(_), Some(from)) => led_to(from + by, by, polygon, point.kind, reshaped),
                _ => Ok(polygon),
            }
        })
    }

    /// Measure how many times as far as a dragged point its vertices move, at most.
    ///
    /// # Errors
    /// [`LeastChangeError`] if too few vertices are free.
    pub(in crate::editor) fn point_magnification(
        &self,
        curve: &Curve,
        point: DraggedPoint,
    ) -> Result<f64, LeastChangeError> {
        let locked: Vec<usize> = curve.locked_vertices.iter().collect();
        let reach = self.reach_of(point, &locked);
        magnification(&curve.polygon, &point.by(DVec3::ZERO), &reach)
    }

    /// The reach of a dragged point, which has no stiffness.
    fn reach_of<'a>(&self, point: DraggedPoint, locked: &'a [usize]) -> Reach<'a> {
        Reach {
            span: self.span_of(point),
            stiffness: 0.0,
            locked,
        }
    }

    fn span_of(&self, point: DraggedPoint) -> usize {
        self.point_span().max(point.least_span)
    }

    /// How many vertices follow a point on each side beside those that it depends on, at least.
    pub(in crate::editor) fn point_span(&self) -> usize {
        self.point_span.round() as usize
    }

    /// Whether the ends of curves follow their targets while these are dragged: in harmony alone, as a
    /// falloff meets no direction.
    pub fn follows_targets(&self) -> bool {
        self.follow == Some(Follow::InHarmony)
    }

    /// Bring an end to a target, its neighbours following with the least change.
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
        follow_target(&curve.polygon, end, target, self.span(), &locked)
    }
}

/// Bring a dragged point of a symmetric curve to its place: near an axis its image moves it too. Where that does not come
/// nearer, as at the axis across it, the polygon stays.
fn led_to(
    place: DVec3,
    by: DVec3,
    mut polygon: FloatPolygon,
    kind: PointKind,
    reshaped: impl Fn(DVec3) -> Result<FloatPolygon, LeastChangeError>,
) -> Result<FloatPolygon, LeastChangeError> {
    let missing = |polygon: &FloatPolygon| kind.place(polygon).map(|at| place - at);
    let mut wanted = by;
    for _ in 0..CORRECTIONS {
        let Some(left) = missing(&polygon).filter(|it| it.length() > LEFT * by.length()) else {
            break;
        };
        wanted += left;
        let next = reshaped(wanted)?;
        let comes_near = |it: DVec3| it.length() < NEARER * left.length();
        if !missing(&next).is_some_and(comes_near) {
            break;
        }
        polygon = next;
    }
    Ok(polygon)
}

/// Reshape a curve whose locked vertices stay.
fn edit(
    before: &Document,
    id: CurveId,
    reshape: impl FnOnce(&Curve, &[usize]) -> Result<FloatPolygon, LeastChangeError>,
) -> Result<Edit, FollowError> {
    let curve = before.curve(id).ok_or(EditError::NoSuchCurve)?;
    let locked: Vec<usize> = curve.locked_vertices.iter().collect();
    let polygon = reshape(curve, &locked).map_err(|error| FollowError::Least {
        name: curve.name.clone(),
        error,
    })?;
    Ok(Edit::SetPolygon { curve: id, polygon })
}
