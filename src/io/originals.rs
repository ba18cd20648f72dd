//! Tests of what is written back into files of other programs.

use glam::DVec3;

use super::exchange::drawing::Shape;
use super::loss::Loss;
use super::{Format, Original, Rest, WrittenBack, formats};
use crate::document::{Curve, CurveId, Document, Edit};
use crate::geometry::FloatPolygon;
use crate::geometry::references::Placement;

/// Of the size of a drawing: what placing coordinates there and back may cost.
const ROUNDING: f64 = 1e-14;

fn opened(extension: &str, text: &str) -> (Original, Document) {
    let format = format(extension);
    let reading = format.read(text.as_bytes()).expect("a drawing");
    let document = reading.into_document().expect("a document");
    let original = Original::new(format, text.as_bytes().to_vec(), document.clone());
    (original, document)
}

fn format(extension: &str) -> &'static Format {
    formats::find(extension).expect("a format")
}

fn named(document: &Document, name: &str) -> CurveId {
    let mut ids = document.all_ids();
    let is_named = |id: &CurveId| document.name(*id) == Some(name);
    ids.find(is_named).unwrap_or_else(|| panic!("no {name}"))
}

/// Move a curve or a reference.
fn moved(document: &Document, name: &str, by: DVec3) -> Document {
    let curve = named(document, name);
    let edit = match document.curve(curve) {
        Some(it) => Edit::MoveVertices {
            curve,
            moves: it
                .polygon
                .vertices()
                .iter()
                .map(|vertex| vertex + by)
                .enumerate()
                .collect(),
        },
        None => {
            let own = &document.reference(curve).expect("a reference").curve;
            let placement = own.placement();
            let to = placement.translation() + by;
            let placement = Placement::new(placement.rotation(), placement.scale(), to);
            Edit::SetReference {
                reference: curve,
                curve: own.clone().placed(placement.expect("a placement")),
            }
        }
    };
    document.edited(vec![edit]).expect("an edit")
}

fn kept(written: WrittenBack) -> String {
    assert_eq!(written.rest, Rest::Kept);
    String::from_utf8(written.export.bytes).expect("a text")
}

/// Check that two texts differ in the values of one attribute alone, and return these.
fn only_value<'t>(before: &'t str, after: &'t str) -> [&'t str; 2] {
    let common = |a: &str, b: &str| {
        let pairs = a.chars().zip(b.chars()).take_while(|(a, b)| a == b);
        pairs.map(|(a, _)| a.len_utf8()).sum::<usize>()
    };
    let start = before[..common(before, after)].rfind('"').expect("a quote") + 1;
    let [a, b] = [&before[start..], &after[start..]];
    let [a, b] = [a, b].map(|text| &text[..text.find('"').expect("a quote")]);
    assert_eq!(before.replacen(a, b, 1), after);
    [a, b]
}

/// A drawing as Inkscape writes it, with everything that must stay.
const INKSCAPE: &str = r##"<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape (http://www.inkscape.org/) -->
<svg
   width="210mm" height="297mm" viewBox="0 0 210 297"
   xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
   xmlns="http://www.w3.org/2000/svg"
   xmlns:svg="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview1"  pagecolor="#ffffff" />
  <defs id="defs1"><style type="text/css">.x { fill : none }</style></defs>
  <g inkscape:label="Deck &amp; Hull" inkscape:groupmode="layer" id="layer1" transform="translate(10,-3.5)">
    <path
       style="fill:none;stroke:#2060a0;stroke-width:0.26"
       d="M 10,20 C 30,10 50,80 90,40"
       id="sheer"
       sodipodi:nodetypes="cc" /><!-- stays -->
    <path d="m 1,2 c 3,4 5,6 7,8 m 10,10 2,2 3,-1 m 5,5 c 1,1 2,2 4,0 z" class='x' id="three" transform="matrix(0.8,0.6,-0.6,0.8,3,4)"/>
    <circle cx="40" cy="50" r='7' id="hole"><title>Hole</title></circle>
    <text x="5"   y="6">Sheer &lt; 12°</text>
    <rect x="1" y="2" width="30" height="20" id="frame" style="opacity:0.5"/>
    <polyline points="1,1 2,3 4,5" id="mark"/>
    <path sodipodi:type="star" sodipodi:sides="5" d="M 0,0 L 10,0 L 5,8 Z" id="star"/>
  </g>
  <symbol id="wheel"><path d="M 0,0 C 1,2 3,4 5,0" id="rim"/></symbol>
  <use href="#wheel" x="10"/>
  <use href="#wheel" x="30"/>
</svg>
"##;

const GLYPH: &str = r#"<?xml version='1.0' encoding='UTF-8'?>
<glyph name="o" format="2">
	<advance width="600"/>
	<unicode hex="006F"/>
	<anchor x="300" y="0" name="bottom"/>
	<outline>
		<component base="ring" xOffset="10"/>
		<contour>
			<point x="20" y="10"/>
			<point x="100" y="250.0" type="curve" smooth="yes" name="hr00"/>
			<point x="100" y="400"/>
			<point x="200" y="500"/>
			<point x="300" y="500" type="curve" identifier="abc"/>
			<point x="250" y="100"/>
		</contour>
		<contour identifier="second">
			<point x="0" y="0" type="line"/>
			<point x="10" y="0" type="line"/>
			<point x="5" y="8" type="line"/>
		</contour>
	</outline>
	<lib><dict><key>com.x</key><integer>3</integer></dict></lib>
</glyph>
"#;

#[test]
fn without_a_change_every_format_keeps_its_bytes() {
    let (svg, drawing) = opened("svg", INKSCAPE);
    assert_eq!(kept(svg.written_back(&drawing).expect("bytes")), INKSCAPE);
    let (glif, glyph) = opened("glif", GLYPH);
    assert_eq!(kept(glif.written_back(&glyph).expect("bytes")), GLYPH);
    for extension in ["dxf", "step", "igs", "3dm", "obj", "brep", "json"] {
        let curve = super::examples::EXAMPLES[0].read().expect("an example");
        let document = curve.into_document().expect("a document");
        let format = format(extension);
        let mut bytes = format.write(&document, None).expect("bytes").bytes;
        if extension == "igs" {
            // What readers pass over.
            bytes.extend(b"\n\n");
        }
        let document = format.read(&bytes).expect("a drawing").into_document();
        let document = document.expect("a document");
        let original = Original::new(format, bytes.clone(), document.clone());
        let written = original.written_back(&document).expect("bytes");
        assert_eq!((written.export.bytes, written.rest), (bytes, Rest::Kept));
    }
}

#[test]
fn a_moved_path_changes_its_data_alone() {
    let (original, document) = opened("svg", INKSCAPE);
    let by = DVec3::new(3.0, -2.0, 0.0);
    let document = moved(&document, "sheer", by);
    let text = kept(original.written_back(&document).expect("bytes"));
    let [_, data] = only_value(INKSCAPE, &text);
    let numbers: Vec<f64> = data
        .split(['M', 'C', ' '])
        .filter_map(|it| it.parse().ok())
        .collect();
    let expected = [13.0, 22.0, 33.0, 12.0, 53.0, 82.0, 93.0, 42.0];
    assert_eq!(numbers.len(), expected.len(), "{data}");
    for (number, expected) in numbers.iter().zip(expected) {
        assert!((number - expected).abs() <= ROUNDING * 297.0, "{data}");
    }
    let again = opened("svg", &text).1;
    assert_eq!(again.names().count(), document.names().count());
}

#[test]
fn subpaths_that_have_not_changed_keep_their_text() {
    let (original, document) = opened("svg", INKSCAPE);
    let document = moved(&document, "three 2", DVec3::new(0.0, 5.0, 0.0));
    let text = kept(original.written_back(&document).expect("bytes"));
    let [_, data] = only_value(INKSCAPE, &text);
    assert!(data.starts_with("m 1,2 c 3,4 5,6 7,8 M"), "{data}");
    // Relative to where the subpath before ended.
    assert!(data.ends_with("M 28 26 c 1,1 2,2 4,0 z"), "{data}");
    let off = |name: &str| {
        let again = opened("svg", &text).1;
        let [new, old] = [&again, &document].map(|it| {
            let shape = it.shape(named(it, name)).expect("a shape");
            [0.0, 0.3, 1.0].map(|share| shape.jet(share * shape.pieces() as f64).point)
        });
        new.iter()
            .zip(old)
            .map(|(a, b)| a.distance(b))
            .fold(0.0, f64::max)
    };
    let names = document.names().filter(|it| it.starts_with("three"));
    for name in names {
        assert!(off(name) <= ROUNDING * 297.0, "{name}: {}", off(name));
    }
}

#[test]
fn basic_shapes_become_paths_and_keep_everything_else() {
    let (original, document) = opened("svg", INKSCAPE);
    let by = DVec3::new(1.0, 0.0, 0.0);
    let text = |name: &str| {
        let document = moved(&document, name, by);
        let written = original.written_back(&document).expect("bytes");
        let told = written.export.losses.to_string();
        (kept(written), told)
    };
    let (hole, told) = text("Hole");
    assert!(
        hole.contains(r#"id="hole"><title>Hole</title></path>"#),
        "{hole}"
    );
    assert!(
        !hole.contains("<circle") && !hole.contains("r='7'"),
        "{hole}"
    );
    assert_eq!(told, "“Hole”: the circle becomes a path");
    let (frame, _) = text("frame");
    assert!(
        frame.contains(r#" id="frame" style="opacity:0.5"/>"#),
        "{frame}"
    );
    let (mark, told) = text("mark");
    let [_, points] = only_value(INKSCAPE, &mark);
    assert_eq!((points, told.as_str()), ("2,1 3,3 5,5", ""));
    let (star, told) = text("star");
    assert!(!star.contains("sodipodi:type"), "{star}");
    assert_eq!(told, "“star”: the Inkscape shape becomes a path");
}

#[test]
fn elements_go_and_come() {
    let (original, document) = opened("svg", INKSCAPE);
    let mark = named(&document, "mark");
    let removed = document.edited(vec![Edit::Remove(mark)]).expect("an edit");
    let text = kept(original.written_back(&removed).expect("bytes"));
    let line = "    <polyline points=\"1,1 2,3 4,5\" id=\"mark\"/>\n";
    assert_eq!(text, INKSCAPE.replacen(line, "", 1));

    let vertices = [(0.0, 0.0), (5.0, 9.0), (9.0, 9.0), (12.0, 0.0)];
    let vertices = vertices.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let polygon = FloatPolygon::new(3, vertices, None, false).expect("a polygon");
    let add = Edit::Add(Box::new(Curve::new("new", polygon.clone())));
    let added = document.edited(vec![add]).expect("an edit");
    let text = kept(original.written_back(&added).expect("bytes"));
    let end = INKSCAPE.len() - "</svg>\n".len();
    assert_eq!(
        (&text[..end], &text[text.len() - 7..]),
        (&INKSCAPE[..end], "</svg>\n")
    );
    let again = opened("svg", &text).1;
    let again = again
        .curve(named(&again, "new"))
        .expect("a curve")
        .polygon
        .clone();
    for share in [0.0, 0.4, 1.0] {
        let off = again.point(share).distance(polygon.point(share));
        assert!(off <= ROUNDING * 297.0, "{off}");
    }
}

#[test]
fn what_stands_for_a_reference_takes_its_element() {
    let (original, document) = opened("svg", INKSCAPE);
    let star = named(&document, "Hole");
    let vertices = [(0.0, 0.0), (5.0, 9.0), (9.0, 9.0), (12.0, 0.0)];
    let vertices = vertices.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let polygon = FloatPolygon::new(3, vertices, None, true).expect("a polygon");
    let edits = vec![
        Edit::Remove(star),
        Edit::Add(Box::new(Curve::new("Hole", polygon))),
    ];
    let document = document.edited(edits).expect("an edit");
    let text = kept(original.written_back(&document).expect("bytes"));
    assert!(
        text.contains(r#"id="hole"><title>Hole</title></path>"#),
        "{text}"
    );
    assert!(text.contains("Z\" id=\"hole\""), "{text}");
}

#[test]
fn what_cannot_be_changed_in_place_says_why() {
    let (original, document) = opened("svg", INKSCAPE);
    let document = moved(&document, "rim", DVec3::X);
    let written = original.written_back(&document).expect("bytes");
    let why = "“rim” is drawn in several places by one element".to_owned();
    assert_eq!(written.rest, Rest::Lost(Some(why)));

    let latin =
        "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0C1 2 3 4 5 0' id='\u{e9}'/></svg>";
    let bytes: Vec<u8> = latin.chars().map(|it| it as u8).collect();
    let format = format("svg");
    let document = format.read(&bytes).expect("a drawing").into_document();
    let document = document.expect("a document");
    let original = Original::new(format, bytes, document.clone());
    let document = moved(&document, "\u{e9}", DVec3::X);
    let written = original.written_back(&document).expect("bytes");
    let why = "the file is damaged, or its text is not UTF-8".to_owned();
    assert_eq!(written.rest, Rest::Lost(Some(why)));
}

#[test]
fn names_and_groups_stay_those_of_the_file_and_that_is_told() {
    let (original, document) = opened("svg", INKSCAPE);
    let curve = named(&document, "sheer");
    let name = "gunwale".to_owned();
    let renamed = document.edited(vec![Edit::Rename { curve, name }]);
    let written = original
        .written_back(&renamed.expect("an edit"))
        .expect("bytes");
    let told = written.export.losses.to_string();
    assert_eq!(told, "“gunwale”: the SVG keeps the old name");
    assert_eq!(kept(written), INKSCAPE);
}

#[test]
fn a_moved_contour_changes_its_coordinates_alone() {
    let (original, document) = opened("glif", GLYPH);
    let written = original.written_back(&moved(&document, "o", DVec3::new(1.0, 0.0, 0.0)));
    let written = written.expect("bytes");
    assert!(written.export.losses.is_empty());
    let text = kept(written);
    let mut expected = GLYPH.to_owned();
    for (old, new) in [
        ("x=\"20\" y=\"10\"", "x=\"21\" y=\"10\""),
        ("x=\"100\" y=\"250.0\"", "x=\"101\" y=\"250.0\""),
        ("x=\"100\" y=\"400\"", "x=\"101\" y=\"400\""),
        ("x=\"200\" y=\"500\"", "x=\"201\" y=\"500\""),
        ("x=\"300\" y=\"500\"", "x=\"301\" y=\"500\""),
        ("x=\"250\" y=\"100\"", "x=\"251\" y=\"100\""),
    ] {
        expected = expected.replacen(old, new, 1);
    }
    assert_eq!(text, expected);
}

#[test]
fn contours_go_come_and_change_their_points() {
    let (original, document) = opened("glif", GLYPH);
    let second = named(&document, "o 2");
    let removed = document
        .edited(vec![Edit::Remove(second)])
        .expect("an edit");
    let text = kept(original.written_back(&removed).expect("bytes"));
    let from = GLYPH.find("\n\t\t<contour identifier").expect("a contour");
    let to = GLYPH.find("\n\t</outline>").expect("an outline");
    assert_eq!(text, [&GLYPH[..from], &GLYPH[to..]].concat());

    let vertices = [(0.0, 0.0), (5.0, 9.0), (9.0, 9.0), (12.0, 0.0)];
    let vertices = vertices.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let polygon = FloatPolygon::new(3, vertices, None, false).expect("a polygon");
    let add = |name: &str| Edit::Add(Box::new(Curve::new(name, polygon.clone())));
    let other = document.edited(vec![Edit::Remove(second), add("o 2"), add("new")]);
    let written = original
        .written_back(&other.expect("an edit"))
        .expect("bytes");
    let told = written.export.losses.to_string();
    assert!(
        told.contains("“o 2”: its contour does not close any more"),
        "{told}"
    );
    let text = kept(written);
    assert_eq!(text[..from], GLYPH[..from]);
    assert!(
        text.contains("<contour identifier=\"second\">\n\t\t\t<point x="),
        "{text}"
    );
    let drawing = format("glif").draw(text.as_bytes()).expect("a drawing");
    let cubics = drawing.items.iter().flat_map(|it| &it.shapes);
    let cubics = cubics.filter(|it| matches!(it, Shape::Nurbs(it) if it.degree == 3));
    assert_eq!((drawing.items.len(), cubics.count()), (3, 3));
}

#[test]
fn curves_in_space_are_left_out_of_planar_formats_by_name() {
    let flat = [
        (0.0, 0.0, 0.0),
        (5.0, 9.0, 0.0),
        (9.0, 9.0, 0.0),
        (12.0, 0.0, 0.0),
    ];
    let mut raised = flat;
    raised[1].2 = 3.0;
    let curve = |name: &str, points: [(f64, f64, f64); 4]| {
        let points = points.map(|(x, y, z)| DVec3::new(x, y, z)).to_vec();
        Curve::new(
            name,
            FloatPolygon::new(3, points, None, false).expect("a polygon"),
        )
    };
    let both = Document::from_curves([curve("flat", flat), curve("raised", raised)]);
    let alone = Document::from_curves([curve("raised", raised)]);
    for extension in ["svg", "glif"] {
        let format = format(extension);
        let export = format.write(&both, None).expect("bytes");
        assert_eq!(export.losses.left_out(), [1, 0]);
        let left_out = export.losses.losses.iter().filter(|(_, loss)| {
            matches!(loss, Loss::LeftOut { what, .. } if what == "a curve outside of the plane z = 0")
        });
        let names: Vec<&str> = left_out.map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["raised"]);
        let read = format.read(&export.bytes).expect("a drawing");
        assert_eq!(read.curves.len(), 1, "{extension}");
        let refused = format.write(&alone, None).expect_err("nothing is left");
        let told = refused.to_string();
        assert!(
            told.contains("“raised” is a curve outside of the plane z = 0"),
            "{told}"
        );
    }
}

#[test]
fn what_a_drawing_has_beside_curves_is_counted() {
    let text = "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n0\n0\nHATCH\n0\nTEXT\n0\nHATCH\n0\nENDSEC\n0\nEOF\n";
    let (original, _) = opened("dxf", text);
    assert_eq!(original.others(), ["2 HATCH", "1 TEXT"]);
}
