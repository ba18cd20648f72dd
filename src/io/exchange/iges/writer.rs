//! The writer: each shape as the entity that holds it exactly.

use std::collections::HashMap;

use glam::{DMat3, DVec3};

use crate::io::exchange::drawing::{
    Affine, Conic, Drawing, Item, Kind, Nurbs, Shape, Space, Unreadable,
};

use super::conic_frame::Frame;
use super::global::UNITS;
use super::links::COLOURS;
use super::sheet::{Entity, Sheet, hollerith, real};
use super::spline_part::{check, end_points, is_finite};

/// Status of what stands alone.
const FREE: &str = "00000000";
/// The same, hidden.
const BLANKED: &str = "01000000";
/// Status of pieces of composite curves.
const PIECE: &str = "00010000";
/// Status of edges: use flag 06, construction geometry.
const EDGE: &str = "00000600";
/// Status of colours and names, which others refer to.
const COLOUR: &str = "00000200";
const PROPERTY: &str = "00010300";

/// Write a drawing as an IGES 5.3 file; `name` becomes the product's name.
///
/// # Errors
/// [`Unreadable`] for a unit that IGES has not, and for items that are damaged; it names the item.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    let millimetres = drawing.unit.unwrap_or(1.0);
    let unit = UNITS
        .iter()
        .find(|unit| unit.2 == millimetres)
        .ok_or_else(|| {
            refusal(format!(
                "IGES has no unit of {millimetres} mm; convert to millimetres first"
            ))
        })?;
    let mut writer = Writer::default();
    writer.number_levels(drawing);
    for (index, item) in drawing.items.iter().enumerate() {
        writer
            .add(item)
            .map_err(|reason| refusal(format!("{}: {reason}", title(index, item))))?;
    }
    writer.sheet.finish(global(drawing, name, unit.0, unit.1))
}

fn refusal(reason: String) -> Unreadable {
    Unreadable { at: None, reason }
}

fn title(index: usize, item: &Item) -> String {
    let name = item
        .name
        .as_ref()
        .map(|name| format!(" \"{name}\""))
        .unwrap_or_default();
    format!("item {} ({}{name})", index + 1, item.kind.name())
}

/// The fields of the global section.
fn global(drawing: &Drawing, name: &str, flag: i64, unit: &str) -> Vec<String> {
    let largest = drawing
        .items
        .iter()
        .flat_map(|item| &item.shapes)
        .fold(0.0_f64, |largest, shape| largest.max(extent(shape)));
    let program = concat!("Batten ", env!("CARGO_PKG_VERSION"));
    let date = "15H20000101.000000";
    let fields = [
        "1H,".to_owned(),
        "1H;".to_owned(),
        hollerith(name),
        hollerith(&format!("{name}.igs")),
        hollerith(program),
        hollerith(program),
        "32".to_owned(),
        "308".to_owned(),
        "15".to_owned(),
        "308".to_owned(),
        "17".to_owned(),
        hollerith(name),
        "1.".to_owned(),
        flag.to_string(),
        hollerith(unit),
        "1".to_owned(),
        "0.01".to_owned(),
        date.to_owned(),
        real(if largest > 0.0 {
            largest * 1.0e-9
        } else {
            1.0e-9
        }),
        real(largest),
        String::new(),
        String::new(),
        // Version 5.3, no drafting standard.
        "11".to_owned(),
        "0".to_owned(),
        date.to_owned(),
    ];
    fields.to_vec()
}

/// The largest coordinate of a shape.
fn extent(shape: &Shape) -> f64 {
    let largest = |points: &[DVec3]| {
        points
            .iter()
            .fold(0.0, |max: f64, it| max.max(it.abs().max_element()))
    };
    match shape {
        Shape::Nurbs(nurbs) => largest(&nurbs.points),
        Shape::Conic(it) => (it.centre.abs() + it.x.abs() + it.y.abs()).max_element(),
        Shape::Polyline { points, .. } => largest(points),
        Shape::Point(point) => largest(&[*point]),
    }
}

#[derive(Default)]
struct Writer {
    sheet: Sheet,
    levels: HashMap<String, usize>,
    /// The numbers of colours other than the eight of the standard.
    colours: HashMap<[u8; 3], usize>,
}

impl Writer {
    /// Number the groups as levels: those that are numbers keep them, the others are named by a property.
    fn number_levels(&mut self, drawing: &Drawing) {
        let paths = drawing.items.iter().filter(|item| !item.group.is_empty());
        let mut named = Vec::new();
        let mut taken = std::collections::HashSet::new();
        for path in paths.map(|item| item.group.join("/")) {
            let number = path
                .parse::<u16>()
                .ok()
                .filter(|it| *it > 0 && it.to_string() == path);
            if let Some(number) = number {
                taken.insert(usize::from(number));
                self.levels.insert(path, usize::from(number));
            } else if self.levels.insert(path.clone(), 0).is_none() {
                named.push(path);
            }
        }
        let mut free = (1..).filter(|number| !taken.contains(number));
        for path in named {
            let level = free.next().unwrap_or_default();
            self.sheet.add(Entity {
                entity: 406,
                form: 3,
                level,
                status: FREE,
                parameters: vec!["2".to_owned(), "0".to_owned(), hollerith(&path)],
                ..Entity::default()
            });
            self.levels.insert(path, level);
        }
    }

    fn add(&mut self, item: &Item) -> Result<(), String> {
        let is_chain = matches!(item.kind, Kind::Polycurve | Kind::Path) || item.shapes.len() > 1;
        let mut entity = match item.shapes.as_slice() {
            [] => return Err("it has no shape".to_owned()),
            [shape] if !is_chain => self.shape(shape, item.kind)?,
            shapes => self.composite(shapes)?,
        };
        entity.level = self
            .levels
            .get(&item.group.join("/"))
            .copied()
            .unwrap_or_default();
        entity.colour = item
            .colour
            .map(|colour| self.colour(colour))
            .unwrap_or_default();
        entity.status = match item.space {
            Space::Edge => EDGE,
            _ if item.hidden => BLANKED,
            _ => FREE,
        };
        if let Some(name) = item.name.as_ref().filter(|name| !name.trim().is_empty()) {
            let property = self.sheet.add(Entity {
                entity: 406,
                form: 15,
                status: PROPERTY,
                parameters: vec!["1".to_owned(), hollerith(name)],
                ..Entity::default()
            });
            // No notes, one property.
            entity
                .parameters
                .extend(["0".to_owned(), "1".to_owned(), property.to_string()]);
        }
        self.sheet.add(entity);
        Ok(())
    }

    fn composite(&mut self, shapes: &[Shape]) -> Result<Entity, String> {
        let mut parameters = vec![shapes.len().to_string()];
        for shape in shapes {
            let mut piece = self.shape(shape, Kind::Polycurve)?;
            piece.status = PIECE;
            parameters.push(self.sheet.add(piece).to_string());
        }
        Ok(Entity {
            entity: 102,
            parameters,
            ..Entity::default()
        })
    }

    /// The colour number of one of the eight, or the pointer to an entity.
    fn colour(&mut self, colour: [u8; 3]) -> i64 {
        if let Some(index) = COLOURS.iter().position(|other| *other == colour) {
            return i64::try_from(index).unwrap_or_default() + 1;
        }
        let number = match self.colours.get(&colour) {
            Some(number) => *number,
            None => {
                let percent = colour.map(|part| real(f64::from(part) / 2.55));
                let number = self.sheet.add(Entity {
                    entity: 314,
                    status: COLOUR,
                    colour: nearest(colour),
                    parameters: percent.to_vec(),
                    ..Entity::default()
                });
                self.colours.insert(colour, number);
                number
            }
        };
        -i64::try_from(number).unwrap_or_default()
    }

    fn shape(&mut self, shape: &Shape, kind: Kind) -> Result<Entity, String> {
        if !is_finite(shape) {
            return Err("its numbers are not finite".to_owned());
        }
        match shape {
            Shape::Nurbs(nurbs) => spline(nurbs),
            Shape::Conic(conic) => self.conic(conic),
            Shape::Polyline { points, closed } => polyline(points, *closed, kind),
            Shape::Point(point) => Ok(Entity {
                entity: 116,
                parameters: reals(point.to_array()).chain(["0".to_owned()]).collect(),
                ..Entity::default()
            }),
        }
    }

    fn conic(&mut self, conic: &Conic) -> Result<Entity, String> {
        let frame = Frame::of(conic).ok_or("its half-axes span no plane")?;
        let turn = std::f64::consts::TAU * (1.0 + 1.0e-12);
        let length = conic.to - conic.from;
        if !(length > 0.0 && length <= turn) {
            return Err("its parameters do not rise, or exceed a turn".to_owned());
        }
        let [start, end] = frame.ends();
        let mut entity = if frame.is_circle() {
            let numbers = [0.0, 0.0, 0.0, start[0], start[1], end[0], end[1]];
            Entity {
                entity: 100,
                parameters: reals(numbers).collect(),
                ..Entity::default()
            }
        } else {
            let [a, b] = frame.halves;
            // Coefficients near 1: OpenCascade takes those below 1e-12 for a parabola's.
            let numbers = [
                b / a,
                0.0,
                a / b,
                0.0,
                0.0,
                -(a * b),
                0.0,
                start[0],
                start[1],
                end[0],
                end[1],
            ];
            Entity {
                entity: 104,
                form: 1,
                parameters: reals(numbers).collect(),
                ..Entity::default()
            }
        };
        entity.matrix = self.place(&frame.place);
        Ok(entity)
    }

    /// Write a placement; 0 for none.
    fn place(&mut self, place: &Affine) -> usize {
        if place.linear == DMat3::IDENTITY && place.origin == DVec3::ZERO {
            return 0;
        }
        let rows = place.linear.transpose();
        let origin = place.origin;
        let row = |row: DVec3, offset: f64| reals([row.x, row.y, row.z, offset]);
        let parameters = row(rows.x_axis, origin.x)
            .chain(row(rows.y_axis, origin.y))
            .chain(row(rows.z_axis, origin.z))
            .collect();
        self.sheet.add(Entity {
            entity: 124,
            status: PIECE,
            parameters,
            ..Entity::default()
        })
    }
}

fn reals<const N: usize>(values: [f64; N]) -> impl Iterator<Item = String> {
    values.into_iter().map(real)
}

/// The nearest of the eight colours, for programs that know no others.
fn nearest(colour: [u8; 3]) -> i64 {
    let distance = |other: &[u8; 3]| -> u32 {
        let parts = colour.iter().zip(other);
        parts.map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
    };
    (1..)
        .zip(COLOURS)
        .min_by_key(|(_, other)| distance(other))
        .map_or(0, |(number, _)| number)
}

fn polyline(points: &[DVec3], closed: bool, kind: Kind) -> Result<Entity, String> {
    let [first, second, ..] = points else {
        return Err("it has fewer than two points".to_owned());
    };
    if points.len() == 2 && !closed && kind != Kind::Polyline {
        return Ok(Entity {
            entity: 110,
            parameters: reals(first.to_array())
                .chain(reals(second.to_array()))
                .collect(),
            ..Entity::default()
        });
    }
    let count = points.len() + usize::from(closed);
    let corners = points.iter().chain(closed.then_some(first));
    let numbers = corners.flat_map(|point| reals(point.to_array()));
    Ok(Entity {
        entity: 106,
        form: 12,
        parameters: ["2".to_owned(), count.to_string()]
            .into_iter()
            .chain(numbers)
            .collect(),
        ..Entity::default()
    })
}

fn spline(nurbs: &Nurbs) -> Result<Entity, String> {
    check(nurbs)?;
    let Nurbs {
        degree,
        knots,
        points,
        weights,
        periodic,
    } = nurbs;
    let (first, last) = end_points(nurbs);
    let is_flat = points.iter().all(|point| point.z == points[0].z);
    let flags = [is_flat, first == last, weights.is_none(), *periodic];
    let mut parameters = vec![(points.len() - 1).to_string(), degree.to_string()];
    parameters.extend(flags.map(|flag| i32::from(flag).to_string()));
    parameters.extend(knots.iter().copied().map(real));
    match weights {
        Some(weights) => parameters.extend(weights.iter().copied().map(real)),
        None => parameters.extend(std::iter::repeat_n("1.".to_owned(), points.len())),
    }
    parameters.extend(points.iter().flat_map(|point| reals(point.to_array())));
    parameters.extend(reals([knots[*degree], knots[points.len()]]));
    parameters.extend(reals([0.0, 0.0, if is_flat { 1.0 } else { 0.0 }]));
    Ok(Entity {
        entity: 126,
        parameters,
        ..Entity::default()
    })
}
