//! Edges in pictures that clicks snap to.

use glam::{DMat2, DVec2};

use crate::document::{Document, Reference};
use crate::editor::view::hit::REACH;
use crate::editor::view::sight::Sight;
use crate::geometry::nearest_edge;

/// The reach of the pointer in pixels of a picture: seen from far at least the first, from near at most the second, so
/// that an edge is found though a pixel is smaller than the pointer's reach or larger.
const PIXELS: [f64; 2] = [2.0, 32.0];

impl Sight<'_> {
    /// Find the strongest edge of the picture in front near a place of the view plane.
    pub(in crate::editor) fn picture_edge(&self, place: DVec2) -> Option<DVec2> {
        let pictures = visible(self.document()).collect::<Vec<_>>().into_iter();
        pictures.rev().find_map(|it| self.edge_of(it, place))
    }

    fn edge_of(&self, reference: &Reference, place: DVec2) -> Option<DVec2> {
        let (picture, [corner, across, up]) = reference.framed()?;
        let pyramid = self.view.pictures.get(&picture.source)?.as_ref().ok()?;
        let size = pyramid.size();
        let [width, height] = size.map(f64::from);
        let flat = |vector| self.viewport().flatten(vector);
        // Rows are counted from the upper left corner.
        let corner = flat(corner + up);
        let pixels = DMat2::from_cols(flat(across) / width, flat(-up) / height);
        let area = pixels.determinant().abs();
        if !(area > f64::MIN_POSITIVE) {
            return None;
        }
        let at = pixels.inverse() * (place - corner);
        let reach = REACH * self.viewport().pixel() / area.sqrt();
        let reach = reach.clamp(PIXELS[0], PIXELS[1]);
        let brightness = |pixel| pyramid.brightness(pixel).unwrap_or(1.0);
        let edge = nearest_edge(brightness, size, at, reach)?;
        Some(corner + pixels * edge)
    }
}

/// The references with pictures that are drawn, from back to front.
fn visible(document: &Document) -> impl Iterator<Item = &Reference> {
    let references = document.references().map(|(_, it)| it.as_ref());
    references.filter(|it| it.visible && it.picture.is_some())
}
