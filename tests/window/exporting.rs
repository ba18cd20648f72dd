//! The export panel.

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

use super::hand::*;

#[test]
fn losses_are_shown_before_anything_is_written() {
    let mut window = open_window_of(1000.0, 700.0);
    choose(&mut window, &["File", "Examples", "Waterline"]);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.get_by_label_contains("1 curve, ");
    click(&mut window, "Program");
    click(&mut window, "Inkscape");
    window.get_by_label_contains("cubic Béziers, up to ");
    click(&mut window, "Program");
    click(&mut window, "LibreCAD");
    window.get_by_label_contains(" becomes 3, ");
    click(&mut window, "Highest degree");
    click(&mut window, "as it is");
    window.get_by_label_contains("LibreCAD reads degrees up to 3");
    assert!(
        window
            .get_by_label("Export…")
            .accesskit_node()
            .is_disabled()
    );
    click(&mut window, "Program");
    click(&mut window, "FreeCAD");
    click(&mut window, "Export…");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("hull.step");
    answer(&mut window, &path);
    let text = std::fs::read_to_string(&path).expect("the export");
    assert!(text.contains("B_SPLINE_CURVE"));
    // The next export of the document begins with the same choice.
    press(&mut window, Modifiers::COMMAND, Key::E);
    let program = window.get_by_label("Program").value();
    assert_eq!(program.as_deref(), Some("FreeCAD"));
    click(&mut window, "Cancel");
    choose(&mut window, &["File", "Examples", "Waterline"]);
    press(&mut window, Modifiers::COMMAND, Key::E);
    let program = window.get_by_label("Program").value();
    assert_eq!(program.as_deref(), Some("any"));
}
