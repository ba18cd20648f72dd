//! What can be written on the command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};

use crate::geometry::PolygonKind;
use crate::io::examples::{EXAMPLES, Example};

/// Shape fair curves by their float S-polygons.
#[derive(Debug, Parser)]
#[command(name = "batten", version, args_conflicts_with_subcommands = true)]
#[command(
    after_help = "Formats are told by their extensions: .batten and .csv are read and written, .dxf is written.\nExit codes: 0 done; 1 bad input, with a message that names file and place; 2 bad usage."
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Option<Command>,

    /// Files to open in the editor; without any, the built-in arc
    #[arg(value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Write a built-in example to a file
    Example {
        /// The example's name
        #[arg(value_parser = example_parser(), required_unless_present = "list")]
        name: Option<Example>,
        /// The file to write; its extension tells the format
        #[arg(required_unless_present = "list")]
        out: Option<PathBuf>,
        /// List the examples instead
        #[arg(long, conflicts_with_all = ["name", "out"])]
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
    Convert {
        /// The file to read; its extension tells the format
        #[arg(value_name = "IN")]
        input: PathBuf,
        /// The file to write; its extension tells the format
        #[arg(value_name = "OUT")]
        out: PathBuf,
        /// The polygon to write
        ///
        /// .batten and .csv: the polygon that holds each curve (without the option: float). A
        /// periodic curve held by its clamped or Bézier polygon becomes an open one, and high
        /// degrees lose digits on the way back to the float polygon; both are listed on stderr.
        /// .dxf: the one polygon drawn beside each curve (without the option: float and
        /// clamped); the curve itself is always a spline on clamped knots.
        #[arg(long, value_parser = polygon_parser())]
        polygon: Option<PolygonKind>,
    },
    /// Print the curves of a file as JSON, with full double precision
    Inspect {
        /// The file to read; its extension tells the format
        file: PathBuf,
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

fn example_parser() -> impl TypedValueParser<Value = Example> {
    let names = PossibleValuesParser::new(EXAMPLES.map(|example| example.name));
    names.try_map(|name| Example::find(&name).ok_or("no such example"))
}

fn polygon_parser() -> impl TypedValueParser<Value = PolygonKind> {
    let names = PossibleValuesParser::new(PolygonKind::ALL.map(PolygonKind::name));
    names.try_map(|name| PolygonKind::from_name(&name).ok_or("no such polygon"))
}

fn parameter(text: &str) -> Result<f64, String> {
    let value: Result<f64, _> = text.trim().parse();
    value
        .ok()
        .filter(|value| value.is_finite())
        .ok_or_else(|| "a finite number is needed".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_definition_holds_together() {
        super::Arguments::command().debug_assert();
    }
}
