//! Harmonising: the least change that leaves the requested features. The method is Batten's own.

use std::cmp::Ordering;

use glam::DVec3;

use super::counts::{CountRequest, ShapeCounts, counted, domain, seen, significant};
use super::problem::{Problem, Sweep};
use super::refitting::{fit_conditions, fitted};
use super::requirement::{Check, PlaceRequest, Requirement};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::harmony::unevenness;
use crate::geometry::progress::Progress;

pub use super::harmonised::{
    Harmonised, Harmony, HarmonyError, Held, farthest_move, flung, follows,
};

/// The weight ε at which the search begins.
const FIRST_CLOSENESS: f64 = 1e3;

/// The search ends at no larger weight ε than this: short waves give in before.
const LAST_CLOSENESS: f64 = 1e-12;

/// Beside a weight ε below this, √ε is lost in doubles.
const LEAST_CLOSENESS: f64 = 1e-24;

/// The factor between the weights of the first sweep.
const SWEEP: f64 = 0.1;

/// Precision of the largest ε, as a factor.
const FOUND: f64 = 1.2;

/// A move of the curve by less than this share of its size is near enough to fit nothing instead.
const NEAR: f64 = 1e-4;

/// A result whose discrete curvature follows the curve may be so many times as far as one whose does not.
const HARDLY_FARTHER: f64 = 1.25;

/// A result that moves no vertex by more than this share of the polygon's size may be farther than a fit whose polygon
/// is less even than it was: that is near, but no harmony.
const LITTLE: f64 = 5e-3;

/// The share of the time for the least change where a fit may follow.
const LEAST_CHANGE: f64 = 0.6;

/// The most steps for one ε.
const MOST_STEPS: usize = 20;

/// The orders of the differences of curvature that are tried: second differences straighten the
/// curvature, third ones keep a bend of it.
const ORDERS: [usize; 2] = [2, 3];

/// Move vertices as little as possible so that the requested features remain, proved.
///
/// Minimises Σ(ΔᵐK)² ℓ² + w Σ(Δ² log leg)² + ε Σ|P − P⁰|²/ℓ² with the ends held, K the discrete
/// curvature and ℓ the mean leg (in space with the torsion angles), for falling ε until the
/// features are those asked for, then for the largest such ε; m = 2 and 3 are tried, and the smaller
/// move is kept. Rational curves keep their weights. Where that moves a planar curve by more than 1e-4 of its size, or
/// does not do, a curve with these features is fitted to it, and the nearer one is kept: one whose polygon folds only if
/// it is 4 times nearer, one with an inflection where the curve turned only if it is 3 times nearer.
///
/// # Errors
/// [`HarmonyError`].
pub fn harmonise(
    polygon: &FloatPolygon,
    harmony: &Harmony,
    progress: &Progress,
) -> Result<Harmonised, HarmonyError> {
    let Some(kept) = fit_conditions(polygon, harmony) else {
        return least_change(polygon, harmony, progress);
    };
    let own = prove(polygon, progress)?;
    let best = least_change(polygon, harmony, &progress.hurried(LEAST_CHANGE))?;
    let mut best = best.with_displaced(polygon, &own, progress);
    let is_near = best.deviation <= NEAR * polygon.size();
    if best.reached && is_near && best.lacking() == 0 && best.displaced.is_none() {
        return Ok(best);
    }
    let iterations = best.iterations;
    let fitted = fitted(polygon, &own, harmony, kept, &best, progress);
    if !fitted.is_empty() {
        best.measure(polygon, progress);
    }
    let candidates = [vec![best], fitted].concat();
    let best = chosen(polygon, candidates, progress).ok_or(HarmonyError::Cancelled)?;
    Ok(Harmonised { iterations, ..best })
}

/// Choose the nearest of some results; of those that are hardly farther, one whose discrete curvature follows the curve.
/// Where a fit is the nearest, and less even than the polygon was, one that is as even and moves the curve little.
fn chosen(
    polygon: &FloatPolygon,
    mut candidates: Vec<Harmonised>,
    progress: &Progress,
) -> Option<Harmonised> {
    let rank = |it: &Harmonised| it.rank(polygon);
    candidates.sort_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal));
    let nearest = candidates.first()?.clone();
    if let Some(even) = more_even(polygon, &nearest, &candidates) {
        return Some(even.clone());
    }
    let (_, _, price) = rank(&nearest);
    let is_near = |it: &&Harmonised| {
        let (misses, flung, own) = rank(it);
        !misses && !flung && own <= HARDLY_FARTHER * price
    };
    if candidates.iter().filter(is_near).count() < 2 {
        return Some(nearest);
    }
    let mut near = candidates.iter().filter(is_near);
    let following = near.find(|it| follows(&it.polygon, progress) == Some(true));
    Some(following.cloned().unwrap_or(nearest))
}

/// The nearest result that has all features, moves the vertices little and is as even as the polygon before, if the nearest
/// of all is a fit that is less even.
fn more_even<'a>(
    polygon: &FloatPolygon,
    nearest: &Harmonised,
    candidates: &'a [Harmonised],
) -> Option<&'a Harmonised> {
    let is_whole = |it: &&Harmonised| {
        let (misses, flung, _) = it.rank(polygon);
        !misses && !flung && it.lacking() == 0 && it.displaced.is_none()
    };
    let is_little = |it: &&Harmonised| {
        let farthest = farthest_move(polygon, &it.polygon);
        farthest.is_none_or(|(_, distance)| distance <= LITTLE * polygon.size())
    };
    if !nearest.refitted {
        return None;
    }
    let before = unevenness(polygon)?;
    let is_even = |it: &Harmonised| unevenness(&it.polygon).is_some_and(|now| now <= before);
    if is_even(nearest) {
        return None;
    }
    let others = candidates.iter().filter(is_whole).filter(is_little);
    others.into_iter().find(|it| is_even(it))
}

/// Move vertices as little as possible, as [`harmonise`] does, and fit nothing instead.
///
/// # Errors
/// [`HarmonyError`].
pub fn least_change(
    polygon: &FloatPolygon,
    harmony: &Harmony,
    progress: &Progress,
) -> Result<Harmonised, HarmonyError> {
    let [begin, end] = domain(polygon);
    let stretch = harmony.stretch.unwrap_or([begin, end]);
    let [from, to] = stretch;
    if polygon.is_periodic() && begin <= to && to < from && from <= end {
        return over_the_seam(polygon, stretch, harmony, progress);
    }
    if !(begin <= stretch[0] && stretch[0] < stretch[1] && stretch[1] <= end) {
        return Err(HarmonyError::BadStretch {
            from,
            to,
            end,
            periodic: polygon.is_periodic(),
        });
    }
    let features = prove(polygon, progress)?;
    let own = significant(polygon, &features, stretch);
    let given = [
        harmony.inflections,
        harmony.extrema,
        harmony.torsion_extrema,
    ];
    let request = CountRequest {
        counts: ShapeCounts {
            inflections: given[0].unwrap_or(own.inflections),
            extrema: given[1].unwrap_or(own.extrema),
            torsion_extrema: given[2].unwrap_or(own.torsion_extrema),
        },
        exact: given.map(|count| count.is_some()),
    };
    let found = counted(&features, polygon.is_planar(), Some(stretch));
    let requirements = requirements(polygon, stretch, harmony, request);
    let unchanged = Harmonised {
        polygon: polygon.clone(),
        reached: found.has(request),
        requirements: requirements.clone(),
        request: request.counts,
        counts: found.counts,
        undecided: found.undecided,
        deviation: 0.0,
        bounded: true,
        iterations: 0,
        refitted: false,
        displaced: None,
    };
    if unchanged.reached {
        return Ok(unchanged);
    }
    let problem = |keeps_speed| {
        let mut problem = problem(polygon, stretch, harmony, keeps_speed);
        problem.end_with(progress);
        problem
    };
    let first = problem(false);
    if first.freedoms() == 0 {
        return Err(HarmonyError::NothingMoves);
    }
    let is_apart = |it: &&Requirement| !matches!(it, Requirement::Features { .. });
    let mut search = Search {
        problem: first,
        apart: requirements.iter().filter(is_apart).cloned().collect(),
        requirements: &requirements,
        harmony,
        stretch,
        request,
        most: harmony.largest_deviation.unwrap_or(f64::INFINITY),
        progress,
        best: Candidate {
            excess: found.excess(request),
            holds_apart: true,
            harmonised: unchanged,
            largest_move: 0.0,
        },
        spoils_ends: false,
        promising: None,
        polygon,
        iterations: 0,
    };
    // When the time is up the best so far counts.
    let unless_late = |result: Result<(), HarmonyError>| match result {
        Err(HarmonyError::Cancelled) if progress.is_late() => Ok(()),
        result => result,
    };
    unless_late(search.run_all([0.0, 0.5]))?;
    // Ends that turned round or stopped on the way keep their speeds, too.
    if search.spoils_ends && !search.best.harmonised.reached {
        search.problem = problem(true);
        unless_late(search.run_all([0.5, 0.5]))?;
    }
    let iterations = search.iterations;
    let best = search.best.harmonised;
    Ok(Harmonised { iterations, ..best })
}

/// What must hold, the deviation apart.
fn requirements(
    polygon: &FloatPolygon,
    stretch: [f64; 2],
    harmony: &Harmony,
    request: CountRequest,
) -> Vec<Requirement> {
    let places = ends(polygon, stretch, harmony).into_iter();
    let places = places.filter_map(|(u, held)| {
        let target = kept(polygon, u, held)?;
        Some(Requirement::Place(PlaceRequest {
            u,
            target,
            tolerance: None,
            speed: Some(polygon.jet(u).speed()),
        }))
    });
    let stays = |vertex: &usize| !moves(polygon, stretch, harmony, *vertex);
    let vertices = (0..polygon.vertices().len()).filter(stays);
    let vertices = vertices.map(|vertex| Requirement::Vertex {
        vertex,
        point: polygon.vertex(vertex),
    });
    let features = Requirement::Features {
        stretch: harmony.stretch,
        request,
    };
    [features]
        .into_iter()
        .chain(places)
        .chain(vertices)
        .collect()
}

/// Whether a vertex is free to move.
fn moves(polygon: &FloatPolygon, stretch: [f64; 2], harmony: &Harmony, vertex: usize) -> bool {
    !harmony.locked.contains(&vertex) && may_move(polygon, stretch, harmony.ends, vertex)
}

/// The vertices that move, and what is held, with the speeds at the ends if `keeps_speed`.
fn problem<'a>(
    polygon: &'a FloatPolygon,
    stretch: [f64; 2],
    harmony: &Harmony,
    keeps_speed: bool,
) -> Problem<'a> {
    let moves = |vertex| moves(polygon, stretch, harmony, vertex);
    let mut problem = Problem::new(polygon, polygon.is_planar(), moves);
    problem.count_only(|vertex| counts(polygon, stretch, harmony.ends, vertex));
    for (u, held) in ends(polygon, stretch, harmony) {
        if let Some(target) = kept(polygon, u, held) {
            let speed = keeps_speed.then(|| polygon.jet(u).speed());
            problem.hold(u, &target, speed);
        }
    }
    problem
}

fn prove(polygon: &FloatPolygon, progress: &Progress) -> Result<Features, HarmonyError> {
    let features = Features::proved(polygon, |_| !progress.is_cancelled());
    features.ok_or(HarmonyError::Cancelled)
}

/// Harmonise a stretch of a periodic curve that goes over the seam: the seam is put elsewhere meanwhile.
fn over_the_seam(
    polygon: &FloatPolygon,
    [from, to]: [f64; 2],
    harmony: &Harmony,
    progress: &Progress,
) -> Result<Harmonised, HarmonyError> {
    let first = from.floor();
    if first < to {
        return Err(HarmonyError::NothingBeyond { from, to });
    }
    let (count, seam) = (polygon.segments(), first as usize);
    let locked = harmony.locked.iter();
    let locked: Vec<usize> = locked
        .map(|vertex| (vertex + 2 * count - seam) % count)
        .collect();
    let harmony = Harmony {
        stretch: Some([from - first, to - first + count as f64]),
        locked: &locked,
        symmetry: None,
        ..harmony.clone()
    };
    let found = harmonise(&polygon.begun_at(seam), &harmony, progress)?;
    let requirements = found.requirements.into_iter();
    let requirements = requirements.map(|requirement| match requirement {
        Requirement::Features { request, .. } => Requirement::Features {
            stretch: Some([from, to]),
            request,
        },
        Requirement::Place(place) => Requirement::Place(PlaceRequest {
            u: (place.u + first).rem_euclid(count as f64),
            ..place
        }),
        Requirement::Vertex { vertex, point } => Requirement::Vertex {
            vertex: (vertex + seam) % count,
            point,
        },
        other => other,
    });
    Ok(Harmonised {
        polygon: found.polygon.begun_at(2 * count - seam),
        requirements: requirements.collect(),
        ..found
    })
}

/// The ends of a stretch with their held values; a whole periodic curve has none.
fn ends(polygon: &FloatPolygon, stretch: [f64; 2], harmony: &Harmony) -> Vec<(f64, Held)> {
    if polygon.is_periodic() && stretch == domain(polygon) {
        return Vec::new();
    }
    stretch.into_iter().zip(harmony.ends).collect()
}

/// Whether the harmony of a vertex counts: it acts on the stretch, or on what the stretch joins in
/// all derivatives.
fn counts(polygon: &FloatPolygon, stretch: [f64; 2], ends: [Held; 2], vertex: usize) -> bool {
    let acts = may_move(polygon, stretch, [Held::Free; 2], vertex);
    let end = vertex as f64 + 1.0;
    let before = end <= stretch[0];
    acts || ends[usize::from(!before)] == Held::All
}

/// Whether a vertex may move: its support [i − n, i + 1] meets the stretch, and does not reach beyond
/// an end where everything is held.
fn may_move(polygon: &FloatPolygon, stretch: [f64; 2], ends: [Held; 2], vertex: usize) -> bool {
    let length = polygon.segments() as f64;
    let whole = stretch == domain(polygon);
    if polygon.is_periodic() && whole {
        return true;
    }
    let support = |turn: f64| {
        let end = vertex as f64 + 1.0 + turn * length;
        [end - polygon.degree() as f64 - 1.0, end]
    };
    let fits = |[from, to]: [f64; 2]| {
        let inside = to > stretch[0] && from < stretch[1];
        let starts = ends[0] != Held::All || from >= stretch[0];
        let stops = ends[1] != Held::All || to <= stretch[1];
        inside && starts && stops
    };
    if polygon.is_periodic() {
        // Every turn of the support that meets the stretch must fit.
        let turns = [-1.0, 0.0, 1.0].map(support);
        let mut meeting = turns
            .into_iter()
            .filter(|[from, to]| *to > stretch[0] && *from < stretch[1])
            .peekable();
        meeting.peek().is_some() && meeting.all(fits)
    } else {
        fits(support(0.0))
    }
}

/// The held values of a curve at a parameter, as a target.
fn kept(polygon: &FloatPolygon, u: f64, held: Held) -> Option<EndTarget> {
    if held == Held::Free || held == Held::All {
        return None;
    }
    let (jet, planar) = (polygon.jet(u), polygon.is_planar());
    let from = |least: Held| held >= least;
    let normal = jet.first.cross(jet.second);
    let curvature = jet.curvature_of(planar);
    let slope = jet.curvature_slope(planar);
    Some(EndTarget {
        point: jet.point,
        direction: jet.tangent().filter(|_| from(Held::Direction)),
        curvature: Some(curvature).filter(|it| from(Held::Curvature) && it.is_finite()),
        normal: Some(normal).filter(|it| !planar && from(Held::Curvature) && *it != DVec3::ZERO),
        slope: Some(slope).filter(|it| from(Held::Slope) && it.is_finite()),
    })
}

/// A polygon that was found.
struct Candidate {
    harmonised: Harmonised,
    /// The number of features too many or too few, with the undecided ones.
    excess: usize,
    /// Whether all but the features holds.
    holds_apart: bool,
    largest_move: f64,
}

impl Candidate {
    /// Distance from the request; the largest move decides between equals.
    fn rank(&self) -> (bool, bool, usize, f64) {
        let missed = !self.harmonised.reached;
        let change = self.harmonised.priced(self.largest_move);
        (missed, !self.holds_apart, self.excess, change)
    }
}

/// Comparison of the counts after one ε with the request.
#[derive(Clone, Copy, PartialEq)]
enum CountVerdict {
    /// More features of some kind than requested, or undecided places.
    TooMany,
    /// The requested features.
    Met,
    /// Too few of some kind, too many of none.
    TooFew,
}

struct Search<'a> {
    problem: Problem<'a>,
    requirements: &'a [Requirement],
    /// All of them but the features.
    apart: Vec<Requirement>,
    polygon: &'a FloatPolygon,
    harmony: &'a Harmony<'a>,
    stretch: [f64; 2],
    request: CountRequest,
    most: f64,
    progress: &'a Progress,
    best: Candidate,
    /// Whether a polygon with the features asked for has lost the ends.
    spoils_ends: bool,
    /// The closest polygon that misses the request, and its number of features too many.
    promising: Option<(usize, FloatPolygon)>,
    iterations: usize,
}

impl Search<'_> {
    /// Search with differences of all orders. `[done, work]` are shares of the progress.
    fn run_all(&mut self, [done, work]: [f64; 2]) -> Result<(), HarmonyError> {
        let work = work / ORDERS.len() as f64;
        for (index, order) in ORDERS.into_iter().enumerate() {
            self.run(order, [done + work * index as f64, work])?;
        }
        self.prove_most_promising()
    }

    /// Search with differences of one order. `[done, work]` are shares of the progress.
    fn run(&mut self, order: usize, [done, work]: [f64; 2]) -> Result<(), HarmonyError> {
        let sweeps = self.problem.sweeps(order);
        let share = work / sweeps.len() as f64;
        for (index, sweep) in sweeps.iter().enumerate() {
            self.sweep(sweep, [done + share * index as f64, share])?;
        }
        Ok(())
    }

    /// Reduce ε until the request is met. `[done, work]` are shares of the progress.
    fn sweep(&mut self, sweep: &Sweep, [done, work]: [f64; 2]) -> Result<(), HarmonyError> {
        let (first, last) = (FIRST_CLOSENESS, self.last_closeness(sweep.order));
        let decades = (last / first).ln() / SWEEP.ln();
        let mut vertices = sweep.begin.clone();
        let mut closeness = first;
        while closeness >= 0.999 * last {
            let share = (closeness / first).ln() / SWEEP.ln() / decades;
            self.progress.set_done(done + work * share);
            if !sweep.goes_on {
                vertices.clone_from(&sweep.begin);
            }
            let before = vertices.clone();
            let found = self.try_out(sweep, closeness, &mut vertices)?;
            let between = [closeness, closeness / SWEEP];
            if found != CountVerdict::TooMany && self.narrow(sweep, between, found, before)? {
                return Ok(());
            }
            closeness *= SWEEP;
        }
        Ok(())
    }

    /// The weight ε at which a sweep ends: moves in a wave as long as the polygon of N vertices count
    /// then no more than its differences of curvature do, about (2π/N)^(2m + 4).
    fn last_closeness(&self, order: usize) -> f64 {
        let longest = std::f64::consts::TAU / self.polygon.vertices().len() as f64;
        let least = longest.powi(2 * order as i32 + 4);
        least.clamp(LEAST_CLOSENESS, LAST_CLOSENESS)
    }

    /// Find the largest ε that leaves what is asked, between one that leaves no more and one that
    /// leaves more; tell whether there is one.
    fn narrow(
        &mut self,
        sweep: &Sweep,
        [mut low, mut high]: [f64; 2],
        found: CountVerdict,
        begin: Vec<DVec3>,
    ) -> Result<bool, HarmonyError> {
        let mut reached = found == CountVerdict::Met;
        while high / low > FOUND {
            let middle = (high * low).sqrt();
            let mut vertices = begin.clone();
            let found = self.try_out(sweep, middle, &mut vertices)?;
            reached |= found == CountVerdict::Met;
            match found {
                CountVerdict::TooMany => high = middle,
                CountVerdict::Met | CountVerdict::TooFew => low = middle,
            }
        }
        Ok(reached)
    }

    /// Descend for one ε, and compare the features with the request.
    fn try_out(
        &mut self,
        sweep: &Sweep,
        closeness: f64,
        vertices: &mut Vec<DVec3>,
    ) -> Result<CountVerdict, HarmonyError> {
        if self.progress.is_cancelled() {
            return Err(HarmonyError::Cancelled);
        }
        let objective = self.problem.harmony(sweep.measure, sweep.order, closeness);
        let found = self.problem.descend(objective, vertices, MOST_STEPS);
        self.iterations += found.steps;
        *vertices = found.vertices;
        let Ok(polygon) = self.problem.polygon(vertices) else {
            return Ok(CountVerdict::TooMany);
        };
        let polygon = self.harmony.completed(polygon);
        // What samples show already needs no proof.
        let looks = seen(&polygon, self.stretch);
        if looks.exceeds(self.request.counts) {
            let excess = looks.distance(self.request);
            if self
                .promising
                .as_ref()
                .is_none_or(|(least, _)| excess < *least)
            {
                self.promising = Some((excess, polygon));
            }
            return Ok(CountVerdict::TooMany);
        }
        self.rank(polygon)
    }

    /// Prove the polygon that looked closest, unless the request is met.
    fn prove_most_promising(&mut self) -> Result<(), HarmonyError> {
        match self.promising.take() {
            Some((_, polygon)) if !self.best.harmonised.reached => self.rank(polygon).map(drop),
            _ => Ok(()),
        }
    }

    /// Prove a polygon, keep it if it is better, and compare it with the request.
    fn rank(&mut self, polygon: FloatPolygon) -> Result<CountVerdict, HarmonyError> {
        let features = prove(&polygon, self.progress)?;
        let proved = counted(&features, polygon.is_planar(), Some(self.stretch));
        let deviation = self.polygon.deviation(&polygon)?;
        let check = |requirements: &[Requirement]| {
            Check::with_features(requirements, &polygon, Some(&features)).holds
        };
        let holds_apart = check(&self.apart);
        let requirements = [
            self.requirements,
            &[Requirement::Limit {
                found: deviation,
                most: self.most,
            }],
        ]
        .concat();
        let reached = check(&requirements);
        let moves = self.polygon.vertices().iter().zip(polygon.vertices());
        let moves = moves.map(|(before, after)| before.distance(*after));
        let has = proved.has(self.request);
        self.spoils_ends |= has && !holds_apart;
        let candidate = Candidate {
            excess: proved.excess(self.request),
            holds_apart,
            largest_move: moves.fold(0.0, f64::max),
            harmonised: Harmonised {
                polygon,
                reached,
                requirements,
                request: self.request.counts,
                counts: proved.counts,
                undecided: proved.undecided,
                deviation,
                bounded: true,
                iterations: self.iterations,
                refitted: false,
                displaced: None,
            },
        };
        if candidate.rank() < self.best.rank() {
            let better = candidate.harmonised.polygon.clone();
            self.progress.show(better);
            self.best = candidate;
        }
        Ok(if has && holds_apart {
            CountVerdict::Met
        } else if has {
            CountVerdict::TooFew
        } else if proved.undecided > 0 || proved.counts.exceeds(self.request.counts) {
            CountVerdict::TooMany
        } else {
            CountVerdict::TooFew
        })
    }
}
