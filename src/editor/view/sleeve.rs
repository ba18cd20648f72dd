//! Sleeves: how far a chain of points can be drawn as one line.

use glam::DVec2;

/// Rounding moves a point by no more than this share of the length of a line to it.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The directions in which a line from a point passes near all points of a chain that were added since.
#[derive(Clone, Copy, Debug)]
pub struct Sleeve {
    from: DVec2,
    tolerance: f64,
    /// How far away the points have come.
    farthest: f64,
    /// The outermost directions on the right and on the left; `None` while all points are within the
    /// tolerance of the first.
    borders: Option<[DVec2; 2]>,
}

impl Sleeve {
    /// Begin at a point of a chain. Lines may pass the points that follow within `tolerance`.
    pub fn new(from: DVec2, tolerance: f64) -> Self {
        Self {
            from,
            tolerance,
            farthest: 0.0,
            borders: None,
        }
    }

    /// Add the next point if one line from the first to this one can stand for the chain between them: it
    /// passes all points within the tolerance, none of them lies farther away, and it is short enough for
    /// rounding not to matter. Returns whether it can.
    pub fn add(&mut self, point: DVec2) -> bool {
        let along = point - self.from;
        let distance = along.length();
        let turns_back = distance < self.farthest - self.tolerance;
        // From far away nothing near could be told apart.
        let is_measured = ROUNDING * distance <= self.tolerance;
        if turns_back || !is_measured {
            return false;
        }
        if let Some([right, left]) = self.borders
            && (right.perp_dot(along) < 0.0 || along.perp_dot(left) < 0.0)
        {
            return false;
        }
        self.farthest = self.farthest.max(distance);
        if distance > self.tolerance {
            let sine = self.tolerance / distance;
            let ahead = (1.0 - sine * sine).sqrt() / distance * along;
            let aside = sine / distance * along.perp();
            let [mut right, mut left] = [ahead - aside, ahead + aside];
            if let Some(before) = self.borders {
                if before[0].perp_dot(right) < 0.0 {
                    right = before[0];
                }
                if left.perp_dot(before[1]) < 0.0 {
                    left = before[1];
                }
            }
            self.borders = Some([right, left]);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sleeve_ends_where_a_line_would_be_off() {
        let mut sleeve = Sleeve::new(DVec2::ZERO, 0.1);
        for (x, y) in [(0.05, 0.0), (1.0, 0.05), (2.0, -0.05), (3.0, 0.0)] {
            assert!(sleeve.add(DVec2::new(x, y)), "{x}");
        }
        // At 2 the line to this point would be 0.1 + 0.05 off.
        assert!(!sleeve.add(DVec2::new(4.0, 0.2)));
        assert!(sleeve.add(DVec2::new(4.0, 0.05)));
    }

    #[test]
    fn a_sleeve_ends_where_the_chain_turns_back_or_cannot_be_measured() {
        let mut sleeve = Sleeve::new(DVec2::ZERO, 0.1);
        assert!(sleeve.add(DVec2::X) && sleeve.add(0.95 * DVec2::X));
        for point in [0.8 * DVec2::X, -DVec2::X, DVec2::NAN, 1e15 * DVec2::X] {
            assert!(!sleeve.add(point), "{point}");
        }
    }
}
