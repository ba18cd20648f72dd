//! The hand: the tool, its gesture, the selection, and the keys that are held.

pub(in crate::editor) mod alignment;
mod clean_step;
mod cycle;
mod drawing_plane;
mod end_axis;
pub mod end_fit;
mod end_fit_report;
mod entering;
pub(in crate::editor) mod following;
pub(in crate::editor) mod gesture;
#[allow(clippy::module_inception)]
mod hand;
pub(in crate::editor) mod input;
mod keeping;
mod kept_curves;
mod kept_features;
pub(in crate::editor) mod menu;
mod menu_request;
pub(in crate::editor) mod snap_name;
pub(in crate::editor) mod snapping;
pub(in crate::editor) mod tools;
pub(in crate::editor) mod typed_point;

pub use drawing_plane::{Leg, LegLocks};
pub use end_fit::{EndFitAction, EndFitReport, EndNoise, MATCH_END, MatchReport};
pub use following::{Follow, Following};
pub use hand::Hand;
pub use input::{Button, Input, Key, Modifiers};
pub use menu_request::{MenuRequest, MenuSubject};
pub use tools::{
    Arrangement, Cursor, DrawSettings, DrawWay, Entry, ToolKind, ToolRow, Transformation,
};
pub use typed_point::EntryError;
