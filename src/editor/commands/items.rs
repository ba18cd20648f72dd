//! Commands on the selected curves and references: the edits of one step, and what it leaves out.

use crate::document::{Curve, CurveId, Document, Edit, Group, Reference, free_name, quoted};
use crate::editor::polygon_edits::periodicity;
use crate::editor::reply::Refusal;
use crate::editor::sharper::sharper_radius;
use crate::geometry::{FloatPolygon, Symmetry, curve_crossing, significant};
use crate::io::counted_items;

/// The most names of items that a message lists.
const MOST_NAMES: usize = 3;

/// The step of a command on several items.
pub(super) struct Change {
    /// The label of the step.
    pub label: String,
    /// The edits.
    pub edits: Vec<Edit>,
    /// The items that are changed.
    pub taken: Vec<CurveId>,
    /// Why the others are left out, a sentence each.
    pub left_out: Vec<String>,
    /// What the user may not want.
    pub warning: Option<String>,
}

/// What a curve that becomes periodic does, and what else there is.
const PERIODIC: &str =
    "it closes round all vertices of its polygon. Close curve joins its ends instead";

/// How far a curve that is called symmetric may be from its image, as a share of its size: no farther than rounding in
/// files of other programs.
const SYMMETRIC: f64 = 1e-6;

/// A curve that is so many times as long as before is told, by lengths of this relative precision.
const LONGER: f64 = 2.0;
const PRECISION: f64 = 1e-3;

impl Change {
    /// Make the edit of each item. Those without one are left out; without any edit the first reason counts.
    fn of(
        items: impl IntoIterator<Item = CurveId>,
        label: impl Fn(&[CurveId]) -> String,
        edit: impl Fn(CurveId) -> Result<Edit, String>,
    ) -> Result<Self, Refusal> {
        let (mut edits, mut taken, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
        for item in items {
            match edit(item) {
                Ok(edit) => {
                    edits.push(edit);
                    taken.push(item);
                }
                Err(reason) => left_out.push(reason),
            }
        }
        if let (true, Some(reason)) = (edits.is_empty(), left_out.first()) {
            return Err(Refusal(reason.clone()));
        }
        Ok(Self {
            label: label(&taken),
            edits,
            taken,
            left_out,
            warning: None,
        })
    }

    /// Remove the items that are not locked.
    pub fn removal(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let label = |taken: &[CurveId]| format!("Delete {}", noun(document, taken));
        let check = |id| match (document.curve(id), document.reference(id)) {
            (Some(curve), _) => curve.check_unlocked(),
            (_, Some(reference)) => reference.check_unlocked(),
            _ => Ok(()),
        };
        Self::of(items.iter().copied(), label, |id| {
            check(id).map_err(|error| error.to_string())?;
            Ok(Edit::Remove(id))
        })
    }

    /// Hide the items if all are visible, or show them.
    pub fn visibility(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let visible = !are_visible(document, items);
        let verb = if visible { "Show" } else { "Hide" };
        let label = |taken: &[CurveId]| format!("{verb} {}", noun(document, taken));
        Self::of(items.iter().copied(), label, |curve| {
            Ok(Edit::SetVisible { curve, visible })
        })
    }

    /// Put the items in a new group, within the group that all of them are in.
    pub fn grouping(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let groups = || document.all_ids().filter_map(|id| document.group(id));
        let own = items.iter().filter_map(|id| document.group(*id));
        let shared = own.cloned().reduce(|shared, group| shared.shared(&group));
        let shared = shared.unwrap_or_default();
        let made = |name: &str| Group::new(shared.names().iter().map(String::as_str).chain([name]));
        let is_taken = |name: &str| groups().any(|group| made(name).holds(group));
        let group = made(&free_name("group 1", is_taken));
        let label = |taken: &[CurveId]| format!("Group {}", noun(document, taken));
        Self::of(items.iter().copied(), label, |curve| {
            Ok(Edit::SetGroup {
                curve,
                group: group.clone(),
            })
        })
    }

    /// Take the items out of the innermost group that each is in.
    pub fn ungrouping(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let label = |taken: &[CurveId]| format!("Ungroup {}", noun(document, taken));
        let grouped = items.iter().copied().filter(|id| {
            let group = document.group(*id);
            group.is_some_and(|group| !group.is_none())
        });
        Self::of(grouped, label, |curve| {
            let group = document.group(curve).cloned().unwrap_or_default();
            Ok(Edit::SetGroup {
                curve,
                group: group.outer(),
            })
        })
    }

    /// Hide what is visible beside the items, or show again what of `hidden` is hidden still.
    pub fn isolation(
        document: &Document,
        items: &[CurveId],
        hidden: &[CurveId],
    ) -> Result<Self, Refusal> {
        let hidden = hidden_still(document, hidden);
        let visible = !hidden.is_empty();
        let others = document.all_ids();
        let others = others.filter(|id| !items.contains(id) && document.is_visible(*id));
        let changed = match visible {
            true => hidden,
            false => others.collect(),
        };
        if changed.is_empty() {
            return Err("Nothing else is visible".into());
        }
        let label = |_: &[CurveId]| match visible {
            true => "End isolation".to_owned(),
            false => format!("Isolate {}", noun(document, items)),
        };
        Self::of(changed, label, |curve| {
            Ok(Edit::SetVisible { curve, visible })
        })
    }

    /// Show everything that is hidden.
    pub fn showing(document: &Document) -> Result<Self, Refusal> {
        let all: Vec<CurveId> = document.all_ids().collect();
        let hidden = hidden_still(document, &all);
        if hidden.is_empty() {
            return Err("Nothing is hidden".into());
        }
        let label = |taken: &[CurveId]| format!("Show {}", noun(document, taken));
        Self::of(hidden, label, |curve| {
            Ok(Edit::SetVisible {
                curve,
                visible: true,
            })
        })
    }

    /// Unlock the items if all are locked, or lock them.
    pub fn lock(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let locked = !are_locked(document, items);
        let verb = if locked { "Lock" } else { "Unlock" };
        let label = |taken: &[CurveId]| format!("{verb} {}", noun(document, taken));
        Self::of(items.iter().copied(), label, |curve| {
            Ok(Edit::SetLocked { curve, locked })
        })
    }

    /// Open the curves if all are periodic, or make them periodic. References stay.
    pub fn periodicity(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let periodic = !are_periodic(document, items);
        let changes = items.iter().copied().filter(|id| {
            let curve = document.curve(*id);
            curve.is_some_and(|curve| curve.polygon.is_periodic() != periodic)
        });
        let label = |taken: &[CurveId]| match (periodic, taken.len()) {
            (true, 1) => "Make periodic".to_owned(),
            (true, _) => format!("Make {} periodic", noun(document, taken)),
            (false, _) => format!("Open {}", noun(document, taken)),
        };
        let change = Self::of(changes, label, |id| {
            let curve = document.curve(id).ok_or("There is no curve")?;
            curve.check_editable().map_err(|error| error.to_string())?;
            periodicity(id, curve, periodic).map_err(|error| error.to_string())
        })?;
        let mut edits = change.edits.iter().filter(|_| periodic);
        let warning = edits.find_map(|edit| warning_of_ring(document, edit));
        Ok(Self { warning, ..change })
    }

    /// Keep the curves symmetric, or let their halves change alone if all are. References stay.
    pub fn symmetry(document: &Document, items: &[CurveId]) -> Result<Self, Refusal> {
        let keeps = !are_symmetric(document, items);
        let changes = items.iter().copied().filter(|id| {
            let curve = document.curve(*id);
            curve.is_some_and(|curve| curve.symmetry.is_some() != keeps)
        });
        let label = |taken: &[CurveId]| match keeps {
            true => format!("Keep {} symmetric", noun(document, taken)),
            false => format!("Let halves of {} change alone", noun(document, taken)),
        };
        Self::of(changes, label, |id| {
            let curve = document.curve(id).ok_or("There is no curve")?;
            curve.check_editable().map_err(|error| error.to_string())?;
            if !keeps {
                return Ok(Edit::SetSymmetry {
                    curve: id,
                    symmetry: None,
                });
            }
            let name = quoted(&curve.name);
            let found = Symmetry::found(&curve.polygon, SYMMETRIC);
            let found = found.ok_or_else(|| {
                format!("{name} is not symmetric: run Make symmetric with “Stay symmetric”")
            })?;
            let edit = Edit::SetSymmetry {
                curve: id,
                symmetry: Some(found),
            };
            let made = document.edited([edit.clone()]);
            made.map(|_| edit).map_err(|error| error.to_string())
        })
    }
}

/// Whether there are curves among items, and all stay symmetric.
pub(super) fn are_symmetric(document: &Document, items: &[CurveId]) -> bool {
    let curves = items.iter().filter_map(|id| document.curve(*id));
    let mut curves = curves.map(|curve| curve.symmetry.is_some()).peekable();
    curves.peek().is_some() && curves.all(|is_symmetric| is_symmetric)
}

/// Say that a curve which becomes periodic crosses itself, has a bend much sharper than all before, or is much longer.
fn warning_of_ring(document: &Document, edit: &Edit) -> Option<String> {
    let Edit::Renumber { curve, polygon, .. } = edit else {
        return None;
    };
    let before = &document.curve(*curve)?.polygon;
    let crosses = |polygon: &FloatPolygon| polygon.is_planar() && curve_crossing(polygon).is_some();
    if crosses(polygon) && !crosses(before) {
        return Some(format!("The curve crosses itself: {PERIODIC}"));
    }
    if let Some(radius) = sharper_radius(before, polygon) {
        return Some(format!("A bend has the radius {radius} now: {PERIODIC}"));
    }
    let [was, now] = [before, polygon].map(|it| it.arc_length(PRECISION));
    (now > LONGER * was).then(|| {
        let [was, now] = [was, now].map(|length| significant(length, 3));
        format!("The curve is {now} long, {was} before: {PERIODIC}")
    })
}

/// The items that are hidden, of those that were.
pub(super) fn hidden_still(document: &Document, hidden: &[CurveId]) -> Vec<CurveId> {
    let hidden = hidden.iter().copied();
    let there = hidden.filter(|id| document.name(*id).is_some());
    there.filter(|id| !document.is_visible(*id)).collect()
}

/// Whether all items are visible.
pub(super) fn are_visible(document: &Document, items: &[CurveId]) -> bool {
    items.iter().all(|id| document.is_visible(*id))
}

/// Whether all items are locked.
pub(super) fn are_locked(document: &Document, items: &[CurveId]) -> bool {
    items.iter().all(|id| {
        let curve = document.curve(*id).map(|it| it.locked);
        let reference = document.reference(*id).map(|it| it.locked);
        curve.or(reference).unwrap_or(false)
    })
}

/// Whether there are curves among items, and all are periodic.
pub(super) fn are_periodic(document: &Document, items: &[CurveId]) -> bool {
    let curves = items.iter().filter_map(|id| document.curve(*id));
    let mut curves = curves.map(|curve| curve.polygon.is_periodic()).peekable();
    curves.peek().is_some() && curves.all(|is_periodic| is_periodic)
}

/// The items with copies of their curves and references.
pub(super) fn copies(document: &Document, items: &[CurveId]) -> (Vec<Curve>, Vec<Reference>) {
    let curves = items.iter().filter_map(|id| document.curve(*id));
    let references = items.iter().filter_map(|id| document.reference(*id));
    (
        curves.map(|curve| Curve::clone(curve)).collect(),
        references
            .map(|reference| Reference::clone(reference))
            .collect(),
    )
}

/// The word for items in labels: "curve", "reference", or how many there are.
pub(super) fn noun(document: &Document, items: &[CurveId]) -> String {
    let references = items.iter().filter(|id| document.reference(**id).is_some());
    let references = references.count();
    match (items.len(), references) {
        (1, 0) => "curve".to_owned(),
        (1, _) => "reference".to_owned(),
        (all, references) => counted_items(all - references, references),
    }
}

/// Name items: all of a few, otherwise the first, and how many others there are.
pub(super) fn named(document: &Document, items: &[CurveId]) -> String {
    let name = |id: &CurveId| quoted(document.name(*id).unwrap_or_default());
    match items {
        [] => String::new(),
        [only] => name(only),
        [first @ .., last] if items.len() <= MOST_NAMES => {
            let first: Vec<String> = first.iter().map(name).collect();
            format!("{} and {}", first.join(", "), name(last))
        }
        _ => {
            let first: Vec<String> = items.iter().take(MOST_NAMES - 1).map(name).collect();
            let others = items.len() - first.len();
            format!("{} and {others} others", first.join(", "))
        }
    }
}
