//! What of a document is exported and how, and the presets named for programs.

use std::collections::BTreeMap;
use std::fmt;

use super::error::WriteError;
use super::exchange::formats::{GLIF, IGES, STEP, SVG, THREEDM};
use super::format::{Exporter, Format, Writing};
use super::formats;
use super::loss::Export;
use crate::document::{Curve, CurveId, Document, Edit, EditError, Group, Reference};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use crate::geometry::{PolygonKind, polyline_within};
use crate::io::dxf::DXF;
use crate::io::polygon::FilePolygon;

/// What of a document is written, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportChoice {
    /// The format.
    pub format: &'static Format,
    /// The program that reads the file; its limits are checked.
    pub preset: Option<&'static Preset>,
    /// Which curves and references are written.
    pub scope: Scope,
    /// Whether the curves themselves are written.
    pub curves: bool,
    /// The polygons that are drawn beside each curve.
    pub polygons: Vec<PolygonKind>,
    /// Whether a polyline of points on each curve is written, and how near to it: within this distance.
    pub points: Option<f64>,
    /// The polygon whose knots splines get, or that tables hold; without one that which the format prefers.
    pub knots: Option<PolygonKind>,
    /// The unit of the file; without one that of the document.
    pub unit: Option<LengthUnit>,
    /// The factor by which everything is larger in the file.
    pub scale: f64,
    /// The highest degree that is written: curves of a higher one are approximated.
    pub most_degree: Option<usize>,
    /// How far curves may move that are written as others; without it 1e-4 of their size.
    pub tolerance: Option<f64>,
}

/// Which curves and references are exported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scope {
    /// Those that are selected.
    Selected,
    /// Those that are visible.
    #[default]
    Visible,
    /// All.
    All,
}

impl Scope {
    /// Every scope, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Selected, Self::Visible, Self::All];

    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Selected => "selected",
            Self::Visible => "visible",
            Self::All => "all",
        }
    }
}

/// A program that reads exported files: the format and the form that it takes best.
#[derive(Debug)]
pub struct Preset {
    /// What the shell and settings call it.
    pub name: &'static str,
    /// The name of the program.
    pub program: &'static str,
    /// What it gets, in one line.
    pub help: &'static str,
    /// The format.
    pub format: &'static Format,
    /// The degree that curves are lowered to.
    lowers_to: Option<usize>,
    /// The highest degree that the program reads, and what happens to higher ones.
    limit: Option<(usize, &'static str)>,
}

impl PartialEq for Preset {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Preset {}

const AS_IT_IS: Preset = Preset {
    name: "",
    program: "",
    help: "",
    format: &DXF,
    lowers_to: None,
    limit: None,
};

/// Programs that build on OpenCascade.
const OPEN_CASCADE: (usize, &str) = (25, "its kernel, OpenCascade, drops them without a word");

/// Every preset, in the order in which they are offered.
pub static PRESETS: [Preset; 9] = [
    Preset {
        name: "autocad",
        program: "AutoCAD",
        help: "DXF: splines on clamped knots",
        ..AS_IT_IS
    },
    Preset {
        name: "rhino",
        program: "Rhino",
        help: "3DM: splines with layers, names and colours",
        format: &THREEDM,
        ..AS_IT_IS
    },
    Preset {
        name: "freecad",
        program: "FreeCAD",
        help: "STEP: splines on clamped knots, up to degree 25",
        format: &STEP,
        limit: Some(OPEN_CASCADE),
        ..AS_IT_IS
    },
    Preset {
        name: "fusion",
        program: "Fusion",
        help: "DXF: splines that Insert DXF takes into a sketch",
        ..AS_IT_IS
    },
    Preset {
        name: "solidworks",
        program: "SolidWorks",
        help: "IGES: splines that come in as curves",
        format: &IGES,
        ..AS_IT_IS
    },
    Preset {
        name: "librecad",
        program: "LibreCAD",
        help: "DXF: cubic splines; it shows no higher degree",
        lowers_to: Some(3),
        limit: Some((3, "it leaves them blank")),
        ..AS_IT_IS
    },
    Preset {
        name: "inkscape",
        program: "Inkscape",
        help: "SVG: planar cubic Béziers, 1 : 1 in millimetres",
        format: &SVG,
        ..AS_IT_IS
    },
    Preset {
        name: "illustrator",
        program: "Illustrator",
        help: "SVG: planar cubic Béziers, 1 : 1 in millimetres",
        format: &SVG,
        ..AS_IT_IS
    },
    Preset {
        name: "glyphs",
        program: "Glyphs",
        help: "GLIF: planar cubic Béziers as contours of a glyph",
        format: &GLIF,
        ..AS_IT_IS
    },
];

impl Preset {
    /// Find a preset by its name.
    pub fn find(name: &str) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| preset.name == name)
    }
}

impl ExportChoice {
    /// Write what is visible in a format, as the format prefers it.
    pub fn new(format: &'static Format) -> Self {
        Self {
            format,
            preset: None,
            scope: Scope::default(),
            curves: true,
            polygons: Vec::new(),
            points: None,
            knots: None,
            unit: None,
            scale: 1.0,
            most_degree: None,
            tolerance: None,
        }
    }

    /// Write what is visible as a row of the menu says.
    pub fn of(exporter: Exporter) -> Self {
        let Exporter { format, row } = exporter;
        let polygons = match (row.polygon, format == &DXF) {
            (None, true) => DXF_POLYGONS.to_vec(),
            (Some(kind), true) => vec![kind],
            _ => Vec::new(),
        };
        Self {
            knots: row.polygon.filter(|_| format != &DXF),
            polygons,
            ..Self::new(format)
        }
    }

    /// Write for a program what was to be written.
    pub fn with_preset(self, preset: &'static Preset) -> Self {
        Self {
            scope: self.scope,
            unit: self.unit,
            scale: self.scale,
            most_degree: preset.lowers_to,
            preset: Some(preset),
            ..Self::new(preset.format)
        }
    }

    /// Whether the format holds splines of any degree, so that knots and degree can be chosen.
    pub fn holds_splines(&self) -> bool {
        self.format.draws() && !self.holds_cubics_alone()
    }

    /// Whether the format holds cubic Béziers alone.
    pub fn holds_cubics_alone(&self) -> bool {
        self.format == &SVG || self.format == &GLIF
    }

    /// Whether knots can be chosen, or the polygon that a table holds: the DXF that programs agree on has clamped ones.
    pub fn has_knots(&self) -> bool {
        self.holds_curves() && !self.holds_cubics_alone() && self.format != &DXF
    }

    /// Whether the format holds curves: tables of points hold points alone.
    pub fn holds_curves(&self) -> bool {
        self.format != &super::POINT_TABLE
    }

    /// The document with what is chosen of another one; `selected` are the items that are selected.
    ///
    /// # Errors
    /// [`WriteError::NothingChosen`].
    pub fn chosen(
        &self,
        document: &Document,
        selected: &[CurveId],
    ) -> Result<Document, WriteError> {
        let is_chosen = |id: CurveId, visible: bool| match self.scope {
            Scope::Selected => selected.contains(&id),
            Scope::Visible => visible,
            Scope::All => true,
        };
        let curves = document
            .curves()
            .filter(|(id, it)| is_chosen(*id, it.visible));
        let curves: Vec<Curve> = curves.map(|(_, curve)| Curve::clone(curve)).collect();
        let references = document.references();
        let references = references.filter(|(id, it)| is_chosen(*id, it.visible));
        let references: Vec<Reference> = references.map(|(_, it)| Reference::clone(it)).collect();
        if curves.is_empty() && references.is_empty() {
            return Err(WriteError::NothingChosen(self.scope.name()));
        }
        Ok(Document::from_curves(curves)
            .with_references(references)
            .with_unit(document.unit())
            .with_extras(document.extras().clone()))
    }

    /// Write a document that has what is chosen, in curves of the degrees that are to be written.
    ///
    /// # Errors
    /// [`WriteError`] if the program cannot read a curve, or the format not hold the document.
    pub fn write(&self, document: &Document) -> Result<Export, WriteError> {
        self.check(document)?;
        let factor = self.factor(document);
        let document = self.scaled(document)?;
        let document = self.with_companions(&document, factor)?;
        let beside = match self.format == &DXF {
            true => self.polygons.clone(),
            false => Vec::new(),
        };
        self.format.write_as(
            &document,
            &Writing {
                polygon: self.knots,
                beside: Some(beside),
                tolerance: self.tolerance.map(|length| factor * length),
            },
        )
    }

    /// Refuse degrees that the program cannot read.
    fn check(&self, document: &Document) -> Result<(), WriteError> {
        let Some((preset, (most, why))) = self.preset.and_then(|it| Some((it, it.limit?))) else {
            return Ok(());
        };
        let curves = document.curves();
        let curves = curves.map(|(_, curve)| (&curve.name, curve.polygon.degree()));
        let references = document
            .references()
            .filter_map(|(_, it)| match it.curve.form() {
                ReferenceForm::Nurbs(nurbs) => Some((&it.name, nurbs.degree())),
                _ => None,
            });
        match curves.chain(references).find(|(_, degree)| *degree > most) {
            None => Ok(()),
            Some((name, degree)) => Err(WriteError::DegreeTooHigh {
                name: name.clone(),
                degree,
                program: preset.program,
                most,
                why,
            }),
        }
    }

    /// The length in the file of a length 1 in the document.
    fn factor(&self, document: &Document) -> f64 {
        let units = document.unit().zip(self.unit);
        let units = units.map(|(own, unit)| own.millimetres() / unit.millimetres());
        self.scale * units.unwrap_or(1.0)
    }

    /// The document in the unit of the file, larger by the scale.
    fn scaled(&self, document: &Document) -> Result<Document, EditError> {
        let edits = match (document.unit(), self.unit) {
            (Some(_), Some(unit)) => vec![Edit::ConvertUnit(unit)],
            (None, Some(unit)) => vec![Edit::SetUnit(Some(unit))],
            _ => Vec::new(),
        };
        let document = document.edited(edits)?;
        match self.scale == 1.0 {
            true => Ok(document),
            false => document.scaled(self.scale),
        }
    }

    /// The document with polylines for polygons and points, and without the curves if these are not written.
    fn with_companions(&self, document: &Document, factor: f64) -> Result<Document, WriteError> {
        let is_dxf = self.format == &DXF;
        let mut lists = Vec::new();
        for (_, curve) in document.curves() {
            for kind in self
                .polygons
                .iter()
                .copied()
                .filter(|_| !is_dxf || !self.curves)
            {
                let polygon = FilePolygon::of(&curve.polygon, kind);
                let mut points = polygon.vertices;
                points.extend(points.first().copied().filter(|_| polygon.periodic));
                lists.push(list(curve, &format!("{kind} polygon"), points)?);
            }
            if let Some(within) = self.points {
                let within = factor * within;
                let parameters = polyline_within(&curve.polygon, within);
                let parameters = parameters.ok_or_else(|| WriteError::TooManyPoints {
                    name: curve.name.clone(),
                    within,
                })?;
                let points = parameters.iter().map(|u| curve.polygon.jet(*u).point);
                lists.push(list(curve, "points", points.collect())?);
            }
        }
        let kept = match self.curves {
            true => document.clone(),
            false => {
                let references = document.references();
                let references = references.map(|(_, it)| Reference::clone(it));
                Document::default()
                    .with_references(references)
                    .with_unit(document.unit())
            }
        };
        Ok(kept.with_references(lists.into_iter().flatten()))
    }

    /// The choice as names and values, for settings.
    pub fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = BTreeMap::new();
        let mut set = |name: &str, value: String| drop(settings.insert(name.to_owned(), value));
        set("format", self.format.extension().to_owned());
        set("scope", self.scope.name().to_owned());
        set("curves", self.curves.to_string());
        let polygons: Vec<&str> = self.polygons.iter().map(|kind| kind.name()).collect();
        set("polygons", polygons.join(","));
        set("scale", self.scale.to_string());
        let given = [
            ("preset", self.preset.map(|it| it.name.to_owned())),
            ("points", self.points.map(|it| it.to_string())),
            ("knots", self.knots.map(|it| it.name().to_owned())),
            ("unit", self.unit.map(|it| it.symbol().to_owned())),
            ("degree", self.most_degree.map(|it| it.to_string())),
            ("tolerance", self.tolerance.map(|it| it.to_string())),
        ];
        for (name, value) in given {
            if let Some(value) = value {
                set(name, value);
            }
        }
        settings
    }

    /// The choice of such settings; `None` if they name no format that can be written. What is not understood is as a
    /// new choice has it.
    pub fn of_settings(settings: &BTreeMap<String, String>) -> Option<Self> {
        let get = |name: &str| settings.get(name).map(String::as_str);
        let above_zero = |name: &str| {
            let value = get(name)?.parse::<f64>().ok()?;
            (value > 0.0 && value.is_finite()).then_some(value)
        };
        let format = formats::find(get("format")?).filter(|it| it.can_write())?;
        let polygons = get("polygons").unwrap_or_default().split(',');
        let mut scopes = Scope::ALL.into_iter();
        Some(Self {
            preset: get("preset").and_then(Preset::find),
            scope: scopes
                .find(|scope| get("scope") == Some(scope.name()))
                .unwrap_or_default(),
            curves: get("curves") != Some("false"),
            polygons: polygons.filter_map(PolygonKind::from_name).collect(),
            points: above_zero("points"),
            knots: get("knots").and_then(PolygonKind::from_name),
            unit: get("unit").and_then(LengthUnit::of_symbol),
            scale: above_zero("scale").unwrap_or(1.0),
            most_degree: get("degree")
                .and_then(|it| it.parse().ok())
                .filter(|it| *it > 0),
            tolerance: above_zero("tolerance"),
            ..Self::new(format)
        })
    }
}

/// The polygons that a DXF shows beside the curves unless others are chosen.
const DXF_POLYGONS: [PolygonKind; 2] = [PolygonKind::Float, PolygonKind::Clamped];

/// A list of points beside a curve, in a group of its own within that of the curve; `None` where they are one place.
fn list(
    curve: &Curve,
    group: &str,
    points: Vec<glam::DVec3>,
) -> Result<Option<Reference>, WriteError> {
    let Ok(list) = PointList::new(points) else {
        return Ok(None);
    };
    let form = ReferenceCurve::of(ReferenceForm::Points(list));
    let names = curve.group.names().iter().map(String::as_str);
    let mut reference = match form {
        Ok(form) => Reference::new(curve.name.clone(), form),
        Err(_) => return Ok(None),
    };
    reference = reference.in_group(Group::new(names.chain([group])));
    reference.colour = curve.colour;
    reference.visible = curve.visible;
    Ok(Some(reference))
}

impl fmt::Display for Preset {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.program)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FloatPolygon, ParametricCurve};
    use crate::io::formats::find;

    fn wave(degree: usize) -> Curve {
        let corner = |index: usize| (30.0 * index as f64, 20.0 * (index % 2) as f64);
        let corners: Vec<(f64, f64)> = (0..degree + 4).map(corner).collect();
        let polygon = FloatPolygon::planar(degree, &corners).expect("a polygon");
        Curve::new("wave", polygon)
    }

    fn choice(extension: &str) -> ExportChoice {
        ExportChoice::new(find(extension).expect("a format"))
    }

    fn read(choice: &ExportChoice, document: &Document) -> crate::io::Reading {
        let export = choice.write(document).expect("a file");
        choice.format.read(&export.bytes).expect("what was written")
    }

    #[test]
    fn choices_survive_as_settings() {
        let mut all: Vec<ExportChoice> = PRESETS
            .iter()
            .map(|preset| choice("dxf").with_preset(preset))
            .collect();
        all.push(ExportChoice {
            scope: Scope::Selected,
            curves: false,
            polygons: vec![PolygonKind::Bezier, PolygonKind::Float],
            points: Some(0.1),
            knots: Some(PolygonKind::Float),
            unit: Some(LengthUnit::Inch),
            scale: 0.3,
            most_degree: Some(7),
            tolerance: Some(1e-5),
            ..choice("igs")
        });
        for choice in all {
            assert_eq!(ExportChoice::of_settings(&choice.settings()), Some(choice));
        }
        let unknown = BTreeMap::from([("format".to_owned(), "gpx".to_owned())]);
        assert_eq!(ExportChoice::of_settings(&unknown), None, "only read");
    }

    #[test]
    fn presets_name_formats_that_can_be_written() {
        for preset in &PRESETS {
            assert_eq!(Preset::find(preset.name), Some(preset));
            assert!(preset.format.can_write() && preset.help.len() < 100);
        }
    }

    #[test]
    fn degrees_that_a_program_cannot_read_are_refused_with_the_reason() {
        let librecad = Preset::find("librecad").expect("a preset");
        let lowered = choice("dxf").with_preset(librecad);
        assert_eq!(lowered.most_degree, Some(3));
        let refused = lowered.write(&Document::from_curves([wave(9)]));
        let refused = refused.expect_err("no LibreCAD reads it").to_string();
        assert_eq!(
            refused,
            "“wave” has degree 9, and LibreCAD reads degrees up to 3: it leaves them blank. \
             Choose a lower degree"
        );
        assert!(lowered.write(&Document::from_curves([wave(3)])).is_ok());
    }

    #[test]
    fn unit_and_scale_change_the_numbers_alike() {
        let document = Document::from_curves([wave(3)]).with_unit(Some(LengthUnit::Inch));
        let choice = ExportChoice {
            unit: Some(LengthUnit::Millimetre),
            scale: 2.0,
            points: Some(0.01),
            ..choice("step")
        };
        let written = read(&choice, &document);
        assert_eq!(written.unit, Some(LengthUnit::Millimetre));
        let own = document
            .curves()
            .next()
            .expect("the curve")
            .1
            .polygon
            .point(1.0);
        let there = written.curves[0].polygon.point(1.0);
        assert!(there.distance(50.8 * own) < 1e-9, "{there}");
        // The points are as near as was asked for in inches.
        let points = written.references[0].points().expect("points");
        let curve = &written.curves[0].polygon;
        let middles = points.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let off = middles
            .map(|it| curve.nearest(it).distance)
            .fold(0.0, f64::max);
        assert!((0.2..=1.0).contains(&(off / (0.01 * 50.8))), "{off}");
    }

    #[test]
    fn polygons_and_points_are_written_beside_curves_or_without_them() {
        let document = Document::from_curves([wave(5)]);
        for extension in ["dxf", "step", "3dm", "svg", "csv"] {
            for curves in [true, false] {
                let choice = ExportChoice {
                    curves,
                    polygons: vec![PolygonKind::Clamped],
                    points: Some(0.1),
                    ..choice(extension)
                };
                let read = read(&choice, &document);
                let lists = read.references.iter();
                let lists = lists.filter_map(|it| Some(it.points()?.len()));
                let lists: Vec<usize> = lists.collect();
                let about = format!("{extension}, {curves}: {lists:?}");
                assert!(lists.contains(&9), "the polygon: {about}");
                assert_eq!(lists.len(), 2, "{about}");
                let has_curve = read.curves.len() + read.references.len() - lists.len() > 0;
                assert_eq!(has_curve, curves, "{about}");
            }
        }
    }

    #[test]
    fn references_come_back_from_a_dxf_as_they_were() {
        let texts = [
            "circle:radius=3",
            "circle:radius=3;from=1;to=2",
            "ellipse:a=2;b=5;from=0.5;to=4",
        ];
        let references = texts.map(|text| {
            let curve = ReferenceCurve::from_text(&text.replace(';', ",")).expect("a reference");
            Reference::new(text, curve)
        });
        let document = Document::default().with_references(references);
        let read = read(&choice("dxf"), &document);
        assert_eq!(read.references.len(), 3);
        for (there, (_, own)) in read.references.iter().zip(document.references()) {
            for step in 0..=8 {
                let [own, there] = [&own.curve, &there.curve].map(|curve| {
                    let u = curve.pieces() as f64 * f64::from(step) / 8.0;
                    curve.jet(u).point
                });
                assert!(own.distance(there) < 1e-12, "{own} and {there}");
            }
        }
    }

    #[test]
    fn what_is_chosen_is_written() {
        let mut hidden = wave(3);
        hidden.visible = false;
        let document = Document::from_curves([wave(3), hidden]);
        let second: Vec<CurveId> = document.ids().skip(1).collect();
        let count = |scope: Scope, selected: &[CurveId]| {
            let choice = ExportChoice {
                scope,
                ..choice("step")
            };
            let chosen = choice.chosen(&document, selected);
            chosen.map(|it| it.curves().count())
        };
        assert_eq!(count(Scope::Visible, &[]), Ok(1));
        assert_eq!(count(Scope::All, &[]), Ok(2));
        assert_eq!(count(Scope::Selected, &second), Ok(1));
        let nothing = count(Scope::Selected, &[]).expect_err("nothing");
        assert!(nothing.to_string().starts_with("nothing is selected"));
    }
}
