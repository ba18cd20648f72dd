//! A half that is bent as little as possible so that it goes on smoothly into its mirror image.
//!
//! A polygon of 2m segments is symmetric if its n middle vertices are pairs of images; then the curve is C^(n−1) across the
//! mirror plane. The first n vertices of the half are these: its own moves δ make pairs of them, with the least second
//! differences Σ|δᵢ − 2δᵢ₊₁ + δᵢ₊₂|², so that the change fades along the half and adds no waves.

use glam::DVec3;

use crate::geometry::pivoted_cholesky::PivotedCholesky;
use crate::geometry::{FloatPolygon, Mirror};

/// The weight of the moves themselves beside their second differences: only so that there is one solution.
const OF_MOVES: f64 = 1e-3;

/// Rows whose remainder is below this share of the largest pivot are dependent.
const DEPENDENT: f64 = 1e-14;

/// Join a half that begins at a mirror plane to its image: its `reach` first vertices move.
///
/// The result runs from the end of the image to that of the half. `None` for a periodic or rational polygon, for half a
/// turn in place of a plane, and where numbers overflow.
pub fn joined_to_image(half: &FloatPolygon, mirror: &Mirror, reach: usize) -> Option<FloatPolygon> {
    let [through, normal] = mirror.plane()?;
    if half.is_periodic() || half.weights().is_some() {
        return None;
    }
    let (degree, count) = (half.degree(), half.vertices().len());
    let reach = reach.clamp(degree, count);
    let heights = half.vertices().iter();
    let heights: Vec<f64> = heights.map(|it| (*it - through).dot(normal)).collect();
    let across: Vec<DVec3> = heights.iter().map(|height| *height * normal).collect();
    let vertices = half.vertices().iter().zip(&across);
    let within: Vec<DVec3> = vertices.map(|(vertex, across)| *vertex - *across).collect();
    let across = paired(&across[..reach], degree, -1.0)?;
    let within = paired(&within[..reach], degree, 1.0)?;
    let mut bent = half.vertices().to_vec();
    for (vertex, (across, within)) in bent.iter_mut().zip(across.into_iter().zip(within)) {
        *vertex += across + within;
    }
    let images = bent.iter().skip(degree).rev();
    let images = images.map(|vertex| mirror.point(*vertex));
    let vertices = images.chain(bent.iter().copied()).collect();
    let whole = FloatPolygon::new(degree, vertices, None, false).ok()?;
    whole.symmetrised(mirror).ok()
}

/// The moves of the first vertices of a half, by their parts across or within the plane, that make vertex n − 1 − i `parity`
/// times vertex i.
fn paired(parts: &[DVec3], degree: usize, parity: f64) -> Option<Vec<DVec3>> {
    let count = parts.len();
    let partner = |index: usize| (degree - 1).checked_sub(index);
    // The mean of a vertex and the image of its partner.
    let mean = |index: usize| match partner(index) {
        Some(other) => 0.5 * (parts[index] + parity * parts[other]),
        None => parts[index],
    };
    let begun: Vec<DVec3> = (0..count).map(|index| mean(index) - parts[index]).collect();
    // Each free vertex takes its partner along; one in the plane stays there.
    let free = (0..count).filter(|index| match partner(*index) {
        Some(other) => other < *index || other == *index && parity > 0.0,
        None => true,
    });
    let columns = free.map(|index| {
        let mut column = vec![0.0; count];
        column[index] = 1.0;
        if let Some(other) = partner(index) {
            column[other] = if other == index { 1.0 } else { parity };
        }
        column
    });
    let columns: Vec<Vec<f64>> = columns.collect();
    let energies: Vec<Vec<f64>> = columns.iter().map(|column| energy(column)).collect();
    let entry = |a: usize, b: usize| dot(&energies[a], &energies[b]);
    let system = PivotedCholesky::new(columns.len(), entry, DEPENDENT)?;
    let mut moves = begun.clone();
    for axis in 0..3 {
        let begun: Vec<f64> = begun.iter().map(|it| it[axis]).collect();
        let begun = energy(&begun);
        let right: Vec<f64> = energies.iter().map(|it| -dot(it, &begun)).collect();
        for (column, by) in columns.iter().zip(system.solve(&right)) {
            for (it, share) in moves.iter_mut().zip(column) {
                it[axis] += share * by;
            }
        }
    }
    Some(moves)
}

/// The second differences of moves, which end with vertices that stay, and the moves themselves with their weight.
fn energy(moves: &[f64]) -> Vec<f64> {
    let at = |index: usize| moves.get(index).copied().unwrap_or_default();
    let bends = (0..moves.len()).map(|it| at(it) - 2.0 * at(it + 1) + at(it + 2));
    bends.chain(moves.iter().map(|it| OF_MOVES * it)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A half of a bottle that begins on the y axis, with a level tangent.
    const HALF: [(f64, f64); 14] = [
        (-24.0, 2.0),
        (-12.0, 0.7),
        (0.0, 0.0),
        (12.0, 0.7),
        (24.0, 2.0),
        (33.0, 8.0),
        (38.0, 20.0),
        (39.0, 36.0),
        (35.0, 54.0),
        (28.0, 70.0),
        (22.0, 84.0),
        (20.0, 97.0),
        (23.0, 109.0),
        (28.0, 118.0),
    ];

    fn half(moved: impl Fn(f64, f64) -> (f64, f64)) -> FloatPolygon {
        let vertices = HALF.map(|(x, y)| moved(x, y));
        FloatPolygon::planar(5, &vertices).expect("a polygon")
    }

    #[test]
    fn a_half_that_is_symmetric_at_the_plane_stays_to_the_bit() {
        let mirror = Mirror::of_coordinate(0);
        let half = half(|x, y| (x, y));
        let whole = joined_to_image(&half, &mirror, 28).expect("a whole");
        assert_eq!(whole.vertices().len(), 23);
        assert_eq!(whole.segments(), 2 * half.segments());
        assert_eq!(whole.vertices()[9..], *half.vertices());
        let images = half.vertices().iter().rev().map(|it| mirror.point(*it));
        assert_eq!(whole.vertices()[..14], images.collect::<Vec<DVec3>>());
    }

    #[test]
    fn a_gap_and_an_angle_are_spread_along_the_half() {
        const BESIDE: f64 = 0.01;
        const ANGLE: f64 = 0.002;
        let mirror = Mirror::of_coordinate(0);
        let askew = half(|x, y| (x + BESIDE, y + ANGLE * x));
        let legs = askew.vertices().windows(2).skip(2);
        let legs: Vec<f64> = legs.map(|leg| leg[0].distance(leg[1])).collect();
        for reach in [7, 10, 14] {
            let whole = joined_to_image(&askew, &mirror, reach).expect("a whole");
            let middle = whole.jet(askew.segments() as f64);
            let rounding = 1e-14 * askew.size();
            assert!(middle.point.x.abs() < rounding && middle.first.y.abs() < rounding);
            // An angle that is turned off evenly over a length moves the end by half of both.
            let length: f64 = legs.iter().take(reach).sum();
            let most = BESIDE + 0.5 * ANGLE * length;
            let moves = (0..=90).map(|step| {
                let u = f64::from(step) / 10.0;
                whole.point(u + 9.0).distance(askew.point(u))
            });
            let largest = moves.fold(0.0, f64::max);
            assert!(
                (0.5 * most..most).contains(&largest),
                "{reach}: {largest} of {most}"
            );
        }
    }

    #[test]
    fn what_has_no_plane_or_no_end_has_no_whole() {
        let half = half(|x, y| (x, y));
        let turn = Mirror::Signs([true, true, false]);
        assert_eq!(joined_to_image(&half, &turn, 14), None);
        let closed = FloatPolygon::new(5, half.vertices().to_vec(), None, true);
        let closed = closed.expect("a closed polygon");
        assert_eq!(
            joined_to_image(&closed, &Mirror::of_coordinate(0), 14),
            None
        );
    }
}
