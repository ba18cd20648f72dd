//! Keys of a project file that this program does not know.

/// Keys of a project or of a curve that this program does not know, with their values as text,
/// in the order of the file. They have no effect, and saving writes them again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extras(Vec<(String, String)>);

impl Extras {
    /// Add a key with its value, as it is written.
    pub fn push(&mut self, key: impl Into<String>, value: impl Into<String>) {
        self.0.push((key.into(), value.into()));
    }

    /// Drop a key.
    pub fn remove(&mut self, key: &str) {
        self.0.retain(|(own, _)| own != key);
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// List the keys with their values.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, &str)> {
        let entries = self.0.iter();
        entries.map(|(key, value)| (key.as_str(), value.as_str()))
    }
}
