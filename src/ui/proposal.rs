//! The preview of the curve that a click would make, fainter than the drawing.

use eframe::egui::{Color32, Stroke};

use super::brush::Brush;
use crate::editor::CurveScene;

/// How faint its polygons are.
const FAINT: f32 = 0.55;

/// Paint the curve that a click would make, and its polygons.
pub fn paint(brush: &Brush<'_>, proposal: &CurveScene) {
    let tokens = brush.tokens;
    let faint = |colour: Color32| Stroke::new(1.0, colour.gamma_multiply(FAINT));
    brush.legs(&proposal.clamped, true, faint(tokens.clamped));
    brush.legs(&proposal.float, false, faint(tokens.float));
    let colour = tokens.of_item(proposal.id, proposal.colour, false);
    brush.chain(&proposal.curve, Stroke::new(1.5, colour));
}
