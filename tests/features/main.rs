//! Proved features: against exact counts, in special cases, and under what must not change them.

#[path = "../common/mod.rs"]
mod common;
#[path = "../witness/mod.rs"]
mod witness;

mod cases;
mod exact_counts;
mod harmony;
mod intervals;
mod invariance;
mod trends;
