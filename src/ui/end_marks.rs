//! The end-fit tool on the canvas: actual end, target, what differs, and the ring that rotates.

use eframe::egui::{Align2, Color32, Pos2, Shape, Stroke, vec2};
use glam::DVec2;
use lucide_icons::Icon;

use super::brush::Brush;
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
    brush.dashed_chain(&marks.circle, Stroke::new(1.0, brush.tokens.target));
    let Some(at) = brush.screen.point(point) else {
        return;
    };
    if let Some(met) = marks.matched {
        link(brush, at, met);
    }
    let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
    let outline = corners.map(|(x, y)| at + DIAMOND * vec2(x, y)).to_vec();
    brush.painter.add(Shape::closed_line(outline, stroke));
}

/// Two links of a chain beside the target: the end is kept matched. In the colour of errors where
/// that is not met.
fn link(brush: &Brush<'_>, at: Pos2, met: bool) {
    let tokens = brush.tokens;
    let (icon, colour) = match met {
        true => (Icon::Link, tokens.target),
        false => (Icon::Unlink, tokens.error),
    };
    let place = at + vec2(-DIAMOND - 5.0, DIAMOND + 5.0);
    let (text, font) = (char::from(icon).to_string(), theme::icon_font(14.0));
    labels::paint(brush, place, Align2::CENTER_CENTER, &text, font, colour);
}

fn actual(brush: &Brush<'_>, marks: &EndFitMarks) {
    let tokens = brush.tokens;
    for vertex in &marks.terminal {
        let outline = Stroke::new(1.0, tokens.target);
        brush.disc(*vertex, 7.0, Color32::TRANSPARENT, outline);
    }
    if let Some(tip) = marks.tangent_tip {
        brush.arrow([marks.actual, tip], Stroke::new(1.5, tokens.curve));
    }
    if let Some(point) = marks.target {
        let apart = point.distance(marks.actual) * brush.screen.scale();
        if apart > VISIBLE {
            brush.dashed_chain(&[marks.actual, point], Stroke::new(1.0, tokens.target));
        }
    }
    if let Some(at) = brush.screen.point(marks.actual) {
        ring(brush, marks, at);
        let outline = Stroke::new(1.5, tokens.curve);
        brush.disc(marks.actual, 3.5, tokens.background, outline);
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
    let handle = marks.actual + along * marks.ring;
    let outline = Stroke::new(1.5, tokens.target);
    brush.disc(handle, 5.5, tokens.background, outline);
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
    brush.dashed_chain(&ray, Stroke::new(1.0, tokens.target));
    let behind = free_place(brush, marks, *middle);
    if let Some(at) = brush.screen.point(behind) {
        let text = figures::degrees(marks.angle, 2);
        let (font, colour) = (theme::number_font(), tokens.target);
        labels::paint(brush, at, Align2::CENTER_CENTER, &text, font, colour);
    }
}

/// Where around the ring a figure is farthest from arrows, handles and vertices; of places about
/// as good, the one opposite to the arc.
fn free_place(brush: &Brush<'_>, marks: &EndFitMarks, middle: DVec2) -> DVec2 {
    /// Directions that are tried.
    const TRIED: u8 = 16;
    let pixel = 1.0 / brush.screen.scale();
    let radius = marks.ring + 28.0 * pixel;
    let tips = [marks.target, marks.target_tip, marks.tangent_tip];
    let terminal = marks.terminal.iter().copied();
    let taken: Vec<DVec2> = tips.into_iter().flatten().chain(terminal).collect();
    let opposite = -middle.try_normalize().unwrap_or(DVec2::NEG_Y);
    let place = |step: u8| {
        let turn = std::f64::consts::TAU * f64::from(step) / f64::from(TRIED);
        marks.actual + radius * DVec2::from_angle(turn).rotate(opposite)
    };
    let free = |place: DVec2| {
        let nearest = taken.iter().map(|other| other.distance(place));
        // Farther than this from everything is free enough.
        nearest.fold(60.0 * pixel, f64::min)
    };
    (0..TRIED)
        .map(place)
        .reduce(|best, next| if free(next) > free(best) { next } else { best })
        .unwrap_or(marks.actual)
}
