//! All that is known of one curve, kept up to date segment by segment.

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::chain_outlines::ChainOutlines;
use super::curvature_series::CurvatureSeries;
use super::curve_outlines::{CurveOutlines, PieceTrend};
use super::curve_samples::{CurveSamples, SampledCurve};
use super::discrete_curvature::append_discrete_curvature;
use super::feature_proof::{FeatureProof, ProofResult, ProvedFeatures};
use super::level_series::{LevelPlot, LevelSeries};
use super::orientation::Orientation;
use super::outline::{Bounds, ViewBox};
use super::revision::Revision;
use super::sample::Sample;
use super::vertex_chain::{VertexChain, changed_range};
use crate::document::Curve;
use crate::geometry::features::Features;
use crate::geometry::{ClampedPolygon, FloatPolygon, Range as Span};

/// Hold the samples of a curve, its closed S-polygon, its features, and what is drawn of them.
#[derive(Debug)]
pub struct CurveAnalysis {
    curve: Arc<Curve>,
    samples: CurveSamples,
    float: VertexChain,
    clamped: VertexChain,
    features: ProvedFeatures,
    curvature: CurvatureSeries,
    levels: LevelSeries,
    redone: usize,
    outlines: CurveOutlines,
    float_outlines: ChainOutlines,
    clamped_outlines: ChainOutlines,
}

impl CurveAnalysis {
    /// Analyse a curve that is seen from somewhere.
    pub fn new(curve: Arc<Curve>, orientation: Orientation) -> Self {
        let polygon = &curve.polygon;
        let mut analysis = Self {
            samples: CurveSamples::new(polygon),
            float: VertexChain::default(),
            clamped: VertexChain::default(),
            features: ProvedFeatures::new(polygon.segments()),
            curvature: CurvatureSeries::default(),
            levels: LevelSeries::default(),
            redone: polygon.segments(),
            outlines: CurveOutlines::default(),
            float_outlines: ChainOutlines::default(),
            clamped_outlines: ChainOutlines::default(),
            curve,
        };
        let polygon = &analysis.curve.polygon;
        analysis
            .float
            .update(polygon.vertices(), polygon.is_periodic());
        analysis
            .clamped
            .update(ClampedPolygon::from_float(polygon).vertices(), false);
        analysis.set_orientation(orientation);
        analysis
    }

    /// Bring the analysis up to date with the curve. Only segments that depend on a vertex that
    /// moved, or whose weight changed, are sampled again.
    pub fn update(&mut self, curve: &Arc<Curve>) {
        if Arc::ptr_eq(&self.curve, curve) {
            return;
        }
        let (old, new) = (&self.curve.polygon, &curve.polygon);
        let alike = old.degree() == new.degree()
            && old.is_periodic() == new.is_periodic()
            && old.is_rational() == new.is_rational();
        let changed = alike
            .then(|| self.float.update(new.vertices(), new.is_periodic()))
            .flatten();
        let Some(mut changed) = changed else {
            *self = Self::new(curve.clone(), self.outlines.orientation());
            return;
        };
        let [old, new] = [old, new].map(|polygon| polygon.weights().unwrap_or_default());
        if let Some(weights) = changed_range(old, new) {
            changed = if changed.is_empty() {
                weights
            } else {
                changed.start.min(weights.start)..changed.end.max(weights.end)
            };
        }
        self.curve = curve.clone();
        self.redone = 0;
        if changed.is_empty() {
            return;
        }
        let new = &self.curve.polygon;
        let moved = &new.vertices()[changed.clone()];
        let planar = if self.samples.is_planar() {
            moved.iter().all(|vertex| vertex.z == 0.0)
        } else {
            new.is_planar()
        };
        if planar != self.samples.is_planar() {
            *self = Self::new(curve.clone(), self.outlines.orientation());
            return;
        }
        for segments in dependent_segments(new, &changed) {
            self.redone += segments.len();
            self.samples.redo(new, segments.clone());
            self.features.forget(segments);
        }
        self.outlines.update(SampledCurve {
            curve: new,
            samples: &self.samples,
        });
        self.update_clamped(changed);
    }

    /// Choose from where the curve is seen; what is drawn of it is made anew.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        self.outlines.set_orientation(orientation);
        self.float_outlines.set_orientation(orientation);
        self.clamped_outlines.set_orientation(orientation);
        let curve = &self.curve.polygon;
        let samples = &self.samples;
        self.outlines.update(SampledCurve { curve, samples });
    }

    /// The curve as it was last analysed.
    pub fn curve(&self) -> &Arc<Curve> {
        &self.curve
    }

    /// The curve with its samples.
    pub fn sampled(&self) -> SampledCurve<'_> {
        SampledCurve {
            curve: &self.curve.polygon,
            samples: &self.samples,
        }
    }

    /// Whether the curve is planar, and its curvature therefore signed.
    pub fn is_planar(&self) -> bool {
        self.samples.is_planar()
    }

    /// The float S-polygon's vertices.
    pub fn float(&self) -> &VertexChain {
        &self.float
    }

    /// The closed S-polygon's vertices; of a periodic curve, opened at u = 0.
    pub fn clamped(&self) -> &VertexChain {
        &self.clamped
    }

    /// The closed S-polygon's vertices.
    pub fn clamped_vertices(&self) -> &[DVec3] {
        self.clamped.vertices()
    }

    /// The number of segments that the last update sampled.
    pub fn segments_redone(&self) -> usize {
        self.redone
    }

    /// The samples of one segment, its ends included, at even parameters.
    pub fn segment_samples(&self, segment: usize) -> &[Sample] {
        self.samples.piece(segment)
    }

    /// Measure the arc length from the samples: to plotting accuracy, not the exact figure.
    pub fn length(&self) -> f64 {
        self.samples.length()
    }

    /// Measure the arc length from the curve's start to u, to plotting accuracy.
    pub fn length_at(&self, u: f64) -> f64 {
        self.sampled().length_at(u)
    }

    /// Find the parameter at an arc length from the curve's start; the inverse of
    /// [`CurveAnalysis::length_at`].
    pub fn parameter_at_length(&self, length: f64) -> f64 {
        self.samples.parameter_at_length(length)
    }

    /// The smallest and largest sampled curvature.
    pub fn curvature(&self) -> Option<Span> {
        self.samples.curvature()
    }

    /// What is left to prove of the features: a job for any thread. `None` if all are known.
    pub fn proof(&self) -> Option<FeatureProof> {
        self.features.proof(&self.curve, self.is_planar())
    }

    /// Changes whenever there is something to prove anew.
    pub fn proof_revision(&self) -> Revision {
        self.features.revision()
    }

    /// Take what a proof came to. It counts for segments that have not changed since.
    pub fn take_proof(&mut self, result: ProofResult) {
        self.features.take(result);
    }

    /// The proved features, if all are known.
    pub fn known_features(&self) -> Option<&Features> {
        self.features.known(&self.curve)
    }

    /// The share of the curve whose features are known.
    pub fn proof_progress(&self) -> f64 {
        self.features.share()
    }

    /// The number of segments that the last proof counted for.
    pub fn segments_proved(&self) -> usize {
        self.features.proved()
    }

    /// Append the curvature over arc length: see [`CurvatureSeries::append`].
    pub fn append_curvature(&mut self, out: &mut Vec<DVec2>) {
        let curve = &self.curve.polygon;
        let samples = &self.samples;
        self.curvature.append(SampledCurve { curve, samples }, out);
    }

    /// Append the polygon's discrete curvature: see [`append_discrete_curvature`].
    pub fn append_discrete_curvature(&self, out: &mut Vec<(usize, DVec2)>) -> f64 {
        append_discrete_curvature(&self.curve.polygon, &self.float, self.sampled(), out)
    }

    /// Append a plot of levels: see [`LevelSeries::append`].
    pub fn append_levels(&mut self, plot: LevelPlot, normalised: bool, out: &mut Vec<DVec2>) {
        let curve = &self.curve.polygon;
        let samples = &self.samples;
        let sampled = SampledCurve { curve, samples };
        self.levels.append(sampled, plot, normalised, out);
    }

    /// The outlines of the curve, and what they are made of.
    pub fn outlines(&mut self) -> (&mut CurveOutlines, SampledCurve<'_>) {
        let curve = &self.curve.polygon;
        let samples = &self.samples;
        (&mut self.outlines, SampledCurve { curve, samples })
    }

    /// The outlines of the float S-polygon, and what they are made of.
    pub fn float_outlines(&mut self) -> (&mut ChainOutlines, &VertexChain) {
        (&mut self.float_outlines, &self.float)
    }

    /// The outlines of the closed S-polygon, and what they are made of.
    pub fn clamped_outlines(&mut self) -> (&mut ChainOutlines, &VertexChain) {
        (&mut self.clamped_outlines, &self.clamped)
    }

    /// Append what is visible of the pieces of the curve on which its curvature does one thing, once
    /// its features are known.
    pub fn append_trend(&mut self, trend: PieceTrend, view: &ViewBox, out: &mut Vec<DVec2>) {
        let sampled = SampledCurve {
            curve: &self.curve.polygon,
            samples: &self.samples,
        };
        if let Some(segments) = self.features.segments() {
            self.outlines
                .append_trend(sampled, segments, trend, view, out);
        }
    }

    /// The box around the curve, as it is seen.
    pub fn bounds(&self) -> Bounds {
        self.outlines.bounds()
    }

    /// Find the point of the curve that is seen nearest to `target`: see [`CurveOutlines::nearest`].
    pub fn nearest(&self, target: DVec2, reach: f64) -> Option<(f64, DVec2, f64)> {
        self.outlines.nearest(self.sampled(), target, reach)
    }

    /// Carry moved vertices over to the closed polygon: inner vertices are the same, and the
    /// n − 1 at either end are converted anew if they may have moved.
    fn update_clamped(&mut self, changed: Range<usize>) {
        let polygon = &self.curve.polygon;
        let (count, degree) = (polygon.vertices().len(), polygon.degree());
        let simple = !polygon.is_periodic() && !polygon.is_rational() && count > 4 * degree;
        if !simple {
            let clamped = ClampedPolygon::from_float(polygon);
            self.clamped.update(clamped.vertices(), false);
            return;
        }
        let near_end = changed.start < degree || changed.end > count - degree;
        let inner = changed.start.max(degree)..changed.end.min(count - degree);
        if !inner.is_empty() {
            self.clamped
                .replace(inner.start, &polygon.vertices()[inner]);
        }
        if near_end {
            let ends = [0..2 * degree, count - 2 * degree..count];
            for (range, keep_first) in ends.into_iter().zip([true, false]) {
                let vertices = polygon.vertices()[range.clone()].to_vec();
                let Ok(part) = FloatPolygon::new(degree, vertices, None, false) else {
                    continue;
                };
                let part = ClampedPolygon::from_float(&part);
                let (first, own) = if keep_first {
                    (0, &part.vertices()[..degree])
                } else {
                    (count - degree, &part.vertices()[degree..])
                };
                self.clamped.replace(first, own);
            }
        }
    }
}

/// List the segments that depend on the vertices of a range: one range, or two where a periodic
/// curve's segments wrap around.
fn dependent_segments(polygon: &FloatPolygon, changed: &Range<usize>) -> Vec<Range<usize>> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    if !polygon.is_periodic() {
        let first = changed.start.saturating_sub(degree);
        return vec![first..changed.end.min(segments)];
    }
    if changed.len() + degree >= segments {
        return vec![0..segments];
    }
    match changed.start.checked_sub(degree) {
        Some(first) => vec![first..changed.end],
        None => {
            let wrapped = changed.start + segments - degree;
            vec![0..changed.end, wrapped..segments]
        }
    }
}
