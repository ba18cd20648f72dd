//! The brush of the scene: lines and arrows between points of the model.

use std::cell::RefCell;

use eframe::egui::{Color32, Painter, Rect, Shape, Stroke, StrokeKind, Vec2};
use glam::DVec2;

use super::chains::Screen;
use super::theme::{STEP, Tokens};
use crate::editor::Legs;

/// The state that all parts of the scene are painted with.
pub struct Brush<'a> {
    /// The painter, clipped to the canvas.
    pub painter: &'a Painter,
    /// From the model to the screen.
    pub screen: Screen<'a>,
    /// The canvas.
    pub rect: Rect,
    /// The colours.
    pub tokens: &'a Tokens,
    /// Where panels lie over the canvas.
    pub overlays: Vec<Rect>,
    /// Where there are texts that no other may lie over.
    pub texts: RefCell<Vec<Rect>>,
}

impl Brush<'_> {
    /// Keep a box for a text, if it is on the canvas and clear of those that are kept already.
    pub fn keep_text(&self, rect: Rect) -> bool {
        let mut texts = self.texts.borrow_mut();
        let is_clear = |other: &Rect| !other.expand(STEP).intersects(rect);
        let fits = self.rect.contains_rect(rect) && texts.iter().all(is_clear);
        if fits {
            texts.push(rect);
        }
        fits
    }

    /// Paint a chain as a line, one for each of its pieces.
    pub fn chain(&self, chain: &[DVec2], stroke: Stroke) {
        for line in self.screen.lines(chain) {
            self.painter.add(Shape::line(line, stroke));
        }
    }

    /// Paint a chain as dashed lines.
    pub fn dashed_chain(&self, chain: &[DVec2], stroke: Stroke) {
        for line in self.screen.lines(chain) {
            let dashes = Shape::dashed_line(&line, stroke, 5.0, 4.0);
            self.painter.extend(dashes);
        }
    }

    /// Paint the legs of a polygon, fainter where they crowd.
    pub fn legs(&self, legs: &Legs, is_dashed: bool, stroke: Stroke) {
        for (chain, strength) in legs.chains() {
            let stroke = Stroke::new(stroke.width, stroke.color.gamma_multiply(strength));
            match is_dashed {
                true => self.dashed_chain(chain, stroke),
                false => self.chain(chain, stroke),
            }
        }
    }

    /// Paint a line between two model points.
    pub fn segment(&self, ends: [DVec2; 2], stroke: Stroke) {
        if let Some(ends) = self.screen.segment(ends) {
            self.painter.line_segment(ends, stroke);
        }
    }

    /// Paint a disc at a model point, with its radius in points.
    pub fn disc(&self, at: DVec2, radius: f32, fill: Color32, outline: Stroke) {
        if let Some(at) = self.screen.point(at) {
            self.painter.circle(at, radius, fill, outline);
        }
    }

    /// Paint a square at a model point, with its side in points.
    pub fn square(&self, at: DVec2, side: f32, fill: Color32, outline: Stroke) {
        if let Some(at) = self.screen.point(at) {
            let rect = Rect::from_center_size(at, Vec2::splat(side));
            let rounding = u8::from(fill != Color32::TRANSPARENT);
            let kind = StrokeKind::Middle;
            self.painter.rect(rect, rounding, fill, outline, kind);
        }
    }

    /// Paint an arrow between two model points, its head at the second.
    pub fn arrow(&self, [from, to]: [DVec2; 2], stroke: Stroke) {
        let Some([tail, tip]) = self.screen.segment([from, to]) else {
            return;
        };
        self.painter.line_segment([tail, tip], stroke);
        if self.screen.point(to).is_some() && tail.distance(tip) > 1.0 {
            let along = (tip - tail).normalized();
            let side = along.rot90();
            let head = |sign: f32| tip - along * 9.0 + side * (4.0 * sign);
            let points = vec![tip, head(1.0), head(-1.0)];
            let head = Shape::convex_polygon(points, stroke.color, Stroke::NONE);
            self.painter.add(head);
        }
    }
}
