//! The program: the command line, and the editor if that is what is asked for.
#![forbid(unsafe_code)]

use std::path::PathBuf;
use std::process::ExitCode;

use batten::cli::{self, Request};

fn main() -> ExitCode {
    match cli::run(std::env::args_os()) {
        Request::Done(code) => code,
        Request::Editor(files) => editor(files),
    }
}

#[cfg(feature = "gui")]
fn editor(_files: Vec<PathBuf>) -> ExitCode {
    // The editor's place: ui::run(files).
    eprintln!("batten: the editor is not there yet; see batten --help for what is");
    ExitCode::FAILURE
}

#[cfg(not(feature = "gui"))]
fn editor(_files: Vec<PathBuf>) -> ExitCode {
    eprintln!(
        "batten: the editor is not built in: build with the feature “gui”, or see batten --help"
    );
    ExitCode::FAILURE
}
