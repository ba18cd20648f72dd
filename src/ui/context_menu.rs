//! Menus of the item under the pointer, read from the table of commands.

use eframe::egui::{
    Align, Context, Id, LayerId, Layout, Popup, PopupKind, Pos2, SetOpenCommand, containers, vec2,
};

use super::action::Action;
use super::menu::{
    ARRANGE, Entry, Entry::Divider, arrangements, command, compare, entries_ui, layers, references,
    views,
};
use super::menu_item::WIDTH;
use super::shell::Shell;
use crate::editor::{Command, Editor, Follow, Layer, MenuSubject, ToolKind, met_curves};
use crate::geometry::Continuity;
use crate::operations::{self, Inputs, Operation};

/// The open context menu.
#[derive(Default)]
pub struct ContextMenu {
    open: Option<Shown>,
}

/// A menu that is open.
#[derive(Clone, Copy)]
struct Shown {
    subject: MenuSubject,
    at: Pos2,
    /// Whether its first line is still to get the keyboard: it was opened by a key.
    takes_keyboard: bool,
}

impl ContextMenu {
    /// Show the requested menu, or the open one; `canvas` is the canvas's upper left corner.
    pub fn show(
        &mut self,
        context: &Context,
        canvas: Pos2,
        editor: &mut Editor,
        shell: &Shell,
        commands: &mut Vec<Action>,
    ) {
        let asked = editor.hand_mut().take_menu();
        if let Some(asked) = asked {
            let pointer = context.input(|input| input.pointer.latest_pos());
            let by_key = asked.at.map(|at| canvas + vec2(at.x as f32, at.y as f32));
            self.open = Some(Shown {
                subject: asked.subject,
                at: by_key.or(pointer).unwrap_or(canvas),
                takes_keyboard: by_key.is_some(),
            });
        }
        let Some(open) = &mut self.open else {
            return;
        };
        let (subject, at) = (open.subject, open.at);
        let id = Id::unique("context menu");
        let popup = Popup::new(id, context.clone(), at, LayerId::background())
            .kind(PopupKind::Menu)
            .layout(Layout::top_down_justified(Align::Min))
            .style(containers::menu::menu_style)
            .open_memory(asked.map(|_| SetOpenCommand::Bool(true)))
            .gap(0.0);
        let shown = popup.show(|ui| {
            ui.set_min_width(WIDTH);
            let first = entries_ui(ui, editor, shell, entries(subject, editor), commands);
            // While its size is found nothing in it is enabled.
            if let Some(first) = first.filter(|_| open.takes_keyboard) {
                first.request_focus();
                open.takes_keyboard = false;
            }
        });
        if shown.is_none() {
            self.open = None;
        }
    }
}

fn tool(tool: ToolKind) -> Entry {
    command(Command::Tool(tool))
}

fn layer(layer: Layer) -> Entry {
    command(Command::ToggleLayer(layer))
}

fn operation(operation: &'static Operation) -> Entry {
    command(Command::Operation(operation))
}

/// The matches of an end to the ends that it meets, in a menu of their own; where it meets none, the tool that matches it.
fn matches(editor: &Editor) -> Entry {
    let levels = |source| Continuity::ALL.map(|level| command(Command::Match(source, level)));
    let matches: Vec<Entry> = met_curves(editor).into_iter().flat_map(levels).collect();
    match matches.is_empty() {
        true => tool(ToolKind::EndFit),
        false => Entry::Submenu(
            "Match",
            [tool(ToolKind::EndFit), Divider]
                .into_iter()
                .chain(matches)
                .collect(),
        ),
    }
}

/// The entries of a subject.
fn entries(subject: MenuSubject, editor: &Editor) -> Vec<Entry> {
    match subject {
        MenuSubject::Vertex | MenuSubject::Leg => vec![
            command(Command::Delete),
            Entry::Action(Action::Cut),
            Entry::Action(Action::Copy),
            Divider,
            match subject {
                MenuSubject::Leg => tool(ToolKind::Insert),
                _ => layer(Layer::SafeRegion),
            },
            command(Command::ToggleVerticesLocked),
            tool(ToolKind::Rotate),
            tool(ToolKind::Scale),
            Entry::Submenu(ARRANGE, arrangements()),
            Divider,
            command(Command::Follow(Follow::InHarmony)),
            command(Command::Follow(Follow::Softly)),
            command(Command::ToggleKeeping),
            Divider,
            command(Command::SelectAll),
            command(Command::Fit),
        ],
        MenuSubject::End => vec![
            matches(editor),
            operation(&operations::extend::OPERATION),
            operation(&operations::trim::OPERATION),
            Divider,
            operation(&operations::translate_end::OPERATION),
            operation(&operations::rotate_end::OPERATION),
            operation(&operations::correct_ends::OPERATION),
            Divider,
            operation(&operations::between::OPERATION),
            operation(&operations::join::OPERATION),
            operation(&operations::close::OPERATION),
        ],
        MenuSubject::Curve | MenuSubject::Reference => {
            let mut entries = vec![
                command(Command::Duplicate),
                Entry::Action(Action::Rename),
                command(Command::DeleteCurve),
                Entry::Action(Action::Copy),
                Divider,
            ];
            let (rotate, scale) = (tool(ToolKind::Rotate), tool(ToolKind::Scale));
            let arrange = Entry::Submenu(ARRANGE, arrangements());
            if subject == MenuSubject::Curve {
                let mut changing = operations::ALL.to_vec();
                changing.retain(|it| {
                    !matches!(
                        it.inputs,
                        Inputs::None | Inputs::Points | Inputs::References
                    )
                });
                let changing = changing.into_iter().map(operation).collect();
                let operations = Entry::Submenu("Operations", changing);
                let periodic = command(Command::TogglePeriodic);
                let symmetric = command(Command::ToggleSymmetric);
                let select = command(Command::SelectAll);
                entries.extend([
                    operations, periodic, symmetric, rotate, scale, arrange, Divider, select,
                ]);
            } else {
                let document = editor.document();
                let reference = editor.active().and_then(|id| document.reference(id));
                let is_list = reference.is_some_and(|it| it.points().is_some());
                let fit = operation(match is_list {
                    true => &operations::fit::OPERATION,
                    false => &operations::approximate::OPERATION,
                });
                entries.push(fit);
                if !is_list {
                    entries.push(operation(&operations::to_float::OPERATION));
                }
                entries.extend([rotate, scale, arrange, Divider]);
            }
            entries.extend([
                command(Command::Fit),
                Divider,
                command(Command::ToggleVisible),
                command(Command::ToggleLocked),
                command(Command::Group),
                command(Command::Isolate),
            ]);
            entries
        }
        MenuSubject::Canvas => vec![
            command(Command::Undo),
            command(Command::Redo),
            Divider,
            Entry::Action(Action::Paste),
            tool(ToolKind::Draw),
            references(),
            Divider,
            command(Command::ShowAll),
            command(Command::SelectAll),
            command(Command::SelectNone),
            Divider,
            command(Command::FitAll),
            views(),
            Entry::Submenu("Layers", layers()),
            command(Command::ToggleSnapping),
        ],
        MenuSubject::Feature => vec![
            command(Command::GoToFeature),
            Divider,
            layer(Layer::Features),
            command(Command::ToggleBands),
            command(Command::ToggleKeeping),
            Divider,
            operation(&operations::split::OPERATION),
            operation(&operations::trim::OPERATION),
            operation(&operations::harmonise::OPERATION),
        ],
        MenuSubject::Plot => vec![
            Entry::Action(Action::FitPlot),
            Entry::Action(Action::NormaliseLength),
            compare(editor),
            Divider,
            layer(Layer::Features),
            layer(Layer::Comb),
            command(Command::ResetComb),
            Divider,
            operation(&operations::harmonise::OPERATION),
            Divider,
            Entry::Action(Action::TogglePlots),
        ],
    }
}
