//! Two curves that meet, but for a small corner and gap, or that a blend connects, made one float polygon within a
//! tolerance.
//!
//! The engines that fit points with a wished number of curvature extrema fit both curves at once: the result has
//! those of both, and at most two more at the joint. A corner and a gap are spread over as much of both curves as the
//! tolerance allows, because few extrema come first. Where the tolerance is missed, the nearest curve tells which one
//! is possible.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::blending::blend;
use super::fitting::{FitRequest, fit_points};
use crate::geometry::distance::{DistanceError, MeasuredDeviation};
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::error::PolygonError;
use crate::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use crate::geometry::features::{Feature, Features};
use crate::geometry::fitting::{Extrema, FitError, PlaneFit, fit_plane};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::joint::{Joint, SMOOTH};
use crate::geometry::nearest::refined_parameter;
use crate::geometry::progress::Progress;
use crate::geometry::wording::significant;

/// The largest angle between the tangents of curves that are merged, in radians: 15°. Above it one curve with few
/// extrema leaves both by more than a designer takes for the same shape.
const BENT: f64 = 15.0 * PI / 180.0;

/// The largest gap between curves that are merged, by the size of the larger one.
const GAP: f64 = 0.05;

/// The samples of a segment that the merged curve is near to, and those at least of a whole curve that is blended: a fit
/// has at most half as many vertices. Curves that are merged have no more, as a dense short one would bend the joint.
const SAMPLES: usize = 6;
const LEAST_SAMPLES: usize = 36;

/// The samples of a segment by which places of the curves are followed along the merged one.
const TRACKED: usize = 16;

/// How far ahead of the place before a place is looked for, in segments.
const AHEAD: f64 = 2.0;

/// The most extrema that a joint may add: where curvature jumps, it must rise and fall there.
const ADDED: usize = 2;

/// A jump of the curvature is none if, times the square of the size, it is below so many tolerances: the curve then
/// gets over it along all of its length.
const ABSORBED: f64 = 16.0;

/// The share of the tolerance that samples must keep, so that the curve between them does too.
pub(super) const KEPT: f64 = 0.9;

/// The same in space, where both ends are corrected afterwards.
const KEPT_IN_SPACE: f64 = 0.5;

/// The most vertices, by those of both curves, and how many a blend or a closed curve may always take.
pub(super) const MOST: usize = 2;
pub(super) const SMALLEST: usize = 60;

/// The least and the most samples of a blend.
const BLEND_SAMPLES: [usize; 2] = [2 * SAMPLES, 200];

/// The share of the time that is left for each number of extrema.
const SHARE: f64 = 0.5;

/// Two curves that became one.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// Where points of the two curves are on it.
    pub tracks: [Track; 2],
    /// The largest deviation from the two curves, both ways.
    pub deviation: f64,
    /// Whether that is a bound.
    pub bounded: bool,
    /// The curvature extrema of both curves together, and of the merged one.
    pub extrema: [usize; 2],
    /// The inflections of a curve with a blend beyond those of both curves and the blend.
    pub waves: usize,
}

impl Merged {
    /// The same with another polygon near it, measured and counted anew.
    ///
    /// # Errors
    /// [`MergeError::Cancelled`].
    pub fn with_polygon(
        self,
        parts: [&FloatPolygon; 2],
        polygon: FloatPolygon,
        progress: &Progress,
    ) -> Result<Self, MergeError> {
        let [extrema, _] = counts_of([&polygon], progress)?;
        let merged = measured(parts, polygon, [self.extrema[0], extrema], progress);
        merged.map_err(|_| MergeError::Cancelled)
    }
}

/// Where the points of a curve are on another one that runs along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The parameters of the other curve at even parameters of this one.
    places: Vec<f64>,
}

/// Why two curves are not merged.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MergeError {
    /// The ends are too far apart.
    #[error(
        "the ends are {} apart, and at most {}, {} % of the size, is merged: bridge the gap",
        significant(*.distance, 3),
        significant(*.most, 3),
        100.0 * GAP
    )]
    Apart {
        /// Their distance.
        distance: f64,
        /// The largest gap that is merged.
        most: f64,
    },
    /// The ends meet at a corner.
    #[error("{}: choose {}", corner_text(*.angle, *.gap), match .gap {
        Some(_) => "Bridge",
        None => "Chain, which keeps both curves",
    })]
    Corner {
        /// The angle between the tangents, in radians.
        angle: f64,
        /// The distance of the ends, if they are apart.
        gap: Option<f64>,
    },
    /// No curve was found.
    #[error("no curve with as few curvature extrema was found: choose Chain")]
    NotFound,
    /// The ends leave no room for a blend, or have no direction.
    #[error("no blend lies between ends that meet or have no direction: choose Merge or Chain")]
    NoBlend,
    /// The computation was ended early.
    #[error("merging was cancelled")]
    Cancelled,
    /// A curve is periodic.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

/// Measure how the end of an open curve meets the start of another.
pub fn joint_of(first: &FloatPolygon, second: &FloatPolygon) -> Joint {
    let [end, start] = [first.end_jet(End::Finish), second.end_jet(End::Start)];
    Joint::between(&end, &start, first.is_planar() && second.is_planar())
}

/// Check that corner and gap of a joint are small enough for one curve: the gap by the size of the larger curve. Ends
/// within the tolerance meet.
///
/// # Errors
/// [`MergeError::Apart`], [`MergeError::Corner`].
pub fn check_joint(joint: Joint, size: f64, tolerance: f64) -> Result<(), MergeError> {
    let Joint { gap, angle, .. } = joint;
    let most = GAP * size;
    if gap > most {
        return Err(MergeError::Apart {
            distance: gap,
            most,
        });
    }
    match angle <= BENT {
        true => Ok(()),
        false => Err(MergeError::Corner {
            angle,
            gap: (!joint.meets(tolerance)).then_some(gap),
        }),
    }
}

/// Say where two curves turn too sharply for one.
fn corner_text(angle: f64, gap: Option<f64>) -> String {
    let angle = significant(angle.to_degrees(), 3);
    match gap {
        Some(gap) => format!(
            "the curves turn by {angle}° over a gap of {}",
            significant(gap, 3)
        ),
        None => format!("the curves meet at a corner of {angle}°"),
    }
}

/// Make one curve of an open one and another that goes on near its end, within a tolerance and without weights; where
/// the second goes on with the vertices of the first, it is exact and keeps them. Both outer ends
/// keep point and direction, and the curve has as many curvature extrema as both, and at most two more, proved.
///
/// Where no such curve keeps the tolerance, the nearest one that was found is returned: its deviation is larger.
///
/// # Errors
/// [`MergeError`].
pub fn merge(
    first: &FloatPolygon,
    second: &FloatPolygon,
    tolerance: f64,
    progress: &Progress,
) -> Result<Merged, MergeError> {
    let parts = open_parts(first, second)?;
    let joint = joint_of(first, second);
    check_joint(joint, first.size().max(second.size()), tolerance)?;
    let [own, inflections] = counts_of(parts, progress)?;
    if let Some(polygon) = first.followed_by(second) {
        let [extrema, _] = counts_of([&polygon], progress)?;
        let merged = measured(parts, polygon, [own, extrema], progress);
        return merged.map_err(|_| MergeError::Cancelled);
    }
    let is_smooth = joint.angle <= SMOOTH && joint.meets(tolerance);
    let search = Search {
        points: points_of(parts, tolerance),
        parts,
        most: MOST * vertices_of(parts),
        is_smooth,
        planar: parts.iter().all(|it| it.is_planar()),
        // Across a gap the nearest curve would turn there and back.
        inflections: (!is_smooth).then_some(inflections + usize::from(bends_over(parts))),
        tolerance,
        progress,
    };
    let first_tried = match search.is_smooth {
        true => own + added_by_joint(parts, search.planar, tolerance),
        // With few extrema a corner or a gap spreads over both curves.
        false => own,
    };
    let others = (own..=own + ADDED).filter(|extrema| *extrema != first_tried);
    search.nearest(own, [first_tried].into_iter().chain(others))
}

/// Make one curve of an open one and another beyond a gap: both stay within the tolerance, and a blend with their tangents
/// and curvatures lies between them. Otherwise as [`merge`]; the blend may bring extrema of its own.
///
/// # Errors
/// [`MergeError`].
pub fn merge_blended(
    first: &FloatPolygon,
    second: &FloatPolygon,
    tolerance: f64,
    progress: &Progress,
) -> Result<Merged, MergeError> {
    let parts = open_parts(first, second)?;
    let between = blend(first, second).ok_or(MergeError::NoBlend)?;
    let planar = parts.iter().all(|it| it.is_planar());
    let [own, inflections] = counts_of(parts, progress)?;
    let [blended, bends] = counts_of([&between], progress)?;
    let added = [[first, &between], [&between, second]];
    let added = added.map(|pair| added_by_joint(pair, planar, tolerance));
    let first_tried = own + blended + added.into_iter().sum::<usize>();
    let search = Search {
        points: points_over(parts, &between),
        parts,
        most: (MOST * vertices_of(parts)).max(SMALLEST),
        is_smooth: true,
        planar,
        // Beside a blend that bends to one side a flat end must not wave.
        inflections: (bends == 0).then_some(inflections),
        tolerance,
        progress,
    };
    // What the blend has cannot be missed without leaving the curves.
    let tried = first_tried..=first_tried + ADDED;
    let merged = match search.nearest(own, tried.clone()) {
        Err(MergeError::NotFound) if search.inflections.is_some() => {
            let search = Search {
                inflections: None,
                ..search
            };
            search.nearest(own, tried)?
        }
        found => found?,
    };
    let [_, after] = counts_of([&merged.polygon], &progress.without_limit())?;
    Ok(Merged {
        waves: after.saturating_sub(inflections + bends),
        ..merged
    })
}

fn open_parts<'a>(
    first: &'a FloatPolygon,
    second: &'a FloatPolygon,
) -> Result<[&'a FloatPolygon; 2], PolygonError> {
    let parts = [first, second];
    for part in parts {
        part.check_open("merged")?;
    }
    Ok(parts)
}

fn vertices_of(parts: [&FloatPolygon; 2]) -> usize {
    parts.map(|it| it.vertices().len()).iter().sum()
}

/// A search for one curve along two others.
struct Search<'a> {
    parts: [&'a FloatPolygon; 2],
    points: Vec<DVec3>,
    /// The most vertices.
    most: usize,
    /// Whether the points go on without a gap or a corner.
    is_smooth: bool,
    planar: bool,
    /// The inflections asked for.
    inflections: Option<usize>,
    tolerance: f64,
    progress: &'a Progress,
}

impl Search<'_> {
    /// The first curve within the tolerance that has one of the numbers of extrema; else the nearest one.
    fn nearest(
        &self,
        own: usize,
        tried: impl IntoIterator<Item = usize>,
    ) -> Result<Merged, MergeError> {
        let (parts, tolerance, progress) = (self.parts, self.tolerance, self.progress);
        let mut nearest: Option<Merged> = None;
        for extrema in tried {
            let found = self.with_extrema(extrema)?;
            if progress.is_cancelled() && !progress.is_late() {
                return Err(MergeError::Cancelled);
            }
            let Some(polygon) = found else {
                continue;
            };
            let merged = measured(parts, polygon, [own, extrema], &progress.without_limit());
            let merged = merged.map_err(|_| MergeError::Cancelled)?;
            if merged.deviation <= tolerance {
                return Ok(merged);
            }
            let is_nearer = |known: &Merged| merged.deviation < known.deviation;
            if nearest.as_ref().is_none_or(is_nearer) {
                nearest = Some(merged);
            }
        }
        nearest.ok_or(MergeError::NotFound)
    }

    /// The curve with so many extrema, proved, near to the points, whose ends keep point and direction.
    fn with_extrema(&self, extrema: usize) -> Result<Option<FloatPolygon>, MergeError> {
        let hurried = self.progress.hurried(SHARE);
        let found = match self.planar {
            true => self.in_plane(extrema, &hurried),
            false => self.in_space(extrema, &hurried),
        };
        match found {
            Err(FitError::Cancelled) => Err(MergeError::Cancelled),
            found => Ok(found.unwrap_or(None)),
        }
    }

    fn degree(&self) -> usize {
        let [first, second] = self.parts.map(|part| part.degree());
        first.max(second)
    }

    /// The distance at which the search may end. A corner or a gap moves both curves however many vertices there are:
    /// there the nearest curve is sought, the same one for all tolerances.
    fn sought(&self, share: f64) -> Option<f64> {
        self.is_smooth.then_some(share * self.tolerance)
    }

    /// The conditions at the outer ends.
    fn ends(&self) -> [(End, EndTarget); 2] {
        let [first, second] = self.parts;
        let outer = [(first, End::Start), (second, End::Finish)];
        outer.map(|(part, end)| (end, EndTarget::keeping(&part.end_jet(end))))
    }

    fn in_plane(
        &self,
        extrema: usize,
        progress: &Progress,
    ) -> Result<Option<FloatPolygon>, FitError> {
        let points: Vec<DVec2> = self.points.iter().map(|point| point.truncate()).collect();
        let asked = PlaneFit {
            degree: self.degree(),
            most: Some(self.most),
            extrema: Extrema::Exactly(extrema),
            inflections: self.inflections,
            tolerance: self.sought(KEPT),
            exact_ends: [true; 2],
            directions: self.ends().map(|(_, end)| Some(end.direction?.truncate())),
            outliers: Some(Vec::new()),
            of_curve: true,
            ..PlaneFit::default()
        };
        let found = fit_plane(&points, &asked, progress)?;
        Ok(found.holds.then_some(found.polygon))
    }

    fn in_space(
        &self,
        extrema: usize,
        progress: &Progress,
    ) -> Result<Option<FloatPolygon>, FitError> {
        let asked = FitRequest {
            degree: self.degree(),
            most: Some(self.most),
            extrema: Some(extrema),
            tolerance: self.sought(KEPT_IN_SPACE),
            outliers: Some(Vec::new()),
            ..FitRequest::default()
        };
        let found = fit_points(&self.points, &asked, progress)?;
        let polygon = &found.polygon;
        let corrected = correct_jointly(
            polygon,
            &self.ends(),
            Disturbance::Curve,
            &[],
            self.progress,
        );
        let Ok(corrected) = corrected else {
            return Ok(None);
        };
        let features = Features::proved(&corrected.polygon, |_| !self.progress.is_cancelled());
        let features = features.ok_or(FitError::Cancelled)?;
        let holds = features.count(Feature::CurvatureExtremum) == extrema;
        Ok(holds.then_some(corrected.polygon))
    }
}

/// The extrema that the joint adds: each change of sign between the slope of the curvature before it, the jump of the
/// curvature there, and the slope behind it.
fn added_by_joint([first, second]: [&FloatPolygon; 2], planar: bool, tolerance: f64) -> usize {
    let [before, behind] = [first.end_jet(End::Finish), second.end_jet(End::Start)];
    let jump = behind.curvature_of(planar) - before.curvature_of(planar);
    let size = first.size().max(second.size());
    let is_absorbed = jump.abs() * size * size <= ABSORBED * tolerance;
    let slopes = [before, behind].map(|jet| jet.curvature_slope(planar));
    let signs = match is_absorbed {
        true => vec![slopes[0], slopes[1]],
        false => vec![slopes[0], jump, slopes[1]],
    };
    let pairs = signs.windows(2);
    pairs.filter(|pair| pair[0] * pair[1] < 0.0).count()
}

/// Whether the curvature of planar curves changes its sign where they meet.
fn bends_over([first, second]: [&FloatPolygon; 2]) -> bool {
    let [before, behind] = [first.end_jet(End::Finish), second.end_jet(End::Start)];
    before.curvature_of(true) * behind.curvature_of(true) < 0.0
}

/// The curvature extrema and the inflections of some curves together.
pub(super) fn counts_of<const N: usize>(
    parts: [&FloatPolygon; N],
    progress: &Progress,
) -> Result<[usize; 2], MergeError> {
    let mut sums = [0; 2];
    for part in parts {
        let features = Features::proved(part, |_| !progress.is_cancelled());
        let features = features.ok_or(MergeError::Cancelled)?;
        sums[0] += features.count(Feature::CurvatureExtremum);
        sums[1] += features.count(Feature::Inflection);
    }
    Ok(sums)
}

/// Points along both curves. The ends count once, in the middle between them, unless a gap lies between them; where the
/// curves overlap, the points beyond the middle do not count.
fn points_of(parts: [&FloatPolygon; 2], tolerance: f64) -> Vec<DVec3> {
    let [first, second] = parts;
    let jets = [first.end_jet(End::Finish), second.end_jet(End::Start)];
    let [mut points, mut others] = parts.map(|it| sampled(it, SAMPLES));
    let way = jets[1].point - jets[0].point;
    let tangents = jets.map(|jet| jet.tangent().unwrap_or(DVec3::ZERO));
    let ahead = (tangents[0] + tangents[1]).normalize_or_zero();
    let gap = way.dot(ahead);
    if way.length() > tolerance && gap > (way - gap * ahead).length() {
        points.append(&mut others);
        return points;
    }
    let middle = jets[0].point.midpoint(jets[1].point);
    let is_beyond = |point: &DVec3, side: f64| side * (*point - middle).dot(ahead) >= 0.0;
    points.pop();
    while points.len() > 1 && points.last().is_some_and(|it| is_beyond(it, 1.0)) {
        points.pop();
    }
    let mut others = others.into_iter().skip(1).peekable();
    while others.len() > 1 && others.next_if(|it| is_beyond(it, -1.0)).is_some() {}
    points.push(middle);
    points.extend(others);
    points
}

/// The samples of each segment of a curve that is blended.
pub(super) fn samples_of(polygon: &FloatPolygon) -> usize {
    SAMPLES.max(LEAST_SAMPLES.div_ceil(polygon.segments()))
}

/// Points along a curve, so many a segment.
pub(super) fn sampled(polygon: &FloatPolygon, samples: usize) -> Vec<DVec3> {
    let places = (0..=samples * polygon.segments()).map(|it| it as f64 / samples as f64);
    places.map(|u| polygon.point(u)).collect()
}

/// Points along both curves and the blend between them, there about as dense as beside it.
fn points_over([first, second]: [&FloatPolygon; 2], between: &FloatPolygon) -> Vec<DVec3> {
    let beside = [(first, End::Finish), (second, End::Start)];
    let steps = beside.map(|(part, end)| part.end_jet(end).speed() / samples_of(part) as f64);
    let needed = (between.jet(0.5).speed() * 2.0 / (steps[0] + steps[1])) as usize;
    let [least, most] = BLEND_SAMPLES;
    let mut points = sampled(first, samples_of(first));
    let blended = sampled(between, needed.clamp(least, most));
    points.extend(blended.into_iter().skip(1));
    points.extend(sampled(second, samples_of(second)).into_iter().skip(1));
    points
}

/// Measure how far a merged curve is from both, along which it runs.
fn measured(
    parts: [&FloatPolygon; 2],
    polygon: FloatPolygon,
    extrema: [usize; 2],
    progress: &Progress,
) -> Result<Merged, DistanceError> {
    let first = Track::along(&polygon, parts[0], 0.0);
    let joint = first.at(parts[0].segments() as f64);
    let begin = beside(&polygon, parts[1].point(0.0), joint);
    let second = Track::along(&polygon, parts[1], begin);
    let tracks = [first, second];
    let (mut deviation, mut bounded) = (0.0_f64, true);
    for (part, track) in parts.into_iter().zip(&tracks) {
        let place = |u: f64| track.at(u);
        let found = MeasuredDeviation::both_ways(part, &polygon, &place, progress)?;
        deviation = deviation.max(found.largest);
        bounded &= found.bounded;
    }
    Ok(Merged {
        polygon,
        tracks,
        deviation,
        bounded,
        extrema,
        waves: 0,
    })
}

/// The parameter of the nearest sample to a point, walking from a parameter: the curves that are merged may overlap or
/// leave a gap.
pub(super) fn beside(polygon: &FloatPolygon, point: DVec3, from: f64) -> f64 {
    let step = 1.0 / TRACKED as f64;
    let last = polygon.segments() as f64;
    let off = |u: f64| polygon.point(u).distance(point);
    let mut place = from;
    for way in [-step, step] {
        let on = |place: f64| (place + way).clamp(0.0, last);
        while off(on(place)) < off(place) {
            place = on(place);
        }
    }
    place
}

impl Track {
    /// Follow a curve along another one, from a parameter of that on.
    pub(super) fn along(polygon: &FloatPolygon, curve: &FloatPolygon, from: f64) -> Self {
        let last = polygon.segments() as f64;
        let mut place = from;
        let samples = 0..=TRACKED * curve.segments();
        let places = samples.map(|sample| {
            let at = curve.point(sample as f64 / TRACKED as f64);
            let bracket = [place, (place + AHEAD).min(last)];
            place = refined_parameter(at, place, bracket, |u| polygon.jet(u));
            place
        });
        let places = places.collect();
        Self { places }
    }

    /// The parameter of the other curve beside a parameter of this one.
    pub fn at(&self, u: f64) -> f64 {
        let place = (TRACKED as f64 * u).clamp(0.0, (self.places.len() - 1) as f64);
        let before = (place as usize).min(self.places.len().saturating_sub(2));
        let share = place - before as f64;
        let next = self.places.get(before + 1).copied();
        let before = self.places[before];
        before + share * (next.unwrap_or(before) - before)
    }
}
