//! The editor without a window, driven by scripts of pointer and key events.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/drawings.rs"]
mod drawings;

mod approximating;
mod autosaving;
mod background;
mod between;
mod commands;
mod crowding;
mod curve_drags;
mod cutting;
mod deleting;
mod documents;
mod dragging;
mod drawing;
mod end_fit;
mod entering;
mod events;
mod features;
mod files;
mod fitting;
mod following;
mod generating;
mod grouping;
mod guides;
mod harmony;
mod importing;
mod joining;
mod keep_shape;
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
