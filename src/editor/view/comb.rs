//! The curvature comb: teeth that stand on the curve, as long as it is curved there.

use std::ops::RangeInclusive;

use glam::DVec2;

use crate::analysis::Sample;
use crate::document::CurveId;
use crate::editor::selection::Selection;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, ViewBox};

/// How a curvature comb is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CombSettings {
    /// The length of a tooth for curvature 1, in units of the model squared.
    pub scale: f64,
    /// Teeth a segment.
    pub density: usize,
}

impl CombSettings {
    /// How many teeth a segment may have.
    pub const DENSITY: RangeInclusive<usize> = 1..=64;
}

/// Which curves and references have a comb; all combs have one scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CombsOf {
    /// The active one.
    #[default]
    Active,
    /// Those that are selected, and the active one.
    Selected,
    /// All that are visible.
    Visible,
}

impl CombsOf {
    /// Every choice, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Active, Self::Selected, Self::Visible];

    /// The name beside the scale of the comb.
    pub fn name(self) -> &'static str {
        match self {
            Self::Active => "active",
            Self::Selected => "selected",
            Self::Visible => "visible",
        }
    }

    /// What menus and the palette call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Active => "Comb of the active curve",
            Self::Selected => "Combs of selected curves",
            Self::Visible => "Combs of visible curves",
        }
    }

    /// Whether a curve or a reference that is visible has a comb.
    pub fn takes(self, id: CurveId, selection: &Selection) -> bool {
        match self {
            Self::Active => selection.active() == Some(id),
            Self::Selected => selection.active() == Some(id) || selection.has_item(id),
            Self::Visible => true,
        }
    }
}

impl Default for CombSettings {
    fn default() -> Self {
        Self {
            scale: 1.0,
            density: 16,
        }
    }
}

/// The teeth of one block's comb: where they stand, and their tips.
#[derive(Debug, Default)]
pub struct Teeth {
    key: Option<(i32, u64, usize)>,
    teeth: Vec<[DVec2; 2]>,
    bounds: Option<Bounds>,
}

impl Teeth {
    /// Bring the teeth up to date if `key` (level, scale, density) has changed since.
    pub fn refresh<'a, I: Iterator<Item = &'a Sample>>(
        &mut self,
        key: (i32, u64, usize),
        spacing: f64,
        view: &Orientation,
        samples: impl FnOnce() -> I,
    ) {
        if self.key == Some(key) {
            return;
        }
        self.key = Some(key);
        self.teeth.clear();
        let scale = f64::from_bits(key.1);
        let mut bounds = Bounds::EMPTY;
        let mut kept: Option<DVec2> = None;
        for sample in samples() {
            let (foot, tip) = (
                view.flatten(sample.point),
                view.flatten(sample.comb_tip(scale)),
            );
            if !tip.is_finite() || kept.is_some_and(|kept| kept.distance(foot) < spacing) {
                continue;
            }
            kept = Some(foot);
            bounds.add(foot);
            bounds.add(tip);
            self.teeth.push([foot, tip]);
        }
        self.bounds = Some(bounds);
    }

    /// Append the teeth if any of them may be visible.
    pub fn append(&self, view: &ViewBox, out: &mut Vec<[DVec2; 2]>) {
        if self.bounds.is_some_and(|bounds| bounds.meets(view)) {
            out.extend_from_slice(&self.teeth);
        }
    }
}
