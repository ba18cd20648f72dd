//! Tests of solids, assemblies, styles, strings and damage.

use glam::{DVec3, dvec3};

use super::read;
use super::tests::{file, set};
use super::text::{decode, encode};
use crate::io::exchange::drawing::{Drawing, Kind, Shape, Space};

fn drawing(text: &str) -> Drawing {
    read(text.as_bytes()).unwrap()
}

fn first_corner(drawing: &Drawing, item: usize) -> DVec3 {
    match drawing.items[item].shapes.as_slice() {
        [Shape::Polyline { points, .. }] => points[0],
        other => panic!("{other:?}"),
    }
}

/// A shell of one face, whose loop is an edge on a circle twice and one on a line against its sense.
pub const SHELL: &str = "#10=CARTESIAN_POINT('',(0.,0.,0.));\n#14=CARTESIAN_POINT('',(2.,0.,0.));\n\
     #15=CARTESIAN_POINT('',(0.,2.,0.));\n#20=AXIS2_PLACEMENT_3D('',#10,$,$);\n#21=CIRCLE('',#20,2.);\n\
     #30=VERTEX_POINT('',#14);\n#31=VERTEX_POINT('',#15);\n#32=EDGE_CURVE('e',#31,#30,#21,.F.);\n\
     #33=ORIENTED_EDGE('',*,*,#32,.T.);\n#34=DIRECTION('',(1.,-1.,0.));\n#35=VECTOR('',#34,1.);\n\
     #36=LINE('',#15,#35);\n#37=EDGE_CURVE('',#30,#31,#36,.F.);\n#38=ORIENTED_EDGE('',*,*,#37,.T.);\n\
     #39=EDGE_LOOP('',(#33,#38,#33));\n#40=FACE_OUTER_BOUND('',#39,.T.);\n#41=PLANE('',#20);\n\
     #42=ADVANCED_FACE('',(#40),#41,.T.);\n#43=OPEN_SHELL('',(#42));\n\
     #44=SHELL_BASED_SURFACE_MODEL('',(#43));\n\
     #45=SHAPE_REPRESENTATION('',(#20,#44),#1);";

#[test]
fn edges_of_solids_run_from_vertex_to_vertex() {
    let drawing = drawing(&file(SHELL));
    assert_eq!(drawing.remarks, Vec::<String>::new());
    let kinds: Vec<_> = drawing.items.iter().map(|it| (it.kind, it.space)).collect();
    assert_eq!(kinds, [(Kind::Arc, Space::Edge), (Kind::Line, Space::Edge)]);
    assert_eq!(drawing.items[0].name.as_deref(), Some("e"));
    let (start, end) = super::evaluation::ends(&drawing.items[0].shapes[0]).unwrap();
    assert!(start.distance(2.0 * DVec3::Y) < 1e-15 && end.distance(2.0 * DVec3::X) < 1e-15);
    let (start, end) = super::evaluation::ends(&drawing.items[1].shapes[0]).unwrap();
    assert_eq!((start, end), (2.0 * DVec3::X, 2.0 * DVec3::Y));
    assert_eq!(drawing.other[0].kind, "SHELL_BASED_SURFACE_MODEL");
}

/// Part 'leaf' with a polyline (context 2: inches), inserted into 'tree' (millimetres) twice.
const ASSEMBLY: &str = "#10=CARTESIAN_POINT('',(1.,0.,0.));\n#11=CARTESIAN_POINT('',(1.,1.,0.));\n\
     #12=POLYLINE('',(#10,#11));\n#13=GEOMETRIC_CURVE_SET('',(#12));\n#14=CARTESIAN_POINT('',(0.,0.,0.));\n\
     #15=AXIS2_PLACEMENT_3D('',#14,$,$);\n#16=SHAPE_REPRESENTATION('',(#13),#2);\n\
     #17=SHAPE_REPRESENTATION('',(#15),#2);\n#18=SHAPE_REPRESENTATION_RELATIONSHIP('','',#17,#16);\n\
     #20=PRODUCT('leaf','leaf','',());\n#21=PRODUCT_DEFINITION_FORMATION('','',#20);\n\
     #22=PRODUCT_DEFINITION('','',#21,$);\n#23=PRODUCT_DEFINITION_SHAPE('','',#22);\n\
     #24=SHAPE_DEFINITION_REPRESENTATION(#23,#17);\n#30=PRODUCT('tree','tree','',());\n\
     #31=PRODUCT_DEFINITION_FORMATION('','',#30);\n#32=PRODUCT_DEFINITION('','',#31,$);\n\
     #33=PRODUCT_DEFINITION_SHAPE('','',#32);\n#34=SHAPE_DEFINITION_REPRESENTATION(#33,#35);\n\
     #35=SHAPE_REPRESENTATION('',(#36,#39),#1);\n#36=AXIS2_PLACEMENT_3D('',#37,$,$);\n\
     #37=CARTESIAN_POINT('',(100.,0.,0.));\n#38=DIRECTION('',(0.,1.,0.));\n\
     #39=AXIS2_PLACEMENT_3D('',#37,$,#38);\n";

/// Insert the leaf: `first` in its own space comes to lie on `second` in that of the tree.
fn insert(number: u64, first: u64, second: u64, turned: bool) -> String {
    let n = number;
    let ends = if turned { "#35,#17" } else { "#17,#35" };
    let items = if turned {
        [second, first]
    } else {
        [first, second]
    };
    format!(
        "#{n}0=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#32,#22,$);\n\
             #{n}1=PRODUCT_DEFINITION_SHAPE('','',#{n}0);\n\
         #{n}2=ITEM_DEFINED_TRANSFORMATION('','',#{},#{});\n\
         #{n}3=(REPRESENTATION_RELATIONSHIP('','',{ends})\
         REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{n}2)\
         SHAPE_REPRESENTATION_RELATIONSHIP());\n#{n}4=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{n}3,#{n}1);\n",
        items[0], items[1]
    )
}

#[test]
fn parts_are_placed_and_scaled_into_the_assembly() {
    for turned in [false, true] {
        let text = file(&format!(
            "{ASSEMBLY}{}{}",
            insert(5, 15, 36, turned),
            insert(6, 15, 39, turned)
        ));
        let drawing = drawing(&text);
        assert_eq!(drawing.remarks, Vec::<String>::new());
        // The first representation is the leaf's: inches.
        assert_eq!((drawing.unit, drawing.items.len()), (Some(25.4), 2));
        assert!(
            drawing
                .items
                .iter()
                .all(|it| it.block.as_deref() == Some("leaf"))
        );
        let millimetres = |item| first_corner(&drawing, item) * 25.4;
        assert!(millimetres(0).distance(dvec3(125.4, 0.0, 0.0)) < 1e-12);
        assert!(millimetres(1).distance(dvec3(100.0, 25.4, 0.0)) < 1e-12);
    }
}

#[test]
fn first_axes_of_a_transformation_come_to_lie_on_the_second() {
    let own = "#70=DIRECTION('',(0.,0.,1.));\n#71=AXIS2_PLACEMENT_3D('',#10,$,#38);\n";
    let drawing = drawing(&file(&format!(
        "{ASSEMBLY}{own}{}",
        insert(5, 71, 36, false)
    )));
    // The leaf's (1, 0, 0) is the origin of its axes, so it goes to the origin of the tree's.
    assert!((first_corner(&drawing, 0) * 25.4).distance(dvec3(100.0, 0.0, 0.0)) < 1e-12);
}

#[test]
fn part_alone_is_no_block() {
    let drawing = drawing(&file(ASSEMBLY));
    assert_eq!(drawing.items.len(), 1);
    assert_eq!(
        (drawing.items[0].block.as_deref(), first_corner(&drawing, 0)),
        (None, DVec3::X)
    );
}

/// A chain of representations, each holding the one before twice; the first holds a polyline.
fn mapped(levels: u64) -> String {
    let mut text = "#10=CARTESIAN_POINT('',(1.,0.,0.));\n#11=CARTESIAN_POINT('',(1.,1.,0.));\n\
         #12=POLYLINE('',(#10,#11));\n#13=CARTESIAN_POINT('',(0.,0.,5.));\n\
         #14=CARTESIAN_POINT('',(0.,0.,0.));\n\
         #15=AXIS2_PLACEMENT_3D('',#13,$,$);\n#16=AXIS2_PLACEMENT_3D('',#14,$,$);\n\
         #100=SHAPE_REPRESENTATION('inner',(#12),#1);\n"
        .to_owned();
    for level in 1..=levels {
        let (n, inner) = (10 * (level + 10), 10 * (level + 9));
        text += &format!(
            "#{}=REPRESENTATION_MAP(#16,#{inner});\n#{}=MAPPED_ITEM('',#{},#15);\n\
                 #{}=MAPPED_ITEM('',#{},#16);\n\
             #{n}=SHAPE_REPRESENTATION('',(#{},#{}),#1);\n",
            n + 1,
            n + 2,
            n + 1,
            n + 3,
            n + 1,
            n + 2,
            n + 3
        );
    }
    file(&text)
}

#[test]
fn mapped_items_nest() {
    let drawing = drawing(&mapped(2));
    assert_eq!(drawing.remarks, Vec::<String>::new());
    let mut heights: Vec<f64> = (0..4).map(|item| first_corner(&drawing, item).z).collect();
    heights.sort_by(f64::total_cmp);
    assert_eq!(
        (drawing.items.len(), heights),
        (4, vec![0.0, 5.0, 5.0, 10.0])
    );
    assert_eq!(drawing.items[0].block.as_deref(), Some("inner"));
}

#[test]
fn doubling_without_end_is_cut_off() {
    let drawing = drawing(&mapped(40));
    assert!(
        (1000..=1_000_000).contains(&drawing.items.len()),
        "{}",
        drawing.items.len()
    );
    assert!(
        drawing
            .remarks
            .iter()
            .any(|it| it.contains("the rest is left out")),
        "{:?}",
        drawing.remarks
    );
}

#[test]
fn circles_of_references_end() {
    let text = mapped(1).replace(
        "REPRESENTATION('inner',(#12)",
        "REPRESENTATION('inner',(#12,#112)",
    );
    assert!(
        drawing(&text)
            .remarks
            .iter()
            .any(|it| it.contains("within itself"))
    );
    let text = set(
        "#30=TRIMMED_CURVE('',#30,(#10),(#11),.T.,.CARTESIAN.);",
        "#30,#21",
    );
    let cyclic = drawing(&text);
    assert_eq!((cyclic.items.len(), cyclic.remarks.len()), (1, 1));
    let data = "#30=COMPOSITE_CURVE('',(#31,#31,#31,#31),.F.);\n\
         #31=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#30);";
    let remarks = drawing(&set(data, "#30")).remarks;
    assert!(
        remarks[0].ends_with("it refers to itself; the piece is left out"),
        "{remarks:?}"
    );
}

#[test]
fn layers_colours_and_points() {
    let data = "#30=COLOUR_RGB('',1.,0.5,0.);\n#31=CURVE_STYLE('',$,$,#30);\n\
         #32=PRESENTATION_STYLE_ASSIGNMENT((#31));\n#33=STYLED_ITEM('',(#32),#21);\n\
         #34=PRESENTATION_LAYER_ASSIGNMENT('a/b','',(#21));\n\
         #35=PRESENTATION_LAYER_ASSIGNMENT('all','',(#90));\n\
         #36=DRAUGHTING_PRE_DEFINED_COLOUR('cyan');\n#37=CURVE_STYLE('',$,$,#36);\n\
         #38=PRESENTATION_STYLE_ASSIGNMENT((#37));\n#39=STYLED_ITEM('',(#38),#90);";
    let drawing = drawing(&set(data, "#21,#11"));
    let [circle, point] = drawing.items.as_slice() else {
        panic!()
    };
    assert_eq!(
        (circle.group.join(">").as_str(), circle.colour),
        ("a>b", Some([255, 128, 0]))
    );
    assert_eq!(
        (point.group.join(">").as_str(), point.colour),
        ("all", Some([0, 255, 255]))
    );
    assert_eq!(
        (point.kind, point.shapes.as_slice()),
        (Kind::Point, [Shape::Point(DVec3::X)].as_slice())
    );
}

#[test]
fn strings_with_every_escape() {
    assert_eq!(
        decode(b"it''s \\\\ \\S\\D \\X\\E9"),
        "it's \\ \u{c4} \u{e9}"
    );
    assert_eq!(decode(b"\\PE\\\\S\\P\\PA\\\\S\\P"), "\u{430}\u{d0}");
    assert_eq!(
        decode(b"\\X2\\03B103B2D83DDE00\\X0\\!"),
        "\u{3b1}\u{3b2}\u{1f600}!"
    );
    assert_eq!(decode(b"\\X4\\0001F600\\X0\\"), "\u{1f600}");
    assert_eq!(decode("\u{fc}".as_bytes()), "\u{fc}");
    assert_eq!(decode(b"\xfc"), "\u{fc}");
    assert_eq!(decode(b"\\X2\\03"), "\\X2\\03");
    for text in ["plain", "it's \\X2\\", "\u{e4}\n\u{1f600}'\\", ""] {
        assert_eq!(decode(encode(text).as_bytes()), text);
    }
}

#[test]
fn damage_is_told_with_line_entity_and_reason() {
    let broken = "#30=POLYLINE('open,(#10,#11));\n#31=POLYLINE('',(#10,#11));\n#31=POLYLINE('',(#10));\n\
         #32=B_SPLINE_CURVE_WITH_KNOTS('',3,(#10,#11),.U.,.F.,.F.,(4,4),(0.,1.),.U.);\n\
         #33=B_SPLINE_CURVE_WITH_KNOTS('',1,(#10,#11),.U.,.F.,.F.,(2,99999999999),(0.,1.),.U.);\nrubbish;\n\
         #34=CIRCLE('',#20,1.E999);";
    let drawing = drawing(&set(broken, "#30,#31,#32,#33,#34,#99"));
    assert_eq!(
        drawing.remarks,
        [
            "line 23: #30=POLYLINE('open,(: no semicolon ends it",
            "line 28: rubbish: no instance, skipped",
            "line 25: #31: its number is taken, skipped",
            "line 23: #30 POLYLINE: it has less than two points, skipped",
            "line 26: #32 B_SPLINE_CURVE_WITH_KNOTS: 2 points are too few for degree 3, skipped",
            "line 27: #33 B_SPLINE_CURVE_WITH_KNOTS: its points need 4 knots, it has more, skipped",
            "line 29: #34 CIRCLE: its placement or size is damaged, skipped",
            "line 30: #90 GEOMETRIC_CURVE_SET: #99 in it is missing, skipped",
        ]
    );
    assert_eq!(drawing.items.len(), 1);
}

#[test]
fn file_that_is_cut_off_keeps_its_curves() {
    let text = set("#30=POLYLINE('',(#10,#11));", "#21");
    let cut = text.split("#90=").next().unwrap();
    let drawing = drawing(cut);
    assert_eq!(drawing.unit, Some(1.0));
    assert_eq!(drawing.items.len(), 3);
    assert!(
        drawing.remarks.iter().any(|it| it.contains("ENDSEC")),
        "{:?}",
        drawing.remarks
    );
    assert!(
        read(b"ISO-10303-21;\nHEADER;\n")
            .unwrap_err()
            .reason
            .contains("no DATA")
    );
}

/// An assembly with a part in two places and a mapped item.
pub fn assembled() -> String {
    let mapped = "#80=REPRESENTATION_MAP(#15,#16);\n#81=MAPPED_ITEM('',#80,#39);\n\
         #82=SHAPE_REPRESENTATION('',(#81),#1);\n";
    file(&format!(
        "{ASSEMBLY}{mapped}{}{}",
        insert(5, 15, 36, false),
        insert(6, 15, 39, false)
    ))
}

#[test]
fn mapped_item_may_be_scaled_and_mirrored() {
    let operator = "#17=DIRECTION('',(0.,-1.,0.));\n\
         #15=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,#17,#13,2.,$);\n";
    let text = mapped(1).replace("#15=AXIS2_PLACEMENT_3D('',#13,$,$);\n", operator);
    let drawing = drawing(&text);
    assert_eq!(drawing.remarks, Vec::<String>::new());
    let Shape::Polyline { points, .. } = &drawing.items[0].shapes[0] else {
        panic!()
    };
    assert_eq!(points[..], [dvec3(2.0, 0.0, 5.0), dvec3(2.0, -2.0, 5.0)]);
}
