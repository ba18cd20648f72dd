//! The formats by name, and how a file's name tells its own.

use std::fmt;
use std::path::Path;

use thiserror::Error;

use crate::document::cut;

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Batten's own project file; it loses nothing.
    Batten,
    /// Tables of polygons as comma-separated values.
    Csv,
    /// AutoCAD's drawing exchange format; written only.
    Dxf,
}

impl Format {
    /// Every format, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Batten, Self::Csv, Self::Dxf];

    /// The extension of its files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Batten => "batten",
            Self::Csv => "csv",
            Self::Dxf => "dxf",
        }
    }

    /// Name the format as dialogs and messages do.
    pub fn name(self) -> &'static str {
        match self {
            Self::Batten => "Batten project",
            Self::Csv => "CSV table",
            Self::Dxf => "DXF",
        }
    }

    /// Whether files of the format can be read.
    pub fn can_read(self) -> bool {
        match self {
            Self::Batten | Self::Csv => true,
            Self::Dxf => false,
        }
    }

    /// List the formats that can be read.
    pub fn readable() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|format| format.can_read())
    }

    /// List the formats that can be written: all of them.
    pub fn writable() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter()
    }

    /// Tell the format to read from a file's extension, in upper or lower case.
    ///
    /// # Errors
    /// [`FormatError`] if there is none, it is not known, or it is only written.
    pub fn to_read(path: &Path) -> Result<Self, FormatError> {
        let known = || extensions(Self::readable());
        let format = Self::from_extension(path, known)?;
        if format.can_read() {
            Ok(format)
        } else {
            Err(FormatError::NotReadable {
                format,
                known: known(),
            })
        }
    }

    /// Tell the format to write from a file's extension, in upper or lower case.
    ///
    /// # Errors
    /// [`FormatError`] if there is none or it is not known.
    pub fn to_write(path: &Path) -> Result<Self, FormatError> {
        Self::from_extension(path, || extensions(Self::writable()))
    }

    /// Find a format by its extension, in upper or lower case.
    pub fn find(extension: &str) -> Option<Self> {
        let mut formats = Self::ALL.into_iter();
        formats.find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    fn from_extension(path: &Path, known: impl Fn() -> String) -> Result<Self, FormatError> {
        let Some(extension) = path.extension() else {
            return Err(FormatError::NoExtension { known: known() });
        };
        let found = extension.to_str().and_then(Self::find);
        found.ok_or_else(|| FormatError::UnknownExtension {
            extension: extension.to_string_lossy().into_owned(),
            known: known(),
        })
    }
}

/// A reason why a format cannot be told from a file's name, or not be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FormatError {
    /// The name has no extension.
    #[error("the name has no extension that tells its format: add one of {known}")]
    NoExtension {
        /// The extensions that could be used.
        known: String,
    },
    /// The name has an extension that is not known.
    #[error("“.{}” is not a format Batten knows: use one of {known}", cut(.extension))]
    UnknownExtension {
        /// The extension.
        extension: String,
        /// The extensions that could be used.
        known: String,
    },
    /// The format is only written.
    #[error("{format} files can be written but not read: the formats that can be read are {known}")]
    NotReadable {
        /// The format.
        format: Format,
        /// The extensions that can be read.
        known: String,
    },
}

impl fmt::Display for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

fn extensions(formats: impl Iterator<Item = Format>) -> String {
    let list: Vec<String> = formats
        .map(|format| format!(".{}", format.extension()))
        .collect();
    list.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_tells_the_format_in_either_case() {
        for format in Format::ALL {
            for extension in [
                format.extension().to_owned(),
                format.extension().to_uppercase(),
            ] {
                let path = Path::new("folder.csv/some.name").with_extension(extension);
                assert_eq!(Format::to_write(&path), Ok(format));
                assert_eq!(Format::to_read(&path).is_ok(), format.can_read());
            }
        }
    }

    #[test]
    fn an_unknown_extension_lists_the_known_ones() {
        let check = |path: &str, expected: &str| {
            let error = Format::to_read(Path::new(path)).unwrap_err();
            assert_eq!(error.to_string(), expected);
        };
        check(
            "a.txt",
            "“.txt” is not a format Batten knows: use one of .batten, .csv",
        );
        check(
            "folder.csv/arc",
            "the name has no extension that tells its format: add one of .batten, .csv",
        );
        check(
            "a.dxf",
            "DXF files can be written but not read: the formats that can be read are .batten, .csv",
        );
        assert_eq!(
            Format::to_write(Path::new("a.docx"))
                .unwrap_err()
                .to_string(),
            "“.docx” is not a format Batten knows: use one of .batten, .csv, .dxf",
        );
    }
}
