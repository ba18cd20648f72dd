//! Batches of points and derivatives: what every view of a curve is drawn from.
//!
//! All segments of a float polygon share one basis. A segment is converted once to powers of
//! s = t − ½ about its middle vertex, which loses a few roundings only, and then evaluated at
//! all parameters of the batch in loops that a compiler turns into vector instructions.

use glam::DVec3;

use super::basis::power_matrix;
use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;

/// Parameters evaluated in one pass of the inner loop.
const LANES: usize = 16;

/// The highest derivative that a batch holds.
pub const BATCH_ORDER: usize = 3;

/// Evaluate many points of one segment after another, at the same local parameters in each.
#[derive(Clone, Debug)]
pub struct Sampler {
    degree: usize,
    matrix: Vec<f64>,
    /// s = t − ½ for every parameter, padded with zeros to whole passes.
    offsets: Vec<f64>,
    count: usize,
}

/// Hold the points and derivatives of one segment, coordinate by coordinate.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    count: usize,
    stride: usize,
    /// For each derivative, for each coordinate x, y, z, w: the values at all parameters.
    values: Vec<f64>,
}

impl Batch {
    /// The number of parameters evaluated.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether nothing was evaluated.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The values of one coordinate (0 x, 1 y, 2 z) of one derivative at all parameters.
    ///
    /// # Panics
    /// If the batch holds no such derivative or coordinate.
    pub fn coordinate(&self, order: usize, axis: usize) -> &[f64] {
        &self.row(order, axis)[..self.count]
    }

    /// The point and the first three derivatives at one parameter; derivatives that were not
    /// asked for are 0.
    ///
    /// # Panics
    /// If the batch has no parameter with this number.
    pub fn jet(&self, index: usize) -> Jet {
        assert!(index < self.count, "parameter {index} of {}", self.count);
        let vector = |order: usize| {
            let first = order * 4 * self.stride + index;
            let value = |axis: usize| self.values[first + axis * self.stride];
            DVec3::new(value(0), value(1), value(2))
        };
        Jet {
            point: vector(0),
            first: vector(1),
            second: vector(2),
            third: vector(3),
        }
    }

    fn row(&self, order: usize, axis: usize) -> &[f64] {
        let first = (order * 4 + axis) * self.stride;
        &self.values[first..first + self.stride]
    }

    fn reset(&mut self, count: usize, stride: usize) {
        if self.stride != stride || self.values.len() != (BATCH_ORDER + 1) * 4 * stride {
            self.values = vec![0.0; (BATCH_ORDER + 1) * 4 * stride];
            self.stride = stride;
        }
        self.count = count;
    }
}

impl Sampler {
    /// Prepare to evaluate curves of this degree at the local parameters `parameters`, each in
    /// \[0, 1\].
    pub fn new(degree: usize, parameters: &[f64]) -> Self {
        let mut offsets: Vec<f64> = parameters.iter().map(|t| t - 0.5).collect();
        offsets.resize(parameters.len().next_multiple_of(LANES), 0.0);
        Self {
            degree,
            matrix: power_matrix(degree),
            offsets,
            count: parameters.len(),
        }
    }

    /// Prepare to evaluate at `count` + 1 evenly spaced parameters, both ends of the segment
    /// among them.
    pub fn even(degree: usize, count: usize) -> Self {
        let parameters: Vec<f64> = (0..=count).map(|j| j as f64 / count as f64).collect();
        Self::new(degree, &parameters)
    }

    /// The number of parameters.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are no parameters.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Evaluate the points and the derivatives up to `order` (at most 3) of one segment.
    ///
    /// The cost is (n + 1)² steps for the segment and about (order + 1)·n a parameter, for each
    /// coordinate; z is skipped where it is 0. Nothing is allocated after the batch's first use.
    ///
    /// # Panics
    /// If the degrees differ, `order` is above 3, or the curve has no such segment.
    pub fn segment(&self, polygon: &FloatPolygon, segment: usize, order: usize, batch: &mut Batch) {
        assert_eq!(self.degree, polygon.degree(), "the sampler's degree");
        assert!(order <= BATCH_ORDER, "derivatives up to the third");
        batch.reset(self.count, self.offsets.len());
        let mut window = [[0.0; MAX_DEGREE + 1]; 4];
        let reference = polygon.vertex(segment + self.degree / 2);
        let mut flat = reference.z == 0.0;
        if polygon.is_rational() {
            for j in 0..=self.degree {
                let (vertex, weight) = (polygon.vertex(segment + j), polygon.weight(segment + j));
                store(&mut window, j, (vertex - reference) * weight);
                window[3][j] = weight;
                flat &= vertex.z == 0.0;
            }
        } else {
            for j in 0..=self.degree {
                let vertex = polygon.vertex(segment + j);
                store(&mut window, j, vertex - reference);
                flat &= vertex.z == 0.0;
            }
        }
        for axis in 0..4 {
            let used = axis < 2 || (axis == 2 && !flat) || (axis == 3 && polygon.is_rational());
            if used {
                self.coordinate(&window[axis], axis, order, batch);
            } else if axis == 2 {
                for derivative in 0..=order {
                    let first = (derivative * 4 + axis) * batch.stride;
                    batch.values[first..first + batch.stride].fill(0.0);
                }
            }
        }
        if polygon.is_rational() {
            project(batch, order);
        }
        for (axis, offset) in reference.to_array().into_iter().enumerate() {
            let first = axis * batch.stride;
            for value in &mut batch.values[first..first + self.count] {
                *value += offset;
            }
        }
    }

    fn coordinate(&self, window: &[f64], axis: usize, order: usize, batch: &mut Batch) {
        let size = self.degree + 1;
        let mut coefficients = [0.0; MAX_DEGREE + 1];
        for (power, coefficient) in coefficients[..size].iter_mut().enumerate() {
            let row = &self.matrix[power * size..(power + 1) * size];
            *coefficient = row.iter().zip(window).map(|(m, v)| m * v).sum();
        }
        let stride = batch.stride;
        let mut length = size;
        for derivative in 0..=order {
            let first = (derivative * 4 + axis) * stride;
            let out = &mut batch.values[first..first + stride];
            horner(&coefficients[..length], &self.offsets, out);
            length = length.saturating_sub(1);
            for power in 0..length {
                coefficients[power] = coefficients[power + 1] * (power + 1) as f64;
            }
        }
    }
}

fn store(window: &mut [[f64; MAX_DEGREE + 1]; 4], index: usize, vector: DVec3) {
    window[0][index] = vector.x;
    window[1][index] = vector.y;
    window[2][index] = vector.z;
}

/// Evaluate one polynomial at all offsets, a fixed number of them side by side.
fn horner(coefficients: &[f64], offsets: &[f64], out: &mut [f64]) {
    let Some((&leading, rest)) = coefficients.split_last() else {
        out.fill(0.0);
        return;
    };
    let passes = offsets.as_chunks::<LANES>().0;
    for (s, out) in passes.iter().zip(out.as_chunks_mut::<LANES>().0) {
        let mut values = [leading; LANES];
        for &coefficient in rest.iter().rev() {
            for lane in 0..LANES {
                values[lane] = values[lane] * s[lane] + coefficient;
            }
        }
        *out = values;
    }
}

/// Divide a batch of homogeneous derivatives by the weight (Leibniz' rule).
fn project(batch: &mut Batch, order: usize) {
    const BINOMIAL: [[f64; 4]; 4] = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 2.0, 1.0, 0.0],
        [1.0, 3.0, 3.0, 1.0],
    ];
    let stride = batch.stride;
    for index in 0..batch.count {
        let weight = |k: usize| (k * 4 + 3) * stride + index;
        let inverse = 1.0 / batch.values[weight(0)];
        for axis in 0..3 {
            for derivative in 0..=order {
                let mut value = batch.values[(derivative * 4 + axis) * stride + index];
                for k in 1..=derivative {
                    value -= BINOMIAL[derivative][k]
                        * batch.values[weight(k)]
                        * batch.values[((derivative - k) * 4 + axis) * stride + index];
                }
                batch.values[(derivative * 4 + axis) * stride + index] = value * inverse;
            }
        }
    }
}
