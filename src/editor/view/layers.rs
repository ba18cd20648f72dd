//! The canvas's layers and which of them are shown.

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
    /// Where the selected vertex may go without adding a feature.
    SafeRegion,
}

impl Layer {
    /// Every layer, in the order of its switches: keys 1 to 9.
    pub const ALL: [Self; 9] = [
        Self::Float,
        Self::Clamped,
        Self::Curve,
        Self::Evolute,
        Self::Comb,
        Self::Targets,
        Self::Grid,
        Self::Features,
        Self::SafeRegion,
    ];

    /// What the layer is called on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Float => "Float S-polygon",
            Self::Clamped => "Closed S-polygon (clamped)",
            Self::Curve => "Curve",
            Self::Evolute => "Evolute",
            Self::Comb => "Curvature comb",
            Self::Targets => "End targets",
            Self::Grid => "Grid and axes",
            Self::Features => "Proved features",
            Self::SafeRegion => "Safe region",
        }
    }
}

/// Which layers are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layers {
    shown: [bool; Layer::ALL.len()],
}

impl Default for Layers {
    /// All but the comb, which together with the evolute would hide the polygons at first sight, and
    /// the safe region, which takes work to find.
    fn default() -> Self {
        let mut layers = Self {
            shown: [true; Layer::ALL.len()],
        };
        layers.set(Layer::Comb, false);
        layers.set(Layer::SafeRegion, false);
        layers
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
