//! Plots of a part of a curve, as closely as it is looked at.

use glam::DVec2;

use super::bins::{BINS, Bins};
use super::curve_samples::SampledCurve;
use super::discrete_curvature::LengthCursor;
use super::level_series::LevelPlot;

/// With about so many points a part is plotted.
const POINTS: f64 = 1536.0;

impl SampledCurve<'_> {
    /// Append the plot of the curvature between two arc lengths: of the samples, or of more points
    /// where these are few. NaN points are gaps.
    pub fn append_curvature_part(self, part: [f64; 2], out: &mut Vec<DVec2>) {
        let planar = self.samples.is_planar();
        let curvature = |piece: usize, parameters: &[f64]| -> Vec<f64> {
            let jets = parameters.iter().map(|t| self.curve.piece_jet(piece, *t));
            jets.map(|jet| jet.curvature_of(planar)).collect()
        };
        if !self.append_closely(LevelPlot::Curvature(1), part, curvature, out) {
            self.append_samples(part, out);
        }
    }

    /// Append a plot of levels between two arc lengths, if there are fewer samples than can be told
    /// apart there; returns whether it has. With `normalised` as for the whole curve.
    pub fn append_level_part(
        self,
        plot: LevelPlot,
        normalised: bool,
        part: [f64; 2],
        out: &mut Vec<DVec2>,
    ) -> bool {
        let planar = self.samples.is_planar();
        let scale = match normalised {
            true => 1.0 / self.samples.length(),
            false => 1.0,
        };
        let level = |piece: usize, parameters: &[f64]| -> Vec<f64> {
            let levels = self.curve.levels(piece, parameters, scale, planar);
            levels.iter().map(|it| plot.point(it, 0.0).y).collect()
        };
        let first = out.len();
        let is_close = self.append_closely(plot, part, level, out);
        for point in out.iter_mut().skip(first) {
            point.x *= scale;
        }
        is_close
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
                let value = Some(value).filter(|value| value.is_finite());
                out.push(DVec2::new(at, value.unwrap_or(f64::NAN)));
            }
            if gaps {
                out.push(DVec2::NAN);
            }
        }
        true
    }

    /// Thin the samples of a part as those of a whole curve are.
    fn append_samples(self, [from, to]: [f64; 2], out: &mut Vec<DVec2>) {
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
                        bins.add(DVec2::new(at, sample.curvature), out);
                    }
                }
                start += samples.last().map_or(0.0, |sample| sample.arc_length);
            }
        }
        bins.finish(out);
    }
}
