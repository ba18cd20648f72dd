//! Operations: their descriptions, what they do to curves, what they report and refuse.

#[path = "../common/mod.rs"]
mod common;

mod approximations;
mod arrays;
mod between;
mod degrees;
mod descriptions;
mod ends;
mod fits;
mod groups;
mod harmony;
mod joining;
mod locks;
mod matches;
mod mineur_farin;
mod mirrors;
mod parts;
mod random;
mod reached;
mod reports;
mod runner;
mod symmetry;
