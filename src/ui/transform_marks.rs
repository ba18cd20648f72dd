//! The ring that rotates, and the box that scales.

use eframe::egui::{Color32, Mesh, Shape, Stroke};
use glam::DVec2;

use super::brush::Brush;

/// The side of square handles.
const SQUARE: f32 = 9.0;

/// The radius of round handles, and of those at sides.
const DISC: f32 = 6.0;
const SIDE: f32 = 4.5;

/// The opacity of lines and of the swept sector.
const LINE: f32 = 0.6;
const SWEPT: f32 = 0.16;

/// The largest angle between two points of the sector's border.
const STEP: f64 = 0.05;

/// Paint the ring about a centre, with its handle and the sector that it has swept.
pub fn ring(brush: &Brush<'_>, centre: DVec2, handle: DVec2, swept: f64) {
    let (Some(at), Some(end)) = (brush.screen.point(centre), brush.screen.point(handle)) else {
        return;
    };
    let accent = brush.tokens.accent;
    let arm = handle - centre;
    let steps = (swept.abs() / STEP).ceil().clamp(1.0, 512.0) as u32;
    let place = |step: u32| {
        let back = swept * (1.0 - f64::from(step) / f64::from(steps));
        let border = centre + DVec2::from_angle(-back).rotate(arm);
        brush.screen.point(border)
    };
    let mut mesh = Mesh::default();
    let fill = accent.gamma_multiply(SWEPT);
    mesh.colored_vertex(at, fill);
    for step in 0..=steps {
        let Some(border) = place(step) else {
            return;
        };
        mesh.colored_vertex(border, fill);
        if step > 0 {
            mesh.add_triangle(0, step, step + 1);
        }
    }
    if swept != 0.0 {
        brush.painter.add(Shape::mesh(mesh));
    }
    let line = Stroke::new(1.0, accent.gamma_multiply(LINE));
    brush.painter.circle_stroke(at, at.distance(end), line);
    let (fill, outline) = handle_colours(brush);
    brush.painter.circle(end, DISC, fill, outline);
}

/// Paint a box with its corners and the handles of its sides.
pub fn corners(brush: &Brush<'_>, corners: &[DVec2; 4], handles: &[DVec2]) {
    let line = Stroke::new(1.0, brush.tokens.accent.gamma_multiply(LINE));
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    for (from, to) in sides {
        brush.segment([*from, *to], line);
    }
    let (fill, outline) = handle_colours(brush);
    for handle in handles {
        brush.disc(*handle, SIDE, fill, outline);
    }
    for corner in corners {
        brush.square(*corner, SQUARE, fill, outline);
    }
}

/// Paint the frame of a reference: its squares scale, the disc at the end of its arm rotates.
pub fn frame(brush: &Brush<'_>, box_corners: &[DVec2; 4], arm: [DVec2; 2]) {
    let line = Stroke::new(1.0, brush.tokens.accent.gamma_multiply(LINE));
    brush.segment(arm, line);
    corners(brush, box_corners, &[]);
    let (fill, outline) = handle_colours(brush);
    brush.disc(arm[1], DISC, fill, outline);
}

fn handle_colours(brush: &Brush<'_>) -> (Color32, Stroke) {
    let tokens = brush.tokens;
    (tokens.background, Stroke::new(1.5, tokens.accent))
}
