//! A polygon as it is drawn: its legs and the discs at its vertices.

use glam::DVec2;

use crate::analysis::VertexChain;
use crate::editor::view::blocks::Blocks;
use crate::editor::view::density::{self, SeenChain};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, ViewBox};
use crate::editor::view::scene::Legs;

/// Points closer together than this, in screen points, are thinned out.
const POINT_SPACING: f64 = 7.0;

/// The share of its strength at which a leg beyond the curve's ends is drawn.
const TAIL: f32 = 0.45;

/// Hold the outlines of a polygon in one orientation, block by block.
#[derive(Debug, Default)]
pub struct ChainOutlines {
    blocks: Blocks<Block>,
}

#[derive(Clone, Debug, Default)]
struct Block {
    points: ThinnedPoints,
    /// The box around the vertices and the legs that begin at them.
    bounds: Bounds,
    /// The longest of the legs that begin at the vertices, as it is seen.
    longest: f64,
}

#[derive(Clone, Debug, Default)]
struct ThinnedPoints {
    level: Option<i32>,
    indices: Vec<usize>,
}

impl ChainOutlines {
    /// Forget blocks that have changed. Call this before any other method after a change of the polygon or of the
    /// orientation.
    pub fn update(&mut self, chain: &VertexChain, eye: Orientation) {
        let seen = SeenChain { chain, eye };
        let revisions = chain.revisions();
        self.blocks
            .update(eye, revisions, |index| Block::new(index, &seen));
    }

    /// The vertices as they are seen.
    pub fn seen<'a>(&self, chain: &'a VertexChain) -> SeenChain<'a> {
        let eye = self.blocks.eye;
        SeenChain { chain, eye }
    }

    /// Append the visible legs. Where they crowd they fade, and so do so many at either end as `tail` says; legs with
    /// both ends on `covering` are left out.
    pub fn append_legs(
        &self,
        chain: &VertexChain,
        tail: usize,
        covering: Option<&SeenChain>,
        view: &ViewBox,
        out: &mut Legs,
    ) {
        let seen = self.seen(chain);
        let count = chain.vertices().len();
        let legs = if chain.is_closed() {
            count
        } else {
            count.saturating_sub(1)
        };
        let covers = |vertex: usize| {
            covering.is_some_and(|covering| seen.coincides(covering, vertex, 0, view.pixel))
        };
        for (index, (block, longest)) in self.blocks_with_longest().enumerate() {
            let longest = longest / view.pixel;
            if density::leg(longest) == 0.0 || !block.bounds.meets(view) {
                continue;
            }
            for from in chain.block_vertices(index).take_while(|from| *from < legs) {
                let is_tail = from < tail || from + tail >= legs;
                let share = if is_tail { TAIL } else { 1.0 };
                let strength = share * density::leg(seen.leg_spacing(from) / view.pixel);
                let ends = seen.place(from).zip(seen.place(from + 1));
                if let Some((start, end)) = ends
                    && !(covers(from) && covers(from + 1))
                {
                    out.add([start, end], strength);
                }
            }
        }
    }

    /// List the vertices whose discs are seen: number, place, and the share of a disc's full size. Where they
    /// crowd discs shrink, and vanish.
    pub fn append_discs(
        &self,
        chain: &VertexChain,
        view: &ViewBox,
        mut found: impl FnMut(usize, DVec2, f32),
    ) {
        let seen = self.seen(chain);
        for (index, (block, longest)) in self.blocks_with_longest().enumerate() {
            let longest = longest / view.pixel;
            if density::disc(longest) == 0.0 || !block.bounds.meets(view) {
                continue;
            }
            for vertex in chain.block_vertices(index) {
                let size = density::disc(seen.spacing(vertex) / view.pixel);
                let place = seen.place(vertex).filter(|at| view.holds(*at));
                if let Some(at) = place.filter(|_| size > 0.0) {
                    found(vertex, at, size);
                }
            }
        }
    }

    /// Append the numbers of the points of a list that are drawn: all, unless they crowd.
    pub fn append_points(&mut self, chain: &VertexChain, view: &ViewBox, out: &mut Vec<usize>) {
        let view = view.grown(POINT_SPACING * view.pixel);
        let level = view.level();
        let eye = self.blocks.eye;
        for (index, block) in self.blocks.iter_mut().enumerate() {
            block.points.refresh(level, index, &eye, chain);
            let visible = |index: &usize| view.holds(eye.flatten(chain.vertices()[*index]));
            out.extend(block.points.indices.iter().copied().filter(visible));
        }
    }

    /// The blocks, each with the longest leg of it and of those beside it: no spacing within the block is larger.
    fn blocks_with_longest(&self) -> impl Iterator<Item = (&Block, f64)> {
        let blocks = self.blocks.iter();
        let (count, longest) = (blocks.len(), blocks.map(|block| block.longest));
        let longest: Vec<f64> = longest.collect();
        self.blocks.iter().enumerate().map(move |(index, block)| {
            let beside = [(index + count - 1) % count, (index + 1) % count];
            let beside = beside.map(|index| longest[index]);
            (block, block.longest.max(beside[0]).max(beside[1]))
        })
    }

    /// The box around the vertices, as they are seen.
    pub fn bounds(&self) -> Bounds {
        let bounds = self.blocks.iter().map(|block| block.bounds);
        bounds.fold(Bounds::EMPTY, Bounds::united)
    }
}

impl Block {
    fn new(index: usize, seen: &SeenChain) -> Self {
        let mut bounds = Bounds::EMPTY;
        let mut longest = 0.0f64;
        for vertex in seen.chain.block_vertices(index) {
            let places = [vertex, vertex + 1].map(|vertex| seen.place(vertex));
            places.iter().flatten().for_each(|place| bounds.add(*place));
            if let [Some(from), Some(to)] = places {
                longest = longest.max(from.distance(to));
            }
        }
        Self {
            bounds,
            longest,
            ..Self::default()
        }
    }
}

impl ThinnedPoints {
    fn refresh(&mut self, level: i32, block: usize, eye: &Orientation, chain: &VertexChain) {
        if self.level == Some(level) {
            return;
        }
        self.level = Some(level);
        self.indices.clear();
        let mut kept: Option<DVec2> = None;
        // A handful of points is kept whole: only crowds are thinned.
        let crowded = 0.5 * POINT_SPACING * 2f64.powi(level + 1);
        for index in chain.block_vertices(block) {
            let at = eye.flatten(chain.vertices()[index]);
            if kept.is_none_or(|kept| kept.distance(at) >= crowded) {
                self.indices.push(index);
                kept = Some(at);
            }
        }
    }
}
