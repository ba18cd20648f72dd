//! Tests of transforms, groups, uses, units and damage.

use super::*;

#[test]
fn all_transforms() {
    let cases = [
        ("translate(3)", (13., 80.)),
        ("translate(3 4)", (13., 76.)),
        ("scale(2)", (20., 60.)),
        ("scale(2,.5)", (20., 90.)),
        ("rotate(90)", (-20., 90.)),
        ("rotate(90 10 10)", (0., 90.)),
        ("skewX(45)", (30., 80.)),
        ("skewY(45)", (10., 70.)),
        ("matrix(1 2 3 4 5 6)", (75., -6.)),
        ("translate(1) scale(2)", (21., 60.)),
        ("scale(2),translate(1)", (22., 60.)),
        ("", (10., 80.)),
    ];
    for (transform, (x, y)) in cases {
        let line = "<path d='M10 20h1'/>";
        let found = page(&format!("<g transform='{transform}'>{line}</g>"));
        assert_near(starts(&found)[0], point(x, y));
        assert!(found.remarks.is_empty(), "{transform}: {:?}", found.remarks);
    }
    let found = page("<path d='M10 20h1' transform='scale(2) what'/>");
    assert_near(starts(&found)[0], point(20., 60.));
    assert_eq!(found.remarks.len(), 1);
}

#[test]
fn layers_groups_names_and_colours() {
    let found = page(
        "<g inkscape:groupmode='layer' inkscape:label='Hull &amp; deck' id='layer1' stroke='red'>\
         <g id='frames' style='fill:none;stroke:#0f0'><g id='g12'><path id='p1' d='M0 0h1'/></g></g>\
         <path inkscape:label='keel' id='p2' d='M0 0h1'/>\
         <path stroke='none' fill='rgb(1,2,3)' d='M0 0h1'><title>T</title></path></g>\
         <g id='Ebene_x0020_1' color='blue'><path stroke='currentColor' d='M0 0h1'/></g><path d='M0 0h1'/>",
    );
    let summary: Vec<_> = found
        .items
        .iter()
        .map(|it| {
            (
                it.group.join("/"),
                it.name.clone().unwrap_or_default(),
                it.colour,
            )
        })
        .collect();
    let expected = [
        ("Hull & deck/frames", "p1", Some([0, 255, 0])),
        ("Hull & deck", "keel", Some([255, 0, 0])),
        ("Hull & deck", "T", Some([1, 2, 3])),
        ("Ebene 1", "", Some([0, 0, 255])),
        ("", "", None),
    ]
    .map(|(group, name, colour)| (group.to_owned(), name.to_owned(), colour));
    assert_eq!(summary, expected);
}

#[test]
fn style_sheets_of_classes() {
    let found = page(
        "<style>/* x */ .a,.b{stroke:#123456} #c{display:none} path{fill:red} g > .a{stroke:blue}</style>\
         <path class='z b' d='M0 0h1'/><path id='c' d='M0 0h1'/><path d='M0 0h1'/>",
    );
    let colours: Vec<_> = found.items.iter().map(|it| it.colour).collect();
    assert_eq!(colours, [Some([0x12, 0x34, 0x56]), Some([255, 0, 0])]);
    assert_eq!(found.remarks.len(), 1);
}

#[test]
fn the_last_rule_of_a_selector_counts() {
    let found = page(
        "<style>.a,.b{stroke:red;stroke:#123456}.a{stroke:inherit}.b{stroke:blue}.b{fill:red}</style>\
         <path class='a' d='M0 0h1'/><path class='b' d='M0 0h1'/>",
    );
    let colours: Vec<_> = found.items.iter().map(|it| it.colour).collect();
    assert_eq!(colours, [Some([0x12, 0x34, 0x56]), Some([0, 0, 255])]);
}

#[test]
fn hidden_elements_are_skipped_with_one_remark() {
    let found = page(
        "<g style='display:none'><path d='M0 0h1'/></g>\n<path visibility='hidden' d='M0 0h1'/>\
         <g visibility='hidden'><path visibility='visible' d='M0 0h1'/></g>",
    );
    assert_eq!(found.items.len(), 1);
    assert_eq!(
        found.remarks,
        ["line 2: 2 hidden elements are skipped, of which this is the first"]
    );
}

#[test]
fn uses_of_elements_and_symbols() {
    let found = page(
        "<defs><path id='a' d='M1 1h1'/><symbol id='s' viewBox='0 0 10 10'><path d='M1 1h1'/></symbol></defs>\
         <use href='#a' x='10' y='20'/><use xlink:href='#s' x='10' width='50' height='50'/>\
         <use transform='scale(2)' href='#a'/>",
    );
    assert_eq!(
        starts(&found),
        [point(11., 79.), point(15., 95.), point(2., 98.)]
    );
    let blocks: Vec<_> = found
        .items
        .iter()
        .map(|it| it.block.as_deref().unwrap())
        .collect();
    assert_eq!(blocks, ["a", "s", "a"]);
}

#[test]
fn uses_that_lead_nowhere_have_a_remark() {
    let found =
        page("<use href='#x'/>\n<g id='y'><use href='#y'/></g>\n<use href='b.svg#x'/>\n<use/>");
    assert_eq!(found.items.len(), 0);
    assert_eq!(found.remarks.len(), 4, "{:?}", found.remarks);
    assert!(found.remarks[1].contains("#y uses itself"));
}

#[test]
fn chains_of_uses_are_cut_off() {
    let mut content = "<path id='a0' d='M0 0h1'/>".to_owned();
    for level in 1..30 {
        content += &format!(
            "<g id='a{level}'>{}</g>",
            format!("<use href='#a{}'/>", level - 1).repeat(10)
        );
    }
    let found = page(&format!("<defs>{content}</defs><use href='#a29'/>"));
    assert!(found.items.len() <= 1_000_000);
    assert_eq!(found.remarks.len(), 1, "{:?}", found.remarks);
    assert!(found.remarks[0].contains("uses elements again too often"));
}

#[test]
fn deep_groups_are_cut_off() {
    let found = page(&format!(
        "{}<path d='M0 0h1'/>{}<path d='M0 0h1'/>",
        "<g>".repeat(100),
        "</g>".repeat(100)
    ));
    assert_eq!(found.items.len(), 1);
    assert!(found.remarks[0].contains("nested more than 64 deep"));
    let text = format!("<svg>{}", "<g>".repeat(100_000));
    assert!(
        read(text.as_bytes())
            .unwrap_err()
            .reason
            .contains("256 elements inside")
    );
}

#[test]
fn nested_drawings_fit_their_view_boxes() {
    let line = "<path d='M10 10h1'/>";
    let cases = [
        ("viewBox='0 0 100 100' width='50' height='20'", (17., 98.)),
        (
            "viewBox='0 0 100 100' width='50' height='20' preserveAspectRatio='xMinYMax'",
            (2., 98.),
        ),
        (
            "viewBox='0 0 100 100' width='50' height='20' preserveAspectRatio='none'",
            (5., 98.),
        ),
        (
            "viewBox='0 0 100 100' width='50' height='20' preserveAspectRatio='xMidYMid slice'",
            (5., 110.),
        ),
        ("viewBox='5 5 50 50' x='10' y='20'", (20., 70.)),
        ("x='10' y='20'", (20., 70.)),
        ("x='10' y='20' width='5' height='5'", (20., 70.)),
    ];
    for (attributes, (x, y)) in cases {
        assert_near(
            starts(&page(&format!("<svg {attributes}>{line}</svg>")))[0],
            point(x, y),
        );
    }
}

#[test]
fn units_of_the_page() {
    let line = "<path d='M10 10h1'/>";
    let px = 25.4 / 96.;
    let cases = [
        (
            "width='10cm' height='5cm' viewBox='0 0 200 100'",
            Some(1.0),
            (5., 45.),
        ),
        (
            "width='2in' viewBox='0 0 200 100'",
            Some(1.0),
            (2.54, 25.4 - 2.54),
        ),
        (
            "width='720pt' height='72pt' viewBox='0 0 720 72'",
            Some(1.0),
            (254. / 72., 25.4 - 254. / 72.),
        ),
        (
            "width='6pc' height='6pc' viewBox='0 0 60 60'",
            Some(1.0),
            (25.4 / 6., 25.4 - 25.4 / 6.),
        ),
        (
            "width='100px' height='50px'",
            Some(1.0),
            (10. * px, 40. * px),
        ),
        (
            "width='100mm' height='50mm'",
            Some(1.0),
            (10. * px, 50. - 10. * px),
        ),
        ("width='100' height='50'", None, (10., 40.)),
        ("width='100%' viewBox='0 0 200 100'", None, (10., 90.)),
        (
            "viewBox='-20 -30 200 100' width='200mm' height='100mm'",
            Some(1.0),
            (10., -10.),
        ),
        ("", None, (10., -10.)),
        (
            "inkscape:version='0.48.4 r9939' width='100px' height='50px'",
            None,
            (10., 40.),
        ),
        (
            "inkscape:version='0.48.4 r9939' width='254mm' height='25.4mm'",
            None,
            (10., 80.),
        ),
        (
            "inkscape:version='0.91 r1' width='10mm' height='10mm' viewBox='0 0 100 100'",
            Some(1.0),
            (1., 9.),
        ),
        (
            "inkscape:version='1.2 (x)' width='100px' height='50px'",
            Some(1.0),
            (10. * px, 40. * px),
        ),
    ];
    for (attributes, unit, (x, y)) in cases {
        let found = drawing(attributes, line);
        assert_eq!(found.unit, unit, "{attributes}");
        assert_near(starts(&found)[0], point(x, y));
        assert_eq!(
            found.remarks.len(),
            usize::from(unit.is_none()),
            "{attributes}"
        );
    }
    assert!(drawing("width='100'", line).remarks[0].contains("96 an inch"));
    assert!(drawing("inkscape:version='0.91'", line).remarks[0].contains("90 pixels"));
    let text = "<!-- Generator: Adobe Illustrator 24 -->\
                <svg width='100px' height='50px'><path d='M1 1h1'/></svg>";
    let found = read(text.as_bytes()).unwrap();
    assert_eq!(found.unit, None);
    assert!(found.remarks[0].contains("72 pixels"));
}

#[test]
fn what_is_no_curve_is_counted_with_its_line() {
    let found =
        page("<text>a</text>\n<image/>\n<text>b</text><metadata><x:y xmlns:x='z'/></metadata>");
    let other: Vec<_> = found
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count, it.at))
        .collect();
    assert_eq!(other, [("text", 2, 2), ("image", 1, 3)]);
}

#[test]
fn entities_of_illustrator() {
    let text = "<!DOCTYPE svg [<!-- it's --><!ENTITY ns 'http://www.w3.org/2000/svg'><!ENTITY blue '#00f'>]>\
                <svg xmlns='&ns;' width='9mm' height='9mm'><switch><foreignObject requiredExtensions='x'/>\
                <g stroke='&blue;'><path d='M0 0h1'/></g></switch></svg>";
    assert_eq!(
        read(text.as_bytes()).unwrap().items[0].colour,
        Some([0, 0, 255])
    );
}

#[test]
fn forgotten_prefixes_are_declared() {
    let text =
        "<?xml version='1.0'?>\n<svg><path id='a' d='M0 0h1'/><use xlink:href='#a' x:y=''/></svg>";
    let found = read(text.as_bytes()).unwrap();
    assert_eq!(found.items[1].block.as_deref(), Some("a"));
    assert!(
        found.remarks[0].starts_with("line 2: the prefix “xlink”"),
        "{:?}",
        found.remarks
    );
    assert!(found.remarks[1].contains("“x”"));
}

#[test]
fn clips_are_counted() {
    let found = page(
        "<clipPath><path d='M0 0h1'/></clipPath><marker/><path clip-path='url(#a)' d='M0 0h1'/>",
    );
    let other: Vec<_> = found
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count))
        .collect();
    assert_eq!(
        (found.items.len(), other),
        (1, vec![("clipPath", 1), ("marker", 1)])
    );
}

#[test]
fn hostile_entities_are_refused() {
    let text = format!(
        "<!DOCTYPE svg [<!ENTITY a '{}'>]><svg>{}</svg>",
        "x".repeat(9999),
        "&a;".repeat(9999)
    );
    assert!(
        read(text.as_bytes())
            .unwrap_err()
            .reason
            .contains("entities")
    );
}

#[test]
fn damaged_files_are_read_up_to_the_damage() {
    let whole = "<svg width='9mm' height='9mm'>\n<g id='a'>\n<path d='M0 0h1'/>\n\
                 <path d='M0 0h2'/></g></svg>";
    let found = read(&whole.as_bytes()[..whole.find("h2").unwrap()]).unwrap();
    assert_eq!(found.items.len(), 1);
    assert!(
        found.remarks[0].starts_with("line 3: the file is damaged"),
        "{:?}",
        found.remarks
    );
    let found = read(whole.replace("</g>", "</h>").as_bytes()).unwrap();
    assert_eq!((found.items.len(), found.remarks.len()), (2, 1));
    for (bytes, reason) in [
        (&b"\x1f\x8b\x08"[..], "compressed"),
        (b"", "XML"),
        (b"<html></html>", "its root is <html>"),
        (b"a\0b", "binary"),
    ] {
        assert!(read(bytes).unwrap_err().reason.contains(reason));
    }
}

#[test]
fn other_encodings() {
    let text = "<svg><g id='\u{e4}'><path d='M0 0h1'/></g></svg>";
    let latin: Vec<u8> = text.chars().map(|it| it as u8).collect();
    let wide: Vec<u8> = std::iter::once(0xfeff)
        .chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    for bytes in [text.as_bytes(), &latin, &wide] {
        assert_eq!(read(bytes).unwrap().items[0].group[..], ["\u{e4}"]);
    }
}

#[test]
fn numbers_beyond_all_are_skipped() {
    let found =
        page("<g transform='scale(1e300)'><path d='M1e300 0h1'/></g><path d='M1e999 0h1'/>");
    assert_eq!(
        (found.items.len(), found.remarks.len()),
        (0, 2),
        "{:?}",
        found.remarks
    );
}
