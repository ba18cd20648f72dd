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
fn editor(files: Vec<PathBuf>) -> ExitCode {
    match batten::ui::run(&files) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("batten: {error:#}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(not(feature = "gui"))]
fn editor(_files: Vec<PathBuf>) -> ExitCode {
    eprintln!(
        "batten: the editor is not built in: build with the feature “gui”, or see batten --help"
    );
    ExitCode::FAILURE
}
