//! Which vertices move, and where their coordinates stand among the unknowns.

use glam::DVec3;

use crate::geometry::float_polygon::FloatPolygon;

/// Number the coordinates of the vertices that may move.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    /// For every vertex its place among those that may move.
    places: Vec<Option<usize>>,
    /// The vertices that may move, by place.
    vertices: Vec<usize>,
    /// Coordinates of a vertex: 2 in the plane.
    pub(super) axes: usize,
}

impl Unknowns {
    /// Number the vertices of a polygon for which `moves` holds, in the plane or in space.
    ///
    /// Those of a periodic polygon are taken from both sides of vertex 0 in turn: neighbours then
    /// stand at most two places apart, all round.
    pub(super) fn new(polygon: &FloatPolygon, planar: bool, moves: impl Fn(usize) -> bool) -> Self {
        let count = polygon.vertices().len();
        let order = (0..count).map(|place| match (polygon.is_periodic(), place % 2) {
            (false, _) => place,
            (true, 0) => place / 2,
            (true, _) => count - place.div_ceil(2),
        });
        let vertices: Vec<usize> = order.filter(|vertex| moves(*vertex)).collect();
        let mut places = vec![None; count];
        for (place, vertex) in vertices.iter().enumerate() {
            places[*vertex] = Some(place);
        }
        Self {
            places,
            vertices,
            axes: if planar { 2 } else { 3 },
        }
    }

    /// The number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.axes * self.vertices.len()
    }

    /// The first unknown of a vertex, if it may move.
    pub(super) fn first(&self, vertex: usize) -> Option<usize> {
        let place = self.places.get(vertex).copied().flatten();
        place.map(|place| self.axes * place)
    }

    /// Whether a vertex may move.
    pub(super) fn moves(&self, vertex: usize) -> bool {
        self.first(vertex).is_some()
    }

    /// List the vertices that may move, each with its first unknown.
    pub(super) fn vertices(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let places = self.vertices.iter().enumerate();
        places.map(|(place, vertex)| (*vertex, self.axes * place))
    }

    /// Move vertices by a share of a step of all unknowns.
    pub(super) fn moved(&self, vertices: &[DVec3], step: &[f64], share: f64) -> Vec<DVec3> {
        let mut moved = vertices.to_vec();
        for (vertex, first) in self.vertices() {
            for axis in 0..self.axes {
                moved[vertex][axis] += share * step[first + axis];
            }
        }
        moved
    }

    /// A gradient by vertices as one by all unknowns.
    pub(super) fn row(&self, gradient: &[(usize, DVec3)]) -> Vec<f64> {
        let mut row = vec![0.0; self.len()];
        for (vertex, slope) in gradient {
            if let Some(first) = self.first(*vertex) {
                for axis in 0..self.axes {
                    row[first + axis] += slope[axis];
                }
            }
        }
        row
    }
}
