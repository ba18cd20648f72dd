//! What a hostile curve is like, apart from its family.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;

/// What a family is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub degree: usize,
    pub in_space: bool,
    pub rational: bool,
    pub periodic: bool,
    /// How many vertices more than one segment has.
    pub extra: usize,
}

/// The highest degrees that are drawn, the low ones more often.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    pub planar: usize,
    pub planar_rational: usize,
    pub space: usize,
    pub space_rational: usize,
}

impl Form {
    /// Draw a form.
    pub fn random(random: &mut Random, reach: Reach) -> Self {
        let [in_space, rational] = [(); 2].map(|()| random.bits().is_multiple_of(2));
        let highest = match (in_space, rational) {
            (false, false) => reach.planar,
            (false, true) => reach.planar_rational,
            (true, false) => reach.space,
            (true, true) => reach.space_rational,
        };
        let part = random.between(0.0, 1.0).powi(3);
        let degree = 2 + (part * (highest - 1) as f64) as usize;
        // Long curves cost much at high degrees.
        let most = if degree <= 5 { 5 } else { 3 };
        Self {
            degree: degree.min(highest),
            in_space,
            rational,
            periodic: random.bits().is_multiple_of(4),
            extra: (random.bits() % most) as usize,
        }
    }

    pub fn vertices(&self) -> usize {
        self.degree + 1 + self.extra
    }

    /// Make the curve; weights count if it is to be rational, heights if it lies in space.
    pub fn curve(&self, vertices: &[DVec3], weights: &[f64]) -> FloatPolygon {
        let flat = |vertex: &DVec3| {
            let z = if self.in_space { vertex.z } else { 0.0 };
            vertex.with_z(z)
        };
        let vertices = vertices.iter().map(flat).collect();
        let weights = self.rational.then(|| weights.to_vec());
        FloatPolygon::new(self.degree, vertices, weights, self.periodic).expect("a valid polygon")
    }

    /// Draw a weight of a usual size.
    pub fn weight(random: &mut Random) -> f64 {
        match random.bits() % 4 {
            0 => 1.0,
            1 => 2f64.powi((random.bits() % 5) as i32 - 2),
            2 => random.between(1.0, 9.0).round(),
            _ => random.between(0.5, 2.0),
        }
    }

    /// Draw as many weights of usual sizes as there are vertices.
    pub fn weights(&self, random: &mut Random, count: usize) -> Vec<f64> {
        (0..count).map(|_| Self::weight(random)).collect()
    }
}

/// Draw a size between two powers of ten.
pub fn size(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(random.between(low, high))
}

/// Draw a whole number from −reach to reach.
pub fn whole(random: &mut Random, reach: i64) -> i64 {
    (random.bits() % (2 * reach as u64 + 1)) as i64 - reach
}

/// Draw a vector of whole numbers.
pub fn whole_vector(random: &mut Random, reach: i64) -> DVec3 {
    DVec3::from([(); 3].map(|()| whole(random, reach) as f64))
}
