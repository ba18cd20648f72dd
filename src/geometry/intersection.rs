//! Points that two curves share, refined from places near them.

use glam::DVec3;

use super::parametric_curve::ParametricCurve;

/// Steps: far more than quadratic convergence needs from where curves pass each other on screen.
const STEPS: usize = 32;

/// The longest step, in pieces: beyond that the tangents tell nothing.
const LONGEST: f64 = 0.5;

/// Rounding of a point, by the size of its coordinates and of the curve's derivative.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The least sine of the angle at which two curves cross: below it the equations are rounding, and a curve that is
/// compared with itself meets itself in every point.
const LEAST_SINE: f64 = 1e-6;

/// A point that two curves share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// Its parameter on either curve.
    pub u: [f64; 2],
    /// The point.
    pub point: DVec3,
}

impl Intersection {
    /// Refine the point that two curves share near two parameters: Newton's method on C(u) = D(v), in space by
    /// least squares, until the points agree to rounding.
    ///
    /// Both may be one curve that crosses itself. Open curves end at their ends. `None` where the curves do not
    /// meet nearby, or only touch.
    pub fn near(curves: [&dyn ParametricCurve; 2], start: [f64; 2]) -> Option<Self> {
        let mut u = start;
        for _ in 0..STEPS {
            let jets = [0, 1].map(|index| curves[index].jet(u[index]));
            let [first, second] = jets.map(|jet| jet.first);
            let sine = first.cross(second).length() / (first.length() * second.length());
            if !(sine >= LEAST_SINE) {
                return None;
            }
            let off = jets[1].point - jets[0].point;
            let rounding = jets.map(|jet| jet.point.abs().max_element() + jet.first.length());
            let met = off.length() <= ROUNDING * rounding[0].max(rounding[1]);
            let steps = steps(off, first, second);
            let next = [0, 1].map(|index| within(curves[index], u[index] + steps[index]));
            // The step after the points agree still improves the parameters.
            if met {
                let point = curves[0].jet(next[0]).point;
                return Some(Self { u: next, point });
            }
            if next == u {
                return None;
            }
            u = next;
        }
        None
    }
}

/// The steps s, t that bring C + s C′ and D + t D′ together, in the least-squares sense.
fn steps(off: DVec3, first: DVec3, second: DVec3) -> [f64; 2] {
    // Minimise |off − s C′ + t D′|²; the normal of both tangents takes no part.
    let normal = first.cross(second);
    let square = normal.length_squared();
    let s = off.cross(second).dot(normal) / square;
    let t = off.cross(first).dot(normal) / square;
    let shorter = (LONGEST / s.abs().max(t.abs())).min(1.0);
    [shorter * s, shorter * t]
}

/// The parameter, kept between the ends of an open curve.
fn within(curve: &dyn ParametricCurve, u: f64) -> f64 {
    let end = curve.pieces() as f64;
    match curve.is_periodic() {
        true => u.rem_euclid(end),
        false => u.clamp(0.0, end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    fn curve(degree: usize, vertices: &[(f64, f64)]) -> FloatPolygon {
        FloatPolygon::planar(degree, vertices).expect("a polygon")
    }

    #[test]
    fn a_parabola_meets_a_line_where_both_formulas_say() {
        // (u, u²/2 + c): the uniform quadratic with vertices at −½, ½, 3⁄2 … is (u, u²/2 + const).
        let at = |x: f64| (x, 0.5 * x * x);
        let parabola = curve(2, &[at(-0.5), at(0.5), at(1.5), at(2.5)]);
        let y = |x: f64| parabola.point(x).y;
        let line = curve(1, &[(0.25, y(1.25) - 1.0), (2.25, y(1.25) + 1.0)]);
        let found = Intersection::near([&parabola, &line], [1.2, 0.4]).expect("a point");
        assert!((found.u[0] - 1.25).abs() < 1e-14, "{found:?}");
        assert!((found.u[1] - 0.5).abs() < 1e-14, "{found:?}");
        assert!(found.point.distance(parabola.point(1.25)) < 1e-14);
    }

    #[test]
    fn a_curve_crosses_itself_and_does_not_meet_itself_elsewhere() {
        let vertices = [
            (-9.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (0.0, 4.0),
            (1.0, -3.0),
            (1.0, -9.0),
        ];
        let looped = curve(2, &vertices);
        let found = Intersection::near([&looped, &looped], [0.4, 3.1]).expect("a point");
        let [one, other] = found.u.map(|u| looped.point(u));
        assert!(one.distance(other) < 1e-14, "{found:?}");
        assert!((found.u[0] - found.u[1]).abs() > 1.0);
        assert_eq!(Intersection::near([&looped, &looped], [1.0, 1.01]), None);
    }

    #[test]
    fn curves_that_pass_each_other_in_space_do_not_meet() {
        let line = |z: f64, towards: DVec3| {
            let from = DVec3::new(0.0, 0.0, z) - towards;
            FloatPolygon::new(1, vec![from, from + 2.0 * towards], None, false).expect("valid")
        };
        let (low, high) = (line(0.0, DVec3::X), line(1e-6, DVec3::Y));
        assert_eq!(Intersection::near([&low, &high], [0.4, 0.6]), None);
        let meeting = line(0.0, DVec3::new(1.0, 1.0, 1.0));
        let found = Intersection::near([&low, &meeting], [0.4, 0.6]).expect("a point");
        assert_eq!(found.u, [0.5, 0.5]);
    }

    #[test]
    fn open_curves_that_end_before_do_not_meet() {
        let line = curve(1, &[(0.0, 0.0), (1.0, 0.0)]);
        let across = curve(1, &[(1.1, -1.0), (1.1, 1.0)]);
        assert_eq!(Intersection::near([&line, &across], [0.9, 0.5]), None);
    }
}
