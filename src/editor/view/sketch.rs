//! Curves outside the document: earlier states, drawn faintly, and the curve that a click would make.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::CurveAnalysis;
use crate::document::Curve;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::outlines::Outlined;
use crate::editor::view::scene::Legs;

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

    /// Append the visible part of a curve and its float S-polygon, and of its closed one without the legs
    /// that lie on the float one's.
    pub fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        (curves, float): (&mut Vec<DVec2>, &mut Legs),
        clamped: Option<&mut Legs>,
    ) {
        self.analysis(curve);
        let Self { analysis, outlined } = self;
        let Some(analysis) = analysis else {
            return;
        };
        outlined.update(analysis, orientation);
        let sampled = analysis.sampled();
        outlined.curve.append_curve(sampled, view, curves);
        outlined
            .float
            .append_legs(analysis.float(), None, view, float);
        if let Some(clamped) = clamped {
            let covering = Some(outlined.float.seen(analysis.float()));
            let chain = analysis.clamped();
            let outlines = &outlined.clamped;
            outlines.append_legs(chain, covering.as_ref(), view, clamped);
        }
    }
}
