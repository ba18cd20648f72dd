//! Batten's own project file: JSON, with every number exactly as it is.
//!
//! ```json
//! {"format": "batten", "version": 1, "curves": [
//!   {"name": "arc", "degree": 9, "polygon": "float", "vertices": [[0.0, 1.0], …],
//!    "weights": null, "periodic": false}]}
//! ```
//!
//! A project is written in the first version that holds all of it, so that older programs read what
//! they can read. Version 2 adds `locked_vertices` to a curve, the path of a `group`
//! to a curve and to a reference ("Deck/Port"; `\/` stands for a `/` within a name), `curvature`, `normal` and `slope` to a
//! target, and `matches`, `references`, the `unit` of length ("mm", "cm", "m" or "in"; left out if there
//! is none) and `numbers` to the project. These number its curves, then its references, in the order in
//! which they were made: the next colour of the palette goes by them. Without them they are counted
//! from 0. `guides` are the places of guide lines by coordinate, as in `{"x": [12.5], "y": [0.0, 80.0]}`. In a file of version 1 these keys are unknown ones.

use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde_json::Value;
use serde_path_to_error::{Path, Segment};

use super::error::{Place, Problem, ReadError, WriteError};
use super::format::{FileUnit, Format, Writing};
use super::json_layout;
use super::loss::LossReport;
use super::object::Version;
use super::project_file::{FORMAT, ProjectFile, Version1, Version2, WrittenProject};
use super::reading::Reading;
use super::text::text;
use crate::document::{Document, escaped};

/// The row of the table of formats.
pub static PROJECT: Format = Format {
    name: "Batten project",
    extensions: &["batten"],
    read: Some(read),
    write: Some(write),
    write_back: None,
    rewrite: None,
    read_chosen: None,
    draw: None,
    file_unit: FileUnit::Optional,
    holds_documents: true,
    exports: &[],
};

/// Read a project.
///
/// `polygon` may be float (also if it is not given), clamped or bezier; `weights`, `periodic`,
/// `group`, `colour`, `visible`, `locked`, `locked_vertices` and `targets` may be left out. Further keys have no effect; those
/// of the project and of its curves are kept.
///
/// # Errors
/// [`ReadError`] with line and column for JSON that is malformed or has something else than
/// belongs there, and with curve and vertex for numbers that make no curve.
fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    let text = text(bytes)?;
    if !text.trim_start().starts_with('{') {
        if text.trim_start().starts_with('[') {
            // Other JSON that is malformed has a place to tell.
            parse::<IgnoredAny>(text)?;
        }
        return Err(Problem::WrongFormat { found: None }.into());
    }
    match parse::<Header>(text) {
        Ok(Header { format, version }) => match check(&format, &version)? {
            Version1::NUMBER => parse::<ProjectFile<Version1>>(text)?.into_reading(),
            _ => parse::<ProjectFile<Version2>>(text)?.into_reading(),
        },
        // A malformed file has no version to rely on: the types of the first tell the place.
        Err(error) => Err(parse::<ProjectFile<Version1>>(text).err().unwrap_or(error)),
    }
}

/// Write a document with each curve held by one of its polygons (default: float, which loses nothing).
fn write(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    let project = WrittenProject::of(document, writing.polygon.unwrap_or_default(), losses);
    Ok(json_layout::to_text(&project).into_bytes())
}

/// What every version has, however the rest of it looks.
#[derive(Deserialize)]
struct Header {
    #[serde(default)]
    format: Value,
    #[serde(default)]
    version: Value,
}

/// Check that the file is a project, and return the number of its version.
fn check(format: &Value, version: &Value) -> Result<u64, Problem> {
    let shown = |value: &Value| (!value.is_null()).then(|| value.to_string());
    if format != FORMAT {
        let found = shown(format);
        return Err(Problem::WrongFormat { found });
    }
    let newest = Version2::NUMBER;
    match version.as_u64() {
        Some(found) if (1..=newest).contains(&found) => Ok(found),
        Some(found) if found > newest => Err(Problem::NewerVersion { found, newest }),
        _ => Err(Problem::BadVersion {
            found: shown(version).unwrap_or("not given".to_owned()),
        }),
    }
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
            Segment::Seq { index } if key == "references" && place.reference.is_none() => {
                place.reference = Some(index + 1);
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
            let message = message.trim_end_matches(&suffix);
            // What serde calls a number.
            let message = match message.strip_suffix("expected f64") {
                Some(start) => format!("{start}expected a number"),
                None => message.to_owned(),
            };
            Problem::Json(shortened(&message))
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
mod references;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod unknown_keys;
