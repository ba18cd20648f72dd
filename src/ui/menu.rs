//! The menu bar, read from the table of commands.

use eframe::egui::{Button, MenuBar, Response, Ui, vec2};

use super::action::Action;
use super::feature_list::chip_ui;
use super::help::{self, Topic};
use super::menu_item::{WIDTH, blank, item_ui};
use super::plots::others;
use super::shell::Shell;
use super::unit_menu::units_ui;
use super::widgets;
use crate::editor::{Command, Editor, Follow, Layer, NamedView, ToolKind};
use crate::geometry::references::KINDS;
use crate::io::examples::EXAMPLES;
use crate::io::formats;
use crate::operations;

/// One line of a menu.
pub enum Entry {
    /// An action of the table.
    Action(Action),
    /// A line between groups.
    Divider,
    /// The built-in examples, in a menu of their own.
    Examples,
    /// The kinds of references, in a menu of their own.
    References,
    /// The document's unit, in a menu of its own.
    Units,
    /// The curves and references to compare the active one with, in a menu of their own.
    Compare,
    /// Other lines, in a menu of their own with this title.
    Submenu(&'static str, Vec<Entry>),
}

use Entry::{Action as Item, Divider};

/// A line for a command.
pub fn command(command: Command) -> Entry {
    Item(Action::Command(command))
}

/// Show the menu bar, and the verdict on the active curve at its right end.
pub fn menu_ui(ui: &mut Ui, editor: &mut Editor, shell: &Shell, commands: &mut Vec<Action>) {
    MenuBar::new().ui(ui, |ui| {
        for (title, entries) in menus() {
            ui.menu_button(title, |ui| {
                ui.set_min_width(WIDTH);
                entries_ui(ui, editor, shell, entries, commands);
                help::mark(ui, ui.min_rect(), Topic::Menu(title));
            });
        }
        widgets::at_right(ui, |ui| {
            let chip = chip_ui(ui, editor);
            let shown = editor.sight().layers().shows(Layer::Features);
            if chip.is_some_and(|chip| chip.clicked()) && !shown {
                commands.push(Command::ToggleLayer(Layer::Features).into());
            }
        });
    });
}

/// Show the lines of a menu; returns the first one that can be chosen.
pub fn entries_ui(
    ui: &mut Ui,
    editor: &Editor,
    shell: &Shell,
    entries: Vec<Entry>,
    commands: &mut Vec<Action>,
) -> Option<Response> {
    let mut first = None;
    for entry in entries {
        match entry {
            Item(action) => {
                let item = item_ui(ui, editor, shell, action, commands);
                first = first.or(Some(item).filter(Response::enabled));
            }
            Divider => drop(ui.separator()),
            Entry::References => references_ui(ui, commands),
            Entry::Units => document_unit_ui(ui, editor, shell, commands),
            Entry::Examples => examples_ui(ui, editor, shell, commands),
            Entry::Compare => {
                let others = others(editor).into_iter().map(|(id, _)| Some(id));
                let compare = [None].into_iter().chain(others).map(Command::Compare);
                let entries = compare.map(command).collect();
                submenu_ui(ui, editor, shell, ("Compare with", entries), commands);
            }
            Entry::Submenu(title, entries) => {
                submenu_ui(ui, editor, shell, (title, entries), commands);
            }
        }
    }
    first
}

fn submenu_ui(
    ui: &mut Ui,
    editor: &Editor,
    shell: &Shell,
    (title, entries): (&str, Vec<Entry>),
    commands: &mut Vec<Action>,
) {
    let response = ui.menu_button((blank(), title), |ui| {
        ui.set_min_width(WIDTH);
        entries_ui(ui, editor, shell, entries, commands);
    });
    response.response.accessible_name(title);
}

fn menus() -> [(&'static str, Vec<Entry>); 6] {
    let mut file = vec![
        Item(Action::New),
        Item(Action::Open),
        Item(Action::Import),
        Entry::Examples,
        Divider,
        Item(Action::Save),
        Item(Action::SaveAs),
        Item(Action::Reload),
        Divider,
    ];
    file.extend(
        formats::exporters()
            .into_iter()
            .map(|exporter| Item(Action::Export(exporter))),
    );
    file.extend([Divider, Item(Action::Quit)]);
    let edit = vec![
        command(Command::Undo),
        command(Command::Redo),
        Divider,
        Item(Action::Cut),
        Item(Action::Copy),
        Item(Action::Paste),
        command(Command::Delete),
        Divider,
        command(Command::SelectAll),
        command(Command::SelectNone),
        Divider,
        command(Command::ToggleVerticesLocked),
        command(Command::ToggleSnapping),
        command(Command::Follow(Follow::InHarmony)),
        command(Command::Follow(Follow::Softly)),
        command(Command::ToggleKeeping),
        Divider,
        Entry::Units,
    ];
    let mut curve = vec![
        Entry::References,
        Divider,
        command(Command::Duplicate),
        Item(Action::Rename),
        command(Command::DeleteCurve),
        Divider,
        command(Command::TogglePeriodic),
        Divider,
    ];
    let operations = operations::ALL.iter().copied();
    curve.extend(operations.map(|operation| command(Command::Operation(operation))));
    curve.extend([
        Divider,
        command(Command::ToggleVisible),
        command(Command::ToggleLocked),
    ]);
    let mut view = vec![
        command(Command::Fit),
        command(Command::FitAll),
        command(Command::ZoomIn),
        command(Command::ZoomOut),
        Divider,
    ];
    view.extend(Layer::ALL.map(|layer| command(Command::ToggleLayer(layer))));
    view.push(command(Command::ToggleBands));
    view.push(Divider);
    view.extend(NamedView::ALL.map(|view| command(Command::View(view))));
    view.extend([
        Divider,
        command(Command::ResetComb),
        Divider,
        Item(Action::TogglePlots),
        Item(Action::FitPlot),
        Item(Action::NormaliseLength),
        Entry::Compare,
        Divider,
        Item(Action::ToggleTheme),
    ]);
    let tools = ToolKind::ALL
        .map(|tool| command(Command::Tool(tool)))
        .into();
    let help = vec![
        Item(Action::Manual),
        Item(Action::Keys),
        Item(Action::Palette),
        Item(Action::Paper),
        Divider,
        Item(Action::About),
    ];
    [
        ("File", file),
        ("Edit", edit),
        ("Curve", curve),
        ("View", view),
        ("Tools", tools),
        ("Help", help),
    ]
}

fn examples_ui(ui: &mut Ui, editor: &Editor, shell: &Shell, commands: &mut Vec<Action>) {
    let title = (blank(), "Examples");
    let response = ui.menu_button(title, |ui| {
        ui.set_min_width(WIDTH);
        for example in 0..EXAMPLES.len() {
            item_ui(ui, editor, shell, Action::OpenExample(example), commands);
        }
    });
    response.response.accessible_name("Examples");
}

/// The units that the document can have.
fn document_unit_ui(ui: &mut Ui, editor: &Editor, shell: &Shell, commands: &mut Vec<Action>) {
    let response = ui.menu_button((blank(), "Document unit"), |ui| {
        ui.set_min_width(WIDTH);
        units_ui(ui, editor, shell, commands);
    });
    response.response.accessible_name("Document unit");
}

/// The kinds of references that can be added, from their table.
fn references_ui(ui: &mut Ui, commands: &mut Vec<Action>) {
    let title = (blank(), "Add reference");
    let response = ui.menu_button(title, |ui| {
        ui.set_min_width(WIDTH);
        let kinds = KINDS.iter().copied();
        let kinds = kinds.map(|kind| (kind.label, kind.help, Command::AddReference(kind)));
        let help = Command::AddFormula.tooltip();
        let formula = ("Formula", help.as_str(), Command::AddFormula);
        for (label, help, command) in kinds.chain([formula]) {
            let button = Button::new((blank(), label)).min_size(vec2(WIDTH, 0.0));
            let response = ui.add(button).accessible_name(label);
            if response.on_hover_text(help).clicked() {
                commands.push(command.into());
                ui.close();
            }
        }
    });
    response.response.accessible_name("Add reference");
}
