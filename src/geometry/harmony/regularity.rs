//! Whether the difference polygons of a polygon are regular.

use glam::DVec3;

use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::vector;

/// Order to which a polygon is regular: every difference polygon Δᵏ P, k = 1 … order, has no
/// zero leg and keeps the sense of turning between inflections.
///
/// The legs of the k-th difference polygon are the vectors Δᵏ Pᵢ; k = 1 is the polygon itself. Of a
/// curve of degree n there are n − 1 to look at: those of its derivatives that are continuous.
/// In space a difference polygon keeps its sense of turning as long as the normals of successive
/// corners make no more than a right angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularity {
    /// The order to which the polygon is regular, at most `highest`.
    pub order: usize,
    /// The highest order that is looked at, n − 1.
    pub highest: usize,
    /// The defect of the next difference polygon; `None` at the highest order.
    pub irregularity: Option<Irregularity>,
}

/// Place where the difference polygon Δᵏ P is irregular first, k one more than the regular order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irregularity {
    /// The defect there.
    pub kind: IrregularityKind,
    /// The vertex of the polygon in the middle of those that the difference is made of.
    pub vertex: usize,
}

/// Say how a difference polygon is irregular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IrregularityKind {
    /// It has a leg without length, or one lost in rounding.
    ZeroLeg,
    /// It turns to the other side, or straight back, though the polygon does not.
    TurnsBack,
}

/// The legs of a difference polygon.
struct Legs {
    vectors: Vec<DVec3>,
    /// The order of the difference: its number of vertices, less 1.
    order: usize,
    closed: bool,
    /// Rounding error of one of them.
    rounding: f64,
}

/// Two corners of a polygon that turn to different sides, by the numbers of their first legs: there
/// is an inflection between them.
type Inflection = [usize; 2];

impl Regularity {
    /// Find the order to which a float polygon is regular, in time proportional to its number of
    /// vertices and its degree. Weights do not count.
    pub fn of(polygon: &FloatPolygon) -> Self {
        let highest = polygon.degree() - 1;
        let mut legs = Legs::vertices(polygon);
        let mut inflections = Vec::new();
        for order in 0..highest {
            legs = legs.differences();
            match legs.changes(&inflections) {
                Ok(changes) if legs.order == 1 => inflections = changes,
                Ok(_) => {}
                Err(irregularity) => {
                    return Self {
                        order,
                        highest,
                        irregularity: Some(irregularity),
                    };
                }
            }
        }
        Self {
            order: highest,
            highest,
            irregularity: None,
        }
    }
}

impl Legs {
    /// The vertices themselves, in a unit in which products of them are numbers.
    fn vertices(polygon: &FloatPolygon) -> Self {
        let largest = vector::reach(polygon.vertices());
        let unit = vector::scaled(DVec3::splat(largest)).1;
        Self {
            vectors: polygon
                .vertices()
                .iter()
                .map(|vertex| *vertex / unit)
                .collect(),
            order: 0,
            closed: polygon.is_periodic(),
            rounding: 0.5 * f64::EPSILON * (largest / unit),
        }
    }

    fn differences(&self) -> Self {
        let count = self.vectors.len();
        let difference = |index: usize| self.vectors[(index + 1) % count] - self.vectors[index];
        Self {
            vectors: (0..self.corners()).map(difference).collect(),
            order: self.order + 1,
            closed: self.closed,
            rounding: 2.0 * self.rounding,
        }
    }

    /// Number of successive vectors.
    fn corners(&self) -> usize {
        self.vectors.len().saturating_sub(usize::from(!self.closed))
    }

    /// List where a difference polygon turns to the other side, or tell where it is irregular
    /// first. The polygon itself may turn anywhere: these are its inflections. One of a higher order
    /// may where the vertices that it is made of reach over an inflection, and vanish there.
    fn changes(&self, inflections: &[Inflection]) -> Result<Vec<Inflection>, Irregularity> {
        let irregular = |kind, from: usize, to: usize| {
            let reaches = inflections
                .iter()
                .any(|inflection| self.reaches([from, to], *inflection));
            let vertex = from.midpoint(to);
            let vertex = if self.closed {
                vertex % self.vectors.len()
            } else {
                vertex
            };
            if reaches {
                Ok(())
            } else {
                Err(Irregularity { kind, vertex })
            }
        };
        let corners = self.corners();
        let mut changes = Vec::new();
        let mut last: Option<(usize, DVec3)> = None;
        // Round a closed polygon, and on to the first corner that turns.
        for corner in 0..corners * (1 + usize::from(self.closed)) {
            let [before, after] =
                [corner, corner + 1].map(|leg| self.vectors[leg % self.vectors.len()]);
            let end = corner + 1 + self.order;
            for (leg, from) in [(before, corner), (after, corner + 1)] {
                if leg.abs().max_element() <= self.rounding {
                    irregular(IrregularityKind::ZeroLeg, from, from + self.order)?;
                }
            }
            let normal = before.cross(after);
            if normal.length() <= 2.0 * self.rounding * (before.length() + after.length()) {
                if before.dot(after) < 0.0 {
                    irregular(IrregularityKind::TurnsBack, corner, end)?;
                }
                continue;
            }
            if let Some((start, sense)) = last
                && sense.dot(normal) < 0.0
            {
                if self.order > 1 {
                    irregular(IrregularityKind::TurnsBack, start, end)?;
                }
                changes.push([start, corner]);
            }
            last = Some((corner, normal));
            if corner >= corners {
                break;
            }
        }
        Ok(changes)
    }

    /// Whether the vertices of a stretch lie on both sides of an inflection: those of the corners
    /// before it reach up to one vertex behind its first corner, and the other way round.
    fn reaches(&self, [from, to]: [usize; 2], [first, last]: Inflection) -> bool {
        let count = self.vectors.len();
        let rounds = if self.closed { 0..=2 } else { 1..=1 };
        let (from, to) = (from + count, to + count);
        rounds
            .map(|round| round * count)
            .any(|shift| to > first + shift + 2 && from < last + shift)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regularity(degree: usize, points: &[(f64, f64)]) -> Regularity {
        Regularity::of(&FloatPolygon::planar(degree, points).expect("a polygon"))
    }

    fn graph(from: i32, to: i32, height: fn(f64) -> f64) -> Vec<(f64, f64)> {
        (from..=to)
            .map(|x| (f64::from(x), height(f64::from(x))))
            .collect()
    }

    #[test]
    fn legs_in_geometric_progression_are_regular_to_every_order() {
        let spiral: Vec<(f64, f64)> = (0..14)
            .map(|index| {
                let (angle, radius) = (0.4 * f64::from(index), 1.1_f64.powi(index));
                (radius * angle.cos(), radius * angle.sin())
            })
            .collect();
        let found = regularity(9, &spiral);
        assert_eq!((found.order, found.irregularity), (8, None));
    }

    #[test]
    fn the_differences_of_a_parabola_vanish_from_the_third_order_on() {
        let found = regularity(5, &graph(0, 8, |x| x * x));
        assert_eq!(found.order, 2);
        let kind = IrregularityKind::ZeroLeg;
        assert_eq!(found.irregularity, Some(Irregularity { kind, vertex: 1 }));
        assert_eq!(regularity(3, &graph(0, 8, |x| x * x)).order, 2);
    }

    #[test]
    fn a_straight_line_is_regular_to_the_first_order() {
        let found = regularity(4, &graph(0, 6, |_| 0.0));
        assert_eq!(found.order, 1);
        assert_eq!(regularity(4, &[(0.0, 0.0); 6]).order, 0);
    }

    #[test]
    fn second_differences_may_vanish_and_turn_back_at_an_inflection_only() {
        assert_eq!(regularity(3, &graph(-4, 4, |x| x.powi(3))).order, 2);
        // A wave with its crest near 0: the third differences change their direction there.
        let crest = regularity(4, &graph(-3, 4, |x| (0.3 * (x - 0.3)).cos()));
        assert_eq!(crest.order, 2);
        let kind = IrregularityKind::TurnsBack;
        assert_eq!(
            crest.irregularity.map(|irregularity| irregularity.kind),
            Some(kind)
        );
    }

    #[test]
    fn a_polygon_that_turns_straight_back_is_not_regular() {
        let found = regularity(
            3,
            &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
        );
        let kind = IrregularityKind::TurnsBack;
        assert_eq!(found.irregularity, Some(Irregularity { kind, vertex: 2 }));
        assert_eq!(found.order, 0);
    }

    #[test]
    fn size_and_start_of_a_periodic_polygon_do_not_matter() {
        let wavy = |start: usize, size: f64| {
            let vertices = (0..20).map(|index| {
                let angle = std::f64::consts::TAU * ((index + start) % 20) as f64 / 20.0;
                let radius = size * (1.0 + 0.3 * (2.0 * angle).cos());
                DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
            });
            Regularity::of(
                &FloatPolygon::new(6, vertices.collect(), None, true).expect("a polygon"),
            )
        };
        let first = wavy(0, 1.0);
        for start in 0..20 {
            for size in [1e-90, 1.0, 1e90] {
                assert_eq!(wavy(start, size).order, first.order, "{start} {size:e}");
            }
        }
    }
}
