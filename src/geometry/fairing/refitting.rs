//! Fits to a curve that is to be harmonised: nearly the same curve with the features asked for.

use super::counts::counted;
use super::displaced_inflection::displaced_inflection;
use super::harmonised::{Harmonised, Harmony, Held, farthest_move, flung, folds};
use super::joint_correction::{Disturbance, correct_jointly};
use super::requirement::{Check, PlaceRequest, Requirement};
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::features::Features;
use crate::geometry::fitting::{Refit, refit};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// How often vertices that go far away are held in another try.
const HELD: usize = 2;

/// The share of the time that is left for a fit; the rest proves and measures it.
const FIT: f64 = 0.8;

/// Up to which derivative each end stays where a curve may be fitted to the old one; `None` where it may not.
pub(super) fn fit_conditions(
    polygon: &FloatPolygon,
    harmony: &Harmony,
) -> Option<[Option<usize>; 2]> {
    if harmony.stretch.is_some()
        || !polygon.is_planar()
        || polygon.weights().is_some()
        || polygon.degree() < 3
    {
        return None;
    }
    let order = |held: Held| match held {
        Held::Free => Some(None),
        Held::Position => Some(Some(0)),
        Held::Direction => Some(Some(1)),
        Held::Curvature => Some(Some(2)),
        Held::Slope | Held::All => None,
    };
    let [start, end] = harmony.ends.map(order);
    Some([start?, end?])
}

/// Curves that are fitted as a whole to the old one, have the features asked for and do not move too far.
pub(super) fn fitted(
    polygon: &FloatPolygon,
    own: &Features,
    harmony: &Harmony,
    kept: [Option<usize>; 2],
    known: &Harmonised,
    progress: &Progress,
) -> Vec<Harmonised> {
    let most = harmony.largest_deviation.unwrap_or(f64::INFINITY);
    let tried = |inflections: Option<usize>, locked: &[usize], share: f64| {
        let asked = Refit {
            extrema: known.request.extrema,
            inflections,
            kept,
            locked,
            symmetry: harmony.symmetry,
        };
        let refitted = refit(polygon, &asked, &progress.hurried(share))?;
        let is_limit = |it: &Requirement| matches!(it, Requirement::Limit { .. });
        let requirements = known.requirements.iter().filter(|it| !is_limit(it));
        let requirements: Vec<Requirement> = requirements.cloned().collect();
        let refitted = with_ends(refitted, &requirements, locked, progress);
        let refitted = harmony.completed(refitted);
        let features = Features::proved(&refitted, |_| !progress.is_cancelled())?;
        let found = counted(&features, true, None);
        let displaced = displaced_inflection([polygon, &refitted], [own, &features]);
        let measured = MeasuredDeviation::between(&refitted, polygon, progress).ok()?;
        let limit = Requirement::Limit {
            found: measured.largest,
            most,
        };
        let requirements = [requirements, vec![limit]].concat();
        let check = Check::with_features(&requirements, &refitted, Some(&features));
        check.holds.then_some(Harmonised {
            polygon: refitted,
            reached: true,
            requirements,
            request: known.request,
            counts: found.counts,
            undecided: found.undecided,
            deviation: measured.largest,
            bounded: measured.bounded,
            iterations: 0,
            refitted: true,
            displaced,
        })
    };
    // A fit that does not look at inflections often has as many as are asked for, and is found where one that forces
    // them is not; where no number is given, fewer will do.
    let mut inflections = known.request.inflections;
    let mut found: Vec<Harmonised> = Vec::new();
    let mut locked = harmony.locked.to_vec();
    let is_wild =
        |it: &Harmonised| flung(polygon, &it.polygon).is_some() || folds(polygon, &it.polygon);
    for _ in 0..=HELD {
        let tries = [(Some(inflections), 0.5 * FIT), (None, FIT)].into_iter();
        let tries = tries.filter_map(|(inflections, share)| tried(inflections, &locked, share));
        let new: Vec<Harmonised> = tries.collect();
        let is_good = |it: &Harmonised| it.displaced.is_none() && !is_wild(it);
        if new.is_empty() || new.iter().any(is_good) {
            found.extend(new);
            break;
        }
        let before = (inflections, locked.len());
        // Two inflections of a small bump have no place of their own when it is gone.
        if harmony.inflections.is_none() && new.iter().any(|it| it.displaced.is_some()) {
            inflections = inflections.saturating_sub(2);
        }
        // Outer vertices hardly act. Those that go far away, or fold the polygon, stay where they are in another try,
        // at little cost.
        let wild = new.iter().filter(|it| is_wild(it));
        let moved = wild.filter_map(|it| farthest_move(polygon, &it.polygon));
        locked.extend(moved.map(|(vertex, _)| vertex));
        locked.sort_unstable();
        locked.dedup();
        found.extend(new);
        if (inflections, locked.len()) == before {
            break;
        }
    }
    found
}

/// Give a fitted curve just the ends that are required; as it was if it has them, or they cannot be met.
fn with_ends(
    polygon: FloatPolygon,
    requirements: &[Requirement],
    locked: &[usize],
    progress: &Progress,
) -> FloatPolygon {
    let places = requirements
        .iter()
        .filter_map(|requirement| match requirement {
            Requirement::Place(place) => Some(*place),
            _ => None,
        });
    let places: Vec<PlaceRequest> = places.collect();
    let size = polygon.size();
    if places.iter().all(|place| place.is_met(&polygon, size)) {
        return polygon;
    }
    let end = |u: f64| if u > 0.0 { End::Finish } else { End::Start };
    let targets = places.iter().map(|place| (end(place.u), place.target));
    let targets: Vec<(End, EndTarget)> = targets.collect();
    let order = Disturbance::Differences(3);
    let corrected = correct_jointly(&polygon, &targets, order, locked, progress);
    corrected.map_or(polygon, |corrected| corrected.polygon)
}
