//! Points, and the splines that are fitted to them.

use glam::DVec2;

use super::banded_rows::{BandMatrix, Layout, Rows};
use super::monotone_runs::best_runs;
use super::sign_runs::SignRuns;
use super::slope_coefficients::SlopeTables;
use super::splines::Splines;
use super::symmetry_axis::SymmetryAxis;
use crate::geometry::banded::difference_stencil;
use crate::geometry::end::End;

/// Vertices that a difference of legs reaches over.
pub(super) const LEG_REACH: usize = 4;

/// Samples of a segment where the curvature is looked at, and where a curve is resampled.
const SAMPLES: usize = 6;

/// The weight of third differences, by points a vertex, when a curve is resampled.
const FAIR_RESAMPLED: f64 = 1e-10;

/// The share of the mean diagonal that keeps an equation regular.
const REGULAR: f64 = 1e-15;

/// Solutions of an equation, each for what the one before misses.
const ROUNDS: usize = 4;

/// A condition at an end of an open curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) struct EndCondition {
    /// Which end.
    pub(in crate::geometry) end: End,
    /// What it must have.
    pub(in crate::geometry) value: EndValue,
}

/// What an end must have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) enum EndValue {
    /// The point.
    Point(DVec2),
    /// The unit tangent, along the curve.
    Direction(DVec2),
    /// The signed curvature.
    Curvature(f64),
}

/// A vertex that stays where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HeldVertex {
    pub(super) vertex: usize,
    pub(super) point: DVec2,
}

/// Points with weights, and conditions at the ends and on vertices.
#[derive(Clone, Copy)]
pub(super) struct Data<'a> {
    pub(super) points: &'a [DVec2],
    pub(super) weights: &'a [f64],
    /// Which points count in errors; the others only guide the curve.
    pub(super) counts: &'a [bool],
    pub(super) ends: &'a [EndCondition],
    /// The vertices that stay, of a curve with the number of vertices asked for.
    pub(super) held: &'a [HeldVertex],
    /// The axis in which the curve is its own mirror image.
    pub(super) mirror: Option<SymmetryAxis>,
    /// Whether the outer legs go on evenly: few points tell how a curve ends, the samples of a curve do.
    pub(super) calms_ends: bool,
}

impl Data<'_> {
    /// The weights, with 0 for those of points that do not count.
    pub(super) fn without_light(&self) -> Vec<f64> {
        let weights = self.weights.iter().zip(self.counts);
        let weights = weights.map(|(weight, counts)| if *counts { *weight } else { 0.0 });
        weights.collect()
    }
}

/// The fit of splines with one number of vertices.
pub(super) struct Problem<'a> {
    pub(super) data: Data<'a>,
    pub(super) splines: Splines,
    pub(super) tables: &'a SlopeTables,
    pub(super) layout: Layout,
    /// The parameter of each member of the slope.
    pub(super) slope_places: Vec<f64>,
}

/// A curve with the parameters of its nearest points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedCurve {
    pub(super) vertices: Vec<DVec2>,
    pub(super) places: Vec<f64>,
}

/// A curve sampled at even parameters.
pub(super) struct Evenly {
    pub(super) places: Vec<f64>,
    pub(super) curvatures: Vec<f64>,
    /// The lengths of the curve between two samples.
    pub(super) steps: Vec<f64>,
}

impl Evenly {
    /// How much each curvature counts: a wave of the curvature κ over a leg h moves the curve by about κ h², so that
    /// the weights are h⁴.
    pub(super) fn weights(&self) -> Vec<f64> {
        let fourth = |step: &f64| step.powi(4);
        let mean = self.steps.iter().map(fourth).sum::<f64>() / self.steps.len() as f64;
        self.steps.iter().map(|step| fourth(step) / mean).collect()
    }
}

/// Where a search begins: a curve, and the signs of slope and curvature along it.
#[derive(Clone, Debug)]
pub(super) struct Start {
    pub(super) curve: PlacedCurve,
    /// The signs of the members of the slope.
    pub(super) slopes: SignRuns,
    /// The signs of the members of the curvature, if inflections are asked for.
    pub(super) bends: Option<SignRuns>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(data: Data<'a>, splines: Splines, tables: &'a SlopeTables) -> Self {
        let reach = (splines.degree + 1).max(LEG_REACH);
        let mut problem = Self {
            data,
            splines,
            tables,
            layout: Layout::new(splines.count, reach, splines.periodic),
            slope_places: Vec::new(),
        };
        let degree = tables.slopes().saturating_sub(1).max(1) as f64;
        for segment in 0..splines.segments() {
            let first = usize::from(problem.shares_slopes(segment));
            let places = (first..tables.slopes()).map(|it| segment as f64 + it as f64 / degree);
            problem.slope_places.extend(places);
        }
        problem
    }

    /// From each point to the curve.
    pub(super) fn offsets(&self, curve: &PlacedCurve) -> Vec<DVec2> {
        let placed = self.data.points.iter().zip(&curve.places);
        placed
            .map(|(point, u)| self.splines.point(&curve.vertices, *u) - *point)
            .collect()
    }

    /// The root of the mean squared distance, weighed, and the largest distance of the points that count.
    pub(super) fn errors(&self, curve: &PlacedCurve) -> [f64; 2] {
        let offsets = self.offsets(curve);
        let weighed = offsets.iter().zip(self.data.weights).zip(self.data.counts);
        let (mut sum, mut most, mut all) = (0.0, 0.0_f64, 0.0);
        for ((offset, weight), _) in weighed.filter(|(_, counts)| **counts) {
            sum += weight * offset.length_squared();
            most = most.max(offset.length());
            all += weight;
        }
        [(sum / all.max(f64::MIN_POSITIVE)).sqrt(), most]
    }

    /// Refine the parameters of the points.
    pub(super) fn project(&self, curve: &mut PlacedCurve, steps: usize) {
        let PlacedCurve { vertices, places } = curve;
        self.splines
            .project(vertices, self.data.points, places, steps);
    }

    /// Solve for least squares with third differences, and refine the parameters; so often.
    pub(super) fn smoothed(
        &self,
        places: Vec<f64>,
        fair: f64,
        rounds: usize,
    ) -> Option<PlacedCurve> {
        let mut curve = PlacedCurve {
            vertices: Vec::new(),
            places,
        };
        let weight = fair * self.data.weights.iter().sum::<f64>() / self.splines.count as f64;
        for _ in 0..rounds {
            curve.vertices = self.least_squares(&curve.places, self.data, weight)?;
            self.project(&mut curve, 3);
        }
        Some(curve)
    }

    /// Minimise Σ w |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|². `None` if the equations are singular.
    fn least_squares(&self, places: &[f64], data: Data, fair: f64) -> Option<Vec<DVec2>> {
        let splines = &self.splines;
        let mut rows = [Rows::new(splines.degree + 1), Rows::new(splines.degree + 1)];
        for u in places {
            let (segment, basis) = splines.basis(*u);
            for (axis, rows) in rows.iter_mut().enumerate() {
                rows.push(segment, interleaved(&basis, splines.degree, axis));
            }
        }
        let differences = self.third_differences();
        let fair = vec![fair; differences[0].firsts.len()];
        let mut matrix = BandMatrix::new(&self.layout);
        for (rows, differences) in rows.iter().zip(&differences) {
            self.layout.add_squares(rows, data.weights, &mut matrix);
            self.layout.add_squares(differences, &fair, &mut matrix);
        }
        if let Some(mirror) = data.mirror {
            self.layout.symmetrise(mirror, &mut matrix);
        }
        let trace: f64 = matrix.diagonal().sum();
        matrix.add_to_diagonal(REGULAR * trace);
        let factor = matrix.factor()?;
        let mut solved = vec![0.0; self.layout.unknowns()];
        // Later rounds give back what the larger diagonal took.
        for _ in 0..ROUNDS {
            let mut missing = vec![0.0; solved.len()];
            for (axis, (rows, differences)) in rows.iter().zip(&differences).enumerate() {
                let reached = self.layout.times(rows, &solved);
                let offsets = data.points.iter().zip(reached).zip(data.weights);
                let offsets =
                    offsets.map(|((point, reached), weight)| weight * (point[axis] - reached));
                let offsets: Vec<f64> = offsets.collect();
                self.layout.add_transposed(rows, &offsets, &mut missing);
                let unfair = self
                    .layout
                    .times(differences, &solved)
                    .into_iter()
                    .zip(&fair);
                let unfair: Vec<f64> = unfair.map(|(it, weight)| -weight * it).collect();
                self.layout
                    .add_transposed(differences, &unfair, &mut missing);
            }
            if let Some(mirror) = data.mirror {
                self.layout.symmetrise_right(mirror, &mut missing);
            }
            for (value, correction) in solved.iter_mut().zip(factor.solve(&missing)) {
                *value += correction;
            }
        }
        let vertex = |vertex: usize| {
            let unknown = self.layout.unknown(vertex);
            DVec2::new(solved[unknown], solved[unknown + 1])
        };
        let mut vertices: Vec<DVec2> = (0..splines.count).map(vertex).collect();
        if let Some(mirror) = data.mirror {
            mirror.symmetrise(&mut vertices);
        }
        vertices
            .iter()
            .all(|vertex| vertex.is_finite())
            .then_some(vertices)
    }

    /// The third differences of the vertices, or the highest that there are, by axis.
    fn third_differences(&self) -> [Rows; 2] {
        let count = self.splines.count;
        let order = 3.min(count - 1);
        let stencil = difference_stencil(order);
        let firsts = if self.splines.periodic {
            count
        } else {
            count - order
        };
        [0, 1].map(|axis| {
            let mut rows = Rows::new(order + 1);
            for first in 0..firsts {
                rows.push(first, interleaved(&stencil, order, axis));
            }
            rows
        })
    }

    /// Sample the curve evenly.
    pub(super) fn sampled(&self, vertices: &[DVec2]) -> Evenly {
        let samples = SAMPLES * self.splines.segments();
        let count = samples + usize::from(!self.splines.periodic);
        let places: Vec<f64> = (0..count).map(|it| it as f64 / SAMPLES as f64).collect();
        let jets = places.iter().map(|u| {
            let [_, first, second] = self.splines.jet(vertices, *u);
            let speed = first.length().max(f64::MIN_POSITIVE);
            let curvature = first.perp_dot(second) / speed.powi(3);
            (curvature, speed / SAMPLES as f64)
        });
        let (curvatures, steps) = jets.unzip();
        Evenly {
            places,
            curvatures,
            steps,
        }
    }

    /// The signs of the members of the slope that suit the curvature best, with so many changes: those of
    /// both beginnings, the better one first.
    pub(super) fn slope_runs(&self, vertices: &[DVec2], extrema: usize) -> [SignRuns; 2] {
        let sampled = self.sampled(vertices);
        let mut weights = sampled.weights();
        let Evenly {
            places,
            mut curvatures,
            ..
        } = sampled;
        // Of mirror images the first half tells all, and in the middle there is an extremum.
        let own = match self.data.mirror {
            Some(_) => {
                curvatures.truncate(places.len().div_ceil(2));
                weights.truncate(places.len().div_ceil(2));
                extrema / 2
            }
            None => extrema,
        };
        best_runs(&curvatures, &weights, own).map(|runs| {
            let turns = runs.turns.iter().map(|turn| {
                let before = places[turn.saturating_sub(1).min(places.len() - 1)];
                let turn = 0.5 * (before + places[(*turn).min(places.len() - 1)]);
                self.slope_member(turn)
            });
            let mut cuts: Vec<usize> = turns.collect();
            cuts.resize(extrema, self.slope_places.len());
            let runs = SignRuns {
                begins_positive: runs.begins_rising,
                cuts,
            };
            self.spread_slopes(runs)
        })
    }

    /// The signs of the members of the curvature with so many changes that waste least of it.
    pub(super) fn bend_runs(&self, vertices: &[DVec2], inflections: usize) -> SignRuns {
        let values: Vec<f64> = (0..self.splines.segments())
            .flat_map(|segment| {
                let found = self
                    .tables
                    .on_segment(&self.splines, vertices, segment, false);
                found.bends
            })
            .collect();
        let best = [true, false].map(|begins_positive| {
            let (wasted, cuts) = least_wasted(&values, begins_positive, inflections);
            let runs = SignRuns {
                begins_positive,
                cuts,
            };
            (wasted, runs)
        });
        let [positive, negative] = best;
        let (_, runs) = if positive.0 <= negative.0 {
            positive
        } else {
            negative
        };
        self.spread_bends(runs)
    }

    /// Whether an end must have a curvature.
    pub(super) fn bends_at(&self, end: End) -> bool {
        let mut ends = self.data.ends.iter();
        ends.any(|it| it.end == end && matches!(it.value, EndValue::Curvature(_)))
    }

    /// Whether the first member of a segment's slope is the last of the segment before.
    pub(super) fn shares_slopes(&self, segment: usize) -> bool {
        self.splines.degree > 3 && (segment > 0 || self.splines.periodic)
    }

    /// The first member of the slope from a parameter on.
    fn slope_member(&self, u: f64) -> usize {
        self.slope_places.partition_point(|place| *place < u)
    }

    /// Leave each inner run of slopes a segment's worth of members, so that it contains the end of a segment.
    pub(super) fn spread_slopes(&self, runs: SignRuns) -> SignRuns {
        self.spread(runs, self.slope_places.len(), self.tables.slopes())
    }

    /// The same for the curvature.
    fn spread_bends(&self, runs: SignRuns) -> SignRuns {
        let members = self.tables.bends() * self.splines.segments();
        self.spread(runs, members, self.tables.bends())
    }

    fn spread(&self, mut runs: SignRuns, members: usize, least: usize) -> SignRuns {
        if self.data.mirror.is_some() {
            runs.symmetrise(members);
        }
        let mut runs = runs.spread(members, least);
        if self.data.mirror.is_some() {
            runs.symmetrise(members);
        }
        runs
    }

    /// Nearly the same start for another number of vertices.
    pub(super) fn resampled(&self, old: &Problem, start: &Start) -> Option<Start> {
        let [end, old_end] = [self.splines.end(), old.splines.end()];
        let samples = SAMPLES * self.splines.segments().max(old.splines.segments());
        let count = samples + usize::from(!self.splines.periodic);
        let shares: Vec<f64> = (0..count).map(|it| it as f64 / samples as f64).collect();
        let points = shares.iter();
        let points = points.map(|share| old.splines.point(&start.curve.vertices, share * old_end));
        let points: Vec<DVec2> = points.collect();
        let even = vec![1.0; points.len()];
        let data = Data {
            points: &points,
            weights: &even,
            counts: &[],
            ends: &[],
            held: &[],
            mirror: self.data.mirror,
            calms_ends: false,
        };
        let places: Vec<f64> = shares.iter().map(|share| share * end).collect();
        let share = end / old_end;
        let mut curve = PlacedCurve {
            vertices: self.least_squares(&places, data, FAIR_RESAMPLED)?,
            places: start.curve.places.iter().map(|u| u * share).collect(),
        };
        self.project(&mut curve, 3);
        let moved = |cut: &usize| {
            self.slope_member(share * old.slope_places[(*cut).min(old.slope_places.len() - 1)])
        };
        let slopes = SignRuns {
            begins_positive: start.slopes.begins_positive,
            cuts: start.slopes.cuts.iter().map(moved).collect(),
        };
        let bends = start.bends.as_ref().map(|bends| {
            let moved = |cut: &usize| (share * *cut as f64) as usize;
            self.spread_bends(SignRuns {
                begins_positive: bends.begins_positive,
                cuts: bends.cuts.iter().map(moved).collect(),
            })
        });
        Some(Start {
            curve,
            slopes: self.spread_slopes(slopes),
            bends,
        })
    }
}

/// Write a row of numbers for one axis, with zeros for the other one.
pub(super) fn interleaved(
    row: &[f64],
    degree: usize,
    axis: usize,
) -> impl Iterator<Item = f64> + '_ {
    let entries = row.iter().take(degree + 1);
    entries.flat_map(move |value| [value * (1 - axis) as f64, value * axis as f64])
}

/// The sum of what has the wrong sign, and the cuts, for the signs that waste least.
fn least_wasted(values: &[f64], begins_positive: bool, cuts: usize) -> (f64, Vec<usize>) {
    // Up to each member, what is wasted so far in a run with one sign.
    let wasted = |positive: bool| {
        let mut sum = 0.0;
        let mut sums = vec![0.0];
        for value in values {
            sum += if positive { -value } else { *value }.max(0.0);
            sums.push(sum);
        }
        sums
    };
    let [positive, negative] = [true, false].map(wasted);
    let of = |positive_run: bool| if positive_run { &positive } else { &negative };
    let mut best: Vec<f64> = of(begins_positive).clone();
    let mut begins: Vec<Vec<usize>> = Vec::new();
    let mut sign = begins_positive;
    for _ in 0..cuts {
        sign = !sign;
        let run = of(sign);
        let mut least = 0;
        let mut begin = Vec::new();
        for end in 0..best.len() {
            if best[end] - run[end] < best[least] - run[least] {
                least = end;
            }
            begin.push(least);
        }
        best = (0..best.len())
            .map(|end| best[begin[end]] - run[begin[end]] + run[end])
            .collect();
        begins.push(begin);
    }
    let mut end = values.len();
    let mut found = Vec::new();
    for begin in begins.iter().rev() {
        end = begin[end];
        found.push(end);
    }
    found.reverse();
    (best[values.len()], found)
}
