//! How the panes of the canvas lie.

use glam::DVec2;

use crate::editor::view::named_view::NamedView;
use crate::editor::view::orientation::Orientation;

/// The distance between panes, in screen points.
const BETWEEN: f64 = 2.0;

/// How many panes the canvas has, and how they lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PaneLayout {
    /// One.
    #[default]
    One,
    /// Two side by side: the present view, and another one.
    Two,
    /// Four: from above, isometric, from the front and from the right, as drawings show them.
    Four,
}

impl PaneLayout {
    /// Every layout, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Four];

    /// What menus call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::One => "One pane",
            Self::Two => "Two panes",
            Self::Four => "Four panes",
        }
    }

    /// One sentence that says what it shows.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::One => "See the model from one side",
            Self::Two => "See the model from two sides at once; each pane pans and zooms alone",
            Self::Four => {
                "See top, front, right and isometric at once; each pane pans and zooms alone"
            }
        }
    }

    /// The columns and the rows of panes.
    fn grid(self) -> [usize; 2] {
        match self {
            Self::One => [1, 1],
            Self::Two => [2, 1],
            Self::Four => [2, 2],
        }
    }

    /// The upper left corners and the sizes of the panes on a canvas of a size, row by row.
    pub(super) fn boxes(self, canvas: DVec2) -> Vec<[DVec2; 2]> {
        let [columns, rows] = self.grid();
        let gaps = DVec2::new(columns as f64 - 1.0, rows as f64 - 1.0) * BETWEEN;
        let size = (canvas - gaps) / DVec2::new(columns as f64, rows as f64);
        let size = size.max(DVec2::ZERO);
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let corner = |(column, row): (usize, usize)| {
            DVec2::new(column as f64, row as f64) * (size + BETWEEN)
        };
        places.map(|place| [corner(place), size]).collect()
    }

    /// From where its panes see the model, where one pane sees it from `present`.
    pub(super) fn orientations(self, present: Orientation) -> Vec<Orientation> {
        let isometric = NamedView::Isometric.orientation();
        match self {
            Self::One => vec![present],
            Self::Two if present == isometric => vec![NamedView::Xy.orientation(), present],
            Self::Two => vec![present, isometric],
            Self::Four => {
                use NamedView::{Isometric, Xy, Xz, Yz};
                [Xy, Isometric, Xz, Yz].map(NamedView::orientation).into()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_fill_the_canvas_but_for_the_gaps() {
        let canvas = DVec2::new(1002.0, 702.0);
        for (layout, size) in [
            (PaneLayout::One, canvas),
            (PaneLayout::Two, DVec2::new(500.0, 702.0)),
            (PaneLayout::Four, DVec2::new(500.0, 350.0)),
        ] {
            let boxes = layout.boxes(canvas);
            assert!(boxes.iter().all(|it| it[1] == size), "{boxes:?}");
            let [corner, size] = boxes[boxes.len() - 1];
            assert_eq!(corner + size, canvas);
            assert_eq!(boxes.len(), layout.orientations(Orientation::XY).len());
        }
    }
}
