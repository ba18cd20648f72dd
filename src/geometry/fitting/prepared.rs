//! Points as a fit takes them.

use glam::{DVec2, DVec3};

use super::counted_points::{CountedPoints, ENOUGH, MANY, every, kept_of};
use super::error::FitError;
use super::levels::size;
use super::neighbours::with_middles;
use super::plane_fit::{Extrema, PlaneFit};
use super::problem::{EndCondition, EndValue};
use super::symmetry_axis::SymmetryAxis;
use crate::geometry::control_polygon::check_size;
use crate::geometry::end::End;

/// Without a tolerance, the one that counts: a share of the size, or so many times the noise, or what the largest of
/// many normal errors is.
const NEAR: f64 = 5e-4;
const NOISE: f64 = 3.0;

/// The most points that a fit is refined on. They leave nothing to bulge between them, and their errors cancel.
const DENSE: usize = 20_000;

/// Coordinates of the middle are multiples of this share of the unit: their sums have no rounding.
const GRID: f64 = 1.0 / (1 << 20) as f64;

/// Points beyond the extrema of their discrete curvature.
const OUTER: usize = 4;

/// Points as they are fitted: those that count, about the origin, about 1 large.
pub(super) struct Prepared {
    /// With light ones between them.
    pub(super) points: Vec<DVec2>,
    pub(super) weights: Vec<f64>,
    /// Which of them are no light ones, and how many.
    pub(super) counts: Vec<bool>,
    pub(super) counting: usize,
    pub(super) middle: DVec2,
    pub(super) unit: f64,
    pub(super) noise: f64,
    pub(super) tolerance: f64,
    /// Whether that is what the noise allows: none was asked for, and the share of the size is less.
    pub(super) is_noisy: bool,
    pub(super) outliers: Vec<usize>,
    pub(super) repeated: Vec<usize>,
    pub(super) ends: Vec<EndCondition>,
}

impl Prepared {
    pub(super) fn new(points: &[DVec2], asked: &PlaneFit) -> Result<Self, FitError> {
        check_size(asked.degree, asked.count.unwrap_or(asked.degree + 1), false)?;
        let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let unit = 2.0_f64.powi((high - low).max_element().log2().ceil() as i32);
        // Of few digits, so that straight curves stay straight when they are moved back.
        let middle = 0.5 * low + 0.5 * high;
        let mut middle = unit * (middle / (unit * GRID)).round() * GRID;
        if let Some(mirror) = asked.mirror {
            middle = mirror.onto_axis(middle);
        }
        let degree = asked.degree;
        if !(unit > 0.0 && unit.is_finite()) {
            let found = points.len().min(1);
            return Err(FitError::TooFewPoints { found, degree });
        }
        let scaled = points
            .iter()
            .map(|point| ((*point - middle) / unit).extend(0.0));
        let scaled: Vec<DVec3> = scaled.collect();
        let left_out = asked.outliers.as_deref();
        let counted =
            CountedPoints::new(&scaled, asked.periodic, left_out, asked.weights.as_deref());
        let differing = points.len() - counted.repeated.len();
        let found = counted.points.len();
        if differing.min(found) < degree + 1 {
            return Err(FitError::TooFewPoints { found, degree });
        }
        if let Some(count) = asked.count.filter(|count| *count > differing) {
            let points = differing;
            return Err(FitError::TooManyVertices { count, points });
        }
        if let Extrema::Exactly(extrema) = asked.extrema
            && extrema + OUTER > differing
        {
            return Err(FitError::TooManyExtrema {
                extrema,
                count: differing,
                of: "points",
                needed: extrema + OUTER,
            });
        }
        let noise = counted.noise_of_counting();
        let weights = counted.weights;
        let counting: Vec<DVec2> = counted.points.iter().map(|it| it.truncate()).collect();
        let normal = (2.0 * (found as f64).ln()).sqrt();
        let [near, noisy] = [NEAR * size(&counting), NOISE.max(normal) * noise];
        let tolerance = asked.tolerance.map_or(near.max(noisy), |it| it / unit);
        let ends = ends(&counting, asked, unit);
        // Many points leave nothing to bulge between them.
        let (all, counts) = match asked.periodic || found > DENSE {
            true => (
                counted.points.into_iter().zip(weights).collect(),
                vec![true; found],
            ),
            false => with_middles(&counted.points, &weights),
        };
        let all = all.into_iter();
        let (points, weights) = all
            .map(|(point, weight)| (point.truncate(), weight))
            .unzip();
        Ok(Self {
            points,
            weights,
            counts,
            counting: found,
            middle,
            unit,
            noise,
            tolerance,
            is_noisy: asked.tolerance.is_none() && noisy > near,
            outliers: counted.outliers,
            repeated: counted.repeated,
            ends,
        })
    }

    /// Those that a fit is refined on: all, or some of very many.
    pub(super) fn refined_on(self, asked: &PlaneFit) -> Self {
        self.some(asked, [DENSE, DENSE]).unwrap_or(self)
    }

    /// Those that the search looks at, if they are not all.
    pub(super) fn thinned(&self, asked: &PlaneFit) -> Option<Self> {
        self.some(asked, [MANY, ENOUGH])
    }

    /// About `enough` of more than `many` points, evenly, with the first and the last one.
    fn some(&self, asked: &PlaneFit, [many, enough]: [usize; 2]) -> Option<Self> {
        if self.counting <= many {
            return None;
        }
        let heavy = self.points.iter().zip(&self.weights).zip(&self.counts);
        let heavy = heavy.filter(|(_, counts)| **counts);
        let heavy: Vec<(DVec3, f64)> = heavy
            .map(|((at, weight), _)| (at.extend(0.0), *weight))
            .collect();
        let kept = every(&heavy, enough);
        let counting = kept.len();
        let (points, weights): (Vec<DVec3>, Vec<f64>) = kept.iter().copied().unzip();
        let (all, counts) = match asked.periodic {
            true => (kept, vec![true; counting]),
            false => with_middles(&points, &weights),
        };
        let all = all.into_iter();
        let (points, weights) = all
            .map(|(point, weight)| (point.truncate(), weight))
            .unzip();
        Some(Self {
            points,
            weights,
            counts,
            counting,
            outliers: self.outliers.clone(),
            repeated: self.repeated.clone(),
            ends: self.ends.clone(),
            ..*self
        })
    }

    /// The parameters of all points by those of the thinned ones.
    pub(super) fn places_of_all(
        &self,
        thinned: &Self,
        places: &[f64],
        end: f64,
        periodic: bool,
    ) -> Vec<f64> {
        let heavy = places.iter().zip(&thinned.counts);
        let heavy = heavy.filter_map(|(place, counts)| counts.then_some(*place));
        let mut known: Vec<(f64, f64)> = kept_of(self.counting, ENOUGH)
            .iter()
            .map(|it| *it as f64)
            .zip(heavy)
            .collect();
        if let (true, Some((_, first))) = (periodic, known.first().copied()) {
            known.push((self.counting as f64, first + end));
        }
        let mut before = 0;
        let place = |counts: &bool| {
            // Light points lie between two others.
            let at = if *counts {
                before as f64
            } else {
                before as f64 - 0.5
            };
            before += usize::from(*counts);
            let behind = known.partition_point(|(own, _)| *own <= at);
            let behind = behind.clamp(1, known.len() - 1);
            let ((a, from), (b, to)) = (known[behind - 1], known[behind]);
            let to = if periodic && to < from { to + end } else { to };
            let place = from + (to - from) * (at - a) / (b - a);
            match periodic {
                true => place.rem_euclid(end),
                false => place.clamp(0.0, end),
            }
        };
        self.counts.iter().map(place).collect()
    }
}

/// The conditions at the ends of an open curve.
fn ends(points: &[DVec2], asked: &PlaneFit, unit: f64) -> Vec<EndCondition> {
    let mut conditions = Vec::new();
    if asked.periodic {
        return conditions;
    }
    if let Some(mirror) = asked.mirror {
        return mirrored_ends(points, asked, unit, mirror);
    }
    let outer = [points.first(), points.last()];
    for (index, end) in [End::Start, End::Finish].into_iter().enumerate() {
        let point = outer[index].filter(|_| asked.exact_ends[index]);
        let values = [
            point.map(|point| EndValue::Point(*point)),
            asked.directions[index].map(EndValue::Direction),
            asked.curvatures[index].map(|curvature| EndValue::Curvature(curvature * unit)),
        ];
        let values = values.into_iter().flatten();
        conditions.extend(values.map(|value| EndCondition { end, value }));
    }
    conditions
}

/// The conditions at the start of a curve that is its own mirror image, or those at its end as they are there; the
/// images hold at its end.
fn mirrored_ends(
    points: &[DVec2],
    asked: &PlaneFit,
    unit: f64,
    mirror: SymmetryAxis,
) -> Vec<EndCondition> {
    let [first, last] = [points.first().copied(), points.last().copied()];
    let image = |vector: Option<DVec2>| vector.map(|it| mirror.image(it));
    let [exact, exact_last] = asked.exact_ends;
    let point = first.filter(|_| exact);
    let point = point.or(image(last).filter(|_| exact_last));
    let [direction, end_direction] = asked.directions;
    // The end runs the other way.
    let direction = direction.or(image(end_direction).map(|it| -it));
    let curvature = asked.curvatures[0].or(asked.curvatures[1]);
    let values = [
        point.map(EndValue::Point),
        direction.map(EndValue::Direction),
        curvature.map(|curvature| EndValue::Curvature(curvature * unit)),
    ];
    let values = values.into_iter().flatten();
    let at_start = values.map(|value| EndCondition {
        end: End::Start,
        value,
    });
    let both = at_start.flat_map(|start| {
        let value = match start.value {
            EndValue::Point(point) => EndValue::Point(mirror.image(point)),
            EndValue::Direction(direction) => EndValue::Direction(-mirror.image(direction)),
            EndValue::Curvature(curvature) => EndValue::Curvature(curvature),
        };
        let end = End::Finish;
        [start, EndCondition { end, value }]
    });
    both.collect()
}
