//! The proved features of a curve, as the list and the canvas show them.

use glam::{DVec2, DVec3};

use crate::analysis::{ReferenceAnalysis, SampledFeature, SampledKind};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::geometry::FloatPolygon;
use crate::geometry::ParametricCurve;
use crate::geometry::features::{ExtremumKind, Feature, Features, Trend, TrendPiece, Verdict};

/// The least distance of two marks in screen points: where few would touch, and where they would cover most
/// of the curve.
const MARK_SPACING: [f64; 2] = [9.0, 36.0];

/// So many marks never count as a crowd.
const FEW_MARKS: usize = 8;

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
    /// The curvature has different limits before and after a knot.
    CurvatureJump,
    /// Something may lie here that could not be counted.
    Undecided,
}

impl FeatureKind {
    /// The feature's name on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Inflection => "Inflection",
            Self::CurvatureMaximum => "Curvature maximum",
            Self::CurvatureMinimum => "Curvature minimum",
            Self::TorsionZero => "Torsion zero",
            Self::TorsionMaximum => "Torsion maximum",
            Self::TorsionMinimum => "Torsion minimum",
            Self::Cusp => "Cusp",
            Self::CurvatureJump => "Curvature jump",
            Self::Undecided => "Undecided",
        }
    }
}

/// One feature, as the list shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureRow {
    /// Its kind.
    pub kind: FeatureKind,
    /// The interval of u that holds it; of a reference the place of its own parameter t.
    pub u: [f64; 2],
    /// How many features the interval holds: 1 unless they are too close to tell apart.
    pub count: usize,
    /// Bounds of the curvature or torsion of an extremum.
    pub value: Option<[f64; 2]>,
    /// The undecided quantity, or a doubt about a cusp.
    pub remark: &'static str,
    /// The parameter in the middle of the interval, within the domain.
    pub middle: f64,
    /// The point there.
    pub point: DVec3,
}

impl FeatureRow {
    /// Whether the curve bends most or least at an extremum of the curvature: a maximum of negative curvature
    /// is flattest. `None` for other features, and where the sign is in doubt.
    pub fn bend(&self) -> Option<&'static str> {
        let is_maximum = match self.kind {
            FeatureKind::CurvatureMaximum => true,
            FeatureKind::CurvatureMinimum => false,
            _ => return None,
        };
        let [low, high] = self.value?;
        match (low >= 0.0, high <= 0.0) {
            (false, false) | (true, true) => None,
            (is_positive, _) if is_positive == is_maximum => Some("tightest"),
            _ => Some("flattest"),
        }
    }
}

/// The features of the active curve or reference.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureReport {
    /// Whether the features come from samples and are not proved.
    pub sampled: bool,
    /// Whether the curvature is proved to be monotone; undecided where features are sampled.
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
        self.rows.iter().filter(fits).map(|row| row.count).sum()
    }

    /// List the features of a reference that its samples show.
    pub fn of_samples(analysis: &ReferenceAnalysis) -> Self {
        let curve = &analysis.reference().curve;
        let row = |feature: &SampledFeature| {
            let t = curve.parameter(feature.u);
            let (kind, value) = match feature.kind {
                SampledKind::Inflection => (FeatureKind::Inflection, None),
                SampledKind::Maximum => (FeatureKind::CurvatureMaximum, Some(feature.curvature)),
                SampledKind::Minimum => (FeatureKind::CurvatureMinimum, Some(feature.curvature)),
                SampledKind::Cusp => (FeatureKind::Cusp, None),
                SampledKind::Jump => (FeatureKind::CurvatureJump, None),
            };
            FeatureRow {
                kind,
                u: [t, t],
                count: 1,
                value: value.map(|value| [value, value]),
                remark: "",
                middle: feature.u,
                point: curve.jet(feature.u).point,
            }
        };
        Self {
            sampled: true,
            monotone: Verdict::Undecided,
            constant: false,
            has_doubts: false,
            polyline: !analysis.is_smooth(),
            rows: analysis.features().iter().map(row).collect(),
        }
    }

    /// List the features of a polygon.
    pub fn of(features: &Features, polygon: &FloatPolygon) -> Self {
        let last = polygon.segments() as f64;
        let row = |kind, u: [f64; 2]| {
            let middle = 0.5 * (u[0] + u[1]);
            // On a periodic curve it may lie behind the joint.
            let middle = if middle > last { middle - last } else { middle };
            FeatureRow {
                kind,
                u,
                count: 1,
                value: None,
                remark: "",
                middle,
                point: polygon.point(middle),
            }
        };
        let mut rows: Vec<FeatureRow> = Vec::new();
        for (kind, roots) in [
            (FeatureKind::Inflection, &features.inflections),
            (FeatureKind::TorsionZero, &features.torsion_zeros),
        ] {
            rows.extend(roots.iter().map(|root| FeatureRow {
                count: root.count,
                ..row(kind, root.u)
            }));
        }
        let [maximum, minimum] = [ExtremumKind::Maximum, ExtremumKind::Minimum];
        for (kind, named, extrema) in [
            (
                FeatureKind::CurvatureMaximum,
                maximum,
                &features.curvature_extrema,
            ),
            (
                FeatureKind::CurvatureMinimum,
                minimum,
                &features.curvature_extrema,
            ),
            (
                FeatureKind::TorsionMaximum,
                maximum,
                &features.torsion_extrema,
            ),
            (
                FeatureKind::TorsionMinimum,
                minimum,
                &features.torsion_extrema,
            ),
        ] {
            let extrema = extrema.iter().filter(|extremum| extremum.kind == named);
            rows.extend(extrema.map(|extremum| FeatureRow {
                count: extremum.count,
                value: Some(extremum.value),
                ..row(kind, extremum.u)
            }));
        }
        rows.extend(features.cusps.iter().map(|cusp| FeatureRow {
            remark: if cusp.proved { "" } else { "cusp?" },
            ..row(FeatureKind::Cusp, cusp.u)
        }));
        rows.extend(features.undecided.iter().map(|doubt| FeatureRow {
            remark: doubtful(doubt.quantity),
            ..row(FeatureKind::Undecided, doubt.u)
        }));
        rows.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]));
        let mut trends = features.trends.iter();
        let is_constant = |piece: &TrendPiece| piece.trend == Trend::Constant;
        let mut doubts = features.undecided.iter();
        Self {
            sampled: false,
            monotone: features.monotone,
            constant: features.monotone == Verdict::Proved && trends.all(is_constant),
            has_doubts: doubts.any(|doubt| doubt.quantity == Feature::CurvatureExtremum),
            polyline: polygon.degree() == 1,
            rows,
        }
    }
}

/// Name what could not be counted.
fn doubtful(quantity: Feature) -> &'static str {
    match quantity {
        Feature::Inflection => "inflections?",
        Feature::CurvatureExtremum => "κ extrema?",
        Feature::TorsionZero => "τ zeros?",
        Feature::TorsionExtremum => "τ extrema?",
    }
}

/// A feature as it is marked on the canvas or in a plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureMark {
    /// Its kind.
    pub kind: FeatureKind,
    /// Where it is.
    pub at: DVec2,
    /// The parameter.
    pub u: f64,
}

/// Append the marks of features that are visible, as far as they do not crowd.
pub fn append_marks(
    report: &FeatureReport,
    orientation: &Orientation,
    view: &ViewBox,
    out: &mut Vec<FeatureMark>,
) {
    let marks = report.rows.iter().map(|row| FeatureMark {
        kind: row.kind,
        at: orientation.flatten(row.point),
        u: row.middle,
    });
    let is_visible =
        |mark: &FeatureMark| mark.at.cmpge(view.low).all() && mark.at.cmple(view.high).all();
    let visible = marks.filter(is_visible);
    let places: Vec<DVec2> = visible.clone().map(|mark| mark.at).collect();
    let apart = mark_spacing(&places, view.pixel);
    let mut kept: Option<DVec2> = None;
    for mark in visible {
        if kept.is_none_or(|kept| kept.distance(mark.at) >= apart) {
            kept = Some(mark.at);
            out.push(mark);
        }
    }
}

/// How far marks at these places stay apart, when a screen point is a `pixel` long.
fn mark_spacing(places: &[DVec2], pixel: f64) -> f64 {
    let [close, wide] = MARK_SPACING.map(|spacing| spacing * pixel);
    let lengths = places.array_windows().map(|[a, b]| a.distance(*b));
    let covered = close * places.len() as f64;
    let crowded = places.len() > FEW_MARKS && covered > 0.5 * lengths.sum::<f64>();
    if crowded { wide } else { close }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So many places along a line 600 points long.
    fn line(count: usize) -> Vec<DVec2> {
        let place = |index: usize| DVec2::new(600.0 * index as f64 / (count - 1) as f64, 0.0);
        (0..count).map(place).collect()
    }

    #[test]
    fn marks_that_would_hide_the_curve_stay_far_apart() {
        let [close, wide] = MARK_SPACING;
        assert_eq!(mark_spacing(&line(30), 1.0), close);
        assert_eq!(mark_spacing(&line(40), 1.0), wide);
        // Nearer, the same marks do not crowd.
        assert_eq!(mark_spacing(&line(40), 0.5), 0.5 * close);
        let few = [DVec2::ZERO; FEW_MARKS];
        assert_eq!(mark_spacing(&few, 1.0), close);
        assert_eq!(mark_spacing(&[], 1.0), close);
    }
}
