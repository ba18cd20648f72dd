//! Plots of a part of a curve in detail.

use glam::DVec2;

use super::bins::{BINS, Bins};
use super::curve_samples::SampledCurve;
use super::discrete_curvature::LengthCursor;
use super::level_series::{LevelPlot, finite};

/// With about so many points a part is plotted.
const POINTS: f64 = 1536.0;

impl SampledCurve<'_> {
    /// Append a plot between two arc lengths, at as many parameters as can be told apart there. Returns
    /// whether it has: where there are more samples than that, only those of the curvature are thinned; other
    /// levels are left to the plot of the whole curve. With `normalised` as for the whole curve.
    pub fn append_part(
        self,
        plot: LevelPlot,
        normalised: bool,
        part: [f64; 2],
        out: &mut Vec<DVec2>,
    ) -> bool {
        let (planar, scale) = (self.samples.is_planar(), self.scale(normalised));
        let is_curvature = plot == LevelPlot::CURVATURE;
        let values = |piece: usize, parameters: &[f64]| -> Vec<f64> {
            if is_curvature {
                let jets = parameters.iter().map(|t| self.curve.piece_jet(piece, *t));
                return jets.map(|jet| jet.curvature_of(planar) / scale).collect();
            }
            let levels = self.curve.levels(piece, parameters, scale, planar);
            levels.iter().map(|it| plot.point(it, 0.0).y).collect()
        };
        let first = out.len();
        let is_close = self.append_closely(plot, part, values, out);
        if !is_close && is_curvature {
            self.append_samples(part, scale, out);
        }
        for point in out.iter_mut().skip(first) {
            point.x *= scale;
        }
        is_close || is_curvature
    }

    /// Evaluate a quantity at more parameters than the samples', if these are few.
    fn append_closely(
        self,
        plot: LevelPlot,
        part: [f64; 2],
        values: impl Fn(usize, &[f64]) -> Vec<f64>,
        out: &mut Vec<DVec2>,
    ) -> bool {
        let [from, to] = part.map(|length| self.samples.parameter_at_length(length));
        let steps = self.samples.steps() as f64;
        if !(to > from) || (to - from) * steps >= POINTS {
            return false;
        }
        let pieces = self.samples.pieces();
        let gaps = plot.jumps(self.curve.continuity());
        let mut cursor = LengthCursor::default();
        for piece in from.floor() as usize..pieces.min(to.ceil() as usize) {
            let start = piece as f64;
            let [first, last] = [from, to].map(|u| (u - start).clamp(0.0, 1.0));
            let samples = self.samples.piece(piece);
            let leaps = samples.iter().any(|sample| sample.leaps);
            let count = match leaps {
                true => steps,
                false => (POINTS * (last - first) / (to - from)).ceil().max(1.0),
            };
            // Where the curve leaps its samples are kept, for they tell where.
            let [first, last] = if leaps { [0.0, 1.0] } else { [first, last] };
            let parameter = |step: usize| first + (last - first) * step as f64 / count;
            let parameters: Vec<f64> = (0..=count as usize).map(parameter).collect();
            let found = values(piece, &parameters);
            for (step, (t, value)) in parameters.iter().zip(found).enumerate() {
                let at = cursor.length_on(self, piece, *t);
                if leaps && samples.get(step).is_some_and(|sample| sample.leaps) {
                    out.push(DVec2::new(at, f64::NAN));
                }
                out.push(finite(DVec2::new(at, value)));
            }
            if gaps {
                out.push(DVec2::NAN);
            }
        }
        true
    }

    /// Append the samples of the curvature in a part, thinned as those of a whole curve are.
    fn append_samples(self, [from, to]: [f64; 2], scale: f64, out: &mut Vec<DVec2>) {
        let mut bins = Bins::new((to - from) / BINS);
        let mut start = 0.0;
        for (index, block) in self.samples.blocks().iter().enumerate() {
            let end = start + block.length;
            if end < from || start > to {
                start = end;
                continue;
            }
            for piece in self.samples.block_pieces(index) {
                let samples = self.samples.piece(piece);
                for sample in samples {
                    let at = start + sample.arc_length;
                    if sample.leaps {
                        bins.add(DVec2::new(at, f64::NAN), out);
                    }
                    if (from..=to).contains(&at) {
                        bins.add(DVec2::new(at, sample.curvature / scale), out);
                    }
                }
                start += samples.last().map_or(0.0, |sample| sample.arc_length);
            }
        }
        bins.finish(out);
    }
}
