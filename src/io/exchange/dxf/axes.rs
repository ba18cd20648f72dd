//! The coordinate system of an entity (OCS), by the arbitrary axis algorithm of the DXF reference.

use glam::{DMat3, DVec3};

use super::groups::Trouble;
use super::records::Record;
use crate::io::exchange::drawing::Affine;

/// Below this in x and y, an extrusion counts as parallel to z.
const NEAR_Z: f64 = 1.0 / 64.0;

/// Take the system of an entity by its extrusion.
///
/// # Errors
/// [`Trouble`] if the extrusion has no length or is damaged.
pub fn axes(record: &Record<'_>) -> Result<Affine, Trouble> {
    let Some(normal) = unit_normal(record)? else {
        return Ok(Affine::default());
    };
    let near_z = normal.x.abs() < NEAR_Z && normal.y.abs() < NEAR_Z;
    let along = if near_z { DVec3::Y } else { DVec3::Z };
    let x = along.cross(normal).normalize();
    let y = normal.cross(x).normalize();
    Ok(Affine {
        linear: DMat3::from_cols(x, y, normal),
        origin: DVec3::ZERO,
    })
}

/// Take the unit extrusion of an entity; `None` if it is z.
///
/// # Errors
/// [`Trouble`] if the extrusion has no length or is damaged.
pub fn unit_normal(record: &Record<'_>) -> Result<Option<DVec3>, Trouble> {
    let Some(x) = record.real(210)? else {
        return Ok(None);
    };
    let y = record.real(220)?.unwrap_or(0.0);
    let z = record.real(230)?.unwrap_or(0.0);
    let normal = DVec3::new(x, y, z);
    if x == 0.0 && y == 0.0 && z > 0.0 {
        return Ok(None);
    }
    // The scale keeps the length of any finite vector finite and above 0.
    let scaled = normal / normal.abs().max_element();
    let unit = scaled.try_normalize();
    let none = || record.trouble("its extrusion has no length");
    unit.map(Some).ok_or_else(none)
}
