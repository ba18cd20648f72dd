//! The analysis of one reference: samples, plots and sampled features.

use std::cell::OnceCell;
use std::sync::Arc;

use glam::DVec2;

use super::curve_samples::{CurveSamples, SampledCurve};
use super::level_series::{LevelPlot, LevelSeries};
use super::sampled_features::{SampledFeature, sampled_features};
use super::vertex_chain::VertexChain;
use crate::document::Reference;
use crate::geometry::ParametricCurve;
use crate::geometry::references::{Placement, ReferenceForm};

/// The samples of a reference, up to twice as many: fewer than of a curve, since each may take an integral. Straight
/// lines have the fewest that there are.
const SAMPLES: usize = 768;

/// Hold the samples of a reference, its plots, and its features as far as samples tell them.
#[derive(Debug)]
pub struct ReferenceAnalysis {
    reference: Arc<Reference>,
    /// The samples of the curve where its formula puts it.
    unplaced: Arc<CurveSamples>,
    /// The samples where it is placed; the same where that is there.
    samples: Arc<CurveSamples>,
    levels: LevelSeries,
    features: OnceCell<Vec<SampledFeature>>,
    /// The points of a list, where they are placed.
    points: VertexChain,
}

impl ReferenceAnalysis {
    /// Analyse a reference.
    pub fn new(reference: Arc<Reference>) -> Self {
        let unplaced = reference.curve.clone().placed(Placement::default());
        let is_straight = matches!(reference.curve.form(), ReferenceForm::Points(_));
        let count = if is_straight { 0 } else { SAMPLES };
        let mut samples = CurveSamples::with_about(count, &unplaced);
        if reference.curve.form().may_leap() {
            samples.mark_leaps(&unplaced);
        }
        samples.free_room();
        Self::of_samples(reference, Arc::new(samples))
    }

    /// Analyse a reference whose curve is sampled already.
    fn of_samples(reference: Arc<Reference>, unplaced: Arc<CurveSamples>) -> Self {
        let mut points = VertexChain::default();
        points.update(&reference.points().unwrap_or_default(), false);
        let placement = reference.curve.placement();
        let samples = match *placement == Placement::default() {
            true => unplaced.clone(),
            false => Arc::new(unplaced.placed(placement, reference.curve.is_planar())),
        };
        Self {
            samples,
            unplaced,
            levels: LevelSeries::default(),
            features: OnceCell::new(),
            points,
            reference,
        }
    }

    /// Bring the analysis up to date with the reference; it is sampled again only if its form or its
    /// interval changed.
    pub fn update(&mut self, reference: &Arc<Reference>) {
        let (old, new) = (&self.reference.curve, &reference.curve);
        if old == new {
            self.reference = reference.clone();
        } else if (old.form(), old.interval()) == (new.form(), new.interval()) {
            *self = Self::of_samples(reference.clone(), self.unplaced.clone());
        } else {
            *self = Self::new(reference.clone());
        }
    }

    /// The reference as it was last analysed.
    pub fn reference(&self) -> &Arc<Reference> {
        &self.reference
    }

    /// The reference's curve with its samples; a list of points is sampled as a polyline.
    pub fn sampled(&self) -> SampledCurve<'_> {
        SampledCurve {
            curve: &self.reference.curve,
            samples: &self.samples,
        }
    }

    /// The points of a list, where they are placed; none of a curve.
    pub fn points(&self) -> &VertexChain {
        &self.points
    }

    /// Whether it is a curve that has a curvature everywhere; a list of points is none.
    pub fn is_smooth(&self) -> bool {
        self.reference.curve.form().is_smooth()
    }

    /// Whether it is a list of single points, which no lines join.
    pub fn has_points_apart(&self) -> bool {
        let form = self.reference.curve.form();
        matches!(form, ReferenceForm::Points(list) if list.is_apart())
    }

    /// Append a plot of the whole curve: see [`LevelSeries::append`].
    pub fn append_levels(&mut self, plot: LevelPlot, normalised: bool, out: &mut Vec<DVec2>) {
        let (curve, samples) = (&self.reference.curve, &self.samples);
        let sampled = SampledCurve { curve, samples };
        self.levels.append(sampled, plot, normalised, out);
    }

    /// List the features that samples show, in the order of u. What lies between two samples
    /// may be missed: nothing is proved. A list of points has none.
    pub fn features(&self) -> &[SampledFeature] {
        let find = || match self.is_smooth() {
            true => sampled_features(self.sampled()),
            false => Vec::new(),
        };
        self.features.get_or_init(find)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::{DQuat, DVec3};

    use super::*;
    use crate::analysis::SampledKind;
    use crate::geometry::references::{Nurbs, ReferenceCurve, ReferenceForm};

    /// Roundings of a placement, in units of what is placed.
    const ROUNDING: f64 = 1e-13;

    #[test]
    fn what_is_placed_anew_has_the_samples_of_the_placed_curve() {
        let tilted = DQuat::from_xyzw(0.1, -0.4, 0.2, 0.7).normalize();
        let turned_over = DQuat::from_rotation_x(PI);
        let exactly_over = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
        for text in [
            "clothoid:from=-2,to=1.5",
            "conical-spiral",
            "circle:radius=3",
        ] {
            let curve = ReferenceCurve::from_text(text).unwrap();
            let mut analysis = ReferenceAnalysis::new(Arc::new(Reference::new("a", curve.clone())));
            for rotation in [
                DQuat::from_rotation_z(0.7),
                tilted,
                turned_over,
                exactly_over,
                DQuat::IDENTITY,
            ] {
                let placement = Placement::new(rotation, 2.5, DVec3::new(3.0, -1.0, 0.0)).unwrap();
                let placed = curve.clone().placed(placement);
                analysis.update(&Arc::new(Reference::new("a", placed.clone())));
                let expected = CurveSamples::with_about(SAMPLES, &placed);
                let found = analysis.sampled().samples;
                assert_eq!(found.is_planar(), expected.is_planar(), "{text} {rotation}");
                let length = expected.length();
                assert!((found.length() - length).abs() <= ROUNDING * length);
                for (a, b) in found.all().iter().zip(expected.all()) {
                    assert!(
                        a.point.distance(b.point) <= ROUNDING * length,
                        "{text}: {a:?} {b:?}"
                    );
                    let largest = b.curvature.abs().max(1.0 / length);
                    assert!(
                        (a.curvature - b.curvature).abs() <= 1e-9 * largest,
                        "{text}: {a:?} {b:?}"
                    );
                    // Where the curvature is 0 a curve in space has no normal.
                    if b.curvature.abs() * length > 1e-6 {
                        assert!(a.normal.distance(b.normal) <= 1e-6, "{text}: {a:?} {b:?}");
                    }
                }
            }
        }
    }

    fn analysed(text: &str) -> ReferenceAnalysis {
        let curve = ReferenceCurve::from_text(text).unwrap();
        ReferenceAnalysis::new(Arc::new(Reference::new("a", curve)))
    }

    #[test]
    fn features_are_where_exact_derivatives_put_them_and_cusps_are_none_of_them() {
        use SampledKind::{Cusp, Inflection, Maximum, Minimum};
        for (text, expected) in [
            ("formula:x=t;y=(t-1.5)^2;from=0;to=4", &[(Maximum, 1.5)][..]),
            (
                "formula:x=t;y=t^3;from=-1;to=0.2",
                &[(Minimum, -(1.0_f64 / 45.0).powf(0.25)), (Inflection, 0.0)],
            ),
            ("formula:x=t^2;y=t^3;from=-1;to=1.3", &[(Cusp, 0.0)]),
            (
                "ellipse:a=3,b=1,from=0.5,to=4",
                &[(Minimum, 0.5 * PI), (Maximum, PI)],
            ),
        ] {
            let analysis = analysed(text);
            let curve = &analysis.reference().curve;
            let features = analysis.features().iter();
            let found: Vec<(SampledKind, f64)> = features
                .map(|it| (it.kind, curve.parameter(it.u)))
                .collect();
            assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
            for ((kind, t), (expected, place)) in found.iter().zip(expected) {
                assert_eq!(kind, expected, "{text}");
                assert!((t - place).abs() < 1e-12, "{text}: {t} {place}");
            }
        }
    }

    #[test]
    fn a_jump_of_the_curvature_at_a_knot_is_no_extremum() {
        use SampledKind::{Inflection, Jump};
        for (last, expected) in [
            ([2.0, 4.0], &[Jump][..]),
            ([3.0, 1.0], &[Inflection, Jump]),
            // Both halves of this one mirror each other: nothing jumps, and the curvature is greatest in the middle.
            ([2.0, 2.0], &[SampledKind::Maximum]),
        ] {
            let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], last];
            let points = points.map(|[x, y]| DVec3::new(x, y, 0.0));
            let knots = [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0];
            let nurbs = Nurbs::new(2, knots, points, None, false).expect("a spline");
            let curve = ReferenceCurve::of(ReferenceForm::Nurbs(nurbs)).expect("a curve");
            let analysis = ReferenceAnalysis::new(Arc::new(Reference::new("a", curve)));
            let features = analysis.features();
            let kinds: Vec<SampledKind> = features.iter().map(|it| it.kind).collect();
            assert_eq!(kinds, expected);
            assert!(features.iter().all(|it| (it.u - 1.0).abs() < 1e-12));
        }
    }

    #[test]
    fn a_closed_curve_has_no_extremum_less_at_its_seam() {
        for (text, expected) in [
            ("ellipse:a=3,b=1", 4),
            ("ellipse:a=3,b=1,from=0.5,to=6.783185307179586", 4),
            (
                "ellipse:a=1,b=3,from=1.5707963267948966,to=7.853981633974483",
                4,
            ),
            ("circle:radius=2", 0),
            // An open one keeps none at its ends.
            ("ellipse:a=3,b=1,from=0,to=3.141592653589793", 1),
            ("ellipse:a=3,b=1,from=0,to=6.2", 3),
        ] {
            let found = analysed(text).features().to_vec();
            assert_eq!(found.len(), expected, "{text}: {found:?}");
            assert!(found.is_sorted_by(|a, b| a.u < b.u), "{text}: {found:?}");
        }
    }

    #[test]
    fn the_seam_of_a_closed_spline_does_not_matter() {
        let count = 12;
        let corner = |index: usize| {
            let angle = std::f64::consts::TAU * (index % count) as f64 / count as f64;
            let radius = 10.0 + (3.0 * angle).cos();
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
        };
        for degree in [3, 5] {
            let counts: Vec<usize> = (0..count)
                .map(|seam| {
                    let points: Vec<DVec3> = (0..count + degree)
                        .map(|index| corner(seam + index))
                        .collect();
                    let knots: Vec<f64> = (0..count + 2 * degree + 1)
                        .map(|knot| knot as f64)
                        .collect();
                    let nurbs = Nurbs::new(degree, knots, points, None, true).expect("a spline");
                    let curve = ReferenceCurve::of(ReferenceForm::Nurbs(nurbs)).expect("a curve");
                    let analysis = ReferenceAnalysis::new(Arc::new(Reference::new("a", curve)));
                    analysis.features().len()
                })
                .collect();
            // Three bumps: a largest and a least curvature each, and two inflections each where they are hollow.
            assert!(
                counts.iter().all(|it| *it == counts[0] && it % 2 == 0),
                "{counts:?}"
            );
            assert!(counts[0] >= 6, "{counts:?}");
        }
    }

    #[test]
    fn the_far_ways_to_a_pole_do_not_squeeze_plots() {
        let analysis = analysed("formula:x=t;y=1/t;from=-1;to=1.1");
        let samples = analysis.sampled().samples;
        assert!(!samples.is_continuous());
        // Up to where the curve is about 16 times as long as elsewhere: a few units, not thousands.
        assert!(
            (1.0..40.0).contains(&samples.length()),
            "{}",
            samples.length()
        );
        assert!(analysed("circle").sampled().samples.is_continuous());
    }
}
