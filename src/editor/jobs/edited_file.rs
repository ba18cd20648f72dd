//! The file of another program that is edited: saving writes the curves back in the format of the file.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::document::Document;
use crate::io::{Format, Original, Rest, WriteError, WrittenBack, formats};

/// So many kinds of what is lost are named, and one more where that is the last.
const NAMED: usize = 5;

/// The file that the program was started to edit.
#[derive(Clone, Debug)]
pub struct EditedFile {
    path: PathBuf,
    /// Whether the file holds nothing but curves.
    is_alone: bool,
    /// Its content when it was opened, if changes can be written into that.
    original: Option<Arc<Original>>,
    /// Whether the user has accepted the losses.
    is_accepted: bool,
    /// Whether the file was saved at least once.
    is_saved: Arc<AtomicBool>,
}

impl EditedFile {
    /// Edit a file. `is_alone` promises that it holds nothing but curves.
    pub fn new(path: &Path, is_alone: bool) -> Self {
        Self {
            path: path.to_owned(),
            is_alone,
            original: None,
            is_accepted: false,
            is_saved: Arc::default(),
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether its format can hold less than a document: saving then loses something.
    pub fn is_foreign(&self) -> bool {
        !formats::to_write(&self.path).is_ok_and(|format| format.holds_documents)
    }

    /// Set the content into which changes are written.
    pub(in crate::editor) fn set_original(&mut self, original: Option<Original>) {
        self.original = original.map(Arc::new);
    }

    /// What a document becomes in the file.
    ///
    /// # Errors
    /// [`WriteError`] if the format cannot hold it.
    pub(super) fn written(
        &self,
        format: &Format,
        document: &Document,
    ) -> Result<WrittenBack, WriteError> {
        match &self.original {
            Some(original) => original.written_back(document),
            None => Ok(WrittenBack {
                export: format.write_back(document)?,
                rest: Rest::Lost(None),
            }),
        }
    }

    /// A flag that tells, also after the window is gone, whether the file was saved.
    pub fn saved_flag(&self) -> Arc<AtomicBool> {
        self.is_saved.clone()
    }

    pub(in crate::editor) fn mark_saved(&self) {
        self.is_saved.store(true, Ordering::Relaxed);
    }

    pub(in crate::editor) fn accept_losses(&mut self) {
        self.is_accepted = true;
    }

    /// The losses that the user must accept before the first save: one line each.
    pub(super) fn losses_to_accept(
        &self,
        format: &Format,
        document: &Document,
        WrittenBack { export, rest }: &WrittenBack,
    ) -> Vec<String> {
        if self.is_accepted {
            return Vec::new();
        }
        let rest = match rest {
            Rest::Lost(why) if format.draws() && !self.is_alone => {
                let original = self.original.as_ref();
                let others = original.map(|original| original.others());
                let why = why.as_ref().map(|why| format!(": {why}"));
                let why = why.map(|why| format!("The {format} cannot be changed in place{why}."));
                let lost = format!(
                    "Once saved, the {format} holds the curves alone: {} and styles are lost.",
                    listed(&others.unwrap_or_default())
                );
                why.into_iter().chain([lost]).collect()
            }
            _ => Vec::new(),
        };
        let mut losses = export.losses.clone();
        losses.take_rounding(document);
        let lines = losses.to_string();
        let lines = lines.lines().map(str::to_owned);
        rest.into_iter().chain(lines).collect()
    }
}

/// List what is lost, the first few kinds by name.
fn listed(what: &[String]) -> String {
    match (what, what.get(NAMED..)) {
        ([], _) => "other entities".to_owned(),
        (_, Some([_, _, ..])) => {
            let others = what.len() - NAMED;
            format!("{} and {others} other kinds", what[..NAMED].join(", "))
        }
        _ => what.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lost_is_named_as_far_as_it_is_short() {
        let kinds = |count: usize| -> Vec<String> {
            (1..=count)
                .map(|index| format!("{index} K{index}"))
                .collect()
        };
        assert_eq!(listed(&[]), "other entities");
        assert_eq!(listed(&kinds(2)), "1 K1, 2 K2");
        assert_eq!(listed(&kinds(6)), "1 K1, 2 K2, 3 K3, 4 K4, 5 K5, 6 K6");
        assert_eq!(
            listed(&kinds(7)),
            "1 K1, 2 K2, 3 K3, 4 K4, 5 K5 and 2 other kinds"
        );
    }
}
