//! Reference curves: their values, derivatives, placement and texts.

#[path = "../common/mod.rs"]
mod common;

mod numbers;
mod texts;
mod values;
