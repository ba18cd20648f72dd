//! Batten's own project file: JSON, with every number exactly as it is.
//!
//! ```json
//! {"format": "batten", "version": 1, "curves": [
//!   {"name": "arc", "degree": 9, "polygon": "float", "vertices": [[0.0, 1.0], …],
//!    "weights": null, "periodic": false}]}
//! ```
//!
//! Each version has types of its own, so that a change of the curves in memory cannot change
//! what old files mean. A project is written in the first version that holds all of it, so that
//! older programs read what they can read: version 2 adds `locked_vertices` to a curve,
//! `curvature`, `normal` and `slope` to a target, and `matches`, `references`, the `unit` of length ("mm", "cm",
//! "m" or "in"; left out if there is none) and `numbers` to the project. These number its curves, then its references,
//! in the order in which they were made: the next colour of the palette goes by them. Without them they are counted
//! from 0.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};

use super::error::{Place, Problem, ReadError};
use super::file_match::FileMatch;
use super::format::Format;
use super::json_layout;
use super::loss::{Export, LossReport};
use super::project_curves::FORMAT;
use super::reading::Reading;
use super::text::text;
use super::{project_v1, project_v2};
use crate::document::{Curve, Extras, Reference, escaped};
use crate::geometry::PolygonKind;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::expressions::LengthUnit;

/// Read a project.
///
/// `polygon` may be float (also if it is not given), clamped or bezier; `weights`, `periodic`,
/// `colour`, `visible`, `locked`, `locked_vertices` and `targets` may be left out. Further keys have no effect; those
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
    match parse::<Header>(text) {
        Ok(Header { format, version }) => match check(&format, &version)? {
            Version::One => parse::<project_v1::Project>(text)?.into_reading(),
            Version::Two => parse::<project_v2::Project>(text)?.into_reading(),
        },
        // What is malformed has no version that could be relied on: the first one's types tell the
        // place.
        Err(error) => Err(parse::<project_v1::Project>(text).err().unwrap_or(error)),
    }
}

/// Write a project with each curve held by one of its polygons; by the float polygon nothing is
/// lost. `matches` are those between the curves and references, `unit`, `numbers` and `extras` those of the project.
pub fn write(
    curves: &[&Curve],
    references: &[&Reference],
    matches: &[FileMatch],
    (unit, numbers, extras): (Option<LengthUnit>, &[u64], &Extras),
    kind: PolygonKind,
) -> Export {
    let mut losses = LossReport::new(Format::Batten);
    let numbers = if is_counted(numbers) { &[] } else { numbers };
    let needs_version_2 = unit.is_some()
        || !numbers.is_empty()
        || !matches.is_empty()
        || !references.is_empty()
        || curves.iter().any(|curve| needs_version_2(curve));
    let bytes = if needs_version_2 {
        let content = (curves, references, matches);
        let project =
            project_v2::Project::from_content(content, (unit, numbers, extras), kind, &mut losses);
        json_layout::to_text(&project).into_bytes()
    } else {
        let project = project_v1::Project::from_curves(curves, extras, kind, &mut losses);
        json_layout::to_text(&project).into_bytes()
    };
    Export { bytes, losses }
}

/// Whether numbers count from 0.
fn is_counted(numbers: &[u64]) -> bool {
    (0..).zip(numbers).all(|(place, number)| place == *number)
}

/// Whether a curve has something that version 1 cannot hold.
fn needs_version_2(curve: &Curve) -> bool {
    let targets = curve.targets.list().into_iter();
    let mut targets = targets.map(|(_, target)| target);
    let of_version_1 = |EndTarget {
                            point, direction, ..
                        }| EndTarget {
        point,
        direction,
        ..EndTarget::default()
    };
    !curve.locked_vertices.is_empty() || targets.any(|target| of_version_1(target) != target)
}

/// What every version has, however the rest of it looks.
#[derive(Deserialize)]
struct Header {
    #[serde(default)]
    format: Value,
    #[serde(default)]
    version: Value,
}

/// A version that can be read.
enum Version {
    One,
    Two,
}

fn check(format: &Value, version: &Value) -> Result<Version, Problem> {
    let shown = |value: &Value| (!value.is_null()).then(|| value.to_string());
    if format != FORMAT {
        let found = shown(format);
        return Err(Problem::WrongFormat { found });
    }
    match version.as_u64() {
        Some(project_v1::VERSION) => Ok(Version::One),
        Some(project_v2::VERSION) => Ok(Version::Two),
        Some(found) if found > project_v2::VERSION => Err(Problem::NewerVersion {
            found,
            newest: project_v2::VERSION,
        }),
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
