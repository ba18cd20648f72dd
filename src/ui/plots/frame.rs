//! The bounds of a plot, kept from frame to frame so that it keeps still.

use egui_plot::PlotBounds;
use glam::DVec2;

/// How much of a plot's height is kept free above and below.
const MARGIN: f64 = 0.08;

/// Values that differ by less than this share of their size are shown as equal: a plot that
/// magnifies the last digits of a constant shows only rounding.
const FLAT: f64 = 1e-3;

/// The least share of a plot's whole extent that can be zoomed to …
const CLOSEST: f64 = 1e-4;

/// … and the largest.
const FARTHEST: f64 = 3.0;

/// The least extent that can be zoomed to, as a share of the values themselves.
const DIGITS: f64 = 1e-9;

/// The bounds of one plot, kept from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Those that hold all that is to be seen.
    whole: Option<(DVec2, DVec2)>,
    /// The ranges that the user has zoomed or moved to, across and upwards.
    chosen: [Option<[f64; 2]>; 2],
}

impl Frame {
    /// Choose the bounds. Ranges that the user has chosen stay; otherwise all that is to be seen is
    /// shown, but while the curve is `held` the bounds only widen, and afterwards they only shrink
    /// when much would stay empty.
    pub fn settle(&mut self, wanted: (DVec2, DVec2), held: bool) -> PlotBounds {
        let whole = match self.whole {
            Some((low, high)) if held => (low.min(wanted.0), high.max(wanted.1)),
            Some((low, high)) if !is_better(wanted, (low, high)) => (low, high),
            _ => wanted,
        };
        self.whole = Some(whole);
        let [mut low, mut high] = [whole.0.to_array(), whole.1.to_array()];
        for (axis, chosen) in self.chosen.iter_mut().enumerate() {
            // Where there is nothing of the curve there is nothing to look at.
            let shows = |[from, to]: &[f64; 2]| *to > low[axis] && *from < high[axis];
            *chosen = chosen.filter(shows);
            if let Some([from, to]) = *chosen {
                (low[axis], high[axis]) = (from, to);
            }
        }
        PlotBounds::from_min_max(low, high)
    }

    /// The bounds that hold all that is to be seen, as they were settled last.
    pub fn whole(&self) -> Option<(DVec2, DVec2)> {
        self.whole
    }

    /// Show the whole plot again.
    pub fn fit(&mut self) {
        self.chosen = [None; 2];
    }

    /// Whether the user has zoomed or moved the plot.
    pub fn is_chosen(&self) -> bool {
        self.chosen.iter().any(Option::is_some)
    }

    /// Show as much across as another frame does.
    pub fn follow_across(&mut self, other: &Self) {
        self.chosen[0] = other.chosen[0];
    }

    /// Zoom about a place by a factor along each axis: 1 leaves an axis as it is.
    pub fn zoom(&mut self, shown: &PlotBounds, about: DVec2, factors: DVec2) {
        for axis in 0..2 {
            if factors[axis] == 1.0 || !(factors[axis] > 0.0) {
                continue;
            }
            let [from, to] = [shown.min()[axis], shown.max()[axis]];
            let [least, most] = self.extents(axis);
            let extent = ((to - from) / factors[axis]).clamp(least, most.max(least));
            let share = (about[axis] - from) / (to - from);
            let from = about[axis] - share * extent;
            self.choose(axis, [from, from + extent]);
        }
    }

    /// Pan by so much: 0 leaves an axis as it is.
    pub fn pan(&mut self, shown: &PlotBounds, by: DVec2) {
        for axis in 0..2 {
            if by[axis] != 0.0 {
                let range = [shown.min()[axis], shown.max()[axis]];
                self.choose(axis, range.map(|value| value + by[axis]));
            }
        }
    }

    /// Choose a range, but keep its middle within the whole plot.
    fn choose(&mut self, axis: usize, [from, to]: [f64; 2]) {
        let middle = 0.5 * (from + to);
        let within = self.whole.map_or(middle, |(low, high)| {
            middle.clamp(low[axis], high[axis].max(low[axis]))
        });
        let shift = within - middle;
        let range = [from + shift, to + shift];
        if range.iter().all(|value| value.is_finite()) && range[0] < range[1] {
            self.chosen[axis] = Some(range);
        }
    }

    /// The least and the largest extent that can be zoomed to.
    fn extents(&self, axis: usize) -> [f64; 2] {
        let Some((low, high)) = self.whole else {
            return [0.0, f64::INFINITY];
        };
        let whole = high[axis] - low[axis];
        let size = low[axis].abs().max(high[axis].abs());
        [(CLOSEST * whole).max(DIGITS * size), FARTHEST * whole]
    }
}

/// Whether new bounds are worth a change: something lies outside the old ones, or a quarter of
/// them would stay empty.
fn is_better(new: (DVec2, DVec2), old: (DVec2, DVec2)) -> bool {
    let spill = 0.04 * (old.1 - old.0);
    let is_outside = (new.0 + spill).cmplt(old.0).any() || (new.1 - spill).cmpgt(old.1).any();
    let is_small = (new.1 - new.0).cmplt(0.75 * (old.1 - old.0)).any();
    is_outside || is_small
}

/// The bounds that hold some points, with a margin above and below.
pub fn bounds_of(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    let finite = points.filter(|point| point.is_finite());
    let (low, mut high) = finite.fold(
        (DVec2::INFINITY, DVec2::NEG_INFINITY),
        |(low, high), point| (low.min(point), high.max(point)),
    );
    if !(low.x <= high.x) {
        return (DVec2::ZERO, DVec2::ONE);
    }
    let size = low.y.abs().max(high.y.abs());
    // Nothing but zeros has no size of its own.
    let is_zero = size < f64::MIN_POSITIVE;
    let size = if is_zero { 0.5 / FLAT } else { size };
    let short = (20.0 * FLAT * size - (high.y - low.y)).max(0.0);
    let margin = 0.5 * short + MARGIN * (high.y - low.y + short);
    if high.x == low.x {
        high.x = low.x + 1.0;
    }
    let margin = DVec2::new(0.0, margin);
    (low - margin, high + margin)
}

/// The share of the values, at either end, that a plot may cut off if they are far beyond the
/// others.
const PEAKS: f64 = 0.02;

/// The bounds that hold a series but for narrow peaks that would flatten all the rest: those that
/// reach beyond the others by more than `tallest` times their extent. If peaks are cut off, also how
/// far they reach.
///
/// Values that differ by less than `noise` look constant.
pub fn within_reason(
    points: &[DVec2],
    noise: f64,
    tallest: f64,
) -> ((DVec2, DVec2), Option<(f64, f64)>) {
    let mut values: Vec<f64> = points.iter().map(|point| point.y).collect();
    values.retain(|value| value.is_finite());
    let Some([from, to]) = most(&mut values) else {
        return (bounds_of(points.iter().copied()), None);
    };
    let low = values.iter().copied().fold(from, f64::min);
    let high = values.iter().copied().fold(to, f64::max);
    let reach = tallest * (to - from);
    if high - low < noise {
        let (bottom, top) = bounds_of(points.iter().map(|point| point.with_y(low)));
        let noise = DVec2::new(0.0, noise);
        return ((bottom - noise, top + noise), None);
    }
    let (bottom, top) = (low.max(from - reach), high.min(to + reach));
    let shown = |point: &DVec2| point.with_y(point.y.clamp(bottom, top));
    let is_cut = bottom > low || top < high;
    let bounds = bounds_of(points.iter().map(shown));
    (bounds, is_cut.then_some((low, high)))
}

/// The least and the greatest of finite values but for the share at either end that may be cut off.
fn most(values: &mut [f64]) -> Option<[f64; 2]> {
    let beyond = (PEAKS * values.len() as f64) as usize;
    let last = values.len().checked_sub(beyond + 1)?;
    let mut value = |index: usize| *values.select_nth_unstable_by(index, f64::total_cmp).1;
    Some([value(beyond), value(last)])
}

/// The bounds that hold a graph but for the share of it that runs off to infinity, in either
/// direction.
pub fn most_of(points: &[DVec2]) -> (DVec2, DVec2) {
    let inner = |values: &mut Vec<f64>| {
        values.retain(|value| value.is_finite());
        most(values)
    };
    let mut across = points.iter().map(|point| point.x).collect();
    let mut along = points.iter().map(|point| point.y).collect();
    let (Some(across), Some(along)) = (inner(&mut across), inner(&mut along)) else {
        return bounds_of(points.iter().copied());
    };
    let corners = [0, 1].map(|end: usize| DVec2::new(across[end], along[end]));
    bounds_of(corners.into_iter())
}

/// A little room at the left and right, so that the outermost dots are whole.
pub fn padded((low, high): (DVec2, DVec2)) -> (DVec2, DVec2) {
    let room = DVec2::new(0.015 * (high.x - low.x), 0.0);
    (low - room, high + room)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(before: (f64, f64), wanted: (f64, f64), dragging: bool, expected: (f64, f64)) {
        let tall = |(low, high): (f64, f64)| (DVec2::new(0.0, low), DVec2::new(1.0, high));
        let mut frame = Frame::default();
        frame.settle(tall(before), false);
        let bounds = frame.settle(tall(wanted), dragging);
        assert_eq!([bounds.min()[1], bounds.max()[1]], [expected.0, expected.1]);
    }

    /// A frame of a plot from 0 to 10 and −1 to 1.
    fn fitted() -> (Frame, PlotBounds) {
        let mut frame = Frame::default();
        let bounds = frame.settle((DVec2::new(0.0, -1.0), DVec2::new(10.0, 1.0)), false);
        (frame, bounds)
    }

    fn settled(frame: &mut Frame) -> [[f64; 2]; 2] {
        let bounds = frame.settle((DVec2::new(0.0, -1.0), DVec2::new(10.0, 1.0)), false);
        [bounds.min(), bounds.max()]
    }

    #[test]
    fn a_zoom_keeps_the_place_under_the_pointer_and_the_other_axis() {
        let (mut frame, bounds) = fitted();
        frame.zoom(&bounds, DVec2::new(2.5, 0.5), DVec2::new(5.0, 1.0));
        assert_eq!(settled(&mut frame), [[2.0, -1.0], [4.0, 1.0]]);
        assert!(frame.is_chosen());
        let bounds = PlotBounds::from_min_max([2.0, -1.0], [4.0, 1.0]);
        frame.zoom(&bounds, DVec2::new(2.5, 0.5), DVec2::new(1.0, 2.0));
        assert_eq!(settled(&mut frame), [[2.0, -0.25], [4.0, 0.75]]);
        frame.fit();
        assert_eq!(settled(&mut frame), [[0.0, -1.0], [10.0, 1.0]]);
        assert!(!frame.is_chosen());
    }

    #[test]
    fn what_the_user_has_chosen_stays_while_the_curve_changes() {
        let (mut frame, bounds) = fitted();
        frame.zoom(&bounds, DVec2::new(5.0, 0.0), DVec2::splat(2.0));
        for (held, top) in [(true, 3.0), (false, 30.0), (false, 0.7)] {
            let wanted = (DVec2::new(0.0, -1.0), DVec2::new(9.0, top));
            let bounds = frame.settle(wanted, held);
            assert_eq!([bounds.min(), bounds.max()], [[2.5, -0.5], [7.5, 0.5]]);
        }
        // Of another curve it would show nothing.
        let wanted = (DVec2::new(100.0, -1.0), DVec2::new(200.0, 1.0));
        let bounds = frame.settle(wanted, false);
        assert_eq!(bounds.min()[0], 100.0);
    }

    #[test]
    fn a_plot_cannot_be_lost_out_of_sight() {
        let (mut frame, bounds) = fitted();
        frame.pan(&bounds, DVec2::new(1e9, 0.0));
        assert_eq!(settled(&mut frame), [[5.0, -1.0], [15.0, 1.0]]);
        for factor in [1e12, 1e-12] {
            let (mut frame, mut bounds) = fitted();
            for _ in 0..5 {
                frame.zoom(&bounds, DVec2::new(3.0, 0.2), DVec2::splat(factor));
                let [low, high] = settled(&mut frame);
                bounds = PlotBounds::from_min_max(low, high);
                let widths = [high[0] - low[0], high[1] - low[1]];
                assert!(widths[0] >= 0.99e-3 && widths[0] <= 30.01, "{widths:?}");
                assert!(widths[1] >= 1.99e-4 && widths[1] <= 6.01, "{widths:?}");
            }
        }
        frame.zoom(&bounds, DVec2::NAN, DVec2::splat(2.0));
        frame.zoom(&bounds, DVec2::ZERO, DVec2::splat(f64::NAN));
        assert!(
            settled(&mut frame)
                .as_flattened()
                .iter()
                .all(|it| it.is_finite())
        );
    }

    #[test]
    fn bounds_keep_still_while_dragging_and_settle_afterwards() {
        check((0.0, 10.0), (2.0, 4.0), true, (0.0, 10.0));
        check((0.0, 10.0), (2.0, 14.0), true, (0.0, 14.0));
        check((0.0, 10.0), (2.0, 4.0), false, (2.0, 4.0));
        check((0.0, 10.0), (0.5, 9.8), false, (0.0, 10.0));
    }

    #[test]
    fn narrow_peaks_are_cut_off_and_told() {
        let wave = |x: f64| DVec2::new(x, x.sin());
        let mut points: Vec<DVec2> = (0..200).map(|index| wave(0.1 * f64::from(index))).collect();
        assert_eq!(within_reason(&points, 0.0, 4.0).1, None);
        points[77].y = -1e14;
        let ((low, high), cut) = within_reason(&points, 0.0, 4.0);
        assert!(low.y > -20.0 && high.y > 0.9, "{low} {high}");
        assert_eq!(cut.map(|cut| cut.0), Some(-1e14));
    }

    #[test]
    fn nearly_constant_values_look_constant() {
        let points = [DVec2::new(0.0, 0.112), DVec2::new(1.0, 0.112 + 1e-9)];
        let (low, high) = bounds_of(points.into_iter());
        assert!(high.y - low.y > 0.001, "{low} {high}");
    }
}
