//! Batten's own project file: JSON, with every number exactly as it is.
//!
//! ```json
//! {"format": "batten", "version": 1, "curves": [
//!   {"name": "arc", "degree": 9, "polygon": "float", "vertices": [[0.0, 1.0], …],
//!    "weights": null, "periodic": false}]}
//! ```
//!
//! Each version has types of its own, so that a change of the curves in memory cannot change
//! what old files mean.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};

use super::error::{Place, Problem, ReadError};
use super::format::Format;
use super::loss::{Export, LossReport};
use super::object::Object;
use super::reading::Reading;
use super::{json_layout, project_v1};
use crate::document::{Curve, Extras, escaped};
use crate::geometry::PolygonKind;

/// What a file says to be a project.
pub(super) const FORMAT: &str = "batten";

/// The newest version, which is the one written.
pub(super) const VERSION: u64 = 1;

/// Read a project.
///
/// `polygon` may be float (also if it is not given), clamped or bezier; `weights`, `periodic`,
/// `colour`, `visible`, `locked` and `targets` may be left out. Further keys have no effect; those
/// of the project and of its curves are kept.
///
/// # Errors
/// [`ReadError`] with line and column for JSON that is malformed or has something else than
/// belongs there, and with curve and vertex for numbers that make no curve.
pub fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    let text = text(bytes)?;
    if !text.trim_start().starts_with('{') {
        return Err(Problem::WrongFormat { found: None }.into());
    }
    let header: Header = parse(text).map_err(|error| {
        // The types of the version know in which curve the JSON is malformed.
        let located = parse::<project_v1::Project>(text).err();
        located
            .filter(|located| located.place.line == error.place.line)
            .unwrap_or(error)
    })?;
    if header.format != Some(Value::from(FORMAT)) {
        let found = header.format.map(|format| format.to_string());
        return Err(Problem::WrongFormat { found }.into());
    }
    match header.version.as_ref().and_then(Value::as_u64) {
        Some(1) => parse::<project_v1::Project>(text)?.into_reading(),
        Some(found) if found > VERSION => Err(Problem::NewerVersion {
            found,
            newest: VERSION,
        }
        .into()),
        _ => Err(Problem::BadVersion {
            found: header
                .version
                .map_or("not given".to_owned(), |version| version.to_string()),
        }
        .into()),
    }
}

/// Write a project with each curve held by one of its polygons; by the float polygon nothing is
/// lost. `extras` are those of the project.
pub fn write(curves: &[&Curve], extras: &Extras, kind: PolygonKind) -> Export {
    let mut losses = LossReport::new(Format::Batten);
    let project = Object {
        value: project_v1::WrittenProject::from_curves(curves, kind, &mut losses),
        extras: extras.clone(),
    };
    Export {
        bytes: json_layout::to_text(&project).into_bytes(),
        losses,
    }
}

/// Take a file's bytes as text, without the mark that some editors put before it.
///
/// # Errors
/// [`Problem::Empty`] or [`Problem::NotUtf8`].
pub(super) fn text(bytes: &[u8]) -> Result<&str, ReadError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        let line_start = valid.iter().rposition(|byte| *byte == b'\n');
        let place = Place {
            line: Some(1 + valid.iter().filter(|byte| **byte == b'\n').count()),
            column: Some(valid.len() - line_start.map_or(0, |start| start + 1) + 1),
            ..Place::default()
        };
        place.problem(Problem::NotUtf8)
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Problem::Empty.into());
    }
    Ok(text)
}

/// What every version has, however the rest of it looks.
#[derive(Deserialize)]
#[serde(expecting = "a Batten project, which is a JSON object")]
struct Header {
    #[serde(default)]
    format: Option<Value>,
    #[serde(default)]
    version: Option<Value>,
}

fn parse<T: DeserializeOwned>(text: &str) -> Result<T, ReadError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|error| located(text, error.path(), error.inner()))?;
    let end = deserializer.end();
    end.map_err(|error| json_problem(text, Place::default(), &error))?;
    Ok(value)
}

fn located(text: &str, path: &Path, error: &serde_json::Error) -> ReadError {
    let mut place = Place::default();
    let mut key = "";
    for segment in path.iter() {
        match segment {
            Segment::Map { key: name } => key = name,
            Segment::Seq { index } if key == "curves" && place.curve.is_none() => {
                place.curve = Some(index + 1);
            }
            Segment::Seq { index }
                if ["vertices", "weights"].contains(&key) && place.vertex.is_none() =>
            {
                place.vertex = Some(*index);
            }
            _ => {}
        }
    }
    json_problem(text, place, error)
}

fn json_problem(text: &str, mut place: Place, error: &serde_json::Error) -> ReadError {
    place.line = Some(error.line());
    place.column = Some(error.column());
    let problem = match token(text, error.line(), error.column()) {
        Some(token) => Problem::NotFinite(token.to_owned()),
        None => {
            // The place is said in front, so it need not be said again.
            let suffix = format!(" at line {} column {}", error.line(), error.column());
            let message = error.to_string();
            Problem::Json(shortened(message.trim_end_matches(&suffix)))
        }
    };
    place.problem(problem)
}

/// Cut a message in its middle, where it repeats a long text of the file: it begins with what is
/// wrong and ends with what is needed.
fn shortened(message: &str) -> String {
    const LONGEST: usize = 200;
    let count = message.chars().count();
    if count <= LONGEST {
        return escaped(message);
    }
    let start: String = message.chars().take(LONGEST / 2).collect();
    let end: String = message.chars().skip(count - LONGEST / 2).collect();
    format!("{}…{}", escaped(&start), escaped(&end))
}

/// Find a number at a place that JSON cannot hold, such as NaN, -Infinity or 1e999.
fn token(text: &str, line: usize, column: usize) -> Option<&str> {
    let line = text.split('\n').nth(line.checked_sub(1)?)?;
    let belongs = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.".contains(byte);
    let bytes = line.as_bytes();
    let inside = column.checked_sub(1)?.min(bytes.len());
    let before = bytes[..inside]
        .iter()
        .rev()
        .take_while(|byte| belongs(byte));
    let after = bytes[inside..].iter().take_while(|byte| belongs(byte));
    let token = line.get(inside - before.count()..inside + after.count())?;
    let number: f64 = token.parse().ok()?;
    (!number.is_finite()).then_some(token)
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod unknown_keys;
