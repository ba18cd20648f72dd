//! Thinning a series of points to what a plot can show.

use glam::DVec2;

/// Points of a series kept for each bin of the horizontal axis: first, lowest, highest, last.
pub(super) const BINS: f64 = 1024.0;

/// The level of detail of a plot: bins are 2^level wide.
pub(super) fn bin_level(extent: f64) -> i32 {
    (extent / BINS).log2().floor().clamp(-1000.0, 1000.0) as i32
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
