//! What most operations ask of their curve beforehand.

use super::error::OperationError;
use super::operands::Operands;
use crate::document::Curve;
use crate::geometry::PolygonError;

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

/// The curve, if it is neither locked nor hidden.
///
/// # Errors
/// As [`check_editable`].
pub(super) fn editable(input: &Operands) -> Result<&Curve, OperationError> {
    let (_, curve) = input.curve()?;
    curve.check_editable()?;
    Ok(curve)
}
