//! Names for new curves.

/// Find a name that is not taken: the name itself, or with another number behind it.
pub fn free_name(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    if !is_taken(name) {
        return name.to_owned();
    }
    let letters = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    // A name that is nothing but a number is kept whole.
    let stem = if letters.trim().is_empty() {
        name
    } else {
        letters.trim_end()
    };
    let mut numbered = (2..).map(|number: u64| format!("{stem} {number}"));
    numbered
        .find(|name| !is_taken(name))
        .unwrap_or_else(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_numbered_on() {
        let taken = ["arc", "arc 2", "2024", "hull 7", "curve 1"];
        for (name, expected) in [
            ("spline", "spline"),
            ("arc", "arc 3"),
            ("arc 2", "arc 3"),
            ("2024", "2024 2"),
            ("hull 7", "hull 2"),
            ("curve 1", "curve 2"),
        ] {
            assert_eq!(free_name(name, |name| taken.contains(&name)), expected);
        }
    }
}
