//! Merging documents: one rule for their units, wherever two of them meet.

use std::fmt;

use thiserror::Error;

use super::curve::CurveId;
use super::document::Document;
use super::edit::Edit;
use super::end_match::EndMatch;
use super::error::EditError;
use crate::geometry::expressions::LengthUnit;

/// The edits that add another document to one, and what happens to its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Merge {
    /// The edits, for the receiving document.
    pub edits: Vec<Edit>,
    /// What happens to the incoming numbers, where that is not obvious.
    pub remark: Option<UnitRemark>,
}

/// The effect of a merge on the incoming numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitRemark {
    /// They are converted, so that everything keeps its size.
    Converted {
        /// The unit they come in.
        from: LengthUnit,
        /// The receiving document's unit.
        to: LengthUnit,
    },
    /// They come without a unit, and count in the receiving document's.
    Counted(LengthUnit),
}

/// A reason why documents cannot be merged.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MergeError {
    /// The incoming document states a unit and the receiving one, which is not empty, none.
    #[error("the curves to add are in {}, the document states no unit: choose the document's unit", .incoming.name())]
    NoUnit {
        /// The unit of the incoming document.
        incoming: LengthUnit,
    },
    /// The incoming numbers cannot be converted, or a match not be added.
    #[error(transparent)]
    Edit(#[from] EditError),
}

impl Document {
    /// Find the edits that add everything in another document behind what this one holds, in this one's unit.
    ///
    /// Where both units are known, numbers are converted. An empty document without a unit takes the incoming one.
    /// Incoming numbers without a unit count in this document's. `assumed` is the unit of whichever of the two
    /// states none.
    ///
    /// # Errors
    /// [`MergeError::NoUnit`] if only the incoming unit is known, this document is not empty, and none is assumed;
    /// [`MergeError::Edit`] if numbers get too large or too small.
    pub fn merging(
        &self,
        incoming: &Self,
        assumed: Option<LengthUnit>,
    ) -> Result<Merge, MergeError> {
        if incoming.is_empty() {
            return Ok(Merge {
                edits: Vec::new(),
                remark: None,
            });
        }
        let stated = incoming.unit().or(assumed);
        let own = match self.is_empty() {
            true => self.unit().or(stated),
            false => self.unit().or(assumed),
        };
        let (converted, remark) = match (own, stated) {
            (None, Some(incoming)) => return Err(MergeError::NoUnit { incoming }),
            (Some(to), Some(from)) if from != to => {
                let convert = [Edit::SetUnit(Some(from)), Edit::ConvertUnit(to)];
                let remark = UnitRemark::Converted { from, to };
                (incoming.edited(convert)?, Some(remark))
            }
            (Some(unit), None) => (incoming.clone(), Some(UnitRemark::Counted(unit))),
            _ => (incoming.clone(), None),
        };
        let unit = (own != self.unit()).then_some(Edit::SetUnit(own));
        let mut edits: Vec<Edit> = unit.into_iter().collect();
        edits.extend(self.additions(&converted));
        Ok(Merge { edits, remark })
    }

    /// The edits that add the curves, references, matches and guide lines of another document with their numbers as they are.
    fn additions(&self, other: &Self) -> Vec<Edit> {
        let old: Vec<CurveId> = other.all_ids().collect();
        let new: Vec<CurveId> = self.next_ids().take(old.len()).collect();
        let new_id = |id: CurveId| {
            let place = old.iter().position(|old| *old == id)?;
            new.get(place).copied()
        };
        let curves = other.curves();
        let curves = curves.map(|(_, curve)| Edit::Add(Box::new(curve.as_ref().clone())));
        let references = other.references();
        let references =
            references.map(|(_, it)| Edit::AddReference(Box::new(it.as_ref().clone())));
        let matches = other.matches().filter_map(|matched| {
            Some(Edit::SetMatch(EndMatch {
                curve: new_id(matched.curve)?,
                source: new_id(matched.source)?,
                ..*matched
            }))
        });
        let lines = [self.guide_lines(), other.guide_lines()].concat();
        let lines = (!other.guide_lines().is_empty()).then_some(Edit::SetGuideLines(lines));
        curves
            .chain(references)
            .chain(matches)
            .chain(lines)
            .collect()
    }
}

impl fmt::Display for UnitRemark {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Converted { from, to } => {
                write!(formatter, "converted from {} to {}", from.name(), to.name())
            }
            Self::Counted(unit) => {
                let unit = unit.name();
                write!(formatter, "no unit given: the numbers count in {unit}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::FloatPolygon;

    const MM: Option<LengthUnit> = Some(LengthUnit::Millimetre);
    const INCH: Option<LengthUnit> = Some(LengthUnit::Inch);

    fn document(unit: Option<LengthUnit>) -> Document {
        let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0)]);
        let curve = Curve::new("arc", polygon.expect("a polygon"));
        Document::from_curves([curve]).with_unit(unit)
    }

    /// The unit of the merged document, the abscissa of the last vertex that was added, and the remark.
    fn merged(
        receiving: &Document,
        incoming: Option<LengthUnit>,
        assumed: Option<LengthUnit>,
    ) -> Result<(Option<LengthUnit>, f64, Option<UnitRemark>), MergeError> {
        let merge = receiving.merging(&document(incoming), assumed)?;
        let merged = receiving.edited(merge.edits)?;
        let (_, last) = merged.curves().last().expect("a curve");
        let x = last.polygon.vertex(2).x;
        Ok((merged.unit(), x, merge.remark))
    }

    #[test]
    fn numbers_are_converted_where_both_units_are_known() {
        let (from, to) = (LengthUnit::Inch, LengthUnit::Millimetre);
        let remark = UnitRemark::Converted { from, to };
        assert_eq!(
            merged(&document(MM), INCH, None),
            Ok((MM, 50.8, Some(remark)))
        );
        assert_eq!(merged(&document(MM), MM, None), Ok((MM, 2.0, None)));
        let empty = Document::default().with_unit(MM);
        assert_eq!(merged(&empty, INCH, None), Ok((MM, 50.8, Some(remark))));
    }

    #[test]
    fn an_empty_document_takes_the_unit_and_any_other_asks() {
        assert_eq!(
            merged(&Document::default(), INCH, None),
            Ok((INCH, 2.0, None))
        );
        let incoming = LengthUnit::Inch;
        let refused = Err(MergeError::NoUnit { incoming });
        assert_eq!(merged(&document(None), INCH, None), refused);
        let (from, to) = (LengthUnit::Inch, LengthUnit::Millimetre);
        let remark = UnitRemark::Converted { from, to };
        assert_eq!(
            merged(&document(None), INCH, MM),
            Ok((MM, 50.8, Some(remark)))
        );
    }

    #[test]
    fn numbers_without_a_unit_count_in_the_documents() {
        let remark = UnitRemark::Counted(LengthUnit::Millimetre);
        assert_eq!(
            merged(&document(MM), None, None),
            Ok((MM, 2.0, Some(remark)))
        );
        assert_eq!(merged(&document(None), None, None), Ok((None, 2.0, None)));
        let (from, to) = (LengthUnit::Inch, LengthUnit::Millimetre);
        let remark = UnitRemark::Converted { from, to };
        assert_eq!(
            merged(&document(MM), None, INCH),
            Ok((MM, 50.8, Some(remark)))
        );
    }

    #[test]
    fn nothing_changes_where_nothing_is_added() {
        let merge = document(MM).merging(&Document::default().with_unit(INCH), None);
        let edits = Vec::new();
        assert_eq!(
            merge,
            Ok(Merge {
                edits,
                remark: None
            })
        );
    }
}
