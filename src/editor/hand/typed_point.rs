//! Points as they are typed while something is drawn.
//!
//! `x,y` or `x,y,z` is a point; `@dx,dy` or `@dx,dy,dz` a point so far from the vertex before; and
//! `@r<angle` one at the distance r in the direction of an angle in degrees. Two numbers are along
//! the axes of the plane that is drawn in; across it the point is where the vertex before is. Here the
//! comma separates; each number may be an expression (`1/2,10*cos(30deg)`).

use glam::{DVec2, DVec3};
use thiserror::Error;

use crate::editor::hand::drawing_plane::DrawingPlane;
use crate::geometry::expressions::{ExpressionMistake, LengthUnit, NumberContext, parts};
use crate::geometry::parameters::Quantity;

/// Why nothing can be made of a text.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EntryError {
    /// It means nothing.
    #[error("column {column}: {reason}")]
    Text {
        /// The number of the first character that cannot be used, counted from 1.
        column: usize,
        /// What is wrong, and what can be typed instead.
        reason: String,
    },
    /// A number in it means nothing.
    #[error(transparent)]
    Number(#[from] ExpressionMistake),
    /// What it means cannot be done now.
    #[error("{0}")]
    Refused(String),
}

impl EntryError {
    fn new(column: usize, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Self::Text { column, reason }
    }
}

/// A point as it is typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TypedPoint {
    /// Whether it counts from the vertex before.
    pub is_relative: bool,
    coordinates: Coordinates,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Coordinates {
    /// Along the axes of the plane that is drawn in.
    Plane(DVec2),
    /// In space.
    Space(DVec3),
    /// A distance, and the direction of an angle in degrees from the plane's first axis to its second.
    Polar { length: f64, degrees: f64 },
}

impl TypedPoint {
    /// Read a text in a document with a unit of length, or without one.
    ///
    /// # Errors
    /// [`EntryError`] with the column in this text.
    pub fn read(text: &str, unit: Option<LengthUnit>) -> Result<Self, EntryError> {
        let leading = text.chars().take_while(|it| it.is_whitespace()).count();
        let trimmed = text.trim();
        let (coordinates, is_relative) = match trimmed.strip_prefix('@') {
            Some(step) => (read_step(step, leading + 1, unit)?, true),
            None => (read_coordinates(trimmed, leading, unit)?, false),
        };
        Ok(Self {
            is_relative,
            coordinates,
        })
    }

    /// The point, in a plane, after a vertex if there is one.
    ///
    /// # Errors
    /// [`EntryError`] if it counts from a vertex and there is none.
    pub fn point(self, from: Option<DVec3>, plane: &DrawingPlane) -> Result<DVec3, EntryError> {
        let by = match self.coordinates {
            Coordinates::Plane(by) => plane.lift(by),
            Coordinates::Space(by) => by,
            Coordinates::Polar { length, degrees } => length * plane.direction(degrees),
        };
        match (self.is_relative, self.coordinates, from) {
            (true, _, Some(from)) => Ok(from + by),
            (true, _, None) => {
                let reason = "there is no vertex yet to count from: type x,y";
                Err(EntryError::new(1, reason))
            }
            (false, Coordinates::Plane(_), Some(from)) => Ok(by + plane.across(from)),
            (false, ..) => Ok(by),
        }
    }
}

/// Read what follows the @, after so many characters of the whole text.
fn read_step(
    step: &str,
    before: usize,
    unit: Option<LengthUnit>,
) -> Result<Coordinates, EntryError> {
    match parts(step, '<').as_slice() {
        [(at, length), (angle_at, angle)] => Ok(Coordinates::Polar {
            length: number(length, before + at, (Quantity::Length, unit))?,
            degrees: number(angle, before + angle_at, (Quantity::Angle, unit))?,
        }),
        _ => read_coordinates(step, before, unit),
    }
}

/// Read two or three numbers with commas between them, after so many characters of the whole text.
fn read_coordinates(
    text: &str,
    before: usize,
    unit: Option<LengthUnit>,
) -> Result<Coordinates, EntryError> {
    let parts = parts(text, ',');
    let numbers = parts
        .iter()
        .map(|(at, part)| number(part, before + at, (Quantity::Length, unit)))
        .collect::<Result<Vec<f64>, EntryError>>()?;
    match (numbers.as_slice(), parts.get(3)) {
        ([x, y], _) => Ok(Coordinates::Plane(DVec2::new(*x, *y))),
        ([x, y, z], _) => Ok(Coordinates::Space(DVec3::new(*x, *y, *z))),
        (_, Some((at, _))) => {
            let reason = "a point has no more than three coordinates";
            Err(EntryError::new(before + at + 1, reason))
        }
        _ => {
            let end = before + text.chars().count() + 1;
            let reason = "a second coordinate is missing: type x,y, @dx,dy or @length<angle";
            Err(EntryError::new(end, reason))
        }
    }
}

/// Read a number of a part that begins after so many characters.
fn number(
    part: &str,
    before: usize,
    (quantity, unit): (Quantity, Option<LengthUnit>),
) -> Result<f64, EntryError> {
    let number = read_number(part, quantity, unit);
    Ok(number.map_err(|mistake| mistake.shifted(before))?)
}

/// Read a single number: a length in the document's unit, an angle in degrees, or a mere number.
///
/// # Errors
/// [`ExpressionMistake`] with the column in this text.
pub fn read_number(
    text: &str,
    quantity: Quantity,
    unit: Option<LengthUnit>,
) -> Result<f64, ExpressionMistake> {
    let context = NumberContext {
        quantity,
        unit,
        before: None,
    };
    context.read(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::view::viewport::Viewport;

    fn point(text: &str, from: Option<DVec3>) -> Result<DVec3, EntryError> {
        let plane = DrawingPlane::of(&Viewport::default());
        TypedPoint::read(text, Some(LengthUnit::Centimetre))?.point(from, &plane)
    }

    #[test]
    fn points_are_read_as_they_are_written() {
        let from = Some(DVec3::new(1.0, 2.0, 3.0));
        for (text, expected) in [
            ("4,5", DVec3::new(4.0, 5.0, 3.0)),
            ("40mm, 2*2.5cm", DVec3::new(4.0, 5.0, 3.0)),
            (" -4 , .5 ", DVec3::new(-4.0, 0.5, 3.0)),
            ("4,5,6", DVec3::new(4.0, 5.0, 6.0)),
            ("@4,−5", DVec3::new(5.0, -3.0, 3.0)),
            ("@1,1,-3", DVec3::new(2.0, 3.0, 0.0)),
            ("@10<90", DVec3::new(1.0, 12.0, 3.0)),
            ("@1e1<180°", DVec3::new(-9.0, 2.0, 3.0)),
            ("@-2<0", DVec3::new(-1.0, 2.0, 3.0)),
            ("8/2,max(1,5)", DVec3::new(4.0, 5.0, 3.0)),
            ("@2*5<30deg+60", DVec3::new(1.0, 12.0, 3.0)),
        ] {
            assert_eq!(point(text, from), Ok(expected), "{text}");
        }
        assert_eq!(point("4,5", None), Ok(DVec3::new(4.0, 5.0, 0.0)));
    }

    #[test]
    fn mistakes_are_told_with_their_column() {
        let from = Some(DVec3::ZERO);
        for (text, column) in [
            ("", 1),
            ("4", 2),
            ("4,", 3),
            ("4,five", 3),
            (" 4, five", 5),
            ("1,2,3,4", 7),
            ("@", 2),
            ("@4", 3),
            ("@4<", 4),
            ("@4<a", 4),
            ("@4<5<6", 3),
            ("inf,1", 1),
        ] {
            let error = point(text, from).expect_err(text);
            let place = format!("column {column}: ");
            assert!(error.to_string().starts_with(&place), "{text}: {error}");
        }
        let nothing_before = point("@1,2", None);
        assert!(matches!(
            nothing_before,
            Err(EntryError::Text { column: 1, .. })
        ));
    }
}
