//! Text of others in messages: names, and what stands in files.

use crate::geometry::counted;

/// So many items are named; their count stands for the others.
const MOST_NAMED: usize = 3;

/// The most characters of a text that a message shows.
const LONGEST: usize = 60;

/// Put text of others into quotation marks for a message: [cut](cut) and escaped.
pub fn quoted(text: &str) -> String {
    format!("“{}”", cut(text))
}

/// Name the first of some items for a message, and count the others: “a”, “b”, “c” and 57 others.
pub fn first_quoted(names: &[&str]) -> String {
    let mut texts: Vec<String> = names.iter().take(MOST_NAMED).map(|it| quoted(it)).collect();
    let others = names.len().saturating_sub(MOST_NAMED);
    if others > 0 {
        texts.push(counted(others, "other", "others"));
    }
    let last = texts.pop().unwrap_or_default();
    match texts.is_empty() {
        true => last,
        false => format!("{} and {last}", texts.join(", ")),
    }
}

/// Make text of others fit for a message: [escaped](escaped), and cut after 60 characters.
pub fn cut(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => escaped(&text[..end]) + "…",
        None => escaped(text),
    }
}

/// Write what would break a message's line or turn its direction as escapes: control
/// characters, line separators, and the marks of right-to-left text.
pub fn escaped(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() || is_separator(character) || is_direction(character) {
            shown.extend(character.escape_default());
        } else {
            shown.push(character);
        }
    }
    shown
}

fn is_separator(character: char) -> bool {
    matches!(character, '\u{2028}' | '\u{2029}')
}

/// Whether a character does nothing but set the direction of the text around it.
fn is_direction(character: char) -> bool {
    matches!(
        character,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_name_breaks_or_turns_a_message() {
        assert_eq!(quoted("two\nlines\t"), "“two\\nlines\\t”");
        for mark in "\u{61c}\u{200e}\u{200f}\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}\u{2028}\u{2029}".chars() {
            let expected = format!("“a\\u{{{:x}}}b”", u32::from(mark));
            assert_eq!(quoted(&format!("a{mark}b")), expected);
        }
        assert_eq!(quoted("Rücken 曲线 קו"), "“Rücken 曲线 קו”");
    }

    #[test]
    fn the_first_are_named_and_the_others_counted() {
        assert_eq!(first_quoted(&["a"]), "“a”");
        assert_eq!(first_quoted(&["a", "b", "c"]), "“a”, “b” and “c”");
        assert_eq!(
            first_quoted(&["a", "b", "c", "d", "e"]),
            "“a”, “b”, “c” and 2 others"
        );
    }

    #[test]
    fn a_long_name_is_cut() {
        let name = "ü".repeat(60);
        assert_eq!(quoted(&name), format!("“{name}”"));
        assert_eq!(quoted(&format!("{name}x")), format!("“{name}…”"));
    }
}
