//! Text inside and outside brackets.

/// Split a text at the separators outside all brackets: each part with the number of characters before
/// it, so that the column of a mistake in a part can be told for the whole text. Parts keep their spaces.
///
/// A text without a separator is one part.
pub fn parts(text: &str, separator: char) -> Vec<(usize, &str)> {
    let (mut depth, mut start, mut before) = (0_usize, 0, 0);
    let mut parts = Vec::new();
    for (index, (byte, character)) in text.char_indices().enumerate() {
        match character {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if character == separator && depth == 0 => {
                parts.push((before, text.get(start..byte).unwrap_or_default()));
                start = byte + character.len_utf8();
                before = index + 1;
            }
            _ => {}
        }
    }
    parts.push((before, text.get(start..).unwrap_or_default()));
    parts
}

/// Write decimal commas as points: all commas but those directly in the brackets of a function, which
/// separate its arguments. Columns stay.
pub(super) fn with_decimal_points(text: &str) -> String {
    let mut functions = Vec::new();
    let mut last = ' ';
    let replaced = text.chars().map(|character| {
        let shown = match character {
            ',' if functions.last() != Some(&true) => '.',
            other => other,
        };
        match character {
            '(' => functions.push(last.is_ascii_alphanumeric()),
            ')' => drop(functions.pop()),
            _ => {}
        }
        if !character.is_whitespace() {
            last = character;
        }
        shown
    });
    replaced.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_in_brackets_are_no_separators() {
        let found = parts("max(1,2),−3 ,(4,5)", ',');
        assert_eq!(found, [(0, "max(1,2)"), (9, "−3 "), (13, "(4,5)")]);
        assert_eq!(parts("", ','), [(0, "")]);
        assert_eq!(parts("1)),2", ','), [(0, "1))"), (4, "2")]);
    }

    #[test]
    fn commas_are_decimal_but_between_arguments() {
        for (text, expected) in [
            ("3,5", "3.5"),
            ("max(3,5)", "max(3,5)"),
            ("max (3,5)", "max (3,5)"),
            ("(3,5)*2,5", "(3.5)*2.5"),
            ("max((3,5)+1,2)", "max((3.5)+1,2)"),
            ("2*(1,5+max(1,2))", "2*(1.5+max(1,2))"),
            ("))1,5", "))1.5"),
        ] {
            assert_eq!(with_decimal_points(text), expected);
        }
    }
}
