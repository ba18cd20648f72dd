//! Polygons that are their own mirror images.

use glam::DVec3;

use super::error::PolygonError;
use super::float_polygon::FloatPolygon;
use super::mirror::Mirror;

impl FloatPolygon {
    /// Make the polygon its own mirror image, in reversed order, by the mean of both: (Pᵢ + P̄ₛ₋ᵢ) / 2.
    ///
    /// An open polygon has s = N − 1; of a periodic one s is that which moves the vertices least. The second half is
    /// computed as the image of the first, bit for bit where coordinates change their signs, and a vertex that is its
    /// own partner is projected. Weights become those of both, evenly.
    ///
    /// # Errors
    /// [`PolygonError`] if numbers overflow.
    pub fn symmetrised(&self, mirror: &Mirror) -> Result<Self, PolygonError> {
        let count = self.vertices().len();
        let sum = match self.is_periodic() {
            true => least_sum(self.vertices(), mirror),
            false => count - 1,
        };
        let partner = |index: usize| (sum + count - index) % count;
        let mut vertices = self.vertices().to_vec();
        let mut weights = self.weights().map(<[f64]>::to_vec);
        for index in 0..count {
            let other = partner(index);
            if other < index {
                continue;
            }
            let mean = mean(self.vertex(index), mirror.point(self.vertex(other)));
            vertices[index] = mean;
            if other != index {
                vertices[other] = mirror.point(mean);
            }
            if let Some(weights) = &mut weights {
                let mean = 0.5 * weights[index] + 0.5 * weights[other];
                (weights[index], weights[other]) = (mean, mean);
            }
        }
        Self::new(self.degree(), vertices, weights, self.is_periodic())
    }
}

/// The middle of two points.
fn mean(a: DVec3, b: DVec3) -> DVec3 {
    0.5 * a + 0.5 * b
}

/// The sum of the numbers of partners with which a closed polygon moves least to its mean with its mirror image.
fn least_sum(vertices: &[DVec3], mirror: &Mirror) -> usize {
    let count = vertices.len();
    let images: Vec<DVec3> = vertices.iter().map(|it| mirror.point(*it)).collect();
    let moves = |sum: usize| -> f64 {
        let pairs = vertices.iter().enumerate();
        let squares = pairs.map(|(index, vertex)| {
            let partner = (sum + count - index) % count;
            vertex.distance_squared(images[partner])
        });
        squares.sum()
    };
    (0..count)
        .min_by(|a, b| moves(*a).total_cmp(&moves(*b)))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_becomes_its_own_image_bit_for_bit() {
        let mirror = Mirror::Signs([true, false, false]);
        for count in [6, 7, 12, 13] {
            let vertex = |index: usize| {
                let t = index as f64 - 0.5 * (count - 1) as f64;
                (
                    t + 0.1 * (7.0 * t).sin(),
                    0.3 * t * t + 0.2 * (3.0 * t).cos(),
                )
            };
            let vertices: Vec<(f64, f64)> = (0..count).map(vertex).collect();
            let polygon = FloatPolygon::planar(4, &vertices).expect("a polygon");
            let symmetric = polygon.symmetrised(&mirror).expect("a polygon");
            for index in 0..count {
                let image = mirror.point(symmetric.vertex(index));
                assert_eq!(symmetric.vertex(count - 1 - index), image);
            }
            assert_eq!(symmetric.symmetrised(&mirror), Ok(symmetric));
        }
    }

    #[test]
    fn a_closed_polygon_keeps_its_place_in_its_order() {
        let mirror = Mirror::Signs([false, true, false]);
        for (count, shift) in [(12, 0.0), (12, 0.5), (13, 3.0), (10, 4.5)] {
            let vertex = |index: usize| {
                let angle = std::f64::consts::TAU * (index as f64 + shift) / count as f64;
                DVec3::new(
                    3.0 * angle.cos(),
                    2.0 * angle.sin() + 0.01 * angle.cos(),
                    0.0,
                )
            };
            let vertices: Vec<DVec3> = (0..count).map(vertex).collect();
            let polygon = FloatPolygon::new(3, vertices, None, true).expect("a polygon");
            let symmetric = polygon.symmetrised(&mirror).expect("a polygon");
            let pairs = polygon.vertices().iter().zip(symmetric.vertices());
            let moved = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(moved < 0.0101, "{count} {shift}: {moved}");
            for vertex in symmetric.vertices() {
                let image = mirror.point(*vertex);
                assert!(
                    symmetric.vertices().contains(&image),
                    "{count} {shift}: {vertex}"
                );
            }
        }
    }
}
