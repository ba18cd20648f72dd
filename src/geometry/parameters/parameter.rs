//! A parameter with its words.

/// Describe a parameter.
#[derive(Clone, Copy, Debug)]
pub struct Parameter<K> {
    /// Name on the command line.
    pub name: &'static str,
    /// Label in panels, at most three words.
    pub label: &'static str,
    /// Help text: one sentence without a full stop.
    pub help: &'static str,
    /// Values that it takes.
    pub kind: K,
}

impl<K: Copy> Parameter<K> {
    /// Describe a parameter by its name, label, help text and values.
    pub const fn new(name: &'static str, label: &'static str, help: &'static str, kind: K) -> Self {
        Self {
            name,
            label,
            help,
            kind,
        }
    }
}
