//! The editor without a window, driven by scripts of pointer and key events.

#[path = "../common/mod.rs"]
mod common;

mod approximating;
mod autosaving;
mod background;
mod between;
mod commands;
mod deleting;
mod documents;
mod drawing;
mod end_fit;
mod entering;
mod events;
mod features;
mod files;
mod following;
mod generating;
mod guides;
mod harmony;
mod joining;
mod keeping;
mod laws;
mod locking;
mod matching;
mod matrix;
mod measuring;
mod menus;
mod model;
mod paper;
mod places;
mod plots;
mod previews;
mod references;
mod reshaping;
mod script;
mod selecting;
mod several;
mod snapshot;
mod space;
mod transforming;
mod trials;
mod vertices;
mod view;
mod watch;
mod window;
