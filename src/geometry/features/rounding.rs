//! Features that only the rounding of the vertices makes.
//!
//! Vertices are rounded to δ = 16 ε M, with M the largest coordinate of those of a segment. So a curvature is known to
//!
//!   δ (1 / |C′|² + |κ| / |C′|),
//!
//! and a torsion to δ (|C′||C″| + |C′||C‴| + |C″||C‴|) / |C′ × C″|². An extremum counts if the quantity rises and falls
//! by more beside it, a change of sign if it lies between levels of different signs that are larger. On a straight
//! stretch, on a circle, and for the torsion of a plane curve in space there would be many others, one a rounding.

use glam::DVec3;

use super::feature::{Extremum, ExtremumKind, Feature, Features, Root, Trend, TrendPiece};
use crate::geometry::float_polygon::FloatPolygon;

/// The rounding δ of the vertices, by their largest coordinate: some operations lie behind them.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How far beside a jump the quantity is taken.
const BESIDE: f64 = 1e-9;

impl Features {
    /// Leave out the features that rounding makes. Curves with cusps, but for rounding, and quantities with undecided
    /// pieces keep all, and so do curves of degree 2, whose curvature jumps at knots.
    pub(super) fn above_rounding(mut self, polygon: &FloatPolygon) -> Self {
        if !self.cusps.is_empty() || polygon.degree() < 3 {
            return self;
        }
        if self.is_decided([Feature::Inflection, Feature::CurvatureExtremum]) {
            let quantity = Feature::CurvatureExtremum;
            let walk = Walk::new(polygon, quantity, &self.curvature_extrema);
            if walk.drops(&self.inflections) {
                self.inflections = walk.signs_kept(&self.inflections);
                self.curvature_extrema = walk.kept(&self.curvature_extrema);
                self.trends = walk.trends(&self.trends);
                self.monotone = self.verdict();
            }
        }
        if self.is_decided([Feature::TorsionZero, Feature::TorsionExtremum]) {
            let quantity = Feature::TorsionExtremum;
            let walk = Walk::new(polygon, quantity, &self.torsion_extrema);
            if walk.drops(&self.torsion_zeros) {
                self.torsion_zeros = walk.signs_kept(&self.torsion_zeros);
                self.torsion_extrema = walk.kept(&self.torsion_extrema);
            }
        }
        self
    }

    fn is_decided(&self, quantities: [Feature; 2]) -> bool {
        let mut undecided = self.undecided.iter();
        !undecided.any(|doubt| quantities.contains(&doubt.quantity))
    }
}

/// A quantity at a place.
#[derive(Clone, Copy, Debug)]
struct Level {
    u: f64,
    /// The value; 0 where it is not known to differ from that.
    value: f64,
    /// How well it is known.
    rounding: f64,
    /// The number of its extremum; an end has none.
    extremum: Option<usize>,
    /// Whether the quantity turns there.
    turns: bool,
    /// Whether the tangent vanishes but for rounding.
    stands: bool,
}

impl Level {
    /// The level at a place, with a value that is known there.
    fn new(polygon: &FloatPolygon, quantity: Feature, u: f64, known: Option<f64>) -> Self {
        let jet = polygon.jet(u);
        let (segment, _) = polygon.locate(u);
        let vertices = segment..=segment + polygon.degree();
        let largest = vertices.map(|it| polygon.vertex(it).abs().max_element());
        let rounded = ROUNDING * largest.fold(0.0, f64::max);
        // In units of the tangent nothing leaves the range of numbers.
        let unit = jet.speed();
        let [first, second, third] = [jet.first, jet.second, jet.third].map(|it| it / unit);
        let (value, rounding) = match quantity {
            Feature::TorsionExtremum | Feature::TorsionZero => {
                let [a, b, c] = [first, second, third].map(DVec3::length);
                let square = first.cross(second).length_squared();
                (jet.torsion(), (a * b + a * c + b * c) / square)
            }
            Feature::CurvatureExtremum | Feature::Inflection => {
                let value = jet.curvature_of(polygon.is_planar());
                (value, 1.0 + unit * value.abs())
            }
        };
        let (value, rounding) = (known.unwrap_or(value), rounded / unit * rounding / unit);
        Self {
            u,
            value: if value.abs() > rounding { value } else { 0.0 },
            rounding,
            extremum: None,
            turns: false,
            stands: unit <= rounded,
        }
    }

    fn differs(&self, other: &Self) -> bool {
        (self.value - other.value).abs() > self.rounding.min(other.rounding)
    }
}

/// A walk along a curve, from one extremum of a quantity to the next.
struct Walk {
    levels: Vec<Level>,
    periodic: bool,
}

impl Walk {
    fn new(polygon: &FloatPolygon, quantity: Feature, extrema: &[Extremum]) -> Self {
        let of_extremum = |(number, it): (usize, &Extremum)| {
            let middle = 0.5 * (it.u[0] + it.u[1]);
            let value = 0.5 * (it.value[0] + it.value[1]);
            // Two in one place lie on both sides of a jump.
            let places = match it.count % 2 {
                0 => vec![(middle - BESIDE, None), (middle + BESIDE, None)],
                _ => vec![(middle, Some(value).filter(|it| it.is_finite()))],
            };
            places.into_iter().map(move |(u, value)| Level {
                extremum: Some(number),
                ..Level::new(polygon, quantity, u, value)
            })
        };
        let inner = extrema.iter().enumerate().flat_map(of_extremum);
        let mut levels: Vec<Level> = inner.collect();
        let periodic = polygon.is_periodic();
        if periodic {
            turn_round(&mut levels);
        } else {
            let end = |u: f64| Level::new(polygon, quantity, u, None);
            levels.insert(0, end(0.0));
            levels.push(end(polygon.segments() as f64));
            turn(&mut levels);
        }
        Self { levels, periodic }
    }

    /// The places where the quantity turns, and the ends of an open curve.
    fn marks(&self) -> Vec<Level> {
        let marks = self.levels.iter();
        let marks = marks.filter(|it| it.turns || it.extremum.is_none());
        marks.copied().collect()
    }

    /// Whether there is a feature that does not count, and no cusp but for rounding.
    fn drops(&self, roots: &[Root]) -> bool {
        let count = |roots: &[Root]| roots.iter().map(|it| it.count).sum::<usize>();
        if self.levels.iter().any(|it| it.stands) {
            return false;
        }
        let mut extrema = self.levels.iter().filter(|it| it.extremum.is_some());
        extrema.any(|it| !it.turns) || count(&self.signs_kept(roots)) < count(roots)
    }

    /// The extrema that count.
    fn kept(&self, extrema: &[Extremum]) -> Vec<Extremum> {
        let kept = extrema.iter().enumerate().filter_map(|(number, it)| {
            let own = self.levels.iter().filter(|it| it.extremum == Some(number));
            let turns: Vec<bool> = own.map(|it| it.turns).collect();
            match turns[..] {
                [true] | [true, true] => Some(*it),
                [true, false] => Some(Extremum { count: 1, ..*it }),
                [false, true] => Some(Extremum {
                    count: 1,
                    kind: match it.kind {
                        ExtremumKind::Maximum => ExtremumKind::Minimum,
                        ExtremumKind::Minimum => ExtremumKind::Maximum,
                    },
                    ..*it
                }),
                _ => None,
            }
        });
        kept.collect()
    }

    /// The changes of sign that count: one between levels of different signs, the middle one of several.
    fn signs_kept(&self, roots: &[Root]) -> Vec<Root> {
        let marks = self.marks();
        let middle = |root: &Root| 0.5 * (root.u[0] + root.u[1]);
        let mut roots = roots.to_vec();
        if let Some(first) = marks.first().filter(|_| self.periodic) {
            let over_the_joint = roots.partition_point(|it| middle(it) < first.u);
            roots.rotate_left(over_the_joint);
        }
        let changes = |gap: usize| {
            let ends = ends_of(&marks, gap);
            ends.is_some_and(|[a, b]| a.value.min(b.value) < 0.0 && a.value.max(b.value) > 0.0)
        };
        let gap_of = |root: &Root| {
            let gap = gap_at(&marks, middle(root));
            // At a jump the sign changes before or behind the extremum that lies there, too.
            let is_there = |[a, _]: [&Level; 2]| (a.u - middle(root)).abs() <= BESIDE;
            match ends_of(&marks, gap).is_some_and(is_there) && !changes(gap) {
                true => (gap + marks.len() - 1) % marks.len(),
                false => gap,
            }
        };
        let between = roots.chunk_by(|a, b| gap_of(a) == gap_of(b));
        let kept = between.filter_map(|between| {
            let gap = between.first().map(gap_of)?;
            let middle = between.get(between.len() / 2).filter(|_| changes(gap));
            middle.map(|it| Root { count: 1, ..*it })
        });
        let mut kept: Vec<Root> = kept.collect();
        kept.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]));
        kept
    }

    /// The pieces between turns: what lies between two of them has one trend.
    fn trends(&self, pieces: &[TrendPiece]) -> Vec<TrendPiece> {
        let marks = self.marks();
        let gap_of = |piece: &TrendPiece| gap_at(&marks, 0.5 * (piece.u[0] + piece.u[1]));
        let trend = |gap: usize| match ends_of(&marks, gap) {
            Some([a, b]) if a.differs(b) && a.value < b.value => Trend::Rising,
            Some([a, b]) if a.differs(b) => Trend::Falling,
            _ => Trend::Constant,
        };
        let between = pieces.chunk_by(|a, b| gap_of(a) == gap_of(b) && a.u[0] < b.u[0]);
        let merged = between.filter_map(|between| {
            let (first, last) = (between.first()?, between.last()?);
            Some(TrendPiece {
                u: [first.u[0], last.u[1]],
                trend: trend(gap_of(first)),
            })
        });
        merged.collect()
    }
}

/// The number of the mark behind a place: on a closed curve the first one comes behind the last.
fn gap_at(marks: &[Level], u: f64) -> usize {
    let behind = marks.partition_point(|mark| mark.u <= u);
    let is_open = marks.first().is_some_and(|it| it.extremum.is_none());
    match is_open {
        true => behind.clamp(1, marks.len() - 1),
        false => behind % marks.len().max(1),
    }
}

/// The marks before and behind a gap.
fn ends_of(marks: &[Level], gap: usize) -> Option<[&Level; 2]> {
    let before = (gap + marks.len()).checked_sub(1)? % marks.len().max(1);
    Some([marks.get(before)?, marks.get(gap)?])
}

/// Find the turns of a closed curve: its highest level is one if there is another.
fn turn_round(levels: &mut Vec<Level>) {
    let highest = levels.iter().enumerate();
    let highest = highest.max_by(|a, b| a.1.value.total_cmp(&b.1.value));
    let Some((highest, level)) = highest.map(|(index, level)| (index, *level)) else {
        return;
    };
    levels.rotate_left(highest);
    levels.push(level);
    turn(levels);
    levels.pop();
    let is_turn = levels.iter().any(|it| it.turns);
    levels[0].turns = is_turn;
    levels.rotate_right(highest);
}

/// Find the levels at which a quantity turns back by more than rounding; the first and the last are none.
fn turn(levels: &mut [Level]) {
    let (mut low, mut high) = (0, 0);
    let mut way: Option<(bool, usize)> = None;
    for index in 1..levels.len() {
        let here = levels[index];
        let Some((rises, farthest)) = way else {
            if here.value < levels[low].value {
                low = index;
            }
            if here.value > levels[high].value {
                high = index;
            }
            if levels[low].differs(&levels[high]) {
                way = Some((high == index, index));
            }
            continue;
        };
        let best = levels[farthest];
        let goes_on = match rises {
            true => here.value >= best.value,
            false => here.value <= best.value,
        };
        if goes_on {
            way = Some((rises, index));
        } else if here.differs(&best) {
            levels[farthest].turns = true;
            way = Some((!rises, index));
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::feature::Verdict;
    use super::*;

    fn polygon(degree: usize, vertices: Vec<DVec3>, periodic: bool) -> FloatPolygon {
        FloatPolygon::new(degree, vertices, None, periodic).expect("a polygon")
    }

    /// Points on a line, each rounded.
    fn on_line(count: usize, way: DVec3) -> Vec<DVec3> {
        let at = |index: usize| DVec3::new(0.1, 0.7, 0.0) + way * (index as f64 * 1.1);
        (0..count).map(at).collect()
    }

    #[test]
    fn a_straight_line_of_rounded_points_has_no_features() {
        for degree in 3..8 {
            for way in [DVec3::new(3.0, 1.7, 0.0), DVec3::new(3.0, 1.7, 0.9)] {
                let features = Features::new(&polygon(degree, on_line(12, way), false));
                let lists = [features.inflections.len(), features.torsion_zeros.len()];
                assert_eq!(lists, [0, 0], "degree {degree}");
                assert!(
                    features.curvature_extrema.is_empty() && features.torsion_extrema.is_empty()
                );
                assert_eq!(features.monotone, Verdict::Proved);
                let is_constant = |it: &TrendPiece| it.trend == Trend::Constant;
                assert!(features.trends.iter().all(is_constant));
            }
        }
    }

    #[test]
    fn beside_a_straight_stretch_only_what_is_larger_than_rounding_counts() {
        for (degree, over) in [(3, false), (4, true), (5, false), (5, true), (7, true)] {
            // A bend to the left, a straight stretch, and a bend to the same side or over.
            let straight = on_line(14, DVec3::new(3.0, 1.7, 0.0));
            let side = DVec3::new(-1.7, 3.0, 0.0);
            let bend = |index: usize, by: f64| {
                let past = index as f64 + 1.0;
                0.05 * by * past * past * side
            };
            let way = straight[1] - straight[0];
            let before = (0..5)
                .rev()
                .map(|it| straight[0] - way * (it + 1) as f64 + bend(it, 1.0));
            let by = if over { -1.0 } else { 1.0 };
            let behind = (0..5).map(|it| straight[13] + way * (it + 1) as f64 + bend(it, by));
            let vertices = before
                .chain(straight.iter().copied())
                .chain(behind)
                .collect();
            let curve = polygon(degree, vertices, false);
            let features = Features::new(&curve);
            let exact = Features::exact(
                &curve,
                &super::super::SegmentFeatures::of_curve(&curve, |_| true).expect("a proof"),
            );
            assert!(exact.inflections.len() + exact.curvature_extrema.len() > 4);
            assert_eq!(
                features.inflections.len(),
                usize::from(over),
                "degree {degree}"
            );
            let least = features.curvature_extrema.iter();
            let least = least.filter(|it| it.value[0].abs() < 1e-12).count();
            // Between bends to one side the curvature is least on the straight stretch.
            assert_eq!(least, usize::from(!over), "degree {degree}");
        }
    }

    #[test]
    fn a_plane_curve_in_space_has_no_torsion() {
        for degree in 3..8 {
            let at = |index: usize| {
                let t = 0.4 * index as f64;
                let (x, y) = (5.0 * t + 0.3, t.sin() + 0.1 * t * t);
                x * DVec3::new(0.36, 0.48, 0.8) + y * DVec3::new(-0.8, 0.6, 0.0)
            };
            let features = Features::new(&polygon(degree, (0..15).map(at).collect(), false));
            assert_eq!(features.count(Feature::TorsionZero), 0, "degree {degree}");
            assert_eq!(
                features.count(Feature::TorsionExtremum),
                0,
                "degree {degree}"
            );
            assert!(features.count(Feature::CurvatureExtremum) > 0);
        }
    }

    #[test]
    fn closed_curves_keep_what_is_larger_than_rounding() {
        // A stadium: two straight stretches of rounded points, two round ends.
        let way = DVec3::new(3.0, 1.7, 0.0);
        let side = DVec3::new(-1.7, 3.0, 0.0);
        let there = on_line(10, way);
        let back = on_line(10, way).into_iter().rev().map(|it| it + 3.0 * side);
        let first = [
            there[9] + 0.9 * way + 0.8 * side,
            there[9] + 0.9 * way + 2.2 * side,
        ];
        let last = [
            there[0] - 0.9 * way + 2.2 * side,
            there[0] - 0.9 * way + 0.8 * side,
        ];
        let vertices = there
            .iter()
            .copied()
            .chain(first)
            .chain(back)
            .chain(last)
            .collect();
        for degree in [3, 4, 5] {
            let curve = polygon(degree, Vec::clone(&vertices), true);
            let segments = super::super::SegmentFeatures::of_curve(&curve, |_| true);
            let exact = Features::exact(&curve, &segments.expect("a proof"));
            let features = Features::new(&curve);
            let counts = [&exact, &features].map(|it| it.curvature_extrema.len());
            assert!(
                counts[0] > counts[1] && counts[1] >= 4 && counts[1] % 2 == 0,
                "{counts:?}"
            );
            let is_noise = |it: &&Extremum| it.value[1].abs() < 1e-12;
            let noise = features.curvature_extrema.iter().filter(is_noise).count();
            assert!(
                noise <= 2 && features.inflections.len() <= 4,
                "degree {degree}"
            );
        }
        let round = |index: usize| {
            let angle = std::f64::consts::TAU * index as f64 / 3.0;
            DVec3::new(angle.cos(), angle.sin(), 0.0)
        };
        let symmetric = polygon(2, (0..3).map(round).collect(), true);
        assert_eq!(Features::new(&symmetric).curvature_extrema.len(), 6);
    }
}
