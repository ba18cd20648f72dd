//! Chains of cubic Béziers that keep inflections and curvature extrema, and whose curvature does not jump.
//!
//! Each cubic has point, tangent and curvature of the curve at both ends (C. de Boor, K. Höllig, M. Sabin:
//! High accuracy geometric Hermite interpolation, 1987), and is as long as tolerance and features allow. The
//! equations have no solution on some pieces, most often next to inflections: the cubic before ends earlier
//! then. Kurbo's fit needs about half as many cubics, but its curvature jumps at the joints, and splitting it
//! at inflections adds others.

use glam::DVec2;

use super::chain_features::{ChainFeatures, CubicSigns, changes};
use super::cubic::Cubic;
use crate::geometry::features::{Feature, Features};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;
use crate::geometry::nearest::refined_parameter;

/// The parts of the tolerance that are tried. A smaller one may need fewer cubics: which joints are good ones
/// is luck. The first leaves room for deviations between the samples.
const PARTS: [f64; 4] = [0.95, 0.5, 0.25, 0.125];

/// How often the rest of a curve is halved for the first cubic. With 6 some curves get stuck; with more than
/// 8 slivers fit by accident, and cubics become many.
const HALVINGS: usize = 8;

/// How often the longest length of a cubic is bisected then.
const REFINEMENTS: usize = 6;

/// How often a cubic may be taken back. For the curves of 43 files 10 are enough.
const RETREATS: usize = 40;

/// What is left of a cubic that is taken back.
const SHORTER: f64 = 0.8;

/// If the rest of the curve is shorter than this part of the cubic before, both get more alike.
const SLIVER: f64 = 0.25;

/// The first part of the two then.
const ALIKE: f64 = 0.6;

/// A search that needs more cubics than this has gone astray.
const MOST: usize = 200;

/// Newton steps for the lengths of the legs. They converge slowly where both curvatures are alike.
const STEPS: usize = 30;

/// How far the equations may be off, by the larger curvature and the square of the chord.
const RESIDUAL: f64 = 1e-9;

/// The longest leg, in chords: beyond are loops.
const LONGEST_LEG: f64 = 2.0;

/// The samples of a cubic whose distances are measured.
const SAMPLES: usize = 16;

/// Features this near to a joint, by the parameter, are at it.
const AT_JOINT: f64 = 1e-9;

/// Find a chain of cubics along a planar curve that is within a length of it at 15 samples of each cubic, has its
/// `features`, proved, and whose curvature does not jump: of a few such chains the one with the fewest cubics. `None` if
/// none is found, or if the features of the curve are not all decided.
pub fn fair_chain(
    polygon: &FloatPolygon,
    features: &Features,
    tolerance: f64,
) -> Option<Vec<Cubic>> {
    if !features.undecided.is_empty() {
        return None;
    }
    let places = |kind| features.places(kind);
    let curve = Curve {
        polygon,
        end: polygon.segments() as f64,
        inflections: places(Feature::Inflection),
        extrema: places(Feature::CurvatureExtremum),
    };
    let kept = ChainFeatures {
        inflections: features.count(Feature::Inflection),
        curvature_extrema: features.count(Feature::CurvatureExtremum),
        jumps: false,
        undecided: false,
    };
    let chains = PARTS
        .iter()
        .filter_map(|part| curve.chain(part * tolerance));
    chains
        .filter(|chain| ChainFeatures::of(chain, polygon.is_periodic()) == kept)
        .min_by_key(Vec::len)
}

/// Intervals of u with the number of features in each.
type Places = Vec<([f64; 2], usize)>;

struct Curve<'a> {
    polygon: &'a FloatPolygon,
    /// The largest parameter.
    end: f64,
    inflections: Places,
    extrema: Places,
}

/// A cubic along a piece of the curve.
struct Piece {
    cubic: Cubic,
    from: f64,
    to: f64,
}

impl Curve<'_> {
    /// Put cubics one after the other, each as long as possible.
    fn chain(&self, tolerance: f64) -> Option<Vec<Cubic>> {
        let mut chain: Vec<Piece> = Vec::new();
        let (mut from, mut limit) = (0.0, self.end);
        let mut retreats = 0;
        while from < self.end {
            if let Some(piece) = self.longest(from, limit, tolerance) {
                (from, limit) = (piece.to, self.end);
                chain.push(piece);
            } else {
                let last = chain.pop()?;
                (from, limit) = (last.from, last.from + SHORTER * (last.to - last.from));
                retreats += 1;
            }
            if retreats > RETREATS || chain.len() > MOST {
                return None;
            }
        }
        Some(chain.into_iter().map(|piece| piece.cubic).collect())
    }

    fn longest(&self, from: f64, limit: f64, tolerance: f64) -> Option<Piece> {
        let mut too_far = limit;
        let mut tries = (0..=HALVINGS as i32).map(|halving| {
            let to = from + (limit - from) * 0.5_f64.powi(halving);
            let found = self.piece(from, to, tolerance);
            if found.is_none() {
                too_far = to;
            }
            found
        });
        let mut longest = tries.find_map(|piece| piece)?;
        if longest.to < limit {
            for _ in 0..REFINEMENTS {
                let to = 0.5 * (longest.to + too_far);
                match self.piece(from, to, tolerance) {
                    Some(piece) => longest = piece,
                    None => too_far = to,
                }
            }
        }
        let rest = self.end - longest.to;
        if rest > 0.0 && rest < SLIVER * (longest.to - from) {
            let to = from + ALIKE * (self.end - from);
            longest = self.piece(from, to, tolerance).unwrap_or(longest);
        }
        Some(longest)
    }

    /// The cubic along a piece, if it is within the tolerance and has the features of the piece.
    fn piece(&self, from: f64, to: f64, tolerance: f64) -> Option<Piece> {
        let cubic = hermite([from, to].map(|u| self.jet(u)), to - from)?;
        let is_good =
            self.is_near(&cubic, [from, to], tolerance) && self.is_kept(&cubic, [from, to]);
        is_good.then_some(Piece { cubic, from, to })
    }

    fn jet(&self, u: f64) -> Jet {
        // The end of a periodic curve is not its start on the way there.
        self.polygon.jet(u.min(self.end.next_down()))
    }

    /// Whether samples of a cubic are near the curve.
    fn is_near(&self, cubic: &Cubic, [from, to]: [f64; 2], tolerance: f64) -> bool {
        let step = (to - from) / SAMPLES as f64;
        let mut u = from;
        (1..SAMPLES).all(|sample| {
            let at = point(cubic, sample as f64 / SAMPLES as f64).extend(0.0);
            u = (u + step).min(to);
            u = refined_parameter(at, u, [from, to], |u| self.jet(u));
            self.jet(u).point.distance(at) <= tolerance
        })
    }

    /// Whether a cubic has as many features as its piece, and its curvature rises or falls as that of the
    /// curve at the ends. Without that there would be an extremum at the joint.
    fn is_kept(&self, cubic: &Cubic, [from, to]: [f64; 2]) -> bool {
        let inside = |places: &Places| -> usize {
            let inside = places.iter().filter(|(u, _)| {
                let u = middle(u, self.end);
                u > from + AT_JOINT && u < to - AT_JOINT
            });
            inside.map(|(_, count)| count).sum()
        };
        let signs = CubicSigns::of(cubic);
        let follows = |u: f64, sign: Option<&bool>| {
            let is_extremum = self.extrema.iter().any(|(place, _)| {
                let off = (middle(place, self.end) - u).abs();
                off <= AT_JOINT || (off - self.end).abs() <= AT_JOINT
            });
            let slope = self.jet(u).curvature_slope(true);
            is_extremum || sign.is_none_or(|sign| *sign == (slope > 0.0))
        };
        changes(&signs.curvature) == inside(&self.inflections)
            && changes(&signs.slope) == inside(&self.extrema)
            && follows(from, signs.slope.first())
            && follows(to, signs.slope.last())
    }
}

/// The middle of an interval, which may reach over the joint of a periodic curve.
fn middle([low, high]: &[f64; 2], end: f64) -> f64 {
    let middle = 0.5 * (low + high);
    if middle > end { middle - end } else { middle }
}

fn point([a, b, c, d]: &Cubic, t: f64) -> DVec2 {
    let s = 1.0 - t;
    s * s * s * *a + 3.0 * s * s * t * *b + 3.0 * s * t * t * *c + t * t * t * *d
}

/// The cubic with points, tangents and curvatures of two jets whose parameters differ by `span`. `None` if
/// the equations for the lengths of its legs, 3/2 κ₀ a² = t₀×d − b t₀×t₁ and 3/2 κ₁ b² = d×t₁ − a t₀×t₁, have
/// no solution near that of the parameters.
fn hermite(jets: [Jet; 2], span: f64) -> Option<Cubic> {
    let [start, end] = jets.map(|jet| jet.point.truncate());
    let speeds = jets.map(|jet| jet.speed());
    let [Some(first), Some(last)] = jets.map(|jet| jet.tangent().map(|it| it.truncate())) else {
        return None;
    };
    let curvatures = jets.map(|jet| 1.5 * jet.signed_curvature());
    let chord = end - start;
    let length = chord.length();
    let turn = first.perp_dot(last);
    let rises = [first.perp_dot(chord), chord.perp_dot(last)];
    let residuals = |[a, b]: [f64; 2]| {
        [
            curvatures[0] * a * a - rises[0] + b * turn,
            curvatures[1] * b * b - rises[1] + a * turn,
        ]
    };
    let mut legs = speeds.map(|speed| span / 3.0 * speed);
    if !legs.iter().all(|leg| *leg < LONGEST_LEG * length) {
        legs = [length / 3.0; 2];
    }
    for _ in 0..STEPS {
        let [f, g] = residuals(legs);
        let (fa, gb) = (2.0 * curvatures[0] * legs[0], 2.0 * curvatures[1] * legs[1]);
        let determinant = fa * gb - turn * turn;
        if determinant == 0.0 {
            break;
        }
        legs[0] -= (f * gb - turn * g) / determinant;
        legs[1] -= (fa * g - f * turn) / determinant;
    }
    let allowed = RESIDUAL * curvatures[0].abs().max(curvatures[1].abs()) * length * length;
    let is_solved = residuals(legs).iter().all(|it| it.abs() <= allowed);
    let is_simple = legs
        .iter()
        .all(|leg| *leg > 0.0 && *leg < LONGEST_LEG * length);
    (is_solved && is_simple).then(|| [start, start + legs[0] * first, end - legs[1] * last, end])
}
