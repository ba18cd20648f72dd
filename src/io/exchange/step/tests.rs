//! Tests of the reader on small files with known geometry.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, dvec3};

use super::evaluation::{Homogeneous, ends};
use super::read;
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape, Space};

/// Wrap instances: 1 is a context in millimetres and radians, 2 in inches and degrees.
pub fn file(data: &str) -> String {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('no DATA; here'),'2;1');\nENDSEC;\nDATA;\n\
         #1=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#3,#4))\
         REPRESENTATION_CONTEXT('',''));\n\
         #2=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#5,#6))\
         REPRESENTATION_CONTEXT('',''));\n\
         #3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n\
         #4=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
         #5=(CONVERSION_BASED_UNIT('INCH',#7)LENGTH_UNIT()NAMED_UNIT(*));\n\
         #6=(CONVERSION_BASED_UNIT('DEGREE',#8)NAMED_UNIT(*)PLANE_ANGLE_UNIT());\n\
         #7=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#3);\n\
         #8=(MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.017453292519943295),#4)\
         PLANE_ANGLE_MEASURE_WITH_UNIT());\n\
         {data}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
}

/// Wrap instances and a set of the curves among them.
pub fn set(data: &str, curves: &str) -> String {
    file(&format!(
        "{BASICS}{data}\n#90=GEOMETRIC_CURVE_SET('',({curves}));\n#91=SHAPE_REPRESENTATION('',(#90),#1);"
    ))
}

/// Points 10 to 16, the axes 20 in the plane z = 0, a circle of radius 2 and an ellipse with half-axes 3 and
/// 1.
const BASICS: &str = "#10=CARTESIAN_POINT('',(0.,0.,0.));\n#11=CARTESIAN_POINT('',(1.,0.,0.));\n\
     #12=CARTESIAN_POINT('',(1.,1.,0.));\n#13=CARTESIAN_POINT('',(0.,1.,0.));\n\
     #14=CARTESIAN_POINT('',(2.,0.,0.));\n#15=CARTESIAN_POINT('',(0.,2.,0.));\n\
     #20=AXIS2_PLACEMENT_3D('',#10,$,$);\n#21=CIRCLE('round',#20,2.);\n#22=ELLIPSE('',#20,3.,1.);\n";

fn drawing(text: &str) -> Drawing {
    read(text.as_bytes()).unwrap()
}

fn one(data: &str, curve: &str) -> Item {
    let drawing = drawing(&set(data, curve));
    assert_eq!(drawing.remarks, Vec::<String>::new());
    assert_eq!(drawing.items.len(), 1, "{drawing:?}");
    drawing.items.into_iter().next().unwrap()
}

fn nurbs(item: &Item) -> &Nurbs {
    match item.shapes.as_slice() {
        [Shape::Nurbs(nurbs)] => nurbs,
        other => panic!("{other:?}"),
    }
}

fn conic(item: &Item) -> &Conic {
    match item.shapes.as_slice() {
        [Shape::Conic(conic)] => conic,
        other => panic!("{other:?}"),
    }
}

fn corners(item: &Item) -> (&[DVec3], bool) {
    match item.shapes.as_slice() {
        [Shape::Polyline { points, closed }] => (points, *closed),
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn near(left: DVec3, right: DVec3) {
    assert!(left.distance(right) < 1e-12, "{left} is not {right}");
}

#[test]
fn spline_with_knots_is_kept() {
    let item = one(
        "#30=B_SPLINE_CURVE_WITH_KNOTS('it''s',2,(#10,#11,#12,#13),.UNSPECIFIED.,.F.,.F.,(3,1,3),(0.,0.5,\
             1.E0),\
         .UNSPECIFIED.);",
        "#30",
    );
    let spline = nurbs(&item);
    assert_eq!(
        (item.kind, item.space, item.name.as_deref()),
        (Kind::Spline, Space::Model, Some("it's"))
    );
    assert_eq!(
        (spline.degree, spline.points.len(), spline.periodic),
        (2, 4, false)
    );
    assert_eq!(spline.knots, [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]);
    assert_eq!(item.at, 23);
}

#[test]
fn complex_spline_is_rational() {
    let item = one(
        "#30=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#14,#12,#15),.UNSPECIFIED.,.F.,.F.)\
         B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.),.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()\
         RATIONAL_B_SPLINE_CURVE((1.,0.5,2.))REPRESENTATION_ITEM('r'));",
        "#30",
    );
    assert_eq!(
        nurbs(&item).weights.as_deref(),
        Some([1.0, 0.5, 2.0].as_slice())
    );
    assert_eq!((item.kind, item.name.as_deref()), (Kind::Spline, Some("r")));
}

#[test]
fn knots_of_uniform_quasi_uniform_and_bezier_curves() {
    let knots = |name: &str, kind: Kind| {
        let item = one(
            &format!("#30={name}('',2,(#10,#11,#12,#13,#15),.UNSPECIFIED.,.F.,.F.);"),
            "#30",
        );
        assert_eq!(item.kind, kind);
        nurbs(&item).knots.clone()
    };
    assert_eq!(
        knots("UNIFORM_CURVE", Kind::Spline),
        [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    );
    assert_eq!(
        knots("QUASI_UNIFORM_CURVE", Kind::Spline),
        [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]
    );
    assert_eq!(
        knots("BEZIER_CURVE", Kind::Bezier),
        [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]
    );
}

#[test]
fn rational_bezier_as_complex_instance() {
    let item = one(
        "#30=(BEZIER_CURVE()BOUNDED_CURVE()B_SPLINE_CURVE(2,(#14,#12,#15),.UNSPECIFIED.,.F.,.F.)CURVE()\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((1.,3.,1.))REPRESENTATION_ITEM(''));",
        "#30",
    );
    assert_eq!(item.kind, Kind::Bezier);
    assert_eq!(nurbs(&item).knots, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    assert!(nurbs(&item).weights.is_some());
}

#[test]
fn closed_spline_without_clamps_is_periodic() {
    let spline = |closed: &str| {
        let data = format!(
            "#30=B_SPLINE_CURVE_WITH_KNOTS('',2,(#10,#11,#12,#13,#10,#11),.UNSPECIFIED.,.{closed}.,.F.,\
             (1,1,1,1,1,1,1,1,1),(-2.,-1.,0.,1.,2.,3.,4.,5.,6.),.UNSPECIFIED.);"
        );
        nurbs(&one(&data, "#30")).periodic
    };
    assert!(spline("T"));
    assert!(!spline("F"));
}

#[test]
fn whole_conics() {
    let circle = one("", "#21");
    assert_eq!(
        (circle.kind, circle.name.as_deref()),
        (Kind::Circle, Some("round"))
    );
    assert_eq!(
        conic(&circle),
        &Conic {
            centre: DVec3::ZERO,
            x: dvec3(2.0, 0.0, 0.0),
            y: dvec3(0.0, 2.0, 0.0),
            from: 0.0,
            to: TAU
        }
    );
    let ellipse = one("", "#22");
    assert_eq!(
        (ellipse.kind, conic(&ellipse).x, conic(&ellipse).y),
        (Kind::Ellipse, 3.0 * DVec3::X, DVec3::Y)
    );
}

#[test]
fn tilted_circle() {
    let item = one(
        "#30=DIRECTION('',(1.,0.,0.));\n#31=DIRECTION('',(5.,0.,3.));\n\
             #32=AXIS2_PLACEMENT_3D('',#12,#30,#31);\n\
         #33=CIRCLE('',#32,4.);",
        "#33",
    );
    assert_eq!(conic(&item).centre, dvec3(1.0, 1.0, 0.0));
    near(conic(&item).x, 4.0 * DVec3::Z);
    near(conic(&item).y, -4.0 * DVec3::Y);
}

#[test]
fn arcs_by_parameters_in_both_senses() {
    let arc = |from: f64, to: f64, sense: &str| {
        let data = format!(
            "#30=TRIMMED_CURVE('',#21,(PARAMETER_VALUE({from:?})),(PARAMETER_VALUE({to:?})),.{sense}.,\
                 .PARAMETER.);"
        );
        let item = one(&data, "#30");
        assert_eq!(
            (item.kind, item.name.as_deref()),
            (Kind::Arc, Some("round"))
        );
        let (start, end) = ends(&item.shapes[0]).unwrap();
        near(start, 2.0 * dvec3(from.cos(), from.sin(), 0.0));
        near(end, 2.0 * dvec3(to.cos(), to.sin(), 0.0));
        let conic = conic(&item).clone();
        (conic.from, conic.to, conic.y.y)
    };
    assert_eq!(arc(0.5, 2.0, "T"), (0.5, 2.0, 2.0));
    assert_eq!(arc(2.0, 0.5, "T"), (2.0, 0.5 + TAU, 2.0));
    assert_eq!(arc(2.0, 0.5, "F"), (-2.0, -0.5, -2.0));
    assert_eq!(arc(0.5, 2.0, "F"), (-0.5, -2.0 + TAU, -2.0));
}

#[test]
fn arc_by_points() {
    let item = one(
        "#30=TRIMMED_CURVE('',#21,(#14),(#15),.T.,.CARTESIAN.);",
        "#30",
    );
    assert_eq!((conic(&item).from, conic(&item).to), (0.0, FRAC_PI_2));
    let item = one(
        "#30=TRIMMED_CURVE('',#21,(#14),(#15),.F.,.CARTESIAN.);",
        "#30",
    );
    near(
        dvec3(conic(&item).to - conic(&item).from, 0.0, 0.0),
        dvec3(1.5 * PI, 0.0, 0.0),
    );
}

#[test]
fn angles_in_degrees_and_lengths_in_inches() {
    let data =
        "#30=TRIMMED_CURVE('',#21,(PARAMETER_VALUE(90.)),(PARAMETER_VALUE(180.)),.T.,.PARAMETER.);";
    let drawing = drawing(&set(data, "#30").replace("(#90),#1)", "(#90),#2)"));
    assert_eq!(drawing.unit, Some(25.4));
    near(
        dvec3(
            conic(&drawing.items[0]).from,
            conic(&drawing.items[0]).to,
            0.0,
        ),
        dvec3(FRAC_PI_2, PI, 0.0),
    );
}

#[test]
fn parameters_that_miss_their_points_are_repaired() {
    let data = "#30=TRIMMED_CURVE('',#21,(#14,PARAMETER_VALUE(0.)),(#15,PARAMETER_VALUE(90.)),.T.,\
         .PARAMETER.);";
    let drawing = drawing(&set(data, "#30"));
    assert_eq!(conic(&drawing.items[0]).to, FRAC_PI_2);
    assert_eq!(
        drawing.remarks,
        ["line 23: #30 TRIMMED_CURVE: its parameters miss its points; the points are taken"]
    );
}

#[test]
fn lines_by_points_and_by_parameters() {
    let line = "#30=DIRECTION('',(3.,0.,0.));\n#31=VECTOR('',#30,2.);\n#32=LINE('',#13,#31);\n";
    let by_points = format!("{line}#33=TRIMMED_CURVE('',#32,(#13),(#12),.T.,.CARTESIAN.);");
    let item = one(&by_points, "#33");
    assert_eq!(item.kind, Kind::Line);
    assert_eq!(
        corners(&item),
        ([DVec3::Y, dvec3(1.0, 1.0, 0.0)].as_slice(), false)
    );
    let by_numbers = format!(
        "{line}#33=TRIMMED_CURVE('',#32,(PARAMETER_VALUE(1.)),(PARAMETER_VALUE(-2.)),.F.,.PARAMETER.);"
    );
    let item = one(&by_numbers, "#33");
    assert_eq!(
        corners(&item).0,
        [dvec3(2.0, 1.0, 0.0), dvec3(-4.0, 1.0, 0.0)]
    );
    let endless = drawing(&set(line, "#32"));
    assert_eq!(
        endless.remarks[0],
        "line 25: #32 LINE: it has no ends, skipped"
    );
}

#[test]
fn polylines_close_on_their_first_point() {
    let open = one("#30=POLYLINE('',(#10,#11,#12));", "#30");
    assert_eq!(
        (open.kind, corners(&open).0.len(), corners(&open).1),
        (Kind::Polyline, 3, false)
    );
    let closed = one("#30=POLYLINE('',(#10,#11,#12,#10));", "#30");
    assert_eq!((corners(&closed).0.len(), corners(&closed).1), (3, true));
    let part = "#30=POLYLINE('',(#10,#11,#12,#13));\n\
         #31=TRIMMED_CURVE('',#30,(PARAMETER_VALUE(2.5)),(#11),.F.,.PARAMETER.);";
    let part = one(part, "#31");
    assert_eq!(
        corners(&part).0,
        [dvec3(0.5, 1.0, 0.0), dvec3(1.0, 1.0, 0.0), DVec3::X]
    );
}

const CUBIC: &str = "#30=B_SPLINE_CURVE_WITH_KNOTS('',3,(#10,#11,#12,#13,#14,#15),.UNSPECIFIED.,.F.,.F.,\
     (4,1,1,4),\
     (0.,1.,2.,3.),.UNSPECIFIED.);\n";

#[test]
fn trimmed_spline_is_the_same_curve() {
    let whole = one(CUBIC, "#30");
    let at = |item: &Item, t: f64| Homogeneous::of(nurbs(item)).at(t).unwrap();
    for (from, to) in [(0.25, 2.75), (1.0, 2.0), (0.0, 1.5), (0.5, 0.75)] {
        let trim = |first: f64, last: f64, sense: &str| {
            let data = format!(
                "{CUBIC}#31=TRIMMED_CURVE('',#30,(PARAMETER_VALUE({first:?})),(PARAMETER_VALUE({last:?}))\
                     ,.{sense}.,\
                 .PARAMETER.);"
            );
            one(&data, "#31")
        };
        let (part, back) = (trim(from, to, "T"), trim(to, from, "F"));
        for step in 0..=20 {
            let t = from + (to - from) * f64::from(step) / 20.0;
            near(at(&part, t), at(&whole, t));
            near(at(&back, -t), at(&whole, t));
        }
    }
}

#[test]
fn spline_trimmed_by_a_point_of_it() {
    let whole = one(CUBIC, "#30");
    let middle = Homogeneous::of(nurbs(&whole)).at(1.25).unwrap();
    let data = format!(
        "{CUBIC}#31=CARTESIAN_POINT('',({:?},{:?},0.));\n\
             #32=TRIMMED_CURVE('',#30,(#31),(#15),.T.,.CARTESIAN.);",
        middle.x, middle.y
    );
    let part = one(&data, "#32");
    let from = nurbs(&part).knots[0];
    assert!((from - 1.25).abs() < 1e-9, "{from}");
}

#[test]
fn closed_spline_is_cut_over_its_joint() {
    let data = "#30=B_SPLINE_CURVE_WITH_KNOTS('',2,(#10,#11,#12,#13,#10),.UNSPECIFIED.,.T.,.F.,(3,1,1,3),\
         (0.,1.,2.,3.),.UNSPECIFIED.);\n";
    let whole = Homogeneous::of(nurbs(&one(data, "#30"))).at(0.5).unwrap();
    let trim = format!(
        "{data}#31=TRIMMED_CURVE('',#30,(PARAMETER_VALUE(2.5)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);"
    );
    let part = one(&trim, "#31");
    let spline = Homogeneous::of(nurbs(&part));
    assert_eq!((spline.knots[0], *spline.knots.last().unwrap()), (2.5, 4.0));
    near(spline.at(3.5).unwrap(), whole);
}

#[test]
fn composite_curve_reverses_its_pieces() {
    let item = one(
        "#30=TRIMMED_CURVE('',#21,(#14),(#15),.T.,.CARTESIAN.);\n#31=POLYLINE('',(#13,#15));\n\
         #32=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#30);\n\
         #33=COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.,.F.,#31);\n\
         #34=COMPOSITE_CURVE('',(#32,#33),.F.);",
        "#34",
    );
    assert_eq!((item.kind, item.shapes.len()), (Kind::Polycurve, 2));
    let (_, joint) = ends(&item.shapes[0]).unwrap();
    let (start, end) = ends(&item.shapes[1]).unwrap();
    near(joint, start);
    assert_eq!(end, DVec3::Y);
}

#[test]
fn surface_curve_is_its_curve_in_space() {
    let item = one("#30=SURFACE_CURVE('on',#21,(#99),.CURVE_3D.);", "#30");
    assert_eq!(
        (item.kind, item.name.as_deref()),
        (Kind::Circle, Some("on"))
    );
}

#[test]
fn unknown_curves_are_counted() {
    let drawing = drawing(&set(
        "#30=PARABOLA('',#20,1.);\n#31=PCURVE('',#20,#20);",
        "#30,#31,#21",
    ));
    let other: Vec<_> = drawing
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count, it.at))
        .collect();
    assert_eq!(other, [("PARABOLA", 1, 23), ("PCURVE", 1, 24)]);
    assert_eq!(drawing.items.len(), 1);
}
