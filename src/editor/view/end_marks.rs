//! The marks of a curve's ends and their targets on the canvas.

use glam::{DQuat, DVec2, DVec3};

use crate::document::Curve;
use crate::editor::view::osculating_circle::{FARTHEST, OsculatingCircle};
use crate::editor::view::viewport::Viewport;
use crate::geometry::end_correction::EndDifference;
use crate::geometry::{End, rotation_between};

/// The length of a target direction's arrow, in screen points.
pub const ARROW: f64 = 64.0;

/// The radius of the ring that rotates the terminal vertices, in screen points.
pub const RING: f64 = 40.0;

/// Chords in the arc that shows the difference angle.
const ARC_STEPS: u8 = 48;

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
    /// The target's osculating circle, or the part of it that is near; only of the chosen end.
    pub circle: Vec<DVec2>,
    /// Whether the end meets its match; `None` if it has none.
    pub matched: Option<bool>,
    /// The radius of the ring that rotates the terminal vertices, in units of the model.
    pub ring: f64,
    /// The terminal vertices.
    pub terminal: Vec<DVec2>,
    /// The difference angle in radians.
    pub angle: f64,
    /// The way that the unit tangent takes through the difference angle, as it is seen.
    pub arc: Vec<DVec2>,
}

/// Make the marks of one end; `matched` tells whether it meets its match.
pub fn marks(
    curve: &Curve,
    end: End,
    chosen: bool,
    matched: Option<bool>,
    viewport: &Viewport,
) -> Option<EndFitMarks> {
    let target = curve.targets.get(end);
    if target.is_none() && !chosen {
        return None;
    }
    let polygon = &curve.polygon;
    let jet = polygon.end_jet(end);
    let arrow = ARROW * viewport.pixel();
    let along = |direction: DVec3| {
        viewport
            .flatten(direction)
            .try_normalize()
            .map(|d| arrow * d)
    };
    let actual = viewport.flatten(jet.point);
    let terminal = polygon.terminal_vertices(end).filter(|_| chosen);
    let difference = target.map(|target| EndDifference::between(polygon, end, &target));
    let direction = target.and_then(|target| target.direction);
    let turn = jet.tangent().zip(direction.filter(|_| chosen));
    Some(EndFitMarks {
        chosen,
        actual,
        tangent_tip: jet.tangent().and_then(along).map(|arm| actual + arm),
        target: target.map(|target| viewport.flatten(target.point)),
        target_tip: target
            .and_then(|target| Some(viewport.flatten(target.point) + along(target.direction?)?)),
        circle: target
            .filter(|_| chosen)
            .and_then(|target| OsculatingCircle::of(&target, curve, end))
            .map_or(Vec::new(), |circle| circle.chain_within(viewport, FARTHEST)),
        matched,
        ring: RING * viewport.pixel(),
        terminal: terminal
            .map(|index| viewport.flatten(polygon.vertex(index)))
            .collect(),
        angle: difference.map_or(0.0, |difference| difference.angle),
        arc: turn.map_or(Vec::new(), |(from, to)| turning(from, to, viewport)),
    })
}

/// Follow a unit vector as it turns to a direction the shortest way, as it is seen.
fn turning(from: DVec3, to: DVec3, viewport: &Viewport) -> Vec<DVec2> {
    let Some(rotation) = rotation_between(from, to) else {
        return Vec::new();
    };
    let whole = DQuat::from_mat3(&rotation);
    let steps = (0..=ARC_STEPS).map(|step| f64::from(step) / f64::from(ARC_STEPS));
    steps
        .map(|share| viewport.flatten(DQuat::IDENTITY.slerp(whole, share) * from))
        .collect()
}
