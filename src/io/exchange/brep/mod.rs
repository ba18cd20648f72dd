//! BREP, the text format of OpenCascade's shapes (`BRepTools`), versions 1 to 3: edges, wires and free
//! vertices with their locations. Edges of faces are boundaries; surfaces, meshes and curves in parameter
//! planes are passed over.

mod curves;
mod reader;
mod tokens;
mod topology;
mod writer;

#[cfg(test)]
mod tests;

use super::{conic_frame, spending, spline_part};

pub use reader::read;
pub use writer::write;
