//! Unsaved documents of earlier sessions, with a small picture.

use std::path::PathBuf;
use std::time::SystemTime;

use glam::{DVec2, DVec3};

use crate::document::{Curve, Document};
use crate::io::autosave::Origin;
use crate::io::{AbandonedSession, FileError, Sessions, disk};

/// The chords of a curve in a small picture: enough to look smooth at its size.
const CHORDS: usize = 120;

/// An autosave of an earlier session.
#[derive(Debug)]
pub struct Recoverable {
    /// Its number among the others.
    pub id: usize,
    /// Its document, or the reason why it cannot be read.
    pub content: Result<RecoverableDocument, FileError>,
    pub(in crate::editor) session: AbandonedSession,
}

/// An unsaved document of an earlier session.
#[derive(Debug)]
pub struct RecoverableDocument {
    /// The name of its file; `None` if it was never saved.
    pub name: Option<String>,
    /// The time of the autosave.
    pub time: SystemTime,
    /// Whether its file has changed since.
    pub is_file_changed: bool,
    /// The number of its curves.
    pub curves: usize,
    /// The number of their vertices.
    pub vertices: usize,
    /// Its visible curves as chains of points, seen along the axis in which they extend least.
    pub picture: Vec<Vec<DVec2>>,
    pub(in crate::editor) origin: Origin,
    pub(in crate::editor) document: Document,
}

impl Recoverable {
    /// Find and read the autosaves of earlier sessions: the newest first, damaged ones last.
    pub fn find(sessions: &Sessions) -> Vec<Self> {
        let found = sessions.abandoned().into_iter();
        let mut found: Vec<Self> = found.map(Self::new).collect();
        found.sort_by_key(|recoverable| {
            let time = recoverable.content.as_ref().map(|content| content.time);
            std::cmp::Reverse(time.ok())
        });
        for (id, recoverable) in found.iter_mut().enumerate() {
            recoverable.id = id;
        }
        found
    }

    /// The folder with all sessions.
    pub fn folder(&self) -> PathBuf {
        let autosave = self.session.path();
        let folder = autosave.ancestors().nth(2);
        folder.unwrap_or(&autosave).to_owned()
    }

    fn new(session: AbandonedSession) -> Self {
        let read = session.read();
        Self {
            id: 0,
            content: read.map(|(origin, document)| RecoverableDocument::new(origin, document)),
            session,
        }
    }
}

impl RecoverableDocument {
    fn new(origin: Origin, document: Document) -> Self {
        let name = origin.path.as_deref().and_then(|path| path.file_name());
        let found = origin.path.as_deref().and_then(disk::fingerprint);
        let is_file_changed = found.is_some() && found != origin.fingerprint;
        let vertices = document
            .curves()
            .map(|(_, curve)| curve.polygon.vertices().len());
        Self {
            name: name.map(|name| name.to_string_lossy().into_owned()),
            time: origin.time,
            is_file_changed,
            curves: document.curves().count(),
            vertices: vertices.sum(),
            picture: picture(&document),
            origin,
            document,
        }
    }
}

/// The visible curves as chains, without the coordinate in which they extend least.
fn picture(document: &Document) -> Vec<Vec<DVec2>> {
    let visible = document.curves().filter(|(_, curve)| curve.visible);
    let chains: Vec<Vec<DVec3>> = visible.map(|(_, curve)| chain(curve)).collect();
    let points = || chains.iter().flatten();
    let least = points().copied().reduce(DVec3::min).unwrap_or_default();
    let most = points().copied().reduce(DVec3::max).unwrap_or_default();
    let extent = most - least;
    let flat = |point: &DVec3| match extent.min_position() {
        0 => DVec2::new(point.y, point.z),
        1 => DVec2::new(point.x, point.z),
        _ => point.truncate(),
    };
    let chains = chains.iter();
    chains
        .map(|chain| chain.iter().map(flat).collect())
        .collect()
}

fn chain(curve: &Curve) -> Vec<DVec3> {
    let end = curve.polygon.segments() as f64;
    let share = |index: usize| index as f64 / CHORDS as f64;
    let chords = 0..=CHORDS;
    chords
        .map(|index| curve.polygon.point(end * share(index)))
        .collect()
}
