//! Groups of curves and references.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// Separates the names of a path.
const SEPARATOR: char = '/';

/// Stands before a separator, or before another one of itself, that belongs to a name.
const ESCAPE: char = '\\';

/// The group of a curve or of a reference: a path of names, the outermost first. Without names it is none.
///
/// No name is empty or begins or ends with a space. A path is shown and typed with `/` between its names; within
/// a name `/` is shown as `\/`, and `\` as `\\`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Group(Arc<[String]>);

impl Group {
    /// Make a group of the names of its path. Spaces around names and empty names are dropped.
    pub fn new(names: impl IntoIterator<Item = impl AsRef<str>>) -> Self {
        let names = names.into_iter();
        let names = names.map(|name| name.as_ref().trim().to_owned());
        Self(names.filter(|name| !name.is_empty()).collect())
    }

    /// The names of the path, the outermost first.
    pub fn names(&self) -> &[String] {
        &self.0
    }

    /// Whether it is no group.
    pub fn is_none(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether another group is this one or lies within it. Nothing lies within no group.
    pub fn holds(&self, other: &Self) -> bool {
        !self.is_none() && other.names().starts_with(&self.0)
    }

    /// The innermost group that holds both; none if there is none.
    pub fn shared(&self, other: &Self) -> Self {
        let names = self.names().iter().zip(other.names());
        let names = names.take_while(|(own, other)| own == other);
        Self(names.map(|(name, _)| name.clone()).collect())
    }

    /// The group that this one lies within; none outside of all.
    pub fn outer(&self) -> Self {
        let outer = self.0.split_last().map_or(&[][..], |(_, outer)| outer);
        Self(outer.into())
    }

    /// The group after this path, or its beginning, was renamed; `None` if it does not lie within `from`.
    pub fn renamed(&self, from: &Self, to: &Self) -> Option<Self> {
        if !from.holds(self) {
            return None;
        }
        let inner = self.names().strip_prefix(from.names())?;
        Some(Self(to.0.iter().chain(inner).cloned().collect()))
    }
}

impl fmt::Display for Group {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_special = |letter: char| [SEPARATOR, ESCAPE].contains(&letter);
        let mut text = String::new();
        for (index, name) in self.0.iter().enumerate() {
            text.extend((index > 0).then_some(SEPARATOR));
            for letter in name.chars() {
                text.extend(is_special(letter).then_some(ESCAPE));
                text.push(letter);
            }
        }
        formatter.pad(&text)
    }
}

impl FromStr for Group {
    type Err = Infallible;

    /// Read a path as it is shown. An escape before another letter is a letter of the name.
    fn from_str(text: &str) -> Result<Self, Infallible> {
        let mut names = vec![String::new()];
        let mut letters = text.chars().peekable();
        while let Some(letter) = letters.next() {
            let next =
                letters.next_if(|next| letter == ESCAPE && [SEPARATOR, ESCAPE].contains(next));
            match (letter, names.last_mut()) {
                (SEPARATOR, _) => names.push(String::new()),
                (_, Some(name)) => name.push(next.unwrap_or(letter)),
                (_, None) => {}
            }
        }
        Ok(Self::new(names))
    }
}

impl From<&str> for Group {
    fn from(text: &str) -> Self {
        let Ok(group) = text.parse();
        group
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        Group::from(text).names().to_vec()
    }

    #[test]
    fn a_path_is_shown_with_slashes_and_read_again() {
        for (path, text) in [
            (&[][..], ""),
            (&["Deck"], "Deck"),
            (&["Deck", "Port"], "Deck/Port"),
            (&["1/2", "a\\b", "\\/"], "1\\/2/a\\\\b/\\\\\\/"),
            (&["c\\"], "c\\\\"),
        ] {
            let group = Group::new(path);
            assert_eq!(group.to_string(), text);
            assert_eq!(Group::from(text), group);
        }
    }

    #[test]
    fn groups_share_the_beginning_of_their_paths() {
        let group = Group::from;
        for (one, other, shared) in [
            ("Deck/Port", "Deck/Star", "Deck"),
            ("Deck/Port", "Deck", "Deck"),
            ("Deck", "Keel", ""),
            ("", "Keel", ""),
        ] {
            assert_eq!(group(one).shared(&group(other)), group(shared));
            assert_eq!(group(other).shared(&group(one)), group(shared));
        }
        assert_eq!(group("Deck/Port").outer(), group("Deck"));
        assert_eq!(group("").outer(), group(""));
    }

    #[test]
    fn what_is_typed_needs_no_care() {
        assert_eq!(names(" Deck / Port side/ "), ["Deck", "Port side"]);
        assert_eq!(names("//Deck//"), ["Deck"]);
        assert_eq!(names("a\\b\\"), ["a\\b\\"]);
        assert!(Group::from(" / ").is_none());
        assert_eq!(Group::new([" Deck", " "]), Group::from("Deck"));
    }

    #[test]
    fn a_group_holds_what_is_within_it() {
        let deck = Group::from("Deck");
        assert!(deck.holds(&deck) && deck.holds(&"Deck/Port".into()));
        assert!(!deck.holds(&"Decks".into()) && !deck.holds(&Group::default()));
        assert!(!Group::default().holds(&deck));
    }

    #[test]
    fn renaming_keeps_what_is_within() {
        let renamed = |group: &str, to: &str| {
            let group = Group::from(group).renamed(&"Deck/Port".into(), &to.into());
            group.map(|group| group.to_string())
        };
        assert_eq!(renamed("Deck/Port", "Hull"), Some("Hull".to_owned()));
        assert_eq!(renamed("Deck/Port/a", "b/c"), Some("b/c/a".to_owned()));
        assert_eq!(renamed("Deck/Port/a", ""), Some("a".to_owned()));
        assert_eq!(renamed("Deck", "Hull"), None);
        assert_eq!(renamed("Deck/Porthole", "Hull"), None);
    }
}
