//! Float polygons whose curves begin and end at given points.
//!
//! A float polygon runs beyond its curve. Between the points given first and last, q₀ and q_m, the
//! others are vertices as they are; in place of q₀ and of q_m come ⌊n/2⌋ + 1 vertices each. Those
//! make Σ|Δ³Pᵢ|² + 0.3 Σ wᵢ|Δ²Pᵢ|² over the whole polygon as small as possible while
//!
//!   Σ_{i<n} bᵢ Pᵢ = q₀,   Σ_{i<n} bᵢ P_{N−n+i} = q_m,   bᵢ the basis of degree n at the end knot,
//!
//! without the third differences where only two points are given: then the polygon is straight and
//! evenly divided. Third differences alone would let the ends hook, second ones would flatten them. Within the vertices
//! of an end and the point beside them, w = r⁴, with r ≥ 1 the ratio of the second leg between the points to the first:
//! beside a short leg the end would leave it backward. Elsewhere w = 1.

use std::ops::Range;

use glam::DVec3;

use crate::geometry::banded::{BandedQr, BandedRow, difference_stencil};
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::end::End;
use crate::geometry::error::{MAX_DEGREE, PolygonError};
use crate::geometry::float_polygon::FloatPolygon;

/// The orders of the differences, if there are points enough, with the weights of their squares.
const ORDERS: [(usize, f64); 2] = [(2, 0.3), (3, 1.0)];

/// The ratio of legs beyond which second differences weigh no more: equations stay regular.
const MOST_RATIO: f64 = 1e2;

/// Repetitions that remove the rounding errors of the conditions.
const REFINEMENTS: usize = 3;

impl FloatPolygon {
    /// Find the float polygon of a degree n whose curve begins at the first and ends at the last of
    /// some points, and that has the points between them as vertices: see the formula above. Of m + 1
    /// points, at least two, it has m − 1 + 2 (⌊n/2⌋ + 1) vertices, so any degree can be had of any
    /// number of points. Of degree 1 it is the polygon of the points themselves.
    ///
    /// The curve's ends are off by rounding only. Points of the plane z = 0 give a planar polygon.
    ///
    /// # Errors
    /// [`PolygonError::TooFewVertices`] of fewer than two points; otherwise as
    /// [`FloatPolygon::new`].
    pub fn through_ends(degree: usize, points: &[DVec3]) -> Result<Self, PolygonError> {
        let (first, last, between) = match points {
            [first, between @ .., last] if (1..=MAX_DEGREE).contains(&degree) => {
                (*first, *last, between)
            }
            _ => return Self::new(degree, points.to_vec(), None, false),
        };
        let tail = tail(degree);
        let mut layout = Layout::new(degree, [tail, tail], between.len());
        let mut backward = points.iter().rev().copied();
        layout.stiffness = [stiffness(points.iter().copied()), stiffness(&mut backward)];
        let mut vertices = vec![first; tail];
        vertices.extend_from_slice(between);
        vertices.resize(layout.count(), last);
        layout.place(&mut vertices, [first, last]);
        Self::new(degree, vertices, None, false)
    }

    /// The ⌊n/2⌋ + 1 vertices that stand for an end of an open curve.
    pub fn tail(&self, end: End) -> Range<usize> {
        let (count, tail) = (self.vertices().len(), tail(self.degree()));
        match end {
            End::Start => 0..tail,
            End::Finish => count - tail..count,
        }
    }

    /// Let an open curve go on from one of its ends to a point, with one vertex more. The end point becomes a vertex; after
    /// it come ⌊n/2⌋ + 1 vertices instead of those there were, placed by the formula above. Weights stay; the new vertex
    /// has the geometric mean of its neighbours'.
    ///
    /// # Errors
    /// [`PolygonError::PeriodicCurve`] of a periodic curve; otherwise as [`FloatPolygon::new`].
    pub fn continued(&self, end: End, to: DVec3) -> Result<Self, PolygonError> {
        self.check_open("continued")?;
        let from = self.end_jet(end).point;
        let Range { start, end: beyond } = self.tail(end);
        let tail = beyond - start;
        let (at, added, moved) = match end {
            End::Start => (beyond, [tail, 0], start..beyond),
            End::Finish => (start, [0, tail], start + 1..beyond + 1),
        };
        let mut vertices = self.vertices().to_vec();
        vertices.insert(at, from);
        vertices[moved].fill(to);
        let weights = self.weights().map(|old| {
            let mut weights = old.to_vec();
            weights.insert(at, (old[at - 1] * old[at]).sqrt());
            weights
        });
        let mut layout = Layout::new(self.degree(), added, vertices.len() - tail);
        let beside = match end {
            End::Start => vertices.get(beyond + 1),
            End::Finish => start.checked_sub(1).and_then(|it| vertices.get(it)),
        };
        layout.stiffness = [stiffness([to, from].into_iter().chain(beside.copied())); 2];
        layout.weights.clone_from(&weights);
        layout.place(&mut vertices, [to, to]);
        Self::new(self.degree(), vertices, weights, false)
    }
}

/// The vertices that come in place of an end point.
fn tail(degree: usize) -> usize {
    degree / 2 + 1
}

/// The weight of second differences beside the end of some points.
fn stiffness(points: impl Iterator<Item = DVec3>) -> f64 {
    let points: Vec<DVec3> = points.take(3).collect();
    let legs = points.windows(2).map(|pair| pair[0].distance(pair[1]));
    match legs.collect::<Vec<f64>>()[..] {
        [first, second] if second > first => (second / first).min(MOST_RATIO).powi(4),
        _ => 1.0,
    }
}

/// The added vertices and their conditions.
struct Layout {
    degree: usize,
    /// Vertices added at each end; an end without any stays as it is.
    added: [usize; 2],
    /// Vertices between them.
    between: usize,
    /// The basis of degree n at an end knot: n numbers, the same from both sides.
    basis: Vec<f64>,
    /// The weights of all vertices of a rational curve.
    weights: Option<Vec<f64>>,
    /// The weights of second differences among the added vertices of each end and the one beside them.
    stiffness: [f64; 2],
}

impl Layout {
    fn new(degree: usize, added: [usize; 2], between: usize) -> Self {
        let mut basis: Vec<f64> = uniform_basis_derivative(degree, 0, 0.0);
        basis.truncate(degree);
        Self {
            degree,
            added,
            between,
            basis,
            weights: None,
            stiffness: [1.0; 2],
        }
    }

    fn count(&self) -> usize {
        self.between + self.columns()
    }

    /// The number of added vertices.
    fn columns(&self) -> usize {
        self.added[0] + self.added[1]
    }

    /// The number of an added vertex among the added ones.
    fn column(&self, vertex: usize) -> Option<usize> {
        let [before, _] = self.added;
        if vertex < before {
            return Some(vertex);
        }
        let column = vertex.checked_sub(self.between)?;
        (column >= before).then_some(column)
    }

    /// Put the added vertices in their places.
    fn place(&self, vertices: &mut [DVec3], ends: [DVec3; 2]) {
        let conditions = self.conditions();
        let Some(factors) = self.factors(&conditions) else {
            return;
        };
        let columns = self.columns();
        let held = conditions
            .each_ref()
            .map(|condition| factors.solve(&self.entries(condition, columns)));
        // The smallest differences without regard to the ends, then the least that meets them.
        let downhill = self.gradient(vertices, &conditions, ends);
        self.move_added(vertices, |axis| {
            let gradient: Vec<f64> = downhill.iter().map(|slope| slope[axis]).collect();
            factors.solve(&gradient)
        });
        for _ in 0..REFINEMENTS {
            let missing = [0, 1].map(|end| ends[end] - combined(&conditions[end], vertices));
            let product = |row: usize, column: usize| -> f64 {
                let entries = self.entries(&conditions[row], columns);
                let own = entries.iter().zip(&held[column]);
                let product: f64 = own.map(|(a, b)| a * b).sum();
                // An end that stays has no condition, and no part in the other one's.
                match conditions[row].is_empty() && row == column {
                    true => 1.0,
                    false => product,
                }
            };
            let [a, b, c, d] = [product(0, 0), product(0, 1), product(1, 0), product(1, 1)];
            let determinant = a * d - b * c;
            let factor = [
                (d * missing[0] - b * missing[1]) / determinant,
                (a * missing[1] - c * missing[0]) / determinant,
            ];
            self.move_added(vertices, |axis| {
                let pairs = held[0].iter().zip(&held[1]);
                pairs
                    .map(|(start, finish)| factor[0][axis] * start + factor[1][axis] * finish)
                    .collect()
            });
        }
    }

    fn move_added(&self, vertices: &mut [DVec3], by: impl Fn(usize) -> Vec<f64>) {
        for axis in 0..3 {
            let moves = by(axis);
            for (vertex, place) in vertices.iter_mut().enumerate() {
                let column = self.column(vertex);
                if let Some(by) = column.and_then(|column| moves.get(column)) {
                    place[axis] += by;
                }
            }
        }
    }

    /// The weights of the vertices in the two end points, none in one that stays.
    fn conditions(&self) -> [Vec<(usize, f64)>; 2] {
        let last = self.count() - self.degree;
        let [before, after] = self.added;
        [(0, before), (last, after)].map(|(first, added)| {
            if added == 0 {
                return Vec::new();
            }
            let places = (first..).zip(self.basis.iter().copied());
            match &self.weights {
                None => places.collect(),
                Some(weights) => weighted(places.collect(), weights),
            }
        })
    }

    /// The differences in which an added vertex occurs.
    fn differences(&self) -> Vec<Vec<(usize, f64)>> {
        let orders = ORDERS.into_iter();
        let orders = orders.filter(|(order, _)| *order <= self.between + 2);
        let rows = orders.flat_map(|(order, weight)| {
            let stencil = difference_stencil(order);
            let places = 0..self.count().saturating_sub(order);
            places.map(move |first| {
                let factor = match order {
                    2 => (weight * self.stiffness_at(first)).sqrt(),
                    _ => weight.sqrt(),
                };
                let entries = stencil.iter().enumerate();
                let entries = entries.map(|(index, share)| (first + index, factor * *share));
                entries.collect()
            })
        });
        let touches = |row: &Vec<(usize, f64)>| {
            let mut vertices = row.iter();
            vertices.any(|(vertex, _)| self.column(*vertex).is_some())
        };
        rows.filter(touches).collect()
    }

    /// The weight of a second difference by its first vertex.
    fn stiffness_at(&self, first: usize) -> f64 {
        let ([before, after], [start, finish]) = (self.added, self.stiffness);
        if before > 0 && first + 2 <= before {
            start
        } else if after > 0 && first + 1 >= before + self.between {
            finish
        } else {
            1.0
        }
    }

    /// What a combination of vertices has of the added ones, by their columns.
    fn entries(&self, row: &[(usize, f64)], columns: usize) -> Vec<f64> {
        let mut entries = vec![0.0; columns];
        for (vertex, share) in row {
            if let Some(entry) = self.column(*vertex).and_then(|it| entries.get_mut(it)) {
                *entry += share;
            }
        }
        entries
    }

    /// The factors of all rows. The conditions are among them: that changes nothing where they are
    /// met, and leaves nothing undetermined.
    fn factors(&self, conditions: &[Vec<(usize, f64)>; 2]) -> Option<BandedQr> {
        let columns = self.columns();
        let conditions = conditions.iter().filter(|it| !it.is_empty());
        let rows = self.differences().into_iter().chain(conditions.cloned());
        let rows = rows.map(|row| BandedRow {
            first: 0,
            entries: self.entries(&row, columns),
            right: 0.0,
        });
        BandedQr::new(rows.collect(), columns)
    }

    /// The direction in which the sum of squares falls, by the added vertices.
    fn gradient(
        &self,
        vertices: &[DVec3],
        conditions: &[Vec<(usize, f64)>; 2],
        ends: [DVec3; 2],
    ) -> Vec<DVec3> {
        let mut gradient = vec![DVec3::ZERO; self.columns()];
        let differences = self.differences().into_iter().map(|row| (row, DVec3::ZERO));
        let conditions = conditions.iter().cloned().zip(ends);
        for (row, value) in differences.chain(conditions) {
            let missing = value - combined(&row, vertices);
            for (vertex, share) in &row {
                if let Some(slope) = self.column(*vertex).and_then(|it| gradient.get_mut(it)) {
                    *slope += *share * missing;
                }
            }
        }
        gradient
    }
}

/// The shares of the vertices of a rational curve: those of their weights too.
fn weighted(row: Vec<(usize, f64)>, weights: &[f64]) -> Vec<(usize, f64)> {
    let weight = |vertex: usize| weights.get(vertex).copied().unwrap_or(1.0);
    let shares = row
        .into_iter()
        .map(|(vertex, b)| (vertex, b * weight(vertex)));
    let shares: Vec<(usize, f64)> = shares.collect();
    let sum: f64 = shares.iter().map(|(_, share)| share).sum();
    shares
        .into_iter()
        .map(|(vertex, share)| (vertex, share / sum))
        .collect()
}

fn combined(row: &[(usize, f64)], vertices: &[DVec3]) -> DVec3 {
    let terms = row.iter();
    terms
        .filter_map(|(vertex, share)| Some(*share * *vertices.get(*vertex)?))
        .sum()
}
