//! The parts of the window beside the document.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::judging::Judging;
use crate::editor::{CurvatureDisplay, Layer, Layers};
use crate::io::{ExportChoice, disk};

/// The parts of the window beside the document; the settings keep them from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shell {
    pub(super) dark: bool,
    pub(super) plots: bool,
    /// Whether the plot in front is that of harmony.
    pub(super) harmony: bool,
    /// Whether plots show curves scaled to length 1.
    pub(super) normalised: bool,
    /// Whether layers are shown, by their names.
    pub(super) layers: BTreeMap<String, bool>,
    /// The layers that are hidden, by their places, as older settings have them.
    #[serde(skip_serializing)]
    pub(super) hidden: Option<Vec<usize>>,
    /// How far an arrow key moves the selection; none is as the editor begins.
    pub(super) nudge_step: Option<f64>,
    /// The name of what the draw tool makes of clicks; none is as the editor begins.
    pub(super) draw_way: Option<String>,
    /// Whether bands of rising and falling curvature are shown on the canvas.
    pub(super) bands: bool,
    /// Whether the tools show their names.
    pub(super) tool_names: bool,
    /// How curvatures are written, by name.
    pub(super) curvature: String,
    /// What documents exported last, by their paths, the last one first.
    pub(super) exports: Vec<(PathBuf, BTreeMap<String, String>)>,
    /// How documents are judged, by their paths, the last one first.
    pub(super) judgings: Vec<(PathBuf, Judging)>,
    /// Whether a card offers the tour of the paper: from the first start until it is answered.
    pub(super) offers_tour: bool,
}

impl Default for Shell {
    fn default() -> Self {
        Self {
            dark: true,
            plots: true,
            harmony: false,
            normalised: false,
            layers: BTreeMap::new(),
            hidden: None,
            nudge_step: None,
            draw_way: None,
            bands: true,
            tool_names: false,
            curvature: CurvatureDisplay::default().name().to_owned(),
            exports: Vec::new(),
            judgings: Vec::new(),
            offers_tour: false,
        }
    }
}

/// The places of layers in old settings.
const OLD_PLACES: [Layer; 9] = [
    Layer::Float,
    Layer::Clamped,
    Layer::Curve,
    Layer::Evolute,
    Layer::Comb,
    Layer::Targets,
    Layer::Grid,
    Layer::Features,
    Layer::SafeRegion,
];

/// The most documents whose last export and judging are kept.
const MOST_KEPT: usize = 50;

impl Shell {
    /// The choice of the last export of a document, by its path.
    pub fn export_of(&self, path: &Path) -> Option<ExportChoice> {
        let settings = kept(&self.exports, path)?;
        ExportChoice::of_settings(settings)
    }

    /// Keep the choice of the last export of a document.
    pub fn keep_export(&mut self, path: &Path, choice: &ExportChoice) {
        keep(&mut self.exports, path, choice.settings());
    }

    /// How a document is judged, by its path.
    pub fn judging_of(&self, path: &Path) -> Option<&Judging> {
        kept(&self.judgings, path)
    }

    /// Keep how a document is judged.
    pub fn keep_judging(&mut self, path: &Path, judging: Judging) {
        keep(&mut self.judgings, path, judging);
    }

    /// Remember which layers are shown.
    pub fn keep_layers(&mut self, layers: Layers) {
        let named = Layer::ALL.map(|layer| (layer.row().name.to_owned(), layers.shows(layer)));
        self.layers = named.into();
        self.hidden = None;
    }

    /// Whether a layer was shown; `None` if the settings do not name it.
    pub fn shows(&self, layer: Layer) -> Option<bool> {
        let old = || {
            let place = OLD_PLACES.iter().position(|old| *old == layer)?;
            Some(!self.hidden.as_ref()?.contains(&place))
        };
        self.layers.get(layer.row().name).copied().or_else(old)
    }
}

/// What is kept of a document.
fn kept<'k, T>(all: &'k [(PathBuf, T)], path: &Path) -> Option<&'k T> {
    let path = full(path);
    let (_, kept) = all.iter().find(|(known, _)| *known == path)?;
    Some(kept)
}

/// The path of a document that does not depend on the folder in which the program was started.
fn full(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    disk::normal(&absolute)
}

/// Keep something of a document in front of the others.
fn keep<T>(all: &mut Vec<(PathBuf, T)>, path: &Path, kept: T) {
    let path = full(path);
    all.retain(|(known, _)| *known != path);
    all.insert(0, (path, kept));
    all.truncate(MOST_KEPT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_of_a_document_is_found_from_any_folder() {
        let mut shell = Shell::default();
        let judging = Judging::default();
        shell.keep_judging(Path::new("job.batten"), judging.clone());
        let folder = std::env::current_dir().expect("a folder");
        let path = folder.join("job.batten");
        assert_eq!(shell.judging_of(&path), Some(&judging));
        let around = Path::new("elsewhere/../job.batten");
        assert_eq!(shell.judging_of(around), Some(&judging));
        assert_eq!(shell.judging_of(Path::new("/elsewhere/job.batten")), None);
        shell.keep_judging(&path, judging);
        assert_eq!(shell.judgings.len(), 1);
    }

    #[test]
    fn layers_are_kept_by_name_and_old_places_are_still_read() {
        let old = r#"{ "hidden": [0, 4] }"#;
        let mut shell: Shell = serde_json::from_str(old).expect("settings");
        let shown = |shell: &Shell| Layer::ALL.map(|layer| shell.shows(layer));
        let expected = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|place| Some(place != 0 && place != 4));
        assert_eq!(shown(&shell)[..9], expected);
        let mut layers = Layers::default();
        layers.set(Layer::Evolute, false);
        shell.keep_layers(layers);
        let written = serde_json::to_string(&shell).expect("settings");
        assert!(written.contains(r#""evolute":false"#) && !written.contains("hidden"));
        let read: Shell = serde_json::from_str(&written).expect("settings");
        assert_eq!(read, shell);
        assert_eq!(
            shown(&read),
            Layer::ALL.map(|layer| Some(layers.shows(layer)))
        );
        assert_eq!(shown(&Shell::default()), Layer::ALL.map(|_| None));
    }
}
