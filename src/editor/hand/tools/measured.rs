//! A measurement: two points, the distance between them, and the arc between them if they lie on one curve.

use glam::{DVec2, DVec3};

use crate::analysis::Item;
use crate::document::{CurveId, Document};
use crate::editor::view::Sight;
use crate::editor::view::scene::{Mark, MeasuredFigure};
use crate::geometry::arc_length_between;
use crate::geometry::references::ReferenceForm;

/// To what part of itself an arc length is found.
const TOLERANCE: f64 = 1e-12;

/// What rounding leaves of a difference of coordinates, in units of them.
const ROUNDING: f64 = 1e-14;

/// How far a point may be from a curve that it lies on, in units of its coordinates or 1.
const ON_CURVE: f64 = 1e-9;

/// A point that is measured from or to, with the curves and references on which it lies and its
/// parameters there.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub point: DVec3,
    pub on: Vec<(CurveId, f64)>,
}

/// A finished measurement. Points are those of the model, so that the figures stay true when it is looked at
/// from another side.
#[derive(Clone, Debug)]
pub struct Measurement {
    from: DVec3,
    to: DVec3,
    arc: Option<MeasuredArc>,
    on_picture: Option<OnPicture>,
}

/// Two points of a picture.
#[derive(Clone, Debug)]
struct OnPicture {
    id: CurveId,
    /// The points before its frame is placed.
    ends: [DVec3; 2],
}

/// The arc between two points of a curve.
#[derive(Clone, Debug)]
struct MeasuredArc {
    id: CurveId,
    /// The curve or the reference as it was measured.
    item: Item,
    parameters: [f64; 2],
    /// Its length; of a periodic curve that of the other way round too.
    lengths: Vec<f64>,
}

impl Measurement {
    /// Measure between two points; on a picture if it is the active item and holds both.
    pub(super) fn between(
        from: &Place,
        to: &Place,
        document: &Document,
        active: Option<CurveId>,
    ) -> Self {
        Self {
            from: from.point,
            to: to.point,
            arc: MeasuredArc::between(from, to, document),
            on_picture: active.and_then(|id| OnPicture::of(id, [from.point, to.point], document)),
        }
    }

    /// Its points: those on a picture go along with it.
    pub(in crate::editor) fn ends(&self, document: &Document) -> [DVec3; 2] {
        let placed = self.on_picture.as_ref().and_then(|on| {
            let reference = document.reference(on.id)?;
            reference.framed()?;
            let placement = reference.curve.placement();
            Some(on.ends.map(|end| placement.point(end)))
        });
        placed.unwrap_or([self.from, self.to])
    }

    /// The picture that both points lie on.
    pub(in crate::editor) fn picture(&self) -> Option<CurveId> {
        self.on_picture.as_ref().map(|on| on.id)
    }

    /// The figures. Once the curve has changed, the arc length is to plotting accuracy, as long as both points
    /// lie on it.
    pub(super) fn figures(&self, sight: Sight<'_>) -> Vec<MeasuredFigure> {
        let [from, to] = self.ends(sight.document());
        let mut figures = figures(from, to);
        figures.extend(self.arc_length(sight));
        figures
    }

    /// The ruler with the figures.
    pub(in crate::editor) fn marks(&self, sight: Sight<'_>) -> [Mark; 2] {
        ruler(self.ends(sight.document()), self.figures(sight), sight)
    }

    fn arc_length(&self, sight: Sight<'_>) -> Option<MeasuredFigure> {
        let arc = self.arc.as_ref()?;
        if arc.item.is_of(sight.document(), arc.id) {
            return Some(arc_length(arc.lengths.clone(), false));
        }
        let curve = sight.document().shape(arc.id)?;
        let mut ends = arc.parameters.into_iter().zip([self.from, self.to]);
        let lies = |(u, point): (f64, DVec3)| curve.jet(u).point.distance(point) <= reach(point);
        if !ends.all(lies) {
            return None;
        }
        plotted_arc_length(arc.id, arc.parameters, sight)
    }
}

impl OnPicture {
    /// Two points as those of a picture, if it holds both.
    fn of(id: CurveId, ends: [DVec3; 2], document: &Document) -> Option<Self> {
        let curve = &document.reference(id)?.curve;
        let ReferenceForm::Frame(frame) = curve.form() else {
            return None;
        };
        let placement = curve.placement();
        let turned = placement.rotation().inverse();
        let ends = ends.map(|end| turned * (end - placement.translation()) / placement.scale());
        let holds = |end: DVec3| {
            let end = end.truncate();
            end.cmpge(DVec2::ZERO).all() && end.cmple(frame.size()).all()
        };
        ends.into_iter().all(holds).then_some(Self { id, ends })
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
            item: Item::of(document, id)?,
            parameters,
            lengths,
        })
    }
}

/// How far a point may be from a curve that it lies on.
pub(super) fn reach(point: DVec3) -> f64 {
    ON_CURVE * point.abs().max_element().max(1.0)
}

/// The line between two points, with figures.
pub(super) fn ruler(
    points: [DVec3; 2],
    figures: Vec<MeasuredFigure>,
    sight: Sight<'_>,
) -> [Mark; 2] {
    let [from, to] = points.map(|point| sight.view.pane.viewport.flatten(point));
    [
        Mark::Ruler([from, to]),
        Mark::Measured(0.5 * (from + to), figures),
    ]
}

/// The figures of two points that are not both set: the arc length is to plotting accuracy.
pub(super) fn plotted_figures(from: &Place, to: &Place, sight: Sight<'_>) -> Vec<MeasuredFigure> {
    let mut figures = figures(from.point, to.point);
    let arc = common(from, to);
    figures.extend(arc.and_then(|(id, parameters)| plotted_arc_length(id, parameters, sight)));
    figures
}

/// The first curve that both lie on.
fn common(from: &Place, to: &Place) -> Option<(CurveId, [f64; 2])> {
    from.on.iter().find_map(|(id, u)| {
        let (_, v) = to.on.iter().find(|(other, _)| other == id)?;
        Some((*id, [*u, *v]))
    })
}

/// The arc length to plotting accuracy.
fn plotted_arc_length(id: CurveId, [u, v]: [f64; 2], sight: Sight<'_>) -> Option<MeasuredFigure> {
    let sampled = sight.view.analyses.sampled(id)?;
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
