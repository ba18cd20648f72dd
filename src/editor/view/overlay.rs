//! The tool's and the operation's share of the canvas and the plots.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Reference};
use crate::editor::view::scene::{HoverScene, Mark};
use crate::geometry::mineur_farin::Atlas;
use crate::geometry::{End, FloatPolygon};

/// Hold what the tool and the operation show in one frame.
#[derive(Debug, Default)]
pub struct Overlay {
    /// Marks on the canvas.
    pub marks: Vec<Mark>,
    /// The handle under the pointer.
    pub handle: Option<HoverScene>,
    /// Whether marks show how far points are from the curve: then the distance between the two is not marked.
    pub measures_points: bool,
    /// What else the pointer can hover.
    pub hovering: Hovering,
    /// Whether the safe region of the selected vertex may be shown.
    pub guides: bool,
    /// The end that the end-fit tool corrects.
    pub fitted_end: Option<End>,
    /// The active curve before the preview, where it is shown.
    pub before: Option<Arc<Curve>>,
    /// The other curves that the operation changes, before it.
    pub others_before: Vec<Arc<Curve>>,
    /// The curves of the preview that do not meet the request.
    pub unreached: Vec<CurveId>,
    /// The polygon that a click would make, and the curve that it would change.
    pub proposal: Option<(FloatPolygon, Option<CurveId>)>,
    /// The reference that the operation was given.
    pub given: Option<Arc<Reference>>,
    /// The parameters between which the operation joined the active curve.
    pub joint: Option<[f64; 2]>,
    /// The plane of the atlas that the operation offers.
    pub atlas: Option<Atlas>,
}

impl Overlay {
    /// What other panes show of it, with marks of their own: what the pointer is over is in its pane alone.
    pub fn elsewhere(&self, marks: Vec<Mark>) -> Self {
        Self {
            marks,
            measures_points: self.measures_points,
            fitted_end: self.fitted_end,
            before: self.before.clone(),
            others_before: self.others_before.clone(),
            unreached: self.unreached.clone(),
            proposal: self.proposal.clone(),
            ..Self::default()
        }
    }
}

/// What the pointer can hover on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hovering {
    /// Nothing, as while the view is panned or points are set.
    #[default]
    Nothing,
    /// Only the vertex that is dragged.
    Dragged((CurveId, usize)),
    /// Vertices, features and curves.
    Document {
        /// What a drag of a closed vertex does to the others; `None` where it takes none.
        closed: Option<Closed>,
    },
}

/// What the other closed vertices do when one is dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closed {
    /// They follow with the least change.
    Follow {
        /// The least number of vertices that follow on each side beside those that one depends on.
        span: usize,
    },
    /// They stay, and the float S-polygon moves many times as far.
    Stay,
}
