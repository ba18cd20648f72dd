//! The panel of the tour: the text and the figures of a page, beside the document that it opened.

use eframe::egui::{
    Align2, Button, Frame, Label, Margin, Panel, Response, RichText, Role, Sense, Slider, Ui,
    WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::help::{self, Topic};
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::editor::Editor;
use crate::geometry::paper::Shortening;
use crate::paper::{Block, Figures, PaperPage, has_shortened, show_shortened};

/// The width of the panel at first, and the least.
const WIDTH: [f32; 2] = [340.0, 280.0];

/// The width of a column of the table of circles.
const COLUMN: f32 = 92.0;

/// The height of a line of that table.
const LINE: f32 = 5.0 * STEP;

/// The panel's own state.
#[derive(Default)]
pub struct PaperPanel {
    page: Option<PaperPage>,
    figures: Figures,
}

impl PaperPanel {
    /// Show a page whose document is open.
    pub fn open(&mut self, page: PaperPage) {
        self.page = Some(page);
        self.figures.reset();
    }

    /// Return the page on show, or the first.
    pub fn page(&self) -> PaperPage {
        self.page.unwrap_or(PaperPage::ALL[0])
    }

    /// Show the panel, if a page is open. Returns the page that the user wants to open.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) -> Option<PaperPage> {
        let page = self.page?;
        let frame = Frame::NONE
            .fill(Tokens::of(ui).panel)
            .inner_margin(Margin::symmetric(12, 8));
        let panel = Panel::left("paper").frame(frame).resizable(true);
        let panel = panel.default_size(WIDTH[0]).size_range(WIDTH[1]..=520.0);
        let request = panel.show(ui, |ui| {
            widgets::filling(ui, |ui| {
                help::mark(ui, ui.max_rect(), Topic::Paper);
                let request = heading_ui(ui, page);
                // The buttons stand at the bottom of every page, however long its text is.
                let foot = Panel::bottom("turning").frame(Frame::NONE).resizable(false);
                let turned = foot.exact_size(ROW + 2.0 * STEP).show(ui, |ui| {
                    ui.add_space(2.0 * STEP);
                    turning_ui(ui, page)
                });
                let opened = widgets::scrolling(ui, page.title(), |ui| {
                    ui.spacing_mut().item_spacing.y = 2.0 * STEP;
                    self.page_ui(ui, editor, page)
                });
                request.or(opened.or(turned.inner).map(Some))
            })
        });
        let opened = request.inner?;
        if opened.is_none() {
            self.page = None;
        }
        opened
    }

    fn page_ui(&mut self, ui: &mut Ui, editor: &mut Editor, page: PaperPage) -> Option<PaperPage> {
        let mut opened = None;
        for block in page.blocks() {
            match block {
                Block::Text(text) => drop(ui.add(Label::new(text).wrap())),
                Block::Note(text) => drop(widgets::note(ui, text)),
                Block::Figures => opened = self.figures_ui(ui, editor, page),
            }
        }
        opened
    }

    fn figures_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        page: PaperPage,
    ) -> Option<PaperPage> {
        let mut opened = None;
        match page {
            PaperPage::Rounding => {
                let available = has_shortened(editor);
                ui.add_enabled_ui(available, |ui| self.digits_ui(ui, editor));
                if !available {
                    widgets::note(ui, "The curve of this test was changed: reopen its curves.");
                }
            }
            PaperPage::Circles { degree } => opened = self.circles_ui(ui, degree),
            PaperPage::Spiral { vertices } => {
                ui.horizontal(|ui| {
                    for (count, name) in Figures::SPIRALS {
                        let button = Button::selectable(count == vertices, name);
                        if ui.add(button).clicked() {
                            opened = Some(PaperPage::Spiral { vertices: count });
                        }
                    }
                });
                widgets::caption(ui, "Largest distance from the spiral");
            }
            _ => {}
        }
        for (name, value) in self.figures.rows(page, editor) {
            widgets::figure_row(ui, name, &value);
        }
        opened
    }

    fn digits_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let figures = &mut self.figures;
        let before = (figures.digits, figures.shortening);
        let slider = widgets::form_row(ui, "Digits kept", |ui| {
            let slider = Slider::new(&mut figures.digits, Figures::DIGITS).show_value(false);
            let slider = ui.add(slider).accessible_name("Digits kept");
            let text = RichText::new(figures.digits.to_string());
            ui.label(text.font(theme::number_font()).color(Tokens::of(ui).text));
            slider
        });
        let slider = slider.inner;
        ui.horizontal(|ui| {
            let shortening = &mut figures.shortening;
            let cut_off = ui.selectable_value(shortening, Shortening::CutOff, "Cut off");
            cut_off.on_hover_text("As the paper does");
            ui.selectable_value(shortening, Shortening::Rounded, "Round");
        });
        let changed = before != (figures.digits, figures.shortening);
        if changed && let Some(test) = figures.rounding() {
            show_shortened(editor, test);
        }
        if slider.drag_stopped() || (changed && !slider.dragged()) {
            editor.commit_preview();
        }
    }

    fn circles_ui(&mut self, ui: &mut Ui, degree: usize) -> Option<PaperPage> {
        let mut opened = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let headings = ["Degree", "Bézier", "B-spline"].map(str::to_owned);
            columns_ui(ui, &[(headings, true)], Sense::hover(), false);
            for row in Figures::DEGREES {
                if self.row_ui(ui, row, row == degree).clicked() {
                    opened = Some(PaperPage::Circles { degree: row });
                }
            }
        });
        opened
    }

    /// Show a row of the table of circles, with the paper's figures below. All of it can be clicked.
    fn row_ui(&mut self, ui: &mut Ui, degree: usize, shown: bool) -> Response {
        let figures = self.figures.circle(degree);
        let [_, bezier, bspline] = &figures;
        let mut label = format!("Degree {degree}: Bézier {bezier}, B-spline {bspline}");
        let printed = self.figures.printed_circle(degree);
        if let Some([_, bezier, bspline]) = &printed {
            label += &format!("; printed {bezier}, {bspline}");
        }
        let mut lines = vec![(figures, false)];
        lines.extend(printed.map(|texts| (texts, true)));
        let response = columns_ui(ui, &lines, Sense::click(), shown);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, shown, &label));
        response.on_hover_text("Open the curves of this degree")
    }
}

/// Show lines of three columns as one row, marked if it is chosen or a hovered button: numbers, or captions in
/// smaller type.
fn columns_ui(ui: &mut Ui, lines: &[([String; 3], bool)], sense: Sense, chosen: bool) -> Response {
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
    for (line, (texts, is_caption)) in lines.iter().enumerate() {
        let (font, colour) = match is_caption {
            true => (theme::small_font(), tokens.faint_text),
            false => (theme::number_font(), tokens.text),
        };
        for (column, text) in texts.iter().enumerate() {
            let x = STEP + COLUMN * column as f32;
            let at = rect.left_top() + vec2(x, LINE * (line as f32 + 0.5));
            let align = Align2::LEFT_CENTER;
            ui.painter().text(at, align, text, font.clone(), colour);
        }
    }
    response
}

/// Show the title and the list of pages; returns the page to open, or that the panel is to close.
fn heading_ui(ui: &mut Ui, page: PaperPage) -> Option<Option<PaperPage>> {
    let mut request = None;
    ui.horizontal(|ui| {
        ui.strong("The paper");
        widgets::at_right(ui, |ui| {
            let close = IconButton::new(Icon::X, "Close the paper");
            if close.show(ui).clicked() {
                request = Some(None);
            }
        });
    });
    let titles = PaperPage::ALL.iter().map(|page| page.title().to_owned());
    let (width, place) = (ui.available_width(), page.place());
    let titles = titles.enumerate();
    let (other, _) = widgets::drop_down(ui, "Page of the paper", width, &place, titles);
    let opened = other.map(|place| PaperPage::ALL.get(place).copied());
    ui.add_space(STEP);
    opened.or(request)
}

/// Show buttons to the pages before and after, and one that opens this page again.
fn turning_ui(ui: &mut Ui, page: PaperPage) -> Option<PaperPage> {
    let mut request = None;
    ui.horizontal(|ui| {
        let place = page.place();
        let mut button = |ui: &mut Ui, name: &str, to: Option<PaperPage>| {
            let response = ui.add_enabled(to.is_some(), Button::new(name));
            if response.clicked() {
                request = to;
            }
        };
        let before = place.checked_sub(1);
        let before = before.and_then(|place| PaperPage::ALL.get(place).copied());
        button(ui, "Previous", before);
        button(ui, "Next", PaperPage::ALL.get(place + 1).copied());
        widgets::at_right(ui, |ui| button(ui, "Reopen its curves", Some(page)));
    });
    request
}
