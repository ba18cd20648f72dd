//! The writer: a compound of edges, wires and vertices.

use glam::DVec3;

use super::conic_frame::Frame;
use super::spline_part::{check, end_points, is_finite};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape, Unreadable};

/// The highest degree that OpenCascade takes; it drops others without a word.
const DEGREE: usize = 25;

/// Write a drawing as a BREP file of version 1, which holds shapes alone: no names, groups and colours.
///
/// # Errors
/// [`Unreadable`] for units other than the millimetre, which the format takes for granted, and for items that
/// OpenCascade cannot hold; it names the item.
pub fn write(drawing: &Drawing, _name: &str) -> Result<Vec<u8>, Unreadable> {
    let millimetres = drawing.unit.unwrap_or(1.0);
    if millimetres != 1.0 {
        let reason = format!(
            "BREP files are in millimetres, not in units of {millimetres} mm; convert first"
        );
        return Err(Unreadable { at: None, reason });
    }
    let mut writer = Writer::default();
    for (index, item) in drawing.items.iter().enumerate() {
        writer.add(item).map_err(|reason| Unreadable {
            at: None,
            reason: format!("{}: {reason}", title(index, item)),
        })?;
    }
    Ok(writer.finish().into_bytes())
}

fn title(index: usize, item: &Item) -> String {
    let name = item
        .name
        .as_ref()
        .map(|name| format!(" \"{name}\""))
        .unwrap_or_default();
    format!("item {} ({}{name})", index + 1, item.kind.name())
}

#[derive(Default)]
struct Writer {
    curves: Vec<String>,
    /// Shapes without the references between them, which count from the last shape.
    shapes: Vec<(String, Vec<(char, usize)>)>,
    /// The shapes of the root.
    roots: Vec<(char, usize)>,
}

impl Writer {
    fn add(&mut self, item: &Item) -> Result<(), String> {
        let mut edges = Vec::new();
        for shape in &item.shapes {
            if !is_finite(shape) {
                return Err("its numbers are not finite".to_owned());
            }
            match shape {
                Shape::Point(point) => {
                    let vertex = self.vertex(*point);
                    self.roots.push(('+', vertex));
                }
                Shape::Nurbs(nurbs) => edges.push(self.spline(nurbs)?),
                Shape::Conic(conic) => edges.push(self.conic(conic)?),
                Shape::Polyline { points, closed } => self.polyline(points, *closed, &mut edges)?,
            }
        }
        let is_chain = matches!(item.kind, Kind::Polycurve | Kind::Path | Kind::Polyline);
        match edges.as_slice() {
            [] => {}
            [edge] if !is_chain => self.roots.push(('+', *edge)),
            _ => {
                let edges = edges.into_iter().map(|edge| ('+', edge)).collect();
                let wire = self.shape("Wi\n\n0101000".to_owned(), edges);
                self.roots.push(('+', wire));
            }
        }
        Ok(())
    }

    fn shape(&mut self, text: String, children: Vec<(char, usize)>) -> usize {
        self.shapes.push((text, children));
        self.shapes.len()
    }

    fn vertex(&mut self, point: DVec3) -> usize {
        self.shape(
            format!("Ve\n1e-07\n{}\n0 0\n\n0101101", numbers(point)),
            Vec::new(),
        )
    }

    /// Add an edge over a range of the last curve.
    fn edge(&mut self, curve: String, range: [f64; 2], ends: [usize; 2]) -> usize {
        self.curves.push(curve);
        let [from, to] = range;
        let text = format!(
            "Ed\n 1e-07 1 1 0\n1  {} 0 {from:?} {to:?}\n0\n\n0101000",
            self.curves.len()
        );
        self.shape(text, vec![('+', ends[0]), ('-', ends[1])])
    }

    /// Add the vertices of a curve, one where it closes.
    fn ends(&mut self, first: DVec3, last: DVec3) -> [usize; 2] {
        let start = self.vertex(first);
        [
            start,
            if first == last {
                start
            } else {
                self.vertex(last)
            },
        ]
    }

    fn spline(&mut self, nurbs: &Nurbs) -> Result<usize, String> {
        check(nurbs)?;
        if nurbs.degree > DEGREE {
            return Err(format!(
                "OpenCascade takes degrees up to {DEGREE}, not {}",
                nurbs.degree
            ));
        }
        let runs: Vec<&[f64]> = nurbs.knots.chunk_by(|a, b| a == b).collect();
        let is_rational = u8::from(nurbs.weights.is_some());
        let (degree, count) = (nurbs.degree, nurbs.points.len());
        let mut text = format!("7 {is_rational} 0  {degree} {count} {} ", runs.len());
        for (index, point) in nurbs.points.iter().enumerate() {
            text += &format!(" {}", numbers(*point));
            if let Some(weights) = &nurbs.weights {
                text += &format!(" {:?}", weights[index]);
            }
        }
        text += "\n";
        for run in runs {
            text += &format!(" {:?} {}", run[0], run.len());
        }
        let (first, last) = end_points(nurbs);
        let ends = self.ends(first, last);
        Ok(self.edge(text, [nurbs.knots[degree], nurbs.knots[count]], ends))
    }

    fn conic(&mut self, conic: &Conic) -> Result<usize, String> {
        let frame = Frame::of(conic).ok_or("its half-axes span no plane")?;
        let [from, to] = frame.range;
        if !(from < to) {
            return Err("its parameters do not rise".to_owned());
        }
        let axes = frame.place.linear;
        let kind = if frame.is_circle() { 2 } else { 3 };
        let parts = [frame.place.origin, axes.z_axis, axes.x_axis, axes.y_axis].map(numbers);
        let mut text = format!("{kind} {} {:?}", parts.join(" "), frame.halves[0]);
        if kind == 3 {
            text += &format!(" {:?}", frame.halves[1]);
        }
        let [start, end] = frame
            .ends()
            .map(|[x, y]| frame.place.point(DVec3::new(x, y, 0.0)));
        let ends = self.ends(start, end);
        Ok(self.edge(text, frame.range, ends))
    }

    fn polyline(
        &mut self,
        points: &[DVec3],
        closed: bool,
        edges: &mut Vec<usize>,
    ) -> Result<(), String> {
        let [first, .., _] = points else {
            return Err("it has fewer than two points".to_owned());
        };
        let start = self.vertex(*first);
        let (mut before, mut vertex) = (*first, start);
        let corners = points
            .iter()
            .skip(1)
            .map(Some)
            .chain(closed.then_some(None));
        for corner in corners {
            let point = *corner.unwrap_or(first);
            let Some(direction) = (point - before).try_normalize() else {
                return Err("two of its points coincide".to_owned());
            };
            let end = if corner.is_some() {
                self.vertex(point)
            } else {
                start
            };
            let line = format!("1 {} {}", numbers(before), numbers(direction));
            edges.push(self.edge(line, [0.0, before.distance(point)], [vertex, end]));
            (before, vertex) = (point, end);
        }
        Ok(())
    }

    fn finish(mut self) -> String {
        let roots = std::mem::take(&mut self.roots);
        self.shape("Co\n\n1100000".to_owned(), roots);
        let mut text =
            "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\n".to_owned();
        text += &format!("Locations 0\nCurve2ds 0\nCurves {}\n", self.curves.len());
        for curve in &self.curves {
            text += curve;
            text += "\n";
        }
        text += "Polygon3D 0\nPolygonOnTriangulations 0\nSurfaces 0\nTriangulations 0\n\n";
        let count = self.shapes.len();
        text += &format!("TShapes {count}\n");
        for (shape, children) in &self.shapes {
            text += shape;
            text += "\n";
            for (sign, child) in children {
                text += &format!("{sign}{} 0 ", count + 1 - child);
            }
            text += "*\n";
        }
        text + "\n+1 0 \n"
    }
}

fn numbers(point: DVec3) -> String {
    format!("{:?} {:?} {:?}", point.x, point.y, point.z)
}
