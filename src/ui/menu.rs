//! The menu bar, read from the table of commands.

use eframe::egui::{Button, Color32, MenuBar, RichText, Ui};
use lucide_icons::Icon;

use super::feature_list::chip_ui;
use super::shell::Shell;
use super::theme::Tokens;
use super::{icons, keyboard, widgets};
use crate::editor::{Command, Editor, Layer, NamedView, ToolKind};
use crate::geometry::{End, PolygonKind};

/// The least width of an open menu.
const WIDTH: f32 = 240.0;

/// One line of a menu.
enum Entry {
    Command(Command),
    Divider,
    Examples,
}

use Entry::{Command as Item, Divider};

/// Show the menu bar, and the verdict on the active curve at its right end.
pub fn menu_ui(ui: &mut Ui, editor: &mut Editor, shell: &Shell, commands: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        for (title, entries) in menus() {
            ui.menu_button(title, |ui| {
                ui.set_min_width(WIDTH);
                for entry in entries {
                    match entry {
                        Item(command) => item_ui(ui, editor, shell, command, commands),
                        Divider => {
                            ui.separator();
                        }
                        Entry::Examples => {
                            examples_ui(ui, editor, shell, commands);
                        }
                    }
                }
            });
        }
        widgets::at_right(ui, |ui| {
            let chip = chip_ui(ui, editor);
            let shown = editor.layers().shows(Layer::Features);
            if chip.is_some_and(|chip| chip.clicked()) && !shown {
                commands.push(Layer::Features.command());
            }
        });
    });
}

fn menus() -> [(&'static str, Vec<Entry>); 6] {
    let mut file = vec![
        Item(Command::New),
        Item(Command::Open),
        Item(Command::Import),
        Entry::Examples,
        Divider,
        Item(Command::Save),
        Item(Command::SaveAs),
        Divider,
        Item(Command::ExportDxf),
    ];
    file.extend(PolygonKind::ALL.map(|kind| Item(Command::ExportCsv(kind))));
    file.extend([Divider, Item(Command::Quit)]);
    let edit = vec![
        Item(Command::Undo),
        Item(Command::Redo),
        Divider,
        Item(Command::Cut),
        Item(Command::Copy),
        Item(Command::Paste),
        Item(Command::Delete),
        Divider,
        Item(Command::SelectAll),
        Item(Command::SelectNone),
        Divider,
        Item(Command::ToggleSnapping),
    ];
    let curve = vec![
        Item(Command::Duplicate),
        Item(Command::DeleteCurve),
        Divider,
        Item(Command::RaiseDegree),
        Item(Command::LowerDegree),
        Item(Command::TogglePeriodic),
        Item(Command::Reverse),
        Divider,
        Item(Command::RaiseCurveDegree),
        Item(Command::LowerCurveDegree),
        Item(Command::Subdivide),
        Item(Command::Extend(End::Start)),
        Item(Command::Extend(End::Finish)),
        Item(Command::Divide),
        Item(Command::Round),
        Divider,
        Item(Command::ToggleVisible),
        Item(Command::ToggleLocked),
    ];
    let mut view = vec![
        Item(Command::Fit),
        Item(Command::FitAll),
        Item(Command::ZoomIn),
        Item(Command::ZoomOut),
        Divider,
    ];
    view.extend(Layer::ALL.map(|layer| Item(layer.command())));
    view.push(Divider);
    view.extend(NamedView::ALL.map(|view| Item(Command::View(view))));
    view.extend([
        Divider,
        Item(Command::ResetComb),
        Divider,
        Item(Command::TogglePlots),
        Item(Command::ToggleTheme),
    ]);
    let tools = ToolKind::ALL.map(|tool| Item(Command::Tool(tool))).into();
    let help = vec![
        Item(Command::Palette),
        Item(Command::Keys),
        Divider,
        Item(Command::About),
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

fn examples_ui(ui: &mut Ui, editor: &Editor, shell: &Shell, commands: &mut Vec<Command>) {
    let title = (blank(), "Examples");
    let response = ui.menu_button(title, |ui| {
        ui.set_min_width(WIDTH);
        for example in 0..editor.examples() {
            item_ui(ui, editor, shell, Command::OpenExample(example), commands);
        }
    });
    response.response.accessible_name("Examples");
}

fn item_ui(
    ui: &mut Ui,
    editor: &Editor,
    shell: &Shell,
    command: Command,
    commands: &mut Vec<Command>,
) {
    let label = editor.label(command);
    let checked = shell.is_checked(editor, command);
    let mark = if checked == Some(true) {
        icons::text(Icon::Check)
    } else {
        blank()
    };
    let mut button = Button::new((mark, label.clone())).min_size(eframe::egui::vec2(WIDTH, 0.0));
    if let Some(shortcut) = command.shortcut() {
        let keys =
            RichText::new(keyboard::shortcut_text(shortcut)).color(Tokens::of(ui).faint_text);
        button = button.shortcut_text(keys);
    }
    let response = ui
        .add_enabled(editor.is_enabled(command), button)
        .accessible_name(&label);
    if response.on_hover_text(command.tooltip()).clicked() {
        commands.push(command);
        ui.close();
    }
}

/// A place as wide as a check mark, so that labels line up.
fn blank() -> RichText {
    icons::text(Icon::Check).color(Color32::TRANSPARENT)
}
