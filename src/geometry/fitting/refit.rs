//! Fits to a curve: nearly the same curve with other features.

use glam::{DVec2, DVec3};

use super::levels::{FAR, Task};
use super::problem::{Data, EndCondition, EndValue, HeldVertex, PlacedCurve};
use super::slope_coefficients::SlopeTables;
use super::symmetry_axis::SymmetryAxis;
use crate::geometry::end::End;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;
use crate::geometry::symmetry::Symmetry;

/// The samples of a segment that the new curve is near to.
const SAMPLES: usize = 6;

/// What the new curve has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) struct Refit<'a> {
    /// The number of curvature extrema.
    pub(in crate::geometry) extrema: usize,
    /// The number of inflections; `None` for any.
    pub(in crate::geometry) inflections: Option<usize>,
    /// Up to which derivative each end stays as it is: `Some(0)` for the point, `Some(2)` for point, direction
    /// and curvature.
    pub(in crate::geometry) kept: [Option<usize>; 2],
    /// The vertices that stay.
    pub(in crate::geometry) locked: &'a [usize],
    /// The rule that the polygon follows. An open one is fitted as its own mirror image: with an odd number of extrema
    /// and an even one of inflections.
    pub(in crate::geometry) symmetry: Option<Symmetry>,
}

/// Where the fit sees the curve: about as large as 1, its axis of symmetry on the y axis.
struct Place {
    middle: DVec2,
    /// The direction of the fit's x axis.
    across: DVec2,
    unit: f64,
}

impl Place {
    /// Around points, and where there is one on an axis, by a point and a normal of length 1.
    fn around(points: &[DVec2], axis: Option<[DVec2; 2]>) -> Option<Self> {
        let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let unit = 2.0_f64.powi((high - low).max_element().log2().ceil() as i32);
        let middle = 0.5 * low + 0.5 * high;
        let [through, across] = axis.unwrap_or([middle, DVec2::X]);
        let place = Self {
            middle: middle - (middle - through).dot(across) * across,
            across,
            unit,
        };
        (unit > 0.0 && unit.is_finite()).then_some(place)
    }

    fn direction(&self, vector: DVec2) -> DVec2 {
        DVec2::new(self.across.dot(vector), self.across.perp_dot(vector))
    }

    fn point(&self, point: DVec2) -> DVec2 {
        self.direction(point - self.middle) / self.unit
    }

    fn back(&self, point: DVec2) -> DVec2 {
        self.unit * (point.x * self.across + point.y * self.across.perp()) + self.middle
    }
}

/// Find a planar curve near another one with so many extrema, the same degree and number of vertices, proved.
///
/// `None` if none is found, or the computation was cancelled.
pub(in crate::geometry) fn refit(
    polygon: &FloatPolygon,
    asked: &Refit,
    progress: &Progress,
) -> Option<FloatPolygon> {
    let segments = polygon.segments();
    let samples = SAMPLES * segments + usize::from(!polygon.is_periodic());
    let place = |sample: usize| polygon.point(sample as f64 / SAMPLES as f64).truncate();
    let points: Vec<DVec2> = (0..samples).map(place).collect();
    let axis = asked.symmetry.filter(|_| !polygon.is_periodic());
    let axis = axis.and_then(|it| it.mirror().plane());
    let place_of_fit = Place::around(&points, axis.map(|it| it.map(DVec3::truncate)))?;
    let is_possible = asked.extrema % 2 == 1 && asked.inflections.is_none_or(|it| it % 2 == 0);
    if axis.is_some() && !is_possible {
        return None;
    }
    let points: Vec<DVec2> = points
        .into_iter()
        .map(|it| place_of_fit.point(it))
        .collect();
    let weights = vec![1.0; points.len()];
    let counts = vec![true; points.len()];
    let ends = ends(polygon, asked.kept, &place_of_fit);
    let own = polygon.vertices().iter();
    let own = own.map(|it| place_of_fit.point(it.truncate()));
    let own = PlacedCurve {
        vertices: own.collect(),
        places: (0..samples).map(|it| it as f64 / SAMPLES as f64).collect(),
    };
    let held = asked.locked.iter();
    let held = held.filter_map(|vertex| {
        let point = *own.vertices.get(*vertex)?;
        let vertex = *vertex;
        Some(HeldVertex { vertex, point })
    });
    let held: Vec<HeldVertex> = held.collect();
    let tables = SlopeTables::new(polygon.degree());
    let task = Task {
        data: Data {
            points: &points,
            weights: &weights,
            counts: &counts,
            ends: &ends,
            held: &held,
            mirror: axis.map(|_| SymmetryAxis::Y),
            calms_ends: false,
        },
        degree: polygon.degree(),
        periodic: polygon.is_periodic(),
        extrema: asked.extrema,
        inflections: asked.inflections,
        count: Some(polygon.vertices().len()),
        most: polygon.vertices().len(),
        tolerance: None,
        far: FAR,
        known: Some(&own),
        tables: &tables,
        progress,
    };
    let levels = task.levels(&[], &|_| ()).into_iter();
    let whole = levels.filter(|level| level.splines.count == polygon.vertices().len());
    let best = whole.min_by(|a, b| a.largest.total_cmp(&b.largest))?;
    let vertices = best.start.curve.vertices.iter();
    let vertices = vertices.map(|vertex| place_of_fit.back(*vertex).extend(0.0));
    let mut vertices: Vec<DVec3> = vertices.collect();
    for vertex in asked.locked {
        // To the last digit.
        if let Some(moved) = vertices.get_mut(*vertex) {
            *moved = polygon.vertex(*vertex);
        }
    }
    let degree = polygon.degree();
    FloatPolygon::new(degree, vertices, None, polygon.is_periodic()).ok()
}

/// The conditions at the ends of an open curve.
fn ends(polygon: &FloatPolygon, kept: [Option<usize>; 2], place: &Place) -> Vec<EndCondition> {
    if polygon.is_periodic() {
        return Vec::new();
    }
    let mut conditions = Vec::new();
    for (end, order) in [End::Start, End::Finish].into_iter().zip(kept) {
        let Some(order) = order else { continue };
        let jet = polygon.end_jet(end);
        let point = EndValue::Point(place.point(jet.point.truncate()));
        let direction = jet.tangent().map(|it| place.direction(it.truncate()));
        let direction = direction.map(EndValue::Direction);
        let curvature = place.unit * jet.signed_curvature();
        let curvature = Some(EndValue::Curvature(curvature)).filter(|_| curvature.is_finite());
        let values = [Some(point), direction, curvature]
            .into_iter()
            .take(order + 1);
        conditions.extend(values.flatten().map(|value| EndCondition { end, value }));
    }
    conditions
}
