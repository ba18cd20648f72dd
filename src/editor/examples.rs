//! The built-in examples, as commands name them.

use crate::io::examples::EXAMPLES;

/// The number of built-in examples.
pub fn count() -> usize {
    EXAMPLES.len()
}

/// The title of an example; empty if there is none with this number.
pub fn title(index: usize) -> String {
    EXAMPLES
        .get(index)
        .map_or("", |example| example.title)
        .to_owned()
}

/// One sentence about an example.
pub fn description(index: usize) -> String {
    EXAMPLES
        .get(index)
        .map_or("", |example| example.description)
        .to_owned()
}
