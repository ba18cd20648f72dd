//! IGES 5.x in fixed ASCII, by the standard (US PRO/IPO-100): curves and points with their placements,
//! levels, names, groups and colours. Surfaces and annotation are counted.

mod conics;
mod directory;
mod entities;
mod global;
mod links;
mod names;
mod parameters;
mod reader;
mod records;
mod sheet;
mod splines;
mod writer;

#[cfg(test)]
mod tests;

use super::{conic_frame, spending, spline_part};

pub use reader::read;
pub use writer::write;
