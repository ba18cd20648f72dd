//! Operations: what makes curves from curves, or from parameters alone, on request.
//!
//! An operation is a value ([`Operation`]): its name and words, the inputs it wants, its
//! parameters described once, and one function from an [`Input`] and checked [`Values`] to an
//! [`Outcome`]: edits, figures and marks. Menus, the operation panel and the command line all read
//! that description. Nothing in here opens windows or threads, or changes a document.
//!
//! A new operation is a file here that exports a `pub static OPERATION`, and a line in the
//! table below.

mod alternatives;
mod amount;
mod atlas;
mod bridge;
mod cutting;
mod degree;
mod editable;
mod error;
mod features;
mod handle;
mod harmony_json;
mod input;
mod inputs;
mod lists;
mod locks;
mod matches;
mod operation;
mod outcome;
mod parameter;
mod report;
mod report_json;
mod report_text;
mod summary;
mod targets;
mod value;
mod values;
mod which_end;
mod whole;

pub use amount::Amount;
pub use atlas::Atlas;
pub use error::OperationError;
pub use features::{FeatureComparison, FeatureCounts};
pub use handle::{Handle, Sets};
pub use input::Input;
pub use inputs::Inputs;
pub use operation::Operation;
pub use outcome::{Deviation, Figure, Mark, Outcome};
pub use parameter::{Choice, Kind, Limits, Parameter, Unit};
pub use report::{LargestMove, Report};
pub use value::Value;
pub use values::Values;

/// Declare the modules of operations, and list what they export in this order.
macro_rules! table {
    ($($module:ident,)*) => {
        $(pub mod $module;)*

        /// Every operation, in the order in which they are offered.
        pub static ALL: &[&Operation] = &[$(&$module::OPERATION,)*];
    };
}

table! {
    reverse,
    reinterpret_degree,
    elevate_degree,
    reduce_degree,
    subdivide,
    extend,
    join,
    close,
    split,
    trim,
    round,
    translate_end,
    rotate_end,
    correct_ends,
    harmonise,
    mineur_farin,
    approximate,
    fit,
    between,
}

/// Find an operation by its name.
pub fn find(name: &str) -> Option<&'static Operation> {
    ALL.iter().copied().find(|operation| operation.name == name)
}
