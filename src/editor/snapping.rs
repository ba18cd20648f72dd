//! Snapping: dragged points prefer vertices, ends, targets and the grid.

use std::collections::BTreeSet;

use glam::DVec2;

use super::grid::grid_steps;
use super::hit::REACH;
use super::selection::VertexId;
use super::viewport::Viewport;
use crate::document::Document;
use crate::geometry::End;

/// Screen points within which the grid attracts: less than vertices do.
const GRID_REACH: f64 = 5.0;

/// Find the place that a dragged point snaps to, or `None` if nothing is near.
///
/// Vertices that move along (`moving`) do not attract. Vertices, end points and targets come
/// before the grid's minor crossings. Places are in the view plane.
pub fn snap(
    point: DVec2,
    document: &Document,
    moving: &BTreeSet<VertexId>,
    viewport: &Viewport,
) -> Option<DVec2> {
    let reach = REACH * viewport.pixel();
    let mut best: Option<(f64, DVec2)> = None;
    let mut consider = |candidate: DVec2| {
        let distance = candidate.distance(point);
        if distance <= reach && best.is_none_or(|(nearest, _)| distance < nearest) {
            best = Some((distance, candidate));
        }
    };
    for (id, curve) in document.curves().filter(|(_, curve)| curve.visible) {
        let polygon = &curve.polygon;
        for (index, vertex) in polygon.vertices().iter().enumerate() {
            let at = viewport.flatten(*vertex);
            if at.distance(point) <= reach && !moving.contains(&(id, index)) {
                consider(at);
            }
        }
        for end in End::BOTH {
            if let Some(target) = curve.targets.get(end) {
                consider(viewport.flatten(target.point));
            }
            let feels = |index| moving.contains(&(id, index));
            if !polygon.is_periodic() && !polygon.terminal_vertices(end).any(feels) {
                consider(viewport.flatten(polygon.end_jet(end).point));
            }
        }
    }
    consider(DVec2::ZERO);
    best.map(|(_, place)| place).or_else(|| {
        // Only a view along an axis of the model shows the grid.
        viewport.orientation.axes()?;
        let (minor, _) = grid_steps(viewport);
        let crossing = (point / minor).round() * minor;
        let near = crossing.distance(point) <= GRID_REACH * viewport.pixel();
        (near && crossing.is_finite()).then_some(crossing)
    })
}

/// Constrain a movement to the nearer axis.
pub fn along_axis(movement: DVec2) -> DVec2 {
    if movement.x.abs() >= movement.y.abs() {
        DVec2::new(movement.x, 0.0)
    } else {
        DVec2::new(0.0, movement.y)
    }
}

/// Constrain an angle in radians to whole multiples of 15°.
pub fn by_fifteen_degrees(angle: f64) -> f64 {
    let step = 15f64.to_radians();
    (angle / step).round() * step
}
