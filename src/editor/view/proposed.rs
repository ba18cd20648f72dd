//! The curve that a click would make, which the document does not have yet.

use std::sync::Arc;

use crate::analysis::CurveAnalysis;
use crate::document::Curve;
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::layers::{Layer, Layers};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::scene::ProposalScene;
use crate::geometry::FloatPolygon;

/// Remember what is known of the curve that a click would have made a frame ago: while the pointer
/// moves, only segments near its vertex change.
#[derive(Debug, Default)]
pub struct ProposedCurve {
    analysis: Option<CurveAnalysis>,
    curve: CurveOutlines,
    clamped: ChainOutlines,
    float: ChainOutlines,
}

impl ProposedCurve {
    /// Make the scene of a polygon, as far as it is visible.
    pub fn draw(
        &mut self,
        polygon: FloatPolygon,
        orientation: Orientation,
        layers: Layers,
        view: &ViewBox,
        scene: &mut ProposalScene,
    ) {
        let curve = Arc::new(Curve::new(String::new(), polygon));
        let analysis = match self.analysis.take() {
            Some(mut known) => {
                known.update(&curve);
                known
            }
            None => CurveAnalysis::new(curve),
        };
        self.curve.set_orientation(orientation);
        self.curve.update(analysis.sampled());
        let curve = &mut scene.curve;
        self.curve.append_curve(analysis.sampled(), view, curve);
        self.float.set_orientation(orientation);
        self.float.update(analysis.float());
        let float = &mut scene.float;
        self.float.append_legs(analysis.float(), None, view, float);
        if layers.shows(Layer::Clamped) {
            self.clamped.set_orientation(orientation);
            self.clamped.update(analysis.clamped());
            let clamped = &mut scene.clamped;
            let covering = Some(self.float.seen(analysis.float()));
            let chain = analysis.clamped();
            self.clamped
                .append_legs(chain, covering.as_ref(), view, clamped);
        }
        self.analysis = Some(analysis);
    }
}
