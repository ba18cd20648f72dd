//! What a document becomes in a format of another program.

use super::chains;
use super::cubics::Cubics;
use super::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape};
use crate::document::{Curve, Document, Group, Reference};
use crate::geometry::PolygonKind;
use crate::geometry::references::{Nurbs as KnownNurbs, ReferenceCurve, ReferenceForm};
use crate::io::error::WriteError;
use crate::io::loss::{Loss, LossReport};
use crate::io::polygon::FilePolygon;

/// The names that a format holds of the path of a group.
pub(in crate::io) type KeptGroup = fn(&[String]) -> Vec<String>;

/// Say what an item is that a format cannot hold.
pub(in crate::io) type Holds = fn(&Item) -> Result<(), String>;

/// What a format makes of a document.
#[derive(Clone, Copy)]
pub(in crate::io) struct Manner {
    /// How curves are written.
    pub(in crate::io) written: Written,
    /// What the format holds of groups.
    pub(in crate::io) kept: KeptGroup,
    /// What it holds of items: the others are left out.
    pub(in crate::io) holds: Holds,
    /// What it holds of names and colours.
    pub(in crate::io) marks: Marks,
    /// Which shapes become splines of the same form.
    pub(in crate::io) as_splines: fn(&Shape) -> bool,
    /// Whether it holds that items are hidden.
    pub(in crate::io) hides: bool,
    /// Whether it has polycurves.
    pub(in crate::io) chains: bool,
}

/// What a format holds of the names and colours of items.
#[derive(Clone, Copy)]
pub(in crate::io) struct Marks {
    pub(in crate::io) names: bool,
    pub(in crate::io) colours: bool,
}

impl Marks {
    /// Both.
    pub(in crate::io) const ALL: Self = Self {
        names: true,
        colours: true,
    };
    /// Names alone.
    pub(in crate::io) const NAMES: Self = Self {
        colours: false,
        ..Self::ALL
    };
    /// Neither.
    pub(in crate::io) const NONE: Self = Self {
        names: false,
        colours: false,
    };

    fn report(self, name: &str, is_coloured: bool, losses: &mut LossReport) {
        if !self.names {
            losses.losses.push((name.to_owned(), Loss::Unnamed));
        }
        if !self.colours && is_coloured {
            losses.losses.push((name.to_owned(), Loss::Colour));
        }
    }
}

/// How curves are written.
#[derive(Clone, Copy)]
pub(in crate::io) enum Written {
    /// On the knots of one of their polygons.
    Knots(PolygonKind),
    /// As Béziers up to degree 3; other planar curves as few cubics within a length, or 1e-4 of their size.
    Cubics(Option<f64>),
}

impl Drawing {
    /// Take curves by one of their polygons or as cubics, and references that formats of other programs can hold.
    /// What the format cannot hold is left out.
    ///
    /// # Errors
    /// [`WriteError::NoCurves`]; [`WriteError::Refused`] if everything is left out.
    pub(super) fn of(
        document: &Document,
        manner: &Manner,
        losses: &mut LossReport,
    ) -> Result<Self, WriteError> {
        let mut drawing = Self {
            unit: document.unit().map(|unit| unit.millimetres()),
            ..Self::default()
        };
        for (_, curve) in document.curves() {
            drawing.items.extend(Item::of_curve(curve, manner, losses));
        }
        for (_, reference) in document.references() {
            let items = Item::of_reference(reference, manner, losses);
            drawing.items.extend(items);
        }
        if manner.chains {
            let items = std::mem::take(&mut drawing.items);
            let holds = |item: &Item| (manner.holds)(item).is_ok();
            drawing.items = chains::joined(items, holds, losses, |item, losses| {
                let name = item.name.as_deref().unwrap_or_default();
                report_group(name, &Group::new(&item.group[..]), manner.kept, losses);
            });
        }
        let format = losses.format;
        match (drawing.items.is_empty(), losses.first_left_out()) {
            (false, _) => Ok(drawing),
            (true, Some(reason)) => Err(WriteError::Refused { format, reason }),
            (true, None) => Err(WriteError::NoCurves { format }),
        }
    }
}

impl Item {
    /// What a curve becomes; `None` if the format cannot hold it.
    pub(in crate::io) fn of_curve(
        curve: &Curve,
        manner: &Manner,
        losses: &mut LossReport,
    ) -> Option<Self> {
        let mut own = LossReport::new(losses.format);
        report(curve, manner.hides, &mut own);
        report_group(&curve.name, &curve.group, manner.kept, &mut own);
        let is_coloured = curve.colour.is_some();
        manner.marks.report(&curve.name, is_coloured, &mut own);
        let shape = manner.written.shape(curve, &mut own);
        let item = Self {
            group: curve.group.names().into(),
            hidden: !curve.visible,
            colour: curve.colour.map(|colour| colour.0),
            ..named(&curve.name, Kind::Spline, shape)
        };
        item.held(manner, own.losses, true, losses)
    }

    /// What a reference becomes, single points an item each; nothing if the format, or any, cannot hold it.
    pub(in crate::io) fn of_reference(
        reference: &Reference,
        manner: &Manner,
        losses: &mut LossReport,
    ) -> Vec<Self> {
        let Some((kind, shapes)) = shapes(&reference.curve) else {
            losses.add_reference(reference);
            return Vec::new();
        };
        let mut own = LossReport::new(losses.format);
        report_group(&reference.name, &reference.group, manner.kept, &mut own);
        let is_coloured = reference.colour.is_some();
        manner.marks.report(&reference.name, is_coloured, &mut own);
        own.add_state(
            &reference.name,
            reference.visible || manner.hides,
            reference.locked,
        );
        let items = shapes.into_iter().filter_map(|shape| {
            let named = |shape: Shape| Self {
                group: reference.group.names().into(),
                hidden: !reference.visible,
                colour: reference.colour.map(|colour| colour.0),
                ..named(&reference.name, kind, shape)
            };
            let item = named(shape.clone());
            let item = match (manner.holds)(&item) {
                Ok(()) => item,
                Err(_) => named(in_beziers(shape)),
            };
            if item.shapes.iter().any(manner.as_splines) {
                let loss = Loss::AsSpline { was: kind.name() };
                own.losses.push((reference.name.clone(), loss));
            }
            item.held(manner, std::mem::take(&mut own.losses), false, losses)
        });
        items.collect()
    }

    /// The item with its own losses, or the loss of it as a whole.
    fn held(
        self,
        manner: &Manner,
        own: Vec<(String, Loss)>,
        is_curve: bool,
        losses: &mut LossReport,
    ) -> Option<Self> {
        match (manner.holds)(&self) {
            Ok(()) => {
                losses.losses.extend(own);
                Some(self)
            }
            Err(what) => {
                let loss = Loss::LeftOut { what, is_curve };
                let name = self.name.unwrap_or_default();
                losses.losses.push((name, loss));
                None
            }
        }
    }
}

/// The highest degree of a chain of Béziers in formats for drawing.
const CUBIC: usize = 3;

impl Written {
    fn shape(self, curve: &Curve, losses: &mut LossReport) -> Shape {
        let polygon = &curve.polygon;
        let is_cubic = polygon.degree() <= CUBIC && !polygon.is_rational();
        match self {
            Self::Cubics(within) if polygon.is_planar() && !is_cubic => {
                let Cubics { chain, difference } = Cubics::along(polygon, within);
                losses.add(curve, Loss::Cubics(difference));
                Shape::Nurbs(chain)
            }
            Self::Cubics(_) => spline(curve, PolygonKind::Bezier, losses),
            Self::Knots(kind) => spline(curve, kind, losses),
        }
    }
}

/// A spline with every inner knot as multiple as its degree: the same curve as a chain of Béziers.
fn in_beziers(shape: Shape) -> Shape {
    let chain = match &shape {
        Shape::Nurbs(nurbs) => nurbs.checked().ok().and_then(|it| it.bezier_chain()),
        _ => None,
    };
    chain.map_or(shape, |chain| Shape::Nurbs(drawn(&chain)))
}

fn drawn(nurbs: &KnownNurbs) -> Nurbs {
    Nurbs {
        degree: nurbs.degree(),
        knots: nurbs.knots().to_vec(),
        points: nurbs.points().to_vec(),
        weights: nurbs.weights().map(<[f64]>::to_vec),
        periodic: nurbs.is_periodic(),
    }
}

fn named(name: &str, kind: Kind, shape: Shape) -> Item {
    Item {
        name: Some(name.to_owned()),
        ..Item::new(kind, vec![shape])
    }
}

fn report(curve: &Curve, hides: bool, losses: &mut LossReport) {
    losses.add_attributes(curve);
    losses.losses.retain(|(_, loss)| *loss != Loss::Colour);
    losses.add_state(&curve.name, curve.visible || hides, curve.locked);
}

fn report_group(name: &str, group: &Group, kept: KeptGroup, losses: &mut LossReport) {
    if !group.is_none() {
        losses.add_group(name, group, Group::new(kept(group.names())));
    }
}

fn spline(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> Shape {
    let polygon = FilePolygon::of(&curve.polygon, kind);
    losses.extend(curve, polygon.losses(&curve.polygon));
    let FilePolygon {
        degree,
        mut vertices,
        mut weights,
        periodic,
        ..
    } = polygon;
    if periodic {
        // The knots go round: the first vertices come again.
        vertices.extend_from_within(..degree);
        if let Some(weights) = &mut weights {
            weights.extend_from_within(..degree);
        }
    }
    let count = vertices.len();
    let place = |knot: usize| -> f64 {
        let index = knot as f64 - degree as f64;
        match kind {
            PolygonKind::Float => index,
            PolygonKind::Clamped => index.clamp(0.0, (count - degree) as f64),
            PolygonKind::Bezier => {
                let segments = ((count - 1) / degree) as f64;
                ((knot as f64 - 1.0) / degree as f64)
                    .floor()
                    .clamp(0.0, segments)
            }
        }
    };
    Shape::Nurbs(Nurbs {
        degree,
        knots: (0..=count + degree).map(place).collect(),
        points: vertices,
        weights,
        periodic,
    })
}

/// A reference as other programs know it: one shape, but for single points; `None` for formulas and spirals.
pub(in crate::io) fn shapes(curve: &ReferenceCurve) -> Option<(Kind, Vec<Shape>)> {
    let placement = curve.placement();
    match curve.form() {
        ReferenceForm::Points(list) if list.is_apart() => {
            let points = list.points().iter();
            let points = points.map(|point| Shape::Point(placement.point(*point)));
            Some((Kind::Point, points.collect()))
        }
        _ => shape(curve).map(|(kind, shape)| (kind, vec![shape])),
    }
}

fn shape(curve: &ReferenceCurve) -> Option<(Kind, Shape)> {
    let placement = curve.placement();
    match curve.form() {
        ReferenceForm::Points(list) => {
            let points = list.points().iter();
            let points: Vec<_> = points.map(|point| placement.point(*point)).collect();
            let closed = false;
            let kind = match points.len() {
                2 => Kind::Line,
                _ => Kind::Polyline,
            };
            Some((kind, Shape::Polyline { points, closed }))
        }
        ReferenceForm::Nurbs(nurbs) if curve.interval() == nurbs.interval() => {
            let mut drawn = drawn(nurbs);
            for point in &mut drawn.points {
                *point = placement.point(*point);
            }
            Some((Kind::Spline, Shape::Nurbs(drawn)))
        }
        ReferenceForm::Analytic(form) => {
            let [a, b] = match (form.kind().name, form.values()) {
                ("circle", [radius]) => [*radius; 2],
                ("ellipse", [a, b]) => [*a, *b],
                _ => return None,
            };
            let [from, to] = curve.interval();
            let conic = Conic {
                centre: placement.translation(),
                x: a * placement.vector(glam::DVec3::X),
                y: b * placement.vector(glam::DVec3::Y),
                from,
                to,
            };
            let kind = match conic.is_whole() {
                _ if a != b => Kind::Ellipse,
                true => Kind::Circle,
                false => Kind::Arc,
            };
            Some((kind, Shape::Conic(conic)))
        }
        _ => None,
    }
}
