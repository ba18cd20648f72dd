//! The table of joints in the inspector: how ends of curves meet, and the match that makes them.

use eframe::egui::{
    Align2, Button, Popup, PopupCloseBehavior, Rect, Response, Role, ScrollArea, Sense, Ui,
    UiBuilder, WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::number_field::NumberField;
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{document_unit, figures};
use crate::analysis::CurveJoint;
use crate::document::{CurveId, Document, Edit};
use crate::editor::{Editor, Look, MATCH_END, told};
use crate::geometry::Continuity;
use crate::geometry::parameters::Quantity;

/// The most joints that are seen at once.
const SEEN: usize = 6;

/// The height of a joint: its names, and its figures.
const HEIGHT: f32 = ROW + FIGURES;

/// The height of a row of figures.
const FIGURES: f32 = 5.0 * STEP;

/// The room for the name of the continuity.
const LEVEL: f32 = 8.0 * STEP;

/// The width of the field for the tolerance.
const FIELD: f32 = 96.0;

/// A button for a level in the menu of matches.
const CELL: [f32; 2] = [40.0, ROW];

/// Gaps and differences of derivatives below which rounding alone lies, by the size.
const NOISE: [f64; 2] = [1e-12, 1e-6];

/// What was done with a joint of the list.
enum Act {
    Hover(usize),
    Go(usize),
    Match(Vec<Edit>),
}

/// Show the joints of the selected items, all where none is selected, with the tolerance.
pub fn joint_list_ui(ui: &mut Ui, editor: &mut Editor) {
    tolerance_ui(ui, editor);
    let listed: Vec<usize> = editor.sight().listed_joints().map(|it| it.0).collect();
    if listed.is_empty() {
        widgets::note(ui, "No ends of visible curves meet here.");
        return;
    }
    header_ui(ui);
    let act = rows_ui(ui, editor, &listed);
    if editor.sight().joints().is_cut() {
        let count = editor.sight().joints().all().len();
        widgets::warning(ui, &format!("There are more than {count} joints"));
    }
    match act {
        None => {}
        Some(Act::Hover(index)) => editor.view_mut().hover_joint(index),
        Some(Act::Go(index)) => editor.look(Look::Joint(index)),
        Some(Act::Match(edits)) => told(editor.apply(MATCH_END, edits)),
    }
}

fn tolerance_ui(ui: &mut Ui, editor: &mut Editor) {
    widgets::form_row(ui, "Ends within", |ui| {
        let tolerance = editor.sight().joints().tolerance();
        let text = figures::significant(tolerance, 4);
        let field = NumberField::new("Joint tolerance", tolerance, text);
        let field = field.range(0.0..=f64::MAX).quantity(Quantity::Length);
        let field = field.help("Ends that are no farther apart meet; 0: a thousandth of the size");
        if let Some(typed) = field.width(FIELD).typed(ui) {
            editor.view_mut().joint_tolerance = Some(typed).filter(|typed| *typed > 0.0);
        }
    });
}

/// The columns of figures.
fn columns(row: Rect) -> [Rect; 4] {
    let width = (row.width() - LEVEL) / 4.0;
    [0.0, 1.0, 2.0, 3.0].map(|column| {
        let left = row.left() + LEVEL + column * width;
        Rect::from_x_y_ranges(left..=left + width - STEP, row.y_range())
    })
}

fn header_ui(ui: &mut Ui) {
    let size = vec2(ui.available_width() - bar(ui), FIGURES);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let faint = Tokens::of(ui).faint_text;
    for (column, name) in columns(rect)
        .into_iter()
        .zip(["Gap", "Angle", "Δκ", "Δ dκ/ds"])
    {
        widgets::text_in(
            ui,
            column,
            Align2::RIGHT_CENTER,
            name,
            theme::small_font(),
            faint,
        );
    }
}

/// The room for the bar, which is always kept.
fn bar(ui: &Ui) -> f32 {
    ui.spacing().scroll.allocated_width()
}

fn rows_ui(ui: &mut Ui, editor: &Editor, listed: &[usize]) -> Option<Act> {
    let area = ScrollArea::vertical()
        .id_salt("joints")
        .max_height(SEEN as f32 * HEIGHT)
        .min_scrolled_height(SEEN as f32 * HEIGHT)
        .auto_shrink([false, true]);
    let width = ui.available_width() - bar(ui);
    let mut act = None;
    ui.spacing_mut().item_spacing.y = 0.0;
    area.show_rows(ui, HEIGHT, listed.len(), |ui, range| {
        ui.set_max_width(width);
        for index in listed.get(range).unwrap_or_default() {
            if let Some(joint) = editor.sight().joints().all().get(*index) {
                act = joint_ui(ui, editor, *index, joint).or(act.take());
            }
        }
    });
    act
}

fn joint_ui(ui: &mut Ui, editor: &Editor, index: usize, joint: &CurveJoint) -> Option<Act> {
    let document = editor.document();
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click());
    widgets::row_background(ui, rect, &response, false);
    let tokens = Tokens::of(ui);
    let names = names(document, joint);
    let level = joint.name();
    let mut top = rect.with_max_y(rect.top() + ROW);
    let button = top.with_min_x(top.right() - ROW);
    top.max.x = button.left() - STEP;
    widgets::label_in(
        ui,
        top.with_min_x(top.left() + STEP),
        level,
        tokens.strong_text,
    );
    widgets::name_in(ui, top.with_min_x(top.left() + LEVEL), &names, tokens.text);
    figures_ui(ui, rect.with_min_y(rect.top() + ROW), joint);
    let is_matched = (0..2).any(|it| joint.match_in(document, it).is_some());
    // A child takes no room of its own: the row has it all.
    let mut inside = ui.new_child(UiBuilder::new().max_rect(button).id_salt(index));
    let name = format!("Match {names}");
    let colour = if is_matched {
        tokens.target
    } else {
        tokens.text
    };
    let link = IconButton::new(Icon::Link, &name).colour(colour);
    let link = link.tooltip("Make one curve follow the other here");
    let link = link.show(&mut inside);
    let chosen = menu_ui(&link, document, joint);
    let said = format!("Joint {level}: {names}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &said));
    let act = match (chosen, response.clicked(), response.hovered()) {
        (Some(edits), ..) => Some(Act::Match(edits)),
        (None, true, _) => Some(Act::Go(index)),
        (None, false, true) => Some(Act::Hover(index)),
        (None, false, false) => None,
    };
    response.on_hover_text(format!("{names}\nClick to go there."));
    act
}

fn figures_ui(ui: &Ui, row: Rect, joint: &CurveJoint) {
    let plain = |value: f64| match value.is_finite() {
        true => figures::significant(value, 3),
        false => "–".to_owned(),
    };
    let shown = |value: f64, noise: f64| widgets::above_noise(value, noise, plain).0;
    let (found, size) = (joint.joint, joint.size);
    let texts = [
        document_unit::length(ui.ctx(), shown(found.gap, NOISE[0] * size)),
        match found.angle <= NOISE[1] {
            true => "0°".to_owned(),
            false => figures::angle(found.angle),
        },
        shown(found.curvature, NOISE[1] / size),
        shown(found.slope, NOISE[1] / (size * size)),
    ];
    for (column, text) in columns(row).into_iter().zip(texts) {
        widgets::text_in(
            ui,
            column,
            Align2::RIGHT_CENTER,
            text,
            theme::small_font(),
            Tokens::of(ui).text,
        );
    }
}

/// Name both ends.
fn names(document: &Document, joint: &CurveJoint) -> String {
    let [one, other] = joint.ends.map(|(id, end)| (name(document, id), end.name()));
    match joint.ends[0].0 == joint.ends[1].0 {
        true => format!("{}: {} to {}", one.0, one.1, other.1),
        false => format!("{} {} – {} {}", one.0, one.1, other.0, other.1),
    }
}

fn name(document: &Document, id: CurveId) -> &str {
    document.name(id).unwrap_or_default()
}

/// The menu of the match: which of the two curves follows, and up to which level.
fn menu_ui(button: &Response, document: &Document, joint: &CurveJoint) -> Option<Vec<Edit>> {
    let popup = Popup::menu(button).close_behavior(PopupCloseBehavior::CloseOnClick);
    let shown = popup.show(|ui| {
        let mut edits = None;
        for follower in 0..2 {
            edits = follower_ui(ui, document, joint, follower).or(edits.take());
        }
        edits
    });
    shown.and_then(|shown| shown.inner)
}

fn follower_ui(
    ui: &mut Ui,
    document: &Document,
    joint: &CurveJoint,
    follower: usize,
) -> Option<Vec<Edit>> {
    let (id, end) = *joint.ends.get(follower)?;
    let refusal = refusal(document, joint, follower);
    let found = joint.match_in(document, follower);
    widgets::caption(
        ui,
        &format!("The {} of {} follows", end.name(), name(document, id)),
    );
    let mut edits = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for level in Continuity::ALL {
            let is_on = found.is_some_and(|it| it.continuity == level);
            let button = Button::selectable(is_on, level.name()).min_size(CELL.into());
            let said = format!(
                "{} of {} follows {}",
                end.name(),
                name(document, id),
                level.name()
            );
            let response = ui
                .add_enabled(refusal.is_none(), button)
                .accessible_name(&said);
            let response = response.on_disabled_hover_text(refusal.as_deref().unwrap_or_default());
            let help = format!("Match up to the {}", level.label());
            if response.on_hover_text(help).clicked() {
                edits = Some(joint.matching(document, follower, level));
            }
        }
        let remove = ui.add_enabled(found.is_some(), Button::new("Remove").min_size(CELL.into()));
        if remove
            .on_hover_text("Remove the match; the curve stays as it is")
            .clicked()
        {
            edits = Some(vec![Edit::RemoveMatch { curve: id, end }]);
        }
    });
    edits
}

/// Why a curve cannot follow the other one.
fn refusal(document: &Document, joint: &CurveJoint, follower: usize) -> Option<String> {
    let (id, _) = *joint.ends.get(follower)?;
    if joint.ends.iter().all(|(own, _)| *own == id) {
        return Some("A curve cannot follow itself: close it instead".to_owned());
    }
    match document.curve(id) {
        None => Some("A reference follows no curve".to_owned()),
        Some(curve) => curve.check_editable().err().map(|it| it.to_string()),
    }
}
