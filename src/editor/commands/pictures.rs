//! Changing the picture of the active reference, and the size and place of its frame.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use crate::document::{CurveId, Edit, Picture, PictureSource, Reference};
use crate::editor::Editor;
use crate::editor::reply::{Note, Refusal, Reply};
use crate::editor::view::NamedView;
use crate::geometry::references::{Placement, ReferenceError, ReferenceForm};
use crate::io::disk;

/// A view whose direction is off a picture's normal by less than this looks straight at it.
const STRAIGHT: f64 = 1e-9;

/// A change of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PictureChange {
    /// Draw it more or less strongly, from 0 to 1.
    Opacity(f64),
    /// Give its frame another width; the height goes along.
    Width(f64),
    /// Give its frame another height; the width goes along.
    Height(f64),
    /// Put it into another plane.
    Plane(NamedView),
    /// Scale it about the first of the two measured points so that they have this distance.
    TrueDistance(f64),
    /// Turn it about the first of the two measured points so that the second lies in this direction, in radians.
    TrueDirection(f64),
    /// Move it so that the first of the two measured points has this coordinate.
    FirstPoint {
        /// The axis of the coordinate: 0 x, 1 y, 2 z.
        axis: usize,
        /// The coordinate.
        to: f64,
    },
    /// Read it from another file.
    Relink(PathBuf),
    /// Keep its bytes in the project.
    Embed,
}

/// The views whose planes pictures stand in.
pub const PICTURE_PLANES: [NamedView; 3] = [NamedView::Xy, NamedView::Xz, NamedView::Yz];

/// The view that looks straight at a picture, whatever its turn in its plane.
pub fn picture_plane(placement: &Placement) -> Option<NamedView> {
    let normal = placement.rotation() * DVec3::Z;
    let is_own = |view: &NamedView| (facing(*view) * DVec3::Z).dot(normal).abs() > 1.0 - STRAIGHT;
    PICTURE_PLANES.into_iter().find(is_own)
}

/// The rotation of a picture that stands upright before a view.
fn facing(view: NamedView) -> DQuat {
    let seen = view.orientation();
    DQuat::from_mat3(&DMat3::from_cols(seen.right(), seen.up(), seen.towards()))
}

impl PictureChange {
    /// Change the active picture as one step. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be changed so; nothing is changed then.
    pub fn apply(&self, editor: &mut Editor) -> Reply {
        match self.edit(editor) {
            Ok(Some(edit)) => {
                if let Self::Relink(path) = self {
                    editor.view.pictures.read_again(path);
                }
                editor.apply(self.label(), vec![edit])
            }
            Ok(None) => Ok(Note::silent()),
            Err(refusal) => {
                editor.interrupt();
                editor.tell(Err(refusal))
            }
        }
    }

    /// Preview the change of the active picture, while its field is dragged.
    pub fn preview(&self, editor: &mut Editor) {
        if let Ok(Some(edit)) = self.edit(editor) {
            editor.preview(self.label(), vec![edit]);
        }
    }

    /// The label of the step of undo.
    fn label(&self) -> &'static str {
        match self {
            Self::Opacity(_) => "Change opacity",
            Self::Width(_) | Self::Height(_) | Self::TrueDistance(_) => "Scale picture",
            Self::Plane(_) | Self::TrueDirection(_) => "Turn picture",
            Self::FirstPoint { .. } => "Move picture",
            Self::Relink(_) => "Relink picture",
            Self::Embed => "Embed picture",
        }
    }

    fn edit(&self, editor: &Editor) -> Result<Option<Edit>, Refusal> {
        let Some((reference, found, picture)) = active_picture(editor) else {
            return Ok(None);
        };
        let changed = |picture| Ok(Some(Edit::SetPicture { reference, picture }));
        match self {
            Self::Opacity(opacity) => {
                let opacity = opacity.clamp(0.0, 1.0);
                return changed(Picture { opacity, ..picture });
            }
            Self::Relink(path) => {
                let source = PictureSource::File(path.clone());
                return changed(Picture { source, ..picture });
            }
            Self::Embed => {
                let Some(path) = picture.file() else {
                    return Ok(None);
                };
                let bytes = disk::read_picture(path)?;
                let source = PictureSource::Embedded(bytes.into());
                return changed(Picture { source, ..picture });
            }
            _ => {}
        }
        let placement = self.placement(editor, (reference, &found))?;
        let curve = found.curve.clone().placed(placement);
        Ok((curve != found.curve).then_some(Edit::SetReference { reference, curve }))
    }

    /// The new placement of the frame.
    fn placement(
        &self,
        editor: &Editor,
        (id, found): (CurveId, &Reference),
    ) -> Result<Placement, Refusal> {
        let now = *found.curve.placement();
        let ReferenceForm::Frame(frame) = found.curve.form() else {
            return Ok(now);
        };
        let placement = match self {
            Self::Width(width) => {
                now.scaled_about(now.translation(), width / (frame.size().x * now.scale()))
            }
            Self::Height(height) => {
                now.scaled_about(now.translation(), height / (frame.size().y * now.scale()))
            }
            Self::Plane(view) => stood(&now, *view),
            Self::TrueDistance(length) => {
                let [from, to] = measured(editor, id)?;
                now.scaled_about(from, length / from.distance(to))
            }
            Self::TrueDirection(angle) => {
                let [from, to] = measured(editor, id)?;
                let turn = turn_to(now.rotation(), [from, to], *angle);
                now.rotated_about(from, turn)
            }
            Self::FirstPoint { axis, to } => {
                let [from, _] = measured(editor, id)?;
                let mut moved = from;
                if let Some(coordinate) = moved.as_mut().get_mut(*axis) {
                    *coordinate = *to;
                }
                Placement::new(
                    now.rotation(),
                    now.scale(),
                    now.translation() + (moved - from),
                )
            }
            _ => Ok(now),
        };
        Ok(placement.map_err(|error| error.to_string())?)
    }
}

/// The active picture, with its reference.
fn active_picture(editor: &Editor) -> Option<(CurveId, Arc<Reference>, Picture)> {
    let (id, reference) = editor.active_reference()?;
    let picture = reference.picture.clone()?;
    Some((id, reference, picture))
}

/// The two measured points of a picture.
fn measured(editor: &Editor, id: CurveId) -> Result<[DVec3; 2], Refusal> {
    let measured = editor.hand.measured_on(id, editor.document());
    measured.ok_or_else(|| "Measure two points of the picture first".into())
}

/// The placement in the plane of a view, with the turn in the plane, the lower left corner as far to the right and as high
/// as before, and on the plane through the origin, on which clicks draw.
fn stood(placement: &Placement, view: NamedView) -> Result<Placement, ReferenceError> {
    let before = picture_plane(placement)
        .unwrap_or(NamedView::Xy)
        .orientation();
    let now = view.orientation();
    let corner = before.flatten(placement.translation());
    let along = before.flatten(placement.rotation() * DVec3::X);
    let turn = DQuat::from_axis_angle(now.towards(), along.to_angle());
    let translation = corner.x * now.right() + corner.y * now.up();
    Placement::new(turn * facing(view), placement.scale(), translation)
}

/// The turn about a picture's normal that brings the second measured point into a direction.
fn turn_to(rotation: DQuat, ends: [DVec3; 2], angle: f64) -> DQuat {
    let normal = rotation * DVec3::Z;
    DQuat::from_axis_angle(normal, angle - measured_direction(rotation, ends))
}

/// The direction from the first to the second measured point in a picture's plane: an angle in radians from the line that
/// the plane shares with the ground, or from the x axis.
pub fn measured_direction(rotation: DQuat, [from, to]: [DVec3; 2]) -> f64 {
    let normal = rotation * DVec3::Z;
    let along = DVec3::Z.cross(normal).try_normalize().unwrap_or(DVec3::X);
    let up = normal.cross(along);
    (to - from).dot(up).atan2((to - from).dot(along))
}
