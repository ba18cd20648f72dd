//! The text and the marks of what the pointer hovers.

use glam::DVec3;

use crate::analysis::{ReferenceAnalysis, SampledCurve};
use crate::document::CurveId;
use crate::editor::view::osculating_circle::OsculatingCircle;
use crate::editor::view::overlay::{Closed, Hovering, Overlay};
use crate::editor::view::scene::HoverScene;
use crate::editor::view::sight::Sight;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::fairing::least_change::{Dragged, Reach, magnification};
use crate::geometry::{coordinate, figure, radius_of, significant};

impl Sight<'_> {
    /// Find what the pointer hovers, on the canvas or in a panel.
    pub(in crate::editor) fn hover(self, overlay: &Overlay) -> Option<HoverScene> {
        if let Some(hover) = self.hover_from_panels().or_else(|| overlay.handle.clone()) {
            return Some(hover);
        }
        let place = self.shown.pointer?;
        let closed = match overlay.hovering {
            Hovering::Nothing => return None,
            Hovering::Dragged(vertex) => {
                let mut hover = self.vertex_hover(vertex);
                if let Some(HoverScene::Vertex { text, .. }) = &mut hover {
                    // The readout beside it tells what a drag does.
                    text.clear();
                }
                return hover;
            }
            Hovering::Document { closed } => closed,
        };
        if let Some(vertex) = self.vertex(place) {
            return self.vertex_hover(vertex);
        }
        if let Some(closed) = closed
            && let Some((id, index)) = self.clamped_vertex(place)
        {
            return self.clamped_hover(id, index, closed);
        }
        if let Some((id, feature)) = self.feature(place) {
            let mut hover = self.curve_hover(id, feature.middle);
            if let Some(HoverScene::Curve { text, .. }) = &mut hover {
                *text = format!("{}\n{text}", feature.kind.label());
            }
            return hover;
        }
        let hit = self.curve(place)?;
        self.curve_hover(hit.curve, hit.u)
    }

    fn hover_from_panels(self) -> Option<HoverScene> {
        let id = self.active()?;
        if let Some(index) = self.view.hovered.vertex {
            return self.vertex_hover((id, index));
        }
        let samples = self.view.analyses.sampled(id)?.samples;
        let u = samples.parameter_at_length(self.view.hovered.length?);
        self.curve_hover(id, u)
    }

    /// Write the coordinates of a point, a line each.
    fn coordinates(self, point: DVec3, in_space: bool) -> String {
        let written = |value| coordinate(value, self.viewport().pixel());
        let mut text = format!("x {}\ny {}", written(point.x), written(point.y));
        if in_space {
            text += &format!("\nz {}", written(point.z));
        }
        text
    }

    fn vertex_hover(self, (id, index): (CurveId, usize)) -> Option<HoverScene> {
        let curve = self.document().curve(id).filter(|curve| curve.visible)?;
        let vertex = *curve.polygon.vertices().get(index)?;
        let place = self.coordinates(vertex, vertex.z != 0.0);
        let mut text = format!("Vertex {index}\n{place}");
        if let Some(weights) = curve.polygon.weights() {
            text += &format!("\nw {}", figure(*weights.get(index)?));
        }
        if curve.locked_vertices.contains(index) {
            text += "\nLocked";
        }
        if self.active() != Some(id) {
            text = format!("{}\n{text}", curve.name);
        }
        Some(HoverScene::Vertex {
            at: self.viewport().flatten(vertex),
            point: vertex,
            text,
        })
    }

    fn clamped_hover(self, id: CurveId, index: usize, closed: Closed) -> Option<HoverScene> {
        let analysis = self.view.analyses.get(id)?;
        let vertex = *analysis.clamped().vertices().get(index)?;
        let place = self.coordinates(vertex, !analysis.is_planar());
        let mut text = format!("Closed vertex {index}\n{place}");
        let polygon = &analysis.curve().polygon;
        let times = match closed {
            Closed::Stay => polygon.clamped_vertex_amplification(index),
            Closed::Follow { span } => {
                let dragged = Dragged::Clamped(index, DVec3::ZERO);
                let locked: Vec<usize> = analysis.curve().locked_vertices.iter().collect();
                let reach = Reach {
                    span,
                    stiffness: 0.0,
                    locked: &locked,
                };
                magnification(polygon, &dragged, &reach).ok()
            }
        };
        if let Some(times) = times {
            text += &format!("\nfloat × {}", significant(times, 3));
        }
        Some(HoverScene::Handle {
            at: self.viewport().flatten(vertex),
            text,
        })
    }

    fn curve_hover(self, id: CurveId, u: f64) -> Option<HoverScene> {
        if !self.document().is_visible(id) {
            return None;
        }
        let SampledCurve {
            curve: shape,
            samples,
        } = self.view.analyses.sampled(id)?;
        let reference = self.view.analyses.reference(id);
        let is_smooth = reference.is_none_or(ReferenceAnalysis::is_smooth);
        let (planar, jet) = (samples.is_planar(), shape.jet(u));
        let curvature = jet.curvature_of(planar);
        let parameter = match reference {
            // The edge of a picture is no curve.
            Some(it) if it.reference().picture.is_some() => None,
            Some(it) => Some(format!("t {:.4}", it.reference().curve.parameter(u))),
            None => Some(format!("u {u:.4}")),
        };
        let place = self.coordinates(jet.point, !planar);
        let mut lines: Vec<String> = parameter.into_iter().chain([place]).collect();
        if is_smooth {
            let display = self.view.curvature_display;
            let unit = self.document().unit();
            if display.shows_curvature() {
                let per = unit.map_or(String::new(), |unit| format!(" /{}", unit.symbol()));
                lines.push(format!("κ {}{per}", figure(curvature)));
            }
            if display.shows_radius() {
                let radius = LengthUnit::behind(unit, radius_of(curvature, 7));
                lines.push(format!("R {radius}"));
            }
            let torsion = Some(jet.torsion()).filter(|torsion| !planar && torsion.is_finite());
            lines.extend(torsion.map(|torsion| format!("τ {}", figure(torsion))));
        }
        if self.active() != Some(id) {
            lines.splice(0..0, self.document().name(id).map(str::to_owned));
        }
        let text = lines.join("\n");
        let centre = jet.centre_of_curvature().filter(|_| is_smooth);
        let seen_as_it_is = planar && self.viewport().orientation.is_from_above();
        let circle = centre.filter(|_| !seen_as_it_is);
        let circle = circle.and_then(|_| OsculatingCircle::of_jet(&jet));
        let viewport = self.viewport();
        let reach = 4.0 * (viewport.size.x + viewport.size.y);
        Some(HoverScene::Curve {
            curve: id,
            u,
            curvature,
            at: self.viewport().flatten(jet.point),
            point: jet.point,
            centre: centre
                .filter(|_| seen_as_it_is)
                .map(|centre| self.viewport().flatten(centre)),
            circle: circle.map_or(Vec::new(), |circle| circle.chain_within(viewport, reach)),
            text,
        })
    }
}
