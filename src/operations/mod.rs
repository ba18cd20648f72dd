//! Operations: what makes curves from curves, or from parameters alone, on request.
//!
//! An operation is a value ([`Operation`]): its name and words, the inputs it wants, its
//! parameters described once, and one function from an [`Operands`] and checked [`Values`] to an
//! [`Outcome`]: edits, figures and annotations. Menus, the operation panel and the command line all read
//! that description. Nothing in here opens windows or threads, or changes a document.
//!
//! A new operation is a file here that exports a `pub static OPERATION`, and a line in the
//! table below.

mod alternatives;
mod amount;
mod atlas;
mod bent_half;
mod bridge;
mod composite;
mod copied_matches;
mod crossing;
mod cutting;
mod degree;
mod each;
mod editable;
mod end_change;
mod error;
mod feature_change;
mod features;
mod fit_piece;
mod fit_warnings;
mod floats;
mod half;
mod handle;
mod harmony_json;
mod inputs;
mod lists;
mod locks;
mod lowering;
mod matched_curves;
mod matches;
mod operands;
mod operation;
mod outcome;
mod parameter;
mod report;
mod report_json;
mod report_text;
mod summary;
mod targets;
mod time_limit;
mod turned_over;
mod value;
mod values;
mod which_end;
mod whole;

pub use amount::Amount;
pub use atlas::Atlas;
pub use each::Share;
pub use error::OperationError;
pub use feature_change::{changed_features, feature_change, feature_counts};
pub use features::{FeatureComparison, FeatureCounts};
pub use floats::{FloatRequest, floated};
pub use handle::{Handle, OnCurve, Sets};
pub use inputs::Inputs;
pub use lowering::{Lowered, lowered, told_of_lowered};
pub use matched_curves::{followers, matched, newly_matched, told_of_bent};
pub use operands::Operands;
pub use operation::Operation;
pub use outcome::{Annotation, Copying, Deviation, Figure, Outcome};
pub use parameter::{Choice, Kind, Parameter};
pub use report::{LargestMove, Report};
pub use targets::moved_with;
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
    mirror,
    array,
    make_symmetric,
    reinterpret_degree,
    elevate_degree,
    reduce_degree,
    refine,
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
    to_float,
    fit,
    between,
}

/// Find an operation by its name.
pub fn find(name: &str) -> Option<&'static Operation> {
    ALL.iter().copied().find(|operation| operation.name == name)
}
