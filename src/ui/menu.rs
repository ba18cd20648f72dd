//! The menu bar, read from the table of commands.

use eframe::egui::{Button, MenuBar, Response, Ui, vec2};

use super::action::Action;
use super::feature_list::chip_ui;
use super::help::{self, Topic};
use super::menu_item::{WIDTH, blank, item_ui};
use super::plots::others;
use super::shell::Shell;
use super::widgets;
use crate::editor::{
    Arrangement, CombsOf, Command, CopyForm, CurvatureDisplay, Editor, Follow, Layer, NamedView,
    PaneLayout, ToolKind,
};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::KINDS;
use crate::io::examples::EXAMPLES;
use crate::io::formats;
use crate::operations;

/// One line of a menu.
pub enum Entry {
    /// An action of the table.
    Action(Action),
    /// A command under a label and a help of its own.
    Named(&'static str, String, Command),
    /// A line between groups.
    Divider,
    /// Other lines, in a menu of their own with this title.
    Submenu(&'static str, Vec<Entry>),
}

use Entry::{Action as Item, Divider};

/// A line for a command.
pub fn command(command: Command) -> Entry {
    Item(Action::Command(command))
}

/// The menu that aligns and distributes.
pub const ARRANGE: &str = "Align and distribute";

/// The lines that align and distribute what is selected.
pub fn arrangements() -> Vec<Entry> {
    let entry = |it: Arrangement| command(Command::Arrange(it));
    let (aligning, distributing) = Arrangement::ALL.split_at(6);
    let aligning = aligning.iter().map(|it| entry(*it));
    let distributing = distributing.iter().map(|it| entry(*it));
    aligning.chain([Divider]).chain(distributing).collect()
}

/// Show the menu bar, and the verdict on the active curve at its right end.
pub fn menu_ui(ui: &mut Ui, editor: &mut Editor, shell: &Shell, commands: &mut Vec<Action>) {
    MenuBar::new().ui(ui, |ui| {
        for (title, entries) in menus(editor) {
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
            Entry::Named(label, help, command) => {
                let button = Button::new((blank(), label)).min_size(vec2(WIDTH, 0.0));
                let response = ui.add(button).accessible_name(label);
                if response.on_hover_text(help).clicked() {
                    commands.push(command.into());
                    ui.close();
                }
            }
            Entry::Submenu(title, entries) => {
                let menu = ui.menu_button((blank(), title), |ui| {
                    ui.set_min_width(WIDTH);
                    entries_ui(ui, editor, shell, entries, commands);
                });
                menu.response.accessible_name(title);
            }
        }
    }
    first
}

/// The built-in examples, in a menu of their own.
fn examples() -> Entry {
    let examples = (0..EXAMPLES.len()).map(|example| Item(Action::OpenExample(example)));
    Entry::Submenu("Examples", examples.collect())
}

/// The kinds of references that can be added, in a menu of their own.
pub fn references() -> Entry {
    let named = |label, help: &str, command| Entry::Named(label, help.to_owned(), command);
    let kinds = KINDS.iter().copied();
    let kinds = kinds.map(|kind| named(kind.label, kind.help, Command::AddReference(kind)));
    let formula = named(
        "Formula",
        &Command::AddFormula.tooltip(),
        Command::AddFormula,
    );
    Entry::Submenu("Add reference", kinds.chain([formula]).collect())
}

/// The units that the document can have, and those that it can be converted to.
pub fn units() -> Vec<Entry> {
    let conversions = LengthUnit::ALL.map(Command::ConvertUnit);
    let units = Command::units().map(command).chain([Divider]);
    units.chain(conversions.map(command)).collect()
}

/// The curves and references to compare the active one with, in a menu of their own.
pub fn compare(editor: &Editor) -> Entry {
    let compare = [Command::Compare(None)].into_iter().chain(compared(editor));
    Entry::Submenu("Compare with", compare.map(command).collect())
}

/// The commands that compare the active curve or reference with each of the others.
pub fn compared(editor: &Editor) -> impl Iterator<Item = Command> {
    let others = others(editor).into_iter();
    others.map(|(id, _)| Command::Compare(Some(id)))
}

/// The layers, as a menu of their own.
pub fn layers() -> Vec<Entry> {
    let layers = Layer::ALL.map(|layer| command(Command::ToggleLayer(layer)));
    let layers = layers.into_iter();
    layers.chain([command(Command::ToggleBands)]).collect()
}

/// The named views, in a menu of their own.
pub fn views() -> Entry {
    let views = NamedView::ALL.map(|view| command(Command::View(view)));
    Entry::Submenu("View from", views.into())
}

/// Operations that have a menu of their own, by their names.
const GROUPS: [(&str, &[&str]); 3] = [
    (
        "Vertices and degree",
        &[
            "refine",
            "subdivide",
            "elevate-degree",
            "reduce-degree",
            "reinterpret-degree",
            "round",
        ],
    ),
    (
        "Cut and join",
        &["join", "close", "trim", "split", "extend"],
    ),
    ("Ends", &["correct-ends", "translate-end", "rotate-end"]),
];

/// The operations: groups in menus of their own, and the others.
fn operations() -> Vec<Entry> {
    let entry = |operation| command(Command::Operation(operation));
    let groups = GROUPS.map(|(title, names)| {
        let operations = names.iter().filter_map(|name| operations::find(name));
        Entry::Submenu(title, operations.map(entry).collect())
    });
    let is_grouped = |name: &str| GROUPS.iter().any(|(_, names)| names.contains(&name));
    let others = operations::ALL.iter().copied();
    let others = others.filter(|operation| !is_grouped(operation.name));
    groups.into_iter().chain(others.map(entry)).collect()
}

fn menus(editor: &Editor) -> [(&'static str, Vec<Entry>); 6] {
    let mut file = vec![
        Item(Action::New),
        Item(Action::Open),
        Item(Action::Import),
        Item(Action::Picture),
        Item(Action::ChooseImport),
        examples(),
        Divider,
        Item(Action::Save),
        Item(Action::SaveAs),
        Item(Action::Reload),
        Divider,
    ];
    let exporters = formats::exporters().into_iter();
    let exports = exporters.map(|exporter| Item(Action::Export(exporter)));
    file.extend([
        Item(Action::ExportLast),
        Entry::Submenu("Export as", exports.collect()),
        Divider,
        Item(Action::Quit),
    ]);
    let edit = vec![
        command(Command::Undo),
        command(Command::Redo),
        Divider,
        Item(Action::Cut),
        Item(Action::Copy),
        Item(Action::CopyAs(CopyForm::SvgPath)),
        Item(Action::CopyAs(CopyForm::Table)),
        Item(Action::Paste),
        command(Command::Delete),
        Divider,
        command(Command::SelectAll),
        command(Command::SelectNone),
        Divider,
        Entry::Submenu(ARRANGE, arrangements()),
        Divider,
        command(Command::ToggleVerticesLocked),
        command(Command::ToggleSnapping),
        command(Command::ToggleAlignment),
        command(Command::ToggleEdges),
        command(Command::ToggleLayer(Layer::Guides)),
        command(Command::RemoveGuides),
        command(Command::Follow(Follow::InHarmony)),
        command(Command::Follow(Follow::Softly)),
        command(Command::ToggleClosedFollow),
        command(Command::ToggleKeepShape),
        command(Command::ToggleKeeping),
        Divider,
        Entry::Submenu("Document unit", units()),
    ];
    let mut curve = vec![
        references(),
        Divider,
        command(Command::Duplicate),
        Item(Action::Rename),
        command(Command::DeleteCurve),
        Divider,
        command(Command::TogglePeriodic),
        command(Command::ToggleSymmetric),
        Divider,
    ];
    curve.extend(operations());
    curve.extend([
        Divider,
        command(Command::ToggleVisible),
        command(Command::ToggleLocked),
        command(Command::Group),
        command(Command::Ungroup),
        command(Command::Isolate),
        command(Command::ShowAll),
    ]);
    let mut view = vec![
        command(Command::Fit),
        command(Command::FitAll),
        command(Command::ZoomIn),
        command(Command::ZoomOut),
        Divider,
    ];
    view.push(Entry::Submenu("Layers", layers()));
    let displays = CurvatureDisplay::ALL.map(|display| command(Command::ShowCurvature(display)));
    view.push(Entry::Submenu("Show curvature", displays.into()));
    let combs = CombsOf::ALL.map(|of| command(Command::ShowCombs(of)));
    view.push(Entry::Submenu("Combs", combs.into()));
    let panes = PaneLayout::ALL.map(|layout| command(Command::Panes(layout)));
    view.extend([
        views(),
        Entry::Submenu("Panes", panes.into()),
        Divider,
        command(Command::ResetComb),
        Divider,
        Item(Action::TogglePlots),
        Item(Action::FitPlot),
        Item(Action::NormaliseLength),
        compare(editor),
        Divider,
        Item(Action::ToggleTheme),
    ]);
    let tools = ToolKind::ALL.map(|tool| command(Command::Tool(tool)));
    let tools = tools
        .into_iter()
        .chain([Divider, Item(Action::ToggleToolNames)]);
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
        ("Tools", tools.collect()),
        ("Help", help),
    ]
}
