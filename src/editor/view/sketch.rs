//! Curves outside the document: earlier states, drawn faintly, and the curve that a click would make.

use std::sync::Arc;

use crate::analysis::CurveAnalysis;
use crate::document::Curve;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::outlines::Outlined;
use crate::editor::view::scene::CurveScene;

/// Keep the analysis and the outlines of a curve from frame to frame, so that only changes cost time.
#[derive(Debug, Default)]
pub struct Sketch {
    analysis: Option<CurveAnalysis>,
    outlined: Outlined,
}

impl Sketch {
    /// Analyse a curve.
    pub fn analysis(&mut self, curve: &Arc<Curve>) -> &mut CurveAnalysis {
        let analysis = match self.analysis.take() {
            Some(mut known) => {
                known.update(curve);
                known
            }
            None => CurveAnalysis::new(curve.clone()),
        };
        self.analysis.insert(analysis)
    }

    /// Append the visible part of a curve and its float S-polygon, and if wanted of its closed one, without the legs
    /// that lie on the float one's.
    pub fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        scene: &mut CurveScene,
        clamped: bool,
    ) {
        self.analysis(curve);
        let Self { analysis, outlined } = self;
        let Some(analysis) = analysis else {
            return;
        };
        outlined.update(analysis, orientation);
        let float = analysis.float();
        outlined
            .curve
            .append_curve(analysis.sampled(), view, &mut scene.curve);
        outlined
            .float
            .append_legs(float, None, view, &mut scene.float);
        if clamped {
            let covering = Some(outlined.float.seen(float));
            let (outlines, chain) = (&outlined.clamped, analysis.clamped());
            outlines.append_legs(chain, covering.as_ref(), view, &mut scene.clamped);
        }
    }
}
