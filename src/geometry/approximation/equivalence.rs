//! Shape equivalence (paper, section 5): whether two curves have the same inflections, maxima and minima,
//! in number and order, in each level of curvature and torsion.

use glam::DVec3;

use crate::geometry::curvature_levels::{CurvatureLevels, LEVEL_ORDER, LEVELS};
use crate::geometry::differentiable::Differentiable;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_figures::Range;
use crate::geometry::root::root;
use crate::geometry::segment_expansion::SegmentExpansion;
use crate::geometry::vector;

/// Samples a segment at which levels are compared.
const SAMPLES: usize = 32;

/// Rises and falls below this share of a level's largest value count as rounding.
const SHARE: f64 = 1e-8;

/// A level above the first that stays below this share of what the first would bend by if it changed within
/// the length of the curve is a straight line: those of a clothoid are. A first level that changes by less
/// than this share of itself is constant, as that of a circle, and so is one that ripples by no more.
const STRAIGHT: f64 = 1e-5;

/// A feature of a level at a place of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelFeature {
    /// It changes its sign.
    Inflection,
    /// It has a maximum.
    Maximum,
    /// It has a minimum.
    Minimum,
}

impl LevelFeature {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inflection => "inflection",
            Self::Maximum => "maximum",
            Self::Minimum => "minimum",
        }
    }
}

/// Compare one level of two curves.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelComparison {
    /// Whether it is a level of the torsion, not of the curvature.
    pub torsion: bool,
    /// Which level, counted from 1.
    pub level: usize,
    /// Rises and falls up to this are no features.
    pub least: f64,
    /// The features of the curve that is approximated, sampled, in their order along it, with its own
    /// parameters t.
    pub there: Vec<(f64, LevelFeature)>,
    /// The features of the approximation, with their parameters u. Round a periodic curve they begin where
    /// they agree best with the others.
    pub here: Vec<(f64, LevelFeature)>,
}

impl LevelComparison {
    /// The name of the level: "curvature level 2".
    pub fn name(&self) -> String {
        let quantity = if self.torsion { "torsion" } else { "curvature" };
        format!("{quantity} level {}", self.level)
    }

    /// Whether both have the same features in the same order.
    pub fn is_equal(&self) -> bool {
        self.first_difference().is_none()
    }

    /// The number of the first feature, counted from 0, that only one of them has or that differs.
    pub fn first_difference(&self) -> Option<usize> {
        let feature = |side: Option<(f64, LevelFeature)>| side.map(|(_, feature)| feature);
        self.side_by_side()
            .position(|(there, here)| feature(there) != feature(here))
    }

    /// The features of the curve that is approximated beside those of the approximation, with their
    /// parameters t and u, as long as one of them has any.
    pub fn side_by_side(&self) -> impl Iterator<Item = SideBySide> {
        let most = self.there.len().max(self.here.len());
        (0..most).map(|index| {
            let at = |side: &[(f64, LevelFeature)]| side.get(index).copied();
            (at(&self.there), at(&self.here))
        })
    }
}

/// A feature of the curve that is approximated and one of the approximation.
pub type SideBySide = (Option<(f64, LevelFeature)>, Option<(f64, LevelFeature)>);

/// Precision of the places of features.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Places {
    /// Those of samples, which is quicker.
    Samples,
    /// Found between the samples.
    Refined,
}

/// Compare the first levels of curvature, and in space of torsion, of an approximation with those of
/// the curve beside it; `parameter` tells which t belongs to a given u. Levels that are not continuous at
/// the polygon's degree are left out: level m takes 2m derivatives, of the torsion one more.
///
/// Both are sampled 32 times a segment. What rises and falls by no more than rounding is no feature: by no more than
/// 1e-8 of the level's largest value; in levels above the first by no more than 1e-5 of what the first would
/// make of them if it changed within the curve's length; and where the first level is constant to 1e-5 of
/// itself, by no more than ripples of that height and of the length of a segment. Between the samples the places of
/// changes of sign are found by bisection, those of turning points too, by the exact slopes, up to level 3, unless
/// the samples' own places are enough.
pub(super) fn compare_levels(
    polygon: &FloatPolygon,
    curve: &dyn Differentiable,
    parameter: &dyn Fn(f64) -> f64,
    levels: usize,
    places: Places,
) -> Vec<LevelComparison> {
    let planar = polygon.is_planar();
    let samples = Samples::new(polygon, curve, parameter, planar);
    let continuous = polygon.degree() - 1;
    let mut compared = Vec::new();
    for torsion in [false, true] {
        if torsion && planar {
            continue;
        }
        for level in 1..=levels.min(LEVELS) {
            let order = 2 * level + usize::from(torsion);
            if order <= continuous {
                compared.push(samples.compared(polygon, curve, torsion, level, places));
            }
        }
    }
    compared
}

/// The levels of both curves at the same places.
struct Samples {
    u: Vec<f64>,
    t: Vec<f64>,
    here: Vec<CurvatureLevels>,
    there: Vec<CurvatureLevels>,
}

impl Samples {
    fn new(
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        planar: bool,
    ) -> Self {
        let (mut u, mut t, mut here, mut there) = (vec![], vec![], vec![], vec![]);
        for segment in 0..polygon.segments() {
            let expansion = SegmentExpansion::new(polygon, segment, planar);
            let last = segment + 1 == polygon.segments() && !polygon.is_periodic();
            for index in 0..SAMPLES + usize::from(last) {
                let local = index as f64 / SAMPLES as f64;
                let place = segment as f64 + local;
                let values = curve.derivatives(parameter(place), LEVEL_ORDER);
                if let Some(values) = values.first_chunk() {
                    u.push(place);
                    t.push(parameter(place));
                    here.push(expansion.curvature_levels(local, 1.0));
                    there.push(CurvatureLevels::of_derivatives(values, 1.0, planar));
                }
            }
        }
        Self { u, t, here, there }
    }

    fn compared(
        &self,
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        torsion: bool,
        level: usize,
        places: Places,
    ) -> LevelComparison {
        let here = values(&self.here, torsion, level);
        let there = values(&self.there, torsion, level);
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        let first = values(&self.there, torsion, 1);
        let length = polygon.arc_length(1e-3);
        let straight = STRAIGHT * largest(&first);
        let powers = 2 * level as i32 - 2;
        let natural = match (is_constant(&first, straight), level) {
            // Ripples have the length of a segment.
            (true, _) => straight / (length / polygon.segments() as f64).powi(powers),
            (false, 1) => 0.0,
            (false, _) => straight / length.powi(powers),
        };
        let noise = rounding(
            polygon,
            torsion,
            level,
            length,
            largest(&values(&self.there, false, 1)),
        );
        let least = (SHARE * largest(&there)).max(natural).max(noise);
        let periodic = polygon.is_periodic();
        let planar = polygon.is_planar();
        let side = |values: &[f64], parameters: &[f64], at: &dyn Fn(f64) -> CurvatureLevels| {
            let found = features(values, least, periodic).into_iter();
            let placed = found.map(|(index, feature)| {
                let place = match places {
                    Places::Samples => parameters[index],
                    Places::Refined => refined(values, parameters, (index, feature), &|place| {
                        let levels = at(place);
                        (
                            value(&levels, torsion, level),
                            slope(&levels, torsion, level),
                        )
                    }),
                };
                (place, feature)
            });
            placed.collect::<Vec<_>>()
        };
        let there = side(&there, &self.t, &|t| {
            let derivatives = curve.derivatives(t, LEVEL_ORDER);
            let derivatives = derivatives.first_chunk().copied();
            let derivatives = derivatives.unwrap_or([DVec3::NAN; LEVEL_ORDER + 1]);
            CurvatureLevels::of_derivatives(&derivatives, 1.0, planar)
        });
        let mut here = side(&here, &self.u, &|u| polygon.curvature_levels(u, 1.0));
        if periodic {
            turn_to(&mut here, &there);
        }
        LevelComparison {
            torsion,
            level,
            least,
            there,
            here,
        }
    }
}

/// The change of a level by rounding the vertices to doubles: each difference of neighbours doubles it.
fn rounding(
    polygon: &FloatPolygon,
    torsion: bool,
    level: usize,
    length: f64,
    curvature: f64,
) -> f64 {
    let reach = vector::reach(polygon.vertices());
    let speed = length / polygon.segments() as f64;
    let order = 2 * level + usize::from(torsion);
    let moved = f64::EPSILON * reach * (2.0 / speed).powi(order as i32);
    // The torsion is divided by the curvature once more.
    if torsion { moved / curvature } else { moved }
}

fn values(levels: &[CurvatureLevels], torsion: bool, level: usize) -> Vec<f64> {
    let values = levels.iter().map(|it| value(it, torsion, level));
    values.collect()
}

fn value(levels: &CurvatureLevels, torsion: bool, level: usize) -> f64 {
    match (torsion, levels.torsion) {
        (true, Some(torsion)) => torsion[level - 1],
        _ => levels.curvature[level - 1],
    }
}

/// The slope of a level; the last one's is not known.
fn slope(levels: &CurvatureLevels, torsion: bool, level: usize) -> Option<f64> {
    let slopes = match (torsion, levels.torsion_slopes) {
        (true, Some(slopes)) => slopes,
        _ => levels.curvature_slopes,
    };
    slopes.get(level - 1).copied()
}

/// Find the place of a feature between the samples beside it, by the value and the slope at a parameter. The
/// sample's own place stays where there is nothing to go by.
fn refined(
    values: &[f64],
    parameters: &[f64],
    (index, feature): (usize, LevelFeature),
    at: &dyn Fn(f64) -> (f64, Option<f64>),
) -> f64 {
    let own = parameters[index];
    let bracket = match feature {
        LevelFeature::Inflection => {
            let earlier = values[..index].iter();
            let before = earlier.rev().position(|it| it * values[index] < 0.0);
            before.map(|steps| [index - steps - 1, index - steps])
        }
        _ => index.checked_sub(1).map(|before| [before, index + 1]),
    };
    let bracket = bracket.filter(|[_, after]| *after < parameters.len());
    let Some([low, high]) = bracket.map(|it| it.map(|index| parameters[index])) else {
        return own;
    };
    let rising = |place: f64| {
        let (value, slope) = at(place);
        match feature {
            LevelFeature::Inflection => Some(value),
            _ => slope,
        }
    };
    let (Some(first), Some(last)) = (rising(low), rising(high)) else {
        return own;
    };
    if !(first * last < 0.0) {
        return own;
    }
    root([low, high], 0.0, |place| rising(place).unwrap_or(last))
}

/// Whether values differ by no more than `least`.
fn is_constant(values: &[f64], least: f64) -> bool {
    Range::of(values.iter().copied()).is_none_or(|range| range.high - range.low <= least)
}

/// Let the features round a periodic curve begin where they agree longest with others.
fn turn_to(here: &mut [(f64, LevelFeature)], there: &[(f64, LevelFeature)]) {
    let agreeing = |turn: usize| {
        let turned = here.iter().cycle().skip(turn).take(here.len());
        let pairs = turned.zip(there);
        pairs.take_while(|(here, there)| here.1 == there.1).count()
    };
    // Of equal ones the first counts.
    let best = (0..here.len()).rev().max_by_key(|turn| agreeing(*turn));
    here.rotate_left(best.unwrap_or(0));
}

/// List the changes of sign and the turning points of sampled values, with the number of the sample; round a
/// periodic curve the first value follows the last one. What does not rise or fall by more than `least` does
/// not count.
fn features(values: &[f64], least: f64, periodic: bool) -> Vec<(usize, LevelFeature)> {
    if !periodic {
        return features_along(values, least);
    }
    // Of three times round the second one counts: it knows what was before it, and what comes.
    let count = values.len();
    let found = features_along(&values.repeat(3), least).into_iter();
    found
        .filter(|(index, _)| (count..2 * count).contains(index))
        .map(|(index, feature)| (index - count, feature))
        .collect()
}

fn features_along(values: &[f64], least: f64) -> Vec<(usize, LevelFeature)> {
    let mut found = Vec::new();
    let numbered = values
        .iter()
        .copied()
        .enumerate()
        .filter(|(_, it)| it.is_finite());
    let (mut sign, mut rising): (Option<bool>, Option<bool>) = (None, None);
    let mut low: Option<(usize, f64)> = None;
    let mut high: Option<(usize, f64)> = None;
    for (index, value) in numbered {
        if value.abs() > least {
            let positive = value > 0.0;
            if sign.is_some_and(|sign| sign != positive) {
                found.push((index, LevelFeature::Inflection));
            }
            sign = Some(positive);
        }
        if low.is_none_or(|(_, low)| value < low) {
            low = Some((index, value));
        }
        if high.is_none_or(|(_, high)| value > high) {
            high = Some((index, value));
        }
        if let Some((place, lowest)) = low
            && value > lowest + least
            && rising != Some(true)
        {
            if rising == Some(false) {
                found.push((place, LevelFeature::Minimum));
            }
            (rising, high) = (Some(true), Some((index, value)));
        }
        if let Some((place, highest)) = high
            && value < highest - least
            && rising != Some(false)
        {
            if rising == Some(true) {
                found.push((place, LevelFeature::Maximum));
            }
            (rising, low) = (Some(false), Some((index, value)));
        }
    }
    found.sort_by_key(|(index, _)| *index);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_points_and_changes_of_sign_are_listed_in_their_order() {
        let values: Vec<f64> = (0..=100)
            .map(|index| (0.1 * f64::from(index)).sin())
            .collect();
        let kinds: Vec<LevelFeature> = features(&values, 1e-9, false)
            .into_iter()
            .map(|it| it.1)
            .collect();
        use LevelFeature::{Inflection, Maximum, Minimum};
        assert_eq!(
            kinds,
            [
                Maximum, Inflection, Minimum, Inflection, Maximum, Inflection
            ]
        );
    }

    #[test]
    fn round_a_periodic_curve_features_at_the_seam_count() {
        let wave = |index: i32| (std::f64::consts::TAU * f64::from(index) / 50.0).cos();
        let values: Vec<f64> = (0..50).map(wave).collect();
        use LevelFeature::{Inflection, Maximum, Minimum};
        let found = features(&values, 1e-9, true);
        let kinds: Vec<LevelFeature> = found.iter().map(|it| it.1).collect();
        assert_eq!(kinds, [Maximum, Inflection, Minimum, Inflection]);
        assert_eq!(found[0].0, 0);
        let mut turned = vec![
            (0.5, Minimum),
            (1.5, Inflection),
            (2.5, Maximum),
            (3.5, Inflection),
        ];
        let there: Vec<(f64, LevelFeature)> = kinds.into_iter().map(|kind| (0.0, kind)).collect();
        turn_to(&mut turned, &there);
        assert_eq!(turned[0], (2.5, Maximum));
    }

    #[test]
    fn what_is_only_rounding_is_no_feature() {
        let ripple = |index: i32| 1.0 + 1e-12 * f64::from(index % 3);
        let values: Vec<f64> = (0..50).map(ripple).collect();
        assert_eq!(features(&values, 1e-9, false), []);
        let rising: Vec<f64> = (0..50)
            .map(|index| f64::from(index) * 0.1 + ripple(index))
            .collect();
        assert_eq!(features(&rising, 1e-9, false), []);
    }
}
