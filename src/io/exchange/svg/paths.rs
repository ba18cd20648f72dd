//! The data of paths.

use glam::DVec3;
use svgtypes::{PathParser, PathSegment};

use super::super::pieces::Pieces;
use super::transforms::sin_cos_degrees;
use crate::io::exchange::drawing::{Conic, Shape};

/// What a path was made of beside its subpaths.
#[derive(Default)]
pub(super) struct Outcome {
    /// Why the rest of the path is missing.
    pub(super) error: Option<svgtypes::Error>,
    /// How many subpaths were no more than a point.
    pub(super) empty: usize,
    /// Whether there was no room for all points.
    pub(super) is_full: bool,
}

/// Read the data of a path up to its first error, giving the pieces of each subpath; stop where it is
/// refused, or where a subpath has too many points.
pub(super) fn read(
    data: &str,
    most_points: usize,
    take: &mut dyn FnMut(Vec<Shape>) -> bool,
) -> Outcome {
    walk(data, most_points, take, &mut |_| {})
}

/// Read where each `M` and `m` of the data leads.
pub(super) fn starts(data: &str) -> Vec<DVec3> {
    let mut starts = Vec::new();
    walk(data, usize::MAX, &mut |_| true, &mut |start| {
        starts.push(start);
    });
    starts
}

fn walk(
    data: &str,
    most_points: usize,
    take: &mut dyn FnMut(Vec<Shape>) -> bool,
    moved: &mut dyn FnMut(DVec3),
) -> Outcome {
    let mut pen = Pen {
        pieces: None,
        start: DVec3::ZERO,
        at: DVec3::ZERO,
        cubic: None,
        quadratic: None,
        outcome: Outcome::default(),
        take,
        moved,
        refused: false,
        most_points,
        points: 0,
        last: 0,
    };
    for segment in PathParser::from(data) {
        match segment {
            Ok(segment) => pen.draw(segment),
            Err(error) => {
                pen.outcome.error = Some(error);
                break;
            }
        }
        if pen.points > pen.most_points {
            pen.outcome.is_full = true;
        }
        if pen.refused || pen.outcome.is_full {
            break;
        }
    }
    pen.lift();
    pen.outcome
}

/// Where the drawing of a path is.
struct Pen<'t> {
    pieces: Option<Pieces>,
    /// The start of the subpath.
    start: DVec3,
    at: DVec3,
    /// The last control point of a cubic, if that was the last segment.
    cubic: Option<DVec3>,
    /// The same of a quadratic.
    quadratic: Option<DVec3>,
    outcome: Outcome,
    take: &'t mut dyn FnMut(Vec<Shape>) -> bool,
    /// Called with the start of each subpath that a command begins.
    moved: &'t mut dyn FnMut(DVec3),
    refused: bool,
    /// How many points a subpath may have.
    most_points: usize,
    /// How many it has, about.
    points: usize,
    /// How many the last segment had.
    last: usize,
}

/// The memory of a piece, in points.
const PIECE: usize = 12;

impl Pen<'_> {
    fn draw(&mut self, segment: PathSegment) {
        let cubic = self.cubic.take();
        let quadratic = self.quadratic.take();
        let points = points_of(&segment);
        // Segments of another kind begin another piece.
        if std::mem::replace(&mut self.last, points) != points {
            self.points += PIECE;
        }
        self.points += points;
        match segment {
            PathSegment::MoveTo { abs, x, y } => self.move_to(self.point(abs, x, y)),
            PathSegment::LineTo { abs, x, y } => self.line(self.point(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                let x = if abs { x } else { self.at.x + x };
                self.line(DVec3::new(x, self.at.y, 0.0));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                let y = if abs { y } else { self.at.y + y };
                self.line(DVec3::new(self.at.x, y, 0.0));
            }
            PathSegment::CurveTo {
                abs,
                x1,
                y1,
                x2,
                y2,
                x,
                y,
            } => {
                let first = self.point(abs, x1, y1);
                self.cubic_to(first, self.point(abs, x2, y2), self.point(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = self.reflected(cubic);
                self.cubic_to(first, self.point(abs, x2, y2), self.point(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.quadratic_to(self.point(abs, x1, y1), self.point(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                self.quadratic_to(self.reflected(quadratic), self.point(abs, x, y));
            }
            PathSegment::EllipticalArc {
                abs,
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
            } => {
                let to = self.point(abs, x, y);
                self.arc(rx, ry, x_axis_rotation, (large_arc, sweep), to);
            }
            PathSegment::ClosePath { .. } => self.close(),
        }
    }

    fn point(&self, absolute: bool, x: f64, y: f64) -> DVec3 {
        let point = DVec3::new(x, y, 0.0);
        if absolute { point } else { self.at + point }
    }

    fn reflected(&self, control: Option<DVec3>) -> DVec3 {
        control.map_or(self.at, |it| 2.0 * self.at - it)
    }

    fn pieces(&mut self) -> &mut Pieces {
        let at = self.at;
        self.pieces.get_or_insert_with(|| Pieces::new(at))
    }

    fn move_to(&mut self, to: DVec3) {
        self.lift();
        (self.moved)(to);
        self.start = to;
        self.at = to;
        self.pieces = Some(Pieces::new(to));
    }

    fn line(&mut self, to: DVec3) {
        self.pieces().line(to);
        self.at = to;
    }

    fn cubic_to(&mut self, first: DVec3, second: DVec3, to: DVec3) {
        self.pieces().spline(3, &[first, second, to]);
        self.cubic = Some(second);
        self.at = to;
    }

    fn quadratic_to(&mut self, control: DVec3, to: DVec3) {
        self.pieces().spline(2, &[control, to]);
        self.quadratic = Some(control);
        self.at = to;
    }

    fn arc(&mut self, rx: f64, ry: f64, degrees: f64, flags: (bool, bool), to: DVec3) {
        if self.at == to {
            return;
        }
        let radii = (rx.abs(), ry.abs());
        if radii.0 > 0.0 && radii.1 > 0.0 {
            let arc = conic(self.at, to, radii, degrees, flags);
            self.pieces().arc(arc, to);
            self.at = to;
        } else {
            self.line(to);
        }
    }

    fn close(&mut self) {
        if let Some(mut pieces) = self.pieces.take() {
            if !pieces.is_empty() {
                pieces.close();
            }
            self.pieces = Some(pieces);
        }
        self.at = self.start;
        self.lift();
    }

    /// End the subpath.
    fn lift(&mut self) {
        match self.pieces.take() {
            Some(pieces) if pieces.is_empty() => self.outcome.empty += 1,
            Some(pieces) => self.refused |= !(self.take)(pieces.finish()),
            None => {}
        }
        self.points = 0;
    }
}

/// How many points the memory of a segment takes.
fn points_of(segment: &PathSegment) -> usize {
    match segment {
        PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. } => 0,
        PathSegment::LineTo { .. }
        | PathSegment::HorizontalLineTo { .. }
        | PathSegment::VerticalLineTo { .. } => 1,
        PathSegment::Quadratic { .. } | PathSegment::SmoothQuadratic { .. } => 2,
        PathSegment::CurveTo { .. } | PathSegment::SmoothCurveTo { .. } => 3,
        PathSegment::EllipticalArc { .. } => size_of::<Shape>().div_ceil(size_of::<DVec3>()),
    }
}

/// Find the ellipse of an arc by its ends, as SVG's implementation notes (B.2.4) describe it; radii that are
/// too small grow.
fn conic(
    from: DVec3,
    to: DVec3,
    (rx, ry): (f64, f64),
    degrees: f64,
    (large, sweep): (bool, bool),
) -> Conic {
    let (sin, cos) = sin_cos_degrees(degrees);
    let (along, across) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
    // In the coordinates where the ellipse is the unit circle, half of the chord is (x, y).
    let half = 0.5 * (from - to);
    let (x, y) = (half.dot(along) / rx, half.dot(across) / ry);
    let length = x.hypot(y);
    let grow = length.max(1.0);
    let (rx, ry, x, y, length) = (rx * grow, ry * grow, x / grow, y / grow, length / grow);
    let offset = ((1.0 - length) * (1.0 + length)).max(0.0).sqrt() / length;
    let offset = if large == sweep { -offset } else { offset };
    let (centre_x, centre_y) = (offset * y, -offset * x);
    let first = (y - centre_y).atan2(x - centre_x);
    let last = (-y - centre_y).atan2(-x - centre_x);
    let turn = std::f64::consts::TAU;
    let centre = 0.5 * (from + to) + centre_x * rx * along + centre_y * ry * across;
    // An arc against the angle runs along it on the mirrored axis.
    let sign = if sweep { 1.0 } else { -1.0 };
    let from = sign * first;
    let span = (sign * (last - first)).rem_euclid(turn);
    Conic {
        centre,
        x: rx * along,
        y: sign * ry * across,
        from,
        to: from + span,
    }
}
