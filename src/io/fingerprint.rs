//! Fingerprints of files: they tell whether another program has changed a file.

use serde::{Deserialize, Serialize};
use siphasher::sip::SipHasher13;

/// A number of 64 bits that tells a file's content from any other that one comes across.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fingerprint(u64);

impl Fingerprint {
    /// Take the fingerprint of some bytes. It is the same in every run and on every machine.
    pub fn of(bytes: &[u8]) -> Self {
        Self(SipHasher13::new().hash(bytes))
    }
}
