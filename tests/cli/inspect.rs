//! `batten inspect`.

use serde_json::{Value, json};

use super::folder::*;

#[test]
fn inspect_agrees_with_the_reference_curves() {
    let reference = data("curves.json");
    for (index, curve) in reference["curves"].as_array().unwrap().iter().enumerate() {
        let source = json!([{
            "name": format!("curve {index}"),
            "degree": curve["degree"],
            "polygon": "float",
            "vertices": curve["float"],
            "weights": curve["weights"],
        }]);
        let folder = Folder::new().with("a.batten", project(source));
        let at: Vec<String> = numbers(&curve["u"]).iter().map(f64::to_string).collect();
        let found = folder.inspect(&["a.batten", "--at", &at.join(",")])["curves"][0].clone();
        assert_eq!(found["dimension"], curve["dimension"]);
        assert_eq!(found["float"], curve["float"]);
        assert_eq!(found["weights"], curve["weights"]);
        check_near(&found["clamped"], &curve["closed"], 1e-12, "clamped");
        check_near(
            &found["clamped_weights"],
            &curve["closed_weights"],
            1e-12,
            "clamped weights",
        );
        let expected = curve["at_u"].as_array().unwrap();
        assert_eq!(found["at"].as_array().unwrap().len(), expected.len());
        for (place, (found, expected)) in found["at"]
            .as_array()
            .unwrap()
            .iter()
            .zip(expected)
            .enumerate()
        {
            let what = |key| format!("curve {index}, u {}: {key}", at[place]);
            for key in ["point", "d1", "d2", "d3", "evolute"] {
                check_near(&found[key], &expected[key], 1e-9, &what(key));
            }
            check_near(
                &found["curvature"],
                &expected["curvature"],
                1e-9,
                &what("curvature"),
            );
            if curve["dimension"] == 3 {
                let torsion = &expected["torsion"];
                check_near(&found["torsion"], torsion, 1e-9, &what("torsion"));
            } else {
                assert_eq!(found.get("torsion"), None);
            }
        }
    }
}

#[test]
fn inspect_prints_the_described_shape() {
    let curves = json!([
        {"name": "line", "degree": 1, "vertices": [[0, 0], [0, 4]]},
        {"name": "round", "degree": 2, "periodic": true, "weights": [1, 2, 1, 2],
         "vertices": [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 1]]},
    ]);
    let folder = Folder::new().with("two.batten", project(curves));
    let found = folder.inspect(&["two.batten", "--at", "0.5"]);
    let line = json!({
        "name": "line", "group": "", "degree": 1, "dimension": 2, "periodic": false,
        "float": [[0.0, 0.0], [0.0, 4.0]], "weights": null,
        "clamped": [[0.0, 0.0], [0.0, 4.0]], "clamped_weights": null,
        "domain": [0.0, 1.0], "length": null,
        "ends": {
            "start": {"point": [0.0, 0.0], "tangent": [0.0, 1.0], "curvature": 0.0},
            "end": {"point": [0.0, 4.0], "tangent": [0.0, 1.0], "curvature": 0.0},
        },
        "at": [{
            "u": 0.5, "point": [0.0, 2.0], "d1": [0.0, 4.0], "d2": [0.0, 0.0], "d3": [0.0, 0.0],
            "curvature": [0.0, 0.0, 0.0], "evolute": null,
        }],
        "features": {
            "inflections": [], "curvature_extrema": [], "torsion_zeros": [], "torsion_extrema": [],
            "cusps": [], "undecided": [], "undecided_of": [], "monotone": "proved",
        },
    });
    let mut first = found["curves"][0].clone();
    check_near(&first["length"].take(), &json!(4.0), 1e-13, "length");
    assert_eq!(first, line);
    let round = &found["curves"][1];
    assert_eq!(round["ends"], Value::Null);
    assert_eq!(round["dimension"], 3);
    assert_eq!(round["domain"], json!([0.0, 4.0]));
    let clamped = numbers(&round["clamped"]);
    assert_eq!(
        clamped.len(),
        18,
        "six vertices of the curve run round once"
    );
    assert_eq!(clamped[..3], clamped[15..]);
    assert_eq!(numbers(&round["clamped_weights"]).len(), 6);
    assert_eq!(
        folder.inspect(&["two.batten"])["curves"][0]["at"],
        json!([])
    );
}

#[test]
fn inspect_and_list_tell_groups() {
    let project = json!({"format": "batten", "version": 2,
        "curves": [
            {"name": "keel", "group": "Hull/Keel", "degree": 1, "vertices": [[0, 0], [0, 4]]},
            {"name": "plank", "degree": 1, "vertices": [[0, 0], [0, 4]]}],
        "references": [{"name": "round", "group": "Deck/1\\/2", "kind": "circle"}]});
    let folder = Folder::new().with("a.batten", project.to_string());
    let found = folder.inspect(&["a.batten"]);
    assert_eq!(found["curves"][0]["group"], "Hull/Keel");
    assert_eq!(found["curves"][1]["group"], "");
    assert_eq!(found["references"][0]["group"], "Deck/1\\/2");

    folder.done(&["convert", "a.batten", "a.3dm"]);
    let found = folder.inspect(&["a.3dm"]);
    assert_eq!(found["curves"][0]["group"], "Hull/Keel");
    assert_eq!(found["references"][0]["group"], "Deck/1\\/2");
    let (listed, _) = folder.done(&["list", "a.3dm"]);
    let listed: Value = serde_json::from_str(&listed).unwrap();
    assert_eq!(listed["items"][0]["group"], "Hull/Keel");
    let (_, told) = folder.done(&["convert", "a.batten", "a.csv"]);
    let loss = "“keel”: the group isn't stored in the CSV table";
    assert!(told.contains(loss), "{told}");
}

#[test]
fn what_is_no_number_is_printed_as_null() {
    let point = json!([{"name": "point", "degree": 1, "vertices": [[1, 1], [1, 1]]}]);
    let folder = Folder::new().with("point.batten", project(point));
    let found = folder.inspect(&["point.batten", "--at", "0"])["curves"][0].clone();
    assert_eq!(found["at"][0]["curvature"], json!([null, null, null]));
    assert_eq!(found["at"][0]["evolute"], Value::Null);
    assert_eq!(found["ends"]["start"]["tangent"], Value::Null);
    assert_eq!(found["ends"]["start"]["curvature"], Value::Null);
    assert_eq!(found["length"], 0.0);
}

#[test]
fn extreme_weights_do_not_hold_up_the_program() {
    let curve = json!([{
        "name": "extreme", "degree": 3, "weights": [1e-100, 1e100, 1e-100, 1e100],
        "vertices": [[1e100, 0], [-1e100, 1], [1, 1e100], [1e100, -1e100]],
    }]);
    let folder = Folder::new().with("extreme.batten", project(curve));
    let found = folder.inspect(&["extreme.batten", "--at", "0,0.5,1"]);
    assert_eq!(found["curves"][0]["at"].as_array().unwrap().len(), 3);
}

#[test]
fn inspect_lists_proved_features() {
    let folder = Folder::new();
    let features = |name: &str| {
        let file = format!("{name}.batten");
        folder.done(&["example", name, &file]);
        folder.inspect(&[&file])["curves"][0]["features"].clone()
    };
    // The arc's ripple is a hundred-millionth of its curvature, with one extremum in the middle.
    let arc = features("arc");
    assert_eq!(arc["monotone"], "disproved");
    let extrema = arc["curvature_extrema"].as_array().unwrap();
    assert_eq!(extrema.len(), 1);
    let [low, high] = numbers(&extrema[0]["u"])[..] else {
        panic!("an interval: {}", extrema[0]);
    };
    assert!(
        low <= 0.5 && 0.5 <= high && high - low <= 1e-12,
        "{low} … {high}"
    );
    assert_eq!(extrema[0]["kind"], "max");
    check_near(
        &json!([extrema[0]["curvature"]]),
        &json!([-0.112_130_6]),
        1e-6,
        "curvature",
    );
    assert_eq!(features("figure2")["monotone"], "proved");
    let wave = features("s-curve");
    assert_eq!(wave["inflections"].as_array().unwrap().len(), 1);
    assert_eq!(wave["undecided"], json!([]));
}

#[test]
fn a_possible_cusp_is_told_and_nothing_claimed_there() {
    // Two legs that lie on each other: the curve turns back on a line.
    let back = json!([{"name": "back", "degree": 2, "vertices": [[0, 0], [4, 0], [0, 0]]}]);
    let folder = Folder::new().with("back.batten", project(back));
    let features = folder.inspect(&["back.batten"])["curves"][0]["features"].clone();
    let cusps = features["cusps"].as_array().unwrap();
    assert_eq!(cusps.len(), 1);
    assert_eq!(cusps[0]["proved"], true);
    let [low, high] = numbers(&cusps[0]["u"])[..] else {
        panic!("an interval: {}", cusps[0]);
    };
    assert!(low <= 0.5 && 0.5 <= high, "{low} … {high}");
    assert_eq!(features["curvature_extrema"], json!([]));
    assert_ne!(features["monotone"], "proved");
}

#[test]
fn an_undecided_piece_says_what_it_is_about() {
    // The tangent vanishes in the middle, where the curvature turns.
    let cusp = json!([{
        "name": "cusp", "degree": 3, "vertices": [[0, 0], [-2, 2.25], [-2, 1.5], [0, 3.75]],
    }]);
    let folder = Folder::new().with("cusp.batten", project(cusp));
    let features = folder.inspect(&["cusp.batten"])["curves"][0]["features"].clone();
    assert_eq!(features["undecided"], json!([[0.5, 0.5]]));
    let piece = json!({"u": [0.5, 0.5], "quantity": "curvature_extrema"});
    assert_eq!(features["undecided_of"], json!([piece]));
    assert_eq!(
        features["cusps"],
        json!([{"u": [0.5, 0.5], "proved": true}])
    );
}

#[test]
fn only_certain_digits_of_an_extremum_are_printed() {
    // C′ = (2 s, 3 s² + ε) with s = t − ½: κ = −2 / ε² at ½, of which doubles see no digit.
    let tiny = f64::EPSILON * 2.0;
    let sharp = json!([{
        "name": "sharp", "degree": 3,
        "vertices": [[0, 0], [-2, 2.25 + tiny], [-2, 1.5 + 2.0 * tiny], [0, 3.75 + 3.0 * tiny]],
    }]);
    let folder = Folder::new().with("sharp.batten", project(sharp));
    let found = folder.inspect(&["sharp.batten"]);
    let sharp = &found["curves"][0]["features"]["curvature_extrema"][1];
    let printed = sharp["curvature"].as_f64().unwrap();
    let digits = format!("{printed:e}")
        .split_once('e')
        .unwrap()
        .0
        .trim_start_matches('-')
        .len()
        - 1;
    assert!(digits >= 10, "{printed:e}");
    let expected = -2.0 / (tiny * tiny);
    assert_eq!(
        format!("{expected:.*e}", digits - 1),
        format!("{printed:e}")
    );
}

#[test]
fn no_zero_is_printed_for_a_digit_that_is_not_certain() {
    let vertices = "[[0,0],[1e-14,2e-14],[3e-14,1e-14],[4e-14,4e-14]]";
    let curve = format!(r#"{{"name":"c","degree":3,"polygon":"float","vertices":{vertices}}}"#);
    let project = format!(r#"{{"format":"batten","version":1,"curves":[{curve}]}}"#);
    let folder = Folder::new().with("small.batten", project);
    let (text, _) = folder.done(&["inspect", "small.batten"]);
    let extremum = text.split("\"kind\"").nth(1).expect("an extremum");
    let value = extremum.split("\"curvature\": ").nth(1).expect("a value");
    let value = value.split_whitespace().next().expect("a number");
    // About 1.2e14: without a power of ten it would have fifteen digits before the point.
    let digits = value.strip_suffix("e14").expect("a power of ten");
    assert!(digits.matches(char::is_numeric).count() < 15, "{value}");
}
