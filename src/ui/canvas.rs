//! The canvas: one response for all of it, and every event of the hand in order.

use std::cell::RefCell;
use std::time::Duration;

use eframe::egui::{
    self, Align2, Context, CursorIcon, Event, EventFilter, Id, MouseWheelSource, MouseWheelUnit,
    PointerButton, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};
use glam::DVec2;

use super::brush::Brush;
use super::chains::Screen;
use super::keyboard::Steering;
use super::pictures::PictureTextures;
use super::theme::{self, STEP, Tokens};
use super::{gizmo, grid, keyboard, labels, painting, rulers, widgets};
use crate::editor::{
    Button, Cursor, Editor, Input, Key, Layer, Look, Modifiers, PaneLayout, PaneView, view_name,
};

/// Points of the wheel that scale by the factor e.
pub const WHEEL_POINTS: f64 = 220.0;

/// How long the pointer rests before it shows what hides among other things, in seconds.
const REST: f32 = 0.3;

/// The canvas's own state: how egui's events are to be read.
#[derive(Default)]
pub struct Canvas {
    /// Where it was in the last frame.
    rect: Option<Rect>,
    /// Where the pane in use was.
    pane: Option<Rect>,
    /// The buttons that went down on the canvas and are still held.
    held: Vec<PointerButton>,
    /// Whether the pointer is on the canvas.
    inside: bool,
    /// Whether the pointer has rested since it moved.
    rested: bool,
    /// Whether the space bar is held.
    space: bool,
    /// The axis whose key is held.
    axis: Option<usize>,
    /// Whether the key is held that turns round whether features are kept.
    keeping: bool,
    /// The modifiers the editor knows of.
    modifiers: Modifiers,
    /// The pictures on the graphics card.
    pictures: PictureTextures,
    /// Whether the last wheel event came from fingers on a touchpad: they push, wheels zoom.
    fingers: bool,
}

/// The identity of the canvas, the same in every frame.
pub fn id() -> Id {
    Id::unique("canvas")
}

impl Canvas {
    /// Where the canvas is, once it was shown.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }

    /// Where the pane in use is, once it was shown.
    pub fn pane(&self) -> Option<Rect> {
        self.pane
    }

    /// Whether fingers on a touchpad turn the wheel.
    pub fn has_fingers(&self) -> bool {
        self.fingers
    }

    /// Send this frame's events to the editor. Called before any panel is shown, so that all of
    /// them show the result.
    pub fn send_events(&mut self, context: &Context, editor: &mut Editor) {
        if self.rect.is_none() {
            return;
        }
        let events = context.input(|input| input.events.clone());
        for event in &events {
            self.send_event(context, editor, event);
        }
        let modifiers = context.input(|input| keyboard::modifiers(input.modifiers));
        send(editor, &mut self.modifiers, modifiers, Input::Modifiers);
        self.send_wheel(context, editor);
        self.notice_rest(context, editor);
        self.notice_covering(context, editor);
    }

    fn send_event(&mut self, context: &Context, editor: &mut Editor, event: &Event) {
        if let Some((steering, pressed)) = keyboard::steering(event) {
            let mine = editor.hand().is_holding() || self.has_keyboard(context);
            match steering {
                Steering::Axis(axis) => self.hold_axis(editor, axis, pressed && mine),
                Steering::Features => {
                    send(
                        editor,
                        &mut self.keeping,
                        pressed && mine,
                        Input::KeepingHeld,
                    );
                }
            }
        }
        match event {
            Event::PointerMoved(pos) => self.moved(context, editor, *pos),
            Event::PointerButton {
                pos,
                button,
                pressed,
                modifiers,
            } => {
                let held = keyboard::modifiers(*modifiers);
                send(editor, &mut self.modifiers, held, Input::Modifiers);
                match pressed {
                    true => self.pressed(context, editor, *pos, *button),
                    false => self.released(context, editor, *pos, *button),
                }
            }
            Event::PointerGone => self.leave(editor),
            Event::MouseWheel { unit, source, .. } => {
                let is_wheel = *source == MouseWheelSource::Wheel;
                self.fingers = *unit == MouseWheelUnit::Point && !is_wheel;
            }
            Event::Key {
                key,
                pressed,
                modifiers,
                repeat,
                ..
            } => {
                let held = keyboard::modifiers(*modifiers);
                send(editor, &mut self.modifiers, held, Input::Modifiers);
                self.key(context, editor, *key, [*pressed, *repeat]);
            }
            Event::WindowFocused(false) => {
                send(
                    editor,
                    &mut self.modifiers,
                    Modifiers::NONE,
                    Input::Modifiers,
                );
                send(editor, &mut self.space, false, Input::SpaceHeld);
                if let Some(axis) = self.axis {
                    self.hold_axis(editor, axis, false);
                }
                send(editor, &mut self.keeping, false, Input::KeepingHeld);
            }
            _ => {}
        }
    }

    /// Tell the editor once that the pointer rests on the canvas with no button held.
    fn notice_rest(&mut self, context: &Context, editor: &mut Editor) {
        let (pos, still) = context.input(|input| {
            let pointer = &input.pointer;
            (pointer.latest_pos(), pointer.time_since_last_movement())
        });
        let Some(pos) = pos.filter(|_| self.inside && self.held.is_empty() && !self.rested) else {
            return;
        };
        if still < REST {
            context.request_repaint_after(Duration::from_secs_f32(REST - still));
            return;
        }
        self.rested = true;
        editor.input(Input::Rested {
            at: self.place(pos),
        });
    }

    fn moved(&mut self, context: &Context, editor: &mut Editor, pos: Pos2) {
        let inside = self.is_on_top(context, pos);
        // A drag that began elsewhere, such as on a panel's edge, hovers nothing here.
        let foreign = self.held.is_empty() && context.input(|input| input.pointer.any_down());
        if !self.held.is_empty() || (inside && !foreign) {
            self.inside = true;
            self.rested = false;
            let at = self.place(pos);
            editor.input(Input::Moved { at });
        } else {
            self.leave(editor);
        }
    }

    fn leave(&mut self, editor: &mut Editor) {
        if self.inside && self.held.is_empty() {
            self.inside = false;
            editor.input(Input::Left);
        }
    }

    fn pressed(
        &mut self,
        context: &Context,
        editor: &mut Editor,
        pos: Pos2,
        pressed: PointerButton,
    ) {
        if self.is_on_top(context, pos)
            && self.has_the_press(context)
            && let Some(button) = translated(pressed)
        {
            self.held.push(pressed);
            context.memory_mut(|memory| memory.request_focus(id()));
            let at = self.place(pos);
            editor.input(Input::Pressed { button, at });
        }
    }

    /// Whether egui gives a press to the canvas rather than to a widget over its edge, such as
    /// the handle that resizes a panel.
    fn has_the_press(&self, context: &Context) -> bool {
        let is_up_again = context.input(|input| !input.pointer.any_down());
        let response = context.read_response(id());
        is_up_again
            || response
                .is_none_or(|response| response.is_pointer_button_down_on() || response.clicked())
    }

    fn released(
        &mut self,
        context: &Context,
        editor: &mut Editor,
        pos: Pos2,
        released: PointerButton,
    ) {
        let Some(index) = self.held.iter().position(|held| *held == released) else {
            return;
        };
        self.held.swap_remove(index);
        let Some(button) = translated(released) else {
            return;
        };
        let at = self.place(pos);
        editor.input(Input::Released { button, at });
        let is_double = context.input(|input| input.pointer.button_double_clicked(released));
        if is_double && button == Button::Primary {
            editor.input(Input::DoubleClicked { at });
        }
        if !self.is_on_top(context, pos) {
            self.leave(editor);
        }
    }

    /// Where a point of the window is on the canvas.
    fn place(&self, pos: Pos2) -> DVec2 {
        let offset = pos - self.rect.unwrap_or(Rect::ZERO).min;
        DVec2::new(f64::from(offset.x), f64::from(offset.y))
    }

    fn is_on_top(&self, context: &Context, pos: Pos2) -> bool {
        let layer = context.layer_id_at(pos);
        let is_behind = layer.is_some_and(|layer| layer.order != egui::Order::Background);
        let is_on = |rect: Rect| {
            let gizmo = gizmo::place(rect).filter(|_| self.pane == self.rect);
            rect.contains(pos) && !gizmo.is_some_and(|gizmo| gizmo.contains(pos))
        };
        self.rect.is_some_and(is_on) && !is_behind
    }

    /// An axis's key steers a drag while it is held.
    fn hold_axis(&mut self, editor: &mut Editor, axis: usize, pressed: bool) {
        let wanted = match (pressed, self.axis) {
            (true, _) => Some(axis),
            (false, Some(held)) if held == axis => None,
            (_, held) => held,
        };
        send(editor, &mut self.axis, wanted, Input::AxisHeld);
    }

    fn key(&mut self, context: &Context, editor: &mut Editor, key: egui::Key, state: [bool; 2]) {
        let [pressed, repeated] = state;
        if key == egui::Key::Space && !pressed {
            send(editor, &mut self.space, false, Input::SpaceHeld);
        }
        if !pressed || !self.has_keyboard(context) {
            return;
        }
        match keyboard::key(key) {
            Some(Key::Space) => send(editor, &mut self.space, true, Input::SpaceHeld),
            Some(key) if repeated => editor.input(Input::KeyRepeated(key)),
            Some(key) => editor.input(Input::Key(key)),
            None => {}
        }
    }

    /// Whether keys are the canvas's: it had the keyboard before this frame's events. The present focus
    /// is no guide, for Esc has already taken it from the field that Esc was meant for, and has
    /// ended the field's drag.
    pub fn has_keyboard(&self, context: &Context) -> bool {
        let dragged = context.dragged_id().or(context.drag_stopped_id());
        context.memory(|memory| memory.had_focus_last_frame(id()))
            && dragged.is_none_or(|dragged| dragged == id())
            && !keyboard::is_covered(context)
    }

    fn send_wheel(&mut self, context: &Context, editor: &mut Editor) {
        let (pointer, scrolled, pinched) = context.input(|input| {
            let pointer = input.pointer.hover_pos();
            (pointer, input.smooth_scroll_delta(), input.zoom_delta())
        });
        let Some(pos) = pointer.filter(|pos| self.is_on_top(context, *pos)) else {
            return;
        };
        let at = self.place(pos);
        if pinched != 1.0 {
            let factor = f64::from(pinched);
            editor.input(Input::Zoomed { at, factor });
        }
        let by = DVec2::new(f64::from(scrolled.x), f64::from(scrolled.y));
        if self.fingers {
            if by != DVec2::ZERO {
                editor.input(Input::Panned { by });
            }
            return;
        }
        // With Shift the wheel turns sideways.
        let turns = editor.hand().turns_following();
        let turned = if turns { by.x + by.y } else { by.y };
        if turned != 0.0 {
            let factor = (turned / WHEEL_POINTS).exp();
            editor.input(Input::Zoomed { at, factor });
        }
        if by.x != 0.0 && !turns {
            let by = by.with_y(0.0);
            editor.input(Input::Panned { by });
        }
    }

    /// A dialog that opens takes the hover away.
    fn notice_covering(&mut self, context: &Context, editor: &mut Editor) {
        let pointer = context.input(|input| input.pointer.hover_pos());
        if !pointer.is_some_and(|pos| self.is_on_top(context, pos)) {
            self.leave(editor);
        }
    }

    /// Show the canvas in all the space there is.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let rect = ui.available_rect_before_wrap();
        let (_, rect) = ui.allocate_space(rect.size());
        if self.rect != Some(rect) {
            self.rect = Some(rect);
            let size = rect.size();
            let size = DVec2::new(f64::from(size.x), f64::from(size.y));
            editor.look(Look::Canvas(size));
        }
        let response = ui.interact(rect, id(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Canvas"));
        self.keep_keyboard(ui);
        if self.inside || !self.held.is_empty() {
            ui.set_cursor_icon(cursor_icon(editor.cursor()));
        }
        let tokens = Tokens::of(ui);
        // What is seen between panes.
        ui.painter_at(rect).rect_filled(rect, 0, tokens.outline);
        // Panels may have changed the scene.
        editor.refresh();
        let layers = editor.sight().layers();
        let [has_grid, has_rulers] = [Layer::Grid, Layer::Guides].map(|it| layers.shows(it));
        let overlays = widgets::overlays(ui.ctx());
        self.pictures.begin_frame();
        for (place, pane) in editor.view().panes().enumerate() {
            let own = pane_rect(rect, &pane);
            let painter = ui.painter_at(own);
            painter.rect_filled(own, 0, tokens.background);
            let brush = Brush {
                painter: &painter,
                screen: Screen::new(pane.viewport, own),
                rect: own,
                tokens,
                overlays: overlays.clone(),
                texts: RefCell::default(),
            };
            if has_grid {
                grid::paint(&brush);
            }
            // The grid shines through: on top of a picture it would hide edges.
            self.pictures.paint(&brush, &pane.scene.pictures);
            painting::paint(&brush, pane.scene);
            if has_rulers {
                rulers::paint(&brush);
            }
            painting::paint_hand(&brush, pane.scene);
            if pane.is_used {
                self.pane = Some(own);
            }
            if editor.view().pane_layout() != PaneLayout::One {
                name_ui(ui, &brush, (place, &pane));
            }
        }
    }

    /// Give the canvas the keyboard whenever nothing else wants it, with Tab and arrow keys.
    fn keep_keyboard(&self, ui: &Ui) {
        let covered = keyboard::is_covered(ui.ctx());
        ui.memory_mut(|memory| {
            if memory.focused().is_none() && !covered {
                memory.request_focus(id());
            }
            if memory.has_focus(id()) {
                let all = EventFilter {
                    tab: true,
                    horizontal_arrows: true,
                    vertical_arrows: true,
                    escape: true,
                };
                memory.set_focus_lock_filter(id(), all);
            }
        });
    }
}

/// Where a pane of the canvas is in the window.
fn pane_rect(canvas: Rect, pane: &PaneView) -> Rect {
    let [corner, size] = [pane.corner, pane.viewport.size].map(|it| vec2(it.x as f32, it.y as f32));
    Rect::from_min_size(canvas.min + corner, size)
}

/// Name the side from which a pane sees the model, in its lower right corner, and frame the pane in use.
fn name_ui(ui: &Ui, brush: &Brush<'_>, (place, pane): (usize, &PaneView)) {
    let (name, tokens) = (view_name(&pane.viewport.orientation), brush.tokens);
    let colour = match pane.is_used {
        true => tokens.strong_text,
        false => tokens.faint_text,
    };
    // Above the ruler.
    let at = brush.rect.right_bottom() - vec2(2.0 * STEP, 6.0 * STEP);
    let font = theme::small_font();
    let size = labels::size(brush.painter, name, font.clone());
    let rect = Align2::RIGHT_BOTTOM.anchor_size(at, size);
    labels::paint(brush, rect.left_top(), Align2::LEFT_TOP, name, font, colour);
    let label = format!("Pane: {name}");
    let response = ui.interact(rect, Id::unique(("pane", place)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
    if pane.is_used {
        let stroke = Stroke::new(1.0, tokens.accent);
        brush
            .painter
            .rect_stroke(brush.rect, 0, stroke, StrokeKind::Inside);
    }
}

/// Send what is held now, if that is new.
fn send<T: Copy + PartialEq>(editor: &mut Editor, known: &mut T, now: T, input: fn(T) -> Input) {
    if *known != now {
        *known = now;
        editor.input(input(now));
    }
}

fn translated(button: PointerButton) -> Option<Button> {
    match button {
        PointerButton::Primary => Some(Button::Primary),
        PointerButton::Secondary => Some(Button::Secondary),
        PointerButton::Middle => Some(Button::Middle),
        _ => None,
    }
}

fn cursor_icon(cursor: Cursor) -> CursorIcon {
    match cursor {
        Cursor::Default => CursorIcon::Default,
        Cursor::Grab => CursorIcon::Grab,
        Cursor::Grabbing => CursorIcon::Grabbing,
        Cursor::Crosshair => CursorIcon::Crosshair,
        Cursor::Move => CursorIcon::Move,
        Cursor::Point => CursorIcon::PointingHand,
    }
}
