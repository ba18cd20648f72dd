//! The editor without a window, driven by scripts of pointer and key events.

mod commands;
mod deleting;
mod drawing;
mod end_fit;
mod features;
mod files;
mod reshaping;
mod script;
mod selecting;
mod several;
mod space;
mod transforming;
mod vertices;
mod view;
