//! Sessions: what each running window keeps in the user's state folder, so that nothing is lost
//! when it ends badly, and other windows know of it.
//!
//! A session is a folder with three files: a lock, held as long as the program runs; the autosave,
//! while something is not saved; and the path of the file that is open. A session whose lock nobody
//! holds was abandoned: the program was killed, or the machine stopped.

use std::path::{Path, PathBuf};

use etcetera::BaseStrategy;

use super::autosave::{self, Origin};
use super::disk::{self, FileLock};
use super::error::{FileError, FileProblem};
use crate::document::Document;

/// The names of a session's files.
const LOCK: &str = "lock";
const AUTOSAVE: &str = "autosave";
const OPEN: &str = "open";

/// The folder that holds the sessions of all windows of a user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sessions(PathBuf);

/// A session of this program: its folder is locked until it is dropped.
#[derive(Debug)]
pub struct Session {
    folder: PathBuf,
    _lock: FileLock,
}

/// A session that ended without being closed, with an autosave. As long as this is held, no other
/// window finds it.
#[derive(Debug)]
pub struct AbandonedSession(Session);

impl Sessions {
    /// The sessions of the user who runs the program: in `batten/sessions` of the state folder that
    /// the system names (`XDG_STATE_HOME`), or of its data folder where there is none. `None` for a
    /// user without a home.
    pub fn of_user() -> Option<Self> {
        let strategy = etcetera::choose_base_strategy().ok()?;
        let folder = strategy.state_dir().unwrap_or_else(|| strategy.data_dir());
        Some(Self::in_folder(folder.join("batten").join("sessions")))
    }

    /// The sessions in a folder, which is made when it is needed.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self(folder)
    }

    /// Begin a session.
    ///
    /// # Errors
    /// [`FileError`] if the folder cannot be made or locked.
    pub fn begin(&self) -> Result<Session, FileError> {
        loop {
            let folder = disk::create_own_folder(&self.0).map_err(FileError::at(&self.0))?;
            // Until it is locked another program may take it for abandoned and remove it.
            match Session::locked(&folder) {
                Ok(Some(session)) if session.is_there() => return Ok(session),
                Err(error) if folder.is_dir() => return Err(error),
                Ok(_) | Err(_) => {}
            }
        }
    }

    /// Take hold of all sessions that were abandoned with an autosave. Those without one are removed.
    pub fn abandoned(&self) -> Vec<AbandonedSession> {
        let folders = disk::folders_in(&self.0).into_iter();
        let sessions = folders.filter_map(|folder| Session::locked(&folder).ok().flatten());
        // The others are removed as they are dropped.
        let abandoned = sessions.filter(Session::has_autosave);
        abandoned.map(AbandonedSession).collect()
    }

    /// Whether a window that runs, other than that of `own`, has a file open.
    pub fn has_open(&self, path: &Path, own: &Session) -> bool {
        let folders = disk::folders_in(&self.0).into_iter();
        let mut others = folders.filter(|folder| *folder != own.folder);
        others.any(|folder| {
            is_open_in(&folder, path)
                && disk::lock(&folder.join(LOCK)).is_ok_and(|lock| lock.is_none())
        })
    }
}

impl Session {
    /// Write the autosave, atomically.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written; what was there before is unchanged then.
    pub fn write_autosave(&self, origin: &Origin, document: &Document) -> Result<(), FileError> {
        let path = self.folder.join(AUTOSAVE);
        let bytes = autosave::write(origin, document).map_err(FileError::at(&path))?;
        disk::write_bytes(&path, &bytes).map_err(FileError::at(&path))?;
        Ok(())
    }

    /// Remove the autosave if there is one: nothing is unsaved.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be removed.
    pub fn remove_autosave(&self) -> Result<(), FileError> {
        let path = self.folder.join(AUTOSAVE);
        disk::remove_file(&path).map_err(FileError::at(&path))
    }

    /// Let other windows know which file is open; `None` if none is.
    ///
    /// # Errors
    /// [`FileError`] if that cannot be written.
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

    fn locked(folder: &Path) -> Result<Option<Self>, FileError> {
        let path = folder.join(LOCK);
        let lock = disk::lock(&path).map_err(FileError::at(&path))?;
        Ok(lock.map(|lock| Self {
            folder: folder.to_owned(),
            _lock: lock,
        }))
    }

    fn is_there(&self) -> bool {
        self.folder.join(LOCK).is_file()
    }

    fn has_autosave(&self) -> bool {
        self.folder.join(AUTOSAVE).is_file()
    }
}

impl Drop for Session {
    /// Leave nothing behind but an autosave.
    fn drop(&mut self) {
        if !self.has_autosave() {
            disk::remove_folder(&self.folder);
        }
    }
}

impl AbandonedSession {
    /// Where the autosave is.
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

/// Whether a session's folder tells that a file is open.
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

    /// What is left in the folder of sessions.
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
