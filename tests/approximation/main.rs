//! Float polygons near other curves: how far they are, and how fast they come nearer.

#[path = "../common/mod.rs"]
mod common;

mod airfoils;
mod bounds;
mod deviations;
mod fits;
mod fits_with_extrema;
mod periodic;
mod places;
mod shapes;
mod symmetric;
