//! What most operations ask of their curve beforehand.

use super::error::OperationError;
use super::operands::Operands;
use crate::document::Curve;
use crate::geometry::PolygonError;

/// The least size of curves that are corrected: cubes of it are in the range of numbers.
const LEAST_SIZE: f64 = 1e-100;

/// Refuse a curve that is locked or hidden.
///
/// # Errors
/// [`OperationError::Edit`], or [`OperationError::Inputs`] if there is no curve.
pub(super) fn check_editable(input: &Operands) -> Result<(), OperationError> {
    editable(input).map(drop)
}

/// Refuse a curve that is locked, hidden or periodic, so that it cannot be `done`.
///
/// # Errors
/// As [`check_editable`], and [`PolygonError::PeriodicCurve`].
pub(super) fn open<'a>(
    input: &'a Operands,
    done: &'static str,
) -> Result<&'a Curve, OperationError> {
    let (_, curve) = input.curve()?;
    open_of(curve, done)?;
    Ok(curve)
}

/// Refuse a curve that is locked, hidden or periodic, so that it cannot be `done`.
///
/// # Errors
/// [`OperationError::Edit`] or [`PolygonError::PeriodicCurve`].
pub(super) fn open_of(curve: &Curve, done: &'static str) -> Result<(), OperationError> {
    curve.check_editable()?;
    if curve.polygon.is_periodic() {
        return Err(PolygonError::PeriodicCurve { done }.into());
    }
    Ok(())
}

/// Refuse a curve of which products of derivatives would be below the range of numbers: whether conditions hold
/// could not be told.
///
/// # Errors
/// [`OperationError::TooSmall`].
pub(super) fn check_measurable(curve: &Curve) -> Result<(), OperationError> {
    let size = curve.polygon.size();
    match size > 0.0 && size < LEAST_SIZE {
        true => Err(OperationError::TooSmall { size }),
        false => Ok(()),
    }
}

/// The curve, if it is neither locked nor hidden.
///
/// # Errors
/// As [`check_editable`].
pub(super) fn editable(input: &Operands) -> Result<&Curve, OperationError> {
    let (_, curve) = input.curve()?;
    curve.check_editable()?;
    Ok(curve)
}
