//! Features of a curve that no polygon makes: found among samples, not proved.

use super::curve_samples::SampledCurve;
use crate::geometry::{Jet, sampled_cusps};

/// The rounding of a sampled curvature, in units of the largest one: smaller ups and downs are noise.
const ROUNDING: f64 = 1e-9;

/// How far the ends of a closed curve may be apart, in units of its length, and their directions and curvatures may
/// differ, in units of the largest one: above the digits that files have, below what can be seen.
const SEAM: f64 = 1e-6;

/// A jump of the curvature by a smaller share of its value is not seen: points of seven digits leave such jumps where
/// the curvature was continuous.
const JUMP: f64 = 1e-3;

/// Steps of a bisection between two samples: to the last digit.
const HALVINGS: usize = 60;

/// A kind of sampled feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampledKind {
    /// The curvature of a planar curve changes its sign.
    Inflection,
    /// The curvature is greatest.
    Maximum,
    /// The curvature is least.
    Minimum,
    /// The curve stops, C′ = 0, and has no curvature.
    Cusp,
    /// The curvature has different limits before and after a knot.
    Jump,
}

/// A feature that samples show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledFeature {
    /// Its kind.
    pub kind: SampledKind,
    /// Where it is.
    pub u: f64,
    /// The curvature there: signed of a planar curve; not a number at a cusp or a jump.
    pub curvature: f64,
}

/// List the inflections and the extrema of the curvature within a curve that its samples show, and its cusps,
/// in the order of u. An extremum must stand out from the samples around it by more than rounding; a cusp,
/// near which the curvature grows beyond all bounds, is none, nor is a jump of the curvature. A curve that closes
/// smoothly has no ends: what is at its seam counts once.
pub(super) fn sampled_features(sampled: SampledCurve<'_>) -> Vec<SampledFeature> {
    let cusps = sampled_cusps(sampled.curve);
    let jumps = jumps(sampled, &cusps);
    let mut runs = runs(sampled, &cusps, &jumps);
    let largest = runs.iter().flatten().map(|(_, value)| value.abs());
    let largest = largest.fold(0.0, f64::max);
    let noise = ROUNDING * largest;
    let turn = sampled.curve.pieces() as f64;
    let is_closed = is_closed(sampled, largest);
    if is_closed {
        close(&mut runs, turn);
    }
    let mut features: Vec<SampledFeature> = Vec::new();
    for run in &runs {
        features.extend(match is_closed && cusps.is_empty() && jumps.is_empty() {
            true => extrema_around(run, noise, sampled),
            false => extrema(run, noise, sampled),
        });
        if sampled.samples.is_planar() {
            features.extend(inflections(run, noise, sampled));
        }
    }
    if is_closed {
        for feature in &mut features {
            feature.u = wrapped(turn, feature.u);
        }
    }
    features.extend(jumps.iter().flat_map(|jump| jump.features(sampled)));
    // Through infinity the curvature may change its sign, but the curve has no point there.
    features.retain(|feature| !leaps_at(sampled, feature.u));
    features.extend(cusps.into_iter().map(|u| SampledFeature {
        kind: SampledKind::Cusp,
        u,
        curvature: f64::NAN,
    }));
    features.sort_by(|a, b| a.u.total_cmp(&b.u));
    features
}

/// Whether a curve ends where it begins, with the same direction and the same curvature.
fn is_closed(sampled: SampledCurve<'_>, largest: f64) -> bool {
    let curve = sampled.curve;
    let start = curve.piece_jet(0, 0.0);
    let end = curve.piece_jet(curve.pieces().saturating_sub(1), 1.0);
    let planar = sampled.samples.is_planar();
    let [from, to] = [start, end].map(|jet| jet.curvature_of(planar));
    start.point.distance(end.point) <= SEAM * sampled.samples.length()
        && start.first.angle_between(end.first) <= SEAM
        && (from - to).abs() <= SEAM * largest
}

/// Join what is before the first cusp of a closed curve to what is behind the last one. Without a cusp go once around
/// from where the curvature is greatest to there, and one sample on.
fn close(runs: &mut Vec<Vec<(f64, f64)>>, turn: f64) {
    let later = |(u, value): &(f64, f64)| (u + turn, *value);
    if let [around] = runs.as_mut_slice() {
        // The end is the start.
        around.pop();
        let numbered = around.iter().enumerate();
        let greatest = numbered.max_by(|(_, a), (_, b)| a.1.total_cmp(&b.1));
        let first = greatest.map_or(0, |(index, _)| index);
        around.rotate_left(first);
        let moved = around.len() - first;
        for (u, _) in around.iter_mut().skip(moved) {
            *u += turn;
        }
        let again: Vec<(f64, f64)> = around.iter().take(2).map(later).collect();
        around.extend(again);
    } else if let Some(last) = runs.pop()
        && let Some(first) = runs.first_mut()
    {
        let begin = first.iter().skip(1).map(later);
        *first = last.into_iter().chain(begin).collect();
    }
}

/// The extrema once around a closed curve, from where the curvature is greatest to there, and one sample on.
fn extrema_around(
    points: &[(f64, f64)],
    noise: f64,
    sampled: SampledCurve<'_>,
) -> Vec<SampledFeature> {
    let end = points.len().saturating_sub(1);
    let mut features = extrema(points.get(..end).unwrap_or_default(), noise, sampled);
    if !features.is_empty() {
        let greatest = end.saturating_sub(1);
        features.extend(extremum(SampledKind::Maximum, points, greatest, sampled));
    }
    features
}

/// A parameter of a closed curve as one from its start on and before its end.
fn wrapped(turn: f64, u: f64) -> f64 {
    match u < turn * (1.0 - 2.0 * f64::EPSILON) {
        true => u,
        false => (u - turn).max(0.0),
    }
}

/// The jet at a parameter, which may be beyond the end of a closed curve.
fn jet(sampled: SampledCurve<'_>, u: f64) -> Jet {
    let turn = sampled.curve.pieces() as f64;
    sampled.curve.jet(if u > turn { u - turn } else { u })
}

/// A jump of the curvature.
struct Jump {
    /// The piece behind it.
    piece: usize,
    /// The curvatures before and after it.
    sides: [f64; 2],
}

impl Jump {
    /// The jump, and the inflection where the sign changes too.
    fn features(&self, sampled: SampledCurve<'_>) -> impl Iterator<Item = SampledFeature> {
        let feature = |kind, curvature| SampledFeature {
            kind,
            u: self.piece as f64,
            curvature,
        };
        let [before, after] = self.sides;
        let turns = sampled.samples.is_planar() && before * after < 0.0;
        let inflection = turns.then(|| feature(SampledKind::Inflection, 0.0));
        let jump = feature(SampledKind::Jump, f64::NAN);
        inflection.into_iter().chain([jump])
    }
}

/// Where the curvature jumps between two pieces, away from cusps.
fn jumps(sampled: SampledCurve<'_>, cusps: &[f64]) -> Vec<Jump> {
    let samples = sampled.samples;
    let all = samples.all().iter().map(|sample| sample.curvature.abs());
    let largest = all.filter(|it| it.is_finite()).fold(0.0, f64::max);
    let sides = |piece: usize| {
        let (before, after) = (samples.piece(piece - 1), samples.piece(piece));
        Some([before.last()?.curvature, after.first()?.curvature])
    };
    let step = 1.0 / samples.steps() as f64;
    let is_apart = |piece: usize| cusps.iter().all(|it| (piece as f64 - it).abs() > step);
    let all = (1..samples.pieces()).filter(|piece| is_apart(*piece));
    let all = all.filter_map(|piece| {
        let sides = sides(piece)?;
        let jump = (sides[1] - sides[0]).abs();
        let is_seen = jump > JUMP * sides[0].abs().max(sides[1].abs()) && jump > SEAM * largest;
        is_seen.then_some(Jump { piece, sides })
    });
    all.collect()
}

/// The finite curvatures of all samples, with their parameters, in runs between the cusps and the jumps: samples within a
/// step of a cusp count for nothing.
fn runs(sampled: SampledCurve<'_>, cusps: &[f64], jumps: &[Jump]) -> Vec<Vec<(f64, f64)>> {
    let samples = sampled.samples;
    let steps = samples.steps() as f64;
    let mut runs = vec![Vec::new(); cusps.len() + jumps.len() + 1];
    for piece in 0..samples.pieces() {
        let passed = jumps.partition_point(|jump| jump.piece <= piece);
        // The end of a piece is the start of the next, but for a jump.
        let is_new = piece == 0 || jumps[..passed].last().is_some_and(|it| it.piece == piece);
        let own = samples.piece(piece).iter().enumerate();
        for (index, sample) in own.skip(usize::from(!is_new)) {
            let u = piece as f64 + index as f64 / steps;
            let run = passed + cusps.partition_point(|cusp| *cusp < u);
            let is_apart = cusps.iter().all(|cusp| (u - cusp).abs() > 1.0 / steps);
            if is_apart && sample.curvature.is_finite() {
                runs[run].push((u, sample.curvature));
            }
        }
    }
    runs
}

/// Whether the curve leaps in the step between two samples that holds u.
fn leaps_at(sampled: SampledCurve<'_>, u: f64) -> bool {
    let (piece, t) = sampled.curve.locate(u);
    let after = (t * sampled.samples.steps() as f64) as usize + 1;
    let sample = sampled.samples.piece(piece).get(after);
    sample.is_some_and(|sample| sample.leaps)
}

fn curvature_at(sampled: SampledCurve<'_>, u: f64) -> f64 {
    let planar = sampled.samples.is_planar();
    jet(sampled, u).curvature_of(planar)
}

/// The turns of a sequence: where it has risen by more than `noise` above what comes next, or
/// fallen.
fn extrema(points: &[(f64, f64)], noise: f64, sampled: SampledCurve<'_>) -> Vec<SampledFeature> {
    let mut features = Vec::new();
    let value = |index: usize| points.get(index).map_or(f64::NAN, |point| point.1);
    let (mut low, mut high) = (0, 0);
    // Whether the sequence rises, once it is known.
    let mut rises: Option<bool> = None;
    for index in 1..points.len() {
        if value(index) > value(high) {
            high = index;
        }
        if value(index) < value(low) {
            low = index;
        }
        let has_risen = value(index) - value(low) > noise;
        let has_fallen = value(high) - value(index) > noise;
        match rises {
            None | Some(false) if has_risen => {
                if rises.is_some() {
                    features.extend(extremum(SampledKind::Minimum, points, low, sampled));
                }
                (rises, high) = (Some(true), index);
            }
            None | Some(true) if has_fallen => {
                if rises.is_some() {
                    features.extend(extremum(SampledKind::Maximum, points, high, sampled));
                }
                (rises, low) = (Some(false), index);
            }
            _ => {}
        }
    }
    features
}

/// Find an extremum between the neighbours of a sample: where the slope of the curvature, an exact
/// derivative, changes its sign.
fn extremum(
    kind: SampledKind,
    points: &[(f64, f64)],
    index: usize,
    sampled: SampledCurve<'_>,
) -> Option<SampledFeature> {
    let (before, after) = (points.get(index.checked_sub(1)?)?, points.get(index + 1)?);
    let planar = sampled.samples.is_planar();
    let sign = if kind == SampledKind::Maximum {
        1.0
    } else {
        -1.0
    };
    let u = bisected([before.0, after.0], |u| {
        sign * jet(sampled, u).curvature_slope(planar)
    });
    let curvature = curvature_at(sampled, u);
    Some(SampledFeature { kind, u, curvature })
}

/// Find where a function that is positive at the first of two parameters becomes 0 or negative.
fn bisected([mut from, mut to]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if value(middle) > 0.0 {
            from = middle;
        } else {
            to = middle;
        }
    }
    0.5 * (from + to)
}

/// Find where the curvature changes its sign, by bisection between samples of different signs.
fn inflections(
    points: &[(f64, f64)],
    noise: f64,
    sampled: SampledCurve<'_>,
) -> Vec<SampledFeature> {
    let signed = points.iter().filter(|(_, value)| value.abs() > noise);
    let signed: Vec<&(f64, f64)> = signed.collect();
    let changes = signed.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0);
    let found = changes.map(|pair| SampledFeature {
        kind: SampledKind::Inflection,
        u: bisected([pair[0].0, pair[1].0], |u| {
            pair[0].1.signum() * curvature_at(sampled, u)
        }),
        curvature: 0.0,
    });
    found.collect()
}
