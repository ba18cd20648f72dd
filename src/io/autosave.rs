//! Autosaves: an unsaved document with the path and the fingerprint of its file.
//!
//! An autosave is a line of JSON with the origin of the document, and below it a project as
//! `io/project` writes it.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use super::error::{Place, Problem, ReadError, WriteError};
use super::fingerprint::Fingerprint;
use super::project::PROJECT;
use crate::document::Document;

/// The name of the format in the first line.
const FORMAT: &str = "batten autosave";

/// The version of the first line.
const VERSION: u64 = 1;

/// The origin of an autosaved document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The document's own file; `None` if it was never saved.
    pub path: Option<PathBuf>,
    /// The fingerprint of that file when it was last read or written.
    pub fingerprint: Option<Fingerprint>,
    /// When the autosave was made, to the second.
    pub time: SystemTime,
    /// The revision of the document in its session.
    pub revision: u64,
}

/// The first line.
#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    version: u64,
    path: Option<std::ffi::OsString>,
    fingerprint: Option<Fingerprint>,
    /// Seconds since 1970.
    time: u64,
    revision: u64,
}

/// Write a document with its origin.
///
/// # Errors
/// [`WriteError`] if a project cannot hold the document: never.
pub fn write(origin: &Origin, document: &Document) -> Result<Vec<u8>, WriteError> {
    let since = origin.time.duration_since(SystemTime::UNIX_EPOCH);
    let header = Header {
        format: FORMAT.to_owned(),
        version: VERSION,
        path: origin.path.clone().map(PathBuf::into_os_string),
        fingerprint: origin.fingerprint,
        time: since.unwrap_or_default().as_secs(),
        revision: origin.revision,
    };
    let project = PROJECT.write(document, None)?;
    let mut bytes = serde_json::json!(header).to_string().into_bytes();
    bytes.push(b'\n');
    bytes.extend(project.bytes);
    Ok(bytes)
}

/// Read a document with its origin.
///
/// # Errors
/// [`ReadError`] with the place, counted from the line below the first.
pub fn read(bytes: &[u8]) -> Result<(Origin, Document), ReadError> {
    if bytes.is_empty() {
        return Err(Problem::Empty.into());
    }
    let end = bytes.iter().position(|byte| *byte == b'\n');
    let (line, project) = bytes.split_at(end.unwrap_or(bytes.len()));
    let header: Header = serde_json::from_slice(line)
        .map_err(|error| Place::line(1).problem(Problem::Json(error.to_string())))?;
    if header.format != FORMAT {
        let found = Some(header.format);
        return Err(Problem::WrongFormat { found }.into());
    }
    if header.version > VERSION {
        let (found, newest) = (header.version, VERSION);
        return Err(Problem::NewerVersion { found, newest }.into());
    }
    let time = SystemTime::UNIX_EPOCH.checked_add(Duration::from_secs(header.time));
    let origin = Origin {
        path: header.path.map(PathBuf::from),
        fingerprint: header.fingerprint,
        time: time.unwrap_or(SystemTime::UNIX_EPOCH),
        revision: header.revision,
    };
    let document = PROJECT.read(project)?.into_document();
    Ok((origin, document.map_err(Problem::Match)?))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::document::Curve;
    use crate::io::examples::EXAMPLES;

    fn document() -> Document {
        Document::from_curves(EXAMPLES[0].read().expect("an example").curves)
    }

    fn origin() -> Origin {
        Origin {
            path: Some(Path::new("/curves/hull “1”.batten").to_owned()),
            fingerprint: Some(Fingerprint::of(b"what was read")),
            time: SystemTime::UNIX_EPOCH + Duration::from_secs(1_800_000_000),
            revision: 7,
        }
    }

    fn curves(document: &Document) -> Vec<&Curve> {
        document.curves().map(|(_, curve)| &**curve).collect()
    }

    #[test]
    fn what_is_written_is_read_again() {
        let untitled = Origin {
            path: None,
            fingerprint: None,
            ..origin()
        };
        for origin in [origin(), untitled] {
            for document in [document(), Document::default()] {
                let bytes = write(&origin, &document).expect("an autosave");
                let (read_origin, read) = read(&bytes).expect("what was written");
                assert_eq!(read_origin, origin);
                assert_eq!(curves(&read), curves(&document));
            }
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_path_that_is_not_unicode_is_kept() {
        use std::os::unix::ffi::OsStringExt;
        let path = PathBuf::from(std::ffi::OsString::from_vec(
            b"/curves/\xff.batten".to_vec(),
        ));
        let origin = Origin {
            path: Some(path),
            ..origin()
        };
        let bytes = write(&origin, &document()).expect("an autosave");
        assert_eq!(read(&bytes).expect("what was written").0, origin);
    }

    #[test]
    fn every_shortened_autosave_is_refused() {
        let bytes = write(&origin(), &document()).expect("an autosave");
        let end = bytes.trim_ascii_end().len();
        for length in 0..end {
            assert!(read(&bytes[..length]).is_err(), "{length} of {end} bytes");
        }
    }
}
