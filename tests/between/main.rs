//! Segments between two ends.

#[path = "../common/mod.rs"]
mod common;
mod existence;
mod log_aesthetic;
mod pairs;
mod superspiral;
mod true_segment;

use batten::geometry::between::{BetweenError, Ends, Segment, SegmentKind, between};
use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::fairing::requirement::Check;
use batten::geometry::features::{Feature, Features, Verdict};
use batten::geometry::{End, Progress};
use glam::DVec2;

use common::Random;

/// What points and directions may be off, in units of the polygon's size.
const EXACT: f64 = 1e-12;

/// Find a segment with the tolerance that is offered.
fn found(ends: &Ends, kind: SegmentKind, degree: usize) -> Result<Segment, BetweenError> {
    between(ends, kind, degree, None, &Progress::default())
}

/// A similarity of the plane, with a reflection or without.
struct Placing {
    origin: DVec2,
    axis: DVec2,
    side: f64,
}

impl Placing {
    /// A place, size and side by chance.
    fn random(random: &mut Random) -> Self {
        let size = 10.0_f64.powf(random.between(-2.0, 3.0));
        let turned = DVec2::from_angle(random.between(-3.0, 3.0));
        let far = DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        Self {
            origin: size * far,
            axis: size * turned,
            side: if random.bits().is_multiple_of(2) {
                1.0
            } else {
                -1.0
            },
        }
    }

    fn vector(&self, vector: DVec2) -> DVec2 {
        self.axis.rotate(DVec2::new(vector.x, self.side * vector.y))
    }

    fn point(&self, point: DVec2) -> DVec2 {
        self.origin + self.vector(point)
    }

    /// The ends of a curve that starts at the origin along (1, 0), ends at a point and turns by an
    /// angle. Directions have lengths of their own.
    fn ends(&self, end: DVec2, turning: f64) -> Ends {
        Ends {
            points: [self.origin, self.point(end)],
            directions: [
                0.3 * self.vector(DVec2::X),
                7.0 * self.vector(DVec2::from_angle(turning)),
            ],
            curvatures: [None; 2],
        }
    }
}

/// Measure what the ends of a segment are off, in units of its size, curvatures included where they are
/// asked for.
fn off(segment: &Segment, ends: &Ends) -> f64 {
    let polygon = &segment.polygon;
    let size = polygon.size();
    let residual = |(index, end): (usize, End)| {
        let target = EndTarget {
            point: ends.points[index].extend(0.0),
            direction: Some(ends.directions[index].extend(0.0)),
            curvature: ends.curvatures[index],
            ..EndTarget::default()
        };
        EndDifference::between(polygon, end, &target).residual(size) / size
    };
    let ends = End::BOTH.into_iter().enumerate();
    ends.map(residual).fold(0.0, f64::max)
}

/// Whether a segment holds what is asked of it.
fn is_reached(segment: &Segment) -> bool {
    let check = Check::of(
        &segment.requirements,
        &segment.polygon,
        &Progress::default(),
    );
    check.is_some_and(|check| check.holds)
}

/// Check that a segment is what it says, with exact ends and proved monotone curvature, and has so
/// many inflections.
#[track_caller]
fn check(segment: &Segment, ends: &Ends, inflections: usize) {
    let features = Features::new(&segment.polygon);
    assert_eq!(features.monotone, Verdict::Proved);
    assert_eq!(features.count(Feature::CurvatureExtremum), 0);
    assert_eq!(features.count(Feature::Inflection), inflections);
    assert!(features.undecided.is_empty() && features.cusps.is_empty());
    assert!(is_reached(segment));
    let off = off(segment, ends);
    assert!(off <= EXACT, "the ends are off by {off:e}");
}
