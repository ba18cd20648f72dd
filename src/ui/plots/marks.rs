//! What plots mark as the canvas does: features, bands of rising and falling curvature, joints.

use eframe::egui::{Align2, Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};
use egui_plot::{PlotPoint, PlotTransform};
use glam::DVec2;

use super::dots::{Crowd, by_halves};
use crate::editor::{FeatureMark, PieceTrend, PlotBand, PlotScene};
use crate::ui::feature_marks;
use crate::ui::theme::{self, STEP, Tokens};

/// The height of the bands along the lower edge.
const BAND: f32 = 4.0;

/// How far glyphs stay from the edges, and from each other, in points.
const GLYPH: f32 = 7.0;

/// How far the middles of two glyphs stay apart, in points: so far where few would touch, and
/// farther where most would.
const APART: [f64; 2] = [11.0, 44.0];

/// How near the pointer must be to a glyph, in points.
const NEAR: f32 = 8.0;

/// Paint behind the lines: bands, and the parts that a join added.
pub fn behind(scene: &PlotScene, transform: &PlotTransform, tokens: &Tokens) -> Shape {
    let frame = transform.frame();
    let part = |[from, to]: [f64; 2]| {
        let [left, right] = [from, to].map(|x| transform.position_from_point_x(x));
        Rect::from_x_y_ranges(left..=right, frame.y_range()).intersect(*frame)
    };
    let mut shapes = Vec::new();
    for joint in &scene.joints {
        let rect = part(*joint);
        if rect.is_positive() {
            let fill = tokens.target.gamma_multiply(0.1);
            shapes.push(Shape::rect_filled(rect, 0.0, fill));
        }
        for x in joint.map(|x| transform.position_from_point_x(x)) {
            if frame.x_range().contains(x) {
                let ends = [pos2(x, frame.top()), pos2(x, frame.bottom())];
                let stroke = Stroke::new(1.0, tokens.target.gamma_multiply(0.7));
                shapes.extend(Shape::dashed_line(&ends, stroke, 4.0, 3.0));
            }
        }
    }
    shapes.extend(scene.bands.iter().filter_map(|band| {
        let rect = part([band.from, band.to]);
        let rect = Rect::from_x_y_ranges(rect.x_range(), rect.bottom() - BAND..=rect.bottom());
        let fill = trend_colour(band, tokens);
        rect.is_positive()
            .then(|| Shape::rect_filled(rect, 0.0, fill))
    }));
    Shape::Vec(shapes)
}

fn trend_colour(band: &PlotBand, tokens: &Tokens) -> Color32 {
    match band.trend {
        PieceTrend::Rising => tokens.rising,
        PieceTrend::Falling => tokens.falling,
        PieceTrend::Undecided => tokens.undecided,
    }
}

/// Paint the glyphs of features, as far as they do not crowd. Returns the one that is nearest to the
/// pointer, if it is near.
pub fn features(
    painter: &Painter,
    scene: &PlotScene,
    transform: &PlotTransform,
    pointer: Option<Pos2>,
    tokens: &Tokens,
) -> Option<usize> {
    let frame = transform.frame();
    let size = DVec2::new(f64::from(frame.width()), f64::from(frame.height()));
    let mut crowd = Crowd::new(size, apart(scene, transform));
    let mut nearest: Option<(f32, usize)> = None;
    for index in by_halves(scene.features.len()) {
        let feature = &scene.features[index];
        let Some(at) = place(feature, transform) else {
            continue;
        };
        let from_corner = at - frame.min;
        if !crowd.keep(DVec2::new(
            f64::from(from_corner.x),
            f64::from(from_corner.y),
        )) {
            continue;
        }
        feature_marks::glyph(painter, at, feature.kind, tokens);
        let distance = pointer.map_or(f32::INFINITY, |pointer| pointer.distance(at));
        if distance <= NEAR && nearest.is_none_or(|(least, _)| distance < least) {
            nearest = Some((distance, index));
        }
    }
    nearest.map(|(_, index)| index)
}

/// How far glyphs stay apart: the curve is seen between them, however many there are.
fn apart(scene: &PlotScene, transform: &PlotTransform) -> f64 {
    let bounds = transform.bounds();
    let seen = bounds.min()[0]..=bounds.max()[0];
    let features = scene.features.iter();
    let seen = features.filter(|feature| seen.contains(&feature.at.x));
    let covered = seen.count() as f64 * APART[0];
    APART[usize::from(covered > 0.5 * f64::from(transform.frame().width()))]
}

/// Where the glyph of a feature stands: at the edge if its value lies beyond it. `None` if it is
/// beyond the left or right edge.
fn place(feature: &FeatureMark, transform: &PlotTransform) -> Option<Pos2> {
    let frame = transform.frame();
    let y = if feature.at.y.is_nan() {
        f64::INFINITY
    } else {
        feature.at.y
    };
    let y = y.clamp(transform.bounds().min()[1], transform.bounds().max()[1]);
    let at = transform.position_from_point(&PlotPoint::new(feature.at.x, y));
    let inner = frame.y_range().shrink(GLYPH);
    let y = if inner.min <= inner.max {
        inner.clamp(at.y)
    } else {
        at.y
    };
    frame.x_range().contains(at.x).then_some(pos2(at.x, y))
}

/// Name the lines that are not the curve's own, at the upper right.
pub fn legend(painter: &Painter, scene: &PlotScene, frame: &Rect, tokens: &Tokens) {
    let before = scene.before.is_some();
    let compared = Some(&scene.compared_name).filter(|_| scene.compared.is_some());
    let lines = [
        before.then(|| ("before", tokens.strong_text.gamma_multiply(0.5))),
        compared.map(|name| (name.as_str(), tokens.joints)),
        (!scene.joints.is_empty()).then_some(("joint", tokens.target)),
    ];
    let mut at = frame.right_top() + vec2(-2.0 * STEP, STEP);
    for (text, colour) in lines.into_iter().flatten() {
        let galley =
            painter.layout_no_wrap(text.to_owned(), theme::small_font(), tokens.faint_text);
        let rect = Align2::RIGHT_TOP.anchor_size(at, galley.size());
        let plate = rect
            .expand2(vec2(STEP, 0.0))
            .with_min_x(rect.left() - 5.0 * STEP);
        painter.rect_filled(plate, 2.0, tokens.panel.gamma_multiply(0.8));
        let dash = rect.left_center() - vec2(STEP, 0.0);
        let stroke = Stroke::new(1.5, colour);
        painter.line_segment([dash - vec2(3.0 * STEP, 0.0), dash], stroke);
        painter.galley(rect.min, galley, tokens.faint_text);
        at.y = rect.bottom();
    }
}
