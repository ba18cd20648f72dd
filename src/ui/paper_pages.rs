//! What each page about the paper says, and its live figures.

use std::collections::HashMap;

use eframe::egui::{
    Align2, Button, Label, Response, RichText, Role, Sense, Slider, Ui, WidgetInfo, vec2,
};

use super::theme::{self, Tokens};
use super::{figures, widgets};
use crate::editor::{Editor, PaperPage, spiral_deviations};
use crate::geometry::PolygonError;
use crate::geometry::paper::{
    CircleComparison, PAPER_RADIUS, RoundingTest, Shortening, evolute_reach, paper_sides,
};

/// The degrees of the table of circles.
const DEGREES: std::ops::RangeInclusive<usize> = 2..=15;

/// The most digits that the rounding test keeps.
const MOST_DIGITS: usize = 15;

/// The width of a column of the table of circles.
const COLUMN: f32 = 92.0;

/// The height of a line of that table.
const LINE: f32 = 5.0 * theme::STEP;

/// What the paper prints of Table 1: the degree, the Bézier curve, the B-spline.
const PRINTED: [(usize, &str, &str); 4] = [
    (3, "8.17283e-1", "8.33333e-1"),
    (5, "8.06272e-2", "1.11371e-3"),
    (7, "4.65855e-2", "7.85284e-6"),
    (9, "3.19524e-2", "5.92221e-8"),
];

/// What the paper prints of the rounding test, whose coordinates are cut off after three digits.
const PRINTED_ROUNDING: (usize, &str) = (3, "3.06354e-1");

/// The numbers of vertices by which the spiral is approximated, and the steps of s that they make.
const SPIRALS: [(usize, &str); 2] = [(20, "Steps of 1"), (32, "Steps of ½")];

/// The state of the pages' controls.
pub struct PaperPages {
    digits: usize,
    shortening: Shortening,
    /// What is computed once: the rows of the table of circles.
    circles: Vec<Result<CircleComparison, PolygonError>>,
    /// How far the curves are from the spiral, by their number of vertices.
    spirals: HashMap<usize, Option<[f64; 2]>>,
    /// The rounding test for the present digits.
    rounding: Option<Result<RoundingTest, PolygonError>>,
}

impl Default for PaperPages {
    fn default() -> Self {
        Self {
            digits: MOST_DIGITS,
            shortening: Shortening::CutOff,
            circles: Vec::new(),
            spirals: HashMap::new(),
            rounding: None,
        }
    }
}

impl PaperPages {
    /// Put the controls back: a page's document was opened.
    pub fn begin(&mut self) {
        self.digits = MOST_DIGITS;
        self.rounding = None;
    }

    /// Show a page. Returns the page whose document is asked for.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, page: PaperPage) -> Option<PaperPage> {
        match page {
            PaperPage::Arc => self.arc_ui(ui, editor),
            PaperPage::Rounding => self.rounding_ui(ui, editor),
            PaperPage::Circles { degree } => return self.circles_ui(ui, degree),
            PaperPage::Steps => steps_ui(ui),
            PaperPage::Typical => typical_ui(ui),
            PaperPage::Spiral { vertices } => return self.spiral_ui(ui, vertices),
            PaperPage::Composite => composite_ui(ui),
        }
        None
    }

    fn arc_ui(&mut self, ui: &mut Ui, editor: &Editor) {
        text(
            ui,
            "Ten corners of a regular dodecagon of radius 10 are the vertices of a float S-polygon of \
             degree 9. They make one segment: the short arc between the middle corners.",
        );
        text(
            ui,
            "The same arc has a closed S-polygon (clamped): it begins and ends on the curve, and its \
             legs are a tenth as long. Zoom in to see it.",
        );
        text(
            ui,
            "How round is the arc? The evolute of a circle is its centre, so the largest distance of \
             the evolute from the centre says it in one figure:",
        );
        let exact = self.circle(9).map(|row| row.bspline);
        figure(ui, "Printed in the paper", "5.92221e-8");
        figure(ui, "Exact", &scientific(exact));
        figure(
            ui,
            "The active curve now",
            &reach(editor).map_or("–".to_owned(), distance),
        );
        note(
            ui,
            "The printed figure is 2e-10 too large, as much as coordinates rounded on the way leave. \
             Drag a vertex to see how sensitive the evolute is, and press Ctrl+Z.",
        );
        note(
            ui,
            "The vertices lie on a circle of radius 10, the curve on one of radius 8.918: a float \
             S-polygon keeps the shape but makes it smaller.",
        );
    }

    fn rounding_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        text(
            ui,
            "The paper cuts the coordinates of one vertex of the closed S-polygon, the second, to three \
             digits after the decimal point. The curve is no arc any more, and the float S-polygon \
             that belongs to it flies apart. Drag the slider to 3 to see it.",
        );
        let available = editor.has_shortened();
        ui.add_enabled_ui(available, |ui| self.digits_ui(ui, editor));
        if !available {
            note(ui, "The curve of this test was changed: reopen its curves.");
        }
        let test = self.rounding(self.digits);
        if let Some(test) = &test {
            let [x, y, _] = test.after.to_array();
            figure(ui, "Vertex x", &x.to_string());
            figure(ui, "Vertex y", &y.to_string());
            figure(ui, "Float vertices move", &short(test.moved));
            figure(
                ui,
                "Evolute from centre",
                &scientific(Some(test.evolute_reach)),
            );
        }
        let (digits, printed) = PRINTED_ROUNDING;
        let is_printed = self.digits == digits && self.shortening == Shortening::CutOff;
        let printed = if is_printed { printed } else { "–" };
        figure(ui, "Printed in the paper", printed);
        text(
            ui,
            "Going from the float to the closed S-polygon only interpolates. The way back \
             extrapolates: at degree 9 it multiplies an error in this vertex by more than two \
             million. So a curve should be kept, edited and exchanged by its float S-polygon.",
        );
        note(
            ui,
            "The paper prints 8.748 for 8.7485818…, so it cuts digits off. Rounded to the nearest, the \
             error is smaller by chance and multiplied all the same. Its other figures, such as \
             −83.972 for −83.97289, are cut off after three digits too.",
        );
    }

    fn digits_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let before = (self.digits, self.shortening);
        let slider = widgets::form_row(ui, "Digits kept", |ui| {
            let slider = Slider::new(&mut self.digits, 0..=MOST_DIGITS).show_value(false);
            let slider = ui.add(slider).accessible_name("Digits kept");
            number(ui, &self.digits.to_string());
            slider
        });
        let slider = slider.inner;
        ui.horizontal(|ui| {
            for (shortening, name) in [
                (Shortening::CutOff, "Cut off, as the paper does"),
                (Shortening::Rounded, "Round"),
            ] {
                ui.selectable_value(&mut self.shortening, shortening, name);
            }
        });
        if before != (self.digits, self.shortening) {
            self.rounding = None;
            if let Some(test) = self.rounding(self.digits) {
                editor.show_shortened(&test);
            }
            if !slider.dragged() {
                editor.commit_preview();
            }
        }
        if slider.drag_stopped() {
            editor.commit_preview();
        }
    }

    fn circles_ui(&mut self, ui: &mut Ui, degree: usize) -> Option<PaperPage> {
        text(
            ui,
            "A B-spline of degree n on n + 1 corners of a regular polygon of radius 10 (6 corners up to \
             degree 3, 12 beyond), and a Bézier curve between the same end points with n equal legs and \
             equal turning angles. Both polygons are as regular as can be; how round are the curves? \
             The figures are the largest distance of the evolute from the centre.",
        );
        let mut asked = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let headings = ["Degree", "Bézier", "B-spline"].map(str::to_owned);
            columns_ui(ui, [(headings, Type::Caption)], Sense::hover(), false);
            for row in DEGREES {
                if self.row_ui(ui, row, row == degree).clicked() {
                    asked = Some(PaperPage::Circles { degree: row });
                }
            }
        });
        text(
            ui,
            "Each degree makes the B-spline rounder, from degree 3 on about ten times on average, and the \
             Bézier curve hardly at all.",
        );
        note(
            ui,
            "The printed B-spline figures agree to their last digit but for degree 9, which is 2e-10 too \
             large. The printed Bézier figures are 0.002 to 0.26 % too small, as if their polygons had \
             been rounded to five or six digits. Ours agree with a computation in 60 digits.",
        );
        asked
    }

    /// A row of the table of circles, with what the paper prints of it below. All of it can be clicked.
    fn row_ui(&mut self, ui: &mut Ui, degree: usize, shown: bool) -> Response {
        let circle = self.circle(degree);
        let figures = [
            degree.to_string(),
            scientific(circle.map(|row| row.bezier)),
            scientific(circle.map(|row| row.bspline)),
        ];
        let mut label = format!(
            "Degree {degree}: Bézier {}, B-spline {}",
            figures[1], figures[2]
        );
        let printed = PRINTED.iter().find(|(of, ..)| *of == degree);
        let printed = printed.map(|(_, bezier, bspline)| {
            label += &format!("; printed {bezier}, {bspline}");
            let texts = ["printed", bezier, bspline].map(str::to_owned);
            (texts, Type::Caption)
        });
        let lines = [(figures, Type::Number)].into_iter().chain(printed);
        let response = columns_ui(ui, lines, Sense::click(), shown);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, shown, label.clone()));
        response.on_hover_text("Open the curves of this degree")
    }

    fn spiral_ui(&mut self, ui: &mut Ui, vertices: usize) -> Option<PaperPage> {
        text(
            ui,
            "The paper approximates the conical spiral x = 2 + s sin s, y = 2 + s cos s, z = s by a curve of \
             degree 8: the vertices of its float S-polygon are 20 points of the spiral, one unit of s \
             apart. That keeps the shape but not the place: the curve is smaller than the polygon's turns.",
        );
        text(
            ui,
            "Vertices by quasi-interpolation, from the derivatives of the spiral at the same parameters, \
             keep both.",
        );
        let mut asked = None;
        ui.horizontal(|ui| {
            for (count, name) in SPIRALS {
                let button = Button::selectable(count == vertices, name);
                if ui.add(button).clicked() {
                    asked = Some(PaperPage::Spiral { vertices: count });
                }
            }
        });
        let far = self.spirals.entry(vertices);
        let far = far.or_insert_with(|| spiral_deviations(vertices).ok());
        widgets::caption(ui, "Largest distance from the spiral");
        figure(
            ui,
            "Vertices on the spiral",
            &far.map_or("–".to_owned(), |far| short(far[0])),
        );
        figure(
            ui,
            "Quasi-interpolation",
            &far.map_or("–".to_owned(), |far| short(far[1])),
        );
        text(
            ui,
            "The plots below show the active curve and the spiral. Look at the levels: the same maxima, minima \
             and inflections in the same order mean an equal shape.",
        );
        note(
            ui,
            "The paper says that curvature and torsion agree up to the second level. With steps of 1 the \
             curvature does; level 2 of the torsion has one more maximum and minimum, in both \
             ways. With steps of ½ all of level 2 agrees. The paper gives no distance. The inspector tells a little \
             more: it measures to the part of the spiral that is drawn, whose end the curve just passes.",
        );
        asked
    }

    fn circle(&mut self, degree: usize) -> Option<CircleComparison> {
        if self.circles.is_empty() {
            let row = |degree| CircleComparison::new(degree, paper_sides(degree), PAPER_RADIUS);
            self.circles = DEGREES.map(row).collect();
        }
        let row = self.circles.get(degree.checked_sub(*DEGREES.start())?)?;
        row.as_ref().ok().copied()
    }

    fn rounding(&mut self, digits: usize) -> Option<RoundingTest> {
        let shortening = self.shortening;
        let test = self
            .rounding
            .get_or_insert_with(|| RoundingTest::new(digits, shortening));
        test.clone().ok()
    }
}

/// How a line of a table is written.
#[derive(Clone, Copy)]
enum Type {
    Number,
    Caption,
}

/// Lines of three columns that are one row: it is marked if it is chosen, or hovered where it can be clicked.
fn columns_ui(
    ui: &mut Ui,
    lines: impl IntoIterator<Item = ([String; 3], Type)>,
    sense: Sense,
    chosen: bool,
) -> Response {
    let lines: Vec<_> = lines.into_iter().collect();
    let size = vec2(ui.available_width(), LINE * lines.len() as f32);
    let (rect, response) = ui.allocate_exact_size(size, sense);
    let tokens = Tokens::of(ui);
    let is_hot = sense.senses_click() && (response.hovered() || response.has_focus());
    if chosen || is_hot {
        let fill = if chosen {
            tokens.selection
        } else {
            tokens.button[1]
        };
        ui.painter().rect_filled(rect, theme::RADIUS, fill);
    }
    for (line, (texts, written)) in lines.iter().enumerate() {
        let (font, colour) = match written {
            Type::Number => (theme::number_font(), tokens.text),
            Type::Caption => (theme::small_font(), tokens.faint_text),
        };
        for (column, text) in texts.iter().enumerate() {
            let x = theme::STEP + COLUMN * column as f32;
            let at = rect.left_top() + vec2(x, LINE * (line as f32 + 0.5));
            let align = Align2::LEFT_CENTER;
            ui.painter().text(at, align, text, font.clone(), colour);
        }
    }
    response
}

fn steps_ui(ui: &mut Ui) {
    text(
        ui,
        "The ends of a curve given by its float S-polygon lie where the polygon puts them. The paper \
         brings them to given points and directions in seven steps; this curve has a target at either \
         end, and the panel on the right has a button for each step.",
    );
    for step in [
        "1. Draw a float S-polygon of the right shape.",
        "2. Look at the ends in the closed S-polygon.",
        "3. Read the differences: a vector for the point, an angle for the direction.",
        "4. Go back to the float S-polygon.",
        "5. Move the n vertices at the end by that vector.",
        "6. Turn the same vertices about the end point by that angle.",
        "7. Edit until the polygon is harmonious, and repeat.",
    ] {
        text(ui, step);
    }
    note(
        ui,
        "The n vertices at an end fix its point and the first n − 1 derivatives, so steps 5 and 6 move \
         the end as a rigid body. With 2n vertices or more the ends do not share any, and one pass is \
         exact. With fewer the passes only approach it, and with n + 1 they do not. The button Both \
         ends at once solves for both ends together, for every polygon.",
    );
}

fn typical_ui(ui: &mut Ui) {
    text(
        ui,
        "A Mineur–Farin polygon turns by the same angle at every vertex, and its legs grow by the same \
         ratio. Here the angle is 90° and the ratio 2. The same five points \
         are the Bézier polygon of one curve and the float S-polygon of the other. The faint lines beyond \
         belong to the float S-polygon of the Bézier curve, which is far larger.",
    );
    text(
        ui,
        "The plot below shows the curvature of both. The Bézier curve has a maximum at t = 0.2. The \
         curvature of the B-spline only falls, to half along its one segment: κ(u + 1) = κ(u)/2.",
    );
    note(
        ui,
        "A Bézier curve on such a polygon is monotone exactly if s cos θ ≥ 1 or s ≤ cos θ, s the ratio and \
         θ the angle. A B-spline is far more often, not always: with s = 2 and 90° not at degree 3. So \
         Batten proves it for each curve: choose one in the list and see the chip at the top right.",
    );
    note(
        ui,
        "The paper speaks of five points and the fifth degree. Five points make degree 4, and six points \
         of degree 5 show the same.",
    );
}

fn composite_ui(ui: &mut Ui) {
    text(
        ui,
        "CAD systems join curves up to G⁴ at most. Float S-polygons of one degree are joined by additional \
         vertices that continue the polygon: the result is a single B-spline of degree n, so all its \
         derivatives up to order n − 1 are continuous over the joint.",
    );
    text(
        ui,
        "Here a clothoid and a logarithmic spiral, both log-aesthetic and of degree 5, are joined by five \
         vertices. The spiral was moved, as a rigid body, to where the polygon is most harmonious. Nothing \
         else of the two parts has changed, but where the bridge reaches.",
    );
    text(
        ui,
        "Hide the composite curve to see the two parts. Look at the curvature plot: it falls all along, \
         which is proved, first along the straight line of the clothoid, then along the spiral, and has no \
         corner in between. The Harmony plot shows the legs, \
         angles and discrete curvature of all vertices, those of the bridge included.",
    );
    note(
        ui,
        "To join curves of your own, make one active, select a vertex of the other with Shift, and choose \
         Join curves in the Curve menu. Close curve joins the two ends of one curve.",
    );
}

/// The distance of the active curve's evolute from the origin.
fn reach(editor: &Editor) -> Option<f64> {
    let curve = editor.document().curve(editor.active()?)?;
    Some(evolute_reach(&curve.polygon)).filter(|reach| reach.is_finite())
}

/// A number as the paper prints them.
fn scientific(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.5e}"))
}

/// A distance as the paper prints them where it is small, plainly otherwise.
fn distance(value: f64) -> String {
    if value < 0.1 {
        scientific(Some(value))
    } else {
        short(value)
    }
}

fn short(value: f64) -> String {
    figures::significant(value, 6)
}

fn text(ui: &mut Ui, text: &str) {
    ui.add(Label::new(text).wrap());
}

fn note(ui: &mut Ui, text: &str) {
    widgets::note(ui, text);
}

fn figure(ui: &mut Ui, name: &str, value: &str) {
    widgets::figure_row(ui, name, value);
}

fn number(ui: &mut Ui, value: &str) {
    let colour = Tokens::of(ui).text;
    ui.label(
        RichText::new(value)
            .font(theme::number_font())
            .color(colour),
    );
}
