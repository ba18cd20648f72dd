//! Conic arcs (type 104): A·x² + B·xy + C·y² + D·x + E·y + F = 0 from a start to an end.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::io::exchange::drawing::{Conic, Kind, Nurbs, Shape};

/// Beyond this ratio of its quadratic terms an arc of form 0 is a parabola.
const PARABOLA: f64 = 1.0e-12;

/// Ends nearer than this, relative to the axes, close an ellipse or a circle.
const CLOSED: f64 = 1.0e-10;

/// The arc of a type 104 entity.
pub(super) struct ConicArc {
    /// The coefficients A to F.
    pub coefficients: [f64; 6],
    pub z: f64,
    pub start: DVec2,
    pub end: DVec2,
    /// 1 for an ellipse, 2 for a hyperbola, 3 for a parabola, 0 if the writer did not say.
    pub form: i32,
}

/// Arc of a circle or ellipse, anticlockwise from one angle to another: whole if they are alike.
pub(super) fn ellipse_arc(centre: DVec3, x: DVec3, y: DVec3, start: DVec2, end: DVec2) -> Conic {
    let from = start.y.atan2(start.x);
    let mut to = end.y.atan2(end.x);
    let is_closed = start.distance(end) <= CLOSED * start.length();
    if is_closed {
        to = from + TAU;
    } else if to <= from {
        to += TAU;
    }
    Conic {
        centre,
        x,
        y,
        from,
        to,
    }
}

/// Say whether a conic closes.
pub(super) fn is_whole(conic: &Conic) -> bool {
    conic.to - conic.from >= TAU * (1.0 - 1.0e-15)
}

impl ConicArc {
    /// Give the arc: ellipses as such, parabolas and hyperbolas as one exact segment of degree 2.
    ///
    /// # Errors
    /// A reason where the coefficients are those of no curve, or the ends do not lie on one branch.
    pub fn shape(&self) -> Result<(Kind, Shape), String> {
        let axes = Axes::of(&self.coefficients);
        let [a, c] = axes.squares;
        let largest = a.abs().max(c.abs());
        if largest == 0.0 {
            return Err("the conic has no quadratic terms".to_owned());
        }
        let limit = match self.form {
            1 | 2 => 0.0,
            3 => 1.0e-6,
            _ => PARABOLA,
        };
        if a.abs().min(c.abs()) <= limit * largest {
            return self
                .parabola(&axes)
                .map(|nurbs| (Kind::Spline, Shape::Nurbs(nurbs)));
        }
        let middle = [-axes.linear[0] / (2.0 * a), -axes.linear[1] / (2.0 * c)];
        let right = a * middle[0] * middle[0] + c * middle[1] * middle[1] - self.coefficients[5];
        let squares = [right / a, right / c];
        match squares.map(|square| square > 0.0) {
            [true, true] => {
                let conic = self.ellipse(&axes, middle, squares.map(f64::sqrt));
                Ok((Kind::Ellipse, Shape::Conic(conic)))
            }
            [false, false] => Err("the conic has no real points".to_owned()),
            [is_first, _] => {
                let axis = usize::from(!is_first);
                let halves = squares.map(|square| square.abs().sqrt());
                self.hyperbola(&axes, middle, halves, axis)
                    .map(|nurbs| (Kind::Spline, Shape::Nurbs(nurbs)))
            }
        }
    }

    fn ellipse(&self, axes: &Axes, middle: [f64; 2], halves: [f64; 2]) -> Conic {
        let middle = DVec2::from(middle);
        let local = |point: DVec2| (axes.local(point) - middle) / DVec2::from(halves);
        ellipse_arc(
            axes.point(middle).extend(self.z),
            (axes.x * halves[0]).extend(0.0),
            (axes.x.perp() * halves[1]).extend(0.0),
            local(self.start),
            local(self.end),
        )
    }

    /// The arc of a hyperbola about `axis`: x = ± a cosh t, y = b sinh t.
    fn hyperbola(
        &self,
        axes: &Axes,
        middle: [f64; 2],
        halves: [f64; 2],
        axis: usize,
    ) -> Result<Nurbs, String> {
        let middle = DVec2::from(middle);
        let [a, b] = if axis == 0 {
            halves
        } else {
            [halves[1], halves[0]]
        };
        let turned = |point: DVec2| {
            if axis == 0 {
                point
            } else {
                DVec2::new(point.y, point.x)
            }
        };
        let (start, end) = (
            turned(axes.local(self.start) - middle),
            turned(axes.local(self.end) - middle),
        );
        if start.x * end.x <= 0.0 {
            return Err("the ends of the hyperbola lie on two branches".to_owned());
        }
        let side = start.x.signum();
        let (from, to) = ((start.y / b).asinh(), (end.y / b).asinh());
        let weight = (0.5 * (to - from)).cosh();
        let shoulder = 0.5 * (from + to);
        let at = |t: f64| DVec2::new(side * a * t.cosh(), b * t.sinh());
        let points = [at(from), at(shoulder) / weight, at(to)];
        self.segment(
            points.map(|point| axes.point(middle + turned(point))),
            Some(weight),
        )
    }

    /// The arc of a parabola: a function of degree 2 along one axis.
    fn parabola(&self, axes: &Axes) -> Result<Nurbs, String> {
        let [a, c] = axes.squares;
        let is_first = a.abs() >= c.abs();
        let turned = |point: DVec2| {
            if is_first {
                point
            } else {
                DVec2::new(point.y, point.x)
            }
        };
        let (square, linear) = (
            if is_first { a } else { c },
            turned(DVec2::from(axes.linear)),
        );
        if linear.y == 0.0 {
            return Err("the conic is a pair of parallel lines".to_owned());
        }
        let (from, to) = (
            turned(axes.local(self.start)).x,
            turned(axes.local(self.end)).x,
        );
        let blossom = |s: f64, t: f64| {
            let mean = 0.5 * (s + t);
            let height = -(square * s * t + linear.x * mean + self.coefficients[5]) / linear.y;
            axes.point(turned(DVec2::new(mean, height)))
        };
        self.segment(
            [blossom(from, from), blossom(from, to), blossom(to, to)],
            None,
        )
    }

    fn segment(&self, points: [DVec2; 3], weight: Option<f64>) -> Result<Nurbs, String> {
        if points[0] == points[2] {
            return Err("the arc has no length".to_owned());
        }
        Ok(Nurbs {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            points: points.map(|point| point.extend(self.z)).to_vec(),
            weights: weight.map(|weight| vec![1.0, weight, 1.0]),
            periodic: false,
        })
    }
}

/// The directions in which the mixed term vanishes.
struct Axes {
    /// The first direction.
    x: DVec2,
    /// The quadratic coefficients along the axes.
    squares: [f64; 2],
    /// The linear coefficients along the axes.
    linear: [f64; 2],
}

impl Axes {
    fn of(coefficients: &[f64; 6]) -> Self {
        let [a, b, c, d, e, _] = *coefficients;
        let angle = if b == 0.0 { 0.0 } else { 0.5 * b.atan2(a - c) };
        let (sine, cosine) = angle.sin_cos();
        Self {
            x: DVec2::new(cosine, sine),
            squares: [
                a * cosine * cosine + b * cosine * sine + c * sine * sine,
                a * sine * sine - b * cosine * sine + c * cosine * cosine,
            ],
            linear: [d * cosine + e * sine, e * cosine - d * sine],
        }
    }

    /// The coordinates of a point along the axes.
    fn local(&self, point: DVec2) -> DVec2 {
        DVec2::new(self.x.dot(point), self.x.perp_dot(point))
    }

    /// The point at coordinates along the axes.
    fn point(&self, local: DVec2) -> DVec2 {
        self.x * local.x + self.x.perp() * local.y
    }
}
