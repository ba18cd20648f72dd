//! Sessions: the files that each window keeps in the user's state folder, for recovery after a crash
//! and for other windows.
//!
//! A session is a folder with four files: two locks, held as long as the program runs; the autosave,
//! while something is unsaved; and the path of the open file. A session whose first lock is free was
//! abandoned: the program was killed, or the machine stopped.

use std::path::{Path, PathBuf};

use etcetera::BaseStrategy;

use super::autosave::{self, Origin};
use super::disk::{self, FileLock};
use super::error::{FileError, FileProblem};
use crate::document::Document;

/// The lock of the session's owner: the window that runs it, or the window that recovers it.
const LOCK: &str = "lock";

/// The lock that other windows try in order to see whether the session runs. It is a second one, so
/// that a look never hides an abandoned session from a window that starts at that moment.
const RUNNING: &str = "running";

const AUTOSAVE: &str = "autosave";
const OPEN: &str = "open";

/// The folder with the sessions of all windows of a user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sessions(PathBuf);

/// A session whose folder is locked until the value is dropped.
#[derive(Debug)]
pub struct Session {
    folder: PathBuf,
    _lock: FileLock,
    /// Held by a session of this program, not by one that it recovers.
    _running: Option<FileLock>,
}

/// A session with an autosave whose program has ended. No other window finds it while this is held.
#[derive(Debug)]
pub struct AbandonedSession(Session);

impl Sessions {
    /// The sessions of the user who runs the program, in `batten/sessions` of the system's state folder
    /// (`XDG_STATE_HOME`), or of its data folder without one. `None` for a user without a home.
    pub fn of_user() -> Option<Self> {
        let strategy = etcetera::choose_base_strategy().ok()?;
        let folder = strategy.state_dir().unwrap_or_else(|| strategy.data_dir());
        Some(Self::in_folder(folder.join("batten").join("sessions")))
    }

    /// The sessions in a folder. The first session creates it.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self(folder)
    }

    /// Begin a session.
    ///
    /// # Errors
    /// [`FileError`] if the folder cannot be created or locked; nothing is left behind then.
    pub fn begin(&self) -> Result<Session, FileError> {
        self.begin_with(disk::lock)
    }

    /// Find all abandoned sessions with an autosave and hold them. Abandoned sessions without one are
    /// removed.
    pub fn abandoned(&self) -> Vec<AbandonedSession> {
        let folders = disk::folders_in(&self.0).into_iter();
        let sessions = folders.filter_map(|folder| {
            let lock = lock_in(&folder, LOCK, disk::lock).ok().flatten()?;
            Some(Session {
                folder,
                _lock: lock,
                _running: None,
            })
        });
        // The others are removed as they are dropped.
        let abandoned = sessions.filter(Session::has_autosave);
        abandoned.map(AbandonedSession).collect()
    }

    /// Whether another running window than that of `own` has a file open.
    pub fn has_open(&self, path: &Path, own: &Session) -> bool {
        let folders = disk::folders_in(&self.0).into_iter();
        let mut others = folders.filter(|folder| *folder != own.folder);
        others.any(|folder| {
            is_open_in(&folder, path)
                && lock_in(&folder, RUNNING, disk::lock).is_ok_and(|lock| lock.is_none())
        })
    }

    fn begin_with(&self, lock: Lock) -> Result<Session, FileError> {
        loop {
            let folder = disk::create_own_folder(&self.0).map_err(FileError::at(&self.0))?;
            let locked = lock_in(&folder, LOCK, lock)
                .and_then(|first| Ok(first.zip(lock_in(&folder, RUNNING, lock)?)));
            // Until it is locked another program may take it for abandoned and remove it.
            match locked {
                Ok(Some((lock, running))) if folder.join(LOCK).is_file() => {
                    return Ok(Session {
                        folder,
                        _lock: lock,
                        _running: Some(running),
                    });
                }
                Err(error) if folder.is_dir() => {
                    disk::remove_folder(&folder);
                    return Err(error);
                }
                Ok(_) | Err(_) => {}
            }
        }
    }
}

/// Take a lock on a file; `None` if another program holds it.
type Lock = fn(&Path) -> Result<Option<FileLock>, FileProblem>;

fn lock_in(folder: &Path, name: &str, lock: Lock) -> Result<Option<FileLock>, FileError> {
    let path = folder.join(name);
    lock(&path).map_err(FileError::at(&path))
}

impl Session {
    /// Write the autosave, atomically.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written; the autosave before is unchanged then.
    pub fn write_autosave(&self, origin: &Origin, document: &Document) -> Result<(), FileError> {
        let path = self.folder.join(AUTOSAVE);
        let bytes = autosave::write(origin, document).map_err(FileError::at(&path))?;
        disk::write_bytes(&path, &bytes).map_err(FileError::at(&path))?;
        Ok(())
    }

    /// Remove the autosave if there is one.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be removed.
    pub fn remove_autosave(&self) -> Result<(), FileError> {
        let path = self.folder.join(AUTOSAVE);
        disk::remove_file(&path).map_err(FileError::at(&path))
    }

    /// Tell other windows which file is open; `None` if none is.
    ///
    /// # Errors
    /// [`FileError`] if the path cannot be written.
    pub fn tell_open(&self, path: Option<&Path>) -> Result<(), FileError> {
        let register = self.folder.join(OPEN);
        let told = match path {
            Some(path) => {
                let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
                let text = serde_json::json!(path.as_os_str()).to_string();
                disk::write_bytes(&register, text.as_bytes()).map(|_| ())
            }
            None => disk::remove_file(&register),
        };
        told.map_err(FileError::at(&register))
    }

    fn has_autosave(&self) -> bool {
        self.folder.join(AUTOSAVE).is_file()
    }
}

impl Drop for Session {
    /// Remove the folder, unless it holds an autosave.
    fn drop(&mut self) {
        if !self.has_autosave() {
            disk::remove_folder(&self.folder);
        }
    }
}

impl AbandonedSession {
    /// The path of the autosave.
    pub fn path(&self) -> PathBuf {
        self.0.folder.join(AUTOSAVE)
    }

    /// Read the autosave.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be read, or is damaged.
    pub fn read(&self) -> Result<(Origin, Document), FileError> {
        let path = self.path();
        let read = || autosave::read(&disk::read_bytes(&path)?).map_err(FileProblem::from);
        read().map_err(FileError::at(&path))
    }

    /// Remove the session with its autosave.
    pub fn remove(self) {
        disk::remove_folder(&self.0.folder);
    }
}

/// Whether a session's folder names a file as open.
fn is_open_in(folder: &Path, path: &Path) -> bool {
    let told = disk::read_bytes(&folder.join(OPEN)).ok();
    let told = told.and_then(|bytes| serde_json::from_slice::<std::ffi::OsString>(&bytes).ok());
    told.is_some_and(|open| disk::is_same_file(Path::new(&open), path))
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

    use super::*;

    fn sessions() -> (tempfile::TempDir, Sessions) {
        let folder = tempfile::tempdir().expect("a folder");
        let sessions = Sessions::in_folder(folder.path().join("state").join("sessions"));
        (folder, sessions)
    }

    fn write_autosave(session: &Session) {
        let origin = Origin {
            path: None,
            fingerprint: None,
            time: SystemTime::UNIX_EPOCH,
            revision: 1,
        };
        let written = session.write_autosave(&origin, &Document::default());
        written.expect("an autosave");
    }

    /// The number of folders that are left.
    fn left(sessions: &Sessions) -> usize {
        disk::folders_in(&sessions.0).len()
    }

    #[test]
    fn a_session_leaves_nothing_but_an_autosave() {
        let (_folder, sessions) = sessions();
        drop(sessions.begin().expect("a session"));
        assert_eq!(left(&sessions), 0);
        let session = sessions.begin().expect("a session");
        session
            .tell_open(Some(Path::new("a.batten")))
            .expect("told");
        write_autosave(&session);
        session.remove_autosave().expect("removed");
        session.remove_autosave().expect("there is none");
        drop(session);
        assert_eq!(left(&sessions), 0);
    }

    #[test]
    fn only_abandoned_sessions_are_found_and_only_once() {
        let (_folder, sessions) = sessions();
        assert!(sessions.abandoned().is_empty(), "no folder yet");
        let running = sessions.begin().expect("a session");
        write_autosave(&running);
        for _ in 0..3 {
            write_autosave(&sessions.begin().expect("a session"));
        }
        let found = sessions.abandoned();
        assert_eq!(found.len(), 3);
        assert!(sessions.abandoned().is_empty(), "another window has them");
        let mut found = found.into_iter();
        found.next().expect("the first").remove();
        drop(found);
        assert_eq!(
            sessions.abandoned().len(),
            2,
            "the others are left for later"
        );
        drop(running);
        assert_eq!(sessions.abandoned().len(), 3);
    }

    #[test]
    fn without_locks_no_folder_is_left_behind() {
        let (_folder, sessions) = sessions();
        let unsupported = |_: &Path| {
            let error = std::io::Error::from(std::io::ErrorKind::Unsupported);
            Err(FileProblem::system("lock")(error))
        };
        for _ in 0..2 {
            let error = sessions.begin_with(unsupported).expect_err("no locks");
            assert!(error.to_string().contains("lock"), "{error}");
        }
        assert_eq!(left(&sessions), 0);
    }

    #[test]
    fn a_window_that_looks_for_open_files_hides_no_abandoned_session() {
        let (folder, sessions) = sessions();
        let file = folder.path().join("a.batten");
        disk::write_bytes(&file, b"").expect("a file");
        let own = sessions.begin().expect("a session");
        let crashed = sessions.begin().expect("a session");
        crashed.tell_open(Some(&file)).expect("told");
        write_autosave(&crashed);
        let probed = crashed.folder.clone();
        drop(crashed);
        // Another window is in the middle of its look.
        let look = lock_in(&probed, RUNNING, disk::lock).expect("a lock");
        assert!(look.is_some(), "the session does not run");
        let found = sessions.abandoned();
        assert_eq!(found.len(), 1);
        drop(look);
        // A window that recovers a document does not count as one that has its file open.
        assert!(!sessions.has_open(&file, &own));
    }

    #[test]
    fn a_damaged_autosave_is_found_and_says_so() {
        let (_folder, sessions) = sessions();
        let session = sessions.begin().expect("a session");
        write_autosave(&session);
        let path = session.folder.join(AUTOSAVE);
        drop(session);
        disk::write_bytes(&path, b"{").expect("damage");
        let found = sessions.abandoned();
        let error = found[0].read().expect_err("damaged").to_string();
        assert!(error.contains("line 1"), "{error}");
        assert!(error.starts_with(&path.display().to_string()), "{error}");
    }

    #[test]
    fn a_file_that_another_window_has_open_is_known() {
        let (folder, sessions) = sessions();
        let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
        for path in [&one, &two] {
            disk::write_bytes(path, b"").expect("a file");
        }
        let own = sessions.begin().expect("a session");
        own.tell_open(Some(&one)).expect("told");
        assert!(!sessions.has_open(&one, &own), "only this window has it");
        let other = sessions.begin().expect("a session");
        other.tell_open(Some(&one)).expect("told");
        assert!(sessions.has_open(&one, &own) && !sessions.has_open(&two, &own));
        other.tell_open(None).expect("told");
        assert!(!sessions.has_open(&one, &own));
        other.tell_open(Some(&two)).expect("told");
        assert!(sessions.has_open(&two, &own));
        write_autosave(&other);
        drop(other);
        assert!(!sessions.has_open(&two, &own), "the other window is gone");
    }
}
