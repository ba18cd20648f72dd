//! Bound of the distance between a curve and its approximation, both ways, which nothing between samples escapes.
//!
//! Pairs of points that follow each other along both curves cut them into cells. Within a cell two polynomials of one
//! parameter s in \[−1, 1\] lead along the curves, from one pair to the next: every point of one curve has a partner on
//! the other, and the largest distance of partners bounds the distance both ways. The power series of their difference
//! about the middle of the cell, with the bounds of its next coefficient over the whole cell as remainder (Taylor's
//! theorem in interval arithmetic), bounds that distance: by the Bernstein coefficients of the polynomial and the size
//! of the remainder. Cells are halved, the worst ones first, until the bound is close to a distance that is reached.
//! Partners are nearest points at the ends of cells and nearly so between, so the bound is tight.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::OnceLock;

use glam::DVec3;

use super::target::foot;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::interval::Interval;
use crate::geometry::power_series::PowerSeries;

/// Pairs a segment to begin with.
const PAIRS: usize = 2;

/// The order of the polynomials is that of the curve plus 1, but in these limits: lower ones take more cells, higher
/// ones more time for each.
const ORDERS: std::ops::RangeInclusive<usize> = 4..=12;

/// The most cells that are looked at, and so many more for each segment: more are looked at only where a curve
/// changes at once, or oscillates more often than it has segments.
const MOST_CELLS: [usize; 2] = [20_000, 16];

/// A cell by this share of the whole without any bound will have none.
const SMALLEST: f64 = 1e-7;

/// Room for the rounding of parameters at the ends of cells.
const PARAMETER_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A bound of the largest distance between two curves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    /// A distance that is reached.
    pub(super) at_least: f64,
    /// A distance that no point of either curve exceeds.
    pub(super) at_most: f64,
    /// The part of that which is rounding, where it cannot be told more closely.
    pub(super) rounding: f64,
    /// The parameters u and t where it is reached.
    pub(super) place: [f64; 2],
    /// The mean of the distances at even parameters of the polygon's curve, over its arc length.
    pub(super) mean: f64,
}

/// What a bound is wanted for.
pub(super) enum Wanted<'a> {
    /// To decide whether the distance is within a tolerance.
    Within {
        /// The tolerance.
        tolerance: f64,
    },
    /// To tell the distance closely.
    Tight {
        /// A distance that is reached.
        found: f64,
        /// The parameter t of the other curve's point that is nearest to the polygon's at u, as samples show it.
        there: &'a dyn Fn(f64) -> f64,
        /// The parameter u of the polygon's point that is nearest to the other curve's at t.
        here: &'a dyn Fn(f64) -> f64,
    },
}

impl Bound {
    /// A bound this many times as large as a distance that is reached is close to it.
    const CLOSE: f64 = 1.01;

    /// Whether it is as close to a distance that is reached as it can be.
    pub(super) fn is_close(&self, reached: f64) -> bool {
        self.at_most <= Self::CLOSE * reached + 3.0 * self.rounding
    }

    /// Bound the distance between a polygon's curve and another one that it runs along; `parameter` tells which t is
    /// near a given u. `None` if nothing is known of the other curve between samples.
    pub(super) fn of(
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        wanted: Wanted<'_>,
    ) -> Option<Self> {
        let interval = [0, polygon.segments()].map(|u| parameter(u as f64));
        let order = polygon.degree() + 1;
        let beside = Beside {
            polygon,
            curve,
            parameter,
            interval,
            order: order.clamp(*ORDERS.start(), *ORDERS.end()),
        };
        // Curves without any bounds are told at once.
        curve.enclosed(&PowerSeries::parameter(Interval::number(interval[0]), 0))?;
        let pairs = beside.pairs();
        let mut search = Search {
            beside: &beside,
            wanted: &wanted,
            cells: BinaryHeap::new(),
            at_least: match wanted {
                Wanted::Within { .. } => 0.0,
                Wanted::Tight { found, .. } => found,
            },
            place: [0.0, interval[0]],
            settled: 0.0,
            rounding: 0.0,
        };
        let pairs: Vec<Pair> = pairs.into_iter().map(|pair| search.seen(pair)).collect();
        let mean = mean(&pairs);
        let at_most = match search.is_over() {
            true => f64::INFINITY,
            false => {
                let cells = pairs.windows(2).map(|ends| beside.cell(ends[0], ends[1]));
                search.cells.extend(cells);
                search.run()
            }
        };
        Some(Self {
            at_least: search.at_least,
            at_most,
            rounding: search.rounding,
            place: search.place,
            mean,
        })
    }
}

/// A pair of points, one on each curve.
#[derive(Clone, Copy)]
struct Pair {
    u: f64,
    t: f64,
    /// The point on the polygon's curve.
    here: DVec3,
    /// The point on the other curve.
    there: DVec3,
    speed: f64,
    /// The speed of the other curve.
    pace: f64,
    /// The slope dt/du of nearest points.
    rate: f64,
    /// Whether the polygon's point belongs to the other curve's, and not the other way round.
    of_t: bool,
}

impl Pair {
    fn distance(&self) -> f64 {
        self.here.distance(self.there)
    }
}

/// Parts of both curves between two pairs.
#[derive(Clone, Copy)]
struct Cell {
    ends: [Pair; 2],
    /// No partners are farther from each other.
    bound: f64,
    /// The part of the bound that is rounding, and will not shrink with the cell.
    rounding: f64,
    /// Whether the other curve moves more than the polygon's.
    by_t: bool,
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

/// The search for a bound.
struct Search<'a> {
    beside: &'a Beside<'a>,
    wanted: &'a Wanted<'a>,
    /// The cells whose bound may be too large, the worst one on top.
    cells: BinaryHeap<Cell>,
    at_least: f64,
    place: [f64; 2],
    /// The largest bound of cells that cannot be better, and the largest rounding in them.
    settled: f64,
    rounding: f64,
}

impl Search<'_> {
    /// Halve cells until the bound is good enough, and return it.
    fn run(&mut self) -> f64 {
        let most = MOST_CELLS[0] + MOST_CELLS[1] * self.beside.polygon.segments();
        for _ in 0..most {
            let Some(worst) = self.cells.peek().copied() else {
                break;
            };
            if worst.bound <= self.enough() || self.is_over() {
                break;
            }
            self.cells.pop();
            if worst.bound - 2.0 * worst.rounding <= self.enough() {
                self.settled = self.settled.max(worst.bound);
                self.rounding = self.rounding.max(worst.rounding);
                continue;
            }
            let is_small = self.beside.share(&worst) <= SMALLEST;
            let middle = self.beside.middle(&worst);
            let is_known = worst.bound.is_finite() || !is_small;
            let middle = middle.filter(|middle| is_known && middle.there.is_finite());
            let Some(middle) = middle else {
                self.settled = self.settled.max(worst.bound);
                self.rounding = self.rounding.max(worst.rounding);
                if worst.bound.is_finite() {
                    continue;
                }
                break;
            };
            let middle = self.seen(middle);
            let [first, last] = worst.ends;
            let halves = [(first, middle), (middle, last)];
            self.cells
                .extend(halves.map(|(first, last)| self.beside.cell(first, last)));
        }
        let worst = self.cells.peek().map_or(0.0, |worst| worst.bound);
        worst.max(self.settled).max(self.at_least)
    }

    /// Note the distance of a pair, and return it: of far ones that of the point whose partner is nearest anywhere.
    fn seen(&mut self, mut pair: Pair) -> Pair {
        if pair.distance() <= self.at_least {
            return pair;
        }
        if let Wanted::Tight { there, here, .. } = self.wanted {
            let beside = self.beside;
            let nearest = match pair.of_t {
                true => {
                    let u = beside.round_u(here(pair.t), pair.u);
                    beside.pair(u, pair.t)
                }
                false => {
                    let t = beside.round_t(there(pair.u), pair.t);
                    beside.pair(pair.u, t)
                }
            };
            let of_t = pair.of_t;
            pair = Pair {
                of_t,
                ..nearer(pair, nearest)
            };
        }
        let mut distance = pair.distance();
        if !pair.of_t {
            // Samples may miss where the other curve is near.
            let ends = self.cells.iter().flat_map(|cell| cell.ends);
            distance = ends.fold(distance, |near, end| {
                near.min(end.there.distance(pair.here))
            });
        }
        if distance > self.at_least {
            self.at_least = distance;
            self.place = [pair.u, pair.t];
        }
        pair
    }

    /// The bound that is good enough.
    fn enough(&self) -> f64 {
        match self.wanted {
            Wanted::Within { tolerance } => *tolerance,
            Wanted::Tight { .. } => Bound::CLOSE * self.at_least,
        }
    }

    /// Whether no bound is good enough.
    fn is_over(&self) -> bool {
        match self.wanted {
            Wanted::Within { tolerance } => self.at_least > *tolerance,
            Wanted::Tight { .. } => false,
        }
    }
}

/// Two curves beside each other.
struct Beside<'a> {
    polygon: &'a FloatPolygon,
    curve: &'a dyn Differentiable,
    parameter: &'a dyn Fn(f64) -> f64,
    /// The part of the other curve.
    interval: [f64; 2],
    /// The order of the polynomials.
    order: usize,
}

impl Beside<'_> {
    /// Pairs along both curves, from their starts to their ends.
    fn pairs(&self) -> Vec<Pair> {
        let segments = self.polygon.segments();
        let [from, to] = self.interval;
        let is_periodic = self.polygon.is_periodic();
        let last = PAIRS * segments;
        let near = |index: usize| (self.parameter)(index as f64 / PAIRS as f64);
        let mut pairs: Vec<Pair> = Vec::with_capacity(last + 3);
        for index in 0..=last {
            let u = index as f64 / PAIRS as f64;
            let guess = near(index);
            let reach = near((index + PAIRS).min(last)) - near(index.saturating_sub(PAIRS));
            // Pairs follow each other along both curves.
            let before = pairs.last().map(|before| before.t);
            let [least, most] = match is_periodic {
                true => [before.unwrap_or(f64::NEG_INFINITY), f64::INFINITY],
                false => [before.unwrap_or(from), to],
            };
            let low = (guess - reach).max(least);
            let bracket = [low, (guess + reach).min(most).max(low)];
            let pair = match (is_periodic && index == last, pairs.first()) {
                (true, Some(first)) => Pair {
                    u,
                    t: first.t + (to - from),
                    ..*first
                },
                _ => self.beside_here(u, guess, bracket),
            };
            pairs.push(pair);
        }
        if !is_periodic {
            let [first, last] = [pairs[0], pairs[last]];
            // The curve may go on beyond an end, beside other places.
            if first.t > from {
                pairs.insert(0, self.beside_there(from, first.u, [0.0, segments as f64]));
            }
            if last.t < to {
                pairs.push(self.beside_there(to, last.u, [0.0, segments as f64]));
            }
        }
        pairs
    }

    /// A pair of points.
    fn pair(&self, u: f64, t: f64) -> Pair {
        let here = self.polygon.jet(u);
        let there = self.curve.derivatives(t, 2);
        let away = there[0] - here.point;
        let along = here.first.dot(there[1]);
        Pair {
            u,
            t,
            here: here.point,
            there: there[0],
            speed: here.speed(),
            pace: there[1].length(),
            rate: along / (there[1].length_squared() + away.dot(there[2])),
            of_t: false,
        }
    }

    /// The pair of a point of the polygon's curve and the other curve's nearest one within a bracket.
    fn beside_here(&self, u: f64, guess: f64, bracket: [f64; 2]) -> Pair {
        let guess = guess.max(bracket[0]).min(bracket[1]);
        let t = foot(self.curve, self.polygon.point(u), guess, bracket);
        nearer(self.pair(u, guess), self.pair(u, t))
    }

    /// The pair of a point of the other curve and the polygon's nearest one within a bracket.
    fn beside_there(&self, t: f64, guess: f64, bracket: [f64; 2]) -> Pair {
        let point = self.curve.derivatives(t, 0)[0];
        let u = foot(self.polygon, point, guess, bracket);
        Pair {
            of_t: true,
            ..nearer(self.pair(guess, t), self.pair(u, t))
        }
    }

    /// A parameter of the polygon's curve, of a periodic one the same one nearest to another.
    fn round_u(&self, u: f64, near: f64) -> f64 {
        let period = self.polygon.segments() as f64;
        match self.polygon.is_periodic() {
            true => u + period * ((near - u) / period).round(),
            false => u,
        }
    }

    /// The same of the other curve.
    fn round_t(&self, t: f64, near: f64) -> f64 {
        let [from, to] = self.interval;
        match self.polygon.is_periodic() {
            true => t + (to - from) * ((near - t) / (to - from)).round(),
            false => t,
        }
    }

    /// The larger share that a cell has of one of the curves.
    fn share(&self, cell: &Cell) -> f64 {
        let [a, b] = cell.ends;
        let [from, to] = self.interval;
        let share = (b.t - a.t).abs() / (to - from);
        share.max((b.u - a.u).abs() / self.polygon.segments() as f64)
    }

    /// A pair in the middle of a cell; `None` if there are no numbers between its ends.
    fn middle(&self, cell: &Cell) -> Option<Pair> {
        let [a, b] = cell.ends;
        let [u, t] = [[a.u, b.u], [a.t, b.t]].map(|[a, b]| a + 0.5 * (b - a));
        let is_inside = |middle: f64, [a, b]: [f64; 2]| a.min(b) < middle && middle < a.max(b);
        let [in_u, in_t] = [is_inside(u, [a.u, b.u]), is_inside(t, [a.t, b.t])];
        match (in_u, in_t) {
            (_, true) if cell.by_t || !in_u => {
                Some(self.beside_there(t, u, self.around(cell, [u, t])))
            }
            (true, _) => Some(self.beside_here(u, t, self.around_there(cell, [u, t]))),
            _ => None,
        }
    }

    /// Where the other curve's point may be that is nearest to the polygon's in the middle of a cell.
    fn around_there(&self, cell: &Cell, [u, t]: [f64; 2]) -> [f64; 2] {
        let [a, b] = cell.ends;
        let [from, to] = self.interval;
        let pace = a.pace.min(b.pace).max(f64::MIN_POSITIVE);
        let way = self.pair(u, t).distance() + a.distance().max(b.distance());
        let room = (way / pace).min(to - from);
        let [low, high] = [a.t.min(b.t) - room, a.t.max(b.t) + room];
        match self.polygon.is_periodic() {
            true => [low, high],
            false => [low.max(from), high.min(to)],
        }
    }

    /// Where the polygon's point may be that is nearest to the other curve's in the middle of a cell. Such points may
    /// go forth and back, as beside a peak: what lies on the way from end to end has a partner all the same.
    fn around(&self, cell: &Cell, [u, t]: [f64; 2]) -> [f64; 2] {
        let [a, b] = cell.ends;
        let speed = a.speed.min(b.speed).max(f64::MIN_POSITIVE);
        let way = self.pair(u, t).distance() + a.distance().max(b.distance());
        let room = (way / speed).min(self.polygon.segments() as f64);
        let [low, high] = [a.u.min(b.u) - room, a.u.max(b.u) + room];
        match self.polygon.is_periodic() {
            true => [low, high],
            false => [low.max(0.0), high.min(self.polygon.segments() as f64)],
        }
    }

    /// Bound the distance of partners between two pairs.
    fn cell(&self, a: Pair, b: Pair) -> Cell {
        let bounded = self.bounded(&a, &b);
        let (bound, rounding, by_t) = bounded.unwrap_or((f64::INFINITY, 0.0, false));
        let is_number = bound.is_finite();
        Cell {
            ends: [a, b],
            bound: if is_number { bound } else { f64::INFINITY },
            rounding: if is_number { rounding } else { 0.0 },
            by_t,
        }
    }

    /// The bound, its rounding, and whether the other curve moves more.
    fn bounded(&self, a: &Pair, b: &Pair) -> Option<(f64, f64, bool)> {
        let u = Way::straight([a.u, b.u]);
        let t = match a.u < b.u && a.t < b.t {
            true => Way::bent([a.t, b.t], [a.rate, b.rate].map(|rate| rate * u.rise())),
            false => Way::straight([a.t, b.t]),
        };
        let order = self.order;
        let series = |over_all: bool| {
            let here = self.polygon.enclosed(&u.series(over_all, order))?;
            let there = self.curve.enclosed(&t.series(over_all, order))?;
            Some([here, there])
        };
        let [here, there] = series(false)?;
        let [here_over, there_over] = series(true)?;
        let sized = |axes: &[PowerSeries<Interval>; 3], k: usize| {
            let sizes = axes
                .each_ref()
                .map(|axis| axis.coefficients()[k].magnitude());
            DVec3::from(sizes).length()
        };
        let by_t = sized(&there_over, 1) > sized(&here_over, 1);
        let difference = |a: &[PowerSeries<Interval>; 3], b: &[PowerSeries<Interval>; 3]| {
            [0, 1, 2].map(|axis| &a[axis] - &b[axis])
        };
        let [middle, over] = [
            difference(&there, &here),
            difference(&there_over, &here_over),
        ];
        let remainders = (0..=order).map(|k| (k, sized(&over, k)));
        let (terms, remainder) = remainders
            .filter(|(_, remainder)| remainder.is_finite())
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        let mut rounding = 0.0;
        let mut polynomial = Vec::with_capacity(terms);
        for k in 0..terms {
            let parts = middle
                .each_ref()
                .map(|axis| axis.coefficients()[k].middle_and_radius());
            let coefficient = DVec3::from(parts.map(|(middle, _)| middle));
            rounding += DVec3::from(parts.map(|(_, radius)| radius)).length();
            rounding += (terms + 2) as f64 * f64::EPSILON * coefficient.length();
            polynomial.push(coefficient);
        }
        let largest = largest_coefficient(&polynomial);
        Some((largest + remainder + rounding, rounding, by_t))
    }
}

/// A parameter as a polynomial of s in \[−1, 1\], from one to the other without turning.
struct Way {
    ends: [f64; 2],
    coefficients: [f64; 4],
}

impl Way {
    fn straight([from, to]: [f64; 2]) -> Self {
        let half = 0.5 * (to - from);
        Self {
            ends: [from, to],
            coefficients: [from + half, half, 0.0, 0.0],
        }
    }

    /// A cubic with slopes at its ends, as far as it rises all along with them (Fritsch and Carlson, 1980).
    fn bent([from, to]: [f64; 2], slopes: [f64; 2]) -> Self {
        let straight = Self::straight([from, to]);
        let mean = straight.rise();
        let [first, last] = slopes.map(|slope| match slope.is_finite() {
            true => slope.clamp(0.0, 3.0 * mean),
            false => mean,
        });
        if mean == 0.0 {
            return straight;
        }
        let [middle, ..] = straight.coefficients;
        let (bend, sum) = (0.25 * (last - first), 0.25 * (first + last));
        let coefficients = [middle - bend, 1.5 * mean - sum, bend, sum - 0.5 * mean];
        Self {
            coefficients,
            ..straight
        }
    }

    /// The mean slope.
    fn rise(&self) -> f64 {
        self.coefficients[1]
    }

    /// Bounds of its series about s = 0, or about every s.
    fn series(&self, over_all: bool, order: usize) -> PowerSeries<Interval> {
        let [a, b, c, d] = self.coefficients.map(Interval::number);
        let [from, to] = self.ends;
        let room = PARAMETER_ROUNDING * from.abs().max(to.abs());
        let coefficients = match over_all {
            false => [a.widened(room), b, c, d],
            true => {
                let [s, two, three] = [
                    Interval::new(-1.0, 1.0),
                    Interval::number(2.0),
                    Interval::number(3.0),
                ];
                let square = Interval::new(0.0, 1.0);
                [
                    Interval::new(from.min(to), from.max(to)).widened(room),
                    b + two * c * s + three * d * square,
                    c + three * d * s,
                    d,
                ]
            }
        };
        PowerSeries::of_coefficients(&coefficients, order)
    }
}

fn nearer(a: Pair, b: Pair) -> Pair {
    if b.distance() <= a.distance() { b } else { a }
}

/// The mean distance of pairs over the arc length, by the trapezium rule.
fn mean(pairs: &[Pair]) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for ends in pairs.windows(2) {
        let step = 0.5 * (ends[1].u - ends[0].u);
        for pair in ends {
            sum += step * pair.speed * pair.distance();
            length += step * pair.speed;
        }
    }
    if length > 0.0 { sum / length } else { 0.0 }
}

/// The length of the largest Bernstein coefficient over \[−1, 1\] of a polynomial by powers.
fn largest_coefficient(polynomial: &[DVec3]) -> f64 {
    let Some(degree) = polynomial.len().checked_sub(1) else {
        return 0.0;
    };
    let rows = powers_in_bernstein_form(degree);
    let coefficient = |row: &Vec<f64>| {
        let terms = polynomial.iter().zip(row);
        let sum = terms.fold(DVec3::ZERO, |sum, (term, factor)| sum + *term * *factor);
        sum.length()
    };
    rows.iter().map(coefficient).fold(0.0, f64::max)
}

/// The Bernstein coefficients of degree n over \[−1, 1\] of 1, s, … sⁿ, a row for each: coefficient i of sʲ is its
/// blossom at n − i times −1 and i times 1, the mean of all products of j of them, and never above 1.
fn powers_in_bernstein_form(degree: usize) -> &'static [Vec<f64>] {
    static ROWS: [OnceLock<Vec<Vec<f64>>>; *ORDERS.end() + 1] =
        [const { OnceLock::new() }; *ORDERS.end() + 1];
    let row = |ones: usize| {
        let roots = (0..degree).map(|index| if index < ones { 1.0 } else { -1.0 });
        let mut products = vec![0.0; degree + 1];
        products[0] = 1.0;
        for (done, root) in roots.enumerate() {
            for j in (0..=done).rev() {
                products[j + 1] += root * products[j];
            }
        }
        let mut binomial = 1.0;
        for (j, product) in products.iter_mut().enumerate() {
            *product /= binomial;
            binomial = binomial * (degree - j) as f64 / (j + 1) as f64;
        }
        products
    };
    ROWS.get(degree).map_or(&[], |rows| {
        rows.get_or_init(|| (0..=degree).map(row).collect())
    })
}
