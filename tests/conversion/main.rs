//! Conversions and operations on polygons: against exact rational arithmetic, there and back, what
//! they report, and properties.

#[path = "../common/mod.rs"]
mod common;
mod exact_witness;

mod exact_conversions;
mod exact_operations;
mod polygons;
mod properties;
mod reports;
mod round_trips;
