//! The guides for moving vertices on the canvas: the border of the safe region, the moves that lose a
//! feature, and their texts.

use eframe::egui::{Align2, Color32, Mesh, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use glam::DVec2;

use super::brush::Brush;
use super::labels;
use super::theme::{self, STEP};
use crate::editor::{GuideLabel, GuideScene, LossArrow};

/// How far a text stays from the place that it speaks of.
const CLEARANCE: f32 = 8.0;

/// A move shorter than this, in points, is marked by a ring.
const SHORT: f32 = 10.0;

/// Regions farther from the window than this, in points, are not filled.
const FARTHEST: f64 = 1e5;

/// How far texts stay from the canvas's edge, where the grid's numbers are.
const EDGE: f32 = 6.0 * STEP;

/// Paint the guides.
pub fn paint(brush: &Brush<'_>, guides: &GuideScene) {
    let own = brush.tokens.good;
    if let Some((centre, corners)) = &guides.region {
        brush.fan(*centre, corners, own.gamma_multiply(0.12));
    }
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
    for label in &guides.labels {
        brush.guide_label(label);
    }
}

impl Brush<'_> {
    /// Fill the triangles between a point and the corners round it.
    fn fan(&self, centre: DVec2, corners: &[DVec2], colour: Color32) {
        // Single numbers are exact enough within this distance.
        let is_near = |point: DVec2| self.screen.exact(point).abs().max_element() < FARTHEST;
        let place = |point: DVec2| is_near(point).then(|| self.screen.pos(point));
        let all = [centre].into_iter().chain(corners.iter().copied());
        let Some(places) = all.map(place).collect::<Option<Vec<Pos2>>>() else {
            return;
        };
        let mut mesh = Mesh::default();
        for place in places {
            mesh.colored_vertex(place, colour);
        }
        let count = corners.len() as u32;
        for corner in 0..count {
            mesh.add_triangle(0, 1 + corner, 1 + (corner + 1) % count);
        }
        self.painter.add(Shape::mesh(mesh));
    }

    fn loss(&self, arrow: &LossArrow) {
        let strength = if arrow.is_shortest { 1.0 } else { 0.5 };
        let colour = self.tokens.accent.gamma_multiply(strength);
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
    fn guide_label(&self, label: &GuideLabel) {
        let place = self.screen.point(label.at);
        let Some(at) = place.filter(|at| self.rect.contains(*at)) else {
            return;
        };
        let font = theme::small_font();
        let size = labels::size(self.painter, &label.text, font.clone());
        let outwards = vec2(label.outwards.x as f32, -label.outwards.y as f32);
        let rect = beside(self.rect, at, outwards, size);
        if !self.keep_text(rect) {
            return;
        }
        let (at, align) = (rect.left_top(), Align2::LEFT_TOP);
        labels::paint(self, at, align, &label.text, font, self.tokens.strong_text);
    }
}

/// Find a box of some size on one side of a place, moved so that it stays on the canvas.
fn beside(canvas: Rect, at: Pos2, outwards: Vec2, size: Vec2) -> Rect {
    let rect = labels::outside(at, outwards.normalized(), size, CLEARANCE);
    labels::moved_into(canvas.shrink(EDGE), rect)
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
            assert!(canvas.contains_rect(rect));
            let corner = beside(canvas, pos2(399.0, 1.0), outwards, size);
            assert!(canvas.contains_rect(corner), "{outwards:?}: {corner:?}");
        }
    }
}
