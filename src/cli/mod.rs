//! The command line: the library from a shell. It reads files, calls the library and prints; it
//! holds no logic of its own.

mod apply;
mod apply_arguments;
mod arguments;
mod batch;
mod choice_parser;
mod compare;
mod convert;
mod edit;
mod ends;
mod export_arguments;
mod feature_lists;
mod inspect;
mod inspected_reference;
mod items;
mod list;
mod many_files;
mod output;
mod parsers;
mod points;
mod progress;
mod references;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use crate::geometry::paper::CircleComparison;
use crate::io::examples::{EXAMPLES, Example};
use arguments::{Arguments, Task};

/// The request of the command line.
#[derive(Debug)]
pub enum Request {
    /// To open the editor with these files; with the first example if there are none.
    Editor(Vec<PathBuf>),
    /// To open the editor with a file that is saved back in its own format.
    Edit {
        /// The file.
        file: PathBuf,
        /// Whether it holds nothing but curves.
        is_alone: bool,
    },
    /// Nothing more: it is done, and this is the exit code.
    Done(ExitCode),
}

/// Run the command line: `arguments` begin with the program's name.
///
/// The exit code is 0, or 1 with a message that names file and place, or 2 with the usage if
/// the arguments are not understood. A reader of the output that goes away early is no error.
pub fn run(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Request {
    let result = match Arguments::try_parse_from(arguments).and_then(Arguments::checked) {
        Ok(Task::Editor(files)) => return Request::Editor(files),
        Ok(Task::Edit { file, is_alone }) => match edit::check(&file) {
            Ok(()) => return Request::Edit { file, is_alone },
            Err(error) => Err(error),
        },
        Ok(Task::Examples) => list_examples(),
        Ok(Task::Example(example, destination)) => convert::example(&example, &destination),
        Ok(Task::Table1 { json }) => table1(json),
        Ok(Task::Convert {
            source,
            destination,
            polygon,
            assumed_unit,
            to_float,
            most_degree,
            tolerance,
            export,
            force,
        }) => convert::convert(
            &source,
            &destination,
            &convert::Conversion {
                polygon,
                assumed_unit,
                to_float,
                most_degree,
                tolerance,
                export,
                force,
            },
        ),
        Ok(Task::Operations) => apply::list(),
        Ok(Task::References) => references::list(),
        Ok(Task::Apply(application)) => {
            return Request::Done(exit_code(apply::run(&application)));
        }
        Ok(Task::ApplyToMany(many, applications)) => {
            return Request::Done(exit_code(batch::run(&many, &applications)));
        }
        Ok(Task::Points {
            source,
            destination,
            density,
            curve,
            option,
        }) => points::run(&source, &destination, density, (curve.as_deref(), option)),
        Ok(Task::Compare { compared, limit }) => {
            return Request::Done(exit_code(compare::run(compared.each_ref(), limit)));
        }
        Ok(Task::List {
            file,
            format,
            listed,
        }) => list::run(&file, format, listed),
        Ok(Task::Inspect { source, at }) => inspect::run(&source, &at),
        Err(error) => {
            if error.use_stderr() {
                output::usage(&error.render().to_string());
            } else {
                // Help goes to a reader that may go away; there is nobody else to tell.
                let _ = error.print();
            }
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            return Request::Done(ExitCode::from(code));
        }
    };
    Request::Done(exit_code(result.map(|()| ExitCode::SUCCESS)))
}

/// The exit code of a command; an error is printed.
fn exit_code(result: anyhow::Result<ExitCode>) -> ExitCode {
    result.unwrap_or_else(|error| {
        output::message(&format!("{error:#}"));
        ExitCode::FAILURE
    })
}

fn list_examples() -> anyhow::Result<()> {
    let width = EXAMPLES.iter().map(|example| example.name.len());
    let width = width.max().unwrap_or_default();
    let lines = EXAMPLES.map(
        |Example {
             name,
             title,
             description,
             ..
         }| { format!("{name:width$}  {title}. {description}\n") },
    );
    output::print(&lines.concat())
}

fn table1(json: bool) -> anyhow::Result<()> {
    let rows = CircleComparison::paper_table()?;
    if json {
        let rows = rows.iter().map(|row| {
            serde_json::json!({
                "degree": row.degree,
                "bspline": row.bspline,
                "bezier": row.bezier,
            })
        });
        return output::print_json(&rows.collect::<Vec<_>>());
    }
    let mut text =
        "Largest distance of the evolute from the circle's centre, radius 10\n".to_owned();
    text.push_str("degree         B-spline           Bézier\n");
    for row in rows {
        let CircleComparison {
            degree,
            bspline,
            bezier,
        } = row;
        text.push_str(&format!("{degree:>6} {bspline:>16.9e} {bezier:>16.9e}\n"));
    }
    output::print(&text)
}
