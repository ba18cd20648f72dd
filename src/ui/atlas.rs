//! The atlas of an operation: a plane of two parameters coloured by proved verdicts, with the present
//! values as a point that can be dragged.

use eframe::egui::{
    Align2, Color32, ColorImage, Key, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke,
    StrokeKind, TextureHandle, TextureOptions, Ui, WidgetInfo, pos2, vec2,
};

use super::number_field::FieldEvent;
use super::theme::{self, STEP, Tokens};
use super::{figures, widgets};
use crate::editor::{Editor, OperationInProgress};
use crate::geometry::features::Verdict;
use crate::geometry::mineur_farin::{self, ATLAS_SIZE, AtlasVerdicts};
use crate::geometry::parameters::Quantity;
use crate::operations::{Atlas, Parameter, Value};

/// The height of the picture.
const HEIGHT: f32 = 200.0;

/// The room for the numbers at the left, and for those below.
const MARGINS: [f32; 2] = [36.0, 34.0];

/// Where the numbers at the axes stand, as shares of the picture.
const TICKS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The radius of the point.
const POINT: f32 = 6.0;

/// Show an atlas, and remember its picture.
#[derive(Default)]
pub struct AtlasView {
    picture: Option<(Picture, TextureHandle)>,
    /// Whether its point is dragged; until it ends or Esc cancels it.
    dragged: bool,
}

/// Values of the operation's parameters, by name.
pub type Values = Vec<(&'static str, Value)>;

/// The data that a picture was made of.
#[derive(PartialEq)]
struct Picture {
    plane: mineur_farin::Atlas,
    stride: usize,
    dark: bool,
}

impl AtlasView {
    /// Show the atlas of the operation at hand; returns what the user did to its point.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        editor: &Editor,
        in_progress: &OperationInProgress,
        atlas: &Atlas,
    ) -> Option<FieldEvent<Values>> {
        let size = vec2(ui.available_width(), HEIGHT + MARGINS[1]);
        let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
        let low = whole.min + vec2(MARGINS[0], 0.5 * STEP);
        let rect = Rect::from_min_max(low, whole.max - vec2(0.5 * STEP, MARGINS[1]));
        let response = ui.interact(rect, ui.scope_id().with("atlas"), Sense::click_and_drag());
        let place = atlas.place(in_progress.values());
        describe(&response, in_progress, atlas);
        let found = editor.view().atlas();
        let found = found.filter(|(plane, _)| **plane == atlas.plane);
        let found = found.map(|(_, verdicts)| verdicts);
        if ui.is_rect_visible(whole) {
            self.paint_picture(ui, rect, atlas, found);
            paint_axes(ui, rect, atlas);
            let painter = ui.painter_at(rect);
            paint_bound(&painter, rect, atlas, Tokens::of(ui));
            let hot = response.hovered() || response.dragged();
            paint_point(&painter, at(rect, place), hot, Tokens::of(ui));
        }
        legend_ui(ui, atlas);
        self.event(ui, &response, rect, editor, atlas)
    }

    /// Turn a click or a drag into an event. Undo ends a drag in the editor, Esc here.
    fn event(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        editor: &Editor,
        atlas: &Atlas,
    ) -> Option<FieldEvent<Values>> {
        let values = || {
            let pointer = response.interact_pointer_pos()?;
            Some(atlas.values(place_at(rect, pointer)).to_vec())
        };
        if response.drag_started() {
            self.dragged = true;
            return values().map(FieldEvent::Preview);
        }
        if !self.dragged {
            let clicked = response.clicked().then(values).flatten();
            return clicked.map(FieldEvent::Set);
        }
        let holds = editor
            .operation()
            .is_some_and(OperationInProgress::holds_values);
        self.dragged = response.dragged() && holds;
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            self.dragged = false;
            return Some(FieldEvent::Abort);
        }
        if self.dragged {
            return values().map(FieldEvent::Preview);
        }
        Some(FieldEvent::Commit)
    }

    fn paint_picture(&mut self, ui: &Ui, rect: Rect, atlas: &Atlas, found: Option<&AtlasVerdicts>) {
        let tokens = Tokens::of(ui);
        ui.painter().rect_filled(rect, 0, tokens.inset);
        if let Some(found) = found {
            let picture = Picture {
                plane: atlas.plane,
                stride: found.stride(),
                dark: ui.visuals().dark_mode,
            };
            let known = self.picture.take().filter(|(known, _)| *known == picture);
            self.picture = known.or_else(|| {
                let (image, options) = (image(found, tokens), TextureOptions::NEAREST);
                Some((picture, ui.ctx().load_texture("atlas", image, options)))
            });
        }
        // Until there is another picture, the last one is shown.
        if let Some((_, texture)) = &self.picture {
            let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, all, Color32::WHITE);
        }
        let outline = Stroke::new(1.0, tokens.outline);
        ui.painter()
            .rect_stroke(rect, 0, outline, StrokeKind::Outside);
    }
}

/// The colour of a verdict: monotone is bright, the rest stays near the background.
fn colour(verdict: Verdict, tokens: &Tokens) -> Color32 {
    let (colour, share) = match verdict {
        Verdict::Proved => (tokens.good, 0.75),
        Verdict::Disproved => (tokens.warning, 0.3),
        Verdict::Undecided => (tokens.undecided, 0.6),
    };
    tokens.inset.lerp_to_gamma(colour, share)
}

fn image(found: &AtlasVerdicts, tokens: &Tokens) -> ColorImage {
    let rows = (0..ATLAS_SIZE).rev();
    let pixels = rows.flat_map(|row| {
        (0..ATLAS_SIZE).map(move |column| colour(found.verdict(column, row), tokens))
    });
    ColorImage::new([ATLAS_SIZE, ATLAS_SIZE], pixels.collect())
}

/// Where a place of the atlas is on the screen.
fn at(rect: Rect, [across, up]: [f64; 2]) -> Pos2 {
    let size = rect.size();
    rect.left_bottom() + vec2(across as f32 * size.x, -up as f32 * size.y)
}

/// The place of the atlas at a point of the screen.
fn place_at(rect: Rect, point: Pos2) -> [f64; 2] {
    let from = (point - rect.left_bottom()) / rect.size();
    [f64::from(from.x), f64::from(-from.y)]
}

fn paint_axes(ui: &Ui, rect: Rect, atlas: &Atlas) {
    let (font, colour) = (theme::small_font(), Tokens::of(ui).faint_text);
    let tick = Stroke::new(1.0, colour);
    let painter = ui.painter();
    for share in TICKS {
        let (across, up) = atlas.plane.at([share, share]);
        let [below, beside] = [at(rect, [share, 0.0]), at(rect, [0.0, share])];
        painter.line_segment([below, below + vec2(0.0, STEP)], tick);
        painter.line_segment([beside, beside - vec2(STEP, 0.0)], tick);
        let [across_align, up_align] = match share {
            0.0 => [Align2::LEFT_TOP, Align2::RIGHT_BOTTOM],
            1.0 => [Align2::RIGHT_TOP, Align2::RIGHT_TOP],
            _ => [Align2::CENTER_TOP, Align2::RIGHT_CENTER],
        };
        let (place, text) = (below + vec2(0.0, 1.25 * STEP), number(atlas.across, across));
        painter.text(place, across_align, text, font.clone(), colour);
        let (place, text) = (beside - vec2(1.5 * STEP, 0.0), number(atlas.up, up));
        painter.text(place, up_align, text, font.clone(), colour);
    }
    let name = format!("{} across, {} up", atlas.across.label, atlas.up.label);
    let place = pos2(rect.center().x, rect.bottom() + MARGINS[1]);
    painter.text(place, Align2::CENTER_BOTTOM, name, font, colour);
}

fn paint_bound(painter: &Painter, rect: Rect, atlas: &Atlas, tokens: &Tokens) {
    let Some(chains) = atlas.bound.and_then(|_| atlas.plane.bezier_bound()) else {
        return;
    };
    let stroke = Stroke::new(1.5, tokens.strong_text);
    for chain in chains {
        let points: Vec<Pos2> = chain.into_iter().map(|place| at(rect, place)).collect();
        painter.extend(Shape::dashed_line(&points, stroke, 5.0, 3.0));
    }
}

fn paint_point(painter: &Painter, at: Pos2, hot: bool, tokens: &Tokens) {
    let cross = Stroke::new(1.0, tokens.strong_text.gamma_multiply(0.5));
    let rect = painter.clip_rect();
    painter.hline(rect.x_range(), at.y, cross);
    painter.vline(at.x, rect.y_range(), cross);
    let fill = if hot {
        tokens.accent
    } else {
        tokens.background
    };
    painter.circle(at, POINT, fill, Stroke::new(2.0, tokens.strong_text));
}

/// Explain the colours and the dashed line.
fn legend_ui(ui: &mut Ui, atlas: &Atlas) {
    let tokens = Tokens::of(ui);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for (verdict, text) in [
            (Verdict::Proved, "κ monotone"),
            (Verdict::Disproved, "not monotone"),
            (Verdict::Undecided, "undecided"),
        ] {
            let (rect, _) = ui.allocate_exact_size(vec2(3.0 * STEP, 3.0 * STEP), Sense::hover());
            widgets::swatch(ui, rect, colour(verdict, tokens));
            widgets::caption(ui, text);
            ui.add_space(STEP);
        }
    });
    if let Some(bound) = atlas.bound {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let (rect, _) = ui.allocate_exact_size(vec2(6.0 * STEP, 3.0 * STEP), Sense::hover());
            let line = [rect.left_center(), rect.right_center()];
            let stroke = Stroke::new(1.5, tokens.strong_text);
            let line = Shape::dashed_line(&line, stroke, 5.0, 3.0);
            ui.painter().extend(line);
            widgets::caption(ui, bound);
        });
    }
}

/// Describe the point to screen readers.
fn describe(response: &Response, in_progress: &OperationInProgress, atlas: &Atlas) {
    let told = [atlas.across, atlas.up].map(|parameter| {
        let value = in_progress.values().get(parameter);
        format!("{} {}", parameter.label, parameter.text(value))
    });
    let told = format!("Atlas: {}, {}", told[0], told[1]);
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, told.clone()));
}

/// A number at an axis.
fn number(parameter: &Parameter, number: f64) -> String {
    let quantity = parameter.quantity();
    let text = figures::significant(quantity.shown(number), 3);
    let text = match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    match quantity {
        Quantity::Angle => format!("{text}°"),
        _ => text.to_owned(),
    }
}
