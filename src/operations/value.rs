//! A value of a parameter, or a figure.

use crate::geometry::End;
use crate::geometry::references::ReferenceCurve;

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Whole(usize),
    /// A finite number; angles are in radians.
    Real(f64),
    /// Which of the options it is, counted from 0.
    Choice(usize),
    /// On or off.
    Switch(bool),
    /// Some finite numbers; none where nothing is given.
    List(Vec<f64>),
    /// The numbers of some things, counted from 0; only figures have them.
    Indices(Vec<usize>),
    /// An end of a first curve and one of a second; only figures have them.
    Ends([End; 2]),
    /// A reference, or none.
    Reference(Option<Box<ReferenceCurve>>),
}
