//! Asking for files: the system's dialogs where there are any, otherwise a field for the path.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{Align2, Context, Id, Key, Label, RichText, TextEdit, Ui, vec2};
use rfd::FileDialog;

use super::theme::{ROW, Tokens};
use super::widgets;
use crate::document::quoted;
use crate::editor::with_extension;
use crate::io::{ExportChoice, Format, PICTURE, PROJECT, formats, shown_path};
use crate::paper::PaperPage;

/// A dialog that answers "nothing" sooner than this was never shown.
const UNAVAILABLE: Duration = Duration::from_millis(250);

/// The step after unsaved changes are saved or discarded.
#[derive(Clone, Debug, PartialEq)]
pub enum AfterDiscard {
    /// Begin an empty document.
    New,
    /// Open this file.
    OpenFile(PathBuf),
    /// Open a recovered document.
    Recover(usize),
    /// Open a built-in example.
    OpenExample(usize),
    /// Open the document of a page about the paper.
    OpenPaper(PaperPage),
    /// Leave.
    Quit,
}

/// The purpose of a path.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// To open: a project in place of the document.
    Open,
    /// To add its curves.
    Import,
    /// To add it as a picture.
    Picture,
    /// To read the active picture from it.
    Relink,
    /// Save under it, then go on.
    Save(Option<AfterDiscard>),
    /// To export to.
    Export(Box<ExportChoice>),
}

/// The paths that the user chose.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The purpose of the paths.
    pub purpose: Purpose,
    /// The paths: at least one.
    pub paths: Vec<PathBuf>,
}

/// The dialogs that are open: any number of the system's, and one prompt.
pub struct FileDialogs {
    /// Whether to try the system's dialogs at all.
    native: bool,
    /// The oldest first.
    waiting: Vec<Waiting>,
    prompt: Option<Prompt>,
}

struct Waiting {
    purpose: Purpose,
    proposal: PathBuf,
    begun: Instant,
    answer: Receiver<Vec<PathBuf>>,
}

struct Prompt {
    purpose: Purpose,
    text: String,
    error: Option<String>,
    /// The file that is written over if the path is confirmed once more.
    replacing: Option<PathBuf>,
    fresh: bool,
}

impl FileDialogs {
    /// Ask through the system's dialogs, or only through the window's own prompt.
    pub fn new(native: bool) -> Self {
        Self {
            native,
            waiting: Vec::new(),
            prompt: None,
        }
    }

    /// Whether the system's dialogs are in use.
    pub fn is_native(&self) -> bool {
        self.native
    }

    /// Ask for a path; `proposal` is where to begin. Dialogs that are open stay so.
    pub fn ask(&mut self, context: &Context, purpose: Purpose, proposal: PathBuf) {
        if !self.native {
            self.prompt = Some(Prompt::new(purpose, &proposal));
            return;
        }
        let (sender, answer) = channel();
        let (kind, start, repaint) = (purpose.clone(), proposal.clone(), context.clone());
        let show = move || {
            // The window may have closed meanwhile; then nobody listens any more.
            let _ = sender.send(native_dialog(&kind, &start));
            repaint.request_repaint();
        };
        let begun = Instant::now();
        if cfg!(target_os = "macos") {
            show();
        } else {
            std::thread::spawn(show);
        }
        self.waiting.push(Waiting {
            purpose,
            proposal,
            begun,
            answer,
        });
    }

    /// Show the prompt again because the path could not be used.
    pub fn ask_again(&mut self, purpose: Purpose, path: &Path, error: String) {
        self.prompt = Some(Prompt {
            error: Some(error),
            ..Prompt::new(purpose, path)
        });
    }

    /// Take the answer of one dialog, if it has come. While the prompt is open, answers wait.
    pub fn answer(&mut self) -> Option<Chosen> {
        if self.prompt.is_some() {
            return None;
        }
        let answer = |waiting: &Waiting| match waiting.answer.try_recv() {
            Err(TryRecvError::Empty) => None,
            Ok(paths) => Some(paths),
            Err(TryRecvError::Disconnected) => Some(Vec::new()),
        };
        let mut dialogs = self.waiting.iter().enumerate();
        let (place, paths) = dialogs.find_map(|(place, it)| Some((place, answer(it)?)))?;
        let Waiting {
            purpose,
            proposal,
            begun,
            ..
        } = self.waiting.remove(place);
        if let [path] = paths.as_slice() {
            let complete = completed(&purpose, path);
            // The system's dialog asked about the typed path, which had no extension.
            if complete != *path && replaces(&purpose, &complete) {
                let mut prompt = Prompt::new(purpose, &complete);
                prompt.replacing = Some(complete);
                self.prompt = Some(prompt);
                return None;
            }
        }
        if !paths.is_empty() {
            return Some(Chosen { purpose, paths });
        }
        if begun.elapsed() < UNAVAILABLE {
            self.native = false;
            self.prompt = Some(Prompt::new(purpose, &proposal));
        }
        None
    }

    /// Show the window's own prompt, if it is open.
    pub fn show(&mut self, context: &Context) -> Option<Chosen> {
        let prompt = self.prompt.as_mut()?;
        let Some(path) = widgets::modal(context, "path prompt", None, |ui| prompt.show(ui))? else {
            self.prompt = None;
            return None;
        };
        if !prompt.accepts(&path) {
            return None;
        }
        let purpose = self.prompt.take()?.purpose;
        let paths = vec![path];
        Some(Chosen { purpose, paths })
    }
}

impl Prompt {
    fn new(purpose: Purpose, path: &Path) -> Self {
        Self {
            purpose,
            text: path.display().to_string(),
            error: None,
            replacing: None,
            fresh: true,
        }
    }

    /// Show the prompt; returns the path once the user confirms it, or `None` in its place to cancel.
    fn show(&mut self, ui: &mut Ui) -> Option<Option<PathBuf>> {
        let (title, verb) = self.purpose.words();
        ui.set_width(520.0);
        ui.strong(title);
        let field = TextEdit::singleline(&mut self.text)
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER)
            .hint_text("Path of the file")
            .min_size(vec2(0.0, 1.25 * ROW));
        let response = ui.add(field).accessible_name("Path");
        if std::mem::take(&mut self.fresh) {
            response.request_focus();
            self.select_stem(ui, response.id);
        }
        if response.changed() {
            self.error = None;
            self.replacing = None;
        }
        self.remark_ui(ui);
        let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let path = || completed(&self.purpose, &typed(self.text.trim()));
        let mut answer = entered.then(|| Some(path()));
        ui.horizontal(|ui| {
            widgets::at_right(ui, |ui| {
                let verb = if self.replacing.is_some() {
                    "Replace"
                } else {
                    verb
                };
                if widgets::primary_button(ui, verb).clicked() {
                    answer = Some(Some(path()));
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(None);
                }
            });
        });
        if entered {
            // A refused path can be corrected at once.
            response.request_focus();
        }
        answer
    }

    /// Select the name without the folder and the extension, so that typing replaces it.
    fn select_stem(&self, ui: &Ui, id: Id) {
        let path = Path::new(&self.text);
        let count = |text: Option<&OsStr>| {
            let text = text
                .filter(|_| path.extension().is_some())
                .unwrap_or_default();
            text.to_string_lossy().chars().count()
        };
        let (stem, name) = (count(path.file_stem()), count(path.file_name()));
        let start = self.text.chars().count() - name;
        let range = CCursorRange::two(CCursor::new(start), CCursor::new(start + stem));
        let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
        state.cursor.set_char_range(Some(range));
        state.store(ui.ctx(), id);
    }

    /// Whether a path can be used as it is; otherwise the remark says why not.
    fn accepts(&mut self, path: &Path) -> bool {
        self.error = refused(&self.purpose, path);
        if self.error.is_some() {
            return false;
        }
        if !replaces(&self.purpose, path) || self.replacing.as_deref() == Some(path) {
            return true;
        }
        self.replacing = Some(path.to_owned());
        false
    }

    /// Below the field: the error, or the effect of Enter.
    fn remark_ui(&self, ui: &mut Ui) {
        let tokens = Tokens::of(ui);
        let (text, colour) = match (&self.error, &self.replacing) {
            (Some(error), _) => (error.clone(), tokens.error),
            (None, Some(path)) => {
                let name = quoted(&path.file_name().unwrap_or_default().to_string_lossy());
                let text = format!("{name} exists. Enter once more replaces it, Esc cancels.");
                (text, tokens.warning)
            }
            (None, None) => {
                let text = "Enter confirms, Esc cancels.".to_owned();
                (text, tokens.faint_text)
            }
        };
        ui.add(Label::new(RichText::new(text).color(colour)).wrap());
    }
}

impl Purpose {
    /// The format of the file to write; `None` if files are read.
    fn written(&self) -> Option<&'static Format> {
        match self {
            Self::Open | Self::Import | Self::Picture | Self::Relink => None,
            Self::Save(_) => Some(&PROJECT),
            Self::Export(choice) => Some(choice.format),
        }
    }

    /// The title of the dialog, and the verb on its button.
    fn words(&self) -> (String, &'static str) {
        match self {
            Self::Open => ("Open a file".to_owned(), "Open"),
            Self::Import => ("Import curves from a file".to_owned(), "Import"),
            Self::Picture => ("Add a picture to trace".to_owned(), "Add"),
            Self::Relink => ("Read the picture from a file".to_owned(), "Relink"),
            Self::Save(_) => ("Save the document".to_owned(), "Save"),
            Self::Export(choice) => {
                let format = choice.format.extension().to_uppercase();
                (format!("Export as {format}"), "Export")
            }
        }
    }
}

/// The path with the extension of the written format.
fn completed(purpose: &Purpose, path: &Path) -> PathBuf {
    let is_name = path.file_name().is_some() && !path.is_dir();
    match purpose.written() {
        Some(format) if is_name => with_extension(&once(path, format), format.extension()),
        _ => path.to_owned(),
    }
}

/// The path with an extension of the format once: a name that is typed over the selected stem may bring another.
fn once(path: &Path, format: &Format) -> PathBuf {
    let is_own = |it: &OsStr| format.extensions.iter().any(|own| it == *own);
    let own = path.extension().filter(|it| is_own(it));
    let stem = path.file_stem().map(Path::new);
    match stem.filter(|stem| own.is_some() && stem.extension() == own) {
        Some(stem) => path.with_file_name(stem),
        None => path.to_owned(),
    }
}

/// Whether a file would be written over.
fn replaces(purpose: &Purpose, path: &Path) -> bool {
    purpose.written().is_some() && path.is_file()
}

/// Read a path as people type it: "~" is the home folder, and "//" or "/~/" behind a folder begins a path anew.
fn typed(text: &str) -> PathBuf {
    let begins = ["//", "/~/"].map(|mark| text.rfind(mark));
    let begin = begins
        .into_iter()
        .flatten()
        .filter(|place| *place > 0)
        .max();
    let text = begin.map_or(text, |place| &text[place + 1..]);
    let home = std::env::var_os(if cfg!(windows) { "USERPROFILE" } else { "HOME" });
    match (text.strip_prefix("~/"), home) {
        (Some(rest), Some(home)) => PathBuf::from(home).join(rest),
        _ => PathBuf::from(text),
    }
}

/// Why a path cannot be used, as far as its text shows.
fn refused(purpose: &Purpose, path: &Path) -> Option<String> {
    if path.as_os_str().is_empty() {
        return Some("Type the path of a file.".to_owned());
    }
    let shown = shown_path(path);
    if path.is_dir() {
        return Some(format!("{shown} is a folder: add a file's name."));
    }
    if purpose.written().is_none() {
        return (!path.is_file()).then(|| format!("There is no file {shown}."));
    }
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())?;
    let missing = || format!("There is no folder {}.", shown_path(folder));
    (!folder.is_dir()).then(missing)
}

fn native_dialog(purpose: &Purpose, proposal: &Path) -> Vec<PathBuf> {
    let mut dialog = FileDialog::new().set_title(purpose.words().0);
    if let Some(folder) = proposal.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    if let Some(name) = proposal.file_name() {
        dialog = dialog.set_file_name(name.to_string_lossy());
    }
    if let Some(format) = purpose.written() {
        let dialog = dialog.add_filter(format.name, format.extensions);
        return dialog.save_file().into_iter().collect();
    }
    let readable = formats::readable().flat_map(|format| format.extensions);
    let readable: Vec<&str> = readable.copied().collect();
    let dialog = match purpose {
        Purpose::Picture | Purpose::Relink => dialog.add_filter("Pictures", PICTURE.extensions),
        _ => dialog.add_filter("Curves and pictures", &readable),
    };
    match purpose {
        Purpose::Import | Purpose::Picture => dialog.pick_files().unwrap_or_default(),
        _ => dialog.pick_file().into_iter().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_typed_behind_the_proposed_folder_begins_anew() {
        for (text, read) in [
            ("/home/me//tmp/scan.csv", "/tmp/scan.csv"),
            ("/home/me/scan.csv", "/home/me/scan.csv"),
            ("//server/scan.csv", "//server/scan.csv"),
        ] {
            assert_eq!(typed(text), PathBuf::from(read));
        }
        assert_eq!(typed("/home/me/~/scan.csv"), typed("~/scan.csv"));
    }

    #[test]
    fn a_written_file_has_its_extension_once() {
        for (typed, path) in [
            ("/a/hull", "/a/hull.batten"),
            ("/a/hull.batten", "/a/hull.batten"),
            ("/a/hull.batten.batten", "/a/hull.batten"),
            ("/a/hull.v1.v1", "/a/hull.v1.v1.batten"),
        ] {
            let found = completed(&Purpose::Save(None), Path::new(typed));
            assert_eq!(found, PathBuf::from(path), "{typed}");
        }
        let read = Path::new("/a/hull.batten.batten");
        assert_eq!(
            completed(&Purpose::Open, read),
            read,
            "a file that is there"
        );
    }

    #[test]
    fn every_open_dialog_is_answered_for_its_own_purpose() {
        let mut dialogs = FileDialogs::new(true);
        let senders = [Purpose::Open, Purpose::Import].map(|purpose| {
            let (sender, answer) = channel();
            dialogs.waiting.push(Waiting {
                purpose,
                proposal: PathBuf::new(),
                begun: Instant::now(),
                answer,
            });
            sender
        });
        assert_eq!(dialogs.answer(), None);
        let purposes = [Purpose::Open, Purpose::Import];
        // The second dialog is answered first.
        for (sender, purpose) in senders.iter().zip(&purposes).rev() {
            let paths = vec![PathBuf::from("a.batten")];
            sender.send(paths.clone()).expect("the dialog waits");
            let purpose = purpose.clone();
            assert_eq!(dialogs.answer(), Some(Chosen { purpose, paths }));
        }
        assert_eq!(dialogs.answer(), None);
    }
}
