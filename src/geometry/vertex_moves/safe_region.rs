//! The region where a vertex may go without adding a curvature extremum or an inflection.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::feature_rise::FeatureRise;
use super::move_prover::MoveError;
use super::ray::RayProver;
use crate::geometry::Progress;
use crate::geometry::features::SegmentFeatures;
use crate::geometry::float_polygon::FloatPolygon;

/// The numbers of rays, from coarse to fine. The first ones are evenly spaced.
const RAYS: [usize; 4] = [8, 24, 48, 96];

/// The even steps in which each ray is tried.
const STEPS: usize = 4;

/// The least angle between two rays.
const LEAST_ANGLE: f64 = TAU / 8192.0;

/// Hold the region in which a vertex of a planar curve may be without adding a curvature extremum,
/// an inflection, a cusp, or anything undecided.
///
/// On each of its rays every place that was tried up to its border is proved to be safe, and that
/// just beyond is proved not to be; they are no further apart than [`super::PRECISION`] of the border's
/// distance. Between the places that were tried, and so between the rays, the region is a guide: of
/// 96 000 places inside the outlines of 1 000 random cases 4 were not safe (`tests/vertex_moves`).
#[derive(Clone, Debug, PartialEq)]
pub struct SafeRegion {
    /// The vertex.
    pub vertex: usize,
    /// The vertex.
    pub centre: DVec3,
    /// Length of rays: [`super::reach`].
    pub limit: f64,
    /// The borders on the rays, anticlockwise from the x axis. They are closer where the border is
    /// further away.
    pub rays: Vec<RayBorder>,
}

/// Hold how far a vertex may go along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayBorder {
    /// The direction, of length 1.
    pub direction: DVec2,
    /// The greatest distance proved to be safe before the border, or before the limit.
    pub safe: f64,
    /// The least distance proved not to be safe, and the added features; `None` if the border lies
    /// beyond the limit.
    pub beyond: Option<(f64, FeatureRise)>,
}

/// Search for a safe region, from coarse to fine.
#[derive(Debug)]
pub struct RegionSearch {
    prover: RayProver,
    region: SafeRegion,
    /// Number of finished levels.
    level: usize,
}

impl SafeRegion {
    /// List the corners of the outline, one a ray.
    pub fn outline(&self) -> impl Iterator<Item = DVec2> + '_ {
        let centre = self.centre.truncate();
        self.rays
            .iter()
            .map(move |ray| centre + ray.safe * ray.direction)
    }
}

impl RegionSearch {
    /// Begin the search for one vertex. `proved` are the features of all segments of the curve.
    ///
    /// # Errors
    /// [`MoveError`] if the curve is not planar, if features of it are undecided, or if there is no
    /// such vertex.
    pub fn new(
        polygon: &FloatPolygon,
        proved: &[SegmentFeatures],
        vertex: usize,
    ) -> Result<Self, MoveError> {
        let prover = RayProver::new(polygon, proved, vertex)?;
        let region = SafeRegion {
            vertex,
            centre: prover.centre,
            limit: prover.limit,
            rays: Vec::new(),
        };
        Ok(Self {
            prover,
            region,
            level: 0,
        })
    }

    /// The region as far as it is known: without rays before the first level.
    pub fn region(&self) -> &SafeRegion {
        &self.region
    }

    /// Whether there is a finer level.
    pub fn is_done(&self) -> bool {
        self.level == RAYS.len() || self.prover.limit == 0.0
    }

    /// Find the borders of the next level, with more rays: new ones go between those whose
    /// corners are furthest apart. Nothing changes if it is cancelled meanwhile. Returns whether the
    /// level is done.
    pub fn refine(&mut self, progress: &Progress) -> bool {
        if self.is_done() {
            return true;
        }
        let mut rays = self.region.rays.clone();
        let count = RAYS[self.level];
        let (first, missing) = (rays.len(), count - rays.len());
        while rays.len() < count {
            let (place, direction) = if self.level == 0 {
                let angle = TAU * rays.len() as f64 / count as f64;
                (rays.len(), DVec2::from_angle(angle))
            } else if let Some(widest) = widest_gap(&rays) {
                widest
            } else {
                break;
            };
            let Some(border) = self.border(direction, progress) else {
                return false;
            };
            rays.insert(place, border);
            progress.set_done((rays.len() - first) as f64 / missing as f64);
        }
        self.region.rays = rays;
        self.level += 1;
        true
    }

    /// Find the border on one ray; `None` if the search is cancelled.
    fn border(&mut self, direction: DVec2, progress: &Progress) -> Option<RayBorder> {
        let limit = self.prover.limit;
        let mut border = RayBorder {
            direction,
            safe: 0.0,
            beyond: None,
        };
        for distance in self.prover.tries(direction, limit, STEPS) {
            self.try_at(&mut border, distance, progress)?;
            if border.beyond.is_some() {
                break;
            }
        }
        while let Some((fails, _)) = border.beyond
            && let Some(distance) = self.prover.between(border.safe, fails)
        {
            self.try_at(&mut border, distance, progress)?;
        }
        Some(border)
    }

    /// Prove what is added at a distance along a ray, and move the border there on the side that it
    /// is of; `None` if the search is cancelled.
    fn try_at(&mut self, border: &mut RayBorder, distance: f64, progress: &Progress) -> Option<()> {
        if progress.is_cancelled() {
            return None;
        }
        let undecided = FeatureRise {
            undecided: 1,
            ..FeatureRise::default()
        };
        let after = self.prover.features(border.direction, distance);
        let rise = after.map_or(undecided, |after| {
            FeatureRise::between(self.prover.prover.before(), &after)
        });
        if rise.is_none() {
            border.safe = distance;
        } else {
            border.beyond = Some((distance, rise));
        }
        Some(())
    }
}

/// Find the gap between two rays whose corners are furthest apart: where a ray between them belongs,
/// and its direction. `None` if all gaps are narrow.
fn widest_gap(rays: &[RayBorder]) -> Option<(usize, DVec2)> {
    let gaps = rays.iter().enumerate().filter_map(|(index, ray)| {
        let next = rays.get(index + 1).or(rays.first())?;
        let angle = ray.direction.angle_to(next.direction);
        let corners = [ray, next].map(|ray| ray.safe * ray.direction);
        let distance = corners[0].distance(corners[1]);
        let direction = DVec2::from_angle(0.5 * angle).rotate(ray.direction);
        (angle >= 2.0 * LEAST_ANGLE).then_some((distance, index + 1, direction))
    });
    gaps.max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, place, direction)| (place, direction))
}
