//! Fits with a wished number of extrema, from few vertices to many.

use glam::{DVec2, DVec3};

use super::descent::descend;
use super::estimate::estimated_extrema;
use super::first_places::{closed_shares, open_shares};
use super::problem::{Data, PlacedCurve, Problem, Start};
use super::sharp_bend::has_cusp;
use super::sign_runs::SignRuns;
use super::slope_coefficients::SlopeTables;
use super::splines::Splines;
use super::winding::{hooks, spikes, winds};
use crate::geometry::end::End;
use crate::geometry::features::{Feature, Features};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_figures::{FOLD, turning_angles};
use crate::geometry::progress::Progress;

/// The factor between the numbers of segments of two levels.
const GROWTH: f64 = 1.35;

/// The middle of a symmetric curve is a point near the axis, which costs so much a share away from the middle of all
/// points; no half is shorter than this share.
const AWAY: f64 = 0.1;
const MIDDLE: f64 = 0.2;

/// Steps of a level that begins at the one before, of its second try, and of a fresh start.
const WARM_STEPS: usize = 20;
const SECOND_STEPS: usize = 40;
const FRESH_STEPS: usize = 30;

/// The share of turning in the first parameters and the weight of fairness, of two fresh starts.
const STARTS: [(f64, f64); 2] = [(0.5, 1e-4), (0.3, 1e-2)];

/// Rounds of least squares of a fresh start.
const ROUNDS: usize = 6;

/// Levels that begin afresh too, from which level on only one of both beginning signs, or only the first start.
const FRESH: [usize; 3] = [0, 2, 4];
const ONE_SIGN: usize = 3;
const ONE_START: usize = 5;

/// Levels with fewer vertices that the number asked for begins at.
const ASKED_STARTS: usize = 4;

/// With more vertices than these, levels that bring nothing are left out.
const MANY: usize = 80;

/// An error above this share of the one before is no gain; so many of them in a row end the search.
const GAIN: f64 = 0.97;
const STALE: usize = 3;

/// A vertex farther than so many sizes from the points can hardly be dragged.
const FAR_VERTEX: f64 = 3.0;

/// An error below this share of the size is rounding.
const EXACT: f64 = 1e-9;

/// A tolerance that is missed by less than this factor is made a condition, for so many steps.
const CLOSE: f64 = 4.0;
const WITHIN_STEPS: usize = 30;

/// Steps from a level that is fitted to more points, or with more vertices and fewer extrema.
const REFINING_STEPS: usize = 10;

/// From this level on, a tolerance that is missed by far with less than that gain is given up.
const FAR_LEVEL: usize = 3;
pub(super) const FAR: f64 = 8.0;
const FAR_GAIN: f64 = 0.85;

/// Extrema nearer to each other or to an end than this share of a segment are none to the eye.
const VISIBLE: f64 = 0.02;

/// Steps to the nearest places of points whose places are known roughly.
const PROJECTIONS: usize = 8;

/// An arc between two points that is longer than so many times the chord and the offsets is a loop.
const LOOP: f64 = 2.0;

/// The chords by which the arc between two points is measured.
const ARC_PARTS: usize = 8;

/// Multipliers below this share of the largest do not count as pressing where a run may be released, and runs of
/// them with a gap of less than so many members are one.
const PRESSING: f64 = 1e-4;
const GAP: usize = 6;

/// The members at an end that make a run one of the end, and the most releases that are tried.
const END: usize = 6;
const RELEASES: usize = 3;

/// What is fitted, and with how many extrema.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) data: Data<'a>,
    pub(super) degree: usize,
    pub(super) periodic: bool,
    pub(super) extrema: usize,
    pub(super) inflections: Option<usize>,
    /// The number of vertices; `None` for as many as it takes.
    pub(super) count: Option<usize>,
    /// The most vertices.
    pub(super) most: usize,
    /// The largest distance of a point.
    pub(super) tolerance: Option<f64>,
    /// From the fourth level on, a tolerance that is missed by more than this factor and gains little is given up;
    /// nothing is pressed within it then.
    pub(super) far: f64,
    /// A curve with the number of vertices asked for, from which held ones are taken.
    pub(super) known: Option<&'a PlacedCurve>,
    pub(super) tables: &'a SlopeTables,
    pub(super) progress: &'a Progress,
}

/// A fit with one number of vertices.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) splines: Splines,
    pub(super) start: Start,
    /// Whether the curve holds all that is asked for, proved.
    pub(super) holds: bool,
    pub(super) rms: f64,
    pub(super) largest: f64,
    press: Vec<f64>,
}

impl Level {
    /// The float polygon.
    pub(super) fn polygon(&self) -> Option<FloatPolygon> {
        let vertices = self.start.curve.vertices.iter();
        let vertices = vertices
            .map(|vertex| vertex.extend(0.0))
            .collect::<Vec<DVec3>>();
        FloatPolygon::new(self.splines.degree, vertices, None, self.splines.periodic).ok()
    }

    /// The better of two: that which holds, then the nearer one.
    fn or(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if (other.holds, -other.rms) > (self.holds, -self.rms) => other,
            _ => self,
        }
    }
}

impl<'a> Task<'a> {
    /// The least number of vertices that is tried.
    fn least(&self) -> usize {
        let degree = self.degree;
        if self.periodic {
            return (degree + 3).max(2 * self.extrema + 4);
        }
        (degree + 4).max(self.extrema + 6)
    }

    /// Find fits with ever more vertices, each nearer than the one before. `fewer` are fits with fewer extrema,
    /// which begin others where one of their runs of conditions gets the other sign.
    ///
    /// Each level begins at the best one so far, resampled; some of the first ones, and those that fail, at the
    /// patterns of smoothed curves too. Returns the levels that hold, the nearest last; `tell` gets those known so far.
    pub(super) fn levels(&self, fewer: &[Level], tell: &dyn Fn(&[Level])) -> Vec<Level> {
        let mut levels: Vec<Level> = Vec::new();
        let most = self.count.unwrap_or(self.most);
        let least = self.least().min(most);
        let size = size(self.data.points);
        let (mut count, mut stale, mut level) = (least, 0, 0);
        // How many levels there were when the tolerance was tried last.
        let mut tried = None;
        loop {
            let found = self.level(count, level, &levels, fewer, count == most);
            level += 1;
            let (before, known) = (levels.last().map(|it| it.rms), levels.len());
            let found = found.filter(|found| found.holds);
            let mut gain = 1.0;
            match found {
                Some(found) if before.is_none_or(|before| found.rms < before) => {
                    gain = before.map_or(0.0, |before| found.rms / before);
                    stale = if gain > GAIN { stale + 1 } else { 0 };
                    levels.push(found);
                }
                Some(found) if self.count == Some(count) => levels.push(found),
                _ => stale += usize::from(before.is_some()),
            }
            if levels.len() > known {
                tell(&levels);
            }
            if self.progress.is_cancelled() {
                break;
            }
            let is_far = self.tolerance.is_some_and(|tolerance| {
                let far = |best: &Level| best.largest > self.far * tolerance && gain > FAR_GAIN;
                level >= FAR_LEVEL && levels.last().is_none_or(far)
            });
            let ends = count >= most || is_far || (stale >= STALE && self.count.is_none());
            if let (Some(best), Some(tolerance)) = (levels.last(), self.tolerance) {
                let close = CLOSE.min(self.far) * tolerance;
                let is_close = best.largest > tolerance && best.largest < close;
                let is_new = tried != Some(levels.len());
                if is_close && is_new && (ends || stale >= 1) {
                    tried = Some(levels.len());
                    let nearer = self.within(best, tolerance);
                    if nearer.largest <= tolerance {
                        levels.push(nearer);
                        break;
                    }
                }
                if best.largest <= tolerance && self.count.is_none() && self.is_handy(best) {
                    break;
                }
            }
            if levels.last().is_some_and(|best| best.rms < EXACT * size) && self.count.is_none() {
                break;
            }
            if ends {
                break;
            }
            // Where more vertices bring nothing, the number asked for comes next.
            count = match stale >= STALE && count > MANY {
                true => most,
                false => self.next_count(count).min(most),
            };
        }
        levels
    }

    /// Whether all vertices lie near the points and the polygon does not fold. With few segments it may.
    pub(super) fn is_handy(&self, level: &Level) -> bool {
        let points = self.data.points.iter().copied();
        let low = points.clone().fold(DVec2::INFINITY, DVec2::min);
        let high = points.fold(DVec2::NEG_INFINITY, DVec2::max);
        let far = FAR_VERTEX * low.distance(high);
        let mut vertices = level.start.curve.vertices.iter();
        let is_near = |vertex: &DVec2| vertex.distance(vertex.clamp(low, high)) <= far;
        let folds = |polygon: &FloatPolygon| turning_angles(polygon).any(|(_, angle)| angle > FOLD);
        vertices.all(is_near) && !level.polygon().is_some_and(|polygon| folds(&polygon))
    }

    /// The fit with any number of extrema: least squares with a little fairness.
    pub(super) fn smoothed(&self) -> Option<Level> {
        let count = self.count.unwrap_or(self.most);
        // As many vertices as points meet them, so that the light ones must not count.
        let heavy = self.data.without_light();
        let meets = count >= heavy.iter().filter(|weight| **weight > 0.0).count();
        let weights = if meets { &heavy } else { self.data.weights };
        let problem = Problem::new(
            Data {
                weights,
                ..self.data
            },
            self.splines(count),
            self.tables,
        );
        let curves = STARTS.iter().filter_map(|(bend, fair)| {
            let (fair, rounds) = if meets { (0.0, 1) } else { (*fair, ROUNDS) };
            let curve = problem.smoothed(self.first_places(&problem, *bend), fair, rounds)?;
            let [rms, largest] = problem.errors(&curve);
            let slopes = SignRuns {
                begins_positive: true,
                cuts: Vec::new(),
            };
            Some(Level {
                splines: problem.splines,
                start: Start {
                    curve,
                    slopes,
                    bends: None,
                },
                holds: false,
                rms,
                largest,
                press: Vec::new(),
            })
        });
        curves.min_by(|a, b| a.rms.total_cmp(&b.rms))
    }

    /// Estimate the fewest extrema, of so many at most, that a tolerance takes, from the smoothed curve with the fewest
    /// vertices that keeps it.
    pub(super) fn estimated_extrema(&self, most: usize, tolerance: f64) -> Option<usize> {
        let [(bend, fair), _] = STARTS;
        let last = self.count.unwrap_or(self.most);
        let mut count = (self.degree + 4).min(last);
        loop {
            let problem = self.problem(count);
            let curve = problem.smoothed(self.first_places(&problem, bend), fair, ROUNDS)?;
            let [_, largest] = problem.errors(&curve);
            if largest <= tolerance || count >= last {
                let near = tolerance.max(largest);
                return Some(estimated_extrema(&problem, &curve.vertices, most, near));
            }
            count = self.next_count(count).min(last);
        }
    }

    /// Measure a straight line.
    pub(super) fn line(&self, count: usize, vertices: Vec<DVec2>, places: Vec<f64>) -> Level {
        let problem = self.problem(count);
        let mut curve = PlacedCurve { vertices, places };
        problem.project(&mut curve, PROJECTIONS);
        let [rms, largest] = problem.errors(&curve);
        let slopes = SignRuns {
            begins_positive: true,
            cuts: Vec::new(),
        };
        Level {
            splines: problem.splines,
            start: Start {
                curve,
                slopes,
                bends: None,
            },
            holds: true,
            rms,
            largest,
            press: Vec::new(),
        }
    }

    /// Fit with these conditions, from a level of others.
    pub(super) fn begun_at(&self, level: &Level) -> Level {
        let problem = self.problem(level.splines.count);
        self.attempt(&problem, level.start.clone(), SECOND_STEPS)
    }

    /// Fit a level to these points, from their parameters.
    pub(super) fn refined(&self, level: Level, places: Vec<f64>) -> Level {
        let problem = self.problem(level.splines.count);
        let mut start = level.start.clone();
        start.curve.places = places;
        problem.project(&mut start.curve, PROJECTIONS);
        let [rms, largest] = problem.errors(&start.curve);
        let known = Level {
            start: start.clone(),
            rms,
            largest,
            ..level
        };
        known.or(Some(self.attempt(&problem, start, REFINING_STEPS)))
    }

    fn next_count(&self, count: usize) -> usize {
        let tail = if self.periodic { 0 } else { self.degree };
        let more = (GROWTH * (count - tail) as f64).round() as usize + tail;
        more.max(count + 1)
    }

    fn problem(&self, count: usize) -> Problem<'a> {
        let held = if self.count == Some(count) {
            self.data.held
        } else {
            &[]
        };
        Problem::new(Data { held, ..self.data }, self.splines(count), self.tables)
    }

    fn splines(&self, count: usize) -> Splines {
        Splines {
            degree: self.degree,
            count,
            periodic: self.periodic,
        }
    }

    /// The best fit found with one number of vertices.
    fn level(
        &self,
        count: usize,
        level: usize,
        known: &[Level],
        fewer: &[Level],
        is_last: bool,
    ) -> Option<Level> {
        let problem = self.problem(count);
        let mut found: Option<Level> = None;
        let better = |found: &mut Option<Level>, it: Level| {
            *found = Some(it.or(found.take()));
        };
        let is_asked = self
            .count
            .is_some_and(|asked| asked == count || self.known.is_none());
        let is_asked = is_asked && count <= MANY;
        // A number that is asked for must be as near as those with fewer vertices, so that these are tried as hard.
        let tried = if is_asked { ASKED_STARTS } else { 1 };
        for best in known.iter().rev().take(tried) {
            let before = self.problem(best.splines.count);
            if let Some(start) = problem.resampled(&before, &best.start) {
                let first = self.attempt(&problem, start, WARM_STEPS);
                if is_asked || !first.holds || first.rms > best.rms {
                    let start = first.start.clone();
                    better(&mut found, self.attempt(&problem, start, SECOND_STEPS));
                }
                better(&mut found, first);
            }
        }
        if FRESH.contains(&level) || is_asked || !found.as_ref().is_some_and(|it| it.holds) {
            let starts = if level < ONE_START || is_asked {
                &STARTS[..]
            } else {
                &STARTS[..1]
            };
            for (bend, fair) in starts {
                let signs = if level < ONE_SIGN || is_asked { 2 } else { 1 };
                for start in self.fresh(&problem, *bend, *fair).into_iter().take(signs) {
                    if self.progress.is_cancelled() {
                        return found;
                    }
                    better(&mut found, self.attempt(&problem, start, FRESH_STEPS));
                }
            }
        }
        let own = self
            .known
            .filter(|_| self.count == Some(count) && !self.data.held.is_empty())
            .cloned();
        for start in own
            .into_iter()
            .flat_map(|own| self.starts_at(&problem, own))
        {
            better(&mut found, self.attempt(&problem, start, FRESH_STEPS));
        }
        for less in fewer {
            let near = less.splines.count as f64 > 0.6 * count as f64 || is_last;
            if less.splines.count <= count && near {
                for released in self.released(&problem, less) {
                    better(&mut found, self.attempt(&problem, released, FRESH_STEPS));
                }
            }
        }
        found
    }

    /// The first parameters of the points.
    fn first_places(&self, problem: &Problem, bend: f64) -> Vec<f64> {
        let points = self.data.points;
        let shares = match self.periodic {
            true => closed_shares(points, bend),
            false => open_shares(points, bend),
        };
        let end = problem.splines.end();
        let middle = self.data.mirror.map(|mirror| {
            let places = points.iter().zip(&shares);
            let off = |(point, share): &(&DVec2, &f64)| {
                mirror.onto_axis(**point).distance(**point) + AWAY * (**share - 0.5).abs()
            };
            let nearest = places.min_by(|a, b| off(a).total_cmp(&off(b)));
            nearest.map_or(0.5, |(_, share)| share.clamp(MIDDLE, 1.0 - MIDDLE))
        });
        // Both halves are as long.
        let placed = |share: f64| match middle {
            Some(middle) if share < middle => 0.5 * share / middle,
            Some(middle) => 0.5 + 0.5 * (share - middle) / (1.0 - middle),
            None => share,
        };
        shares
            .into_iter()
            .map(|share| placed(share) * end)
            .collect()
    }

    /// Starts at the patterns of a smoothed curve.
    fn fresh(&self, problem: &Problem, bend: f64, fair: f64) -> Vec<Start> {
        let places = self.first_places(problem, bend);
        let Some(curve) = problem.smoothed(places, fair, ROUNDS) else {
            return Vec::new();
        };
        self.starts_at(problem, curve)
    }

    /// Starts at the patterns of a curve.
    fn starts_at(&self, problem: &Problem, curve: PlacedCurve) -> Vec<Start> {
        let bends = self.inflections;
        let bends = bends.map(|inflections| problem.bend_runs(&curve.vertices, inflections));
        let runs = problem.slope_runs(&curve.vertices, self.extrema);
        let start = |slopes| Start {
            curve: curve.clone(),
            slopes,
            bends: bends.clone(),
        };
        runs.into_iter().map(start).collect()
    }

    fn attempt(&self, problem: &Problem, start: Start, steps: usize) -> Level {
        self.attempt_within(problem, start, None, steps)
    }

    /// Step down from a start, and prove and measure what is found.
    fn attempt_within(
        &self,
        problem: &Problem,
        start: Start,
        limit: Option<f64>,
        steps: usize,
    ) -> Level {
        let descended = descend(problem, start, limit, steps, self.progress);
        let [rms, largest] = problem.errors(&descended.start.curve);
        let mut level = Level {
            splines: problem.splines,
            holds: descended.holds,
            start: descended.start,
            rms,
            largest,
            press: descended.press,
        };
        level.holds = level.holds && self.is_proved(&level);
        level
    }

    /// Whether the curve winds between its points: by a loop, or by turns that they do not show.
    pub(super) fn winds_between(
        &self,
        polygon: &FloatPolygon,
        level: &Level,
        points: &[(DVec2, f64)],
    ) -> bool {
        loops(&self.problem(level.splines.count), &level.start) || winds(polygon, points)
    }

    /// The points that count with their parameters; those of a ring end with the first one.
    pub(super) fn placed_points(&self, level: &Level) -> Vec<(DVec2, f64)> {
        let places = &level.start.curve.places;
        let points = self.data.points.iter().copied().zip(places.iter().copied());
        let heavy = points.zip(self.data.counts).filter(|(_, counts)| **counts);
        let mut heavy: Vec<(DVec2, f64)> = heavy.map(|(placed, _)| placed).collect();
        if self.periodic {
            heavy.extend(heavy.first().copied());
        }
        heavy
    }

    /// Whether the curve has just the features asked for, and does not go astray.
    fn is_proved(&self, level: &Level) -> bool {
        let Some(polygon) = level.polygon() else {
            return false;
        };
        let points = self.placed_points(level);
        let problem = self.problem(level.splines.count);
        let known = End::BOTH.map(|end| problem.bends_at(end));
        if self.winds_between(&polygon, level, &points)
            || hooks(&polygon, &points)
            || spikes(&polygon, &points, known)
        {
            return false;
        }
        let features = Features::proved(&polygon, |_| !self.progress.is_cancelled());
        features.is_some_and(|features| {
            if has_cusp(&polygon, &features, &points, known) {
                return false;
            }
            let inflections = features.count(Feature::Inflection);
            let extrema = features.curvature_extrema.iter();
            let mut places: Vec<f64> = extrema.map(|it| 0.5 * (it.u[0] + it.u[1])).collect();
            if !self.periodic {
                places.insert(0, 0.0);
                places.push(level.splines.end());
            }
            let are_visible = places.windows(2).all(|pair| pair[1] - pair[0] > VISIBLE);
            are_visible
                && features.undecided.is_empty()
                && features.count(Feature::CurvatureExtremum) == self.extrema
                && self.inflections.is_none_or(|asked| asked == inflections)
        })
    }

    /// Search for a curve near a level that keeps the tolerance.
    fn within(&self, level: &Level, tolerance: f64) -> Level {
        let problem = self.problem(level.splines.count);
        let start = level.start.clone();
        let nearer = self.attempt_within(&problem, start, Some(tolerance), WITHIN_STEPS);
        match nearer.holds && nearer.largest < level.largest {
            true => nearer,
            false => level.clone(),
        }
    }

    /// Starts at a fit with fewer extrema: the runs of conditions that press most get the other sign.
    fn released(&self, problem: &Problem, less: &Level) -> Vec<Start> {
        let known = self.problem(less.splines.count);
        let fewer = Task {
            extrema: less.start.slopes.cuts.len(),
            ..*self
        };
        let base = if less.splines.count == problem.splines.count {
            less.clone()
        } else {
            let Some(start) = problem.resampled(&known, &less.start) else {
                return Vec::new();
            };
            fewer.attempt(problem, start, REFINING_STEPS)
        };
        let more = self.extrema.saturating_sub(fewer.extrema);
        let runs = released_runs(&base, more, self.data.mirror.is_some()).into_iter();
        runs.map(|slopes| Start {
            slopes: problem.spread_slopes(slopes),
            ..base.start.clone()
        })
        .collect()
    }
}

/// The signs with one or two more changes in which a run that presses gets the other sign.
fn released_runs(level: &Level, more: usize, is_symmetric: bool) -> Vec<SignRuns> {
    let (press, runs) = (&level.press, &level.start.slopes);
    let members = press.len();
    let signs = runs.signs(members);
    let most = press
        .iter()
        .fold(f64::MIN_POSITIVE, |most, it| most.max(*it));
    let mut pressing: Vec<(f64, usize, usize)> = Vec::new();
    for member in (0..members).filter(|member| press[*member] > PRESSING * most) {
        match pressing.last_mut() {
            Some((sum, _, end)) if member < *end + GAP && signs[member] == signs[*end - 1] => {
                *sum += press[member];
                *end = member + 1;
            }
            _ => pressing.push((press[member], member, member + 1)),
        }
    }
    pressing.sort_by(|a, b| b.0.total_cmp(&a.0));
    let with = |begins_positive: bool, added: &[usize]| {
        let mut cuts = [&runs.cuts, added].concat();
        cuts.sort_unstable();
        SignRuns {
            begins_positive,
            cuts,
        }
    };
    let mut released = Vec::new();
    for (_, begin, end) in pressing {
        let is_free = |cut: &usize| [begin, end].iter().all(|it| it.abs_diff(*cut) >= 2);
        let at_start = begin < END;
        let at_end = end + END > members;
        let image = |cut: usize| members - cut;
        match more {
            2 if is_symmetric && at_start => {
                released.push(with(!runs.begins_positive, &[end, image(end)]));
            }
            _ if is_symmetric => {}
            1 if at_start => released.push(with(!runs.begins_positive, &[end])),
            1 if at_end => released.push(with(runs.begins_positive, &[begin])),
            2 if !at_start && !at_end && runs.cuts.iter().all(is_free) => {
                released.push(with(runs.begins_positive, &[begin, end]));
            }
            _ => {}
        }
    }
    released.truncate(RELEASES);
    released
}

/// Whether the curve goes astray between two points.
fn loops(problem: &Problem, start: &Start) -> bool {
    let offsets = problem.offsets(&start.curve);
    let points = problem.data.points.windows(2);
    let places = start.curve.places.windows(2).zip(offsets.windows(2));
    points.zip(places).any(|(points, (places, offsets))| {
        let part = |index: usize| {
            let share = index as f64 / ARC_PARTS as f64;
            let u = places[0] + share * (places[1] - places[0]);
            problem.splines.point(&start.curve.vertices, u)
        };
        let arc: f64 = (0..ARC_PARTS)
            .map(|it| part(it).distance(part(it + 1)))
            .sum();
        let straight = points[0].distance(points[1]) + offsets[0].length() + offsets[1].length();
        places[1] >= places[0] && arc > LOOP * straight
    })
}

/// The diagonal of the box of points.
pub(super) fn size(points: &[DVec2]) -> f64 {
    let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points
        .iter()
        .fold(none, |(low, high), it| (low.min(*it), high.max(*it)));
    low.distance(high)
}
