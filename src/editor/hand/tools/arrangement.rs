//! Alignments and even distances of several vertices, or of several curves and references.

use std::collections::BTreeMap;

use super::tool::Context;
use super::transformed::{Part, Transformed};
use crate::document::Edit;
use crate::editor::hand::drawing_plane::DrawingPlane;
use crate::geometry::references::ReferenceError;

/// How items are arranged along an axis of the plane that is drawn in. Those at the outside stay; of an alignment in the
/// middle, all move to the middle of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arrangement {
    /// Left sides on one line.
    AlignLeft,
    /// Middles on one upright line.
    AlignCentre,
    /// Right sides on one line.
    AlignRight,
    /// Upper sides on one line.
    AlignTop,
    /// Middles on one level line.
    AlignMiddle,
    /// Lower sides on one line.
    AlignBottom,
    /// Even gaps from left to right.
    DistributeAcross,
    /// Even gaps from bottom to top.
    DistributeUp,
}

impl Arrangement {
    /// All, as menus list them.
    pub const ALL: [Self; 8] = [
        Self::AlignLeft,
        Self::AlignCentre,
        Self::AlignRight,
        Self::AlignTop,
        Self::AlignMiddle,
        Self::AlignBottom,
        Self::DistributeAcross,
        Self::DistributeUp,
    ];

    /// The name in menus.
    pub fn label(self) -> &'static str {
        match self {
            Self::AlignLeft => "Align left",
            Self::AlignCentre => "Align centre",
            Self::AlignRight => "Align right",
            Self::AlignTop => "Align top",
            Self::AlignMiddle => "Align middle",
            Self::AlignBottom => "Align bottom",
            Self::DistributeAcross => "Distribute across",
            Self::DistributeUp => "Distribute upwards",
        }
    }

    /// One sentence that says what it does.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::AlignLeft => {
                "Move the selected vertices, or curves, as far left as the leftmost one"
            }
            Self::AlignCentre => "Move the middles of what is selected onto one upright line",
            Self::AlignRight => {
                "Move the selected vertices, or curves, as far right as the rightmost one"
            }
            Self::AlignTop => "Move the selected vertices, or curves, as high as the highest one",
            Self::AlignMiddle => "Move the middles of what is selected onto one level line",
            Self::AlignBottom => "Move the selected vertices, or curves, as low as the lowest one",
            Self::DistributeAcross => "Make the gaps even from left to right; the outer two stay",
            Self::DistributeUp => "Make the gaps even from bottom to top; the outer two stay",
        }
    }

    /// The least number of items.
    pub fn least(self) -> usize {
        match self {
            Self::DistributeAcross | Self::DistributeUp => 3,
            _ => 2,
        }
    }

    /// The edits that arrange the items.
    ///
    /// # Errors
    /// [`ReferenceError`] if a reference cannot be placed so.
    pub fn edits(
        self,
        items: &Transformed,
        context: &Context,
    ) -> Result<Vec<Edit>, ReferenceError> {
        let plane = DrawingPlane::of(context.viewport);
        let axis = self.axis();
        let parts = items.parts();
        let extents = items.extents(plane.axis(axis), context);
        let places = self.places(&extents);
        let moves = extents.iter().zip(places);
        let moves = moves.map(|([low, _], place)| (*low, place));
        let moves: BTreeMap<Part, (f64, f64)> = parts.into_iter().zip(moves).collect();
        items.placed_by(|part, at| {
            let Some((low, place)) = moves.get(&part) else {
                return at;
            };
            let mut coordinates = plane.flatten(at);
            let along = coordinates[axis];
            // A vertex is there to the bit.
            coordinates[axis] = if along == *low {
                *place
            } else {
                along + (*place - *low)
            };
            plane.across(at) + plane.lift(coordinates)
        })
    }

    /// The axis of the plane: 0 or 1.
    fn axis(self) -> usize {
        match self {
            Self::AlignLeft | Self::AlignCentre | Self::AlignRight | Self::DistributeAcross => 0,
            _ => 1,
        }
    }

    /// Where the lower sides of items with these extents come to.
    fn places(self, extents: &[[f64; 2]]) -> Vec<f64> {
        let low = extents.iter().map(|it| it[0]).fold(f64::INFINITY, f64::min);
        let high = extents
            .iter()
            .map(|it| it[1])
            .fold(f64::NEG_INFINITY, f64::max);
        let aligned = |share: f64| {
            let line = low + share * (high - low);
            let places = extents
                .iter()
                .map(|[low, high]| line - share * (high - low));
            places.collect()
        };
        match self {
            Self::AlignLeft | Self::AlignBottom => aligned(0.0),
            Self::AlignCentre | Self::AlignMiddle => aligned(0.5),
            Self::AlignRight | Self::AlignTop => aligned(1.0),
            Self::DistributeAcross | Self::DistributeUp => even(extents),
        }
    }
}

/// The lower sides at even gaps: in the order of the middles, the outer ones stay.
fn even(extents: &[[f64; 2]]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..extents.len()).collect();
    let middle = |index: usize| extents[index][0] + extents[index][1];
    order.sort_by(|a, b| middle(*a).total_cmp(&middle(*b)));
    let mut places: Vec<f64> = extents.iter().map(|[low, _]| *low).collect();
    let [Some(first), Some(last)] = [order.first(), order.last()] else {
        return places;
    };
    let inner: Vec<usize> = order
        .iter()
        .copied()
        .filter(|it| it != first && it != last)
        .collect();
    let width = |index: &usize| extents[*index][1] - extents[*index][0];
    let [from, to] = [extents[*first][1], extents[*last][0]];
    let filled: f64 = inner.iter().map(width).sum();
    let gap = (to - from - filled) / (inner.len() + 1) as f64;
    let mut at = from;
    for index in inner {
        places[index] = at + gap;
        at = places[index] + width(&index);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_even_between_the_outer_ones() {
        let extents = [[10.0, 12.0], [0.0, 1.0], [3.0, 6.0]];
        let places = Arrangement::DistributeAcross.places(&extents);
        // Gaps of (10 − 1 − 3) / 2 = 3.
        assert_eq!(places, [10.0, 0.0, 4.0]);
    }

    #[test]
    fn sides_and_middles_lie_on_one_line() {
        let extents = [[10.0, 12.0], [0.0, 1.0], [3.0, 6.0]];
        assert_eq!(Arrangement::AlignLeft.places(&extents), [0.0; 3]);
        assert_eq!(Arrangement::AlignTop.places(&extents), [10.0, 11.0, 9.0]);
        assert_eq!(Arrangement::AlignCentre.places(&extents), [5.0, 5.5, 4.5]);
    }
}
