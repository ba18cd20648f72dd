//! The axes of the model in a corner of the canvas: they show how the view is turned, turn it
//! when they are dragged, and look along an axis when its tip is clicked.

use eframe::egui::{
    Align2, Color32, CursorIcon, Id, Painter, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2,
    WidgetInfo, vec2,
};
use glam::{DVec2, DVec3};

use super::action::Action;
use super::theme::{self, STEP, Tokens};
use super::widgets;
use crate::editor::{Command, Editor, Look, NamedView, Orientation, view_name};

/// The gizmo's width and height, in points.
const SIZE: f32 = 84.0;

/// The length of an axis.
const ARM: f32 = 27.0;

/// The radius of the disc at the tip of an axis.
const TIP: f32 = 8.5;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// The place of the gizmo, the upper right corner of the canvas; `None` where there is too little
/// room for it.
pub fn place(canvas: Rect) -> Option<Rect> {
    if canvas.width() < 4.0 * SIZE || canvas.height() < 3.0 * SIZE {
        return None;
    }
    let corner = canvas.right_top() + vec2(-SIZE - 2.0 * STEP, 2.0 * STEP);
    Some(Rect::from_min_size(corner, Vec2::splat(SIZE)))
}

/// The place of the name of the view, below the gizmo.
pub fn name_place(canvas: Rect) -> Option<Rect> {
    let gizmo = place(canvas)?;
    let corner = gizmo.left_bottom() - vec2(0.0, 2.0 * STEP);
    Some(Rect::from_min_size(corner, vec2(SIZE, 4.0 * STEP)))
}

/// Show the gizmo over the canvas.
pub fn gizmo_ui(ui: &mut Ui, canvas: Rect, editor: &mut Editor, commands: &mut Vec<Action>) {
    let Some(rect) = place(canvas) else {
        return;
    };
    let response = ui.interact(rect, Id::unique("gizmo"), Sense::click_and_drag());
    let label = "Axes: drag to orbit, click a tip to look along an axis";
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    let view = editor.view().viewport().orientation;
    paint(ui, rect, &view, &response);
    if response.dragged() {
        let by = response.drag_delta();
        editor.look(Look::Orbit(DVec2::new(f64::from(by.x), f64::from(by.y))));
        ui.set_cursor_icon(CursorIcon::Grabbing);
    }
    if response.clicked()
        && let Some(at) = response.interact_pointer_pos()
        && let Some(named) = clicked_view(rect.center(), &view, at)
    {
        commands.push(Command::View(named).into());
    }
    if !response.dragged() {
        response.on_hover_text(label);
    }
    if let Some(rect) = name_place(canvas) {
        name_ui(ui, rect, view_name(&view));
    }
}

/// Name the side from which the model is seen.
fn name_ui(ui: &Ui, rect: Rect, name: &str) {
    let response = ui.interact(rect, Id::unique("view name"), Sense::hover());
    let label = format!("Seen from: {name}");
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
    let (align, font) = (Align2::CENTER_CENTER, theme::small_font());
    widgets::text_in(ui, rect, align, name, font, Tokens::of(ui).faint_text);
}

/// The view along the axis whose tip is at a place.
fn clicked_view(centre: Pos2, view: &Orientation, at: Pos2) -> Option<NamedView> {
    let views = [NamedView::Yz, NamedView::Xz, NamedView::Xy];
    let near = |axis: &usize| tip(centre, view, *axis).distance(at);
    let nearest = (0..3).min_by(|a, b| near(a).total_cmp(&near(b)))?;
    (near(&nearest) <= 1.5 * TIP).then_some(views[nearest])
}

fn tip(centre: Pos2, view: &Orientation, axis: usize) -> Pos2 {
    let seen = view.flatten(DVec3::AXES[axis]);
    centre + ARM * vec2(seen.x as f32, -seen.y as f32)
}

fn paint(ui: &Ui, rect: Rect, view: &Orientation, response: &Response) {
    let tokens = Tokens::of(ui);
    let painter = ui.painter_at(rect);
    let centre = rect.center();
    if response.hovered() || response.dragged() {
        painter.circle_filled(centre, 0.5 * SIZE, tokens.button[0].gamma_multiply(0.8));
    }
    // Axes that point away from the eye lie behind the others.
    let mut order = [0, 1, 2];
    let depth = |axis: &usize| view.depth(DVec3::AXES[*axis]);
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for axis in order {
        arm(&painter, centre, view, axis, tokens);
    }
}

fn arm(painter: &Painter, centre: Pos2, view: &Orientation, axis: usize, tokens: &Tokens) {
    let colour: Color32 = tokens.model_axes[axis];
    let end = tip(centre, view, axis);
    painter.line_segment([centre, end], Stroke::new(2.0, colour));
    painter.circle(end, TIP, tokens.background, Stroke::new(1.5, colour));
    let (name, font) = (NAMES[axis], theme::small_font());
    painter.text(end, Align2::CENTER_CENTER, name, font, colour);
}
