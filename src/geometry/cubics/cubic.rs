//! A cubic Bézier.

use glam::DVec2;

/// The vertices of a cubic Bézier in the plane.
pub type Cubic = [DVec2; 4];
