//! The contents of the plot under the canvas, ready to paint.

use glam::DVec2;

use crate::analysis::{Flow, Item, LevelPlot};
use crate::document::CurveId;
use crate::editor::view::curve_outlines::PieceTrend;
use crate::editor::view::feature_report::FeatureMark;
use crate::editor::view::plot_chain::{Beside, OtherPlot};

/// The kind of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotKind {
    /// A level of curvature or torsion, or the logarithmic graph. The curvature itself comes with the
    /// polygon's discrete curvature.
    Levels {
        /// Which of them.
        plot: LevelPlot,
        /// Whether it is that of the curve scaled to length 1.
        normalised: bool,
    },
    /// The flow of the float S-polygon's vertices.
    Harmony,
}

/// The plot of the active curve that is shown; series of others are empty.
#[derive(Clone, Debug, Default)]
pub struct PlotScene {
    /// Whether curvature is signed.
    pub planar: bool,
    /// The plot of levels; NaN points are gaps.
    pub series: Vec<DVec2>,
    /// The polygon's discrete curvature at its vertices, over arc length, by vertex number.
    /// Vertices that lie beyond the curve's ends stand evenly spaced in a flank beside either.
    pub discrete: Vec<(usize, DVec2)>,
    /// How wide the flank beside either end is; 0 if there is none.
    pub flank: f64,
    /// The sequences of the flow over the vertices' numbers, in the order of [`Flow::ALL`], angles
    /// in degrees; what belongs to a leg stands where it begins. The last is empty in the plane.
    pub flow: [Vec<DVec2>; Flow::ALL.len()],
    /// The vertex of each where the sequence is least even, with the value there.
    pub worst: [Option<DVec2>; Flow::ALL.len()],
    /// The series of the curve or reference to compare with.
    pub compared: Option<Box<PlotScene>>,
    /// The plots of the other selected curves and references.
    pub others: Vec<OtherPlot>,
    /// The part of the curve, between two arc lengths, that is looked at closely and that the series
    /// are of; `None` where they are of the whole curve.
    pub part: Option<[f64; 2]>,
    /// The name of the curve or reference to compare with.
    pub compared_name: String,
    /// The features that belong to the plot, in the order of u: they are at their arc lengths, as high as the
    /// curvature or torsion there, which is not finite at a cusp.
    pub features: Vec<FeatureMark>,
    /// Where the curvature rises, falls, or may do either, as far as it is proved: in the plot of
    /// the curvature.
    pub bands: Vec<PlotBand>,
    /// The parts of the curve that the operation at hand has made to join it, along the plot's axis.
    pub joints: Vec<[f64; 2]>,
    /// The arc length of the whole curve.
    pub length: f64,
    /// The arc length as the plot shows it: 1 of a curve that is scaled to length 1.
    pub extent: f64,
    /// The place on the series that is hovered on the canvas.
    pub hovered: Option<DVec2>,
    /// The vertex that is hovered on the canvas.
    pub hovered_vertex: Option<usize>,
    /// The series of the curve as it was, where that is shown too.
    pub before: Option<Box<PlotScene>>,
}

/// A part of a curve, by arc length, on which its curvature has one trend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotBand {
    /// The trend of the curvature on it.
    pub trend: PieceTrend,
    /// Where the part begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl PlotScene {
    /// The arc lengths between which there are curves: those of the active one, and of its chain.
    pub fn reach(&self) -> [f64; 2] {
        let all = self.others.iter().flat_map(|other| &other.series);
        let all = all.map(|point| point.x).filter(|x| x.is_finite());
        all.fold([0.0, self.extent], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    }
}

impl PlotKind {
    /// The curvature over arc length.
    pub const CURVATURE: Self = Self::Levels {
        plot: LevelPlot::CURVATURE,
        normalised: false,
    };
}

/// The inputs of a plot's series.
#[derive(Debug, PartialEq)]
pub struct PlotSource {
    /// The kind of the plot.
    pub kind: PlotKind,
    /// Of which curve or reference.
    pub id: CurveId,
    /// The curve or the reference as it is.
    pub item: Item,
    /// The curve as it was.
    pub before: Option<Item>,
    /// What it is compared with: a curve or a reference of the document, or without an id the reference that an
    /// operation was given.
    pub compared: Option<(Option<CurveId>, Item)>,
    /// The other selected curves and references, those of a chain at their places.
    pub others: Vec<Beside>,
    /// The part that is looked at closely.
    pub part: Option<[f64; 2]>,
}

/// The inputs of a plot's marks, beside those of its series.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkSource {
    /// Whether features are known and shown.
    pub features: bool,
    /// The parameters between which the curve was joined.
    pub joint: Option<[f64; 2]>,
}
