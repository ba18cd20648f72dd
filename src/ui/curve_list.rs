//! The list of curves, and of references below them, by groups.

use std::collections::BTreeSet;

use eframe::egui::{Align2, Context, Id, Key, Rect, Sense, TextEdit, Ui, UiBuilder, pos2, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::curve_item::Item;
use super::draft;
use super::group_heading::Heading;
use super::group_rows::{Row, rows};
use super::keyboard::{self, Typing};
use super::theme::{ROW, STEP};
use super::widgets::{self, IconButton};
use crate::document::{CurveId, Document, Edit, Group};
use crate::editor::{Command, Editor, MenuOf, told};

/// How far each group indents its rows.
const INDENT: f32 = 3.0 * STEP;

/// The list's own state: the name that is being typed, and the groups that are folded.
#[derive(Default)]
pub struct CurveList {
    renaming: Option<Renaming>,
    /// The groups of which only the headings are shown.
    folded: BTreeSet<Group>,
    /// The text that names or groups of shown rows contain; `None` while its field is closed.
    filter: Option<String>,
    /// Whether the field of the filter has just been opened.
    opens_filter: bool,
    /// Whether only the heading is shown.
    is_collapsed: bool,
    /// The curve or reference whose row the list scrolled to when it became active.
    in_sight: Option<CurveId>,
}

/// What gets another name.
#[derive(Clone, PartialEq)]
enum Named {
    /// A curve or a reference.
    Item(CurveId),
    /// A group.
    Group(Group),
}

struct Renaming {
    named: Named,
    text: String,
    is_new: bool,
}

/// The field of the name that is being typed.
fn field_id() -> Id {
    Id::unique("name of a curve")
}

impl CurveList {
    /// Open the field for another name of the active curve or reference.
    pub fn rename_active(&mut self, context: &Context, editor: &Editor) {
        if let Some(active) = editor.active() {
            if let Some(group) = editor.document().group(active) {
                self.folded.retain(|folded| !folded.holds(group));
            }
            self.begin_renaming(context, editor, Named::Item(active));
        }
    }

    /// The height that the heading and all rows take.
    pub fn height(&self, ui: &Ui, editor: &Editor) -> f32 {
        if self.is_collapsed {
            return ROW;
        }
        let field = match self.filter {
            Some(_) => ROW + ui.spacing().item_spacing.y,
            None => 0.0,
        };
        // Rows come and go while a filter is typed; the list keeps its height.
        let rows = self.row_count(editor.document());
        // The note of an empty list wraps to two lines.
        ROW + ui.spacing().item_spacing.y + field + ROW * rows.max(2) as f32
    }

    /// How many rows there are without a filter.
    fn row_count(&self, document: &Document) -> usize {
        let curves = document.curves().map(|(_, curve)| &curve.group);
        let references = document.references().map(|(_, it)| &it.group);
        let groups: Vec<&Group> = curves.chain(references).collect();
        rows(&groups, |group| group, &self.folded).len()
    }

    /// Show the list with its heading.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, commands: &mut Vec<Action>) {
        let mut items = Item::all(editor);
        self.heading_ui(ui, editor, &items, commands);
        if self.is_collapsed {
            return;
        }
        if items.is_empty() {
            let text = "No curves yet. Draw one with D, or open a file or an example.";
            widgets::note(ui, text);
            return;
        }
        self.filter_ui(ui);
        let mut folded = self.folded.clone();
        if let Some(filter) = self.filter.as_ref().filter(|filter| !filter.is_empty()) {
            items.retain(|item| is_found(item, filter));
            folded.clear();
        }
        let rows = rows(&items, |item| &item.group, &folded);
        if rows.is_empty() {
            widgets::note(ui, "No name contains this text.");
            return;
        }
        let shown = rows.iter().filter_map(|row| match row {
            Row::Item { item, .. } => Some(item.id),
            Row::Group(_) => None,
        });
        let shown: Vec<CurveId> = shown.collect();
        let is_sought = |row: &Row<'_, Item>| match row {
            Row::Item { item, .. } => item.active,
            Row::Group(_) => false,
        };
        let sought = rows.iter().position(is_sought);
        let sought = sought.filter(|_| self.in_sight != editor.active());
        self.in_sight = editor.active();
        let count = rows.len();
        let renamed = widgets::scrolling_rows(ui, "curves", count, sought, |ui, seen| {
            let mut renamed = None;
            let passed = (seen.start, seen.len());
            for row in rows.into_iter().skip(passed.0).take(passed.1) {
                let named = match row {
                    Row::Group(group) => {
                        let heading = Heading::from(group);
                        let row = |ui: &mut Ui| self.group_ui(ui, editor, &heading);
                        ui.push_id(&heading.group, row).inner
                    }
                    Row::Item { item, depth } => {
                        let row = |ui: &mut Ui| self.row_ui(ui, editor, item, (depth, &shown));
                        ui.push_id(item.id, row).inner
                    }
                };
                renamed = named.or(renamed);
            }
            renamed
        });
        // The field takes the keyboard after the row that was clicked has had it.
        if let Some(named) = renamed {
            self.begin_renaming(ui.ctx(), editor, named);
        }
    }

    /// Show the field of the filter, if it is open. Esc closes it.
    fn filter_ui(&mut self, ui: &mut Ui) {
        let Some(filter) = &mut self.filter else {
            return;
        };
        let field = TextEdit::singleline(filter)
            .id(filter_id())
            .hint_text("Part of a name or a group")
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER)
            .min_size(vec2(0.0, ROW));
        let response = ui.add(field).accessible_name("Filter of curves");
        keyboard::claim(ui.ctx(), filter_id(), Typing::Text, response.rect);
        if std::mem::take(&mut self.opens_filter) {
            response.request_focus();
        }
        if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.filter = None;
        }
    }

    /// Open the field for a name; from now on keys are the field's.
    fn begin_renaming(&mut self, context: &Context, editor: &Editor, named: Named) {
        let text = match &named {
            Named::Item(id) => editor.document().name(*id).map(str::to_owned),
            Named::Group(group) => Some(group.to_string()),
        };
        self.renaming = text.map(|text| {
            draft::select_all(context, field_id(), &text);
            Renaming {
                named,
                text,
                is_new: true,
            }
        });
        keyboard::claim(context, field_id(), Typing::Text, Rect::NOTHING);
        context.memory_mut(|memory| memory.request_focus(field_id()));
    }

    /// Show the heading of a group; returns the group if a double-click renames it.
    fn group_ui(&mut self, ui: &mut Ui, editor: &mut Editor, heading: &Heading) -> Option<Named> {
        let (row, response) = widgets::row(ui, Sense::click(), false);
        let rect = indented(row, heading.depth);
        heading.paint(ui, rect, &response);
        heading.take_dropped(ui, editor, row, &response);
        if response.clicked() {
            self.fold(&heading.group, !heading.is_folded);
        }
        let inner = rect.shrink2(vec2(2.0 * STEP, 0.0));
        let builder = UiBuilder::new().max_rect(inner).id_salt(&heading.group);
        ui.scope_builder(builder, |ui| {
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                heading.switches_ui(ui, editor, row);
            });
        });
        let renames = response.double_clicked();
        let named = Named::Group(heading.group.clone());
        match self.renaming.as_ref().is_some_and(|it| it.named == named) {
            true => self.renaming_ui(ui, editor, name_rect(inner)),
            false => heading.name_ui(ui, name_rect(inner), response),
        }
        renames.then_some(named)
    }

    fn fold(&mut self, group: &Group, is_folded: bool) {
        match is_folded {
            true => self.folded.insert(group.clone()),
            false => self.folded.remove(group),
        };
    }

    /// Show a row; returns the item if a double-click renames it.
    fn row_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        item: &Item,
        (depth, shown): (usize, &[CurveId]),
    ) -> Option<Named> {
        let (row, response) = widgets::row(ui, Sense::click_and_drag(), item.selected);
        let rect = indented(row, depth);
        item.paint(ui, rect, &response);
        item.reorder(ui, editor, row, &response);
        let renames = response.double_clicked();
        if response.clicked() && !renames {
            let modifiers = ui.input(|input| input.modifiers);
            pick(editor, item.id, (modifiers.command, modifiers.shift), shown);
        }
        if response.secondary_clicked() {
            editor.ask_for_menu(MenuOf::Item(item.id));
        }
        let inner = rect.shrink2(vec2(2.0 * STEP, 0.0));
        let builder = UiBuilder::new().max_rect(inner).id_salt(item.id);
        ui.scope_builder(builder, |ui| {
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                item.switches_ui(ui, editor, row);
            });
        });
        let named = Named::Item(item.id);
        match self.renaming.as_ref().is_some_and(|it| it.named == named) {
            true => self.renaming_ui(ui, editor, name_rect(inner)),
            false => item.name_ui(ui, name_rect(inner), response),
        }
        renames.then_some(named)
    }

    fn renaming_ui(&mut self, ui: &mut Ui, editor: &mut Editor, rect: Rect) {
        let Some(renaming) = &mut self.renaming else {
            return;
        };
        let field = TextEdit::singleline(&mut renaming.text)
            .id(field_id())
            .align(Align2::LEFT_CENTER)
            .min_size(rect.size())
            .desired_width(rect.width());
        let label = match renaming.named {
            Named::Item(_) => "Curve name",
            Named::Group(_) => "Group path",
        };
        let response = ui.put(rect, field).accessible_name(label);
        keyboard::claim(ui.ctx(), field_id(), Typing::Text, rect);
        if renaming.is_new {
            ui.scroll_to_rect(rect, None);
        }
        if std::mem::take(&mut renaming.is_new) || !response.lost_focus() {
            return;
        }
        let is_cancelled = ui.input(|input| input.key_pressed(Key::Escape));
        if let Some(Renaming { named, text, .. }) = self.renaming.take()
            && !is_cancelled
        {
            match named {
                Named::Item(curve) => told(editor.change(Edit::Rename { curve, name: text })),
                Named::Group(group) => rename_group(editor, group, &text),
            }
        }
    }
}

/// Select the item of a row that is clicked: alone, with Ctrl beside others or no more, and with Shift all rows from
/// the active one on, of those that are shown.
fn pick(editor: &mut Editor, item: CurveId, (toggles, extends): (bool, bool), shown: &[CurveId]) {
    let place = |id: CurveId| shown.iter().position(|it| *it == id);
    let ends = editor.active().and_then(place).zip(place(item));
    let range = ends.and_then(|(from, to)| shown.get(from.min(to)..=from.max(to)));
    match (range.filter(|_| extends), toggles) {
        (Some(range), false) => editor.hand_mut().select_items(range.iter().copied()),
        (Some(range), true) => {
            let selected = editor.hand().selection().items();
            let both = selected.into_iter().chain(range.iter().copied());
            editor.hand_mut().select_items(both);
        }
        (None, true) => editor.hand_mut().toggle_item(item),
        (None, false) => editor.activate(item),
    }
}

/// Give a group the path that was typed; an empty one dissolves it.
fn rename_group(editor: &mut Editor, group: Group, text: &str) {
    let to = Group::from(text);
    if to != group {
        told(editor.change(Edit::RenameGroup { group, to }));
    }
}

/// The part of a row that a group within so many others has.
fn indented(row: Rect, depth: usize) -> Rect {
    let left = row.left() + depth as f32 * INDENT;
    Rect::from_min_max(pos2(left, row.top()), row.max)
}

/// The room for the name in a row.
fn name_rect(inner: Rect) -> Rect {
    let low = inner.min + vec2(6.0 * STEP, 0.0);
    Rect::from_min_max(low, inner.max - vec2(2.0 * ROW + STEP, 0.0))
}

fn reorder(editor: &mut Editor, curve: CurveId, place: usize) {
    told(editor.apply("Reorder curves", vec![Edit::Reorder { curve, place }]));
}

/// The field of the filter.
fn filter_id() -> Id {
    Id::unique("filter of curves")
}

/// Whether the name or the group of an item contains a text, whatever the case of its letters.
fn is_found(item: &Item, text: &str) -> bool {
    let text = text.trim().to_lowercase();
    let contains = |name: &str| name.to_lowercase().contains(&text);
    contains(&item.name) || contains(&item.group.to_string())
}

impl CurveList {
    /// Open the field of the filter, or close it and show all rows.
    fn toggle_filter(&mut self, context: &Context) {
        self.filter = match self.filter {
            Some(_) => None,
            None => {
                keyboard::claim(context, filter_id(), Typing::Text, Rect::NOTHING);
                self.opens_filter = true;
                Some(String::new())
            }
        };
    }

    fn heading_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        items: &[Item],
        commands: &mut Vec<Action>,
    ) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            let (icon, name) = match self.is_collapsed {
                true => (Icon::ChevronRight, "Expand curve list"),
                false => (Icon::ChevronDown, "Collapse curve list"),
            };
            if IconButton::new(icon, name).show(ui).clicked() {
                self.is_collapsed = !self.is_collapsed;
            }
            ui.strong("Curves");
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                for (icon, command) in [
                    (Icon::Trash2, Command::DeleteCurve),
                    (Icon::CopyPlus, Command::Duplicate),
                    (Icon::Focus, Command::Isolate),
                ] {
                    let name = command.label_now(editor);
                    let button = IconButton::new(icon, &name).enabled(command.is_enabled(editor));
                    if button.tooltip(command.tooltip()).show(ui).clicked() {
                        commands.push(command.into());
                    }
                }
                let filter =
                    IconButton::new(Icon::Search, "Filter curves").enabled(!items.is_empty());
                if filter
                    .tooltip("Show rows whose name or group contains a text")
                    .show(ui)
                    .clicked()
                {
                    self.toggle_filter(ui.ctx());
                }
                let active = items.iter().find(|item| item.active);
                let beside = |active: &Item, is_on_side: fn(usize, usize) -> bool| {
                    let beside = items.iter().filter(|item| item.is_beside(active));
                    let places = beside.map(|item| item.place);
                    let places = places.filter(|place| is_on_side(*place, active.place));
                    places.min_by_key(|place| place.abs_diff(active.place))
                };
                for (icon, name, is_on_side) in [
                    (
                        Icon::ArrowDown,
                        "Move curve down",
                        (|place, own| place > own) as fn(usize, usize) -> bool,
                    ),
                    (Icon::ArrowUp, "Move curve up", |place, own| place < own),
                ] {
                    let to = active.and_then(|active| Some((active, beside(active, is_on_side)?)));
                    let response = IconButton::new(icon, name).enabled(to.is_some()).show(ui);
                    if let (true, Some((active, place))) = (response.clicked(), to) {
                        reorder(editor, active.id, place);
                    }
                }
            });
        });
    }
}
