//! The pieces of a path: runs of lines, of Bézier curves of one degree, and arcs.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::io::exchange::drawing::{Conic, Nurbs, Shape};

/// Collects the pieces of a path, one after another. Segments of the same degree become one spline, with an
/// inner knot as multiple as the degree where two of them meet.
pub(super) struct Pieces {
    shapes: Vec<Shape>,
    run: Run,
    start: DVec3,
    end: DVec3,
    /// The largest coordinate of an end of a segment.
    size: f64,
}

/// How far the end of a closed path may be off its start, per size: relative coordinates add up their
/// rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// The piece that may still grow.
enum Run {
    None,
    Lines(Vec<DVec3>),
    /// A spline whose last knot is still missing.
    Spline(Nurbs),
}

impl Pieces {
    /// Begin at a point.
    pub(super) fn new(start: DVec3) -> Self {
        Self {
            shapes: Vec::new(),
            run: Run::None,
            start,
            end: start,
            size: start.abs().max_element(),
        }
    }

    /// Get the last point.
    pub(super) fn end(&self) -> DVec3 {
        self.end
    }

    /// Tell whether the path is no more than its first point.
    pub(super) fn is_empty(&self) -> bool {
        self.shapes.is_empty() && matches!(self.run, Run::None)
    }

    /// Add a straight segment.
    pub(super) fn line(&mut self, to: DVec3) {
        if let Run::Lines(points) = &mut self.run {
            points.push(to);
        } else {
            self.finish_run();
            self.run = Run::Lines(vec![self.end, to]);
        }
        self.reach(to);
    }

    /// Add a spline on clamped uniform knots, of which the last point is the first control point: a Bézier
    /// curve where there are as many points as the degree.
    pub(super) fn spline(&mut self, degree: usize, points: &[DVec3]) {
        let (Some(&end), Some(spans)) = (points.last(), (points.len() + 1).checked_sub(degree))
        else {
            return;
        };
        if !matches!(&self.run, Run::Spline(nurbs) if nurbs.degree == degree) {
            self.finish_run();
            self.run = Run::Spline(Nurbs {
                degree,
                knots: vec![0.0; degree + 1],
                points: vec![self.end],
                weights: None,
                periodic: false,
            });
        }
        if let Run::Spline(nurbs) = &mut self.run {
            let from = nurbs.knots.last().copied().unwrap_or_default();
            let inner = (1..spans).map(|it| from + it as f64);
            nurbs.knots.extend(inner);
            nurbs.knots.extend(vec![from + spans as f64; degree]);
            nurbs.points.extend(points);
        }
        self.reach(end);
    }

    /// Add an arc that ends at a point; the parts of one arc are joined.
    pub(super) fn arc(&mut self, arc: Conic, to: DVec3) {
        self.finish_run();
        self.reach(to);
        if let Some(Shape::Conic(last)) = self.shapes.last_mut()
            && continues(last, &arc)
        {
            last.to += arc.to - arc.from;
            if (last.to - last.from - TAU).abs() <= 1e-12 {
                last.to = last.from + TAU;
            }
            return;
        }
        self.shapes.push(Shape::Conic(arc));
    }

    /// Draw back to the first point.
    pub(super) fn close(&mut self) {
        self.meet_start();
        if let (Run::Lines(points), true) = (&mut self.run, self.shapes.is_empty()) {
            if points.len() > 2 && points.last() == Some(&self.start) {
                points.pop();
            }
            let points = std::mem::take(points);
            self.run = Run::None;
            self.shapes.push(Shape::Polyline {
                points,
                closed: true,
            });
        } else if self.end != self.start {
            self.line(self.start);
        }
        self.end = self.start;
    }

    /// Get the pieces.
    pub(super) fn finish(mut self) -> Vec<Shape> {
        self.finish_run();
        self.shapes.shrink_to_fit();
        self.shapes
    }

    fn reach(&mut self, end: DVec3) {
        self.end = end;
        self.size = self.size.max(end.abs().max_element());
    }

    /// Move the last point to the first, if it is off by rounding alone.
    fn meet_start(&mut self) {
        if self.end.distance(self.start) > ROUNDING * self.size {
            return;
        }
        self.end = self.start;
        let last = match &mut self.run {
            Run::None => None,
            Run::Lines(points) => points.last_mut(),
            Run::Spline(nurbs) => nurbs.points.last_mut(),
        };
        if let Some(last) = last {
            *last = self.start;
        }
    }

    fn finish_run(&mut self) {
        match std::mem::replace(&mut self.run, Run::None) {
            Run::None => {}
            Run::Lines(mut points) => {
                points.shrink_to_fit();
                self.shapes.push(Shape::Polyline {
                    points,
                    closed: false,
                });
            }
            Run::Spline(mut nurbs) => {
                nurbs.knots.extend(nurbs.knots.last().copied());
                nurbs.points.shrink_to_fit();
                nurbs.knots.shrink_to_fit();
                self.shapes.push(Shape::Nurbs(nurbs));
            }
        }
    }
}

/// Tell whether all coordinates of a shape are finite.
pub(super) fn is_finite(shape: &Shape) -> bool {
    match shape {
        Shape::Nurbs(nurbs) => nurbs.points.iter().all(|it| it.is_finite()),
        Shape::Conic(conic) => {
            let vectors = [conic.centre, conic.x, conic.y];
            vectors.iter().all(|it| it.is_finite()) && (conic.to - conic.from).is_finite()
        }
        Shape::Polyline { points, .. } => points.iter().all(|it| it.is_finite()),
        Shape::Point(point) => point.is_finite(),
    }
}

/// Whether an arc goes on where another one ends, on the same ellipse but for rounding, without overlapping
/// it.
fn continues(last: &Conic, next: &Conic) -> bool {
    let size = last.centre.length() + last.x.length() + last.y.length();
    let near = |a: DVec3, b: DVec3| a.distance(b) <= 1e-13 * size;
    let gap = (next.from - last.to + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
    near(last.centre, next.centre)
        && near(last.x, next.x)
        && near(last.y, next.y)
        && gap.abs() <= 1e-12
        && last.to - last.from + (next.to - next.from) <= TAU + 1e-12
}
