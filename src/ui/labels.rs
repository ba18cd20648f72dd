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
