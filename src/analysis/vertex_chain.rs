//! A polygon's vertices, and the figures and series that follow from its legs and corners.

use std::cell::OnceCell;
use std::ops::Range;

use glam::{DVec2, DVec3};

use super::bins::{BINS, Bins};
use super::revision::Revision;
use crate::geometry::Range as Span;
use crate::geometry::polygon_figures::{discrete_curvature, torsion_angle, turning_angle};

/// Vertices in one block.
pub(super) const BLOCK: usize = 64;

/// Hold a polygon's vertices and, block by block, the figures of its legs and corners.
#[derive(Debug, Default)]
pub struct VertexChain {
    vertices: Vec<DVec3>,
    closed: bool,
    /// Whether all vertices lie in the plane z = 0: only then angles and curvatures have signs.
    planar: bool,
    blocks: Vec<Block>,
}

/// The figures of the vertices of one block, and of the legs that begin at them.
#[derive(Clone, Debug, Default)]
struct Block {
    revision: Revision,
    figures: OnceCell<ChainFigures>,
    extremes: OnceCell<Vec<(usize, f64)>>,
    flows: [OnceCell<Vec<DVec2>>; Flow::ALL.len()],
}

/// Name a sequence of the flow of control vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// The lengths of the legs.
    Legs,
    /// The turning angles.
    Turns,
    /// The discrete curvature.
    Curvatures,
    /// The torsion angles of a polygon in space.
    TorsionAngles,
}

impl Flow {
    /// All of them, as they are drawn one below the other.
    pub const ALL: [Self; 4] = [
        Self::Legs,
        Self::Turns,
        Self::Curvatures,
        Self::TorsionAngles,
    ];
}

/// The smallest and largest leg and turning angle of a polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChainFigures {
    /// The legs' lengths; `None` for fewer than two vertices.
    pub legs: Option<Span>,
    /// The turning angles in radians; `None` for fewer than three vertices.
    pub turns: Option<Span>,
}

impl VertexChain {
    /// The vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Whether a leg runs from the last vertex to the first.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The revisions of the blocks: one changes when a vertex of the block or next to it moves.
    pub fn revisions(&self) -> impl ExactSizeIterator<Item = Revision> {
        self.blocks.iter().map(|block| block.revision)
    }

    /// The numbers of the vertices of one block.
    pub fn block_vertices(&self, block: usize) -> Range<usize> {
        block * BLOCK..((block + 1) * BLOCK).min(self.vertices.len())
    }

    /// Take other vertices; only blocks in which something changed are redone. Returns the range
    /// of vertices that changed, or `None` if their number did.
    pub(super) fn update(&mut self, vertices: &[DVec3], closed: bool) -> Option<Range<usize>> {
        let planar = vertices.iter().all(|vertex| vertex.z == 0.0);
        let is_as_before = (self.closed, self.planar) == (closed, planar);
        if self.vertices.len() != vertices.len() || !is_as_before {
            self.vertices.clear();
            self.vertices.extend_from_slice(vertices);
            self.closed = closed;
            self.planar = planar;
            self.blocks.clear();
            let blocks = vertices.len().div_ceil(BLOCK);
            self.blocks.resize_with(blocks, Block::default);
            return None;
        }
        let Some(changed) = changed_range(&self.vertices, vertices) else {
            return Some(0..0);
        };
        self.replace(changed.start, &vertices[changed.clone()]);
        Some(changed)
    }

    /// Overwrite some vertices from number `first` on.
    pub(super) fn replace(&mut self, first: usize, vertices: &[DVec3]) {
        let changed = first..first + vertices.len();
        self.vertices[changed.clone()].copy_from_slice(vertices);
        let planar = self.vertices.iter().all(|vertex| vertex.z == 0.0);
        if planar != self.planar {
            self.planar = planar;
            self.blocks.iter_mut().for_each(|it| *it = Block::default());
            return;
        }
        // A torsion angle reaches one vertex back and two on; a leg and a turning angle less far.
        let count = self.vertices.len();
        let last = self.blocks.len() - 1;
        let low = changed.start.saturating_sub(2) / BLOCK;
        let high = ((changed.end + 1).min(count) / BLOCK).min(last);
        for index in low..=high {
            self.blocks[index] = Block::default();
        }
        if self.closed {
            for index in [0, count.saturating_sub(2) / BLOCK, last] {
                self.blocks[index] = Block::default();
            }
        }
    }

    /// Collect the figures of the whole polygon.
    pub fn figures(&self) -> ChainFigures {
        let blocks = (0..self.blocks.len()).map(|index| self.block_figures(index));
        blocks.fold(ChainFigures::default(), |all, own| ChainFigures {
            legs: union(all.legs, own.legs),
            turns: union(all.turns, own.turns),
        })
    }

    /// List the discrete curvature at the vertices, with their numbers; where there are more than
    /// a plot has bins, only the greatest in magnitude of each run of neighbours.
    pub(super) fn extreme_curvatures(&self) -> impl Iterator<Item = (usize, f64)> {
        let blocks = self.blocks.iter().enumerate();
        let known = blocks
            .flat_map(|(index, block)| block.extremes.get_or_init(|| self.block_extremes(index)));
        known.copied()
    }

    /// Append the discrete curvature at the vertices, with their numbers, over the length of the legs
    /// from the first vertex on; thinned out as for a plot.
    pub fn append_curvatures_by_length(&self, out: &mut Vec<(usize, DVec2)>) {
        let (mut vertex, mut length) = (0, 0.0);
        for (index, curvature) in self.extreme_curvatures() {
            let legs = (vertex..index).filter_map(|leg| self.leg(leg));
            length += legs.sum::<f64>();
            vertex = index;
            out.push((index, DVec2::new(length, curvature)));
        }
    }

    /// Append a sequence of the flow over the vertices' numbers, thinned so that its extrema are
    /// kept; what belongs to a leg stands at the vertex where it begins, angles are in radians.
    /// Where there is no number there is a gap, a NaN point.
    pub fn append_flow(&self, flow: Flow, out: &mut Vec<DVec2>) {
        for (index, block) in self.blocks.iter().enumerate() {
            let series = || self.binned(index, |vertex| self.flow(flow, vertex));
            out.extend_from_slice(block.flows[flow as usize].get_or_init(series));
        }
    }

    /// A number of the flow; `None` at the ends of an open polygon.
    pub fn flow(&self, flow: Flow, vertex: usize) -> Option<f64> {
        match flow {
            Flow::Legs => self.leg(vertex),
            Flow::Turns => self.turn(vertex),
            Flow::Curvatures => self.curvature(vertex),
            Flow::TorsionAngles => self.torsion_angle(vertex),
        }
    }

    /// The number of neighbours that share a bin: a power of two, so that blocks hold whole bins.
    fn run(&self) -> usize {
        self.vertices
            .len()
            .div_ceil(BINS as usize)
            .next_power_of_two()
            .min(BLOCK)
    }

    fn binned(&self, index: usize, value: impl Fn(usize) -> Option<f64>) -> Vec<DVec2> {
        let mut points = Vec::new();
        let mut bins = Bins::new(self.run() as f64);
        for vertex in self.block_vertices(index) {
            if let Some(value) = value(vertex) {
                let value = if value.is_finite() { value } else { f64::NAN };
                bins.add(DVec2::new(vertex as f64, value), &mut points);
            }
        }
        bins.finish(&mut points);
        points
    }

    fn block_extremes(&self, index: usize) -> Vec<(usize, f64)> {
        let (range, run) = (self.block_vertices(index), self.run());
        let curvature = |i: usize| Some((i, self.curvature(i)?));
        let runs = range
            .clone()
            .step_by(run)
            .map(|first| first..(first + run).min(range.end));
        runs.filter_map(|run| {
            let values = run
                .filter_map(curvature)
                .filter(|(_, value)| value.is_finite());
            values.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        })
        .collect()
    }

    /// The vertex with this number; beyond the last it wraps if the polygon is closed.
    pub fn get(&self, index: usize) -> Option<DVec3> {
        let count = self.vertices.len();
        let index = if self.closed { index % count } else { index };
        self.vertices.get(index).copied()
    }

    /// The length of the leg from vertex `index` to the next.
    pub fn leg(&self, index: usize) -> Option<f64> {
        Some(self.get(index)?.distance(self.get(index + 1)?))
    }

    /// The turning angle at vertex `index`, in radians.
    pub fn turn(&self, index: usize) -> Option<f64> {
        self.corner(index)
            .map(|[before, corner, after]| turning_angle(before, corner, after, self.planar))
    }

    /// The discrete curvature at vertex `index`.
    fn curvature(&self, index: usize) -> Option<f64> {
        let [before, corner, after] = self.corner(index)?;
        Some(discrete_curvature(before, corner, after, self.planar))
    }

    /// The torsion angle along the leg from vertex `index` to the next, in radians.
    fn torsion_angle(&self, index: usize) -> Option<f64> {
        let [before, start, end] = self.corner(index)?;
        Some(torsion_angle(before, start, end, self.get(index + 2)?))
    }

    /// The vertex with its two neighbours.
    pub fn corner(&self, index: usize) -> Option<[DVec3; 3]> {
        let count = self.vertices.len();
        let before = match index.checked_sub(1) {
            Some(before) => before,
            None if self.closed => count.checked_sub(1)?,
            None => return None,
        };
        Some([self.get(before)?, self.get(index)?, self.get(index + 1)?])
    }

    fn block_figures(&self, index: usize) -> ChainFigures {
        *self.blocks[index].figures.get_or_init(|| ChainFigures {
            legs: Span::of(self.block_vertices(index).filter_map(|i| self.leg(i))),
            turns: Span::of(self.block_vertices(index).filter_map(|i| self.turn(i))),
        })
    }
}

fn union(a: Option<Span>, b: Option<Span>) -> Option<Span> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        (a, b) => a.or(b),
    }
}

/// Find the smallest range that holds every difference of two slices of one length.
pub(super) fn changed_range<T: PartialEq>(old: &[T], new: &[T]) -> Option<Range<usize>> {
    let mut pairs = old.iter().zip(new);
    let first = pairs.position(|(a, b)| a != b)?;
    let behind = old.iter().zip(new).rev();
    let equal = behind.take_while(|(a, b)| a == b).count();
    Some(first..new.len() - equal)
}
