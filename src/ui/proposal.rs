//! The preview of the curve that a click would make, fainter than the drawing.

use eframe::egui::Stroke;

use super::brush::Brush;
use super::theme;
use crate::editor::ProposalScene;

/// How faint its polygons are.
const FAINT: f32 = 0.55;

/// Paint the curve that a click would make, and its polygons.
pub fn paint(brush: &Brush<'_>, proposal: &ProposalScene) {
    let tokens = brush.tokens;
    let faint = |colour: eframe::egui::Color32| Stroke::new(1.0, colour.gamma_multiply(FAINT));
    brush.dashed_legs(&proposal.clamped, faint(tokens.clamped));
    brush.legs(&proposal.float, faint(tokens.float));
    let next = || proposal.id.map_or(tokens.curve, |id| tokens.of_curve(id));
    let colour = proposal.colour.map_or_else(next, theme::of_document);
    brush.chain(&proposal.curve, Stroke::new(1.5, colour));
}
