//! Proved features and harmony of the curves that an operation concerns, before and after it.

use std::f64::consts::PI;
use std::sync::Arc;

use serde::{Serialize, Serializer};

use super::error::OperationError;
use super::harmony_json;
use super::operands::Operands;
use super::outcome::Outcome;
use crate::document::{Curve, CurveId, Document};
use crate::geometry::features::{Feature, Features, Verdict};
use crate::geometry::harmony::Harmony;
use crate::geometry::polygon_figures::{FOLD, sharpest_turn};
use crate::geometry::{BezierPolygon, FloatPolygon, Progress, significant};

/// A bend that is so many times as sharp as all bends before is told.
const SHARPER: f64 = 1.5;

/// A polygon that folds is told if it turns by so much more than before, in radians.
const MORE_TURN: f64 = PI / 18.0;

/// A bend that is so many times as sharp is a cusp to the eye.
const CUSP: f64 = 100.0;

/// A curve may always bend as a circle of its size does: the curvature of that times its size.
const ROUND: f64 = 2.0;

/// Hold the features and the harmony of each curve that an operation concerns: those that were
/// chosen, and those that it changes, adds or removes.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureComparison {
    /// The curves before the operation.
    pub before: Vec<FeatureCounts>,
    /// The curves afterwards.
    pub after: Vec<FeatureCounts>,
}

/// Count the proved features of a curve, and hold its harmony.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FeatureCounts {
    /// The curve's name.
    pub name: String,
    /// Inflections of a planar curve.
    pub inflections: usize,
    /// Extrema of the curvature.
    pub curvature_extrema: usize,
    /// Zeros of the torsion.
    pub torsion_zeros: usize,
    /// Extrema of the torsion.
    pub torsion_extrema: usize,
    /// Cusps.
    pub cusps: usize,
    /// Places where there may be features that could not be counted.
    pub undecided: usize,
    /// The largest curvature, without its sign.
    pub largest_curvature: f64,
    /// The size of the curve.
    #[serde(skip)]
    size: f64,
    /// The largest angle by which its polygon turns at a vertex, in radians.
    #[serde(skip)]
    largest_turn: f64,
    /// Whether the curvature is monotone.
    #[serde(serialize_with = "verdict")]
    pub monotone: Verdict,
    /// The harmony of the curve and its polygon.
    #[serde(serialize_with = "harmony_json::serialize")]
    pub harmony: Harmony,
}

impl FeatureComparison {
    /// Prove the features, segment by segment; `None` if `progress` is cancelled meanwhile.
    pub fn prove(input: &Operands, outcome: &Outcome, progress: &Progress) -> Option<Self> {
        let after = outcome.after(input);
        let concerned = concerned(input, &after);
        let find = |document: &Document| -> Vec<Arc<Curve>> {
            let found = concerned.iter();
            found
                .filter_map(|id| document.curve(*id).cloned())
                .collect()
        };
        let [before, after] = [input.document(), &after].map(find);
        let mut proof = Proof {
            progress,
            done: 0,
            segments: segments(&before) + segments(&after),
            proved: Vec::new(),
        };
        Some(Self {
            before: proof.counts(&before)?,
            after: proof.counts(&after)?,
        })
    }

    /// Say that there are more inflections or curvature extrema than in the curves before, a bend that is much
    /// sharper, or a polygon that turns back.
    pub(super) fn remarks_on_more(&self) -> Vec<String> {
        let kinds = [
            ("Inflections", self.more(|it| it.inflections)),
            ("Zeros of the torsion", self.more(|it| it.torsion_zeros)),
            ("Curvature extrema", self.more(|it| it.curvature_extrema)),
        ];
        let told = kinds.into_iter().filter_map(|(kind, counts)| {
            let [before, now] = counts?;
            Some(format!("{kind}: {before} before, {now} now"))
        });
        let shapes = [self.remark_on_sharper(), self.remark_on_fold()];
        told.chain(shapes.into_iter().flatten()).collect()
    }

    /// Say that a polygon turns back, by more than before.
    fn remark_on_fold(&self) -> Option<String> {
        let turns = [&self.before, &self.after]
            .map(|curves| curves.iter().map(|it| it.largest_turn).reduce(f64::max));
        let [before, now] = [turns[0]?, turns[1]?];
        (now > FOLD && now > before + MORE_TURN).then(|| {
            let [before, now] = [before, now].map(|turn| turn.to_degrees().round());
            format!("The polygon turns back by {now}° at a vertex, before by {before}° at most")
        })
    }

    /// Say that the curves have a much sharper bend than before.
    fn remark_on_sharper(&self) -> Option<String> {
        let [before, now] = [&self.before, &self.after].map(|curves| {
            let largest = curves.iter().map(|it| it.largest_curvature);
            largest.fold(0.0, f64::max)
        });
        let least = self.before.iter().map(|it| ROUND / it.size);
        let least = least.reduce(f64::max)?;
        (now > SHARPER * before.max(least)).then(|| {
            let [before, now] = [before, now].map(|curvature| match curvature {
                0.0 => "∞".to_owned(),
                _ => significant(1.0 / curvature, 3),
            });
            format!("Smallest radius: {before} before, {now} now")
        })
    }

    /// A count before and now, if there was a curve and it has grown. Curves with another name and as many as one before
    /// are its copies.
    fn more(&self, of: fn(&FeatureCounts) -> usize) -> Option<[usize; 2]> {
        let is_new = |it: &&FeatureCounts| !self.before.iter().any(|own| own.name == it.name);
        let is_like_one = |it: &&FeatureCounts| self.before.iter().any(|own| of(own) == of(it));
        let copies = self.after.iter().filter(is_new).filter(is_like_one);
        let copied: usize = copies.map(of).sum();
        let [before, now] =
            [&self.before, &self.after].map(|curves| curves.iter().map(of).sum::<usize>());
        let now = now - copied;
        (!self.before.is_empty() && now > before).then_some([before, now])
    }
}

/// Prove the features of a curve before and after a change.
///
/// # Errors
/// [`OperationError::Cancelled`].
pub(super) fn proved(
    polygons: [&FloatPolygon; 2],
    progress: &Progress,
) -> Result<[Features; 2], OperationError> {
    let [before, after] =
        polygons.map(|polygon| Features::proved(polygon, |_| !progress.is_cancelled()));
    match (before, after) {
        (Some(before), Some(after)) => Ok([before, after]),
        _ => Err(OperationError::Cancelled),
    }
}

/// Say that a curve that took another's place has lost inflections, in space zeros of the torsion.
pub(super) fn remark_on_lost_inflections(planar: bool, features: &[Features; 2]) -> Option<String> {
    let [was, now] = features
        .each_ref()
        .map(|features| features.count(Feature::Inflection) + features.count(Feature::TorsionZero));
    let kind = match planar {
        true => "Inflections",
        false => "Zeros of the torsion",
    };
    (now < was).then(|| format!("{kind}: {was} before, {now} now"))
}

/// Whether a curve that took another's place bends so sharply somewhere that it seems to have a cusp there.
pub(super) fn gains_cusp([before, after]: [&FloatPolygon; 2], features: &[Features; 2]) -> bool {
    let least = ROUND / BezierPolygon::from_float(before).size();
    let before = features[0].largest_curvature(before).max(least);
    before.is_finite() && features[1].largest_curvature(after) > CUSP * before
}

impl FeatureCounts {
    fn of(curve: &Curve, (features, harmony): &(Features, Harmony)) -> Self {
        let cusps = features.cusps.iter().filter(|cusp| cusp.proved).count();
        Self {
            name: curve.name.clone(),
            inflections: features.count(Feature::Inflection),
            curvature_extrema: features.count(Feature::CurvatureExtremum),
            torsion_zeros: features.count(Feature::TorsionZero),
            torsion_extrema: features.count(Feature::TorsionExtremum),
            cusps,
            undecided: features.undecided.len() + features.cusps.len() - cusps,
            largest_curvature: features.largest_curvature(&curve.polygon),
            size: BezierPolygon::from_float(&curve.polygon).size(),
            largest_turn: sharpest_turn(&curve.polygon).map_or(0.0, |(_, turn)| turn),
            monotone: features.monotone,
            harmony: harmony.clone(),
        }
    }
}

/// Write a verdict as a word.
fn verdict<S: Serializer>(verdict: &Verdict, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match verdict {
        Verdict::Proved => "proved",
        Verdict::Disproved => "disproved",
        Verdict::Undecided => "undecided",
    })
}

/// List the curves that were chosen, then those whose polygon differs, in the documents' order.
fn concerned(input: &Operands, after: &Document) -> Vec<CurveId> {
    let before = input.document();
    let polygon = |document: &Document, id| document.curve(id).map(|curve| curve.polygon.clone());
    let differs = |id: &CurveId| match (before.curve(*id), after.curve(*id)) {
        (Some(a), Some(b)) if Arc::ptr_eq(a, b) => false,
        _ => polygon(before, *id) != polygon(after, *id),
    };
    let mut concerned: Vec<CurveId> = input.curves().iter().map(|(id, _)| *id).collect();
    for id in before.ids().chain(after.ids()) {
        if differs(&id) && !concerned.contains(&id) {
            concerned.push(id);
        }
    }
    concerned
}

fn segments(curves: &[Arc<Curve>]) -> usize {
    curves.iter().map(|curve| curve.polygon.segments()).sum()
}

/// The proofs of some curves, one after the other.
struct Proof<'a> {
    progress: &'a Progress,
    /// How many segments are proved, of how many.
    done: usize,
    segments: usize,
    /// What is proved: a curve that an operation leaves as it is needs no second proof.
    proved: Vec<(FloatPolygon, (Features, Harmony))>,
}

impl Proof<'_> {
    fn counts(&mut self, curves: &[Arc<Curve>]) -> Option<Vec<FeatureCounts>> {
        let counts = curves.iter();
        let counts = counts.map(|curve| {
            let known = self.known(&curve.polygon)?;
            Some(FeatureCounts::of(curve, known))
        });
        counts.collect()
    }

    fn known(&mut self, polygon: &FloatPolygon) -> Option<&(Features, Harmony)> {
        let known = self.proved.iter().position(|(known, _)| known == polygon);
        let index = match known {
            Some(index) => {
                self.advance(polygon.segments());
                index
            }
            None => {
                let proof = self.proof(polygon)?;
                self.proved.push((polygon.clone(), proof));
                self.proved.len() - 1
            }
        };
        self.proved.get(index).map(|(_, known)| known)
    }

    fn proof(&mut self, polygon: &FloatPolygon) -> Option<(Features, Harmony)> {
        let features = Features::proved(polygon, |_| {
            self.advance(1);
            !self.progress.is_cancelled()
        })?;
        let harmony = Harmony::of(polygon, &features);
        Some((features, harmony))
    }

    fn advance(&mut self, segments: usize) {
        self.done += segments;
        self.progress
            .set_done(self.done as f64 / self.segments as f64);
    }
}
