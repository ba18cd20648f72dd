//! The program: the command line, and the editor if that is what is asked for.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use batten::cli::{self, Request};

/// Keeps the memory of a frame for the next one.
#[cfg(feature = "gui")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    match cli::run(std::env::args_os()) {
        Request::Done(code) => code,
        request => editor(&request),
    }
}

/// The exit code of a window that has not saved the file it was to edit.
#[cfg(feature = "gui")]
const NOT_SAVED: u8 = 3;

#[cfg(feature = "gui")]
fn editor(request: &Request) -> ExitCode {
    let is_saved = match request {
        Request::Done(code) => return *code,
        Request::Editor(files) => batten::ui::run(files).map(|()| true),
        Request::Edit { file, is_alone } => batten::ui::edit(file, *is_alone),
    };
    match is_saved {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(NOT_SAVED),
        Err(error) => {
            eprintln!("batten: {error:#}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(not(feature = "gui"))]
fn editor(_request: &Request) -> ExitCode {
    eprintln!(
        "batten: the editor is not built in: build with the feature “gui”, or see batten --help"
    );
    ExitCode::FAILURE
}
