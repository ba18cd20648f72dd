//! `batten list`: what a file of another program holds, as JSON.

use std::path::Path;

use serde::Serialize;

use super::output::{self, OneByOne};
use crate::geometry::expressions::LengthUnit;
use crate::io::exchange::drawing::{Item, Shape, Space};
use crate::io::exchange::import::FoundRow;
use crate::io::{Format, disk};

/// The names of units that Batten itself does not have, by their millimetres.
const OTHER_UNITS: [(&str, f64); 8] = [
    ("nm", 1e-6),
    ("µm", 1e-3),
    ("mil", 0.0254),
    ("dm", 100.0),
    ("ft", 304.8),
    ("yd", 914.4),
    ("km", 1e6),
    ("mi", 1_609_344.0),
];

/// Units that differ by less than this share are one.
const SAME: f64 = 1e-9;

/// The items that are listed beside the free ones.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Listed {
    /// Edges of solids and boundaries of surfaces.
    pub(super) edges: bool,
    /// Layouts for printing.
    pub(super) paper: bool,
}

/// The printed list.
#[derive(Serialize)]
#[serde(bound = "")]
struct List<'d, R: Iterator<Item = ListedRow>, I: Iterator<Item = ListedItem>> {
    format: &'static str,
    unit: Option<String>,
    rows: OneByOne<R>,
    items: OneByOne<I>,
    other: Vec<ListedOther>,
    remarks: &'d [String],
}

#[derive(Serialize)]
struct ListedItem {
    kind: &'static str,
    degree: Option<usize>,
    rational: bool,
    periodic: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices: Option<usize>,
    group: String,
    name: Option<String>,
    block: Option<String>,
    /// Whether the file hides it, or its layer.
    hidden: bool,
    /// Whether it becomes a float polygon exactly.
    curve: bool,
}

/// The items of one kind on one layer.
#[derive(Serialize)]
struct ListedRow {
    layer: String,
    kind: &'static str,
    count: usize,
    degrees: Vec<usize>,
    rational: usize,
    periodic: usize,
    hidden: usize,
    /// The corners of the box around them, in the unit of the file.
    bounds: Option<[[f64; 3]; 2]>,
}

#[derive(Serialize)]
struct ListedOther {
    kind: String,
    count: usize,
    /// The line or, of a binary file, the byte of the first.
    at: u64,
}

/// Print what a file holds.
///
/// # Errors
/// If nothing in it can be read, with the place.
pub(super) fn run(
    file: &Path,
    format: Option<&'static Format>,
    listed: Listed,
) -> anyhow::Result<()> {
    let (drawing, format) = disk::draw_file(file, format)?;
    let is_listed = |space: Space| match space {
        Space::Model => true,
        Space::Paper => listed.paper,
        Space::Edge => listed.edges,
    };
    let found = drawing.found();
    let rows = found.rows.iter().filter(|row| is_listed(row.key.space));
    let items = drawing.items.iter().zip(&found.curves);
    let items = items.filter(|(item, _)| is_listed(item.space));
    let others = drawing.other.iter().map(|other| ListedOther {
        kind: other.kind.clone(),
        count: other.count,
        at: other.at,
    });
    output::print_json(&List {
        format: format.name,
        unit: drawing.unit.map(unit_name),
        rows: OneByOne::new(rows.map(ListedRow::of)),
        items: OneByOne::new(items.map(|(item, is_curve)| ListedItem::of(item, *is_curve))),
        other: others.collect(),
        remarks: &found.remarks,
    })
}

impl ListedRow {
    fn of(row: &FoundRow) -> Self {
        Self {
            layer: row.key.layer.join("/"),
            kind: row.key.kind.name(),
            count: row.count,
            degrees: row.degrees.clone(),
            rational: row.rational,
            periodic: row.periodic,
            hidden: row.hidden,
            bounds: row.bounds.map(|corners| corners.map(|it| it.to_array())),
        }
    }
}

impl ListedItem {
    fn of(item: &Item, is_curve: bool) -> Self {
        let splines = || item.shapes.iter().filter_map(Shape::nurbs);
        let is_conic = |shape: &Shape| matches!(shape, Shape::Conic(_));
        let points: usize = splines().map(|nurbs| nurbs.points.len()).sum();
        let vertices: usize = item.shapes.iter().filter_map(Shape::corners).sum();
        Self {
            kind: item.kind.name(),
            degree: splines().map(|nurbs| nurbs.degree).max(),
            rational: splines().any(|nurbs| nurbs.weights.is_some())
                || (splines().next().is_some() && item.shapes.iter().any(is_conic)),
            periodic: splines().any(|nurbs| nurbs.periodic),
            points: (points > 0).then_some(points),
            vertices: (vertices > 0).then_some(vertices),
            group: item.group.join("/"),
            name: item.name.clone(),
            block: item.block.as_deref().map(str::to_owned),
            hidden: item.hidden,
            curve: is_curve,
        }
    }
}

/// The name of a unit of so many millimetres; the number with "mm" if it has none.
fn unit_name(millimetres: f64) -> String {
    let own = LengthUnit::ALL.map(|unit| (unit.symbol(), unit.millimetres()));
    let mut all = own.into_iter().chain(OTHER_UNITS);
    let found = all.find(|(_, length)| (length / millimetres - 1.0).abs() <= SAME);
    found.map_or_else(|| format!("{millimetres} mm"), |(name, _)| name.to_owned())
}
