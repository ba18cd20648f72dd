//! The shortest moves of single vertices that lose a feature.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::feature_rise::FeatureRise;
use super::move_prover::MoveError;
use super::ray::RayProver;
use crate::geometry::Progress;
use crate::geometry::features::{Feature, Features, SegmentFeatures};
use crate::geometry::float_polygon::FloatPolygon;

/// The rays that are tried first.
const RAYS: usize = 16;

/// Later halvings of the angle to the best ray's neighbours.
const HALVINGS: usize = 4;

/// The even steps in which each ray is tried.
const STEPS: usize = 12;

/// Result for a vertex: a move of it that is proved to lose a feature, and to add none.
///
/// The features of the curve with the vertex at `to` are proved. That it is the chosen feature that is
/// lost, not another, follows from the places tried on the straight way there, at which nothing is
/// added either; that no move is shorter does not follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureLoss {
    /// The vertex.
    pub vertex: usize,
    /// Its place.
    pub from: DVec3,
    /// Its new place; `None` if no move was found.
    pub to: Option<DVec3>,
    /// The radius in which moves were looked for: [`super::reach`].
    pub limit: f64,
}

impl FeatureLoss {
    /// Distance of the vertex's move.
    pub fn distance(&self) -> Option<f64> {
        Some(self.to?.distance(self.from))
    }
}

/// Look for the shortest moves that lose a feature of a planar curve: of each vertex that the feature
/// depends on, one at a time, by rays in its plane. `proved` are the features of all segments.
#[derive(Clone, Copy, Debug)]
pub struct LossSearch<'a> {
    /// The curve.
    pub polygon: &'a FloatPolygon,
    /// The features of all of its segments.
    pub proved: &'a [SegmentFeatures],
    /// The feature: an inflection or an extremum of the curvature.
    pub quantity: Feature,
    /// Its place: the middle of its interval.
    pub u: f64,
}

impl LossSearch<'_> {
    /// Find a move for each of the n + 1 vertices, in the order of the curve; `None` if the search is
    /// cancelled.
    ///
    /// # Errors
    /// [`MoveError`] if the curve is not planar, or if features of it are undecided.
    pub fn run(&self, progress: &Progress) -> Result<Option<Vec<FeatureLoss>>, MoveError> {
        let (first, _) = self.polygon.locate(self.u);
        let count = self.polygon.vertices().len();
        let mut vertices: Vec<usize> = (first..=first + self.polygon.degree())
            .map(|index| index % count)
            .collect();
        // A short periodic curve comes back to the same vertices.
        vertices.truncate(count);
        let mut losses = Vec::with_capacity(vertices.len());
        for vertex in &vertices {
            let Some(loss) = self.of_vertex(*vertex, progress)? else {
                return Ok(None);
            };
            losses.push(loss);
            progress.set_done(losses.len() as f64 / vertices.len() as f64);
        }
        Ok(Some(losses))
    }

    fn of_vertex(
        &self,
        vertex: usize,
        progress: &Progress,
    ) -> Result<Option<FeatureLoss>, MoveError> {
        let prover = RayProver::new(self.polygon, self.proved, vertex)?;
        let (from, limit) = (prover.centre, prover.limit);
        let mut trial = Trial {
            origin: origin(self.polygon, prover.prover.dependent()),
            period: self
                .polygon
                .is_periodic()
                .then(|| self.polygon.segments() as f64),
            quantity: self.quantity,
            u: self.u,
            prover,
        };
        let mut best: Option<(f64, f64)> = None;
        let step = TAU / RAYS as f64;
        let first = (0..RAYS).map(|ray| step * ray as f64);
        for angle in first {
            if progress.is_cancelled() {
                return Ok(None);
            }
            trial.improve(&mut best, angle, limit);
        }
        for halving in 1..=HALVINGS {
            let Some((angle, _)) = best else {
                break;
            };
            let aside = step / f64::from(1_u32 << halving);
            for angle in [angle - aside, angle + aside] {
                if progress.is_cancelled() {
                    return Ok(None);
                }
                trial.improve(&mut best, angle, limit);
            }
        }
        let to =
            best.map(|(angle, distance)| trial.prover.place(DVec2::from_angle(angle), distance));
        Ok(Some(FeatureLoss {
            vertex,
            from,
            to,
            limit,
        }))
    }
}

/// The search for one vertex.
struct Trial {
    prover: RayProver,
    quantity: Feature,
    u: f64,
    /// Start of the order of features: opposite to the moved segments.
    origin: f64,
    /// The length of a periodic curve's domain.
    period: Option<f64>,
}

impl Trial {
    /// Try a ray, as far as the shortest move found so far goes.
    fn improve(&mut self, best: &mut Option<(f64, f64)>, angle: f64, limit: f64) {
        let within = best.map_or(limit, |(_, distance)| distance);
        if let Some(distance) = self.shortest(DVec2::from_angle(angle), within)
            && distance < within
        {
            *best = Some((angle, distance));
        }
    }

    /// Find the distance along a ray at which the feature is lost first, if nothing is added before
    /// that.
    fn shortest(&mut self, direction: DVec2, within: f64) -> Option<f64> {
        let mut known = self.places(self.prover.prover.before());
        let mut own = nearest(&known, self.unrolled(self.u))?;
        let mut reached = 0.0;
        for distance in self.prover.tries(direction, within, STEPS) {
            let mut fails = distance;
            let mut after = self.allowed(direction, distance)?;
            if after.len() < known.len() {
                // The nearer to where they meet, the surer it is which features are lost.
                while let Some(middle) = self.prover.between(reached, fails) {
                    let places = self.allowed(direction, middle)?;
                    if places.len() < known.len() {
                        (fails, after) = (middle, places);
                    } else {
                        (reached, known) = (middle, places);
                    }
                }
                let kept = kept(&known, &after);
                match kept.iter().position(|index| *index == own) {
                    Some(position) => own = position,
                    None => return Some(fails),
                }
            } else if let Some(position) = kept(&after, &known).get(own) {
                // Another one that was lost may have come back.
                own = *position;
            }
            (reached, known) = (fails, after);
        }
        None
    }

    /// List the places of the features at a distance along a ray; `None` if any are added.
    fn allowed(&mut self, direction: DVec2, distance: f64) -> Option<Vec<f64>> {
        let after = self.prover.features(direction, distance)?;
        let rise = FeatureRise::between(self.prover.prover.before(), &after);
        rise.is_none().then(|| self.places(&after))
    }

    /// List the places of the features in order, each as often as it counts.
    fn places(&self, features: &Features) -> Vec<f64> {
        let places = features.places(self.quantity).into_iter();
        let places = places.flat_map(|([low, high], count)| {
            std::iter::repeat_n(self.unrolled(0.5 * (low + high)), count)
        });
        let mut places: Vec<f64> = places.collect();
        places.sort_by(f64::total_cmp);
        places
    }

    /// Count a parameter of a periodic curve from the origin.
    fn unrolled(&self, u: f64) -> f64 {
        self.period
            .map_or(u, |period| (u - self.origin).rem_euclid(period))
    }
}

/// Choose where the order of a periodic curve's features begins: in the middle of the segments that
/// stay as they are, if there are any.
fn origin(polygon: &FloatPolygon, dependent: &[usize]) -> f64 {
    let count = polygon.segments();
    let fixed = count - dependent.len();
    let first = (0..count).find(|segment| {
        let before = (segment + count - 1) % count;
        dependent.contains(segment) && !dependent.contains(&before)
    });
    first.map_or(0.0, |first| first as f64 - 0.5 * fixed as f64)
}

/// Find the number of the place nearest to another.
fn nearest(places: &[f64], to: f64) -> Option<usize> {
    let distances = places.iter().map(|place| (place - to).abs()).enumerate();
    distances
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

/// Match places in order with fewer of them so that they move least: returns the numbers of those
/// that are kept.
fn kept(before: &[f64], after: &[f64]) -> Vec<usize> {
    let lost = before.len().saturating_sub(after.len());
    // How far the rest moves if `skipped` of those before place `index` of `after` are lost: the
    // table is filled from the end.
    let mut costs = vec![vec![0.0_f64; lost + 1]; after.len() + 1];
    for index in (0..after.len()).rev() {
        for skipped in (0..=lost).rev() {
            let moved = (before[index + skipped] - after[index]).abs() + costs[index + 1][skipped];
            let skip = costs[index].get(skipped + 1);
            costs[index][skipped] = skip.map_or(moved, |skip| skip.min(moved));
        }
    }
    let mut kept = Vec::with_capacity(after.len());
    let mut skipped = 0;
    for (index, costs) in costs.iter().enumerate().take(after.len()) {
        while skipped < lost && costs[skipped + 1] <= costs[skipped] {
            skipped += 1;
        }
        kept.push(index + skipped);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lost_is_what_the_rest_moves_least_without() {
        for (before, after, expected) in [
            (vec![1.0, 2.0, 2.1, 3.0], vec![1.02, 3.01], vec![0, 3]),
            (vec![0.01, 2.0, 3.0], vec![2.0, 3.0], vec![1, 2]),
            (vec![1.0, 2.0, 4.9], vec![1.1, 2.1], vec![0, 1]),
            (vec![1.0, 1.1], vec![], vec![]),
            (vec![1.0, 2.0], vec![0.9, 2.2], vec![0, 1]),
        ] {
            assert_eq!(kept(&before, &after), expected, "{before:?} {after:?}");
        }
    }
}
