//! `batten references`: the kinds of references with their parameters.

use super::output;
use crate::geometry::references::{KINDS, ReferenceKind};

/// The text about formulas, which have no parameters of their own.
const FORMULA: &str = "formula  Expressions in t with +, -, *, /, ^, pi, e, sin, cos, exp, sqrt and other functions: formula:x=cos(t);y=sin(t)\n  x, y, z   the coordinates; without z the curve is planar\n  from, to  the interval of t; without them 0 to 1\n";

/// List the kinds.
///
/// # Errors
/// If the standard output cannot be written.
pub(super) fn list() -> anyhow::Result<()> {
    let mut text: String = KINDS.iter().map(|kind| lines(kind)).collect();
    text.push_str(FORMULA);
    output::print(&text)
}

/// A kind: its help, and a line for each parameter with its default and limits.
fn lines(kind: &ReferenceKind) -> String {
    let mut rows: Vec<(String, String)> = Vec::new();
    for (parameter, default) in kind.parameters.iter().zip(kind.defaults()) {
        let assignment = format!("{}={default}", parameter.name);
        let limits = parameter.kind.range_words();
        rows.push((assignment, format!("{}; {limits}", parameter.help)));
    }
    let [from, to] = kind.default_interval();
    let interval = format!("the interval of t; without them {from} to {to}");
    rows.push(("from, to".to_owned(), interval));
    let width = rows.iter().map(|(name, _)| name.chars().count()).max();
    let width = width.unwrap_or_default();
    let rows = rows.into_iter();
    let rows = rows.map(|(name, help)| format!("  {name:width$}  {help}\n"));
    format!("{}  {}\n{}", kind.name, kind.help, rows.collect::<String>())
}
