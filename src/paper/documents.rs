//! The documents of the pages: the paper's figures and its table as curves.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::PaperPage;
use crate::document::{Colour, Curve, Document, Reference};
use crate::geometry::approximation::{ApproximationError, Placing, UniformKnots, float_polygon};
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::bridging::{Bridge, join};
use crate::geometry::mineur_farin::{Configuration, Format};
use crate::geometry::paper::{
    PAPER_RADIUS, RoundingTest, equal_leg_bezier, paper_sides, regular_polygon,
};
use crate::geometry::references::ReferenceCurve;
use crate::geometry::{End, FloatPolygon, PolygonError, Progress};

/// The name of the curve that the rounding test changes.
pub(super) const SHORTENED: &str = "shortened";

/// Colours that tell the curves of a page apart.
const BLUE: Colour = Colour([0x3B, 0x82, 0xD6]);
const VERMILION: Colour = Colour([0xD5, 0x5E, 0x2A]);

/// Why a page has no document: a polygon, an approximation, a reference or a bridge that is not valid.
pub type PaperError = Box<dyn std::error::Error + Send + Sync>;

/// Make the document of a page.
pub(super) fn of(page: PaperPage) -> Result<Document, PaperError> {
    let curves = match page {
        PaperPage::Arc => vec![Curve::new("arc", RoundingTest::arc()?)],
        PaperPage::Rounding => vec![
            coloured("arc", RoundingTest::arc()?, BLUE),
            coloured(SHORTENED, RoundingTest::arc()?, VERMILION),
        ],
        PaperPage::Circles { degree } => circles(degree)?,
        PaperPage::Steps => vec![off_its_ends()?],
        PaperPage::Typical => typical()?,
        PaperPage::Spiral { vertices } => return spiral(vertices),
        PaperPage::Composite => composite()?,
    };
    Ok(Document::from_curves(curves))
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

/// Make a curve of degree 5 with a target beside each end, in another direction.
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
    let targets = [
        (End::Start, DVec3::new(-0.4, 0.3, 0.0), 4.0_f64),
        (End::Finish, DVec3::new(0.3, -0.5, 0.0), -5.0),
    ];
    for (end, moved, degrees) in targets {
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

/// Make figure 2: five points, legs that double, right angles.
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

/// The part of the spiral that figure 3 approximates. Its 20 vertices belong to the parameters 0 to 19.
const SPIRAL_PART: [f64; 2] = [3.5, 15.5];

/// Make figure 3: the conical spiral, and a float polygon for each way to place vertices.
fn spiral(vertices: usize) -> Result<Document, PaperError> {
    let (spiral, knots) = spiral_and_knots(vertices)?;
    let mut curves = Vec::new();
    for (placing, name, colour) in [
        (Placing::OnCurve, "vertices on the spiral", VERMILION),
        (Placing::Quasi, "quasi-interpolation", BLUE),
    ] {
        let polygon = float_polygon(&spiral, &knots, placing)?;
        curves.push(coloured(name, polygon, colour));
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

/// Measure the largest distance from the spiral of both float polygons of figure 3: vertices on the spiral,
/// then quasi-interpolation.
///
/// # Errors
/// None for numbers of vertices from 9 on.
pub fn spiral_deviations(vertices: usize) -> Result<[f64; 2], PaperError> {
    let (spiral, knots) = spiral_and_knots(vertices)?;
    let far = |placing| {
        let polygon = float_polygon(&spiral, &knots, placing)?;
        let parameter = |u| knots.curve_parameter(u);
        let (reach, progress) = (knots.reach(), Progress::default());
        let measured = MeasuredDeviation::measure(&polygon, &spiral, &parameter, reach, &progress);
        let measured = measured.map_err(ApproximationError::from)?;
        Ok::<_, PaperError>(measured.largest)
    };
    Ok([far(Placing::OnCurve)?, far(Placing::Quasi)?])
}

/// The degree of the composite curve.
const COMPOSITE_DEGREE: usize = 5;

/// The number of vertices in the bridge between its parts.
const BRIDGE: usize = 5;

/// Make the composite curve and its parts, a clothoid and a logarithmic spiral. The spiral lies where a
/// bridge of five vertices is most harmonious.
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
