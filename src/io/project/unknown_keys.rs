//! Keys that are not known: what is told of them, and that they are kept.

use super::*;
use crate::io::{DXF, TABLE};

/// A project with keys that are not known, of all kinds, as another program lays it out.
const WITH_EXTRAS: &str = r#"{"autor": "Ä \u00df", "format": "batten", "id": 123456789012345678901234567890,
 "version": 1, "curves": [
  {"name": "arc", "weigths": [1.50, 2e0], "degree": 1, "vertices": [[0, 0], [1, 1]],
   "more": {"b": 1e999, "a": null}}, {"name": "hull", "degree": 1, "vertices": [[0, 0], [1, 1]]},
  {"name": "keel", "degree": 1, "vertices": [[0, 0], [1, 1]], "weigths": null, "weigths": 7}
 ]}"#;

#[test]
fn unknown_keys_are_named() {
    let remarks = read(WITH_EXTRAS.as_bytes()).unwrap().remarks.to_string();
    assert_eq!(
        remarks,
        "the project's key “autor” is not known and has no effect\n\
         the project's key “id” is not known and has no effect\n\
         the key “weigths” of 2 curves is not known and has no effect; the first is curve 1 “arc”\n\
         curve 1 “arc”: the key “more” is not known and has no effect"
    );
}

#[test]
fn many_unknown_keys_do_not_fill_the_screen() {
    let keys: Vec<String> = (0..30).map(|i| format!("\"key {i}\": 0")).collect();
    let text = format!(
        "{{\"format\":\"batten\",\"version\":1,{},\"curves\":[]}}",
        keys.join(",")
    );
    let remarks = read(text.as_bytes()).unwrap().remarks.to_string();
    assert_eq!(remarks.lines().count(), 9);
    assert_eq!(
        remarks.lines().last(),
        Some("22 other keys are not known either")
    );
}

#[test]
fn unknown_keys_are_written_again_to_the_letter() {
    let reading = read(WITH_EXTRAS.as_bytes()).unwrap();
    let document = reading.clone().into_document().unwrap();
    let written = PROJECT.write(&document, None).unwrap();
    assert!(written.losses.is_empty(), "{}", written.losses);
    let text = String::from_utf8(written.bytes).unwrap();
    for part in [
        r#""autor": "Ä \u00df""#,
        r#""id": 123456789012345678901234567890"#,
        r#""weigths": [1.50, 2e0]"#,
        r#""more": {"b": 1e999, "a": null}"#,
        "\"weigths\": null,\n      \"weigths\": 7\n",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert_eq!(read(text.as_bytes()).unwrap(), reading);
    for (format, expected) in [(&TABLE, "CSV table"), (&DXF, "DXF")] {
        let written = format.write(&document, None);
        let losses = written.unwrap().losses.to_string();
        let expected = format!(
            "“arc” and “keel”: unknown keys aren't stored in the {expected}\n\
             the project's unknown keys aren't stored in the {expected}"
        );
        assert_eq!(losses, expected);
    }
}

#[test]
fn unknown_keys_of_targets_are_named_as_lost() {
    let text = r#"{"format":"batten","version":1,"curves":[{"name":"a","degree":1,
        "vertices":[[0,0],[1,1]],"targets":{"strat":1,"end":{"point":[1,2],"dir":[1,0]}}}]}"#;
    let reading = read(text.as_bytes()).unwrap();
    assert_eq!(
        reading.remarks.to_string(),
        "curve 1 “a”: the key “strat” of its targets is not known, has no effect and is not kept\n\
         curve 1 “a”: the key “dir” of its targets is not known, has no effect and is not kept"
    );
    assert!(reading.curves[0].targets.finish.is_some());
}
