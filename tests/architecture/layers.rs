//! Which layer looks at which, and how large they are.

use std::collections::BTreeSet;

use crate::imports::Imports;
use crate::paths::named_paths;
use crate::source::{Source, code, tokens};
use crate::{LAYERS, MAIN, check, check_all};

fn layer(path: &str) -> Option<(&'static str, &'static [&'static str])> {
    let folder = path.split(['/', '.']).next()?;
    let mut layers = LAYERS.iter();
    layers.find(|(name, _)| *name == folder).copied()
}

/// Whether a module at the top of the library is a layer; macros and constants are not.
fn is_layer(name: &str) -> bool {
    LAYERS.iter().any(|(layer, _)| *layer == name)
}

fn check_arrows(source: &Source) -> Vec<String> {
    let named = modules_named(source);
    let (this, allowed) = match source.path.as_str() {
        "main.rs" => ("main.rs", MAIN),
        "lib.rs" => return Vec::new(),
        path => match layer(path) {
            Some(layer) => layer,
            None => return vec![format!("src/{path} belongs to no layer of the table")],
        },
    };
    let wrong = named.iter().filter(|name| {
        is_layer(name) && name.as_str() != this && !allowed.contains(&name.as_str())
    });
    wrong
        .map(|name| {
            format!(
                "src/{} names {name}, but {this} may only look at {allowed:?}",
                source.path
            )
        })
        .collect()
}

/// List the modules at the top of the library that a file names, wherever it does.
fn modules_named(source: &Source) -> BTreeSet<String> {
    let code = code(&source.text);
    let paths = named_paths(&tokens(&code));
    let module = source.module();
    let absolute = paths.iter().filter_map(|path| path.absolute(&module));
    absolute
        .filter_map(|names| names.into_iter().next())
        .collect()
}

#[test]
fn no_layer_looks_the_wrong_way() {
    check_all(&Source::all(), check_arrows);
}

/// `cargo test --test architecture -- --nocapture` shows the table.
#[test]
fn lines_and_arrows_are_counted_by_layer() {
    let imports = Imports::of(&Source::all());
    println!(
        "{:12} {:>5} {:>6} {:>6} {:>7}",
        "layer", "files", "lines", "inside", "outward"
    );
    let mut lines_in_all = 0;
    for (name, allowed) in LAYERS {
        let is_of = |path: &str, name: &str| path.split(['/', '.']).next() == Some(name);
        let files: Vec<_> = imports
            .files()
            .iter()
            .filter(|file| is_of(&file.path, name))
            .collect();
        let lines: usize = files.iter().map(|file| file.lines).sum();
        let arrows = || imports.arrows().filter(|(from, _)| is_of(from, name));
        let inside = arrows().filter(|(_, to)| is_of(to, name)).count();
        let outward = arrows().count() - inside;
        println!(
            "{name:12} {:5} {lines:6} {inside:6} {outward:7}",
            files.len()
        );
        let allowed = |to: &str| allowed.iter().any(|layer| is_of(to, layer));
        assert!(
            arrows().all(|(_, to)| is_of(to, name) || allowed(to)),
            "{name}"
        );
        lines_in_all += lines;
    }
    println!("{:12} {:>5} {lines_in_all:6}", "all", imports.files().len());
}

#[test]
fn an_arrow_against_the_table_is_caught() {
    let wrong = ["src/geometry/jet.rs names document, but geometry may only look at []"];
    for text in [
        "use crate::document::Curve;",
        "pub use crate::document;",
        "use crate::{geometry::{End, document}, document::Curve};",
        "use crate::{\n    geometry,\n    document,\n};",
        "fn f() -> crate::document::Curve { x }",
        "use super::super::document::Curve;",
        "fn f() { super::super::document::cut(x) }",
        "mod inner { use super::super::super::document::Curve; }",
        "#[cfg(test)] mod tests { use crate :: document::Curve; }",
        "/* \" */ use crate::document::Curve; // \"",
        "const QUOTE: char = '\"'; use crate::document::Curve; const S: &str = \"\";",
    ] {
        check(check_arrows, "geometry/jet.rs", text, &wrong);
    }
    let siblings =
        ["src/io/dxf.rs names analysis, but io may only look at [\"document\", \"geometry\"]"];
    check(
        check_arrows,
        "io/dxf.rs",
        "use crate::analysis::Comb;",
        &siblings,
    );
    let main = ["src/main.rs names editor, but main.rs may only look at [\"cli\", \"ui\"]"];
    check(
        check_arrows,
        "main.rs",
        "use batten::editor::Editor;",
        &main,
    );
    let stray = ["src/helpers.rs belongs to no layer of the table"];
    check(check_arrows, "helpers.rs", "", &stray);
}

#[test]
fn what_the_table_allows_is_let_through() {
    for (path, text) in [
        (
            "geometry/jet.rs",
            "use crate::geometry::End; use super::vector;",
        ),
        ("geometry/jet.rs", "use crate::{geometry::{io, ui}};"),
        (
            "geometry/jet.rs",
            "// see crate::document\nconst S: &str = \"crate::io::\\\"x\";",
        ),
        (
            "geometry/jet.rs",
            "const S: &str = r#\"use crate::io; \"\"#;",
        ),
        ("geometry/levels/mod.rs", "use super::super::geometry::End;"),
        ("geometry/jet.rs", "pub(in crate::document) fn f() {}"),
        ("document/edit.rs", "use crate::geometry::FloatPolygon;"),
        ("ui/canvas.rs", "use crate::{editor::Tool, geometry::End};"),
        ("cli.rs", "use crate::io::project;"),
        (
            "main.rs",
            "fn main() { batten::cli::run(); batten::ui::run(); }",
        ),
        ("lib.rs", "pub use crate::ui::run;"),
    ] {
        check(check_arrows, path, text, &[]);
    }
}
