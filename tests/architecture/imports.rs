//! Which file of the library imports which, and the circles among them.

use std::collections::{BTreeMap, BTreeSet};

use crate::paths::{NamedPath, named_paths};
use crate::source::{Source, code, tokens, without_tests};

/// The files of the library, tests aside, and which imports which.
pub struct Imports {
    files: Vec<File>,
    /// For each file the places of those it imports.
    arrows: Vec<BTreeSet<usize>>,
}

/// A file without its tests.
pub struct File {
    /// Its path below src.
    pub path: String,
    /// How many lines of code it has.
    pub lines: usize,
    module: Vec<String>,
    paths: Vec<NamedPath>,
    words: BTreeSet<String>,
}

impl Imports {
    /// Read which of the sources imports which.
    ///
    /// A name that a module only hands on (`pub use`) is looked up where it is defined.
    pub fn of(sources: &[Source]) -> Self {
        let mut files = Vec::new();
        let mut tests: Vec<Vec<String>> = Vec::new();
        // A program is a crate of its own.
        for source in sources.iter().filter(|source| source.path != "main.rs") {
            let module = source.module();
            let (code, modules) = without_tests(&code(&source.text));
            tests.extend(
                modules
                    .into_iter()
                    .map(|name| [&module[..], &[name]].concat()),
            );
            let tokens = tokens(&code);
            files.push(File {
                path: source.path.clone(),
                lines: code.lines().filter(|line| !line.trim().is_empty()).count(),
                module,
                paths: named_paths(&tokens),
                words: words_outside_imports(&tokens),
            });
        }
        files.retain(|file| !tests.iter().any(|test| file.module.starts_with(test)));
        let arrows = Names::of(&files).arrows(&files);
        Self { files, arrows }
    }

    /// List the files in the order of their paths.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// List the arrows: the path of a file, and that of one which it imports.
    pub fn arrows(&self) -> impl Iterator<Item = (&str, &str)> {
        let path = |place: usize| self.files[place].path.as_str();
        let from = self.arrows.iter().enumerate();
        from.flat_map(move |(from, to)| to.iter().map(move |to| (path(from), path(*to))))
    }

    /// List the circles: all files of each reach all the others of it by their imports.
    pub fn circles(&self) -> BTreeSet<Vec<&str>> {
        let reached: Vec<BTreeSet<usize>> = (0..self.files.len())
            .map(|file| self.reached_from(file))
            .collect();
        let circle = |file: usize| -> Vec<&str> {
            let mutual = reached[file]
                .iter()
                .filter(|other| reached[**other].contains(&file));
            mutual
                .map(|other| self.files[*other].path.as_str())
                .collect()
        };
        let circles = (0..self.files.len()).map(circle);
        circles.filter(|circle| circle.len() > 1).collect()
    }

    fn reached_from(&self, file: usize) -> BTreeSet<usize> {
        let mut reached = BTreeSet::new();
        let mut next = vec![file];
        while let Some(file) = next.pop() {
            next.extend(self.arrows[file].iter().filter(|to| reached.insert(**to)));
        }
        reached
    }
}

/// What the names of all modules mean.
struct Names {
    /// The place of each module's file.
    files: BTreeMap<Vec<String>, usize>,
    /// For each file the path from the root of what it imports, by the name it has there.
    imported: Vec<BTreeMap<String, Vec<String>>>,
}

impl Names {
    fn of(files: &[File]) -> Self {
        let places = files.iter().enumerate();
        let mut names = Self {
            files: places
                .map(|(place, file)| (file.module.clone(), place))
                .collect(),
            imported: vec![BTreeMap::new(); files.len()],
        };
        for (place, file) in files.iter().enumerate() {
            for path in &file.paths {
                if let Some(import) = &path.import
                    && let Some(meant) = names.absolute(place, file, path)
                {
                    names.imported[place].insert(import.name.clone(), meant);
                }
            }
        }
        names
    }

    fn arrows(&self, files: &[File]) -> Vec<BTreeSet<usize>> {
        let arrows = files.iter().enumerate().map(|(place, file)| {
            let used = file.paths.iter().filter(|path| match &path.import {
                Some(import) => !import.is_public || file.words.contains(&import.name),
                None => true,
            });
            let meant = used.filter_map(|path| self.absolute(place, file, path));
            let imported = meant.filter_map(|names| self.file(&names, files.len()));
            imported.filter(|other| *other != place).collect()
        });
        arrows.collect()
    }

    /// The path from the root: its first name is `crate`, `self` or `super`, a module below the
    /// file's own, or something imported. `None` is a name from elsewhere, or a local one.
    fn absolute(&self, place: usize, file: &File, path: &NamedPath) -> Option<Vec<String>> {
        path.absolute(&file.module).or_else(|| {
            let (first, rest) = path.names.split_first()?;
            let below = [&file.module[..], std::slice::from_ref(first)].concat();
            let start = match self.files.contains_key(&below) {
                true => &below,
                false => self.imported[place].get(first)?,
            };
            Some([start, rest].concat())
        })
    }

    /// The file that defines what a path from the root means; `steps` bounds how often it may be
    /// handed on.
    fn file(&self, names: &[String], steps: usize) -> Option<usize> {
        let known = |length: &usize| self.files.contains_key(&names[..*length]);
        let length = (0..=names.len()).rev().find(known)?;
        let place = self.files[&names[..length]];
        let handed_on = names
            .get(length)
            .and_then(|name| self.imported[place].get(name));
        match handed_on {
            Some(start) if steps > 0 => {
                self.file(&[start, &names[length + 1..]].concat(), steps - 1)
            }
            _ => Some(place),
        }
    }
}

fn words_outside_imports(tokens: &[&str]) -> BTreeSet<String> {
    let mut is_import = false;
    let mut words = BTreeSet::new();
    for token in tokens {
        is_import = *token == "use" || (is_import && *token != ";");
        if !is_import {
            words.insert((*token).to_owned());
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circles(files: &[(&str, &str)]) -> Vec<String> {
        let sources: Vec<Source> = files
            .iter()
            .map(|(path, text)| Source {
                path: (*path).to_owned(),
                text: (*text).to_owned(),
            })
            .collect();
        let imports = Imports::of(&sources);
        let circles = imports.circles().into_iter();
        circles.map(|circle| circle.join(" ")).collect()
    }

    #[test]
    fn circles_are_found_through_all_kinds_of_paths() {
        let a = ("a/one.rs", "use super::two::Two;");
        for two in [
            "use crate::a::one::One;",
            "fn f() -> crate::a::One { x }",
            "use super::One;",
            "use super::one; fn f() { one::g() }",
            "use super::{one::{self, One}, three::Three};",
            "use crate::a; fn f() { a::one::g() }",
        ] {
            let root = ("a/mod.rs", "mod one; mod two; pub use one::One;");
            let found = circles(&[root, a, ("a/two.rs", two)]);
            assert_eq!(found, ["a/one.rs a/two.rs"], "{two}");
        }
    }

    #[test]
    fn what_is_handed_on_is_not_used_there() {
        let one = ("a/one.rs", "use super::Shared;");
        let files = |root| [("a/mod.rs", root), one];
        assert_eq!(
            circles(&files("pub use one::One; pub struct Shared;")),
            [""; 0]
        );
        let used = "pub use one::One; pub struct Shared(One);";
        assert_eq!(circles(&files(used)), ["a/mod.rs a/one.rs"]);
    }

    #[test]
    fn tests_and_other_crates_make_no_circles() {
        let two = ("a/two.rs", "use super::one::One; use std::one::One;");
        for one in [
            "#[cfg(test)] mod tests { use super::super::two::Two; }",
            "#[cfg(test)] mod tests;",
            "// use super::two::Two;",
            "pub(in crate::a::two) struct One;",
        ] {
            let tests = ("a/one/tests.rs", "use super::super::two::Two;");
            let found = circles(&[("a/one.rs", one), two, tests]);
            assert_eq!(found, [""; 0], "{one}");
        }
    }
}
