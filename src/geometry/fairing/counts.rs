//! Numbers of features of a curve or a stretch of it, ripple apart.

use crate::geometry::features::{Extremum, Feature, Features};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;
use crate::geometry::sampler::{BATCH_ORDER, Batch, Sampler};

/// Extrema that differ by a smaller share of the extrema beside them count as ripple.
const RIPPLE: f64 = 0.05;

/// Samples of a segment, taken before its proof.
const SAMPLES: usize = 8;

/// Slopes below this share of the largest have no certain sign in doubles.
const UNCERTAIN: f64 = 1e-9;

/// Count the features that harmonising looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShapeCounts {
    /// Inflections of a planar curve; zeros of the torsion of one in space.
    pub inflections: usize,
    /// Extrema of the curvature.
    pub extrema: usize,
    /// Extrema of the torsion; none in the plane.
    pub torsion_extrema: usize,
}

impl ShapeCounts {
    /// The number of features too many, or too few of a kind with an exact request.
    pub(super) fn distance(self, request: CountRequest) -> usize {
        let apart = |has: usize, most: usize, exact: bool| {
            if exact {
                has.abs_diff(most)
            } else {
                has.saturating_sub(most)
            }
        };
        let (most, exact) = (request.counts, request.exact);
        apart(self.inflections, most.inflections, exact[0])
            + apart(self.extrema, most.extrema, exact[1])
            + apart(self.torsion_extrema, most.torsion_extrema, exact[2])
    }

    /// The number of features of all kinds that there are more of in another.
    pub(super) fn lacking(self, other: Self) -> usize {
        other.inflections.saturating_sub(self.inflections)
            + other.extrema.saturating_sub(self.extrema)
            + other.torsion_extrema.saturating_sub(self.torsion_extrema)
    }

    /// Whether there are more features of some kind than in another.
    pub(super) fn exceeds(self, other: Self) -> bool {
        self.inflections > other.inflections
            || self.extrema > other.extrema
            || self.torsion_extrema > other.torsion_extrema
    }
}

/// The requested numbers of features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CountRequest {
    /// The numbers.
    pub counts: ShapeCounts,
    /// Whether the numbers of inflections, extrema and torsion extrema are exact requests, or
    /// largest numbers.
    pub exact: [bool; 3],
}

impl CountRequest {
    /// Ask for just so many inflections, extrema and torsion extrema; `None` for any number.
    pub fn exactly([inflections, extrema, torsion_extrema]: [Option<usize>; 3]) -> Self {
        let any = usize::MAX;
        Self {
            counts: ShapeCounts {
                inflections: inflections.unwrap_or(any),
                extrema: extrema.unwrap_or(any),
                torsion_extrema: torsion_extrema.unwrap_or(any),
            },
            exact: [inflections, extrema, torsion_extrema].map(|count| count.is_some()),
        }
    }
}

/// The proved features of a stretch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ProvedCounts {
    pub(super) counts: ShapeCounts,
    pub(super) undecided: usize,
}

impl ProvedCounts {
    /// Whether the request is met.
    pub(super) fn has(self, request: CountRequest) -> bool {
        self.excess(request) == 0
    }

    /// The number of features too many or too few, with the undecided ones.
    pub(super) fn excess(self, request: CountRequest) -> usize {
        self.counts.distance(request) + self.undecided
    }
}

/// Count the proved features that lie in a stretch, of a periodic curve with u₀ > u₁ over the seam; `None` for the
/// whole curve.
pub(super) fn counted(
    features: &Features,
    planar: bool,
    stretch: Option<[f64; 2]>,
) -> ProvedCounts {
    let within = |u: [f64; 2]| match stretch {
        None => true,
        Some([from, to]) if from <= to => u[1] >= from && u[0] <= to,
        Some([from, to]) => u[1] >= from || u[0] <= to,
    };
    let number = |quantity: Feature| -> usize {
        let found = features.places(quantity).into_iter();
        let found = found.filter(|(u, _)| within(*u));
        found.map(|(_, count)| count).sum()
    };
    let inflection = match planar {
        true => Feature::Inflection,
        false => Feature::TorsionZero,
    };
    let doubts = features.undecided.iter().filter(|doubt| within(doubt.u));
    let cusps = features.cusps.iter().filter(|cusp| within(cusp.u));
    ProvedCounts {
        counts: ShapeCounts {
            inflections: number(inflection),
            extrema: number(Feature::CurvatureExtremum),
            torsion_extrema: number(Feature::TorsionExtremum),
        },
        undecided: doubts.count() + cusps.count(),
    }
}

/// Count the features that are more than ripple: extrema that stand out from their neighbours, and the changes of
/// sign between those and the ends.
pub(super) fn significant(
    polygon: &FloatPolygon,
    features: &Features,
    stretch: [f64; 2],
) -> ShapeCounts {
    let planar = polygon.is_planar();
    let cyclic = polygon.is_periodic() && stretch[1] - stretch[0] >= polygon.segments() as f64;
    let sequence = |extrema: &[Extremum], value: &dyn Fn(&Jet) -> f64| {
        let peak = |u: f64, known: f64| {
            let jet = polygon.jet(u);
            let value = if known.is_finite() {
                known
            } else {
                value(&jet)
            };
            let weight = jet.first.length_squared();
            Peak { value, weight }
        };
        let inside = extrema
            .iter()
            .filter(|extremum| extremum.u[1] >= stretch[0] && extremum.u[0] <= stretch[1]);
        let mut peaks: Vec<Peak> = inside
            .map(|extremum| {
                let [low, high] = extremum.value;
                peak(0.5 * (extremum.u[0] + extremum.u[1]), 0.5 * (low + high))
            })
            .collect();
        if !cyclic {
            peaks.insert(0, peak(stretch[0], f64::NAN));
            peaks.push(peak(stretch[1], f64::NAN));
        }
        let left = prominent(peaks, cyclic);
        left.into_iter()
            .map(|peak| peak.value)
            .collect::<Vec<f64>>()
    };
    let curvature = sequence(&features.curvature_extrema, &|jet| jet.curvature_of(planar));
    let torsion = if planar {
        Vec::new()
    } else {
        sequence(&features.torsion_extrema, &Jet::torsion)
    };
    let ends = if cyclic { 0 } else { 2 };
    ShapeCounts {
        inflections: sign_changes(if planar { &curvature } else { &torsion }, cyclic),
        extrema: curvature.len().saturating_sub(ends),
        torsion_extrema: torsion.len().saturating_sub(ends),
    }
}

/// An extremum of the curvature, or an end. A wave of the curvature by k over a leg moves the curve by about
/// k |C′|², so that curvatures count by |C′|²: a sharp nose of short legs does not hide a calm body.
#[derive(Clone, Copy)]
struct Peak {
    value: f64,
    weight: f64,
}

/// Take out of a sequence of extrema, the two ends among them unless it is cyclic, two that differ by less than 5 %
/// of the larger of their neighbours, those that differ least first. Where the curvature hardly changes at all, as on
/// an arc, they are compared with its range.
fn prominent(mut peaks: Vec<Peak>, cyclic: bool) -> Vec<Peak> {
    peaks.retain(|peak| peak.value.is_finite());
    let values = || peaks.iter().map(|peak| peak.value);
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let is_even = high - low < RIPPLE * low.abs().max(high.abs());
    loop {
        let count = peaks.len();
        if count <= 2 {
            return peaks;
        }
        let pairs = if cyclic { count } else { count - 1 };
        let share = |pair: usize| {
            let [a, b] = [peaks[pair], peaks[(pair + 1) % count]];
            if is_even {
                return (b.value - a.value).abs() / (high - low);
            }
            let before = (cyclic || pair > 0).then(|| (pair + count - 1) % count);
            let behind = (cyclic || pair + 2 < count).then(|| (pair + 2) % count);
            let beside = before.into_iter().chain(behind).map(|index| peaks[index]);
            let size = beside.fold(0.0_f64, |most, it| most.max(it.value.abs() * it.weight));
            (b.value - a.value).abs() * a.weight.max(b.weight) / size
        };
        let smallest = (0..pairs).min_by(|a, b| share(*a).total_cmp(&share(*b)));
        let Some(pair) = smallest.filter(|pair| share(*pair) < RIPPLE) else {
            return peaks;
        };
        let next = (pair + 1) % count;
        if cyclic || (pair > 0 && next < count - 1) {
            // A maximum and a minimum go together.
            peaks.remove(pair.max(next));
            peaks.remove(pair.min(next));
        } else {
            // The end stands for the extremum beside it.
            peaks.remove(if pair == 0 { next } else { pair });
        }
    }
}

fn sign_changes(values: &[f64], cyclic: bool) -> usize {
    let signs: Vec<bool> = values
        .iter()
        .filter(|value| **value != 0.0)
        .map(|value| *value > 0.0)
        .collect();
    let inside = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let around = cyclic && signs.first() != signs.last();
    inside + usize::from(around)
}

/// Look at samples how many features a stretch has at least. What is not seen here may still be
/// there.
pub(super) fn seen(polygon: &FloatPolygon, stretch: [f64; 2]) -> ShapeCounts {
    let planar = polygon.is_planar();
    let sampler = Sampler::even(polygon.degree(), SAMPLES);
    let mut batch = Batch::default();
    let mut series: [Vec<f64>; 4] = Default::default();
    let first = stretch[0].max(0.0).floor() as usize;
    let last = (stretch[1].ceil() as usize).min(polygon.segments());
    for segment in first..last {
        sampler.segment(polygon, segment, BATCH_ORDER, &mut batch);
        for index in 0..batch.len() {
            let u = segment as f64 + index as f64 / SAMPLES as f64;
            if u < stretch[0] || u > stretch[1] {
                continue;
            }
            let jet = batch.jet(index);
            series[0].push(jet.curvature_slope(planar));
            if planar {
                series[1].push(jet.signed_curvature());
            } else {
                series[1].push(jet.torsion());
            }
        }
    }
    if !planar {
        let torsion = &series[1];
        series[2] = torsion.windows(2).map(|pair| pair[1] - pair[0]).collect();
    }
    ShapeCounts {
        extrema: certain_changes(&series[0]),
        inflections: certain_changes(&series[1]),
        torsion_extrema: certain_changes(&series[2]),
    }
}

fn certain_changes(values: &[f64]) -> usize {
    let finite = values.iter().filter(|value| value.is_finite());
    let largest = finite
        .clone()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let certain: Vec<f64> = finite
        .filter(|value| value.abs() > UNCERTAIN * largest)
        .copied()
        .collect();
    sign_changes(&certain, false)
}

/// The whole domain of a curve.
pub(super) fn domain(polygon: &FloatPolygon) -> [f64; 2] {
    [0.0, polygon.segments() as f64]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ripple_is_told_from_what_stands_out() {
        let cases: [(&[f64], bool, usize, usize); 7] = [
            // A small bump on a slope.
            (&[0.0, 5.0, 4.9, 10.0], false, 0, 0),
            // A hump with ripple on its top.
            (&[0.0, 9.9, 9.8, 10.0, 0.0], false, 1, 0),
            // An extremum beside the end.
            (&[0.0, -0.1, 10.0], false, 0, 0),
            // Small waves about 0 on the way through.
            (&[-10.0, 0.2, -0.2, 10.0], false, 0, 1),
            // An arc of an approximated circle.
            (&[1.0, 1.001, 1.0], false, 1, 0),
            // A wave beside a nose of short legs.
            (&[1.0, 0.8, 1.0, 0.8, 100.0, 1.0], false, 4, 0),
            // An oval with ripple.
            (&[1.0, 2.0, 1.0, 1.99, 1.98, 2.0], true, 4, 0),
        ];
        for (values, cyclic, extrema, changes) in cases {
            let weight = |value: f64| if value < 100.0 { 1.0 } else { 1e-4 };
            let peaks = values.iter().map(|value| Peak {
                value: *value,
                weight: weight(*value),
            });
            let left = prominent(peaks.collect(), cyclic);
            let left: Vec<f64> = left.into_iter().map(|peak| peak.value).collect();
            let ends = if cyclic { 0 } else { 2 };
            assert_eq!(left.len() - ends, extrema, "{values:?}: {left:?}");
            assert_eq!(sign_changes(&left, cyclic), changes, "{values:?}: {left:?}");
        }
    }
}
