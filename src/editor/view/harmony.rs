//! The harmony of the active curve, and the vertices where the flow is least even.

use crate::analysis::{Flow, LevelPlot};
use crate::editor::view::layers::Layer;
use crate::editor::view::plot_scene::PlotKind;
use crate::editor::view::scene::Mark;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;

/// A second difference of a logarithm or an angle up to this is rounding.
const EVEN: f64 = 1e-9;

impl View {
    /// Whether something shows the harmony of the active curve.
    pub(super) fn shows_harmony(&self) -> bool {
        let is_plotted = match self.plot {
            Some(PlotKind::Harmony) => true,
            Some(PlotKind::Levels { plot, .. }) => plot == LevelPlot::Logarithmic,
            _ => false,
        };
        is_plotted || self.harmony
    }
}

impl Sight<'_> {
    /// The vertices where the flow of the active curve is least even, if its harmony is known and
    /// shown in strips.
    pub(super) fn worst_of_flow(self) -> [Option<(Flow, usize)>; Flow::ALL.len()] {
        let is_shown = matches!(self.view.plot, Some(PlotKind::Harmony));
        let harmony = self.harmony().filter(|_| is_shown);
        Flow::ALL.map(|flow| {
            let figures = harmony?.figures;
            let worst = match flow {
                Flow::Legs => figures.legs,
                Flow::Turns => figures.turns,
                Flow::Curvatures => figures.sharpest,
                Flow::TorsionAngles => figures.torsions,
            };
            // An even polygon has no worst vertex.
            let is_even = |value: f64| flow != Flow::Curvatures && value <= EVEN;
            let worst = worst.filter(|figure| !is_even(figure.value))?;
            Some((flow, worst.vertex))
        })
    }

    /// Mark these vertices on the canvas, with the names of the strips in which they are worst.
    pub(super) fn flow_marks(self) -> Vec<Mark> {
        let Some(curve) = self.active().and_then(|id| self.document().curve(id)) else {
            return Vec::new();
        };
        if !curve.visible || !self.shown.layers.shows(Layer::Float) {
            return Vec::new();
        }
        let mut worst: Vec<(usize, String)> = Vec::new();
        for (flow, vertex) in self.worst_of_flow().into_iter().flatten() {
            match worst.iter_mut().find(|(known, _)| *known == vertex) {
                Some((_, names)) => *names += &format!(", {}", short_name(flow)),
                None => worst.push((vertex, short_name(flow).to_owned())),
            }
        }
        let marks = worst.into_iter().filter_map(|(vertex, text)| {
            let vertex = curve.polygon.vertices().get(vertex)?;
            let at = self.viewport().flatten(*vertex);
            Some(Mark::Extreme { at, text })
        });
        marks.collect()
    }
}

/// The label of a vertex, by the sequence in which it is worst.
fn short_name(flow: Flow) -> &'static str {
    match flow {
        Flow::Legs => "leg",
        Flow::Turns => "angle",
        Flow::Curvatures => "κ",
        Flow::TorsionAngles => "torsion",
    }
}
