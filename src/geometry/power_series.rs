//! Truncated power series of a length that is known only at run time: Taylor arithmetic for curves
//! given by formulas (Griewank and Walther, "Evaluating Derivatives", chapter 13).

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

use super::taylor_series::{power_sum, product_coefficient};

/// The first coefficients of the power series of a function about a parameter t:
/// f(t + h) = Σ cₖ hᵏ, k = 0 … order, where cₖ is the k-th derivative at t over k!.
///
/// Functions of series have the coefficients of the truncated series, exact up to rounding. Where a
/// function is not defined, or not smooth, coefficients are infinite or not numbers. Series that
/// are combined have the same order.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::geometry) struct PowerSeries(Vec<f64>);

impl PowerSeries {
    /// Write a constant as a series.
    pub(in crate::geometry) fn constant(value: f64, order: usize) -> Self {
        let mut coefficients = vec![0.0; order + 1];
        coefficients[0] = value;
        Self(coefficients)
    }

    /// Write the parameter itself as a series about t: t + h.
    pub(in crate::geometry) fn parameter(t: f64, order: usize) -> Self {
        let mut series = Self::constant(t, order);
        if let Some(slope) = series.0.get_mut(1) {
            *slope = 1.0;
        }
        series
    }

    /// Make the series of which coefficient k + 1 follows from those up to k.
    pub(in crate::geometry) fn by_recurrence(
        value: f64,
        order: usize,
        mut next: impl FnMut(&[f64], usize) -> f64,
    ) -> Self {
        let mut coefficients = Vec::with_capacity(order + 1);
        coefficients.push(value);
        for k in 0..order {
            let coefficient = next(&coefficients, k);
            coefficients.push(coefficient);
        }
        Self(coefficients)
    }

    /// Write the value and the derivatives of a function as a series.
    pub(in crate::geometry) fn of_derivatives(values: impl Iterator<Item = f64>) -> Self {
        let mut factorial = 1.0;
        let coefficient = |(order, value): (usize, f64)| {
            factorial *= order.max(1) as f64;
            value / factorial
        };
        Self(values.enumerate().map(coefficient).collect())
    }

    /// The coordinates of a curve by the values of its derivatives.
    pub(in crate::geometry) fn coordinates(values: &[DVec3]) -> [Self; 3] {
        [0, 1, 2].map(|axis| Self::of_derivatives(values.iter().map(|value| value[axis])))
    }

    /// The derivatives of a curve, given by its own, by another parameter.
    pub(in crate::geometry) fn reparametrised(values: &[DVec3], inner: &Self) -> Vec<DVec3> {
        let coordinates = Self::coordinates(values).map(|series| series.composed(inner));
        Self::derivatives(coordinates.each_ref())
    }

    /// Write the series of three coordinates as a point and its derivatives.
    pub(in crate::geometry) fn derivatives([x, y, z]: [&Self; 3]) -> Vec<DVec3> {
        let coordinates = x.0.iter().zip(&y.0).zip(&z.0);
        let mut factorial = 1.0;
        let derivative = |(order, ((x, y), z)): (usize, ((&f64, &f64), &f64))| {
            factorial *= order.max(1) as f64;
            DVec3::new(*x, *y, *z) * factorial
        };
        coordinates.enumerate().map(derivative).collect()
    }

    /// The coefficients, of which there is at least one.
    pub(in crate::geometry) fn coefficients(&self) -> &[f64] {
        &self.0
    }

    /// The order of the highest derivative.
    pub(in crate::geometry) fn order(&self) -> usize {
        self.0.len() - 1
    }

    /// The value of the function at the parameter itself.
    pub(in crate::geometry) fn value(&self) -> f64 {
        self.0[0]
    }

    /// Add a number.
    pub(in crate::geometry) fn plus(mut self, number: f64) -> Self {
        self.0[0] += number;
        self
    }

    /// Multiply by a number.
    pub(in crate::geometry) fn times(mut self, factor: f64) -> Self {
        for coefficient in &mut self.0 {
            *coefficient *= factor;
        }
        self
    }

    /// Take the part that has `order` derivatives.
    pub(in crate::geometry) fn truncated(&self, order: usize) -> Self {
        Self(self.0[..=order].to_vec())
    }

    /// Differentiate, which leaves one derivative less; of a mere value the derivative is unknown.
    pub(in crate::geometry) fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self(terms.map(|(k, c)| k as f64 * c).collect())
    }

    /// Integrate with a given value at the parameter itself, to the given order: at most one more
    /// than this one's.
    pub(in crate::geometry) fn antiderivative(&self, value: f64, order: usize) -> Self {
        Self::by_recurrence(value, order, |_, k| self.0[k] / (k + 1) as f64)
    }

    /// Insert another series s for h: f(t + s − s₀), where s₀ is the other's value, by Horner's
    /// rule.
    pub(in crate::geometry) fn composed(&self, inner: &Self) -> Self {
        let step = inner.clone().plus(-inner.value());
        let order = inner.order();
        let mut terms = self.0[..=order].iter().rev();
        let last = Self::constant(terms.next().copied().unwrap_or_default(), order);
        terms.fold(last, |sum, c| (&sum * &step).plus(*c))
    }

    /// Compute eᶠ: g′ = f′ g.
    pub(in crate::geometry) fn exp(&self) -> Self {
        let slope = self.derivative();
        Self::by_recurrence(self.value().exp(), self.order(), |g, k| {
            product_coefficient(&slope.0, g, k) / (k + 1) as f64
        })
    }

    /// Compute the natural logarithm: g′ = f′ / f.
    pub(in crate::geometry) fn ln(&self) -> Self {
        self.integrated(self.value().ln(), |f| f)
    }

    /// Compute sine and cosine: s′ = c f′, c′ = −s f′.
    pub(in crate::geometry) fn sin_cos(&self) -> (Self, Self) {
        let (sine, cosine) = self.value().sin_cos();
        self.paired(sine, cosine, -1.0)
    }

    /// Compute the hyperbolic sine and cosine: s′ = c f′, c′ = s f′.
    pub(in crate::geometry) fn sinh_cosh(&self) -> (Self, Self) {
        self.paired(self.value().sinh(), self.value().cosh(), 1.0)
    }

    /// Compute the tangent: g′ = (1 + g²) f′.
    pub(in crate::geometry) fn tan(&self) -> Self {
        self.self_similar(self.value().tan(), 1.0)
    }

    /// Compute the hyperbolic tangent: g′ = (1 − g²) f′.
    pub(in crate::geometry) fn tanh(&self) -> Self {
        self.self_similar(self.value().tanh(), -1.0)
    }

    /// Compute the inverse sine: g′ = f′ / √(1 − f²).
    pub(in crate::geometry) fn asin(&self) -> Self {
        self.integrated(self.value().asin(), |f| {
            // As a product nothing is lost where f is near 1.
            let (below, above) = ((-&f).plus(1.0), f.plus(1.0));
            (&below * &above).power(0.5)
        })
    }

    /// Compute the inverse cosine: g′ = −f′ / √(1 − f²).
    pub(in crate::geometry) fn acos(&self) -> Self {
        let mut series = -&self.asin();
        series.0[0] = self.value().acos();
        series
    }

    /// Compute the inverse tangent: g′ = f′ / (1 + f²).
    pub(in crate::geometry) fn atan(&self) -> Self {
        self.integrated(self.value().atan(), |f| (&f * &f).plus(1.0))
    }

    /// Compute the angle of the direction (x, f), with the signs of both: g′ = (x f′ − f x′) / (x² + f²).
    pub(in crate::geometry) fn direction(&self, x: &Self) -> Self {
        let value = self.value().atan2(x.value());
        if self.order() == 0 {
            return Self(vec![value]);
        }
        let [y_before, x_before] = [self, x].map(|it| it.truncated(self.order() - 1));
        let turning = &(&x_before * &self.derivative()) - &(&y_before * &x.derivative());
        let squared = &(&x_before * &x_before) + &(&y_before * &y_before);
        (&turning / &squared).antiderivative(value, self.order())
    }

    /// Compute |f|, which is smooth but where f is 0: there, derivatives are not numbers.
    pub(in crate::geometry) fn abs(&self) -> Self {
        if self.value() > 0.0 {
            self.clone()
        } else if self.value() < 0.0 {
            -self
        } else {
            Self::by_recurrence(self.value().abs(), self.order(), |_, _| f64::NAN)
        }
    }

    /// Raise to a power that is a number. Whole powers of small size are those of repeated
    /// multiplication, also where f is 0 or negative.
    pub(in crate::geometry) fn power(&self, exponent: f64) -> Self {
        /// Above this a whole power is one like others.
        const FEW: f64 = 64.0;
        if exponent.fract() == 0.0 && exponent.abs() <= FEW {
            let power = self.whole_power(exponent.abs() as u32);
            return if exponent < 0.0 {
                &Self::constant(1.0, self.order()) / &power
            } else {
                power
            };
        }
        let inverse = 1.0 / self.value();
        Self::by_recurrence(self.value().powf(exponent), self.order(), |g, k| {
            power_sum(exponent, &self.0, g, k + 1) * inverse / (k + 1) as f64
        })
    }

    fn whole_power(&self, exponent: u32) -> Self {
        let mut power = Self::constant(1.0, self.order());
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = &power * &power;
            if exponent >> bit & 1 == 1 {
                power = &power * self;
            }
        }
        power
    }

    /// Solve g′ = f′ / `slope`(f) with g = `value` at the parameter itself.
    fn integrated(&self, value: f64, slope: impl Fn(Self) -> Self) -> Self {
        if self.order() == 0 {
            return Self(vec![value]);
        }
        let divisor = slope(self.truncated(self.order() - 1));
        (&self.derivative() / &divisor).antiderivative(value, self.order())
    }

    /// Solve s′ = c f′, c′ = `sign` · s f′.
    fn paired(&self, sine: f64, cosine: f64, sign: f64) -> (Self, Self) {
        let slope = self.derivative();
        let (mut sines, mut cosines) = (vec![sine], vec![cosine]);
        for k in 0..self.order() {
            let step = 1.0 / (k + 1) as f64;
            let rise = product_coefficient(&cosines, &slope.0, k) * step;
            let fall = product_coefficient(&sines, &slope.0, k) * step;
            sines.push(rise);
            cosines.push(sign * fall);
        }
        (Self(sines), Self(cosines))
    }

    /// Solve g′ = (1 + `sign` g²) f′.
    fn self_similar(&self, value: f64, sign: f64) -> Self {
        let slope = self.derivative();
        let (mut values, mut factors) = (vec![value], Vec::new());
        for k in 0..self.order() {
            let one = if k == 0 { 1.0 } else { 0.0 };
            factors.push(one + sign * product_coefficient(&values, &values, k));
            values.push(product_coefficient(&slope.0, &factors, k) / (k + 1) as f64);
        }
        Self(values)
    }

    fn zipped(&self, other: &Self, combine: impl Fn(f64, f64) -> f64) -> Self {
        let pairs = self.0.iter().zip(&other.0);
        Self(pairs.map(|(a, b)| combine(*a, *b)).collect())
    }
}

impl Add for &PowerSeries {
    type Output = PowerSeries;

    fn add(self, other: Self) -> PowerSeries {
        self.zipped(other, |a, b| a + b)
    }
}

impl Sub for &PowerSeries {
    type Output = PowerSeries;

    fn sub(self, other: Self) -> PowerSeries {
        self.zipped(other, |a, b| a - b)
    }
}

impl Neg for &PowerSeries {
    type Output = PowerSeries;

    fn neg(self) -> PowerSeries {
        PowerSeries(self.0.iter().map(|c| -c).collect())
    }
}

impl Mul for &PowerSeries {
    type Output = PowerSeries;

    fn mul(self, other: Self) -> PowerSeries {
        let orders = 0..=self.order().min(other.order());
        PowerSeries(
            orders
                .map(|k| product_coefficient(&self.0, &other.0, k))
                .collect(),
        )
    }
}

impl Div for &PowerSeries {
    type Output = PowerSeries;

    /// Solve q b = a: qₖ = (aₖ − Σ bⱼ qₖ₋ⱼ) / b₀, j = 1 … k.
    fn div(self, other: Self) -> PowerSeries {
        let orders = self.order().min(other.order());
        let inverse = 1.0 / other.value();
        let quotient = self.value() / other.value();
        PowerSeries::by_recurrence(quotient, orders, |q, k| {
            // Without b₀: the sum over j = 1 … k + 1.
            let known = product_coefficient(&other.0[1..], q, k);
            (self.0[k + 1] - known) * inverse
        })
    }
}
