//! The glyphs of proved features, on the canvas and in lists: each has its own form.

use eframe::egui::{Color32, Painter, Pos2, Shape, Stroke, vec2};

use super::brush::Brush;
use super::theme::Tokens;
use crate::editor::{FeatureKind, FeatureMark};

/// Half the size of a glyph.
const HALF: f32 = 5.0;

/// Paint a feature on the canvas.
pub fn paint(brush: &Brush<'_>, mark: &FeatureMark) {
    if let Some(at) = brush.screen.point(mark.at) {
        glyph(brush.painter, at, mark.kind, brush.tokens);
    }
}

/// The colour of a kind of feature.
fn colour(kind: FeatureKind, tokens: &Tokens) -> Color32 {
    match kind {
        FeatureKind::Inflection
        | FeatureKind::TorsionZero
        | FeatureKind::CurvatureMaximum
        | FeatureKind::CurvatureMinimum => tokens.strong_text,
        FeatureKind::TorsionMaximum | FeatureKind::TorsionMinimum => tokens.evolute,
        FeatureKind::Cusp => tokens.error,
        FeatureKind::Undecided => tokens.undecided,
    }
}

/// Paint a feature's glyph: triangles for extrema, upwards for maxima; a diamond for an
/// inflection, a square for a zero of the torsion, a cross for a cusp, a ring for an
/// undecided feature.
pub fn glyph(painter: &Painter, at: Pos2, kind: FeatureKind, tokens: &Tokens) {
    let own = colour(kind, tokens);
    let stroke = Stroke::new(1.5, own);
    let corners = |corners: &[(f32, f32)]| -> Vec<Pos2> {
        let corner = |(x, y): &(f32, f32)| at + HALF * vec2(*x, *y);
        corners.iter().map(corner).collect()
    };
    let shape = |points: Vec<Pos2>| Shape::convex_polygon(points, tokens.background, stroke);
    match kind {
        FeatureKind::CurvatureMaximum | FeatureKind::TorsionMaximum => {
            painter.add(shape(corners(&[(0.0, -1.1), (1.0, 0.8), (-1.0, 0.8)])));
        }
        FeatureKind::CurvatureMinimum | FeatureKind::TorsionMinimum => {
            painter.add(shape(corners(&[(0.0, 1.1), (-1.0, -0.8), (1.0, -0.8)])));
        }
        FeatureKind::Inflection => {
            let diamond = [(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)];
            painter.add(shape(corners(&diamond)));
        }
        FeatureKind::TorsionZero => {
            let square = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
            painter.add(shape(corners(&square)));
        }
        FeatureKind::Cusp => {
            for (x, y) in [(1.0, 1.0), (1.0, -1.0)] {
                let arm = HALF * vec2(x, y);
                painter.line_segment([at - arm, at + arm], stroke);
            }
        }
        FeatureKind::Undecided => {
            painter.circle(at, HALF, tokens.background, stroke);
        }
    }
}
