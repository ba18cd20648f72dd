//! Why an entity cannot be read.

use super::instances::Instance;

/// Why an entity cannot be read.
#[derive(Clone, Debug)]
pub enum Flaw {
    /// It is damaged or breaks a rule.
    Damaged {
        /// Its line.
        line: u64,
        /// Its name.
        entity: String,
        /// What is wrong with it.
        reason: String,
    },
    /// There is no room for it.
    TooLarge {
        /// Its line.
        line: u64,
        /// Its name.
        entity: String,
    },
    /// It is a kind that this reader does not know.
    Unknown {
        /// Its line.
        line: u64,
        /// Its name.
        entity: String,
    },
}

impl Flaw {
    /// Say what is wrong with an instance.
    pub fn damaged(instance: &Instance, reason: &str) -> Self {
        Self::Damaged {
            line: instance.line,
            entity: numbered(instance),
            reason: reason.to_owned(),
        }
    }

    /// Say that there is no room for an instance.
    pub fn too_large(instance: &Instance) -> Self {
        Self::TooLarge {
            line: instance.line,
            entity: numbered(instance),
        }
    }

    /// Say that an instance is of a kind that this reader does not know.
    pub fn unknown(instance: &Instance) -> Self {
        Self::Unknown {
            line: instance.line,
            entity: instance.name().to_owned(),
        }
    }
}

fn numbered(instance: &Instance) -> String {
    format!("#{} {}", instance.id, instance.name())
}
