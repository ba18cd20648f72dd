//! The analysis of one curve, updated segment by segment.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec2;

use super::curve_samples::{CurveSamples, SampledCurve};
use super::discrete_curvature::append_discrete_curvature;
use super::feature_proof::{FeatureProof, ProofResult, ProvedFeatures};
use super::harmony_measurement::{HarmonyMeasurement, MeasuredHarmony};
use super::level_series::{LevelPlot, LevelSeries};
use super::revision::Revision;
use super::vertex_chain::{VertexChain, changed_range};
use crate::document::Curve;
use crate::geometry::features::{Features, SegmentFeatures};
use crate::geometry::harmony::Harmony;
use crate::geometry::{ClampedPolygon, FloatPolygon, Range as Span};

/// A curvature that is less than this, by the size of the curve, is rounding of a straight one.
pub const STRAIGHT: f64 = 1e-9;

/// Hold the samples of a curve, its polygons' vertices, its features and its plots.
#[derive(Debug)]
pub struct CurveAnalysis {
    curve: Arc<Curve>,
    samples: CurveSamples,
    float: VertexChain,
    clamped: VertexChain,
    features: ProvedFeatures,
    levels: LevelSeries,
    /// The harmony that was measured last.
    harmony: Option<Arc<MeasuredHarmony>>,
    redone: usize,
}

impl CurveAnalysis {
    /// Analyse a curve.
    pub fn new(curve: Arc<Curve>) -> Self {
        let polygon = &curve.polygon;
        let mut analysis = Self {
            samples: CurveSamples::new(polygon),
            float: VertexChain::default(),
            clamped: VertexChain::default(),
            features: ProvedFeatures::new(polygon.segments()),
            levels: LevelSeries::default(),
            harmony: None,
            redone: polygon.segments(),
            curve,
        };
        let polygon = &analysis.curve.polygon;
        analysis
            .float
            .update(polygon.vertices(), polygon.is_periodic());
        analysis
            .clamped
            .update(ClampedPolygon::from_float(polygon).vertices(), false);
        analysis
    }

    /// Update the analysis. Only segments that depend on a moved vertex or a changed weight are sampled
    /// again.
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
            *self = Self::new(curve.clone());
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
            *self = Self::new(curve.clone());
            return;
        }
        for segments in new.dependent_segments(&changed) {
            self.redone += segments.len();
            self.samples.redo(new, segments.clone());
            self.features.forget(segments);
        }
        self.update_clamped(changed);
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

    /// The curve's samples.
    pub fn samples(&self) -> &CurveSamples {
        &self.samples
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

    /// The number of segments that the last update sampled.
    pub fn segments_redone(&self) -> usize {
        self.redone
    }

    /// The open part of the features' proof, a job for any thread; `None` if all is proved.
    pub fn proof(&self) -> Option<FeatureProof> {
        self.features.proof(&self.curve, self.is_planar())
    }

    /// The revision of the proof: it changes whenever there is something to prove.
    pub fn proof_revision(&self) -> Revision {
        self.features.revision()
    }

    /// Take the result of a proof. It counts for segments that have not changed since.
    pub fn take_proof(&mut self, result: ProofResult) {
        self.features.take(result);
    }

    /// The proved features, if all are known.
    pub fn known_features(&self) -> Option<&Features> {
        self.features.known(&self.curve)
    }

    /// The smallest and largest curvature: that of the samples, and once the features are proved that of the extrema
    /// between them, to rounding. Signed if the curve is planar. What is less than 1e-9 by the size of the polygon is 0.
    pub fn curvature(&self) -> Option<Span> {
        let polygon = &self.curve.polygon;
        let extrema = self.known_features().into_iter();
        let extrema = extrema.flat_map(|features| &features.curvature_extrema);
        let values = extrema.filter(|it| it.value.iter().all(|bound| bound.is_finite()));
        let values = values.map(|it| {
            let jet = polygon.jet(0.5 * (it.u[0] + it.u[1]));
            jet.curvature_of(self.is_planar())
        });
        let sampled = self.samples.curvature()?;
        let Span { low, high } = values.fold(sampled, Span::with);
        let straight = STRAIGHT / polygon.size();
        let above = |value: f64| if value.abs() > straight { value } else { 0.0 };
        Some(Span {
            low: above(low),
            high: above(high),
        })
    }

    /// The features of all segments, if they are known.
    pub fn proved_segments(&self) -> Option<&[SegmentFeatures]> {
        self.features.segments()
    }

    /// The share of the curve whose features are known.
    pub fn proof_progress(&self) -> f64 {
        self.features.share()
    }

    /// The number of segments that the last proof counted for.
    pub fn segments_proved(&self) -> usize {
        self.features.proved()
    }

    /// The measurement of the curve's harmony, a job for any thread; `None` if the harmony is known, and
    /// until the features are proved.
    pub fn harmony_measurement(&self) -> Option<HarmonyMeasurement> {
        if self.harmony().is_some() {
            return None;
        }
        let features = self.known_features()?.clone();
        let known = self.harmony.clone();
        Some(HarmonyMeasurement::new(self.curve.clone(), features, known))
    }

    /// Take the result of a measurement. It counts until the curve changes, and spares work afterwards.
    pub fn take_harmony(&mut self, measured: MeasuredHarmony) {
        self.harmony = Some(Arc::new(measured));
    }

    /// The harmony of the curve, once it is measured.
    pub fn harmony(&self) -> Option<&Harmony> {
        let measured = self.harmony.as_ref()?;
        measured.of(&self.curve)
    }

    /// Append the polygon's discrete curvature at its vertices, by their numbers, over arc length.
    /// Vertices that lie beyond an end of the curve stand evenly spaced in a flank beside it.
    /// Of many vertices only the outermost are listed, but of a `part` between two arc lengths all, if
    /// it has few. Returns the flanks' width, 0 if there are none.
    pub fn append_discrete_curvature(
        &self,
        part: Option<[f64; 2]>,
        out: &mut Vec<(usize, DVec2)>,
    ) -> f64 {
        append_discrete_curvature(&self.curve.polygon, &self.float, self.sampled(), part, out)
    }

    /// Append a plot of the whole curve: see [`LevelSeries::append`].
    pub fn append_levels(&mut self, plot: LevelPlot, normalised: bool, out: &mut Vec<DVec2>) {
        let (curve, samples) = (&self.curve.polygon, &self.samples);
        let sampled = SampledCurve { curve, samples };
        self.levels.append(sampled, plot, normalised, out);
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
