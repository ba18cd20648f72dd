//! The application's window: where everything stands, and who is told what.

use std::path::{Path, PathBuf};

use eframe::egui::{
    self, CentralPanel, Context, Frame, Margin, Panel, ScrollArea, Ui, ViewportCommand,
};

use super::canvas::Canvas;
use super::curve_list::CurveList;
use super::dialogs::{self, Decision, Dialog};
use super::end_fit_panel::EndFitPanel;
use super::file_dialogs::{Chosen, FileDialogs, Purpose};
use super::gizmo::gizmo_ui;
use super::inspector::Inspector;
use super::keyboard::{self, Asked, Keyboard, Typing};
use super::layer_list::layer_list_ui;
use super::menu::menu_ui;
use super::message::message_ui;
use super::palette::Palette;
use super::plots::{self, Plots, Tab};
use super::reshaping_dialogs::DivisionDialog;
use super::shell::Shell;
use super::status_bar::{self, status_bar_ui};
use super::theme::{self, Tokens};
use super::tool_rail::{self, tool_rail_ui};
use super::{canvas, overlays, widgets};
use crate::editor::{AfterDiscard, Command, Editor, Layer, Request, ToolKind};

/// Under which name the settings are kept.
const SETTINGS: &str = "window";

/// The height, below the list of curves, from which on the layers stay in sight beside the
/// inspector, and beside the taller end-fit panel.
const PINNED: [f32; 2] = [780.0, 920.0];

/// The application: the editor, and what only a window has.
pub struct App {
    editor: Editor,
    shell: Shell,
    canvas: Canvas,
    keyboard: Keyboard,
    curves: CurveList,
    inspector: Inspector,
    end_fit: EndFitPanel,
    plots: Plots,
    palette: Palette,
    files: FileDialogs,
    dialog: Option<Dialog>,
    /// Commands that wait for the end of the frame.
    commands: Vec<Command>,
    /// The title that the window has now.
    title: String,
    /// Whether the window may close without being asked again.
    leaving: bool,
}

impl App {
    /// Make the application about an editor. `storage` holds the settings of the last run;
    /// without `native_dialogs` files are asked for in the window itself.
    pub fn new(
        context: &Context,
        storage: Option<&dyn eframe::Storage>,
        native_dialogs: bool,
        mut editor: Editor,
    ) -> Self {
        theme::install(context);
        context.add_plugin(super::key_order::KeyOrder::default());
        context.options_mut(|options| options.quit_shortcuts.clear());
        let kept = storage.and_then(|storage| eframe::get_value(storage, SETTINGS));
        let shell: Shell = kept.unwrap_or_default();
        theme::choose(context, shell.dark);
        if let Some(hidden) = &shell.hidden {
            hide_layers(&mut editor, hidden);
        }
        let mut plots = Plots::default();
        plots.set_tab(if shell.legs {
            Tab::Legs
        } else {
            Tab::Curvature
        });
        Self {
            editor,
            shell,
            canvas: Canvas::default(),
            keyboard: Keyboard::default(),
            curves: CurveList::default(),
            inspector: Inspector::default(),
            end_fit: EndFitPanel::default(),
            plots,
            palette: Palette::default(),
            files: FileDialogs::new(native_dialogs),
            dialog: None,
            commands: Vec::new(),
            title: String::new(),
            leaving: false,
        }
    }

    /// The editor behind the window.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// Where the canvas is, in points of the window; `None` before the first frame.
    pub fn canvas_rect(&self) -> Option<egui::Rect> {
        self.canvas.rect()
    }

    /// Show one frame of the window.
    pub fn show(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        self.take_answers(&context);
        self.take_dropped_files(&context);
        self.take_keys(&context);
        self.canvas.send_events(&context, &mut self.editor);
        self.editor.features();
        // Panels read what is hovered from the scene: bring it up to date before they do.
        self.editor.update_hover();
        self.editor.hover_nothing();
        self.panels_ui(ui);
        self.overlays_ui(&context);
        let commands = std::mem::take(&mut self.commands);
        for command in commands {
            self.execute(&context, command);
            // The panels above have shown what was before.
            context.request_repaint();
        }
        self.update_title(&context);
        self.watch_closing(&context);
    }

    fn take_answers(&mut self, context: &Context) {
        if let Some(chosen) = self.files.answer() {
            self.use_chosen(context, chosen);
        }
    }

    fn take_keys(&mut self, context: &Context) {
        if self.palette.is_open() {
            return;
        }
        if context.input(|input| input.key_pressed(egui::Key::F6)) {
            move_keyboard(context);
        }
        let typing = keyboard::typing(context) == Typing::Text;
        let asked = self.keyboard.asked(context, &self.editor);
        if typing && !asked.is_empty() {
            // What is being typed counts: its field gives it up before the command is done.
            context.memory_mut(|memory| memory.stop_text_input());
        }
        for asked in asked {
            match asked {
                Asked::Command(command) if typing => self.commands.push(command),
                Asked::Command(command) => self.execute(context, command),
                Asked::Paste(text) => self.editor.paste_text(&text),
            }
        }
    }

    fn take_dropped_files(&mut self, context: &Context) {
        let dropped: Vec<PathBuf> = context.input(|input| {
            let files = input.raw.dropped_files.iter();
            files.map(|file| file.path().to_owned()).collect()
        });
        match dropped.as_slice() {
            [] => {}
            [one] if is_project(one) => {
                let request = self.editor.confirmed(AfterDiscard::OpenFile(one.clone()));
                self.grant(context, request);
            }
            several => self.editor.import(several),
        }
    }

    fn panels_ui(&mut self, ui: &mut Ui) {
        let tokens = Tokens::of(ui);
        let bar = |x: i8, y: i8| {
            Frame::NONE
                .fill(tokens.panel)
                .inner_margin(Margin::symmetric(x, y))
        };
        Panel::top("menu")
            .frame(bar(4, 2))
            .resizable(false)
            .show(ui, |ui| {
                menu_ui(ui, &mut self.editor, &self.shell, &mut self.commands);
            });
        let status = Panel::bottom("status").frame(bar(12, 0)).resizable(false);
        status
            .exact_size(status_bar::HEIGHT)
            .show(ui, |ui| status_bar_ui(ui, &self.editor));
        let rail = Panel::left("tools").frame(bar(4, 4)).resizable(false);
        rail.exact_size(tool_rail::WIDTH).show(ui, |ui| {
            tool_rail_ui(ui, &self.editor, &mut self.commands);
        });
        let side = Panel::right("side").frame(Frame::NONE.fill(tokens.panel));
        side.default_size(320.0)
            .size_range(280.0..=520.0)
            .show(ui, |ui| self.side_ui(ui));
        self.plots_ui(ui);
        CentralPanel::default()
            .frame(Frame::NONE.fill(tokens.background))
            .show(ui, |ui| {
                self.canvas.show(ui, &mut self.editor);
                if let Some(rect) = self.canvas.rect() {
                    gizmo_ui(ui, rect, &mut self.editor, &mut self.commands);
                }
            });
    }

    fn side_ui(&mut self, ui: &mut Ui) {
        let pad = Frame::NONE.inner_margin(Margin::symmetric(12, 8));
        let curves = Panel::top("curves").frame(pad).resizable(true);
        curves
            .default_size(116.0)
            .size_range(72.0..=400.0)
            .show(ui, |ui| {
                self.curves.show(ui, &mut self.editor, &mut self.commands);
            });
        // In a low window the layers scroll with the rest, so that nothing is squeezed out.
        let is_end_fit = self.editor.tool() == ToolKind::EndFit;
        let pinned = ui.available_height() >= PINNED[usize::from(is_end_fit)];
        if pinned {
            let layers = Panel::bottom("layers").frame(pad).resizable(false);
            layers.show(ui, |ui| self.layers_ui(ui));
        }
        CentralPanel::default().frame(pad).show(ui, |ui| {
            // Each has its own place in its own scroll area.
            let name = if is_end_fit { "end fit" } else { "inspector" };
            let area = ScrollArea::vertical()
                .id_salt(name)
                .auto_shrink([false, false]);
            // Room for the bar is always kept, so that nothing moves when it appears.
            let width = ui.available_width() - ui.spacing().scroll.allocated_width();
            area.show(ui, |ui| {
                ui.set_max_width(width);
                if is_end_fit {
                    self.end_fit.show(ui, &mut self.editor);
                } else {
                    self.inspector.show(ui, &mut self.editor);
                }
                if !pinned {
                    self.layers_ui(ui);
                }
            });
        });
    }

    fn layers_ui(&mut self, ui: &mut Ui) {
        widgets::section(ui, "Layers", true, |ui| {
            layer_list_ui(ui, &mut self.editor, &mut self.commands);
        });
    }

    fn plots_ui(&mut self, ui: &mut Ui) {
        let tokens = Tokens::of(ui);
        let frame = Frame::NONE
            .fill(tokens.panel)
            .inner_margin(Margin::symmetric(8, 0));
        if !self.shell.plots {
            let bar = Panel::bottom("plots folded").frame(frame).resizable(false);
            bar.exact_size(plots::BAR).show(ui, |ui| {
                self.plots
                    .bar_ui(ui, &self.editor, false, &mut self.commands);
            });
            return;
        }
        let panel = Panel::bottom("plots").frame(frame).resizable(true);
        panel
            .default_size(232.0)
            .size_range(168.0..=640.0)
            .show(ui, |ui| {
                ui.allocate_ui(egui::vec2(ui.available_width(), plots::BAR), |ui| {
                    self.plots
                        .bar_ui(ui, &self.editor, true, &mut self.commands);
                });
                self.plots.show(ui, &mut self.editor);
            });
    }

    fn overlays_ui(&mut self, context: &Context) {
        if let Some(rect) = self.canvas.rect() {
            message_ui(context, rect, &mut self.editor, &mut self.commands);
            if self.editor.is_orbited() {
                overlays::orbited_ui(context, rect, &mut self.commands);
            }
            overlays::drop_ui(context, rect);
            if self.editor.document().is_empty() && self.editor.tool() != ToolKind::Draw {
                overlays::empty_ui(context, rect);
            }
        }
        self.palette.show(context, &self.editor, &mut self.commands);
        if let Some(chosen) = self.files.show(context) {
            self.use_chosen(context, chosen);
        }
        let decided = self
            .dialog
            .as_mut()
            .and_then(|dialog| dialogs::dialog_ui(context, dialog, &self.editor));
        if let Some(decision) = decided {
            self.dialog = None;
            self.decide(context, decision);
            context.request_repaint();
        }
    }

    fn execute(&mut self, context: &Context, command: Command) {
        let request = self.editor.execute(command);
        self.grant(context, request);
    }

    fn grant(&mut self, context: &Context, request: Option<Request>) {
        let Some(request) = request else {
            return;
        };
        match request {
            Request::Open => self.files.ask(context, Purpose::Open, self.folder()),
            Request::Import => self.files.ask(context, Purpose::Import, self.folder()),
            Request::SaveAs => self.ask_save(context, None),
            Request::Export(export) => {
                let proposal = self.folder().join(&export.file_name);
                self.files.ask(context, Purpose::Export(export), proposal);
            }
            Request::ConfirmDiscard(after) => self.dialog = Some(Dialog::Unsaved(after)),
            Request::Quit => {
                self.leaving = true;
                context.send_viewport_cmd(ViewportCommand::Close);
            }
            Request::CopyText(text) => context.copy_text(text),
            Request::Paste => context.send_viewport_cmd(ViewportCommand::RequestPaste),
            Request::ToggleTheme => {
                self.shell.dark = !self.shell.dark;
                theme::choose(context, self.shell.dark);
            }
            Request::TogglePlots => self.shell.plots = !self.shell.plots,
            Request::Palette => self.palette.open(),
            Request::Divide => {
                self.dialog = Some(Dialog::Divide(DivisionDialog::new(&self.editor)));
            }
            Request::Round => self.dialog = Some(Dialog::Round(Box::default())),
            Request::Keys => self.dialog = Some(Dialog::Keys),
            Request::About => self.dialog = Some(Dialog::About),
        }
    }

    fn ask_save(&mut self, context: &Context, after: Option<AfterDiscard>) {
        let named = self.editor.path().map(Path::to_owned);
        let proposal = named.unwrap_or_else(|| self.folder().join("untitled.batten"));
        self.files.ask(context, Purpose::Save(after), proposal);
    }

    /// Where questions for files begin: beside the document's file, otherwise where the program
    /// was started. Ends with a separator, so that a name can be typed behind it.
    fn folder(&self) -> PathBuf {
        let beside = self
            .editor
            .path()
            .and_then(Path::parent)
            .map(Path::to_owned);
        let folder = beside.filter(|folder| folder.is_dir());
        let folder = folder
            .or_else(|| std::env::current_dir().ok())
            .unwrap_or_default();
        folder.join("")
    }

    fn decide(&mut self, context: &Context, decision: Decision) {
        match decision {
            Decision::Close => {}
            Decision::Divide(division, subdivisions) => self.editor.divide(division, subdivisions),
            Decision::Round(kind, digits) => self.editor.round(kind, digits),
            Decision::Discard(after) => {
                let request = self.editor.discard_and(after);
                self.grant(context, request);
            }
            Decision::Save(after) => match self.editor.path().map(Path::to_owned) {
                Some(path) => self.save_and(context, &path, Some(after)),
                None => self.ask_save(context, Some(after)),
            },
        }
    }

    fn save_and(&mut self, context: &Context, path: &Path, after: Option<AfterDiscard>) {
        if !self.editor.save(path) {
            self.ask_again(Purpose::Save(after), path);
        } else if let Some(after) = after {
            let request = self.editor.discard_and(after);
            self.grant(context, request);
        }
    }

    fn use_chosen(&mut self, context: &Context, chosen: Chosen) {
        let Chosen { purpose, paths } = chosen;
        let Some(path) = paths.first() else {
            return;
        };
        match &purpose {
            Purpose::Save(after) => return self.save_and(context, path, after.clone()),
            Purpose::Open => self.editor.open(path),
            Purpose::Import => self.editor.import(&paths),
            Purpose::Export(export) => self.editor.export(path, export),
        }
        if self
            .editor
            .message()
            .is_some_and(|message| message.is_error)
        {
            self.ask_again(purpose, path);
        }
        context.request_repaint();
    }

    /// Where the window's own prompt was in use, an error is told there; otherwise it stays the
    /// message.
    fn ask_again(&mut self, purpose: Purpose, path: &Path) {
        if self.files.is_native() {
            return;
        }
        if let Some(message) = self.editor.message().cloned() {
            self.editor.dismiss_message();
            self.files.ask_again(purpose, path, message.text);
        }
    }

    fn update_title(&mut self, context: &Context) {
        let name = self.editor.path().and_then(Path::file_name);
        let name = name.map_or("Untitled".into(), |name| name.to_string_lossy());
        let dot = if self.editor.is_modified() {
            "• "
        } else {
            ""
        };
        let title = format!("{dot}{name} – Batten");
        if title != self.title {
            context.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// A window that is closed from outside asks about unsaved changes first.
    fn watch_closing(&mut self, context: &Context) {
        let asked = context.input(|input| input.viewport().close_requested());
        if asked && !self.leaving && self.editor.is_modified() {
            context.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Unsaved(AfterDiscard::Quit));
        }
    }

    fn settings(&self) -> Shell {
        let layers = self.editor.chosen_layers();
        let hidden = Layer::ALL
            .into_iter()
            .enumerate()
            .filter(|(_, layer)| !layers.shows(*layer));
        Shell {
            legs: self.plots.tab() == Tab::Legs,
            hidden: Some(hidden.map(|(place, _)| place).collect()),
            ..self.shell.clone()
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        self.show(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, SETTINGS, &self.settings());
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

fn is_project(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("batten"))
}

/// F6: the keyboard goes on from the canvas to the panels, and back.
fn move_keyboard(context: &Context) {
    context.memory_mut(|memory| {
        if memory.has_focus(canvas::id()) {
            memory.move_focus(egui::FocusDirection::Next);
        } else {
            memory.request_focus(canvas::id());
        }
    });
}

fn hide_layers(editor: &mut Editor, hidden: &[usize]) {
    for (place, layer) in Layer::ALL.into_iter().enumerate() {
        if editor.layers().shows(layer) == hidden.contains(&place) {
            editor.execute(layer.command());
        }
    }
}
