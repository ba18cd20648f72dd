//! Several segments that meet with one curvature, for two ends with curvatures.
//!
//! Of two log-aesthetic segments the first takes the curvature from that of the start to one between
//! the two, and the second from there to that of the end: the curvature of both together is monotone.
//! The unknowns are the curvature between and the first segment's share of the turning, for the two
//! coordinates of the chord; both segments have one α. Without a given α they have −1 + e and −1 − e, and
//! e takes the place of the curvature as an unknown: the curvature may then fall fast, slowly and fast
//! again, or the other way round, which one α does not allow.
//!
//! Where the curvature changes its sign, or no pair is found, three clothoids take it from one end to the
//! other. The first and the last are equally long; the length of all and the change of curvature along
//! the middle one are the unknowns.

use glam::{DMat2, DVec2};

use super::clothoid::Clothoid;
use super::ends::Task;
use super::log_aesthetic::LogAesthetic;

/// Steps of Newton's method from one beginning.
const STEPS: usize = 60;

/// Most halvings of a step.
const HALVINGS: usize = 20;

/// Residual of a chord of 1 that counts as met: rounding, with room.
const MET: f64 = 1e-13;

/// The step of differences.
const DIFFERENCE: f64 = 1e-7;

/// Shares at which searches begin.
const SHARES: [f64; 5] = [0.5, 0.35, 0.65, 0.2, 0.8];

/// The least share of a segment: along less the curvature would all but jump.
const LEAST_SHARE: f64 = 0.1;

/// The shares of the growth of ln ρ that the first of two segments with different α is tried with.
const GROWN: [f64; 7] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];

/// The largest e, over the growth of ln ρ: beyond, the curvature all but jumps.
const MOST_SPREAD: f64 = 2.0;

/// The e at which searches begin, over the growth of ln ρ.
const SPREADS: [f64; 3] = [0.0, 1.0, -1.0];

/// Length of three clothoids at the start of searches, relative to an arc.
const LONGER: [f64; 4] = [1.0, 1.1, 1.3, 1.7];

/// The shares that the first and the last of three clothoids have of the length.
const OUTER: [f64; 5] = [0.3, 0.2, 0.4, 0.15, 0.1];

/// A segment up to a similarity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PlaneSegment {
    /// A log-aesthetic one without an inflection.
    LogAesthetic(LogAesthetic),
    /// A clothoid.
    Clothoid(Clothoid),
}

impl PlaneSegment {
    fn chord(&self) -> DVec2 {
        match self {
            Self::LogAesthetic(segment) => segment.chord(),
            Self::Clothoid(clothoid) => clothoid.chord(),
        }
    }

    fn turning(&self) -> f64 {
        match self {
            Self::LogAesthetic(segment) => segment.turning,
            Self::Clothoid(clothoid) => clothoid.turning(),
        }
    }

    /// The curvatures at the ends, over a chord of 1.
    pub(super) fn curvatures(&self) -> [f64; 2] {
        match self {
            Self::LogAesthetic(segment) => segment.curvatures(),
            Self::Clothoid(clothoid) => {
                let chord = clothoid.chord().length();
                clothoid.curvatures.map(|it| it * chord)
            }
        }
    }
}

/// Segments that follow each other on the chord from (0, 0) to (1, 0).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    /// The segments.
    pub(super) segments: Vec<PlaneSegment>,
    /// Their ends: one point more than segments.
    pub(super) points: Vec<DVec2>,
}

/// Find two log-aesthetic segments, with a given α or without, for two positive curvatures. `None` if
/// none are found.
pub(super) fn log_aesthetic_pair(
    task: &Task,
    alpha: Option<f64>,
    curvatures: [f64; 2],
) -> Option<Chain> {
    let chain = |alphas, done, grown| pair(task, curvatures, alphas, done, grown);
    let share = |share: f64| (LEAST_SHARE..=1.0 - LEAST_SHARE).contains(&share);
    if let Some(alpha) = alpha {
        let of = |[done, grown]: [f64; 2]| chain([alpha; 2], done, grown);
        let fits = |[done, grown]: [f64; 2]| share(done) && share(grown);
        return newton(of, fits, &pairs(SHARES, SHARES)).map(of);
    }
    // What bends the graph of ln κ is e times its growth.
    let unit = (curvatures[0] / curvatures[1]).ln().abs().recip();
    let found = GROWN.into_iter().filter_map(|grown| {
        let of = |[done, spread]: [f64; 2]| {
            let spread = unit * spread;
            chain([-1.0 + spread, -1.0 - spread], done, grown)
        };
        let fits = |[done, spread]: [f64; 2]| share(done) && spread.abs() <= MOST_SPREAD;
        let found = newton(of, fits, &pairs(SHARES, SPREADS))?;
        Some((found[1].abs(), of(found)))
    });
    let least = found.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, chain)| chain)
}

/// Find three clothoids for two curvatures. `None` if none with monotone curvature are found.
pub(super) fn clothoids(task: &Task, curvatures: [f64; 2]) -> Option<Chain> {
    let [first, last] = curvatures;
    let half = 0.5 * task.turning();
    let arc = if half == 0.0 {
        1.0
    } else {
        half / half.sin().abs()
    };
    OUTER.into_iter().find_map(|outer| {
        let bends = |[length, change]: [f64; 2]| {
            let mean = (task.turning() / length - 0.5 * outer * (first + last)) / (1.0 - outer);
            [first, mean - 0.5 * change, mean + 0.5 * change, last]
        };
        let of = |unknowns: [f64; 2]| {
            let [length, _] = unknowns;
            let bends = bends(unknowns);
            let lengths = [outer, 1.0 - 2.0 * outer, outer].map(|share| share * length);
            let segments = bends.windows(2).zip(lengths).map(|(bends, length)| {
                let curvatures = [bends[0] * length, bends[1] * length];
                (PlaneSegment::Clothoid(Clothoid { curvatures }), length)
            });
            chain(task, segments.collect())
        };
        let fits = |[length, _]: [f64; 2]| length > 0.0;
        let changes = SHARES.map(|share| share * (last - first));
        let lengths = LONGER.map(|longer| longer * arc);
        let found = newton(of, fits, &pairs(lengths, changes))?;
        let bends = bends(found);
        let steps = bends.windows(2).map(|pair| pair[1] - pair[0]);
        let monotone = steps.into_iter().all(|step| step * (last - first) >= 0.0);
        monotone.then(|| of(found))
    })
}

/// The pair of which the first does some share of the turning, and of the growth of ln ρ.
fn pair(
    task: &Task,
    [first, last]: [f64; 2],
    [one, other]: [f64; 2],
    done: f64,
    grown: f64,
) -> Chain {
    let growth = (first / last).ln();
    let segment = |alpha, share_of_growth: f64, share_of_turning: f64| {
        PlaneSegment::LogAesthetic(LogAesthetic {
            alpha,
            growth: share_of_growth * growth,
            turning: share_of_turning * task.turning(),
        })
    };
    let radius = first.recip();
    let segments = vec![
        (segment(one, grown, done), radius),
        (
            segment(other, 1.0 - grown, 1.0 - done),
            radius * (grown * growth).exp(),
        ),
    ];
    chain(task, segments)
}

/// Put segments, each with the scale that it has, one after the other.
fn chain(task: &Task, segments: Vec<(PlaneSegment, f64)>) -> Chain {
    let mut points = vec![DVec2::ZERO];
    let (mut point, mut direction) = (DVec2::ZERO, -task.angles[0]);
    for (segment, scale) in &segments {
        point += *scale * DVec2::from_angle(direction).rotate(segment.chord());
        direction += segment.turning();
        points.push(point);
    }
    Chain {
        segments: segments.into_iter().map(|(segment, _)| segment).collect(),
        points,
    }
}

fn pairs<const ONE: usize, const OTHER: usize>(
    ones: [f64; ONE],
    others: [f64; OTHER],
) -> Vec<[f64; 2]> {
    let pairs = others.into_iter();
    let pairs = pairs.flat_map(|other| ones.map(|one| [one, other]));
    pairs.collect()
}

/// Find unknowns that fit at which the segments end where the chord does, by Newton's method with
/// halved steps.
fn newton(
    of: impl Fn([f64; 2]) -> Chain,
    fits: impl Fn([f64; 2]) -> bool,
    beginnings: &[[f64; 2]],
) -> Option<[f64; 2]> {
    let missing = |at: DVec2| {
        let chain = of(at.to_array());
        let end = chain.points.last();
        end.map_or(DVec2::NAN, |end| *end - DVec2::X)
    };
    beginnings.iter().find_map(|begin| {
        let mut at = DVec2::from(*begin);
        let mut value = missing(at);
        for _ in 0..STEPS {
            let slope = |axis: DVec2| {
                let [ahead, behind] =
                    [1.0, -1.0].map(|side| missing(at + side * DIFFERENCE * axis));
                (ahead - behind) / (2.0 * DIFFERENCE)
            };
            let step = DMat2::from_cols(slope(DVec2::X), slope(DVec2::Y)).inverse() * value;
            let shorter = (0..HALVINGS).map(|halvings| at - step * 0.5_f64.powi(halvings as i32));
            let better = shorter
                .filter(|at| fits(at.to_array()))
                .map(|at| (at, missing(at)))
                .find(|(_, next)| next.length() < value.length());
            match better {
                Some(next) => (at, value) = next,
                None => break,
            }
        }
        (value.length() <= MET).then_some(at.to_array())
    })
}
