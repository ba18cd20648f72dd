//! A picture that a reference shows in its frame.

use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Hold where a picture's bytes are, how many pixels it has, and how strongly it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Where its bytes are.
    pub source: PictureSource,
    /// Its width and height in pixels, as it is shown.
    pub pixels: [u32; 2],
    /// How strongly it is drawn, from 0 to 1.
    pub opacity: f64,
}

/// Where the bytes of a picture are.
#[derive(Clone, Debug)]
pub enum PictureSource {
    /// In a file. In a document its path is absolute, in a project it is relative to the project's folder.
    File(PathBuf),
    /// In the project itself.
    Embedded(Arc<[u8]>),
}

impl PartialEq for PictureSource {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::File(own), Self::File(other)) => own == other,
            // Each frame compares them: megabytes that are the very same are not looked at.
            (Self::Embedded(own), Self::Embedded(other)) => Arc::ptr_eq(own, other) || own == other,
            _ => false,
        }
    }
}

impl Picture {
    /// The opacity of a new picture: curves and grid stay readable on it.
    pub const OPACITY: f64 = 0.6;

    /// Make a picture with the opacity of a new one.
    pub fn new(source: PictureSource, pixels: [u32; 2]) -> Self {
        Self {
            source,
            pixels,
            opacity: Self::OPACITY,
        }
    }

    /// The file that holds it, unless it is embedded.
    pub fn file(&self) -> Option<&Path> {
        match &self.source {
            PictureSource::File(path) => Some(path),
            PictureSource::Embedded(_) => None,
        }
    }
}
