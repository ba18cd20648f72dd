//! Writes glyphs.

use std::fmt::Write;

use glam::DVec3;

use super::super::splines::{Piece, described, hull, pieces};
use crate::io::exchange::drawing::{Drawing, Item, Shape, Unreadable};
use crate::io::xml::escaped;

/// Write a glyph.
pub(super) fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<glyph name=\"{}\" format=\"2\">\n  <outline>\n",
        escaped(name)
    );
    for item in &drawing.items {
        for contour in contours(&item.shapes).map_err(|what| refusal(drawing, item, &what))? {
            contour.write(&mut text, |_, _| None);
        }
    }
    text.push_str("  </outline>\n</glyph>\n");
    Ok(text.into_bytes())
}

/// The points of a contour with their types.
pub(super) struct Contour {
    pub(super) points: Vec<(DVec3, Option<&'static str>)>,
}

impl Contour {
    fn from(start: DVec3) -> Self {
        Self {
            points: vec![(start, Some("move"))],
        }
    }

    fn end(&self) -> Option<DVec3> {
        self.points.last().map(|it| it.0)
    }

    /// Add the points of a segment behind its first.
    fn extend(&mut self, points: &[DVec3], kind: &'static str) {
        let Some((_, rest)) = points.split_first() else {
            return;
        };
        let Some((last, inner)) = rest.split_last() else {
            return;
        };
        self.points.extend(inner.iter().map(|&it| (it, None)));
        self.points.push((*last, Some(kind)));
    }

    /// Join the end to the start, if they are one point.
    fn close(&mut self) {
        if self.points.len() > 2
            && self.points.first().map(|it| it.0) == self.end()
            && let Some((_, kind)) = self.points.pop()
            && let Some(first) = self.points.first_mut()
        {
            first.1 = kind;
        }
    }

    /// Write the contour with its tags; `kept` gives points that stand in the file already.
    pub(super) fn write<'t>(
        &self,
        text: &mut String,
        kept: impl FnMut(DVec3, Option<&'static str>) -> Option<&'t str>,
    ) {
        text.push_str("    <contour>\n");
        self.write_points(text, "      ", kept);
        text.push_str("    </contour>\n");
    }

    /// Whether it does not close.
    pub(super) fn is_open(&self) -> bool {
        self.points.first().is_some_and(|it| it.1 == Some("move"))
    }

    /// Write the points, a line each; `kept` gives those that stand in the file already.
    pub(super) fn write_points<'t>(
        &self,
        text: &mut String,
        indent: &str,
        mut kept: impl FnMut(DVec3, Option<&'static str>) -> Option<&'t str>,
    ) {
        for (point, kind) in &self.points {
            if let Some(own) = kept(*point, *kind) {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{indent}{own}");
                continue;
            }
            let kind = kind.map(|it| format!(" type=\"{it}\"")).unwrap_or_default();
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{indent}<point x=\"{}\" y=\"{}\"{kind}/>",
                point.x, point.y
            );
        }
    }
}

/// The contours along some shapes, or what they are that a glyph cannot hold.
pub(super) fn contours(shapes: &[Shape]) -> Result<Vec<Contour>, String> {
    let mut contours: Vec<Contour> = Vec::new();
    if shapes.iter().flat_map(hull).any(|point| point.z != 0.0) {
        return Err("a curve outside of the plane z = 0".to_owned());
    }
    for shape in shapes {
        for piece in pieces(shape)? {
            add(&mut contours, &piece)?;
        }
    }
    contours.iter_mut().for_each(Contour::close);
    for (point, _) in contours.iter().flat_map(|it| &it.points) {
        if !point.is_finite() {
            return Err("a curve with numbers that are not finite".to_owned());
        }
    }
    Ok(contours)
}

fn add(contours: &mut Vec<Contour>, piece: &Piece) -> Result<(), String> {
    match piece {
        Piece::Arc(_) => return Err("an arc".to_owned()),
        Piece::Ring(points) => {
            let points = points.iter().map(|&it| (it, None)).collect();
            contours.push(Contour { points });
            return Ok(());
        }
        Piece::Lines {
            points,
            closed: true,
        } => {
            let points = points.iter().map(|&it| (it, Some("line"))).collect();
            contours.push(Contour { points });
            return Ok(());
        }
        _ => {}
    }
    let Some(start) = piece.start() else {
        return Ok(());
    };
    if contours.last().and_then(Contour::end) != Some(start) {
        contours.push(Contour::from(start));
    }
    let Some(contour) = contours.last_mut() else {
        return Ok(());
    };
    match piece {
        Piece::Lines { points, .. } => points
            .windows(2)
            .for_each(|segment| contour.extend(segment, "line")),
        Piece::Quadratic(points) => contour.extend(points, "qcurve"),
        Piece::Cubic(points) => contour.extend(points, "curve"),
        Piece::Arc(_) | Piece::Ring(_) => {}
    }
    Ok(())
}

fn refusal(drawing: &Drawing, item: &Item, what: &str) -> Unreadable {
    Unreadable {
        at: None,
        reason: format!(
            "{} is {what}, which GLIF cannot hold: approximate it by plane Bézier curves before",
            described(drawing, item)
        ),
    }
}
