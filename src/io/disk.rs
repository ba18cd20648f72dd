//! The disk: whole files read and written, the only place that touches them.
//!
//! A file is written beside its place and then moved there, so that at every moment either the
//! old or the new content is on the disk, whole.

use std::borrow::Borrow;
use std::fs::{self, File, Metadata, Permissions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::error::FileError;
use super::format::Format;
use super::loss::LossReport;
use crate::document::Curve;
use crate::geometry::PolygonKind;

/// The most bytes that are read: far more than any curve, far less than fills the memory.
pub const MOST_BYTES: u64 = 1 << 30;

/// How many symbolic links are followed, one behind the other.
const MOST_LINKS: usize = 32;

/// Read the curves of a file; its extension tells the format.
///
/// # Errors
/// [`FileError`], naming the file and the place in it.
pub fn read_file(path: &Path) -> Result<Vec<Curve>, FileError> {
    let format = Format::to_read(path).map_err(|error| FileError::Format {
        path: path.to_owned(),
        error,
    })?;
    let bytes = read_bytes(path, MOST_BYTES)?;
    format.read(&bytes).map_err(|error| FileError::Content {
        path: path.to_owned(),
        error,
    })
}

/// Whether two paths lead to one file that exists.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let canonical = |path: &Path| std::fs::canonicalize(path).ok();
    canonical(a).is_some_and(|a| canonical(b) == Some(a))
}

/// Write curves to a file; its extension tells the format, and `polygon` means what it does to
/// [`Format::write`]. Returns what the format could not hold.
///
/// # Errors
/// [`FileError`], naming the file; what was there before is unchanged then.
pub fn write_file<C: Borrow<Curve>>(
    path: &Path,
    curves: &[C],
    polygon: Option<PolygonKind>,
) -> Result<LossReport, FileError> {
    let format = Format::to_write(path).map_err(|error| FileError::Format {
        path: path.to_owned(),
        error,
    })?;
    let export = format.write(curves, polygon);
    let export = export.map_err(|error| FileError::Export {
        path: path.to_owned(),
        error,
    })?;
    write_bytes(path, &export.bytes)?;
    Ok(export.losses)
}

/// Write bytes to a file, atomically: on failure what was there before is unchanged and nothing
/// else is left behind. An existing file keeps its permissions; where the path is a symbolic
/// link, the file it points to is written.
///
/// # Errors
/// [`FileError`], naming the file.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |action| {
        move |error| FileError::System {
            path: path.to_owned(),
            action,
            error,
        }
    };
    let target = followed(path).map_err(failed("find"))?;
    let permissions = match fs::metadata(&target) {
        Ok(metadata) => Some(writable_permissions(path, &metadata)?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(failed("find")(error)),
    };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(FileError::NoFolder {
            path: path.to_owned(),
            folder: folder.to_owned(),
        });
    }
    let mut temporary = beside(folder).map_err(failed("write"))?;
    temporary.write_all(bytes).map_err(failed("write"))?;
    let file = temporary.as_file();
    if let Some(permissions) = permissions {
        file.set_permissions(permissions).map_err(failed("write"))?;
    }
    file.sync_all().map_err(failed("write"))?;
    let moved = temporary.persist(&target);
    moved.map_err(|error| failed("write")(error.error))?;
    // Where folders can be synchronised, this keeps the new name too; the content is safe.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, FileError> {
    let failed = |error| FileError::System {
        path: path.to_owned(),
        action: "read",
        error,
    };
    let too_large = || FileError::TooLarge {
        path: path.to_owned(),
        most,
    };
    let file = File::open(path).map_err(failed)?;
    let metadata = file.metadata().map_err(failed)?;
    if metadata.is_dir() {
        return Err(FileError::NotAFile {
            path: path.to_owned(),
        });
    }
    if metadata.len() > most {
        return Err(too_large());
    }
    // The file may grow, or not know its size: the limit holds for what is read.
    let mut bytes = Vec::new();
    let limited = file.take(most + 1).read_to_end(&mut bytes);
    limited.map_err(failed)?;
    if bytes.len() as u64 > most {
        return Err(too_large());
    }
    Ok(bytes)
}

/// Follow symbolic links to where the file is, or would be: the last one may point nowhere yet.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        let is_link = fs::symlink_metadata(&target).is_ok_and(|metadata| metadata.is_symlink());
        if !is_link {
            return Ok(target);
        }
        let next = fs::read_link(&target)?;
        target = match target.parent() {
            Some(folder) => folder.join(next),
            None => next,
        };
    }
    Err(io::Error::other("too many symbolic links"))
}

fn writable_permissions(path: &Path, metadata: &Metadata) -> Result<Permissions, FileError> {
    let path = || path.to_owned();
    if !metadata.is_file() {
        return Err(FileError::NotAFile { path: path() });
    }
    let permissions = metadata.permissions();
    if permissions.readonly() {
        return Err(FileError::ReadOnly { path: path() });
    }
    Ok(permissions)
}

fn beside(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".batten-");
    #[cfg(unix)]
    {
        // As for any new file: the user's mask takes from this what it does not allow.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    fn curve() -> Curve {
        let points = [(0.0, 0.1), (1.0, 2.0), (3.0, 1e-300), (4.0, 0.0)];
        Curve::new("arc", FloatPolygon::planar(3, &points).unwrap())
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_written_whole_and_read_back() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.batten", "b.CSV"] {
            let path = folder.path().join(name);
            let losses = write_file(&path, &[curve()], None).unwrap();
            assert!(losses.is_empty(), "{losses}");
            assert_eq!(read_file(&path).unwrap(), [curve()]);
        }
        assert_eq!(names(folder.path()), ["a.batten", "b.CSV"]);
    }

    #[test]
    fn what_cannot_be_read_or_written_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let check = |result: Result<(), FileError>, name: &str, expected: &str| {
            let path = folder.path().join(name);
            let message = result.unwrap_err().to_string();
            let expected = format!("{}: {expected}", path.display());
            assert!(
                message.starts_with(&expected),
                "{message}\nis not\n{expected}"
            );
        };
        let read = |name: &str| read_file(&folder.path().join(name)).map(|_| ());
        let write =
            |name: &str| write_file(&folder.path().join(name), &[curve()], None).map(|_| ());
        fs::create_dir(folder.path().join("folder.csv")).unwrap();
        fs::write(folder.path().join("bad.batten"), "{").unwrap();
        check(read("gone.batten"), "gone.batten", "cannot read the file: ");
        check(read("folder.csv"), "folder.csv", "this is not a file");
        check(write("folder.csv"), "folder.csv", "this is not a file");
        check(
            read("a.txt"),
            "a.txt",
            "“.txt” is not a format Batten knows",
        );
        check(write("a"), "a", "the name has no extension");
        check(read("bad.batten"), "bad.batten", "line 1, column 1: EOF");
        check(write("no/a.csv"), "no/a.csv", "the folder ");
        let none: [Curve; 0] = [];
        let result = write_file(&folder.path().join("a.dxf"), &none, None);
        check(result.map(|_| ()), "a.dxf", "there is no curve to write");
        assert_eq!(names(folder.path()), ["bad.batten", "folder.csv"]);
    }

    #[test]
    fn a_file_that_is_too_large_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("huge.batten");
        // The file takes no room: it consists of a hole.
        File::create(&path)
            .unwrap()
            .set_len(MOST_BYTES + 1)
            .unwrap();
        let message = read_file(&path).unwrap_err().to_string();
        assert!(
            message.ends_with("larger than 1024 MiB, the most that Batten reads"),
            "{message}"
        );
        fs::write(&path, [b' '; 11]).unwrap();
        assert_eq!(read_bytes(&path, 11).unwrap().len(), 11);
        assert!(matches!(
            read_bytes(&path, 10),
            Err(FileError::TooLarge { .. })
        ));
    }

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{PermissionsExt, symlink};

        use super::*;

        fn mode(path: &Path) -> u32 {
            fs::metadata(path).unwrap().permissions().mode() & 0o777
        }

        #[test]
        fn permissions_are_kept() {
            let folder = tempfile::tempdir().unwrap();
            let (new, plain) = (folder.path().join("new.csv"), folder.path().join("plain"));
            write_bytes(&new, b"1").unwrap();
            File::create(&plain).unwrap();
            assert_eq!(mode(&new), mode(&plain), "as any new file");
            fs::set_permissions(&new, Permissions::from_mode(0o640)).unwrap();
            write_bytes(&new, b"2").unwrap();
            assert_eq!(
                (mode(&new), fs::read(&new).unwrap()),
                (0o640, b"2".to_vec())
            );
            fs::set_permissions(&new, Permissions::from_mode(0o444)).unwrap();
            let result = write_bytes(&new, b"3");
            assert!(
                matches!(result, Err(FileError::ReadOnly { .. })),
                "{result:?}"
            );
            assert_eq!(fs::read(&new).unwrap(), b"2");
        }

        #[test]
        fn links_are_followed() {
            let folder = tempfile::tempdir().unwrap();
            fs::create_dir(folder.path().join("inner")).unwrap();
            let (link, second) = (folder.path().join("link.csv"), folder.path().join("second"));
            let real = folder.path().join("inner/real.csv");
            symlink("inner/real.csv", &second).unwrap();
            symlink("second", &link).unwrap();
            for content in [b"new", b"old"] {
                write_bytes(&link, content).unwrap();
                assert!(link.is_symlink() && second.is_symlink() && !real.is_symlink());
                assert_eq!(fs::read(&real).unwrap(), content);
            }
            let circle = folder.path().join("circle");
            symlink("circle", &circle).unwrap();
            assert!(matches!(
                write_bytes(&circle, b"x"),
                Err(FileError::System { .. })
            ));
        }
    }
}
