//! The application's window: the places of its parts, and the dispatch of actions.

use std::path::{Path, PathBuf};
use std::time::Instant;

use eframe::egui::{self, CentralPanel, Context, Frame, Margin, Panel, Ui, ViewportCommand};

use super::action::Action;
use super::canvas::Canvas;
use super::context_menu::ContextMenu;
use super::dialogs::{self, Decision, Dialog};
use super::document_unit;
use super::export_panel::{ExportAnswer, ExportPanel};
use super::file_dialogs::{AfterDiscard, Chosen, FileDialogs, Purpose};
use super::gizmo::gizmo_ui;
use super::help::{self, Help, Topic};
use super::import_panel::{ImportAnswer, ImportPanel};
use super::judging::Judging;
use super::keyboard::{self, KeyCommand, Keyboard, Typing};
use super::layer_strip::layer_strip_ui;
use super::menu::menu_ui;
use super::message::message_ui;
use super::palette::Palette;
use super::paper_panel::PaperPanel;
use super::pictures::decoded;
use super::plots::{self, Plots, Tab};
use super::recovery::{self, Choice};
use super::shell::Shell;
use super::side::Side;
use super::signals::Signals;
use super::status_bar::{self, status_bar_ui};
use super::theme::{self, Tokens};
use super::tool_rail::{self, tool_rail_ui};
use super::{canvas, overlays, unit_menu, widgets};
use crate::editor::{
    Command, CopyForm, CurvatureDisplay, DrawSettings, DrawWay, Editor, FileAnswer, Layer, MenuOf,
    MenuSubject, PaneLayout, PictureChange, Refusal, Reply, ToolKind, end_drawing, is_project,
    told,
};

use crate::io::{DXF, ExportChoice, Exporter, PROJECT, Scope, formats};

/// Under which name the settings are kept.
const SETTINGS: &str = "window";

/// The application: the editor, and the state of the window.
pub struct App {
    editor: Editor,
    shell: Shell,
    canvas: Canvas,
    keyboard: Keyboard,
    side: Side,
    plots: Plots,
    context_menu: ContextMenu,
    palette: Palette,
    paper: PaperPanel,
    help: Help,
    files: FileDialogs,
    /// The request for files whose reply is not there.
    requested: Option<Requested>,
    dialog: Option<Dialog>,
    import: ImportPanel,
    export: ExportPanel,
    /// The document that is judged as it was before.
    judged: Option<u64>,
    /// Actions that wait for the end of the frame.
    actions: Vec<Action>,
    /// The title that the window has now.
    title: String,
    /// Whether the window may close without another question.
    leaving: bool,
    signals: Signals,
}

/// A request to read or write files, and what follows from its reply.
struct Requested {
    purpose: Purpose,
    path: PathBuf,
    /// Whether the prompt asks again after a refusal.
    asks_again: bool,
}

impl App {
    /// Make the application about an editor. `storage` holds the settings of the last run;
    /// without `native_dialogs` the window has its own prompt for files.
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
        let shell: Shell = kept.unwrap_or_else(|| Shell {
            offers_tour: storage.is_some(),
            ..Shell::default()
        });
        theme::choose(context, shell.dark);
        if let Some(step) = shell.nudge_step {
            editor.hand_mut().set_nudge_step(step);
        }
        if let Some(way) = shell.draw_way.as_deref().and_then(DrawWay::named) {
            let settings = editor.hand().draw_settings();
            let settings = DrawSettings { way, ..settings };
            editor.hand_mut().set_draw_settings(settings);
        }
        for layer in Layer::ALL {
            if let Some(shown) = shell.shows(layer) {
                editor.view_mut().layers.set(layer, shown);
            }
        }
        editor.view_mut().bands_only_plotted = !shell.bands;
        let display = CurvatureDisplay::of_name(&shell.curvature).unwrap_or_default();
        editor.view_mut().curvature_display = display;
        let mut plots = Plots::default();
        if shell.harmony {
            plots.tab = Tab::Harmony;
        }
        Self {
            editor,
            shell,
            canvas: Canvas::default(),
            keyboard: Keyboard::default(),
            side: Side::default(),
            plots,
            context_menu: ContextMenu::default(),
            palette: Palette::default(),
            paper: PaperPanel::default(),
            help: Help::default(),
            files: FileDialogs::new(native_dialogs),
            requested: None,
            dialog: None,
            import: ImportPanel::default(),
            export: ExportPanel::default(),
            judged: None,
            actions: Vec::new(),
            title: String::new(),
            leaving: false,
            signals: Signals::default(),
        }
    }

    /// End in order on SIGTERM, SIGINT or SIGHUP.
    ///
    /// # Errors
    /// If the system does not let signals be heard.
    pub fn listen_to_signals(&mut self, context: &Context) -> std::io::Result<()> {
        self.signals = Signals::listen(context, self.editor.recovery().autosaver().cloned())?;
        Ok(())
    }

    /// The editor behind the window.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// Where the canvas is, or its pane in use, in points of the window; `None` before the first frame.
    pub fn canvas_rect(&self) -> Option<egui::Rect> {
        self.canvas.pane()
    }

    /// Show one frame of the window.
    pub fn show(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        self.editor.begin_frame();
        document_unit::set(&context, self.editor.document().unit());
        self.take_answers(&context);
        self.take_dropped_files(&context);
        self.take_keys(&context);
        self.canvas.send_events(&context, &mut self.editor);
        self.follow_judging();
        self.editor.refresh();
        self.editor.view_mut().hover_nothing();
        self.editor.view_mut().harmony = false;
        if keyboard::is_covered(&context) || self.palette.is_open() {
            self.editor.foresee();
        }
        self.panels_ui(ui);
        self.overlays_ui(&context);
        let actions = std::mem::take(&mut self.actions);
        for action in actions {
            self.perform(&context, action);
            // The panels above have shown the state before.
            context.request_repaint();
        }
        self.update_title(&context);
        self.watch_closing(&context);
        self.keep(&context);
    }

    /// Judge a document that was opened as it was judged before, and keep how it is judged.
    fn follow_judging(&mut self) {
        let workspace = self.editor.workspace();
        let path = workspace.path().map(Path::to_owned);
        let opening = Some(workspace.opening());
        let is_new = std::mem::replace(&mut self.judged, opening) != opening;
        let Some(path) = path else {
            return;
        };
        if is_new && let Some(known) = self.shell.judging_of(&path).cloned() {
            known.restore(&mut self.editor);
        }
        let now = Judging::of(&self.editor);
        if self.shell.judging_of(&path) != Some(&now) {
            self.shell.keep_judging(&path, now);
        }
    }

    /// Autosave unsaved changes, and check the file when the window gets the
    /// keyboard again.
    fn keep(&mut self, context: &Context) {
        let (gained, lost) = context.input(|input| {
            let has = |gains| input.events.contains(&egui::Event::WindowFocused(gains));
            (has(true), has(false))
        });
        if gained {
            self.editor.look_at_file();
            context.request_repaint();
        }
        if let Some(wait) = self.editor.autosave(Instant::now(), lost) {
            context.request_repaint_after(wait);
        }
    }

    fn take_answers(&mut self, context: &Context) {
        self.take_file_reply(context);
        if let Some(chosen) = self.files.answer() {
            self.use_chosen(context, chosen);
        }
    }

    fn take_keys(&mut self, context: &Context) {
        self.help.take_escape(context);
        if let Some(topic) = help::take_key(context) {
            self.help.open_topic(topic);
        }
        if self.palette.is_open() {
            return;
        }
        if context.input(|input| input.key_pressed(egui::Key::F6)) {
            move_keyboard(context);
        }
        self.side.take_keys(context, &self.editor, &self.canvas);
        if keyboard::asks_for_menu(context) {
            self.editor.ask_for_menu(MenuOf::Selection);
        }
        let typing = keyboard::typing(context) == Typing::Text;
        let commands = self.keyboard.take_commands(context, &self.editor);
        if typing && !commands.is_empty() {
            // The field gives up its text before the command runs: that text counts.
            context.memory_mut(|memory| memory.stop_text_input());
        }
        for command in commands {
            match command {
                KeyCommand::Action(action) if typing => self.actions.push(action),
                KeyCommand::Action(action) => self.perform(context, action),
                KeyCommand::Paste(text) => told(self.editor.paste(&text)),
                KeyCommand::PastePicture(image) => {
                    told(self.editor.paste(&decoded(&image)));
                }
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
                self.confirm(context, AfterDiscard::OpenFile(one.clone()));
            }
            several => told(self.editor.import(several)),
        }
    }

    fn panels_ui(&mut self, ui: &mut Ui) {
        let tokens = Tokens::of(ui);
        let frame = |x: i8, y: i8| {
            let margin = Margin::symmetric(x, y);
            Frame::NONE.fill(tokens.panel).inner_margin(margin)
        };
        let menu = Panel::top("menu").frame(frame(4, 2)).resizable(false);
        menu.show(ui, |ui| {
            menu_ui(ui, &mut self.editor, &self.shell, &mut self.actions)
        });
        let status = Panel::bottom("status").frame(frame(12, 0)).resizable(false);
        let status = status.exact_size(status_bar::HEIGHT).show(ui, |ui| {
            let hint = self.plots.hint(ui.ctx());
            let hint = hint.map_or_else(|| self.editor.hint(), str::to_owned);
            let hint = (hint.as_str(), &mut self.actions);
            status_bar_ui(ui, &mut self.editor, &self.shell, hint);
        });
        help::mark(ui, status.response.rect, Topic::StatusBar);
        let rail = Panel::left("tools").frame(frame(4, 4)).resizable(false);
        let names = self.shell.tool_names;
        let rail = rail.exact_size(tool_rail::width(names)).show(ui, |ui| {
            tool_rail_ui(ui, &self.editor, names, &mut self.actions);
        });
        help::mark(ui, rail.response.rect, Topic::Tools);
        if let Some(page) = self.paper.show(ui, &mut self.editor) {
            self.confirm(&ui.ctx().clone(), AfterDiscard::OpenPaper(page));
        }
        let side = Panel::right("side").frame(Frame::NONE.fill(tokens.panel));
        let side = side.default_size(320.0).size_range(280.0..=520.0);
        side.show(ui, |ui| {
            widgets::filling(ui, |ui| {
                self.side.show(ui, &mut self.editor, &mut self.actions)
            });
        });
        self.plots_ui(ui, frame(8, 0));
        let canvas = CentralPanel::default().frame(Frame::NONE.fill(tokens.background));
        canvas.show(ui, |ui| {
            self.canvas.show(ui, &mut self.editor);
            let is_one = self.editor.view().pane_layout() == PaneLayout::One;
            if let Some(rect) = self.canvas.rect().filter(|_| is_one) {
                gizmo_ui(ui, rect, &mut self.editor, &mut self.actions);
            }
        });
    }

    fn plots_ui(&mut self, ui: &mut Ui, frame: Frame) {
        let (editor, actions) = (&mut self.editor, &mut self.actions);
        self.plots.normalised = self.shell.normalised;
        if !self.shell.plots {
            editor.view_mut().plot = None;
            let bar = Panel::bottom("plots folded").frame(frame).resizable(false);
            let bar = bar.exact_size(plots::BAR);
            bar.show(ui, |ui| self.plots.bar_ui(ui, editor, false, actions));
            return;
        }
        let panel = Panel::bottom("plots").frame(frame).resizable(true);
        let panel = panel.default_size(232.0).size_range(168.0..=640.0);
        let shown = panel.show(ui, |ui| {
            self.plots.navigation.fingers = self.canvas.has_fingers();
            widgets::filling(ui, |ui| {
                let bar = egui::vec2(ui.available_width(), plots::BAR);
                ui.allocate_ui(bar, |ui| self.plots.bar_ui(ui, editor, true, actions));
                self.plots.show(ui, editor);
            });
        });
        let topic = match self.plots.tab {
            Tab::Harmony => Topic::Harmony,
            _ => Topic::Plots,
        };
        help::mark(ui, shown.response.rect, topic);
        if is_menu_asked_for(ui, shown.response.rect) {
            self.editor.hand_mut().ask_for_menu(MenuSubject::Plot);
        }
    }

    fn overlays_ui(&mut self, context: &Context) {
        if let Some(rect) = self.canvas.rect() {
            layer_strip_ui(context, rect, &mut self.editor, &mut self.actions);
            message_ui(context, rect, &mut self.editor, &mut self.actions);
            let is_one = self.editor.view().pane_layout() == PaneLayout::One;
            if is_one && self.editor.sight().is_orbited() {
                overlays::orbited_ui(context, rect, &mut self.actions);
            }
            if self.editor.view().evolute.is_hidden {
                overlays::hidden_evolute_ui(context, rect, &mut self.editor);
            }
            // What a tool asks for stands in its place.
            let is_idle = self.editor.hand().tool() == ToolKind::Select;
            // Over a document of the user's own it would lie in the way.
            let is_new = self.editor.workspace().has_nothing_to_keep();
            if self.shell.offers_tour
                && is_idle
                && is_new
                && overlays::tour_ui(context, rect, &mut self.actions)
            {
                self.shell.offers_tour = false;
            }
            overlays::drop_ui(context, rect);
            if self.editor.document().is_empty() && self.editor.hand().tool() != ToolKind::Draw {
                overlays::empty_ui(context, rect);
            }
        }
        let canvas = self.canvas.pane().map_or(egui::Pos2::ZERO, |rect| rect.min);
        let (shell, actions) = (&self.shell, &mut self.actions);
        self.context_menu
            .show(context, canvas, &mut self.editor, shell, actions);
        self.palette.show(context, &self.editor, &mut self.actions);
        self.help.show(context);
        if let Some(chosen) = self.files.show(context) {
            self.use_chosen(context, chosen);
        }
        if let Some(incoming) = self.editor.filing().unit_question()
            && let Some(answer) = dialogs::unit_ui(context, incoming)
        {
            told(self.editor.answer_files(answer.map(FileAnswer::Unit)));
        }
        if let Some(question) = self.editor.filing().column_question()
            && let Some(answer) = dialogs::columns_ui(context, question)
        {
            told(self.editor.answer_files(answer.map(FileAnswer::Columns)));
        }
        let question = self.editor.filing().import_question();
        match self.import.show(context, question, self.editor.document()) {
            Some(ImportAnswer::Cancel) => told(self.editor.answer_files(None)),
            Some(ImportAnswer::Take(choices)) => {
                told(self.editor.answer_files(Some(FileAnswer::Import(choices))));
            }
            None => {}
        }
        match self.export.show(context, &mut self.editor) {
            Some(ExportAnswer::Write(choice)) => self.ask_export(context, choice),
            Some(ExportAnswer::Cancel) | None => {}
        }
        match recovery::recovery_ui(context, self.editor.recovery().recoverable()) {
            Some(Choice::Open(id)) => self.confirm(context, AfterDiscard::Recover(id)),
            Some(Choice::Discard(id)) => self.editor.recovery_mut().discard(id),
            Some(Choice::Later) => self.editor.recovery_mut().leave(),
            None => {}
        }
        let dialog = self.dialog.as_ref();
        let decided = dialog.and_then(|it| dialogs::dialog_ui(context, it, &self.editor));
        if let Some(decision) = decided {
            self.dialog = None;
            self.decide(context, decision);
            context.request_repaint();
        }
    }

    fn perform(&mut self, context: &Context, action: Action) {
        // A key also gives a command that menus do not offer: the editor says why it cannot be given.
        let is_answered = matches!(action, Action::Command(_));
        if !is_answered && !action.is_enabled(&self.editor) {
            return;
        }
        if action.covers_canvas() && self.editor.hand().is_dragging() {
            self.editor.interrupt();
        }
        match action {
            Action::Command(command) => {
                if command == Command::Undo {
                    // A field's drag that is taken back must not go on.
                    context.stop_dragging();
                }
                told(self.editor.execute(command));
            }
            Action::New => self.confirm(context, AfterDiscard::New),
            Action::Open => {
                self.editor.interrupt();
                self.files.ask(context, Purpose::Open, self.folder());
            }
            Action::ChooseImport => told(self.editor.answer_files(Some(FileAnswer::Anew))),
            Action::OpenExample(index) => self.confirm(context, AfterDiscard::OpenExample(index)),
            Action::Paper => self.confirm(context, AfterDiscard::OpenPaper(self.paper.page())),
            Action::Quit => self.confirm(context, AfterDiscard::Quit),
            Action::Import => self.files.ask(context, Purpose::Import, self.folder()),
            Action::Picture => self.files.ask(context, Purpose::Picture, self.folder()),
            Action::RelinkPicture => self.files.ask(context, Purpose::Relink, self.folder()),
            Action::Save => self.save_own(context, None, false),
            Action::SaveAs => self.ask_save(context, None),
            Action::Reload => told(self.editor.reload()),
            Action::Export(exporter) => {
                let choice = self.export_choice(Some(exporter));
                self.export.open(choice);
            }
            Action::ExportLast => {
                let choice = self.export_choice(None);
                self.export.open(choice);
            }
            Action::Cut => copy(context, self.editor.cut()),
            Action::Copy => copy(context, self.editor.copy(CopyForm::Own)),
            Action::CopyAs(form) => copy(context, self.editor.copy(form)),
            Action::Rename => self.side.rename_active(context, &self.editor),
            Action::Paste => context.send_viewport_cmd(ViewportCommand::RequestPaste),
            Action::ToggleTheme => {
                self.shell.dark = !self.shell.dark;
                theme::choose(context, self.shell.dark);
            }
            Action::ToggleToolNames => self.shell.tool_names = !self.shell.tool_names,
            Action::TogglePlots => self.shell.plots = !self.shell.plots,
            Action::FitPlot => self.plots.fit(),
            Action::NormaliseLength => self.shell.normalised = !self.shell.normalised,
            Action::NudgeStep => unit_menu::open(context),
            Action::Palette => self.palette.open(),
            Action::Manual => self.help.open(),
            Action::Keys => self.dialog = Some(Dialog::Keys),
            Action::About => self.dialog = Some(Dialog::About),
        }
    }

    /// Ask about unsaved changes if there are any, otherwise go on.
    fn confirm(&mut self, context: &Context, after: AfterDiscard) {
        end_drawing(&mut self.editor);
        // The question says that a preview is not applied.
        if self.editor.previewed_operation().is_none() {
            self.editor.interrupt();
        }
        if self.editor.workspace().is_modified() {
            self.dialog = Some(Dialog::Unsaved(after));
        } else {
            self.go_on(context, after);
        }
    }

    /// Take the next step: nothing is unsaved, or it may be lost.
    fn go_on(&mut self, context: &Context, after: AfterDiscard) {
        match after {
            AfterDiscard::New => self.editor.begin_empty(),
            AfterDiscard::OpenFile(path) => told(self.editor.open(&[path])),
            AfterDiscard::Recover(id) => told(self.editor.recover(id)),
            AfterDiscard::OpenExample(index) => told(self.editor.open_example(index)),
            AfterDiscard::OpenPaper(page) => {
                if page.open(&mut self.editor).is_ok() {
                    self.paper.open(page);
                }
            }
            AfterDiscard::Quit => {
                self.leaving = true;
                context.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// What an export begins with: the document's last choice if it has the format, or as the row of the menu says.
    fn export_choice(&self, exporter: Option<Exporter>) -> ExportChoice {
        let workspace = self.editor.workspace();
        let last = self.editor.filing().last_export(workspace).cloned();
        let last = last.or_else(|| self.shell.export_of(workspace.path()?));
        let first = || {
            let mut exporters = formats::exporters().into_iter();
            exporters.find(|it| it.format == &DXF)
        };
        match (exporter, last) {
            (None, Some(last)) => last,
            (Some(exporter), Some(last)) if last.format == exporter.format => last,
            (exporter, _) => {
                let choice = match exporter.or_else(first) {
                    Some(exporter) => ExportChoice::of(exporter),
                    None => ExportChoice::new(&DXF),
                };
                // One is selected always; several are by intent.
                let has_several = self.editor.hand().selection().has_several_items();
                let scope = if has_several {
                    Scope::Selected
                } else {
                    choice.scope
                };
                ExportChoice { scope, ..choice }
            }
        }
    }

    fn ask_export(&mut self, context: &Context, choice: Box<ExportChoice>) {
        let workspace = self.editor.workspace();
        if let Some(path) = workspace.path() {
            self.shell.keep_export(path, &choice);
        }
        let extension = choice.format.extension();
        let stem = self.editor.workspace().path().and_then(Path::file_stem);
        let name = stem.map(|stem| stem.to_string_lossy().into_owned());
        // All curves are written: one names the file only if it is alone.
        let document = self.editor.document();
        let mut curves = document.curves();
        let only = curves.next().filter(|_| curves.next().is_none());
        let name = name.or_else(|| only.map(|(_, curve)| curve.name.clone()));
        let name = name.unwrap_or_else(|| "curves".into());
        let proposal = self.folder().join(format!("{name}.{extension}"));
        self.files.ask(context, Purpose::Export(choice), proposal);
    }

    fn ask_save(&mut self, context: &Context, after: Option<AfterDiscard>) {
        let named = self.editor.workspace().path().map(|path| {
            let holds_all = formats::to_write(path).is_ok_and(|format| format.holds_documents);
            // The file of another program may be in a folder that is removed afterwards.
            match holds_all {
                true => path.to_owned(),
                false => working_folder().join(
                    path.with_extension(PROJECT.extension())
                        .file_name()
                        .unwrap_or_default(),
                ),
            }
        });
        let proposal = named.unwrap_or_else(|| self.folder().join("untitled.batten"));
        self.files.ask(context, Purpose::Save(after), proposal);
    }

    /// Where questions for files begin: beside the document's file, otherwise where the program
    /// was started. Ends with a separator, so that a name can be typed behind it.
    fn folder(&self) -> PathBuf {
        let beside = self.editor.workspace().path().and_then(Path::parent);
        let folder = beside.filter(|folder| folder.is_dir()).map(Path::to_owned);
        folder.unwrap_or_else(working_folder).join("")
    }

    fn decide(&mut self, context: &Context, decision: Decision) {
        match decision {
            Decision::Close => {}
            Decision::Discard(after) => self.go_on(context, after),
            Decision::Save(after) => self.save_own(context, Some(after), false),
            Decision::SaveAs(after) => self.ask_save(context, after),
            Decision::Overwrite(after) => self.save_own(context, after, true),
            Decision::Accept(after) => {
                self.editor.filing_mut().accept_losses();
                self.save_own(context, after, false);
            }
            Decision::Reload => told(self.editor.reload()),
        }
    }

    /// Save to the document's own file: unless another program has changed it, or whatever it holds.
    fn save_own(&mut self, context: &Context, after: Option<AfterDiscard>, overwrites: bool) {
        let Some(path) = self.editor.workspace().path().map(Path::to_owned) else {
            return self.ask_save(context, after);
        };
        let requested = Requested {
            asks_again: after.is_some(),
            purpose: Purpose::Save(after),
            path,
        };
        self.request_files(context, requested, |editor, path| match overwrites {
            true => editor.save(path),
            false => editor.save_unless_changed(),
        });
    }

    fn use_chosen(&mut self, context: &Context, chosen: Chosen) {
        let Chosen { purpose, paths } = chosen;
        let Some(path) = paths.first().cloned() else {
            return;
        };
        if purpose == Purpose::Open && is_project(&path) && self.editor.workspace().is_modified() {
            // Anything else is added. The Enter that ended the prompt is no answer to this question.
            context.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Enter));
            self.confirm(context, AfterDiscard::OpenFile(path));
            return;
        }
        if purpose == Purpose::Relink {
            told(PictureChange::Relink(path).apply(&mut self.editor));
            return;
        }
        let requested = Requested {
            purpose: purpose.clone(),
            path,
            asks_again: true,
        };
        self.request_files(context, requested, |editor, path| match purpose {
            Purpose::Save(_) => editor.save(path),
            Purpose::Open => editor.open(&paths),
            Purpose::Import | Purpose::Picture | Purpose::Relink => editor.import(&paths),
            Purpose::Export(choice) => editor.export(path, &choice),
        });
        context.request_repaint();
    }

    /// Request to read or write files. What follows from the reply is done when it is there.
    fn request_files(
        &mut self,
        context: &Context,
        requested: Requested,
        request: impl FnOnce(&mut Editor, &Path) -> Reply,
    ) {
        let is_busy = self.editor.filing().work().is_some();
        told(request(&mut self.editor, &requested.path));
        // While another task runs, the request is refused.
        if !is_busy {
            self.requested = Some(requested);
            self.take_file_reply(context);
        }
    }

    /// Do what follows from the reply to the last request for files, once it is there.
    fn take_file_reply(&mut self, context: &Context) {
        let Some(answer) = self.editor.filing_mut().take_reply() else {
            return;
        };
        let Some(requested) = self.requested.take() else {
            return;
        };
        match (requested.purpose, answer.reply) {
            (Purpose::Save(after), _) if answer.is_file_changed => {
                self.editor.dismiss_message();
                self.dialog = Some(Dialog::Changed(after));
            }
            (Purpose::Save(after), _) if !answer.losses.is_empty() => {
                self.editor.dismiss_message();
                self.dialog = Some(Dialog::Losses(answer.losses, after));
            }
            // In the system's dialogs the refusal stays the message.
            (purpose, Err(Refusal(reason))) if requested.asks_again && !self.files.is_native() => {
                self.editor.dismiss_message();
                self.files.ask_again(purpose, &requested.path, reason);
            }
            (Purpose::Save(Some(after)), Ok(_)) => self.go_on(context, after),
            _ => {}
        }
    }

    fn update_title(&mut self, context: &Context) {
        let name = self.editor.workspace().path().and_then(Path::file_name);
        let name = name.map_or("Untitled".into(), |name| name.to_string_lossy());
        let is_modified = self.editor.workspace().is_modified();
        let dot = if is_modified { "• " } else { "" };
        let title = format!("{dot}{name} – Batten");
        if title != self.title {
            context.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// A window closed from outside asks about unsaved changes first; a signal closes it at
    /// once, as autosaving keeps them.
    fn watch_closing(&mut self, context: &Context) {
        if self.signals.have_come() {
            context.send_viewport_cmd(ViewportCommand::Close);
            return;
        }
        let asked = context.input(|input| input.viewport().close_requested());
        if !asked || self.leaving {
            return;
        }
        end_drawing(&mut self.editor);
        if self.editor.workspace().is_modified() {
            context.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Unsaved(AfterDiscard::Quit));
        }
    }

    fn settings(&self) -> Shell {
        let mut shell = Shell {
            harmony: self.plots.tab == Tab::Harmony,
            nudge_step: Some(self.editor.hand().nudge_step()),
            draw_way: Some(self.editor.hand().draw_settings().way.label().to_owned()),
            bands: !self.editor.view().bands_only_plotted,
            curvature: self.editor.view().curvature_display.name().to_owned(),
            ..self.shell.clone()
        };
        shell.keep_layers(self.editor.view().layers);
        shell
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        self.show(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, SETTINGS, &self.settings());
    }

    fn on_exit(&mut self, _: Option<&eframe::glow::Context>) {
        told(self.editor.close(!self.leaving));
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

/// Where the program was started.
fn working_folder() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

fn copy(context: &Context, copied: Result<String, Refusal>) {
    if let Ok(text) = copied {
        context.copy_text(text);
    }
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

/// Whether the second button was clicked in a box: pressed and released, not dragged.
fn is_menu_asked_for(ui: &Ui, rect: egui::Rect) -> bool {
    let clicked = ui.input(|input| {
        let pointer = &input.pointer;
        let inside = pointer.interact_pos().is_some_and(|at| rect.contains(at));
        inside && pointer.button_clicked(egui::PointerButton::Secondary)
    });
    clicked && !keyboard::is_covered(ui.ctx())
}
