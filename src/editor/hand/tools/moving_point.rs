//! A drag of a point of a curve, or of a vertex of its closed S-polygon: the float polygon follows.

use glam::{DVec2, DVec3};

use super::move_drag::MoveDrag;
use super::tool::{Context, Effect};
use crate::document::{Curve, CurveId, quoted};
use crate::editor::hand::following::{DraggedPoint, Followers, Following, PointKind};
use crate::editor::hand::snapping::Carried;
use crate::editor::view::scene::Mark;
use crate::geometry::{Continuity, End, FloatPolygon, significant};

/// A press near an end, by segments and by a share of all, takes the end where a drag of the point moves vertices more
/// than so many times as far.
const NEAR_END: f64 = 0.5;
const NEAR_SHARE: f64 = 0.1;
const MOST_MAGNIFIED: f64 = 10.0;

/// Vertices within so many screen points of a dragged point follow it, however many there are.
const NEAR: f64 = 24.0;

/// The state of the drag.
#[derive(Debug)]
pub struct MovingPoint {
    drag: MoveDrag,
    curve: CurveId,
    point: DraggedPoint,
    /// Where the point was.
    from: DVec3,
    planar: bool,
    /// The tangent at a matched end, along which alone the vertex beside it moves.
    slide: Option<Slide>,
}

/// A way that a point slides along.
#[derive(Clone, Copy, Debug)]
struct Slide {
    /// Its direction, of length 1.
    along: DVec3,
    /// How far back it goes.
    back: f64,
}

impl Slide {
    fn of(self, by: DVec3) -> DVec3 {
        by.dot(self.along).max(-self.back) * self.along
    }
}

/// The share of the way to its end that a vertex slides back.
const MOST_BACK: f64 = 0.9;

impl MovingPoint {
    /// Begin with the pointer at a place on the canvas; the label of the step comes with it.
    ///
    /// # Errors
    /// Why the point cannot be dragged.
    pub fn begin(
        place: DVec2,
        id: CurveId,
        kind: PointKind,
        context: &Context,
    ) -> Result<(Self, String), String> {
        let curve = context.before.curve(id).ok_or_else(String::new)?;
        curve.check_editable().map_err(|error| error.to_string())?;
        let least_span = crowding(&curve.polygon, kind, context);
        let point = DraggedPoint { kind, least_span };
        let point = taken(curve, point, &context.following)?;
        let from = point.kind.place(&curve.polygon).ok_or_else(String::new)?;
        let slide = slide(id, &curve.polygon, point.kind, context)?;
        let planar = curve.polygon.is_planar();
        let carried = Carried {
            item: Some(id),
            is_off_ground: !planar,
            ..Carried::default()
        };
        let held = context.viewport.flatten(from);
        let label = match point.kind {
            PointKind::Clamped(index) => format!("Move vertex {index} of closed S-polygon"),
            PointKind::OnCurve(_) => "Move point of curve".to_owned(),
        };
        let moving = Self {
            drag: MoveDrag::begin(place, held, carried, context),
            curve: id,
            point,
            from,
            planar,
            slide,
        };
        Ok((moving, label))
    }

    /// Go on with the pointer at a place on the canvas.
    pub fn drag(&mut self, place: DVec2, context: &Context) -> Effect {
        let by = self.drag.go_on(place, context);
        let by = context.movement(by, self.planar);
        let by = self.slide.map_or(by, |slide| slide.of(by));
        let following = &context.following;
        let edit = following.point_edit(context.before, self.curve, self.point, by);
        Effect::preview(edit.map(|edit| vec![edit]))
    }

    /// What the wheel sets.
    pub fn wheel_turns(&self, following: &Following) -> Option<Followers> {
        let stays = following.closed_stay && matches!(self.point.kind, PointKind::Clamped(_));
        (!stays).then_some(Followers::OfPoint)
    }

    /// The hint for the status bar.
    pub fn hint(&self, context: &Context) -> String {
        let what = match self.point.kind {
            PointKind::Clamped(index) => format!("vertex {index} of the closed S-polygon"),
            PointKind::OnCurve(_) => "the curve".to_owned(),
        };
        let words = self.words(context).unwrap_or_default();
        let turned = match self.wheel_turns(&context.following) {
            Some(_) => "the wheel sets how many",
            None => "Esc cancels",
        };
        format!("Moving {what}: {words}; {turned}")
    }

    /// The marks on the canvas.
    pub fn marks(&self, context: &Context) -> Vec<Mark> {
        let curve = context.document.curve(self.curve);
        let now = curve.and_then(|curve| self.point.kind.place(&curve.polygon));
        let readout = now.map(|now| {
            let lag = self
                .drag
                .lag(self.curve, [self.from, now], self.planar, context);
            let remark = lag.map(str::to_owned).or_else(|| self.words(context));
            self.drag
                .readout([self.from, now], !self.planar, remark, context)
        });
        self.drag.marks(readout, context)
    }

    /// How many vertices follow, and how far the float S-polygon moves where that is much farther.
    fn words(&self, context: &Context) -> Option<String> {
        let curve = context.before.curve(self.curve)?;
        let following = &context.following;
        match (self.point.kind, self.wheel_turns(following)) {
            (PointKind::Clamped(index), None) => {
                let times = curve.polygon.clamped_vertex_amplification(index)?;
                Some(magnified_words(times))
            }
            _ => {
                let followers = following.point_words(&curve.polygon, self.point);
                let times = following.point_magnification(curve, self.point).ok();
                let times = times.filter(|times| *times > MOST_MAGNIFIED);
                Some(match times {
                    Some(times) => format!("{followers}; {}", magnified_words(times)),
                    None => followers,
                })
            }
        }
    }
}

/// The way that a closed vertex slides along because its match holds the tangent; `None` for other points.
///
/// # Errors
/// Says so where a match holds the point itself.
fn slide(
    id: CurveId,
    polygon: &FloatPolygon,
    kind: PointKind,
    context: &Context,
) -> Result<Option<Slide>, String> {
    let PointKind::Clamped(index) = kind else {
        return Ok(None);
    };
    if polygon.is_periodic() {
        return Ok(None);
    }
    let last = polygon.segments() + polygon.degree() - 1;
    let sides = [
        (End::Start, index),
        (End::Finish, last.saturating_sub(index)),
    ];
    for (end, steps) in sides {
        let Some(matched) = context.before.match_of(id, end) else {
            continue;
        };
        let jet = polygon.end_jet(end);
        let place = kind.place(polygon).unwrap_or(jet.point);
        match (steps, (place - jet.point).try_normalize()) {
            (0, _) => {
                let source = context.before.name(matched.source).unwrap_or_default();
                let (end, source) = (end.name(), quoted(source));
                return Err(format!("The {end} follows {source}: the match holds it"));
            }
            (1, Some(along)) if matched.continuity != Continuity::G0 => {
                let back = MOST_BACK * place.distance(jet.point);
                return Ok(Some(Slide { along, back }));
            }
            _ => {}
        }
    }
    Ok(None)
}

/// Say how far the float S-polygon moves with a point.
fn magnified_words(times: f64) -> String {
    let times = significant(times, 3);
    format!("the float S-polygon moves up to {times}× as far")
}

/// The point that a press takes: the end of a curve beside which no other point can be dragged well.
fn taken(
    curve: &Curve,
    point: DraggedPoint,
    following: &Following,
) -> Result<DraggedPoint, String> {
    let PointKind::OnCurve(u) = point.kind else {
        return Ok(point);
    };
    let polygon = &curve.polygon;
    let times = following.point_magnification(curve, point);
    let is_well = times.as_ref().is_ok_and(|times| *times <= MOST_MAGNIFIED);
    let last = polygon.vertices().len().saturating_sub(1);
    let segments = polygon.segments() as f64;
    let near = NEAR_END.min(NEAR_SHARE * segments);
    let end = match u {
        u if u <= near => Some(0),
        u if segments - u <= near => Some(last),
        _ => None,
    };
    match end.filter(|_| !is_well && !polygon.is_periodic()) {
        Some(index) => Ok(DraggedPoint {
            kind: PointKind::Clamped(index),
            ..point
        }),
        None => times.map(|_| point).map_err(|error| error.to_string()),
    }
}

/// How many vertices are near a point of a curve on the canvas, on each side, beyond those that it depends on.
fn crowding(polygon: &FloatPolygon, kind: PointKind, context: &Context) -> usize {
    let PointKind::OnCurve(u) = kind else {
        return 0;
    };
    let speed = polygon.jet(u).first.length() / context.viewport.pixel();
    let near = (NEAR / speed).min(polygon.vertices().len() as f64);
    (near as usize).saturating_sub(polygon.degree() / 2)
}
