//! The side panel: the list of curves, and below it, one at a time, the inspector, the vertices and what
//! the fields of the operation or the tool.

use eframe::egui::{
    Button, CentralPanel, Context, CursorIcon, Frame, Id, Margin, Panel, Rangef, Rect, Role, Sense,
    Stroke, Ui, WidgetInfo, vec2,
};

use super::action::Action;
use super::canvas::Canvas;
use super::curve_list::CurveList;
use super::end_fit_panel::end_fit_panel_ui;
use super::feature_list::feature_list_ui;
use super::help::{self, Topic};
use super::inspector::Inspector;
use super::operation_panel::OperationPanel;
use super::theme::{ROW, STEP, Tokens};
use super::tool_panel::ToolPanel;
use super::vertex_table::VertexTable;
use super::widgets;
use crate::editor::{Editor, ToolKind};
use crate::operations;

/// The most of the height that the list of curves takes.
const CURVES: f32 = 0.4;

/// The share of the height that the list of features takes at first, and the most.
const FEATURES: [f32; 2] = [0.3, 0.6];

/// The margin above and below a list.
const MARGIN: i8 = 8;

/// The height below which no list is cut.
const LEAST: f32 = 5.0 * ROW;

/// The height of the bar of tabs, and the width of a tab.
const TABS: [f32; 2] = [ROW + 3.0 * STEP, 92.0];

/// The tabs of the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tab {
    #[default]
    Inspector,
    Vertices,
}

/// A task with fields of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Task {
    /// An operation with a preview.
    Preview(&'static str),
    /// An operation that was applied last: its values can still be changed.
    Applied(&'static str),
    /// A tool with fields.
    Tool(ToolKind),
}

/// The side panel's own state.
#[derive(Default)]
pub struct Side {
    curves: CurveList,
    inspector: Inspector,
    table: VertexTable,
    operation: OperationPanel,
    tool: ToolPanel,
    tab: Tab,
    /// The task of the last frame: a new one comes to the front.
    task: Option<Task>,
    /// Whether the task is in front of the tabs.
    is_task_in_front: bool,
}

impl Side {
    /// Show the panel in all the room that there is.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        help::mark(ui, ui.max_rect(), Topic::Curves);
        self.curves_ui(ui, editor, commands);
        self.notice_task(editor);
        let bar = Panel::top("side tabs").resizable(false).exact_size(TABS[0]);
        let bar = bar.frame(Frame::NONE.inner_margin(Margin::symmetric(12, 0)));
        bar.show(ui, |ui| self.tabs_ui(ui, editor));
        let body = CentralPanel::default().frame(Frame::NONE);
        body.show(ui, |ui| {
            widgets::filling(ui, |ui| self.body_ui(ui, editor, commands));
        });
    }

    /// The list of curves, as tall as its rows.
    fn curves_ui(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        let rows = self.curves.height(ui, editor) + 2.0 * f32::from(MARGIN);
        let height = rows
            .min((CURVES * ui.available_height()).max(LEAST))
            .round();
        let panel = Panel::top("curves").resizable(false).exact_size(height);
        let panel = panel.frame(Frame::NONE.inner_margin(Margin::symmetric(12, MARGIN)));
        panel.show(ui, |ui| {
            widgets::filling(ui, |ui| self.curves.show(ui, editor, commands));
        });
    }

    /// Open the field for another name of the active curve or reference.
    pub fn rename_active(&mut self, context: &Context, editor: &Editor) {
        self.curves.rename_active(context, editor);
    }

    /// Take what is typed on the canvas for the tool in the hand, whose panel comes to the front then.
    pub fn take_keys(&mut self, context: &Context, editor: &Editor, canvas: &Canvas) {
        let task = task(editor);
        if matches!(task, Some(Task::Tool(_))) && self.tool.take_keys(context, editor, canvas) {
            self.task = task;
            self.is_task_in_front = true;
        }
    }

    /// Bring a new task to the front. An applied operation keeps the place of its preview.
    fn notice_task(&mut self, editor: &Editor) {
        let task = task(editor);
        if task == self.task {
            return;
        }
        self.is_task_in_front = match (self.task, task) {
            (Some(Task::Preview(before)), Some(Task::Applied(now))) if before == now => {
                self.is_task_in_front
            }
            (_, Some(Task::Applied(_)) | None) => false,
            (_, Some(Task::Preview(_) | Task::Tool(_))) => true,
        };
        self.task = task;
    }

    fn tabs_ui(&mut self, ui: &mut Ui, editor: &Editor) {
        let active = editor.active().and_then(|id| editor.document().curve(id));
        let count = active.map(|curve| curve.polygon.vertices().len());
        let vertices = count.map_or("Vertices".to_owned(), |count| format!("Vertices ({count})"));
        let in_front = self.task.filter(|_| self.is_task_in_front);
        ui.horizontal_centered(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let tab = |ui: &mut Ui, name: &str, is_on: bool| {
                let button = Button::selectable(is_on, name).min_size(vec2(TABS[1], ROW));
                ui.add(button).clicked()
            };
            for (own, name) in [(Tab::Inspector, "Inspector"), (Tab::Vertices, &*vertices)] {
                if tab(ui, name, in_front.is_none() && self.tab == own) {
                    self.tab = own;
                    self.is_task_in_front = false;
                }
            }
            let label = match self.task {
                None => return,
                Some(Task::Preview(_) | Task::Applied(_)) => "Operation",
                Some(Task::Tool(_)) => "Tool",
            };
            if tab(ui, label, in_front.is_some()) {
                self.is_task_in_front = true;
            }
        });
    }

    fn body_ui(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        let pad = Frame::NONE.inner_margin(Margin {
            top: 4,
            ..Margin::symmetric(12, 8)
        });
        let task = self.task.filter(|_| self.is_task_in_front);
        if task.is_none() && self.tab == Tab::Inspector {
            list_ui(ui, "features", |ui| {
                help::mark(ui, ui.max_rect(), Topic::Features);
                ui.strong("Features");
                feature_list_ui(ui, editor);
            });
        }
        if !matches!(task, Some(Task::Tool(_))) {
            self.tool.hide(editor);
        }
        let body = CentralPanel::default().frame(pad);
        body.show(ui, |ui| {
            let reference = editor.active_reference().map(|(_, it)| it);
            let is_picture = reference.as_ref().is_some_and(|it| it.picture.is_some());
            let topic = match (task, self.tab) {
                (Some(Task::Preview(name) | Task::Applied(name)), _) => {
                    operations::find(name).map_or(Topic::Menu("Curve"), Topic::Operation)
                }
                (Some(Task::Tool(ToolKind::EndFit)), _) => Topic::EndFit,
                (Some(Task::Tool(_)), _) => Topic::Tools,
                (None, Tab::Inspector) if is_picture => Topic::Picture,
                (None, Tab::Inspector) if reference.is_some() => Topic::Reference,
                (None, Tab::Inspector) => Topic::Inspector,
                (None, Tab::Vertices) => Topic::Vertices,
            };
            help::mark(ui, ui.max_rect(), topic);
            widgets::filling(ui, |ui| match (task, self.tab) {
                (Some(Task::Preview(_) | Task::Applied(_)), _) => self.operation.show(ui, editor),
                (Some(Task::Tool(ToolKind::EndFit)), _) => end_fit_panel_ui(ui, editor),
                (Some(Task::Tool(_)), _) => {
                    widgets::scrolling(ui, "tool", |ui| self.tool.show(ui, editor));
                }
                (None, Tab::Inspector) => {
                    widgets::scrolling(ui, "inspector", |ui| {
                        self.inspector.show(ui, editor, commands);
                    });
                }
                (None, Tab::Vertices) => self.vertices_ui(ui, editor),
            });
        });
    }

    fn vertices_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let active = editor.active();
        let curve = active.and_then(|id| Some((id, editor.document().curve(id)?.clone())));
        match curve {
            Some((id, curve)) => self.table.show(ui, editor, id, &curve),
            None if active.is_some() => drop(widgets::note(ui, "A reference has no vertices.")),
            None => drop(widgets::note(ui, "Select a curve to see its vertices.")),
        }
    }
}

/// The current task: an operation with a preview, then the tool, then the operation applied last.
fn task(editor: &Editor) -> Option<Task> {
    let in_progress = editor.operation();
    if let Some(in_progress) = in_progress.filter(|_| editor.previewed_operation().is_some()) {
        return Some(Task::Preview(in_progress.operation().name));
    }
    let tool = editor.hand().tool();
    if tool.row().has_panel {
        return Some(Task::Tool(tool));
    }
    let in_progress =
        in_progress.filter(|in_progress| !in_progress.operation().parameters.is_empty())?;
    Some(Task::Applied(in_progress.operation().name))
}

/// Show a list at the bottom, with a share of the height that the user can change, and nothing else does.
fn list_ui(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let height = ui.available_height();
    let id = Id::unique(name);
    let [first, most] = FEATURES;
    let share = ui.data_mut(|data| data.get_persisted::<f32>(id));
    let most = (most * height).max(LEAST);
    let size = (share.unwrap_or(first) * height).clamp(LEAST, most);
    let panel = Panel::bottom(name).frame(Frame::NONE.inner_margin(Margin::symmetric(12, MARGIN)));
    let panel = panel.resizable(false).exact_size(size.round());
    let rect = panel
        .show(ui, |ui| widgets::filling(ui, contents))
        .response
        .rect;
    if let Some(at) = handle_ui(ui, name, rect.x_range(), rect.top()) {
        let share = (rect.bottom() - at).clamp(LEAST, most) / height;
        ui.data_mut(|data| data.insert_persisted(id, share));
    }
}

/// The edge of a list, which can be dragged; returns the place it is dragged to.
fn handle_ui(ui: &mut Ui, name: &str, across: Rangef, line: f32) -> Option<f32> {
    let place = Rect::from_x_y_ranges(across, Rangef::point(line).expand(0.5 * STEP));
    let handle = ui.interact(place, Id::unique(name).with("edge"), Sense::drag());
    let handle = handle.on_hover_and_drag_cursor(CursorIcon::ResizeVertical);
    if handle.hovered() || handle.dragged() {
        let stroke = Stroke::new(1.0, Tokens::of(ui).accent);
        ui.painter().hline(across, line, stroke);
    }
    handle.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, format!("Resize {name}")));
    let at = handle.interact_pointer_pos().filter(|_| handle.dragged());
    at.map(|at| at.y)
}
