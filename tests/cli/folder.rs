//! A folder to run the program in, and what tests read of its output.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command as Process, Output};

use assert_cmd::cargo::cargo_bin;
use serde_json::{Value, json};
use tempfile::TempDir;

/// A folder of its own to run the program in.
pub struct Folder(pub TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn with(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        fs::write(self.path(name), content).unwrap();
        self
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        let mut process = Process::new(cargo_bin!("batten"));
        process.args(arguments).current_dir(self.0.path());
        process.output().unwrap()
    }

    /// Run and expect success; returns what is printed, and what is printed as error.
    pub fn done(&self, arguments: &[&str]) -> (String, String) {
        let output = self.run(arguments);
        let (out, err) = texts(&output);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {err}");
        (out, err)
    }

    /// Run and expect the one line of an error message.
    pub fn refused(&self, arguments: &[&str], expected: &str) {
        let output = self.run(arguments);
        let (out, err) = texts(&output);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {err}");
        assert_eq!(err, format!("batten: {expected}\n"));
        assert_eq!(out, "");
    }

    /// Run and return the exit code and what is printed as error.
    pub fn failed(&self, arguments: &[&str]) -> (i32, String) {
        let output = self.run(arguments);
        (output.status.code().unwrap_or(-1), texts(&output).1)
    }

    /// Run and expect that the usage is not understood.
    pub fn misused(&self, arguments: &[&str], expected: &str) {
        let output = self.run(arguments);
        let (_, err) = texts(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    }

    pub fn inspect(&self, arguments: &[&str]) -> Value {
        let arguments = [&["inspect"], arguments].concat();
        serde_json::from_str(&self.done(&arguments).0).unwrap()
    }
}

/// What is printed, and what is printed as error but for lines that tell how far a computation has come: they
/// appear where it takes longer than a second, as it may under load.
pub fn texts(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let is_progress = |line: &&str| {
        let told = line.strip_prefix("batten: ");
        told.is_some_and(|told| told.starts_with("proving features: ") || told.ends_with(" %\n"))
    };
    let errors = text(&output.stderr);
    let errors = errors
        .split_inclusive('\n')
        .filter(|line| !is_progress(line));
    (text(&output.stdout), errors.collect())
}

pub fn data(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

pub fn project(curves: Value) -> String {
    json!({"format": "batten", "version": 1, "curves": curves}).to_string()
}

pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        value => vec![
            value
                .as_f64()
                .unwrap_or_else(|| panic!("{value} is no number")),
        ],
    }
}

/// Compare two nests of numbers of the same shape, relative to the largest number expected.
pub fn check_near(found: &Value, expected: &Value, tolerance: f64, what: &str) {
    if expected.is_null() {
        assert!(found.is_null(), "{what}: {found} is not null");
        return;
    }
    let (found, expected) = (numbers(found), numbers(expected));
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected
        .iter()
        .fold(1e-9, |scale: f64, value| scale.max(value.abs()));
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() <= tolerance * scale, "{what}: {a} is not {b}");
    }
}
