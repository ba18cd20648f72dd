//! All that is known of one reference: samples, plots and sampled features.

use std::cell::OnceCell;
use std::sync::Arc;

use glam::DVec2;

use super::curvature_series::CurvatureSeries;
use super::curve_samples::{CurveSamples, SampledCurve};
use super::level_series::{LevelPlot, LevelSeries};
use super::sampled_features::{SampledFeature, sampled_features};
use super::vertex_chain::VertexChain;
use crate::document::Reference;

/// Hold the samples of a reference, its plots, and its features as far as samples tell them.
#[derive(Debug)]
pub struct ReferenceAnalysis {
    reference: Arc<Reference>,
    samples: CurveSamples,
    curvature: CurvatureSeries,
    levels: LevelSeries,
    features: OnceCell<Vec<SampledFeature>>,
    /// The points of a list, where they are placed.
    points: VertexChain,
}

impl ReferenceAnalysis {
    /// Analyse a reference.
    pub fn new(reference: Arc<Reference>) -> Self {
        let mut points = VertexChain::default();
        points.update(&reference.points().unwrap_or_default(), false);
        Self {
            samples: CurveSamples::new(&reference.curve),
            curvature: CurvatureSeries::default(),
            levels: LevelSeries::default(),
            features: OnceCell::new(),
            points,
            reference,
        }
    }

    /// Bring the analysis up to date with the reference; it is sampled again only if its curve
    /// changed.
    pub fn update(&mut self, reference: &Arc<Reference>) {
        if self.reference.curve == reference.curve {
            self.reference = reference.clone();
        } else {
            *self = Self::new(reference.clone());
        }
    }

    /// The reference as it was last analysed.
    pub fn reference(&self) -> &Arc<Reference> {
        &self.reference
    }

    /// The reference's curve with its samples; a list of points is sampled as a polyline.
    pub fn sampled(&self) -> SampledCurve<'_> {
        SampledCurve {
            curve: &self.reference.curve,
            samples: &self.samples,
        }
    }

    /// The points of a list, where they are placed; none of a curve.
    pub fn points(&self) -> &VertexChain {
        &self.points
    }

    /// Whether it is a curve that has a curvature everywhere; a list of points is none.
    pub fn is_smooth(&self) -> bool {
        self.reference.curve.form().is_smooth()
    }

    /// Append the curvature over arc length: see [`CurvatureSeries::append`].
    pub fn append_curvature(&mut self, out: &mut Vec<DVec2>) {
        let (curve, samples) = (&self.reference.curve, &self.samples);
        self.curvature.append(SampledCurve { curve, samples }, out);
    }

    /// Append a plot of levels: see [`LevelSeries::append`].
    pub fn append_levels(&mut self, plot: LevelPlot, normalised: bool, out: &mut Vec<DVec2>) {
        let (curve, samples) = (&self.reference.curve, &self.samples);
        let sampled = SampledCurve { curve, samples };
        self.levels.append(sampled, plot, normalised, out);
    }

    /// List the features that samples show, in the order of u. What lies between two samples
    /// may be missed: nothing is proved. A list of points has none.
    pub fn features(&self) -> &[SampledFeature] {
        let find = || match self.is_smooth() {
            true => sampled_features(self.sampled()),
            false => Vec::new(),
        };
        self.features.get_or_init(find)
    }
}
