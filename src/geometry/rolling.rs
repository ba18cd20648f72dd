//! The exact change between a periodic polygon and the open one that runs round it once: its last n vertices are the
//! first ones once more.

use super::float_polygon::FloatPolygon;

/// Vertices and weights that differ by no more than this share of the size are the same.
const SHARED: f64 = 1e-12;

impl FloatPolygon {
    /// Write the periodic curve's polygon as an open one: the first n vertices are repeated
    /// behind the last, so that the open curve runs round once. An open polygon is returned as
    /// it is.
    pub fn unrolled(&self) -> Self {
        if !self.is_periodic() {
            return self.clone();
        }
        let round = 0..self.vertices().len() + self.degree();
        self.window(round)
            .expect("a periodic polygon has more than n vertices")
    }

    /// Write the polygon of an open curve that runs round once as a periodic one, without its last n vertices.
    ///
    /// The parameters are the same. `None` where the last n vertices are not the first ones (differ by more than 1e-12
    /// of the size), as those of [`unrolled`](Self::unrolled) are, or the curve is periodic.
    pub fn rolled(&self) -> Option<Self> {
        if self.is_periodic() || !self.goes_on_in(self) {
            return None;
        }
        let kept = self.vertices().len() - self.degree();
        let vertices = self.vertices().iter().take(kept).copied().collect();
        let weights = self.weights();
        let weights = weights.map(|weights| weights.iter().take(kept).copied().collect());
        Self::new(self.degree(), vertices, weights, true).ok()
    }

    /// Whether another open curve, or this one itself, goes on with the knots and the last n vertices of this one.
    pub fn goes_on_in(&self, next: &Self) -> bool {
        let degree = self.degree();
        let Some(begin) = self.vertices().len().checked_sub(degree) else {
            return false;
        };
        let size = self.size().max(next.size());
        let is_shared = |index: usize| {
            let [own, other] = [begin + index, index];
            let weight = self.weight(own);
            self.vertex(own).distance(next.vertex(other)) <= SHARED * size
                && (weight - next.weight(other)).abs() <= SHARED * weight
        };
        next.degree() == degree && (0..degree).all(is_shared)
    }

    /// The exact curve of this one and another that goes on with its knots and its last n vertices, as the parts of a
    /// curve do that was split at a knot; `None` where it does not go on so.
    pub fn followed_by(&self, next: &Self) -> Option<Self> {
        if !self.goes_on_in(next) {
            return None;
        }
        let degree = self.degree();
        let behind = degree..next.vertices().len();
        let vertices = self.vertices().iter().copied();
        let vertices = vertices.chain(behind.clone().map(|index| next.vertex(index)));
        let weights = [self, next].iter().any(|it| it.is_rational()).then(|| {
            let own = (0..self.vertices().len()).map(|index| self.weight(index));
            own.chain(behind.map(|index| next.weight(index))).collect()
        });
        Self::new(degree, vertices.collect(), weights, false).ok()
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn ring(degree: usize, count: usize, weights: bool) -> FloatPolygon {
        let angle = |index: usize| index as f64 * std::f64::consts::TAU / count as f64;
        let vertices = (0..count).map(|it| DVec3::new(angle(it).cos(), angle(it).sin(), it as f64));
        let weights = weights.then(|| (0..count).map(|it| 1.0 + it as f64).collect());
        FloatPolygon::new(degree, vertices.collect(), weights, true).expect("a polygon")
    }

    #[test]
    fn rolled_undoes_unrolled_bit_by_bit() {
        for (degree, count) in [(1, 3), (3, 4), (4, 9), (7, 8)] {
            for weights in [false, true] {
                let ring = ring(degree, count, weights);
                let open = ring.unrolled();
                assert_eq!(open.segments(), ring.segments());
                for step in 0..8 * count {
                    let u = step as f64 / 8.0;
                    assert_eq!(open.point(u), ring.point(u), "degree {degree}, u {u}");
                }
                assert_eq!(open.rolled(), Some(ring));
            }
        }
    }

    #[test]
    fn what_does_not_go_on_in_itself_is_not_rolled() {
        let ring = ring(3, 9, false);
        assert_eq!(ring.rolled(), None, "it is periodic");
        let mut open = ring.unrolled();
        let last = open.vertices().len() - 1;
        let moved = open.vertex(last) + 1e-9 * open.size() * DVec3::X;
        open.move_vertices([(last, moved)]).expect("a polygon");
        assert_eq!(open.rolled(), None);
        let short = FloatPolygon::planar(3, &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0)]);
        assert_eq!(short.expect("a polygon").rolled(), None);
    }
}
