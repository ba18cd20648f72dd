//! Corrections of ends, and harmonising.

#[path = "../common/mod.rs"]
mod common;
mod corrections;
mod following;
mod harmonising;
