//! The series of the plot, made again only when the curve or the kind of plot changes.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use crate::analysis::{CurveAnalysis, Flow, Item, LevelPlot, ReferenceAnalysis, SampledCurve};
use crate::document::{CurveId, Document, Reference};
use crate::editor::view::overlay::Overlay;
use crate::editor::view::plot_chain::{Beside, OtherPlot, chain};
use crate::editor::view::plot_scene::{PlotKind, PlotScene, PlotSource};
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;
use crate::geometry::references::ReferenceCurve;

impl View {
    /// Make the plot that is shown; its series are made anew only if its curves or its kind changed.
    pub(in crate::editor) fn draw_plot(&mut self, shown: Shown<'_>, overlay: &Overlay) {
        let source = self.plot_source(shown, overlay);
        let mut plots = std::mem::take(&mut self.plots);
        plots.hovered = None;
        plots.hovered_vertex = None;
        if source != self.plotted {
            plots.clear();
            self.fill(&mut plots, source.as_ref(), shown.document());
            self.plotted = source;
            self.plot_marked = None;
        }
        self.mark_plot(&mut plots, shown, overlay.joint);
        if let Some((id, kind)) = shown.active().zip(self.plot)
            && let Some(sampled) = self.analyses.sampled(id)
        {
            if let Some((hovered, u, _)) = self.pane.scene.hovered()
                && hovered == id
                && let PlotKind::Levels { plot, normalised } = kind
            {
                plots.hovered = Some(sampled.level_at(plot, normalised, u));
            }
            plots.hovered_vertex = self.sight(shown).hovered_vertex();
            plots.worst = self.sight(shown).worst_of_flow().map(|worst| {
                let (flow, vertex) = worst?;
                let value = self.analyses.get(id)?.float().flow(flow, vertex)?;
                Some(DVec2::new(vertex as f64, as_shown(flow, value)))
            });
        }
        self.plots = plots;
    }

    /// The inputs of the plot; `None` without an active curve, and while plots are folded.
    fn plot_source(&mut self, shown: Shown<'_>, overlay: &Overlay) -> Option<PlotSource> {
        let (id, kind) = shown.active().zip(self.plot)?;
        let compared = self.compared_with(id, shown.document(), overlay);
        let of_document = compared.as_ref().and_then(|(other, _)| *other);
        Some(PlotSource {
            kind,
            id,
            item: Item::of(shown.document(), id)?,
            before: overlay.before.clone().map(Item::Curve),
            others: self.beside(shown, (id, of_document), kind),
            compared,
            part: self.plot_part.filter(|_| can_be_closer(kind)),
        })
    }

    /// Find the other selected curves and references that are plotted beside the active one; `compared` has a plot of its
    /// own. In the length of each they are end to end where they meet in a chain.
    fn beside(
        &self,
        shown: Shown<'_>,
        (active, compared): (CurveId, Option<CurveId>),
        kind: PlotKind,
    ) -> Vec<Beside> {
        let PlotKind::Levels { plot, normalised } = kind else {
            return Vec::new();
        };
        let mut others = shown.selection.items();
        others.retain(|id| *id != active && Some(*id) != compared);
        let length = |id| {
            let sampled = self.analyses.sampled(id);
            sampled.map_or(0.0, |sampled| sampled.samples.length())
        };
        let placed = match normalised || plot == LevelPlot::Logarithmic {
            true => BTreeMap::new(),
            false => chain(self.joints.all(), active, &others, length),
        };
        let beside = others.into_iter().filter_map(|id| {
            Some(Beside {
                id,
                item: Item::of(shown.document(), id)?,
                placed: placed.get(&id).copied(),
            })
        });
        beside.collect()
    }

    /// Find what the active curve is compared with: the user's choice in the document, or the reference that an
    /// operation was given, which the document does not have.
    fn compared_with(
        &mut self,
        id: CurveId,
        document: &Document,
        overlay: &Overlay,
    ) -> Option<(Option<CurveId>, Item)> {
        let has = |given: &Arc<Reference>| {
            let mut references = document.references();
            references.find(|(_, reference)| reference.curve == given.curve)
        };
        match &overlay.given {
            Some(given) if has(given).is_none() => {
                match &mut self.given {
                    Some(analysis) => analysis.update(given),
                    none => *none = Some(ReferenceAnalysis::new(given.clone())),
                }
                Some((None, Item::Reference(given.clone())))
            }
            given => {
                let of_document = given.as_ref().and_then(has).map(|(id, _)| id);
                let other = of_document.or(self.compared(id));
                let other = other.filter(|other| *other != id)?;
                Some((Some(other), Item::of(document, other)?))
            }
        }
    }

    /// The reference with the curve that an operation was given: the same as in the frame before, unless it
    /// is another curve.
    pub(in crate::editor) fn given_reference(&self, curve: &ReferenceCurve) -> Arc<Reference> {
        let known = self.given.as_ref().map(ReferenceAnalysis::reference);
        let known = known.filter(|known| known.curve == *curve);
        known.cloned().unwrap_or_else(|| {
            let name = curve.form().label().to_lowercase();
            Arc::new(Reference::new(name, curve.clone()))
        })
    }

    fn fill(&mut self, plots: &mut PlotScene, source: Option<&PlotSource>, document: &Document) {
        let Some(source) = source else {
            return;
        };
        plots.part = source.part;
        self.fill_of(plots, source.id, source.kind);
        if let Some(Item::Curve(before)) = &source.before {
            let mut scene = PlotScene {
                part: source.part,
                ..PlotScene::default()
            };
            scene.fill(self.pane.ghost.analysis(before), source.kind);
            plots.before = Some(Box::new(scene));
        }
        for beside in &source.others {
            let mut scene = PlotScene::default();
            self.fill_of(&mut scene, beside.id, source.kind);
            if let Some(placed) = beside.placed {
                let is_signed = scene.planar && !is_of_torsion(source.kind);
                placed.place(&mut scene.series, scene.length, is_signed);
            }
            plots.others.push(OtherPlot {
                id: beside.id,
                series: scene.series,
            });
        }
        let Some((other, _)) = &source.compared else {
            return;
        };
        let mut scene = PlotScene::default();
        if let Some(other) = other {
            self.fill_of(&mut scene, *other, source.kind);
            plots.compared_name = document.name(*other).unwrap_or_default().to_owned();
        } else if let Some(analysis) = &mut self.given {
            scene.fill_reference(analysis, source.kind);
            plots.compared_name = format!("source: {}", analysis.reference().name);
        }
        plots.compared = Some(Box::new(scene));
    }

    /// Make the series of a curve or a reference.
    fn fill_of(&mut self, plots: &mut PlotScene, id: CurveId, kind: PlotKind) {
        if let Some(reference) = self.analyses.reference_mut(id) {
            plots.fill_reference(reference, kind);
        } else if let Some(analysis) = self.analyses.get_mut(id) {
            plots.fill(analysis, kind);
        }
    }
}

/// Whether a part of a plot can be looked at closely: the graph has no arc length, and strips show
/// vertices.
fn can_be_closer(kind: PlotKind) -> bool {
    match kind {
        PlotKind::Levels { plot, .. } => plot != LevelPlot::Logarithmic,
        PlotKind::Harmony => false,
    }
}

/// Whether a plot is that of the torsion or a level of it, which does not change with the direction.
fn is_of_torsion(kind: PlotKind) -> bool {
    matches!(
        kind,
        PlotKind::Levels {
            plot: LevelPlot::Torsion(_),
            ..
        }
    )
}

/// A number of the flow as it is shown: angles in degrees.
fn as_shown(flow: Flow, value: f64) -> f64 {
    match flow {
        Flow::Turns | Flow::TorsionAngles => value.to_degrees(),
        Flow::Legs | Flow::Curvatures => value,
    }
}

impl PlotScene {
    /// Take what series of every kind tell of their curve. Returns the scale of the curve.
    fn begin(&mut self, sampled: SampledCurve<'_>, kind: PlotKind) -> f64 {
        let scale = match kind {
            PlotKind::Levels { normalised, .. } => sampled.scale(normalised),
            PlotKind::Harmony => 1.0,
        };
        self.planar = sampled.samples.is_planar();
        self.length = sampled.samples.length();
        self.extent = if scale == 1.0 { self.length } else { 1.0 };
        scale
    }

    /// Make the series of a reference: of a list of points there is only the discrete curvature, and vertices
    /// have no flow.
    fn fill_reference(&mut self, reference: &mut ReferenceAnalysis, kind: PlotKind) {
        let scale = self.begin(reference.sampled(), kind);
        let PlotKind::Levels { plot, normalised } = kind else {
            return;
        };
        if reference.is_smooth() {
            if !self.fill_part(reference.sampled(), plot, normalised) {
                reference.append_levels(plot, normalised, &mut self.series);
            }
        } else if plot == LevelPlot::CURVATURE {
            let points = reference.points();
            points.append_curvatures_by_length(&mut self.discrete);
            self.scale_discrete(scale);
        }
    }

    /// Make the series of a curve.
    fn fill(&mut self, analysis: &mut CurveAnalysis, kind: PlotKind) {
        let scale = self.begin(analysis.sampled(), kind);
        match kind {
            PlotKind::Levels { plot, normalised } => {
                if plot == LevelPlot::CURVATURE {
                    let (part, dots) = (self.part, &mut self.discrete);
                    self.flank = scale * analysis.append_discrete_curvature(part, dots);
                    self.scale_discrete(scale);
                }
                if !self.fill_part(analysis.sampled(), plot, normalised) {
                    analysis.append_levels(plot, normalised, &mut self.series);
                }
            }
            PlotKind::Harmony => {
                for (flow, series) in Flow::ALL.into_iter().zip(&mut self.flow) {
                    if flow == Flow::TorsionAngles && self.planar {
                        continue;
                    }
                    analysis.float().append_flow(flow, series);
                    for point in series {
                        point.y = as_shown(flow, point.y);
                    }
                }
            }
        }
    }

    /// Make the series of the part that is looked at closely, if there is one. Returns whether it has.
    fn fill_part(&mut self, sampled: SampledCurve<'_>, plot: LevelPlot, normalised: bool) -> bool {
        let part = self.part;
        part.is_some_and(|part| sampled.append_part(plot, normalised, part, &mut self.series))
    }

    fn scale_discrete(&mut self, scale: f64) {
        for (_, at) in &mut self.discrete {
            *at = DVec2::new(at.x * scale, at.y / scale);
        }
    }

    /// Empty all series, and keep their room.
    fn clear(&mut self) {
        let mut empty = std::mem::take(self);
        empty.discrete.clear();
        empty.series.clear();
        empty.flow.iter_mut().for_each(Vec::clear);
        *self = Self {
            series: empty.series,
            discrete: empty.discrete,
            flow: empty.flow,
            ..Self::default()
        };
    }
}
