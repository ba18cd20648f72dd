//! The axis of a symmetric curve, which has half of the unknowns.

use glam::DVec2;

use super::sign_runs::SignRuns;

/// The coordinate axis in which a curve is its own mirror image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymmetryAxis {
    /// The x axis: y changes its sign.
    X,
    /// The y axis: x changes its sign.
    Y,
}

impl SymmetryAxis {
    /// The factors of the coordinates.
    fn factors(self) -> DVec2 {
        match self {
            Self::X => DVec2::new(1.0, -1.0),
            Self::Y => DVec2::new(-1.0, 1.0),
        }
    }

    /// The image of a point or a direction.
    pub(super) fn image(self, vector: DVec2) -> DVec2 {
        self.factors() * vector
    }

    /// What two unknowns, each the x or the y of a vertex, are multiplied by in an equation that holds both.
    pub(super) fn sign(self, a: usize, b: usize) -> f64 {
        let factors = self.factors();
        factors[a % 2] * factors[b % 2]
    }

    /// The factor of an unknown.
    pub(super) fn factor(self, unknown: usize) -> f64 {
        self.factors()[unknown % 2]
    }

    /// Put a point on the axis.
    pub(super) fn onto_axis(self, point: DVec2) -> DVec2 {
        0.5 * (point + self.image(point))
    }

    /// Take the mean of the vertices and their images in the reverse order: the one half becomes the image of the
    /// other, bit for bit, and a middle vertex lies on the axis.
    pub(super) fn symmetrise(self, vertices: &mut [DVec2]) {
        let count = vertices.len();
        for index in 0..count.div_ceil(2) {
            let other = count - 1 - index;
            let mean = 0.5 * (vertices[index] + self.image(vertices[other]));
            vertices[other] = self.image(mean);
            vertices[index] = mean;
        }
    }
}

impl SignRuns {
    /// Make the later half of the cuts the mirror image of the earlier one, for so many members. A middle one cuts
    /// in the middle.
    pub(super) fn symmetrise(&mut self, members: usize) {
        let count = self.cuts.len();
        for index in 0..count / 2 {
            self.cuts[count - 1 - index] = members - self.cuts[index].min(members);
        }
        if count % 2 == 1 {
            self.cuts[count / 2] = members.div_ceil(2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_half_is_the_image_of_the_first() {
        let mut vertices = [(0.0, 1.0), (1.0, 0.7), (2.0, 0.1), (1.1, -0.6), (0.3, -1.0)];
        let mut vertices = vertices.each_mut().map(|it| DVec2::from(*it));
        SymmetryAxis::X.symmetrise(&mut vertices);
        assert_eq!(vertices[2], DVec2::new(2.0, 0.0));
        for index in 0..5 {
            assert_eq!(vertices[4 - index], SymmetryAxis::X.image(vertices[index]));
        }
        assert_eq!(
            SymmetryAxis::Y.onto_axis(DVec2::new(3.0, 4.0)),
            DVec2::new(0.0, 4.0)
        );
    }

    #[test]
    fn cuts_lie_as_far_from_either_end() {
        let mut runs = SignRuns {
            begins_positive: true,
            cuts: vec![3, 9, 14],
        };
        runs.symmetrise(20);
        assert_eq!(runs.cuts, [3, 10, 17]);
        let signs = runs.signs(20);
        assert!((0..20).all(|it| signs[it] == -signs[19 - it]));
    }
}
