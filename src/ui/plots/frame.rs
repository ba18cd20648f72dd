//! The bounds of a plot, kept from frame to frame so that it keeps still.

use egui_plot::PlotBounds;
use glam::DVec2;

/// How much of a plot's height is kept free above and below.
const MARGIN: f64 = 0.08;

/// Values that differ by less than this share of their size are shown as equal: a plot that
/// blows up the last digits of a constant tells nothing.
const FLAT: f64 = 1e-3;

/// The bounds of one plot, kept from frame to frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame {
    bounds: Option<(DVec2, DVec2)>,
}

impl Frame {
    /// Choose the bounds: all that is to be seen, but while a drag goes on they only widen, and
    /// afterwards they only shrink when much would stay empty.
    pub fn settle(&mut self, wanted: (DVec2, DVec2), dragging: bool) -> PlotBounds {
        let settled = match self.bounds {
            Some((low, high)) if dragging => (low.min(wanted.0), high.max(wanted.1)),
            Some((low, high)) if !is_better(wanted, (low, high)) => (low, high),
            _ => wanted,
        };
        self.bounds = Some(settled);
        PlotBounds::from_min_max(settled.0.to_array(), settled.1.to_array())
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
    let size = if size < f64::MIN_POSITIVE {
        0.5 / FLAT
    } else {
        size
    };
    let short = (20.0 * FLAT * size - (high.y - low.y)).max(0.0);
    let margin = 0.5 * short + MARGIN * (high.y - low.y + short);
    if high.x == low.x {
        high.x = low.x + 1.0;
    }
    (
        low - DVec2::new(0.0, margin),
        high + DVec2::new(0.0, margin),
    )
}

/// The share of the values, at either end, that a plot may cut off if they are far beyond the
/// others.
const PEAKS: f64 = 0.02;

/// How far beyond the others a peak may reach and still be shown, in units of their extent.
const TALLEST: f64 = 4.0;

/// The bounds that hold a series but for narrow peaks that would flatten all the rest; if peaks
/// are cut off, also how far they reach.
///
/// Values that differ by less than `noise` look constant.
pub fn within_reason(points: &[DVec2], noise: f64) -> ((DVec2, DVec2), Option<(f64, f64)>) {
    let mut values: Vec<f64> = points.iter().map(|point| point.y).collect();
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    let beyond = (PEAKS * values.len() as f64) as usize;
    let whole = values.first().zip(values.last());
    let most = values.get(beyond).zip(values.iter().nth_back(beyond));
    let (Some((low, high)), Some((from, to))) = (whole, most) else {
        return (bounds_of(points.iter().copied()), None);
    };
    let reach = TALLEST * (to - from);
    if high - low < noise {
        let flat = points.iter().map(|point| DVec2::new(point.x, *low));
        let (bottom, top) = bounds_of(flat);
        return (
            (
                bottom - DVec2::new(0.0, noise),
                top + DVec2::new(0.0, noise),
            ),
            None,
        );
    }
    let (bottom, top) = (low.max(from - reach), high.min(to + reach));
    let shown = points
        .iter()
        .map(|point| DVec2::new(point.x, point.y.clamp(bottom, top)));
    let is_cut = bottom > *low || top < *high;
    (bounds_of(shown), is_cut.then_some((*low, *high)))
}

/// The bounds that hold a graph but for the share of it that runs off to infinity, in either
/// direction.
pub fn most_of(points: &[DVec2]) -> (DVec2, DVec2) {
    let inner = |values: &mut Vec<f64>| {
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let beyond = (PEAKS * values.len() as f64) as usize;
        Some((*values.get(beyond)?, *values.iter().nth_back(beyond)?))
    };
    let mut across = points.iter().map(|point| point.x).collect();
    let mut along = points.iter().map(|point| point.y).collect();
    let (Some(across), Some(along)) = (inner(&mut across), inner(&mut along)) else {
        return bounds_of(points.iter().copied());
    };
    let corners = [DVec2::new(across.0, along.0), DVec2::new(across.1, along.1)];
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
        let mut frame = Frame {
            bounds: Some(tall(before)),
        };
        frame.settle(tall(wanted), dragging);
        assert_eq!(frame.bounds, Some(tall(expected)));
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
        assert_eq!(within_reason(&points, 0.0).1, None);
        points[77].y = -1e14;
        let ((low, high), cut) = within_reason(&points, 0.0);
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
