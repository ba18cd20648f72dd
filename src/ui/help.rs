//! The help window: the pages of the manual with links and a search field, and the page that belongs to each
//! panel, operation and menu.

use eframe::egui::{
    Align, Context, CursorIcon, Id, InputState, Key, LayerId, Modifiers, Order, Pos2, Rect,
    RichText, ScrollArea, TextEdit, Ui, Window, vec2,
};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};

use super::manual::{self, Page};
use super::theme::{STEP, Tokens};
use super::widgets;
use crate::operations::Operation;

/// The width of the list of pages.
const LIST: f32 = 168.0;

/// The size of the window at first, and the least.
const SIZES: [[f32; 2]; 2] = [[860.0, 600.0], [520.0, 320.0]];

/// Name a part of the window that has a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topic {
    /// An open menu, by its title.
    Menu(&'static str),
    /// An operation, in a menu or at hand.
    Operation(&'static Operation),
    /// The side panel, unless a part of it has its own topic.
    Curves,
    /// The inspector of a curve.
    Inspector,
    /// The inspector of a reference.
    Reference,
    /// The inspector of a picture.
    Picture,
    /// The list of features.
    Features,
    /// The table of vertices.
    Vertices,
    /// The panel of the end-fit tool.
    EndFit,
    /// The panel of a tool that rotates or scales, and the tool rail.
    Tools,
    /// The strip of layers.
    Layers,
    /// The plots of curvature and torsion.
    Plots,
    /// The plot of harmony.
    Harmony,
    /// The status bar.
    StatusBar,
    /// The tour of the paper.
    Paper,
    /// The import panel.
    Import,
    /// The export panel.
    Export,
}

impl Topic {
    /// Return the link to the topic's section.
    fn link(self) -> String {
        let link = match self {
            Self::Operation(operation) => {
                return format!("operations.md#{}", manual::slug(operation.label));
            }
            Self::Menu("File") => "files.md",
            Self::Menu("Curve") => "operations.md",
            Self::Menu("View") => "curves.md#views",
            Self::Menu("Tools") | Self::Tools => "curves.md#tools",
            Self::Menu("Help") => "start.md",
            Self::Menu(_) | Self::Curves | Self::Inspector => "curves.md",
            Self::Reference => "references.md",
            Self::Picture => "pictures.md",
            Self::Features => "proofs.md#features",
            Self::Vertices | Self::StatusBar => "curves.md#numbers-and-units",
            Self::EndFit => "ends.md",
            Self::Layers => "curves.md#layers",
            Self::Plots => "plots.md",
            Self::Harmony => "harmony.md",
            Self::Paper => "start.md#try-the-examples",
            Self::Import => "files.md#import",
            Self::Export => "files.md#export",
        };
        link.to_owned()
    }
}

/// The places of topics in a frame, with the layer of each.
type Places = Vec<(LayerId, Rect, Topic)>;

fn places_id() -> Id {
    Id::unique("help topics")
}

/// Tell which topic a place of the window belongs to. Of several the smallest counts.
pub fn mark(ui: &Ui, rect: Rect, topic: Topic) {
    let place = (ui.layer_id(), rect, topic);
    ui.data_mut(|data| {
        let places: &mut Places = data.get_temp_mut_or_default(places_id());
        places.push(place);
    });
}

/// Take F1, if there is a topic under the pointer or around the widget that has the keyboard, or a menu is open.
/// Forgets the places of the last frame.
pub fn take_key(context: &Context) -> Option<Topic> {
    let places: Places = context.data_mut(|data| data.remove_temp(places_id()))?;
    if !context.input(|input| input.key_pressed(Key::F1) && input.modifiers.is_none()) {
        return None;
    }
    // A page would hide a drag, which goes on under it.
    if context.input(|input| input.pointer.any_down()) {
        return None;
    }
    let pointer = context.input(|input| input.pointer.latest_pos());
    let pointer = pointer.and_then(|at| Some((context.layer_id_at(at)?, at)));
    let focused = context.memory(|memory| memory.focused());
    let focused = focused.and_then(|id| context.read_response(id));
    let focused = focused.map(|response| (response.layer_id, response.rect.center()));
    let under = |(layer, at): (LayerId, Pos2)| {
        let all = places.iter();
        let around = all.filter(|(of, rect, _)| *of == layer && rect.contains(at));
        around.min_by(|(_, a, _), (_, b, _)| a.area().total_cmp(&b.area()))
    };
    let open = || {
        let mut menus = places.iter().rev();
        menus.find(|(layer, _, topic)| {
            layer.order == Order::Foreground && matches!(topic, Topic::Menu(_))
        })
    };
    let found = pointer.and_then(under).or(focused.and_then(under));
    let (.., topic) = found.or_else(open)?;
    context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::F1));
    Some(*topic)
}

/// The help window's own state.
#[derive(Default)]
pub struct Help {
    is_open: bool,
    pages: Vec<Page>,
    page: usize,
    /// The section to scroll to in the next frame.
    section: Option<String>,
    /// Whether the page was changed, so that it begins at its top.
    is_new: bool,
    search: String,
    cache: CommonMarkCache,
}

impl Help {
    /// Open the manual at its first page, or where it was last.
    pub fn open(&mut self) {
        self.is_open = true;
        if self.pages.is_empty() {
            self.pages = manual::pages();
            let sections = self.pages.iter().flat_map(|page| &page.sections);
            let links = sections.flat_map(|section| manual::links(&section.text));
            links.for_each(|link| self.cache.add_link_hook(link));
        }
    }

    /// Open the page of a topic.
    pub fn open_topic(&mut self, topic: Topic) {
        self.open();
        self.follow(&topic.link());
    }

    /// Close the window at Esc, if it is open: it lies on top of all else. A drag goes on under it.
    pub fn take_escape(&mut self, context: &Context) {
        if self.is_open && !context.input(|input| input.pointer.any_down()) {
            let escape = |input: &mut InputState| input.consume_key(Modifiers::NONE, Key::Escape);
            self.is_open = !context.input_mut(escape);
        }
    }

    /// Show the window, if it is open.
    pub fn show(&mut self, context: &Context) {
        let mut is_open = self.is_open;
        Window::new("Manual")
            .id(Id::unique("manual"))
            .open(&mut is_open)
            .collapsible(false)
            .default_size(SIZES[0])
            .min_size(SIZES[1])
            .show(context, |ui| self.contents_ui(ui));
        self.is_open = is_open;
    }

    fn contents_ui(&mut self, ui: &mut Ui) {
        let field = TextEdit::singleline(&mut self.search).hint_text("Search the manual");
        let field = ui.add(field.desired_width(f32::INFINITY));
        field.accessible_name("Search the manual");
        ui.add_space(STEP);
        let height = ui.available_height();
        ui.horizontal_top(|ui| {
            ui.allocate_ui(vec2(LIST, height), |ui| {
                ui.vertical(|ui| self.list_ui(ui));
            });
            ui.separator();
            ui.vertical(|ui| match self.search.trim().is_empty() {
                true => self.page_ui(ui),
                false => self.found_ui(ui),
            });
        });
    }

    fn list_ui(&mut self, ui: &mut Ui) {
        ui.set_width(LIST);
        let mut chosen = None;
        for (place, page) in self.pages.iter().enumerate() {
            let is_shown = place == self.page && self.search.trim().is_empty();
            if ui.selectable_label(is_shown, page.title()).clicked() {
                chosen = Some(page.file);
            }
        }
        if let Some(file) = chosen {
            self.follow(file);
        }
    }

    fn page_ui(&mut self, ui: &mut Ui) {
        let Some(page) = self.pages.get(self.page) else {
            return;
        };
        let mut area = ScrollArea::vertical().id_salt("page").auto_shrink(false);
        if std::mem::take(&mut self.is_new) && self.section.is_none() {
            area = area.vertical_scroll_offset(0.0);
        }
        let wanted = self.section.take();
        area.show(ui, |ui| {
            for section in &page.sections {
                let shown = ui.push_id(&section.slug, |ui| {
                    CommonMarkViewer::new().show(ui, &mut self.cache, &section.text);
                });
                if wanted.as_ref() == Some(&section.slug) {
                    shown.response.scroll_to_me(Some(Align::Min));
                }
                ui.add_space(2.0 * STEP);
            }
        });
        let mut hooks = self.cache.link_hooks().iter();
        let followed = hooks.find(|(_, is_clicked)| **is_clicked);
        if let Some(link) = followed.map(|(link, _)| link.clone()) {
            self.follow(&link);
        }
    }

    fn found_ui(&mut self, ui: &mut Ui) {
        let found = manual::search(&self.pages, &self.search);
        if found.is_empty() {
            widgets::note(ui, "No section has all these words.");
        }
        let mut link = None;
        let tokens = Tokens::of(ui);
        ScrollArea::vertical()
            .id_salt("found")
            .auto_shrink(false)
            .show(ui, |ui| {
                for (page, section) in found {
                    let page = &self.pages[page];
                    let section = &page.sections[section];
                    let row = ui.horizontal(|ui| {
                        let title = ui.link(section.title);
                        ui.label(RichText::new(page.title()).color(tokens.faint_text));
                        title
                    });
                    let row = row.inner.on_hover_cursor(CursorIcon::PointingHand);
                    if row.clicked() {
                        link = Some(format!("{}#{}", page.file, section.slug));
                    }
                }
            });
        if let Some(link) = link {
            self.follow(&link);
        }
    }

    /// Go to the section of a link.
    fn follow(&mut self, link: &str) {
        let (file, slug) = link.split_once('#').unwrap_or((link, ""));
        if let Some(place) = self.pages.iter().position(|page| page.file == file) {
            self.page = place;
            self.is_new = true;
            self.section = (!slug.is_empty()).then(|| slug.to_owned());
            self.search.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operations;

    #[test]
    fn every_topic_has_a_section() {
        let menus = ["File", "Edit", "Curve", "View", "Tools", "Help"].map(Topic::Menu);
        let operations = operations::ALL.iter().copied().map(Topic::Operation);
        let panels = [
            Topic::Curves,
            Topic::Inspector,
            Topic::Reference,
            Topic::Picture,
            Topic::Features,
            Topic::Vertices,
            Topic::EndFit,
            Topic::Tools,
            Topic::Layers,
            Topic::Plots,
            Topic::Harmony,
            Topic::StatusBar,
            Topic::Paper,
        ];
        let pages = manual::pages();
        for topic in menus.into_iter().chain(operations).chain(panels) {
            let link = topic.link();
            let (file, slug) = link.split_once('#').unwrap_or((&link, ""));
            let page = pages.iter().find(|page| page.file == file).expect(file);
            let has = page.sections.iter().any(|section| section.slug == slug);
            assert!(slug.is_empty() || has, "{link}");
        }
    }
}
