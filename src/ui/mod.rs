//! The window: egui only. It shows the editor's state and sends the user's events; it
//! computes no geometry.

mod action;
mod app;
mod atlas;
mod brush;
mod canvas;
mod cell_entry;
mod cell_keys;
mod chains;
mod chips;
mod context_menu;
mod curvature_rows;
mod curve_item;
mod curve_list;
mod deviation_panel;
mod dialogs;
mod document_unit;
mod draft;
mod end_fit_panel;
mod end_fit_target;
mod end_marks;
mod export_panel;
mod feature_comparison;
mod feature_list;
mod feature_marks;
mod figures;
mod file_dialogs;
mod fitted_points;
mod formula_fields;
mod gizmo;
mod grid;
mod group_heading;
mod group_rows;
mod guides;
mod harmony_list;
mod help;
mod icons;
mod import_panel;
mod inspector;
mod item_fields;
mod items_panel;
mod joint_list;
mod judging;
mod key_list;
mod key_order;
mod keyboard;
mod labels;
mod layer_strip;
mod legend;
mod level_comparison;
mod manual;
mod menu;
mod menu_item;
mod message;
mod move_fields;
mod number_field;
mod operation_fields;
mod operation_panel;
mod operation_report;
mod overlays;
mod painting;
mod palette;
mod paper_panel;
mod picture_panel;
mod pictures;
mod plots;
mod proposal;
mod recovery;
mod reference_panel;
mod rulers;
mod seconds;
mod shell;
mod side;
mod signals;
mod status_bar;
mod steady_rows;
mod theme;
mod tool_panel;
mod tool_rail;
mod trade_off;
mod transform_marks;
mod unit_menu;
mod vertex_columns;
mod vertex_rows;
mod vertex_table;
mod whisker_fields;
mod widgets;

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration;

use anyhow::{anyhow, bail};
use eframe::egui::{IconData, ViewportBuilder};

pub use app::App;

use crate::editor::{EditedFile, Editor};
use crate::io::Sessions;

/// The window's size at first.
const SIZE: [f32; 2] = [1440.0, 900.0];

/// The smallest size at which nothing is cut off.
const LEAST: [f32; 2] = [960.0, 640.0];

/// How much work is lost at most when the program ends badly.
const AUTOSAVE_PERIOD: Duration = Duration::from_secs(10);

/// The variable that sets another period, in seconds: for tests.
const AUTOSAVE_VARIABLE: &str = "BATTEN_AUTOSAVE_SECONDS";

/// How long a frame waits for background jobs.
const PATIENCE: Duration = Duration::from_millis(4);

/// Open the editor with some files, and return when its window is closed.
///
/// # Errors
/// If a file cannot be read, there is no display, or no window can be opened on it.
pub fn run(files: &[PathBuf]) -> anyhow::Result<()> {
    let mut editor = Editor::new();
    editor.open(files)?;
    show(editor)
}

/// Open the editor with a file of any format, to be saved back in that format. Returns whether it was saved once its
/// window is closed. `is_alone` promises that the file holds nothing but curves.
///
/// # Errors
/// As [`run`].
pub fn edit(file: &Path, is_alone: bool) -> anyhow::Result<bool> {
    let mut editor = Editor::new();
    let edited = EditedFile::new(file, is_alone);
    let saved = edited.saved_flag();
    editor.filing_mut().edit(edited);
    editor.open(&[file.to_owned()])?;
    show(editor)?;
    Ok(saved.load(Ordering::Relaxed))
}

/// Show an editor in a window until it is closed.
fn show(mut editor: Editor) -> anyhow::Result<()> {
    check_display()?;
    if let Some(sessions) = Sessions::of_user() {
        let period = seconds::seconds_of(AUTOSAVE_VARIABLE).unwrap_or(AUTOSAVE_PERIOD);
        editor.autosave_in(sessions, period);
    }
    let mut viewport = ViewportBuilder::default()
        .with_title("Batten")
        .with_app_id("batten")
        .with_inner_size(SIZE)
        .with_min_inner_size(LEAST)
        .with_drag_and_drop(true);
    if let Some(icon) = icon() {
        viewport = viewport.with_icon(icon);
    }
    let options = eframe::NativeOptions {
        viewport,
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |creation| {
        let context = creation.egui_ctx.clone();
        editor.run_in_background(PATIENCE, move || context.request_repaint());
        let mut app = App::new(&creation.egui_ctx, creation.storage, true, editor);
        app.listen_to_signals(&creation.egui_ctx)?;
        Ok(Box::new(app))
    });
    eframe::run_native("Batten", options, create).map_err(|error| {
        // The last part is the failure; those before name the sources of libraries.
        let text = error.to_string();
        let cause = text.rsplit(": ").next().unwrap_or_default();
        anyhow!("cannot open the window: {cause}. Is a display reachable?")
    })
}

/// Name the missing display on Linux and its like: libraries fail with less clear messages.
fn check_display() -> anyhow::Result<()> {
    let names = ["WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DISPLAY"];
    let is_set = |name: &&str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !names.iter().any(is_set) {
        bail!(
            "there is no display to open the window on: neither WAYLAND_DISPLAY nor DISPLAY is \
             set. Start Batten from a desktop session, or use its commands (batten --help)."
        );
    }
    Ok(())
}

fn icon() -> Option<IconData> {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).ok()
}
