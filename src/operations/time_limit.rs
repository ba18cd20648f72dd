//! The time that a search has.

use std::time::Duration;

use super::lists::given;
use super::parameter::{Kind, POSITIVE, Parameter};
use super::values::Values;
use crate::geometry::Progress;

/// The time without a wish, in seconds.
const TIME: f64 = 10.0;

/// The seconds after which a search ends.
pub(super) const TIME_LIMIT: Parameter = Parameter {
    name: "time-limit",
    label: "Time limit",
    help: "The seconds after which the search ends with the best so far",
    kind: Kind::optional_number(POSITIVE, |_| "10"),
};

/// What is said of a search that ended so.
pub(super) const TIME_IS_UP: &str = "The time was up: this is the best found so far";

/// Give a search the time that the values allow.
pub(super) fn limited(progress: &Progress, values: &Values) -> Progress {
    progress.limited(Duration::try_from_secs_f64(seconds(values)).unwrap_or(Duration::MAX))
}

/// Tell the seconds that a search has.
pub(super) fn seconds(values: &Values) -> f64 {
    given(values, &TIME_LIMIT).unwrap_or(TIME)
}
