//! Proofs of moves of some vertices, from the proofs of the rest of the curve.

use glam::DVec3;
use thiserror::Error;

use super::feature_rise::{FeatureRise, doubts};
use crate::geometry::error::PolygonError;
use crate::geometry::features::{Features, SegmentFeatures, SegmentProver};
use crate::geometry::float_polygon::FloatPolygon;

/// Prove the features of a planar curve with some of its vertices elsewhere.
///
/// Only the segments that depend on one of these vertices are proved anew, n + 1 for a single one;
/// together with those known before they are put together as a proof of the whole curve would.
#[derive(Debug)]
pub struct MoveProver {
    /// The curve, its vertices where they were tried last.
    polygon: FloatPolygon,
    segments: Vec<SegmentFeatures>,
    vertices: Vec<usize>,
    dependent: Vec<usize>,
    prover: SegmentProver,
    before: Features,
}

/// Say why nothing can be proved of a move.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MoveError {
    /// Only the features of planar curves are compared.
    #[error("the curve is in space: this is for planar curves, with z = 0 throughout")]
    Space,
    /// Undecided features before the move allow no comparison.
    #[error("some features of the curve are undecided: move a vertex at one of these places first")]
    Undecided,
    /// A vertex does not exist, or cannot be there.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

impl MoveProver {
    /// Prepare for moves of these vertices. `proved` are the features of all segments of the curve.
    ///
    /// # Errors
    /// [`MoveError`] if the curve is not planar, if features of it are undecided, or if a vertex does
    /// not exist.
    pub fn new(
        polygon: &FloatPolygon,
        proved: &[SegmentFeatures],
        vertices: Vec<usize>,
    ) -> Result<Self, MoveError> {
        if !polygon.is_planar() {
            return Err(MoveError::Space);
        }
        let count = polygon.vertices().len();
        if let Some(&index) = vertices.iter().find(|index| **index >= count) {
            return Err(PolygonError::NoSuchVertex { index, count }.into());
        }
        let before = Features::assemble(polygon, proved);
        if doubts(&before) > 0 {
            return Err(MoveError::Undecided);
        }
        let of_vertex = |index: &usize| polygon.dependent_segments(&(*index..*index + 1));
        let dependent = vertices.iter().flat_map(of_vertex).flatten();
        let mut dependent: Vec<usize> = dependent.collect();
        dependent.sort_unstable();
        dependent.dedup();
        Ok(Self {
            polygon: polygon.clone(),
            segments: proved.to_vec(),
            vertices,
            dependent,
            prover: SegmentProver::new(true),
            before,
        })
    }

    /// The features of the curve as it was.
    pub fn before(&self) -> &Features {
        &self.before
    }

    /// The segments that are proved anew for each move, in rising order.
    pub fn dependent(&self) -> &[usize] {
        &self.dependent
    }

    /// Prove the features of the whole curve with its vertices at these places, one a vertex.
    ///
    /// # Errors
    /// [`MoveError`] if a place is out of the plane or cannot be used.
    pub fn features(&mut self, places: &[DVec3]) -> Result<Features, MoveError> {
        if places.iter().any(|place| place.z != 0.0) {
            return Err(MoveError::Space);
        }
        let moves = self.vertices.iter().copied().zip(places.iter().copied());
        self.polygon.move_vertices(moves)?;
        for segment in &self.dependent {
            self.segments[*segment] = self.prover.segment(&self.polygon, *segment);
        }
        Ok(Features::assemble(&self.polygon, &self.segments))
    }

    /// Prove the added features with the vertices at these places.
    ///
    /// # Errors
    /// As [`MoveProver::features`].
    pub fn rise(&mut self, places: &[DVec3]) -> Result<FeatureRise, MoveError> {
        let after = self.features(places)?;
        Ok(FeatureRise::between(&self.before, &after))
    }
}
