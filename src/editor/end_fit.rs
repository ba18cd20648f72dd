//! The end-fit tool's state and figures: the paper's seven steps.

use glam::{DVec2, DVec3};

use crate::geometry::end_correction::EndOverlap;
use crate::geometry::{End, Range};

/// What the seven steps say of one end, in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct EndFitReport {
    /// The end that is being corrected.
    pub end: End,
    /// Whether the curve is planar: figures in z are left out then.
    pub planar: bool,
    /// The degree n: the number of terminal vertices.
    pub degree: usize,
    /// The number of vertices N.
    pub vertices: usize,
    /// Step 1: the smallest and largest leg.
    pub legs: Option<Range>,
    /// Step 1: the smallest and largest turning angle, in radians.
    pub turns: Option<Range>,
    /// The actual end point.
    pub point: DVec3,
    /// The actual unit tangent; `None` at a cusp.
    pub tangent: Option<DVec3>,
    /// The target point; `None` until it is set.
    pub target_point: Option<DVec3>,
    /// The target direction.
    pub target_direction: Option<DVec3>,
    /// Step 3: the difference vector.
    pub difference: DVec3,
    /// Step 3: the difference angle, in radians.
    pub angle: f64,
    /// The larger of the position difference and the difference angle's arc, over both ends
    /// that have targets.
    pub residual: f64,
    /// The tolerance that the loop works to, as a length.
    pub tolerance: f64,
    /// Whether both ends are within the tolerance.
    pub within: bool,
    /// Passes made by "repeat" since the targets last changed.
    pub passes: usize,
    /// How the two ends share their vertices.
    pub overlap: EndOverlap,
    /// What the last action came to, in words; `true` if it failed.
    pub outcome: Option<(String, bool)>,
    /// The largest move of a vertex by the last "both ends at once", and which vertex.
    pub largest_move: Option<(f64, usize)>,
}

/// Something that the end-fit panel asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndFitAction {
    /// Work on this end.
    Choose(End),
    /// Show the closed S-polygon (step 2), or go back to the float one (step 4).
    ShowClosed(bool),
    /// Put the target where the actual end is.
    TargetActual,
    /// Type the target point.
    SetPoint(DVec3),
    /// Type the target direction, or free it.
    SetDirection(Option<DVec3>),
    /// Forget the target.
    ClearTarget,
    /// Pick the target from another curve's end by the next click.
    PickFromCurve,
    /// Translate the terminal vertices by the difference vector (step 5).
    Translate,
    /// Rotate them by the difference angle (step 6).
    Rotate,
    /// Repeat steps 2 to 6 on every end that has a target until within the tolerance (step 7).
    Repeat,
    /// Correct both ends at once by the least disturbance.
    BothAtOnce,
    /// Set the tolerance, as a length.
    SetTolerance(f64),
}

/// One end's marks on the canvas.
#[derive(Clone, Debug, PartialEq)]
pub struct EndFitMarks {
    /// Whether the end-fit tool works on this end now; otherwise only the target is drawn.
    pub chosen: bool,
    /// The actual end point.
    pub actual: DVec2,
    /// The tip of the actual tangent's arrow.
    pub tangent_tip: Option<DVec2>,
    /// The target point.
    pub target: Option<DVec2>,
    /// The tip of the target direction's arrow; a handle.
    pub target_tip: Option<DVec2>,
    /// The radius of the ring that rotates the terminal vertices, in units of the model.
    pub ring: f64,
    /// The terminal vertices.
    pub terminal: Vec<DVec2>,
    /// The difference angle in radians, for the arc that shows it.
    pub angle: f64,
}
