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
        FeatureKind::Cusp | FeatureKind::CurvatureJump => tokens.error,
        FeatureKind::Undecided => tokens.undecided,
    }
}

/// Paint a feature's glyph: triangles for extrema, upwards for maxima; a diamond for an
/// inflection, a square for a zero of the torsion, a cross for a cusp, a step for a
/// jump of the curvature, a ring for an undecided feature.
pub fn glyph(painter: &Painter, at: Pos2, kind: FeatureKind, tokens: &Tokens) {
    let stroke = Stroke::new(1.5, colour(kind, tokens));
    let corners: &[(f32, f32)] = match kind {
        FeatureKind::CurvatureMaximum | FeatureKind::TorsionMaximum => {
            &[(0.0, -1.1), (1.0, 0.8), (-1.0, 0.8)]
        }
        FeatureKind::CurvatureMinimum | FeatureKind::TorsionMinimum => {
            &[(0.0, 1.1), (-1.0, -0.8), (1.0, -0.8)]
        }
        FeatureKind::Inflection => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
        FeatureKind::TorsionZero => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        FeatureKind::Cusp => {
            for arm in [vec2(HALF, HALF), vec2(HALF, -HALF)] {
                painter.line_segment([at - arm, at + arm], stroke);
            }
            return;
        }
        FeatureKind::CurvatureJump => {
            let steps = [(-1.2, 0.7), (0.0, 0.7), (0.0, -0.7), (1.2, -0.7)];
            let steps = steps.map(|(x, y)| at + HALF * vec2(x, y));
            painter.add(Shape::line(steps.to_vec(), stroke));
            return;
        }
        FeatureKind::Undecided => {
            painter.circle(at, HALF, tokens.background, stroke);
            return;
        }
    };
    let corners = corners.iter().map(|(x, y)| at + HALF * vec2(*x, *y));
    painter.add(Shape::convex_polygon(
        corners.collect(),
        tokens.background,
        stroke,
    ));
}
