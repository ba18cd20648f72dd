//! The curvature plot, as a plain series.

use glam::DVec2;

use super::bins::{BINS, Bins, bin_level};
use super::curve_samples::SampledCurve;
use super::level_series::LevelPlot;
use super::revision::Revision;

/// Hold the plot of the curvature over arc length, thinned block by block.
#[derive(Debug, Default)]
pub struct CurvatureSeries {
    blocks: Vec<Block>,
}

/// The thinned plot of one block, from its own start.
#[derive(Clone, Debug, Default)]
struct Block {
    /// What the points were made of: the block's samples, and the bins' level of detail.
    key: Option<(Revision, i32)>,
    points: Vec<DVec2>,
}

impl CurvatureSeries {
    /// Append the curvature over arc length, thinned so that the whole curve has about a
    /// thousand bins with their extrema kept. NaN points are gaps.
    pub fn append(&mut self, sampled: SampledCurve<'_>, out: &mut Vec<DVec2>) {
        let samples = sampled.samples;
        let level = bin_level(samples.length());
        self.blocks
            .resize_with(samples.blocks().len(), Block::default);
        let mut start = 0.0;
        for (index, (own, block)) in self.blocks.iter_mut().zip(samples.blocks()).enumerate() {
            own.refresh((block.revision, level), index, sampled);
            let points = own.points.iter();
            out.extend(points.map(|point| DVec2::new(start + point.x, point.y)));
            start += block.length;
        }
    }
}

impl Block {
    fn refresh(&mut self, key: (Revision, i32), index: usize, sampled: SampledCurve<'_>) {
        if self.key == Some(key) {
            return;
        }
        self.key = Some(key);
        let points = &mut self.points;
        points.clear();
        let mut bins = Bins::new(2f64.powi(key.1));
        let mut start = 0.0;
        let few = (sampled.samples.pieces() as f64) < BINS;
        let gaps = few && LevelPlot::Curvature(1).jumps(sampled.curve.continuity());
        for piece in sampled.samples.block_pieces(index) {
            let samples = sampled.samples.piece(piece);
            for sample in samples {
                let point = DVec2::new(start + sample.arc_length, sample.curvature);
                if sample.leaps {
                    bins.add(DVec2::new(point.x, f64::NAN), points);
                }
                bins.add(point, points);
            }
            start += samples.last().map_or(0.0, |sample| sample.arc_length);
            if gaps {
                bins.add(DVec2::new(start, f64::NAN), points);
            }
        }
        bins.finish(points);
    }
}
