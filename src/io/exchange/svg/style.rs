//! Colours and visibility, by attributes, `style` attributes and the plain rules of style sheets: those for a
//! class, an identifier or an element alone.

use std::collections::HashMap;
use std::str::FromStr;

use roxmltree::Node;

/// The properties that count.
const PROPERTIES: [&str; 5] = ["stroke", "fill", "color", "display", "visibility"];

/// The bytes of the longest value that is kept.
const LONGEST_VALUE: usize = 128;

/// The bytes of the longest selector that is looked at.
const LONGEST_SELECTOR: usize = 1000;

/// The most selectors of a file that have an effect.
pub(super) const MOST_SELECTORS: usize = 100_000;

/// What an element inherits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Style {
    stroke: Paint,
    fill: Paint,
    colour: Option<[u8; 3]>,
    invisible: bool,
    /// Whether the element and all in it is not drawn at all.
    pub(super) hidden: bool,
}

/// A stroke or a fill.
#[derive(Clone, Copy, Debug, Default)]
enum Paint {
    /// Unknown, or no single colour.
    #[default]
    None,
    /// The value of `color`.
    Current,
    Colour([u8; 3]),
}

/// The rules of all style sheets of a file, by selector.
#[derive(Default)]
pub(super) struct Sheet {
    rules: HashMap<String, Vec<(String, String)>>,
    /// Whether there are too many selectors.
    pub(super) is_full: bool,
}

impl Style {
    /// Get the colour of a shape: of its stroke, or else of its fill.
    pub(super) fn shown(&self) -> Option<[u8; 3]> {
        self.paint(self.stroke).or_else(|| self.paint(self.fill))
    }

    /// Tell whether a shape is not drawn.
    pub(super) fn is_invisible(&self) -> bool {
        self.invisible
    }

    /// Make the style of an element within one of this style.
    pub(super) fn of(mut self, node: Node, sheet: &Sheet) -> Self {
        self.hidden = false;
        for name in PROPERTIES {
            if let Some(value) = node.attribute(name) {
                self.set(name, value);
            }
        }
        if !sheet.rules.is_empty() {
            let classes = node.attribute("class").unwrap_or_default();
            let classes = classes.split_ascii_whitespace().map(|it| (".", it));
            let id = node.attribute("id").map(|it| ("#", it));
            let selectors = std::iter::once(("", node.tag_name().name()));
            let selectors = selectors.chain(classes).chain(id);
            for (mark, name) in selectors.filter(|(_, name)| name.len() < LONGEST_SELECTOR) {
                let rules = sheet.rules.get(&[mark, name].concat());
                for (name, value) in rules.into_iter().flatten() {
                    self.set(name, value);
                }
            }
        }
        for (name, value) in declarations(node.attribute("style").unwrap_or_default()) {
            self.set(name, value);
        }
        self
    }

    fn paint(&self, paint: Paint) -> Option<[u8; 3]> {
        match paint {
            Paint::None => None,
            Paint::Current => self.colour,
            Paint::Colour(colour) => Some(colour),
        }
    }

    fn set(&mut self, name: &str, value: &str) {
        let value = value.trim();
        if value == "inherit" {
            return;
        }
        match name {
            "stroke" => self.stroke = paint(value),
            "fill" => self.fill = paint(value),
            "color" => self.colour = rgb(value).or(self.colour),
            "display" => self.hidden = value == "none",
            "visibility" => self.invisible = matches!(value, "hidden" | "collapse"),
            _ => {}
        }
    }
}

impl Sheet {
    /// Add the rules of a `style` element.
    pub(super) fn add(&mut self, text: &str) {
        let text = without_comments(text);
        for rule in text.split('}') {
            let Some((selectors, body)) = rule.split_once('{') else {
                continue;
            };
            let mut known = Vec::new();
            for (name, value) in declarations(body).filter(|it| PROPERTIES.contains(&it.0)) {
                declare(&mut known, name, value);
            }
            for selector in selectors.split(',').map(str::trim) {
                let is_combined =
                    selector.contains(|it: char| it.is_whitespace() || "@:[>+~*".contains(it));
                if is_combined || selector.len() > LONGEST_SELECTOR {
                    continue;
                }
                if self.rules.len() >= MOST_SELECTORS && !self.rules.contains_key(selector) {
                    self.is_full = true;
                    continue;
                }
                let rules = self.rules.entry(selector.to_owned()).or_default();
                for (name, value) in &known {
                    declare(rules, name, value);
                }
            }
        }
    }
}

/// Add a declaration in the place of an earlier one of its name, so that no selector has more than a few.
fn declare(rules: &mut Vec<(String, String)>, name: &str, value: &str) {
    // No colour is so long.
    let value = if value.len() > LONGEST_VALUE {
        ""
    } else {
        value
    };
    let changes_nothing = value == "inherit" || (name == "color" && rgb(value).is_none());
    if !changes_nothing {
        rules.retain(|(known, _)| known != name);
        rules.push((name.to_owned(), value.to_owned()));
    }
}

fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split(';').filter_map(|it| {
        let (name, value) = it.split_once(':')?;
        let value = value.trim();
        Some((
            name.trim(),
            value.strip_suffix("!important").unwrap_or(value),
        ))
    })
}

fn without_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        kept.push_str(part.split_once("*/").map_or("", |(_, rest)| rest));
    }
    kept
}

fn paint(value: &str) -> Paint {
    if value.eq_ignore_ascii_case("currentColor") {
        return Paint::Current;
    }
    rgb(value).map_or(Paint::None, Paint::Colour)
}

fn rgb(value: &str) -> Option<[u8; 3]> {
    let colour = svgtypes::Color::from_str(value).ok()?;
    Some([colour.red, colour.green, colour.blue])
}
