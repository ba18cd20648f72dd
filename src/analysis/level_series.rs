//! Plots of curvature and torsion levels over arc length, and the logarithmic curvature graph.

use glam::DVec2;

use super::bins::{BINS, Bins, bin_level};
use super::curve_samples::SampledCurve;
use super::revision::Revision;
use crate::geometry::CurvatureLevels;

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
    pub(super) fn point(self, levels: &CurvatureLevels, arc_length: f64) -> DVec2 {
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

    /// Whether the plot may jump where pieces meet with so many continuous derivatives: level m
    /// of the curvature takes 2m, of the torsion 2m + 1.
    pub(super) fn jumps(self, continuity: usize) -> bool {
        let taken = match self {
            Self::Curvature(level) => 2 * level,
            Self::Torsion(level) => 2 * level + 1,
            Self::Logarithmic => 3,
        };
        continuity < taken
    }
}

/// Hold one plot's series, block by block.
#[derive(Debug, Default)]
pub struct LevelSeries {
    /// What the blocks were made for: the plot, the scale's bits, the bins' level of detail.
    key: Option<(LevelPlot, u64, i32)>,
    /// For each block its points, from the block's own start, and the samples they were made of.
    blocks: Vec<Option<(Revision, Vec<DVec2>)>>,
}

impl LevelSeries {
    /// Append a plot of levels, thinned so that the whole curve has about a thousand bins with
    /// their extrema kept; NaN points are gaps, also at joints where the plot may jump. With
    /// `normalised`, the levels are those of the curve scaled to length 1, over the share of its
    /// length.
    pub fn append(
        &mut self,
        sampled: SampledCurve<'_>,
        plot: LevelPlot,
        normalised: bool,
        out: &mut Vec<DVec2>,
    ) {
        let samples = sampled.samples;
        let length = samples.length();
        let scale = if normalised { 1.0 / length } else { 1.0 };
        if !(scale > 0.0 && scale.is_finite()) {
            return;
        }
        let level = bin_level(length);
        let key = Some((plot, scale.to_bits(), level));
        if self.key != key {
            self.key = key;
            self.blocks.clear();
        }
        self.blocks.resize(samples.blocks().len(), None);
        let mut start = 0.0;
        for (index, (own, block)) in self.blocks.iter_mut().zip(samples.blocks()).enumerate() {
            own.take_if(|(revision, _)| *revision != block.revision);
            let (_, points) = own.get_or_insert_with(|| {
                let points = block_levels(sampled, index, plot, scale, level);
                (block.revision, points)
            });
            out.extend(points.iter().map(|point| match plot {
                LevelPlot::Logarithmic => *point,
                _ => DVec2::new((start + point.x) * scale, point.y),
            }));
            start += block.length;
        }
    }
}

impl SampledCurve<'_> {
    /// The place of the parameter u on a plot of levels.
    pub fn level_at(&self, plot: LevelPlot, normalised: bool, u: f64) -> DVec2 {
        let samples = self.samples;
        let scale = if normalised {
            1.0 / samples.length()
        } else {
            1.0
        };
        let (piece, t) = self.curve.locate(u);
        let levels = self.curve.levels(piece, &[t], scale, samples.is_planar());
        let arc_length = scale * self.length_at(u);
        let place = |levels| plot.point(levels, arc_length);
        levels.first().map_or(DVec2::NAN, place)
    }
}

fn block_levels(
    SampledCurve { curve, samples }: SampledCurve<'_>,
    index: usize,
    plot: LevelPlot,
    scale: f64,
    level: i32,
) -> Vec<DVec2> {
    let mut points = Vec::new();
    let mut bins = Bins::new(2f64.powi(level));
    let mut start = 0.0;
    // Where pieces are narrower than the bins, their jumps cannot be told apart.
    let few = (samples.pieces() as f64) < BINS;
    let gaps = few && plot.jumps(curve.continuity());
    let is_graph = plot == LevelPlot::Logarithmic;
    let steps = samples.steps();
    let parameters: Vec<f64> = (0..=steps).map(|step| step as f64 / steps as f64).collect();
    for piece in samples.block_pieces(index) {
        let own = samples.piece(piece);
        let levels = curve.levels(piece, &parameters, scale, samples.is_planar());
        for (sample, levels) in own.iter().zip(&levels) {
            let point = plot.point(levels, start + sample.arc_length);
            if sample.leaps {
                match is_graph {
                    true => append_apart(DVec2::NAN, &mut points),
                    false => bins.add(DVec2::new(point.x, f64::NAN), &mut points),
                }
            }
            if is_graph {
                append_apart(point, &mut points);
            } else {
                bins.add(finite(point), &mut points);
            }
        }
        start += own.last().map_or(0.0, |sample| sample.arc_length);
        if gaps {
            bins.add(DVec2::new(start, f64::NAN), &mut points);
        }
    }
    bins.finish(&mut points);
    points
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
