//! What a file of another program holds, by layer and kind, and what of it is taken.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use thiserror::Error;

use super::choice::free_space;
pub use super::choice::{ImportChoice, RowKey};
use super::drawing::{Drawing, Item, Kind, Other, Shape, Space};
use super::pieces::is_finite;
use super::remarks::Remarks;
use super::single_points::{SinglePoint, lists};
use super::splines::outermost;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::Nurbs;
use crate::geometry::{significant, widen};

/// So many items come in unasked; more are worth a look before they fill the canvas.
const FEW: usize = 20;

/// The steps between two knots of a spline at which its box is measured: a coordinate seldom turns twice between them.
const STEPS: usize = 16;

/// About so many steps along a spline of many pieces, each of which is small beside the whole.
const MOST_STEPS: usize = 1 << 16;

/// The digits of a size.
const DIGITS: usize = 4;

/// Sizes that are written as whole numbers.
const PLAIN: std::ops::Range<f64> = 1e4..1e7;

/// What a file holds of one kind on one layer.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundRow {
    /// The kind and the layer.
    pub key: RowKey,
    /// The number of items.
    pub count: usize,
    /// The degrees of its splines, rising, each once.
    pub degrees: Vec<usize>,
    /// How many are rational splines.
    pub rational: usize,
    /// How many are splines that the file calls periodic.
    pub periodic: usize,
    /// How many items the file hides.
    pub hidden: usize,
    /// How many items come from blocks or symbols.
    pub inserted: usize,
    /// How many of their pieces are curves: a float polygon holds them.
    pub curves: usize,
    /// How many of their pieces are references.
    pub references: usize,
    /// How many of these are smooth: float polygons can be made of them.
    pub smooth: usize,
    /// How many lists of points single points make.
    pub lists: usize,
    /// How many single points are in none of these: shown, then hidden ones.
    pub lone: [usize; 2],
    /// The corners of the box around them, in the unit of the file.
    pub bounds: Option<[DVec3; 2]>,
}

/// Everything that was found in a file of another program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// The length of a unit of the file in millimetres; `None` if the file does not say it.
    pub unit: Option<f64>,
    /// Whether lengths of the format have no unit at all, as in glyphs.
    pub is_unitless: bool,
    /// The items by layer and kind: free ones first, then layouts for printing, then edges.
    pub rows: Vec<FoundRow>,
    /// For each item of the drawing whether it becomes a float polygon exactly.
    pub curves: Vec<bool>,
    /// What is not understood.
    pub other: Vec<Other>,
    /// What is not wrong but better told.
    pub remarks: Vec<String>,
    /// Whether the file is binary: places in it are bytes, not lines.
    pub is_binary: bool,
}

/// What to take, by names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportFilter {
    /// The paths of layers, with what is in them; all without a name.
    pub layers: Vec<String>,
    /// The kinds; all without one.
    pub kinds: Vec<Kind>,
    /// Whether edges of solids and boundaries of surfaces are taken.
    pub edges: bool,
    /// Whether layouts for printing are taken.
    pub paper: bool,
}

/// A filter that takes nothing.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum FilterError {
    /// No layer has this name.
    #[error("there is no layer {name}: the file has {known}")]
    NoLayer {
        /// The name given.
        name: String,
        /// The layers of the file.
        known: String,
    },
    /// Nothing has the kinds on the layers.
    #[error("nothing of that kind is there: the file has {known}")]
    Nothing {
        /// The kinds and layers of the file.
        known: String,
    },
}

impl FoundRow {
    fn new(key: RowKey) -> Self {
        Self {
            key,
            count: 0,
            degrees: Vec::new(),
            rational: 0,
            periodic: 0,
            hidden: 0,
            inserted: 0,
            curves: 0,
            references: 0,
            smooth: 0,
            lists: 0,
            lone: [0; 2],
            bounds: None,
        }
    }

    /// Count an item; tell why it is no curve, if it is none. Return whether it becomes a float polygon exactly.
    fn add(&mut self, item: &Item, remarks: &mut Remarks) -> bool {
        self.count += 1;
        let known = self.curves;
        let splines = || item.shapes.iter().filter_map(Shape::nurbs);
        for nurbs in splines() {
            if let Err(place) = self.degrees.binary_search(&nurbs.degree) {
                self.degrees.insert(place, nurbs.degree);
            }
        }
        self.rational += usize::from(splines().any(|nurbs| nurbs.weights.is_some()));
        self.periodic += usize::from(splines().any(|nurbs| nurbs.periodic));
        self.hidden += usize::from(item.hidden);
        self.inserted += usize::from(item.block.is_some());
        for shape in &item.shapes {
            match shape {
                Shape::Nurbs(drawn) => match drawn.checked() {
                    Ok(nurbs) => self.add_spline(&nurbs),
                    Err(error) => {
                        let kind = item.kind.name();
                        remarks.add(format!("{kind} (at {}) is no curve: {error}", item.at));
                    }
                },
                Shape::Point(point) => widen(&mut self.bounds, *point),
                Shape::Conic(conic) if conic.is_curve() => {
                    self.references += 1;
                    self.smooth += 1;
                    outermost(conic).for_each(|it| widen(&mut self.bounds, it));
                }
                Shape::Polyline { points, .. } if points.len() > 1 && is_finite(shape) => {
                    self.references += 1;
                    points.iter().for_each(|it| widen(&mut self.bounds, *it));
                }
                Shape::Conic(_) | Shape::Polyline { .. } => {}
            }
        }
        item.shapes.len() == 1 && self.curves > known
    }

    /// Count a spline, without the conversion that would take long, and widen the box by it.
    fn add_spline(&mut self, nurbs: &Nurbs) {
        if nurbs.has_float_polygon() {
            self.curves += 1;
        } else {
            self.references += 1;
            self.smooth += 1;
        }
        let steps = (MOST_STEPS / nurbs.points().len()).clamp(1, STEPS);
        nurbs.widen(&mut self.bounds, steps);
    }

    /// Count the lists of single points.
    fn add_points(&mut self, points: Vec<SinglePoint>) {
        for list in lists(points) {
            match list[..] {
                [only] => self.lone[usize::from(only.item.hidden)] += 1,
                _ => self.lists += 1,
            }
        }
    }
}

impl Drawing {
    /// List what is in the drawing by layer and kind.
    pub fn found(&self) -> Found {
        let (places, count) = self.places();
        let mut rows: Vec<FoundRow> = Vec::with_capacity(count);
        let mut curves = Vec::with_capacity(self.items.len());
        let mut points: HashMap<usize, Vec<SinglePoint>> = HashMap::new();
        let mut remarks = Remarks::default();
        for (item, place) in self.items.iter().zip(places) {
            if place == rows.len() {
                rows.push(FoundRow::new(RowKey::of(item)));
            }
            let row = rows.get_mut(place);
            curves.push(row.is_some_and(|row| row.add(item, &mut remarks)));
            for point in SinglePoint::of(item) {
                points.entry(place).or_default().push(point);
            }
        }
        for (place, points) in points {
            if let Some(row) = rows.get_mut(place) {
                row.add_points(points);
            }
        }
        rows.sort_by_key(|row| match row.key.space {
            Space::Model => 0,
            Space::Paper => 1,
            Space::Edge => 2,
        });
        Found {
            unit: self.unit,
            is_unitless: self.is_unitless,
            rows,
            curves,
            other: self.other.clone(),
            remarks: [self.remarks.clone(), remarks.finish()].concat(),
            is_binary: self.is_binary,
        }
    }

    /// For each item the place of its row, in the order in which rows first occur, and the number of rows.
    fn places(&self) -> (Vec<usize>, usize) {
        let mut known: HashMap<(Space, &[String], Kind), usize> = HashMap::new();
        let places = self.items.iter().map(|item| {
            let next = known.len();
            let key = (item.space, &item.group[..], item.kind);
            *known.entry(key).or_insert(next)
        });
        (places.collect(), known.len())
    }
}

impl Found {
    /// What is taken at first: everything that is free, or the edges of solids where nothing is.
    pub fn choice(&self) -> ImportChoice {
        let space = free_space(self.rows.iter().map(|row| row.key.space));
        let rows = self.rows.iter().filter(|row| row.key.space == space);
        ImportChoice {
            taken: rows.map(|row| row.key.clone()).collect(),
            ..ImportChoice::default()
        }
    }

    /// Whether there is something to choose: several layers or kinds, many items, a unit that the file does not
    /// say, or something that is not understood.
    pub fn asks(&self) -> bool {
        let has_unit = self.unit.is_some() || self.is_unitless;
        let is_plain = match &self.rows[..] {
            [] => true,
            [only] => only.count <= FEW && only.key.space == Space::Model,
            _ => false,
        };
        !(has_unit && is_plain && self.other.is_empty() && self.remarks.is_empty())
    }

    /// The corners of the box around what is taken, in the unit of the file.
    pub fn bounds(&self, choice: &ImportChoice) -> Option<[DVec3; 2]> {
        let taken = self.taken(choice).filter_map(|row| row.bounds);
        taken.reduce(|[low, high], [other_low, other_high]| {
            [low.min(other_low), high.max(other_high)]
        })
    }

    /// Tell the size of what is taken, in the unit that the file says or that is chosen, and in that of the document that
    /// receives it; `None` if nothing has a size.
    pub fn size(&self, choice: &ImportChoice, receiving: Option<LengthUnit>) -> Option<String> {
        let bounds = self.bounds(choice)?;
        let Some(millimetres) = self.unit else {
            return Some(size_in_both(bounds, choice.unit, receiving));
        };
        let mut own = LengthUnit::ALL.into_iter();
        Some(match own.find(|unit| unit.millimetres() == millimetres) {
            Some(unit) => size_in_both(bounds, Some(unit), receiving),
            None => {
                let shown = receiving.unwrap_or(LengthUnit::Millimetre);
                size_told(bounds, millimetres / shown.millimetres(), Some(shown))
            }
        })
    }

    /// The unit that a file which says none is most likely in: metres if nothing that is taken is as large as 1,
    /// otherwise millimetres.
    pub fn likely_unit(&self, choice: &ImportChoice) -> Option<LengthUnit> {
        let [low, high] = self.bounds(choice)?;
        let size = (high - low).max_element();
        Some(match size < 1.0 {
            true => LengthUnit::Metre,
            false => LengthUnit::Millimetre,
        })
    }

    /// List the units that a file which says none may be in, each with the size that what is taken then has: in that
    /// unit, and in that of the document that receives it, or in millimetres.
    pub fn unit_offers(
        &self,
        choice: &ImportChoice,
        receiving: Option<LengthUnit>,
    ) -> Vec<(Option<LengthUnit>, String)> {
        let bounds = self.bounds(choice);
        let told = |unit: Option<LengthUnit>| {
            let Some(bounds) = bounds else {
                return String::new();
            };
            let shown = receiving.unwrap_or(LengthUnit::Millimetre);
            size_in_both(bounds, unit, Some(shown))
        };
        let units = LengthUnit::ALL.map(Some).into_iter();
        // Without a unit numbers count in that of the document, if it has one.
        let none = receiving.is_none().then_some(None);
        let units = units.chain(none);
        units.map(|unit| (unit, told(unit))).collect()
    }

    /// List the rows that are taken.
    pub fn taken<'a>(&'a self, choice: &'a ImportChoice) -> impl Iterator<Item = &'a FoundRow> {
        let rows = self.rows.iter();
        rows.filter(|row| choice.taken.contains(&row.key))
    }

    /// Count the references that are made of what is taken, beside those of which float polygons are made, and the single
    /// points that are left out.
    pub fn references(&self, choice: &ImportChoice) -> [usize; 2] {
        let mut count = 0;
        let mut lone = [0; 2];
        for row in self.taken(choice) {
            let floats = if choice.to_float { row.smooth } else { 0 };
            count += row.references - floats + row.lists;
            for (sum, own) in lone.iter_mut().zip(row.lone) {
                *sum += own;
            }
        }
        let joined = lone.iter().filter(|count| **count > 1).count();
        let left_out = lone.iter().filter(|count| **count == 1).count();
        [count + joined, left_out]
    }

    /// What is not understood, by name with its count and the place of the first, a line each.
    pub fn not_understood(&self) -> impl Iterator<Item = String> {
        let other = self.other.iter();
        other.map(|other| other.told(self.is_binary))
    }

    /// Choose by names. Edges and layouts are taken only on demand.
    ///
    /// # Errors
    /// [`FilterError`], naming what the file has.
    pub fn matching(&self, filter: &ImportFilter) -> Result<ImportChoice, FilterError> {
        let layers = || -> Vec<String> {
            let mut names: Vec<String> = self.rows.iter().map(|row| row.key.layer_name()).collect();
            names.sort();
            names.dedup();
            names
        };
        let is_in = |row: &FoundRow, name: &String| {
            let layer = row.key.layer_name();
            let inner = layer.strip_prefix(name.as_str());
            inner.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let has_layer = |name: &&String| !self.rows.iter().any(|row| is_in(row, name));
        if let Some(name) = filter.layers.iter().find(has_layer) {
            return Err(FilterError::NoLayer {
                name: name.clone(),
                known: layers().join(", "),
            });
        }
        let mut choice = self.choice();
        let wants = |row: &&FoundRow| {
            let is_of_space = match row.key.space {
                Space::Model => true,
                Space::Paper => filter.paper,
                Space::Edge => filter.edges,
            };
            let is_of_layer =
                filter.layers.is_empty() || filter.layers.iter().any(|name| is_in(row, name));
            let is_of_kind = filter.kinds.is_empty() || filter.kinds.contains(&row.key.kind);
            let is_offered = is_of_space || choice.taken.contains(&row.key);
            is_offered && is_of_layer && is_of_kind
        };
        let taken: HashSet<RowKey> = self
            .rows
            .iter()
            .filter(wants)
            .map(|row| row.key.clone())
            .collect();
        if taken.is_empty() && !self.rows.is_empty() {
            let known = self.rows.iter().map(|row| {
                let layer = row.key.layer_name();
                format!("{} {} on {layer}", row.count, row.key.kind.name())
            });
            let known: Vec<String> = known.collect();
            return Err(FilterError::Nothing {
                known: known.join(", "),
            });
        }
        choice.taken = taken;
        Ok(choice)
    }
}

/// Tell the sides of a box in a unit, and in another one that is shown.
fn size_in_both(bounds: [DVec3; 2], unit: Option<LengthUnit>, shown: Option<LengthUnit>) -> String {
    let own = size_told(bounds, 1.0, unit);
    match unit.zip(shown).filter(|(unit, shown)| unit != shown) {
        None => own,
        Some((unit, shown)) => {
            let factor = unit.millimetres() / shown.millimetres();
            format!("{own} = {}", size_told(bounds, factor, Some(shown)))
        }
    }
}

/// Tell the sides of a box in a unit: two in the plane, three in space.
pub fn size_told([low, high]: [DVec3; 2], factor: f64, unit: Option<LengthUnit>) -> String {
    let sides = factor * (high - low);
    let axes = if sides.z == 0.0 { 2 } else { 3 };
    let sides = sides.to_array().into_iter().take(axes);
    let sides = sides.map(|side| match PLAIN.contains(&side) {
        true => format!("{side:.0}"),
        false => trimmed(significant(side, DIGITS)),
    });
    let sides: Vec<String> = sides.collect();
    LengthUnit::behind(unit, sides.join(" × "))
}

/// Leave out zeros at the end of decimals.
fn trimmed(text: String) -> String {
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::exchange::drawing::{Conic, Nurbs};

    fn item(layer: &[&str], kind: Kind, space: Space, shape: Shape) -> Item {
        Item {
            group: layer.iter().map(|it| (*it).to_owned()).collect(),
            space,
            at: 7,
            ..Item::new(kind, vec![shape])
        }
    }

    fn line(to: [f64; 2]) -> Shape {
        Shape::Polyline {
            points: vec![DVec3::ZERO, DVec3::new(to[0], to[1], 0.0)],
            closed: false,
        }
    }

    /// A cubic on uneven knots, which no float polygon holds.
    fn uneven() -> Shape {
        let corner = |index: usize| DVec3::new(index as f64, (index % 2) as f64, 0.0);
        Shape::Nurbs(Nurbs {
            degree: 3,
            knots: vec![0.0, 0.0, 0.0, 0.0, 1.0, 4.0, 5.0, 5.0, 5.0, 5.0],
            points: (0..6).map(corner).collect(),
            weights: None,
            periodic: false,
        })
    }

    fn circle() -> Shape {
        Shape::Conic(Conic {
            centre: DVec3::new(10.0, 0.0, 0.0),
            x: 2.0 * DVec3::X,
            y: 2.0 * DVec3::Y,
            from: 0.0,
            to: std::f64::consts::TAU,
        })
    }

    fn drawing() -> Drawing {
        let mut drawing = Drawing {
            items: vec![
                item(&["Deck"], Kind::Line, Space::Model, line([3.0, 4.0])),
                item(&["Deck"], Kind::Line, Space::Model, line([-1.0, 1.0])),
                item(&["Deck", "Port"], Kind::Spline, Space::Model, uneven()),
                item(&["Deck"], Kind::Circle, Space::Paper, circle()),
                item(&[], Kind::Spline, Space::Edge, uneven()),
            ],
            ..Drawing::default()
        };
        drawing.items[1].hidden = true;
        drawing.items[2].block = Some("winch".into());
        drawing.count_other("HATCH", 120);
        drawing.count_other("HATCH", 140);
        drawing
    }

    #[test]
    fn items_are_found_by_layer_and_kind() {
        let found = drawing().found();
        let rows: Vec<(String, &str, usize)> = found
            .rows
            .iter()
            .map(|row| (row.key.layer_name(), row.key.kind.name(), row.count))
            .collect();
        let expected = [
            ("Deck", "line", 2),
            ("Deck/Port", "spline", 1),
            ("Deck", "circle", 1),
            ("no layer", "spline", 1),
        ];
        assert_eq!(
            rows,
            expected.map(|(layer, kind, count)| (layer.to_owned(), kind, count))
        );
        let spline = &found.rows[1];
        assert_eq!((&spline.degrees[..], spline.smooth), (&[3][..], 1));
        assert_eq!((found.rows[0].references, found.rows[0].smooth), (2, 0));
        let expected = [DVec3::new(-1.0, 0.0, 0.0), DVec3::new(3.0, 4.0, 0.0)];
        assert_eq!(found.rows[0].bounds, Some(expected));
        let counts = found
            .rows
            .iter()
            .map(|row| [row.hidden, row.inserted])
            .collect::<Vec<_>>();
        assert_eq!(counts, [[1, 0], [0, 1], [0, 0], [0, 0]]);
        let [low, high] = found.rows[2].bounds.expect("a box");
        assert!(low.distance(DVec3::new(8.0, -2.0, 0.0)) < 1e-12, "{low}");
        assert!(high.distance(DVec3::new(12.0, 2.0, 0.0)) < 1e-12, "{high}");
        let told: Vec<String> = found.not_understood().collect();
        assert_eq!(told, ["2 HATCH, the first at line 120"]);
    }

    #[test]
    fn free_items_are_chosen_first_and_edges_where_nothing_is_free() {
        let mut drawing = drawing();
        let taken = |drawing: &Drawing| {
            let found = drawing.found();
            let choice = found.choice();
            let rows = found.taken(&choice).map(|row| row.key.space);
            rows.collect::<Vec<_>>()
        };
        assert_eq!(taken(&drawing), [Space::Model; 2]);
        drawing.items.retain(|item| item.space != Space::Model);
        assert_eq!(taken(&drawing), [Space::Edge]);
    }

    #[test]
    fn only_a_file_with_nothing_to_choose_comes_in_unasked() {
        let plain = Drawing {
            unit: Some(1.0),
            items: vec![item(&["0"], Kind::Spline, Space::Model, uneven())],
            ..Drawing::default()
        };
        assert!(!plain.found().asks());
        let without_unit = Drawing {
            unit: None,
            ..plain.clone()
        };
        assert!(without_unit.found().asks());
        let glyph = Found {
            is_unitless: true,
            ..without_unit.found()
        };
        assert!(!glyph.asks());
        let mut many = plain.clone();
        many.items = vec![plain.items[0].clone(); FEW + 1];
        assert!(many.found().asks());
        let mut layers = plain.clone();
        layers
            .items
            .push(item(&["1"], Kind::Spline, Space::Model, uneven()));
        assert!(layers.found().asks());
        let mut unknown = plain.clone();
        unknown.count_other("HATCH", 3);
        assert!(unknown.found().asks());
    }

    #[test]
    fn names_of_layers_and_kinds_choose() {
        let found = drawing().found();
        let count = |filter: &ImportFilter| {
            let choice = found.matching(filter)?;
            Ok::<usize, FilterError>(found.taken(&choice).map(|row| row.count).sum())
        };
        let layers = |name: &str| ImportFilter {
            layers: vec![name.to_owned()],
            ..ImportFilter::default()
        };
        assert_eq!(count(&ImportFilter::default()), Ok(3));
        assert_eq!(count(&layers("Deck")), Ok(3), "with what is in it");
        assert_eq!(count(&layers("Deck/Port")), Ok(1));
        let all = ImportFilter {
            edges: true,
            paper: true,
            ..ImportFilter::default()
        };
        assert_eq!(count(&all), Ok(5));
        let lines = ImportFilter {
            kinds: vec![Kind::Line],
            ..ImportFilter::default()
        };
        assert_eq!(count(&lines), Ok(2));
        let refused = count(&layers("Dec")).expect_err("no layer");
        assert_eq!(
            refused.to_string(),
            "there is no layer Dec: the file has Deck, Deck/Port, no layer"
        );
        let arcs = ImportFilter {
            kinds: vec![Kind::Arc],
            ..ImportFilter::default()
        };
        assert!(matches!(count(&arcs), Err(FilterError::Nothing { .. })));
    }

    #[test]
    fn boxes_reach_to_where_a_coordinate_turns() {
        let bounds = |shape| {
            let drawing = Drawing {
                items: vec![item(&[], Kind::Spline, Space::Model, shape)],
                ..Drawing::default()
            };
            drawing.found().rows[0].bounds.expect("a box")
        };
        let check = |shape, expected: [[f64; 2]; 2]| {
            let found = bounds(shape).map(|corner| [corner.x, corner.y]);
            for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
                assert!((found - expected).abs() <= 1e-14, "{found} {expected}");
            }
        };
        // y = 3t(1 − t)² is greatest at t = 1/3.
        let cubic = Shape::Nurbs(Nurbs {
            degree: 3,
            knots: [[0.0; 4], [1.0; 4]].concat(),
            points: [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 0.0)]
                .map(|(x, y)| DVec3::new(x, y, 0.0))
                .to_vec(),
            weights: None,
            periodic: false,
        });
        check(cubic, [[0.0, 0.0], [3.0, 4.0 / 9.0]]);
        // A circle by three rational quadratic pieces, whose knots are at no axis.
        let circle = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let points = (0..7).map(|index| {
            let angle = 0.3 + std::f64::consts::FRAC_PI_3 * f64::from(index);
            if index % 2 == 0 {
                circle(angle)
            } else {
                2.0 * circle(angle)
            }
        });
        let weights = (0..7).map(|index| if index % 2 == 0 { 1.0 } else { 0.5 });
        let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 3.0];
        let circle = Shape::Nurbs(Nurbs {
            degree: 2,
            knots: knots.to_vec(),
            points: points.collect(),
            weights: Some(weights.collect()),
            periodic: false,
        });
        check(circle, [[-1.0, -1.0], [1.0, 1.0]]);
        // An ellipse with oblique half-axes: its box has the half sides √(3² + 1²) and √(1² + 2²).
        let ellipse = |to| {
            Shape::Conic(Conic {
                centre: DVec3::ZERO,
                x: DVec3::new(3.0, 1.0, 0.0),
                y: DVec3::new(-1.0, 2.0, 0.0),
                from: 0.0,
                to,
            })
        };
        let [a, b] = [10.0_f64.sqrt(), 5.0_f64.sqrt()];
        check(ellipse(std::f64::consts::TAU), [[-a, -b], [a, b]]);
        // A quarter of it runs from (3, 1) over its highest point to (−1, 2).
        check(
            ellipse(std::f64::consts::FRAC_PI_2),
            [[-1.0, 1.0], [3.0, b]],
        );
    }

    #[test]
    fn sizes_tell_units_apart() {
        let found = drawing().found();
        let mut choice = found.choice();
        choice.taken.retain(|key| key.kind == Kind::Line);
        let told = |receiving| -> Vec<String> {
            let offers = found.unit_offers(&choice, receiving).into_iter();
            offers.map(|(_, text)| text).collect()
        };
        assert_eq!(
            told(None),
            [
                "4 × 4 mm",
                "4 × 4 cm = 40 × 40 mm",
                "4 × 4 m = 4000 × 4000 mm",
                "4 × 4 in = 101.6 × 101.6 mm",
                "4 × 4"
            ]
        );
        let large = [DVec3::ZERO, DVec3::new(120_000.0, 45.5, 0.0)];
        assert_eq!(size_told(large, 1.0, None), "120000 × 45.5");
        let inches = told(Some(LengthUnit::Inch));
        assert_eq!(inches[0], "4 × 4 mm = 0.1575 × 0.1575 in");
        assert_eq!(inches.len(), 4, "numbers without a unit count in inches");
        choice.unit = Some(LengthUnit::Metre);
        assert_eq!(found.size(&choice, None).as_deref(), Some("4 × 4 m"));
        let inches = Found {
            unit: Some(25.4),
            ..found
        };
        let told = |receiving| inches.size(&choice, receiving);
        assert_eq!(told(None).as_deref(), Some("4 × 4 in"));
        let [inch, millimetre] = [LengthUnit::Inch, LengthUnit::Millimetre].map(Some);
        assert_eq!(told(inch).as_deref(), Some("4 × 4 in"));
        let expected = Some("4 × 4 in = 101.6 × 101.6 mm");
        assert_eq!(told(millimetre).as_deref(), expected);
    }

    #[test]
    fn what_is_not_chosen_is_told() {
        let drawing = drawing();
        let mut choice = drawing.found().choice();
        choice.taken.retain(|key| key.kind == Kind::Line);
        choice.unit = Some(LengthUnit::Inch);
        let reading = drawing.reading_of(&choice);
        assert_eq!(reading.unit, Some(LengthUnit::Inch));
        assert_eq!(reading.references.len(), 2);
        let told = reading.remarks.to_string();
        assert_eq!(
            told,
            "1 item not chosen, left out\n\
             1 item of a layout for printing left out\n\
             1 edge of a solid or surface left out\n\
             not understood: 2 HATCH, the first at line 120"
        );
    }

    #[test]
    fn pieces_of_a_spline_that_meet_at_a_full_knot_are_one_curve() {
        let spline = |gap: f64| {
            let x = [0.0, 1.0, 2.0, 2.0 + gap, 3.0, 4.0];
            Shape::Nurbs(Nurbs {
                degree: 2,
                knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0],
                points: x.map(|x| DVec3::new(x, x * x, 0.0)).to_vec(),
                weights: None,
                periodic: false,
            })
        };
        let drawing = |gap| Drawing {
            items: vec![item(&["0"], Kind::Spline, Space::Model, spline(gap))],
            ..Drawing::default()
        };
        let (reading, found) = (drawing(0.0).reading(), drawing(0.0).found());
        assert_eq!((reading.references.len(), found.remarks), (1, vec![]));
        let (reading, found) = (drawing(0.1).reading(), drawing(0.1).found());
        assert_eq!(reading.references.len(), 0);
        let why =
            "spline (at 7) is no curve: knot 3 is repeated so often that the curve breaks there";
        assert_eq!(found.remarks, [why]);
    }
}
