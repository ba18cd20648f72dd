//! Durations from environment variables.

use std::time::Duration;

/// A duration that an environment variable sets in seconds.
pub fn seconds_of(variable: &str) -> Option<Duration> {
    let seconds = std::env::var(variable).ok()?.parse().ok()?;
    Duration::try_from_secs_f64(seconds).ok()
}
