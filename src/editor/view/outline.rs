//! Outlines: chains of points, thinned to the screen and kept block by block.
//!
//! A block is made again only when its source or the level of detail changes: a drag makes the blocks
//! under the hand and copies the others.

use glam::DVec2;

use crate::editor::view::sleeve::Sleeve;

/// How far lines may pass points of a chain that are left out, as a share of the spacing below which points
/// are not told apart: at most 1/32 of a screen point.
const FLAT: f64 = 1.0 / 16.0;

/// The visible box of the view plane, and the size of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewBox {
    /// The lower left corner.
    pub low: DVec2,
    /// The upper right corner.
    pub high: DVec2,
    /// The width of one screen point, in units of the model.
    pub pixel: f64,
}

impl ViewBox {
    /// The level of detail: detail finer than 2^level units, at most half a screen point, is not
    /// seen.
    pub fn level(&self) -> i32 {
        (0.5 * self.pixel).log2().floor().clamp(-1000.0, 1000.0) as i32
    }

    /// The length of the part of a line segment that lies in the box (Liang and Barsky, 1984).
    pub fn seen_length(&self, from: DVec2, to: DVec2) -> f64 {
        let way = to - from;
        let (mut begin, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let sides = [self.low[axis] - from[axis], self.high[axis] - from[axis]];
            if way[axis] == 0.0 {
                if sides[0] > 0.0 || sides[1] < 0.0 {
                    return 0.0;
                }
                continue;
            }
            let [a, b] = sides.map(|side| side / way[axis]);
            begin = begin.max(a.min(b));
            end = end.min(a.max(b));
        }
        way.length() * (end - begin).max(0.0)
    }

    /// Whether a point lies in the box.
    pub fn holds(&self, point: DVec2) -> bool {
        point.cmpge(self.low).all() && point.cmple(self.high).all()
    }

    /// Widen the box on every side.
    pub fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low - by,
            high: self.high + by,
            pixel: self.pixel,
        }
    }
}

/// A box around points; empty until the first is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lower left corner.
    pub low: DVec2,
    /// The upper right corner.
    pub high: DVec2,
}

impl Default for Bounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    /// The box around nothing.
    pub const EMPTY: Self = Self {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
    };

    /// Widen the box to hold a point; points that are not finite are passed over.
    pub fn add(&mut self, point: DVec2) {
        if point.is_finite() {
            self.low = self.low.min(point);
            self.high = self.high.max(point);
        }
    }

    /// The box around two boxes.
    pub fn united(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Widen the box on every side by a multiple of its greater extent.
    pub fn grown(&self, share: f64) -> Self {
        let by = share * (self.high - self.low).max_element();
        Self {
            low: self.low - by,
            high: self.high + by,
        }
    }

    /// The common part of two boxes.
    pub fn within(&self, other: &Self) -> Self {
        let common = Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        };
        if common.low.cmple(common.high).all() {
            common
        } else {
            Self::EMPTY
        }
    }

    /// Whether there is nothing in the box.
    pub fn is_empty(&self) -> bool {
        !(self.low.x <= self.high.x)
    }

    /// Whether a curve through points with this box around them may be visible: between the
    /// points it may run a little beyond the box.
    pub fn may_meet(&self, view: &ViewBox) -> bool {
        let reach = (self.high - self.low).max_element();
        !self.is_empty() && self.meets(&view.grown(0.25 * reach))
    }

    /// Whether any part of the box is visible.
    pub fn meets(&self, view: &ViewBox) -> bool {
        self.low.cmple(view.high).all() && self.high.cmpge(view.low).all()
    }
}

/// A point that breaks a chain: what comes after starts anew.
pub const GAP: DVec2 = DVec2::NAN;

/// The level of detail and the inputs of an outline's points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineKey {
    /// The level of detail; `None` keeps no points, only the box around them.
    pub level: Option<i32>,
    /// A key of other inputs, such as the bits of the comb's scale.
    pub shape: u64,
}

/// The thinned points of one block of a chain.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    key: Option<OutlineKey>,
    points: Vec<DVec2>,
    bounds: Bounds,
    /// The view and the shape that the points were made for that one view alone needs.
    close_key: Option<(ViewBox, u64)>,
    close: Vec<DVec2>,
}

impl Outline {
    /// Bring the points up to date with `source` if `key` has changed since.
    pub fn refresh<I: Iterator<Item = DVec2>>(
        &mut self,
        key: OutlineKey,
        source: impl FnOnce() -> I,
    ) {
        if self.key == Some(key) {
            return;
        }
        self.key = Some(key);
        self.bounds = Bounds::EMPTY;
        self.points.clear();
        match key.level {
            Some(level) => {
                let spacing = 2f64.powi(level);
                thin(source(), spacing, &mut self.points, &mut self.bounds);
            }
            None => source().for_each(|point| self.bounds.add(point)),
        }
    }

    /// The box around the points.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Append the points if any of them may be visible, otherwise a gap.
    pub fn append(&self, view: &ViewBox, out: &mut Vec<DVec2>) {
        if self.bounds.meets(view) {
            out.extend_from_slice(&self.points);
        } else {
            append_gap(out);
        }
    }

    /// Append points for this view alone; `make` makes them unless they are kept from the frame before.
    pub fn append_close(
        &mut self,
        view: &ViewBox,
        shape: u64,
        out: &mut Vec<DVec2>,
        make: impl FnOnce(&mut Vec<DVec2>),
    ) {
        let key = Some((*view, shape));
        if self.close_key != key {
            self.close_key = key;
            self.close.clear();
            make(&mut self.close);
        }
        let is_gap = |point: Option<&DVec2>| point.is_some_and(|point| point.is_nan());
        let broken = out.is_empty() || is_gap(out.last());
        let first = usize::from(broken && is_gap(self.close.first()));
        out.extend_from_slice(&self.close[first..]);
    }
}

/// Break a chain, if it is not broken already.
pub fn append_gap(out: &mut Vec<DVec2>) {
    if out.last().is_some_and(|last| !last.is_nan()) {
        out.push(GAP);
    }
}

/// Copy a chain, leaving out points nearer than `spacing` to the one before, and those that a line without
/// them passes within a small share of it; the ends of the chain and of each of its pieces stay.
pub fn thin(
    source: impl Iterator<Item = DVec2>,
    spacing: f64,
    out: &mut Vec<DVec2>,
    bounds: &mut Bounds,
) {
    let (squared, tolerance) = (spacing * spacing, FLAT * spacing);
    // The line from the last point kept, and to where it goes so far.
    let mut line: Option<(Sleeve, DVec2)> = None;
    let mut skipped: Option<DVec2> = None;
    for point in source {
        if point.is_nan() {
            finish(&mut line, &mut skipped, out);
            // A gap at the very beginning counts: what came before must not be joined.
            if out.last().is_none_or(|last| !last.is_nan()) {
                out.push(GAP);
            }
            continue;
        }
        bounds.add(point);
        let Some((sleeve, to)) = &mut line else {
            out.push(point);
            line = Some((Sleeve::new(point, tolerance), point));
            continue;
        };
        if point.distance_squared(*to) < squared {
            skipped = Some(point);
            continue;
        }
        for from in [*to, point] {
            if sleeve.add(point) {
                break;
            }
            keep(from, out);
            *sleeve = Sleeve::new(from, tolerance);
        }
        *to = point;
        skipped = None;
    }
    finish(&mut line, &mut skipped, out);
}

/// Keep the last points of a piece.
fn finish(line: &mut Option<(Sleeve, DVec2)>, skipped: &mut Option<DVec2>, out: &mut Vec<DVec2>) {
    if let Some((_, to)) = line.take() {
        keep(to, out);
    }
    out.extend(skipped.take());
}

fn keep(point: DVec2, out: &mut Vec<DVec2>) {
    if out.last() != Some(&point) {
        out.push(point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seen_part_of_a_line_ends_at_the_box() {
        let view = ViewBox {
            low: DVec2::ZERO,
            high: DVec2::new(4.0, 2.0),
            pixel: 1.0,
        };
        for (from, to, expected) in [
            ([1.0, 1.0], [3.0, 1.0], 2.0),
            ([-10.0, 1.0], [10.0, 1.0], 4.0),
            ([-10.0, 3.0], [10.0, 3.0], 0.0),
            ([-1.0, 0.0], [2.0, 3.0], 2.0_f64.sqrt()),
            ([1.0, 1.0], [1.0, 1.0], 0.0),
            ([5.0, 5.0], [6.0, 9.0], 0.0),
        ] {
            let length = view.seen_length(from.into(), to.into());
            assert!(
                (length - expected).abs() < 1e-12,
                "{from:?} {to:?}: {length}"
            );
        }
    }

    fn check_thin(source: &[DVec2], spacing: f64, expected: &[DVec2]) {
        let (mut points, mut bounds) = (Vec::new(), Bounds::EMPTY);
        thin(source.iter().copied(), spacing, &mut points, &mut bounds);
        assert_eq!(points.len(), expected.len(), "{points:?}");
        for (point, expected) in points.iter().zip(expected) {
            assert!(point == expected || (point.is_nan() && expected.is_nan()));
        }
    }

    #[test]
    fn thinning_keeps_ends_and_gaps() {
        let at = |x: f64| DVec2::new(x, 0.0);
        check_thin(
            &[at(0.0), at(0.1), at(0.2), at(1.0), at(1.1)],
            0.5,
            &[at(0.0), at(1.0), at(1.1)],
        );
        check_thin(&[at(0.0), at(0.1)], 0.5, &[at(0.0), at(0.1)]);
        check_thin(
            &[at(0.0), at(0.1), GAP, GAP, at(0.2), at(0.9)],
            0.5,
            &[at(0.0), at(0.1), GAP, at(0.2), at(0.9)],
        );
        check_thin(&[GAP, GAP], 0.5, &[GAP]);
        check_thin(&[GAP, at(0.0)], 0.5, &[GAP, at(0.0)]);
    }

    #[test]
    fn thinned_chains_stay_within_a_share_of_the_spacing() {
        let wave = |index: usize| {
            let angle = 1e-4 * index as f64;
            (500.0 + 300.0 * (3.0 * angle).sin()) * DVec2::from_angle(angle)
        };
        let chain: Vec<DVec2> = (0..=10_000).map(wave).collect();
        let (mut points, mut bounds) = (Vec::new(), Bounds::EMPTY);
        thin(chain.iter().copied(), 0.1, &mut points, &mut bounds);
        assert!(points.len() < 400, "{}", points.len());
        let off = |at: &DVec2| {
            let distances = points.windows(2).map(|pair| {
                let along = pair[1] - pair[0];
                let share = (*at - pair[0]).dot(along) / along.length_squared();
                at.distance(pair[0] + share.clamp(0.0, 1.0) * along)
            });
            distances.fold(f64::INFINITY, f64::min)
        };
        let worst = chain.iter().map(off).fold(0.0, f64::max);
        assert!(worst <= 1.01 * FLAT * 0.1, "{worst}");
        assert!(worst > 0.5 * FLAT * 0.1, "{worst}");
    }

    #[test]
    fn what_follows_a_point_too_far_to_measure_keeps_its_shape() {
        for far in [1e16, 1e200] {
            let bend = [DVec2::new(3.0, 9.0), DVec2::ONE, DVec2::X, DVec2::ZERO];
            let chain = [&[DVec2::splat(far)], bend.as_slice()].concat();
            check_thin(&chain, 0.1, &chain);
            let back: Vec<DVec2> = chain.iter().rev().copied().collect();
            check_thin(&back, 0.1, &back);
        }
    }
}
