//! Batches of points and derivatives: what every view of a curve is drawn from.
//!
//! All segments of a float polygon share one basis, so the basis is computed once, for all
//! parameters of the batch, and every segment is a small product of that table and its own
//! vertices. The r-th derivative is the curve of degree n − r on the r-th differences of the
//! vertices. The loops run over a fixed number of parameters side by side, which a compiler turns
//! into vector instructions.

use glam::DVec3;

use super::basis::uniform_basis_step;
use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;

/// Parameters evaluated side by side. Two coordinates of so many just fit into the registers of
/// a processor with vectors of two doubles.
const LANES: usize = 8;

/// The highest derivative that a batch holds.
pub const BATCH_ORDER: usize = 3;

/// The coordinates x, y, z and w of a segment's vertices.
type Window = [[f64; MAX_DEGREE + 1]; 4];

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

    /// The rows of the coordinates `axis` … `axis` + K − 1 of one derivative.
    fn rows_mut<const K: usize>(&mut self, order: usize, axis: usize) -> [&mut [f64]; K] {
        let first = (order * 4 + axis) * self.stride;
        let mut rows = self.values[first..first + K * self.stride].chunks_exact_mut(self.stride);
        std::array::from_fn(|_| rows.next().unwrap_or_default())
    }

    /// Make room, and clear what an earlier evaluation left in rows that this one skips.
    fn prepare(&mut self, count: usize, stride: usize, order: usize, flat: bool) {
        if self.stride != stride {
            self.values = vec![0.0; (BATCH_ORDER + 1) * 4 * stride];
            self.stride = stride;
            self.flat = true;
            self.order = 0;
        }
        if flat && !self.flat {
            for order in 0..=BATCH_ORDER {
                let [row] = self.rows_mut(order, 2);
                row.fill(0.0);
            }
        }
        if order < self.order {
            self.values[(order + 1) * 4 * stride..].fill(0.0);
        }
        self.count = count;
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
            let mut basis = [0.0; MAX_DEGREE + 1];
            basis[0] = 1.0;
            for level in 0..=degree {
                if level > 0 {
                    uniform_basis_step(level, t, &mut basis);
                }
                let Some(table) = tables.get_mut(degree - level) else {
                    continue;
                };
                let first = lane / LANES * (level + 1);
                for (row, value) in table[first..=first + level].iter_mut().zip(basis) {
                    row[lane % LANES] = value;
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
    pub fn segment(&self, polygon: &FloatPolygon, segment: usize, order: usize, batch: &mut Batch) {
        assert_eq!(self.degree, polygon.degree(), "the sampler's degree");
        assert!(order <= BATCH_ORDER, "derivatives up to the third");
        // Coordinates count from a vertex of the segment, so that far from the origin nothing
        // is lost.
        let reference = polygon.vertex(segment + self.degree / 2);
        let mut window: Window = [[0.0; MAX_DEGREE + 1]; 4];
        let rational = polygon.is_rational();
        let flat = self.gather(polygon, segment, reference, &mut window);
        let stride = self.count.next_multiple_of(LANES);
        batch.prepare(self.count, stride, order, flat);
        if self.count == 0 {
            return;
        }
        // A rational curve is moved to its place after the division by the weight.
        let origin = if rational { DVec3::ZERO } else { reference };
        let [x, y, z, w] = &mut window;
        self.coordinates([x, y], 0, [origin.x, origin.y], order, batch);
        match (flat, rational) {
            (true, false) => {}
            (false, false) => self.coordinates([z], 2, [origin.z], order, batch),
            (true, true) => self.coordinates([w], 3, [0.0], order, batch),
            (false, true) => self.coordinates([z, w], 2, [0.0, 0.0], order, batch),
        }
        if rational {
            project(batch, order, reference);
        }
    }

    /// Write the segment's vertices coordinate by coordinate, and tell whether z is 0 throughout.
    fn gather(
        &self,
        polygon: &FloatPolygon,
        segment: usize,
        reference: DVec3,
        window: &mut Window,
    ) -> bool {
        let rational = polygon.is_rational();
        let mut flat = reference.z == 0.0;
        let last = segment + self.degree;
        let inside = polygon.vertices().get(segment..=last);
        for j in 0..=self.degree {
            let vertex = inside.map_or_else(|| polygon.vertex(segment + j), |inside| inside[j]);
            flat &= vertex.z == 0.0;
            let mut arm = vertex - reference;
            if rational {
                let weight = polygon.weight(segment + j);
                arm *= weight;
                window[3][j] = weight;
            }
            (window[0][j], window[1][j], window[2][j]) = (arm.x, arm.y, arm.z);
        }
        flat
    }

    /// Evaluate K neighbouring coordinates, of which the first has number `axis`, and move their
    /// points by `origin`. The vertices in `window` are replaced by their differences.
    fn coordinates<const K: usize>(
        &self,
        mut window: [&mut [f64; MAX_DEGREE + 1]; K],
        axis: usize,
        mut origin: [f64; K],
        order: usize,
        batch: &mut Batch,
    ) {
        for derivative in 0..=order {
            let out = batch.rows_mut::<K>(derivative, axis);
            let Some(table) = self.tables.get(derivative) else {
                out.into_iter().for_each(|row| row.fill(0.0));
                continue;
            };
            let used = self.degree + 1 - derivative;
            combine(table, std::array::from_fn(|k| &window[k][..used]), origin, out);
            for values in window.iter_mut() {
                for j in 0..used - 1 {
                    values[j] = values[j + 1] - values[j];
                }
            }
            origin = [0.0; K];
        }
    }
}

/// Add up vertices times basis functions, at all parameters of the table, for K coordinates.
fn combine<const K: usize>(
    table: &[[f64; LANES]],
    vertices: [&[f64]; K],
    origin: [f64; K],
    mut out: [&mut [f64]; K],
) {
    let used = vertices[0].len();
    for (pass, rows) in table.chunks_exact(used).enumerate() {
        let mut sums = [[0.0; LANES]; K];
        for (j, row) in rows.iter().enumerate() {
            for (sum, vertices) in sums.iter_mut().zip(&vertices) {
                let vertex = vertices[j];
                for lane in 0..LANES {
                    sum[lane] += row[lane] * vertex;
                }
            }
        }
        for ((sum, origin), out) in sums.into_iter().zip(origin).zip(&mut out) {
            let out = &mut out[pass * LANES..(pass + 1) * LANES];
            for lane in 0..LANES {
                out[lane] = sum[lane] + origin;
            }
        }
    }
}

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
