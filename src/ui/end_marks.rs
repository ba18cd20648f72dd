//! The end-fit tool on the canvas: actual end, target, what differs, and the ring that rotates.

use eframe::egui::{Align2, Pos2, Shape, Stroke, vec2};
use glam::DVec2;

use super::painting::Brush;
use super::{figures, labels, theme};
use crate::editor::EndFitMarks;

/// Half the height of the target's diamond, in points.
const DIAMOND: f32 = 7.0;

/// The angle's arc, as a share of the ring's radius.
const ARC: f64 = 0.7;

/// Differences below this, in points or radians, are not drawn.
const VISIBLE: f64 = 1e-3;

/// Paint one end's marks.
pub fn paint(brush: &Brush<'_>, marks: &EndFitMarks) {
    if marks.chosen {
        actual(brush, marks);
    }
    target(brush, marks);
}

fn target(brush: &Brush<'_>, marks: &EndFitMarks) {
    let Some(point) = marks.target else {
        return;
    };
    let stroke = Stroke::new(1.5, brush.tokens.target);
    if let Some(tip) = marks.target_tip {
        brush.arrow([point, tip], stroke);
    }
    let Some(at) = brush.screen.point(point) else {
        return;
    };
    let corners = [
        vec2(0.0, -DIAMOND),
        vec2(DIAMOND, 0.0),
        vec2(0.0, DIAMOND),
        vec2(-DIAMOND, 0.0),
    ];
    let outline = corners.map(|corner| at + corner).to_vec();
    brush.painter.add(Shape::closed_line(outline, stroke));
}

fn actual(brush: &Brush<'_>, marks: &EndFitMarks) {
    let tokens = brush.tokens;
    for vertex in &marks.terminal {
        if let Some(at) = brush.screen.point(*vertex) {
            brush
                .painter
                .circle_stroke(at, 7.0, Stroke::new(1.0, tokens.target));
        }
    }
    if let Some(tip) = marks.tangent_tip {
        brush.arrow([marks.actual, tip], Stroke::new(1.5, tokens.curve));
    }
    if let Some(point) = marks.target {
        let apart = point.distance(marks.actual) * brush.screen.scale();
        if apart > VISIBLE {
            brush.dashed([marks.actual, point], Stroke::new(1.0, tokens.target));
        }
    }
    if let Some(at) = brush.screen.point(marks.actual) {
        ring(brush, marks, at);
        brush
            .painter
            .circle(at, 3.5, tokens.background, Stroke::new(1.5, tokens.curve));
    }
}

/// The ring that rotates the terminal vertices, its handle where the tangent crosses it, and the
/// arc of the difference angle.
fn ring(brush: &Brush<'_>, marks: &EndFitMarks, at: Pos2) {
    let tokens = brush.tokens;
    let radius = (marks.ring * brush.screen.scale()) as f32;
    if !(radius > 1.0 && radius < 1e4) {
        return;
    }
    let faint = Stroke::new(1.0, tokens.target.gamma_multiply(0.55));
    brush.painter.circle_stroke(at, radius, faint);
    let Some(tip) = marks.tangent_tip else {
        return;
    };
    let Some(along) = (tip - marks.actual).try_normalize() else {
        return;
    };
    if marks.angle.abs() > VISIBLE {
        angle(brush, marks);
    }
    if let Some(handle) = brush.screen.point(marks.actual + along * marks.ring) {
        let stroke = Stroke::new(1.5, tokens.target);
        brush.painter.circle(handle, 5.5, tokens.background, stroke);
    }
}

fn angle(brush: &Brush<'_>, marks: &EndFitMarks) {
    let tokens = brush.tokens;
    let (Some(last), Some(middle)) = (marks.arc.last(), marks.arc.get(marks.arc.len() / 2)) else {
        return;
    };
    let place = |along: &DVec2, share: f64| marks.actual + share * marks.ring * *along;
    let arc: Vec<DVec2> = marks.arc.iter().map(|along| place(along, ARC)).collect();
    brush.chain(&arc, Stroke::new(2.0, tokens.target));
    let ray = [marks.actual, place(last, 1.0)];
    brush.dashed(ray, Stroke::new(1.0, tokens.target));
    // Beside the arc lie arrows and handles: the figure stands on the free side of the ring.
    let outwards = middle.try_normalize().unwrap_or(DVec2::Y);
    let behind = marks.actual - outwards * (marks.ring + 26.0 / brush.screen.scale());
    if let Some(at) = brush.screen.point(behind) {
        let text = figures::degrees(marks.angle, 2);
        let font = theme::number_font();
        labels::paint(
            brush.painter,
            at,
            Align2::CENTER_CENTER,
            &text,
            font,
            tokens.target,
            tokens,
        );
    }
}
