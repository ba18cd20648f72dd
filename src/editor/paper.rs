//! The figures and the table of the paper as documents.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use thiserror::Error;

use crate::document::{Colour, Curve, CurveId, Document, Edit, Reference};
use crate::editor::reply::{Note, Reply};
use crate::editor::{Command, Editor, NamedView, ToolKind};
use crate::geometry::approximation::{
    ApproximationError, MeasuredDeviation, Placing, UniformKnots, float_polygon,
};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::bridging::{Bridge, BridgeError, join};
use crate::geometry::mineur_farin::{Configuration, Format};
use crate::geometry::paper::{
    PAPER_RADIUS, RoundingTest, equal_leg_bezier, paper_sides, regular_polygon,
};
use crate::geometry::references::{ReferenceCurve, ReferenceTextError};
use crate::geometry::{End, FloatPolygon, PolygonError, Progress};

/// The name of the curve whose closed S-polygon loses digits.
const SHORTENED: &str = "shortened";

/// Colours that tell the curves of a page apart.
const BLUE: Colour = Colour([0x3B, 0x82, 0xD6]);
const VERMILION: Colour = Colour([0xD5, 0x5E, 0x2A]);

/// A reason why a page has no curves.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PaperError {
    /// A polygon is not valid.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// The spiral cannot be approximated.
    #[error(transparent)]
    Approximation(#[from] ApproximationError),
    /// A reference cannot be read.
    #[error(transparent)]
    Reference(#[from] ReferenceTextError),
    /// Two parts cannot be joined.
    #[error(transparent)]
    Bridge(#[from] BridgeError),
}

/// A page about the paper, with the document that it explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperPage {
    /// Figure 1: an arc of degree 9 by its float and its closed S-polygon.
    Arc,
    /// Digits taken from a vertex of the closed S-polygon.
    Rounding,
    /// Table 1: circles by B-splines and by Bézier curves of this degree.
    Circles {
        /// The degree of the curves in the document.
        degree: usize,
    },
    /// The seven steps that put the ends of a curve where they should be.
    Steps,
    /// Figure 2: one polygon with growing legs, as float and as Bézier polygon.
    Typical,
    /// Figure 3: a conical spiral and two float polygons near it.
    Spiral {
        /// The number of vertices: 20 in the paper, one a unit of the parameter.
        vertices: usize,
    },
    /// Section 6: two log-aesthetic parts, and the curve that a bridge makes of them.
    Composite,
}

impl PaperPage {
    /// Every page, in the order of the paper.
    pub const ALL: [Self; 7] = [
        Self::Arc,
        Self::Rounding,
        Self::Circles { degree: 9 },
        Self::Steps,
        Self::Typical,
        Self::Spiral { vertices: 20 },
        Self::Composite,
    ];

    /// What the page is called.
    pub fn title(self) -> &'static str {
        match self {
            Self::Arc => "Figure 1: an arc of degree 9",
            Self::Rounding => "Rounding the closed S-polygon",
            Self::Circles { .. } => "Table 1: circles, both ways",
            Self::Steps => "Seven steps to exact ends",
            Self::Typical => "Figure 2: Mineur–Farin polygon",
            Self::Spiral { .. } => "Figure 3: conical spiral",
            Self::Composite => "Section 6: composite curves",
        }
    }

    /// Where the page stands among all.
    pub fn place(self) -> usize {
        let same = |page: &Self| std::mem::discriminant(page) == std::mem::discriminant(&self);
        Self::ALL.iter().position(same).unwrap_or_default()
    }

    fn document(self) -> Result<Document, PaperError> {
        let curves = match self {
            Self::Arc => vec![Curve::new("arc", RoundingTest::arc()?)],
            Self::Rounding => vec![
                coloured("arc", RoundingTest::arc()?, BLUE),
                coloured(SHORTENED, RoundingTest::arc()?, VERMILION),
            ],
            Self::Circles { degree } => circles(degree)?,
            Self::Steps => vec![off_its_ends()?],
            Self::Typical => typical()?,
            Self::Spiral { vertices } => return spiral(vertices),
            Self::Composite => composite()?,
        };
        Ok(Document::from_curves(curves))
    }

    /// Which curve of the document is active, counted from 0.
    fn active(self) -> usize {
        usize::from(matches!(self, Self::Rounding | Self::Spiral { .. }))
    }

    /// The tool in the hand, and from where the document is seen.
    fn tool_and_view(self) -> (ToolKind, NamedView) {
        match self {
            Self::Steps => (ToolKind::EndFit, NamedView::Xy),
            Self::Spiral { .. } => (ToolKind::Select, NamedView::Isometric),
            _ => (ToolKind::Select, NamedView::Xy),
        }
    }
}

impl Editor {
    /// Open the document of a page in place of the present one. The reply is told.
    ///
    /// # Errors
    /// None: the polygons of the pages are valid.
    pub fn open_paper(&mut self, page: PaperPage) -> Reply {
        let reply = self.replace_by_page(page);
        self.tell(reply)
    }

    /// Whether the document has the curve whose closed S-polygon loses digits.
    pub fn has_shortened(&self) -> bool {
        self.shortened().is_some()
    }

    /// Show the curve of the rounding test with so many digits kept. In a page as it was opened that is no step,
    /// and nothing to save; where something was edited it is a preview, which [`Editor::commit_preview`] keeps.
    pub fn show_shortened(&mut self, test: &RoundingTest) {
        let Some(curve) = self.shortened() else {
            return;
        };
        let polygon = test.polygon.clone();
        let edits = vec![Edit::SetPolygon { curve, polygon }];
        if !self.workspace.is_as_opened() {
            return self.preview("Shorten coordinates", edits);
        }
        if let Ok(document) = self.document().edited(edits) {
            self.workspace.replace(document, None);
            self.document_changed();
        }
    }

    fn shortened(&self) -> Option<CurveId> {
        let degree = RoundingTest::arc().ok()?.degree();
        let mut curves = self.document().curves();
        let fits = |curve: &Curve| {
            let polygon = &curve.polygon;
            curve.name == SHORTENED
                && polygon.degree() == degree
                && polygon.vertices().len() == degree + 1
                && curve.check_editable().is_ok()
        };
        curves.find(|(_, curve)| fits(curve)).map(|(id, _)| id)
    }

    fn replace_by_page(&mut self, page: PaperPage) -> Reply {
        let document = page.document().map_err(|error| error.to_string())?;
        let active = document.ids().nth(page.active());
        // A reference is what curves are compared with, if there is one.
        let references = document.references().map(|(id, _)| id);
        let compared = references.chain(document.ids());
        let compared = compared.into_iter().find(|id| Some(*id) != active);
        // A whole is not compared with its parts.
        let compared = compared.filter(|_| page != PaperPage::Composite);
        self.replace(document, None);
        if let Some(active) = active {
            self.activate(active);
        }
        self.view.compare(compared);
        let (tool, view) = page.tool_and_view();
        self.use_tool(tool);
        self.execute(Command::View(view))?;
        self.execute(Command::FitAll)?;
        Ok(Note::silent())
    }
}

fn coloured(name: &str, polygon: FloatPolygon, colour: Colour) -> Curve {
    Curve {
        colour: Some(colour),
        ..Curve::new(name, polygon)
    }
}

fn circles(degree: usize) -> Result<Vec<Curve>, PolygonError> {
    let sides = paper_sides(degree);
    let bspline = regular_polygon(degree, sides, PAPER_RADIUS)?;
    let bezier = equal_leg_bezier(degree, sides, PAPER_RADIUS)?;
    Ok(vec![
        coloured("B-spline", bspline, BLUE),
        coloured("Bézier", bezier, VERMILION),
    ])
}

/// A curve of degree 5 whose ends are to be moved and turned.
fn off_its_ends() -> Result<Curve, PolygonError> {
    const VERTICES: [(f64, f64); 12] = [
        (-8.0, -6.0),
        (-6.0, -4.6),
        (-4.0, -2.8),
        (-1.6, -0.8),
        (1.2, 1.1),
        (4.4, 2.8),
        (8.0, 4.2),
        (12.0, 5.2),
        (16.3, 5.8),
        (20.8, 6.0),
        (25.4, 5.8),
        (30.0, 5.3),
    ];
    let polygon = FloatPolygon::planar(5, &VERTICES)?;
    let mut curve = Curve::new("ends", polygon);
    let asked = [
        (End::Start, DVec3::new(-0.4, 0.3, 0.0), 4.0_f64),
        (End::Finish, DVec3::new(0.3, -0.5, 0.0), -5.0),
    ];
    for (end, moved, degrees) in asked {
        let jet = curve.polygon.jet(end.parameter(&curve.polygon));
        let turn = DVec2::from_angle(degrees.to_radians());
        let direction = turn.rotate(jet.first.truncate()).extend(0.0);
        let target = EndTarget {
            point: jet.point + moved,
            direction: Some(direction),
            ..EndTarget::default()
        };
        curve.targets.set(end, Some(target));
    }
    Ok(curve)
}

/// Figure 2: five points whose legs double at each turn by a right angle.
fn typical() -> Result<Vec<Curve>, PolygonError> {
    let configuration = Configuration {
        start: DVec3::ZERO,
        first_leg: DVec3::X,
        ratio: 2.0,
        turn: FRAC_PI_2,
        torsion: 0.0,
    };
    let bspline = configuration.curve(Format::Float { degree: 4 }, 4)?.polygon;
    let bezier = configuration.curve(Format::Bezier, 4)?.polygon;
    Ok(vec![
        coloured("B-spline", bspline, BLUE),
        coloured("Bézier", bezier, VERMILION),
    ])
}

/// The degree of figure 3.
const SPIRAL_DEGREE: usize = 8;

/// Where the curve of figure 3 begins and ends on the spiral: 20 vertices, from the parameter 0 on, lie
/// about this part.
const SPIRAL_PART: [f64; 2] = [3.5, 15.5];

/// Figure 3: the conical spiral, and float polygons by both ways to place their vertices.
fn spiral(vertices: usize) -> Result<Document, PaperError> {
    let (spiral, knots) = spiral_and_knots(vertices)?;
    let mut curves = Vec::new();
    for (placing, name, colour) in [
        (Placing::OnCurve, "vertices on the spiral", VERMILION),
        (Placing::Quasi, "quasi-interpolation", BLUE),
    ] {
        curves.push(coloured(
            name,
            float_polygon(&spiral, &knots, placing)?,
            colour,
        ));
    }
    let spiral = Reference::new("conical spiral", spiral);
    Ok(Document::from_curves(curves).with_references([spiral]))
}

fn spiral_and_knots(vertices: usize) -> Result<(ReferenceCurve, UniformKnots), PaperError> {
    const SPIRAL: &str = "formula:x=2+t*sin(t);y=2+t*cos(t);z=t;from=3.5;to=15.5";
    let spiral = ReferenceCurve::from_text(SPIRAL)?;
    let knots = UniformKnots::between(SPIRAL_DEGREE, SPIRAL_PART, vertices)?;
    Ok((spiral, knots))
}

/// How far both float polygons of figure 3 are from the spiral: with vertices on it, and by
/// quasi-interpolation.
///
/// # Errors
/// None for numbers of vertices from 9 on.
pub fn spiral_deviations(vertices: usize) -> Result<[f64; 2], PaperError> {
    let (spiral, knots) = spiral_and_knots(vertices)?;
    let far = |placing| {
        let polygon = float_polygon(&spiral, &knots, placing)?;
        let parameter = |u| knots.curve_parameter(u);
        let measured = MeasuredDeviation::measure(&polygon, &spiral, &parameter, knots.reach())?;
        Ok::<_, PaperError>(measured.largest)
    };
    Ok([far(Placing::OnCurve)?, far(Placing::Quasi)?])
}

/// The degree of the composite curve.
const COMPOSITE_DEGREE: usize = 5;

/// The vertices of the bridge between its parts.
const BRIDGE: usize = 5;

/// A clothoid and a logarithmic spiral by vertices on them, the spiral where a bridge of five vertices is
/// most harmonious, and the curve that the bridge makes of both.
fn composite() -> Result<Vec<Curve>, PaperError> {
    const PARTS: [(&str, [f64; 2], usize); 2] = [
        ("log-aesthetic:alpha=-1,lambda=0.2", [0.0, 2.5], 15),
        ("log-aesthetic:alpha=1,lambda=0.5", [4.25, 9.25], 23),
    ];
    let part = |(text, interval, vertices): (&str, [f64; 2], usize)| {
        let curve = ReferenceCurve::from_text(text)?;
        let knots = UniformKnots::between(COMPOSITE_DEGREE, interval, vertices)?;
        Ok::<_, PaperError>(float_polygon(&curve, &knots, Placing::OnCurve)?)
    };
    let [first, second] = [part(PARTS[0])?, part(PARTS[1])?];
    let bridge = Bridge {
        vertices: Some(BRIDGE),
        second_moves: true,
    };
    let joined = join(&first, &second, &bridge, &Progress::default())?;
    let moved = joined.polygon.vertices()[joined.bridge.end..].to_vec();
    let second = FloatPolygon::new(COMPOSITE_DEGREE, moved, None, false)?;
    Ok(vec![
        Curve::new("composite", joined.polygon),
        coloured("clothoid", first, BLUE),
        coloured("logarithmic spiral", second, VERMILION),
    ])
}
