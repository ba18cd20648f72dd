//! What moving a vertex does to proved features: against proofs of the whole curve, and against a dense
//! march along rays.

#[path = "../common/mod.rs"]
mod common;

mod curves;
mod losses;
mod moves;
mod safe_regions;
