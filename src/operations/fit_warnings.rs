//! What the user may not want of a curve that is fitted to points.

use glam::DVec3;

use crate::geometry::fitting::{Fitted, PlaneFit, SharpBend};
use crate::geometry::polygon_figures::{FOLD, sharpest_turn};
use crate::geometry::{BezierPolygon, End, FloatPolygon, bounds, percent, significant};

/// A vertex farther off the curve than so many times its size is named.
const LONG_TAIL: f64 = 5.0;

/// What to do about a polygon that can hardly be dragged.
const ANOTHER: &str = "another number of vertices may be handier";

/// With more noise than this, by the size, circles through three points tell no bend.
const NOISY: f64 = 5e-4;

/// The share of the segments that lie beside an end, and the samples of the others.
const BESIDE: f64 = 0.1;
const SAMPLES: usize = 200;

/// An end whose curvature is so many times the largest beyond that dives, and so does one that bends the other way by this
/// share of it: no extremum tells.
const DIVES: f64 = 2.0;
const OTHER_WAY: f64 = 0.5;

/// The least curvature of such an end, by the size of the curve: nobody sees less.
const SEEN: f64 = 1.0;

/// Points so far off the curve, by its size, are told if the tolerance is smaller.
const FAR: f64 = 0.01;

/// What the user may not want: a loop, points far off, bends and ends that the points do not show, and vertices far away.
pub(super) fn warnings(asked: &PlaneFit, found: &Fitted) -> Vec<String> {
    let crossing = found.crossing.map(|at| {
        let [x, y] = at.to_array().map(|coordinate| significant(coordinate, 6));
        let advice = match asked.periodic || asked.exact_ends == [true; 2] {
            true => "ask for more extrema",
            false => "hold exact ends, or ask for more extrema",
        };
        format!("The curve crosses itself at {x}, {y}, its points do not: {advice}")
    });
    let size = BezierPolygon::from_float(&found.polygon).size();
    let bend = found.sharp_bend.map(|bend| told_bend(bend, size));
    let dives = match found.noise > NOISY * size {
        true => dives(asked, &found.polygon),
        false => Vec::new(),
    };
    let far = far(found, size);
    let unhandy = [tails(&found.polygon), fold(&found.polygon)];
    let told = crossing.into_iter().chain(far).chain(bend).chain(dives);
    told.chain(unhandy.into_iter().flatten()).collect()
}

/// Say that points lie far off the curve.
fn far(found: &Fitted, size: f64) -> Option<String> {
    (found.deviation > found.tolerance.max(FAR * size)).then(|| {
        let off = significant(found.deviation, 3);
        let share = percent(found.deviation / size);
        format!("Points lie up to {off} off the curve, {share} of its size: allow more extrema or vertices")
    })
}

/// Say which ends bend much more than the rest of the curve, if their curvature is not asked for.
fn dives(asked: &PlaneFit, polygon: &FloatPolygon) -> Vec<String> {
    if polygon.is_periodic() {
        return Vec::new();
    }
    let (length, size) = (
        polygon.segments() as f64,
        BezierPolygon::from_float(polygon).size(),
    );
    let curvature = |share: f64| polygon.jet(share * length).signed_curvature();
    let share = |sample: usize| BESIDE + (1.0 - 2.0 * BESIDE) * sample as f64 / SAMPLES as f64;
    let rest = (0..=SAMPLES).map(|sample| curvature(share(sample)).abs());
    let rest = rest.fold(0.0, f64::max);
    let ends = [(0.0, BESIDE), (1.0, 1.0 - BESIDE)].into_iter();
    let ends = ends.zip(End::BOTH).zip(asked.curvatures);
    let dives = ends.filter_map(|(((at, beside), end), asked)| {
        let [own, beside] = [at, beside].map(curvature);
        let most = match own * beside < 0.0 {
            true => OTHER_WAY,
            false => DIVES,
        };
        let is_seen = own.abs() * size > SEEN && rest > 0.0;
        (asked.is_none() && own.abs() > most * rest && is_seen).then(|| {
            let [own, rest] = [own.abs(), rest].map(|curvature| significant(1.0 / curvature, 3));
            let name = end.name();
            let advice = "ask for one more extremum, or give its curvature";
            format!("The {name} bends to the radius {own}, the rest to {rest}: {advice}")
        })
    });
    dives.collect()
}

/// Say where the curve bends more sharply than its points, to four digits of its size.
fn told_bend(bend: SharpBend, size: f64) -> String {
    let digit = 10.0_f64.powf(size.log10().ceil() - 4.0);
    let place = (bend.at / digit).round() * digit;
    let [x, y] = place
        .to_array()
        .map(|coordinate| significant(coordinate, 4));
    let own = significant(1.0 / bend.curvature, 3);
    let shown = match bend.shown {
        0.0 => "lie straight".to_owned(),
        shown => format!("show a radius of {} at least", significant(1.0 / shown, 3)),
    };
    let advice = "ask for other extrema, or give a curvature";
    format!("A bend has the radius {own} at {x}, {y}, where the points {shown}: {advice}")
}

/// Name the vertex where the polygon turns back most: nobody could drag it there.
fn fold(polygon: &FloatPolygon) -> Option<String> {
    let (vertex, turn) = sharpest_turn(polygon)?;
    (turn > FOLD).then(|| {
        let turn = turn.to_degrees().round();
        format!("The polygon turns back by {turn}° at vertex {vertex}: {ANOTHER}")
    })
}

/// Name a vertex that lies far off the curve: it can hardly be dragged.
fn tails(polygon: &FloatPolygon) -> Option<String> {
    let places = (0..=4 * polygon.segments()).map(|it| polygon.point(it as f64 / 4.0));
    let (low, high) = bounds(places);
    let off = |vertex: &DVec3| vertex.distance(vertex.clamp(low, high)) / low.distance(high);
    let all = polygon.vertices().iter().map(off).enumerate();
    let (vertex, farthest) = all.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (farthest > LONG_TAIL).then(|| {
        let sizes = significant(farthest, 2);
        format!("Vertex {vertex} lies {sizes} times the curve's size away: {ANOTHER}")
    })
}
