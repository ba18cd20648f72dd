//! How far the direction of a planar curve turns.

use glam::DVec2;

use crate::geometry::conversion::segment_bezier;
use crate::geometry::float_polygon::FloatPolygon;

/// Halvings of a segment: a part as short as this turns as its ends tell, also at a cusp.
const HALVINGS: u32 = 40;

/// Hold the direction angle of a planar curve, continuous along it.
///
/// Segments are halved until the hodograph's Bézier polygon lies within a right angle, so that no turn is missed,
/// however tight. The weights of rational curves do not count.
#[derive(Clone, Debug)]
pub struct Turning {
    parts: Vec<Part>,
    total: f64,
}

/// A part of the curve that turns by less than a right angle.
#[derive(Clone, Copy, Debug)]
struct Part {
    from: f64,
    direction: DVec2,
    /// The angle at its beginning.
    angle: f64,
}

impl Turning {
    /// Follow the direction of a curve from u = 0, where the angle is that of the direction, in radians.
    pub fn new(polygon: &FloatPolygon) -> Self {
        let mut turning = Self {
            parts: Vec::new(),
            total: 0.0,
        };
        let mut last = DVec2::X;
        for segment in 0..polygon.segments() {
            let bezier = segment_bezier(polygon, segment);
            let legs = bezier.windows(2);
            let legs: Vec<DVec2> = legs
                .map(|leg| DVec2::new(leg[1].x - leg[0].x, leg[1].y - leg[0].y))
                .collect();
            turning.follow(legs, [segment as f64, 1.0], HALVINGS, &mut last);
        }
        turning
    }

    /// The angle from the first direction to the last one, in radians: 2π for a periodic curve that goes round once.
    pub fn total(&self) -> f64 {
        self.total - self.parts.first().map_or(0.0, |part| part.angle)
    }

    /// The angle of the direction at a parameter where it is `direction`.
    pub fn angle(&self, u: f64, direction: DVec2) -> f64 {
        let behind = self.parts.partition_point(|part| part.from <= u);
        let part = self.parts.get(behind.saturating_sub(1));
        part.map_or(0.0, |part| part.angle + angle(part.direction, direction))
    }

    fn follow(
        &mut self,
        hodograph: Vec<DVec2>,
        [from, width]: [f64; 2],
        left: u32,
        last: &mut DVec2,
    ) {
        let mut directions = hodograph.iter().filter(|it| **it != DVec2::ZERO);
        let Some(first) = directions.next().copied() else {
            return;
        };
        let end = hodograph.iter().rev().find(|it| **it != DVec2::ZERO);
        let end = end.copied().unwrap_or(first);
        let is_calm = directions.all(|it| first.dot(*it) > 0.0);
        if !is_calm && left > 0 {
            let [before, behind] = halves(hodograph);
            let half = 0.5 * width;
            self.follow(before, [from, half], left - 1, last);
            self.follow(behind, [from + half, half], left - 1, last);
            return;
        }
        if self.parts.is_empty() {
            self.total = first.to_angle();
        } else {
            self.total += angle(*last, first);
        }
        self.parts.push(Part {
            from,
            direction: first,
            angle: self.total,
        });
        self.total += angle(first, end);
        *last = end;
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
}
