//! Plots of curvature and torsion levels over arc length, and the logarithmic curvature graph.

use glam::DVec2;

use super::curve_analysis::CurveAnalysis;
use super::plot_series::{BINS, Bins};
use crate::geometry::{CurvatureLevels, SegmentExpansion};

/// What is plotted of a curve's levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LevelPlot {
    /// A level (1 to 4) of the curvature over arc length.
    Curvature(usize),
    /// A level (1 to 4) of the torsion over arc length.
    Torsion(usize),
    /// The logarithmic curvature graph: log |ρ ds/dρ| over log ρ, both to base 10.
    Logarithmic,
}

impl LevelPlot {
    /// The value at one parameter: NaN where there is none.
    fn point(self, levels: &CurvatureLevels, arc_length: f64) -> DVec2 {
        let level = |values: &[f64], level: usize| {
            let value = level.checked_sub(1).and_then(|index| values.get(index));
            DVec2::new(arc_length, value.copied().unwrap_or(f64::NAN))
        };
        match self {
            Self::Curvature(number) => level(&levels.curvature, number),
            Self::Torsion(number) => level(levels.torsion.as_ref().map_or(&[], |t| t), number),
            Self::Logarithmic => levels
                .logarithmic()
                .map_or(DVec2::NAN, |(radius, change)| DVec2::new(radius, change)),
        }
    }

    /// Whether a curve of some degree may jump at its knots: it has n − 1 continuous
    /// derivatives, of which level m of the curvature takes 2m and of the torsion 2m + 1.
    pub(super) fn jumps(self, degree: usize) -> bool {
        let taken = match self {
            Self::Curvature(level) => 2 * level,
            Self::Torsion(level) => 2 * level + 1,
            Self::Logarithmic => 3,
        };
        degree < taken + 1
    }
}

/// One plot's series, block by block.
#[derive(Debug, Default)]
pub(super) struct LevelSeries {
    /// What the blocks were made for: the plot, the scale's bits, the bins' level of detail.
    key: Option<(LevelPlot, u64, i32)>,
    /// For each block its points, from the block's own start; `None` if they must be made.
    blocks: Vec<Option<Vec<DVec2>>>,
}

impl LevelSeries {
    /// Forget a block whose segments have changed.
    pub(super) fn forget(&mut self, block: usize) {
        if let Some(points) = self.blocks.get_mut(block) {
            *points = None;
        }
    }
}

impl CurveAnalysis {
    /// Append a plot of levels, thinned as [`CurveAnalysis::append_curvature`] is; NaN points are
    /// gaps, also at knots where the plot may jump. With `normalised`, the levels are those of
    /// the curve scaled to length 1, over the share of its length.
    pub fn append_levels(&mut self, plot: LevelPlot, normalised: bool, out: &mut Vec<DVec2>) {
        let length = self.length();
        let scale = if normalised { 1.0 / length } else { 1.0 };
        if !(scale > 0.0 && scale.is_finite()) {
            return;
        }
        let level = bin_level(length);
        let mut series = std::mem::take(self.level_series());
        let key = Some((plot, scale.to_bits(), level));
        if series.key != key || series.blocks.len() != self.blocks() {
            series.key = key;
            series.blocks.clear();
            series.blocks.resize(self.blocks(), None);
        }
        let mut start = 0.0;
        for index in 0..self.blocks() {
            let points = series.blocks[index]
                .get_or_insert_with(|| self.block_levels(index, plot, scale, level));
            out.extend(points.iter().map(|point| match plot {
                LevelPlot::Logarithmic => *point,
                _ => DVec2::new((start + point.x) * scale, point.y),
            }));
            start += self.summary(index).length;
        }
        *self.level_series() = series;
    }

    /// The place of the parameter u on a plot of levels.
    pub fn level_at(&self, plot: LevelPlot, normalised: bool, u: f64) -> DVec2 {
        let scale = if normalised { 1.0 / self.length() } else { 1.0 };
        let polygon = &self.curve().polygon;
        let (segment, t) = polygon.locate(u);
        let expansion = SegmentExpansion::new(polygon, segment, self.is_planar());
        plot.point(
            &expansion.curvature_levels(t, scale),
            scale * self.length_at(u),
        )
    }

    fn block_levels(&self, index: usize, plot: LevelPlot, scale: f64, level: i32) -> Vec<DVec2> {
        let polygon = &self.curve().polygon;
        let mut points = Vec::new();
        let mut bins = Bins::new(2f64.powi(level));
        let mut start = 0.0;
        // Where segments are narrower than the bins, their jumps cannot be told apart.
        let few = (polygon.segments() as f64) < BINS;
        let gaps = few && plot.jumps(polygon.degree());
        let is_graph = plot == LevelPlot::Logarithmic;
        for segment in self.block_segments(index) {
            let expansion = SegmentExpansion::new(polygon, segment, self.is_planar());
            let samples = self.segment_samples(segment);
            let steps = samples.len().saturating_sub(1).max(1) as f64;
            for (number, sample) in samples.iter().enumerate() {
                let t = number as f64 / steps;
                let levels = expansion.curvature_levels(t, scale);
                let point = plot.point(&levels, start + sample.arc_length);
                if is_graph {
                    append_apart(point, &mut points);
                } else {
                    bins.add(finite(point), &mut points);
                }
            }
            start += samples.last().map_or(0.0, |sample| sample.arc_length);
            if gaps {
                bins.add(DVec2::new(start, f64::NAN), &mut points);
            }
        }
        bins.finish(&mut points);
        points
    }
}

/// Append a point of the logarithmic graph, unless it is one with the last; one gap stands for
/// many.
fn append_apart(point: DVec2, points: &mut Vec<DVec2>) {
    /// A thousandth of a decade.
    const APART: f64 = 1e-3;
    let apart = match points.last() {
        None => point.is_finite(),
        Some(last) if last.is_nan() => point.is_finite(),
        Some(last) => point.is_nan() || last.distance(point) >= APART,
    };
    if apart {
        points.push(point);
    }
}

/// Values beyond the range of numbers are gaps.
fn finite(point: DVec2) -> DVec2 {
    let y = if point.y.is_finite() {
        point.y
    } else {
        f64::NAN
    };
    DVec2::new(point.x, y)
}

/// The level of detail of a plot: bins are 2^level wide.
pub(super) fn bin_level(extent: f64) -> i32 {
    (extent / BINS).log2().floor().clamp(-1000.0, 1000.0) as i32
}
