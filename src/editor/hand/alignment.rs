//! Alignment lines: guides, level, upright, along and across an end. A dragged place keeps to one near it, or to the
//! crossing of two.

use glam::{DVec2, DVec3};

use super::snapping::{Carried, Snap};
use crate::document::{Curve, CurveId, Document};
use crate::editor::view::plane_lines::{PlaneLine, symmetry_axes};
use crate::editor::view::viewport::Viewport;
use crate::geometry::End;

/// Screen points within which a line attracts: less than points and the grid do.
const REACH: f64 = 4.0;

/// Screen points within which the crossing of two lines attracts.
const CROSSING: f64 = 7.0;

/// Lines at a smaller angle, by its sine, have no crossing.
const PARALLEL: f64 = 0.2;

/// The lines along the axes through a point.
const LEVEL: [(DVec2, &str); 2] = [(DVec2::X, "Level with"), (DVec2::Y, "Upright with")];

/// A line through a point of the view plane.
struct Line {
    from: DVec2,
    /// Of length 1; along an axis exactly.
    direction: DVec2,
    name: String,
}

impl Line {
    /// The foot of a place on the line, exact along an axis.
    fn foot(&self, place: DVec2) -> DVec2 {
        match self.direction {
            DVec2::X => DVec2::new(place.x, self.from.y),
            DVec2::Y => DVec2::new(self.from.x, place.y),
            direction => self.from + direction.dot(place - self.from) * direction,
        }
    }

    /// Where two lines cross, unless they are nearly parallel.
    fn crossing(&self, other: &Self) -> Option<DVec2> {
        let sine = self.direction.perp_dot(other.direction);
        if sine.abs() < PARALLEL {
            return None;
        }
        let along = (other.from - self.from).perp_dot(other.direction) / sine;
        let place = self.from + along * self.direction;
        // On a line along an axis to the bit.
        let foot = self.foot(place);
        let is_exact = matches!(other.direction, DVec2::X | DVec2::Y);
        Some(if is_exact { other.foot(foot) } else { foot })
    }
}

/// What a dragged place can line up with.
#[derive(Clone, Copy)]
pub struct Aligning<'a> {
    /// The document as it was when the drag began.
    pub document: &'a Document,
    /// The active curve.
    pub active: Option<CurveId>,
    /// What goes along, and does not attract.
    pub carried: &'a Carried,
    /// How the model is seen.
    pub viewport: &'a Viewport,
    /// Whether lines through points attract.
    pub lines: bool,
    /// Whether guides attract.
    pub guides: bool,
}

/// Find what a dragged place of the view plane lines up with: guides, the vertices of the active curve and its axis of
/// symmetry, the ends of all visible curves with their tangents and normals, targets and the origin, as far as they are on
/// the canvas and not carried; a single vertex also with the legs beside it.
///
/// `None` if no line is near, or the view is turned against the model, where no axis is level.
pub fn line_up(place: DVec2, aligning: &Aligning<'_>) -> Option<Snap> {
    let viewport = aligning.viewport;
    viewport.orientation.axes()?;
    let mut near = aligning.lines_near(place);
    let off = |line: &Line| line.foot(place).distance(place);
    near.sort_by(|a, b| off(a).total_cmp(&off(b)));
    let first = near.first()?;
    let crossing = near.iter().find_map(|other| {
        let at = first.crossing(other)?;
        (at.distance(place) <= CROSSING * viewport.pixel()).then_some((at, other))
    });
    let (at, lines) = match crossing {
        Some((at, second)) => (at, vec![first, second]),
        None => (first.foot(place), vec![first]),
    };
    let names: Vec<&str> = lines.iter().map(|line| line.name.as_str()).collect();
    Some(Snap {
        point: viewport.grounded(at),
        name: names.join(", "),
        lines: lines.iter().map(|line| [line.from, at]).collect(),
    })
}

/// Find the line of a direction that a dragged one lines up with, near a place of it.
pub fn line_along(place: DVec2, direction: DVec2, aligning: &Aligning<'_>) -> Option<Snap> {
    let direction = exact(direction);
    let near = aligning.lines_near(place).into_iter();
    let near = near.filter(|line| line.direction == direction);
    let off = |line: &Line| line.foot(place).distance(place);
    let line = near.min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let at = line.foot(place);
    Some(Snap {
        point: aligning.viewport.grounded(at),
        name: line.name,
        lines: vec![[line.from, at]],
    })
}

impl Aligning<'_> {
    /// Guides come first: of lines in one place they are named.
    fn lines_near(&self, place: DVec2) -> Vec<Line> {
        let guides = self.document.guide_lines().iter().enumerate();
        let guides = guides.filter(|(index, _)| self.guides && self.carried.guide != Some(*index));
        let guides = guides.filter_map(|(_, it)| PlaneLine::seen(it.plane(), self.viewport));
        let mut lines: Vec<Line> = guides
            .filter_map(|it| self.line_of(it, place, "On the guide"))
            .collect();
        if self.lines {
            lines.extend(lines_near(place, self));
        }
        lines
    }

    /// A line that crosses all that is seen, if a place is near.
    fn line_of(&self, line: PlaneLine, place: DVec2, name: &str) -> Option<Line> {
        // Drawn from where it is near.
        let from = line.foot(place);
        let is_near = from.distance(place) <= REACH * self.viewport.pixel();
        is_near.then(|| Line {
            from,
            direction: exact(line.along),
            name: name.to_owned(),
        })
    }
}

/// The lines near a place through points on the canvas. Only they get names, as there may be many points.
fn lines_near(place: DVec2, aligning: &Aligning<'_>) -> Vec<Line> {
    let Aligning {
        document,
        active,
        carried,
        viewport,
        ..
    } = *aligning;
    let reach = REACH * viewport.pixel();
    let mut lines = Vec::new();
    let mut add = |point: DVec3, directions: &[(DVec2, &str)], name: &dyn Fn() -> String| {
        let from = viewport.flatten(point);
        let on_screen = viewport.to_screen(from);
        let is_seen = on_screen.min_element() >= 0.0 && on_screen.cmple(viewport.size).all();
        for (direction, way) in directions {
            let off = direction.perp_dot(place - from).abs();
            if is_seen && off <= reach {
                lines.push(Line {
                    from,
                    direction: *direction,
                    name: format!("{way} {}", name()),
                });
            }
        }
    };
    for (id, curve) in document.curves().filter(|(_, curve)| curve.visible) {
        let polygon = &curve.polygon;
        let goes_along = carried.item == Some(id);
        let own = carried.vertices.range((id, 0)..=(id, usize::MAX));
        let own: Vec<usize> = own.map(|(_, index)| *index).collect();
        // The images of carried vertices move too.
        let carried_along: Vec<usize> = own.iter().flat_map(|it| curve.dependents(*it)).collect();
        let feels = |index: usize| goes_along || carried_along.contains(&index);
        if active == Some(id) {
            for (index, vertex) in polygon.vertices().iter().enumerate() {
                if !feels(index) {
                    add(*vertex, &LEVEL, &|| format!("vertex {index}"));
                }
            }
        }
        for end in End::BOTH {
            if let Some(target) = curve.targets.get(end)
                && carried.target != Some((id, end))
            {
                add(target.point, &LEVEL, &|| {
                    format!("target of the {}", end.name())
                });
            }
            if polygon.is_periodic() || polygon.terminal_vertices(end).any(feels) {
                continue;
            }
            let jet = polygon.end_jet(end);
            let name = || format!("{} of {}", end.name(), curve.name);
            add(jet.point, &LEVEL, &name);
            if let Some(along) = viewport.flatten(jet.first).try_normalize() {
                let both = [(along, "Along"), (along.perp(), "Across")];
                add(jet.point, &both, &name);
            }
        }
    }
    add(DVec3::ZERO, &LEVEL, &|| "origin".to_owned());
    let active = active.filter(|id| carried.item != Some(*id));
    let only = carried
        .vertices
        .first()
        .filter(|_| carried.vertices.len() == 1);
    if let Some((id, index)) = only
        && let Some(curve) = document.curve(*id)
    {
        let legs = leg_lines(curve, *index, viewport).into_iter();
        lines.extend(legs.filter(|line| line.foot(place).distance(place) <= reach));
    }
    let symmetric = active.and_then(|id| document.curve(id));
    if let Some(curve) = symmetric {
        let name = format!("On the axis of {}", curve.name);
        let axes = symmetry_axes(curve, viewport);
        lines.extend(axes.filter_map(|axis| aligning.line_of(axis, place, &name)));
    }
    lines
}

/// The lines of a polygon on which a vertex may stand: as far from one of its neighbours as from the other, in line with
/// both, and in line with the legs next to its own.
fn leg_lines(curve: &Curve, index: usize, viewport: &Viewport) -> Vec<Line> {
    let polygon = &curve.polygon;
    let count = polygon.vertices().len();
    let images = curve.dependents(index);
    let neighbour = |by: isize| {
        let at = match polygon.is_periodic() {
            true => (index + count).checked_add_signed(by)? % count,
            false => index.checked_add_signed(by)?,
        };
        let vertex = polygon.vertices().get(at)?;
        (!images.contains(&at)).then(|| (at, viewport.flatten(*vertex)))
    };
    let mut lines = Vec::new();
    if let (Some((a, from)), Some((b, to))) = (neighbour(-1), neighbour(1))
        && let Some(along) = (to - from).try_normalize()
    {
        let middle = 0.5 * (from + to);
        let line = |direction: DVec2, name: String| Line {
            from: middle,
            direction: exact(direction),
            name,
        };
        lines.push(line(along.perp(), format!("Equal legs to {a} and {b}")));
        lines.push(line(along, format!("In line with {a} and {b}")));
    }
    for side in [-1, 1] {
        let pair = neighbour(side).zip(neighbour(2 * side));
        let along = pair.and_then(|((_, near), (_, far))| (near - far).try_normalize());
        if let Some((((a, near), (b, _)), along)) = pair.zip(along) {
            lines.push(Line {
                from: near,
                direction: exact(along),
                name: format!("In line with {a} and {b}"),
            });
        }
    }
    lines
}

/// A direction that is an axis up to its sign, as that axis.
fn exact(direction: DVec2) -> DVec2 {
    match direction.abs() {
        DVec2::X => DVec2::X,
        DVec2::Y => DVec2::Y,
        _ => direction,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    /// What lines up with a place of the model, moved by some screen points.
    fn at(place: DVec2, by: DVec2) -> Option<Snap> {
        let points = [(10.0, 10.0), (40.0, 20.0), (70.0, 80.0), (100.0, 90.0)];
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        let document = Document::from_curves([Curve::new("a", polygon)]);
        let viewport = Viewport {
            centre: DVec2::splat(50.0),
            scale: 4.0,
            ..Viewport::default()
        };
        let place = place + by * viewport.pixel();
        let aligning = Aligning {
            document: &document,
            active: document.ids().next(),
            carried: &Carried::default(),
            viewport: &viewport,
            lines: true,
            guides: true,
        };
        line_up(place, &aligning)
    }

    #[test]
    fn a_place_keeps_to_the_line_of_the_nearest_vertex_to_the_bit() {
        let near = at(DVec2::new(85.0, 20.0), DVec2::new(0.0, 2.0)).expect("a line");
        assert_eq!(
            (near.name.as_str(), near.point.y),
            ("Level with vertex 1", 20.0)
        );
        assert_eq!(near.lines.len(), 1);
        let crossing = at(DVec2::new(10.0, 80.0), DVec2::new(3.0, -2.0)).expect("two lines");
        assert_eq!(crossing.point, DVec3::new(10.0, 80.0, 0.0));
        assert_eq!(crossing.lines.len(), 2);
        assert!(at(DVec2::new(25.0, 30.0), DVec2::ZERO).is_none());
    }

    #[test]
    fn a_vertex_stands_between_its_neighbours_or_in_line_with_legs() {
        let points = [
            (0.0, 0.0),
            (10.0, 0.0),
            (33.0, 5.0),
            (40.0, 20.0),
            (40.0, 50.0),
            (60.0, 90.0),
        ];
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        let document = Document::from_curves([Curve::new("a", polygon)]);
        let id = document.ids().next().expect("a curve");
        let viewport = Viewport {
            centre: DVec2::splat(50.0),
            scale: 4.0,
            ..Viewport::default()
        };
        let carried = Carried {
            vertices: [(id, 2)].into(),
            ..Carried::default()
        };
        let aligning = Aligning {
            document: &document,
            active: None,
            carried: &carried,
            viewport: &viewport,
            lines: true,
            guides: true,
        };
        let at = |x, y| line_up(DVec2::new(x, y), &aligning);
        // The mean of vertices 1 and 3.
        let middle = at(25.2, 10.3).expect("a crossing");
        assert!(middle.point.distance(DVec3::new(25.0, 10.0, 0.0)) < 1e-12);
        assert!(
            middle.name.contains("Equal legs to 1 and 3"),
            "{}",
            middle.name
        );
        let [a, b] = [(10.0, 0.0), (40.0, 20.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let bisector = at(32.6, -1.5).expect("a line").point;
        assert!((bisector.distance(a) - bisector.distance(b)).abs() < 1e-12);
        // On the legs beside it, prolonged, to the bit.
        let corner = at(40.5, 0.4).expect("a crossing");
        assert_eq!(corner.point, DVec3::new(40.0, 0.0, 0.0));
        assert_eq!(corner.lines.len(), 2);
    }
}
