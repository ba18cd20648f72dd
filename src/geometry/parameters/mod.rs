//! Descriptions of parameters, the same for references and for operations.
//!
//! A [`Parameter`] has a name, a label, a help text and a kind. The kind of a reference's parameter is a
//! [`Number`]; operations have more kinds. Fields, the command line and messages read these descriptions.

mod number;
mod parameter;
mod quantity;

pub use number::{Limits, Number, OutOfRange, SIZES, brief, check_limits};
pub use parameter::Parameter;
pub use quantity::Quantity;
