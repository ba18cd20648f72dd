//! One curve of a document.

use super::error::EditError;
use super::extras::Extras;
use super::group::Group;
use super::locked_vertices::LockedVertices;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, FloatPolygon, PolygonError, Symmetry};

/// The identity of a curve or of a reference within its document; it survives every edit. Both are counted together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CurveId(pub(super) u64);

impl CurveId {
    /// How many curves and references the document had before, those that are deleted included.
    pub fn number(self) -> u64 {
        self.0
    }
}

/// A colour: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

/// The targets of a curve's two ends, where they are set.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct EndTargets {
    /// The target of the start.
    pub start: Option<EndTarget>,
    /// The target of the end.
    pub finish: Option<EndTarget>,
}

impl EndTargets {
    /// The target of one end.
    pub fn get(&self, end: End) -> Option<EndTarget> {
        match end {
            End::Start => self.start,
            End::Finish => self.finish,
        }
    }

    /// Set or clear the target of one end.
    pub fn set(&mut self, end: End, target: Option<EndTarget>) {
        match end {
            End::Start => self.start = target,
            End::Finish => self.finish = target,
        }
    }

    /// Give each end the target of the other, turned round: the targets of the reversed curve.
    pub fn turned(&self, planar: bool) -> Self {
        let turned = |target: EndTarget| target.turned(planar);
        Self {
            start: self.finish.map(turned),
            finish: self.start.map(turned),
        }
    }

    /// List the ends that have a target, with it.
    pub fn list(&self) -> Vec<(End, EndTarget)> {
        let both = End::BOTH.into_iter();
        both.filter_map(|end| Some((end, self.get(end)?))).collect()
    }

    /// Whether every number of the targets can be used.
    pub fn are_usable(&self) -> bool {
        let mut targets = self.list().into_iter();
        targets.all(|(_, target)| target.is_usable())
    }
}

/// Hold a curve: its float polygon, which is the truth of its shape, and what the user calls it.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The name shown in lists and written to files.
    pub name: String,
    /// The group that lists show it in, and that files of other programs write as its layer.
    pub group: Group,
    /// The curve's own colour; `None` takes the theme's.
    pub colour: Option<Colour>,
    /// Whether it is drawn and can be picked.
    pub visible: bool,
    /// Whether its shape is protected from edits.
    pub locked: bool,
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// The vertices that no edit moves.
    pub locked_vertices: LockedVertices,
    /// Where the ends shall be.
    pub targets: EndTargets,
    /// The rule that it is its own mirror image, if it shall stay so.
    pub symmetry: Option<Symmetry>,
    /// What its file said of it that this program does not know. Every edit keeps it; copies and
    /// parts split off are curves of their own and have none.
    pub extras: Extras,
}

impl Curve {
    /// Refuse if the curve's shape cannot be changed: it is hidden or locked.
    ///
    /// # Errors
    /// [`EditError::Hidden`] or [`EditError::Locked`].
    pub fn check_editable(&self) -> Result<(), EditError> {
        self.check_visible()?;
        self.check_unlocked()
    }

    /// Refuse if the curve is hidden.
    ///
    /// # Errors
    /// [`EditError::Hidden`].
    pub fn check_visible(&self) -> Result<(), EditError> {
        if self.visible {
            return Ok(());
        }
        let name = self.name.clone();
        Err(EditError::Hidden { name })
    }

    /// Refuse if the curve is locked.
    ///
    /// # Errors
    /// [`EditError::Locked`].
    pub fn check_unlocked(&self) -> Result<(), EditError> {
        if !self.locked {
            return Ok(());
        }
        let name = self.name.clone();
        Err(EditError::Locked { name })
    }

    /// Refuse a polygon that moves a locked vertex, changes its weight or does not have it.
    ///
    /// # Errors
    /// [`EditError::LockedVertex`].
    pub fn check_held(&self, polygon: &FloatPolygon) -> Result<(), EditError> {
        let vertex = |polygon: &FloatPolygon, index: usize| {
            let point = *polygon.vertices().get(index)?;
            Some((point, polygon.weight(index)))
        };
        let is_held = |index| vertex(&self.polygon, index) == vertex(polygon, index);
        match self.locked_vertices.iter().find(|vertex| !is_held(*vertex)) {
            None => Ok(()),
            Some(vertex) => Err(self.refused_vertex(vertex)),
        }
    }

    /// Refuse if one of some vertices is locked.
    ///
    /// # Errors
    /// [`EditError::LockedVertex`].
    pub fn check_vertices_unlocked(
        &self,
        vertices: impl IntoIterator<Item = usize>,
    ) -> Result<(), EditError> {
        let mut vertices = vertices.into_iter();
        match vertices.find(|vertex| self.locked_vertices.contains(*vertex)) {
            None => Ok(()),
            Some(vertex) => Err(self.refused_vertex(vertex)),
        }
    }

    pub(super) fn refused(&self, error: PolygonError) -> EditError {
        let name = self.name.clone();
        EditError::Polygon { name, error }
    }

    fn refused_vertex(&self, vertex: usize) -> EditError {
        let name = self.name.clone();
        EditError::LockedVertex { name, vertex }
    }

    /// Make a visible, unlocked curve without group, locked vertices and targets.
    pub fn new(name: impl Into<String>, polygon: FloatPolygon) -> Self {
        Self {
            name: name.into(),
            group: Group::default(),
            colour: None,
            visible: true,
            locked: false,
            polygon,
            locked_vertices: LockedVertices::default(),
            targets: EndTargets::default(),
            symmetry: None,
            extras: Extras::default(),
        }
    }

    /// Put the curve into a group.
    pub fn in_group(self, group: Group) -> Self {
        Self { group, ..self }
    }
}
