//! A report as JSON: one schema for all operations.

use std::collections::BTreeMap;

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::json;

use super::outcome::Deviation;
use super::report::Report;
use super::value::Value;
use crate::geometry::approximation::LevelComparison;

impl Serialize for Report {
    /// Write the keys `operation`, `reached`, `residual`, `deviation` (0 where the curve is the
    /// same, null where it is another and the distance is not measured), `deviation_is` (`exact`, `bounded`, which is
    /// proved, `sampled`, or of points `measured`; null with the deviation), `largest_move`,
    /// `features_before`, `features_after` (counts and `harmony` of each curve; null where they are not
    /// proved), `remarks`, and the
    /// operation's own figures under their names, angles in degrees; of approximations `equivalence`, a
    /// list of the levels of curvature and torsion with whether they are equal.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("operation", self.name)?;
        map.serialize_entry("reached", &self.reached)?;
        map.serialize_entry("residual", &self.residual)?;
        map.serialize_entry("deviation", &self.moved())?;
        map.serialize_entry("deviation_is", &kind(self.deviation))?;
        map.serialize_entry("largest_move", &self.largest_move)?;
        let features = self.features.as_ref();
        let before = features.map(|features| &features.before);
        map.serialize_entry("features_before", &before)?;
        let after = features.map(|features| &features.after);
        map.serialize_entry("features_after", &after)?;
        for figure in &self.figures {
            let value = match &figure.value {
                Value::Whole(count) | Value::Choice(count) => json!(count),
                Value::Real(number) => json!(figure.quantity.shown(*number)),
                Value::Switch(on) => json!(on),
                Value::List(numbers) => json!(numbers),
                Value::Indices(indices) => json!(indices),
                Value::Table { columns, rows } => {
                    let row = |row: &Vec<f64>| {
                        let cells = columns.iter().zip(row).map(|(name, it)| (*name, cell(*it)));
                        cells.collect::<BTreeMap<_, _>>()
                    };
                    json!(rows.iter().map(row).collect::<Vec<_>>())
                }
                Value::Word(word) => json!(word),
                Value::Ends([first, second]) => {
                    json!({ "first": first.name(), "second": second.name() })
                }
                Value::Reference(reference) => {
                    json!(reference.as_ref().map(|reference| reference.to_string()))
                }
            };
            map.serialize_entry(figure.name, &value)?;
        }
        if let Some(levels) = &self.equivalence {
            let levels: Vec<_> = levels.iter().map(level).collect();
            map.serialize_entry("equivalence", &levels)?;
        }
        let remarks: Vec<&String> = self.warnings.iter().chain(&self.remarks).collect();
        map.serialize_entry("remarks", &remarks)?;
        map.end()
    }
}

/// Name what a deviation is: what holds everywhere, or only where it was looked at.
fn kind(deviation: Deviation) -> Option<&'static str> {
    match deviation {
        Deviation::Exact => Some("exact"),
        Deviation::AtMost(_) => Some("bounded"),
        Deviation::Measured(_) => Some("sampled"),
        Deviation::FromPoints(_) => Some("measured"),
        Deviation::Unmeasured => None,
    }
}

/// Write a number of a table, a whole one without a point.
fn cell(number: f64) -> serde_json::Value {
    match number.fract() == 0.0 && number.abs() < 1e15 {
        true => json!(number as i64),
        false => json!(number),
    }
}

/// Write how a level of two curves compares: below which height nothing is a feature, the features of both in
/// their order, and which of them, counted from 0, is the first that differs.
fn level(level: &LevelComparison) -> serde_json::Value {
    let there = level.there.iter();
    let there = there.map(|(t, feature)| json!({ "t": t, "feature": feature.name() }));
    let here = level.here.iter();
    let here = here.map(|(u, feature)| json!({ "u": u, "feature": feature.name() }));
    json!({
        "of": if level.torsion { "torsion" } else { "curvature" },
        "level": level.level,
        "equal": level.is_equal(),
        "least": level.least,
        "sampled": true,
        "reference": there.collect::<Vec<_>>(),
        "curve": here.collect::<Vec<_>>(),
        "first_difference": level.first_difference(),
    })
}
