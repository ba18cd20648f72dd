//! Points in the tables of solvers and scanners: a title, then a line of blanks and numbers for each point.
//!
//! ```text
//! NACA 0012
//!   1.0  0.00126
//!   0.95 0.00807
//! ```
//!
//! A blank line divides several lists. They are read as every [table](super::table) is.

use glam::DVec3;

use super::error::WriteError;
use super::format::{FileUnit, Format, Writing};
use super::loss::LossReport;
use super::table;
use super::table_header::TableHeader;
use super::table_points::is_title;
use crate::document::{Document, Reference};

/// The row of the table of formats.
pub static POINT_TABLE: Format = Format {
    name: "point table",
    extensions: &["dat", "txt", "xyz", "pts", "asc", "xy"],
    read: Some(table::read),
    read_chosen: Some(table::read_chosen),
    draw: None,
    write: Some(write),
    write_back: None,
    rewrite: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[],
};

/// Write references that are points, each below its name. Numbers keep all digits.
///
/// # Errors
/// [`WriteError::NoPoints`].
fn write(document: &Document, _: &Writing, losses: &mut LossReport) -> Result<Vec<u8>, WriteError> {
    // Rows of a file have one number of columns.
    let mut all = document.references().filter_map(|(_, it)| it.points());
    let planar = all.all(|points| points.iter().all(|it| it.z == 0.0));
    let columns = if planar { 2 } else { 3 };
    let mut lists = Vec::new();
    for (_, curve) in document.curves() {
        losses.add_curve(curve);
    }
    for (_, reference) in document.references() {
        match reference.points() {
            Some(points) => {
                lists.push(list(reference, &points, columns));
                losses.add_list(reference);
            }
            None => losses.add_reference(reference),
        }
    }
    if lists.is_empty() {
        let format = POINT_TABLE.name;
        return Err(WriteError::NoPoints { format });
    }
    let unit = document.unit().map(table::unit_line).unwrap_or_default();
    Ok((unit + &lists.join("\n")).into_bytes())
}

fn list(reference: &Reference, points: &[DVec3], columns: usize) -> String {
    let texts: Vec<[String; 3]> = points
        .iter()
        .map(|point| point.to_array().map(|value| format!("{value:?}")))
        .collect();
    let width = texts
        .iter()
        .flatten()
        .map(String::len)
        .max()
        .unwrap_or_default();
    let rows = texts.iter().map(|row| {
        let row = row[..columns]
            .iter()
            .map(|text| format!("  {text:<width$}"));
        format!("{}\n", row.collect::<String>().trim_end())
    });
    format!("{}\n{}", title(&reference.name), rows.collect::<String>())
}

/// The name as a title; as a line with # where it would not be read as one.
fn title(name: &str) -> String {
    if is_title(name) {
        return name.to_owned();
    }
    TableHeader {
        curve: None,
        name: Some(name.to_owned()),
    }
    .to_line()
}
