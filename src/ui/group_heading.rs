//! The heading of a group in the list of curves.

use eframe::egui::{Color32, Rect, Response, Role, Ui, Vec2, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::curve_item::{Dragged, Item};
use super::group_rows::GroupRow;
use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::document::{CurveId, Edit, Group};
use crate::editor::{Editor, told};

/// The heading of a group.
pub struct Heading {
    /// The group.
    pub group: Group,
    /// What is shown of its path.
    name: String,
    /// How many headings it is under.
    pub depth: usize,
    /// Whether the rows under it are left out.
    pub is_folded: bool,
    members: Vec<Member>,
    /// Whether the active curve or reference is in it.
    has_active: bool,
}

/// A curve or a reference of the group.
struct Member {
    id: CurveId,
    visible: bool,
    locked: bool,
}

impl From<GroupRow<'_, Item>> for Heading {
    fn from(row: GroupRow<'_, Item>) -> Self {
        let members = row.members.iter().map(|item| Member {
            id: item.id,
            visible: item.visible,
            locked: item.locked,
        });
        Self {
            members: members.collect(),
            has_active: row.members.iter().any(|item| item.active),
            group: row.group,
            name: row.name,
            depth: row.depth,
            is_folded: row.is_folded,
        }
    }
}

impl Heading {
    /// Paint the chevron, and name the row for screen readers.
    pub fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let icon = match self.is_folded {
            true => Icon::ChevronRight,
            false => Icon::ChevronDown,
        };
        let centre = rect.left_center() + vec2(4.0 * STEP, 0.0);
        let chevron = Rect::from_center_size(centre, Vec2::splat(3.5 * STEP));
        widgets::icon(ui, chevron, icon, Tokens::of(ui).faint_text);
        let label = format!("group {}", self.group);
        let is_open = !self.is_folded;
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_open, &label));
    }

    /// Show the name; a tooltip shows the whole path.
    pub fn name_ui(&self, ui: &Ui, rect: Rect, response: Response) {
        let tokens = Tokens::of(ui);
        let is_visible = self.members.iter().any(|member| member.visible);
        let colour = match (self.is_folded && self.has_active, is_visible) {
            (true, _) => tokens.strong_text,
            (false, true) => tokens.text,
            (false, false) => tokens.faint_text,
        };
        widgets::name_in(ui, rect, &self.name, colour);
        response.on_hover_text(self.group.to_string());
    }

    /// Rows that are dropped on the heading move to the group.
    pub fn take_dropped(&self, ui: &Ui, editor: &mut Editor, rect: Rect, response: &Response) {
        if response.dnd_hover_payload::<Dragged>().is_some() {
            widgets::outline(ui, rect, 1.5, Tokens::of(ui).accent);
        }
        let Some(dropped) = response.dnd_release_payload::<Dragged>() else {
            return;
        };
        let others = dropped.0.iter().copied();
        let others = others.filter(|id| editor.document().group(*id) != Some(&self.group));
        let edits = others.map(|curve| Edit::SetGroup {
            curve,
            group: self.group.clone(),
        });
        let edits: Vec<Edit> = edits.collect();
        if !edits.is_empty() {
            told(editor.apply("Move to group", edits));
        }
    }

    /// Show the lock and the eye of all that is in the group.
    pub fn switches_ui(&self, ui: &mut Ui, editor: &mut Editor, row: Rect) {
        let tokens = Tokens::of(ui);
        let faint = match ui.rect_contains_pointer(row) {
            true => tokens.faint_text,
            false => Color32::TRANSPARENT,
        };
        let are_locked = self.members.iter().filter(|member| member.locked).count();
        let are_visible = self.members.iter().filter(|member| member.visible).count();
        let all = self.members.len();
        let (icon, colour) = match are_locked {
            0 => (Icon::LockOpen, faint),
            count if count == all => (Icon::Lock, tokens.text),
            _ => (Icon::Lock, tokens.faint_text),
        };
        let help = "Protect all shapes in the group from edits";
        if self.switch_ui(ui, "Lock", icon, colour, help) {
            self.lock(editor, are_locked < all);
        }
        let (icon, colour) = match are_visible {
            0 => (Icon::EyeOff, tokens.text),
            count if count == all => (Icon::Eye, faint),
            _ => (Icon::EyeOff, tokens.faint_text),
        };
        let help = "Show or hide all in the group";
        if self.switch_ui(ui, "Show", icon, colour, help) {
            self.show(editor, are_visible < all);
        }
    }

    fn switch_ui(&self, ui: &mut Ui, verb: &str, icon: Icon, colour: Color32, help: &str) -> bool {
        let label = format!("{verb} group {}", self.group);
        let button = IconButton::new(icon, &label).colour(colour).tooltip(help);
        button.show(ui).clicked()
    }

    fn lock(&self, editor: &mut Editor, locked: bool) {
        let others = self.members.iter().filter(|member| member.locked != locked);
        let edits = others.map(|member| Edit::SetLocked {
            curve: member.id,
            locked,
        });
        let label = if locked { "Lock group" } else { "Unlock group" };
        told(editor.apply(label, edits.collect()));
    }

    fn show(&self, editor: &mut Editor, visible: bool) {
        let others = self
            .members
            .iter()
            .filter(|member| member.visible != visible);
        let edits = others.map(|member| Edit::SetVisible {
            curve: member.id,
            visible,
        });
        let label = if visible { "Show group" } else { "Hide group" };
        told(editor.apply(label, edits.collect()));
    }
}
