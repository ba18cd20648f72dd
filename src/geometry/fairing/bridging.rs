//! Bridges: vertices between two parts that make one harmonious float polygon of them.

use std::f64::consts::PI;
use std::ops::Range;

use glam::{DVec2, DVec3, DVec4};
use thiserror::Error;

use super::bends::Bends;
use super::counts::{ShapeCounts, counted, domain, seen};
use super::objective::Measure;
use super::problem::Problem;
use super::walk::walk;
use crate::geometry::arc_length::arc_length_between;
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::crossing::new_crossing;
use crate::geometry::end::End;
use crate::geometry::error::PolygonError;
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::harmony::VertexFlow;
use crate::geometry::jet::Jet;
use crate::geometry::progress::Progress;

/// The most vertices that a bridge may have.
pub const MAX_BRIDGE: usize = 2000;

/// Most numbers of vertices to try where the number is not given.
const MOST_TRIALS: usize = 24;

/// The orders of the differences of curvature that are tried.
const ORDERS: [usize; 2] = [2, 3];

/// The weight ε of the moves from the first guess: it only keeps the equations regular.
const CLOSENESS: f64 = 1e-9;

/// The most Gauss–Newton steps of one descent.
const MOST_STEPS: usize = 60;

/// Pieces that measure the length of a first guess.
const PIECES: usize = 64;

/// A bridge between two curves that is longer than so many times the gap and the legs beside it goes a long way round.
const LONG: f64 = 3.0;

/// The relative error of a bridge's length.
const LENGTH: f64 = 1e-3;

/// How often the segments of both parts are halved so that a bridge fits into the gap.
const MOST_HALVINGS: usize = 4;

/// The same of a curve that is closed: the ends of one with few vertices are long.
const MOST_HALVINGS_CLOSING: usize = 6;

/// A bridge that closes a curve is looked for between finer segments while it is longer than so many times the cubic.
const DIRECT: f64 = 2.0;

/// Across a tight gap a bridge whose excess of curvature is larger is looked for between finer segments, too.
const FINE: f64 = 1.5;

/// Speeds at the ends with a smaller ratio count as equal.
const UNEVEN: f64 = 1.5;

/// Vertices nearer to each other than this share of the size are one: the same one from two subdivisions.
const ONE: f64 = 1e-13;

/// Twice as many vertices in both parts must make the excess of curvature so many times smaller.
const MILDER: f64 = 1.25;

/// Request for a bridge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bridge {
    /// The number of vertices; `None` for the best number.
    pub vertices: Option<usize>,
    /// Whether the second part may move rigidly into its best place.
    pub second_moves: bool,
}

/// A polygon with its bridge.
#[derive(Clone, Debug, PartialEq)]
pub struct Bridged {
    /// The vertices of the first part, those of the bridge and those of the second part.
    pub polygon: FloatPolygon,
    /// The numbers of the bridge's vertices.
    pub bridge: Range<usize>,
    /// The parameters of the ends that are joined.
    pub joint: [f64; 2],
    /// How sharply it bends between them.
    pub bends: Bends,
    /// The proved features of the segments that depend on the bridge.
    pub counts: ShapeCounts,
    /// The number of undecided places, cusps included.
    pub undecided: usize,
    /// The number of Gauss–Newton steps in all.
    pub iterations: usize,
    /// How often the segments of each part were halved, which changes no part.
    pub halvings: [usize; 2],
    /// Whether a bridge between the segments as they were fits without a knuckle, or the parts need none.
    pub is_plain: bool,
    /// The length of the curve between the parts.
    pub length: f64,
    /// The distance of the ends.
    pub gap: f64,
    /// Whether it goes a long way round: it is much longer than the gap, or has a loop.
    pub is_long: bool,
}

/// Why there is no bridge.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BridgeError {
    /// The parts have different degrees.
    #[error("the curves have the degrees {first} and {second}: bring them to one degree first")]
    Degrees {
        /// The degree of the first part.
        first: usize,
        /// The degree of the second part.
        second: usize,
    },
    /// A bridge of legs like those of the parts has too many vertices.
    #[error(
        "a bridge of legs like those beside the gap takes about {needed} vertices, {MAX_BRIDGE} are the most: give their number, or bring the ends closer"
    )]
    TooFar {
        /// The number it would have.
        needed: usize,
    },
    /// The computation was ended early.
    #[error("joining was cancelled")]
    Cancelled,
    /// The vertices make no polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

/// Join the end of an open curve with the start of another of the same degree n by a bridge: the
/// composite is one float polygon, hence C^{n−1}, and where only vertices of one part act it is that
/// part to the bit.
///
/// The bridge minimises the functional of [`harmonise`](super::harmonising::harmonise) with second
/// or third differences. The first guess is the cubic with the last legs' directions at its ends.
/// Where the second part moves, legs, curvatures and torsion angles of the bridge are free of each
/// other, and each sequence is the discrete spline between those of the parts.
///
/// Where the number of vertices is not given, parts that share two to n vertices there (of degree 1 one), as those of a curve without the
/// segments between, need none. Else numbers about as large as that of the legs that fit into the gap are tried:
/// the most even bridge wins: with the smallest sum of the largest second differences of legs, turning
/// and torsion angles, times 1 + the features that it shows, the number of its legs, and the square of
/// 1 + its bending energy times its length; where the second part moves, the one with
/// the fewest features, then the shortest move; one that makes a curve of the plane cross itself comes last. The
/// logarithms of weights go on as a cubic.
///
/// A bridge has n segments at least, about as long as those beside it. Where it goes a long way round for that,
/// turns by half a turn more than the cubic between the ends of a short gap, or bends much more than its ends, the
/// segments of the part with the longer ones are halved until they are about as long, then those of both parts, up to
/// four times, until it does not; if it always does, the mildest counts.
///
/// # Errors
/// [`BridgeError`]; a part that is periodic is [`PolygonError::PeriodicCurve`].
pub fn join(
    first: &FloatPolygon,
    second: &FloatPolygon,
    bridge: &Bridge,
    progress: &Progress,
) -> Result<Bridged, BridgeError> {
    if first.degree() != second.degree() {
        let (first, second) = (first.degree(), second.degree());
        return Err(BridgeError::Degrees { first, second });
    }
    let parts = Parts {
        first: first.clone(),
        second: second.clone(),
        closes: false,
    };
    parts.check_open("joined")?;
    parts.fitted(bridge, progress)
}

/// Join the end of an open curve with its own start, so that it is periodic, as [`join`] does.
///
/// # Errors
/// [`BridgeError`]; a curve that is periodic is [`PolygonError::PeriodicCurve`].
pub fn close(
    polygon: &FloatPolygon,
    vertices: Option<usize>,
    progress: &Progress,
) -> Result<Bridged, BridgeError> {
    let parts = Parts {
        first: polygon.clone(),
        second: polygon.clone(),
        closes: true,
    };
    parts.check_open("closed")?;
    let bridge = Bridge {
        vertices,
        second_moves: false,
    };
    parts.fitted(&bridge, progress)
}

/// Measure the largest jump of the value and the derivatives up to order n − 1 by u at the knots of
/// what depends on some vertices, each relative to the sum of the magnitudes that it is a sum of; of
/// a rational curve those of its homogeneous form. In exact numbers it is 0.
pub fn largest_jump(polygon: &FloatPolygon, vertices: &Range<usize>) -> f64 {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    let from = vertices.start + usize::from(polygon.is_periodic()) * segments;
    let knots = from.saturating_sub(degree)..=from + vertices.len();
    let inside = |knot: &usize| polygon.is_periodic() || (*knot > 0 && *knot < segments);
    let mut largest = 0.0_f64;
    for knot in knots.filter(inside) {
        for order in 0..degree {
            let mut jump = DVec4::ZERO;
            let mut sum = 0.0;
            for (side, before, t) in [(1.0, 0, 0.0), (-1.0, 1, 1.0)] {
                let first = knot - before;
                for (index, basis) in uniform_basis_derivative::<f64>(degree, order, t)
                    .iter()
                    .enumerate()
                {
                    let term: DVec4 = *basis * polygon.homogeneous(first + index);
                    jump += side * term;
                    sum += term.length();
                }
            }
            if sum > 0.0 {
                largest = largest.max(jump.length() / sum);
            }
        }
    }
    largest
}

impl Bridged {
    /// What the excess of curvature and the halvings cost: a smaller price is better.
    fn price(&self) -> f64 {
        let doublings = 0.5 * self.halvings.iter().sum::<usize>() as f64;
        self.bends.excess() * MILDER.powf(doublings)
    }

    /// The same curve, run through the other way.
    pub fn reversed(self) -> Self {
        let count = self.polygon.vertices().len();
        let [from, to] = self.joint.map(|u| self.polygon.segments() as f64 - u);
        Self {
            polygon: self.polygon.reversed(),
            bridge: count - self.bridge.end..count - self.bridge.start,
            joint: [to, from],
            ..self
        }
    }
}

/// The two parts to join.
struct Parts {
    first: FloatPolygon,
    second: FloatPolygon,
    /// Whether the two are the same, and the bridge closes it.
    closes: bool,
}

/// A polygon that was tried.
struct Trial {
    polygon: FloatPolygon,
    bridge: Range<usize>,
    /// The criterion, then the one that decides between equals.
    rank: (f64, f64),
}

impl Parts {
    fn check_open(&self, done: &'static str) -> Result<(), PolygonError> {
        self.first.check_open(done)?;
        self.second.check_open(done)
    }

    fn is_planar(&self) -> bool {
        self.first.is_planar() && self.second.is_planar()
    }

    /// The composite where the parts are those of one polygon: the last vertices of the first, two to n, are the first
    /// ones of the second, as after a cut.
    fn seamless(&self) -> Option<Trial> {
        let (degree, count) = (self.first.degree(), self.first.vertices().len());
        let vertex = |polygon: &FloatPolygon, index| (polygon.vertex(index), polygon.weight(index));
        let most = degree.min(count).min(self.second.vertices().len());
        let least = ONE * self.first.size().max(self.second.size());
        let shares = |shared: &usize| {
            let pairs = (0..*shared).map(|index| (count - shared + index, index));
            let mut pairs =
                pairs.map(|(last, first)| [vertex(&self.first, last), vertex(&self.second, first)]);
            pairs.all(|[(a, p), (b, q)]| a.distance(b) <= least && (p - q).abs() <= ONE * p)
        };
        let begin = count - (degree.min(2)..=most).rev().find(shares)?;
        // A curve that closes may have too few vertices without those.
        let polygon = self.composite(begin, &[], self.second.vertices()).ok()?;
        Some(Trial {
            polygon,
            bridge: begin..begin,
            rank: (0.0, 0.0),
        })
    }

    /// The bridge between the parts with as few halvings as fit it into the gap without a knuckle; else the mildest
    /// one that fits, or one without halvings.
    fn fitted(self, bridge: &Bridge, progress: &Progress) -> Result<Bridged, BridgeError> {
        let whole = self.bridged(bridge, progress)?;
        // Without vertices it is what the parts were cut from.
        if bridge.second_moves || bridge.vertices.is_some() || whole.bridge.is_empty() {
            let is_long = !bridge.second_moves && !whole.bridge.is_empty() && !self.fits(&whole);
            return Ok(Bridged { is_long, ..whole });
        }
        let fits = self.fits(&whole);
        let is_plain = fits && !whole.bends.is_knuckle();
        let (is_tight, way) = (self.is_tight(), self.way());
        let is_fine = |found: &Bridged| match is_tight {
            _ if self.crosses(found) || self.closes && found.length > DIRECT * way => false,
            true => found.bends.excess() <= FINE,
            false => !found.bends.is_knuckle(),
        };
        let mut best = fits.then(|| whole.clone());
        for halvings in self.halvings() {
            if best.as_ref().is_some_and(is_fine) {
                break;
            }
            let found = self.halved(halvings)?.bridged(bridge, progress)?;
            let is_seamless = found.bridge.is_empty();
            let found = Bridged { halvings, ..found };
            let milder = |best: &Bridged| match (self.crosses(&found), self.crosses(best)) {
                (true, false) => false,
                (false, true) => true,
                _ if self.closes => found.length * found.price() < best.length * best.price(),
                _ => found.price() < best.price(),
            };
            if is_seamless || (self.fits(&found) && best.as_ref().is_none_or(milder)) {
                best = Some(found);
            }
            if is_seamless {
                break;
            }
        }
        Ok(match best {
            Some(best) => {
                let is_plain = is_plain || best.bridge.is_empty();
                Bridged { is_plain, ..best }
            }
            None => Bridged {
                is_long: true,
                ..whole
            },
        })
    }

    /// How often the segments of both parts are halved, in the order of the tries.
    fn halvings(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let (even, most) = match self.closes {
            true => ([0; 2], MOST_HALVINGS_CLOSING),
            false => (self.even_halvings(), MOST_HALVINGS),
        };
        let all = (0..=most).map(move |more| even.map(|own| own + more));
        all.filter(|halvings| *halvings != [0; 2])
    }

    /// How often the segments of the part with the longer ones at its end are halved to be about as long.
    fn even_halvings(&self) -> [usize; 2] {
        let ratio = {
            let [end, start] = self.ends();
            end.speed() / start.speed()
        };
        let needed = |ratio: f64| match ratio.is_finite() && ratio > UNEVEN {
            true => (ratio.log2().round() as usize).min(MOST_HALVINGS),
            false => 0,
        };
        [needed(ratio), needed(ratio.recip())]
    }

    /// The parts with halved segments.
    fn halved(&self, [first, second]: [usize; 2]) -> Result<Self, PolygonError> {
        let halved = |part: &FloatPolygon, times: usize| {
            (0..times).try_fold(part.clone(), |part, _| part.subdivided())
        };
        Ok(Self {
            first: halved(&self.first, first)?,
            second: halved(&self.second, second)?,
            closes: self.closes,
        })
    }

    /// Whether the gap is shorter than the n + 1 segments of a bridge would like it.
    fn is_tight(&self) -> bool {
        let [end, start] = self.ends();
        let (degree, gap) = (self.first.degree() as f64, end.point.distance(start.point));
        gap < 0.5 * (degree + 1.0) * (end.speed() + start.speed())
    }

    /// Whether a bridge goes no long way round: it is at most three times as long as the gap, or as the cubic between the
    /// ends where it closes a curve, and the legs |C′|/n of the closed polygons beside it; and across a gap of the plane
    /// that is shorter than its n + 1 segments would like it turns by no more than that cubic and half a turn.
    fn fits(&self, found: &Bridged) -> bool {
        let [end, start] = self.ends();
        let (degree, speeds) = (self.first.degree() as f64, end.speed() + start.speed());
        if found.length > LONG * self.way() + speeds / degree {
            return false;
        }
        if !self.is_tight() || !self.is_planar() {
            return true;
        }
        let from = self.first.segments() as f64;
        let across = found.bridge.end as f64 - from;
        let bridge = |step: usize| {
            found
                .polygon
                .point(from + across * step as f64 / PIECES as f64)
        };
        turned(bridge) - turned(|step| self.cubic(step)) < PI
    }

    /// A point of the cubic between the ends, with their directions and slopes as long as the gap.
    fn cubic(&self, step: usize) -> DVec3 {
        let [end, start] = self.ends();
        let chord = start.point - end.point;
        let slope = |jet: &Jet| chord.length() * jet.tangent().unwrap_or(DVec3::ZERO);
        let points = [end.point, slope(&end), slope(&start), start.point];
        let weights = hermite(step as f64 / PIECES as f64);
        let terms = weights.into_iter().zip(points);
        terms.map(|(weight, point)| weight * point).sum()
    }

    /// The way that a bridge has to go: the gap, or the cubic between the ends where it closes a curve.
    fn way(&self) -> f64 {
        let [end, start] = self.ends();
        let pieces = (0..PIECES).map(|step| self.cubic(step).distance(self.cubic(step + 1)));
        match self.closes {
            true => pieces.sum(),
            false => end.point.distance(start.point),
        }
    }

    /// Whether a curve is closed so that it crosses itself.
    fn crosses(&self, found: &Bridged) -> bool {
        self.closes && new_crossing(&[&self.first], &found.polygon).is_some()
    }

    /// The ends that are joined.
    fn ends(&self) -> [Jet; 2] {
        [
            self.first.end_jet(End::Finish),
            self.second.end_jet(End::Start),
        ]
    }

    fn bridged(&self, bridge: &Bridge, progress: &Progress) -> Result<Bridged, BridgeError> {
        let mut search = Search {
            parts: self,
            second_moves: bridge.second_moves,
            progress,
            best: self.seamless().filter(|_| bridge.vertices.is_none()),
            iterations: 0,
        };
        match bridge.vertices {
            Some(count) => search.try_out([count])?,
            None if search.best.is_some() => {}
            None if bridge.second_moves => search.try_out(1..=2 * self.first.degree() + 8)?,
            None => search.narrow(self.numbers()?)?,
        }
        let iterations = search.iterations;
        // Each number of vertices gives a polygon or an error, and one at least was tried.
        let best = search.best.ok_or(BridgeError::Cancelled)?;
        let (around, stretch) = around(&best.polygon, &best.bridge)?;
        let features = Features::proved(&around, |_| !progress.is_cancelled());
        let features = features.ok_or(BridgeError::Cancelled)?;
        let proved = counted(&features, around.is_planar(), Some(stretch));
        let [end, start] = self.ends();
        let gap = end.point.distance(start.point);
        let joint = [self.first.segments(), best.bridge.end].map(|u| u as f64);
        let length = arc_length_between(&best.polygon, joint[0], joint[1], LENGTH);
        Ok(Bridged {
            bends: Bends::between(&best.polygon, joint),
            polygon: best.polygon,
            bridge: best.bridge,
            joint,
            counts: proved.counts,
            undecided: proved.undecided,
            iterations,
            halvings: [0; 2],
            is_plain: true,
            length,
            gap,
            is_long: false,
        })
    }

    /// The vertices of the last leg of the first part and of the first leg of the second, with the
    /// logarithms of their weights.
    fn legs(&self) -> [[(DVec3, f64); 2]; 2] {
        let vertex =
            |polygon: &FloatPolygon, index| (polygon.vertex(index), polygon.weight(index).ln());
        let last = self.first.vertices().len() - 1;
        [
            [vertex(&self.first, last - 1), vertex(&self.first, last)],
            [vertex(&self.second, 0), vertex(&self.second, 1)],
        ]
    }

    /// The range of numbers of vertices that are tried: about as many as legs fit into the gap.
    ///
    /// # Errors
    /// [`BridgeError::TooFar`].
    fn numbers(&self) -> Result<[usize; 2], BridgeError> {
        let points = self.guess(PIECES);
        let [[_, from], [to, _]] = self.legs();
        let mut way = vec![from.0];
        way.extend(points.iter().map(|(point, _)| *point));
        way.push(to.0);
        let length: f64 = way.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
        let [before, after] = self.legs().map(|[a, b]| a.0.distance(b.0));
        let leg = (before * after).sqrt();
        let fitting = if leg > 0.0 { length / leg } else { 0.0 };
        let degree = self.first.degree();
        let most = 2.0 * fitting + degree as f64;
        if most > MAX_BRIDGE as f64 {
            let needed = fitting.round() as usize;
            return Err(BridgeError::TooFar { needed });
        }
        Ok([((0.5 * fitting) as usize).max(1), (most as usize).max(1)])
    }

    /// The first guess of a bridge: the cubic that leaves the last vertex of the first part and
    /// arrives at the first one of the second along their legs.
    fn guess(&self, count: usize) -> Vec<(DVec3, f64)> {
        let [[before, from], [to, after]] = self.legs();
        let chord = to.0 - from.0;
        let along = |leg: DVec3| leg.try_normalize().unwrap_or(chord.normalize_or_zero());
        let steps = (count + 1) as f64;
        let slopes = [
            (
                chord.length() * along(from.0 - before.0),
                steps * (from.1 - before.1),
            ),
            (
                chord.length() * along(after.0 - to.0),
                steps * (after.1 - to.1),
            ),
        ];
        let point = |index: usize| {
            let weights = hermite((index + 1) as f64 / steps);
            let points = [from.0, slopes[0].0, slopes[1].0, to.0];
            let logarithms = [from.1, slopes[0].1, slopes[1].1, to.1];
            let terms = weights.iter().zip(points);
            let point = terms.map(|(weight, point)| *weight * point).sum();
            let terms = weights.iter().zip(logarithms);
            (point, terms.map(|(weight, number)| weight * number).sum())
        };
        (0..count).map(point).collect()
    }

    /// Put the composite together: so many vertices of the first part, the bridge, and the second part
    /// with these vertices.
    fn composite(
        &self,
        first: usize,
        bridge: &[(DVec3, f64)],
        second: &[DVec3],
    ) -> Result<FloatPolygon, PolygonError> {
        let second = if self.closes { &[] } else { second };
        let first = (0..first).map(|index| (self.first.vertex(index), self.first.weight(index)));
        let bridge = bridge
            .iter()
            .map(|(point, logarithm)| (*point, logarithm.exp()));
        let second = second.iter().enumerate();
        let second = second.map(|(index, vertex)| (*vertex, self.second.weight(index)));
        let (vertices, weights): (_, Vec<f64>) = first.chain(bridge).chain(second).unzip();
        let is_rational = self.first.is_rational() || self.second.is_rational();
        let weights = is_rational.then_some(weights);
        FloatPolygon::new(self.first.degree(), vertices, weights, self.closes)
    }

    /// The best bridges of `count` vertices with both parts in their places.
    fn fixed(
        &self,
        count: usize,
        order: usize,
        iterations: &mut usize,
    ) -> Result<Vec<Trial>, BridgeError> {
        let first = self.first.vertices().len();
        let guess = self.composite(first, &self.guess(count), self.second.vertices())?;
        let bridge = first..first + count;
        let problem = Problem::new(&guess, self.is_planar(), |vertex| bridge.contains(&vertex));
        let mut vertices = guess.vertices().to_vec();
        let mut trials = Vec::new();
        // In space the curvature vector leads to where torsion angles mean something.
        let in_space = (!self.is_planar()).then_some(Measure::CurvatureVector);
        for measure in in_space.into_iter().chain([problem.measure()]) {
            let harmony = problem.harmony(measure, order, CLOSENESS);
            let found = problem.descend(harmony, &vertices, MOST_STEPS);
            *iterations += found.steps;
            vertices = found.vertices;
            let polygon = problem.polygon(&vertices)?;
            trials.push(Trial {
                rank: (unevenness(&polygon, &bridge)?, count as f64),
                polygon,
                bridge: bridge.clone(),
            });
        }
        Ok(trials)
    }

    /// The best bridge of `count` vertices with the second part where it fits best. A bridge that makes the curve cross
    /// itself ranks last.
    fn moving(&self, count: usize, order: usize) -> Result<Trial, BridgeError> {
        let weights = self.guess(count).into_iter().map(|(_, weight)| weight);
        let parts = [self.first.vertices(), self.second.vertices()];
        let (points, second) = walk(parts, count, order, self.is_planar());
        let bridge: Vec<(DVec3, f64)> = points.into_iter().zip(weights).collect();
        let first = self.first.vertices().len();
        let polygon = self.composite(first, &bridge, &second)?;
        let bridge = first..first + count;
        let pairs = self.second.vertices().iter().zip(&second);
        let moved = pairs.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b)));
        let features = match new_crossing(&[&self.first, &self.second], &polygon) {
            Some(_) => f64::INFINITY,
            None => features(&polygon, &bridge)? as f64,
        };
        Ok(Trial {
            rank: (features, moved),
            polygon,
            bridge,
        })
    }
}

/// The weights of the start, the slopes at start and end, and the end in a cubic (Hermite).
fn hermite(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        s * s * (1.0 + 2.0 * t),
        s * s * t,
        -t * t * s,
        t * t * (1.0 + 2.0 * s),
    ]
}

/// By how much a line through points of the plane turns to either side, in radians.
fn turned(point: impl Fn(usize) -> DVec3) -> f64 {
    let points: Vec<DVec2> = (0..=PIECES).map(|step| point(step).truncate()).collect();
    let legs: Vec<DVec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let turns = legs.windows(2).map(|pair| pair[0].angle_to(pair[1]));
    turns.map(f64::abs).sum()
}

/// The search for the best number of vertices.
struct Search<'a> {
    parts: &'a Parts,
    second_moves: bool,
    progress: &'a Progress,
    best: Option<Trial>,
    iterations: usize,
}

impl Search<'_> {
    /// Try a few numbers of a range, then those between the neighbours of the best one.
    fn narrow(&mut self, [least, most]: [usize; 2]) -> Result<(), BridgeError> {
        let mut step = (most - least).div_ceil(MOST_TRIALS).max(1);
        self.try_out((least..=most).step_by(step))?;
        while step > 1 {
            step = step.div_ceil(2);
            let best = self.best.as_ref().map_or(least, |best| best.bridge.len());
            self.try_out([best.saturating_sub(step).max(1), best + step])?;
        }
        Ok(())
    }

    /// Try numbers of vertices, and keep the best composite.
    fn try_out(&mut self, numbers: impl IntoIterator<Item = usize>) -> Result<(), BridgeError> {
        let numbers: Vec<usize> = numbers.into_iter().collect();
        let all = numbers.len() as f64;
        for (index, count) in numbers.into_iter().enumerate() {
            self.progress.set_done(index as f64 / all);
            for order in ORDERS {
                if self.progress.is_cancelled() {
                    return Err(BridgeError::Cancelled);
                }
                let found = if self.second_moves {
                    vec![self.parts.moving(count, order)?]
                } else {
                    self.parts.fixed(count, order, &mut self.iterations)?
                };
                for trial in found {
                    if self.best.as_ref().is_none_or(|best| trial.rank < best.rank) {
                        self.best = Some(trial);
                    }
                }
            }
        }
        Ok(())
    }
}

/// How uneven a bridge is: the largest second differences of the logarithms of its legs, of its
/// turning angles and, in space, of its torsion angles, and those of the legs beside it, times 1 + the
/// features that it shows, times the number of its legs, times the square of 1 + the [`bending`], so that
/// many vertices on a long way round lose.
fn unevenness(polygon: &FloatPolygon, bridge: &Range<usize>) -> Result<f64, PolygonError> {
    let (beside, _) = around(polygon, bridge)?;
    let flow = VertexFlow::of(&beside);
    let legs = flow.legs.map(f64::ln);
    let sequences = [Some(&legs), Some(&flow.turns), flow.torsion_angles.as_ref()];
    let largest = sequences.into_iter().flatten().map(|sequence| {
        let differences = sequence.second_differences();
        differences.fold(0.0_f64, |most, (_, difference)| most.max(difference.abs()))
    });
    let features = features(polygon, bridge)?;
    // Finer legs have smaller differences however they run.
    let legs = (bridge.len() + 1) as f64;
    let detour = 1.0 + bending(&flow);
    Ok((1 + features) as f64 * largest.sum::<f64>() * legs * detour * detour)
}

/// The discrete bending energy of legs times their length, which no change of size changes:
/// Σ ℓᵢ · Σ 2δᵢ² / (ℓᵢ₋₁ + ℓᵢ), with the turning angles δᵢ.
fn bending(flow: &VertexFlow) -> f64 {
    let legs = flow.legs.values();
    let pairs = legs.windows(2).map(|pair| pair.iter().sum::<f64>());
    let corners = pairs.zip(flow.turns.values());
    let corners = corners.filter(|(pair, _)| *pair > 0.0);
    let energy: f64 = corners.map(|(pair, turn)| 2.0 * turn * turn / pair).sum();
    energy * legs.iter().sum::<f64>()
}

/// The number of features seen in the segments that depend on a bridge.
fn features(polygon: &FloatPolygon, bridge: &Range<usize>) -> Result<usize, PolygonError> {
    let (around, stretch) = around(polygon, bridge)?;
    let counts = seen(&around, stretch);
    Ok(counts.extrema + counts.inflections + counts.torsion_extrema)
}

/// The part of a curve around a bridge, with the stretch of it that depends on the bridge: where a
/// neighbouring segment is there, it shows whether there is an extremum at the knot between.
fn around(
    polygon: &FloatPolygon,
    bridge: &Range<usize>,
) -> Result<(FloatPolygon, [f64; 2]), PolygonError> {
    let (degree, count) = (polygon.degree(), polygon.vertices().len());
    let whole = polygon.unrolled();
    let beside = degree + 1;
    let (first, last) = if polygon.is_periodic() {
        if bridge.len() + 2 * beside > count {
            let stretch = domain(&whole);
            return Ok((whole, stretch));
        }
        (bridge.start + count - beside, bridge.end + count + beside)
    } else {
        let last = (bridge.end + beside).min(count);
        (bridge.start.saturating_sub(beside), last)
    };
    let part = polygon.window(first..last)?;
    let bridge_first = if polygon.is_periodic() {
        beside
    } else {
        bridge.start - first
    };
    let stretch = [
        bridge_first.saturating_sub(degree) as f64,
        (bridge_first + bridge.len()).min(part.segments()) as f64,
    ];
    Ok((part, stretch))
}
