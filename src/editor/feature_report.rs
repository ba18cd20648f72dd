//! The proved features of the active curve: for the list, for the canvas, and to go to.

use glam::DVec2;

use super::Editor;
use super::layers::Layer;
use crate::analysis::{Bounds, CurveAnalysis, ViewBox};
use crate::geometry::features::{ExtremumKind, Features, Quantity, Trend, TrendPiece, Verdict};

/// How much of a segment is shown around a feature, on either side.
const SURROUNDINGS: f64 = 0.6;

/// Marks nearer together than this, in screen points, are thinned out.
const MARK_SPACING: f64 = 9.0;

/// A kind of feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// The curvature of a planar curve changes its sign.
    Inflection,
    /// The curvature is greatest.
    CurvatureMaximum,
    /// The curvature is least.
    CurvatureMinimum,
    /// The torsion changes its sign.
    TorsionZero,
    /// The torsion is greatest.
    TorsionMaximum,
    /// The torsion is least.
    TorsionMinimum,
    /// The tangent vanishes, or may vanish.
    Cusp,
    /// Something may lie here that could not be counted.
    Undecided,
}

impl FeatureKind {
    /// What the feature is called on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Inflection => "Inflection",
            Self::CurvatureMaximum => "Curvature maximum",
            Self::CurvatureMinimum => "Curvature minimum",
            Self::TorsionZero => "Torsion zero",
            Self::TorsionMaximum => "Torsion maximum",
            Self::TorsionMinimum => "Torsion minimum",
            Self::Cusp => "Cusp",
            Self::Undecided => "Undecided",
        }
    }
}

/// One feature, as the list shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureRow {
    /// What it is.
    pub kind: FeatureKind,
    /// The interval of u that holds it.
    pub u: [f64; 2],
    /// The curvature or torsion of an extremum.
    pub value: Option<f64>,
    /// What is not decided, or what is not proved of a cusp, in words.
    pub remark: &'static str,
}

impl FeatureRow {
    /// The middle of the interval.
    pub fn middle(&self) -> f64 {
        0.5 * (self.u[0] + self.u[1])
    }
}

/// The features of the active curve.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureReport {
    /// Whether the curvature is proved to be monotone.
    pub monotone: Verdict,
    /// Whether it is proved to be constant, as on a line or a circle.
    pub constant: bool,
    /// Whether there are pieces on which curvature extrema could not be counted.
    pub has_doubts: bool,
    /// Whether the curve is of degree 1: its corners have no curvature.
    pub polyline: bool,
    /// The features in the order of u.
    pub rows: Vec<FeatureRow>,
}

impl FeatureReport {
    /// How many features of a kind there are.
    pub fn count(&self, kinds: &[FeatureKind]) -> usize {
        let fits = |row: &&FeatureRow| kinds.contains(&row.kind);
        self.rows.iter().filter(fits).count()
    }

    fn of(features: &Features) -> Self {
        let plain = |kind| {
            move |u: &[f64; 2]| FeatureRow {
                kind,
                u: *u,
                value: None,
                remark: "",
            }
        };
        let mut rows: Vec<FeatureRow> = Vec::new();
        rows.extend(
            features
                .inflections
                .iter()
                .map(plain(FeatureKind::Inflection)),
        );
        rows.extend(
            features
                .torsion_zeros
                .iter()
                .map(plain(FeatureKind::TorsionZero)),
        );
        let extrema = [
            (
                &features.curvature_extrema,
                FeatureKind::CurvatureMaximum,
                FeatureKind::CurvatureMinimum,
            ),
            (
                &features.torsion_extrema,
                FeatureKind::TorsionMaximum,
                FeatureKind::TorsionMinimum,
            ),
        ];
        for (extrema, maximum, minimum) in extrema {
            rows.extend(extrema.iter().map(|extremum| FeatureRow {
                kind: match extremum.kind {
                    ExtremumKind::Maximum => maximum,
                    ExtremumKind::Minimum => minimum,
                },
                u: extremum.u,
                value: Some(extremum.value),
                remark: "",
            }));
        }
        rows.extend(features.cusps.iter().map(|cusp| FeatureRow {
            kind: FeatureKind::Cusp,
            u: cusp.u,
            value: None,
            remark: if cusp.proved { "" } else { "cusp?" },
        }));
        rows.extend(features.undecided.iter().map(|doubt| FeatureRow {
            kind: FeatureKind::Undecided,
            u: doubt.u,
            value: None,
            remark: match doubt.quantity {
                Quantity::Inflection => "inflections?",
                Quantity::CurvatureExtremum => "κ extrema?",
                Quantity::TorsionZero => "τ zeros?",
                Quantity::TorsionExtremum => "τ extrema?",
            },
        }));
        rows.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]));
        let mut trends = features.trends.iter();
        let is_constant = |piece: &TrendPiece| piece.trend == Trend::Constant;
        Self {
            monotone: features.monotone,
            constant: features.monotone == Verdict::Proved && trends.all(is_constant),
            has_doubts: features
                .undecided
                .iter()
                .any(|doubt| doubt.quantity == Quantity::CurvatureExtremum),
            polyline: false,
            rows,
        }
    }
}

/// A feature as it is marked on the canvas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureMark {
    /// What it is.
    pub kind: FeatureKind,
    /// Where it is.
    pub at: DVec2,
    /// The parameter.
    pub u: f64,
}

impl Editor {
    /// Go on proving the features of the active curve, and return them once all are known: of a
    /// long curve after some calls.
    pub fn features(&mut self) -> Option<FeatureReport> {
        self.analyses.update(self.history.document());
        let analysis = self.analyses.get(self.selection.active()?)?;
        let polyline = analysis.curve().polygon.degree() == 1;
        Some(FeatureReport {
            polyline,
            ..FeatureReport::of(analysis.features()?)
        })
    }

    /// The share of the active curve whose features are known.
    pub fn proof_progress(&self) -> Option<f64> {
        Some(
            self.analyses
                .peek(self.selection.active()?)?
                .proof_progress(),
        )
    }

    /// Show the surroundings of a parameter of the active curve, and the layer of its features.
    pub fn go_to(&mut self, u: f64) {
        let Some((_, curve)) = self.active_curve() else {
            return;
        };
        let last = curve.polygon.segments() as f64;
        let u = if curve.polygon.is_periodic() {
            u.rem_euclid(last)
        } else {
            u.clamp(0.0, last)
        };
        let jet = curve.polygon.jet(u);
        let reach = SURROUNDINGS * jet.speed();
        let at = self.viewport.flatten(jet.point);
        let mut bounds = Bounds::EMPTY;
        bounds.add(at - reach);
        bounds.add(at + reach);
        self.viewport = self.viewport.fitted(&bounds);
        self.layers.set(Layer::Features, true);
        self.layers.set(Layer::Curve, true);
    }

    /// The mark of a feature under a place on the canvas.
    pub(super) fn feature_mark(&self, place: DVec2, reach: f64) -> Option<FeatureMark> {
        let active = self.scene.curves.iter().find(|curve| curve.active)?;
        let distance = |mark: &&FeatureMark| self.viewport.to_screen(mark.at).distance(place);
        let near = active
            .features
            .iter()
            .filter(|mark| distance(mark) <= reach);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .copied()
    }
}

/// Append the marks of a curve's features that are visible, unless they crowd.
pub(super) fn append_marks(
    analysis: &mut CurveAnalysis,
    view: &ViewBox,
    out: &mut Vec<FeatureMark>,
) {
    let curve = analysis.curve().clone();
    let polygon = &curve.polygon;
    let eye = analysis.orientation();
    let last = polygon.segments() as f64;
    let mut kept: Option<DVec2> = None;
    let Some(features) = analysis.known_features() else {
        return;
    };
    for row in FeatureReport::of(features).rows {
        let middle = row.middle();
        let u = if middle > last { middle - last } else { middle };
        let at = eye.flatten(polygon.point(u));
        let is_visible = at.cmpge(view.low).all() && at.cmple(view.high).all();
        let apart = kept.is_none_or(|kept| kept.distance(at) >= MARK_SPACING * view.pixel);
        if is_visible && apart {
            kept = Some(at);
            out.push(FeatureMark {
                kind: row.kind,
                at,
                u,
            });
        }
    }
}
