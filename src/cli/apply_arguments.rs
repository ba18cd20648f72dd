//! The arguments of `batten apply`, made from the descriptions of the operations.

use std::path::{Path, PathBuf};

use clap::builder::ValueParser;
use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};

use super::choice_parser::{Assignments, ChoiceParser, no_such_parameter};
use super::many_files::ManyFiles;
use super::parsers::{columns, format_parser, jobs, unit_parser};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;
use crate::geometry::references::{KINDS, ReferenceCurve};
use crate::io::formats;
use crate::io::{ColumnChoice, Format, shown_path};
use crate::operations::{
    ALL, Choice, Inputs, Kind, Operation, OperationError, Parameter, Value, find,
};

const LIST: &str = "list";
const IN: &str = "IN";
const SECOND: &str = "SECOND";
const OUT: &str = "OUT";
const MORE: &str = "FILE";
const CURVE: &str = "curve";
const WITH: &str = "with";
const FROM_FORMAT: &str = "from-format";
const COLUMNS: &str = "columns";
const WEIGHTS: &str = "weights";
const TO_FORMAT: &str = "to-format";
const ASSUME_UNIT: &str = "assume-unit";
const BEST: &str = "best";
const TEXT: &str = "text";
const OUT_DIR: &str = "out-dir";
const JOBS: &str = "jobs";
const FULL: &str = "full";

/// What `batten apply` is asked for.
#[derive(Debug)]
pub(super) enum ApplyArguments {
    /// To list the operations.
    List,
    /// To apply one.
    Run(Box<Given>),
}

/// An operation with its input.
#[derive(Debug)]
pub(super) struct Given {
    /// The operation.
    pub(super) operation: &'static Operation,
    /// The file to read; `None` if the operation works on nothing.
    pub(super) input: Option<PathBuf>,
    /// The format to read, if it is told.
    pub(super) from_format: Option<&'static Format>,
    /// The columns of points in a table, if they are told.
    pub(super) columns: Option<ColumnChoice>,
    /// The file to write.
    pub(super) out: PathBuf,
    /// The many files to read and to write instead.
    pub(super) many: Option<ManyFiles>,
    /// The format to write, if it is told.
    pub(super) to_format: Option<&'static Format>,
    /// The file that the second of two curves comes from; `None` if from the same.
    pub(super) second: Option<PathBuf>,
    /// The name of the curve that was chosen, and of the second of two.
    pub(super) curves: [Option<String>; 2],
    /// The values of the parameters that are given.
    pub(super) values: Vec<(&'static str, Value)>,
    /// The unit of what states none.
    pub(super) assumed_unit: Option<LengthUnit>,
    /// Whether the best result is written where the request is not reached.
    pub(super) best: bool,
    /// Whether the report is printed as text.
    pub(super) text: bool,
}

impl Args for ApplyArguments {
    fn augment_args(command: Command) -> Command {
        let list = Arg::new(LIST)
            .long(LIST)
            .action(ArgAction::SetTrue)
            .help("List the operations instead");
        command
            .arg(list)
            .args_conflicts_with_subcommands(true)
            .arg_required_else_help(true)
            .subcommand_value_name("OPERATION")
            .subcommand_help_heading("Operations")
            .disable_help_subcommand(true)
            .subcommands(ALL.iter().map(|operation| command_of(operation)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for ApplyArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let chosen = matches.subcommand();
        let chosen = chosen.and_then(|(name, matches)| Some((find(name)?, matches)));
        Ok(match chosen {
            Some((operation, matches)) => {
                let refused = |message: String| Err(misused(operation, &message));
                let given = match Given::new(operation, matches) {
                    Ok(given) => given,
                    Err(message) => return refused(message),
                };
                let twice = given.twice();
                let twice =
                    twice.map(|name| format!("“{name}” is given twice: leave one of them out"));
                match twice.or_else(|| given.misplaced()) {
                    Some(message) => return refused(message),
                    None => Self::Run(Box::new(given)),
                }
            }
            None => Self::List,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Given {
    /// Take the arguments of an operation from its command.
    ///
    /// # Errors
    /// A reference cannot be read, or there are not as many files as the operation takes.
    pub(super) fn new(operation: &'static Operation, matches: &ArgMatches) -> Result<Self, String> {
        let format = |name| matches.try_get_one::<&Format>(name).ok().flatten().copied();
        let name = |name| matches.try_get_one::<String>(name).ok().flatten().cloned();
        let parameters = operation.parameters.iter();
        let values = parameters.flat_map(|parameter| {
            let given = matches.get_one::<Assignments>(parameter.name);
            given.cloned().unwrap_or_default()
        });
        let mut values: Vec<(&'static str, Value)> = values.collect();
        let many = many_files(operation, matches)?;
        let Files {
            mut input,
            second,
            out,
        } = match many {
            Some(_) => Files::default(),
            None => Files::of(operation.inputs, paths(matches))?,
        };
        let columns: Option<ColumnChoice> = matches.try_get_one(COLUMNS).ok().flatten().cloned();
        let columns = match matches.try_get_one::<String>(WEIGHTS).ok().flatten() {
            Some(column) => Some(
                (columns.unwrap_or_default().with_weights(column))
                    .map_err(|problem| format!("--{WEIGHTS}: {problem}"))?,
            ),
            None => columns,
        };
        let text = input.as_deref().and_then(Path::to_str);
        let text = text.filter(|text| operation.inputs == Inputs::OneOrNone && is_reference(text));
        if let Some(text) = text {
            let interval = interval_given(&values);
            let reference = ReferenceCurve::from_text_over(text, interval);
            let reference = reference.map_err(|error| format!("“{text}”: {error}"))?;
            let reference = Box::new(reference);
            let parameters = operation.parameters.iter();
            let takes = |it: &&Parameter| matches!(it.kind, Kind::Reference { .. });
            let value = Value::Reference(Some(reference.clone()));
            values.extend(parameters.filter(takes).map(|it| (it.name, value.clone())));
            input = None;
        }
        Ok(Self {
            operation,
            input,
            second,
            from_format: format(FROM_FORMAT),
            columns,
            out,
            many,
            to_format: format(TO_FORMAT),
            curves: [CURVE, WITH].map(name),
            values,
            assumed_unit: matches.try_get_one(ASSUME_UNIT).ok().flatten().copied(),
            best: matches.get_flag(BEST),
            text: matches.get_flag(TEXT),
        })
    }

    /// The first parameter that has two values, by an argument of its own and with a choice.
    fn twice(&self) -> Option<&'static str> {
        let names = self.values.iter().map(|(name, _)| *name);
        let mut names = names.enumerate();
        let found = names.find(|(index, name)| {
            let before = self.values.iter().take(*index);
            before.map(|(name, _)| *name).any(|known| known == *name)
        });
        found.map(|(_, name)| name)
    }

    /// Refuse a parameter that counts only for a word that is not chosen.
    fn misplaced(&self) -> Option<String> {
        let choices = self.operation.parameters.iter();
        choices
            .filter_map(|parameter| match parameter.kind {
                Kind::Choice { options, default } => Some((parameter.name, options, default)),
                _ => None,
            })
            .find_map(|(name, options, default)| {
                let given = self.values.iter().find_map(|(known, value)| match value {
                    Value::Choice(index) if *known == name => Some(*index),
                    _ => None,
                });
                let chosen = options.get(given.unwrap_or(default))?;
                let mut names = self.values.iter().map(|(name, _)| *name);
                let misplaced = names.find(|name| {
                    let owns = |option: &Choice| option.parameters.contains(name);
                    options.iter().any(owns) && !owns(chosen)
                })?;
                Some(no_such_parameter(chosen.name, misplaced, chosen.parameters))
            })
    }
}

/// The files of a single run.
#[derive(Default)]
struct Files {
    input: Option<PathBuf>,
    second: Option<PathBuf>,
    out: PathBuf,
}

impl Files {
    /// Tell by their number which files are which.
    fn of(inputs: Inputs, paths: Vec<PathBuf>) -> Result<Self, String> {
        let most = match inputs {
            Inputs::None | Inputs::UpToTwo => 1,
            Inputs::One | Inputs::OneOrNone | Inputs::Points | Inputs::References => 2,
            Inputs::Two => 3,
        };
        if let Some(path) = paths.get(most) {
            let hint = match takes_one(inputs) {
                true => ": --out-dir DIR takes many files",
                false => "",
            };
            return Err(format!("unexpected argument “{}”{hint}", shown_path(path)));
        }
        let mut paths = paths.into_iter();
        match (paths.next(), paths.next(), paths.next()) {
            (Some(out), None, _) if most == 1 => Ok(Self {
                out,
                ..Self::default()
            }),
            (input, Some(out), None) => Ok(Self {
                input,
                second: None,
                out,
            }),
            (input, second, Some(out)) => Ok(Self { input, second, out }),
            _ => Err("OUT, the file to write, is required".to_owned()),
        }
    }
}

/// The files as they are typed.
fn paths(matches: &ArgMatches) -> Vec<PathBuf> {
    let names = [IN, SECOND, OUT, MORE].into_iter();
    let typed = names.filter_map(|name| matches.try_get_raw(name).ok().flatten());
    typed.flatten().map(PathBuf::from).collect()
}

/// Take the arguments of many files, if there is a folder for their results.
fn many_files(
    operation: &'static Operation,
    matches: &ArgMatches,
) -> Result<Option<ManyFiles>, String> {
    let Some(folder) = matches.get_one::<PathBuf>(OUT_DIR) else {
        return Ok(None);
    };
    let name = operation.name;
    if !takes_one(operation.inputs) {
        let number = match operation.inputs {
            Inputs::Two => "up to two files",
            _ => "no file",
        };
        return Err(format!(
            "--out-dir is for operations that take one file: {name} takes {number}"
        ));
    }
    let files = paths(matches);
    let is_reference = |path: &&PathBuf| path.to_str().is_some_and(ReferenceCurve::is_text);
    let mut references = files.iter().filter(is_reference);
    if let (Inputs::OneOrNone, Some(path)) = (operation.inputs, references.next()) {
        let shown = shown_path(path);
        return Err(format!("“{shown}” is a reference: --out-dir takes files"));
    }
    let format = matches.get_one::<&Format>(TO_FORMAT).copied();
    Ok(Some(ManyFiles {
        files: ManyFiles::named(files, folder, format)?,
        folder: folder.clone(),
        jobs: matches.get_one(JOBS).copied(),
        full: matches.get_flag(FULL),
    }))
}

/// Whether an operation takes just one file, so that many can go through it.
fn takes_one(inputs: Inputs) -> bool {
    matches!(
        inputs,
        Inputs::One | Inputs::OneOrNone | Inputs::Points | Inputs::References
    )
}

/// The usage of an operation: the files that it takes.
fn usage(operation: &Operation) -> String {
    let files = match operation.inputs {
        Inputs::None | Inputs::UpToTwo => "<OUT>",
        Inputs::One | Inputs::Points | Inputs::References => "<IN> <OUT>",
        Inputs::OneOrNone => "<REFERENCE|IN> <OUT>",
        Inputs::Two => "<IN> [SECOND] <OUT>",
    };
    let start = format!("batten apply {} [OPTIONS]", operation.name);
    match takes_one(operation.inputs) {
        true => format!("{start} {files}\n       {start} --out-dir <DIR> <FILE>..."),
        false => format!("{start} {files}"),
    }
}

/// The error of an operation's arguments, with its usage.
pub(super) fn misused(operation: &'static Operation, message: &str) -> Error {
    let command = command_of(operation).bin_name(format!("batten apply {}", operation.name));
    command.clone().error(ErrorKind::ValueValidation, message)
}

/// Describe an operation as a command.
pub(super) fn command_of(operation: &'static Operation) -> Command {
    let (input, has_curves, has_other) = match operation.inputs {
        // What curves would offer is given by parameters.
        Inputs::None | Inputs::UpToTwo => (None, false, false),
        Inputs::OneOrNone => (Some(REFERENCE_OR_CURVES), true, false),
        Inputs::One => (Some(CURVES), true, false),
        Inputs::Two => (Some(CURVES), true, true),
        Inputs::Points => (Some(POINTS), true, false),
        Inputs::References => (Some(CURVES), true, false),
    };
    let command = Command::new(operation.name).about(operation.help);
    let mut command = command.override_usage(usage(operation));
    if let Some(help) = input {
        let argument = match operation.inputs {
            Inputs::OneOrNone => path_argument(IN, help).value_name("REFERENCE|IN"),
            _ => path_argument(IN, help),
        };
        command = command.arg(argument).arg(format_argument(
            FROM_FORMAT,
            "The format to read, whatever the file's extension; needed for the standard input",
            format_parser(formats::readable()),
        ));
        let choice = option(COLUMNS).value_name("COLUMNS").value_parser(columns);
        command = command.arg(choice.help("The columns of x, y and, in space, z in a table of points, by numbers from 1 or by names"));
        if operation.inputs == Inputs::Points {
            let weights = option(WEIGHTS).value_name("COLUMN");
            command = command.arg(weights.help("The column of a table that tells how much each point counts, by its number or name"));
        }
        let unit = option(ASSUME_UNIT).value_name("UNIT");
        let unit = unit.value_parser(unit_parser());
        command = command.arg(unit.help("The unit of a file that states none"));
    }
    if has_other {
        command = command.arg(path_argument(SECOND, SECOND_FILE).required(false));
    }
    let out = path_argument(
        OUT,
        "The file to write, or - for the standard output, the report going to stderr then; its extension tells the format",
    );
    let out = out.required(false);
    command = command.arg(match has_other {
        // Of two files the last is this one.
        true => out,
        false => out.required_unless_present(OUT_DIR),
    });
    command = command.args(arguments_of_many(operation));
    command = command.arg(format_argument(
        TO_FORMAT,
        "The format to write, whatever the file's extension; needed for the standard output",
        format_parser(formats::writable()),
    ));
    if has_curves {
        let curve = match operation.inputs {
            Inputs::OneOrNone => "The curve or reference; needed where the file has several",
            Inputs::Points => "The curve or list of points; needed where the file has several",
            Inputs::References => "The reference; without it all references",
            _ => "The curve; needed where the file has several",
        };
        command = command.arg(name_argument(CURVE, curve));
    }
    if has_other {
        let other =
            "The second curve; needed where one file has not just two, or the second file several";
        command = command.arg(name_argument(WITH, other));
    }
    let parameters = operation.parameters.iter();
    command = command.args(parameters.map(|it| parameter_argument(it, operation.parameters)));
    if operation.inputs == Inputs::OneOrNone {
        let kinds: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
        command = command.after_help(format!(
            "References: {}, formula. “batten references” lists them with their parameters.",
            kinds.join(", ")
        ));
    }
    let best = Arg::new(BEST).long(BEST).action(ArgAction::SetTrue);
    let text = Arg::new(TEXT).long(TEXT).action(ArgAction::SetTrue);
    command
        .arg(best.help("Write the best found also where what was asked for is not reached; the exit code is 1 then"))
        .arg(text.help("Print the report as text instead of JSON"))
}

/// The arguments of many files; those of an operation that does not take them are only refused.
fn arguments_of_many(operation: &Operation) -> [Arg; 4] {
    let more = path_argument(MORE, "More files to read").required(false);
    let folder = option(OUT_DIR).value_name("DIR").conflicts_with(TEXT);
    let folder = folder.value_parser(value_parser!(PathBuf));
    let number = option(JOBS).value_name("N").value_parser(jobs);
    let full = option(FULL).action(ArgAction::SetTrue);
    let is_hidden = !takes_one(operation.inputs);
    let full = full.help("Add the whole report and the messages to each line of --out-dir");
    [
        more.num_args(0..).hide(true),
        folder.help("Read all the files named, and write DIR/STEM.batten, or --to-format, for each; print a line of JSON for each").hide(is_hidden),
        number.requires(OUT_DIR).help("How many files of --out-dir to work on at once; default: all cores").hide(is_hidden),
        full.requires(OUT_DIR).hide(is_hidden),
    ]
}

/// The interval of a reference that the parameters ask for: only there it needs points.
fn interval_given(values: &[(&'static str, Value)]) -> [Option<f64>; 2] {
    ["from", "to"].map(|name| {
        values.iter().find_map(|(known, value)| match value {
            Value::List(numbers) if *known == name => numbers.first().copied(),
            _ => None,
        })
    })
}

/// Take a text for a reference if it begins with the name of a kind, or with another word that names no
/// file; else it is a path.
fn is_reference(text: &str) -> bool {
    ReferenceCurve::is_text(text) || is_unknown_word(text)
}

/// Whether a text is neither a file nor a name with an extension, but a word that could be a reference
/// misspelled.
fn is_unknown_word(text: &str) -> bool {
    let (word, rest) = text.split_once(':').unwrap_or((text, ""));
    let is_word = word.chars().all(|it| it.is_alphanumeric() || it == '-') && word.len() > 1;
    let is_reference = rest.is_empty() || rest.contains('=');
    is_word && is_reference && !Path::new(text).exists()
}

const REFERENCE_OR_CURVES: &str = "A reference, such as conical-spiral, circle:radius=10 or formula:x=t;y=sin(t), or the file to read, or - for the standard input; its extension tells the format";
const CURVES: &str =
    "The file to read, or - for the standard input; its extension tells the format";
const SECOND_FILE: &str =
    "The file that the second curve comes from; if left out, both come from one file";
const POINTS: &str = "The file with the points, or - for the standard input: a list of points, or the vertices of a curve";

fn path_argument(name: &'static str, help: &'static str) -> Arg {
    let parser = value_parser!(PathBuf);
    Arg::new(name)
        .required(true)
        .value_parser(parser)
        .help(help)
}

fn format_argument(name: &'static str, help: &'static str, parser: impl Into<ValueParser>) -> Arg {
    option(name)
        .value_name("FORMAT")
        .value_parser(parser)
        .help(help)
}

fn name_argument(name: &'static str, help: &'static str) -> Arg {
    option(name).value_name("NAME").help(help)
}

fn parameter_argument(parameter: &'static Parameter, all: &'static [Parameter]) -> Arg {
    let default = format!("default: {}", parameter.default_words());
    let about = match parameter.kind {
        // Their values are listed by themselves.
        Kind::Choice { .. } => default,
        _ => format!("{}; {default}", parameter.range_words()),
    };
    let read = |text: &str| {
        let value = parameter.read_given(text)?;
        Ok::<_, OperationError>(vec![(parameter.name, value)])
    };
    let argument = option(parameter.name)
        .value_name(value_name(parameter))
        .allow_negative_numbers(true)
        .allow_hyphen_values(matches!(parameter.kind, Kind::List { .. }))
        .help(format!("{} [{about}]", parameter.help));
    match parameter.kind {
        Kind::Choice { options, .. } => argument.value_parser(ChoiceParser {
            parameter,
            options,
            all,
        }),
        Kind::Switch { .. } => argument
            .value_parser(read)
            .num_args(0..=1)
            .require_equals(true)
            .default_missing_value("on"),
        Kind::Whole { .. } | Kind::Real { .. } | Kind::List { .. } | Kind::Reference { .. } => {
            argument.value_parser(read)
        }
    }
}

fn value_name(parameter: &Parameter) -> &'static str {
    match (&parameter.kind, parameter.quantity()) {
        (
            Kind::List {
                count,
                whole,
                quantity,
                ..
            },
            _,
        ) => match (*count.end(), *whole, *quantity) {
            (1, true, _) => "COUNT",
            (1, ..) => "X",
            (2, _, Quantity::Parameter) => "U,U",
            (2, ..) => "X,Y",
            (3, ..) => "X,Y[,Z]",
            _ => "I,J,…",
        },
        (Kind::Choice { .. }, _) => "WORD",
        (Kind::Reference { .. }, _) => "REFERENCE",
        (Kind::Switch { .. }, _) => "on|off",
        (_, Quantity::Length) => "LENGTH",
        (_, Quantity::Angle) => "DEGREES",
        (_, Quantity::Parameter) => "U",
        (Kind::Whole(_), _) => "N",
        (Kind::Real(_), _) => "X",
    }
}

fn option(name: &'static str) -> Arg {
    Arg::new(name).long(name)
}
