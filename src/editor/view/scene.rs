//! The contents of the canvas in model coordinates, ready to paint.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::analysis::Item;
use crate::document::{Colour, CurveId};
use crate::editor::jobs::pyramid::Pyramid;
use crate::editor::view::comb::CombSettings;
use crate::editor::view::end_marks::EndFitMarks;
use crate::editor::view::feature_report::FeatureMark;
use crate::editor::view::layers::Layers;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{ViewBox, append_gap};
use crate::geometry::degrees_text;

/// All that is on the canvas, from back to front. Chains are points in the model's plane; a NaN
/// point ([`crate::editor::GAP`]) breaks them.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The pictures that are shown, behind everything else.
    pub pictures: Vec<PictureScene>,
    /// The references that are shown, then the curves.
    pub curves: Vec<CurveScene>,
    /// The curves that the gesture or the operation changes as they were before, with their float S-polygons, drawn
    /// faintly.
    pub ghost: CurveScene,
    /// The curve that a click would make, with its polygons; empty if it would make none.
    pub proposal: CurveScene,
    /// The marks of tools, operations and comparisons.
    pub marks: Vec<Mark>,
    /// The end-fit tool's marks, and the targets of all curves.
    pub ends: Vec<EndFitMarks>,
    /// What guides the move of a vertex.
    pub guides: GuideScene,
    /// The hovered thing.
    pub hover: Option<HoverScene>,
}

/// A picture in its frame.
#[derive(Clone, Debug)]
pub struct PictureScene {
    /// The lower left corner.
    pub corner: DVec2,
    /// The vectors along the lower and along the left side.
    pub sides: [DVec2; 2],
    /// How strongly it is drawn, from 0 to 1.
    pub opacity: f64,
    /// The picture, or what the frame says in its place.
    pub picture: Result<Arc<Pyramid>, String>,
}

/// The layers of one curve or reference; those that are not shown are empty.
#[derive(Clone, Debug, Default)]
pub struct CurveScene {
    /// What it was made of, if it can be kept for the next frame.
    pub(super) source: Option<SceneSource>,
    /// The curve or the reference.
    pub id: Option<CurveId>,
    /// Whether it is a reference.
    pub is_reference: bool,
    /// Whether it is the active one; the others step back.
    pub active: bool,
    /// Whether it is selected with others.
    pub selected: bool,
    /// Whether it is locked.
    pub locked: bool,
    /// Whether it is a preview that does not meet the request.
    pub unreached: bool,
    /// Its own colour.
    pub colour: Option<Colour>,
    /// The comb's teeth.
    pub teeth: Vec<[DVec2; 2]>,
    /// The comb's envelope.
    pub comb: Vec<DVec2>,
    /// The evolute.
    pub evolute: Vec<DVec2>,
    /// The closed S-polygon's legs, without those that lie on the float one's.
    pub clamped: Legs,
    /// The closed S-polygon's vertices, without those that lie on the float one's.
    pub clamped_vertices: Vec<ClampedMark>,
    /// The float S-polygon's legs.
    pub float: Legs,
    /// The float S-polygon's vertices, without those that crowd.
    pub vertices: Vec<VertexMark>,
    /// The curve itself.
    pub curve: Vec<DVec2>,
    /// The points of a reference that is a list of them.
    pub points: Vec<DVec2>,
    /// Its pieces of rising, falling and undecided curvature, in the order of
    /// [`crate::editor::PieceTrend::ALL`].
    pub pieces: [Vec<DVec2>; 3],
    /// Its proved features.
    pub features: Vec<FeatureMark>,
    /// The joints between segments: points with the curve's normals, of length 1 or less where they crowd.
    pub joints: Vec<[DVec2; 2]>,
}

/// All that the scene of an inactive curve or reference depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SceneSource {
    pub(super) id: CurveId,
    pub(super) item: Item,
    pub(super) view: ViewBox,
    pub(super) orientation: Orientation,
    pub(super) layers: Layers,
    pub(super) comb: Option<CombSettings>,
    pub(super) selected: bool,
}

/// The legs of a polygon, by the strength with which they are drawn: where they crowd they fade.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Legs {
    chains: [Vec<DVec2>; LEG_STRENGTHS],
}

/// How many strengths of legs there are.
const LEG_STRENGTHS: usize = 5;

impl Legs {
    /// The chains with the strength of each, more than 0 and at most 1.
    pub fn chains(&self) -> impl Iterator<Item = (&[DVec2], f32)> {
        let chains = self.chains.iter().enumerate();
        chains.map(|(step, chain)| (chain.as_slice(), (step + 1) as f32 / LEG_STRENGTHS as f32))
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.chains.iter().all(Vec::is_empty)
    }

    /// Forget all.
    pub fn clear(&mut self) {
        self.chains.iter_mut().for_each(Vec::clear);
    }

    /// Add a leg of a strength between 0 and 1; the last one goes on where it begins.
    pub fn add(&mut self, [from, to]: [DVec2; 2], strength: f32) {
        let step = (strength * LEG_STRENGTHS as f32).ceil() as usize;
        let Some(chain) = step
            .checked_sub(1)
            .and_then(|step| self.chains.get_mut(step))
        else {
            return;
        };
        if chain.last() != Some(&from) {
            append_gap(chain);
            chain.push(from);
        }
        chain.push(to);
    }
}

/// A vertex of a closed S-polygon, as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClampedMark {
    /// Where it is.
    pub at: DVec2,
    /// The share of its full size.
    pub size: f32,
}

/// A vertex of a float S-polygon, as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexMark {
    /// Its number, counted from 0.
    pub index: usize,
    /// Where it is.
    pub at: DVec2,
    /// Whether it is selected.
    pub selected: bool,
    /// Whether the vertex itself is locked.
    pub locked: bool,
    /// The share of its full size.
    pub size: f32,
}

/// A mark of a tool, an operation or a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A dashed line, such as the leg that a click would add.
    Guide([DVec2; 2]),
    /// The axis of a symmetric curve.
    SymmetryAxis([DVec2; 2]),
    /// A guide.
    GuideLine([DVec2; 2]),
    /// A line that measures.
    Ruler([DVec2; 2]),
    /// The figures of a measurement, beside a place.
    Measured(DVec2, Vec<MeasuredFigure>),
    /// A box that selects, by opposite corners.
    SelectionBox([DVec2; 2]),
    /// A vertex that a click would add.
    NewVertex(DVec2),
    /// The pivot of a rotation or scaling.
    Pivot(DVec2),
    /// The ring that rotates about a pivot.
    Ring {
        /// The pivot.
        centre: DVec2,
        /// The handle, on the ring.
        handle: DVec2,
        /// By how much it has turned to come there, in radians.
        swept: f64,
    },
    /// The box that scales, by its corners, which are handles, and those that scale along one axis.
    Corners {
        /// The corners.
        corners: [DVec2; 4],
        /// The handles for one axis each.
        sides: Vec<DVec2>,
    },
    /// The frame of a reference.
    Frame {
        /// Its corners, handles that scale.
        corners: [DVec2; 4],
        /// From the middle of a side to the handle that rotates.
        arm: [DVec2; 2],
    },
    /// A place that the pointer snapped to.
    Snap(DVec2),
    /// A name beside a place.
    Name(DVec2, String),
    /// The line that a drag keeps to, and the axis of the model (0 x, 1 y, 2 z) that it is.
    Axis {
        /// Its ends, beyond the canvas.
        ends: [DVec2; 2],
        /// The axis of the model; `None` for a direction of the screen.
        axis: Option<usize>,
    },
    /// The readout of a drag, beside the dragged point.
    Drag(DragReadout),
    /// A place with the largest value: of unevenness in the flow of vertices, or of the distance between
    /// curves.
    Extreme {
        /// Where it is.
        at: DVec2,
        /// The quantity that is largest there, in a few words.
        text: String,
    },
    /// A handle that sets parameters of an operation.
    Handle {
        /// Where it is.
        at: DVec2,
        /// Whether the pointer is on it, or drags it.
        marked: bool,
    },
    /// Where ends of curves meet.
    Joint {
        /// Where it is.
        at: DVec2,
        /// The continuity that holds, where it is written.
        name: Option<&'static str>,
    },
    /// A short text at a place.
    Label(DVec2, String),
    /// Distances from a curve, from the curve on.
    Whiskers {
        /// From the curve to the tips.
        lines: Vec<[DVec2; 2]>,
        /// Whether they are longer than allowed.
        beyond: bool,
    },
    /// Points that are fitted.
    Points {
        /// Those that count.
        kept: Vec<DVec2>,
        /// Those that are left out.
        left_out: Vec<DVec2>,
        /// The one that a click would switch.
        hovered: Option<DVec2>,
    },
}

/// A figure of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredFigure {
    /// Its name.
    pub name: &'static str,
    /// Its value, in units of the model or in degrees; two where a periodic curve may be followed either way.
    pub values: Vec<f64>,
    /// Whether it is an angle.
    pub is_angle: bool,
    /// Whether it is known only to plotting accuracy.
    pub is_about: bool,
}

impl MeasuredFigure {
    /// Say the figure, with lengths as they are to be written.
    pub fn text(&self, length: impl Fn(f64) -> String) -> String {
        let value = |value: &f64| match self.is_angle {
            true => degrees_text(*value, 3),
            false => length(*value),
        };
        let values: Vec<String> = self.values.iter().map(value).collect();
        let about = if self.is_about { "≈ " } else { "" };
        format!("{} {about}{}", self.name, values.join(" or "))
    }
}

/// The readout of a drag: by how much, and to where.
#[derive(Clone, Debug, PartialEq)]
pub struct DragReadout {
    /// Where the point is seen.
    pub at: DVec2,
    /// Where it goes, as it is seen: the readout stands on the other side.
    pub way: DVec2,
    /// How far it was moved.
    pub by: DVec3,
    /// Where it is.
    pub to: DVec3,
    /// Whether the readout shows z.
    pub in_space: bool,
    /// Remarks, a line each.
    pub remarks: Vec<String>,
}

/// The hovered vertex, place or handle, and its text.
#[derive(Clone, Debug, PartialEq)]
pub enum HoverScene {
    /// A vertex of a float S-polygon.
    Vertex {
        /// Where it is.
        at: DVec2,
        /// The point itself.
        point: DVec3,
        /// Its number and coordinates, in words; empty while it is dragged.
        text: String,
    },
    /// A place on a curve.
    Curve {
        /// The curve.
        curve: CurveId,
        /// The parameter u.
        u: f64,
        /// The curvature: signed for a planar curve, not negative in space.
        curvature: f64,
        /// Where it is seen.
        at: DVec2,
        /// The point itself.
        point: DVec3,
        /// The centre of the osculating circle of a planar curve seen from above; `None` where it
        /// is straight, or seen otherwise.
        centre: Option<DVec2>,
        /// The osculating circle of a curve in space, or seen from elsewhere, as a chain.
        circle: Vec<DVec2>,
        /// u, point, curvature and radius, in words, a line each.
        text: String,
    },
    /// A leg, a target or another handle.
    Handle {
        /// Where it is.
        at: DVec2,
        /// What it is, in words.
        text: String,
    },
}

impl Scene {
    /// The curve or reference that is hovered, with the parameter and the curvature of the place.
    pub fn hovered(&self) -> Option<(CurveId, f64, f64)> {
        match self.hover {
            Some(HoverScene::Curve {
                curve,
                u,
                curvature,
                ..
            }) => Some((curve, u, curvature)),
            _ => None,
        }
    }
}

/// What guides the move of a vertex. Chains are points of the view plane, broken by
/// [`crate::editor::GAP`].
#[derive(Clone, Debug, Default)]
pub struct GuideScene {
    /// The selected vertex, and the corners of its safe region round it.
    pub region: Option<(DVec2, Vec<DVec2>)>,
    /// The border of that region.
    pub border: Vec<DVec2>,
    /// Where the region goes on beyond the radius in which it was looked for.
    pub limit: Vec<DVec2>,
    /// The moves that lose the chosen feature, the shortest first.
    pub arrows: Vec<LossArrow>,
    /// Texts, the weightiest first: one that would lie over an earlier one is left out.
    pub labels: Vec<GuideLabel>,
}

/// A move of a vertex that loses a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossArrow {
    /// From where the vertex is to where it goes.
    pub ends: [DVec2; 2],
    /// Whether no shorter one was found.
    pub is_shortest: bool,
}

/// A text beside a place.
#[derive(Clone, Debug, PartialEq)]
pub struct GuideLabel {
    /// The place.
    pub at: DVec2,
    /// On which side of it the text stands.
    pub outwards: DVec2,
    /// The text.
    pub text: String,
}

impl GuideScene {
    /// Show nothing.
    pub fn clear(&mut self) {
        self.region = None;
        self.border.clear();
        self.limit.clear();
        self.arrows.clear();
        self.labels.clear();
    }
}
