//! Batches of points and derivatives, from which all views of a curve are drawn.
//!
//! All segments of a float polygon share one basis, so the basis is computed once, for all
//! parameters of the batch, and every segment is a small product of that table and its own
//! vertices. The r-th derivative is the curve of degree n − r on the r-th differences of the
//! vertices. The loops run over a fixed number of parameters side by side, which a compiler turns
//! into vector instructions.

use glam::DVec3;

use super::basis::derivative_bases;
use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;

/// Parameters evaluated side by side: the sums of so many just fit into the registers of a
/// processor with vectors of two doubles, and are enough to hide its latency.
const LANES: usize = 16;

/// The highest derivative that a batch holds.
pub const BATCH_ORDER: usize = 3;

/// Evaluate many points of one segment after another, at the same local parameters in each.
#[derive(Clone, Debug)]
pub struct Sampler {
    degree: usize,
    count: usize,
    /// For each derivative r that does not vanish, for every pass of `LANES` parameters: the
    /// n + 1 − r basis functions of degree n − r. Lanes beyond `count` repeat the last parameter.
    tables: Vec<Vec<[f64; LANES]>>,
}

/// Hold the points and derivatives of one segment, coordinate by coordinate.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    count: usize,
    stride: usize,
    /// For each derivative, for each coordinate x, y, z, w: the values at all parameters.
    values: Vec<f64>,
    /// Whether every value of z is 0.
    flat: bool,
    /// The highest derivative that is not 0 throughout.
    order: usize,
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
        Jet::from([0, 1, 2, 3].map(vector))
    }

    /// Fill in so many parameters, one after the other: `evaluate` is given the number of a parameter
    /// and a slice for its point and its derivatives up to `order`.
    pub(super) fn fill(
        &mut self,
        count: usize,
        order: usize,
        mut evaluate: impl FnMut(usize, &mut [DVec3]),
    ) {
        self.prepare(count);
        let mut values = [DVec3::ZERO; BATCH_ORDER + 1];
        for index in 0..count {
            evaluate(index, &mut values[..=order]);
            for (order, value) in values[..=order].iter().enumerate() {
                for axis in 0..3 {
                    self.values[(order * 4 + axis) * self.stride + index] = value[axis];
                }
            }
        }
        self.clear_skipped(order, false);
    }

    fn row(&self, order: usize, axis: usize) -> &[f64] {
        let first = (order * 4 + axis) * self.stride;
        &self.values[first..first + self.stride]
    }

    /// Make room for `count` parameters.
    #[inline]
    fn prepare(&mut self, count: usize) {
        let stride = count.next_multiple_of(LANES);
        if self.stride != stride {
            self.resize(stride);
        }
        self.count = count;
    }

    #[cold]
    fn resize(&mut self, stride: usize) {
        self.values = vec![0.0; (BATCH_ORDER + 1) * 4 * stride];
        self.stride = stride;
        self.flat = true;
        self.order = 0;
    }

    /// Clear the rows that this evaluation skipped.
    fn clear_skipped(&mut self, order: usize, flat: bool) {
        let stride = self.stride;
        if flat && !self.flat {
            for order in 0..=BATCH_ORDER {
                let first = (order * 4 + 2) * stride;
                self.values[first..first + stride].fill(0.0);
            }
        }
        if order < self.order {
            self.values[(order + 1) * 4 * stride..].fill(0.0);
        }
        self.flat = flat;
        self.order = order;
    }
}

impl Sampler {
    /// Prepare to evaluate curves of this degree at the local parameters `parameters`, each in
    /// \[0, 1\].
    pub fn new(degree: usize, parameters: &[f64]) -> Self {
        let passes = parameters.len().div_ceil(LANES);
        let orders = BATCH_ORDER.min(degree) + 1;
        let mut tables: Vec<Vec<[f64; LANES]>> = (0..orders)
            .map(|order| vec![[0.0; LANES]; passes * (degree + 1 - order)])
            .collect();
        for lane in 0..passes * LANES {
            let t = parameters[lane.min(parameters.len() - 1)];
            let bases = derivative_bases::<{ BATCH_ORDER + 1 }>(degree, t);
            for (order, (table, basis)) in tables.iter_mut().zip(&bases).enumerate() {
                let size = degree + 1 - order;
                let rows = &mut table[lane / LANES * size..][..size];
                for (row, value) in rows.iter_mut().zip(basis) {
                    row[lane % LANES] = *value;
                }
            }
        }
        Self {
            degree,
            count: parameters.len(),
            tables,
        }
    }

    /// Prepare to evaluate at `count` + 1 evenly spaced parameters, both ends of the segment
    /// among them; at the start alone if `count` is 0.
    pub fn even(degree: usize, count: usize) -> Self {
        let steps = count.max(1) as f64;
        let parameters: Vec<f64> = (0..=count).map(|j| j as f64 / steps).collect();
        Self::new(degree, &parameters)
    }

    /// The degree of the curves.
    pub(super) fn degree(&self) -> usize {
        self.degree
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
    /// The cost is n + 1 − r multiplications for the r-th derivative of each coordinate at each
    /// parameter; z is skipped where it is 0. Nothing is allocated after the batch's first use.
    ///
    /// # Panics
    /// If the degrees differ, `order` is above 3, or the curve has no such segment.
    #[inline]
    pub fn segment(&self, polygon: &FloatPolygon, segment: usize, order: usize, batch: &mut Batch) {
        assert_eq!(self.degree, polygon.degree(), "the sampler's degree");
        assert!(order <= BATCH_ORDER, "derivatives up to the third");
        let size = self.degree + 1;
        let inside = polygon.vertices().get(segment..segment + size);
        if let (Some(vertices), false) = (inside, polygon.is_rational()) {
            return self.coordinates(vertices, order, batch);
        }
        self.gathered(polygon, segment, order, batch);
    }

    /// Evaluate a segment whose vertices do not stand in the polygon as they are needed: it runs
    /// over the joint of a periodic polygon, or is rational.
    fn gathered(&self, polygon: &FloatPolygon, segment: usize, order: usize, batch: &mut Batch) {
        let size = self.degree + 1;
        // A rational segment counts its coordinates from one of its vertices: the division by
        // the weight would otherwise lose what the distance from the origin takes.
        let origin = if polygon.is_rational() {
            polygon.vertex(segment + self.degree / 2)
        } else {
            DVec3::ZERO
        };
        let mut vertices = [DVec3::ZERO; MAX_DEGREE + 1];
        for (vertex, index) in vertices[..size].iter_mut().zip(segment..) {
            *vertex = (polygon.vertex(index) - origin) * polygon.weight(index);
        }
        self.coordinates(&vertices[..size], order, batch);
        if polygon.is_rational() && self.count > 0 {
            self.weights(polygon, segment, order, batch);
            // Arms may lie in a plane z ≠ 0; their own z is 0 then, and so are its rows.
            batch.flat &= origin.z == 0.0;
            project(batch, order, origin);
        }
    }

    /// Evaluate x, y and, if it is not 0 throughout, z.
    #[inline]
    fn coordinates(&self, vertices: &[DVec3], order: usize, batch: &mut Batch) {
        batch.prepare(self.count);
        if self.count == 0 {
            return;
        }
        // Without derivatives to think of, the compiler makes a better loop of the points.
        let functions = if order == 0 { &POINTS } else { &VERTICES };
        let evaluate = functions[self.degree - 1];
        let flat = evaluate(&self.tables, vertices, order, &mut batch.values);
        if flat != batch.flat || order != batch.order {
            batch.clear_skipped(order, flat);
        }
    }

    /// Evaluate the weight as a fourth coordinate.
    fn weights(&self, polygon: &FloatPolygon, segment: usize, order: usize, batch: &mut Batch) {
        let mut weights = [0.0; MAX_DEGREE + 1];
        for (weight, index) in weights[..=self.degree].iter_mut().zip(segment..) {
            *weight = polygon.weight(index);
        }
        let evaluate = NUMBERS[self.degree - 1];
        evaluate(
            &self.tables,
            &weights,
            order,
            &mut batch.values[3 * batch.stride..],
        );
    }
}

/// The basis functions of each derivative, for every pass.
type Tables = [Vec<[f64; LANES]>];

/// Evaluates one coordinate and its derivatives, given by a number a vertex, into rows that are
/// four rows apart.
type OfNumbers = fn(&Tables, &[f64], usize, &mut [f64]);

/// Evaluates x, y and z with their derivatives. Returns whether z is 0 throughout, in which case
/// its rows are left as they are.
type OfVertices = fn(&Tables, &[DVec3], usize, &mut [f64]) -> bool;

/// The sum of `SIZE` products. With their number known to the compiler the sums of all lanes stay
/// in registers, which is worth a factor of two.
#[inline(always)]
fn sum<const SIZE: usize>(table: &[[f64; LANES]], values: &[f64; SIZE], out: &mut [f64]) {
    let passes = table.as_chunks::<SIZE>().0;
    for (rows, out) in passes.iter().zip(out.as_chunks_mut::<LANES>().0) {
        let mut sums = [0.0; LANES];
        for (row, value) in rows.iter().zip(values) {
            for lane in 0..LANES {
                sums[lane] += row[lane] * value;
            }
        }
        *out = sums;
    }
}

/// The differences of neighbours.
#[inline(always)]
fn differences<const SIZE: usize, const LESS: usize>(values: &[f64; SIZE]) -> [f64; LESS] {
    std::array::from_fn(|j| {
        if j + 1 < SIZE {
            values[j + 1] - values[j]
        } else {
            0.0
        }
    })
}

/// Evaluate one coordinate: `S0` … `S3` are the numbers of basis functions of the derivatives.
#[inline(always)]
fn rows<const S0: usize, const S1: usize, const S2: usize, const S3: usize>(
    tables: &Tables,
    values: &[f64; S0],
    order: usize,
    out: &mut [f64],
) {
    let Some(points) = tables.first() else {
        return;
    };
    let stride = points.len() / S0 * LANES;
    sum(points, values, out);
    if order == 0 {
        return;
    }
    let row = |order: usize| 4 * order * stride..(4 * order + 1) * stride;
    let first: [f64; S1] = differences(values);
    derivative(tables.get(1), &first, &mut out[row(1)]);
    if order == 1 {
        return;
    }
    let second: [f64; S2] = differences(&first);
    derivative(tables.get(2), &second, &mut out[row(2)]);
    if order == 2 {
        return;
    }
    let third: [f64; S3] = differences(&second);
    derivative(tables.get(3), &third, &mut out[row(3)]);
}

/// Evaluate one derivative. Of those above the degree there is no table: they are 0.
#[inline(always)]
fn derivative<const SIZE: usize>(
    table: Option<&Vec<[f64; LANES]>>,
    values: &[f64; SIZE],
    out: &mut [f64],
) {
    match table {
        Some(table) => sum(table, values, out),
        None => out.fill(0.0),
    }
}

fn of_numbers<const S0: usize, const S1: usize, const S2: usize, const S3: usize>(
    tables: &Tables,
    values: &[f64],
    order: usize,
    out: &mut [f64],
) {
    if let Some(values) = values.first_chunk::<S0>() {
        rows::<S0, S1, S2, S3>(tables, values, order, out);
    }
}

fn of_vertices<const S0: usize, const S1: usize, const S2: usize, const S3: usize>(
    tables: &Tables,
    vertices: &[DVec3],
    order: usize,
    out: &mut [f64],
) -> bool {
    let (Some(vertices), Some(points)) = (vertices.first_chunk::<S0>(), tables.first()) else {
        return true;
    };
    let stride = points.len() / S0 * LANES;
    rows::<S0, S1, S2, S3>(tables, &vertices.map(|vertex| vertex.x), order, out);
    let y = vertices.map(|vertex| vertex.y);
    rows::<S0, S1, S2, S3>(tables, &y, order, &mut out[stride..]);
    let z = vertices.map(|vertex| vertex.z);
    let flat = z.iter().fold(true, |flat, z| flat & (*z == 0.0));
    if !flat {
        rows::<S0, S1, S2, S3>(tables, &z, order, &mut out[2 * stride..]);
    }
    flat
}

fn points_alone<const S0: usize, const S1: usize, const S2: usize, const S3: usize>(
    tables: &Tables,
    vertices: &[DVec3],
    _: usize,
    out: &mut [f64],
) -> bool {
    let (Some(vertices), Some(points)) = (vertices.first_chunk::<S0>(), tables.first()) else {
        return true;
    };
    let stride = points.len() / S0 * LANES;
    let (x, rest) = out.split_at_mut(stride);
    let (y, rest) = rest.split_at_mut(stride);
    sum(points, &vertices.map(|vertex| vertex.x), x);
    sum(points, &vertices.map(|vertex| vertex.y), y);
    let z = vertices.map(|vertex| vertex.z);
    let flat = z.iter().fold(true, |flat, z| flat & (*z == 0.0));
    if !flat {
        sum(points, &z, &mut rest[..stride]);
    }
    flat
}

/// The number of basis functions of a derivative, at least 1.
const fn size(degree: usize, derivative: usize) -> usize {
    if degree > derivative {
        degree + 1 - derivative
    } else {
        1
    }
}

/// List a function for degrees 1, 2, … 25.
macro_rules! for_every_degree {
    ($function:ident) => {
        for_every_degree!($function: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24
            25)
    };
    ($function:ident: $($degree:literal)+) => {
        [$($function::<
            { size($degree, 0) },
            { size($degree, 1) },
            { size($degree, 2) },
            { size($degree, 3) },
        >),+]
    };
}

/// The evaluation of a number a vertex, by degree, less 1.
static NUMBERS: [OfNumbers; MAX_DEGREE] = for_every_degree!(of_numbers);

/// The functions that evaluate points alone; entry n - 1 is for degree n.
static POINTS: [OfVertices; MAX_DEGREE] = for_every_degree!(points_alone);

/// The functions that evaluate vertices; entry n - 1 is for degree n.
static VERTICES: [OfVertices; MAX_DEGREE] = for_every_degree!(of_vertices);

/// Divide a batch of homogeneous derivatives by the weight (Leibniz' rule) and move the points
/// by `origin`.
fn project(batch: &mut Batch, order: usize, origin: DVec3) {
    const BINOMIAL: [[f64; 4]; 4] = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 2.0, 1.0, 0.0],
        [1.0, 3.0, 3.0, 1.0],
    ];
    let axes = if batch.flat { 2 } else { 3 };
    let stride = batch.stride;
    for first in (0..stride).step_by(LANES) {
        let at = |order: usize, axis: usize| (order * 4 + axis) * stride + first;
        let mut weights = [[0.0; LANES]; BATCH_ORDER + 1];
        for (derivative, weights) in weights.iter_mut().enumerate().take(order + 1) {
            weights.copy_from_slice(&batch.values[at(derivative, 3)..][..LANES]);
        }
        let inverse = weights[0].map(|weight| 1.0 / weight);
        for axis in 0..axes {
            let mut found = [[0.0; LANES]; BATCH_ORDER + 1];
            for derivative in 0..=order {
                let out = &mut batch.values[at(derivative, axis)..][..LANES];
                let mut value = [0.0; LANES];
                value.copy_from_slice(out);
                for k in 1..=derivative {
                    let factor = BINOMIAL[derivative][k];
                    for lane in 0..LANES {
                        value[lane] -= factor * weights[k][lane] * found[derivative - k][lane];
                    }
                }
                for lane in 0..LANES {
                    value[lane] *= inverse[lane];
                }
                found[derivative] = value;
                out.copy_from_slice(&value);
            }
            for value in &mut batch.values[at(0, axis)..][..LANES] {
                *value += origin[axis];
            }
        }
    }
}
