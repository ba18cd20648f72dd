//! Places on the curve of a previewed operation: drags of handles and clicks set the parameters there.

use glam::DVec2;

use super::{Operating, OperationInProgress};
use crate::document::CurveId;
use crate::editor::hand::tools::Context;
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::{REACH, Viewport};
use crate::geometry::{End, FloatPolygon, Intersection, MAX_ADDED_SEGMENTS};
use crate::operations::{Handle, OnCurve, Sets, Value};

impl Operating<'_> {
    /// Set the value whose handle is nearest along the curve to a click on it. Returns whether a curve was clicked.
    pub(super) fn click_on_curve(&mut self, at: DVec2) -> bool {
        let context = self.context();
        let given = self.previewed().and_then(|it| it.clicked(at, &context));
        let Some(given) = given else {
            return false;
        };
        if let Err(error) = self.set_values(&given) {
            Message::tell_update(self.message, Some(Refusal(error.to_string())));
        }
        true
    }
}

impl OperationInProgress {
    /// Whether a click on the curve sets a value.
    pub(in crate::editor) fn takes_clicks_on_curve(&self) -> bool {
        self.on_curve().next().is_some()
    }

    /// The values that a handle on the curve sets when it is dragged to a place of the view plane.
    pub(super) fn values_on_curve(
        &self,
        handle: &Handle,
        on_curve: &OnCurve,
        place: DVec2,
        context: &Context<'_>,
    ) -> Vec<(&'static str, Value)> {
        let Ok((id, curve)) = self.input.curve() else {
            return Vec::new();
        };
        let polygon = &curve.polygon;
        let u = match *on_curve {
            OnCurve::Beyond { end, from, .. } => beyond(polygon, end, from, place, context),
            OnCurve::Number(_) | OnCurve::PartEnd { .. } => {
                parameter_at((id, polygon), self.set_parameter(handle), place, context)
            }
        };
        u.map(|u| on_curve.values(u)).unwrap_or_default()
    }

    /// The values that a click on the curve sets: those of the handle that is nearest along it.
    fn clicked(&self, at: DVec2, context: &Context<'_>) -> Option<Vec<(&'static str, Value)>> {
        let (id, curve) = self.input.curve().ok()?;
        let polygon = &curve.polygon;
        let place = context.model(at);
        let seen = seen(polygon, context.viewport)?;
        let nearest = seen.nearest(place.extend(0.0));
        if nearest.distance > REACH * context.viewport.pixel() {
            return None;
        }
        let u = parameter_at((id, polygon), None, place, context)?;
        let turn = polygon.segments() as f64;
        let apart = |handle: &Handle| {
            let own = self.set_parameter(handle).unwrap_or(0.0);
            let apart = (own - u).abs();
            match polygon.is_periodic() {
                true => (apart % turn).min(turn - apart % turn),
                false => apart,
            }
        };
        let nearest = self
            .on_curve()
            .min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)));
        nearest.map(|(_, on_curve)| on_curve.values(u))
    }

    /// The handles whose values are parameters of the curve.
    fn on_curve(&self) -> impl Iterator<Item = (&Handle, &OnCurve)> {
        let handles = self.handles().iter();
        handles.filter_map(|handle| match &handle.sets {
            Sets::OnCurve(OnCurve::Beyond { .. }) => None,
            Sets::OnCurve(on_curve) => Some((handle, on_curve)),
            _ => None,
        })
    }

    /// The present value of the parameter that a handle sets.
    fn set_parameter(&self, handle: &Handle) -> Option<f64> {
        let names = handle.parameters();
        let parameter = names.first().and_then(|name| self.parameter(name))?;
        match self.values.get(parameter) {
            Value::Real(u) => Some(*u),
            _ => None,
        }
    }
}

/// The parameter of the point of a curve that is seen nearest to a place of the view plane, beside `now` if the curve
/// passes there. With snapping an intersection attracts, and so does a knot.
fn parameter_at(
    (id, polygon): (CurveId, &FloatPolygon),
    now: Option<f64>,
    place: DVec2,
    context: &Context<'_>,
) -> Option<f64> {
    let reach = REACH * context.viewport.pixel();
    let seen = seen(polygon, context.viewport)?;
    let target = place.extend(0.0);
    let beside = now.map(|now| seen.parameter_near(target, now));
    let beside = beside.filter(|u| seen.point(*u).distance(target) <= reach);
    let u = beside.unwrap_or_else(|| seen.nearest(target).u);
    if !context.snaps() {
        return Some(u);
    }
    let others = context
        .hits
        .passes(context.viewport.to_screen(place), |other| other != id);
    let others = others.into_iter().filter_map(|hit| {
        let other = context.document.shape(hit.curve)?;
        Intersection::near([polygon, other], [u, hit.u])
    });
    let own = seen.passes(target, reach).into_iter();
    let own = own.filter_map(|pass| Intersection::near([polygon, polygon], [u, pass.u]));
    let knot = u.round();
    let known = others.chain(own).map(|it| it.u[0]).chain([knot]);
    let distances = known.map(|u| (seen.point(u).distance(target), u));
    let near = distances.filter(|(distance, _)| *distance <= reach);
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    Some(nearest.map_or(u, |(_, u)| u))
}

/// The parameter beyond an end, by whole segments, whose point is seen nearest to a place of the view plane.
fn beyond(
    polygon: &FloatPolygon,
    end: End,
    from: f64,
    place: DVec2,
    context: &Context<'_>,
) -> Option<f64> {
    let ahead = match end {
        End::Start => -1.0,
        End::Finish => 1.0,
    };
    let parameters = (1..=MAX_ADDED_SEGMENTS).map(|count| from + ahead * count as f64);
    let distances = parameters.map(|u| {
        let seen = context.viewport.flatten(polygon.point(u));
        (seen.distance(place), u)
    });
    let finite = distances.filter(|(distance, _)| distance.is_finite());
    let nearest = finite.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, u)| u)
}

/// A curve as it is seen, in the view plane.
fn seen(polygon: &FloatPolygon, viewport: &Viewport) -> Option<FloatPolygon> {
    let vertices = polygon.vertices().iter();
    let vertices = vertices.map(|vertex| viewport.flatten(*vertex).extend(0.0));
    let weights = polygon.weights().map(<[f64]>::to_vec);
    FloatPolygon::new(
        polygon.degree(),
        vertices.collect(),
        weights,
        polygon.is_periodic(),
    )
    .ok()
}
