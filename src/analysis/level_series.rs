//! Plots of curvature, torsion and their levels over arc length, and the logarithmic curvature graph.

use glam::DVec2;

use super::bins::{BINS, Bins, bin_level};
use super::curve_samples::SampledCurve;
use super::revision::Revision;
use crate::geometry::CurvatureLevels;

/// A plot of a curve's levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LevelPlot {
    /// A level (1 to 4) of the curvature over arc length; level 1 is the curvature itself.
    Curvature(usize),
    /// A level (1 to 4) of the torsion over arc length.
    Torsion(usize),
    /// The logarithmic curvature graph: log |ρ ds/dρ| over log ρ, both to base 10.
    Logarithmic,
}

impl LevelPlot {
    /// The curvature, which samples know without further derivatives.
    pub const CURVATURE: Self = Self::Curvature(1);

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
    /// What the blocks were made for: the plot, the bits of the values' scale, the bins' level of detail.
    key: Option<(LevelPlot, u64, i32)>,
    /// For each block the samples that its points were made of, and the points from the block's own start.
    blocks: Vec<(Option<Revision>, Vec<DVec2>)>,
}

impl LevelSeries {
    /// Append a plot, thinned so that the whole curve has about a thousand bins with their extrema kept; NaN
    /// points are gaps, also at joints where the plot may jump. With `normalised`, the values are those of
    /// the curve scaled to length 1, over the share of its length.
    pub fn append(
        &mut self,
        sampled: SampledCurve<'_>,
        plot: LevelPlot,
        normalised: bool,
        out: &mut Vec<DVec2>,
    ) {
        let samples = sampled.samples;
        let scale = sampled.scale(normalised);
        // Curvatures are kept as they are: the length changes in every frame of a drag.
        let (kept, factor) = match plot {
            LevelPlot::CURVATURE => (1.0, 1.0 / scale),
            _ => (scale, 1.0),
        };
        let level = bin_level(samples.length());
        let key = Some((plot, kept.to_bits(), level));
        if self.key != key {
            self.key = key;
            self.blocks.clear();
        }
        self.blocks
            .resize(samples.blocks().len(), Default::default());
        let mut start = 0.0;
        for (index, (own, block)) in self.blocks.iter_mut().zip(samples.blocks()).enumerate() {
            let (revision, points) = own;
            if *revision != Some(block.revision) {
                *revision = Some(block.revision);
                points.clear();
                append_block(sampled, index, plot, (kept, level), points);
            }
            out.extend(points.iter().map(|point| match plot {
                LevelPlot::Logarithmic => *point,
                _ => DVec2::new((start + point.x) * scale, point.y * factor),
            }));
            start += block.length;
        }
    }
}

impl SampledCurve<'_> {
    /// The factor that scales the curve to length 1 if it is `normalised` and has a length; otherwise 1.
    pub fn scale(&self, normalised: bool) -> f64 {
        let scale = 1.0 / self.samples.length();
        if normalised && scale > 0.0 && scale.is_finite() {
            scale
        } else {
            1.0
        }
    }

    /// The place of the parameter u on a plot.
    pub fn level_at(&self, plot: LevelPlot, normalised: bool, u: f64) -> DVec2 {
        let (planar, scale) = (self.samples.is_planar(), self.scale(normalised));
        let arc_length = scale * self.length_at(u);
        if plot == LevelPlot::CURVATURE {
            return DVec2::new(arc_length, self.curve.jet(u).curvature_of(planar) / scale);
        }
        let (piece, t) = self.curve.locate(u);
        let levels = self.curve.levels(piece, &[t], scale, planar);
        let place = |levels| plot.point(levels, arc_length);
        levels.first().map_or(DVec2::NAN, place)
    }
}

/// Append a plot of one block, from its own start, with values of the curve scaled by `scale`.
fn append_block(
    SampledCurve { curve, samples }: SampledCurve<'_>,
    index: usize,
    plot: LevelPlot,
    (scale, level): (f64, i32),
    out: &mut Vec<DVec2>,
) {
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
        let levels = match plot {
            LevelPlot::CURVATURE => Vec::new(),
            _ => curve.levels(piece, &parameters, scale, samples.is_planar()),
        };
        for (step, sample) in own.iter().enumerate() {
            let at = start + sample.arc_length;
            let point = match levels.get(step) {
                Some(levels) => plot.point(levels, at),
                None => DVec2::new(at, sample.curvature),
            };
            if is_graph {
                if sample.leaps {
                    append_apart(DVec2::NAN, out);
                }
                append_apart(point, out);
            } else {
                if sample.leaps {
                    bins.add(DVec2::new(at, f64::NAN), out);
                }
                bins.add(finite(point), out);
            }
        }
        start += own.last().map_or(0.0, |sample| sample.arc_length);
        if gaps {
            bins.add(DVec2::new(start, f64::NAN), out);
        }
    }
    bins.finish(out);
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

/// Turn a value beyond the range of numbers into a gap.
pub(super) fn finite(point: DVec2) -> DVec2 {
    let y = if point.y.is_finite() {
        point.y
    } else {
        f64::NAN
    };
    DVec2::new(point.x, y)
}
