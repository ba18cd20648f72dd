//! The edges of boundary representations.

use super::chunks::{ANONYMOUS, Archive, CLASS, Chunks};
use super::cursor::Cursor;
use super::curves::{Curve, curve, polycurve};
use super::objects::{Object, object};
use super::properties::TWO_DOMAINS;

/// Parameters that differ by less than this part of the whole are the same.
const SAME: f64 = 1e-9;

/// An edge: a curve between two parameters.
struct Edge {
    curve: i32,
    domain: (f64, f64),
}

/// Read the edges of a brep, and why others are left out.
pub(super) fn edges(
    mut data: Cursor,
    archive: Archive,
) -> Result<(Vec<Curve>, Vec<String>), String> {
    match data.version()? {
        (3, _) => {}
        (2, _) => return Ok((old(data, archive)?, Vec::new())),
        (major, minor) => return Err(format!("its layout {major}.{minor} is not known")),
    }
    let mut chunks = Chunks::new(data, archive);
    // Flat curves, curves in space, surfaces, vertices, edges.
    let [_, curves, _, _, edges] = std::array::from_fn(|_| {
        chunks
            .next()
            .filter(|chunk| chunk.code == ANONYMOUS && !chunk.cut)
    });
    let (Some(curves), Some(edges)) = (curves, edges) else {
        return Err("its layout is damaged".to_owned());
    };
    let objects = objects(curves.body, archive)?;
    let (mut found, mut skipped) = (Vec::new(), Vec::new());
    for (index, edge) in table(edges.body, archive)?.into_iter().enumerate() {
        match edge_curve(&edge, &objects, archive) {
            Ok(curve) => found.push(curve),
            Err(reason) => skipped.push(format!("edge {}: {reason}", index + 1)),
        }
    }
    Ok((found, skipped))
}

/// The curves in space, by their index.
fn objects(mut data: Cursor, archive: Archive) -> Result<Vec<Option<Object>>, String> {
    data.version()?;
    let count = data.count(4)?;
    let mut objects = Vec::with_capacity(count);
    for _ in 0..count {
        if data.int()? != 1 {
            objects.push(None);
            continue;
        }
        let mut chunks = Chunks::new(data, archive);
        let chunk = chunks.next().filter(|chunk| chunk.code == CLASS);
        let chunk = chunk.ok_or_else(|| "its curves are damaged".to_owned())?;
        objects.push(Some(object(&chunk, archive)?));
        data = chunks.rest();
    }
    Ok(objects)
}

fn table(mut data: Cursor, archive: Archive) -> Result<Vec<Edge>, String> {
    data.version()?;
    let count = data.count(52)?;
    let mut edges = Vec::with_capacity(count);
    for _ in 0..count {
        data.int()?;
        let curve = data.int()?;
        // Whether it runs backwards does not matter here.
        data.int()?;
        let domain = data.interval()?;
        // Two vertices, the trims.
        data.bytes(8)?;
        let trims = data.count(4)?;
        data.bytes(trims.saturating_mul(4))?;
        // The tolerance, and the parameters by which programs speak of the edge.
        data.number()?;
        if archive.version >= 3 && archive.opennurbs >= TWO_DOMAINS {
            data.interval()?;
        }
        edges.push(Edge { curve, domain });
    }
    Ok(edges)
}

fn edge_curve(edge: &Edge, objects: &[Option<Object>], archive: Archive) -> Result<Curve, String> {
    let object = usize::try_from(edge.curve)
        .ok()
        .and_then(|index| objects.get(index));
    let Some(Some(object)) = object else {
        return Err("it has no curve".to_owned());
    };
    let curve =
        curve(object, archive)?.ok_or_else(|| format!("{} is no curve", object.class.name()))?;
    let (from, to) = curve.domain;
    let tolerance = SAME * (to - from).abs();
    let whole =
        (edge.domain.0 - from).abs() <= tolerance && (edge.domain.1 - to).abs() <= tolerance;
    // Some one in a thousand; cutting a curve would give other numbers than those of the file.
    whole
        .then_some(curve)
        .ok_or_else(|| "it is but a part of its curve".to_owned())
}

/// The layout of version 2: flat curves, then the edges, all of them polycurves.
fn old(mut data: Cursor, archive: Archive) -> Result<Vec<Curve>, String> {
    // The count of faces.
    data.int()?;
    let edges = data.count(60)?;
    // The count of loops.
    data.int()?;
    let trims = data.count(60)?;
    // A mark and the bounding box.
    data.bytes(4 + 48)?;
    for _ in 0..trims {
        polycurve(&mut data, archive)?;
    }
    (0..edges).map(|_| polycurve(&mut data, archive)).collect()
}
