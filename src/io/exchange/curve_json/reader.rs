//! Reads curves. Each is parsed on its own, so that damage to one does not take the others along.

use std::fmt;

use glam::DVec3;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::super::remarks::Remarks;
use super::super::spending::Spending;
use super::super::splines::{checked, clamped_knots};
use super::units::UNITS;
use crate::io::exchange::drawing::{Drawing, Item, Kind, Nurbs, Shape, Unreadable};
use crate::io::exchange::short_names::{DEEPEST, short, short_path};

/// Read all curves.
pub(super) fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let text = std::str::from_utf8(bytes).map_err(|error| Unreadable {
        at: Some(error.valid_up_to() as u64 + 1),
        reason: "this is no JSON file: it is not UTF-8".to_owned(),
    })?;
    let text = text.trim_start_matches('\u{feff}');
    let mut file = File {
        text,
        drawing: Drawing::of_file(text.len()),
        remarks: Remarks::default(),
        spending: Spending::of_file(text.len()),
        is_full: false,
        line: (0, 1),
    };
    let mut parser = serde_json::Deserializer::from_str(text);
    let outcome = Whole(&mut file)
        .deserialize(&mut parser)
        .and_then(|()| parser.end());
    if let Err(error) = outcome {
        if file.drawing.items.is_empty() {
            return Err(Unreadable {
                at: Some(error.line() as u64),
                reason: format!("this is no list of curves in JSON: {error}"),
            });
        }
        file.remarks.add(format!(
            "line {}: the file is damaged here: {error}",
            error.line()
        ));
    }
    file.drawing.remarks = file.remarks.finish();
    Ok(file.drawing)
}

/// What was read so far.
struct File<'d> {
    text: &'d str,
    drawing: Drawing,
    remarks: Remarks,
    spending: Spending,
    /// Whether there is no room for more curves.
    is_full: bool,
    /// The last position that was asked for, and its line.
    line: (usize, u64),
}

impl<'d> File<'d> {
    /// Get the line of a part of the text; parts come in order.
    fn line_of(&mut self, part: &str) -> u64 {
        let position = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let passed = self
            .text
            .as_bytes()
            .get(self.line.0..position)
            .unwrap_or_default();
        let lines = passed.iter().filter(|&&it| it == b'\n').count();
        self.line = (position.max(self.line.0), self.line.1 + lines as u64);
        self.line.1
    }

    fn curve(&mut self, text: &'d str) {
        let line = self.line_of(text);
        let is_told = !self.remarks.are_full();
        let curve = serde_json::from_str::<Curve>(text).map_err(|error| match is_told {
            true => (line + error.line() as u64 - 1, reason_of(&error)),
            false => (line, String::new()),
        });
        let result = curve.and_then(|mut curve| {
            let name = curve.name.as_deref().map(short);
            let group = curve.group.take().map(|path| path.0).unwrap_or_default();
            let spline = curve.spline().map_err(|reason| (line, reason))?;
            Ok((name, group, spline))
        });
        match result {
            Ok((name, group, spline)) => self.add(Item {
                group: self.drawing.path(&group),
                name,
                at: line,
                ..Item::new(Kind::Spline, vec![Shape::Nurbs(spline)])
            }),
            Err((line, reason)) => self
                .remarks
                .add(format!("line {line}: a curve is skipped: {reason}")),
        }
    }

    /// Add an item, if there is room.
    fn add(&mut self, item: Item) {
        item.shapes
            .iter()
            .for_each(|it| self.spending.keep_shape(it));
        if self.spending.keep(&item, self.drawing.items.last()) {
            self.drawing.items.push(item);
            return;
        }
        if !self.is_full {
            let reason = self.spending.reason();
            let told = format!("line {}: the rest is left out: {reason}", item.at);
            self.remarks.add(told);
        }
        self.is_full = true;
    }

    fn unit(&mut self, text: &'d str) {
        let line = self.line_of(text);
        let name = serde_json::from_str::<Option<String>>(text);
        match name {
            Ok(None) => {}
            Ok(Some(name)) => match UNITS.iter().find(|it| it.0 == name) {
                Some((_, unit)) => self.drawing.unit = Some(*unit),
                None => self.remarks.add(format!(
                    "line {line}: the unit “{name}” is unknown: mm, cm, m and in are known"
                )),
            },
            Err(_) => self
                .remarks
                .add(format!("line {line}: the unit is no text")),
        }
    }
}

/// Say what is wrong, without the place, which is that in the text of the curve alone.
fn reason_of(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let reason = text.strip_suffix(&place).unwrap_or(&text);
    reason.replace("expected usize", "expected a whole number")
}

/// A curve of the file.
#[derive(Deserialize)]
#[serde(expecting = "a curve, which is a JSON object")]
struct Curve {
    name: Option<String>,
    degree: usize,
    knots: Option<Vec<f64>>,
    points: Vec<Corner>,
    weights: Option<Vec<f64>>,
    periodic: Option<bool>,
    group: Option<Path>,
}

impl Curve {
    fn spline(self) -> Result<Nurbs, String> {
        let knots = match self.knots {
            Some(knots) => knots,
            None if self.degree < self.points.len() => {
                clamped_knots(self.degree, self.points.len())
            }
            None => Vec::new(),
        };
        checked(Nurbs {
            degree: self.degree,
            knots,
            points: self.points.into_iter().map(|it| it.0).collect(),
            weights: self.weights,
            periodic: self.periodic.unwrap_or_default(),
        })
    }
}

/// The groups of a curve, without empty names and cut where they nest too deep.
struct Path(Vec<String>);

impl<'de> Deserialize<'de> for Path {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Names;
        impl<'de> Visitor<'de> for Names {
            type Value = Path;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a text or a list of names")
            }

            fn visit_str<E>(self, text: &str) -> Result<Path, E> {
                let names = text.split('/').filter(|name| !name.is_empty());
                Ok(Path(short_path(names)))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Path, A::Error> {
                let mut names = Vec::new();
                while let Some(name) = list.next_element::<String>()? {
                    if !name.is_empty() && names.len() <= DEEPEST {
                        names.push(short(&name));
                    }
                }
                Ok(Path(short_path(names.iter().map(String::as_str))))
            }
        }
        deserializer.deserialize_any(Names)
    }
}

/// A point of two or three coordinates.
struct Corner(DVec3);

impl<'de> Deserialize<'de> for Corner {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Coordinates;
        impl<'de> Visitor<'de> for Coordinates {
            type Value = Corner;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a list of two or three coordinates")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Corner, A::Error> {
                let missing = || A::Error::custom("a point has fewer than two coordinates");
                let x = list.next_element()?.ok_or_else(missing)?;
                let y = list.next_element()?.ok_or_else(missing)?;
                let z = list.next_element()?.unwrap_or_default();
                match list.next_element::<IgnoredAny>()? {
                    None => Ok(Corner(DVec3::new(x, y, z))),
                    Some(_) => Err(A::Error::custom("a point has more than three coordinates")),
                }
            }
        }
        deserializer.deserialize_seq(Coordinates)
    }
}

/// Reads the outermost value into a file.
struct Whole<'f, 'd>(&'f mut File<'d>);

impl<'d> DeserializeSeed<'d> for Whole<'_, 'd> {
    type Value = ();

    fn deserialize<D: Deserializer<'d>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'d> Visitor<'d> for Whole<'_, 'd> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a list of curves, or an object with “curves”")
    }

    fn visit_seq<A: SeqAccess<'d>>(self, list: A) -> Result<(), A::Error> {
        Curves(self.0).visit_seq(list)
    }

    fn visit_map<A: MapAccess<'d>>(self, mut map: A) -> Result<(), A::Error> {
        let mut found = false;
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "curves" => {
                    map.next_value_seed(Curves(self.0))?;
                    found = true;
                }
                "unit" => self.0.unit(map.next_value::<&'d RawValue>()?.get()),
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        if found {
            Ok(())
        } else {
            Err(A::Error::custom("it has no “curves”"))
        }
    }
}

/// Reads a list of curves into a file.
struct Curves<'f, 'd>(&'f mut File<'d>);

impl<'d> DeserializeSeed<'d> for Curves<'_, 'd> {
    type Value = ();

    fn deserialize<D: Deserializer<'d>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'d> Visitor<'d> for Curves<'_, 'd> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a list of curves")
    }

    fn visit_seq<A: SeqAccess<'d>>(self, mut list: A) -> Result<(), A::Error> {
        while let Some(curve) = list.next_element::<&'d RawValue>()? {
            self.0.curve(curve.get());
        }
        Ok(())
    }
}
