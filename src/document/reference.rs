//! One reference of a document: what curves are drawn and measured against.

use glam::DVec3;

use super::curve::Colour;
use super::error::EditError;
use super::extras::Extras;
use super::group::Group;
use super::picture::Picture;
use crate::geometry::references::{ReferenceCurve, ReferenceForm};

/// Hold a reference: its curve or its points, which no vertices edit, and what the user calls it.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The name shown in lists and written to files.
    pub name: String,
    /// The group that lists show it in, and that files of other programs write as its layer.
    pub group: Group,
    /// The reference's own colour; `None` takes the theme's.
    pub colour: Option<Colour>,
    /// Whether it is drawn and can be picked.
    pub visible: bool,
    /// Whether its shape and place are protected from edits.
    pub locked: bool,
    /// Its curve, where it is placed.
    pub curve: ReferenceCurve,
    /// The picture in its frame, if the curve is one.
    pub picture: Option<Picture>,
    /// What its file said of it that this program does not know. Every edit keeps it; copies have
    /// none.
    pub extras: Extras,
}

impl Reference {
    /// Make a visible, unlocked reference without group.
    pub fn new(name: impl Into<String>, curve: ReferenceCurve) -> Self {
        Self {
            name: name.into(),
            group: Group::default(),
            colour: None,
            visible: true,
            locked: false,
            curve,
            picture: None,
            extras: Extras::default(),
        }
    }

    /// Put the reference into a group.
    pub fn in_group(self, group: Group) -> Self {
        Self { group, ..self }
    }

    /// Show a picture in its frame.
    pub fn with_picture(self, picture: Picture) -> Self {
        let picture = Some(picture);
        Self { picture, ..self }
    }

    /// The picture with the lower left corner of its frame, and the vectors along its lower and its left side.
    pub fn framed(&self) -> Option<(&Picture, [DVec3; 3])> {
        let ReferenceForm::Frame(frame) = self.curve.form() else {
            return None;
        };
        let (size, placement) = (frame.size(), self.curve.placement());
        let sides = [size.x * DVec3::X, size.y * DVec3::Y].map(|side| placement.vector(side));
        let [across, up] = sides;
        Some((
            self.picture.as_ref()?,
            [placement.translation(), across, up],
        ))
    }

    /// The points where they are placed, if it is a list of points.
    pub fn points(&self) -> Option<Vec<DVec3>> {
        let ReferenceForm::Points(list) = self.curve.form() else {
            return None;
        };
        let placement = self.curve.placement();
        let points = list.points().iter();
        Some(points.map(|point| placement.point(*point)).collect())
    }

    /// How much each of its points counts, if they differ.
    pub fn weights(&self) -> Option<&[f64]> {
        match self.curve.form() {
            ReferenceForm::Points(list) => list.weights(),
            _ => None,
        }
    }

    /// Refuse if the reference cannot be changed: it is hidden or locked.
    ///
    /// # Errors
    /// [`EditError::Hidden`] or [`EditError::Locked`].
    pub fn check_editable(&self) -> Result<(), EditError> {
        if !self.visible {
            let name = self.name.clone();
            return Err(EditError::Hidden { name });
        }
        self.check_unlocked()
    }

    /// Refuse if the reference is locked.
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
}
