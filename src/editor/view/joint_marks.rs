//! The joints of curves on the canvas.

use std::collections::BTreeSet;

use crate::analysis::{CurveJoint, Joints};
use crate::document::CurveId;
use crate::editor::view::layers::Layer;
use crate::editor::view::scene::Mark;
use crate::editor::view::sight::Sight;

/// The most joints that are named at once: beyond it the names would cover the curves.
const NAMED: usize = 24;

impl<'a> Sight<'a> {
    /// The joints of the document.
    pub fn joints(self) -> &'a Joints {
        &self.view.joints
    }

    /// The joints that panels list, each with its number: those of the selected items, all where none is selected, or
    /// only references that have none.
    pub fn listed_joints(self) -> impl Iterator<Item = (usize, &'a CurveJoint)> {
        let items = self.shown.selection.items().into_iter();
        let joints = self.joints().all();
        let meets = |id: CurveId| {
            joints
                .iter()
                .any(|it| it.ends.iter().any(|end| end.0 == id))
        };
        let counts = |id: &CurveId| self.document().curve(*id).is_some() || meets(*id);
        let counted: BTreeSet<CurveId> = items.filter(counts).collect();
        let is_taken = move |id| counted.is_empty() || counted.contains(&id);
        let all = joints.iter().enumerate();
        all.filter(move |(_, joint)| joint.ends.iter().any(|(id, _)| is_taken(*id)))
    }

    /// Mark the joints in sight; those that panels list are named.
    pub(super) fn joint_marks(self) -> Vec<Mark> {
        if !self.shown.layers.shows(Layer::Joints) {
            return Vec::new();
        }
        let view = self.viewport().view_box();
        let listed: Vec<usize> = self.listed_joints().map(|(index, _)| index).collect();
        let hovered = self.view.hovered.joint;
        let is_named = |index: usize| match hovered {
            Some(hovered) => hovered == index,
            None => listed.len() <= NAMED && listed.binary_search(&index).is_ok(),
        };
        let all = self.joints().all().iter().enumerate();
        let marks = all.filter_map(|(index, joint)| {
            let at = self.viewport().flatten(joint.point);
            view.holds(at).then_some(Mark::Joint {
                at,
                name: is_named(index).then(|| joint.name()),
            })
        });
        marks.collect()
    }
}
