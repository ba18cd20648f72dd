//! Pictures, read and decoded one after the other on a thread.

use std::path::Path;
use std::sync::Arc;

use super::Client;
use super::pyramid::Pyramid;
use crate::document::{Document, Picture, PictureSource};
use crate::io::{decode, disk};

/// A picture, or the reason why it cannot be shown.
pub type LoadedPicture = Result<Arc<Pyramid>, String>;

/// Hold the pictures of a document that are decoded.
#[derive(Debug, Default)]
pub struct Pictures {
    loading: Client<PictureSource, LoadedPicture>,
    loaded: Vec<(PictureSource, LoadedPicture)>,
}

impl Pictures {
    /// Decode on a thread, which calls `wake` when a picture is there.
    pub fn background(wake: impl Fn() + Clone + Send + 'static) -> Self {
        Self {
            loading: Client::background("pictures", wake),
            ..Self::default()
        }
    }

    /// Forget what the document has no longer, take what is decoded, and decode the next one.
    pub fn update(&mut self, document: &Document) {
        let used = || {
            document
                .references()
                .filter_map(|(_, it)| it.picture.as_ref())
        };
        self.loaded
            .retain(|(source, _)| used().any(|it| it.source == *source));
        self.loading.receive();
        loop {
            self.take();
            let is_new = |it: &&Picture| self.get(&it.source).is_none();
            let next = used().find(is_new).map(|it| it.source.clone());
            let has_next = next.is_some();
            let job = |source: PictureSource| move |_: &_| Some(load(&source));
            self.loading.advance(next, None, job);
            if !has_next || self.loading.watched().is_some() {
                return;
            }
        }
    }

    /// The picture from a source, if it is there yet.
    pub fn get(&self, source: &PictureSource) -> Option<&LoadedPicture> {
        let mut loaded = self.loaded.iter();
        loaded.find(|(own, _)| own == source).map(|(_, it)| it)
    }

    /// Read a file once more, and those that could not be read.
    pub fn read_again(&mut self, path: &Path) {
        let is_that =
            |source: &PictureSource| matches!(source, PictureSource::File(it) if it == path);
        self.loaded
            .retain(|(source, picture)| picture.is_ok() && !is_that(source));
    }

    fn take(&mut self) {
        let Some(source) = self.loading.request().cloned() else {
            return;
        };
        let failed = self.loading.failure().map(|reason| Err(reason.to_owned()));
        if let Some(picture) = self.loading.take_result().or(failed) {
            self.loading.forget();
            self.loaded.push((source, picture));
        }
    }
}

fn load(source: &PictureSource) -> LoadedPicture {
    let decoded = match source {
        PictureSource::Embedded(bytes) => decode(bytes),
        PictureSource::File(path) => {
            let bytes = disk::read_picture(path);
            decode(&bytes.map_err(|error| error.to_string())?)
        }
    };
    let decoded = decoded.map_err(|problem| problem.to_string())?;
    Ok(Arc::new(Pyramid::of(decoded)))
}
