//! Rows that keep their places, though some come and go.

/// The names of rows in the order in which they were first shown. One that comes later stands below
/// the others, and one that goes leaves its place empty: nothing moves while a number is dragged.
#[derive(Default)]
pub struct SteadyRows {
    names: Vec<&'static str>,
}

impl SteadyRows {
    /// Put rows into their places; a place whose row is not there now has `None`.
    pub fn in_place<T>(&mut self, rows: Vec<(&'static str, T)>) -> Vec<(&'static str, Option<T>)> {
        let count = |names: &[&str], name: &str| names.iter().filter(|it| **it == name).count();
        let mut named = Vec::new();
        for (name, _) in &rows {
            named.push(*name);
            // Several rows may have one name.
            if count(&named, name) > count(&self.names, name) {
                self.names.push(name);
            }
        }
        let rows = rows.into_iter().map(|(name, row)| (name, Some(row)));
        let mut rows: Vec<_> = rows.collect();
        let places = self.names.iter().map(|name| {
            let mut all = rows.iter_mut();
            let own = all.find(|(other, row)| other == name && row.is_some());
            (*name, own.and_then(|(_, row)| row.take()))
        });
        places.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_shown_once_keeps_its_place() {
        let mut rows = SteadyRows::default();
        let first = rows.in_place(vec![("a", 1), ("c", 2), ("c", 3)]);
        assert_eq!(first, [("a", Some(1)), ("c", Some(2)), ("c", Some(3))]);
        let second = rows.in_place(vec![("b", 4), ("c", 5)]);
        let expected = [("a", None), ("c", Some(5)), ("c", None), ("b", Some(4))];
        assert_eq!(second, expected);
    }
}
