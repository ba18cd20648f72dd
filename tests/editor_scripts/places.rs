//! Places on the canvas by what lies there, so that a script means the same whatever came before.

use batten::document::{Curve, CurveId};
use batten::geometry::{ClampedPolygon, End};
use glam::{DVec2, DVec3};

use super::window::{CANVAS, Window};

/// What lies at a place. Curves, vertices, legs and teeth are counted from 0 and round again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A vertex of a curve.
    Vertex(usize, usize),
    /// A vertex of the active curve.
    Own(usize),
    /// A vertex of a curve that is not active.
    Other(usize),
    /// A share of the way along a leg of the active curve.
    Leg(usize, f64),
    /// A share of the way along the active curve's parameter.
    Curve(f64),
    /// A vertex of the active curve's closed S-polygon.
    Clamped(usize),
    /// The tip of a tooth of the active curve's comb.
    Tooth(usize),
    /// An end of the active curve.
    End(End),
    /// A place on the end-fit tool's ring, by its angle.
    Ring(f64),
    /// The target that the end-fit tool works on.
    Target,
    /// The tip of its arrow.
    Arrow,
    /// The pivot of the tool.
    Pivot,
    /// A place of the canvas, in screen points.
    At(DVec2),
}

impl Place {
    /// Find it on the canvas; `None` if there is no such thing.
    pub fn find(self, window: &mut Window) -> Option<DVec2> {
        if let Self::At(at) = self {
            return Some(at);
        }
        let seen = self.in_view(window)?;
        let at = window.viewport().to_screen(seen);
        at.is_finite().then_some(at)
    }

    /// Find it on the canvas, or take the middle.
    pub fn on_canvas(self, window: &mut Window) -> DVec2 {
        self.find(window).unwrap_or(0.5 * CANVAS)
    }

    /// Find it in the view plane.
    fn in_view(self, window: &mut Window) -> Option<DVec2> {
        match self {
            Self::Tooth(number) => {
                let mut tips = window.teeth();
                let length = |tooth: &[DVec2; 2]| tooth[0].distance(tooth[1]);
                // The longest come first.
                tips.sort_by(|a, b| length(b).total_cmp(&length(a)));
                let index = number.checked_rem(tips.len())?;
                tips.get(index).map(|tooth| tooth[1])
            }
            Self::Ring(angle) => {
                let marks = window.end_marks()?;
                Some(marks.actual + marks.ring * DVec2::from_angle(angle))
            }
            Self::Target => window.end_marks()?.target,
            Self::Arrow => window.end_marks()?.target_tip,
            Self::Pivot => window.pivot(),
            shaped => Some(window.viewport().flatten(shaped.in_space(window)?)),
        }
    }

    fn in_space(self, window: &Window) -> Option<DVec3> {
        if let Self::Vertex(curve, vertex) = self {
            return place_of(window, window.vertex(curve, vertex)?);
        }
        if let Self::Other(vertex) = self {
            let active = window.active();
            let is_other = |(id, curve): &(CurveId, &std::sync::Arc<Curve>)| {
                Some(*id) != active && curve.visible
            };
            let (id, curve) = window.document().curves().find(is_other)?;
            return place_of(window, (id, vertex % curve.polygon.vertices().len()));
        }
        let polygon = window.active_polygon()?;
        let count = polygon.vertices().len();
        Some(match self {
            Self::Own(vertex) => polygon.vertex(vertex % count),
            Self::Leg(leg, share) => {
                let legs = if polygon.is_periodic() {
                    count
                } else {
                    count - 1
                };
                let from = leg % legs;
                polygon
                    .vertex(from)
                    .lerp(polygon.vertex((from + 1) % count), share)
            }
            Self::Curve(share) => polygon.point(share * polygon.segments() as f64),
            Self::Clamped(vertex) => {
                let clamped = ClampedPolygon::from_float(&polygon);
                let vertices = clamped.vertices();
                vertices.get(vertex % vertices.len()).copied()?
            }
            Self::End(end) if !polygon.is_periodic() => polygon.end_jet(end).point,
            _ => return None,
        })
    }
}

fn place_of(window: &Window, (curve, vertex): (CurveId, usize)) -> Option<DVec3> {
    let curve = window.document().curve(curve)?;
    Some(curve.polygon.vertex(vertex))
}
