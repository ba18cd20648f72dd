//! New polygons from old ones: the edits that change how many vertices there are.

use glam::DVec3;

use crate::document::{Curve, CurveId, Edit, EditError, ParameterSpan, Renumbering};
use crate::geometry::{End, FloatPolygon, PolygonError};

/// The edit that inserts a vertex into a curve's polygon, so that it gets number `index`, with its images where the curve
/// is symmetric: these may come before it.
///
/// # Errors
/// [`PolygonError`] if the vertex cannot be used.
pub fn insertion(
    id: CurveId,
    curve: &Curve,
    index: usize,
    vertex: DVec3,
) -> Result<Edit, PolygonError> {
    let mut all = insertions(curve, index, vertex);
    all.sort_by_key(|(at, _)| *at);
    let last_first = all.iter().rev();
    let polygon = last_first
        .clone()
        .try_fold(curve.polygon.clone(), |polygon, (at, vertex)| {
            inserted(&polygon, *at, *vertex)
        })?;
    let number = |old| Some(old + all.iter().filter(|(at, _)| *at <= old).count());
    Ok(Edit::Renumber {
        curve: id,
        renumbering: Renumbering::of_vertices(curve, &polygon, number),
        polygon,
    })
}

/// The number that an inserted vertex has once its images are there too.
pub fn number_of_inserted(curve: &Curve, index: usize) -> usize {
    let all = insertions(curve, index, DVec3::ZERO);
    index + all.iter().filter(|(at, _)| *at < index).count()
}

fn insertions(curve: &Curve, index: usize, vertex: DVec3) -> Vec<(usize, DVec3)> {
    match curve.symmetry {
        Some(symmetry) => symmetry.insertions(&curve.polygon, index, vertex),
        None => vec![(index, vertex)],
    }
}

/// The edit that lets a curve go on from an end to a point, a symmetric one from its other end too: see
/// [`FloatPolygon::continued`].
///
/// # Errors
/// As [`FloatPolygon::continued`].
pub fn continuation(id: CurveId, curve: &Curve, end: End, to: DVec3) -> Result<Edit, PolygonError> {
    let old = &curve.polygon;
    let mirror = curve.symmetry.map(|symmetry| symmetry.mirror());
    let image = mirror.map(|mirror| (end.other(), mirror.point(to)));
    let ends: Vec<(End, DVec3)> = [(end, to)].into_iter().chain(image).collect();
    let mut ends_of = ends.iter();
    let polygon = ends_of.try_fold(old.clone(), |polygon, (end, to)| {
        polygon.continued(*end, *to)
    })?;
    let is_before = |vertex: usize, end: End| match end {
        End::Start => old.tail(end).contains(&vertex),
        End::Finish => !old.tail(end).contains(&vertex),
    };
    let number = |vertex| {
        let behind = ends.iter().filter(|(end, _)| !is_before(vertex, *end));
        Some(vertex + behind.count())
    };
    Ok(Edit::Renumber {
        curve: id,
        renumbering: Renumbering::of_vertices(curve, &polygon, number),
        polygon,
    })
}

/// The edit that removes vertices from a curve's polygon, by their numbers, with their images where the curve is
/// symmetric.
///
/// # Errors
/// [`EditError`] if one of them is locked, or the rest is no curve of this degree.
pub fn deletion(id: CurveId, curve: &Curve, indices: &[usize]) -> Result<Edit, EditError> {
    let dependents = indices.iter().flat_map(|it| curve.dependents(*it));
    let mut indices: Vec<usize> = dependents.collect();
    indices.sort_unstable();
    indices.dedup();
    curve.check_vertices_unlocked(indices.iter().copied())?;
    let polygon = without(&curve.polygon, &indices).map_err(|error| EditError::Polygon {
        name: curve.name.clone(),
        error,
    })?;
    let number = |old| match indices.binary_search(&old) {
        Ok(_) => None,
        Err(below) => Some(old - below),
    };
    Ok(Edit::Renumber {
        curve: id,
        renumbering: Renumbering::of_vertices(curve, &polygon, number),
        polygon,
    })
}

/// The edit that takes another polygon whose curve runs evenly along a curve's.
pub fn replacement(id: CurveId, curve: &Curve, polygon: FloatPolygon) -> Edit {
    let whole = |polygon: &FloatPolygon| [0.0, polygon.segments() as f64];
    let evenly = ParameterSpan {
        old: whole(&curve.polygon),
        new: whole(&polygon),
    };
    Edit::Renumber {
        curve: id,
        renumbering: Renumbering::of_parameters(curve, &polygon, vec![evenly]),
        polygon,
    }
}

/// Insert a vertex so that it gets number `index`; its weight is the geometric mean of its neighbours'.
///
/// # Errors
/// [`PolygonError`] if the vertex cannot be used.
fn inserted(
    polygon: &FloatPolygon,
    index: usize,
    vertex: DVec3,
) -> Result<FloatPolygon, PolygonError> {
    let index = index.min(polygon.vertices().len());
    let mut vertices = polygon.vertices().to_vec();
    vertices.insert(index, vertex);
    let weights = polygon.weights().map(|old| {
        // At an end of an open polygon the only neighbour stands for both.
        let [round_before, round_after] = if polygon.is_periodic() {
            [old.last(), old.first()]
        } else {
            [old.first(), old.last()]
        };
        let neighbour =
            |found: Option<&f64>, round: Option<&f64>| found.or(round).copied().unwrap_or(1.0);
        let before = neighbour(old.get(index.wrapping_sub(1)), round_before);
        let after = neighbour(old.get(index), round_after);
        let mut weights = old.to_vec();
        weights.insert(index, (before * after).sqrt());
        weights
    });
    FloatPolygon::new(polygon.degree(), vertices, weights, polygon.is_periodic())
}

/// Remove vertices, by their numbers in rising order. The degree stays.
///
/// # Errors
/// [`PolygonError::TooFewVertices`] if the rest is no curve of this degree.
fn without(polygon: &FloatPolygon, indices: &[usize]) -> Result<FloatPolygon, PolygonError> {
    let kept = |index: &usize| indices.binary_search(index).is_err();
    let all = 0..polygon.vertices().len();
    let vertices = all
        .clone()
        .filter(kept)
        .map(|i| polygon.vertex(i))
        .collect();
    let weights = polygon
        .weights()
        .map(|old| all.filter(kept).map(|i| old[i]).collect());
    FloatPolygon::new(polygon.degree(), vertices, weights, polygon.is_periodic())
}

/// The edit that makes a curve periodic or opens it.
///
/// Opened, it keeps its shape and begins and ends at its joint ([`FloatPolygon::unrolled`]). A periodic curve runs round
/// all vertices; those that an opened one repeats go again ([`FloatPolygon::rolled`]).
///
/// # Errors
/// [`EditError`] if there are too few vertices, or one of those that go is locked and not quite where the first is.
pub fn periodicity(id: CurveId, curve: &Curve, periodic: bool) -> Result<Edit, EditError> {
    let old = &curve.polygon;
    let polygon = match periodic {
        true => rolled(curve)?,
        false => old.unrolled(),
    };
    let [before, now] = [old, &polygon].map(|it| it.vertices().len());
    let round = before.min(now);
    let is_locked = |vertex: &usize| {
        let held = |vertex| curve.locked_vertices.contains(vertex);
        held(vertex % round) || (now < before && held(vertex + now))
    };
    let common = old.segments().min(polygon.segments()) as f64;
    let same = ParameterSpan::shifted([0.0, common], 0.0);
    Ok(Edit::Renumber {
        curve: id,
        renumbering: Renumbering::of_parameters(curve, &polygon, vec![same])
            .with_locked_vertices((0..now).filter(is_locked).collect()),
        polygon,
    })
}

/// The polygon of a curve that runs round its vertices.
fn rolled(curve: &Curve) -> Result<FloatPolygon, EditError> {
    let old = &curve.polygon;
    if let Some(rolled) = old.rolled() {
        let kept = rolled.vertices().len();
        let moves = |vertex: &usize| old.vertex(*vertex) != old.vertex(vertex - kept);
        curve.check_vertices_unlocked((kept..old.vertices().len()).filter(moves))?;
        return Ok(rolled);
    }
    let weights = old.weights().map(<[f64]>::to_vec);
    let polygon = FloatPolygon::new(old.degree(), old.vertices().to_vec(), weights, true);
    polygon.map_err(|error| EditError::Polygon {
        name: curve.name.clone(),
        error,
    })
}
