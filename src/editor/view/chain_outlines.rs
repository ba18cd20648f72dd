//! A polygon as it is drawn: its legs and the handles at its vertices.

use glam::DVec2;

use crate::analysis::{Revision, VertexChain};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, Outline, OutlineKey, ViewBox};

/// Handles closer together than this, in screen points, are thinned out.
const HANDLE_SPACING: f64 = 7.0;

/// Hold, block by block, what is drawn of a polygon, seen from somewhere.
#[derive(Debug, Default)]
pub struct ChainOutlines {
    orientation: Orientation,
    blocks: Vec<Block>,
}

#[derive(Clone, Debug)]
struct Block {
    /// What the block was made of.
    revision: Revision,
    legs: Outline,
    handles: Handles,
    bounds: Bounds,
}

#[derive(Clone, Debug, Default)]
struct Handles {
    level: Option<i32>,
    indices: Vec<usize>,
}

impl ChainOutlines {
    /// Choose from where the polygon is seen.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        if self.orientation != orientation {
            self.orientation = orientation;
            self.blocks.clear();
        }
    }

    /// Forget what was made of blocks that have changed. All else that asks about a polygon comes
    /// after this.
    pub fn update(&mut self, chain: &VertexChain) {
        let revisions = chain.revisions();
        self.blocks.truncate(revisions.len());
        for (index, revision) in revisions.enumerate() {
            let known = self.blocks.get(index).map(|block| block.revision);
            if known == Some(revision) {
                continue;
            }
            let mut bounds = Bounds::EMPTY;
            for vertex in &chain.vertices()[chain.block_vertices(index)] {
                bounds.add(self.orientation.flatten(*vertex));
            }
            let block = Block {
                revision,
                legs: Outline::default(),
                handles: Handles::default(),
                bounds,
            };
            match self.blocks.get_mut(index) {
                Some(old) => *old = block,
                None => self.blocks.push(block),
            }
        }
    }

    /// Append what is visible of the legs.
    pub fn append_legs(&mut self, chain: &VertexChain, view: &ViewBox, out: &mut Vec<DVec2>) {
        let key = OutlineKey {
            level: Some(view.level()),
            shape: 0,
        };
        let (vertices, eye) = (chain.vertices(), self.orientation);
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let own = chain.block_vertices(index);
            // One vertex more than the block has, so that neighbouring blocks join.
            let end = (own.end + 1).min(vertices.len());
            let closing = chain.is_closed() && own.end == vertices.len();
            block.legs.refresh(key, || {
                let wrap = closing.then(|| eye.flatten(vertices[0]));
                let own = vertices[own.start..end].iter();
                let own = own.map(move |vertex| eye.flatten(*vertex));
                own.chain(wrap)
            });
            block.legs.append(view, out);
        }
    }

    /// Append the numbers of the vertices whose handles are drawn: all, unless they crowd.
    pub fn append_handles(&mut self, chain: &VertexChain, view: &ViewBox, out: &mut Vec<usize>) {
        let view = view.grown(HANDLE_SPACING * view.pixel);
        let level = view.level();
        let eye = self.orientation;
        for (index, block) in self.blocks.iter_mut().enumerate() {
            block.handles.refresh(level, index, &eye, chain);
            let visible = |index: &usize| {
                let at = eye.flatten(chain.vertices()[*index]);
                at.cmpge(view.low).all() && at.cmple(view.high).all()
            };
            out.extend(block.handles.indices.iter().copied().filter(visible));
        }
    }

    /// The box around the vertices, as they are seen.
    pub fn bounds(&self) -> Bounds {
        let mut all = Bounds::EMPTY;
        self.blocks
            .iter()
            .for_each(|block| all.unite(&block.bounds));
        all
    }
}

impl Handles {
    fn refresh(&mut self, level: i32, block: usize, eye: &Orientation, chain: &VertexChain) {
        if self.level == Some(level) {
            return;
        }
        self.level = Some(level);
        self.indices.clear();
        let mut kept: Option<DVec2> = None;
        // Vertices in a handful of legs are all kept: only crowds are thinned.
        let crowded = 0.5 * HANDLE_SPACING * 2f64.powi(level + 1);
        for index in chain.block_vertices(block) {
            let at = eye.flatten(chain.vertices()[index]);
            if kept.is_none_or(|kept| kept.distance(at) >= crowded) {
                self.indices.push(index);
                kept = Some(at);
            }
        }
    }
}
