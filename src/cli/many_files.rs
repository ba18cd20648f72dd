//! The many files that go through one operation.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::ends::STANDARD;
use crate::io::{Format, disk, shown_path};

/// The extension of results whose format is not told.
const PROJECT: &str = "batten";

/// Many files that go through one operation.
#[derive(Debug)]
pub(super) struct ManyFiles {
    /// The files to read, each with the file to write.
    pub(super) files: Vec<[PathBuf; 2]>,
    /// The folder of the files to write.
    pub(super) folder: PathBuf,
    /// How many files are worked on at once; `None`: as many as there are cores.
    pub(super) jobs: Option<usize>,
    /// Whether lines hold reports and messages.
    pub(super) full: bool,
}

impl ManyFiles {
    /// Name the file to write for each file to read: its stem in the folder, with the extension of the format.
    ///
    /// # Errors
    /// Two files have one stem, whatever the case of its letters: some systems would take their results for one
    /// file. Or a file has no stem, as the standard input. Or a file to write is one to read.
    pub(super) fn named(
        files: Vec<PathBuf>,
        folder: &Path,
        format: Option<&Format>,
    ) -> Result<Vec<[PathBuf; 2]>, String> {
        let mut known: HashMap<OsString, PathBuf> = HashMap::new();
        let mut named = Vec::new();
        for file in files {
            let stem = file.file_stem().filter(|_| file.as_os_str() != STANDARD);
            let Some(stem) = stem else {
                let shown = shown_path(&file);
                return Err(format!("“{shown}” has no name to write a file under"));
            };
            let mut name = stem.to_owned();
            name.push(".");
            name.push(format.map_or(PROJECT, Format::extension));
            let out = folder.join(name);
            let lower = stem.to_str().map(|stem| stem.to_lowercase().into());
            let key = lower.unwrap_or_else(|| stem.to_owned());
            if let Some(first) = known.insert(key, file.clone()) {
                let [first, second, out] = [&first, &file, &out].map(|path| shown_path(path));
                return Err(format!(
                    "“{first}” and “{second}” would both be written to “{out}”: rename one of them, or use another folder for it"
                ));
            }
            named.push([file, out]);
        }
        match replaced(&named) {
            Some([out, file]) => Err(format!(
                "“{}” would replace the input “{}”: use another folder",
                shown_path(out),
                shown_path(file)
            )),
            None => Ok(named),
        }
    }
}

/// Find a file to write that is one of those to read, with the name by which that is given.
fn replaced(named: &[[PathBuf; 2]]) -> Option<[&Path; 2]> {
    let inputs = named.iter().filter_map(|[file, _]| {
        let canonical = disk::canonical(file)?;
        Some((canonical, file.as_path()))
    });
    let inputs: HashMap<PathBuf, &Path> = inputs.collect();
    named.iter().find_map(|[_, out]| {
        let file = inputs.get(&disk::canonical(out)?)?;
        Some([out.as_path(), *file])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_named_by_stems_that_differ_in_any_case() {
        let named = |files: &[&str]| {
            let files = files.iter().map(PathBuf::from).collect();
            ManyFiles::named(files, Path::new("out"), None)
        };
        let names = named(&["a/b.c.dat", "b.dat", "c", "-.csv"]).expect("different stems");
        let outs = names.iter().map(|[_, out]| out.display().to_string());
        let outs: Vec<String> = outs.collect();
        assert_eq!(
            outs,
            [
                "out/b.c.batten",
                "out/b.batten",
                "out/c.batten",
                "out/-.batten"
            ]
        );
        for (files, expected) in [
            (
                &["a/x.dat", "y.dat", "b/x.csv"],
                "“a/x.dat” and “b/x.csv” would both be written to “out/x.batten”",
            ),
            (
                &["Ü.dat", "y.dat", "ü.dat"],
                "“Ü.dat” and “ü.dat” would both be written to “out/ü.batten”",
            ),
            (&["a", "-", "b"], "“-” has no name to write a file under"),
            (&["a", "..", "b"], "“..” has no name to write a file under"),
        ] {
            let error = named(files).expect_err("refused");
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
