//! Batten: an editor for fair curves, shaped by their float S-polygons.
//!
//! The layers and which way they look:
//! `geometry ← document ← { analysis, io, operations } ← editor ← paper ← ui`, with `cli` beside the editor.
#![forbid(unsafe_code)]

// The parser that is made of the grammar of expressions names it.
extern crate alloc;

pub mod analysis;
pub mod cli;
pub mod document;
pub mod editor;
pub mod geometry;
pub mod io;
pub mod operations;
pub mod paper;
#[cfg(feature = "gui")]
pub mod ui;
