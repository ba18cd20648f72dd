//! Measure a distance, its direction and, between two points of a curve, the arc length.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::tool::{Context, Effect, Tool};
use crate::document::{Curve, CurveId, Document, MatchPlace, Reference};
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, along_axis, snap_to_grid, snap_to_point};
use crate::editor::view::scene::{Mark, MeasuredFigure};
use crate::geometry::{End, arc_length_between, significant};

/// To what part of itself an arc length is found.
const TOLERANCE: f64 = 1e-12;

/// The digits of figures, and of those that are found to plotting accuracy.
const DIGITS: usize = 8;
const PLOTTED_DIGITS: usize = 5;

/// What rounding leaves of a difference of coordinates, in units of them.
const ROUNDING: f64 = 1e-14;

/// How far a point may be from a curve that it lies on, in units of its coordinates or 1.
const ON_CURVE: f64 = 1e-9;

/// The measure tool's state. Points are those of the model, so that the figures stay true when it
/// is looked at from another side.
#[derive(Debug, Default)]
pub struct MeasureTool {
    state: State,
}

#[derive(Clone, Debug, Default)]
enum State {
    #[default]
    Idle,
    /// The first point is set, the second follows the pointer. A drag began where `dragged` says.
    From { from: Place, dragged: Option<DVec2> },
    /// Both are set and stay until the next measurement, or Esc.
    Between(Measured),
}

/// A point that is measured from or to, with the curves and references on which it lies and its
/// parameters there.
#[derive(Clone, Debug)]
struct Place {
    point: DVec3,
    on: Vec<(CurveId, f64)>,
}

/// Two points, and the arc between them if they lie on one curve.
#[derive(Clone, Debug)]
struct Measured {
    from: DVec3,
    to: DVec3,
    arc: Option<MeasuredArc>,
}

/// The arc between two points of a curve.
#[derive(Clone, Debug)]
struct MeasuredArc {
    id: CurveId,
    /// The curve or the reference as it was measured.
    shape: Shape,
    parameters: [f64; 2],
    /// Its length; of a periodic curve that of the other way round too.
    lengths: Vec<f64>,
}

#[derive(Clone, Debug)]
enum Shape {
    Curve(Arc<Curve>),
    Reference(Arc<Reference>),
}

impl Shape {
    fn of(id: CurveId, document: &Document) -> Option<Self> {
        let curve = || document.curve(id).cloned().map(Self::Curve);
        let reference = || document.reference(id).cloned().map(Self::Reference);
        curve().or_else(reference)
    }

    fn is_in(&self, id: CurveId, document: &Document) -> bool {
        match (self, Self::of(id, document)) {
            (Self::Curve(was), Some(Self::Curve(now))) => Arc::ptr_eq(was, &now),
            (Self::Reference(was), Some(Self::Reference(now))) => Arc::ptr_eq(was, &now),
            _ => false,
        }
    }
}

impl MeasuredArc {
    fn between(from: &Place, to: &Place, document: &Document) -> Option<Self> {
        let (id, parameters) = common(from, to)?;
        let curve = document.shape(id)?;
        let [u, v] = parameters;
        let mut lengths = vec![arc_length_between(curve, u.min(v), u.max(v), TOLERANCE)];
        if curve.is_periodic() {
            let whole = arc_length_between(curve, 0.0, curve.pieces() as f64, TOLERANCE);
            lengths.extend(lengths.first().map(|length| whole - length));
            lengths.sort_by(f64::total_cmp);
        }
        Some(Self {
            id,
            shape: Shape::of(id, document)?,
            parameters,
            lengths,
        })
    }
}

/// The first curve that both lie on.
fn common(from: &Place, to: &Place) -> Option<(CurveId, [f64; 2])> {
    from.on.iter().find_map(|(id, u)| {
        let (_, v) = to.on.iter().find(|(other, _)| other == id)?;
        Some((*id, [*u, *v]))
    })
}

impl Place {
    /// A point, with all curves on which it lies.
    fn new(point: DVec3, context: &Context) -> Self {
        let reach = ON_CURVE * point.abs().max_element().max(1.0);
        let curves = context.hits.curves().filter_map(|(id, curve)| {
            let nearest = curve.polygon.nearest(point);
            (nearest.distance <= reach).then_some((id, nearest.u))
        });
        let references = context.document.references();
        let references = references.filter(|(_, it)| it.visible);
        let ends = references.flat_map(|(id, reference)| {
            let ends = [(End::Start, 0.0), (End::Finish, f64::INFINITY)];
            ends.into_iter().filter_map(move |(end, u)| {
                let jet = MatchPlace::End(end).jet(&reference.curve)?;
                let pieces = context.document.shape(id)?.pieces() as f64;
                (jet.point == point).then_some((id, f64::min(u, pieces)))
            })
        });
        let on = curves.chain(ends).collect();
        Self { point, on }
    }
}

impl MeasureTool {
    /// What stays of it when another tool is used: a measurement until it is dismissed.
    pub fn kept(&mut self) -> Self {
        let state = match std::mem::take(&mut self.state) {
            State::Between(measured) => State::Between(measured),
            _ => State::Idle,
        };
        Self { state }
    }

    /// Whether both points are set.
    pub fn has_measured(&self) -> bool {
        matches!(self.state, State::Between(_))
    }

    /// Take a measurement away that stays. Returns whether there was one.
    pub fn dismiss(&mut self) -> bool {
        let measured = self.has_measured();
        if measured {
            self.state = State::Idle;
        }
        measured
    }

    /// What is meant by a place of the view plane: a vertex or an end, otherwise a point of a curve,
    /// otherwise the grid if snapping is on, otherwise the point on the ground. Ctrl lets nothing attract.
    fn place(&self, at: DVec2, context: &Context) -> Place {
        let view = context.viewport;
        if let (State::From { from, .. }, true) = (&self.state, context.modifiers.shift) {
            let by = along_axis(at - view.flatten(from.point));
            return Place::new(from.point + view.movement(by, true), context);
        }
        let free = |point| Place {
            point,
            on: Vec::new(),
        };
        if context.modifiers.ctrl {
            return free(view.grounded(at));
        }
        if let Some(snap) = snap_to_point(at, context.before, &Carried::default(), view) {
            return Place::new(snap.point, context);
        }
        let hit = context.hits.curve(view.to_screen(at));
        let curve = hit.and_then(|hit| Some((hit, context.document.shape(hit.curve)?)));
        if let Some((hit, curve)) = curve {
            return Place {
                point: curve.jet(hit.u).point,
                on: vec![(hit.curve, hit.u)],
            };
        }
        let grid = snap_to_grid(at, view).filter(|_| context.snapping);
        free(grid.map_or_else(|| view.grounded(at), |snap| snap.point))
    }

    /// What is measured now, with the two points.
    fn figures(&self, context: &Context) -> Option<(DVec3, DVec3, Vec<MeasuredFigure>)> {
        match &self.state {
            State::Idle => None,
            State::From { from, .. } => {
                let to = self.place(context.pointer?, context);
                let mut figures = figures(from.point, to.point);
                let arc = common(from, &to);
                let arc = arc.and_then(|(id, parameters)| about(id, parameters, context));
                figures.extend(arc);
                Some((from.point, to.point, figures))
            }
            State::Between(measured) => {
                let mut figures = figures(measured.from, measured.to);
                figures.extend(measured.arc(context));
                Some((measured.from, measured.to, figures))
            }
        }
    }

    /// Set the first point, by a click or where a drag begins.
    fn begin(&mut self, place: DVec2, dragged: Option<DVec2>, context: &Context) {
        self.state = State::Idle;
        let from = self.place(context.model(place), context);
        self.state = State::From { from, dragged };
    }

    /// Set the second point.
    fn end(&mut self, from: &Place, place: DVec2, context: &Context) {
        let to = self.place(context.model(place), context);
        self.state = State::Between(Measured {
            from: from.point,
            to: to.point,
            arc: MeasuredArc::between(from, &to, context.document),
        });
    }
}

impl Measured {
    /// The arc length; to plotting accuracy once the curve has changed, as long as both points lie on it.
    fn arc(&self, context: &Context) -> Option<MeasuredFigure> {
        let arc = self.arc.as_ref()?;
        if arc.shape.is_in(arc.id, context.document) {
            return Some(arc_length(arc.lengths.clone(), false));
        }
        let curve = context.document.shape(arc.id)?;
        let ends = arc.parameters.into_iter().zip([self.from, self.to]);
        let mut ends = ends.map(|(u, point)| (curve.jet(u).point.distance(point), point));
        let lies =
            |(off, point): (f64, DVec3)| off <= ON_CURVE * point.abs().max_element().max(1.0);
        if !ends.all(lies) {
            return None;
        }
        about(arc.id, arc.parameters, context)
    }
}

/// The arc length to plotting accuracy.
fn about(id: CurveId, [u, v]: [f64; 2], context: &Context) -> Option<MeasuredFigure> {
    let sampled = context.hits.view.analyses.sampled(id)?;
    let one_way = (sampled.length_at(u) - sampled.length_at(v)).abs();
    let other_way = sampled.samples.length() - one_way;
    let lengths = match sampled.curve.is_periodic() {
        true => vec![one_way.min(other_way), one_way.max(other_way)],
        false => vec![one_way],
    };
    Some(arc_length(lengths, true))
}

fn arc_length(values: Vec<f64>, is_about: bool) -> MeasuredFigure {
    MeasuredFigure {
        name: "Arc length",
        values,
        is_angle: false,
        is_about,
    }
}

/// A distance in space and its parts and, within a plane of two axes, its direction.
fn figures(from: DVec3, to: DVec3) -> Vec<MeasuredFigure> {
    const NAMES: [&str; 3] = ["Δx", "Δy", "Δz"];
    let figure = |name: &'static str, value: f64, is_angle: bool| MeasuredFigure {
        name,
        values: vec![value],
        is_angle,
        is_about: false,
    };
    let rounding = ROUNDING * from.abs().max(to.abs());
    let span = DVec3::select((to - from).abs().cmple(rounding), DVec3::ZERO, to - from);
    let part = |axis: usize| figure(NAMES[axis], span[axis], false);
    let mut figures = vec![figure("Distance", span.length(), false)];
    // The plane z = 0 first: it is where planar curves are.
    match [2, 1, 0].into_iter().find(|normal| span[*normal] == 0.0) {
        Some(normal) => {
            let [across, along] = [[1, 2], [0, 2], [0, 1]][normal];
            let angle = DVec2::new(span[across], span[along]).to_angle();
            figures.extend([part(across), part(along)]);
            figures.push(figure("Angle", angle.to_degrees(), true));
        }
        None => figures.extend([0, 1, 2].map(part)),
    }
    figures
}

/// Say figures in full, in one line.
fn told(figures: &[MeasuredFigure]) -> String {
    let text = |figure: &MeasuredFigure| {
        let digits = if figure.is_about {
            PLOTTED_DIGITS
        } else {
            DIGITS
        };
        figure.text(|value| significant(value, digits))
    };
    figures
        .iter()
        .map(text)
        .collect::<Vec<String>>()
        .join("   ")
}

impl Tool for MeasureTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (self.state.clone(), gesture) {
            // A hasty click is a short drag: it sets one point, as a click does.
            (
                State::From {
                    from,
                    dragged: Some(origin),
                },
                Gesture::DragEnd(place),
            ) if is_hasty_click(origin, place) => {
                self.state = State::From {
                    from,
                    dragged: None,
                };
            }
            (State::From { from, .. }, Gesture::Click(place) | Gesture::DragEnd(place)) => {
                self.end(&from, place, context);
            }
            // The second point is where the drag ends.
            (State::From { .. }, Gesture::DragStart(_)) => {}
            (_, Gesture::Click(place)) => self.begin(place, None, context),
            (_, Gesture::DragStart(place)) => self.begin(place, Some(place), context),
            (State::Idle, Gesture::Key(Key::Escape)) => return vec![Effect::Finish],
            (_, Gesture::Key(Key::Escape) | Gesture::Cancel) => self.state = State::Idle,
            _ => {}
        }
        Vec::new()
    }

    fn hint(&self, context: &Context) -> String {
        match (&self.state, self.figures(context)) {
            (State::From { .. }, Some((_, _, figures))) => {
                format!("{}   Shift locks to an axis", told(&figures))
            }
            (State::Between(_), Some((_, _, figures))) => {
                format!("{}   Esc removes it", told(&figures))
            }
            _ => "Click two points, or drag, to measure between them; Esc ends".into(),
        }
    }

    fn undo_label(&self) -> Option<&'static str> {
        matches!(self.state, State::From { .. }).then_some("first point")
    }

    fn undo(&mut self) {
        self.state = State::Idle;
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let view = context.viewport;
        let snapped = || {
            let at = context.pointer?;
            let place = view.flatten(self.place(at, context).point);
            (place != at).then_some(Mark::Snap(place))
        };
        let Some((from, to, figures)) = self.figures(context) else {
            return snapped().into_iter().collect();
        };
        let [from, to] = [from, to].map(|point| view.flatten(point));
        let ruler = [
            Mark::Ruler([from, to]),
            Mark::Measured(0.5 * (from + to), figures),
        ];
        let snap = snapped().filter(|_| !self.has_measured());
        ruler.into_iter().chain(snap).collect()
    }
}
