//! Reference curves: their values, derivatives, placement and texts.

#[path = "../common/mod.rs"]
mod common;

mod numbers;
mod nurbs;
mod texts;
mod values;
