//! Reads statements.

use std::sync::Arc;

use glam::DVec3;

use super::super::remarks::Remarks;
use super::curves::Curve;
use super::words::{DEFAULT_GROUP, UNIT};
use crate::io::exchange::drawing::{Drawing, Item, Kind, Shape, Unreadable};
use crate::io::exchange::short_names::{short, short_path};

/// The bytes of a file that an item takes: points take two, but a hundred times as much memory.
const ITEM_BYTES: usize = 20;

/// So many items any file may have.
const ITEMS: usize = 500_000;

/// So many bytes of names count as an item: a file gives a name once to all that follows.
const NAME_BYTES: usize = 64;

/// So many points of a curve count as an item: it names each vertex by two bytes or more.
const POINTS: usize = 4;

/// Read a file.
pub(super) fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    if let Some(at) = bytes.iter().position(|&it| it == 0) {
        return Err(Unreadable {
            at: Some(at as u64 + 1),
            reason: "this is no OBJ file, but a binary one".to_owned(),
        });
    }
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader {
        drawing: Drawing::of_file(bytes.len()),
        left: ITEMS.max(bytes.len() / ITEM_BYTES),
        ..Reader::default()
    };
    let mut lines = text.lines().zip(1..);
    while let Some((line, number)) = lines.next() {
        let joined = line.ends_with('\\').then(|| continued(line, &mut lines));
        reader.line = number;
        reader.statement(joined.as_deref().unwrap_or(line).trim());
    }
    if reader.known == 0 {
        return Err(Unreadable {
            at: Some(1),
            reason: "this is no OBJ file: it has none of its statements".to_owned(),
        });
    }
    reader.end_curve(true);
    reader.drawing.remarks = reader.remarks.finish();
    Ok(reader.drawing)
}

/// Join the lines that go on after a backslash.
fn continued<'t>(line: &str, lines: &mut impl Iterator<Item = (&'t str, u64)>) -> String {
    let mut joined = line.trim_end_matches('\\').to_owned();
    for (next, _) in lines {
        joined.push(' ');
        joined.push_str(next.trim_end_matches('\\'));
        if !next.ends_with('\\') {
            break;
        }
    }
    joined
}

/// What the statements so far say.
#[derive(Default)]
struct Reader {
    drawing: Drawing,
    remarks: Remarks,
    line: u64,
    /// How many statements and comments belong to the format.
    known: usize,
    vertices: Vec<(DVec3, f64)>,
    name: Option<String>,
    group: Arc<[String]>,
    /// The kind of curves, and whether they are rational.
    basis: Option<(String, bool)>,
    degree: Option<usize>,
    open: Option<Open>,
    /// How many items there may still be, those for long names and many points counted.
    left: usize,
    /// Whether there is no room for more.
    full: bool,
}

/// What is between a `curv` or `surf` and its `end`.
struct Open {
    line: u64,
    /// Nothing for a surface.
    curve: Option<Curve>,
}

impl Reader {
    fn statement(&mut self, text: &str) {
        if let Some(unit) = text.strip_prefix(UNIT) {
            let unit = unit
                .trim()
                .strip_suffix("mm")
                .and_then(|it| it.trim().parse().ok());
            self.drawing.unit = unit.filter(|it: &f64| it.is_finite() && *it > 0.0);
        }
        self.known += usize::from(text.starts_with('#'));
        let text = text.split('#').next().unwrap_or_default().trim();
        let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        if word.is_empty() {
            return;
        }
        self.known += 1;
        match self.known_statement(word, rest.trim()) {
            Ok(true) => {}
            Ok(false) => {
                self.known -= 1;
                self.drawing
                    .count_other(word.get(..40).unwrap_or(word), self.line);
            }
            Err(reason) => self.remark(&format!("“{word}” is skipped: {reason}")),
        }
    }

    /// Take a statement; return false if it is unknown.
    fn known_statement(&mut self, word: &str, rest: &str) -> Result<bool, String> {
        match word {
            "v" => self.vertices.push(vertex(rest)?),
            "o" => self.name = Some(short(rest)).filter(|it| !it.is_empty()),
            "g" => self.group = group(rest).into(),
            "cstype" => self.basis = Some(basis(rest)),
            "deg" => self.degree = Some(number(rest.split_whitespace().next())?),
            "curv" => self.curve(rest)?,
            "parm" => self.parameters(rest)?,
            "end" => self.end_curve(false),
            "l" => self.polyline(rest)?,
            "p" => self.points(rest)?,
            "f" => self.drawing.count_other("f", self.line),
            "surf" | "curv2" => {
                self.end_curve(true);
                self.drawing.count_other(word, self.line);
                self.open = Some(Open {
                    line: self.line,
                    curve: None,
                });
            }
            "vt" | "vn" | "vp" | "s" | "mtllib" | "usemtl" | "ctech" | "stech" | "trim"
            | "hole" | "scrv" | "sp" | "con" | "lod" | "bevel" | "c_interp" | "d_interp"
            | "step" | "bmat" => {}
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn remark(&mut self, text: &str) {
        self.remarks.add(format!("line {}: {text}", self.line));
    }

    /// Find a vertex by its number, from 1, or from the last one backwards.
    fn vertex(&self, text: &str) -> Result<(DVec3, f64), String> {
        let number = text.split('/').next().unwrap_or_default().parse::<i64>();
        let index = match number {
            Ok(number) if number > 0 => usize::try_from(number - 1).ok(),
            Ok(number) if number < 0 => {
                let back = usize::try_from(number.unsigned_abs()).ok();
                back.and_then(|it| self.vertices.len().checked_sub(it))
            }
            _ => None,
        };
        let vertex = index.and_then(|it| self.vertices.get(it)).copied();
        vertex.ok_or_else(|| format!("there is no vertex {text}"))
    }

    /// Take a part of each of some vertices.
    fn vertices<'t, T>(
        &self,
        words: impl Iterator<Item = &'t str> + Clone,
        part: impl Fn((DVec3, f64)) -> T,
    ) -> Result<Vec<T>, String> {
        let mut parts = Vec::with_capacity(words.clone().count());
        for word in words {
            parts.push(part(self.vertex(word)?));
        }
        Ok(parts)
    }

    fn curve(&mut self, rest: &str) -> Result<(), String> {
        self.end_curve(true);
        // What belongs to a curve that is skipped is skipped too.
        self.open = Some(Open {
            line: self.line,
            curve: None,
        });
        let (basis, is_rational) = self.basis.clone().ok_or("there is no cstype before it")?;
        let is_bezier = basis == "bezier";
        if !is_bezier && basis != "bspline" {
            return Err(format!("curves of type {basis} are not known"));
        }
        let degree = self.degree.ok_or("there is no deg before it")?;
        let mut words = rest.split_whitespace();
        let range = (number(words.next())?, number(words.next())?);
        if !self.spend(words.clone().count() / POINTS) {
            return Ok(());
        }
        let weights = is_rational
            .then(|| self.vertices(words.clone(), |it| it.1))
            .transpose()?;
        let curve = Curve {
            is_bezier,
            degree,
            points: self.vertices(words, |it| it.0)?,
            weights,
            parameters: Vec::new(),
            range,
        };
        self.open = Some(Open {
            line: self.line,
            curve: Some(curve),
        });
        Ok(())
    }

    fn parameters(&mut self, rest: &str) -> Result<(), String> {
        let Some(open) = &mut self.open else {
            return Err("there is no curve before it".to_owned());
        };
        let mut words = rest.split_whitespace();
        if let (Some(curve), Some("u")) = (&mut open.curve, words.next()) {
            for word in words {
                curve.parameters.push(number(Some(word))?);
            }
        }
        Ok(())
    }

    /// End a curve, which may lack its `end`.
    fn end_curve(&mut self, early: bool) {
        let Some(Open { line, curve }) = self.open.take() else {
            return;
        };
        let Some(curve) = curve else { return };
        if early {
            self.remarks
                .add(format!("line {line}: “curv” has no “end”"));
        }
        let kind = if curve.is_bezier {
            Kind::Bezier
        } else {
            Kind::Spline
        };
        if curve.is_beyond() {
            self.remarks.add(format!(
                "line {line}: the range of “curv” is cut to where its knots define the curve"
            ));
        }
        match curve.spline() {
            Ok(spline) => self.push(kind, Shape::Nurbs(spline), line),
            Err(reason) => self
                .remarks
                .add(format!("line {line}: “curv” is skipped: {reason}")),
        }
    }

    fn polyline(&mut self, rest: &str) -> Result<(), String> {
        let words = rest.split_whitespace();
        if !self.spend(words.clone().count() / POINTS) {
            return Ok(());
        }
        let mut points = self.vertices(words.clone(), |it| it.0)?;
        if points.len() < 2 {
            return Err("it has fewer than two points".to_owned());
        }
        let vertex = |it: &str| it.split('/').next().map(str::to_owned);
        let closed = points.len() > 2
            && words.clone().next().and_then(vertex) == words.last().and_then(vertex);
        if closed {
            points.pop();
        }
        let kind = if points.len() == 2 {
            Kind::Line
        } else {
            Kind::Polyline
        };
        self.push(kind, Shape::Polyline { points, closed }, self.line);
        Ok(())
    }

    fn points(&mut self, rest: &str) -> Result<(), String> {
        for word in rest.split_whitespace() {
            let (point, _) = self.vertex(word)?;
            self.push(Kind::Point, Shape::Point(point), self.line);
        }
        Ok(())
    }

    fn push(&mut self, kind: Kind, shape: Shape, at: u64) {
        let item = Item {
            group: Arc::clone(&self.group),
            name: self.name.clone(),
            at,
            ..Item::new(kind, vec![shape])
        };
        let texts = item.names_memory(self.drawing.items.last());
        if self.spend(1 + texts / NAME_BYTES) {
            self.drawing.items.push(item);
        }
    }

    /// Make room; `false` where there is none.
    fn spend(&mut self, items: usize) -> bool {
        match self.left.checked_sub(items) {
            Some(left) if !self.full => self.left = left,
            _ if self.full => {}
            _ => {
                let count = self.drawing.items.len();
                self.remark(&format!(
                    "the rest of the file is skipped: its {count} curves and points take too much memory"
                ));
                self.full = true;
            }
        }
        !self.full
    }
}

fn number<T: std::str::FromStr>(word: Option<&str>) -> Result<T, String> {
    let word = word.ok_or("a number is missing")?;
    word.parse().map_err(|_| format!("“{word}” is no number"))
}

/// Read coordinates and, where there are four numbers, a weight; colours may follow.
fn vertex(rest: &str) -> Result<(DVec3, f64), String> {
    let mut words = rest.split_whitespace();
    let mut next = || number::<f64>(words.next());
    let point = DVec3::new(next()?, next()?, next()?);
    let weight = match rest.split_whitespace().count() {
        4 => next()?,
        _ => 1.0,
    };
    Ok((point, weight))
}

/// Read the path of a group.
pub(super) fn group(rest: &str) -> Vec<String> {
    if rest == DEFAULT_GROUP {
        return Vec::new();
    }
    let names = rest.split('/').map(str::trim).filter(|it| !it.is_empty());
    short_path(names)
}

fn basis(rest: &str) -> (String, bool) {
    let is_rational = rest.split_whitespace().next() == Some("rat");
    (
        short(rest.split_whitespace().last().unwrap_or_default()),
        is_rational,
    )
}
