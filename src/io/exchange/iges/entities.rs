//! The shapes of single entities, in their own coordinates.

use glam::{DMat3, DVec2, DVec3};

use super::conics::{ConicArc, ellipse_arc, is_whole};
use super::parameters::Parameters;
use super::spline_part::{self, is_finite};
use super::splines;
use crate::io::exchange::drawing::{Affine, Kind, Nurbs, Shape};

/// The highest degree taken: cutting a spline costs its square.
const DEGREE: usize = 128;

/// One shape, or the points of a set, each an item of its own.
pub(super) enum Content {
    One(Shape),
    Points(Vec<DVec3>),
}

/// What an entity's parameters give.
pub(super) struct Found {
    pub kind: Kind,
    pub content: Content,
    /// How many parameters are the entity's own, with the type: pointers to properties follow.
    pub used: usize,
    /// What was survived.
    pub remark: Option<String>,
}

impl Found {
    fn new(kind: Kind, shape: Shape, used: usize) -> Self {
        Self {
            kind,
            content: Content::One(shape),
            used,
            remark: None,
        }
    }
}

/// Say whether an entity is a curve or a point of its own.
pub(super) fn is_shape(entity: u32, form: i32) -> bool {
    match entity {
        100 | 104 | 110 | 112 | 116 | 126 => true,
        106 => matches!(form, 1..=3 | 11..=13 | 63),
        _ => false,
    }
}

/// Read the shape of an entity that [`is_shape`].
///
/// # Errors
/// The reason why it is skipped.
pub(super) fn read(entity: u32, form: i32, from: &Parameters) -> Result<Found, String> {
    let found = match entity {
        100 => circle(from)?,
        104 => conic(form, from)?,
        106 => copious_data(form, from)?,
        110 => line(form, from)?,
        112 => parametric_spline(from)?,
        116 => Found::new(Kind::Point, Shape::Point(from.point(1)?), 5),
        _ => spline(from)?,
    };
    match &found.content {
        Content::One(shape) if !is_finite(shape) => Err("its numbers are too large".to_owned()),
        _ => Ok(found),
    }
}

/// Read a transformation (type 124).
///
/// # Errors
/// A reason if numbers are missing.
pub(super) fn transformation(from: &Parameters) -> Result<Affine, String> {
    let mut rows = [[0.0; 4]; 3];
    for (index, value) in rows.iter_mut().flatten().enumerate() {
        *value = from.number(index.saturating_add(1))?;
    }
    let [x, y, z] = rows;
    Ok(Affine {
        linear: DMat3::from_cols(
            DVec3::new(x[0], y[0], z[0]),
            DVec3::new(x[1], y[1], z[1]),
            DVec3::new(x[2], y[2], z[2]),
        ),
        origin: DVec3::new(x[3], y[3], z[3]),
    })
}

fn pair(from: &Parameters, index: usize) -> Result<DVec2, String> {
    Ok(DVec2::new(
        from.number(index)?,
        from.number(index.saturating_add(1))?,
    ))
}

fn circle(from: &Parameters) -> Result<Found, String> {
    let z = from.number(1)?;
    let (centre, start, end) = (pair(from, 2)?, pair(from, 4)?, pair(from, 6)?);
    let (start, end) = (start - centre, end - centre);
    let radius = start.length();
    if !(radius > 0.0) {
        return Err("the radius is 0".to_owned());
    }
    let conic = ellipse_arc(
        centre.extend(z),
        DVec3::X * radius,
        DVec3::Y * radius,
        start,
        end,
    );
    let kind = if is_whole(&conic) {
        Kind::Circle
    } else {
        Kind::Arc
    };
    let mut found = Found::new(kind, Shape::Conic(conic), 8);
    let miss = (end.length() - radius).abs();
    if miss > 1.0e-6 * radius {
        found.remark = Some(format!(
            "the end of the arc misses its circle by {miss:.3e}"
        ));
    }
    Ok(found)
}

fn conic(form: i32, from: &Parameters) -> Result<Found, String> {
    let mut coefficients = [0.0; 6];
    for (index, value) in coefficients.iter_mut().enumerate() {
        *value = from.number(index.saturating_add(1))?;
    }
    let arc = ConicArc {
        coefficients,
        z: from.number(7)?,
        start: pair(from, 8)?,
        end: pair(from, 10)?,
        form,
    };
    arc.shape().map(|(kind, shape)| Found::new(kind, shape, 12))
}

fn line(form: i32, from: &Parameters) -> Result<Found, String> {
    let points = vec![from.point(1)?, from.point(4)?];
    let mut found = Found::new(
        Kind::Line,
        Shape::Polyline {
            points,
            closed: false,
        },
        7,
    );
    if matches!(form, 1 | 2) {
        found.remark = Some("an unbounded line; taken between its two points".to_owned());
    }
    Ok(found)
}

/// Point sets (forms 1 to 3), chains (11 to 13) and closed areas (63), with or without vectors at the points.
fn copious_data(form: i32, from: &Parameters) -> Result<Found, String> {
    let per_point = match from.integer(1)? {
        1 => 2,
        2 => 3,
        3 => 6,
        other => return Err(format!("interpretation flag {other}")),
    };
    let count = from.count(2)?;
    let first: usize = if per_point == 2 { 4 } else { 3 };
    let z = if per_point == 2 { from.number(3)? } else { 0.0 };
    let mut points = Vec::with_capacity(count.min(from.len() / per_point));
    for index in 0..count {
        let at = first.saturating_add(index.saturating_mul(per_point));
        points.push(if per_point == 2 {
            pair(from, at)?.extend(z)
        } else {
            from.point(at)?
        });
    }
    let used = first.saturating_add(count.saturating_mul(per_point));
    if matches!(form, 1..=3) {
        return Ok(Found {
            kind: Kind::Point,
            content: Content::Points(points),
            used,
            remark: None,
        });
    }
    let is_repeated = points.len() > 2 && points.first() == points.last();
    if is_repeated {
        points.pop();
    }
    if points.len() < 2 {
        return Err("it has fewer than two points".to_owned());
    }
    let closed = form == 63 || is_repeated;
    Ok(Found::new(
        Kind::Polyline,
        Shape::Polyline { points, closed },
        used,
    ))
}

fn parametric_spline(from: &Parameters) -> Result<Found, String> {
    let count = from.count(4)?;
    if count == 0 {
        return Err("it has no segments".to_owned());
    }
    let after = 6_usize.saturating_add(count);
    let used = after.saturating_add(count.saturating_mul(12));
    if used > from.len() {
        return Err(format!(
            "{count} segments need {used} parameters, it has {}",
            from.len()
        ));
    }
    let breaks = (5..after)
        .map(|index| from.number(index))
        .collect::<Result<Vec<_>, _>>()?;
    let mut segments = Vec::with_capacity(count);
    for start in (after..used).step_by(12) {
        let mut axes = [[0.0; 4]; 3];
        for (offset, value) in axes.iter_mut().flatten().enumerate() {
            *value = from.number(start.saturating_add(offset))?;
        }
        let [x, y, z] = axes;
        segments.push([0, 1, 2, 3].map(|power: usize| DVec3::new(x[power], y[power], z[power])));
    }
    let nurbs = splines::of_segments(&breaks, &segments)?;
    // Twelve numbers of the last point follow.
    Ok(Found::new(
        Kind::Spline,
        Shape::Nurbs(nurbs),
        used.saturating_add(12),
    ))
}

fn spline(from: &Parameters) -> Result<Found, String> {
    let count = from.count(1)?.saturating_add(1);
    let degree = usize::try_from(from.integer(2)?).map_err(|_| "the degree is negative")?;
    if degree == 0 || degree > DEGREE {
        return Err(format!("degree {degree}"));
    }
    if count <= degree {
        return Err(format!("{count} points are too few for degree {degree}"));
    }
    let weights_at = count.saturating_add(degree).saturating_add(8);
    let points_at = weights_at.saturating_add(count);
    let range_at = points_at.saturating_add(count.saturating_mul(3));
    if range_at > from.len() {
        let own = from.len();
        return Err(format!(
            "{count} points of degree {degree} need {range_at} parameters, it has {own}"
        ));
    }
    let knots = (7..weights_at)
        .map(|index| from.number(index))
        .collect::<Result<Vec<_>, _>>()?;
    let weights = (weights_at..points_at)
        .map(|index| from.number(index))
        .collect::<Result<Vec<_>, _>>()?;
    let points = (points_at..range_at).step_by(3);
    let nurbs = Nurbs {
        degree,
        knots,
        points: points
            .map(|index| from.point(index))
            .collect::<Result<Vec<_>, _>>()?,
        weights: own_weights(weights),
        periodic: from.integer(6)? == 1,
    };
    spline_part::check(&nurbs)?;
    let (range, remark) = parameter_range(&nurbs, from, range_at);
    let nurbs = spline_part::cut(nurbs, range.0, range.1);
    let mut found = Found::new(
        Kind::Spline,
        Shape::Nurbs(nurbs),
        range_at.saturating_add(5),
    );
    found.remark = remark;
    Ok(found)
}

/// Weights that differ.
fn own_weights(weights: Vec<f64>) -> Option<Vec<f64>> {
    let is_rational = weights.windows(2).any(|pair| pair[0] != pair[1]);
    let is_damaged = weights.iter().any(|weight| !(*weight > 0.0));
    (is_rational || is_damaged).then_some(weights)
}

/// The range V0 to V1 within the domain of a spline.
fn parameter_range(nurbs: &Nurbs, from: &Parameters, at: usize) -> ((f64, f64), Option<String>) {
    let domain = (
        nurbs.knots.get(nurbs.degree).copied().unwrap_or_default(),
        nurbs
            .knots
            .get(nurbs.points.len())
            .copied()
            .unwrap_or_default(),
    );
    let (Ok(start), Ok(end)) = (from.number(at), from.number(at.saturating_add(1))) else {
        return (
            domain,
            Some("the parameter range is missing; the whole curve is taken".to_owned()),
        );
    };
    let range = (
        start.clamp(domain.0, domain.1),
        end.clamp(domain.0, domain.1),
    );
    if !(range.0 < range.1) {
        let text =
            format!("the parameter range {start} to {end} is empty; the whole curve is taken");
        return (domain, Some(text));
    }
    let excess = (domain.0 - start).max(end - domain.1);
    // Rounded numbers may end a little outside.
    let is_outside = excess > 1.0e-9 * (domain.1 - domain.0);
    let remark =
        || format!("the parameter range {start} to {end} goes beyond the knots; cut off there");
    (range, is_outside.then(remark))
}
