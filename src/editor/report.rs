//! Reports for the panels: plain figures and texts, made anew each frame.

use glam::DVec3;

use crate::geometry::{Amplification, Range};

/// The figures of the status bar.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readout {
    /// The point of the model under the pointer: what is hovered, or in the plane through the point about
    /// which the view turns.
    pub pointer: Option<DVec3>,
    /// Whether z is shown: something is in space, or seen from elsewhere than from above.
    pub in_space: bool,
    /// The parameter of the hovered place: u of a curve, t of a reference.
    pub parameter: Option<f64>,
    /// What that is called.
    pub parameter_name: &'static str,
    /// The curvature there.
    pub curvature: Option<f64>,
    /// Screen points a unit.
    pub scale: f64,
    /// The active curve's degree.
    pub degree: Option<usize>,
}

/// What the inspector says of the active reference, beside the reference itself: figures of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceReport {
    /// Whether it is planar.
    pub planar: bool,
    /// The arc length, to plotting accuracy; `None` if the curve runs through infinity or jumps.
    pub length: Option<f64>,
    /// The smallest and largest curvature among the samples.
    pub curvature: Option<Range>,
}

/// The inspector's figures of the active curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveReport {
    /// Whether the curve is planar.
    pub planar: bool,
    /// The number of segments.
    pub segments: usize,
    /// The arc length, to plotting accuracy.
    pub length: f64,
    /// The smallest and largest curvature among the samples.
    pub curvature: Option<Range>,
    /// The smallest and largest leg of the float S-polygon.
    pub legs: Option<Range>,
    /// Its smallest and largest turning angle, in radians.
    pub turns: Option<Range>,
    /// How much errors in the closed S-polygon grow in the float S-polygon.
    pub amplification: Amplification,
}
