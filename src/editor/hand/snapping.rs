//! Snapping: dragged points prefer vertices, ends, targets, references and the grid.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use crate::document::{CurveId, Document, MatchPlace};
use crate::editor::selection::VertexId;
use crate::editor::view::grid::{grid_steps, ground_steps};
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;
use crate::editor::view::viewport::Viewport;
use crate::geometry::End;

/// Screen points within which the grid attracts: less than vertices do.
const GRID_REACH: f64 = 5.0;

/// The middle of a leg attracts where the leg is longer than this, in screen points: else its vertices are near.
const LONG_LEG: f64 = 6.0 * REACH;

/// A place at a smaller angle from a line, in radians, lies on it.
const ON_LINE: f64 = 1e-12;

/// How much farther than a vertex the end of a curve may be to come before it, in screen points.
const AHEAD: f64 = 4.0;

/// What goes along with a dragged point, and does not attract it.
#[derive(Clone, Debug, Default)]
pub struct Carried {
    /// The vertices.
    pub vertices: BTreeSet<VertexId>,
    /// The target of a curve's end.
    pub target: Option<(CurveId, End)>,
    /// The reference, or the curve whose points move.
    pub item: Option<CurveId>,
    /// The guide, by its place among the document's.
    pub guide: Option<usize>,
    /// Whether it does not lie on the ground, whose grid it only seems to meet where the view is turned.
    pub is_off_ground: bool,
}

impl Carried {
    /// Whether a curve or a reference, or a part of it, moves along.
    pub fn takes_along(&self, id: CurveId) -> bool {
        let from = self.vertices.range((id, 0)..);
        let vertex = from.map(|(curve, _)| *curve).next();
        vertex == Some(id) || self.item == Some(id)
    }
}

/// A snap of a dragged place.
#[derive(Clone, Debug, PartialEq)]
pub struct Snap {
    /// The point of the model.
    pub point: DVec3,
    /// Its name, in a word or two.
    pub name: String,
    /// The alignment lines that it keeps to, in the view plane.
    pub lines: Vec<[DVec2; 2]>,
}

impl Snap {
    /// A snap to a point.
    pub fn to(point: DVec3, name: impl Into<String>) -> Self {
        Self {
            point,
            name: name.into(),
            lines: Vec::new(),
        }
    }

    /// Whether another place of the view plane lies on the alignment line, if it is one.
    pub fn is_on_line(&self, place: DVec2) -> bool {
        let [[from, to]] = self.lines[..] else {
            return false;
        };
        let (along, other) = (to - from, place - from);
        along.perp_dot(other).abs() <= ON_LINE * along.length() * other.length()
    }

    /// The alignment lines, as they are drawn.
    pub fn line_marks(&self) -> impl Iterator<Item = Mark> + '_ {
        let lines = self.lines.iter();
        lines.map(|ends| Mark::Axis {
            ends: *ends,
            axis: None,
        })
    }
}

/// Find what a dragged place of the view plane snaps to, or `None` if nothing is near: vertices, the middles of long
/// legs, end points, targets, the points of lists, and the origin. An end comes before a vertex that lies beside it.
///
/// Vertices that are carried along do not attract.
pub fn snap_to_point(
    place: DVec2,
    document: &Document,
    carried: &Carried,
    viewport: &Viewport,
) -> Option<Snap> {
    let reach = REACH * viewport.pixel();
    let mut best: Option<(f64, Snap)> = None;
    let mut consider = |point: DVec3, ahead: f64, name: &dyn Fn() -> String| {
        let distance = viewport.flatten(point).distance(place);
        let counted = distance - ahead * viewport.pixel();
        let is_best = best.as_ref().is_none_or(|(nearest, _)| counted < *nearest);
        if distance <= reach && is_best {
            best = Some((counted, Snap::to(point, name())));
        }
    };
    for (id, curve) in document.curves().filter(|(_, curve)| curve.visible) {
        let polygon = &curve.polygon;
        for (index, vertex) in polygon.vertices().iter().enumerate() {
            let near = viewport.flatten(*vertex).distance(place) <= reach;
            if near && !carried.vertices.contains(&(id, index)) {
                consider(*vertex, 0.0, &|| format!("Vertex {index}"));
            }
        }
        for end in End::BOTH {
            if let Some(target) = curve.targets.get(end)
                && carried.target != Some((id, end))
            {
                consider(target.point, 0.0, &|| {
                    format!("Target of the {}", end.name())
                });
            }
            let feels = |index| carried.vertices.contains(&(id, index));
            if !polygon.is_periodic() && !polygon.terminal_vertices(end).any(feels) {
                let name = match end {
                    End::Start => "Start",
                    End::Finish => "End",
                };
                consider(polygon.end_jet(end).point, AHEAD, &|| name.to_owned());
            }
        }
    }
    let references = document.references();
    let others = references
        .filter(|(id, it)| it.visible && carried.item != Some(*id) && it.picture.is_none());
    for (id, reference) in others {
        let ends = || {
            let jets = End::BOTH.map(|end| MatchPlace::End(end).jet(&reference.curve));
            jets.into_iter().flatten().map(|jet| jet.point).collect()
        };
        for point in reference.points().unwrap_or_else(ends) {
            consider(point, 0.0, &|| reference_name(id, document));
        }
    }
    consider(DVec3::ZERO, 0.0, &|| "Origin".to_owned());
    let point = best.map(|(_, snap)| snap);
    // Ends of curves often lie beside the middle of a leg: they come first.
    point.or_else(|| snap_to_middle(place, document, carried, viewport))
}

/// Find the middle of a long leg near a place of the view plane whose vertices are not carried along.
fn snap_to_middle(
    place: DVec2,
    document: &Document,
    carried: &Carried,
    viewport: &Viewport,
) -> Option<Snap> {
    let mut best: Option<(f64, Snap)> = None;
    for (id, curve) in document.curves().filter(|(_, curve)| curve.visible) {
        let polygon = &curve.polygon;
        let count = polygon.vertices().len();
        for from in 0..count - usize::from(!polygon.is_periodic()) {
            let ends = [from, (from + 1) % count];
            let [start, end] = ends.map(|index| polygon.vertex(index));
            let middle = 0.5 * (start + end);
            let distance = viewport.flatten(middle).distance(place);
            let nearest = best.as_ref().map_or(f64::INFINITY, |(nearest, _)| *nearest);
            let length = viewport.flatten(start).distance(viewport.flatten(end));
            let is_carried = ends.iter().any(|it| carried.vertices.contains(&(id, *it)));
            if distance <= REACH * viewport.pixel()
                && distance < nearest
                && length >= LONG_LEG * viewport.pixel()
                && !is_carried
            {
                let name = format!("Middle of vertices {} and {}", ends[0], ends[1]);
                best = Some((distance, Snap::to(middle, name)));
            }
        }
    }
    best.map(|(_, snap)| snap)
}

/// The name of a snap to a reference.
pub fn reference_name(id: CurveId, document: &Document) -> String {
    format!("Reference {}", document.name(id).unwrap_or_default())
}

/// Find the crossing of the grid's minor lines that a place of the view plane snaps to, if one is near: of the grid in
/// the view plane, or of that on the ground where the view is turned against the model.
pub fn snap_to_grid(place: DVec2, viewport: &Viewport) -> Option<Snap> {
    let point = match viewport.orientation.axes() {
        Some(_) => {
            let (minor, _) = grid_steps(viewport);
            viewport.grounded((place / minor).round() * minor)
        }
        None => {
            let (minor, _) = ground_steps(viewport)?;
            let ground = viewport.grounded(place).truncate();
            ((ground / minor).round() * minor).extend(0.0)
        }
    };
    let near = viewport.flatten(point).distance(place) <= GRID_REACH * viewport.pixel();
    (near && point.is_finite()).then(|| Snap::to(point, "Grid"))
}

/// Find the grid's minor line along an axis that a line through a place of the view plane snaps to, if one is near.
pub fn snap_to_grid_line(place: DVec2, along: DVec2, viewport: &Viewport) -> Option<Snap> {
    viewport.orientation.axes()?;
    let (minor, _) = grid_steps(viewport);
    let axis = DVec2::AXES.iter().position(|it| it.dot(along) == 0.0)?;
    let mut on_grid = place;
    on_grid[axis] = (place[axis] / minor).round() * minor;
    let near = (on_grid - place).length() <= GRID_REACH * viewport.pixel();
    (near && on_grid.is_finite()).then(|| Snap::to(viewport.grounded(on_grid), "Grid"))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::FloatPolygon;

    #[test]
    fn an_end_comes_before_a_vertex_beside_it() {
        // The curve begins midway between its first two vertices.
        let points = [(0.0, 0.0), (4.0, 0.0), (100.0, 80.0), (200.0, 0.0)];
        let polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        let document = Document::from_curves([Curve::new("low", polygon)]);
        let found = |x: f64, scale: f64| {
            let place = DVec2::new(x, 0.0);
            let viewport = Viewport {
                scale,
                ..Viewport::default()
            };
            let snap = snap_to_point(place, &document, &Carried::default(), &viewport);
            snap.map(|snap| snap.name)
        };
        assert_eq!(found(3.5, 1.0).as_deref(), Some("Start"));
        assert_eq!(found(2.0, 1.0).as_deref(), Some("Start"));
        assert_eq!(found(3.5, 10.0).as_deref(), Some("Vertex 1"));
    }
}
