//! A polygon as it is drawn: its legs and the handles at its vertices.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::orientation::Orientation;
use super::outline::{Bounds, Outline, OutlineKey, ViewBox};
use super::plot_series::Bins;
use crate::geometry::Range as Span;
use crate::geometry::polygon_figures::{discrete_curvature, turning_angle};

/// Vertices in one block.
const BLOCK: usize = 64;

/// Handles closer together than this, in screen points, are thinned out.
const HANDLE_SPACING: f64 = 7.0;

/// Hold a polygon's vertices and, block by block, what is drawn of them.
#[derive(Debug, Default)]
pub struct VertexChain {
    vertices: Vec<DVec3>,
    closed: bool,
    orientation: Orientation,
    blocks: Vec<Block>,
}

#[derive(Clone, Debug, Default)]
struct Block {
    legs: Outline,
    handles: Handles,
    figures: Option<BlockFigures>,
    extremes: Option<Vec<(usize, f64)>>,
    leg_series: Option<Vec<DVec2>>,
    turn_series: Option<Vec<DVec2>>,
}

#[derive(Clone, Debug, Default)]
struct Handles {
    level: Option<i32>,
    indices: Vec<usize>,
}

#[derive(Clone, Copy, Debug)]
struct BlockFigures {
    legs: Option<Span>,
    turns: Option<Span>,
    bounds: Bounds,
}

/// The smallest and largest leg and turning angle of a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainFigures {
    /// The legs' lengths; `None` for fewer than two vertices.
    pub legs: Option<Span>,
    /// The turning angles in radians; `None` for fewer than three vertices.
    pub turns: Option<Span>,
    /// The box around the vertices, as they are seen.
    pub bounds: Bounds,
}

impl VertexChain {
    /// The vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Choose from where the polygon is seen.
    pub(super) fn set_orientation(&mut self, orientation: Orientation) {
        if self.orientation != orientation {
            self.orientation = orientation;
            self.blocks.fill(Block::default());
        }
    }

    /// Take other vertices; only blocks in which something changed are redone. Returns the range
    /// of vertices that changed, or `None` if their number did.
    pub(super) fn update(&mut self, vertices: &[DVec3], closed: bool) -> Option<Range<usize>> {
        if self.vertices.len() != vertices.len() || self.closed != closed {
            self.vertices.clear();
            self.vertices.extend_from_slice(vertices);
            self.closed = closed;
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
        // A leg reaches one vertex on and a turning angle one to either side.
        let count = self.vertices.len();
        let low = changed.start.saturating_sub(2) / BLOCK;
        let high = ((changed.end + 1).min(count) / BLOCK).min(self.blocks.len() - 1);
        let last = self.blocks.len() - 1;
        for index in low..=high {
            self.blocks[index] = Block::default();
        }
        if self.closed {
            self.blocks[0] = Block::default();
            self.blocks[last] = Block::default();
        }
    }

    /// Append what is visible of the legs.
    pub fn append_legs(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let key = OutlineKey {
            level: Some(view.level()),
            shape: 0,
        };
        let (count, eye) = (self.vertices.len(), self.orientation);
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let first = index * BLOCK;
            // One vertex more than the block has, so that neighbouring blocks join.
            let end = (first + BLOCK + 1).min(count);
            let closing = self.closed && end == count && first + BLOCK >= count;
            let vertices = &self.vertices;
            block.legs.refresh(key, || {
                let wrap = closing.then(|| eye.flatten(vertices[0]));
                let own = vertices[first..end].iter();
                let own = own.map(move |vertex| eye.flatten(*vertex));
                own.chain(wrap)
            });
            block.legs.append(view, out);
        }
    }

    /// Append the numbers of the vertices whose handles are drawn: all, unless they crowd.
    pub fn append_handles(&mut self, view: &ViewBox, out: &mut Vec<usize>) {
        let view = view.grown(HANDLE_SPACING * view.pixel);
        let level = view.level();
        let spacing = HANDLE_SPACING * 2f64.powi(level + 1);
        let eye = self.orientation;
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let first = index * BLOCK;
            let end = (first + BLOCK).min(self.vertices.len());
            block
                .handles
                .refresh(level, spacing, &eye, &self.vertices, first..end);
            let visible = |index: &usize| {
                let at = eye.flatten(self.vertices[*index]);
                at.cmpge(view.low).all() && at.cmple(view.high).all()
            };
            out.extend(block.handles.indices.iter().copied().filter(visible));
        }
    }

    /// Collect the figures of the whole polygon.
    pub fn figures(&mut self) -> ChainFigures {
        let mut all = ChainFigures {
            legs: None,
            turns: None,
            bounds: Bounds::EMPTY,
        };
        for index in 0..self.blocks.len() {
            let figures = self.block_figures(index);
            all.legs = union(all.legs, figures.legs);
            all.turns = union(all.turns, figures.turns);
            all.bounds.unite(&figures.bounds);
        }
        all
    }

    /// Append the discrete curvature at the vertices, with their numbers; where there are more
    /// than `bins` vertices, only the greatest in magnitude of each run of neighbours.
    pub(super) fn append_extreme_curvatures(&mut self, bins: usize, out: &mut Vec<(usize, f64)>) {
        let run = self.run(bins);
        for index in 0..self.blocks.len() {
            let known = self.blocks[index].extremes.take();
            let extremes = known.unwrap_or_else(|| self.block_extremes(index, run));
            out.extend_from_slice(&extremes);
            self.blocks[index].extremes = Some(extremes);
        }
    }

    /// Append the lengths of the legs over the number of the vertex where each begins, thinned to
    /// about `bins` bins with their extrema kept.
    pub(super) fn append_leg_series(&mut self, bins: usize, out: &mut Vec<DVec2>) {
        let run = self.run(bins);
        for index in 0..self.blocks.len() {
            let known = self.blocks[index].leg_series.take();
            let series = known.unwrap_or_else(|| self.binned(index, run, |i| self.leg(i)));
            out.extend_from_slice(&series);
            self.blocks[index].leg_series = Some(series);
        }
    }

    /// Append the turning angles in radians over the numbers of their vertices, thinned as
    /// [`VertexChain::append_leg_series`] does.
    pub(super) fn append_turn_series(&mut self, bins: usize, out: &mut Vec<DVec2>) {
        let run = self.run(bins);
        for index in 0..self.blocks.len() {
            let known = self.blocks[index].turn_series.take();
            let series = known.unwrap_or_else(|| self.binned(index, run, |i| self.turn(i)));
            out.extend_from_slice(&series);
            self.blocks[index].turn_series = Some(series);
        }
    }

    /// The number of neighbours that share a bin: a power of two, so that blocks hold whole bins.
    fn run(&self, bins: usize) -> usize {
        self.vertices
            .len()
            .div_ceil(bins)
            .next_power_of_two()
            .min(BLOCK)
    }

    fn binned(&self, index: usize, run: usize, value: impl Fn(usize) -> Option<f64>) -> Vec<DVec2> {
        let mut points = Vec::new();
        let mut bins = Bins::new(run as f64);
        for vertex in index * BLOCK..((index + 1) * BLOCK).min(self.vertices.len()) {
            if let Some(value) = value(vertex) {
                bins.add(DVec2::new(vertex as f64, value), &mut points);
            }
        }
        bins.finish(&mut points);
        points
    }

    fn block_extremes(&self, index: usize, run: usize) -> Vec<(usize, f64)> {
        let range = index * BLOCK..((index + 1) * BLOCK).min(self.vertices.len());
        let curvature = |i: usize| {
            let [before, corner, after] = self.corner(i)?;
            Some((i, discrete_curvature(before, corner, after)))
        };
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
            .map(|[before, corner, after]| turning_angle(before, corner, after))
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

    fn block_figures(&mut self, index: usize) -> BlockFigures {
        if let Some(figures) = self.blocks[index].figures {
            return figures;
        }
        let range = index * BLOCK..((index + 1) * BLOCK).min(self.vertices.len());
        let mut bounds = Bounds::EMPTY;
        for vertex in &self.vertices[range.clone()] {
            bounds.add(self.orientation.flatten(*vertex));
        }
        let figures = BlockFigures {
            legs: Span::of(range.clone().filter_map(|i| self.leg(i))),
            turns: Span::of(range.filter_map(|i| self.turn(i))),
            bounds,
        };
        self.blocks[index].figures = Some(figures);
        figures
    }
}

impl Handles {
    fn refresh(
        &mut self,
        level: i32,
        spacing: f64,
        eye: &Orientation,
        vertices: &[DVec3],
        range: Range<usize>,
    ) {
        if self.level == Some(level) {
            return;
        }
        self.level = Some(level);
        self.indices.clear();
        let mut kept: Option<DVec2> = None;
        // Vertices in a handful of legs are all kept: only crowds are thinned.
        let crowded = 0.5 * spacing;
        for index in range {
            let at = eye.flatten(vertices[index]);
            if kept.is_none_or(|kept| kept.distance(at) >= crowded) {
                self.indices.push(index);
                kept = Some(at);
            }
        }
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
