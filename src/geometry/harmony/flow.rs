//! The flow of control vertices: the figures of a polygon as sequences, one beside the other.

use glam::DVec3;

use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_figures::{
    discrete_curvature, discrete_torsion, torsion_angle, turning_angle,
};
use crate::geometry::vector;

/// Hold a number at each of some consecutive vertices of a polygon.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexSequence {
    first: usize,
    closed: bool,
    values: Vec<f64>,
}

/// Hold the flow of control vertices of a float polygon with N vertices.
///
/// What belongs to a leg stands at the vertex where it begins. Of a periodic polygon every sequence
/// has N values and closes.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexFlow {
    /// The lengths of the legs: of an open polygon from vertex 0 to N − 2.
    pub legs: VertexSequence,
    /// The turning angles in radians, signed in the plane z = 0: from vertex 1 to N − 2.
    pub turns: VertexSequence,
    /// The discrete curvature Kᵢ, signed in the plane z = 0: from vertex 1 to N − 2.
    pub curvatures: VertexSequence,
    /// The torsion angles in radians, of a polygon in space: from vertex 1 to N − 3.
    pub torsion_angles: Option<VertexSequence>,
    /// The discrete torsion, of a polygon in space: from vertex 1 to N − 3.
    pub torsions: Option<VertexSequence>,
}

impl VertexFlow {
    /// Measure the flow of a float polygon's vertices. Weights do not count.
    pub fn of(polygon: &FloatPolygon) -> Self {
        let count = polygon.vertices().len();
        let closed = polygon.is_periodic();
        // Beyond an open polygon's ends nothing is evaluated.
        let vertex = |index: usize| polygon.vertex(index % count);
        let sequence = |first: usize, missing: usize, value: &dyn Fn(usize) -> f64| {
            let (first, number) = if closed {
                (0, count)
            } else {
                (first, count.saturating_sub(missing))
            };
            let vertices = first..first + number;
            VertexSequence {
                first,
                closed,
                // One period on, the vertex before has a number that is not negative.
                values: vertices.map(|index| value(index + count)).collect(),
            }
        };
        let corner = |index: usize| [index - 1, index, index + 1].map(vertex);
        let four = |index: usize| [index - 1, index, index + 1, index + 2].map(vertex);
        let in_space = !polygon.is_planar();
        let around_legs = |value: fn(DVec3, DVec3, DVec3, DVec3) -> f64| {
            in_space.then(|| {
                sequence(1, 3, &|index| {
                    let [before, start, end, after] = four(index);
                    value(before, start, end, after)
                })
            })
        };
        let at_corners = |value: fn(DVec3, DVec3, DVec3, bool) -> f64| {
            sequence(1, 2, &|index| {
                let [before, at, after] = corner(index);
                value(before, at, after, !in_space)
            })
        };
        Self {
            legs: sequence(0, 1, &|index| {
                vector::length(vertex(index + 1) - vertex(index))
            }),
            turns: at_corners(turning_angle),
            curvatures: at_corners(discrete_curvature),
            torsion_angles: around_legs(torsion_angle),
            torsions: around_legs(discrete_torsion),
        }
    }
}

impl VertexSequence {
    /// The numbers, in the order of their vertices.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Whether the first number follows the last.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The vertex that the number at `place` of the values belongs to.
    pub fn vertex(&self, place: usize) -> usize {
        self.first + place
    }

    /// The sequence of a function of the numbers.
    pub fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        Self {
            values: self.values.iter().map(|value| function(*value)).collect(),
            ..*self
        }
    }

    /// List the second differences Δ²xᵢ = xᵢ₋₁ − 2xᵢ + xᵢ₊₁ with the vertices i; those at the ends
    /// of a sequence that does not close are missing.
    pub fn second_differences(&self) -> impl Iterator<Item = (usize, f64)> {
        let count = self.values.len();
        let inner = if self.closed {
            0..count
        } else {
            1..count.saturating_sub(1)
        };
        inner.map(move |place| {
            let value = |place: usize| self.values[place % count];
            let rise = value(place + 1) - value(place);
            let before = value(place) - value(place + count - 1);
            (self.vertex(place), rise - before)
        })
    }
}

#[cfg(test)]
impl VertexSequence {
    /// Some numbers, from vertex 0 on.
    pub(super) fn of(values: &[f64], closed: bool) -> Self {
        Self {
            first: 0,
            closed,
            values: values.to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(sequence: &VertexSequence) -> Vec<(usize, f64)> {
        let places = 0..sequence.values.len();
        places
            .map(|place| (sequence.vertex(place), sequence.values[place]))
            .collect()
    }

    #[test]
    fn an_open_polygon_has_what_its_vertices_allow() {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)];
        let flow = VertexFlow::of(&FloatPolygon::planar(2, &points).expect("a polygon"));
        assert_eq!(figures(&flow.legs), [(0, 1.0), (1, 2.0), (2, 2.0)]);
        let right = std::f64::consts::FRAC_PI_2;
        assert_eq!(figures(&flow.turns), [(1, right), (2, right)]);
        // D₁ = (1/2, 1), D₂ = (−1, 2): 2 / (5/4)^{3/2}; then (−1, 1) and (−2, −2).
        let expected = [2.0 / 1.25_f64.powf(1.5), 4.0 / 2.0_f64.powf(1.5)];
        for (found, expected) in flow.curvatures.values.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() <= 4.0 * f64::EPSILON);
        }
        assert_eq!(flow.torsions, None);
    }

    #[test]
    fn a_periodic_polygon_closes() {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let vertices = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let polygon = FloatPolygon::new(3, vertices, None, true).expect("a polygon");
        let flow = VertexFlow::of(&polygon);
        assert_eq!(flow.legs.values, [1.0; 4]);
        assert_eq!(flow.turns.values, [std::f64::consts::FRAC_PI_2; 4]);
        assert!(
            flow.turns
                .second_differences()
                .all(|(_, change)| change == 0.0)
        );
        assert_eq!(flow.turns.second_differences().count(), 4);
    }

    #[test]
    fn a_helix_has_constant_torsion_angles_of_its_hand() {
        for hand in [1.0, -1.0] {
            let vertices = (0..8).map(|index| {
                let angle = 0.3 * f64::from(index);
                DVec3::new(angle.cos(), angle.sin(), 0.2 * hand * angle)
            });
            let polygon = FloatPolygon::new(3, vertices.collect(), None, false).expect("a polygon");
            let flow = VertexFlow::of(&polygon);
            let angles = flow.torsion_angles.expect("in space");
            assert_eq!((angles.vertex(0), angles.values.len()), (1, 5));
            for value in &angles.values {
                assert!((value / angles.values[0] - 1.0).abs() <= 1e-12);
                assert!(value * hand > 0.0);
            }
            let torsions = flow.torsions.expect("in space");
            for value in &torsions.values {
                // τ = c / (1 + c²) of the helix, up to the square of the step.
                let exact = 0.2 * hand / 1.04;
                assert!((value / exact - 1.0).abs() < 0.05, "{value} {exact}");
            }
        }
    }
}
