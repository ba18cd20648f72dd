//! The marks of a plot: features, bands of rising and falling curvature, joined parts.

use glam::DVec2;

use crate::analysis::{CurveAnalysis, LengthCursor, LevelPlot, SampledCurve};
use crate::editor::view::curve_outlines::PieceTrend;
use crate::editor::view::feature_report::{FeatureKind, FeatureMark, FeatureRow};
use crate::editor::view::layers::Layer;
use crate::editor::view::plot_scene::{MarkSource, PlotBand, PlotKind, PlotScene, PlotSource};
use crate::editor::view::shown::Shown;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;
use crate::geometry::ParametricCurve;
use crate::geometry::features::SegmentFeatures;

/// Features that are nearer together than this share of what a plot shows are one mark.
const FINEST_MARK: f64 = 1.0 / 8192.0;

/// Bands are looked at in so many places along what a plot shows.
const BANDS: f64 = 2048.0;

/// The plot of the torsion itself.
const TORSION: LevelPlot = LevelPlot::Torsion(1);

/// Whether a plot shows the quantity that has a feature.
fn shows(plot: LevelPlot, kind: FeatureKind) -> bool {
    match kind {
        FeatureKind::Inflection
        | FeatureKind::CurvatureMaximum
        | FeatureKind::CurvatureMinimum
        | FeatureKind::CurvatureJump => plot == LevelPlot::CURVATURE,
        FeatureKind::TorsionZero | FeatureKind::TorsionMaximum | FeatureKind::TorsionMinimum => {
            plot == TORSION
        }
        FeatureKind::Cusp | FeatureKind::Undecided => {
            [LevelPlot::CURVATURE, TORSION].contains(&plot)
        }
    }
}

/// The plotted quantity at a feature: not a number where there is none.
fn value_at(row: &FeatureRow, plot: LevelPlot, curve: &dyn ParametricCurve, planar: bool) -> f64 {
    match (row.kind, row.value) {
        (_, Some([low, high])) => 0.5 * (low + high),
        (FeatureKind::Inflection | FeatureKind::TorsionZero, _) => 0.0,
        _ if plot == LevelPlot::CURVATURE => curve.jet(row.middle).curvature_of(planar),
        _ => curve.jet(row.middle).torsion(),
    }
}

impl View {
    /// Mark features and joined parts in the plot; marks are made again only when their inputs change.
    pub(super) fn mark_plot(
        &mut self,
        plots: &mut PlotScene,
        shown: Shown<'_>,
        joint: Option<[f64; 2]>,
    ) {
        let source = self.plotted.as_ref().map(|_| MarkSource {
            features: shown.layers.shows(Layer::Features) && self.sight(shown).features().is_some(),
            joint,
        });
        // The series were not made anew, nor did what their marks are made of change.
        if source == self.plot_marked {
            return;
        }
        plots.features.clear();
        plots.bands.clear();
        plots.joints.clear();
        if let Some((source, plotted)) = source.as_ref().zip(self.plotted.as_ref()) {
            if source.features {
                self.sight(shown).mark_features(plots, plotted);
            }
            if let Some(joint) = source.joint {
                self.sight(shown).mark_joint(plots, plotted, joint);
            }
        }
        self.plot_marked = source;
    }
}

impl PlotScene {
    /// How many units of the plot's axis are one of the curve.
    fn scale(&self) -> f64 {
        match self.length > 0.0 {
            true => self.extent / self.length,
            false => 1.0,
        }
    }
}

impl Sight<'_> {
    fn mark_features(self, plots: &mut PlotScene, source: &PlotSource) {
        let analyses = &self.view.analyses;
        let (PlotKind::Levels { plot, .. }, Some(sampled)) =
            (source.kind, analyses.sampled(source.id))
        else {
            return;
        };
        let rows = self.features().map_or(&[][..], |report| &report.rows);
        let planar = sampled.samples.is_planar();
        let scale = plots.scale();
        let mut cursor = LengthCursor::default();
        let [from, to] = plots.part.unwrap_or([0.0, plots.length]);
        let apart = FINEST_MARK * (to - from);
        let mut last = f64::NEG_INFINITY;
        for row in rows.iter().filter(|row| shows(plot, row.kind)) {
            let along = cursor.length_at(sampled, row.middle);
            if (along - last).abs() < apart {
                continue;
            }
            last = along;
            let value = value_at(row, plot, sampled.curve, planar);
            plots.features.push(FeatureMark {
                kind: row.kind,
                at: DVec2::new(along * scale, value / scale),
                u: row.middle,
            });
        }
        let analysis = analyses.get(source.id);
        let segments = analysis.and_then(CurveAnalysis::proved_segments);
        if let Some(segments) = segments.filter(|_| plot == LevelPlot::CURVATURE) {
            append_bands(sampled, segments, to - from, &mut plots.bands);
            for band in &mut plots.bands {
                band.from *= scale;
                band.to *= scale;
            }
        }
    }

    /// Mark the part between two parameters, in strips its vertices; on a periodic curve it may run
    /// over the end.
    fn mark_joint(self, plots: &mut PlotScene, source: &PlotSource, [from, to]: [f64; 2]) {
        let (id, kind) = (source.id, source.kind);
        let Some(sampled) = self.view.analyses.sampled(id) else {
            return;
        };
        match kind {
            PlotKind::Levels {
                plot: LevelPlot::Logarithmic,
                ..
            } => return,
            PlotKind::Levels { .. } => {}
            PlotKind::Harmony => {
                let degree = self.document().curve(id).map(|it| it.polygon.degree());
                let first = from + degree.unwrap_or_default() as f64;
                plots.joints.push([first, to].map(|vertex| vertex - 0.5));
                return;
            }
        }
        let scale = plots.scale();
        let (end, whole) = (sampled.curve.pieces() as f64, plots.length);
        // On a periodic curve the end is the start.
        let within = |u: f64| match u < end {
            true => scale * sampled.length_at(u.max(0.0)),
            false => scale * whole,
        };
        plots.joints.push([from, to].map(within));
        if sampled.curve.is_periodic() && to > end {
            plots.joints.push([0.0, within(to - end)]);
        }
    }
}

/// Append the parts on which the curvature does one thing, as far as they are long enough to see where
/// a plot shows a part of the curve of some `extent`.
fn append_bands(
    sampled: SampledCurve<'_>,
    segments: &[SegmentFeatures],
    extent: f64,
    out: &mut Vec<PlotBand>,
) {
    let mut cursor = LengthCursor::default();
    let step = extent / BANDS;
    // The next place that is looked at.
    let mut next = 0.5 * step;
    let mut from = 0.0;
    let mut add = |trend: Option<PieceTrend>, (segment, until): (usize, f64)| {
        let to = cursor.length_on(sampled, segment, until);
        if to > next {
            next += ((to - next) / step).floor() * step + step;
            match (trend, out.last_mut()) {
                (Some(trend), Some(last)) if last.trend == trend && last.to >= from => last.to = to,
                (Some(trend), _) => out.push(PlotBand { trend, from, to }),
                (None, _) => {}
            }
        } else if let Some(last) = out.last_mut().filter(|last| last.to >= from) {
            // What is too short to see belongs to what comes before.
            last.to = to;
        }
        from = to;
    };
    let mut run: Option<(Option<PieceTrend>, (usize, f64))> = None;
    for (index, segment) in segments.iter().enumerate() {
        for piece in &segment.curvature_slope {
            let (trend, until) = (PieceTrend::of(piece), (index, piece.until));
            match &mut run {
                Some((last, end)) if *last == trend => *end = until,
                _ => {
                    if let Some((last, end)) = run {
                        add(last, end);
                    }
                    run = Some((trend, until));
                }
            }
        }
    }
    if let Some((last, end)) = run {
        add(last, end);
    }
}
