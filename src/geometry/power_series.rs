//! Truncated power series of a length that is known only at run time: Taylor arithmetic for curves
//! given by formulas (Griewank and Walther, "Evaluating Derivatives", chapter 13).

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

use super::coefficient::Coefficient;
use super::taylor_series::{power_sum, product_coefficient};

/// The first coefficients of the power series of a function about a parameter t:
/// f(t + h) = Σ cₖ hᵏ, k = 0 … order, where cₖ is the k-th derivative at t over k!.
///
/// Functions of series have the coefficients of the truncated series, exact up to rounding. Where a
/// function is not defined, or not smooth, coefficients are infinite or not numbers. Series that
/// are combined have the same order.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerSeries<T = f64>(Vec<T>);

impl<T: Coefficient> PowerSeries<T> {
    /// Write a constant as a series.
    pub(in crate::geometry) fn constant(value: T, order: usize) -> Self {
        let mut coefficients = vec![T::of(0.0); order + 1];
        coefficients[0] = value;
        Self(coefficients)
    }

    /// Write the parameter itself as a series about t: t + h.
    pub(in crate::geometry) fn parameter(t: T, order: usize) -> Self {
        let mut series = Self::constant(t, order);
        if let Some(slope) = series.0.get_mut(1) {
            *slope = T::of(1.0);
        }
        series
    }

    /// Take the first coefficients of a series, as many as `order` has; missing ones are 0.
    pub(in crate::geometry) fn of_coefficients(coefficients: &[T], order: usize) -> Self {
        let zeros = std::iter::repeat(T::of(0.0));
        let coefficients = coefficients.iter().copied().chain(zeros);
        Self(coefficients.take(order + 1).collect())
    }

    /// Make the series of which coefficient k + 1 follows from those up to k.
    pub(in crate::geometry) fn by_recurrence(
        value: T,
        order: usize,
        mut next: impl FnMut(&[T], usize) -> T,
    ) -> Self {
        let mut coefficients = Vec::with_capacity(order + 1);
        coefficients.push(value);
        for k in 0..order {
            let coefficient = next(&coefficients, k);
            coefficients.push(coefficient);
        }
        Self(coefficients)
    }

    /// The coefficients, of which there is at least one.
    pub(in crate::geometry) fn coefficients(&self) -> &[T] {
        &self.0
    }

    /// The order of the highest derivative.
    pub(in crate::geometry) fn order(&self) -> usize {
        self.0.len() - 1
    }

    /// The value of the function at the parameter itself.
    pub(in crate::geometry) fn value(&self) -> T {
        self.0[0]
    }

    /// Add a number.
    pub(in crate::geometry) fn plus(mut self, number: T) -> Self {
        self.0[0] = self.0[0] + number;
        self
    }

    /// Multiply by a number.
    pub(in crate::geometry) fn times(mut self, factor: T) -> Self {
        for coefficient in &mut self.0 {
            *coefficient = *coefficient * factor;
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
        Self(terms.map(|(k, c)| T::of(k as f64) * *c).collect())
    }

    /// Integrate with a given value at the parameter itself, to the given order: at most one more
    /// than this one's.
    pub(in crate::geometry) fn antiderivative(&self, value: T, order: usize) -> Self {
        Self::by_recurrence(value, order, |_, k| self.0[k] / T::of((k + 1) as f64))
    }

    /// Insert another series s for h: f(t + s − s₀), where s₀ is the other's value.
    pub(in crate::geometry) fn composed(&self, inner: &Self) -> Self {
        Self::inserted(&self.0[..=inner.order()], inner)
    }

    /// Insert a series into a polynomial Σ cₖ xᵏ.
    pub(in crate::geometry) fn polynomial(mut coefficients: Vec<T>, inner: &Self) -> Self {
        // Taylor's shift to the series' value.
        let value = inner.value();
        let degree = coefficients.len() - 1;
        for done in 0..degree {
            for k in (done..degree).rev() {
                coefficients[k] = coefficients[k] + value * coefficients[k + 1];
            }
        }
        Self::inserted(&coefficients, inner)
    }

    /// Insert a series without its value into Σ cₖ hᵏ, by Horner's rule.
    fn inserted(coefficients: &[T], inner: &Self) -> Self {
        let zero = T::of(0.0);
        if inner.0.iter().skip(2).all(|c| *c == zero) {
            // Powers of a linear series are those of its slope.
            let slope = inner.0.get(1).copied().unwrap_or(zero);
            let (mut power, terms) = (T::of(1.0), coefficients.iter().take(inner.0.len()));
            let terms = terms.map(|c| {
                let term = *c * power;
                power = power * slope;
                term
            });
            return Self::of_coefficients(&terms.collect::<Vec<T>>(), inner.order());
        }
        let step = Self([&[zero], &inner.0[1..]].concat());
        let mut terms = coefficients.iter().rev();
        let last = terms.next().copied().unwrap_or(zero);
        let last = Self::constant(last, inner.order());
        terms.fold(last, |sum, c| (&sum * &step).plus(*c))
    }

    /// Bounds of both series as far as `order`; beyond nothing is known.
    pub(in crate::geometry) fn joined(&self, other: &Self, order: usize) -> Self {
        let pairs = self.0.iter().zip(&other.0).enumerate();
        let joined = pairs.map(|(k, (a, b))| match k <= order {
            true => a.either(*b),
            false => T::UNKNOWN,
        });
        Self(joined.collect())
    }

    /// Compute eᶠ: g′ = f′ g.
    pub(in crate::geometry) fn exp(&self) -> Self {
        let slope = self.derivative();
        Self::by_recurrence(self.value().rising(f64::exp), self.order(), |g, k| {
            product_coefficient(&slope.0, g, k) / T::of((k + 1) as f64)
        })
    }

    /// Compute the natural logarithm: g′ = f′ / f.
    pub(in crate::geometry) fn ln(&self) -> Self {
        self.integrated(self.value().ln(), |f| f)
    }

    /// Compute sine and cosine: s′ = c f′, c′ = −s f′.
    pub(in crate::geometry) fn sin_cos(&self) -> (Self, Self) {
        let (sine, cosine) = self.value().sin_cos();
        self.paired(sine, cosine, T::of(-1.0))
    }

    /// Compute the hyperbolic sine and cosine: s′ = c f′, c′ = s f′.
    pub(in crate::geometry) fn sinh_cosh(&self) -> (Self, Self) {
        let value = self.value();
        self.paired(value.rising(f64::sinh), value.cosh(), T::of(1.0))
    }

    /// Compute the tangent: g′ = (1 + g²) f′.
    pub(in crate::geometry) fn tan(&self) -> Self {
        let value = self.value().tan();
        self.self_similar(value, value.squared() + T::of(1.0), T::of(2.0))
    }

    /// Compute the hyperbolic tangent: g′ = (1 − g²) f′.
    pub(in crate::geometry) fn tanh(&self) -> Self {
        let (value, slope) = (self.value().rising(f64::tanh), self.value().tanh_slope());
        self.self_similar(value, slope, T::of(-2.0))
    }

    /// Compute the inverse sine: g′ = f′ / √(1 − f²).
    pub(in crate::geometry) fn asin(&self) -> Self {
        self.integrated(self.value().asin(), |f| {
            // As a product nothing is lost where f is near 1.
            let (below, above) = ((-&f).plus(T::of(1.0)), f.plus(T::of(1.0)));
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
        let value = self.value().rising(f64::atan);
        self.integrated(value, |f| f.squared().plus(T::of(1.0)))
    }

    /// Compute the angle of the direction (x, f), with the signs of both: g′ = (x f′ − f x′) / (x² + f²).
    pub(in crate::geometry) fn direction(&self, x: &Self) -> Self {
        let value = self.value().direction(x.value());
        if self.order() == 0 {
            return Self(vec![value]);
        }
        let [y_before, x_before] = [self, x].map(|it| it.truncated(self.order() - 1));
        let turning = &(&x_before * &self.derivative()) - &(&y_before * &x.derivative());
        let squared = &x_before.squared() + &y_before.squared();
        (&turning / &squared).antiderivative(value, self.order())
    }

    /// Compute |f|, which is smooth but where f is 0: there, derivatives are unknown.
    pub(in crate::geometry) fn abs(&self) -> Self {
        match self.value().compared(T::of(0.0)) {
            Some(Ordering::Greater) => self.clone(),
            Some(Ordering::Less) => -self,
            _ => -&self.bent(&-self),
        }
    }

    /// Take the smaller one of two, of equal ones the first.
    pub(in crate::geometry) fn lower(&self, other: &Self) -> Self {
        match self.value().compared(other.value()) {
            Some(Ordering::Less | Ordering::Equal) => self.clone(),
            Some(Ordering::Greater) => other.clone(),
            None => self.bent(other),
        }
    }

    /// Take the larger one of two, of equal ones the first.
    pub(in crate::geometry) fn upper(&self, other: &Self) -> Self {
        -&(-self).lower(&-other)
    }

    /// The smaller one of two where each may be the smaller one: the slope is that of either.
    fn bent(&self, other: &Self) -> Self {
        let value = self.value().lower(other.value());
        Self::by_recurrence(value, self.order(), |_, k| match k {
            0 => self.0[1].either(other.0[1]),
            _ => T::UNKNOWN,
        })
    }

    /// Square it.
    pub(in crate::geometry) fn squared(&self) -> Self {
        let mut square = self * self;
        square.0[0] = self.value().squared();
        square
    }

    /// Raise to a power that is a number. Whole powers of small size are those of repeated
    /// multiplication, also where f is 0 or negative.
    pub(in crate::geometry) fn power(&self, exponent: f64) -> Self {
        /// Above this a whole power is one like others.
        const FEW: f64 = 64.0;
        if exponent.fract() == 0.0 && exponent.abs() <= FEW {
            let power = self.whole_power(exponent.abs() as u32);
            return if exponent < 0.0 {
                &Self::constant(T::of(1.0), self.order()) / &power
            } else {
                power
            };
        }
        let inverse = T::of(1.0) / self.value();
        Self::by_recurrence(self.value().power(exponent), self.order(), |g, k| {
            power_sum(exponent, &self.0, g, k + 1) * inverse / T::of((k + 1) as f64)
        })
    }

    fn whole_power(&self, exponent: u32) -> Self {
        let mut power = Self::constant(T::of(1.0), self.order());
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = power.squared();
            if exponent >> bit & 1 == 1 {
                power = &power * self;
            }
        }
        power
    }

    /// Solve g′ = f′ / `slope`(f) with g = `value` at the parameter itself.
    fn integrated(&self, value: T, slope: impl Fn(Self) -> Self) -> Self {
        if self.order() == 0 {
            return Self(vec![value]);
        }
        let divisor = slope(self.truncated(self.order() - 1));
        (&self.derivative() / &divisor).antiderivative(value, self.order())
    }

    /// Solve s′ = c f′, c′ = `sign` · s f′.
    fn paired(&self, sine: T, cosine: T, sign: T) -> (Self, Self) {
        let slope = self.derivative();
        let (mut sines, mut cosines) = (vec![sine], vec![cosine]);
        for k in 0..self.order() {
            let step = T::of(1.0) / T::of((k + 1) as f64);
            let rise = product_coefficient(&cosines, &slope.0, k) * step;
            let fall = product_coefficient(&sines, &slope.0, k) * step;
            sines.push(rise);
            cosines.push(sign * fall);
        }
        (Self(sines), Self(cosines))
    }

    /// Solve g′ = h f′ with h′ = `twice` g g′: h = 1 ± g².
    fn self_similar(&self, value: T, factor: T, twice: T) -> Self {
        let slope = self.derivative();
        let (mut values, mut factors, mut slopes) = (vec![value], vec![factor], Vec::new());
        for k in 0..self.order() {
            let step = T::of((k + 1) as f64);
            slopes.push(product_coefficient(&factors, &slope.0, k));
            values.push(slopes[k] / step);
            factors.push(twice * product_coefficient(&values, &slopes, k) / step);
        }
        Self(values)
    }

    fn zipped(&self, other: &Self, combine: impl Fn(T, T) -> T) -> Self {
        let pairs = self.0.iter().zip(&other.0);
        Self(pairs.map(|(a, b)| combine(*a, *b)).collect())
    }
}

impl PowerSeries {
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
}

impl<T: Coefficient> Add for &PowerSeries<T> {
    type Output = PowerSeries<T>;

    fn add(self, other: Self) -> PowerSeries<T> {
        self.zipped(other, |a, b| a + b)
    }
}

impl<T: Coefficient> Sub for &PowerSeries<T> {
    type Output = PowerSeries<T>;

    fn sub(self, other: Self) -> PowerSeries<T> {
        self.zipped(other, |a, b| a - b)
    }
}

impl<T: Coefficient> Neg for &PowerSeries<T> {
    type Output = PowerSeries<T>;

    fn neg(self) -> PowerSeries<T> {
        PowerSeries(self.0.iter().map(|c| -*c).collect())
    }
}

impl<T: Coefficient> Mul for &PowerSeries<T> {
    type Output = PowerSeries<T>;

    fn mul(self, other: Self) -> PowerSeries<T> {
        let orders = 0..=self.order().min(other.order());
        PowerSeries(
            orders
                .map(|k| product_coefficient(&self.0, &other.0, k))
                .collect(),
        )
    }
}

impl<T: Coefficient> Div for &PowerSeries<T> {
    type Output = PowerSeries<T>;

    /// Solve q b = a: qₖ = (aₖ − Σ bⱼ qₖ₋ⱼ) / b₀, j = 1 … k.
    fn div(self, other: Self) -> PowerSeries<T> {
        let orders = self.order().min(other.order());
        let inverse = T::of(1.0) / other.value();
        let quotient = self.value() / other.value();
        PowerSeries::by_recurrence(quotient, orders, |q, k| {
            // Without b₀: the sum over j = 1 … k + 1.
            let known = product_coefficient(&other.0[1..], q, k);
            (self.0[k + 1] - known) * inverse
        })
    }
}
