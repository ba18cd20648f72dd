//! Points of curves, and the parameters of points.

use glam::{DVec3, DVec4};

use crate::io::exchange::drawing::{Conic, Nurbs, Shape};

/// So often a bracket loses a third: it is then 1e-7 as wide, and distances tell no more.
const THIRDS: usize = 40;

/// A spline in homogeneous coordinates.
pub struct Homogeneous {
    /// The degree.
    pub degree: usize,
    /// All knots.
    pub knots: Vec<f64>,
    /// The control points, multiplied by their weights.
    pub points: Vec<DVec4>,
}

impl Homogeneous {
    /// Multiply the points of a spline by their weights.
    pub fn of(nurbs: &Nurbs) -> Self {
        let weight = |place: usize| nurbs.weights.as_ref().and_then(|it| it.get(place)).copied();
        let points = nurbs.points.iter().enumerate().map(|(place, point)| {
            let weight = weight(place).unwrap_or(1.0);
            (*point * weight).extend(weight)
        });
        Self {
            degree: nurbs.degree,
            knots: nurbs.knots.clone(),
            points: points.collect(),
        }
    }

    /// Divide by the weights.
    pub fn into_nurbs(self, rational: bool) -> Nurbs {
        Nurbs {
            degree: self.degree,
            knots: self.knots,
            points: self.points.iter().map(|it| it.truncate() / it.w).collect(),
            weights: rational.then(|| self.points.iter().map(|it| it.w).collect()),
            periodic: false,
        }
    }

    /// Insert a knot until the curve touches its control polygon there.
    pub fn insert_fully(&mut self, knot: f64) -> Option<()> {
        let degree = self.degree;
        let mut times = self.knots.iter().filter(|it| **it == knot).count();
        while times < degree {
            let span = self.knots.iter().rposition(|it| *it <= knot)?;
            let first = (span + 1).checked_sub(degree)?;
            let blends: Option<Vec<DVec4>> = (first..=span - times)
                .map(|place| self.blend(place, degree, knot))
                .collect();
            let kept = span.checked_sub(times)?;
            if kept > self.points.len() {
                return None;
            }
            self.points.splice(first..kept, blends?);
            self.knots.insert(span + 1, knot);
            times += 1;
        }
        Some(())
    }

    /// Evaluate by de Boor's algorithm.
    pub fn at(&self, parameter: f64) -> Option<DVec3> {
        let degree = self.degree;
        let last = self.points.len().checked_sub(1)?;
        let span = self.knots.partition_point(|knot| *knot <= parameter);
        let span = span.checked_sub(1)?.clamp(degree, last);
        // Most degrees need no allocation.
        let points = self.points.get(span - degree..=span)?;
        let (mut few, mut many) = ([DVec4::ZERO; 16], Vec::new());
        let row = match few.get_mut(..=degree) {
            Some(row) => {
                row.copy_from_slice(points);
                row
            }
            None => {
                many.extend_from_slice(points);
                &mut many[..]
            }
        };
        for level in 1..=degree {
            for place in (level..=degree).rev() {
                let low = *self.knots.get(span - degree + place)?;
                let high = *self.knots.get(span + 1 + place - level)?;
                let share = if high > low {
                    (parameter - low) / (high - low)
                } else {
                    0.0
                };
                let blended = row.get(place - 1)?.lerp(*row.get(place)?, share);
                *row.get_mut(place)? = blended;
            }
        }
        row.last().map(|it| it.truncate() / it.w)
    }

    fn blend(&self, place: usize, degree: usize, knot: f64) -> Option<DVec4> {
        let low = *self.knots.get(place)?;
        let high = *self.knots.get(place + degree)?;
        let share = if high > low {
            (knot - low) / (high - low)
        } else {
            0.0
        };
        let before = *self.points.get(place.checked_sub(1)?)?;
        let Some(own) = self.points.get(place) else {
            return Some(before);
        };
        Some(before * (1.0 - share) + *own * share)
    }
}

/// Evaluate a spline where it starts.
pub fn start(nurbs: &Nurbs) -> Option<DVec3> {
    let first = *nurbs.knots.get(nurbs.degree)?;
    if nurbs.knots.first() == Some(&first) {
        return nurbs.points.first().copied();
    }
    Homogeneous::of(nurbs).at(first)
}

/// Evaluate a spline where it ends.
pub fn end(nurbs: &Nurbs) -> Option<DVec3> {
    let last = *nurbs.knots.get(nurbs.points.len())?;
    if nurbs.knots.last() == Some(&last) {
        return nurbs.points.last().copied();
    }
    Homogeneous::of(nurbs).at(last)
}

/// Where a shape starts and ends.
pub fn ends(shape: &Shape) -> Option<(DVec3, DVec3)> {
    match shape {
        Shape::Nurbs(nurbs) => Some((start(nurbs)?, end(nurbs)?)),
        Shape::Conic(conic) => Some((on_conic(conic, conic.from), on_conic(conic, conic.to))),
        Shape::Polyline { points, closed } => {
            let first = *points.first()?;
            Some((first, if *closed { first } else { *points.last()? }))
        }
        Shape::Point(point) => Some((*point, *point)),
    }
}

/// Evaluate a conic.
pub fn on_conic(conic: &Conic, angle: f64) -> DVec3 {
    conic.centre + conic.x * angle.cos() + conic.y * angle.sin()
}

/// Find the angle of the point of a conic in the direction of `point`.
pub fn angle_of(conic: &Conic, point: DVec3) -> f64 {
    let offset = point - conic.centre;
    let share = |axis: DVec3| offset.dot(axis) / axis.length_squared();
    share(conic.y).atan2(share(conic.x))
}

/// Find the parameter of the point of a spline that is nearest to `point`: the best of samples, then
/// Newton's steps by differences, which settle below rounding of the parameter in real files.
pub fn parameter_of(spline: &Homogeneous, point: DVec3) -> Option<f64> {
    let count = spline.points.len();
    let domain = spline.knots.get(spline.degree..=count)?;
    let samples = 4 * (spline.degree + 1);
    let mut best = (f64::INFINITY, *domain.first()?);
    let mut width = 0.0;
    for pair in domain.windows(2) {
        let [low, high] = pair else { continue };
        if low >= high {
            continue;
        }
        for step in 0..=samples {
            let parameter = low + (high - low) * step as f64 / samples as f64;
            let distance = spline.at(parameter)?.distance(point);
            if distance < best.0 {
                best = (distance, parameter);
                width = (high - low) / samples as f64;
            }
        }
    }
    let (low, high) = (*domain.first()?, *domain.last()?);
    refine(spline, point, best.1, width, (low, high))
}

/// Halve the bracket around a sample, by the sign of the tangent's part towards the point.
fn refine(
    spline: &Homogeneous,
    point: DVec3,
    at: f64,
    width: f64,
    domain: (f64, f64),
) -> Option<f64> {
    let (mut low, mut high) = ((at - width).max(domain.0), (at + width).min(domain.1));
    for _ in 0..THIRDS {
        let third = (high - low) / 3.0;
        let (left, right) = (low + third, high - third);
        if left <= low || right >= high {
            break;
        }
        if spline.at(left)?.distance_squared(point) <= spline.at(right)?.distance_squared(point) {
            high = right;
        } else {
            low = left;
        }
    }
    newton(spline, point, (low + high) / 2.0, width * 1e-3, domain)
}

/// Distances cannot tell parameters closer than the root of rounding: the tangent can.
fn newton(
    spline: &Homogeneous,
    point: DVec3,
    at: f64,
    step: f64,
    domain: (f64, f64),
) -> Option<f64> {
    let mut at = at;
    for _ in 0..4 {
        let (low, high) = ((at - step).max(domain.0), (at + step).min(domain.1));
        let tangent = (spline.at(high)? - spline.at(low)?) / (high - low);
        let move_by = (point - spline.at(at)?).dot(tangent) / tangent.length_squared();
        if !move_by.is_finite() || move_by.abs() > step {
            break;
        }
        at = (at + move_by).clamp(domain.0, domain.1);
    }
    Some(at)
}
