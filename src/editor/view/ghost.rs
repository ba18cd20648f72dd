//! A curve as it was, drawn faintly behind what it is now.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::CurveAnalysis;
use crate::document::Curve;
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::scene::Legs;

/// Remember what is known of a curve as it was, which changes rarely while it is drawn often.
#[derive(Debug, Default)]
pub struct Ghost {
    analysis: Option<CurveAnalysis>,
    curve: CurveOutlines,
    float: ChainOutlines,
}

impl Ghost {
    /// The analysis of a curve as it was.
    pub fn analysis(&mut self, curve: &Arc<Curve>) -> &mut CurveAnalysis {
        let known = self.analysis.take();
        let known = known.filter(|known| Arc::ptr_eq(known.curve(), curve));
        let analyse = || CurveAnalysis::new(curve.clone());
        self.analysis.insert(known.unwrap_or_else(analyse))
    }

    /// Append what is visible of a curve, and of its float S-polygon.
    pub fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        (curves, polygons): (&mut Vec<DVec2>, &mut Legs),
    ) {
        self.analysis(curve);
        let Some(analysis) = &self.analysis else {
            return;
        };
        self.curve.set_orientation(orientation);
        self.curve.update(analysis.sampled());
        self.curve.append_curve(analysis.sampled(), view, curves);
        self.float.set_orientation(orientation);
        self.float.update(analysis.float());
        self.float
            .append_legs(analysis.float(), None, view, polygons);
    }
}
