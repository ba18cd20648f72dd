//! A bridge made of its legs, curvatures and torsion angles, vertex after vertex.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3};

use super::flow::Sequence;
use crate::geometry::banded::{BandedQr, BandedRow, difference_stencil};
use crate::geometry::root::root;

/// The order of the differences of the logarithms of legs.
const LEG_ORDER: usize = 2;

/// The weight of the numbers themselves: it decides only where differences leave them free.
const RIDGE: f64 = 1e-9;

/// The largest turning angle.
const LARGEST_TURN: f64 = 0.95 * PI;

/// Find the `count` vertices of a bridge between two parts, of which the second moves rigidly, and
/// the vertices of that one.
///
/// Logarithms of legs, discrete curvatures and torsion angles are independent of each other: each
/// sequence has the smallest differences of its order, beside those of the parts.
pub(super) fn walk(
    parts: [&[DVec3]; 2],
    count: usize,
    order: usize,
    planar: bool,
) -> (Vec<DVec3>, Vec<DVec3>) {
    let [first, second] = parts;
    let between = |sequence: Sequence, order| {
        let members = |vertices: &[DVec3]| -> Vec<f64> {
            let windows = vertices.windows(sequence.width());
            windows.map(|window| member(sequence, window)).collect()
        };
        let unknown = count + sequence.width() - 1;
        spline(&members(first), &members(second), unknown, order)
    };
    let legs = between(Sequence::LogLeg, LEG_ORDER);
    let (curvatures, torsions) = if planar {
        let seen = Sequence::SeenCurvature(DVec3::Z);
        (between(seen, order), vec![0.0; count + 3])
    } else {
        let torsions = between(Sequence::TorsionAngle, order);
        (between(Sequence::Curvature, order), torsions)
    };
    let mut frame = Frame::at(end_of(first), planar);
    let mut point = first[first.len() - 1];
    let mut before = point.distance(first[first.len() - 2]);
    let mut bridge = Vec::with_capacity(count + 1);
    let own = second[0].distance(second[1]);
    for (index, (curvature, torsion)) in curvatures.iter().zip(&torsions).enumerate() {
        let after = legs.get(index).map_or(own, |leg| leg.exp());
        frame.twist(*torsion);
        frame.turn(turning_angle(*curvature, before, after));
        if index <= count {
            point += after * frame.along;
            bridge.push(point);
        }
        before = after;
    }
    frame.twist(torsions[count + 2]);
    let begin = bridge.pop().unwrap_or(point);
    let turned = frame.matrix() * Frame::at(start_of(second), planar).matrix().transpose();
    let place = |vertex: &DVec3| begin + turned * (*vertex - second[0]);
    (bridge, second.iter().map(place).collect())
}

/// A direction, and the normal of the plane in which it turns.
struct Frame {
    along: DVec3,
    normal: DVec3,
}

/// The last two legs of a part, the last one second.
fn end_of(vertices: &[DVec3]) -> [Option<DVec3>; 2] {
    let mut legs = vertices.windows(2).rev().map(|leg| leg[1] - leg[0]);
    let last = legs.next();
    [legs.next(), last]
}

/// The first two legs of a part, the first one second, and the other turned about, so that both
/// make the plane that they do in their order.
fn start_of(vertices: &[DVec3]) -> [Option<DVec3>; 2] {
    let mut legs = vertices.windows(2).map(|leg| leg[1] - leg[0]);
    let first = legs.next();
    [legs.next().map(|leg| -leg), first]
}

impl Frame {
    /// The frame of a leg, in the plane that it has with another one before it.
    fn at([other, leg]: [Option<DVec3>; 2], planar: bool) -> Self {
        let along = leg.and_then(DVec3::try_normalize).unwrap_or(DVec3::X);
        if planar {
            let normal = DVec3::Z;
            return Self { along, normal };
        }
        let normal = other.and_then(|other| other.cross(along).try_normalize());
        let normal = normal.unwrap_or_else(|| along.any_orthonormal_vector());
        Self { along, normal }
    }

    /// Turn the plane about the direction.
    fn twist(&mut self, angle: f64) {
        if angle != 0.0 {
            self.normal = DQuat::from_axis_angle(self.along, angle) * self.normal;
        }
    }

    /// Turn the direction in the plane.
    fn turn(&mut self, angle: f64) {
        let across = self.normal.cross(self.along);
        self.along = (angle.cos() * self.along + angle.sin() * across).normalize();
    }

    fn matrix(&self) -> DMat3 {
        DMat3::from_cols(self.along, self.normal.cross(self.along), self.normal)
    }
}

/// Evaluate a member of a sequence; where the vertices have none it is 0.
fn member(sequence: Sequence, vertices: &[DVec3]) -> f64 {
    let mut touched = [DVec3::ZERO; 4];
    for (place, vertex) in touched.iter_mut().zip(vertices) {
        *place = *vertex;
    }
    let value = sequence.member(&touched).value;
    if value.is_finite() { value } else { 0.0 }
}

/// Find so many numbers between given ones so that Σ(Δᵐx)² is smallest.
fn spline(before: &[f64], after: &[f64], unknown: usize, order: usize) -> Vec<f64> {
    let before = &before[before.len() - before.len().min(order)..];
    let after = &after[..after.len().min(order)];
    let stencil = difference_stencil(order);
    let first = before.len();
    let length = first + unknown + after.len();
    let known = |place: usize| -> Option<f64> {
        let beyond = || after.get(place - first - unknown);
        if place < first {
            before.get(place).copied()
        } else if place < first + unknown {
            None
        } else {
            beyond().copied()
        }
    };
    let ridge = (0..unknown).map(|place| BandedRow {
        first: place,
        entries: vec![RIDGE],
        right: 0.0,
    });
    let mut rows: Vec<BandedRow> = ridge.collect();
    for begin in 0..(length + 1).saturating_sub(stencil.len()) {
        let mut row: Option<BandedRow> = None;
        let mut right = 0.0;
        for (offset, weight) in stencil.iter().enumerate() {
            match known(begin + offset) {
                Some(value) => right -= weight * value,
                None => {
                    let row = row.get_or_insert(BandedRow {
                        first: begin + offset - first,
                        entries: Vec::new(),
                        right: 0.0,
                    });
                    row.entries.push(*weight);
                }
            }
        }
        rows.extend(row.map(|row| BandedRow { right, ..row }));
    }
    let factors = BandedQr::new(rows, unknown);
    factors.map_or_else(|| vec![0.0; unknown], |factors| factors.solution())
}

/// Find the angle φ by which a polygon turns between legs a and b so that its discrete curvature
/// 8 a b sin φ / (a² + b² + 2 a b cos φ)^{3/2} is given; at most the largest angle.
fn turning_angle(curvature: f64, a: f64, b: f64) -> f64 {
    let missing = |angle: f64| {
        let square = a * a + b * b + 2.0 * a * b * angle.cos();
        8.0 * a * b * angle.sin() - curvature.abs() * square * square.sqrt()
    };
    // Where the curvature is out of reach the sharpest turn comes closest.
    let [mut low, mut high] = [0.0, 0.0];
    while missing(high) < 0.0 && high < LARGEST_TURN {
        low = high;
        high += 0.01 * PI;
    }
    root([low, high], 0.0, missing).copysign(curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon of legs, turning angles and torsion angles that grow evenly.
    fn spiral(count: usize, twist: f64) -> Vec<DVec3> {
        let mut frame = Frame {
            along: DVec3::X,
            normal: DVec3::Z,
        };
        let mut point = DVec3::ZERO;
        let mut vertices = vec![point];
        for _ in 1..count {
            point += frame.along;
            vertices.push(point);
            frame.twist(twist);
            frame.turn(0.2);
        }
        vertices
    }

    #[test]
    fn a_walk_goes_on_as_both_parts_do_wherever_the_second_is() {
        for twist in [0.0, 0.1] {
            let whole = spiral(20, twist);
            let moved = DQuat::from_axis_angle(DVec3::Z, 1.0);
            let planar = twist == 0.0;
            let second: Vec<DVec3> = whole[12..]
                .iter()
                .map(|vertex| moved * *vertex + DVec3::new(3.0, 1.0, 0.0))
                .collect();
            for order in [2, 3] {
                let (bridge, second) = walk([&whole[..8], &second], 4, order, planar);
                assert_eq!((bridge.len(), second.len()), (4, 8));
                let found = bridge.iter().chain(&second);
                for (found, expected) in found.zip(&whole[8..]) {
                    let apart = found.distance(*expected);
                    assert!(apart < 1e-6, "{twist} {order}: {found} {expected}");
                }
            }
        }
    }

    #[test]
    fn turning_angles_have_their_curvature() {
        for (a, b) in [(1.0, 1.0), (1.0, 2.0), (3.0, 0.5)] {
            for angle in [-1.5, -0.3, 0.0, 1e-3, 1.0] {
                let (along, turned) = (
                    DVec3::X * a,
                    DVec3::new(f64::cos(angle), f64::sin(angle), 0.0),
                );
                let vertices = [DVec3::ZERO, along, along + b * turned];
                let curvature = member(Sequence::SeenCurvature(DVec3::Z), &vertices);
                let found = turning_angle(curvature, a, b);
                assert!((found - angle).abs() < 1e-12, "{found} {angle}");
            }
        }
    }
}
