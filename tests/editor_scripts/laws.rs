//! What documents, selection and view are after anything that is done, and what protects curves.

use std::sync::Arc;

use batten::document::{Curve, Document, Reference};
use batten::editor::Selection;
use batten::geometry::{Continuity, End, FloatPolygon};
use batten::io::{MatchSource, PROJECT, Reading};
use glam::DVec3;

use super::common::check_symmetry;
use super::snapshot::{Bit, Bits, Snapshot};
use super::watch::Done;
use super::window::Window;

/// Every polygon is one that could be made anew.
pub fn check_document(document: &Document) -> Result<(), String> {
    for matched in document.matches() {
        if matched.target(document).is_none() {
            return Err(format!("{matched:?} is of what is not there"));
        }
    }
    let again = Document::clone(document).with_matches(document.matches().copied());
    if again.is_err() {
        return Err(format!("curves follow each other in a circle: {again:?}"));
    }
    for (_, curve) in document.curves() {
        let polygon = &curve.polygon;
        let rebuilt = FloatPolygon::new(
            polygon.degree(),
            polygon.vertices().to_vec(),
            polygon.weights().map(<[f64]>::to_vec),
            polygon.is_periodic(),
        );
        if rebuilt.as_ref() != Ok(polygon) {
            return Err(format!("“{}” is no polygon: {rebuilt:?}", curve.name));
        }
        if curve.name.trim().is_empty() {
            return Err("a curve has no name".into());
        }
        if let Some(last) = curve.locked_vertices.iter().last()
            && last >= polygon.vertices().len()
        {
            return Err(format!("“{}” has no vertex {last}", curve.name));
        }
        check_symmetry(curve)?;
        for (end, target) in curve.targets.list() {
            let directs = |way: DVec3| way.is_finite() && way != DVec3::ZERO;
            if !(target.point.is_finite() && target.direction.is_none_or(directs)) {
                return Err(format!("“{}”, {end:?}: {target:?}", curve.name));
            }
        }
    }
    Ok(())
}

/// What is selected is there and visible, and some of it is of the active curve, which is there.
pub fn check_selection(document: &Document, selection: &Selection) -> Result<(), String> {
    for (curve, vertex) in selection.vertices() {
        let found = document
            .curve(curve)
            .ok_or("a curve is selected that is gone")?;
        if !found.visible {
            return Err(format!("vertex {vertex} of a hidden curve is selected"));
        }
        if vertex >= found.polygon.vertices().len() {
            return Err(format!("vertex {vertex} is selected and does not exist"));
        }
    }
    for item in selection.items() {
        if document.name(item).is_none() {
            return Err("what is selected is gone".into());
        }
    }
    let mut curves = selection.vertices().map(|(curve, _)| curve);
    if !curves.all(|curve| selection.has_item(curve)) {
        return Err("vertices of a curve that is not selected are".into());
    }
    let active = selection.active();
    if !selection.has_no_item() && !active.is_some_and(|active| selection.has_item(active)) {
        return Err("curves are selected, and not the active one".into());
    }
    match active {
        None if document.is_empty() => Ok(()),
        None => Err("no curve is active".into()),
        Some(active) if document.name(active).is_none() => Err("what is active is gone".into()),
        Some(active) => {
            let own = selection.of_curve(active).next();
            if selection.is_empty() || own.is_some() {
                Ok(())
            } else {
                Err("vertices are selected, and none of the active curve".into())
            }
        }
    }
}

/// What of two ends counts as the same place, in units of their coordinates or 1.
const SAME: f64 = 1e-7;

/// An end that counts as met lies where it is to be and goes on in that direction, and the canvas shows of
/// every visible end whether it does.
pub fn check_matches(window: &Window) -> Result<(), String> {
    let document = window.document();
    for matched in document.matches().filter(|matched| document.meets(matched)) {
        let curve = document.curve(matched.curve);
        let source = document.shape(matched.source);
        let (Some(curve), Some(source)) = (curve, source) else {
            return Err(format!("{matched:?} is of what is not there"));
        };
        let own = curve.polygon.end_jet(matched.end);
        let other = matched.place.jet(source);
        let other = other.ok_or(format!("{matched:?} has no place"))?;
        let reach = other.point.abs().max_element().max(1.0);
        if own.point.distance(other.point) > SAME * reach {
            return Err(format!("{matched:?} is not met: {own:?}, {other:?}"));
        }
        if let (true, Some(own), Some(other)) = (
            matched.continuity >= Continuity::G1,
            own.tangent(),
            other.tangent(),
        ) && own.cross(other).length() > SAME
        {
            return Err(format!("{matched:?} goes elsewhere: {own}, {other}"));
        }
    }
    let Some(shown) = window.shown_matches() else {
        return Ok(());
    };
    let visible = document.curves().filter(|(_, curve)| curve.visible);
    let ends = visible.flat_map(|(id, _)| End::BOTH.map(|end| document.match_of(id, end)));
    let expected: Vec<bool> = ends.flatten().map(|it| document.meets(it)).collect();
    match shown == expected {
        true => Ok(()),
        false => Err(format!(
            "matches are shown as met {shown:?}, not {expected:?}"
        )),
    }
}

/// The view and the comb have numbers that can be drawn with.
pub fn check_view(window: &Window) -> Result<(), String> {
    let view = window.viewport();
    if !(view.centre.is_finite() && view.scale.is_finite() && view.scale > 0.0) {
        return Err(format!("a view of {view:?}"));
    }
    let comb = window.comb();
    if !(comb.scale.is_finite() && comb.scale > 0.0) {
        return Err(format!("a comb of {comb:?}"));
    }
    if window.hint().is_empty() {
        return Err("no hint".into());
    }
    if window.message().is_some_and(|text| text.trim().is_empty()) {
        return Err("a message without words".into());
    }
    Ok(())
}

/// Hidden and locked curves and locked vertices keep their shape and locked curves stay; only deleting
/// or joining curves takes one away. Another unit of length rescales them all.
pub fn check_protected(before: &Snapshot, after: &Snapshot, done: Done) -> Result<(), String> {
    for (id, old) in before.curves() {
        let named = &old.named.0;
        match after.curve(*id) {
            None if old.locked => return Err(format!("“{named}” is locked and was deleted")),
            None if done == Done::Delete => {
                return Err(format!("“{named}” was deleted with its vertices"));
            }
            None => {}
            Some(_) if done == Done::Convert => {}
            Some(new) => check_kept(old, new, after.follows(*id))?,
        }
    }
    let gone = before.curves().iter();
    let gone = gone.filter(|(id, _)| after.curve(*id).is_none()).count();
    let most = match done {
        Done::DeleteCurves(count) => count,
        Done::Join => 1,
        _ => 0,
    };
    if gone > most {
        return Err(format!("{gone} curves are gone after {done:?}"));
    }
    Ok(())
}

fn check_kept(old: &Bits, new: &Bits, follows: bool) -> Result<(), String> {
    let named = &old.named.0;
    // A matched curve follows as soon as it is free.
    let locked = old.locked && (new.locked || !follows);
    let hidden = !old.visible && (!new.visible || !follows);
    if old.shape != new.shape && locked {
        return Err(format!("“{named}” is locked and changed its shape"));
    }
    if old.shape != new.shape && hidden {
        return Err(format!("“{named}” is hidden and changed its shape"));
    }
    if old.locked_vertices != new.locked_vertices && !old.visible {
        return Err(format!("“{named}” is hidden and its locks changed"));
    }
    let vertex = |bits: &Bits, index: usize| {
        let weights = bits
            .shape
            .3
            .as_ref()
            .map_or(Some(Bit::ONE), |all| all.get(index).copied());
        Some((*bits.shape.2.get(index)?, weights?))
    };
    // A mirror image takes the locks of all vertices along; without values it is that in the y axis.
    let mut pairs = old.shape.2.iter().zip(&new.shape.2);
    let is_image = pairs.all(|(old, new)| old[0].is_opposite(&new[0]) && old[1..] == new[1..]);
    let has_numbers = old.shape.2.len() == new.shape.2.len();
    if old.locked_vertices == new.locked_vertices && has_numbers && !is_image {
        let mut locked = old.locked_vertices.iter();
        if let Some(moved) = locked.find(|index| vertex(old, **index) != vertex(new, **index)) {
            return Err(format!(
                "vertex {moved} of “{named}” is locked and was moved"
            ));
        }
    }
    if old.targets != new.targets && hidden {
        return Err(format!("“{named}” is hidden and got a target"));
    }
    Ok(())
}

/// What is written is read back equal.
pub fn check_written(document: &Document) -> Result<(), String> {
    let written = PROJECT.write(document, None);
    let written = written.map_err(|error| format!("cannot be written: {error}"))?;
    check_read(document, PROJECT.read(&written.bytes))
}

/// What was read is what the document holds.
pub fn check_read<E: std::fmt::Display>(
    document: &Document,
    read: Result<Reading, E>,
) -> Result<(), String> {
    let read = read.map_err(|error| format!("cannot be read back: {error}"))?;
    let held: Vec<&Arc<Reference>> = document.references().map(|(_, it)| it).collect();
    if read.references.iter().collect::<Vec<_>>() != held {
        return Err(format!("read back as {:?}, not {held:?}", read.references));
    }
    let (read, matches, extras) = (read.curves, read.matches, read.extras);
    let place = |id| document.ids().position(|other| other == id);
    let source = |id| match document.references().position(|(other, _)| other == id) {
        Some(place) => Some(MatchSource::Reference(place)),
        None => place(id).map(MatchSource::Curve),
    };
    let pairs = matches.iter().zip(document.matches());
    let same = pairs.fold(matches.len() == document.matches().len(), |same, (a, b)| {
        same && (Some(a.curve), Some(a.source)) == (place(b.curve), source(b.source))
            && (a.end, a.place) == (b.end, b.place)
            && (a.continuity, a.reversed) == (b.continuity, b.reversed)
    });
    if !same {
        return Err(format!("the matches {matches:?} were read back"));
    }
    if extras != *document.extras() {
        return Err(format!("{extras:?} was read back"));
    }
    let held: Vec<&Arc<Curve>> = document.curves().map(|(_, curve)| curve).collect();
    if read.iter().collect::<Vec<_>>() != held {
        return Err(format!("read back as {read:?}, not {held:?}"));
    }
    Ok(())
}
