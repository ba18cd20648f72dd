//! Texts on the canvas: legible over anything, and never outside.

use std::f32::consts::PI;

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, vec2};

use super::brush::Brush;
use super::theme::{self, RADIUS, STEP};

/// The longest line of a box, in points: longer ones, such as long names, are broken.
const WIDEST: f32 = 320.0;

/// How far a tooltip stays from the point that it speaks of.
const CLEARANCE: f32 = 14.0;

/// How little a text's plate lets through.
const PLATE: f32 = 0.85;

/// The size of a line of text.
pub fn size(painter: &Painter, text: &str, font: FontId) -> Vec2 {
    painter
        .layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER)
        .size()
}

/// Write a text on a plate in the canvas's colour, so that lines under it don't disturb.
pub fn paint(
    brush: &Brush<'_>,
    at: Pos2,
    align: Align2,
    text: &str,
    font: FontId,
    colour: Color32,
) {
    let galley = brush.painter.layout_no_wrap(text.to_owned(), font, colour);
    let rect = align.anchor_size(at, galley.size());
    let fill = brush.tokens.background.gamma_multiply(PLATE);
    let plate = rect.expand2(vec2(0.75 * STEP, 0.25 * STEP));
    brush.painter.rect_filled(plate, RADIUS, fill);
    brush.painter.galley(rect.min, galley, colour);
}

/// Show some lines in a box beside a point: within the canvas, never over the point, under no overlay where that can
/// be, and over as few of some `others` as can be.
pub fn tooltip(brush: &Brush<'_>, others: &[Pos2], point: Pos2, text: &str) {
    let canvas = brush.rect.shrink(STEP);
    let avoided = Avoided::of(brush, others);
    lines_in_box(brush, text, |size| beside(canvas, point, size, &avoided));
}

/// Show some lines in a box, which a function places by its size.
fn lines_in_box(brush: &Brush<'_>, text: &str, place: impl Fn(Vec2) -> Rect) {
    let (painter, tokens) = (brush.painter, brush.tokens);
    let font = theme::number_font();
    let galley = painter.layout(text.to_owned(), font, tokens.text, WIDEST);
    let padding = vec2(2.0 * STEP, 1.5 * STEP);
    let rect = place(galley.size() + 2.0 * padding);
    let outline = Stroke::new(1.0, tokens.outline);
    painter.rect(rect, RADIUS, tokens.panel, outline, StrokeKind::Outside);
    painter.galley(rect.min + padding, galley, tokens.text);
}

/// What a text should not lie over.
struct Avoided<'a> {
    points: &'a [Pos2],
    /// Panels, which would hide it.
    overlays: &'a [Rect],
}

impl<'a> Avoided<'a> {
    fn of(brush: &'a Brush<'_>, points: &'a [Pos2]) -> Self {
        Self {
            points,
            overlays: &brush.overlays,
        }
    }

    /// How many panels hide a box, then how many points it covers, or nearly so.
    fn cost(&self, rect: &Rect) -> (usize, usize) {
        let near = rect.expand(STEP);
        let hides = |overlay: &&Rect| overlay.intersects(*rect);
        let is_covered = |point: &&Pos2| near.contains(**point);
        (
            self.overlays.iter().filter(hides).count(),
            self.points.iter().filter(is_covered).count(),
        )
    }
}

/// Name a point in small type below it.
pub fn name(brush: &Brush<'_>, point: Pos2, text: &str) {
    let font = theme::small_font();
    let size = size(brush.painter, text, font.clone());
    let rect = Rect::from_center_size(point + vec2(0.0, CLEARANCE + 0.5 * size.y), size);
    let at = moved_into(brush.rect.shrink(STEP), rect).left_top();
    paint(
        brush,
        at,
        Align2::LEFT_TOP,
        text,
        font,
        brush.tokens.strong_text,
    );
}

/// Show some lines in a box beside a point that moves along `way`: behind it, where it comes from, and over as
/// few of some `others` as can be.
pub fn behind(brush: &Brush<'_>, others: &[Pos2], moved: (Pos2, Vec2), text: &str) {
    let canvas = brush.rect.shrink(STEP);
    let avoided = Avoided::of(brush, others);
    lines_in_box(brush, text, |size| {
        place_behind(canvas, moved, size, &avoided)
    });
}

/// Find a box of some size behind a point that moves along `way`, where it covers as few of some `others` as can be;
/// near the canvas's edge on one of its other sides, where there is room.
fn place_behind(
    canvas: Rect,
    (point, way): (Pos2, Vec2),
    size: Vec2,
    avoided: &Avoided<'_>,
) -> Rect {
    let back = match way == Vec2::ZERO {
        true => vec2(0.0, -1.0),
        false => -way.normalized(),
    };
    let (left, right) = (back.rot90(), -back.rot90());
    let boxed = |side: Vec2| moved_into(canvas, outside(point, side, size, CLEARANCE));
    let is_clear = |rect: &Rect| !rect.expand(0.5 * CLEARANCE).contains(point);
    let best = |sides: &[Vec2]| {
        let boxes = sides.iter().map(|side| boxed(*side)).filter(is_clear);
        boxes.min_by_key(|rect| avoided.cost(rect))
    };
    let halfway = [back + left, back + right].map(Vec2::normalized);
    let behind = best(&[back, halfway[0], halfway[1]]);
    let behind = behind.filter(|rect| avoided.cost(rect) == (0, 0));
    let around = best(&[back, halfway[0], halfway[1], left, right]);
    let around = around.filter(|rect| avoided.cost(rect).0 == 0);
    let turned = (0_u8..12).map(|twelfth| back.angle() + f32::from(twelfth) * PI / 6.0);
    let anywhere: Vec<Vec2> = turned.map(Vec2::angled).collect();
    let anywhere = || best(&anywhere);
    behind.or(around).or_else(anywhere).unwrap_or(boxed(back))
}

/// Find a box of some size on one side of a point, clear of it by some distance.
pub fn outside(point: Pos2, side: Vec2, size: Vec2, clearance: f32) -> Rect {
    let half = 0.5 * (side.x.abs() * size.x + side.y.abs() * size.y);
    Rect::from_center_size(point + side * (clearance + half), size)
}

/// Move a box so that it lies on the canvas.
pub fn moved_into(canvas: Rect, rect: Rect) -> Rect {
    let low = (canvas.min - rect.min).max(Vec2::ZERO);
    let high = (canvas.max - rect.max).min(Vec2::ZERO);
    rect.translate(low + high)
}

/// Find a box of some size beside a point: right of it and above if there is room, otherwise on
/// another side, or where it costs least.
fn beside(canvas: Rect, point: Pos2, size: Vec2, avoided: &Avoided<'_>) -> Rect {
    let right = point.x + CLEARANCE;
    let left = point.x - CLEARANCE - size.x;
    let above = point.y - CLEARANCE - size.y;
    let below = point.y + CLEARANCE;
    let boxed = |x: f32, y: f32| Rect::from_min_size(Pos2::new(x, y), size);
    let corners = [(right, above), (left, above), (right, below), (left, below)];
    let is_free = |rect: &Rect| canvas.contains_rect(*rect);
    let free = corners
        .map(|(x, y)| boxed(x, y))
        .into_iter()
        .filter(is_free);
    let best = free.min_by_key(|rect| avoided.cost(rect));
    if let Some(best) = best.filter(|rect| avoided.cost(rect).0 == 0) {
        return best;
    }
    // Near a short edge or an overlay: keep to a side of the point and slide along it.
    let fits = right + size.x <= canvas.right();
    let x = if fits { right } else { left };
    let y = above.clamp(canvas.top(), (canvas.bottom() - size.y).max(canvas.top()));
    let slid = boxed(x.max(canvas.left()), y);
    let overlays = avoided.overlays.iter();
    let beyond = overlays.flat_map(|it| [it.bottom() + STEP, it.top() - STEP - size.y]);
    let beyond = beyond.flat_map(|y| [boxed(right, y), boxed(left, y)]);
    let beyond = beyond.filter(is_free);
    let all = best.into_iter().chain([slid]).chain(beyond);
    // The first of those that cost as much: where there is no overlay, the box that slid least.
    all.min_by_key(|rect| avoided.cost(rect).0).unwrap_or(slid)
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    const NOTHING: Avoided = Avoided {
        points: &[],
        overlays: &[],
    };

    #[test]
    fn a_readout_stands_where_the_drag_comes_from() {
        let canvas = Rect::from_min_size(pos2(0.0, 0.0), vec2(600.0, 400.0));
        let size = vec2(150.0, 50.0);
        for step in 0..24 {
            let way = Vec2::angled(step as f32);
            let point = pos2(300.0, 200.0);
            let rect = place_behind(canvas, (point, way), size, &NOTHING);
            assert!((rect.center() - point).dot(way) < 0.0, "{way:?}: {rect:?}");
            let ahead = (0..200).map(|far| point + way * far as f32);
            assert!(ahead.into_iter().all(|place| !rect.contains(place)));
            for corner in [pos2(3.0, 2.0), pos2(598.0, 3.0), pos2(2.0, 397.0)] {
                let rect = place_behind(canvas, (corner, way), size, &NOTHING);
                assert!(canvas.contains_rect(rect) && !rect.contains(corner));
            }
        }
    }

    #[test]
    fn texts_stand_beside_a_curve_that_passes() {
        let canvas = Rect::from_min_size(pos2(0.0, 0.0), vec2(900.0, 700.0));
        let (point, size) = (pos2(450.0, 350.0), vec2(150.0, 50.0));
        for step in 0..48 {
            let along = Vec2::angled(step as f32 * 0.13);
            let curve = (-300..=300).map(|far| point + along * far as f32);
            let curve: Vec<Pos2> = curve.collect();
            let curve = Avoided {
                points: &curve,
                overlays: &[],
            };
            // The point is dragged across the curve, to either side, or along it.
            for way in [along.rot90(), -along.rot90()] {
                let rect = place_behind(canvas, (point, way), size, &curve);
                assert_eq!(curve.cost(&rect), (0, 0), "{way:?}: {rect:?}");
                assert!((rect.center() - point).dot(way) < 1.0);
            }
            let rect = place_behind(canvas, (point, along), size, &curve);
            assert!((rect.center() - point).dot(along) < 1.0);
            let behind = curve.cost(&outside(point, -along, size, CLEARANCE));
            assert!(curve.cost(&rect) < behind.max((0, 1)));
        }
        let diagonal: Vec<Pos2> = (0..300)
            .map(|far| point + vec2(1.0, -1.0) * far as f32)
            .collect();
        let diagonal = Avoided {
            points: &diagonal,
            overlays: &[],
        };
        let rect = beside(canvas, point, size, &diagonal);
        assert_eq!(diagonal.cost(&rect), (0, 0));
    }

    #[test]
    fn no_overlay_hides_a_text() {
        let canvas = Rect::from_min_size(pos2(0.0, 0.0), vec2(1000.0, 600.0));
        let bar = Rect::from_min_size(pos2(8.0, 8.0), vec2(490.0, 32.0));
        let panel = Rect::from_min_size(pos2(250.0, 500.0), vec2(500.0, 64.0));
        let overlays = [bar, panel];
        let avoided = Avoided {
            points: &[],
            overlays: &overlays,
        };
        let size = vec2(200.0, 60.0);
        for x in 1..20 {
            for y in 1..12 {
                let point = pos2(50.0 * x as f32, 50.0 * y as f32);
                let rect = beside(canvas, point, size, &avoided);
                assert_eq!(avoided.cost(&rect).0, 0, "{point:?}: {rect:?}");
                assert!(canvas.contains_rect(rect) && !rect.contains(point));
                // What is dragged lies under no panel.
                let is_hidden = overlays.iter().any(|it| it.contains(point));
                for step in (0..12).filter(|_| !is_hidden) {
                    let way = Vec2::angled(step as f32 * 0.52);
                    let rect = place_behind(canvas, (point, way), size, &avoided);
                    assert_eq!(avoided.cost(&rect).0, 0, "{point:?} {way:?}: {rect:?}");
                }
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
                let rect = beside(canvas, point, size, &NOTHING);
                assert!(canvas.contains_rect(rect), "{point:?}: {rect:?}");
                assert!(!rect.contains(point), "{point:?}: {rect:?}");
            }
        }
    }
}
