//! Numbers that carry their derivatives: exact slopes of any formula of three vectors.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// The coordinates of three vectors.
const COORDINATES: usize = 9;

/// Hold a number and its derivatives by the coordinates of three vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    value: f64,
    slopes: [f64; COORDINATES],
}

/// Hold a vector of such numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct DualVector {
    x: Dual,
    y: Dual,
    z: Dual,
}

/// Evaluate a formula of three vectors, with its gradient by each of them.
pub(super) fn differentiate(
    vectors: [DVec3; 3],
    formula: impl Fn([DualVector; 3]) -> Dual,
) -> (f64, [DVec3; 3]) {
    let variable = |vector: usize| {
        let coordinate = |axis: usize| {
            let mut slopes = [0.0; COORDINATES];
            slopes[3 * vector + axis] = 1.0;
            Dual {
                value: vectors[vector][axis],
                slopes,
            }
        };
        DualVector {
            x: coordinate(0),
            y: coordinate(1),
            z: coordinate(2),
        }
    };
    let Dual { value, slopes } = formula([variable(0), variable(1), variable(2)]);
    let gradient = |vector: usize| DVec3::from_slice(&slopes[3 * vector..]);
    (value, [gradient(0), gradient(1), gradient(2)])
}

impl Dual {
    /// Apply a function, given its value and its derivative here.
    fn map(self, value: f64, slope: f64) -> Self {
        Self {
            value,
            slopes: self.slopes.map(|it| slope * it),
        }
    }

    /// The square root; its slope at 0 counts as 0.
    pub(super) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.map(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }

    /// The natural logarithm.
    pub(super) fn ln(self) -> Self {
        self.map(self.value.ln(), self.value.recip())
    }

    /// The cube.
    pub(super) fn cubed(self) -> Self {
        self * self * self
    }

    /// The angle of the point (`cosine`, `self`), in radians.
    pub(super) fn atan2(self, cosine: Self) -> Self {
        let squared = self.value * self.value + cosine.value * cosine.value;
        let mut slopes = [0.0; COORDINATES];
        if squared > 0.0 {
            for (slope, (sine, cosine_slope)) in slopes
                .iter_mut()
                .zip(self.slopes.iter().zip(&cosine.slopes))
            {
                *slope = (cosine.value * sine - self.value * cosine_slope) / squared;
            }
        }
        Self {
            value: self.value.atan2(cosine.value),
            slopes,
        }
    }
}

impl DualVector {
    /// The scalar product.
    pub(super) fn dot(self, other: Self) -> Dual {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector product.
    pub(super) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The component along a fixed vector.
    pub(super) fn along(self, axis: DVec3) -> Dual {
        self.x * axis.x + self.y * axis.y + self.z * axis.z
    }

    /// The length.
    pub(super) fn length(self) -> Dual {
        self.dot(self).sqrt()
    }
}

/// The numerator of a curve's curvature slope by its first three derivatives: dκ/ds times |C′|⁶,
/// with κ as seen along a normal; without one times |C′ × C″| as well, with κ of the curve in space.
pub(super) fn slope_numerator(
    [first, second, third]: [DualVector; 3],
    seen: Option<DVec3>,
) -> Dual {
    let (normal, change) = (first.cross(second), first.cross(third));
    let (turning, bending) = match seen {
        Some(axis) => (change.along(axis), normal.along(axis)),
        None => (normal.dot(change), normal.dot(normal)),
    };
    first.dot(first) * turning - first.dot(second) * bending * 3.0
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut sum = self;
        sum.value += other.value;
        for (slope, added) in sum.slopes.iter_mut().zip(other.slopes) {
            *slope += added;
        }
        sum
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.map(factor * self.value, factor)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut slopes = other.slopes;
        for (slope, own) in slopes.iter_mut().zip(self.slopes) {
            *slope = self.value * *slope + other.value * own;
        }
        Self {
            value: self.value * other.value,
            slopes,
        }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let inverse = other.value.recip();
        self * other.map(inverse, -inverse * inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_agree_with_differences() {
        let vectors = [
            DVec3::new(1.0, 0.3, -0.2),
            DVec3::new(0.4, 1.1, 0.5),
            DVec3::new(-0.3, 0.2, 0.9),
        ];
        type Formula = fn([DualVector; 3]) -> Dual;
        let formulas: [Formula; 4] = [
            |[a, b, _]| a.cross(b).length() / a.length().cubed(),
            |[a, b, c]| (a.length() * a.dot(b.cross(c))).atan2(a.cross(b).dot(b.cross(c))),
            |[a, _, c]| a.dot(c).sqrt().ln() - c.along(DVec3::Y),
            |[a, b, c]| -a.dot(b) * c.length() * 2.0,
        ];
        // Central differences leave the cube root of the rounding squared.
        const STEP: f64 = 1e-5;
        for (number, formula) in formulas.into_iter().enumerate() {
            let vectors = if number == 2 {
                [vectors[0], vectors[1], -vectors[2]]
            } else {
                vectors
            };
            let (_, gradient) = differentiate(vectors, formula);
            for vector in 0..3 {
                for axis in 0..3 {
                    let moved = |by: f64| {
                        let mut moved = vectors;
                        moved[vector][axis] += by;
                        differentiate(moved, formula).0
                    };
                    let difference = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
                    let slope = gradient[vector][axis];
                    assert!(
                        (slope - difference).abs() <= 1e-8 * (1.0 + slope.abs()),
                        "{number}: {slope} against {difference}"
                    );
                }
            }
        }
    }
}
