//! What panels and plots read, made anew each frame.

use glam::DVec2;

use crate::analysis::LevelPlot;
use crate::editor::Editor;
use crate::editor::report::{CurveReport, Readout};
use crate::editor::view::scene::{HoverScene, PlotScene};
use crate::geometry::{Amplification, FloatPolygon, PolygonKind};

impl Editor {
    /// Bring the plots of the active curve up to date and return them.
    pub fn plots(&mut self) -> &PlotScene {
        self.analyses.update(self.workspace.document());
        let mut plots = std::mem::take(&mut self.view.plots);
        plots.curvature.clear();
        plots.discrete.clear();
        plots.legs.clear();
        plots.turns.clear();
        plots.hovered = None;
        plots.hovered_vertex = None;
        if let Some(id) = self.hand.selection.active()
            && let Some(analysis) = self.analyses.get(id)
        {
            plots.planar = analysis.is_planar();
            analysis.append_curvature(&mut plots.curvature);
            plots.flank = analysis.append_discrete_curvature(&mut plots.discrete);
            plots.length = analysis.length();
            let hovered = self.view.scene.hovered_on(id);
            plots.hovered =
                hovered.map(|(u, curvature)| DVec2::new(analysis.length_at(u), curvature));
            plots.hovered_vertex = self.vertex_hovered_on(id);
        }
        self.view.plots = plots;
        &self.view.plots
    }

    /// Bring a plot of levels of the active curve up to date and return it with the others;
    /// `normalised` scales the curve to length 1.
    pub fn level_plot(&mut self, plot: LevelPlot, normalised: bool) -> &PlotScene {
        self.plots();
        let scene = &mut self.view.plots;
        scene.levels.clear();
        scene.hovered_level = None;
        scene.slope = None;
        if let Some(id) = self.hand.selection.active()
            && let Some(analysis) = self.analyses.get(id)
        {
            analysis.append_levels(plot, normalised, &mut scene.levels);
            let hovered = self.view.scene.hovered_on(id);
            scene.hovered_level =
                hovered.map(|(u, _)| analysis.sampled().level_at(plot, normalised, u));
            scene.slope = (plot == LevelPlot::Logarithmic)
                .then(|| straight_slope(&scene.levels))
                .flatten();
        }
        scene
    }

    /// Whether the active curve is planar, if there is one.
    pub fn active_is_planar(&self) -> Option<bool> {
        Some(
            self.analyses
                .peek(self.hand.selection.active()?)?
                .is_planar(),
        )
    }

    /// Bring the plot of legs and turning angles up to date and return it with the others.
    pub fn leg_plots(&mut self) -> &PlotScene {
        self.plots();
        let Some(id) = self.hand.selection.active() else {
            return &self.view.plots;
        };
        if let Some(analysis) = self.analyses.get(id) {
            analysis
                .float()
                .append_leg_series(&mut self.view.plots.legs);
            analysis
                .float()
                .append_turn_series(&mut self.view.plots.turns);
        }
        for point in &mut self.view.plots.turns {
            point.y = point.y.to_degrees();
        }
        &self.view.plots
    }

    /// What the status bar reads.
    pub fn readout(&self) -> Readout {
        let mut readout = Readout {
            pointer: self
                .hand
                .gestures
                .pointer()
                .map(|at| self.view.viewport.to_model(at)),
            axes: self.axis_names(),
            scale: self.view.viewport.scale,
            degree: self.active_curve().map(|(_, curve)| curve.polygon.degree()),
            ..Readout::default()
        };
        if let Some(HoverScene::Curve { u, curvature, .. }) = self.view.scene.hover {
            readout.u = Some(u);
            readout.curvature = Some(curvature);
        }
        readout
    }

    /// What the inspector says of the active curve.
    pub fn report(&mut self) -> Option<CurveReport> {
        self.analyses.update(self.workspace.document());
        let id = self.hand.selection.active()?;
        let analysis = self.analyses.get(id)?;
        let figures = analysis.float().figures();
        Some(CurveReport {
            planar: analysis.is_planar(),
            segments: analysis.curve().polygon.segments(),
            length: analysis.length(),
            curvature: analysis.curvature(),
            legs: figures.legs,
            turns: figures.turns,
            amplification: clamped_amplification(&analysis.curve().polygon),
        })
    }

    /// The vertex of the active curve that is hovered, on the canvas or in a panel.
    pub fn hovered_vertex(&self) -> Option<usize> {
        self.vertex_hovered_on(self.hand.selection.active()?)
    }

    /// The number of segments of a curve that were sampled when it last changed.
    pub fn segments_redone(&self, curve: crate::document::CurveId) -> Option<usize> {
        Some(self.analyses.peek(curve)?.segments_redone())
    }

    /// The number of segments of a curve whose features were proved when it last changed.
    pub fn segments_proved(&self, curve: crate::document::CurveId) -> Option<usize> {
        Some(self.analyses.peek(curve)?.segments_proved())
    }

    fn vertex_hovered_on(&self, id: crate::document::CurveId) -> Option<usize> {
        let told = self.view.hovered.vertex.or(self.view.hovered_before.vertex);
        if told.is_some() {
            return told;
        }
        let place = self.hand.gestures.pointer()?;
        if self.hand.gestures.is_dragging() {
            return None;
        }
        let hit = self.context().hits.vertex(place)?;
        (hit.0 == id).then_some(hit.1)
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

/// How much an error in a vertex of the closed S-polygon grows in the float S-polygon.
fn clamped_amplification(polygon: &FloatPolygon) -> Option<Amplification> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    Amplification::of(PolygonKind::Clamped, PolygonKind::Float, degree, segments).ok()
}
