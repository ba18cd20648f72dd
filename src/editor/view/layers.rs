//! The table of the canvas's layers, and which of them are shown.

/// A layer of the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layer {
    /// The float S-polygon.
    Float,
    /// The closed S-polygon (clamped).
    Clamped,
    /// The curve.
    Curve,
    /// The evolute.
    Evolute,
    /// The curvature comb.
    Comb,
    /// Targets of the ends.
    Targets,
    /// The grid and its axes.
    Grid,
    /// Proved monotone pieces and features.
    Features,
    /// Places of the selected vertex that add no feature.
    SafeRegion,
    /// Where ends of curves meet.
    Joints,
    /// Guides, and the rulers from which they are dragged.
    Guides,
}

/// A row of the table of layers. Menu, strip of switches, keys, legend and settings read it.
#[derive(Debug)]
pub struct LayerRow {
    /// The layer.
    pub layer: Layer,
    /// Its name in the settings.
    pub name: &'static str,
    /// Its name on screen.
    pub label: &'static str,
    /// The tooltip of its switch.
    pub help: &'static str,
    /// The Lucide name of its icon.
    pub icon: &'static str,
    /// The name of its colour in the theme.
    pub colour: &'static str,
    /// Its sample in the legend.
    pub sample: Option<LayerSample>,
    /// Whether it is shown until the user hides it.
    pub is_on: bool,
}

/// How the legend draws a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerSample {
    /// A line.
    Line,
    /// A line with a disc.
    Discs,
    /// A dashed line with a square.
    Squares,
}

/// Every layer, in the order of the switches, which is that of [`Layer`]'s variants.
static LAYERS: &[LayerRow] = &[
    row(
        Layer::Float,
        "float",
        "Float S-polygon",
        ["waypoints", "float"],
    )
    .sampled(LayerSample::Discs),
    row(
        Layer::Clamped,
        "closed",
        "Closed S-polygon",
        ["pentagon", "clamped"],
    )
    .sampled(LayerSample::Squares)
    .help("Show or hide the clamped control polygon, as CAD programs show it"),
    row(Layer::Curve, "curve", "Curve", ["spline", "curve"]).sampled(LayerSample::Line),
    row(Layer::Evolute, "evolute", "Evolute", ["origami", "evolute"]).sampled(LayerSample::Line),
    // Together with the evolute it would hide the polygons at first sight.
    row(
        Layer::Comb,
        "comb",
        "Curvature comb",
        ["chart-no-axes-column", "comb"],
    )
    .sampled(LayerSample::Line)
    .off(),
    row(Layer::Targets, "targets", "End targets", ["goal", "target"]).sampled(LayerSample::Line),
    row(Layer::Grid, "grid", "Grid and axes", ["grid-3x3", "joints"]),
    row(
        Layer::Features,
        "features",
        "Proved features",
        ["badge-check", "rising"],
    ),
    // It takes work to find.
    row(
        Layer::SafeRegion,
        "safe-region",
        "Safe region",
        ["circle-dashed", "good"],
    )
    .help("Show or hide where the selected vertex can go without adding a feature")
    .off(),
    row(
        Layer::Joints,
        "joints",
        "Joints of curves",
        ["merge", "joints"],
    )
    .help("Show or hide where ends of curves meet, with the continuity that holds"),
    row(
        Layer::Guides,
        "guides",
        "Guides and rulers",
        ["pencil-ruler", "guide"],
    )
    .help("Show or hide guides, which points snap to; drag new ones from the rulers"),
];

/// A layer that is shown, has no sample in the legend, and the usual help.
const fn row(
    layer: Layer,
    name: &'static str,
    label: &'static str,
    [icon, colour]: [&'static str; 2],
) -> LayerRow {
    LayerRow {
        layer,
        name,
        label,
        help: "Show or hide this layer",
        icon,
        colour,
        sample: None,
        is_on: true,
    }
}

impl LayerRow {
    const fn sampled(self, sample: LayerSample) -> Self {
        let sample = Some(sample);
        Self { sample, ..self }
    }

    const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    const fn off(self) -> Self {
        Self {
            is_on: false,
            ..self
        }
    }
}

impl Layer {
    /// Every layer, in the order of the switches.
    pub const ALL: [Self; LAYERS.len()] = {
        let mut all = [Self::Float; LAYERS.len()];
        let mut place = 0;
        while place < LAYERS.len() {
            assert!(
                LAYERS[place].layer as usize == place,
                "rows in the order of variants"
            );
            all[place] = LAYERS[place].layer;
            place += 1;
        }
        all
    };

    /// The layer's row of the table.
    pub fn row(self) -> &'static LayerRow {
        &LAYERS[self as usize]
    }

    /// The layer's name on screen.
    pub fn label(self) -> &'static str {
        self.row().label
    }

    /// The digit that shows or hides the layer; none after the ninth.
    pub fn key(self) -> Option<char> {
        let digit = self as u32 + 1;
        char::from_digit(digit, 10)
    }
}

/// Which layers are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layers {
    shown: [bool; Layer::ALL.len()],
}

impl Default for Layers {
    fn default() -> Self {
        Self {
            shown: Layer::ALL.map(|layer| layer.row().is_on),
        }
    }
}

impl Layers {
    /// Whether a layer is shown.
    pub fn shows(&self, layer: Layer) -> bool {
        self.shown[layer as usize]
    }

    /// Show or hide a layer.
    pub fn set(&mut self, layer: Layer, shown: bool) {
        self.shown[layer as usize] = shown;
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn layers_have_names_of_their_own_and_the_first_nine_a_digit() {
        let names: BTreeSet<&str> = LAYERS.iter().map(|row| row.name).collect();
        assert_eq!(names.len(), LAYERS.len());
        for (place, layer) in Layer::ALL.into_iter().enumerate() {
            let digit = "123456789".chars().nth(place);
            assert_eq!(layer.key(), digit, "{}", layer.label());
        }
    }
}
