//! What has become of the items of a drawing since it was read, to be written into the text of its file.

use std::collections::HashMap;

use glam::DVec3;

use super::drawing::{Affine, Item, Shape};
use super::pieces::ROUNDING;
use super::splines::spline;
use super::writing::Manner;
use crate::io::loss::LossReport;

/// Writes changes into the bytes of a file, or says why that is not possible.
type Rewrite = fn(&[u8], &Changes, &mut LossReport) -> Result<Vec<u8>, String>;

/// How changes are written into files of a format.
pub(in crate::io) struct Rewriter {
    /// What the format makes of curves and references.
    pub(in crate::io) manner: Manner,
    /// Write changes into the bytes of a file, and leave everything else as it was; the reason where that is not
    /// possible.
    pub(in crate::io) write: Rewrite,
}

/// The changes of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// The items that have changed, by their places in the drawing.
    pub items: HashMap<usize, ItemChange>,
    /// The items that are new.
    pub added: Vec<Item>,
}

/// What has become of an item.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ItemChange {
    /// Its name, for what is told.
    pub name: String,
    /// For each of its shapes what stands for it now; `None` for a shape that has not changed.
    pub shapes: Vec<Option<Vec<Shape>>>,
}

impl Changes {
    /// Whether nothing has changed.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty() && self.added.is_empty()
    }
}

impl ItemChange {
    /// Put what stands for the shapes of the item, placed, in their places. Ends that stay but for rounding are those
    /// of the file, so that pieces go on to meet.
    pub(super) fn applied(&self, shapes: Vec<Shape>, place: &Affine) -> Vec<Shape> {
        let shapes = shapes.into_iter().enumerate();
        let changed = shapes.flat_map(|(index, shape)| match self.shapes.get(index) {
            Some(Some(shapes)) => {
                let shapes = shapes.iter().cloned();
                let mut shapes: Vec<Shape> = shapes.map(|it| it.placed(place)).collect();
                keep_ends(&mut shapes, &shape);
                shapes
            }
            _ => vec![shape],
        });
        changed.collect()
    }
}

/// Give a chain of shapes the ends of the one that it stands for, where they are off by rounding alone.
fn keep_ends(shapes: &mut [Shape], before: &Shape) {
    let Some(old) = spline(before).filter(|_| !is_closed(before)) else {
        return;
    };
    let size = old.points.iter().map(|it| it.abs().max_element());
    let rounding = ROUNDING * size.fold(0.0, f64::max);
    let keep = |new: Option<&mut DVec3>, old: Option<&DVec3>| {
        if let (Some(new), Some(old)) = (new, old)
            && new.distance(*old) <= rounding
        {
            *new = *old;
        }
    };
    let first = shapes.first_mut().and_then(corners);
    keep(first.and_then(<[_]>::first_mut), old.points.first());
    let last = shapes.last_mut().and_then(corners);
    keep(last.and_then(<[_]>::last_mut), old.points.last());
}

fn is_closed(shape: &Shape) -> bool {
    matches!(shape, Shape::Polyline { closed: true, .. })
}

/// The points of an open shape, of which the first and the last are its ends.
fn corners(shape: &mut Shape) -> Option<&mut [DVec3]> {
    match shape {
        Shape::Nurbs(nurbs) => Some(&mut nurbs.points),
        Shape::Polyline { points, closed } => Some(&mut points[..]).filter(|_| !*closed),
        Shape::Conic(_) | Shape::Point(_) => None,
    }
}
