//! The curves and references of a document, chosen by name or number.

use anyhow::bail;

use crate::document::{CurveId, Document, quoted};
use crate::operations::Inputs;

/// The curves of a document, and the references that an operation can work on, with their names.
pub(super) fn items(document: &Document, inputs: Inputs) -> Vec<(CurveId, &str)> {
    let curves = document.curves().filter(|_| inputs != Inputs::References);
    let curves = curves.map(|(id, curve)| (id, curve.name.as_str()));
    let references = document.references().filter(|(_, reference)| match inputs {
        Inputs::OneOrNone | Inputs::References => true,
        Inputs::Points => reference.points().is_some(),
        _ => false,
    });
    let references = references.map(|(id, reference)| (id, reference.name.as_str()));
    curves.chain(references).collect()
}

/// Find an item by its name or, if none has this name, by its number, counted from 1.
pub(super) fn found(
    items: &[(CurveId, &str)],
    inputs: Inputs,
    name: &str,
) -> anyhow::Result<CurveId> {
    let named = items.iter().filter(|(_, known)| *known == name);
    let named: Vec<CurveId> = named.map(|(id, _)| *id).collect();
    let number = name.parse::<usize>().ok();
    let numbered = number.and_then(|number| items.get(number.checked_sub(1)?));
    let [one, several] = match inputs {
        Inputs::One | Inputs::Two => ["curve", "curves"],
        Inputs::References => ["reference", "references"],
        _ => ["curve or reference", "curves and references"],
    };
    let name = quoted(name);
    match (&named[..], numbered) {
        ([id], _) | ([], Some((id, _))) => Ok(*id),
        ([], None) => bail!("there is no {one} {name}: {}", listed(items)),
        (several_named, _) => {
            let count = several_named.len();
            bail!("there are {count} {several} {name}: give them different names first")
        }
    }
}

/// Find the curve or reference with a name; without one the only curve or, if there is none, the only reference.
/// `option` gives the name.
pub(super) fn only(
    document: &Document,
    name: Option<&str>,
    option: &str,
) -> anyhow::Result<CurveId> {
    let (curves, all) = (items(document, Inputs::One), all(document));
    let offered = if curves.is_empty() { &all } else { &curves };
    match (name, &offered[..]) {
        (Some(name), _) => item(&all, name),
        (None, [(only, _)]) => Ok(*only),
        (None, []) => bail!("there is neither a curve nor a reference"),
        (None, _) => bail!("choose one with {option}: {}", listed(offered)),
    }
}

/// All curves and references of a document, with their names.
pub(super) fn all(document: &Document) -> Vec<(CurveId, &str)> {
    items(document, Inputs::OneOrNone)
}

/// Find a curve or a reference among all by its name or number.
///
/// # Errors
/// As [`found`].
pub(super) fn item(all: &[(CurveId, &str)], name: &str) -> anyhow::Result<CurveId> {
    found(all, Inputs::OneOrNone, name)
}

/// List items in a message.
pub(super) fn listed(items: &[(CurveId, &str)]) -> String {
    let names: Vec<String> = items.iter().map(|(_, name)| quoted(name)).collect();
    match &names[..] {
        [name] => format!("there is {name}"),
        names => format!("there are {}", names.join(", ")),
    }
}
