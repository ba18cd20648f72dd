//! Sections `Locations` and `TShapes`.

use std::rc::Rc;

use glam::{DMat3, DVec3};

use super::tokens::Tokens;
use crate::io::exchange::drawing::{Affine, Unreadable};

/// The highest power of a location.
const POWER: i64 = 64;

/// A shape without its place.
pub(super) struct Part {
    pub content: Content,
    pub children: Rc<[Reference]>,
    /// The line in the file, from 1.
    pub line: u64,
}

/// What a shape is.
pub(super) enum Content {
    Vertex(DVec3),
    Edge(Edge),
    Wire,
    /// A face, shell or solid: its edges are boundaries.
    Face,
    Compound,
}

/// An edge's curve.
#[derive(Default)]
pub(super) struct Edge {
    /// The curve's number from 1, its location and its range.
    pub curve: Option<(usize, usize, f64, f64)>,
    /// Whether it is a point on a surface.
    pub is_degenerate: bool,
}

/// A shape in another one. A file can be little more than these: their numbers are small.
#[derive(Clone, Copy)]
pub(super) struct Reference {
    part: u32,
    location: u32,
    pub is_reversed: bool,
}

impl Reference {
    /// The index of the shape in the file's order, from 0.
    pub(super) fn part(self) -> usize {
        self.part as usize
    }

    /// The number of its place.
    pub(super) fn location(self) -> usize {
        self.location as usize
    }
}

/// Read the locations; number 0 is none.
///
/// # Errors
/// [`Unreadable`] with the line of damage.
pub(super) fn locations(from: &mut Tokens) -> Result<Vec<Affine>, Unreadable> {
    let count = from.count()?;
    let mut all = vec![Affine::default()];
    for _ in 0..count {
        let place = match from.integer()? {
            1 => matrix(from)?,
            _ => product(&all, from)?,
        };
        all.push(place);
    }
    Ok(all)
}

fn matrix(from: &mut Tokens) -> Result<Affine, Unreadable> {
    let mut rows = [DVec3::ZERO; 3];
    let mut origin = [0.0; 3];
    for (row, offset) in rows.iter_mut().zip(&mut origin) {
        (*row, *offset) = (from.point()?, from.number()?);
    }
    Ok(Affine {
        linear: DMat3::from_cols(rows[0], rows[1], rows[2]).transpose(),
        origin: DVec3::from(origin),
    })
}

/// A product of powers, the last factor outermost.
fn product(all: &[Affine], from: &mut Tokens) -> Result<Affine, Unreadable> {
    let mut place = Affine::default();
    loop {
        let number = from.integer()?;
        if number == 0 {
            return Ok(place);
        }
        let power = from.integer()?.clamp(-POWER, POWER);
        let factor = usize::try_from(number)
            .ok()
            .and_then(|index| all.get(index));
        let factor = factor.ok_or_else(|| from.fault("a location before this one", None))?;
        let factor = if power < 0 { inverse(factor) } else { *factor };
        for _ in 0..power.abs() {
            place = factor.of(&place);
        }
    }
}

fn inverse(place: &Affine) -> Affine {
    let linear = place.linear.inverse();
    Affine {
        linear,
        origin: -(linear * place.origin),
    }
}

/// Read the shapes as far as they are whole, and the damage behind them.
pub(super) fn parts(from: &mut Tokens, version: u32) -> (Vec<Part>, Option<Unreadable>) {
    let count = match from.count() {
        Ok(count) => count,
        Err(fault) => return (Vec::new(), Some(fault)),
    };
    let mut parts = Vec::new();
    for index in 0..count {
        match part(from, version, index, count) {
            Ok(part) => parts.push(part),
            Err(fault) => return (parts, Some(fault)),
        }
    }
    (parts, None)
}

/// Read a reference such as `+12 3`; `None` for the end of a list.
///
/// # Errors
/// [`Unreadable`] if it is none, or not of an earlier shape.
pub(super) fn reference(
    from: &mut Tokens,
    below: usize,
    count: usize,
) -> Result<Option<Reference>, Unreadable> {
    let word = from.next();
    if word == Some(b"*") {
        return Ok(None);
    }
    let fault = |from: &Tokens| from.fault("a reference to an earlier shape", word);
    let (sign, digits) = word
        .and_then(<[u8]>::split_first)
        .ok_or_else(|| fault(from))?;
    let number: Option<usize> = std::str::from_utf8(digits)
        .ok()
        .and_then(|digits| digits.parse().ok());
    // Shapes are numbered from the last one.
    let part = number
        .and_then(|number| count.checked_sub(number))
        .filter(|part| *part < below);
    let part = part.and_then(|part| u32::try_from(part).ok());
    let part = part
        .filter(|_| b"+-ie".contains(sign))
        .ok_or_else(|| fault(from))?;
    let location = u32::try_from(from.integer()?).map_err(|_| fault(from))?;
    Ok(Some(Reference {
        part,
        location,
        is_reversed: *sign == b'-',
    }))
}

fn part(from: &mut Tokens, version: u32, index: usize, count: usize) -> Result<Part, Unreadable> {
    let line = from.line();
    let word = from.next();
    let content = match word {
        Some(b"Ve") => vertex(from, version)?,
        Some(b"Ed") => Content::Edge(edge(from, version)?),
        Some(b"Wi") => Content::Wire,
        Some(b"Fa") => face(from)?,
        Some(b"Sh" | b"So") => Content::Face,
        Some(b"CS" | b"Co") => Content::Compound,
        _ => return Err(from.fault("a shape", word)),
    };
    // Flags: free, modified, checked, orientable, closed, infinite, convex.
    let flags = from.next();
    if !flags.is_some_and(|flags| flags.iter().all(|flag| matches!(flag, b'0' | b'1'))) {
        return Err(from.fault("a shape's flags", flags));
    }
    let mut children = Vec::new();
    while let Some(child) = reference(from, index, count)? {
        children.push(child);
    }
    Ok(Part {
        content,
        children: children.into(),
        line,
    })
}

fn vertex(from: &mut Tokens, version: u32) -> Result<Content, Unreadable> {
    from.number()?;
    let point = from.point()?;
    loop {
        // Version 3 has the kind before the parameter. Both end with "0 0".
        let words = [from.next(), from.next()];
        let kind = words[usize::from(version < 3)];
        let numbers = match kind {
            Some(b"0") => return Ok(Content::Vertex(point)),
            Some(b"1") => 2,
            Some(b"2" | b"3") => 3,
            _ => return Err(from.fault("a vertex's place on a curve", kind)),
        };
        skip(from, numbers)?;
    }
}

fn edge(from: &mut Tokens, version: u32) -> Result<Edge, Unreadable> {
    skip(from, 3)?;
    let mut edge = Edge {
        curve: None,
        is_degenerate: from.integer()? != 0,
    };
    // Version 2 adds the ends in the parameter plane.
    let ends = if version == 2 { 4 } else { 0 };
    loop {
        match split_continuity(from.next()) {
            (b"0", _) => return Ok(edge),
            (b"1", _) => {
                let (curve, location) = (from.integer()?, from.integer()?);
                let (first, last) = (from.number()?, from.number()?);
                let numbers = (usize::try_from(curve), usize::try_from(location));
                if let (Ok(curve), Ok(location)) = numbers {
                    edge.curve = edge.curve.or(Some((curve, location, first, last)));
                }
            }
            (b"2", _) => skip(from, 5 + ends)?,
            (b"3", _) => {
                skip(from, 1)?;
                let (_, is_glued) = split_continuity(from.next());
                skip(from, if is_glued { 4 } else { 5 } + 2 * ends)?;
            }
            (b"4", is_glued) => skip(from, if is_glued { 4 } else { 5 })?,
            (b"5", _) => skip(from, 2)?,
            (b"6", _) => skip(from, 3)?,
            (b"7", _) => skip(from, 4)?,
            (word, _) => return Err(from.fault("an edge's curve", Some(word))),
        }
    }
}

/// Split a number from a continuity that may follow without a blank, as in `4CN`.
fn split_continuity(word: Option<&[u8]>) -> (&[u8], bool) {
    let word = word.unwrap_or_default();
    let digits = word.iter().take_while(|byte| byte.is_ascii_digit()).count();
    match word.split_at_checked(digits) {
        Some((number, [b'C' | b'G', ..])) => (number, true),
        _ => (word, false),
    }
}

fn face(from: &mut Tokens) -> Result<Content, Unreadable> {
    skip(from, 4)?;
    // A mesh.
    if from.peek() == Some(b"2") {
        skip(from, 2)?;
    }
    Ok(Content::Face)
}

fn skip(from: &mut Tokens, words: usize) -> Result<(), Unreadable> {
    for _ in 0..words {
        from.next().ok_or_else(|| from.fault("a number", None))?;
    }
    Ok(())
}
