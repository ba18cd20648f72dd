//! The paper's pages: what its figures and its table show, beside the document that they open.

use eframe::egui::{Button, ComboBox, Panel, Ui};
use lucide_icons::Icon;

use super::paper_pages::PaperPages;
use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::editor::{Editor, PaperPage};

/// The width of the panel at first, and the least.
const WIDTH: [f32; 2] = [340.0, 280.0];

/// The panel's own state.
#[derive(Default)]
pub struct PaperPanel {
    page: Option<PaperPage>,
    pages: PaperPages,
}

/// What the user asks for.
enum Asked {
    Open(PaperPage),
    Close,
}

impl PaperPanel {
    /// Show a page: its document is open.
    pub fn open(&mut self, page: PaperPage) {
        self.page = Some(page);
        self.pages.begin();
    }

    /// The page that is shown, or the first.
    pub fn page(&self) -> PaperPage {
        self.page.unwrap_or(PaperPage::ALL[0])
    }

    /// Show the panel, if a page is open. Returns the page whose document is asked for.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) -> Option<PaperPage> {
        let page = self.page?;
        let tokens = Tokens::of(ui);
        let frame = eframe::egui::Frame::NONE
            .fill(tokens.panel)
            .inner_margin(eframe::egui::Margin::symmetric(12, 8));
        let panel = Panel::left("paper").frame(frame).resizable(true);
        let panel = panel.default_size(WIDTH[0]).size_range(WIDTH[1]..=520.0);
        let asked = panel.show(ui, |ui| {
            widgets::filling(ui, |ui| {
                let asked = heading_ui(ui, page);
                let opened = widgets::scrolling(ui, page.title(), |ui| {
                    ui.spacing_mut().item_spacing.y = 2.0 * STEP;
                    let opened = self.pages.show(ui, editor, page);
                    ui.add_space(2.0 * STEP);
                    opened.or(turning_ui(ui, page))
                });
                asked.or(opened.map(Asked::Open))
            })
        });
        match asked.inner? {
            Asked::Open(page) => Some(page),
            Asked::Close => {
                self.page = None;
                None
            }
        }
    }
}

fn heading_ui(ui: &mut Ui, page: PaperPage) -> Option<Asked> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.strong("The paper");
        widgets::at_right(ui, |ui| {
            if IconButton::new(Icon::X, "Close the paper")
                .show(ui)
                .clicked()
            {
                asked = Some(Asked::Close);
            }
        });
    });
    let width = ui.available_width();
    let choice = ComboBox::from_id_salt("paper page")
        .selected_text(page.title())
        .width(width)
        .show_ui(ui, |ui| {
            for other in PaperPage::ALL {
                let chosen = other.place() == page.place();
                if ui.selectable_label(chosen, other.title()).clicked() && !chosen {
                    asked = Some(Asked::Open(other));
                }
            }
        });
    choice.response.accessible_name("Page of the paper");
    ui.add_space(STEP);
    asked
}

/// Buttons to the pages before and after, and one that opens this page's document again.
fn turning_ui(ui: &mut Ui, page: PaperPage) -> Option<PaperPage> {
    let mut asked = None;
    ui.horizontal(|ui| {
        let place = page.place();
        let mut button = |ui: &mut Ui, name: &str, to: Option<PaperPage>| {
            let response = ui.add_enabled(to.is_some(), Button::new(name));
            if response.clicked() {
                asked = to;
            }
        };
        let before = place.checked_sub(1);
        let before = before.and_then(|place| PaperPage::ALL.get(place).copied());
        button(ui, "Previous", before);
        button(ui, "Next", PaperPage::ALL.get(place + 1).copied());
        widgets::at_right(ui, |ui| button(ui, "Reopen its curves", Some(page)));
    });
    asked
}
