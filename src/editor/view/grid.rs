//! The grid's steps: 1, 2 or 5 times a power of ten, by zoom.

use glam::{DVec2, DVec3};

use crate::editor::view::outline::Bounds;
use crate::editor::view::viewport::Viewport;

/// Screen points that a minor step of the grid spans at least.
const NARROWEST: f64 = 12.0;

/// Choose the grid's minor and major steps, in units of the model: the minor step is the
/// smallest 1, 2 or 5 times a power of ten that spans at least twelve screen points, the major
/// step four or five times as large, itself 1, 2 or 5 times a power of ten.
pub fn grid_steps(viewport: &Viewport) -> (f64, f64) {
    let smallest = NARROWEST * viewport.pixel();
    let power = 10f64.powf(smallest.log10().floor());
    let (factor, times) = [(1.0, 5.0), (2.0, 5.0), (5.0, 4.0), (10.0, 5.0)]
        .into_iter()
        .find(|(factor, _)| factor * power >= smallest * (1.0 - 1e-9))
        .unwrap_or((10.0, 5.0));
    (factor * power, factor * power * times)
}

/// A view whose elevation above the ground has a smaller sine than the first shows no grid on it; from the
/// second on it is shown in full.
const GROUND_SEEN: [f64; 2] = [0.1, 0.35];

/// The most lines of one kind: a guard, steps are chosen so that fewer suffice.
const MOST: f64 = 1000.0;

/// The grid on the ground, the plane z = 0, as it is seen at an angle: lines in the view plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundGrid {
    /// The minor lines.
    pub minor: Vec<[DVec2; 2]>,
    /// The major lines.
    pub major: Vec<[DVec2; 2]>,
    /// How strongly it is drawn, from 0 to 1: less where the ground is seen at a shallow angle.
    pub strength: f32,
}

/// The minor and major steps of the grid on the ground, if it is seen in a view that is turned against the
/// model.
pub fn ground_steps(viewport: &Viewport) -> Option<(f64, f64)> {
    let [right, up] = [DVec3::X, DVec3::Y].map(|axis| viewport.flatten(axis));
    let slant = right.perp_dot(up).abs();
    // Lines must not crowd in the direction in which they are seen closest together.
    let closest = slant / right.length().max(up.length());
    let steps = || {
        grid_steps(&Viewport {
            scale: viewport.scale * closest,
            ..*viewport
        })
    };
    (ground_strength(slant) > 0.0).then(steps)
}

fn ground_strength(slant: f64) -> f32 {
    let [least, full] = GROUND_SEEN;
    ((slant - least) / (full - least)).clamp(0.0, 1.0) as f32
}

/// Make the grid on the ground for a view that is turned against the model.
pub fn ground_grid(viewport: &Viewport) -> GroundGrid {
    let mut grid = GroundGrid::default();
    let Some((minor, major)) = ground_steps(viewport) else {
        return grid;
    };
    let [right, up] = [DVec3::X, DVec3::Y].map(|axis| viewport.flatten(axis));
    grid.strength = ground_strength(right.perp_dot(up).abs());
    let ground = |place: DVec2| {
        let across = place.perp_dot(up) / right.perp_dot(up);
        let along = right.perp_dot(place) / right.perp_dot(up);
        DVec2::new(across, along)
    };
    let view = viewport.view_box();
    let corners = [
        view.low,
        DVec2::new(view.high.x, view.low.y),
        view.high,
        DVec2::new(view.low.x, view.high.y),
    ];
    let mut seen = Bounds::EMPTY;
    corners
        .map(ground)
        .into_iter()
        .for_each(|corner| seen.add(corner));
    for (step, lines) in [(minor, &mut grid.minor), (major, &mut grid.major)] {
        for axis in [0, 1] {
            let (first, last) = (
                (seen.low[axis] / step).ceil(),
                (seen.high[axis] / step).floor(),
            );
            if !(last - first < MOST) || first.abs().max(last.abs()) > 1e15 {
                continue;
            }
            for number in first as i64..=last as i64 {
                let end = |bounds: DVec2| {
                    let mut place = bounds;
                    place[axis] = number as f64 * step;
                    place.x * right + place.y * up
                };
                lines.push([end(seen.low), end(seen.high)]);
            }
        }
    }
    grid
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::view::orientation::Orientation;

    fn check(scale: f64, expected: (f64, f64)) {
        let viewport = Viewport {
            scale,
            ..Viewport::default()
        };
        let (minor, major) = grid_steps(&viewport);
        assert!(
            (minor - expected.0).abs() < 1e-9 * expected.0,
            "{scale}: {minor}"
        );
        assert!(
            (major - expected.1).abs() < 1e-9 * expected.1,
            "{scale}: {major}"
        );
    }

    #[test]
    fn the_ground_is_seen_as_even_lines_that_fill_the_view() {
        let viewport = Viewport {
            orientation: Orientation::isometric(),
            ..Viewport::default()
        };
        let grid = ground_grid(&viewport);
        assert_eq!(grid.strength, 1.0);
        // Seen at 35 degrees, the lines of a grid of 1 are 20 / √2 points apart.
        let (minor, major) = grid_steps(&Viewport {
            scale: 20.0 / 2f64.sqrt(),
            ..viewport
        });
        assert_eq!((minor, major), (1.0, 5.0));
        let spacing = |lines: &[[DVec2; 2]]| {
            let along = (lines[0][1] - lines[0][0]).normalize();
            (lines[1][0] - lines[0][0]).perp_dot(along).abs() * viewport.scale
        };
        assert!((spacing(&grid.minor) - 14.142).abs() < 0.001);
        assert!((spacing(&grid.major) - 70.711).abs() < 0.001);
        let edge_on = Viewport {
            orientation: Orientation::XZ,
            ..viewport
        };
        assert_eq!(ground_grid(&edge_on), GroundGrid::default());
    }

    #[test]
    fn steps_are_one_two_or_five() {
        check(12.0, (1.0, 5.0));
        check(11.0, (2.0, 10.0));
        check(6.0, (2.0, 10.0));
        check(5.0, (5.0, 20.0));
        check(2.3, (10.0, 50.0));
        check(1200.0, (0.01, 0.05));
    }
}
