//! What becomes of a drawing: curves where a float polygon is exact, references elsewhere.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use super::chains::piece_name;
use super::choice::{ImportChoice, RowKey, free_space};
use super::drawing::{Affine, Conic, Drawing, Item, Kind, Nurbs as DrawnNurbs, Shape, Space};
use super::single_points::{SinglePoint, common, lists};
use crate::document::{Colour, Curve, Group, Reference};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{
    AnalyticForm, Nurbs, Placement, PointList, ReferenceCurve, ReferenceError, ReferenceForm,
    formulas,
};
use crate::geometry::{NearestFloat, PolygonKind, counted};
use crate::io::reading::{Reading, Remark};

/// Axes whose angle or length differs by less than this share are perpendicular, or of one length.
const SAME: f64 = 1e-12;

/// Points that are so little apart, per size, are one: pieces of a spline meet there.
const JOINED: f64 = 1e-12;

/// What a shape becomes.
pub(super) enum Made {
    Curve(NearestFloat),
    Reference(ReferenceCurve),
}

impl Drawing {
    /// Make curves and references of the free items: those of blocks too, but not layouts for printing. Edges of solids
    /// are taken where nothing is free. Lengths are in the file's unit, or in millimetres where Batten has
    /// no such unit.
    pub fn reading(&self) -> Reading {
        let space = free_space(self.items.iter().map(|item| item.space));
        self.taken(|item| item.space == space)
    }

    /// Make curves and references of what is chosen, in the chosen unit where the file says none. What is left out
    /// is counted in a remark.
    pub fn reading_of(&self, choice: &ImportChoice) -> Reading {
        let mut reading = self.taken(|item| choice.taken.contains(&RowKey::of(item)));
        reading.unit = reading.unit.or(choice.unit);
        reading
    }

    /// The item and the shape of which each curve, then each reference of [`Drawing::reading`] is made; `None` for
    /// lists of single points.
    pub(in crate::io) fn sources(&self) -> [Vec<Option<ShapePlace>>; 2] {
        let space = free_space(self.items.iter().map(|item| item.space));
        self.taken_from(|item| item.space == space).1
    }

    fn taken(&self, is_taken: impl Fn(&Item) -> bool) -> Reading {
        self.taken_from(is_taken).0
    }

    fn taken_from(
        &self,
        is_taken: impl Fn(&Item) -> bool,
    ) -> (Reading, [Vec<Option<ShapePlace>>; 2]) {
        let (unit, factor) = unit_of(self.unit);
        let mut taken = Taken {
            reading: Reading {
                unit,
                ..Reading::default()
            },
            names: Names::default(),
            chains: Names::default(),
            points: Vec::new(),
            crowds: HashMap::new(),
            last_group: Group::default(),
            sources: Default::default(),
            factor,
            is_nameless: self.is_nameless,
        };
        for item in &self.items {
            *taken.crowds.entry(&item.group).or_default() += 1;
        }
        let items = self.items.iter().enumerate();
        let (chosen, rest): (Vec<_>, Vec<_>) = items.partition(|(_, item)| is_taken(item));
        for (index, item) in &chosen {
            taken.take(*index, item);
        }
        let [chosen, rest] = [chosen, rest].map(|items| {
            let items = items.into_iter().map(|(_, item)| item);
            items.collect::<Vec<&Item>>()
        });
        taken.finish(self, &chosen, &rest)
    }
}

/// The place of an item in a drawing, and that of a shape in the item.
pub(in crate::io) type ShapePlace = [usize; 2];

impl DrawnNurbs {
    /// Check the knots and points of a file.
    ///
    /// # Errors
    /// [`ReferenceError`] if they are no curve.
    pub fn checked(&self) -> Result<Nurbs, ReferenceError> {
        let whole = self.joined();
        let (knots, points) = (&whole.knots[..], &whole.points[..]);
        let weights = whole.weights.clone();
        Ok(Nurbs::new(
            whole.degree,
            knots,
            points,
            weights,
            whole.periodic,
        )?)
    }

    /// The same curve without the points that stand twice, at both sides of an inner knot that is once more multiple
    /// than the degree: its pieces meet there.
    fn joined(&self) -> Cow<'_, Self> {
        let (n, knots, points) = (self.degree, &self.knots, &self.points);
        let Some(last) = knots
            .get(points.len())
            .filter(|_| (1..points.len()).contains(&n))
        else {
            return Cow::Borrowed(self);
        };
        let size = points.iter().map(|it| it.abs().max_element());
        let near = JOINED * size.fold(0.0, f64::max);
        let meet = |index: usize| {
            let weights = self.weights.as_ref();
            let are_alike = weights.is_none_or(|it| it.get(index - 1) == it.get(index));
            are_alike && points[index - 1].distance(points[index]) <= near
        };
        let is_doubled = |index: usize| {
            let (first, behind) = (knots[index], knots.get(index + n));
            behind == Some(&first) && knots[index - 1] < first && first < *last && meet(index)
        };
        let doubled: HashSet<usize> = (n + 1..points.len()).filter(|it| is_doubled(*it)).collect();
        if doubled.is_empty() {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self {
            knots: without(knots, &doubled),
            points: without(points, &doubled),
            weights: self.weights.as_ref().map(|it| without(it, &doubled)),
            ..*self
        })
    }
}

/// The elements that are not at some places.
fn without<T: Copy>(all: &[T], places: &HashSet<usize>) -> Vec<T> {
    let kept = all
        .iter()
        .enumerate()
        .filter(|(index, _)| !places.contains(index));
    kept.map(|(_, element)| *element).collect()
}

/// The unit of a file with so many millimetres to its unit, and the factor to it.
fn unit_of(millimetres: Option<f64>) -> (Option<LengthUnit>, f64) {
    let Some(millimetres) = millimetres else {
        return (None, 1.0);
    };
    let found = LengthUnit::ALL
        .into_iter()
        .find(|unit| unit.millimetres() == millimetres);
    match found {
        Some(unit) => (Some(unit), 1.0),
        None => (Some(LengthUnit::Millimetre), millimetres),
    }
}

/// A colour of its own: black is what lines have without one.
fn own_colour(colour: [u8; 3]) -> Option<Colour> {
    (colour != [0; 3]).then_some(Colour(colour))
}

/// What was taken so far.
struct Taken<'d> {
    reading: Reading,
    names: Names,
    /// The names of items of several pieces, each of which is a group.
    chains: Names,
    /// The single points.
    points: Vec<SinglePoint<'d>>,
    /// How many items each group has.
    crowds: HashMap<&'d [String], usize>,
    /// The group of the last item.
    last_group: Group,
    /// Of what each curve, then each reference is made.
    sources: [Vec<Option<ShapePlace>>; 2],
    factor: f64,
    /// Whether layers stand for the names of items.
    is_nameless: bool,
}

/// The names of a group: the path of an item, its block, and the item itself if it has several pieces.
fn path<'a>(
    layers: &'a [String],
    block: Option<&'a str>,
    chain: Option<&'a str>,
) -> impl Iterator<Item = &'a str> {
    layers.iter().map(String::as_str).chain(block).chain(chain)
}

/// The layer that items without one are on: in DXF, which has no names of items, and in 3DM.
fn is_default(layer: &str, is_nameless: bool) -> bool {
    layer == "0" || (layer == "Default" && !is_nameless)
}

impl<'d> Taken<'d> {
    fn take(&mut self, place: usize, item: &'d Item) {
        let shapes = item.shapes.len();
        let (own, layers) = self.placed(item);
        let chain = (shapes > 1).then(|| match own {
            Some(name) => self.chains.free(name),
            None => {
                let name = self.names.of_kind(item.kind);
                self.chains.free(&name)
            }
        });
        let group = Group::new(path(layers, item.block.as_deref(), chain.as_deref()));
        let group = self.shared(group);
        for (index, shape) in item.shapes.iter().enumerate() {
            if let Shape::Point(point) = shape {
                let point = self.factor * *point;
                self.points.push(SinglePoint { point, item });
                continue;
            }
            let name = match (&chain, own) {
                (Some(chain), _) => self.names.free(&piece_name(chain, index + 1)),
                (None, Some(name)) => self.names.free(name),
                (None, None) => self.names.of_kind(item.kind),
            };
            match Made::of(&scaled(shape, self.factor)) {
                Ok(Made::Curve(near)) => {
                    self.sources[0].push(Some([place, index]));
                    self.add_curve(name, near, item, group.clone());
                }
                Ok(Made::Reference(curve)) => {
                    self.sources[1].push(Some([place, index]));
                    self.tell_long_chain(&name, &curve);
                    let mut reference = Reference::new(name, curve).in_group(group.clone());
                    reference.colour = item.colour.and_then(own_colour);
                    reference.visible = !item.hidden;
                    self.reading.references.push(Arc::new(reference));
                }
                Err(error) => self.tell(format!("{name} (at {}) is left out: {error}", item.at)),
            }
        }
    }

    /// The group of the item before, where it is the same.
    fn shared(&mut self, group: Group) -> Group {
        if self.last_group != group {
            self.last_group = group;
        }
        self.last_group.clone()
    }

    /// Tell that a chain of Béziers is too long to look for its float polygon.
    fn tell_long_chain(&mut self, name: &str, curve: &ReferenceCurve) {
        if let ReferenceForm::Nurbs(nurbs) = curve.form()
            && nurbs.is_long_chain()
        {
            let count = nurbs.points().len();
            self.tell(format!(
                "{name}: {count} points of Béziers stay a reference, a float polygon is not looked for"
            ));
        }
    }

    /// The name of an item, and the layers that become its group: not that which items without one are on.
    fn placed<'a>(&self, item: &'a Item) -> (Option<&'a String>, &'a [String]) {
        match (&item.name, &item.group[..]) {
            (name, [layer]) if is_default(layer, self.is_nameless) => (name.as_ref(), &[]),
            (None, [outer @ .., layer]) if self.are_layer(item, 1) => (Some(layer), outer),
            (name, layers) => (name.as_ref(), layers),
        }
    }

    /// Whether so many items are all that its layer has, in a format that has layers in place of names.
    fn are_layer(&self, item: &Item, count: usize) -> bool {
        let on_layer = self.crowds.get(&item.group[..]);
        self.is_nameless && on_layer == Some(&count) && item.block.is_none()
    }

    fn add_curve(&mut self, name: String, near: NearestFloat, item: &Item, group: Group) {
        let number = self.reading.curves.len() + 1;
        if !near.is_close {
            self.reading.remarks.add(Remark::CurveOff {
                curve: (number, name.clone()),
                kind: PolygonKind::Clamped,
                by: near.deviation,
            });
        }
        let mut curve = Curve::new(name, near.polygon).in_group(group);
        curve.colour = item.colour.and_then(own_colour);
        curve.visible = !item.hidden;
        self.reading.curves.push(Arc::new(curve));
    }

    fn tell(&mut self, text: String) {
        self.reading.remarks.add(Remark::Drawn(text));
    }

    /// Add the points, and say what was not taken.
    fn finish(
        mut self,
        drawing: &Drawing,
        chosen: &[&Item],
        rest: &[&Item],
    ) -> (Reading, [Vec<Option<ShapePlace>>; 2]) {
        for list in lists(std::mem::take(&mut self.points)) {
            match &list[..] {
                [only] => {
                    let at = only.item.at;
                    self.tell(format!(
                        "a single point (at {at}) is left out: a list has two or more"
                    ));
                }
                _ => self.add_points(&list),
            }
        }
        let count = |items: &[&Item], space: Space| {
            let of_space = items.iter().filter(|item| item.space == space);
            of_space.count()
        };
        let is_edges_alone = count(rest, Space::Model) == 0 && count(chosen, Space::Model) == 0;
        if is_edges_alone && count(chosen, Space::Edge) > 0 {
            let taken = edges(count(chosen, Space::Edge));
            self.tell(format!("{taken} taken: there is no free curve"));
        }
        let printed = |count| {
            let [one, many] = ["item of a layout", "items of layouts"];
            format!("{} for printing", counted(count, one, many))
        };
        let not_chosen = |count| format!("{} not chosen,", counted(count, "item", "items"));
        let words: [(Space, &dyn Fn(usize) -> String); 3] = [
            (Space::Model, &not_chosen),
            (Space::Paper, &printed),
            (Space::Edge, &edges),
        ];
        for (space, words) in words {
            let count = count(rest, space);
            if count > 0 {
                self.tell(format!("{} left out", words(count)));
            }
        }
        let others = drawing.other.iter();
        let others: Vec<String> = others.map(|it| it.told(drawing.is_binary)).collect();
        if !others.is_empty() {
            self.tell(format!("not understood: {}", others.join("; ")));
        }
        if self.factor != 1.0 {
            let told = format!(
                "lengths are read in mm: the file's unit is {} mm",
                self.factor
            );
            self.tell(told);
        }
        for remark in &drawing.remarks {
            self.tell(remark.clone());
        }
        (self.reading, self.sources)
    }

    /// Add a list of single points, with the name, the layer and the colour that all of them have. What differs is
    /// told.
    fn add_points(&mut self, list: &[SinglePoint]) {
        let name = common(list, |item| item.name.as_deref());
        let place = common(list, |item| (&item.group, &item.block));
        let colour = common(list, |item| item.colour);
        let are_layer = place.is_some() && self.are_layer(list[0].item, list.len());
        let (own, group) = match place {
            None => (None, Group::default()),
            Some((layers, block)) => match &layers[..] {
                [layer] if is_default(layer, self.is_nameless) => (None, Group::new(block)),
                [outer @ .., layer] if are_layer => (Some(layer.as_str()), Group::new(outer)),
                layers => (None, Group::new(path(layers, block.as_deref(), None))),
            },
        };
        let name_of_all = name.flatten().or(own).unwrap_or("points");
        let name_of_all = self.names.free(name_of_all);
        let differing = [
            (name.is_none(), "names"),
            (place.is_none(), "layers"),
            (colour.is_none(), "colours"),
        ];
        for (_, what) in differing.iter().filter(|(differs, _)| *differs) {
            let what =
                format!("{name_of_all}: its points had {what} of their own, which it has not");
            self.tell(what);
        }
        let points = list.iter().map(|it| it.point).collect();
        let points = PointList::new(points).map(PointList::apart);
        let curve = points.and_then(|list| ReferenceCurve::of(ReferenceForm::Points(list)));
        match curve {
            Ok(curve) => {
                let mut reference = Reference::new(name_of_all, curve).in_group(group);
                reference.colour = colour.flatten().and_then(own_colour);
                reference.visible = !list[0].item.hidden;
                self.sources[1].push(None);
                self.reading.references.push(Arc::new(reference));
            }
            Err(error) => self.tell(format!("{name_of_all} is left out: {error}")),
        }
    }
}

/// Names that differ.
#[derive(Default)]
struct Names {
    taken: HashSet<String>,
    /// The number behind each name at which to go on.
    next: HashMap<String, usize>,
    /// How many items of each kind have no name of their own.
    counts: HashMap<Kind, usize>,
}

impl Names {
    fn free(&mut self, name: &str) -> String {
        if self.taken.insert(name.to_owned()) {
            return name.to_owned();
        }
        let number = self.next.entry(name.to_owned()).or_insert(2);
        loop {
            let numbered = format!("{name} {number}");
            *number += 1;
            if self.taken.insert(numbered.clone()) {
                return numbered;
            }
        }
    }

    fn of_kind(&mut self, kind: Kind) -> String {
        let count = self.counts.entry(kind).or_default();
        *count += 1;
        let name = kind.numbered(*count);
        self.free(&name)
    }
}

fn scaled(shape: &Shape, factor: f64) -> Cow<'_, Shape> {
    match factor == 1.0 {
        true => Cow::Borrowed(shape),
        false => Cow::Owned(shape.clone().placed(&Affine::scaling(factor))),
    }
}

/// Count edges.
fn edges(count: usize) -> String {
    counted(
        count,
        "edge of a solid or surface",
        "edges of solids and surfaces",
    )
}

impl Made {
    /// Make a curve of a shape where a float polygon is exact, otherwise a reference. A single point is none.
    ///
    /// # Errors
    /// [`ReferenceError`] if the shape is no curve.
    pub(super) fn of(shape: &Shape) -> Result<Self, ReferenceError> {
        let reference = match shape {
            Shape::Nurbs(drawn) => {
                let nurbs = drawn.checked()?;
                if let Some(near) = nurbs.float_polygon() {
                    return Ok(Made::Curve(near));
                }
                ReferenceCurve::of(ReferenceForm::Nurbs(nurbs))?
            }
            Shape::Conic(conic) => ellipse(conic)?,
            Shape::Polyline { points, closed } => {
                let first = points.first();
                let again = first.filter(|first| *closed && points.last() != Some(first));
                let points = points.iter().chain(again).copied().collect();
                ReferenceCurve::of(ReferenceForm::Points(PointList::new(points)?))?
            }
            Shape::Point(point) => {
                let list = PointList::new(vec![*point])?;
                ReferenceCurve::of(ReferenceForm::Points(list))?
            }
        };
        Ok(Made::Reference(reference))
    }
}

/// The circle or ellipse over its part, placed.
fn ellipse(conic: &Conic) -> Result<ReferenceCurve, ReferenceError> {
    let Conic {
        centre,
        x,
        y,
        from,
        to,
    } = conic.with_axes();
    let [a, b] = [x, y].map(DVec3::length);
    let form = match (a - b).abs() <= SAME * a {
        true => AnalyticForm::new(&formulas::CIRCLE, vec![a])?,
        false => AnalyticForm::new(&formulas::ELLIPSE, vec![a, b])?,
    };
    let placement = Placement::new(rotation(x / a, y / b), 1.0, centre)?;
    ReferenceCurve::new(ReferenceForm::Analytic(form), [from, to], placement)
}

/// The rotation that leads the axes x and y to two perpendicular directions. In the plane it turns about z alone, or
/// turns the plane over, to the bit.
fn rotation(x: DVec3, y: DVec3) -> DQuat {
    let z = x.cross(y);
    if x.z == 0.0 && y.z == 0.0 {
        let half = 0.5 * x.y.atan2(x.x);
        return match z.z > 0.0 {
            true => DQuat::from_xyzw(0.0, 0.0, half.sin(), half.cos()),
            false => DQuat::from_xyzw(half.cos(), half.sin(), 0.0, 0.0),
        };
    }
    DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z)).normalize()
}

impl Conic {
    /// The same arc by perpendicular half-axes.
    fn with_axes(&self) -> Self {
        let [x, y] = [self.x, self.y];
        let (across, lengths) = (x.dot(y), [x.length(), y.length()]);
        if across.abs() <= SAME * lengths[0] * lengths[1] {
            return self.clone();
        }
        let turn = 0.5 * (2.0 * across).atan2(x.length_squared() - y.length_squared());
        let (sin, cos) = turn.sin_cos();
        Self {
            x: cos * x + sin * y,
            y: cos * y - sin * x,
            from: self.from - turn,
            to: self.to - turn,
            centre: self.centre,
        }
    }
}
