//! The inspector of a picture: its file, how strongly it is drawn, the size and the plane of its frame.

use eframe::egui::{Button, Ui, vec2};
use glam::DVec3;

use super::action::Action;
use super::figures;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{ROW, STEP};
use super::widgets;
use crate::document::{CurveId, Picture, PictureSource, Reference};
use crate::editor::{
    Editor, PICTURE_PLANES, PictureChange, measured_direction, picture_plane, told,
};
use crate::geometry::parameters::Quantity;
use crate::geometry::references::{Frame, Placement};

/// The width of a field.
const FIELD: f32 = 120.0;

/// Show a picture's file and opacity, of locked ones too, then its size and plane.
pub fn picture_ui(
    ui: &mut Ui,
    editor: &mut Editor,
    (id, reference, frame): (CurveId, &Reference, &Frame),
    actions: &mut Vec<Action>,
) {
    let Some(picture) = &reference.picture else {
        return;
    };
    file_ui(ui, editor, picture, actions);
    let [width, height] = picture.pixels;
    widgets::figure_row(ui, "Pixels", &format!("{width} × {height}"));
    widgets::form_row(ui, "Opacity", |ui| {
        let percent = 100.0 * picture.opacity;
        let field = NumberField::new("opacity", percent, format!("{}%", figures::short(percent)));
        let field = field.speed(0.5).range(0.0..=100.0).width(FIELD);
        send(editor, field.show(ui), |percent| {
            PictureChange::Opacity(percent / 100.0)
        });
    });
    let may_change = reference.check_editable().is_ok();
    ui.add_enabled_ui(may_change, |ui| {
        size_ui(ui, editor, frame, reference.curve.placement());
        plane_ui(ui, editor, reference.curve.placement());
        true_size_ui(ui, editor, (id, reference.curve.placement()));
    });
}

/// Where the bytes are, with buttons that change it.
fn file_ui(ui: &mut Ui, editor: &mut Editor, picture: &Picture, actions: &mut Vec<Action>) {
    let name = match &picture.source {
        PictureSource::File(path) => path.file_name().unwrap_or_default().to_string_lossy(),
        PictureSource::Embedded(_) => "in the project".into(),
    };
    let row = widgets::fact_row(ui, "File", &name);
    if let Some(path) = picture.file() {
        row.on_hover_text(path.display().to_string());
    }
    if let Some(reason) = editor.view().picture_fault(&picture.source) {
        widgets::warning(ui, reason);
    }
    widgets::form_row(ui, "", |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        let width = 0.5 * (ui.available_width() - STEP);
        let button = |ui: &mut Ui, label: &str, help: &str, enabled| {
            let button = ui.add_enabled_ui(enabled, |ui| {
                ui.add_sized(vec2(width, ROW), Button::new(label))
            });
            button.inner.on_hover_text(help).clicked()
        };
        if button(ui, "Relink…", "Read the picture from another file", true) {
            actions.push(Action::RelinkPicture);
        }
        let is_file = picture.file().is_some();
        if button(
            ui,
            "Embed",
            "Keep the picture in the project itself",
            is_file,
        ) {
            told(PictureChange::Embed.apply(editor));
        }
    });
}

fn size_ui(ui: &mut Ui, editor: &mut Editor, frame: &Frame, placement: &Placement) {
    let size = placement.scale() * frame.size();
    for (label, value, change) in [
        (
            "Width",
            size.x,
            PictureChange::Width as fn(f64) -> PictureChange,
        ),
        ("Height", size.y, PictureChange::Height),
    ] {
        widgets::form_row(ui, label, |ui| {
            let field = length_field(label, value).range(f64::MIN_POSITIVE..=f64::MAX);
            send(editor, field.show(ui), change);
        });
    }
}

fn plane_ui(ui: &mut Ui, editor: &mut Editor, placement: &Placement) {
    widgets::form_row(ui, "Plane", |ui| {
        let now = picture_plane(placement);
        let planes = PICTURE_PLANES.map(|plane| (Some(plane), plane.name().to_owned()));
        let other = now.is_none().then(|| (None, "tilted".to_owned()));
        let all = planes.into_iter().chain(other);
        let (chosen, _) = widgets::drop_down(ui, "picture plane", FIELD, &now, all);
        if let Some(plane) = chosen.flatten() {
            told(PictureChange::Plane(plane).apply(editor));
        }
    });
}

/// Fields for the true distance and direction of two points that were measured on the picture.
fn true_size_ui(ui: &mut Ui, editor: &mut Editor, (id, placement): (CurveId, &Placement)) {
    let Some([from, to]) = editor.hand().measured_on(id, editor.document()) else {
        let text = "To scale and place it, measure two points (M): fields for them appear here.";
        widgets::note(ui, text);
        return;
    };
    let distance = DVec3::distance(from, to);
    widgets::form_row(ui, "True distance", |ui| {
        let field = length_field("true distance", distance).range(f64::MIN_POSITIVE..=f64::MAX);
        let field = field.help("Scale the picture so that the measured points lie so far apart");
        if let Some(length) = field.typed(ui) {
            told(PictureChange::TrueDistance(length).apply(editor));
        }
    });
    widgets::form_row(ui, "True direction", |ui| {
        let angle = measured_direction(placement.rotation(), [from, to]).to_degrees();
        let field = NumberField::new(
            "true direction",
            angle,
            format!("{}°", figures::short(angle)),
        );
        let field = field.quantity(Quantity::Angle).width(FIELD);
        let field =
            field.help("Turn the picture so that the measured points lie in this direction");
        if let Some(angle) = field.typed(ui) {
            told(PictureChange::TrueDirection(angle.to_radians()).apply(editor));
        }
    });
    let axes = picture_plane(placement).and_then(|plane| plane.orientation().axes());
    for axis in axes.map_or(vec![0, 1, 2], Vec::from) {
        let (name, at) = (["x", "y", "z"][axis], from[axis]);
        widgets::form_row(ui, &format!("First point {name}"), |ui| {
            let label = format!("first point {name}");
            let field = length_field(&label, at);
            let field = field.help("Move the picture so that the first measured point lies here");
            if let Some(to) = field.typed(ui) {
                told(PictureChange::FirstPoint { axis, to }.apply(editor));
            }
        });
    }
    widgets::note(
        ui,
        "A perspective is not corrected: measure in the plane that you trace.",
    );
}

fn length_field(name: &str, value: f64) -> NumberField<'_> {
    let field = NumberField::new(name, value, figures::short(value));
    let speed = (0.01 * value.abs()).max(1e-6);
    field.speed(speed).quantity(Quantity::Length).width(FIELD)
}

/// Send a field's event to the editor.
fn send(editor: &mut Editor, event: Option<FieldEvent>, change: impl FnOnce(f64) -> PictureChange) {
    if let Some(event) = event {
        event.map(change).send(
            editor,
            |editor, change| change.preview(editor),
            |editor, change| told(change.apply(editor)),
        );
    }
}
