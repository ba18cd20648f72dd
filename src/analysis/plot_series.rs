//! The curvature plot and the plot of the polygon's legs and turns, as plain series.

use glam::DVec2;

use super::curve_analysis::CurveAnalysis;
use super::level_series::{LevelPlot, bin_level};
use crate::geometry::FloatPolygon;

/// Points of a series kept for each bin of the horizontal axis: first, lowest, highest, last.
pub(super) const BINS: f64 = 1024.0;

/// How far apart vertices beyond an end are drawn, as a share of the curve's length …
const FLANK_STEP: f64 = 1.0 / 40.0;

/// … and how wide they may be together.
const WIDEST_FLANK: f64 = 1.0 / 6.0;

/// The thinned plot of one block, from its own start.
#[derive(Debug, Default)]
pub(super) struct PlotBlock {
    level: Option<i32>,
    points: Vec<DVec2>,
}

impl CurveAnalysis {
    /// Append the curvature over arc length, thinned so that the whole curve has about a
    /// thousand bins with their extrema kept. NaN points are gaps.
    pub fn append_curvature(&mut self, out: &mut Vec<DVec2>) {
        let level = bin_level(self.length());
        let mut start = 0.0;
        for index in 0..self.blocks() {
            self.refresh_plot(index, level);
            let points = &self.plot_block(index).points;
            out.extend(
                points
                    .iter()
                    .map(|point| DVec2::new(start + point.x, point.y)),
            );
            start += self.summary(index).length;
        }
    }

    /// Append the polygon's discrete curvature at its vertices over the arc length at their
    /// Greville abscissae, with the vertices' numbers; of vertices that share a bin only the
    /// outermost are kept.
    ///
    /// Vertices whose abscissae lie beyond an end of the curve, where there is no arc length,
    /// stand evenly spaced in a flank beside it. Returns the flanks' width, 0 if there are none.
    pub fn append_discrete_curvature(&mut self, out: &mut Vec<(usize, DVec2)>) -> f64 {
        let curve = self.curve().clone();
        let polygon = &curve.polygon;
        let end = polygon.segments() as f64;
        let length = self.length();
        let beyond = vertices_beyond_an_end(polygon);
        let step = length * FLANK_STEP.min(WIDEST_FLANK / (beyond as f64 + 0.5));
        let mut cursor = LengthCursor::default();
        let mut extremes = Vec::new();
        self.float()
            .append_extreme_curvatures(BINS as usize, &mut extremes);
        for (index, value) in extremes {
            if !value.is_finite() {
                continue;
            }
            let u = polygon.greville(index);
            let x = if polygon.is_periodic() {
                cursor.length_at(self, u.rem_euclid(end))
            } else if u < 0.0 {
                u.floor() * step
            } else if u > end {
                length + (u - end).ceil() * step
            } else {
                cursor.length_at(self, u)
            };
            out.push((index, DVec2::new(x, value)));
        }
        if beyond > 0 {
            (beyond as f64 + 0.5) * step
        } else {
            0.0
        }
    }

    /// Append the lengths of the legs, over the number of the vertex where each begins.
    pub fn append_leg_lengths(&mut self, out: &mut Vec<DVec2>) {
        self.float().append_leg_series(BINS as usize, out);
    }

    /// Append the turning angles in radians, over the numbers of their vertices.
    pub fn append_turning_angles(&mut self, out: &mut Vec<DVec2>) {
        self.float().append_turn_series(BINS as usize, out);
    }

    fn refresh_plot(&mut self, index: usize, level: i32) {
        if self.plot_block(index).level == Some(level) {
            return;
        }
        let mut points = std::mem::take(&mut self.plot_block(index).points);
        points.clear();
        let mut bins = Bins::new(2f64.powi(level));
        let mut start = 0.0;
        let polygon = &self.curve().polygon;
        let few = (polygon.segments() as f64) < BINS;
        let gaps = few && LevelPlot::Curvature(1).jumps(polygon.degree());
        for segment in self.block_segments(index) {
            let samples = self.segment_samples(segment);
            for sample in samples {
                let point = DVec2::new(start + sample.arc_length, sample.curvature);
                bins.add(point, &mut points);
            }
            start += samples.last().map_or(0.0, |sample| sample.arc_length);
            if gaps {
                bins.add(DVec2::new(start, f64::NAN), &mut points);
            }
        }
        bins.finish(&mut points);
        let block = self.plot_block(index);
        block.points = points;
        block.level = Some(level);
    }
}

/// Count the inner vertices of an open polygon whose Greville abscissae lie beyond one end:
/// those before number (n − 1)/2, the very first excepted.
fn vertices_beyond_an_end(polygon: &FloatPolygon) -> usize {
    if polygon.is_periodic() {
        0
    } else {
        (polygon.degree() / 2).saturating_sub(1)
    }
}

/// Remember the arc length where the last question ended, so that questions in rising order
/// walk along the curve once.
#[derive(Default)]
struct LengthCursor {
    block: usize,
    before_block: f64,
}

impl LengthCursor {
    fn length_at(&mut self, analysis: &CurveAnalysis, u: f64) -> f64 {
        let (segment, t) = analysis.curve().polygon.locate(u);
        if segment < analysis.block_segments(self.block).start {
            *self = Self::default();
        }
        while segment >= analysis.block_segments(self.block).end {
            self.before_block += analysis.summary(self.block).length;
            self.block += 1;
        }
        self.before_block + analysis.length_in_block(segment, t)
    }
}

/// Thin a series: of the points that fall into one bin keep the first, the lowest, the highest
/// and the last.
pub(super) struct Bins {
    width: f64,
    bin: f64,
    kept: [DVec2; 4],
    filled: bool,
}

impl Bins {
    pub(super) fn new(width: f64) -> Self {
        Self {
            width,
            bin: 0.0,
            kept: [DVec2::ZERO; 4],
            filled: false,
        }
    }

    pub(super) fn add(&mut self, point: DVec2, out: &mut Vec<DVec2>) {
        if point.y.is_nan() {
            self.finish(out);
            out.push(DVec2::new(point.x, f64::NAN));
            return;
        }
        let bin = (point.x / self.width).floor();
        if self.filled && bin != self.bin {
            self.finish(out);
        }
        if !self.filled {
            *self = Self {
                bin,
                kept: [point; 4],
                filled: true,
                ..*self
            };
            return;
        }
        if point.y < self.kept[1].y {
            self.kept[1] = point;
        }
        if point.y > self.kept[2].y {
            self.kept[2] = point;
        }
        self.kept[3] = point;
    }

    pub(super) fn finish(&mut self, out: &mut Vec<DVec2>) {
        if !self.filled {
            return;
        }
        self.filled = false;
        let [first, low, high, last] = self.kept;
        let (a, b) = if low.x <= high.x {
            (low, high)
        } else {
            (high, low)
        };
        for point in [first, a, b, last] {
            if out.last() != Some(&point) {
                out.push(point);
            }
        }
    }
}
