//! The arguments of the command line.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{ArgGroup, CommandFactory, Error, Parser, Subcommand};

use super::apply::Application;
use super::apply_arguments::{ApplyArguments, Given};
use super::compare::Compared;
use super::ends::{Destination, STANDARD, Source};
use super::export_arguments::ExportArguments;
use super::list::Listed;
use super::many_files::ManyFiles;
use super::parsers::{
    columns, count, example_parser, format_parser, kind_parser, parameter, polygon_parser,
    spacing_parser, tolerance, unit_parser,
};
use super::points::Density;
use crate::document::quoted;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{PolygonKind, Spacing};
use crate::io::examples::Example;
use crate::io::exchange::drawing::Kind;
use crate::io::exchange::import::ImportFilter;
use crate::io::formats;
use crate::io::{ColumnChoice, Format};

/// How like a command a word must be to be taken for one misspelled, as 0 to 1.
const LEAST_LIKENESS: f64 = 0.7;

/// Shape fair curves by their float S-polygons.
#[derive(Debug, Parser)]
#[command(name = "batten", version, args_conflicts_with_subcommands = true)]
#[command(
    after_help = "Formats are told by their extensions: .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .dxf, .step, .igs, .3dm, .svg, .glif, .obj, .brep and .json are read and written, .gpx is read.\n“-” stands for the standard input and output; --from-format and --to-format tell the format then.\nExit codes: 0 done; 1 bad input, with a message that names file and place, or what was asked for is not reached; 2 bad usage; 3 (edit) the file was not saved."
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,

    /// Files to open in the editor; without any, an S-curve
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Open the editor on a file of any format, which Save writes back in that format
    ///
    /// What the format cannot hold is told before the first save. The exit code is 0 if the file was saved, and 3 if
    /// it was not.
    Edit {
        /// The file to edit; its extension tells the format
        file: PathBuf,
        /// Promise that the file holds nothing but curves: the window then asks only about their own losses
        #[arg(long)]
        alone: bool,
    },
    /// Write a built-in example to a file
    Example {
        /// The example's name
        #[arg(value_parser = example_parser(), required_unless_present = "list")]
        name: Option<Example>,
        /// The file to write, or - for the standard output; its extension tells the format
        #[arg(required_unless_present = "list")]
        out: Option<PathBuf>,
        /// The format to write, whatever the file's extension; needed for the standard output
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::writable()))]
        to_format: Option<&'static Format>,
        /// List the examples instead
        #[arg(long, conflicts_with_all = ["name", "out", "to_format"])]
        list: bool,
    },
    /// Recompute the paper's Table 1: how near B-spline and Bézier segments come to a circle
    #[command(name = "table1")]
    Table1 {
        /// Print JSON: one object a degree, with the keys degree, bspline and bezier
        #[arg(long)]
        json: bool,
    },
    /// Convert a file to another format; what the format cannot hold is listed on stderr
    #[command(group = ArgGroup::new("nearing").args(["degree_at_most", "to_float", "preset"]).multiple(true))]
    Convert {
        /// The file to read, or - for the standard input; its extension tells the format
        #[arg(value_name = "IN")]
        input: PathBuf,
        /// The file to write, or - for the standard output; its extension tells the format
        #[arg(value_name = "OUT")]
        out: PathBuf,
        /// The format to read, whatever the file's extension; needed for the standard input
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::readable()))]
        from_format: Option<&'static Format>,
        /// The columns of x, y and, in space, z in a table of points, by numbers from 1 or by names
        #[arg(long, value_name = "COLUMNS", value_parser = columns)]
        columns: Option<ColumnChoice>,
        /// The format to write, whatever the file's extension; needed for the standard output
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::writable()))]
        to_format: Option<&'static Format>,
        /// The polygon to write
        ///
        /// .batten and .csv: the polygon that holds each curve (without the option: float). A
        /// periodic curve held by its clamped or Bézier polygon becomes an open one, and high
        /// degrees lose digits on the way back to the float polygon; both are listed on stderr.
        /// .dxf: the one polygon drawn beside each curve (without the option: float and
        /// clamped); the curve itself is always a spline on clamped knots.
        #[arg(long, value_parser = polygon_parser())]
        polygon: Option<PolygonKind>,
        /// The unit of a file that states none
        #[arg(long, value_name = "UNIT", value_parser = unit_parser())]
        assume_unit: Option<LengthUnit>,
        /// The highest degree that is written: curves of a higher one are approximated
        ///
        /// How far each of them moves, and the number of its vertices, are told on stderr. Features stay
        /// where that is possible.
        #[arg(long, value_name = "DEGREE", value_parser = clap::value_parser!(u8).range(1..=25))]
        degree_at_most: Option<u8>,
        /// Take of a drawing only this layer, with what is in it; may be given several times
        #[arg(long, value_name = "LAYER")]
        layer: Vec<String>,
        /// Take of a drawing only this kind; may be given several times
        #[arg(long, value_name = "KIND", value_parser = kind_parser())]
        kind: Vec<Kind>,
        /// Take edges of solids and boundaries of surfaces too
        #[arg(long)]
        edges: bool,
        /// Take layouts for printing too
        #[arg(long)]
        paper_space: bool,
        /// Make float polygons of all smooth references, within the tolerance
        ///
        /// The vertices and the deviation of each are told on stderr. One that has none within the tolerance
        /// stays a reference.
        #[arg(long)]
        to_float: bool,
        /// Largest deviation of lower degrees, float polygons and cubic Béziers; default: 1e-4 of the size
        #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = tolerance)]
        tolerance: Option<f64>,
        /// Write so many points on the curve, not its vertices, as `points` does
        #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = count,
            conflicts_with_all = ["polygon", "nearing", "tolerance"])]
        points: Option<usize>,
        /// Write as few points on the curve as keep the polyline through them this near to it
        #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = tolerance,
            conflicts_with_all = ["points", "polygon", "nearing", "tolerance"])]
        chord: Option<f64>,
        #[command(flatten)]
        export: ExportArguments,
        /// Write a polygon even if it cannot be read back as the curve
        #[arg(long)]
        force: bool,
    },
    /// Write points on a curve as a table: a section goes back to the solver that it came from
    ///
    /// The title of the table that the curve was fitted to is kept, and so is the order around a section.
    /// How near to the curve the polyline through the points is, is measured and told on stderr.
    Points {
        /// The file to read, or - for the standard input; its extension tells the format
        #[arg(value_name = "FILE")]
        input: PathBuf,
        /// The file to write, or - for the standard output; its extension tells the format
        #[arg(value_name = "OUT")]
        out: PathBuf,
        /// The format to read, whatever the file's extension; needed for the standard input
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::readable()))]
        from_format: Option<&'static Format>,
        /// The columns of x, y and, in space, z in a table of points, by numbers from 1 or by names
        #[arg(long, value_name = "COLUMNS", value_parser = columns)]
        columns: Option<ColumnChoice>,
        /// The format to write, whatever the file's extension; needed for the standard output
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::writable()))]
        to_format: Option<&'static Format>,
        /// The number of points, both ends of the curve among them
        #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = count)]
        count: Option<usize>,
        /// As few points as keep the polyline through them within this distance of the curve
        #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = tolerance, conflicts_with = "count")]
        tolerance: Option<f64>,
        /// How points are spread (default arc-length); cosine: densely at the ends and the nose of a section
        #[arg(long, value_parser = spacing_parser())]
        spacing: Option<Spacing>,
        /// The curve or reference; needed where the file has several
        #[arg(long, value_name = "NAME")]
        curve: Option<String>,
    },
    /// Print how far two curves or references are from each other, as JSON
    ///
    /// Distances go to the nearest points, from both sides; points count from their side alone. Means are over the
    /// arc length, or over the points.
    Compare {
        /// The file of the first one, or - for the standard input; its extension tells the format
        #[arg(value_name = "A")]
        a: PathBuf,
        /// The file of the second one, which may be the same file
        #[arg(value_name = "B")]
        b: PathBuf,
        /// The curve or reference of A; needed where the file has several
        #[arg(long, value_name = "NAME")]
        curve: Option<String>,
        /// The curve or reference of B; needed where the file has several
        #[arg(long, value_name = "NAME")]
        with: Option<String>,
        /// The largest distance that is allowed: beyond it the exit code is 1, and whiskers are counted
        #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = tolerance)]
        limit: Option<f64>,
        /// The format to read both, whatever the files' extensions
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::readable()))]
        from_format: Option<&'static Format>,
        /// The columns of x, y and, in space, z in tables of points, by numbers from 1 or by names
        #[arg(long, value_name = "COLUMNS", value_parser = columns)]
        columns: Option<ColumnChoice>,
    },
    /// Apply an operation to a curve of a file, or of each of many, and print what it did as JSON
    ///
    /// The file that is written holds everything that was read, with the changes made. Nothing is
    /// written, and the exit status is 1, if what was asked for is not reached. With --out-dir
    /// many files go through the operation, each on its own.
    Apply(ApplyArguments),
    /// List the references that `batten apply approximate` knows, with their parameters
    References,
    /// List what a file of a CAD or drawing program holds, as JSON
    List {
        /// The file to read; its extension tells the format
        file: PathBuf,
        /// The format to read, whatever the file's extension
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::drawn()))]
        from_format: Option<&'static Format>,
        /// List edges of solids and boundaries of surfaces too
        #[arg(long)]
        edges: bool,
        /// List layouts for printing too
        #[arg(long)]
        paper_space: bool,
    },
    /// Print the curves and references of a file as JSON, with full double precision
    Inspect {
        /// The file to read, or - for the standard input; its extension tells the format
        file: PathBuf,
        /// The format to read, whatever the file's extension; needed for the standard input
        #[arg(long, value_name = "FORMAT", value_parser = format_parser(formats::readable()))]
        from_format: Option<&'static Format>,
        /// The columns of x, y and, in space, z in a table of points, by numbers from 1 or by names
        #[arg(long, value_name = "COLUMNS", value_parser = columns)]
        columns: Option<ColumnChoice>,
        /// Parameters at which to evaluate every curve, each from 0 to the number of segments
        #[arg(
            long,
            value_name = "U,U,…",
            value_delimiter = ',',
            allow_negative_numbers = true,
            value_parser = parameter
        )]
        at: Vec<f64>,
    },
}

/// The command.
pub(super) enum Task {
    /// Open the editor with these files.
    Editor(Vec<PathBuf>),
    /// Open the editor to edit a file of another program.
    Edit {
        /// The file.
        file: PathBuf,
        /// Whether it holds nothing but curves.
        is_alone: bool,
    },
    /// List the examples.
    Examples,
    /// Write an example.
    Example(Example, Destination),
    /// Recompute Table 1.
    Table1 {
        /// As JSON.
        json: bool,
    },
    /// Convert a file.
    Convert {
        /// The source.
        source: Source,
        /// The destination.
        destination: Destination,
        /// The polygon to write.
        polygon: Option<PolygonKind>,
        /// The unit of what states none.
        assumed_unit: Option<LengthUnit>,
        /// Whether float polygons are made of references.
        to_float: bool,
        /// The highest degree that is written.
        most_degree: Option<usize>,
        /// The largest deviation of lower degrees, float polygons and cubic Béziers.
        tolerance: Option<f64>,
        /// What is written and how.
        export: ExportArguments,
        /// Whether to write what cannot be read back.
        force: bool,
    },
    /// Write points on a curve.
    Points {
        /// The source.
        source: Source,
        /// The destination.
        destination: Destination,
        /// How many points there are, and where.
        density: Density,
        /// The name of the curve that was chosen.
        curve: Option<String>,
        /// The option that chooses it.
        option: &'static str,
    },
    /// Compare two curves or references.
    Compare {
        /// The two.
        compared: [Compared; 2],
        /// The largest distance that is allowed.
        limit: Option<f64>,
    },
    /// List the operations.
    Operations,
    /// Apply an operation.
    Apply(Application),
    /// Apply an operation to many files, each by its own application.
    ApplyToMany(ManyFiles, Vec<Application>),
    /// List the kinds of references.
    References,
    /// List what a drawing holds.
    List {
        /// The file.
        file: PathBuf,
        /// The format, whatever the file's name says.
        format: Option<&'static Format>,
        /// The items beside the free ones.
        listed: Listed,
    },
    /// Print curves and references in numbers.
    Inspect {
        /// The source.
        source: Source,
        /// The parameters at which curves are evaluated.
        at: Vec<f64>,
    },
}

impl Arguments {
    /// Check the arguments together.
    ///
    /// # Errors
    /// The usage, if a word is neither a command nor a file, or a format is missing.
    pub(super) fn checked(self) -> Result<Task, Error> {
        Ok(match self.command {
            None => Task::Editor(files(self.files)?),
            Some(Command::Edit { file, .. }) if file.as_os_str() == STANDARD => {
                let needed = "a file is needed: the standard input cannot be written back";
                return Err(missing("edit", needed));
            }
            Some(Command::Edit { file, alone }) => Task::Edit {
                file,
                is_alone: alone,
            },
            Some(Command::Example {
                name: Some(example),
                out: Some(out),
                to_format,
                ..
            }) => Task::Example(example, destination("example", out, to_format)?),
            Some(Command::Example { .. }) => Task::Examples,
            Some(Command::Table1 { json }) => Task::Table1 { json },
            Some(Command::Convert {
                input,
                out,
                from_format,
                columns,
                to_format,
                polygon,
                assume_unit,
                degree_at_most,
                layer,
                kind,
                edges,
                paper_space,
                to_float,
                tolerance,
                points,
                chord,
                export,
                force,
            }) => {
                let source = source("convert", input, from_format, columns)?;
                let source = source.choosing(ImportFilter {
                    layers: layer,
                    kinds: kind,
                    edges,
                    paper: paper_space,
                });
                let destination = destination("convert", out, to_format)?;
                let is_near = degree_at_most.is_some() || to_float || export.has_preset();
                if tolerance.is_some() && !is_near && !destination.holds_cubics_alone() {
                    let needed = "--tolerance needs --degree-at-most, --to-float, --preset, or SVG or GLIF as OUT";
                    return Err(missing("convert", needed));
                }
                let density = points.map(|count| Density::Count(count, Spacing::ArcLength));
                match density.or(chord.map(|it| Density::Tolerance(it, None))) {
                    Some(density) => Task::Points {
                        source,
                        destination,
                        density,
                        curve: export.item().map(str::to_owned),
                        option: "--item",
                    },
                    None => Task::Convert {
                        source,
                        destination,
                        polygon,
                        assumed_unit: assume_unit,
                        to_float,
                        most_degree: degree_at_most.map(usize::from),
                        tolerance,
                        export,
                        force,
                    },
                }
            }
            Some(Command::Points {
                input,
                out,
                from_format,
                columns,
                to_format,
                count,
                tolerance,
                spacing,
                curve,
            }) => Task::Points {
                source: source("points", input, from_format, columns)?,
                destination: destination("points", out, to_format)?,
                density: match (tolerance, count) {
                    (Some(tolerance), _) => Density::Tolerance(tolerance, spacing),
                    (None, Some(count)) => Density::Count(count, spacing.unwrap_or_default()),
                    (None, None) => {
                        let needed = "say how many points: --count N, or --tolerance T for as few as keep the polyline that near";
                        return Err(missing("points", needed));
                    }
                },
                curve,
                option: "--curve",
            },
            Some(Command::Compare {
                a,
                b,
                curve,
                with,
                limit,
                from_format,
                columns,
            }) => {
                let compared = |path, name, columns| {
                    let source = source("compare", path, from_format, columns)?;
                    Ok::<_, Error>(Compared { source, name })
                };
                Task::Compare {
                    compared: [
                        compared(a, curve, columns.clone())?,
                        compared(b, with, columns)?,
                    ],
                    limit,
                }
            }
            Some(Command::Apply(ApplyArguments::List)) => Task::Operations,
            Some(Command::Apply(ApplyArguments::Run(mut given))) => match given.many.take() {
                Some(many) => {
                    let applications = many
                        .files
                        .iter()
                        .map(|[file, out]| application(&given, Some(file.clone()), out.clone()));
                    let applications = applications.collect::<Result<_, _>>()?;
                    Task::ApplyToMany(many, applications)
                }
                None => Task::Apply(application(&given, given.input.clone(), given.out.clone())?),
            },
            Some(Command::References) => Task::References,
            Some(Command::List {
                file,
                from_format,
                edges,
                paper_space,
            }) => Task::List {
                file,
                format: from_format,
                listed: Listed {
                    edges,
                    paper: paper_space,
                },
            },
            Some(Command::Inspect {
                file,
                from_format,
                columns,
                at,
            }) => Task::Inspect {
                source: source("inspect", file, from_format, columns)?,
                at,
            },
        })
    }
}

fn source(
    command: &str,
    path: PathBuf,
    format: Option<&'static Format>,
    columns: Option<ColumnChoice>,
) -> Result<Source, Error> {
    let needed = "--from-format says what the standard input holds, and is needed with “-”";
    Source::new(path, format, columns).ok_or_else(|| missing(command, needed))
}

fn destination(
    command: &str,
    path: PathBuf,
    format: Option<&'static Format>,
) -> Result<Destination, Error> {
    let needed = "--to-format says what the standard output gets, and is needed with “-”";
    Destination::new(path, format).ok_or_else(|| missing(command, needed))
}

/// Apply an operation as it is given to one file.
fn application(given: &Given, input: Option<PathBuf>, out: PathBuf) -> Result<Application, Error> {
    let source = |path| source("apply", path, given.from_format, given.columns.clone());
    Ok(Application {
        operation: given.operation,
        source: input.map(source).transpose()?,
        second: given.second.clone().map(source).transpose()?,
        destination: destination("apply", out, given.to_format)?,
        curves: given.curves.clone(),
        values: given.values.clone(),
        assumed_unit: given.assumed_unit,
        best: given.best,
        text: given.text,
    })
}

/// Take files to open, unless the first is a word that can only be a command misspelled.
fn files(files: Vec<PathBuf>) -> Result<Vec<PathBuf>, Error> {
    let Some(word) = files.first().filter(|path| is_bare_word(path)) else {
        return Ok(files);
    };
    let word = word.to_string_lossy();
    let mut text = format!("{} is neither a command nor a file", quoted(&word));
    let mut command = Arguments::command();
    if let Some(similar) = similar_command(&command, &word) {
        text += &format!("\n\n  tip: a command with a similar name is “{similar}”");
    }
    Err(command.error(ErrorKind::InvalidSubcommand, text))
}

/// Whether a path is a single word that names no file: without an extension it could not be
/// opened either.
fn is_bare_word(path: &Path) -> bool {
    path.components().count() == 1 && path.extension().is_none() && !path.exists()
}

fn similar_command(command: &clap::Command, word: &str) -> Option<String> {
    let names = command.get_subcommands().map(clap::Command::get_name);
    let rated = names.map(|name| (strsim::jaro(name, word), name));
    let near = rated.filter(|(likeness, _)| *likeness > LEAST_LIKENESS);
    let best = near.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, name)| name.to_owned())
}

fn missing(subcommand: &str, text: &str) -> Error {
    let mut command = Arguments::command();
    command.build();
    let command = command.find_subcommand_mut(subcommand);
    match command {
        Some(command) => command.error(ErrorKind::MissingRequiredArgument, text),
        None => Arguments::command().error(ErrorKind::MissingRequiredArgument, text),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_definition_holds_together() {
        super::Arguments::command().debug_assert();
    }
}
