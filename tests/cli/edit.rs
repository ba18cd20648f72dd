//! `batten edit`: what is refused before a window opens.

use std::fs;

use super::folder::*;

#[test]
fn a_format_that_is_only_read_is_refused() {
    let folder = Folder::new().with("a.gpx", "<gpx/>");
    folder.refused(
        &["edit", "a.gpx"],
        "a.gpx: GPX files can be read but not written: the formats that can be written are .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json",
    );
}

#[test]
fn the_standard_input_is_no_file_to_edit() {
    let folder = Folder::new();
    folder.misused(&["edit", "-"], "cannot be written back");
    folder.misused(&["edit"], "required");
    folder.misused(&["edit", "a.step", "b.step"], "unexpected argument");
}

#[test]
fn a_file_that_is_not_there_or_is_no_curve_is_refused() {
    let folder = Folder::new().with("bad.step", "no step");
    let (code, told) = folder.failed(&["edit", "none.step"]);
    assert!(
        code == 1 && told.starts_with("batten: none.step: "),
        "{told}"
    );
    if cfg!(feature = "gui") {
        let (code, told) = folder.failed(&["edit", "bad.step"]);
        assert!(
            code == 1 && told.starts_with("batten: bad.step: "),
            "{told}"
        );
    }
    fs::create_dir(folder.path("folder.step")).unwrap();
    let (code, told) = folder.failed(&["edit", "folder.step"]);
    assert!(code == 1 && told.contains("folder.step"), "{told}");
}

#[test]
fn a_file_that_may_not_be_written_is_refused() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "arc.step"]);
    let path = folder.path("arc.step");
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let (code, told) = folder.failed(&["edit", "arc.step"]);
    assert!(code == 1 && told.contains("read-only"), "{told}");
    assert_eq!(
        fs::read_dir(folder.path(".")).unwrap().count(),
        1,
        "nothing is left behind"
    );
}
