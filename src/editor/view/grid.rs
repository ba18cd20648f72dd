//! The grid's steps: 1, 2 or 5 times a power of ten, by zoom.

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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn steps_are_one_two_or_five() {
        check(12.0, (1.0, 5.0));
        check(11.0, (2.0, 10.0));
        check(6.0, (2.0, 10.0));
        check(5.0, (5.0, 20.0));
        check(2.3, (10.0, 50.0));
        check(1200.0, (0.01, 0.05));
    }
}
