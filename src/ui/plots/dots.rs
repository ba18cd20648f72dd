//! Dots of a plot, thinned out where they would touch. Those beyond its edges become arrows there.

use std::iter::{once, successors};

use glam::DVec2;

use super::pane::Pane;

/// How far the middles of two dots stay apart, in points.
const DOT: f64 = 7.0;

/// How far the middles of two arrows stay apart, in points.
const ARROW: f64 = 10.0;

/// The dots of a series that are drawn, by their places in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Dots {
    /// Those that are drawn as dots.
    pub inside: Vec<usize>,
    /// Those above the plot: arrows at its upper edge.
    pub above: Vec<usize>,
    /// Those below.
    pub below: Vec<usize>,
    /// Whether there are others that would touch these.
    pub crowded: bool,
}

impl Dots {
    /// Choose the dots to draw, so that none touches another; `first` is drawn in any case. Which
    /// of them stay depends on their places in the series: few change when one dot moves.
    pub fn new(series: &[DVec2], pane: &Pane, first: Option<usize>) -> Self {
        let mut dots = Self::default();
        let mut inside = Crowd::new(pane.size, DOT);
        let [mut above, mut below] =
            [(); 2].map(|()| Crowd::new(DVec2::new(pane.size.x, 0.0), ARROW));
        let first = first.filter(|index| *index < series.len());
        for index in first.into_iter().chain(by_halves(series.len())) {
            let place = pane.place(series[index]);
            if !(0.0..=pane.size.x).contains(&place.x) || !place.y.is_finite() {
                continue;
            }
            let edge = DVec2::new(place.x, 0.0);
            let (crowd, at, kept) = if place.y > pane.size.y {
                (&mut above, edge, &mut dots.above)
            } else if place.y < 0.0 {
                (&mut below, edge, &mut dots.below)
            } else {
                (&mut inside, place, &mut dots.inside)
            };
            if crowd.keep(at) {
                kept.push(index);
            } else if Some(index) != first {
                dots.crowded = true;
            }
        }
        dots
    }
}

/// The numbers below `count`: 0, then the middle, then the middles of both halves, and so on.
pub fn by_halves(count: usize) -> impl Iterator<Item = usize> {
    let widest = Some(count.next_power_of_two() / 2).filter(|step| *step > 0);
    let steps = successors(widest, |step| (*step > 1).then_some(step / 2));
    let others = steps.flat_map(move |step| (step..count).step_by(2 * step));
    once(0).filter(move |_| count > 0).chain(others)
}

/// Places on a plot, in points, that keep some distance.
pub struct Crowd {
    apart: f64,
    cell: f64,
    columns: usize,
    /// For each cell the place that is kept in it, if there is one.
    kept: Vec<Option<DVec2>>,
}

impl Crowd {
    /// Places on a plot of some size, at least `apart` from each other.
    pub fn new(size: DVec2, apart: f64) -> Self {
        // Two places in a cell would be too close.
        let cell = apart / 2f64.sqrt();
        let count = |extent: f64| (extent / cell).clamp(0.0, 1e4) as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        Self {
            apart,
            cell,
            columns,
            kept: vec![None; columns * rows],
        }
    }

    /// Keep a place if none that is kept is too close.
    pub fn keep(&mut self, at: DVec2) -> bool {
        let cell = |value: f64| (value / self.cell).max(0.0) as usize;
        let (column, row) = (cell(at.x).min(self.columns - 1), cell(at.y));
        for row in row.saturating_sub(2)..=row + 2 {
            for column in column.saturating_sub(2)..=(column + 2).min(self.columns - 1) {
                let other = self.kept.get(row * self.columns + column);
                let other = other.copied().flatten();
                if other.is_some_and(|other| other.distance(at) < self.apart) {
                    return false;
                }
            }
        }
        let own = self.kept.get_mut(row * self.columns + column);
        own.is_some_and(|own| own.replace(at).is_none())
    }
}

#[cfg(test)]
mod tests {
    use egui_plot::PlotBounds;

    use super::*;

    fn pane() -> Pane {
        Pane {
            bounds: PlotBounds::from_min_max([0.0, -1.0], [100.0, 1.0]),
            size: DVec2::new(500.0, 100.0),
        }
    }

    fn waves(count: usize) -> Vec<DVec2> {
        let wave = |index: usize| {
            let x = 100.0 * index as f64 / count as f64;
            DVec2::new(x, 1.5 * (0.4 * x).sin())
        };
        (0..count).map(wave).collect()
    }

    #[test]
    fn halves_name_every_number_once() {
        for count in 0..70 {
            let mut numbers: Vec<usize> = by_halves(count).collect();
            numbers.sort_unstable();
            assert!(numbers.into_iter().eq(0..count));
        }
    }

    #[test]
    fn what_does_not_touch_is_all_drawn() {
        let series = waves(40);
        let dots = Dots::new(&series, &pane(), None);
        let beyond = |sign: f64| series.iter().filter(|at| sign * at.y > 1.0).count();
        assert_eq!(dots.above.len(), beyond(1.0));
        assert_eq!(dots.below.len(), beyond(-1.0));
        assert!(dots.above.len() > 5 && dots.below.len() > 5);
        let count = dots.inside.len() + dots.above.len() + dots.below.len();
        assert_eq!(count, 40);
        assert!(!dots.crowded && !Dots::new(&series, &pane(), Some(7)).crowded);
    }

    #[test]
    fn dots_and_arrows_thin_out_where_they_would_touch() {
        let pane = pane();
        for count in [100, 1000, 10_000] {
            let series = waves(count);
            let dots = Dots::new(&series, &pane, None);
            assert!(dots.crowded);
            let place = |index: &usize| pane.place(series[*index]);
            for (a, index) in dots.inside.iter().enumerate() {
                for other in &dots.inside[..a] {
                    assert!(place(index).distance(place(other)) >= DOT);
                }
            }
            for arrows in [&dots.above, &dots.below] {
                for (a, index) in arrows.iter().enumerate() {
                    for other in &arrows[..a] {
                        assert!((place(index).x - place(other).x).abs() >= ARROW);
                    }
                }
                // They cover what they stand for.
                let beyond = series.iter().filter(|at| at.y.abs() > 1.0).count();
                assert!(arrows.len() >= 12 && arrows.len() < beyond, "{arrows:?}");
            }
            // Nowhere is there room for one more.
            for at in series.iter().filter(|at| at.y.abs() <= 1.0) {
                let near = |index: &usize| place(index).distance(pane.place(*at)) < DOT;
                assert!(dots.inside.iter().any(near));
            }
        }
    }

    #[test]
    fn the_dot_that_is_hovered_is_drawn_and_others_stay() {
        let series = waves(5000);
        let before = Dots::new(&series, &pane(), None);
        let hidden =
            (0..5000).find(|index| series[*index].y.abs() < 1.0 && !before.inside.contains(index));
        let hidden = hidden.expect("a dot that is not drawn");
        let dots = Dots::new(&series, &pane(), Some(hidden));
        assert!(dots.inside.contains(&hidden));
        let gone = before
            .inside
            .iter()
            .filter(|index| !dots.inside.contains(index));
        assert!(gone.count() < 12);
    }

    #[test]
    fn nothing_comes_of_nothing() {
        assert_eq!(Dots::new(&[], &pane(), Some(3)), Dots::default());
        let odd = [
            DVec2::NAN,
            DVec2::new(50.0, f64::NAN),
            DVec2::new(-1.0, 0.0),
        ];
        assert_eq!(Dots::new(&odd, &pane(), None), Dots::default());
        let flat = Pane {
            size: DVec2::ZERO,
            ..pane()
        };
        assert!(Dots::new(&waves(100), &flat, None).inside.len() <= 1);
    }
}
