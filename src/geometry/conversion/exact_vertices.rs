//! Homogeneous vertices with more digits than doubles hold, coordinate by coordinate.

use std::ops::Range;

use glam::{DVec3, DVec4};

use crate::geometry::control_polygon::ControlPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::expansion::Expansion;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// What K = 3 parts may lose of the numbers that entered a vertex, in their units: a weight
/// smaller than this cannot be told from 0.
const LOST: f64 = 1.0 / (1u128 << 75) as f64 / (1u128 << 75) as f64;

/// Rounding error of a conversion's steps, in units of the last of K doubles.
const STEPS: f64 = 1024.0;

/// Relative error below which rounding a number is rounding the exact one: 2⁻⁶⁰.
const SURE: f64 = f64::EPSILON / 256.0;

/// Hold the homogeneous coordinates w·x, w·y, w·z and w of some vertices.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::geometry) struct ExactVertices<const K: usize> {
    /// The coordinates; z is left out of a planar polygon, w of a polynomial one.
    axes: [Option<Vec<Expansion<K>>>; 4],
}

impl<const K: usize> ExactVertices<K> {
    /// Take the vertices of a polygon without error.
    pub(in crate::geometry) fn of(polygon: &ControlPolygon) -> Self {
        Self::new(polygon.weighted_vertices(), polygon.is_rational())
    }

    /// Take vertices and weights without error.
    pub(in crate::geometry) fn new(
        vertices: impl Iterator<Item = (DVec3, f64)> + Clone,
        rational: bool,
    ) -> Self {
        let planar = vertices.clone().all(|(vertex, _)| vertex.z == 0.0);
        let coordinate = |axis: usize| {
            let numbers = vertices.clone();
            let numbers = numbers.map(|(vertex, weight)| {
                if axis == 3 {
                    Expansion::from(weight)
                } else if rational {
                    Expansion::product(vertex[axis], weight)
                } else {
                    Expansion::from(vertex[axis])
                }
            });
            numbers.collect()
        };
        let used = [true, true, !planar, rational];
        Self {
            axes: std::array::from_fn(|axis| used[axis].then(|| coordinate(axis))),
        }
    }

    /// Whether there are weights.
    pub(in crate::geometry) fn is_rational(&self) -> bool {
        self.axes[3].is_some()
    }

    /// The number of vertices.
    pub(in crate::geometry) fn len(&self) -> usize {
        self.axes[0].as_ref().map_or(0, Vec::len)
    }

    /// Change each coordinate's list of numbers in place.
    pub(in crate::geometry) fn change(&mut self, change: impl Fn(&mut [Expansion<K>])) {
        self.axes.iter_mut().flatten().for_each(|axis| change(axis));
    }

    /// Make vertices whose coordinates are lists made of the present ones.
    pub(in crate::geometry) fn map(
        &self,
        make: impl Fn(&[Expansion<K>]) -> Vec<Expansion<K>>,
    ) -> Self {
        let axes = self.axes.each_ref();
        Self {
            axes: axes.map(|axis| axis.as_ref().map(|axis| make(axis))),
        }
    }

    /// Make vertices whose coordinates are lists made of the present ones and of others with the
    /// same coordinates in use.
    pub(in crate::geometry) fn map_with(
        &self,
        other: &Self,
        make: impl Fn(&[Expansion<K>], &[Expansion<K>]) -> Vec<Expansion<K>>,
    ) -> Self {
        let mut others = other.axes.iter();
        let axes = self.axes.each_ref();
        Self {
            axes: axes.map(|axis| {
                let other = others.next().and_then(Option::as_ref);
                axis.as_ref()
                    .zip(other)
                    .map(|(axis, other)| make(axis, other))
            }),
        }
    }

    /// Hold the same coordinates by J doubles a number.
    pub(in crate::geometry) fn resized<const J: usize>(&self) -> ExactVertices<J> {
        let axes = self.axes.each_ref();
        let resized = |axis: &Vec<Expansion<K>>| axis.iter().map(|n| n.resized()).collect();
        ExactVertices {
            axes: axes.map(|axis| axis.as_ref().map(resized)),
        }
    }

    /// Subtract the homogeneous coordinates of another vertex from those of a vertex and round;
    /// a coordinate that neither polygon has is 0.
    pub(in crate::geometry) fn difference(&self, other: &Self, index: usize) -> DVec4 {
        let coordinate = |axis: usize| {
            let [a, b] = [self, other].map(|vertices| vertices.axes[axis].as_ref());
            let [a, b] = [a, b].map(|axis| axis.map_or(Expansion::default(), |axis| axis[index]));
            (a - b).value()
        };
        DVec4::from_array(std::array::from_fn(coordinate))
    }

    /// List the K doubles of each number in use.
    pub(in crate::geometry) fn parts(&self) -> [Option<Vec<[f64; K]>>; 4] {
        let axes = self.axes.each_ref();
        axes.map(|axis| {
            let axis = axis.as_ref()?;
            Some(axis.iter().map(|number| *number.parts()).collect())
        })
    }

    /// Find the largest magnitude of each coordinate's numbers in a range; 0 where it is not in use.
    pub(in crate::geometry) fn largest(&self, range: Range<usize>) -> [f64; 4] {
        let axes = self.axes.each_ref();
        axes.map(|axis| {
            let values = axis.iter().flat_map(|axis| &axis[range.clone()]);
            values.fold(0.0, |largest: f64, number| {
                largest.max(number.value().abs())
            })
        })
    }

    /// Whether converting has left enough digits of each number of a vertex to round it, when the
    /// magnitudes that entered it sum up to `entered`.
    pub(in crate::geometry) fn is_sure(&self, index: usize, entered: [f64; 4]) -> bool {
        let lost = STEPS * f64::EPSILON.powi(K as i32);
        let mut axes = self.axes.iter().zip(entered);
        axes.all(|(axis, entered)| {
            let number = axis.as_ref().map_or(0.0, |axis| axis[index].value());
            entered == 0.0 || number.abs() * SURE >= lost * entered
        })
    }

    /// Take some of the vertices.
    pub(in crate::geometry) fn part(&self, range: Range<usize>) -> Self {
        self.map(|axis| axis[range.clone()].to_vec())
    }

    /// Find the largest weight; 1 for a polynomial curve.
    pub(in crate::geometry) fn largest_weight(&self) -> f64 {
        let Some(weights) = &self.axes[3] else {
            return 1.0;
        };
        weights
            .iter()
            .fold(0.0, |largest, w| w.value().max(largest))
    }

    /// Round a vertex to doubles: the point and its weight.
    pub(in crate::geometry) fn rounded(&self, index: usize) -> (DVec3, f64) {
        let coordinate = |axis: usize| self.axes[axis].as_ref().map(|axis| axis[index]);
        let weight = coordinate(3);
        let point = [0, 1, 2].map(|axis| match (coordinate(axis), weight) {
            (Some(number), Some(weight)) => (number / weight).value(),
            (Some(number), None) => number.value(),
            (None, _) => 0.0,
        });
        (DVec3::from(point), weight.map_or(1.0, Expansion::value))
    }

    /// Round all vertices to doubles: points and, of a rational curve, weights.
    pub(in crate::geometry) fn all_rounded(&self) -> RoundedVertices {
        let all = (0..self.len()).map(|index| self.rounded(index));
        let (points, weights): (Vec<DVec3>, Vec<f64>) = all.unzip();
        (points, self.is_rational().then_some(weights))
    }
}

/// Points and, of a rational curve, weights.
pub(in crate::geometry) type RoundedVertices = (Vec<DVec3>, Option<Vec<f64>>);

/// Bound the error of a weight computed from numbers whose magnitudes sum up to `total`.
pub(in crate::geometry) fn weight_loss(total: f64) -> f64 {
    total * LOST
}

/// Refuse a weight that is not positive, or not by more than its computation `loses`.
///
/// # Errors
/// [`PolygonError::WeightLost`].
pub(in crate::geometry) fn check_weight(
    to: PolygonKind,
    index: usize,
    weight: f64,
    loses: f64,
) -> Result<(), PolygonError> {
    // Written so that a weight that is not a number is refused too.
    if weight > loses {
        Ok(())
    } else {
        Err(PolygonError::WeightLost { to, index, weight })
    }
}

/// Make the float polygon of converted vertices.
///
/// # Errors
/// As [`FloatPolygon::new`], with [`PolygonError::Overflow`] for the vertices.
pub(in crate::geometry) fn converted_float(
    degree: usize,
    (vertices, weights): RoundedVertices,
    periodic: bool,
) -> Result<FloatPolygon, PolygonError> {
    FloatPolygon::new(degree, vertices, weights, periodic)
        .map_err(|error| converted_error(PolygonKind::Float, error))
}

/// Name the vertex that a converted polygon cannot hold, in place of the constructor's complaint
/// about a number that the user never gave.
pub(in crate::geometry) fn converted_error(to: PolygonKind, error: PolygonError) -> PolygonError {
    match error {
        PolygonError::BadCoordinate { index, .. } | PolygonError::BadWeight { index, .. } => {
            PolygonError::Overflow { to, index }
        }
        other => other,
    }
}
