//! The guides for moving vertices on the canvas: the border of the safe region, the moves that lose a
//! feature, and their texts.

use eframe::egui::{Align2, Pos2, Rect, Shape, Stroke, Vec2, vec2};

use super::brush::Brush;
use super::labels;
use super::theme::{self, STEP};
use crate::editor::{GuideLabel, GuideScene, LossArrow};

/// How far a text stays from the place that it speaks of.
const CLEARANCE: f32 = 8.0;

/// A move shorter than this, in points, is marked by a ring.
const SHORT: f32 = 10.0;

/// Paint the guides.
pub fn paint(brush: &Brush<'_>, guides: &GuideScene) {
    let own = brush.tokens.good;
    brush.dashed_chain(&guides.border, Stroke::new(1.25, own));
    let faint = Stroke::new(1.0, own.gamma_multiply(0.5));
    for line in brush.screen.lines(&guides.limit) {
        brush
            .painter
            .extend(Shape::dashed_line(&line, faint, 1.5, 5.0));
    }
    for arrow in guides.arrows.iter().rev() {
        brush.loss(arrow);
    }
    let mut taken: Vec<Rect> = Vec::new();
    for label in &guides.labels {
        brush.guide_label(label, &mut taken);
    }
}

impl Brush<'_> {
    fn loss(&self, arrow: &LossArrow) {
        let strength = if arrow.is_shortest { 1.0 } else { 0.5 };
        let colour = self.tokens.warning.gamma_multiply(strength);
        let stroke = Stroke::new(1.5, colour);
        self.arrow(arrow.ends, stroke);
        let ends = arrow.ends.map(|end| self.screen.point(end));
        if let [Some(from), Some(to)] = ends
            && from.distance(to) < SHORT
        {
            self.painter.circle_stroke(from, SHORT, stroke);
        }
    }

    /// Write a text outside of its place and within the canvas, unless an earlier one is there.
    fn guide_label(&self, label: &GuideLabel, taken: &mut Vec<Rect>) {
        let Some(at) = self.screen.point(label.at) else {
            return;
        };
        let font = theme::small_font();
        let size = labels::size(self.painter, &label.text, font.clone());
        let outwards = vec2(label.outwards.x as f32, -label.outwards.y as f32);
        let rect = beside(self.rect, at, outwards, size);
        if taken
            .iter()
            .any(|other| other.expand(STEP).intersects(rect))
        {
            return;
        }
        taken.push(rect);
        let (colour, tokens) = (self.tokens.strong_text, self.tokens);
        let (at, align) = (rect.left_top(), Align2::LEFT_TOP);
        labels::paint(self.painter, at, align, &label.text, font, colour, tokens);
    }
}

/// Find a box of some size on one side of a place, moved so that it stays on the canvas.
fn beside(canvas: Rect, at: Pos2, outwards: Vec2, size: Vec2) -> Rect {
    let outwards = outwards.normalized();
    let half = 0.5 * (outwards.x.abs() * size.x + outwards.y.abs() * size.y);
    let rect = Rect::from_center_size(at + outwards * (CLEARANCE + half), size);
    let room = canvas.shrink(STEP);
    let low = (room.min - rect.min).max(Vec2::ZERO);
    let high = (room.max - rect.max).min(Vec2::ZERO);
    rect.translate(low + high)
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn a_text_stands_outside_of_its_place_and_on_the_canvas() {
        let canvas = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        let size = vec2(80.0, 14.0);
        for step in 0..16 {
            let outwards = Vec2::angled(step as f32);
            let place = pos2(200.0, 150.0);
            let rect = beside(canvas, place, outwards, size);
            assert!(!rect.contains(place), "{outwards:?}: {rect:?}");
            let corner = beside(canvas, pos2(399.0, 1.0), outwards, size);
            assert!(canvas.contains_rect(corner), "{outwards:?}: {corner:?}");
        }
    }
}
