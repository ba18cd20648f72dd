//! Edits: every change to a document, as data, applied in one place.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use super::curve::{Colour, Curve, CurveId};
use super::document::Document;
use super::end_match::EndMatch;
use super::error::EditError;
use super::group::Group;
use super::guide_line::GuideLine;
use super::picture::Picture;
use super::reference::Reference;
use super::renumbering::Renumbering;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::ReferenceCurve;
use crate::geometry::{End, FloatPolygon, PolygonError, Symmetry};

/// A change to a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Put vertices of a curve's float polygon somewhere else. Locked ones cannot be moved.
    MoveVertices {
        /// The curve.
        curve: CurveId,
        /// The vertices, counted from 0, with their new places.
        moves: Vec<(usize, DVec3)>,
    },
    /// Give a curve another float polygon with the same degree and number of vertices, open or periodic as it was.
    /// Locked vertices stay where they are.
    SetPolygon {
        /// The curve.
        curve: CurveId,
        /// The new polygon.
        polygon: FloatPolygon,
    },
    /// Give a curve a float polygon whose vertices have other numbers, as after an insertion. Locks and matches at
    /// places of the curve go along.
    Renumber {
        /// The curve.
        curve: CurveId,
        /// The new polygon.
        polygon: FloatPolygon,
        /// Where vertices and places go. A locked vertex must be one that was locked before, at its point.
        renumbering: Renumbering,
    },
    /// Lock vertices of a curve, or unlock them.
    SetVerticesLocked {
        /// The curve.
        curve: CurveId,
        /// The vertices, counted from 0.
        vertices: Vec<usize>,
        /// Whether they shall be locked.
        locked: bool,
    },
    /// Change the weight of a vertex, unless it is locked.
    SetWeight {
        /// The curve.
        curve: CurveId,
        /// The vertex, counted from 0.
        vertex: usize,
        /// The new weight.
        weight: f64,
    },
    /// Give a curve or a reference another name.
    Rename {
        /// The curve or the reference.
        curve: CurveId,
        /// The new name.
        name: String,
    },
    /// Move a curve or a reference to a group, or out of its group.
    SetGroup {
        /// The curve or the reference.
        curve: CurveId,
        /// The new group.
        group: Group,
    },
    /// Give a group another path, with the groups within it. Without names in the new path its curves and
    /// references leave it.
    RenameGroup {
        /// The group.
        group: Group,
        /// Its new path.
        to: Group,
    },
    /// Give a curve or a reference a colour of its own, or the theme's.
    Recolour {
        /// The curve or the reference.
        curve: CurveId,
        /// The new colour.
        colour: Option<Colour>,
    },
    /// Show or hide a curve or a reference.
    SetVisible {
        /// The curve or the reference.
        curve: CurveId,
        /// Whether it shall be drawn.
        visible: bool,
    },
    /// Protect the shape of a curve or a reference from edits, or release it.
    SetLocked {
        /// The curve or the reference.
        curve: CurveId,
        /// Whether it shall be protected.
        locked: bool,
    },
    /// Set or clear the target of an end.
    SetTarget {
        /// The curve.
        curve: CurveId,
        /// The end.
        end: End,
        /// The new target.
        target: Option<EndTarget>,
    },
    /// Make a curve symmetric, by the mean of its halves, and keep it so; or let each half change alone.
    SetSymmetry {
        /// The curve.
        curve: CurveId,
        /// The rule, for as many vertices as the curve has.
        symmetry: Option<Symmetry>,
    },
    /// Match an end to a place of another curve or of a reference, in place of its earlier match.
    SetMatch(EndMatch),
    /// Let an end be no longer matched; its target stays.
    RemoveMatch {
        /// The curve.
        curve: CurveId,
        /// The end.
        end: End,
    },
    /// Give the document another unit of length, or none. Its numbers stay: 5 mm become 5 in.
    SetUnit(Option<LengthUnit>),
    /// Convert the document to another unit of length: everything keeps its size, 25.4 mm become 1 in.
    ConvertUnit(LengthUnit),
    /// Replace the guide lines.
    SetGuideLines(Vec<GuideLine>),
    /// Add a curve behind the others. It gets [`Document::next_id`].
    Add(Box<Curve>),
    /// Add a reference behind the others. It gets [`Document::next_id`].
    AddReference(Box<Reference>),
    /// Give a reference another shape or another place.
    SetReference {
        /// The reference.
        reference: CurveId,
        /// The new curve, where it is placed.
        curve: ReferenceCurve,
    },
    /// Give the frame of a picture another picture, or the same one with another opacity. Locked ones too.
    SetPicture {
        /// The reference with the frame.
        reference: CurveId,
        /// The new picture.
        picture: Picture,
    },
    /// Remove a curve, with the matches of its ends and to it, or a reference, with the matches to it.
    Remove(CurveId),
    /// Put a curve at another place among the curves, or a reference among the references.
    Reorder {
        /// The curve or the reference.
        curve: CurveId,
        /// Its new place, counted from 0; the last place if it lies beyond.
        place: usize,
    },
}

impl Document {
    /// Make some edits in a copy, one after the other; then the other halves of symmetric curves and matched ends
    /// follow.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made.
    pub fn edited(&self, edits: impl IntoIterator<Item = Edit>) -> Result<Self, EditError> {
        self.edited_hastily(edits, &BTreeSet::new())
    }

    /// Make edits as [`Document::edited`] does, but do not try long to let the curves in `hasty` follow.
    ///
    /// # Errors
    /// As [`Document::edited`].
    pub(super) fn edited_hastily(
        &self,
        edits: impl IntoIterator<Item = Edit>,
        hasty: &BTreeSet<CurveId>,
    ) -> Result<Self, EditError> {
        let mut document = self.clone();
        for edit in edits {
            document.apply(edit)?;
        }
        document.keep_symmetries(self)?;
        document.follow(self, hasty);
        Ok(document)
    }

    /// Make one edit. Other halves and matched ends do not follow: see [`Document::edited`].
    ///
    /// # Errors
    /// [`EditError`]; the document is unchanged then.
    pub fn apply(&mut self, edit: Edit) -> Result<(), EditError> {
        match edit {
            Edit::MoveVertices { curve, moves } => self.reshape(curve, |polygon| {
                polygon.move_vertices(moves.iter().copied())
            }),
            Edit::SetPolygon { curve, polygon } => self.set_polygon(curve, polygon),
            Edit::Renumber {
                curve,
                polygon,
                renumbering,
            } => self.renumber(curve, polygon, &renumbering),
            Edit::SetVerticesLocked {
                curve,
                vertices,
                locked,
            } => self.lock_vertices(curve, &vertices, locked),
            Edit::SetWeight {
                curve,
                vertex,
                weight,
            } => self.reshape(curve, |polygon| polygon.set_weight(vertex, weight)),
            Edit::Rename { curve, name } => {
                let name = name.trim().to_owned();
                if name.is_empty() {
                    return Err(EditError::EmptyName);
                }
                self.change_attributes(curve, |item| *item.name = name)
            }
            Edit::SetGroup { curve, group } => {
                self.change_attributes(curve, |item| *item.group = group)
            }
            Edit::RenameGroup { group, to } => self.rename_group(&group, &to),
            Edit::Recolour { curve, colour } => {
                self.change_attributes(curve, |item| *item.colour = colour)
            }
            Edit::SetVisible { curve, visible } => {
                self.change_attributes(curve, |item| *item.visible = visible)
            }
            Edit::SetLocked { curve, locked } => {
                self.change_attributes(curve, |item| *item.locked = locked)
            }
            Edit::SetTarget { target, .. } if target.is_some_and(|target| !target.is_usable()) => {
                Err(EditError::BadTarget)
            }
            Edit::SetTarget { curve, end, target } => {
                let found = self.curve(curve).ok_or(EditError::NoSuchCurve)?;
                found.check_visible()?;
                let is_symmetric = found.symmetry.is_some();
                self.check_unmatched(curve, end)?;
                if is_symmetric {
                    self.check_unmatched(curve, end.other())?;
                }
                self.change(curve, |curve| curve.targets.set(end, target))
            }
            Edit::SetSymmetry { curve, symmetry } => self.set_symmetry(curve, symmetry),
            Edit::SetMatch(matched) => self.set_match(matched),
            Edit::RemoveMatch { curve, end } => {
                self.remove_match(curve, end);
                Ok(())
            }
            Edit::SetUnit(unit) => {
                self.unit = unit;
                Ok(())
            }
            Edit::ConvertUnit(unit) => self.convert_unit(unit),
            Edit::SetGuideLines(lines) => {
                self.set_guide_lines(lines);
                Ok(())
            }
            Edit::Add(curve) if !curve.targets.are_usable() => Err(EditError::BadTarget),
            Edit::Add(curve) => {
                check_vertices(&curve, curve.locked_vertices.iter())?;
                self.push(*curve);
                Ok(())
            }
            Edit::AddReference(reference) => {
                self.push_reference(*reference);
                Ok(())
            }
            Edit::SetReference { reference, curve } => self.set_reference(reference, curve),
            Edit::SetPicture { reference, picture } => {
                let index = self.reference_position(reference);
                let index = index.ok_or(EditError::NoSuchCurve)?;
                Arc::make_mut(&mut self.references[index].1).picture = Some(picture);
                Ok(())
            }
            Edit::Remove(curve) => {
                match (self.position(curve), self.reference_position(curve)) {
                    (Some(index), _) => drop(self.curves.remove(index)),
                    (None, Some(index)) => drop(self.references.remove(index)),
                    (None, None) => return Err(EditError::NoSuchCurve),
                }
                let is_other =
                    |matched: &EndMatch| ![matched.curve, matched.source].contains(&curve);
                self.matches.retain(is_other);
                Ok(())
            }
            Edit::Reorder { curve, place } => {
                match (self.position(curve), self.reference_position(curve)) {
                    (Some(index), _) => reorder(&mut self.curves, index, place),
                    (None, Some(index)) => reorder(&mut self.references, index, place),
                    (None, None) => return Err(EditError::NoSuchCurve),
                }
                Ok(())
            }
        }
    }

    /// Change what curves and references both have.
    fn change_attributes(
        &mut self,
        id: CurveId,
        change: impl FnOnce(Attributes<'_>),
    ) -> Result<(), EditError> {
        if let Some(index) = self.position(id) {
            let curve = Arc::make_mut(&mut self.curves[index].1);
            change(Attributes {
                name: &mut curve.name,
                group: &mut curve.group,
                colour: &mut curve.colour,
                visible: &mut curve.visible,
                locked: &mut curve.locked,
            });
            return Ok(());
        }
        let index = self.reference_position(id).ok_or(EditError::NoSuchCurve)?;
        let reference = Arc::make_mut(&mut self.references[index].1);
        change(Attributes {
            name: &mut reference.name,
            group: &mut reference.group,
            colour: &mut reference.colour,
            visible: &mut reference.visible,
            locked: &mut reference.locked,
        });
        Ok(())
    }

    fn rename_group(&mut self, group: &Group, to: &Group) -> Result<(), EditError> {
        let members: Vec<CurveId> = self.members(group).collect();
        if members.is_empty() {
            let group = group.to_string();
            return Err(EditError::NoSuchGroup { group });
        }
        for id in members {
            self.change_attributes(id, |item| {
                if let Some(renamed) = item.group.renamed(group, to) {
                    *item.group = renamed;
                }
            })?;
        }
        Ok(())
    }

    fn set_reference(&mut self, id: CurveId, curve: ReferenceCurve) -> Result<(), EditError> {
        let index = self.reference_position(id).ok_or(EditError::NoSuchCurve)?;
        let shared = &mut self.references[index].1;
        shared.check_editable()?;
        Arc::make_mut(shared).curve = curve;
        Ok(())
    }

    fn change(&mut self, id: CurveId, change: impl FnOnce(&mut Curve)) -> Result<(), EditError> {
        let index = self.position(id).ok_or(EditError::NoSuchCurve)?;
        change(Arc::make_mut(&mut self.curves[index].1));
        Ok(())
    }

    fn reshape(
        &mut self,
        id: CurveId,
        change: impl FnOnce(&mut FloatPolygon) -> Result<(), PolygonError>,
    ) -> Result<(), EditError> {
        let index = self.position(id).ok_or(EditError::NoSuchCurve)?;
        let shared = &mut self.curves[index].1;
        let name = || shared.name.clone();
        shared.check_editable()?;
        let mut changed = Curve::clone(shared);
        change(&mut changed.polygon).map_err(|error| EditError::Polygon {
            name: name(),
            error,
        })?;
        shared.check_held(&changed.polygon)?;
        *shared = Arc::new(changed);
        Ok(())
    }

    fn set_symmetry(&mut self, id: CurveId, symmetry: Option<Symmetry>) -> Result<(), EditError> {
        let index = self.position(id).ok_or(EditError::NoSuchCurve)?;
        let are_matched = End::BOTH.map(|end| self.match_of(id, end).is_some());
        let shared = &mut self.curves[index].1;
        shared.check_editable()?;
        if symmetry.is_some() && are_matched == [true, true] {
            let name = shared.name.clone();
            return Err(EditError::SymmetricEnds { name });
        }
        *shared = Arc::new(match symmetry {
            Some(symmetry) => shared.with_symmetry(symmetry)?,
            None => Curve {
                symmetry: None,
                ..Curve::clone(shared)
            },
        });
        Ok(())
    }

    fn set_polygon(&mut self, id: CurveId, polygon: FloatPolygon) -> Result<(), EditError> {
        let curve = self.curve(id).ok_or(EditError::NoSuchCurve)?;
        if !curve.polygon.has_numbers_of(&polygon) {
            let name = curve.name.clone();
            return Err(EditError::OtherNumbers { name });
        }
        self.reshape(id, |old| {
            *old = polygon;
            Ok(())
        })
    }

    fn renumber(
        &mut self,
        id: CurveId,
        polygon: FloatPolygon,
        renumbering: &Renumbering,
    ) -> Result<(), EditError> {
        let index = self.position(id).ok_or(EditError::NoSuchCurve)?;
        let shared = &mut self.curves[index].1;
        shared.check_editable()?;
        let held = shared.locked_vertices.carried(&shared.polygon, &polygon);
        let mut locked = renumbering.locked_vertices().iter();
        if let Some(vertex) = locked.find(|new| !held.contains(*new)) {
            let name = shared.name.clone();
            return Err(EditError::LockedVertex { name, vertex });
        }
        let changed = Arc::make_mut(shared);
        if renumbering.is_turned() {
            changed.targets = changed.targets.turned(changed.polygon.is_planar());
        }
        changed.polygon = polygon;
        changed.locked_vertices = renumbering.locked_vertices().clone();
        let matches = self.matches.iter().filter_map(|matched| match matched {
            matched if matched.source == id => renumbering.of_source(matched),
            matched if matched.curve == id => Some(renumbering.of_end(matched)),
            matched => Some(*matched),
        });
        self.matches = matches.collect();
        Ok(())
    }

    fn lock_vertices(
        &mut self,
        id: CurveId,
        vertices: &[usize],
        locked: bool,
    ) -> Result<(), EditError> {
        let curve = self.curve(id).ok_or(EditError::NoSuchCurve)?;
        curve.check_visible()?;
        check_vertices(curve, vertices.iter().copied())?;
        self.change(id, |curve| {
            let own: Vec<usize> = vertices
                .iter()
                .flat_map(|it| curve.dependents(*it))
                .collect();
            for vertex in own {
                curve.locked_vertices.set(vertex, locked);
            }
        })
    }
}

/// What curves and references both have, to be changed.
struct Attributes<'a> {
    name: &'a mut String,
    group: &'a mut Group,
    colour: &'a mut Option<Colour>,
    visible: &'a mut bool,
    locked: &'a mut bool,
}

/// Put one of a list at another place; the last place if it lies beyond.
fn reorder<T>(list: &mut Vec<T>, index: usize, place: usize) {
    let moved = list.remove(index);
    list.insert(place.min(list.len()), moved);
}

/// Refuse vertices that a curve does not have.
fn check_vertices(
    curve: &Curve,
    mut vertices: impl Iterator<Item = usize>,
) -> Result<(), EditError> {
    let checked = vertices.try_for_each(|vertex| curve.polygon.check_index(vertex));
    checked.map_err(|error| EditError::Polygon {
        name: curve.name.clone(),
        error,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_fill_or_turn_the_message_of_an_edit() {
        let name = format!("a\u{202e}\n{}", "x".repeat(1000));
        let shown = format!("“a\\u{{202e}}\\n{}…”", "x".repeat(57));
        let error = PolygonError::DegreeOutOfRange { degree: 0 };
        let locked = EditError::Locked { name: name.clone() }.to_string();
        assert!(
            locked.starts_with(&format!("{shown} is locked")),
            "{locked}"
        );
        let hidden = EditError::Hidden { name: name.clone() }.to_string();
        assert!(
            hidden.starts_with(&format!("{shown} is hidden")),
            "{hidden}"
        );
        let refused = EditError::Polygon { name, error }.to_string();
        assert!(
            refused.starts_with(&format!("{shown}: degree 0")),
            "{refused}"
        );
    }
}
