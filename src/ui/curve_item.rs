//! A row of the list of curves: a curve or a reference.

use eframe::egui::{Color32, CursorIcon, Rect, Response, Role, Ui, Vec2, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::document::{Colour, CurveId, Edit, Group};
use crate::editor::{Editor, told};

/// What a curve and a reference have in common.
pub struct Item {
    /// Its identity.
    pub id: CurveId,
    /// Whether it is a reference.
    pub is_reference: bool,
    /// Whether it is a reference with a picture.
    pub is_picture: bool,
    /// Its name.
    pub name: String,
    /// Its group.
    pub group: Group,
    /// Its own colour; `None` takes the theme's.
    pub colour: Option<Colour>,
    /// Whether it is drawn.
    pub visible: bool,
    /// Whether its shape is protected from edits.
    pub locked: bool,
    /// Its place among the curves, or among the references.
    pub place: usize,
    /// Whether it is the active one.
    pub active: bool,
    /// Whether it is selected.
    pub selected: bool,
}

impl Item {
    /// List all curves, then all references.
    pub fn all(editor: &Editor) -> Vec<Self> {
        let (document, active) = (editor.document(), editor.active());
        let selection = editor.hand().selection();
        let curves = document.curves().enumerate();
        let curves = curves.map(|(place, (id, curve))| Self {
            id,
            is_reference: false,
            is_picture: false,
            name: curve.name.clone(),
            group: curve.group.clone(),
            colour: curve.colour,
            visible: curve.visible,
            locked: curve.locked,
            place,
            active: active == Some(id),
            selected: selection.has_item(id),
        });
        let references = document.references().enumerate();
        let references = references.map(|(place, (id, reference))| Self {
            id,
            is_reference: true,
            is_picture: reference.picture.is_some(),
            name: reference.name.clone(),
            group: reference.group.clone(),
            colour: reference.colour,
            visible: reference.visible,
            locked: reference.locked,
            place,
            active: active == Some(id),
            selected: selection.has_item(id),
        });
        curves.chain(references).collect()
    }

    /// The active curve or reference.
    pub fn active(editor: &Editor) -> Option<Self> {
        Self::all(editor).into_iter().find(|item| item.active)
    }

    /// The colour that it is shown in.
    pub fn shown_colour(&self, tokens: &Tokens) -> Color32 {
        tokens.of_item(Some(self.id), self.colour, self.is_reference)
    }

    /// What screen readers and tooltips call it.
    fn noun(&self) -> &'static str {
        match (self.is_picture, self.is_reference) {
            (true, _) => "picture",
            (false, true) => "reference",
            (false, false) => "curve",
        }
    }

    /// Whether another item is of its kind and in its group: only these trade places.
    pub fn is_beside(&self, other: &Self) -> bool {
        self.is_reference == other.is_reference && self.group == other.group
    }

    /// Paint its swatch, and name its row for screen readers.
    pub fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let colour = self.shown_colour(Tokens::of(ui));
        let centre = rect.left_center() + vec2(4.0 * STEP, 0.0);
        let swatch = Rect::from_center_size(centre, Vec2::splat(3.0 * STEP));
        match (self.is_picture, self.is_reference) {
            (true, _) => widgets::icon(ui, swatch, Icon::Image, colour),
            (false, true) => widgets::icon(ui, swatch, Icon::SplinePointer, colour),
            (false, false) => widgets::swatch(ui, swatch, colour),
        }
        let label = format!("{} {}", self.noun(), self.name);
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, self.selected, &label));
    }

    /// Show the name; a tooltip shows all of one that does not fit.
    pub fn name_ui(&self, ui: &Ui, rect: Rect, response: Response) {
        let tokens = Tokens::of(ui);
        let colour = match (self.active, self.visible) {
            (true, _) => tokens.strong_text,
            (false, true) => tokens.text,
            (false, false) => tokens.faint_text,
        };
        if widgets::name_in(ui, rect, &self.name, colour) {
            response.on_hover_text(&self.name);
        }
    }

    /// A row can be dragged to another place, with all that are selected if it is; in the rows of another group they
    /// move to that group.
    pub fn reorder(&self, ui: &Ui, editor: &mut Editor, rect: Rect, response: &Response) {
        if response.drag_started() {
            response.dnd_set_drag_payload(match self.selected {
                true => Dragged(editor.hand().selection().items()),
                false => Dragged(vec![self.id]),
            });
        }
        if response.dragged() {
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
        let hovering = response.dnd_hover_payload::<Dragged>();
        if hovering.is_some_and(|dragged| !dragged.0.contains(&self.id)) {
            widgets::outline(ui, rect, 1.5, Tokens::of(ui).accent);
        }
        let dropped = response.dnd_release_payload::<Dragged>();
        if let Some(dropped) = dropped.filter(|dropped| !dropped.0.contains(&self.id)) {
            self.take_place(editor, &dropped.0);
        }
    }

    /// Put other items in its place, in their order, and in its group. Those of the other kind move to the group
    /// alone.
    fn take_place(&self, editor: &mut Editor, dropped: &[CurveId]) {
        let document = editor.document();
        let others = dropped
            .iter()
            .filter(|id| document.group(**id) != Some(&self.group));
        let grouped = others.map(|curve| Edit::SetGroup {
            curve: *curve,
            group: self.group.clone(),
        });
        let mut edits: Vec<Edit> = grouped.collect();
        let before: Vec<CurveId> = match self.is_reference {
            true => document.references().map(|(id, _)| id).collect(),
            false => document.ids().collect(),
        };
        let after = placed(&before, dropped, self.id);
        // The places before are those in the end, one after the other.
        let moved = after.iter().enumerate();
        let moved = moved.skip_while(|(place, id)| before.get(*place) == Some(*id));
        let last = (0..before.len())
            .rev()
            .find(|place| before.get(*place) != after.get(*place));
        let moved = moved.take_while(|(place, _)| last.is_some_and(|last| *place <= last));
        edits.extend(moved.map(|(place, curve)| Edit::Reorder {
            curve: *curve,
            place,
        }));
        if !edits.is_empty() {
            told(editor.apply("Reorder curves", edits));
        }
    }

    /// Show its lock and its eye at the right of its row.
    pub fn switches_ui(&self, ui: &mut Ui, editor: &mut Editor, row: Rect) {
        let tokens = Tokens::of(ui);
        // Switches in their default state are hidden until the row is hovered.
        let faint = match ui.rect_contains_pointer(row) || self.active {
            true => tokens.faint_text,
            false => Color32::TRANSPARENT,
        };
        let mut switch = |icon, verb: &str, colour, tooltip: String, edit| {
            let label = format!("{verb} {}", self.name);
            let button = IconButton::new(icon, &label)
                .colour(colour)
                .tooltip(tooltip);
            if button.show(ui).clicked() {
                told(editor.change(edit));
            }
        };
        let (icon, colour) = match self.locked {
            true => (Icon::Lock, tokens.text),
            false => (Icon::LockOpen, faint),
        };
        let (curve, locked, visible) = (self.id, !self.locked, !self.visible);
        let tooltip = "Protect the shape from edits".to_owned();
        switch(
            icon,
            "Lock",
            colour,
            tooltip,
            Edit::SetLocked { curve, locked },
        );
        let (icon, colour) = match self.visible {
            true => (Icon::Eye, faint),
            false => (Icon::EyeOff, tokens.text),
        };
        let tooltip = format!("Show or hide the {}", self.noun());
        switch(
            icon,
            "Show",
            colour,
            tooltip,
            Edit::SetVisible { curve, visible },
        );
    }
}

/// The items of rows that are dragged.
pub struct Dragged(pub Vec<CurveId>);

/// The order of items after some of them are put in the place of another one: before it if they come from behind, or
/// else behind it.
fn placed(before: &[CurveId], moved: &[CurveId], target: CurveId) -> Vec<CurveId> {
    let is_moved = |id: &CurveId| moved.contains(id);
    let place = before.iter().position(|id| *id == target);
    let from_before = before.iter().take(place.unwrap_or(0)).any(is_moved);
    let mut after: Vec<CurveId> = before.iter().copied().filter(|id| !is_moved(id)).collect();
    let place = after.iter().position(|id| *id == target).unwrap_or(0);
    let place = place + usize::from(from_before);
    let moved = before.iter().copied().filter(is_moved);
    after.splice(place..place, moved);
    after
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Curve, Document};
    use crate::geometry::FloatPolygon;

    #[test]
    fn rows_that_are_dropped_take_the_place_of_the_row_below_them() {
        let polygon = FloatPolygon::planar(1, &[(0.0, 0.0), (1.0, 0.0)]).expect("a polygon");
        let document = Document::from_curves(vec![Curve::new("line", polygon); 5]);
        let ids: Vec<CurveId> = document.ids().collect();
        let order = |moved: &[usize], target: usize| -> Vec<usize> {
            let moved: Vec<CurveId> = moved.iter().map(|place| ids[*place]).collect();
            let after = placed(&ids, &moved, ids[target]);
            let place = |id: &CurveId| ids.iter().position(|it| it == id);
            after.iter().filter_map(place).collect()
        };
        assert_eq!(order(&[0], 2), [1, 2, 0, 3, 4]);
        assert_eq!(order(&[4], 2), [0, 1, 4, 2, 3]);
        assert_eq!(order(&[0, 1], 3), [2, 3, 0, 1, 4]);
        assert_eq!(order(&[3, 4], 0), [3, 4, 0, 1, 2]);
        assert_eq!(order(&[0, 4], 2), [1, 2, 0, 4, 3]);
    }
}
