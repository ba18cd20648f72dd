//! The inspector: everything of the active curve, in numbers.

use eframe::egui::{Align2, Button, Key, TextBuffer, TextEdit, Ui, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::curvature_rows::curvature_rows;
use super::curve_item::Item;
use super::deviation_panel::deviation_ui;
use super::formula_fields::FormulaFields;
use super::harmony_list::harmony_list_ui;
use super::item_fields::{colour_ui, set_degree, state_ui};
use super::items_panel::ItemsPanel;
use super::joint_list::joint_list_ui;
use super::keyboard::{self, Typing};
use super::move_fields::MoveFields;
use super::number_field::NumberField;
use super::theme::{ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{document_unit, figures};
use super::{picture_panel, reference_panel};
use crate::document::{Curve, CurveId, Edit, Group, GuideLine, Reference};
use crate::editor::{Command, CurvatureDisplay, CurveReport, Editor, told};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;
use crate::geometry::references::ReferenceForm;
use crate::geometry::{MAX_DEGREE, significant};

/// The inspector's own state.
#[derive(Default)]
pub struct Inspector {
    /// The text that is being typed, for the curve that it belongs to and the field.
    typed: Option<(CurveId, Text, String)>,
    formulas: FormulaFields,
    several: ItemsPanel,
    movement: MoveFields,
}

/// A field of text.
#[derive(Clone, Copy, PartialEq)]
enum Text {
    Name,
    Group,
}

impl Text {
    fn label(self) -> &'static str {
        match self {
            Self::Name => "Name",
            Self::Group => "Group",
        }
    }

    /// What a tooltip says beside the text itself.
    fn help(self) -> &'static str {
        match self {
            Self::Name => "",
            Self::Group => "Path, such as Deck/Port; empty for none",
        }
    }

    /// The edit that a typed text asks for; `None` if it changes nothing.
    fn edit(self, item: &Item, text: String) -> Option<Edit> {
        let curve = item.id;
        match self {
            Self::Name if text.trim() == item.name => None,
            Self::Name => Some(Edit::Rename { curve, name: text }),
            Self::Group => {
                let group = Group::from(text.as_str());
                (group != item.group).then_some(Edit::SetGroup { curve, group })
            }
        }
    }
}

impl Inspector {
    /// Show the inspector of the active curve or reference, or of several that are selected.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, actions: &mut Vec<Action>) {
        if editor.hand().selection().has_several_items() {
            let mut items = Item::all(editor);
            items.retain(|item| item.selected);
            self.several.show(ui, editor, &items);
            document_section_ui(ui, editor, false);
            return joints_ui(ui, editor);
        }
        let Some(item) = Item::active(editor) else {
            let text = "Draw or select a curve to see its degree, properties and features.";
            widgets::note(ui, text);
            document_section_ui(ui, editor, true);
            return joints_ui(ui, editor);
        };
        let (id, document) = (item.id, editor.document());
        let (curve, reference) = (document.curve(id).cloned(), document.reference(id).cloned());
        // Each curve has fields of its own, so that no text goes to another curve.
        ui.push_id(id, |ui| {
            for (text, shown) in [
                (Text::Name, item.name.clone()),
                (Text::Group, item.group.to_string()),
            ] {
                let label = text.label();
                widgets::form_row(ui, label, |ui| {
                    self.text_ui(ui, editor, &item, (text, &shown));
                });
            }
            let own = std::slice::from_ref(&item);
            widgets::form_row(ui, "Colour", |ui| colour_ui(ui, editor, own));
            if let Some(curve) = &curve {
                ui.add_enabled_ui(curve.check_editable().is_ok(), |ui| {
                    widgets::form_row(ui, "Degree", |ui| degree_ui(ui, editor, curve));
                    widgets::form_row(ui, "Ends", |ui| ends_ui(ui, editor, curve));
                    widgets::form_row(ui, "Symmetry", |ui| symmetry_ui(ui, editor, (id, curve)));
                });
            }
            widgets::form_row(ui, "State", |ui| state_ui(ui, editor, own));
        });
        if let Some(reference) = &reference {
            self.reference_ui(ui, editor, (id, reference), actions);
        }
        let display = editor.view().curvature_display;
        widgets::section(ui, "Properties", true, |ui| {
            if let Some((curve, report)) = curve.as_ref().zip(editor.sight().report()) {
                figures_ui(ui, curve, &report, display);
            }
            if let Some((curve, report)) = reference.zip(editor.sight().reference_report()) {
                reference_panel::figures_ui(ui, &curve, &report, display);
            }
            deviation_ui(ui, editor);
        });
        let in_space = editor.sight().is_planar(id) == Some(false);
        let heading = "Move by numbers";
        widgets::section(ui, heading, false, |ui| {
            self.movement.show(ui, editor, in_space)
        });
        document_section_ui(ui, editor, false);
        joints_ui(ui, editor);
        if curve.is_some() {
            // Its sentences come and go: nothing stands below them.
            widgets::section(ui, "Harmony", false, |ui| harmony_list_ui(ui, editor));
        }
    }

    /// Show the shape and the placement of a reference.
    fn reference_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        (id, own): (CurveId, &Reference),
        actions: &mut Vec<Action>,
    ) {
        let may_change = own.check_editable().is_ok();
        if let ReferenceForm::Frame(frame) = own.curve.form() {
            widgets::section(ui, own.curve.form().label(), true, |ui| {
                ui.push_id(id, |ui| {
                    picture_panel::picture_ui(ui, editor, (id, own, frame), actions)
                });
            });
        } else {
            widgets::section(ui, own.curve.form().label(), true, |ui| {
                ui.push_id(id, |ui| {
                    ui.add_enabled_ui(may_change, |ui| {
                        reference_panel::shape_ui(ui, editor, &mut self.formulas, (id, own));
                    });
                });
            });
        }
        widgets::section(ui, "Placement", true, |ui| {
            ui.push_id(id, |ui| {
                ui.add_enabled_ui(may_change, |ui| {
                    reference_panel::placement_ui(ui, editor, &own.curve);
                });
            });
        });
    }

    /// Show a field of text with the text that the item has.
    fn text_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        item: &Item,
        (of, shown): (Text, &str),
    ) {
        self.typed.take_if(|(owner, ..)| *owner != item.id);
        let typed = self.typed.take_if(|(_, field, _)| *field == of);
        let mut text = typed.map_or_else(|| shown.to_owned(), |(_, _, text)| text);
        let field_id = ui.make_persistent_id(of.label());
        let is_typed = ui.memory(|memory| memory.has_focus(field_id));
        let room = ui.available_width() - 2.0 * STEP;
        let mut is_cut = false;
        let mut cut_short = |ui: &Ui, text: &dyn TextBuffer, _: f32| {
            let galley = widgets::cut_short(ui, text.as_str(), room, Tokens::of(ui).text);
            is_cut = galley.elided;
            galley
        };
        let mut field = TextEdit::singleline(&mut text)
            .id(field_id)
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER)
            .min_size(vec2(0.0, ROW));
        if !is_typed {
            field = field.layouter(&mut cut_short);
        }
        let mut response = ui.add(field).accessible_name(of.label());
        for tip in [is_cut.then_some(shown), Some(of.help())] {
            let tip = tip.filter(|tip| !tip.is_empty());
            response = tip.map_or(response.clone(), |tip| response.on_hover_text(tip));
        }
        keyboard::claim(ui.ctx(), response.id, Typing::Text, response.rect);
        if response.lost_focus() {
            let called_off = ui.input(|input| input.key_pressed(Key::Escape));
            let edit = of.edit(item, text).filter(|_| !called_off);
            if let Some(edit) = edit {
                told(editor.change(edit));
            }
        } else if response.has_focus() {
            self.typed = Some((item.id, of, text));
        }
    }
}

/// The document's properties below those of the active curve; without one they are `open` at first.
fn document_section_ui(ui: &mut Ui, editor: &mut Editor, open: bool) {
    let id = if open { "empty" } else { "beside" };
    ui.push_id(id, |ui| {
        widgets::section(ui, "Document", open, |ui| {
            let row = widgets::form_row(ui, "Unit", |ui| unit_ui(ui, editor));
            row.response.on_hover_text(Command::SetUnit(None).tooltip());
            guides_ui(ui, editor);
        });
    });
}

/// Show the places of the guides.
fn guides_ui(ui: &mut Ui, editor: &mut Editor) {
    let guides = editor.document().guide_lines().to_vec();
    let mut changed = None;
    for (index, guide) in guides.iter().enumerate() {
        let name = format!("Guide {}", guide.coordinate());
        widgets::form_row(ui, &name, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let name = format!("guide {} {}", index + 1, guide.coordinate());
            let field = NumberField::new(&name, guide.at, significant(guide.at, 6));
            if let Some(at) = field.quantity(Quantity::Length).typed(ui) {
                let mut moved = guides.clone();
                moved[index] = GuideLine { at, ..*guide };
                changed = Some(("Move guide", moved));
            }
            let name = format!("Remove guide {}", index + 1);
            if IconButton::new(Icon::X, &name).show(ui).clicked() {
                let mut others = guides.clone();
                others.remove(index);
                changed = Some(("Remove guide", others));
            }
        });
    }
    if let Some((label, guides)) = changed {
        told(editor.apply(label, vec![Edit::SetGuideLines(guides)]));
    }
}

/// The joints of the selected items, or of the document. They come and go while a curve is dragged: nothing but
/// figures stands below them.
fn joints_ui(ui: &mut Ui, editor: &mut Editor) {
    widgets::section(ui, "Joints", false, |ui| joint_list_ui(ui, editor));
}

fn unit_ui(ui: &mut Ui, editor: &mut Editor) {
    let all = [None].into_iter().chain(LengthUnit::ALL.map(Some));
    let all = all.map(|unit| (unit, unit.map_or("none", LengthUnit::name).to_owned()));
    let (unit, width) = (editor.document().unit(), ui.spacing().combo_width);
    if let (Some(unit), _) = widgets::drop_down(ui, "Document unit", width, &unit, all) {
        told(editor.execute(Command::SetUnit(unit)));
    }
}

fn degree_ui(ui: &mut Ui, editor: &mut Editor, curve: &Curve) {
    let degree = curve.polygon.degree();
    let most = MAX_DEGREE.min(curve.polygon.vertices().len() - 1);
    ui.spacing_mut().item_spacing.x = STEP;
    let step = |ui: &mut Ui, icon, to: usize, help: &str, is_possible| {
        let name = format!("Degree {to}, keep polygon");
        let button = IconButton::new(icon, &name)
            .tooltip(help)
            .enabled(is_possible);
        button.show(ui).clicked().then_some(to as f64)
    };
    let help = "Keep the polygon; the curve follows it more closely";
    let lower = step(ui, Icon::Minus, degree.saturating_sub(1), help, degree > 1);
    let field = NumberField::new("Degree", degree as f64, degree.to_string());
    let typed = field.width(48.0).range(1.0..=most as f64).typed(ui);
    let help =
        "Keep the polygon, change the curve; Elevate degree with a tolerance keeps the curve";
    let raised = step(ui, Icon::Plus, degree + 1, help, degree < MAX_DEGREE);
    if let Some(degree) = lower.or(typed).or(raised) {
        set_degree(editor, degree);
    }
}

fn ends_ui(ui: &mut Ui, editor: &mut Editor, curve: &Curve) {
    let periodic = curve.polygon.is_periodic();
    ui.spacing_mut().item_spacing.x = STEP;
    for (name, wanted, help) in [
        (
            "Open",
            false,
            "The curve begins and ends at its joint, with the same shape",
        ),
        (
            "Periodic",
            true,
            "The curve runs round all vertices; those that repeat the first ones go",
        ),
    ] {
        let response = ui.add(Button::selectable(periodic == wanted, name));
        let response = response.on_hover_text(help);
        if response.clicked() && periodic != wanted {
            told(editor.execute(Command::TogglePeriodic));
        }
    }
}

fn symmetry_ui(ui: &mut Ui, editor: &mut Editor, (id, curve): (CurveId, &Curve)) {
    ui.spacing_mut().item_spacing.x = STEP;
    let command = Command::ToggleSymmetric;
    let mut stays = curve.symmetry.is_some();
    let response = ui.checkbox(&mut stays, "Keep");
    if response.on_hover_text(command.tooltip()).clicked() {
        told(editor.execute(command));
    }
    let planes = curve.symmetry.into_iter().flat_map(|it| it.planes());
    for [through, normal] in planes {
        let axis = normal.abs().to_array().iter().position(|it| *it == 1.0);
        let Some(axis) = axis else {
            widgets::caption(ui, "slanted axis");
            continue;
        };
        widgets::caption(ui, ["x", "y", "z"][axis]);
        let name = ["axis at x", "axis at y", "axis at z"][axis];
        let place = through[axis];
        let field = NumberField::new(name, place, significant(place, 6));
        let field = field.width(56.0).quantity(Quantity::Length);
        let help = "Where the axis is; the curve moves with it";
        if let Some(wanted) = field.help(help).typed(ui) {
            let by = (wanted - place) * normal.abs();
            let vertices = curve.polygon.vertices().iter().enumerate();
            let moves = vertices.map(|(index, at)| (index, *at + by)).collect();
            told(editor.apply("Move axis", vec![Edit::MoveVertices { curve: id, moves }]));
        }
    }
}

fn figures_ui(ui: &mut Ui, curve: &Curve, report: &CurveReport, display: CurvatureDisplay) {
    ui.spacing_mut().item_spacing.y = 0.0;
    let kind = match (report.planar, curve.polygon.weights().is_some()) {
        (true, false) => "planar, polynomial",
        (true, true) => "planar, rational",
        (false, false) => "in space, polynomial",
        (false, true) => "in space, rational",
    };
    widgets::fact_row(ui, "Kind", kind);
    widgets::figure_row(ui, "Segments", &report.segments.to_string());
    let plain = |value: f64| figures::significant(value, 6);
    let length = document_unit::length(ui.ctx(), figures::significant(report.length, 8));
    widgets::figure_row(ui, "Length", &length);
    curvature_rows(ui, display, report.curvature);
    let legs = document_unit::length(ui.ctx(), figures::range(report.legs, plain));
    widgets::figure_row(ui, "Polygon legs", &legs);
    let angle = |value: f64| figures::degrees(value, 3);
    widgets::figure_row(ui, "Turning angles", &figures::range(report.turns, angle));
    let growth = figures::significant(report.amplification.largest, 4);
    let text = format!("grows × {growth}");
    let tooltip = format!(
        "Error of the float vertices by one rounded closed vertex; all rounded: × {}",
        figures::significant(report.amplification.norm, 4)
    );
    widgets::figure_row(ui, "Rounding in CAD", &text).on_hover_text(tooltip);
}
