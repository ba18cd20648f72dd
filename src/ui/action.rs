//! The table of actions: the editor's commands, and those of the window alone. Menus, keys,
//! buttons and the command palette all read it.

use crate::editor::{Command, CopyForm, Editor, Key, Modifiers, PaneLayout, Shortcut};
use crate::geometry::rounded_up;
use crate::io::examples::EXAMPLES;
use crate::io::{Exporter, formats};
use crate::operations::Deviation;
use crate::ui::shell::Shell;

/// Something that the user can ask for by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// A command of the editor.
    Command(Command),
    /// Begin an empty document.
    New,
    /// Open a file.
    Open,
    /// Open a built-in example, by its number.
    OpenExample(usize),
    /// Add the curves of a file to the document.
    Import,
    /// Add a picture to trace.
    Picture,
    /// Read the active picture from another file.
    RelinkPicture,
    /// Choose anew what is taken of the files that came in last.
    ChooseImport,
    /// Save under the present path.
    Save,
    /// Save under another path.
    SaveAs,
    /// Open the document's file again.
    Reload,
    /// Write curves as they were written last.
    ExportLast,
    /// Write curves in a format.
    Export(Exporter),
    /// Leave.
    Quit,
    /// Copy the selected vertices and remove them.
    Cut,
    /// Copy the selected curve or vertices.
    Copy,
    /// Copy the selected curves in a form for other programs.
    CopyAs(CopyForm),
    /// Add the copied curve or vertices.
    Paste,
    /// Type another name for the active curve in its row of the list.
    Rename,
    /// Switch between the dark and the light theme.
    ToggleTheme,
    /// Show the names of the tools beside their icons.
    ToggleToolNames,
    /// Show or hide the plots.
    TogglePlots,
    /// Show all of the plot in front again.
    FitPlot,
    /// Plot the curve scaled to length 1, or as it is.
    NormaliseLength,
    /// Set how far an arrow key moves the selection.
    NudgeStep,
    /// Find an action by its name.
    Palette,
    /// Explain the paper's figures, with their curves.
    Paper,
    /// Open the manual.
    Manual,
    /// List the keys.
    Keys,
    /// Show version and licence.
    About,
}

impl From<Command> for Action {
    fn from(command: Command) -> Self {
        Self::Command(command)
    }
}

impl Action {
    /// List every action there is, in the order in which the palette offers them.
    pub fn all() -> Vec<Self> {
        let mut all = vec![
            Self::New,
            Self::Open,
            Self::Import,
            Self::Picture,
            Self::RelinkPicture,
            Self::ChooseImport,
            Self::Save,
            Self::SaveAs,
            Self::Reload,
        ];
        all.push(Self::ExportLast);
        all.extend(formats::exporters().into_iter().map(Self::Export));
        all.extend((0..EXAMPLES.len()).map(Self::OpenExample));
        all.extend([Self::Quit, Self::Cut, Self::Copy]);
        all.extend(CopyForm::OTHERS.map(Self::CopyAs));
        all.extend([Self::Paste, Self::Rename]);
        all.extend(Command::all().into_iter().map(Self::Command));
        all.extend([
            Self::ToggleTheme,
            Self::ToggleToolNames,
            Self::TogglePlots,
            Self::FitPlot,
            Self::NormaliseLength,
            Self::NudgeStep,
            Self::Palette,
            Self::Paper,
            Self::Manual,
            Self::Keys,
            Self::About,
        ]);
        all
    }

    /// What menus and buttons call the action.
    pub fn label(self) -> String {
        let label = match self {
            Self::Command(command) => return command.label(),
            Self::New => "New",
            Self::Open => "Open…",
            Self::OpenExample(index) => EXAMPLES.get(index).map_or("", |example| example.title),
            Self::Import => "Import curves…",
            Self::Picture => "Picture to trace…",
            Self::RelinkPicture => "Relink picture…",
            Self::ChooseImport => "Choose imported…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::Reload => "Reload",
            Self::ExportLast => "Export…",
            Self::Export(exporter) => exporter.row.label,
            Self::Quit => "Quit",
            Self::Cut => "Cut",
            Self::Copy => "Copy",
            Self::CopyAs(CopyForm::SvgPath) => "Copy as SVG path",
            Self::CopyAs(CopyForm::Own | CopyForm::Table) => "Copy as table",
            Self::Paste => "Paste",
            Self::Rename => "Rename curve",
            Self::ToggleTheme => "Light theme",
            Self::ToggleToolNames => "Tool names",
            Self::TogglePlots => "Plots",
            Self::FitPlot => "Fit plot",
            Self::NormaliseLength => "Normalise length",
            Self::NudgeStep => "Nudge step…",
            Self::Palette => "Find a command…",
            Self::Paper => "The paper",
            Self::Manual => "Manual",
            Self::Keys => "Keys and mouse",
            Self::About => "About Batten",
        };
        label.to_owned()
    }

    /// The words that find the action in the palette: its title, its name on the command line, and what other
    /// programs call it.
    pub fn words(self, editor: &Editor) -> String {
        let other = match self {
            Self::Command(command) => other_words(command),
            _ => "",
        };
        match self {
            Self::Command(Command::Operation(operation)) => {
                format!("{} {} {other}", operation.label, operation.name)
            }
            Self::Command(Command::Compare(Some(_))) => {
                format!("{} {other}", self.title_now(editor))
            }
            _ => format!("{} {other}", self.label()),
        }
    }

    /// The label outside of menus, whose titles say a part of it.
    pub fn title_now(self, editor: &Editor) -> String {
        let label = self.label_now(editor);
        match self {
            Self::Command(Command::Compare(Some(_))) => format!("Compare with {label}"),
            _ => label,
        }
    }

    /// The label in a menu now: undo and redo name their step.
    pub fn label_now(self, editor: &Editor) -> String {
        match self {
            Self::Command(command) => command.label_now(editor),
            Self::Rename if editor.active_reference().is_some() => "Rename reference".to_owned(),
            _ => self.label(),
        }
    }

    /// One sentence for the tooltip.
    pub fn tooltip(self) -> String {
        let tooltip = match self {
            Self::Command(command) => return command.tooltip(),
            Self::New => "Create an empty document",
            Self::Open => {
                let names = formats::readable().map(|format| format.name);
                return format!("Open a {}", names.collect::<Vec<_>>().join(" or "));
            }
            Self::OpenExample(index) => EXAMPLES
                .get(index)
                .map_or("", |example| example.description),
            Self::Import => "Add the curves of a file to this document",
            Self::Picture => "Add a PNG, JPEG, WebP or TIFF behind the curves, to trace it",
            Self::RelinkPicture => "Read the active picture from another file",
            Self::Save => "Save the document to its file",
            Self::SaveAs => "Save the document to another file",
            Self::ChooseImport => "Choose anew what is taken of the drawing that came in last",
            Self::Reload => "Read the file again from disk; Undo brings your changes back",
            Self::ExportLast => {
                "Export in the form of the last export, after a look at what it loses"
            }
            Self::Export(exporter) => exporter.row.help,
            Self::Quit => "Quit Batten",
            Self::Cut => "Copy the selected vertices and delete them",
            Self::Copy => "Copy the active curve, or only its selected vertices",
            Self::CopyAs(CopyForm::SvgPath) => {
                "Copy the selected curves as the data of an SVG path"
            }
            Self::CopyAs(CopyForm::Own | CopyForm::Table) => {
                "Copy float vertices as a table for spreadsheets"
            }
            Self::Paste => "Add copied curves, vertices, SVG paths, DXF text or a picture",
            Self::Rename => "Rename in the list of curves; a double-click on a row does the same",
            Self::ToggleTheme => "Switch between the dark and the light theme",
            Self::ToggleToolNames => "Show the names of the tools beside their icons",
            Self::TogglePlots => "Show or hide the plots under the canvas",
            Self::FitPlot => "Show the whole plot again; a double-click does the same",
            Self::NormaliseLength => {
                "Scale the plotted curve to length 1, to compare curves of different sizes"
            }
            Self::NudgeStep => "Set how far an arrow key moves the selection",
            Self::Palette => "Find a command by typing part of its name",
            Self::Paper => "Open figures and tables of the paper behind Batten, with explanations",
            Self::Manual => "Open the manual; F1 over a panel or menu opens its page",
            Self::Keys => "List all keys and mouse actions",
            Self::About => "Show version and licence",
        };
        tooltip.to_owned()
    }

    /// The key of the action.
    pub fn shortcut(self) -> Option<Shortcut> {
        Some(match self {
            Self::Command(command) => return command.shortcut(),
            Self::New => Shortcut::ctrl('n'),
            Self::Open => Shortcut::ctrl('o'),
            Self::Import => Shortcut::ctrl('i'),
            Self::Save => Shortcut::ctrl('s'),
            Self::SaveAs => Shortcut::ctrl_shift('s'),
            Self::ExportLast => Shortcut::ctrl('e'),
            Self::Export(exporter) => return exporter.row.key.map(Shortcut::ctrl),
            Self::Quit => Shortcut::ctrl('q'),
            Self::Cut => Shortcut::ctrl('x'),
            Self::Copy => Shortcut::ctrl('c'),
            Self::Paste => Shortcut::ctrl('v'),
            Self::Rename => Shortcut::plain(Key::Function(2)),
            Self::ToggleTheme => Shortcut::plain(Key::Function(9)),
            Self::TogglePlots => Shortcut::plain(Key::Function(8)),
            Self::FitPlot => Shortcut {
                modifiers: Modifiers::SHIFT,
                key: Key::Function(8),
            },
            Self::Palette => Shortcut::ctrl('p'),
            Self::Keys => Shortcut::plain(Key::Function(1)),
            Self::OpenExample(_)
            | Self::Reload
            | Self::Picture
            | Self::RelinkPicture
            | Self::ChooseImport
            | Self::CopyAs(_)
            | Self::NormaliseLength
            | Self::ToggleToolNames
            | Self::NudgeStep
            | Self::Paper
            | Self::Manual
            | Self::About => return None,
        })
    }

    /// Whether the action opens a dialog, under which no drag can go on.
    pub fn covers_canvas(self) -> bool {
        matches!(
            self,
            Self::Import
                | Self::Picture
                | Self::RelinkPicture
                | Self::ChooseImport
                | Self::SaveAs
                | Self::Export(_)
                | Self::ExportLast
                | Self::NudgeStep
                | Self::Palette
                | Self::Manual
                | Self::Keys
                | Self::About
        )
    }

    /// Whether the action is available now.
    pub fn is_enabled(self, editor: &Editor) -> bool {
        match self {
            Self::Command(command) => command.is_enabled(editor),
            Self::Export(_) | Self::ExportLast => !editor.document().is_empty(),
            Self::Reload => editor.workspace().path().is_some(),
            Self::RelinkPicture => {
                let active = editor.active_reference();
                active.is_some_and(|(_, reference)| reference.picture.is_some())
            }
            Self::ChooseImport => editor.filing().has_imported(),
            Self::Cut | Self::Copy | Self::CopyAs(_) | Self::Rename => editor.active().is_some(),
            _ => true,
        }
    }

    /// The tooltip, with the reason if the action is not available.
    pub fn tooltip_now(self, editor: &Editor) -> String {
        let tooltip = self.tooltip();
        match self.refusal(editor) {
            None => tooltip,
            Some(refusal) => format!("{tooltip}\n\n{refusal}"),
        }
    }

    /// Why the action is not available, if that is known.
    pub fn refusal(self, editor: &Editor) -> Option<String> {
        let Self::Command(Command::Operation(operation)) = self else {
            return None;
        };
        let reason = editor.input_of(operation).err()?;
        Some(format!("Unavailable: {reason}"))
    }

    /// How far the action would move the active curve, as far as that is known: "exact" or "± 0.28".
    pub fn foreseen(self, editor: &Editor) -> Option<String> {
        let Self::Command(Command::Operation(operation)) = self else {
            return None;
        };
        match editor.foreseen(operation)? {
            Deviation::Exact | Deviation::AtMost(0.0) => Some("exact".to_owned()),
            Deviation::AtMost(bound) => {
                let unit = editor.document().unit();
                let unit = unit.map_or(String::new(), |unit| format!(" {}", unit.symbol()));
                Some(format!("± {}{unit}", rounded_up(bound)))
            }
            Deviation::Measured(_) | Deviation::FromPoints(_) | Deviation::Unmeasured => None,
        }
    }

    /// The name of the action for screen readers.
    pub fn name_now(self, editor: &Editor) -> String {
        let label = self.label_now(editor);
        match self.foreseen(editor) {
            Some(foreseen) => format!("{label} {foreseen}"),
            None => label,
        }
    }

    /// Whether a switch is on; `None` for actions that are no switches.
    pub fn is_checked(self, editor: &Editor, shell: &Shell) -> Option<bool> {
        match self {
            Self::Command(command) => command.is_checked(editor),
            Self::ToggleTheme => Some(!shell.dark),
            Self::TogglePlots => Some(shell.plots),
            Self::ToggleToolNames => Some(shell.tool_names),
            Self::NormaliseLength => Some(shell.normalised),
            _ => None,
        }
    }
}

/// What other programs call a command.
fn other_words(command: Command) -> &'static str {
    match command {
        Command::Compare(_) => "deviation difference distance",
        Command::Panes(PaneLayout::One) => "one view",
        Command::Panes(PaneLayout::Two) => "two views split",
        Command::Panes(PaneLayout::Four) => "four views split",
        Command::FitAll => "zoom to fit",
        Command::Fit => "zoom to selection",
        Command::ShowAll => "unhide show everything",
        Command::Isolate => "hide others solo",
        Command::ToggleVisible => "hide show",
        Command::TogglePeriodic => "closed",
        Command::Operation(operation) => {
            let mut words = OTHER_WORDS.iter();
            let words = words.find(|(name, _)| *name == operation.name);
            words.map_or("", |(_, words)| words)
        }
        _ => "",
    }
}

/// What other programs call operations, by their names.
pub const OTHER_WORDS: [(&str, &str); 6] = [
    ("mirror", "flip reflect"),
    ("harmonise", "fair smooth"),
    ("array", "copies pattern"),
    ("to-float", "rebuild"),
    ("join", "merge connect"),
    ("split", "divide"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn actions_have_names_and_keys_of_their_own() {
        let actions = Action::all();
        for (index, action) in actions.iter().enumerate() {
            assert!(!action.label().is_empty() && !action.tooltip().is_empty());
            for other in &actions[index + 1..] {
                assert_ne!(action.label(), other.label());
                if let Some(shortcut) = action.shortcut() {
                    assert_ne!(Some(shortcut), other.shortcut(), "{action:?} and {other:?}");
                }
            }
        }
    }
}
