//! From insertions of parts into assemblies to the placements of every part.

use std::sync::Arc;

use super::styles::Style;
use crate::io::exchange::drawing::Affine;
use crate::io::exchange::remarks::Remarks;

/// How deep assemblies may be nested.
const DEEPEST: usize = 64;
/// How many placements a file may have in all: real assemblies have thousands.
const MOST: usize = 500_000;

/// One placement of a representation.
#[derive(Clone, Default)]
pub struct Placement<'a> {
    /// Where it is; none for identity.
    pub place: Option<Affine>,
    /// The product that was inserted.
    pub block: Option<Arc<str>>,
    /// What the inserted item says of the look.
    pub style: Style<'a>,
}

/// An insertion of one node into another.
pub struct Insertion<'a> {
    /// The node that is inserted.
    pub child: usize,
    /// The node that it is inserted into.
    pub parent: usize,
    /// The line of the entity that says so.
    pub line: u64,
    /// Where it is.
    pub placement: Placement<'a>,
}

/// Work the placements of all nodes out, from the outermost assemblies inwards.
pub fn expand<'a>(
    nodes: &[usize],
    insertions: &[Insertion<'a>],
    root: impl Fn(usize) -> Placement<'a>,
    remarks: &mut Remarks,
) -> Vec<Vec<Placement<'a>>> {
    let mut placements: Vec<Vec<Placement>> = vec![Vec::new(); nodes.len()];
    let order = Order::new(nodes, insertions);
    let most = order.most_each(remarks);
    for (node, is_root) in order.nodes.iter().copied() {
        let mut outer = placements
            .get_mut(node)
            .map(std::mem::take)
            .unwrap_or_default();
        if is_root {
            outer.push(root(node));
        }
        for insertion in order.within.get(node).into_iter().flatten() {
            if let Some(inner) = placements.get_mut(insertion.child) {
                let left = most.saturating_sub(inner.len());
                inner.extend(
                    outer
                        .iter()
                        .take(left)
                        .map(|outer| placed(outer, &insertion.placement)),
                );
            }
        }
        if let Some(own) = placements.get_mut(node) {
            *own = outer;
        }
    }
    for insertion in order.left_out {
        remarks.add_at(
            insertion.line,
            "assembly",
            "a part is nested more than 64 deep or within itself",
        );
        if let Some(own) = placements
            .get_mut(insertion.child)
            .filter(|own| own.is_empty())
        {
            own.push(root(insertion.child));
        }
    }
    placements
}

/// The nodes, assemblies before their parts.
struct Order<'a, 'i> {
    /// Each node, and whether it is a root.
    nodes: Vec<(usize, bool)>,
    /// The insertions into each node.
    within: Vec<Vec<&'i Insertion<'a>>>,
    /// What is inserted into itself, or too deep.
    left_out: Vec<&'i Insertion<'a>>,
}

impl<'a, 'i> Order<'a, 'i> {
    fn new(joined: &[usize], insertions: &'i [Insertion<'a>]) -> Self {
        let mut within: Vec<Vec<&Insertion>> = joined.iter().map(|_| Vec::new()).collect();
        let mut waiting = vec![0usize; joined.len()];
        for insertion in insertions {
            if let (Some(list), Some(count)) = (
                within.get_mut(insertion.parent),
                waiting.get_mut(insertion.child),
            ) {
                list.push(insertion);
                *count += 1;
            }
        }
        let is_root =
            |node: &usize| joined.get(*node) == Some(node) && waiting.get(*node) == Some(&0);
        let mut level: Vec<usize> = (0..joined.len()).filter(is_root).collect();
        let mut nodes: Vec<(usize, bool)> = level.iter().map(|node| (*node, true)).collect();
        for _ in 0..DEEPEST {
            let mut next = Vec::new();
            for insertion in level.iter().filter_map(|node| within.get(*node)).flatten() {
                if let Some(count) = waiting.get_mut(insertion.child) {
                    *count -= 1;
                    if *count == 0 {
                        next.push(insertion.child);
                    }
                }
            }
            nodes.extend(next.iter().map(|node| (*node, false)));
            level = next;
        }
        let waits = |it: &&Insertion| waiting.get(it.child).is_some_and(|count| *count > 0);
        let left_out = insertions.iter().filter(waits).collect();
        Self {
            nodes,
            within,
            left_out,
        }
    }

    /// Limit the placements of one node, if all would be too many together.
    fn most_each(&self, remarks: &mut Remarks) -> usize {
        let mut counts = vec![0usize; self.within.len()];
        let mut total = 0usize;
        for (node, is_root) in &self.nodes {
            let own = counts
                .get(*node)
                .copied()
                .unwrap_or(0)
                .saturating_add(usize::from(*is_root));
            total = total.saturating_add(own);
            for insertion in self.within.get(*node).into_iter().flatten() {
                if let Some(count) = counts.get_mut(insertion.child) {
                    *count = count.saturating_add(own);
                }
            }
        }
        if total <= MOST {
            return MOST;
        }
        let line = self
            .within
            .iter()
            .flatten()
            .map(|it| it.line)
            .next()
            .unwrap_or(0);
        remarks.add_at(
            line,
            "assembly",
            "it has more than 500000 parts; the rest is left out",
        );
        (MOST / self.nodes.len()).max(1)
    }
}

fn placed<'a>(outer: &Placement<'a>, inner: &Placement<'a>) -> Placement<'a> {
    Placement {
        place: match (&outer.place, &inner.place) {
            (Some(outer), Some(inner)) => Some(outer.of(inner)),
            (outer, inner) => (*outer).or(*inner),
        },
        block: inner.block.clone().or_else(|| outer.block.clone()),
        style: inner.style.within(outer.style),
    }
}
