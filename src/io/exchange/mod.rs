//! Formats of CAD and drawing programs: each reader makes a [`Drawing`](drawing::Drawing) of bytes, of which curves and
//! references are taken; each writer makes bytes of one.

mod brep;
mod chains;
pub(super) mod changes;
mod choice;
mod conic_frame;
mod cubics;
mod curve_json;
pub mod drawing;
pub(super) mod dxf;
pub(super) mod formats;
mod glif;
mod iges;
pub mod import;
mod memory;
#[cfg(test)]
mod mutate;
mod obj;
mod pieces;
mod reading;
pub(super) mod remarks;
pub(super) mod short_names;
mod single_points;
pub(super) mod spending;
mod spline_part;
mod splines;
mod step;
mod svg;
mod text_edits;
mod threedm;
pub(super) mod writing;
