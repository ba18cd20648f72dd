//! How far the direction of a planar curve turns.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::geometry::conversion::segment_bezier;
use crate::geometry::float_polygon::FloatPolygon;

/// Halvings of a segment: a part as short as this turns as its ends tell, also at a cusp.
const HALVINGS: u32 = 40;

/// Derivatives below this share of a segment's largest are rounding: they have no direction.
const ROUNDING: f64 = 1e-13;

/// Legs below this share of the coordinates are rounding too.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// Hold the direction angle of a planar polynomial curve, continuous along it.
///
/// Segments are halved until the hodograph's Bézier polygon lies within a right angle of its beginning, so that no
/// turn is missed, however tight. Where the curve stops it goes on in the direction before.
pub struct Turning<'a> {
    polygon: &'a FloatPolygon,
    parts: Vec<Part>,
    /// The direction and the angle at the end.
    last: DVec2,
    end: f64,
}

/// A part of the curve that turns by less than a right angle.
#[derive(Clone, Copy)]
struct Part {
    from: f64,
    direction: DVec2,
    /// The angle at its beginning.
    angle: f64,
}

impl<'a> Turning<'a> {
    /// Follow the direction of a curve from u = 0 on. Weights do not count.
    pub fn new(polygon: &'a FloatPolygon) -> Self {
        let mut turning = Self {
            polygon,
            parts: Vec::new(),
            last: DVec2::X,
            end: 0.0,
        };
        for segment in 0..polygon.segments() {
            turning.follow(hodograph(polygon, segment), segment as f64, 1.0, HALVINGS);
        }
        turning
    }

    /// The angle from the first direction to the last one, in radians: 2π for a periodic curve that goes round once.
    pub fn total(&self) -> f64 {
        self.end - self.begin()
    }

    /// Count by how many whole turns a planar curve turns more than another one, beyond what its ends turn, each the
    /// shorter way: 0 where one bends into the other without a loop.
    pub fn rounds_since(&self, before: &Self) -> i64 {
        let [old, new] = [before, self];
        let ends = angle(old.last, new.last) - angle(old.first(), new.first());
        let rounds = (new.total() - old.total() - ends) / TAU;
        // Directions are followed to rounding: this is a whole number but for that.
        rounds.round() as i64
    }

    /// The angle of the direction at a parameter, in radians; that at u = 0 is its angle to the x axis. A periodic
    /// curve goes on beyond its last parameter.
    pub fn angle(&self, u: f64) -> f64 {
        let length = self.polygon.segments() as f64;
        let rounds = match self.polygon.is_periodic() {
            true => (u / length).floor(),
            false => 0.0,
        };
        let u = u - rounds * length;
        let behind = self.parts.partition_point(|part| part.from <= u);
        let direction = self.polygon.jet(u).first.truncate();
        let part = self.parts.get(behind.saturating_sub(1));
        let angle = part.map_or(0.0, |part| part.angle + angle(part.direction, direction));
        angle + rounds * self.total()
    }

    fn first(&self) -> DVec2 {
        self.parts.first().map_or(DVec2::X, |part| part.direction)
    }

    fn begin(&self) -> f64 {
        self.parts.first().map_or(0.0, |part| part.angle)
    }

    fn follow(&mut self, hodograph: Vec<DVec2>, from: f64, width: f64, halvings: u32) {
        let directed = |it: &&DVec2| it.abs().max_element() > ROUNDING;
        let mut directions = hodograph.iter().filter(directed);
        let Some(first) = directions.next().copied() else {
            return;
        };
        let end = hodograph.iter().rev().find(directed);
        let end = end.copied().unwrap_or(first);
        let is_calm = directions.all(|it| first.dot(*it) > 0.0);
        if !is_calm && halvings > 0 {
            let [before, behind] = halves(hodograph);
            let half = 0.5 * width;
            self.follow(before, from, half, halvings - 1);
            self.follow(behind, from + half, half, halvings - 1);
            return;
        }
        self.end += angle(self.last, first);
        self.parts.push(Part {
            from,
            direction: first,
            angle: self.end,
        });
        self.end += angle(first, end);
        self.last = end;
    }
}

/// The Bézier polygon of a segment's derivative, its largest coordinate 1.
fn hodograph(polygon: &FloatPolygon, segment: usize) -> Vec<DVec2> {
    let bezier = segment_bezier(polygon, segment);
    let points = bezier.iter().map(|point| point.truncate().truncate());
    let points: Vec<DVec2> = points.collect();
    let legs = points.windows(2).map(|leg| leg[1] - leg[0]);
    let legs: Vec<DVec2> = legs.collect();
    let size = |vectors: &[DVec2]| {
        let sizes = vectors.iter().map(|it| it.abs().max_element());
        sizes.fold(f64::MIN_POSITIVE, f64::max)
    };
    let (largest, rounding) = (size(&legs), ROUNDED * size(&points));
    // Where the curve stops, legs are what rounding leaves.
    match largest > rounding {
        true => legs.into_iter().map(|leg| leg / largest).collect(),
        false => Vec::new(),
    }
}

/// The angle from one direction to another, exact also where it is small: an arc cosine would lose half of the digits.
fn angle(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}

/// Halve a Bézier polygon (de Casteljau).
fn halves(mut polygon: Vec<DVec2>) -> [Vec<DVec2>; 2] {
    let mut before = Vec::with_capacity(polygon.len());
    let mut behind = Vec::with_capacity(polygon.len());
    while let (Some(first), Some(last)) = (polygon.first(), polygon.last()) {
        before.push(*first);
        behind.push(*last);
        polygon = polygon
            .windows(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .collect();
    }
    behind.reverse();
    [before, behind]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn turns_are_counted_however_tight() {
        let ring = |count: usize, periodic: bool| {
            let vertices = (0..count).map(|it| {
                let angle = TAU * it as f64 / 8.0;
                (angle.cos(), angle.sin())
            });
            let vertices: Vec<(f64, f64)> = vertices.collect();
            let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
            match periodic {
                true => FloatPolygon::new(5, polygon.vertices().to_vec(), None, true)
                    .expect("a polygon"),
                false => polygon,
            }
        };
        assert!((Turning::new(&ring(8, true)).total() - TAU).abs() < 1e-9);
        // 16 segments of an eighth turn each.
        assert!((Turning::new(&ring(21, false)).total() - 2.0 * TAU).abs() < 1e-9);
        // Loops of less than a ten thousandth of the curve, against the turns between dense samples.
        for size in [0.3, 1e-2, 1e-4] {
            let middle = (0..16).map(|it| {
                let angle = TAU * (it as f64 - 4.0) / 8.0;
                (size * angle.cos(), 1.0 + size * angle.sin())
            });
            let line = |from: f64| (0..6).map(move |it| (from + it as f64, 1.0));
            let vertices = line(-6.0).chain(middle).chain(line(1.0));
            let polygon = FloatPolygon::planar(5, &vertices.collect::<Vec<_>>());
            let polygon = polygon.expect("a polygon");
            let samples = (0..=5000 * polygon.segments()).map(|it| it as f64 / 5000.0);
            let tangents = samples.map(|u| polygon.jet(u).first.truncate());
            let tangents: Vec<DVec2> = tangents.collect();
            let turns = tangents.windows(2).map(|it| angle(it[0], it[1]));
            let [sampled, found] = [turns.sum::<f64>(), Turning::new(&polygon).total()];
            assert!(
                found > 6.0 && (found - sampled).abs() < 1e-9,
                "{size}: {found} {sampled}"
            );
        }
    }

    #[test]
    fn stops_cusps_and_tiny_curves_are_followed() {
        let total = |vertices: &[(f64, f64)]| {
            let polygon = FloatPolygon::planar(5, vertices).expect("a polygon");
            Turning::new(&polygon).total()
        };
        let arc = |size: f64| {
            let vertex = |it: i32| {
                let angle = TAU * f64::from(it) / 16.0;
                (size * angle.cos(), size * angle.sin())
            };
            (0..21).map(vertex).collect::<Vec<(f64, f64)>>()
        };
        for size in [1e-300, 1e-200, 1.0, 1e90] {
            assert!((total(&arc(size)) - TAU).abs() < 1e-9, "{size}");
        }
        // Six vertices in one point stop the curve; all in one leave it without a direction.
        let mut stopped = arc(1.0);
        stopped.splice(7..13, [stopped[9]; 6]);
        assert!((total(&stopped) - TAU).abs() < 1.0, "{}", total(&stopped));
        assert_eq!(total(&[(1.0, 2.0); 9]), 0.0);
        // There and back.
        let back = [0.0, 1.0, 2.0, 3.0, 3.0, 2.0, 1.0, 0.0].map(|x| (x, 0.0));
        assert!((total(&back).abs() - TAU / 2.0).abs() < 1e-9);
    }

    #[test]
    fn angles_go_on_around_a_periodic_curve() {
        let vertices = (0..8).map(|it| {
            let angle = TAU * f64::from(it) / 8.0;
            DVec2::from_angle(angle).extend(0.0)
        });
        let polygon = FloatPolygon::new(5, vertices.collect(), None, true).expect("a polygon");
        let turning = Turning::new(&polygon);
        for u in [0.0, 0.3, 4.0, 7.9] {
            let steps = turning.angle(u + 8.0) - turning.angle(u);
            assert!((steps - TAU).abs() < 1e-9, "{u}");
            assert!((turning.angle(u + 1.0) - turning.angle(u) - TAU / 8.0).abs() < 1e-9);
        }
    }
}
