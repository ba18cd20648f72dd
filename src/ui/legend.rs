//! The legend: the meaning of colours and marks on the canvas.

use eframe::egui::{
    Color32, Label, Painter, Rect, RichText, Sense, Shape, Stroke, StrokeKind, TextWrapMode, Ui,
    Vec2, vec2,
};

use super::feature_marks::glyph;
use super::theme::{STEP, Tokens};
use crate::editor::{FeatureKind, Layer, LayerSample};

/// The width of the sample in a row.
const SAMPLE: f32 = 7.0 * STEP;

/// The height of a row.
const HEIGHT: f32 = 5.0 * STEP;

/// The sample in a row, beside its colour.
#[derive(Clone, Copy)]
enum Sample {
    /// A band along the curve.
    Band,
    /// A line.
    Line,
    /// A dashed line with a square.
    Closed,
    /// A line with a disc.
    Float,
    /// A tick across the curve.
    Tick,
    /// A feature's glyph, in a colour of its own.
    Glyph(FeatureKind),
    /// A disc in a square.
    Locked,
}

/// A row: sample, colour and text.
type Row = (Sample, Color32, &'static str);

/// Show the legend under a remark.
pub fn legend_ui(ui: &mut Ui, remark: &str) {
    ui.set_min_width(60.0 * STEP);
    ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
    ui.label(remark);
    ui.separator();
    ui.spacing_mut().item_spacing.y = 0.0;
    let tokens = Tokens::of(ui);
    ui.columns(2, |columns| {
        let [left, right] = columns else {
            return;
        };
        for row in bands(tokens).into_iter().chain(glyphs(tokens)) {
            row_ui(left, row);
        }
        for row in lines(tokens) {
            row_ui(right, row);
        }
    });
}

fn bands(tokens: &Tokens) -> [Row; 3] {
    [
        (Sample::Band, tokens.rising, "Curvature rises"),
        (Sample::Band, tokens.falling, "Curvature falls"),
        (Sample::Band, tokens.undecided, "Undecided"),
    ]
}

fn glyphs(tokens: &Tokens) -> [Row; 9] {
    let kinds = [
        FeatureKind::CurvatureMaximum,
        FeatureKind::CurvatureMinimum,
        FeatureKind::Inflection,
        FeatureKind::Cusp,
        FeatureKind::CurvatureJump,
        FeatureKind::TorsionMaximum,
        FeatureKind::TorsionMinimum,
        FeatureKind::TorsionZero,
        FeatureKind::Undecided,
    ];
    kinds.map(|kind| {
        let name = match kind {
            FeatureKind::Undecided => "Undecided feature",
            _ => kind.label(),
        };
        (Sample::Glyph(kind), tokens.text, name)
    })
}

fn lines(tokens: &Tokens) -> impl Iterator<Item = Row> {
    let layers = Layer::ALL.into_iter().filter_map(|layer| {
        let row = layer.row();
        let sample = match row.sample? {
            LayerSample::Line => Sample::Line,
            LayerSample::Discs => Sample::Float,
            LayerSample::Squares => Sample::Closed,
        };
        Some((sample, tokens.named(row.colour), row.label))
    });
    layers.chain([
        (Sample::Locked, tokens.float, "Locked vertex"),
        (Sample::Tick, tokens.joints, "Joint of segments"),
        (Sample::Line, tokens.reference, "Reference"),
    ])
}

fn row_ui(ui: &mut Ui, (sample, colour, text): Row) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(SAMPLE, HEIGHT), Sense::hover());
        paint(ui.painter(), rect, (sample, colour), Tokens::of(ui));
        ui.add(Label::new(RichText::new(text)));
    });
}

fn paint(painter: &Painter, rect: Rect, (sample, colour): (Sample, Color32), tokens: &Tokens) {
    let at = rect.center();
    let ends = [rect.left_center(), rect.right_center()];
    let line = |width: f32, colour: Color32| {
        painter.line_segment(ends, Stroke::new(width, colour));
    };
    let square = |side: f32| {
        let rect = Rect::from_center_size(at, Vec2::splat(side));
        painter.rect_stroke(rect, 0, Stroke::new(1.25, colour), StrokeKind::Middle);
    };
    match sample {
        Sample::Band => {
            line(7.0, colour.gamma_multiply(0.4));
            line(2.0, tokens.curve);
        }
        Sample::Line => line(1.5, colour),
        Sample::Closed => {
            let stroke = Stroke::new(1.0, colour);
            painter.extend(Shape::dashed_line(&ends, stroke, 5.0, 4.0));
            square(7.0);
        }
        Sample::Float => {
            line(1.25, colour);
            painter.circle_filled(at, 4.0, colour);
        }
        Sample::Tick => {
            line(2.0, tokens.curve);
            let half = vec2(0.0, 5.0);
            painter.line_segment([at - half, at + half], Stroke::new(1.5, colour));
        }
        Sample::Glyph(kind) => glyph(painter, at, kind, tokens),
        Sample::Locked => {
            painter.circle_filled(at, 3.0, colour);
            square(13.0);
        }
    }
}
