//! Points, directions and axis placements.

use glam::{DMat3, DVec3};

use super::instances::Instances;
use super::tokens::{Params, Value};
use crate::io::exchange::drawing::Affine;

/// The cosine below which two directions count as perpendicular: corrections this small only add noise.
const SQUARE: f64 = 4.0 * f64::EPSILON;

/// Read a CARTESIAN_POINT.
pub fn point(file: &Instances, id: u64) -> Option<DVec3> {
    let point = file.get(id)?;
    match point.part("CARTESIAN_POINT")?.first::<2>() {
        [_, Value::List(list)] => coordinates(list),
        [Value::List(list), _] => coordinates(list),
        _ => None,
    }
}

/// Read a DIRECTION as it is, of any length but nought.
pub fn direction(file: &Instances, id: u64) -> Option<DVec3> {
    let [_, ratios] = file.get(id)?.part("DIRECTION")?.first::<2>();
    coordinates(ratios.list()?).filter(|it| it.length().is_normal())
}

/// Read a placement: its axes as columns x, y, z of length 1, and its origin.
pub fn axes(file: &Instances, id: u64) -> Option<Affine> {
    let (origin, x, z) = frame(file, id)?;
    let x = x.normalize();
    let z = z.normalize();
    Some(Affine {
        linear: DMat3::from_cols(x, z.cross(x).normalize(), z),
        origin,
    })
}

/// Read a placement for a conic: the centre and the half-axes of given lengths. An axis whose direction is
/// as long as the half-axis already is taken bit for bit.
pub fn half_axes(
    file: &Instances,
    id: u64,
    first: f64,
    second: f64,
) -> Option<(DVec3, DVec3, DVec3)> {
    let (centre, x, z) = frame(file, id)?;
    let y = z.cross(x);
    let scaled = |axis: DVec3, length: f64| axis * (length / axis.length());
    Some((centre, scaled(x, first), scaled(y, second)))
}

/// Read a CARTESIAN_TRANSFORMATION_OPERATOR.
pub fn operator(file: &Instances, id: u64) -> Option<Affine> {
    let instance = file.get(id)?;
    let (_, params) = instance.parts().find(|(name, params)| {
        name.starts_with("CARTESIAN_TRANSFORMATION_OPERATOR") && params.clone().next().is_some()
    })?;
    // A simple instance begins with its name, and some give the name and description of a transformation too.
    let values: Vec<Value> = params
        .skip_while(|value| matches!(value, Value::Text(_)))
        .take(5)
        .collect();
    let at = |place: usize| values.get(place).and_then(Value::reference);
    let axis = |place: usize| at(place).and_then(|id| direction(file, id));
    let origin = point(file, at(2)?)?;
    let scale = values.get(3).and_then(Value::number).unwrap_or(1.0);
    let z = axis(4).unwrap_or(DVec3::Z).normalize();
    let x = square(axis(0).unwrap_or(DVec3::X), z)?.normalize();
    let mut y = z.cross(x);
    if axis(1).is_some_and(|it| it.dot(y) < 0.0) {
        y = -y;
    }
    Some(Affine {
        linear: DMat3::from_cols(x, y, z) * scale,
        origin,
    })
}

/// Invert a placement of perpendicular axes of length 1.
pub fn inverse(axes: &Affine) -> Affine {
    let linear = axes.linear.transpose();
    Affine {
        linear,
        origin: -(linear * axes.origin),
    }
}

/// Read an axis or transformation operator as the map from its own space.
pub fn map(file: &Instances, id: u64) -> Option<Affine> {
    axes(file, id).or_else(|| operator(file, id))
}

/// The origin, the direction of x, perpendicular to z, and z; x of the length that the file gives, z of any.
fn frame(file: &Instances, id: u64) -> Option<(DVec3, DVec3, DVec3)> {
    let instance = file.get(id)?;
    let named = |id: &Value| id.reference().and_then(|id| direction(file, id));
    if let Some(params) = instance.part("AXIS2_PLACEMENT_3D") {
        let [_, origin, z, x] = params.first::<4>();
        let z = named(&z).unwrap_or(DVec3::Z);
        let x = named(&x).unwrap_or(DVec3::X);
        let origin = point(file, origin.reference()?)?;
        let x = square(x, z.normalize()).or_else(|| square(DVec3::Y, z.normalize()))?;
        return Some((origin, x, z));
    }
    let [_, origin, x] = instance.part("AXIS2_PLACEMENT_2D")?.first::<3>();
    let origin = point(file, origin.reference()?)?;
    Some((origin, named(&x).unwrap_or(DVec3::X), DVec3::Z))
}

/// Make a direction perpendicular to z; none if they are parallel.
fn square(x: DVec3, z: DVec3) -> Option<DVec3> {
    let along = x.dot(z);
    if along.abs() <= SQUARE * x.length() {
        return Some(x);
    }
    let rest = x - along * z;
    (rest.length() > 1e-9 * x.length()).then_some(rest)
}

fn coordinates(list: Params) -> Option<DVec3> {
    let mut values = [0.0; 3];
    let mut count = 0;
    for value in list {
        *values.get_mut(count)? = value.number()?;
        count += 1;
    }
    (count > 0).then_some(DVec3::from_array(values))
}
