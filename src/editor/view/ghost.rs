//! A curve as it was, drawn faintly behind what it is now.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::{CurveSamples, SampledCurve};
use crate::document::Curve;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;

/// Remember the samples of a curve as it was, which changes rarely while it is drawn often.
#[derive(Debug, Default)]
pub struct Ghost {
    sampled: Option<(Arc<Curve>, CurveSamples)>,
    outlines: CurveOutlines,
}

impl Ghost {
    /// Append what is visible of a curve.
    pub fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
    ) {
        self.sampled
            .take_if(|(known, _)| !Arc::ptr_eq(known, curve));
        let (_, samples) = self
            .sampled
            .get_or_insert_with(|| (curve.clone(), CurveSamples::new(&curve.polygon)));
        let sampled = SampledCurve {
            curve: &curve.polygon,
            samples,
        };
        self.outlines.set_orientation(orientation);
        self.outlines.update(sampled);
        self.outlines.append_curve(sampled, view, out);
    }
}
