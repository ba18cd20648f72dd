//! Names of a usual length: a file may repeat a name of megabytes for each of its curves.

use std::sync::Arc;

use super::drawing::Drawing;

/// The letters of the longest name that is kept: AutoCAD allows as many.
pub(super) const LONGEST: usize = 255;

/// What is told of names that are cut.
pub(in crate::io) const CUT: &str = "names of more than 255 letters are cut";

/// The most groups of a path that are kept.
pub(super) const DEEPEST: usize = 64;

/// The letters of the longest path that is kept: a project holds it for each of its curves.
const LONGEST_PATH: usize = 1000;

/// Letters take up to so many bytes in any coding, with their escapes.
const LETTER: usize = 16;

/// What stands for the rest of a longer name.
const REST: char = '…';

/// Cut a name that is too long.
pub(in crate::io) fn short(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        None => name.to_owned(),
        Some((end, _)) => [&name[..end], REST.encode_utf8(&mut [0; 4])].concat(),
    }
}

/// Cut the names of the path of a group, and the path itself.
pub(super) fn short_path<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let (mut path, mut letters) = (Vec::new(), 0);
    for name in names.into_iter().map(short) {
        letters += name.chars().count();
        if path.len() == DEEPEST || letters > LONGEST_PATH {
            path.push(REST.to_string());
            break;
        }
        path.push(name);
    }
    path
}

/// The first bytes of a coded name, which are more than the letters that are kept. UTF-8 is cut between letters.
pub(super) fn beginning(bytes: &[u8]) -> &[u8] {
    let Some(mut bytes) = bytes.get(..LONGEST * LETTER) else {
        return bytes;
    };
    while let [rest @ .., last] = bytes {
        match last {
            0x80..0xc0 => bytes = rest,
            0xc0.. => return rest,
            _ => return bytes,
        }
    }
    bytes
}

/// Whether a name was cut.
pub(in crate::io) fn is_cut(name: &str) -> bool {
    name.len() > LONGEST && name.ends_with(REST) && name.chars().count() == LONGEST + 1
}

fn is_cut_path(path: &[String]) -> bool {
    let [names @ .., last] = path else {
        return false;
    };
    let letters: usize = names.iter().map(|name| name.chars().count()).sum();
    let is_full = names.len() == DEEPEST || letters + LONGEST + 1 > LONGEST_PATH;
    is_full && last.chars().eq([REST])
}

impl Drawing {
    /// Make the path of the next item, cut where it is too long: that of the last one where it is the same.
    pub(super) fn path(&self, names: &[impl AsRef<str>]) -> Arc<[String]> {
        let names = names.iter().map(AsRef::as_ref);
        let last = self.items.last().map(|item| &item.group);
        if let Some(last) = last.filter(|last| names.clone().eq(last.iter())) {
            return Arc::clone(last);
        }
        let path = short_path(names);
        match last.filter(|last| ***last == path) {
            Some(last) => Arc::clone(last),
            None => path.into(),
        }
    }

    /// Tell whether names were cut.
    pub(in crate::io) fn tell_cut_names(&mut self) {
        let mut names = self.items.iter().flat_map(|item| {
            let names = item.group.iter().chain(&item.name).map(String::as_str);
            names.chain(item.block.as_deref())
        });
        if names.any(is_cut) {
            self.remarks.push(CUT.to_owned());
        }
        if self.items.iter().any(|item| is_cut_path(&item.group)) {
            let told =
                format!("paths of more than {DEEPEST} groups or {LONGEST_PATH} letters are cut");
            self.remarks.push(told);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_behind_a_letter() {
        assert_eq!(short("Keel"), "Keel");
        let longest = "ü".repeat(LONGEST);
        assert_eq!(short(&longest), longest);
        assert!(!is_cut(&longest));
        let cut = short(&"ü".repeat(9999));
        assert_eq!(cut, longest + "…");
        assert!(is_cut(&cut));
        assert_eq!(beginning(&[7; 99_999]).len(), LONGEST * LETTER);
        assert_eq!(beginning(&[7; 9]), [7; 9]);
        let text = format!("a{}", "ü".repeat(9999));
        let bytes = beginning(text.as_bytes());
        assert_eq!(bytes.len(), LONGEST * LETTER - 1);
        assert!(std::str::from_utf8(bytes).is_ok());
        let deep = ["a"; 70];
        let path = short_path(deep);
        assert_eq!((path.len(), path[64].as_str()), (65, "…"));
        assert!(is_cut_path(&path) && !is_cut_path(&short_path(["a"; 64])));
        let long = "n".repeat(200);
        let path = short_path([long.as_str(); 9]);
        assert_eq!((path.len(), path[5].as_str()), (6, "…"));
        assert!(is_cut_path(&path) && !is_cut_path(&path[..5]));
    }
}
