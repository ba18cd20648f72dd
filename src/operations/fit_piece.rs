//! The points of one of the curves that a fit makes.

use glam::{DVec2, DVec3};

use super::error::OperationError;
use super::targets::{SHARE_OF_SIZE, place_of};
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::fairing::counts::CountRequest;
use crate::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::fitting::{
    Extrema, FitError, Fitted, PlaneFit, corners, fit_plane_corrected, is_closed,
};
use crate::geometry::{End, FloatPolygon, Progress};

/// A curve with exact ends may be so many times as far off as one that crosses itself.
const FARTHER: f64 = 1.5;

/// The share of the time for a curve whose ends may cross, and how near they are then, by the size of the points.
const FIRST: f64 = 0.8;

/// How many more extrema than the fewest a fit with exact ends is tried with where that crosses itself.
const MORE: usize = 2;
const NEAR: f64 = 0.05;

/// The most that a curve moves to meet its ends to the last digits, in units of its size.
const ROUNDING: f64 = 1e-5;

/// The pieces of points, one for each curve: all, or those between corners, where closed points begin at a corner. The
/// corners come with them.
pub(super) fn pieces(
    points: &[DVec2],
    periodic: bool,
    are_split: bool,
) -> (Vec<Piece>, Vec<usize>) {
    let in_space: Vec<DVec3> = points.iter().map(|point| point.extend(0.0)).collect();
    let is_closed = is_closed(&in_space);
    let goes_round = periodic || is_closed;
    let count = points.len();
    let ring = count - usize::from(is_closed && count > 1);
    let mut corners = corners(&points[..ring], goes_round);
    if !periodic && !are_split {
        // The curve begins and ends there.
        corners.retain(|corner| *corner > 0);
    }
    if !are_split || corners.is_empty() {
        let closes = are_split && is_closed && !periodic;
        let whole = match closes {
            true => Piece::round(ring),
            false => Piece::whole(count),
        };
        return (vec![whole], corners);
    }
    let last = count.saturating_sub(1);
    let bounds = match goes_round {
        true => [&corners[..], &[corners[0] + ring]].concat(),
        false => [&[0], &corners[..], &[last]].concat(),
    };
    let pieces = bounds.windows(2).map(|bounds| Piece {
        numbers: (bounds[0]..=bounds[1]).map(|it| it % ring).collect(),
        is_outer: [
            !goes_round && bounds[0] == 0,
            !goes_round && bounds[1] == last,
        ],
    });
    (pieces.collect(), corners)
}

/// Require numbers of features, if there are any asked for.
pub(super) fn features(extrema: Option<usize>, inflections: Option<usize>) -> Option<Requirement> {
    let asked = extrema.or(inflections);
    asked.map(|_| Requirement::Features {
        stretch: None,
        request: CountRequest::exactly([inflections, extrema, None]),
    })
}

/// Whether the outer points are near each other, beside the size of all.
fn are_near(points: &[DVec2]) -> bool {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let outer = points.first().zip(points.last());
    outer.is_some_and(|(first, last)| first.distance(*last) <= NEAR * low.distance(high))
}

/// The points of one curve.
pub(super) struct Piece {
    /// Their numbers, along the curve.
    pub(super) numbers: Vec<usize>,
    /// Whether it begins, and ends, where all points do, and not at a corner.
    pub(super) is_outer: [bool; 2],
}

impl Piece {
    /// All of so many points.
    pub(super) fn whole(points: usize) -> Self {
        Self {
            numbers: (0..points).collect(),
            is_outer: [true; 2],
        }
    }

    /// All of so many points and the first again: the curve closes, with a corner there.
    fn round(points: usize) -> Self {
        Self {
            numbers: (0..=points).map(|number| number % points).collect(),
            is_outer: [false; 2],
        }
    }

    /// Fit one curve, whose inner ends are just at the corners. Points keep their numbers. Where free ends make a curve
    /// that crosses itself and exact ones do not, its ends are exact; or else it has more extrema, if that helps.
    pub(super) fn fit(
        &self,
        points: &[DVec2],
        asked: &PlaneFit,
        progress: &Progress,
    ) -> Result<(PlaneFit, Fitted), FitError> {
        let ends = [0, 1].map(|end| !self.is_outer[end] || asked.exact_ends[end]);
        let outer = self.is_outer;
        let is_whole = outer == [true; 2];
        let own = self.of(points);
        // A short piece has a lower degree, not the whole curve.
        let degree = match is_whole {
            true => asked.degree,
            false => asked.degree.min(own.len().saturating_sub(1)).max(1),
        };
        let asked = PlaneFit {
            degree,
            count: asked.count.map(|count| match is_whole {
                true => count,
                false => count.min(own.len()),
            }),
            periodic: asked.periodic && is_whole,
            exact_ends: ends,
            directions: [0, 1].map(|end| asked.directions[end].filter(|_| outer[end])),
            curvatures: [0, 1].map(|end| asked.curvatures[end].filter(|_| outer[end])),
            outliers: asked.outliers.as_ref().map(|numbers| self.own(numbers)),
            weights: asked.weights.as_ref().map(|weights| self.of(weights)),
            ..asked.clone()
        };
        // Ends that are near each other may cross: some time is kept for exact ones.
        let may_cross = !asked.periodic && asked.exact_ends != [true; 2] && are_near(&own);
        let share = if may_cross { FIRST } else { 1.0 };
        let fit = |asked: &PlaneFit, progress: &Progress| {
            let corrected = |polygon: &FloatPolygon, left_out: &[usize]| {
                self.with_ends(points, asked, (polygon, left_out), progress)
            };
            fit_plane_corrected(&own, asked, &corrected, progress)
        };
        let mut found = fit(&asked, &progress.hurried(share))?;
        let mut asked = asked;
        if found.crossing.is_some() {
            // It must be about as near.
            let most = found.tolerance.max(FARTHER * found.deviation);
            let exact = PlaneFit {
                exact_ends: [true; 2],
                lists_trade_off: false,
                ..asked.clone()
            };
            let mut uncrossed = Vec::new();
            if asked.exact_ends != [true; 2] && !asked.periodic {
                // Where the fewest extrema cross, some more need not.
                let more = (1..=MORE).map(|more| Extrema::Exactly(found.extrema + more));
                let more = more.filter(|_| asked.extrema == Extrema::Fewest);
                for extrema in std::iter::once(asked.extrema).chain(more) {
                    let asked = PlaneFit {
                        extrema,
                        ..exact.clone()
                    };
                    let Ok(mut found) = fit(&asked, progress) else {
                        break;
                    };
                    let others = std::mem::take(&mut found.uncrossed).into_iter();
                    uncrossed.extend(others.map(|other| (exact.clone(), other.fitted)));
                    let crosses = found.crossing.is_some();
                    uncrossed.push((exact.clone(), found));
                    if !crosses {
                        break;
                    }
                }
            }
            // The time may have been too short for that.
            let others = std::mem::take(&mut found.uncrossed).into_iter();
            uncrossed.extend(others.map(|other| match other.has_exact_ends {
                true => (exact.clone(), other.fitted),
                false => (asked.clone(), other.fitted),
            }));
            uncrossed.retain(|(_, it)| it.holds && it.crossing.is_none() && it.deviation <= most);
            // A stable sort leaves exact ends first.
            uncrossed.sort_by_key(|(_, it)| (it.deviation > it.tolerance, it.extrema));
            if let Some((own, uncrossed)) = uncrossed.into_iter().next() {
                asked = own;
                found = Fitted {
                    trade_off: found.trade_off,
                    ..uncrossed
                };
            }
        }
        for (outlier, _) in &mut found.outliers {
            *outlier = self.numbers[*outlier];
        }
        for repeated in &mut found.repeated {
            *repeated = self.numbers[*repeated];
        }
        Ok((asked, found))
    }

    /// Tell a cancellation from other errors, and which of several pieces an error is about.
    pub(super) fn told(&self, error: FitError, index: usize, pieces: usize) -> OperationError {
        match (error, &self.numbers[..]) {
            (FitError::Cancelled, _) => OperationError::Cancelled,
            (error, [first, .., last]) if pieces > 1 => OperationError::Piece {
                piece: index + 1,
                first: *first,
                last: *last,
                error,
            },
            (error, _) => error.into(),
        }
    }

    /// What belongs to its points, of all.
    pub(super) fn of<T: Copy>(&self, all: &[T]) -> Vec<T> {
        let own = self.numbers.iter();
        own.filter_map(|number| all.get(*number).copied()).collect()
    }

    /// Those of some points, by their places along the piece.
    pub(super) fn own(&self, numbers: &[usize]) -> Vec<usize> {
        let places = self.numbers.iter().enumerate();
        let inside = places.filter(|(_, number)| numbers.contains(number));
        inside.map(|(place, _)| place).collect()
    }

    /// What is asked of the ends. Points that do not count are no ends.
    fn targets(
        &self,
        points: &[DVec2],
        asked: &PlaneFit,
        polygon: &FloatPolygon,
        counts: impl Fn(usize) -> bool,
    ) -> Vec<(End, EndTarget)> {
        if asked.periodic {
            return Vec::new();
        }
        let mut counting = self.numbers.iter().copied().filter(|index| counts(*index));
        let outer = [counting.next(), counting.next_back()];
        let target = |(index, end): (usize, End)| {
            let point = outer[index].filter(|_| asked.exact_ends[index]);
            let point = point.and_then(|point| points.get(point));
            let direction = asked.directions[index];
            let curvature = asked.curvatures[index];
            let asks = point.is_some() || direction.is_some() || curvature.is_some();
            let target = EndTarget {
                point: point.map_or(polygon.end_jet(end).point, |point| point.extend(0.0)),
                direction: direction.map(|direction| direction.extend(0.0)),
                curvature,
                ..EndTarget::default()
            };
            asks.then_some((end, target))
        };
        let ends = End::BOTH.into_iter().enumerate();
        ends.filter_map(target).collect()
    }

    /// Bring a fitted curve to what is asked of its ends to the last digits, if that is a matter of rounding. `left_out`
    /// are the places of points that do not count.
    fn with_ends(
        &self,
        points: &[DVec2],
        asked: &PlaneFit,
        (polygon, left_out): (&FloatPolygon, &[usize]),
        progress: &Progress,
    ) -> Option<FloatPolygon> {
        let is_left_out = |index: usize| {
            let mut places = left_out.iter();
            places.any(|place| self.numbers.get(*place) == Some(&index))
        };
        let targets = self.targets(points, asked, polygon, |index| !is_left_out(index));
        let size = polygon.size();
        let is_met = |(end, target): &(End, EndTarget)| {
            EndDifference::between(polygon, *end, target).residual(size) <= SHARE_OF_SIZE * size
        };
        // A correction would not keep the mirror image to the bit.
        if asked.mirror.is_some() || targets.iter().all(is_met) {
            return None;
        }
        let order = Disturbance::Differences(3);
        let corrected = correct_jointly(polygon, &targets, order, &[], progress);
        let corrected = corrected.ok()?.polygon;
        let moved = polygon.deviation(&corrected).ok()?;
        (moved <= ROUNDING * size).then_some(corrected)
    }

    /// What the curve must hold: its features, its ends and the tolerance.
    pub(super) fn requirements(
        &self,
        points: &[DVec2],
        asked: &PlaneFit,
        found: &Fitted,
    ) -> Vec<Requirement> {
        let features = features(asked.extrema.number(), asked.inflections);
        let polygon = &found.polygon;
        let tolerance = SHARE_OF_SIZE * polygon.size();
        let targets = self.targets(points, asked, polygon, |index| {
            found.outliers.iter().all(|(outlier, _)| *outlier != index)
        });
        let places = targets.into_iter();
        let places = places.map(|(end, target)| place_of(polygon, end, target, tolerance));
        let limit = asked.tolerance.map(|most| Requirement::Limit {
            found: found.deviation,
            most,
        });
        // Without a wish the curve is as near as the noise lets expect.
        let is_rough = asked.extrema == Extrema::Fewest && found.deviation > found.tolerance;
        let failed = (!found.holds || is_rough).then_some(Requirement::Failed { left: None });
        features
            .into_iter()
            .chain(places)
            .chain(limit)
            .chain(failed)
            .collect()
    }
}
