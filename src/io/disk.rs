//! The disk: whole files read and written, the only place that touches them.
//!
//! A file is written beside its place and then moved there, so that at every moment either the
//! old or the new content is on the disk, whole.

use std::fmt;
use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use tempfile::NamedTempFile;

use super::error::{FileError, FileProblem, shown_path};
use super::exchange::drawing::Drawing;
use super::fingerprint::Fingerprint;
use super::format::Format;
use super::formats;
use super::loss::{Export, LossReport};
use super::original::Original;
use super::reading::{Reading, Remark};
use super::table_columns::ColumnChoice;
use crate::document::{Document, PictureSource, quoted};
use crate::geometry::PolygonKind;

/// The most bytes that are read: far more than any curve, far less than fills the memory.
const MOST_BYTES: u64 = 1 << 30;

/// How many symbolic links are followed, one behind the other.
const MOST_LINKS: usize = 32;

/// What the names of temporary files are made of: the prefix, random letters and digits, and the
/// suffix, a digit.
const PREFIX: &str = ".batten-";
const RANDOM: usize = 5;
const SUFFIX: &str = "0";

/// Read the curves of a file; its extension tells the format.
///
/// # Errors
/// [`FileError`], naming the file and the place in it.
pub fn read_file(path: &Path) -> Result<Reading, FileError> {
    let (reading, _) = read_with_fingerprint(path, None, None)?;
    Ok(reading)
}

/// Read the curves of a file as [`read_file`] does, with the fingerprint of its bytes; `format` is one that
/// is given, whatever the name, and `choice` names the columns of points.
///
/// # Errors
/// As [`read_file`].
pub fn read_with_fingerprint(
    path: &Path,
    format: Option<&Format>,
    choice: Option<&ColumnChoice>,
) -> Result<(Reading, Fingerprint), FileError> {
    let format = format.map_or_else(|| formats::to_read(path), Ok);
    let format = format.map_err(FileError::at(path))?;
    let bytes = read_bytes(path).map_err(FileError::at(path))?;
    let reading = format.read_columns(&bytes, choice);
    let mut reading = reading.map_err(FileError::at(path))?;
    place_pictures(&mut reading, path, format);
    Ok((reading, Fingerprint::of(&bytes)))
}

/// Keep the bytes of a file of another program with the document that was read from it; `None` if it is no such file, or
/// holds something else by now.
pub fn original(path: &Path, known: Fingerprint, document: &Document) -> Option<Original> {
    let format = formats::to_read(path).ok().filter(|it| it.draws())?;
    let bytes = read_bytes(path).ok()?;
    let is_known = Fingerprint::of(&bytes) == known;
    is_known.then(|| Original::new(format, bytes, document.clone()))
}

/// Read everything that a file of another program holds, with its format; `format` is one that is given, whatever the
/// name.
///
/// # Errors
/// As [`read_file`], also for formats that are no drawings.
pub fn draw_file(
    path: &Path,
    format: Option<&'static Format>,
) -> Result<(Drawing, &'static Format), FileError> {
    let format = format.map_or_else(|| formats::to_read(path), Ok);
    let format = format.map_err(FileError::at(path))?;
    let bytes = read_bytes(path).map_err(FileError::at(path))?;
    let drawing = format.draw(&bytes).map_err(FileError::at(path))?;
    Ok((drawing, format))
}

/// Read everything that a stream of another program's format holds; `name` is what messages call it.
///
/// # Errors
/// As [`read_stream`], also for formats that are no drawings.
pub fn draw_stream(stream: impl Read, name: &str, format: &Format) -> Result<Drawing, FileError> {
    let name = Path::new(name);
    let bytes = limited_bytes(stream, MOST_BYTES).map_err(FileError::at(name))?;
    format.draw(&bytes).map_err(FileError::at(name))
}

/// The fingerprint of what a file holds now; `None` if there is no such file, or it cannot be read.
pub fn fingerprint(path: &Path) -> Option<Fingerprint> {
    let bytes = read_bytes(path).ok()?;
    Some(Fingerprint::of(&bytes))
}

/// Read the curves of a stream to its end; `name` is what messages call it, `choice` names the columns of
/// points.
///
/// # Errors
/// [`FileError`], with the name and the place in the stream.
pub fn read_stream(
    stream: impl Read,
    name: &str,
    format: &Format,
    choice: Option<&ColumnChoice>,
) -> Result<Reading, FileError> {
    let name = Path::new(name);
    let bytes = limited_bytes(stream, MOST_BYTES).map_err(FileError::at(name))?;
    let reading = format.read_columns(&bytes, choice);
    reading.map_err(FileError::at(name))
}

/// The one path of an existing file, whatever the spelling and the links by which it is given.
pub fn canonical(path: &Path) -> Option<PathBuf> {
    fs::canonicalize(path).ok()
}

/// Whether two paths lead to one file that exists.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    canonical(a).is_some_and(|a| canonical(b) == Some(a))
}

/// The remarks on a written file. Shown as one line a remark.
#[derive(Clone, Debug, PartialEq)]
pub struct Saved {
    /// The losses of the format.
    pub losses: LossReport,
    /// How many other names (hard links) the old file had: they keep its content.
    pub other_names: u64,
    /// The fingerprint of the written bytes.
    pub fingerprint: Fingerprint,
}

impl Saved {
    /// Say which other names of the file keep the old content, if it had any.
    pub fn broken_links(&self) -> Option<String> {
        match self.other_names {
            0 => None,
            1 => Some(
                "the file had another name (a hard link), which keeps the old content".to_owned(),
            ),
            count => Some(format!(
                "the file had {count} other names (hard links), which keep the old content"
            )),
        }
    }
}

impl fmt::Display for Saved {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = [Some(self.losses.to_string()), self.broken_links()];
        let lines = lines.into_iter().flatten().filter(|line| !line.is_empty());
        formatter.write_str(&lines.collect::<Vec<_>>().join("\n"))
    }
}

/// Write a document to a file; its extension tells the format, and `polygon` means what it does to
/// [`Format::write`].
///
/// # Errors
/// [`FileError`], naming the file; an earlier file is unchanged then.
pub fn write_document(
    path: &Path,
    document: &Document,
    polygon: Option<PolygonKind>,
) -> Result<Saved, FileError> {
    let format = formats::to_write(path).map_err(FileError::at(path))?;
    let document = beside_pictures(document.clone(), path);
    let export = format.write(&document, polygon);
    write_export(path, export.map_err(FileError::at(path))?)
}

/// Name the pictures of a document from the folder of its file.
pub fn beside_pictures(document: Document, path: &Path) -> Document {
    let folder = home_of(path);
    // Between drives there is no relative path.
    let relative = |file: &Path| pathdiff::diff_paths(file, &folder).unwrap_or(file.to_owned());
    document.with_picture_files(relative)
}

/// Give the pictures of a file absolute paths: a project names them from its folder, and a picture is its own file.
fn place_pictures(reading: &mut Reading, path: &Path, format: &Format) {
    let folder = home_of(path);
    for reference in &mut reading.references {
        if reference.picture.is_none() {
            continue;
        }
        let reference = Arc::make_mut(reference);
        let Some(picture) = &mut reference.picture else {
            continue;
        };
        match &picture.source {
            PictureSource::File(file) => {
                let file = normal(&folder.join(file));
                if !file.is_file() {
                    let (name, file) = (quoted(&reference.name), shown_path(&file));
                    let told =
                        format!("The picture {name} is missing: relink it. There is no {file}");
                    reading.remarks.add(Remark::Drawn(told));
                }
                picture.source = PictureSource::File(file);
            }
            PictureSource::Embedded(_) if !format.holds_documents => {
                let name = path.file_name().unwrap_or_default();
                let stem = path.file_stem().unwrap_or(name);
                reference.name = stem.to_string_lossy().into_owned();
                picture.source = PictureSource::File(folder.join(name));
            }
            PictureSource::Embedded(_) => {}
        }
    }
}

/// The absolute folder of a file, even of one that is not there yet.
fn home_of(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(&path);
    canonical(folder).unwrap_or_else(|| folder.to_owned())
}

/// The path without steps back.
pub fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(normal.pop()),
            Component::CurDir => {}
            part => normal.push(part),
        }
    }
    normal
}

/// Read the bytes of a picture's file.
///
/// # Errors
/// [`FileError`], naming the file.
pub fn read_picture(path: &Path) -> Result<Vec<u8>, FileError> {
    read_bytes(path).map_err(FileError::at(path))
}

/// Write an export to a file.
///
/// # Errors
/// [`FileError`], naming the file; an earlier file is unchanged then.
pub fn write_export(path: &Path, export: Export) -> Result<Saved, FileError> {
    Ok(Saved {
        other_names: write_bytes(path, &export.bytes).map_err(FileError::at(path))?,
        losses: export.losses,
        fingerprint: Fingerprint::of(&export.bytes),
    })
}

/// Check that a file can be replaced by another content, without a change of it.
///
/// # Errors
/// [`FileError`], naming the file.
pub fn check_replaceable(path: &Path) -> Result<(), FileError> {
    let check = || -> Result<(), FileProblem> {
        let target = followed(path).map_err(FileProblem::system("find"))?;
        let metadata = fs::metadata(&target).map_err(FileProblem::system("find"))?;
        check_writable(path, metadata)?;
        beside(folder_of(&target)).map_err(FileProblem::system("write"))?;
        Ok(())
    };
    check().map_err(FileError::at(path))
}

/// The folder that a file is in.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Write bytes to a file, atomically: on failure what was there before is unchanged and nothing
/// else is left. An existing file keeps its permissions, and its owner and group where the
/// system allows it; where the path is a symbolic link, the file it points to is written.
/// Returns how many other names (hard links) the old file had: they keep its content.
///
/// What killed saves have left in the folder is removed.
pub(super) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<u64, FileProblem> {
    let (not_found, not_written) = (FileProblem::system("find"), FileProblem::system("write"));
    let target = followed(path).map_err(&not_found)?;
    let old = match fs::metadata(&target) {
        Ok(metadata) => Some(check_writable(path, metadata)?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(not_found(error)),
    };
    let folder = folder_of(&target);
    if !folder.is_dir() {
        return Err(FileProblem::NoFolder(folder.to_owned()));
    }
    remove_stale(folder);
    let mut temporary = beside(folder).map_err(&not_written)?;
    // The errors of the file itself do not name the temporary path.
    let file = temporary.as_file_mut();
    file.write_all(bytes).map_err(&not_written)?;
    if let Some(old) = &old {
        keep_owner(file, old);
        // After the owner: a change of owner can take permissions away.
        let kept = file.set_permissions(old.permissions());
        kept.map_err(&not_written)?;
    }
    file.sync_all().map_err(&not_written)?;
    let moved = temporary.persist(&target);
    moved.map_err(|error| not_written(error.error))?;
    // Where folders can be synchronised, this keeps the new name too; the content is safe.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(old.as_ref().map_or(0, other_names))
}

/// Read a whole file, unless it has more bytes than Batten reads.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, FileProblem> {
    read_at_most(path, MOST_BYTES)
}

/// A lock on a file: held until it is dropped or the process ends, however it ends.
#[derive(Debug)]
pub(super) struct FileLock(#[expect(dead_code, reason = "held, never read")] File);

/// Lock a file, which is made if it is not there; `None` if another holds the lock.
pub(super) fn lock(path: &Path) -> Result<Option<FileLock>, FileProblem> {
    let mut options = File::options();
    let file = options.create(true).truncate(false).write(true).open(path);
    let file = file.map_err(FileProblem::system("open"))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(FileLock(file))),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) => Err(FileProblem::system("lock")(error)),
    }
}

/// Create a folder, and those that it is in, where they are not there.
///
/// # Errors
/// [`FileError`], naming the folder.
pub fn create_folder(path: &Path) -> Result<(), FileError> {
    let created = fs::create_dir_all(path);
    created.map_err(|error| FileError::at(path)(FileProblem::Folder(error)))
}

/// Create a folder with a name of its own in another, which is made if it is not there.
pub(super) fn create_own_folder(parent: &Path) -> Result<PathBuf, FileProblem> {
    fs::create_dir_all(parent).map_err(FileProblem::system("create"))?;
    let folder = tempfile::Builder::new().prefix("").tempdir_in(parent);
    Ok(folder.map_err(FileProblem::system("create"))?.keep())
}

/// List the folders in a folder; none if it is not there.
pub(super) fn folders_in(parent: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(parent).into_iter().flatten().flatten();
    let folders = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    folders.map(|entry| entry.path()).collect()
}

/// Remove a file if it is there.
pub(super) fn remove_file(path: &Path) -> Result<(), FileProblem> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(FileProblem::system("remove")(error))
        }
        _ => Ok(()),
    }
}

/// Remove a folder with all that is in it, as far as the system allows.
pub(super) fn remove_folder(path: &Path) {
    let _ = fs::remove_dir_all(path);
}

/// Whether the program was started with a signal ignored, as `nohup` does with SIGHUP. Linux tells in
/// `/proc/self/status`; elsewhere the answer is `false`.
pub fn ignores_signal(signal: i32) -> bool {
    let status = read_bytes(Path::new("/proc/self/status")).unwrap_or_default();
    is_ignored_in(&String::from_utf8_lossy(&status), signal)
}

/// Whether a status of Linux lists a signal as ignored: bit n - 1 of a hexadecimal mask is signal n.
fn is_ignored_in(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    let bit = u32::try_from(signal.saturating_sub(1))
        .ok()
        .and_then(|n| 1_u64.checked_shl(n));
    mask.zip(bit).is_some_and(|(mask, bit)| mask & bit != 0)
}

fn read_at_most(path: &Path, most: u64) -> Result<Vec<u8>, FileProblem> {
    let file = File::open(path).map_err(FileProblem::system("read"))?;
    let metadata = file.metadata().map_err(FileProblem::system("read"))?;
    if metadata.is_dir() {
        return Err(FileProblem::IsFolder);
    }
    if metadata.len() > most {
        return Err(FileProblem::TooLarge(most));
    }
    // The file may grow, or not know its size: the limit holds for the bytes read.
    limited_bytes(file, most)
}

fn limited_bytes(stream: impl Read, most: u64) -> Result<Vec<u8>, FileProblem> {
    let mut bytes = Vec::new();
    let limited = stream.take(most + 1).read_to_end(&mut bytes);
    limited.map_err(FileProblem::system("read"))?;
    if bytes.len() as u64 > most {
        return Err(FileProblem::TooLarge(most));
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

fn check_writable(path: &Path, metadata: Metadata) -> Result<Metadata, FileProblem> {
    if metadata.is_dir() {
        return Err(FileProblem::IsFolder);
    }
    if !metadata.is_file() {
        return Err(FileProblem::IsDevice);
    }
    // A folder that may be written to lets a file be replaced that may not be.
    let opened = File::options().write(true).open(path);
    let refused = opened.is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied);
    if metadata.permissions().readonly() || refused {
        return Err(FileProblem::ReadOnly);
    }
    Ok(metadata)
}

/// Give a file the owner and the group of another, or the group alone, or neither: as far as the
/// system allows.
#[cfg(unix)]
fn keep_owner(file: &File, old: &Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    if fchown(file, Some(old.uid()), Some(old.gid())).is_err() {
        let _ = fchown(file, None, Some(old.gid()));
    }
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) {}

#[cfg(unix)]
fn other_names(metadata: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    metadata.nlink().saturating_sub(1)
}

#[cfg(not(unix))]
fn other_names(_: &Metadata) -> u64 {
    0
}

/// Create a temporary file in a folder. It is locked as long as it is open, which tells
/// [`remove_stale`] that it is in use.
fn beside(folder: &Path) -> io::Result<NamedTempFile> {
    loop {
        let temporary = tempfile::Builder::new()
            .prefix(PREFIX)
            .rand_bytes(RANDOM)
            .suffix(SUFFIX)
            .make_in(folder, |path| {
                // As for any new file: the user's mask takes from the permissions.
                File::create_new(path)
            })?;
        match temporary.as_file().try_lock() {
            Ok(()) if temporary.path().exists() => return Ok(temporary),
            // Where there are no locks, nobody takes the file for stale either.
            Err(TryLockError::Error(_)) => return Ok(temporary),
            // Between its creation and the lock it was taken for stale: another one is needed.
            Ok(()) | Err(TryLockError::WouldBlock) => {}
        }
    }
}

/// Remove the temporary files that killed saves have left in a folder: those that no process
/// has locked. What cannot be removed stays.
fn remove_stale(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let is_temporary = entry.file_name().to_str().is_some_and(is_temporary_name)
            && entry.file_type().is_ok_and(|kind| kind.is_file());
        if !is_temporary {
            continue;
        }
        let path = entry.path();
        // The lock is held until the file is gone, so that no process can begin to use it.
        let file = File::options().read(true).write(true).open(&path);
        if let Ok(file) = file
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(&path);
        }
    }
}

/// Whether a file's name is one that a save gives to its temporary file: six letters and digits
/// after the prefix, with a digit among them, so that no word is taken for one.
fn is_temporary_name(name: &str) -> bool {
    name.strip_prefix(PREFIX).is_some_and(|rest| {
        rest.len() == RANDOM + SUFFIX.len()
            && rest.bytes().all(|byte| byte.is_ascii_alphanumeric())
            && rest.bytes().any(|byte| byte.is_ascii_digit())
    })
}

#[cfg(test)]
mod tests;
