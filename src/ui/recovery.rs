//! What earlier sessions have left unsaved: a list with small pictures.

use std::time::SystemTime;

use eframe::egui::{
    Align, Button, Context, Id, Label, Layout, Pos2, Rect, RichText, ScrollArea, Sense, Shape,
    Stroke, Ui, Vec2, vec2,
};
use glam::DVec2;

use super::theme::{RADIUS, STEP, Tokens};
use super::widgets;
use crate::editor::{Recoverable, RecoverableDocument};
use crate::geometry::counted;

/// The size of a picture.
const PICTURE: Vec2 = vec2(104.0, 64.0);

/// The width of the list.
const WIDTH: f32 = 460.0;

/// The width of the button that discards a document.
const DISCARD: f32 = 96.0;

/// The height from which on the list scrolls.
const HEIGHT: f32 = 320.0;

/// The user's choice among recovered documents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Open it.
    Open(usize),
    /// Give it up.
    Discard(usize),
    /// Leave all of it for the next start.
    Later,
}

/// Show the recovered documents, if there are any, until each is opened, discarded or left; returns the user's choice.
pub fn recovery_ui(context: &Context, all: &[Recoverable]) -> Option<Choice> {
    if all.is_empty() {
        return None;
    }
    widgets::modal(context, "recovered documents", Choice::Later, |ui| {
        ui.set_width(WIDTH);
        ui.strong("Recovered documents");
        widgets::note(ui, "Batten closed before these documents were saved.");
        let area = ScrollArea::vertical().max_height(HEIGHT);
        let chosen = area.show(ui, |ui| {
            let rows = all.iter().map(|recoverable| row_ui(ui, recoverable));
            // Every row is shown, whatever is chosen in one of them.
            rows.collect::<Vec<_>>().into_iter().flatten().next()
        });
        let mut later = None;
        ui.horizontal(|ui| {
            widgets::at_right(ui, |ui| {
                let help = "Offer them again at the next start (Esc)";
                let button = ui.button("Later").on_hover_text(help);
                later = button.clicked().then_some(Choice::Later);
                folder_ui(ui, all);
            });
        });
        chosen.inner.or(later)
    })
}

/// Where the documents are kept, in the room that is left.
fn folder_ui(ui: &mut Ui, all: &[Recoverable]) {
    let Some(folder) = all.first().map(Recoverable::folder) else {
        return;
    };
    let text = format!("In {}", folder.display());
    let text = RichText::new(text).color(Tokens::of(ui).faint_text);
    let room = ui.available_size();
    ui.allocate_ui_with_layout(room, Layout::left_to_right(Align::Center), |ui| {
        ui.add(Label::new(text).truncate());
    });
}

fn row_ui(ui: &mut Ui, recoverable: &Recoverable) -> Option<Choice> {
    let tokens = Tokens::of(ui);
    let mut choice = None;
    ui.horizontal(|ui| {
        let picture = recoverable.content.as_ref().map(|content| &content.picture);
        picture_ui(ui, picture.map_or(&[], |picture| picture));
        widgets::at_right(ui, |ui| {
            // Each row's buttons have names of their own.
            let [title, lines] = texts(recoverable);
            if discard_ui(ui, recoverable.id, &title) {
                choice = Some(Choice::Discard(recoverable.id));
            }
            if recoverable.content.is_ok() {
                let open = widgets::primary_button(ui, "Open");
                if open.accessible_name(format!("Open {title}")).clicked() {
                    choice = Some(Choice::Open(recoverable.id));
                }
            }
            let room = vec2(ui.available_width(), PICTURE.y);
            ui.allocate_ui_with_layout(room, *ui.layout(), |ui| {
                ui.vertical(|ui| {
                    ui.spacing_mut().item_spacing.y = STEP;
                    ui.add(Label::new(RichText::new(title).color(tokens.strong_text)).truncate());
                    let colour = match &recoverable.content {
                        Ok(_) => tokens.faint_text,
                        Err(_) => tokens.error,
                    };
                    ui.add(Label::new(RichText::new(lines).color(colour)).wrap());
                });
            });
        });
    });
    choice
}

/// Show the button that discards a document at the second press: nothing brings it back.
fn discard_ui(ui: &mut Ui, id: usize, title: &str) -> bool {
    let asked = Id::unique("discard").with(id);
    let is_asked = ui.data(|data| data.get_temp(asked)).unwrap_or(false);
    let (verb, colour) = match is_asked {
        true => ("Really discard", Tokens::of(ui).error),
        false => ("Discard", Tokens::of(ui).text),
    };
    let text = RichText::new(verb).color(colour);
    // The buttons beside it stay where they are.
    let button = ui.add(Button::new(text).min_size(vec2(DISCARD, 0.0)));
    let button = button.accessible_name(format!("{verb} {title}"));
    let is_pressed = button.clicked();
    ui.data_mut(|data| data.insert_temp(asked, is_pressed || is_asked));
    is_pressed && is_asked
}

/// The name and the facts of a document.
fn texts(recoverable: &Recoverable) -> [String; 2] {
    match &recoverable.content {
        Ok(content) => {
            let name = content.name.as_deref().unwrap_or("Untitled").to_owned();
            [name, facts(content, SystemTime::now()).join("\n")]
        }
        Err(error) => ["Damaged document".to_owned(), error.to_string()],
    }
}

fn facts(content: &RecoverableDocument, now: SystemTime) -> Vec<String> {
    let curves = counted(content.curves, "curve", "curves");
    let vertices = counted(content.vertices, "vertex", "vertices");
    let mut facts = vec![ago(content.time, now), format!("{curves} · {vertices}")];
    if content.is_file_changed {
        facts.push("The file has changed since".to_owned());
    }
    facts
}

/// The time since a save, in words.
fn ago(time: SystemTime, now: SystemTime) -> String {
    let seconds = now.duration_since(time).unwrap_or_default().as_secs();
    let minutes = usize::try_from(seconds / 60).unwrap_or(usize::MAX);
    let (hours, days) = (minutes / 60, minutes / (60 * 24));
    let past = match (minutes, hours, days) {
        (0, ..) => return "Less than a minute ago".to_owned(),
        (minutes, 0, _) => counted(minutes, "minute", "minutes"),
        (_, hours, 0) => counted(hours, "hour", "hours"),
        (_, _, days) => counted(days, "day", "days"),
    };
    format!("{past} ago")
}

/// Draw chains of points into a small box.
fn picture_ui(ui: &mut Ui, chains: &[Vec<DVec2>]) {
    let tokens = Tokens::of(ui);
    let (rect, _) = ui.allocate_exact_size(PICTURE, Sense::hover());
    ui.painter().rect_filled(rect, RADIUS, tokens.background);
    let place = placing(rect.shrink(2.0 * STEP), chains);
    for chain in chains {
        let points: Vec<Pos2> = chain.iter().map(|point| place(*point)).collect();
        let stroke = Stroke::new(1.5, tokens.strong_text);
        ui.painter().add(Shape::line(points, stroke));
    }
}

/// Map the bounds of the chains into a box, upright and undistorted.
fn placing(rect: Rect, chains: &[Vec<DVec2>]) -> impl Fn(DVec2) -> Pos2 {
    let points = || chains.iter().flatten().copied();
    let least = points().reduce(DVec2::min).unwrap_or_default();
    let most = points().reduce(DVec2::max).unwrap_or_default();
    let centre = least.midpoint(most);
    // Points far apart would overflow: halves do not.
    let extent = most / 2.0 - least / 2.0;
    let room = DVec2::new(rect.width().into(), rect.height().into()) / 2.0;
    let scale = (room / extent).min_element();
    let scale = if scale.is_finite() { scale } else { 1.0 };
    move |point| {
        let off = (point - centre) * scale;
        rect.center() + vec2(off.x as f32, -off.y as f32)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn how_long_ago_is_told_in_the_largest_unit() {
        let now = SystemTime::UNIX_EPOCH + Duration::from_secs(1_800_000_000);
        for (seconds, expected) in [
            (0, "Less than a minute ago"),
            (59, "Less than a minute ago"),
            (60, "1 minute ago"),
            (59 * 60 + 59, "59 minutes ago"),
            (3600, "1 hour ago"),
            (86_399, "23 hours ago"),
            (86_400, "1 day ago"),
            (30 * 86_400, "30 days ago"),
        ] {
            assert_eq!(ago(now - Duration::from_secs(seconds), now), expected);
        }
        // A clock that was set back.
        assert_eq!(
            ago(now, now - Duration::from_secs(9)),
            "Less than a minute ago"
        );
    }

    #[test]
    fn a_picture_fits_its_box_whatever_it_shows() {
        let rect = Rect::from_min_size(Pos2::ZERO, PICTURE);
        let far = 1e308;
        for chain in [
            vec![DVec2::new(0.0, 0.0), DVec2::new(10.0, 1.0)],
            vec![DVec2::new(5.0, 5.0); 2],
            vec![DVec2::new(-3.0, 7.0), DVec2::new(-3.0, 7e6)],
            vec![DVec2::splat(-far), DVec2::splat(far)],
            vec![],
        ] {
            let chains = [chain];
            let place = placing(rect, &chains);
            for point in &chains[0] {
                assert!(rect.expand(1e-3).contains(place(*point)), "{point}");
            }
        }
    }
}
