//! Texts on the canvas: legible over anything, and never outside.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, vec2};

use super::theme::{self, RADIUS, STEP, Tokens};

/// How far a tooltip stays from the point that it speaks of.
const CLEARANCE: f32 = 14.0;

/// The size of a line of text.
pub fn size(painter: &Painter, text: &str, font: FontId) -> Vec2 {
    painter
        .layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER)
        .size()
}

/// Write a text with a halo in the canvas's colour, so that lines under it don't disturb.
pub fn paint(
    painter: &Painter,
    at: Pos2,
    align: Align2,
    text: &str,
    font: FontId,
    colour: Color32,
    tokens: &Tokens,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), font, colour);
    let rect = align.anchor_size(at, galley.size());
    let halo = tokens.background;
    for offset in [
        vec2(-1.0, 0.0),
        vec2(1.0, 0.0),
        vec2(0.0, -1.0),
        vec2(0.0, 1.0),
        vec2(-1.0, -1.0),
        vec2(1.0, 1.0),
        vec2(-1.0, 1.0),
        vec2(1.0, -1.0),
    ] {
        painter.galley_with_override_text_color(rect.min + offset, galley.clone(), halo);
    }
    painter.galley(rect.min, galley, colour);
}

/// Show some lines in a box beside a point: within the canvas, and never over the point.
pub fn tooltip(painter: &Painter, canvas: Rect, point: Pos2, text: &str, tokens: &Tokens) {
    let galley = painter.layout_no_wrap(text.to_owned(), theme::number_font(), tokens.text);
    let padding = vec2(2.0 * STEP, 1.5 * STEP);
    let rect = beside(canvas.shrink(STEP), point, galley.size() + 2.0 * padding);
    painter.rect(
        rect,
        RADIUS,
        tokens.panel,
        Stroke::new(1.0, tokens.outline),
        StrokeKind::Outside,
    );
    painter.galley(rect.min + padding, galley, tokens.text);
}

/// Name what is at a point, in small type below it.
pub fn name(painter: &Painter, canvas: Rect, point: Pos2, text: &str, tokens: &Tokens) {
    let font = theme::small_font();
    let size = size(painter, text, font.clone());
    let rect = Rect::from_center_size(point + vec2(0.0, CLEARANCE + 0.5 * size.y), size);
    let at = moved_into(canvas.shrink(STEP), rect).left_top();
    let colour = tokens.strong_text;
    paint(painter, at, Align2::LEFT_TOP, text, font, colour, tokens);
}

/// Show some lines in a box beside a point that moves along `way`: behind it, where it comes from.
pub fn behind(
    painter: &Painter,
    canvas: Rect,
    (point, way): (Pos2, Vec2),
    text: &str,
    tokens: &Tokens,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), theme::number_font(), tokens.text);
    let padding = vec2(2.0 * STEP, 1.5 * STEP);
    let size = galley.size() + 2.0 * padding;
    let rect = place_behind(canvas.shrink(STEP), point, way, size);
    let outline = Stroke::new(1.0, tokens.outline);
    painter.rect(rect, RADIUS, tokens.panel, outline, StrokeKind::Outside);
    painter.galley(rect.min + padding, galley, tokens.text);
}

/// Find a box of some size behind a point that moves along `way`; near the canvas's edge on one of its other
/// sides, where there is room.
fn place_behind(canvas: Rect, point: Pos2, way: Vec2, size: Vec2) -> Rect {
    let back = match way == Vec2::ZERO {
        true => vec2(0.0, -1.0),
        false => -way.normalized(),
    };
    let sides = [back, back.rot90(), -back.rot90(), -back];
    let boxes = sides.map(|side| {
        let rect = outside(point, side, size);
        moved_into(canvas, rect)
    });
    let is_clear = |rect: &&Rect| !rect.expand(0.5 * CLEARANCE).contains(point);
    boxes.iter().find(is_clear).copied().unwrap_or(boxes[0])
}

/// Find a box of some size on one side of a point.
fn outside(point: Pos2, side: Vec2, size: Vec2) -> Rect {
    let half = 0.5 * (side.x.abs() * size.x + side.y.abs() * size.y);
    Rect::from_center_size(point + side * (CLEARANCE + half), size)
}

/// Move a box so that it lies on the canvas.
fn moved_into(canvas: Rect, rect: Rect) -> Rect {
    let low = (canvas.min - rect.min).max(Vec2::ZERO);
    let high = (canvas.max - rect.max).min(Vec2::ZERO);
    rect.translate(low + high)
}

/// Find a box of some size beside a point: right of it and above if there is room, otherwise on
/// another side.
fn beside(canvas: Rect, point: Pos2, size: Vec2) -> Rect {
    let right = point.x + CLEARANCE;
    let left = point.x - CLEARANCE - size.x;
    let above = point.y - CLEARANCE - size.y;
    let below = point.y + CLEARANCE;
    let corners = [(right, above), (left, above), (right, below), (left, below)];
    let boxes = corners.map(|(x, y)| Rect::from_min_size(Pos2::new(x, y), size));
    if let Some(free) = boxes.into_iter().find(|rect| canvas.contains_rect(*rect)) {
        return free;
    }
    // Near a short edge: keep to a side of the point and slide along it.
    let x = if right + size.x <= canvas.right() {
        right
    } else {
        left
    };
    let y = above.clamp(canvas.top(), (canvas.bottom() - size.y).max(canvas.top()));
    Rect::from_min_size(Pos2::new(x.max(canvas.left()), y), size)
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn a_readout_stands_where_the_drag_comes_from() {
        let canvas = Rect::from_min_size(pos2(0.0, 0.0), vec2(600.0, 400.0));
        let size = vec2(150.0, 50.0);
        for step in 0..24 {
            let way = Vec2::angled(step as f32);
            let point = pos2(300.0, 200.0);
            let rect = place_behind(canvas, point, way, size);
            assert!((rect.center() - point).dot(way) < 0.0, "{way:?}: {rect:?}");
            let ahead = (0..200).map(|far| point + way * far as f32);
            assert!(ahead.into_iter().all(|place| !rect.contains(place)));
            for corner in [pos2(3.0, 2.0), pos2(598.0, 3.0), pos2(2.0, 397.0)] {
                let rect = place_behind(canvas, corner, way, size);
                assert!(canvas.contains_rect(rect) && !rect.contains(corner));
            }
        }
    }

    #[test]
    fn a_tooltip_stays_on_the_canvas_and_off_its_point() {
        let canvas = Rect::from_min_size(pos2(100.0, 50.0), vec2(600.0, 400.0));
        let size = vec2(150.0, 80.0);
        for x in 0..=12 {
            for y in 0..=8 {
                let point = canvas.min + vec2(50.0 * x as f32, 50.0 * y as f32);
                let rect = beside(canvas, point, size);
                assert!(canvas.contains_rect(rect), "{point:?}: {rect:?}");
                assert!(!rect.contains(point), "{point:?}: {rect:?}");
            }
        }
    }
}
