//! The order of the folders inside `geometry` and inside `editor`.

use std::collections::BTreeSet;

use crate::assert_no_complaints;
use crate::imports::Imports;
use crate::source::Source;

/// A layer whose folders have an order: each folder may import those before it.
struct Layer {
    name: &'static str,
    /// The folders in their order. `BASE` stands for the files that lie in the layer itself.
    folders: &'static [&'static str],
    /// Imports against the order that still exist: a file, and the folder that it imports.
    exceptions: &'static [(&'static str, &'static str)],
}

const BASE: &str = "base";

/// The folder that the editor's `mod.rs` counts as: commands are methods of the `Editor` that it
/// defines.
const COMMANDS: &str = "commands";

/// The order, as ARCHITECTURE.md tells it.
const ORDERED: [Layer; 2] = [
    Layer {
        name: "geometry",
        folders: &[
            BASE,
            "conversion",
            "features",
            "cubics",
            "harmony",
            "distance",
            "fitting",
            "fairing",
            "rebuilding",
            "approximation",
            "parameters",
            "expressions",
            "references",
            "between",
            "mineur_farin",
            "vertex_moves",
            "paper",
        ],
        exceptions: &[],
    },
    Layer {
        name: "editor",
        folders: &[
            BASE,
            "jobs",
            "view",
            "hand",
            "operating",
            COMMANDS,
            "dispatch",
        ],
        exceptions: &[],
    },
];

impl Layer {
    /// The folder of a file, and the file's path below the layer.
    fn folder<'a>(&self, path: &'a str) -> Option<(&'a str, &'a str)> {
        let below = path.strip_prefix(self.name)?.strip_prefix('/')?;
        let folder = match below.split_once('/') {
            Some((folder, _)) => folder,
            None if below == "mod.rs" && self.folders.contains(&COMMANDS) => COMMANDS,
            None => BASE,
        };
        Some((folder, below))
    }

    fn place(&self, folder: &str) -> Option<usize> {
        self.folders.iter().position(|name| *name == folder)
    }

    /// List the imports against the order: each once, as a file and the folder that it imports.
    fn wrong<'a>(
        &self,
        arrows: impl Iterator<Item = (&'a str, &'a str)>,
    ) -> BTreeSet<(&'a str, &'a str)> {
        let wrong = arrows.filter_map(|(from, to)| {
            let ((from, file), (to, _)) = (self.folder(from)?, self.folder(to)?);
            let allowed = from == to || self.place(to)? < self.place(from)?;
            (!allowed).then_some((file, to))
        });
        wrong.collect()
    }

    fn complaints(&self, sources: &[Source]) -> Vec<String> {
        let (layer, imports) = (self.name, Imports::of(sources));
        let paths = imports.files().iter().map(|file| file.path.as_str());
        let folders: BTreeSet<&str> = paths
            .filter_map(|path| Some(self.folder(path)?.0))
            .collect();
        let unknown = folders.iter().filter(|name| self.place(name).is_none());
        let mut complaints: Vec<String> = unknown
            .map(|name| {
                format!(
                    "src/{layer}/{name} has no place in ORDERED of tests/architecture/folders.rs"
                )
            })
            .collect();
        let wrong = self.wrong(imports.arrows());
        for (file, folder) in wrong.iter().filter(|one| !self.exceptions.contains(one)) {
            complaints.push(format!(
                "src/{layer}/{file} imports {folder}, which comes later in ORDERED of \
                 tests/architecture/folders.rs: move the file to {folder} or a later folder, move what \
                 both need to an earlier one, or pass it as an argument"
            ));
        }
        for (file, folder) in self.exceptions.iter().filter(|one| !wrong.contains(one)) {
            complaints.push(format!(
                "src/{layer}/{file} no longer imports {folder}: \
                 remove the line (\"{file}\", \"{folder}\") from the exceptions"
            ));
        }
        complaints
    }
}

#[test]
fn folders_import_only_earlier_ones() {
    let sources = Source::all();
    let layers = ORDERED.iter();
    assert_no_complaints(
        layers
            .flat_map(|layer| layer.complaints(&sources))
            .collect(),
    );
}

#[test]
fn an_import_against_the_order_is_caught() {
    let source = |path: &str, text: &str| Source {
        path: path.to_owned(),
        text: text.to_owned(),
    };
    let sources = [
        source(
            "editor/mod.rs",
            "mod reply; mod view; mod hand; use hand::pen::Pen;",
        ),
        source("editor/reply.rs", "use super::view::comb::Comb;"),
        source("editor/view/mod.rs", "pub mod comb;"),
        source(
            "editor/view/comb.rs",
            "use crate::editor::hand::pen::Pen; pub struct Comb;",
        ),
        source("editor/hand/mod.rs", "pub mod pen;"),
        source(
            "editor/hand/pen.rs",
            "use crate::editor::reply::Reply; pub struct Pen;",
        ),
        source("editor/stray/mod.rs", ""),
    ];
    let layer = Layer {
        name: "editor",
        folders: &[BASE, "view", "hand", COMMANDS],
        exceptions: &[("reply.rs", "view"), ("reply.rs", "hand")],
    };
    let complaints = layer.complaints(&sources);
    let expected = [
        "src/editor/stray has no place",
        "src/editor/view/comb.rs imports hand,",
        "src/editor/reply.rs no longer imports hand:",
    ];
    assert_eq!(complaints.len(), expected.len(), "{complaints:?}");
    for (complaint, expected) in complaints.iter().zip(expected) {
        assert!(complaint.starts_with(expected), "{complaint}");
    }
}
