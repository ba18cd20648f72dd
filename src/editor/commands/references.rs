//! Adding references, and changing their shape and placement.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use crate::document::{Document, Edit, Reference};
use crate::editor::Editor;
use crate::editor::reply::{Note, Refusal, Reply};
use crate::geometry::references::{
    AnalyticForm, Formula, Placement, ReferenceCurve, ReferenceError, ReferenceForm, ReferenceKind,
};

/// The formulas that a new curve begins with.
const FORMULAS: [&str; 2] = ["t", "sin(t)"];

/// A change of a reference.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceChange {
    /// Give a parameter of its kind, by its number, another value.
    Value(usize, f64),
    /// Give it other formulas: x, y and z, which is empty in the plane.
    Formula([String; 3]),
    /// Begin or end at another parameter t.
    Interval([f64; 2]),
    /// Put its origin elsewhere.
    Translate(DVec3),
    /// Turn it otherwise.
    Rotate(DQuat),
    /// Make it larger or smaller.
    Scale(f64),
}

impl ReferenceChange {
    /// Change the active reference as one step. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if the reference cannot be changed so; nothing is changed then.
    pub fn apply(&self, editor: &mut Editor) -> Reply {
        match self.edit(editor) {
            Ok(Some(edit)) => editor.apply(self.label(), vec![edit]),
            Ok(None) => Ok(Note::silent()),
            Err(error) => {
                editor.interrupt();
                editor.tell(Err(Refusal(error.to_string())))
            }
        }
    }

    /// Preview the change of the active reference, while its field is dragged or typed into.
    ///
    /// # Errors
    /// [`ReferenceError`] if the reference cannot be changed so; the last preview stays.
    pub fn preview(&self, editor: &mut Editor) -> Result<(), ReferenceError> {
        if let Some(edit) = self.edit(editor)? {
            editor.preview(self.label(), vec![edit]);
        }
        Ok(())
    }

    /// The label of the step of undo.
    fn label(&self) -> &'static str {
        match self {
            Self::Value(..) => "Change reference",
            Self::Formula(_) => "Change formula",
            Self::Interval(_) => "Change interval of reference",
            Self::Translate(_) => "Move reference",
            Self::Rotate(_) => "Rotate reference",
            Self::Scale(_) => "Scale reference",
        }
    }

    /// The edit of the active reference, if there is one.
    fn edit(&self, editor: &Editor) -> Result<Option<Edit>, ReferenceError> {
        let Some((reference, found)) = editor.active_reference() else {
            return Ok(None);
        };
        let curve = self.applied_to(&found.curve)?;
        Ok(Some(Edit::SetReference { reference, curve }))
    }

    /// Make the changed curve.
    fn applied_to(&self, curve: &ReferenceCurve) -> Result<ReferenceCurve, ReferenceError> {
        let now = *curve.placement();
        let (rotation, scale, translation) = (now.rotation(), now.scale(), now.translation());
        let placed = |rotation, scale, translation| {
            let placement = Placement::new(rotation, scale, translation)?;
            Ok(curve.clone().placed(placement))
        };
        match self {
            Self::Value(index, value) => {
                let ReferenceForm::Analytic(form) = curve.form() else {
                    return Ok(curve.clone());
                };
                let mut values = form.values().to_vec();
                if let Some(own) = values.get_mut(*index) {
                    *own = *value;
                }
                let form = ReferenceForm::Analytic(AnalyticForm::new(form.kind(), values)?);
                // An interval that was never chosen is the new values' own.
                let is_default = curve.interval() == curve.form().default_interval();
                let interval = match is_default {
                    true => form.default_interval(),
                    false => curve.interval(),
                };
                ReferenceCurve::new(form, interval, now)
            }
            Self::Formula([x, y, z]) => {
                let z = Some(z.as_str()).filter(|z| !z.trim().is_empty());
                let form = ReferenceForm::Formula(Formula::new(x, y, z)?);
                ReferenceCurve::new(form, curve.interval(), now)
            }
            Self::Interval(interval) => ReferenceCurve::new(curve.form().clone(), *interval, now),
            Self::Translate(to) => placed(rotation, scale, *to),
            Self::Rotate(to) => placed(*to, scale, translation),
            Self::Scale(to) => placed(rotation, *to, translation),
        }
    }
}

/// The edit that adds a reference where its formula puts it, in units of the document.
pub(super) fn addition(
    document: &Document,
    label: &str,
    curve: Result<ReferenceCurve, ReferenceError>,
) -> Result<Edit, Refusal> {
    let curve = curve.map_err(|error| error.to_string())?;
    let name = document.free_name(&label.to_lowercase());
    Ok(Edit::AddReference(Box::new(Reference::new(name, curve))))
}

/// A curve by formulas, to be changed.
pub(super) fn new_formula() -> Result<ReferenceCurve, ReferenceError> {
    let [x, y] = FORMULAS;
    let form = ReferenceForm::Formula(Formula::new(x, y, None)?);
    ReferenceCurve::new(form, [0.0, TAU], Placement::default())
}

/// A reference of a kind, with its defaults.
pub(super) fn new_reference(
    kind: &'static ReferenceKind,
) -> Result<ReferenceCurve, ReferenceError> {
    let form = AnalyticForm::new(kind, kind.defaults())?;
    ReferenceCurve::of(ReferenceForm::Analytic(form))
}
