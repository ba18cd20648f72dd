//! Rhino's 3DM files: archives of versions 2 to 8 are read, archives of version 4 written.
//!
//! The layouts are those of openNURBS. Curves and points are read with layers, names, colours and
//! the blocks that place them, and the edges of breps; meshes, surfaces and texts are counted. User
//! data, materials and views are skipped.

mod attributes;
mod breps;
mod chunks;
mod classes;
mod cursor;
mod curves;
mod ends;
mod exact;
mod geometry;
mod instances;
mod knots;
mod layers;
mod objects;
mod output;
mod properties;
mod scene;
mod table;
mod writer;

#[cfg(test)]
mod tests;

use crate::io::exchange::drawing::{Drawing, Unreadable};

pub(in crate::io) use geometry::is_spline;

/// Read a 3DM file.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    table::scene(bytes).map(scene::Scene::drawing)
}

/// The names of a group's path that a file holds.
pub fn kept_group(path: &[String]) -> Vec<String> {
    path.iter()
        .map(|name| writer::layer_name(Some(name)))
        .collect()
}

/// Write a 3DM file: curves without a group come onto the layer `name`.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing, name)
}
