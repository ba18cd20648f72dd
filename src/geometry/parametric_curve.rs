//! Interface of parametric curves to sampling, hit tests and plots.

use glam::DVec3;

use super::control_polygon::ControlPolygon;
use super::curvature_levels::{CurvatureLevels, LEVEL_ORDER};
use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::sampler::{BATCH_ORDER, Batch, Sampler};
use super::segment_expansion::SegmentExpansion;

/// A curve in pieces, each smooth over its local parameter t in \[0, 1\]: the parameter u = piece + t
/// of the whole runs over \[0, m\].
pub trait ParametricCurve {
    /// The number of pieces m, at least 1.
    fn pieces(&self) -> usize;

    /// Whether the end of the last piece is the start of the first.
    fn is_periodic(&self) -> bool;

    /// Whether the curve lies in the plane z = 0, and its curvature is therefore signed.
    fn is_planar(&self) -> bool;

    /// Number of continuous derivatives where two pieces meet.
    fn continuity(&self) -> usize;

    /// Fill `values` with the point and as many derivatives by t as there is room for, at the local
    /// parameter t of a piece. At a joint this chooses the side, with t = 0 or t = 1.
    ///
    /// # Panics
    /// If the curve has no piece with this number, or there is room for more than [`LEVEL_ORDER`]
    /// derivatives.
    fn fill_derivatives(&self, piece: usize, t: f64, values: &mut [DVec3]);

    /// Find the piece that holds u and the local parameter in it.
    ///
    /// A periodic curve takes u modulo m; an open one continues its first and last pieces beyond
    /// \[0, m\].
    fn locate(&self, u: f64) -> (usize, f64) {
        let pieces = self.pieces();
        let u = if self.is_periodic() {
            u.rem_euclid(pieces as f64)
        } else {
            u
        };
        // The cast takes NaN and everything below 0 to piece 0.
        let piece = (u.floor() as usize).min(pieces - 1);
        (piece, u - piece as f64)
    }

    /// Evaluate the point and the first three derivatives.
    fn jet(&self, u: f64) -> Jet {
        let (piece, t) = self.locate(u);
        self.piece_jet(piece, t)
    }

    /// Evaluate as [`ParametricCurve::jet`] does, on a given piece.
    ///
    /// # Panics
    /// If the curve has no piece with this number.
    fn piece_jet(&self, piece: usize, t: f64) -> Jet {
        let mut values = [DVec3::ZERO; 4];
        self.fill_derivatives(piece, t, &mut values);
        Jet::from(values)
    }

    /// Evaluate the points and the derivatives up to `order` (at most 3) of one piece, at the even
    /// parameters of the batch.
    ///
    /// # Panics
    /// If `order` is above 3, or the curve has no piece with this number.
    fn fill_batch(&self, piece: usize, order: usize, batch: &mut EvenBatch) {
        assert!(order <= BATCH_ORDER, "derivatives up to the third");
        let EvenBatch { steps, batch, .. } = batch;
        batch.fill(*steps + 1, order, |index, values| {
            self.fill_derivatives(piece, index as f64 / *steps as f64, values);
        });
    }

    /// Compute the levels of curvature and torsion at some local parameters of one piece of the curve
    /// scaled by `scale` > 0. `planar` is [`ParametricCurve::is_planar`], which takes time of its own.
    ///
    /// # Panics
    /// If the curve has no piece with this number.
    fn levels(
        &self,
        piece: usize,
        parameters: &[f64],
        scale: f64,
        planar: bool,
    ) -> Vec<CurvatureLevels> {
        let levels = parameters.iter().map(|t| {
            let mut values = [DVec3::ZERO; LEVEL_ORDER + 1];
            self.fill_derivatives(piece, *t, &mut values);
            CurvatureLevels::of_derivatives(&values, scale, planar)
        });
        levels.collect()
    }
}

/// Hold the points and derivatives of one piece at even parameters, both of its ends included.
#[derive(Debug)]
pub struct EvenBatch {
    steps: usize,
    batch: Batch,
    /// Evaluator of float polygons of one degree.
    sampler: Option<Sampler>,
}

impl EvenBatch {
    /// Make room for `steps` + 1 parameters, at least two.
    pub fn new(steps: usize) -> Self {
        Self {
            steps: steps.max(1),
            batch: Batch::default(),
            sampler: None,
        }
    }

    /// The number of steps that a piece is divided into.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// The point and the derivatives at one parameter; those beyond the order are 0.
    ///
    /// # Panics
    /// If the batch has no parameter with this number.
    pub fn jet(&self, index: usize) -> Jet {
        self.batch.jet(index)
    }
}

impl ParametricCurve for FloatPolygon {
    fn pieces(&self) -> usize {
        self.segments()
    }

    fn is_periodic(&self) -> bool {
        self.is_periodic()
    }

    fn is_planar(&self) -> bool {
        ControlPolygon::is_planar(self)
    }

    fn continuity(&self) -> usize {
        self.degree() - 1
    }

    fn fill_derivatives(&self, piece: usize, t: f64, values: &mut [DVec3]) {
        // Distances take few derivatives, of very many points.
        if values.len() <= 3 {
            let derivatives: [DVec3; 3] = self.segment_derivatives(piece, t);
            values.copy_from_slice(&derivatives[..values.len()]);
            return;
        }
        let derivatives: [DVec3; LEVEL_ORDER + 1] = self.segment_derivatives(piece, t);
        values.copy_from_slice(&derivatives[..values.len()]);
    }

    fn piece_jet(&self, piece: usize, t: f64) -> Jet {
        self.segment_jet(piece, t)
    }

    /// All segments share one basis: see [`Sampler`].
    fn fill_batch(&self, piece: usize, order: usize, batch: &mut EvenBatch) {
        let kept = batch.sampler.take();
        let sampler = kept
            .filter(|sampler| sampler.degree() == self.degree())
            .unwrap_or_else(|| Sampler::even(self.degree(), batch.steps));
        sampler.segment(self, piece, order, &mut batch.batch);
        batch.sampler = Some(sampler);
    }

    /// See [`SegmentExpansion`].
    fn levels(
        &self,
        piece: usize,
        parameters: &[f64],
        scale: f64,
        planar: bool,
    ) -> Vec<CurvatureLevels> {
        let expansion = SegmentExpansion::new(self, piece, planar);
        let levels = parameters
            .iter()
            .map(|t| expansion.curvature_levels(*t, scale));
        levels.collect()
    }
}
