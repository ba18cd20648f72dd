//! The logarithmic curvature graph of a piece of a curve, as sums from which its line follows.

use glam::DVec2;

use crate::geometry::curvature_levels::logarithmic_point;
use crate::geometry::jet::Jet;
use crate::geometry::parametric_curve::ParametricCurve;
use crate::geometry::quadrature::gauss_legendre;

/// A graph that lies within this share of its extent off a line is straight: what is left is
/// rounding.
const STRAIGHT: f64 = 1e-9;

/// Sums over points of the graph, weighted by arc length: they add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GraphMoments {
    weight: f64,
    mean: DVec2,
    xx: f64,
    xy: f64,
    yy: f64,
}

impl GraphMoments {
    /// Collect the graph at the 16 nodes of Gauss–Legendre quadrature between two local parameters
    /// of a piece, weighted as for an integral by arc length. Where the graph runs off to infinity
    /// it is left out.
    pub(super) fn of(
        curve: &dyn ParametricCurve,
        piece: usize,
        [from, to]: [f64; 2],
        planar: bool,
    ) -> Self {
        let mut moments = Self::default();
        for (t, weight) in gauss_legendre(from, to) {
            moments = moments.with_jet(&curve.piece_jet(piece, t), weight, planar);
        }
        moments
    }

    /// The sums with one point more.
    fn with_jet(self, jet: &Jet, weight: f64, planar: bool) -> Self {
        let point = logarithmic_point(jet.curvature_of(planar), jet.curvature_slope(planar));
        point.map_or(self, |(x, y)| {
            self.merged(Self {
                weight: weight * jet.speed(),
                mean: DVec2::new(x, y),
                ..Self::default()
            })
        })
    }

    /// The sums over the points of both (Chan, Golub and LeVeque).
    pub(super) fn merged(self, other: Self) -> Self {
        let weight = self.weight + other.weight;
        if !(weight > 0.0 && weight.is_finite()) {
            return self;
        }
        let arm = other.mean - self.mean;
        let share = other.weight / weight;
        let lever = self.weight * share;
        Self {
            weight,
            mean: self.mean + share * arm,
            xx: self.xx + other.xx + lever * arm.x * arm.x,
            xy: self.xy + other.xy + lever * arm.x * arm.y,
            yy: self.yy + other.yy + lever * arm.y * arm.y,
        }
    }

    /// The slope of the least-squares line and its R². `None` if the graph is one point or stands
    /// upright.
    pub(super) fn line(&self) -> Option<(f64, f64)> {
        let slope = self.xy / self.xx;
        // A level graph has no variance to account for.
        let residual = (self.yy - slope * self.xy).max(0.0);
        let is_straight = residual <= STRAIGHT * STRAIGHT * (self.xx + self.yy);
        let straightness = if is_straight {
            1.0
        } else {
            1.0 - residual / self.yy
        };
        (slope.is_finite() && straightness.is_finite()).then_some((slope, straightness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::harmony::tests::LogAesthetic;

    #[test]
    fn the_graph_of_a_log_aesthetic_curve_is_straight_and_its_slope_is_alpha() {
        for alpha in [-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 4.0] {
            for lambda in [0.1, 0.5] {
                let curve = LogAesthetic { alpha, lambda };
                for part in [[0.0, 1.0], [0.2, 0.3]] {
                    let (slope, straightness) = GraphMoments::of(&curve, 0, part, true)
                        .line()
                        .expect("a graph");
                    assert!((slope - alpha).abs() <= 1e-9, "{alpha} {lambda}: {slope}");
                    assert!(
                        (1.0 - straightness).abs() <= 1e-9,
                        "{alpha}: {straightness}"
                    );
                }
            }
        }
    }

    #[test]
    fn sums_add_up() {
        let curve = LogAesthetic {
            alpha: 0.7,
            lambda: 2.0,
        };
        let parts = [[0.0, 0.25], [0.25, 0.5], [0.5, 1.0]];
        let parts = parts.map(|part| GraphMoments::of(&curve, 0, part, true));
        let forwards = parts
            .into_iter()
            .fold(GraphMoments::default(), GraphMoments::merged);
        let backwards = parts
            .into_iter()
            .rev()
            .fold(GraphMoments::default(), GraphMoments::merged);
        let near = |a: f64, b: f64| (a / b - 1.0).abs() <= 1e-13;
        assert!(near(forwards.xx, backwards.xx) && near(forwards.xy, backwards.xy));
        assert!(near(forwards.yy, backwards.yy) && near(forwards.mean.x, backwards.mean.x));
        assert_eq!(GraphMoments::default().line(), None);
    }
}
