//! The names of elements and groups.

use roxmltree::Node;

use super::namespaces::{INKSCAPE, SVG};
use crate::io::exchange::short_names::short;

/// A title is the first child, but for comments and blanks.
const FIRST: usize = 32;

/// The name of an element: Inkscape's label, its title, or its identifier.
pub(super) fn name<'d>(node: Node<'d, 'd>) -> Option<&'d str> {
    let title = || {
        let mut first = node.children().take(FIRST);
        let title = first.find(|it| it.has_tag_name((SVG, "title")))?;
        title.text()
    };
    let label = node.attribute((INKSCAPE, "label"));
    label
        .or_else(title)
        .or_else(|| node.attribute("data-name"))
        .or_else(|| node.attribute("id"))
        .map(str::trim)
        .filter(|it| !it.is_empty())
}

/// The name of a group, if it is more than the number that Inkscape gives to any group.
pub(super) fn group_name(node: Node) -> Option<String> {
    let name = name(node)?;
    let numbered = name
        .strip_prefix('g')
        .is_some_and(|it| it.bytes().all(|it| it.is_ascii_digit() || it == b'-'));
    let is_layer = node.attribute((INKSCAPE, "groupmode")) == Some("layer");
    (is_layer || !numbered).then(|| short(&without_escapes(&short(name))))
}

/// Undo Illustrator's escapes: `_x0020_` is a space.
fn without_escapes(name: &str) -> String {
    let mut parts = name.split("_x");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let code = part
            .split_once('_')
            .filter(|(code, _)| (2..=4).contains(&code.len()));
        let letter = code.and_then(|(code, rest)| {
            let letter = char::from_u32(u32::from_str_radix(code, 16).ok()?)?;
            Some((letter, rest))
        });
        match letter {
            Some((letter, rest)) => {
                text.push(letter);
                text.push_str(rest);
            }
            None => {
                text.push_str("_x");
                text.push_str(part);
            }
        }
    }
    text
}
