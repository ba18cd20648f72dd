//! Curves that wind where their points do not: loops between points, and hooks at the ends.

use std::f64::consts::PI;

use glam::DVec2;

use crate::geometry::crossing::{crossing, curve_crossing};
use crate::geometry::features::Turning;
use crate::geometry::float_polygon::FloatPolygon;

/// A curve that turns so much more or less than the polyline of its points, in radians, winds: half a turn too much
/// for a curve near them, and below the whole turn of the smallest loop.
const WINDING: f64 = 1.5 * PI;

/// Where the polyline turns by more than this at a point, in radians, its turns may be noise and are not added up: one
/// of two chords then runs back. A nose or a corner turns by a right angle or a little more.
const CLEAN: f64 = 2.0;

/// An end that turns from the outermost chord by more than this and the turn of the polyline beside it, in radians, is
/// a hook.
const HOOK: f64 = 0.5;

/// A curve that bends by more than this between an end and the point beside it, as the curvature times the distance
/// of both, has a spike that its points do not show.
const SPIKE: f64 = 3.0;

/// The places between an end and the point beside it where its curvature is looked up.
const LOOKED_UP: usize = 16;

/// A chord between two points that follow each other.
struct Chord {
    /// The parameter in the middle of their places.
    middle: f64,
    /// Its direction, continuous along the polyline, and how far the polyline turned there.
    angle: f64,
    turn: f64,
}

/// Whether a curve turns by half a turn more or less than the polyline of its points.
///
/// `points` are in their order along the curve, with the parameters where it is nearest to them. Where noise turns the
/// polyline sharply, only what the curve turns by between two chords counts.
pub(super) fn winds(polygon: &FloatPolygon, points: &[(DVec2, f64)]) -> bool {
    let turning = Turning::new(polygon);
    let chords = chords(points, polygon);
    let mut range: Option<[f64; 2]> = None;
    let mut last = None;
    chords.iter().any(|chord| {
        let turned = turning.angle(chord.middle) - chord.angle;
        let [low, high] = match range.filter(|_| chord.turn.abs() <= CLEAN) {
            Some([low, high]) => [turned.min(low), turned.max(high)],
            None => [turned; 2],
        };
        range = Some([low, high]);
        let jump = last.map_or(0.0, |last: f64| (turned - last).abs());
        last = Some(turned);
        jump.max(high - low) > WINDING
    })
}

/// Whether an end of a curve turns away from the outermost chord; `points` are as for [`winds`].
pub(super) fn hooks(polygon: &FloatPolygon, points: &[(DVec2, f64)]) -> bool {
    let turning = Turning::new(polygon);
    let chords = chords(points, polygon);
    let ([first, second, ..], [.., last]) = (&chords[..], &chords[..]) else {
        return false;
    };
    let end = polygon.segments() as f64;
    let mut outer = [(0.0, first, second.turn), (end, last, last.turn)].into_iter();
    let turns_away = |(u, chord, turn): (f64, &Chord, f64)| {
        let turned = turning.angle(u) - turning.angle(chord.middle);
        turned.abs() > HOOK + turn.abs()
    };
    !polygon.is_periodic() && outer.any(turns_away)
}

/// Whether the curvature peaks between an end of a curve and the point beside it; `points` are as for [`winds`].
/// `known` are the ends whose curvature is asked for.
pub(super) fn spikes(polygon: &FloatPolygon, points: &[(DVec2, f64)], known: [bool; 2]) -> bool {
    let ([first, second, ..], [.., before, last]) = (points, points) else {
        return false;
    };
    let end = polygon.segments() as f64;
    let outer = [(0.0, first, second), (end, last, before)];
    let peaks = |(u, point, beside): (f64, &(DVec2, f64), &(DVec2, f64))| {
        let gap = point.0.distance(beside.0);
        let share = |step: usize| step as f64 / LOOKED_UP as f64;
        let places = (0..LOOKED_UP).map(|step| u + share(step) * (beside.1 - u));
        let is_calm = |u: f64| polygon.jet(u).curvature() * gap <= SPIKE;
        !places.into_iter().all(is_calm)
    };
    let mut outer = outer.into_iter().zip(known).filter(|(_, known)| !known);
    !polygon.is_periodic() && outer.any(|(end, _)| peaks(end))
}

/// A point where a curve crosses itself, at samples, if the polyline of its points does not.
pub(super) fn crossing_of(polygon: &FloatPolygon, points: &[DVec2]) -> Option<DVec2> {
    curve_crossing(polygon).filter(|_| crossing(points).is_none())
}

/// The chords of points that differ.
fn chords(points: &[(DVec2, f64)], polygon: &FloatPolygon) -> Vec<Chord> {
    let length = polygon.segments() as f64;
    let mut chords: Vec<Chord> = Vec::new();
    let mut before: Option<DVec2> = None;
    let mut rounds = 0.0;
    for pair in points.windows(2) {
        let [(from, begin), (to, end)] = [pair[0], pair[1]];
        // Parameters of a periodic curve begin anew at its seam.
        let wraps = polygon.is_periodic() && end < begin - 0.5 * length;
        let over = if wraps { length } else { 0.0 };
        let chord = to - from;
        if chord != DVec2::ZERO {
            let turn = before.map_or(0.0, |before| before.angle_to(chord));
            let angle = chords
                .last()
                .map_or(chord.to_angle(), |last| last.angle + turn);
            chords.push(Chord {
                middle: rounds + 0.5 * (begin + end + over),
                angle,
                turn,
            });
            before = Some(chord);
        }
        rounds += over;
    }
    chords
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a curve at some parameters, with these.
    fn placed(polygon: &FloatPolygon, places: impl Iterator<Item = f64>) -> Vec<(DVec2, f64)> {
        let point = |u: f64| (polygon.point(u).truncate(), u);
        places.map(point).collect()
    }

    fn line(vertices: &[(f64, f64)]) -> FloatPolygon {
        FloatPolygon::planar(3, vertices).expect("a polygon")
    }

    #[test]
    fn a_loop_between_two_points_winds_and_a_bend_does_not() {
        let calm = line(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|x| (x, 0.1 * x * x)));
        let looped = [
            (0.0, 0.0),
            (1.0, 0.0),
            (2.2, 0.0),
            (2.2, 0.4),
            (1.8, 0.4),
            (1.8, 0.0),
        ];
        let looped = line(&[&looped[..], &[(3.0, 0.0), (4.0, 0.0), (5.0, 0.0)]].concat());
        let every = |segments: usize| (0..=segments).map(|it| it as f64);
        assert!(!winds(&calm, &placed(&calm, every(4))));
        // With points all along, the polyline loops too.
        let along = (0..=60).map(|it| 0.1 * f64::from(it));
        assert!(!winds(&looped, &placed(&looped, along)));
        let beside = [0.0, 0.5, 5.5, 6.0].into_iter();
        assert!(winds(&looped, &placed(&looped, beside)));
    }

    #[test]
    fn an_end_that_turns_away_is_a_hook() {
        let straight = [(2.0, 0.0), (3.0, 0.0), (4.0, 0.0), (5.0, 0.0)];
        let hook = [(1.6, 0.6), (0.8, 0.7), (0.9, 0.05)];
        let hooked = line(&[&hook[..], &straight].concat());
        let places = || [0.0, 2.0, 3.0, 4.0].into_iter();
        assert!(hooks(&hooked, &placed(&hooked, places())));
        let calm = line(&[&[(-1.0, 0.0), (0.0, 0.0), (1.0, 0.1)], &straight[..]].concat());
        assert!(!hooks(&calm, &placed(&calm, places())));
    }

    #[test]
    fn a_curvature_that_peaks_beside_an_end_is_a_spike() {
        let straight = [(2.0, 0.0), (3.0, 0.0), (4.0, 0.0), (5.0, 0.0)];
        let turned = [(0.9, 0.4), (0.98, -0.04), (1.1, 0.0)];
        let spiked = line(&[&turned[..], &straight].concat());
        let places = || [0.0, 2.0, 3.0, 4.0].into_iter();
        assert!(spikes(&spiked, &placed(&spiked, places()), [false; 2]));
        assert!(!spikes(&spiked, &placed(&spiked, places()), [true, false]));
        let calm = line(&[&[(-1.0, 0.0), (0.0, 0.0), (1.0, 0.1)], &straight[..]].concat());
        assert!(!spikes(&calm, &placed(&calm, places()), [false; 2]));
    }

    #[test]
    fn a_periodic_curve_turns_once_with_its_points() {
        let vertex = |it: i32| DVec2::from_angle(PI * f64::from(it) / 5.0).extend(0.0);
        let polygon = FloatPolygon::new(3, (0..10).map(vertex).collect(), None, true);
        let polygon = polygon.expect("a polygon");
        // The first point lies anywhere.
        let places = (0..24).map(|it| (3.3 + 10.0 * f64::from(it) / 24.0).rem_euclid(10.0));
        assert!(!winds(&polygon, &placed(&polygon, places)));
    }
}
