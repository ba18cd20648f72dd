//! Fits of planar points.

use std::collections::BTreeMap;
use std::time::Duration;

use glam::{DVec2, DVec3};

use super::error::FitError;
use super::levels::{self, Level, Task};
use super::plane_fit::{Extrema, PlaneFit};
use super::prepared::Prepared;
use super::problem::{Data, EndCondition, EndValue};
use super::sharp_bend::{SharpBend, sharp_bend};
use super::slope_coefficients::SlopeTables;
use super::trend::has_trend;
use super::winding::crossing_of;
use crate::geometry::end::End;
use crate::geometry::error::PolygonError;
use crate::geometry::features::{Feature, Features};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::nearest::refined_parameter;
use crate::geometry::progress::Progress;

/// The most vertices without a wish, without and with a tolerance, and the points that each of them stands for at
/// least.
const MOST_VERTICES: [usize; 2] = [40, 80];
const POINTS_A_VERTEX: usize = 2;

/// Points that are off by no more than this, of a size of 1 or less, are met.
const EXACT: f64 = 1e-11;

/// Vertices of straight lines are multiples of this share of the unit: their sums have no rounding.
const LINE_GRID: f64 = 1.0 / (1_u64 << 43) as f64;

/// The most extrema that are tried.
const MOST_EXTREMA: usize = 80;

/// Where the points are farther than so many tolerances, from this number of extrema on, the next numbers are left
/// out: half as many as were tried, and from the second number on a quarter as many even where points are nearer. If
/// that was too far, they are bisected.
const FAR: f64 = 6.0;
const SKIPS_FROM: usize = 4;
const STRIDES_FROM: usize = 8;

/// From the number of extrema on that a smoothed curve lets expect, larger and larger ones are tried first, in this share
/// of the time: smaller ones may take all of it to miss the tolerance. A number that misses it by more than this factor
/// and gains little is given up early, so that the others have the time if the expectation was wrong.
const EXPECTED_TIME: f64 = 0.5;
const EXPECTED_FAR: f64 = 1.2;

/// The same factor for smaller numbers than one that keeps the tolerance. With half of it, sections get up to five extrema
/// more than they take.
const FAR_BELOW: f64 = 3.0;

/// So many further numbers are tried for so long beside the fewest, so that there is something to choose from.
const MORE: usize = 2;
const MORE_TIME: Duration = Duration::from_millis(500);

/// Where noisy points lie beside the best in runs, so many further numbers of extrema are tried. One that leaves this share
/// of the RMS counts, while the noise alone leaves nearly all: 80 points of an arch with one extremum were fitted with none
/// at 1.5 times the RMS.
const TREND: usize = 3;
const EXPLAINED: f64 = 0.85;

/// A fit with fewer inflections may explain noisy points worse by this factor, in the RMS.
const AS_WELL: f64 = 1.03;

/// So long what asking for each number of extrema brings is looked for, beside the fewest.
const EACH_TIME: Duration = Duration::from_secs(3);

/// A handy fit may explain the points worse by this factor, in the RMS, than one that is not.
const HANDIER: f64 = 1.25;

/// A fit that does not cross itself may be farther off by this factor than one that does.
const ABOUT: f64 = 1.25;

/// Levels of fewer extrema that begin those of more, and those of few that patterns of smoothed curves begin too.
const RELEASED: [usize; 2] = [3, 1];

/// Levels with fewer extrema, which are looked for so long, begin those with just so many: from this number on only they,
/// below it also patterns of smoothed curves.
const LADDER: usize = 4;
const LADDER_TIME: Duration = Duration::from_secs(2);

/// From this number of extrema on, a fit that misses the tolerance by this factor is also begun at those with all smaller
/// numbers, so long at most: fewer extrema are seldom near enough.
const SEARCHED: usize = 3;
const MISSED: f64 = 2.0;
const NEARER_TIME: Duration = Duration::from_secs(3);

/// The search for the fewest extrema ends where so many numbers in a row come no nearer than this share: fewer where
/// the points are within so many times their noise, and more where they are not. A shape with four equal waves comes no
/// nearer until all of them are allowed.
const STALE: [usize; 2] = [4, 10];
const GAIN: f64 = 0.9;
const NOISY: f64 = 10.0;

/// The share of the time that is left after which a search for a tolerance below the noise ends without a gain: 3 s of
/// 10 s. Hardly any curve keeps it, and more extrema only follow the noise.
const HOPELESS_SHARE: f64 = 0.3;

/// How near a number of extrema comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TradeOff {
    /// The number of curvature extrema.
    pub extrema: usize,
    /// The number of vertices.
    pub vertices: usize,
    /// The root of the mean squared distance of the points that count, weighed.
    pub rms: f64,
    /// The largest of these distances.
    pub largest: f64,
}

/// A fit with its figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// Whether extrema, inflections and ends are those asked for, proved.
    pub holds: bool,
    /// The number of curvature extrema, proved.
    pub extrema: usize,
    /// The number of inflections.
    pub inflections: usize,
    /// The root of the mean squared distance of the points that count, weighed.
    pub rms: f64,
    /// The largest distance of the points that count.
    pub deviation: f64,
    /// The largest distance of all points.
    pub largest: f64,
    /// The points that do not count, with their distances.
    pub outliers: Vec<(usize, f64)>,
    /// The estimated standard deviation of the points' noise.
    pub noise: f64,
    /// The tolerance that counted.
    pub tolerance: f64,
    /// What each number of extrema that was tried reaches.
    pub trade_off: Vec<TradeOff>,
    /// The fewest extrema found that keep the tolerance, if the number asked for does not.
    pub least_extrema: Option<usize>,
    /// The points that repeat the one before, from 0; they count once.
    pub repeated: Vec<usize>,
    /// Whether the time was up before the search had ended.
    pub stopped: bool,
    /// A bend that the points do not show.
    pub sharp_bend: Option<SharpBend>,
    /// A point where the curve crosses itself, if the polyline of the points does not.
    pub crossing: Option<DVec2>,
    /// If it does, others that do not and are about as near: the one that exact ends make of it, and of the others found
    /// the one with the fewest extrema.
    pub uncrossed: Vec<Uncrossed>,
}

/// A fit that does not cross itself, beside one that does.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncrossed {
    /// The fit.
    pub fitted: Fitted,
    /// Whether it has exact ends though they are not asked for.
    pub has_exact_ends: bool,
}

/// Fit a curve with a wished number of curvature extrema, or the fewest, to points of the plane that follow each
/// other along it.
///
/// Minimises the distances of the points while the curvature rises and falls as often as asked, proved. Without
/// a number of vertices ever more are tried until that no longer helps.
///
/// # Errors
/// [`FitError`].
pub fn fit_plane(
    points: &[DVec2],
    asked: &PlaneFit,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    fit_plane_corrected(points, asked, &|_, _| None, progress)
}

/// Fit as [`fit_plane`] does, and let the curve be corrected before it is measured: `corrected` gets the curve and the
/// points that do not count. What it returns counts if extrema and inflections stay, proved.
///
/// # Errors
/// [`FitError`].
pub fn fit_plane_corrected(
    points: &[DVec2],
    asked: &PlaneFit,
    corrected: &dyn Fn(&FloatPolygon, &[usize]) -> Option<FloatPolygon>,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    let whole = Prepared::new(points, asked)?.refined_on(asked);
    let thinned = whole.thinned(asked);
    let fit = Fit {
        prepared: thinned.as_ref().unwrap_or(&whole),
        whole: &whole,
        asked,
        progress,
        tables: &SlopeTables::new(asked.degree),
    };
    let Found {
        level,
        trade_off,
        least_extrema,
        others,
    } = fit.found();
    if progress.is_cancelled() && !progress.is_late() {
        return Err(FitError::Cancelled);
    }
    let smoothed = || fit.task(0, None).smoothed().map(|level| fit.refined(level));
    let level = level.or_else(smoothed);
    let level = level.ok_or(FitError::NotFound)?;
    let fitted = fit.finished(points, &level, corrected)?;
    let uncrossed = match fitted.crossing {
        Some(_) => fit.uncrossed(points, &level, others, corrected),
        None => Vec::new(),
    };
    Ok(Fitted {
        uncrossed,
        trade_off,
        least_extrema,
        ..fitted
    })
}

/// What a fit has found.
#[derive(Default)]
struct Found {
    /// The best fit.
    level: Option<Level>,
    /// What each number of extrema reaches.
    trade_off: Vec<TradeOff>,
    /// The fewest extrema that keep the tolerance where the number asked for does not.
    least_extrema: Option<usize>,
    /// Fits with other numbers of extrema and vertices, where any will do.
    others: Vec<Level>,
}

/// What a search for the fewest extrema knows.
#[derive(Default)]
struct Search {
    known: BTreeMap<usize, Vec<Level>>,
    trade_off: Vec<TradeOff>,
    best: Option<Level>,
    /// Whether the result is shown as it gets better.
    is_shown: bool,
}

impl Search {
    /// Levels of one or two extrema less, which begin those of more.
    fn fewer(&self, extrema: usize) -> Vec<Level> {
        let near = self.known.range(extrema.saturating_sub(2)..extrema);
        let last = near.flat_map(|(_, levels)| levels.iter().rev().take(RELEASED[0]));
        last.cloned().collect()
    }
}

/// What a number of extrema brings.
struct Searched {
    /// Whether it keeps the tolerance.
    keeps: bool,
    /// Whether it is nearer than the best so far, by more than little.
    gains: bool,
    /// Whether the points are many tolerances off, or there is no curve.
    is_far: bool,
}

#[derive(Clone, Copy)]
struct Fit<'a> {
    /// The points that are looked at in the search.
    prepared: &'a Prepared,
    /// All points.
    whole: &'a Prepared,
    asked: &'a PlaneFit,
    progress: &'a Progress,
    tables: &'a SlopeTables,
}

impl Fit<'_> {
    fn task(&self, extrema: usize, tolerance: Option<f64>) -> Task<'_> {
        self.task_on(self.prepared, extrema, tolerance)
    }

    fn task_of_all(&self, extrema: usize, tolerance: Option<f64>) -> Task<'_> {
        self.task_on(self.whole, extrema, tolerance)
    }

    fn task_on<'b>(
        &'b self,
        prepared: &'b Prepared,
        extrema: usize,
        tolerance: Option<f64>,
    ) -> Task<'b> {
        let most = MOST_VERTICES[usize::from(tolerance.is_some())];
        let half = (prepared.counting / POINTS_A_VERTEX).min(most);
        let most = self.asked.most.unwrap_or(half);
        Task {
            data: Data {
                points: &prepared.points,
                weights: &prepared.weights,
                counts: &prepared.counts,
                ends: &prepared.ends,
                held: &[],
                mirror: self.asked.mirror,
                calms_ends: !self.asked.periodic && !self.asked.of_curve,
            },
            degree: self.asked.degree,
            periodic: self.asked.periodic,
            extrema,
            inflections: self.asked.inflections,
            count: self.asked.count,
            most: most.max(self.asked.degree + 1),
            tolerance,
            far: levels::FAR,
            known: None,
            tables: self.tables,
            progress: self.progress,
        }
    }

    /// The fit to all points that is found from one to some of them.
    fn refined(&self, level: Level) -> Level {
        if std::ptr::eq(self.prepared, self.whole) {
            return level;
        }
        let (end, periodic) = (level.splines.end(), self.asked.periodic);
        let places = &level.start.curve.places;
        let places = self
            .whole
            .places_of_all(self.prepared, places, end, periodic);
        let extrema = level.start.slopes.cuts.len();
        self.task_of_all(extrema, None).refined(level, places)
    }

    fn found(&self) -> Found {
        if let Some(exact) = self.straight().or_else(|| self.exact()) {
            return Found {
                level: Some(exact),
                ..Found::default()
            };
        }
        let Extrema::Exactly(extrema) = self.asked.extrema else {
            let mut search = self.fewest(true);
            self.ask_for_each(&mut search);
            if self.prepared.is_noisy {
                self.follow_trend(&mut search);
                self.drop_inflections(&mut search);
            }
            return Found {
                level: search.best,
                trade_off: search.trade_off,
                others: search.known.into_values().flatten().collect(),
                ..Found::default()
            };
        };
        let (level, trade_off) = self.exactly(extrema, true);
        let tolerance = self.prepared.tolerance;
        let is_near = level
            .as_ref()
            .is_some_and(|level| level.largest <= tolerance);
        if self.asked.tolerance.is_none() || is_near {
            return Found {
                level,
                trade_off,
                ..Found::default()
            };
        }
        let search = self.fewest(false);
        let fair = search.best.as_ref().filter(|it| it.largest <= tolerance);
        let least = fair.map(|fair| fair.start.slopes.cuts.len());
        // Fits with fewer extrema begin nearer ones with those asked for.
        let levels = self.task(extrema, Some(tolerance));
        let levels = levels.levels(&search.fewer(extrema), &|_| ());
        let (again, _) = self.refined_choice(extrema, levels, true);
        let off = |level: &Option<Level>| level.as_ref().map_or(f64::INFINITY, |it| it.largest);
        let level = if off(&again) < off(&level) {
            again
        } else {
            level
        };
        let least = least.filter(|_| off(&level) > tolerance);
        Found {
            level,
            trade_off: search.trade_off,
            least_extrema: least,
            others: Vec::new(),
        }
    }

    /// A fit that is nearer than a level with so many extrema, begun at those with all smaller numbers.
    fn nearer(&self, extrema: usize, level: Option<&Level>) -> Option<Level> {
        let progress = self.progress.limited(NEARER_TIME);
        let asked = PlaneFit {
            most: Some(self.task(extrema, None).most),
            ..self.asked.clone()
        };
        let fit = Fit {
            asked: &asked,
            progress: &progress,
            ..*self
        };
        let (step, _) = self.numbers();
        let mut search = Search::default();
        for fewer in (extrema % step..extrema).step_by(step) {
            fit.searched(fewer, levels::FAR, &mut search);
        }
        let tolerance = Some(self.prepared.tolerance);
        let levels = fit
            .task(extrema, tolerance)
            .levels(&search.fewer(extrema), &|_| ());
        let (found, _) = fit.refined_choice(extrema, levels, true);
        found.filter(|found| {
            level.is_none_or(|level| found.rms < level.rms && found.largest < level.largest)
        })
    }

    /// The straight line that the points lie on: its vertices are even to the last digit, so that nothing bends.
    fn straight(&self) -> Option<Level> {
        let (prepared, asked) = (self.whole, self.asked);
        let bends = asked.inflections.is_some_and(|it| it > 0)
            || asked.extrema.number().is_some_and(|it| it > 0);
        // The line through the outer points meets them.
        let is_point = |end: &EndCondition| matches!(end.value, EndValue::Point(_));
        let is_free = prepared.ends.iter().all(is_point) && asked.mirror.is_none();
        if asked.periodic || bends || !is_free {
            return None;
        }
        let (first, last) = (*prepared.points.first()?, *prepared.points.last()?);
        let way = last - first;
        let along = way.try_normalize()?;
        let share = |point: &DVec2| (*point - first).dot(way) / way.length_squared();
        let shares: Vec<f64> = prepared.points.iter().map(share).collect();
        let off = |point: &DVec2| (*point - first).perp_dot(along).abs();
        let lie_on_it = prepared.points.iter().all(|point| off(point) <= EXACT);
        if !lie_on_it || !shares.is_sorted() {
            return None;
        }
        let degree = asked.degree;
        let count = asked.count.unwrap_or(degree + 1);
        let segments = (count - degree) as f64;
        let even = |vector: DVec2| (vector / LINE_GRID).round() * LINE_GRID;
        let leg = even(way / segments);
        // The curve begins in the middle of the vertices that make its first point.
        let begin = even(first - 0.5 * (degree - 1) as f64 * leg);
        let vertices = (0..count).map(|index| begin + index as f64 * leg).collect();
        let places = shares.iter().map(|share| share * segments).collect();
        Some(self.task_of_all(0, None).line(count, vertices, places))
    }

    /// The curve of least squares if it meets the points, as one with as many vertices as points or a straight
    /// line does, and has the features asked for.
    fn exact(&self) -> Option<Level> {
        if !std::ptr::eq(self.prepared, self.whole) {
            // So many points are on no such curve.
            return None;
        }
        let mut level = self.task(0, None).smoothed()?;
        self.show(&level);
        if level.largest > EXACT || !self.prepared.ends.is_empty() {
            return None;
        }
        let polygon = level.polygon()?;
        // Where the points leave no choice, hooks at the ends are theirs.
        let task = self.task(0, None);
        if task.winds_between(&polygon, &level, &task.placed_points(&level)) {
            return None;
        }
        let features = Features::proved(&polygon, |_| !self.progress.is_cancelled())?;
        let [extrema, inflections] =
            [Feature::CurvatureExtremum, Feature::Inflection].map(|it| features.count(it));
        let suits = match self.asked.extrema {
            Extrema::Exactly(asked) => extrema == asked && features.undecided.is_empty(),
            // Another one may have fewer, unless so few points leave no choice.
            Extrema::Fewest => {
                let count = self.asked.count.unwrap_or(self.asked.degree + 1);
                extrema == 0 || count >= self.prepared.counting
            }
        };
        let bends = self.asked.inflections;
        level.holds = suits && bends.is_none_or(|asked| asked == inflections);
        level.holds.then_some(level)
    }

    /// Without a tolerance the search ends where the points are near enough for it, and a wished number of extrema
    /// where they are as near as they get: tell what asking for each number brings, the nearest numbers first. One that
    /// is near enough with fewer extrema, or with a handier polygon, takes the place of the best.
    fn ask_for_each(&self, search: &mut Search) {
        let is_wanted = |best: &&Level| {
            let lists = self.asked.lists_trade_off;
            self.asked.tolerance.is_none() && (lists || !self.task(0, None).is_handy(best))
        };
        let Some(best) = search.best.as_ref().filter(is_wanted) else {
            return;
        };
        let chosen = best.start.slopes.cuts.len();
        let progress = self.progress.limited(EACH_TIME);
        let asking = Fit {
            progress: &progress,
            ..*self
        };
        let mut rows: Vec<&mut TradeOff> = search.trade_off.iter_mut().collect();
        rows.retain(|row| self.asked.lists_trade_off || row.extrema == chosen);
        rows.sort_by_key(|row| row.extrema.abs_diff(chosen));
        for row in rows {
            let (level, reached) = asking.exactly(row.extrema, false);
            if progress.is_cancelled() {
                break;
            }
            if let Some(own) = reached.last().filter(|it| it.extrema == row.extrema) {
                *row = *own;
            }
            let is_better = |level: &Level| self.is_fairer(level, search.best.as_ref());
            search.best = level.filter(is_better).or(search.best.take());
        }
    }

    /// Allow noisy points more extrema while they lie beside the best in runs, if that explains them much better.
    fn follow_trend(&self, search: &mut Search) {
        let progress = self.progress.limited(EACH_TIME);
        let asking = Fit {
            progress: &progress,
            ..*self
        };
        let (step, most) = self.numbers();
        while let Some(best) = search.best.clone().filter(|best| self.misses_trend(best)) {
            let chosen = best.start.slopes.cuts.len();
            let numbers = (1..=TREND).map(|more| chosen + more * step);
            let better = numbers
                .take_while(|extrema| *extrema <= most)
                .find_map(|extrema| {
                    let (level, _) = asking.exactly(extrema, false);
                    level.filter(|it| it.rms <= EXPLAINED * best.rms && self.is_near(it))
                });
            let Some(better) = better else { return };
            self.take(better, search);
        }
    }

    fn is_near(&self, level: &Level) -> bool {
        level.holds && level.largest <= self.prepared.tolerance
    }

    /// Let a level be the best, and its row that of its number of extrema.
    fn take(&self, level: Level, search: &mut Search) {
        let extrema = level.start.slopes.cuts.len();
        search.trade_off.retain(|row| row.extrema != extrema);
        search.trade_off.push(self.trade_off(extrema, &level));
        search.trade_off.sort_by_key(|row| row.extrema);
        search.best = Some(level);
    }

    fn misses_trend(&self, level: &Level) -> bool {
        let points = self.task_of_all(0, None).placed_points(level);
        let polygon = level.polygon();
        polygon.is_some_and(|polygon| has_trend(&polygon, &points))
    }

    /// Leave out inflections that noisy points do not ask for: those without which the best explains them as well.
    fn drop_inflections(&self, search: &mut Search) {
        if self.asked.inflections.is_some() {
            return;
        }
        let progress = self.progress.limited(EACH_TIME);
        let count = |level: &Level| {
            let features = Features::proved(&level.polygon()?, |_| !progress.is_cancelled())?;
            Some(features.count(Feature::Inflection))
        };
        while let Some(best) = &search.best {
            let inflections = count(best).unwrap_or(0);
            let fewer = [inflections.checked_sub(1), inflections.checked_sub(2)];
            let found = fewer.into_iter().flatten().find_map(|inflections| {
                let asked = PlaneFit {
                    inflections: Some(inflections),
                    ..self.asked.clone()
                };
                let asking = Fit {
                    asked: &asked,
                    progress: &progress,
                    ..*self
                };
                let (level, _) = asking.exactly(best.start.slopes.cuts.len(), false);
                level.filter(|it| it.rms <= AS_WELL * best.rms && self.is_near(it))
            });
            let Some(found) = found else { return };
            self.take(found, search);
        }
    }

    /// Whether a level is near enough, and has fewer extrema than another one, or as many and a handier polygon.
    fn is_fairer(&self, level: &Level, other: Option<&Level>) -> bool {
        let task = self.task(0, None);
        let price = |level: &Level| (level.start.slopes.cuts.len(), !task.is_handy(level));
        level.largest <= self.prepared.tolerance
            && other.is_none_or(|other| price(level) < price(other))
    }

    /// The nearest fit with just so many extrema, and what it and those that begin it reach.
    fn exactly(&self, extrema: usize, is_shown: bool) -> (Option<Level>, Vec<TradeOff>) {
        let tolerance = self.asked.tolerance.map(|_| self.prepared.tolerance);
        let task = self.task(extrema, tolerance);
        let keeps = tolerance.is_some();
        let find = |fewer: &[Level], is_shown: bool| {
            let levels = task.levels(fewer, &|known| {
                if is_shown {
                    self.show_chosen(known, keeps);
                }
            });
            self.refined_choice(extrema, levels, keeps).0
        };
        let is_few = extrema < LADDER;
        let plain = is_few.then(|| find(&[], is_shown)).flatten();
        let is_kept = |it: &Level| tolerance.is_some_and(|tolerance| it.largest <= tolerance);
        let (fewer, mut reached) = match plain.as_ref().is_some_and(is_kept) {
            true => (Vec::new(), Vec::new()),
            false => self.ladder(extrema),
        };
        let is_begun = !is_few || !fewer.is_empty();
        let begun = is_begun.then(|| find(&fewer, is_shown && !is_few));
        let found = plain.into_iter().chain(begun.flatten());
        let mut level = self.chosen(found.collect(), keeps);
        let is_far = |it: &Level| it.largest > MISSED * self.prepared.tolerance;
        if !keeps && extrema >= SEARCHED && level.as_ref().is_none_or(is_far) {
            level = self.nearer(extrema, level.as_ref()).or(level);
        }
        reached.extend(level.as_ref().map(|level| self.trade_off(extrema, level)));
        (level, reached)
    }

    /// Levels with fewer extrema, which begin those with more: patterns of smoothed curves alone may lead to worse ones.
    /// What each number reaches comes with them. Monotone curvature begins nothing better.
    fn ladder(&self, extrema: usize) -> (Vec<Level>, Vec<TradeOff>) {
        let (mut fewer, mut reached): (Vec<Level>, _) = (Vec::new(), Vec::new());
        let (step, _) = self.numbers();
        let below = extrema.checked_sub(step).filter(|rung| *rung > 0);
        let rungs = match extrema < LADDER {
            true => below.map_or(0..0, |rung| rung..rung + 1),
            false => 2 + extrema % 2..extrema,
        };
        let released = RELEASED[usize::from(extrema < LADDER)];
        let progress = self.progress.limited(LADDER_TIME);
        for rung in rungs.step_by(2) {
            if progress.is_cancelled() {
                break;
            }
            let task = Task {
                progress: &progress,
                ..self.task(rung, None)
            };
            let levels = task.levels(&fewer, &|_| ());
            reached.extend(levels.last().map(|nearest| self.trade_off(rung, nearest)));
            if !levels.is_empty() {
                fewer = levels.into_iter().rev().take(released).collect();
            }
        }
        (fewer, reached)
    }

    /// The level chosen, fitted to all points, and what the number of extrema reaches.
    fn refined_choice(
        &self,
        extrema: usize,
        levels: Vec<Level>,
        is_for_tolerance: bool,
    ) -> (Option<Level>, Option<TradeOff>) {
        if std::ptr::eq(self.prepared, self.whole) {
            let level = self.chosen(levels, is_for_tolerance);
            let trade_off = level.as_ref().map(|level| self.trade_off(extrema, level));
            return (level, trade_off);
        }
        let nearest = levels.last().cloned();
        let level = self.chosen(levels, is_for_tolerance);
        let level = level.map(|level| self.refined(level));
        // What some of the points keep all need not keep.
        let is_near = |level: &Level| level.largest <= self.prepared.tolerance;
        let level = match (level, nearest) {
            (Some(level), Some(nearest)) if is_for_tolerance && !is_near(&level) => {
                let nearest = self.refined(nearest);
                Some(if nearest.largest < level.largest {
                    nearest
                } else {
                    level
                })
            }
            (level, _) => level,
        };
        let trade_off = level.as_ref().map(|level| self.trade_off(extrema, level));
        (level, trade_off)
    }

    /// The fit with the fewest extrema that keeps the tolerance, or else the nearest.
    fn fewest(&self, is_shown: bool) -> Search {
        let afresh = || Search {
            is_shown,
            ..Search::default()
        };
        let (mut expected, mut search) = (afresh(), afresh());
        let (step, most) = self.numbers();
        let least = usize::from(self.asked.mirror.is_some());
        // The fewest that are known to keep the tolerance.
        let kept = self.expected([least, most], step, &mut expected);
        if kept.is_some() {
            std::mem::swap(&mut expected, &mut search);
        }
        let far = kept.map_or(levels::FAR, |_| FAR_BELOW);
        let (mut extrema, mut stale) = (least, 0);
        // The largest number that misses the tolerance.
        let mut missed = None;
        let mut progress = self.patient();
        while extrema <= most {
            if let Some(kept) = kept.filter(|kept| *kept <= extrema) {
                self.bisect([missed, Some(kept)], step, far, &mut search);
                break;
            }
            let fit = Fit {
                progress: &progress,
                ..*self
            };
            let found = fit.searched(extrema, far, &mut search);
            if found.gains {
                progress = self.patient();
            }
            if found.keeps {
                self.bisect([missed, Some(extrema)], step, far, &mut search);
                break;
            }
            stale = if found.gains || search.best.is_none() {
                0
            } else {
                stale + 1
            };
            let best = search.best.as_ref().map_or(f64::INFINITY, |it| it.largest);
            let is_noisy = best <= NOISY * self.prepared.noise;
            let patience = STALE[usize::from(!is_noisy)];
            if (stale >= patience && kept.is_none()) || progress.is_cancelled() {
                break;
            }
            missed = Some(extrema);
            let skipped = match extrema {
                few if few < SKIPS_FROM => 0,
                _ if found.is_far => extrema / 2,
                few if few < STRIDES_FROM => 0,
                many => many / 4,
            };
            let skipped = skipped / step * step;
            extrema = match extrema + step + skipped {
                next if extrema < most => {
                    let last = extrema + (most - extrema) / step * step;
                    next.min(last).max(extrema + step)
                }
                next => next,
            };
            self.progress.set_done((extrema as f64 / 10.0).min(0.9));
        }
        let off = |search: &Search| search.best.as_ref().map_or(f64::INFINITY, |it| it.largest);
        if off(&search) > self.prepared.tolerance && off(&expected) < off(&search) {
            search.best = expected.best;
        }
        if self.asked.lists_trade_off {
            self.try_more(step, &mut search);
        }
        search.trade_off.sort_by_key(|it| it.extrema);
        search
    }

    /// The time until the next gain.
    fn patient(&self) -> Progress {
        match self.prepared.tolerance < self.prepared.noise {
            true => self.progress.hurried(HOPELESS_SHARE),
            false => self.progress.clone(),
        }
    }

    /// Find a number of extrema that keeps the tolerance, beginning with the one that a smoothed curve lets expect.
    fn expected(
        &self,
        [least, most]: [usize; 2],
        step: usize,
        search: &mut Search,
    ) -> Option<usize> {
        let task = self.task(0, None);
        let expected = task.estimated_extrema(most, self.prepared.tolerance)?;
        let progress = self.progress.hurried(EXPECTED_TIME);
        let hurried = Fit {
            progress: &progress,
            ..*self
        };
        let first = least + expected.saturating_sub(least).div_ceil(step) * step;
        let next = |extrema: &usize| Some(extrema + step + extrema / 4 / step * step);
        let numbers = std::iter::successors(Some(first), next);
        let mut numbers =
            numbers.take_while(|extrema| *extrema <= most && !progress.is_cancelled());
        numbers.find(|extrema| hurried.searched(*extrema, EXPECTED_FAR, search).keeps)
    }

    /// Find what a few more extrema than those of the best would reach, for the choice alone.
    fn try_more(&self, step: usize, search: &mut Search) {
        let Some(best) = &search.best else { return };
        let (first, tolerance) = (best.start.slopes.cuts.len(), self.prepared.tolerance);
        let progress = self.progress.limited(MORE_TIME);
        let mut fewer = vec![best.clone()];
        for extrema in (1..=MORE).map(|more| first + more * step) {
            if search.known.contains_key(&extrema) || self.progress.is_late() {
                continue;
            }
            let task = Task {
                progress: &progress,
                ..self.task(extrema, Some(tolerance))
            };
            let levels = task.levels(&fewer, &|_| ());
            fewer.extend(levels.last().cloned());
            search.known.insert(extrema, levels.clone());
            let (found, trade_off) = self.refined_choice(extrema, levels, true);
            search.trade_off.extend(trade_off);
            // Where nothing keeps the tolerance, the nearest counts.
            let nearest = search
                .best
                .as_ref()
                .map_or(0.0, |it| it.largest.max(tolerance));
            if found.as_ref().is_some_and(|it| it.largest < nearest) && nearest > tolerance {
                search.best = found;
            }
        }
    }

    /// Try numbers of extrema between one that misses the tolerance and one that keeps it.
    fn bisect(
        &self,
        [missed, kept]: [Option<usize>; 2],
        step: usize,
        far: f64,
        search: &mut Search,
    ) {
        let (Some(mut low), Some(mut high)) = (missed, kept) else {
            return;
        };
        while high > low + step && !self.progress.is_cancelled() {
            let middle = low + (high - low) / 2 / step * step;
            match self.searched(middle, far, search).keeps {
                true => high = middle,
                false => low = middle,
            }
        }
    }

    /// Try a number of extrema, and keep what is better than the best so far: what keeps the tolerance with fewer
    /// extrema, or else what is nearer. A number that misses it by more than the factor `far` and gains little is given up.
    fn searched(&self, extrema: usize, far: f64, search: &mut Search) -> Searched {
        let tolerance = self.prepared.tolerance;
        let fewer = search.fewer(extrema);
        let is_first = search.is_shown && search.best.is_none();
        let task = Task {
            far,
            ..self.task(extrema, Some(tolerance))
        };
        let levels = task.levels(&fewer, &|known| {
            if is_first {
                self.show_chosen(known, true);
            }
        });
        search.known.insert(extrema, levels.clone());
        let (found, trade_off) = self.refined_choice(extrema, levels, true);
        search.trade_off.retain(|row| row.extrema != extrema);
        search.trade_off.extend(trade_off);
        let distance =
            |level: &Option<Level>| level.as_ref().map_or(f64::INFINITY, |it| it.largest);
        let [now, before] = [distance(&found), distance(&search.best)];
        let keeps = now <= tolerance;
        if keeps || (now < before && before > tolerance) {
            if let Some(found) = found.as_ref().filter(|_| search.is_shown) {
                self.show(found);
            }
            search.best = found;
        }
        Searched {
            keeps,
            gains: now < GAIN * before,
            is_far: now > FAR * tolerance,
        }
    }

    /// The step between numbers of extrema, and the most.
    fn numbers(&self) -> (usize, usize) {
        let is_even = self.asked.periodic || self.asked.mirror.is_some();
        let step = if is_even { 2 } else { 1 };
        (step, MOST_EXTREMA.min(self.prepared.counting / 4))
    }

    fn trade_off(&self, extrema: usize, level: &Level) -> TradeOff {
        let unit = self.prepared.unit;
        TradeOff {
            extrema,
            vertices: level.splines.count,
            rms: unit * level.rms,
            largest: unit * level.largest,
        }
    }

    /// Of ever nearer levels the first handy one that keeps the tolerance if there is one, or else the one that
    /// explains the points best for its size (generalised cross validation: Craven and Wahba, 1979), a handy one if it
    /// does so nearly as well.
    fn chosen(&self, levels: Vec<Level>, is_for_tolerance: bool) -> Option<Level> {
        let tolerance = self.prepared.tolerance;
        let asked = self.asked.count;
        let levels = levels.into_iter();
        let levels = levels.filter(|it| asked.is_none_or(|count| it.splines.count == count));
        let levels: Vec<Level> = levels.collect();
        let score = |level: &Level| {
            let share = level.splines.count as f64 / self.prepared.counting as f64;
            level.rms.powi(2) / (1.0 - share.min(0.9)).powi(2)
        };
        let kept = |level: &&Level| is_for_tolerance && level.largest <= tolerance;
        let task = self.task(0, None);
        let handy = levels.iter().filter(kept).find(|it| task.is_handy(it));
        if let Some(level) = handy.or_else(|| levels.iter().find(kept)) {
            return Some(level.clone());
        }
        if is_for_tolerance {
            return levels
                .into_iter()
                .min_by(|a, b| a.largest.total_cmp(&b.largest));
        }
        let best = levels.iter().min_by(|a, b| score(a).total_cmp(&score(b)))?;
        let most = HANDIER.powi(2) * score(best);
        let handy = levels
            .iter()
            .filter(|it| score(it) <= most && task.is_handy(it));
        let handy = handy.min_by(|a, b| score(a).total_cmp(&score(b)));
        handy.or(Some(best)).cloned()
    }

    /// Show what would be chosen of the levels known so far.
    fn show_chosen(&self, known: &[Level], is_for_tolerance: bool) {
        if let Some(chosen) = self.chosen(known.to_vec(), is_for_tolerance) {
            self.show(&chosen);
        }
    }

    /// Show the best level so far.
    fn show(&self, level: &Level) {
        if let Ok(polygon) = self.polygon(level) {
            self.progress.show(polygon);
        }
    }

    /// Take a level back to where the points are.
    fn polygon(&self, level: &Level) -> Result<FloatPolygon, PolygonError> {
        let prepared = self.prepared;
        let vertices = level.start.curve.vertices.iter();
        let vertices =
            vertices.map(|vertex| (prepared.unit * *vertex + prepared.middle).extend(0.0));
        let vertices: Vec<DVec3> = vertices.collect();
        FloatPolygon::new(self.asked.degree, vertices, None, self.asked.periodic)
    }

    /// Take a level back to where the points are, correct it and measure it there.
    fn finished(
        &self,
        points: &[DVec2],
        level: &Level,
        corrected: &dyn Fn(&FloatPolygon, &[usize]) -> Option<FloatPolygon>,
    ) -> Result<Fitted, FitError> {
        let prepared = self.whole;
        let mut polygon = self.polygon(level)?;
        let prove = |polygon: &FloatPolygon| Features::proved(polygon, |_| true);
        let mut features = prove(&polygon).ok_or(FitError::Cancelled)?;
        let kinds = [Feature::CurvatureExtremum, Feature::Inflection];
        if let Some(other) = corrected(&polygon, &prepared.outliers).filter(|_| level.holds) {
            let own = prove(&other).ok_or(FitError::Cancelled)?;
            let is_same = |kind: Feature| own.count(kind) == features.count(kind);
            if own.undecided.is_empty() && kinds.into_iter().all(is_same) {
                (polygon, features) = (other, own);
            }
        }
        let distances = self.distances(points, level, &polygon);
        let counts = |index: &usize| prepared.outliers.binary_search(index).is_err();
        let kept: Vec<usize> = (0..points.len()).filter(counts).collect();
        let weight = |index: usize| match &self.asked.weights {
            Some(weights) => weights.get(index).copied().unwrap_or(0.0),
            None => 1.0,
        };
        let all: f64 = kept.iter().map(|it| weight(*it)).sum();
        let squares = kept.iter().map(|it| weight(*it) * distances[*it].powi(2));
        let square: f64 = squares.sum();
        let kept: Vec<f64> = kept.into_iter().map(|it| distances[it]).collect();
        let most = |distances: &[f64]| distances.iter().fold(0.0_f64, |most, it| most.max(*it));
        let outliers = prepared.outliers.iter();
        Ok(Fitted {
            holds: level.holds,
            extrema: features.count(Feature::CurvatureExtremum),
            inflections: features.count(Feature::Inflection),
            rms: (square / all.max(f64::MIN_POSITIVE)).sqrt(),
            deviation: most(&kept),
            largest: most(&distances),
            outliers: outliers.map(|index| (*index, distances[*index])).collect(),
            noise: prepared.unit * prepared.noise,
            tolerance: prepared.unit * prepared.tolerance,
            trade_off: Vec::new(),
            least_extrema: None,
            repeated: prepared.repeated.clone(),
            stopped: self.progress.is_late(),
            sharp_bend: sharp_bend(&polygon, &features, &self.placed(level), self.known_bends()),
            crossing: crossing_of(&polygon, points),
            uncrossed: Vec::new(),
            polygon,
        })
    }

    /// The points that count with their parameters, back where they are.
    fn placed(&self, level: &Level) -> Vec<(DVec2, f64)> {
        let (unit, middle) = (self.whole.unit, self.whole.middle);
        let placed = self.task_of_all(0, None).placed_points(level).into_iter();
        placed
            .map(|(point, u)| (unit * point + middle, u))
            .collect()
    }

    /// The ends whose curvature is asked for.
    fn known_bends(&self) -> [bool; 2] {
        End::BOTH.map(|end| {
            let mut own = self.whole.ends.iter().filter(|it| it.end == end);
            own.any(|it| matches!(it.value, EndValue::Curvature(_)))
        })
    }

    /// Fits about as near as a level that do not cross themselves: the one that exact ends make of it, and of others, within
    /// the tolerance if possible, the one with the fewest extrema.
    fn uncrossed(
        &self,
        points: &[DVec2],
        level: &Level,
        others: Vec<Level>,
        corrected: &dyn Fn(&FloatPolygon, &[usize]) -> Option<FloatPolygon>,
    ) -> Vec<Uncrossed> {
        let tolerance = self.prepared.tolerance;
        let most = ABOUT * tolerance.max(level.largest);
        let mut near: Vec<Level> = others
            .into_iter()
            .filter(|it| it.largest <= most)
            .map(|it| self.refined(it))
            .collect();
        near.sort_by(|a, b| {
            let rank = |it: &Level| (it.largest > tolerance, it.start.slopes.cuts.len());
            rank(a).cmp(&rank(b)).then(a.largest.total_cmp(&b.largest))
        });
        let passes = |level: &Level| {
            let polygon = self.polygon(level);
            level.holds
                && level.largest <= most
                && polygon.is_ok_and(|polygon| crossing_of(&polygon, points).is_none())
        };
        let exact = self.with_exact_ends(level).filter(passes);
        let other = near.into_iter().find(passes);
        let found = [(exact, true), (other, false)].into_iter();
        let found = found.filter_map(|(level, has_exact_ends)| {
            let fitted = self.finished(points, &level?, corrected).ok()?;
            Some(Uncrossed {
                fitted,
                has_exact_ends,
            })
        });
        found.collect()
    }

    /// The fit with exact ends that a level leads to, however little time is left.
    fn with_exact_ends(&self, level: &Level) -> Option<Level> {
        if self.asked.exact_ends == [true; 2] || self.asked.periodic || self.asked.mirror.is_some()
        {
            return None;
        }
        let progress = self.progress.without_limit();
        let task = self.task_of_all(level.start.slopes.cuts.len(), None);
        let (first, last) = (task.data.points.first()?, task.data.points.last()?);
        let is_point = |it: &EndCondition| matches!(it.value, EndValue::Point(_));
        let kept = task.data.ends.iter().copied().filter(|it| !is_point(it));
        let outer = [(End::Start, first), (End::Finish, last)];
        let points = outer.map(|(end, point)| EndCondition {
            end,
            value: EndValue::Point(*point),
        });
        let ends: Vec<EndCondition> = points.into_iter().chain(kept).collect();
        let task = Task {
            data: Data {
                ends: &ends,
                ..task.data
            },
            progress: &progress,
            ..task
        };
        Some(task.begun_at(level))
    }

    /// The distance of each point from the curve, looked for near the parameters of its neighbours.
    fn distances(&self, points: &[DVec2], level: &Level, polygon: &FloatPolygon) -> Vec<f64> {
        let prepared = self.whole;
        let places = &level.start.curve.places;
        let end = polygon.segments() as f64;
        let mut known = 0;
        let near = |point: DVec2| {
            let scaled = (point - prepared.middle) / prepared.unit;
            // The next point that counts is this one, or the one after a light one.
            let exact = prepared.points.iter().enumerate().skip(known).take(3);
            let mut exact = exact.filter(|(_, it)| **it == scaled);
            if let Some((index, _)) = exact.next() {
                known = index;
            }
            places.get(known).copied().unwrap_or_default()
        };
        let starts: Vec<f64> = points.iter().copied().map(near).collect();
        let distance = |(point, start): (&DVec2, f64)| {
            let point = point.extend(0.0);
            let nearest = |from: f64| {
                let bracket = match polygon.is_periodic() {
                    true => [from - 1.0, from + 1.0],
                    false => [(from - 1.0).max(0.0), (from + 1.0).min(end)],
                };
                let u = refined_parameter(point, from, bracket, |u| polygon.jet(u));
                polygon.point(u).distance(point)
            };
            nearest(start).min(polygon.point(start).distance(point))
        };
        points.iter().zip(starts).map(distance).collect()
    }
}
