//! The motion of a shape as a whole.

use glam::{DVec2, DVec3};

use super::parametric_curve::ParametricCurve;

/// The number of points that tell how a shape was moved.
const SAMPLES: usize = 33;

/// What points may be off a motion, in units of the shape's size.
const ROUNDING: f64 = 1e-9;

/// A motion x ↦ a (x − p) + q: a turn about the z axis, with a scale if the shape is planar, and a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// The factor a as a complex number.
    factor: DVec2,
    /// The point p.
    from: DVec3,
    /// Its image q.
    to: DVec3,
}

impl Similarity {
    /// Find the motion that takes a shape to another; `None` unless there is one, as after a change of a part.
    pub fn between(before: &dyn ParametricCurve, after: &dyn ParametricCurve) -> Option<Self> {
        if before.pieces() != after.pieces() {
            return None;
        }
        let step = before.pieces() as f64 / (SAMPLES - 1) as f64;
        let sampled = |shape: &dyn ParametricCurve| -> Vec<DVec3> {
            let places = (0..SAMPLES).map(|it| it as f64 * step);
            places.map(|u| shape.jet(u).point).collect()
        };
        let (from, to) = (sampled(before), sampled(after));
        let (first, image) = (*from.first()?, *to.first()?);
        let ways = from.iter().zip(&to);
        let ways = ways.map(|(from, to)| (*from - first, *to - image));
        let ways: Vec<(DVec3, DVec3)> = ways.collect();
        let length = |way: &DVec3| way.truncate().length_squared();
        let longest = ways
            .iter()
            .max_by(|a, b| length(&a.0).total_cmp(&length(&b.0)))?;
        let [own, its] = [longest.0, longest.1].map(DVec3::truncate);
        if own.length_squared() == 0.0 {
            return None;
        }
        let conjugate = DVec2::new(own.x, -own.y);
        let found = Self {
            factor: its.rotate(conjugate) / own.length_squared(),
            from: first,
            to: image,
        };
        let size = ways.iter().map(|(own, _)| own.length()).fold(0.0, f64::max);
        let is_there =
            |(from, to): (&DVec3, &DVec3)| found.image(*from).distance(*to) <= ROUNDING * size;
        from.iter().zip(&to).all(is_there).then_some(found)
    }

    /// The image of a point.
    pub fn image(&self, point: DVec3) -> DVec3 {
        let way = point - self.from;
        self.to + self.factor.rotate(way.truncate()).extend(way.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    const VERTICES: [(f64, f64); 6] = [
        (0.0, 0.0),
        (1.0, 0.4),
        (2.0, 0.3),
        (3.1, -0.2),
        (4.0, 0.6),
        (5.0, 0.1),
    ];

    fn moved(by: impl Fn(DVec2) -> DVec2) -> FloatPolygon {
        let vertices = VERTICES.map(|(x, y)| by(DVec2::new(x, y)).into());
        FloatPolygon::planar(3, &vertices).expect("a polygon")
    }

    #[test]
    fn turns_scales_and_shifts_are_found() {
        let before = moved(|it| it);
        let turn = DVec2::from_angle(0.7);
        for scale in [1.0, 2.5] {
            let motion = |it: DVec2| scale * turn.rotate(it) + DVec2::new(30.0, -7.0);
            let found = Similarity::between(&before, &moved(motion)).expect("a motion");
            let point = DVec2::new(-3.0, 8.0);
            let image = found.image(point.extend(0.0));
            let off = image.distance(motion(point).extend(0.0));
            assert!(off <= 1e-12 * 30.0, "{off}");
        }
    }

    #[test]
    fn other_changes_are_no_motions() {
        let before = moved(|it| it);
        let stretched = moved(|it| DVec2::new(it.x, 1.001 * it.y));
        assert_eq!(Similarity::between(&before, &stretched), None);
        let mirrored = moved(|it| DVec2::new(it.x, -it.y));
        assert_eq!(Similarity::between(&before, &mirrored), None);
        let mut bent = before.clone();
        bent.move_vertices([(3, DVec3::new(3.1, -0.25, 0.0))])
            .expect("in range");
        assert_eq!(Similarity::between(&before, &bent), None);
    }
}
