//! Making the plot of the active curve that is shown.

use glam::DVec2;

use crate::analysis::{CurveAnalysis, LevelPlot};
use crate::editor::Editor;
use crate::editor::view::plot_scene::{PlotKind, PlotScene, PlotSource};

impl Editor {
    /// Make the plot that is shown; its series are made anew only if its curves or its kind changed.
    pub(in crate::editor) fn plot(&mut self) {
        let source = self.plot_source();
        let mut plots = std::mem::take(&mut self.view.plots);
        plots.hovered = None;
        plots.hovered_level = None;
        plots.hovered_vertex = None;
        if source != self.view.plotted {
            plots.clear();
            self.fill(&mut plots, source.as_ref());
            self.view.plotted = source;
        }
        if let Some((id, kind)) = self.active().zip(self.view.plot)
            && let Some(analysis) = self.analyses.get(id)
        {
            if let Some((u, curvature)) = self.view.scene.hovered_on(id) {
                let sampled = analysis.sampled();
                plots.hovered = Some(DVec2::new(sampled.length_at(u), curvature));
                if let PlotKind::Levels { plot, normalised } = kind {
                    plots.hovered_level = Some(sampled.level_at(plot, normalised, u));
                }
            }
            plots.hovered_vertex = self.vertex_hovered_on(id);
        }
        self.view.plots = plots;
    }

    /// What is to be plotted; `None` if nothing is.
    fn plot_source(&self) -> Option<PlotSource> {
        let (id, kind) = self.active().zip(self.view.plot)?;
        Some(PlotSource {
            kind,
            id,
            curve: self.analyses.get(id)?.curve().clone(),
            before: self.before(),
        })
    }

    fn fill(&mut self, plots: &mut PlotScene, source: Option<&PlotSource>) {
        if let Some(source) = source
            && let Some(analysis) = self.analyses.get_mut(source.id)
        {
            plots.fill(analysis, source.kind);
            plots.before = source.before.as_ref().map(|before| {
                let mut plots = PlotScene::default();
                plots.fill(self.view.ghost.analysis(before), source.kind);
                Box::new(plots)
            });
        }
    }
}

impl PlotScene {
    /// Make the series of a curve.
    fn fill(&mut self, analysis: &mut CurveAnalysis, kind: PlotKind) {
        self.planar = analysis.is_planar();
        self.length = analysis.samples().length();
        match kind {
            PlotKind::Curvature => {
                analysis.append_curvature(&mut self.curvature);
                self.flank = analysis.append_discrete_curvature(&mut self.discrete);
            }
            PlotKind::Levels { plot, normalised } => {
                analysis.append_levels(plot, normalised, &mut self.levels);
                let is_graph = plot == LevelPlot::Logarithmic;
                self.slope = is_graph.then(|| straight_slope(&self.levels)).flatten();
            }
            PlotKind::Legs => {
                analysis.float().append_leg_series(&mut self.legs);
                analysis.float().append_turn_series(&mut self.turns);
                for point in &mut self.turns {
                    point.y = point.y.to_degrees();
                }
            }
        }
    }

    /// Empty all series, and keep their room.
    fn clear(&mut self) {
        let Self {
            curvature,
            discrete,
            levels,
            legs,
            turns,
            ..
        } = std::mem::take(self);
        *self = Self {
            curvature,
            discrete,
            levels,
            legs,
            turns,
            ..Self::default()
        };
        self.discrete.clear();
        for series in [
            &mut self.curvature,
            &mut self.levels,
            &mut self.legs,
            &mut self.turns,
        ] {
            series.clear();
        }
    }
}

/// The share of a graph's points, at either end in either direction, that run off to infinity
/// and are left out when a straight line is put through it.
const RUNS_OFF: f64 = 0.1;

/// The slope of the straight line nearest to the middle of a graph, measured upwards (least
/// squares), and how well it fits: r², 1 for a straight graph. `None` if it lies over one place.
fn straight_slope(points: &[DVec2]) -> Option<(f64, f64)> {
    let finite: Vec<DVec2> = points
        .iter()
        .copied()
        .filter(|point| point.is_finite())
        .collect();
    let inner = |value: fn(&DVec2) -> f64| {
        let mut values: Vec<f64> = finite.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        let beyond = (RUNS_OFF * values.len() as f64) as usize;
        Some(*values.get(beyond)?..=*values.iter().nth_back(beyond)?)
    };
    let (across, along) = (inner(|point| point.x)?, inner(|point| point.y)?);
    let is_inner = |point: &&DVec2| across.contains(&point.x) && along.contains(&point.y);
    let inner = || finite.iter().filter(is_inner);
    let mean = inner().sum::<DVec2>() / inner().count() as f64;
    let (xx, xy, yy) = inner().fold((0.0, 0.0, 0.0), |(xx, xy, yy), point| {
        let arm = *point - mean;
        (xx + arm.x * arm.x, xy + arm.x * arm.y, yy + arm.y * arm.y)
    });
    let (slope, fit) = (xy / xx, xy * xy / (xx * yy));
    (slope.is_finite() && fit.is_finite()).then_some((slope, fit))
}
