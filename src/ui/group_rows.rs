//! The rows of a list by groups: headings that fold, and what they hold.

use std::collections::{BTreeSet, HashMap};

use crate::document::Group;

/// So many groups inside one another have headings of their own; the rest of a longer path is one heading.
const DEEPEST: usize = 5;

/// A row of a list.
pub enum Row<'a, T> {
    /// The heading of a group.
    Group(GroupRow<'a, T>),
    /// An item of the list.
    Item {
        /// The item.
        item: &'a T,
        /// How many headings it is under.
        depth: usize,
    },
}

/// The heading of a group.
pub struct GroupRow<'a, T> {
    /// The group with its whole path.
    pub group: Group,
    /// The end of the path, as it is shown under the heading above.
    pub name: String,
    /// How many headings it is under.
    pub depth: usize,
    /// Whether the rows under it are left out.
    pub is_folded: bool,
    /// What is in it, and in the groups within it.
    pub members: Vec<&'a T>,
}

/// The rows of a list. Groups, and what is in none, stand where the first item of each stands.
pub fn rows<'a, T>(
    items: &'a [T],
    group: impl Fn(&T) -> &Group,
    folded: &BTreeSet<Group>,
) -> Vec<Row<'a, T>> {
    let mut list = List {
        group: &group,
        folded,
        rows: Vec::with_capacity(items.len()),
    };
    list.add(items.iter().collect(), 0);
    list.rows
}

struct List<'a, 'g, T> {
    group: &'g dyn Fn(&T) -> &Group,
    folded: &'g BTreeSet<Group>,
    rows: Vec<Row<'a, T>>,
}

impl<'a, T> List<'a, '_, T> {
    /// Add the rows of items that have a path of so many names in common.
    fn add(&mut self, items: Vec<&'a T>, depth: usize) {
        for (group, members) in self.by_group(items, depth) {
            let Some(group) = group else {
                let items = members.into_iter().map(|item| Row::Item { item, depth });
                self.rows.extend(items);
                continue;
            };
            let is_folded = self.folded.contains(&group);
            self.rows.push(Row::Group(GroupRow {
                name: Group::new(&group.names()[depth..]).to_string(),
                group,
                depth,
                is_folded,
                members: members.clone(),
            }));
            if !is_folded {
                self.add(members, depth + 1);
            }
        }
    }

    /// Part items by the next name of their paths, in the order of the first of each part.
    fn by_group(&self, items: Vec<&'a T>, depth: usize) -> Vec<(Option<Group>, Vec<&'a T>)> {
        let mut places: HashMap<Option<&[String]>, usize> = HashMap::new();
        let mut parts: Vec<(Option<Group>, Vec<&'a T>)> = Vec::new();
        for item in items {
            let names = (self.group)(item).names();
            let length = match depth + 1 {
                DEEPEST => names.len(),
                length => length,
            };
            let is_deeper = depth < DEEPEST && names.len() > depth;
            let path = names.get(..length).filter(|_| is_deeper);
            let place = *places.entry(path).or_insert(parts.len());
            match parts.get_mut(place) {
                Some((_, members)) => members.push(item),
                None => parts.push((path.map(Group::new), vec![item])),
            }
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of items with these groups, each indented by its depth; items by their numbers.
    fn shown(groups: &[&str], folded: &[&str]) -> Vec<String> {
        let items = groups.iter().map(|group| Group::from(*group)).enumerate();
        let items: Vec<(usize, Group)> = items.collect();
        let folded = folded.iter().map(|group| Group::from(*group)).collect();
        let shown = rows(&items, |item| &item.1, &folded).into_iter();
        let shown = shown.map(|row| match row {
            Row::Item { item, depth } => format!("{}{}", " ".repeat(depth), item.0),
            Row::Group(row) => {
                let indent = " ".repeat(row.depth);
                format!("{indent}{} ({})", row.name, row.members.len())
            }
        });
        shown.collect()
    }

    #[test]
    fn without_groups_the_items_are_the_rows() {
        assert_eq!(shown(&["", "", ""], &["Deck"]), ["0", "1", "2"]);
    }

    #[test]
    fn groups_stand_where_their_first_item_does() {
        let groups = ["Deck", "", "Hull", "Deck", ""];
        let expected = ["Deck (2)", " 0", " 3", "1", "4", "Hull (1)", " 2"];
        assert_eq!(shown(&groups, &[]), expected);
    }

    #[test]
    fn groups_within_groups_have_headings_under_headings() {
        let groups = ["Deck/Port", "Deck", "Deck/Port/a\\/b", "Decks"];
        let expected = [
            "Deck (3)",
            " Port (2)",
            "  0",
            "  a\\/b (1)",
            "   2",
            " 1",
            "Decks (1)",
            " 3",
        ];
        assert_eq!(shown(&groups, &[]), expected);
    }

    #[test]
    fn a_folded_group_leaves_out_what_is_in_it() {
        let groups = ["Deck/Port", "Deck", "Hull"];
        assert_eq!(
            shown(&groups, &["Deck", "Deck/Port"]),
            ["Deck (2)", "Hull (1)", " 2"]
        );
        assert_eq!(
            shown(&groups, &["Deck/Port"]),
            ["Deck (2)", " Port (1)", " 1", "Hull (1)", " 2"]
        );
    }

    #[test]
    fn the_rest_of_a_long_path_is_one_heading() {
        let long = ["a/b/c/d/e/f/g", "a/b/c/d/e/f/g", "a/b/c/d/e"];
        let expected = [
            "a (3)",
            " b (3)",
            "  c (3)",
            "   d (3)",
            "    e/f/g (2)",
            "     0",
            "     1",
            "    e (1)",
            "     2",
        ];
        assert_eq!(shown(&long, &[]), expected);
        let endless = "a/".repeat(100_000);
        assert_eq!(shown(&[&endless], &[]).len(), DEEPEST + 1);
    }
}
