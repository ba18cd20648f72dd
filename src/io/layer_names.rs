//! Names of layers that drawing programs accept: short enough, without forbidden characters,
//! and no two alike.

use std::collections::HashSet;

/// What AutoCAD forbids in the name of a layer.
const FORBIDDEN: &str = "<>/\\\":;?*|=,`";

/// The layer that every drawing has.
pub(super) const DEFAULT: &str = "0";

/// The longest name made, in characters: with what is appended to it well below the 255 that
/// are allowed.
const LONGEST: usize = 180;

/// Give out names, each once. Names that differ only in upper and lower case are alike.
pub(super) struct LayerNames {
    taken: HashSet<String>,
}

impl LayerNames {
    /// Begin with the names that every drawing has, also with each of the `suffixes` appended.
    pub(super) fn new(suffixes: &[&str]) -> Self {
        let own = [DEFAULT, "defpoints"].map(str::to_owned).into_iter();
        let others = suffixes.iter().map(|suffix| format!("{DEFAULT}{suffix}"));
        Self {
            taken: own.chain(others).collect(),
        }
    }

    /// Make a layer name of a curve's name such that it and the names with each of the
    /// `suffixes` appended are new, and take them all.
    pub(super) fn take(&mut self, name: &str, suffixes: &[&str]) -> String {
        let base = allowed(name);
        let mut candidate = base.clone();
        let mut number = 1;
        loop {
            let own = std::iter::once("").chain(suffixes.iter().copied());
            let names: Vec<String> = own
                .map(|suffix| format!("{candidate}{suffix}").to_lowercase())
                .collect();
            if names.iter().all(|name| !self.taken.contains(name)) {
                self.taken.extend(names);
                return candidate;
            }
            number += 1;
            candidate = format!("{base} {number}");
        }
    }
}

/// Replace characters that a layer's name cannot have. Those beyond the basic plane cannot be written
/// in this version of the format.
fn allowed(name: &str) -> String {
    let replaced = name.trim().chars().map(|character| {
        let odd = character.is_control() || u32::from(character) > 0xffff;
        if odd || FORBIDDEN.contains(character) {
            '_'
        } else {
            character
        }
    });
    let short: String = replaced.take(LONGEST).collect();
    match short.trim() {
        "" => "curve".to_owned(),
        short => short.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(names: &[&str], expected: &[&str]) {
        let mut layers = LayerNames::new(&[" float polygon"]);
        let given: Vec<String> = names
            .iter()
            .map(|name| layers.take(name, &[" float polygon"]))
            .collect();
        assert_eq!(given, expected);
    }

    #[test]
    fn plain_names_stay() {
        check(&["arc", "Rücken 3", "曲线"], &["arc", "Rücken 3", "曲线"]);
    }

    #[test]
    fn forbidden_characters_are_replaced() {
        check(
            &["a/b:c", "two\nlines", " padded ", "🚤", "", "\u{1}"],
            &["a_b_c", "two_lines", "padded", "_", "curve", "_ 2"],
        );
        check(&["x".repeat(999).as_str()], &["x".repeat(180).as_str()]);
    }

    #[test]
    fn no_two_names_are_alike() {
        check(
            &["arc", "ARC", "arc 2", "0"],
            &["arc", "ARC 2", "arc 2 2", "0 2"],
        );
        check(&["0 float polygon"], &["0 float polygon 2"]);
        check(
            &["arc", "arc float polygon"],
            &["arc", "arc float polygon 2"],
        );
        check(
            &["arc float polygon", "arc"],
            &["arc float polygon", "arc 2"],
        );
    }
}
