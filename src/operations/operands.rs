//! What an operation works on.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use super::error::OperationError;
use super::inputs::Inputs;
use crate::document::{Curve, CurveId, Document, EditError, Group};
use crate::geometry::FloatPolygon;
use crate::geometry::references::ReferenceCurve;

/// Hold a snapshot of a document with what was chosen in it: curves, or a table of points.
#[derive(Clone, Debug)]
pub struct Operands {
    document: Document,
    curves: Vec<(CurveId, Arc<Curve>)>,
    points: Vec<DVec3>,
    weights: Option<Vec<f64>>,
    reference: Option<ReferenceCurve>,
    chosen_reference: Option<CurveId>,
    /// The group of the curve or the reference that comes first.
    group: Group,
    /// The other items that an operation runs on, each by itself, or why it cannot.
    beside: Vec<(CurveId, Result<Operands, OperationError>)>,
    /// The items that an operation runs on at once.
    together: Arc<BTreeSet<CurveId>>,
}

impl Operands {
    /// Choose curves of a document, in the order in which the operation takes them.
    ///
    /// # Errors
    /// [`EditError::NoSuchCurve`] if the document has no such curve.
    pub fn new(
        document: &Document,
        curves: impl IntoIterator<Item = CurveId>,
    ) -> Result<Self, OperationError> {
        let found = |id| {
            let curve = document.curve(id).ok_or(EditError::NoSuchCurve)?;
            Ok((id, curve.clone()))
        };
        let curves: Result<Vec<_>, EditError> = curves.into_iter().map(found).collect();
        let curves = curves?;
        let group = curves.first().map(|(_, curve)| curve.group.clone());
        Ok(Self {
            document: document.clone(),
            group: group.unwrap_or_default(),
            curves,
            points: Vec::new(),
            weights: None,
            reference: None,
            chosen_reference: None,
            beside: Vec::new(),
            together: Arc::default(),
        })
    }

    /// Choose the operands of an operation from an active curve or reference and other curves.
    ///
    /// The active curve comes first. Where an operation needs two curves and there are just two, the second
    /// needs no choice. Points are those of a reference, or the vertices of a curve.
    ///
    /// # Errors
    /// [`EditError::NoSuchCurve`] if the document lacks a curve.
    pub fn choose(
        document: &Document,
        inputs: Inputs,
        active: Option<CurveId>,
        others: &[CurveId],
    ) -> Result<Self, OperationError> {
        let curve = active.and_then(|id| document.curve(id).map(|curve| (id, curve)));
        let reference = active.and_then(|id| document.reference(id));
        let mut curves: Vec<CurveId> = curve.map(|(id, _)| id).into_iter().collect();
        match inputs {
            Inputs::None | Inputs::Points | Inputs::References => curves.clear(),
            Inputs::One | Inputs::OneOrNone => {}
            Inputs::Two | Inputs::UpToTwo => curves.extend(others),
        }
        if let (Inputs::Two, [only]) = (inputs, &curves[..]) {
            let rest: Vec<CurveId> = document.ids().filter(|id| id != only).collect();
            curves.extend(rest.first().filter(|_| rest.len() == 1));
        }
        let operands = Self::new(document, curves)?;
        let operands = operands.with_reference(reference.map(|it| it.curve.clone()));
        let points = match (inputs, reference, curve) {
            (Inputs::Points, Some(reference), _) => reference.points(),
            (Inputs::Points, None, Some((_, curve))) => Some(curve.polygon.vertices().to_vec()),
            _ => None,
        };
        let group = active.filter(|_| inputs != Inputs::None);
        let group = group.and_then(|id| document.group(id));
        Ok(Self {
            group: group.cloned().unwrap_or_default(),
            weights: reference.and_then(|it| it.weights()).map(<[f64]>::to_vec),
            chosen_reference: active.filter(|_| reference.is_some()),
            ..operands.with_points(points.unwrap_or_default())
        })
    }

    /// Let an operation run on other items too, each by itself, or tell of each why it cannot.
    pub fn with_beside(self, beside: Vec<(CurveId, Result<Operands, OperationError>)>) -> Self {
        let others = beside
            .iter()
            .filter(|(_, it)| it.is_ok())
            .map(|(id, _)| *id);
        let together: Arc<BTreeSet<CurveId>> = Arc::new(others.chain(self.item()).collect());
        let beside = beside.into_iter().map(|(id, it)| {
            let together = together.clone();
            (id, it.map(|it| Self { together, ..it }))
        });
        Self {
            beside: beside.collect(),
            together,
            ..self
        }
    }

    /// The other items that an operation runs on, each by itself, or why it cannot.
    pub fn beside(&self) -> &[(CurveId, Result<Operands, OperationError>)] {
        &self.beside
    }

    /// The curve that comes first, or the reference that was chosen.
    pub fn item(&self) -> Option<CurveId> {
        let curve = self.curves.first().map(|(id, _)| *id);
        curve.or(self.chosen_reference)
    }

    /// Whether an operation runs on a curve or a reference too, at the same time.
    pub(super) fn goes_along(&self, item: CurveId) -> bool {
        self.together.contains(&item)
    }

    /// Whether an operation runs on several items at once.
    pub(super) fn has_others(&self) -> bool {
        self.together.len() > 1
    }

    /// List the curves that were chosen, with those beside.
    pub fn all_curves(&self) -> impl Iterator<Item = &(CurveId, Arc<Curve>)> {
        let beside = self.beside.iter().filter_map(|(_, it)| it.as_ref().ok());
        let beside = beside.flat_map(|it| it.curves.iter());
        self.curves.iter().chain(beside)
    }

    /// Add a table of points with finite coordinates.
    pub fn with_points(self, points: Vec<DVec3>) -> Self {
        Self { points, ..self }
    }

    /// Offer a reference, for operations that take one.
    pub fn with_reference(self, reference: Option<ReferenceCurve>) -> Self {
        Self { reference, ..self }
    }

    /// The reference that is offered.
    pub fn reference(&self) -> Option<&ReferenceCurve> {
        self.reference.as_ref()
    }

    /// The reference that was chosen, for operations on references.
    pub fn chosen_reference(&self) -> Option<CurveId> {
        self.chosen_reference
    }

    /// The document as it is before the operation.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The curves that were chosen.
    pub fn curves(&self) -> &[(CurveId, Arc<Curve>)] {
        &self.curves
    }

    /// The points of the table.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// How much each point counts, if they differ.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The group of a curve that is made: that of the reference it is made of, of the document's first that
    /// is the same curve, or else that of the operand that comes first.
    pub(super) fn group(&self, made_of: Option<&ReferenceCurve>) -> Group {
        let Some(made_of) = made_of else {
            return self.group.clone();
        };
        let mut references = self.document.references();
        let found = references.find(|(_, reference)| reference.curve == *made_of);
        found.map_or_else(Group::default, |(_, reference)| reference.group.clone())
    }

    /// Whether it is what an operation wants.
    pub(super) fn is(&self, inputs: Inputs) -> bool {
        let (curves, points) = (&self.curves[..], self.points.len());
        match (inputs, curves) {
            (Inputs::None | Inputs::OneOrNone | Inputs::UpToTwo | Inputs::References, []) => {
                points == 0
            }
            (Inputs::One | Inputs::OneOrNone | Inputs::UpToTwo, [_]) => points == 0,
            (Inputs::Two | Inputs::UpToTwo, [(first, _), (second, _)]) => {
                first != second && points == 0
            }
            (Inputs::Points, []) => points > 0,
            _ => false,
        }
    }

    /// The first curve that was chosen.
    ///
    /// # Errors
    /// [`OperationError::Inputs`] if none was.
    pub fn curve(&self) -> Result<(CurveId, &Curve), OperationError> {
        let needed = Inputs::One;
        let first = self.curves.first();
        let (id, curve) = first.ok_or(OperationError::Inputs { needed })?;
        Ok((*id, curve))
    }

    /// The polygon of the first curve that was chosen.
    ///
    /// # Errors
    /// As [`Operands::curve`].
    pub fn polygon(&self) -> Result<&FloatPolygon, OperationError> {
        Ok(&self.curve()?.1.polygon)
    }
}
