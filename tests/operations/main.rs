//! Operations: their descriptions, what they do to curves, what they report and refuse.

mod between;
#[path = "../common/mod.rs"]
mod common;
mod degrees;
mod descriptions;
mod ends;
mod harmony;
mod joining;
mod locks;
mod matches;
mod mineur_farin;
mod parts;
mod random;
mod reports;
mod runner;
