//! The features of a whole curve, put together from those of its segments.

use super::enclosure::narrower;
use super::exact_numerators::ExactSegment;
use super::feature::{Cusp, Extremum, ExtremumKind, Feature, Features, Root, Undecided, Verdict};
use super::segment_features::SegmentFeatures;
use super::separation::{ChangeInterval, join_neighbours, narrow_neighbours};
use super::sign_piece::SignPiece;
use super::sign_walk::{Place, SignWalk};
use super::trends::trends;
use super::values;
use crate::geometry::float_polygon::FloatPolygon;

impl Features {
    /// Prove the features of a whole curve.
    ///
    /// To follow a drag, keep the segments' features ([`SegmentProver::segment`](super::SegmentProver::segment)), redo those of
    /// the n + 1 segments that a vertex touches and put them together again with
    /// [`Features::assemble`].
    pub fn new(polygon: &FloatPolygon) -> Self {
        Self::proved(polygon, |_| true).unwrap_or_default()
    }

    /// Prove the features of a whole curve; `wanted` tells before each segment, by its number,
    /// whether to go on. `None` if not.
    pub fn proved(polygon: &FloatPolygon, wanted: impl FnMut(usize) -> bool) -> Option<Self> {
        let segments = SegmentFeatures::of_curve(polygon, wanted)?;
        Some(Self::assemble(polygon, &segments))
    }

    /// Put the features of all segments together as [`Features::exact`] does, without those within the rounding of the
    /// vertices.
    pub fn assemble(polygon: &FloatPolygon, segments: &[SegmentFeatures]) -> Self {
        Self::exact(polygon, segments).above_rounding(polygon)
    }

    /// Put the features of all segments together, joining them at the knots, in time
    /// proportional to their number: those of the doubles given, however small. Segments that are missing end the curve.
    ///
    /// At a knot κ is continuous from degree 3 on and κ′ from degree 4 on (torsion: 4 and 5). An
    /// extremum sits on the knot where the slope changes its sign there. At degree 2 (torsion:
    /// 3) the quantity itself jumps, and the jump counts as a vertical piece of its graph: rising,
    /// up, falling is one maximum; rising, down, rising is a maximum and a minimum, both at the
    /// knot, in one interval; rising, up, rising is none. Polylines, of degree 1, have curvature 0;
    /// their corners are not features. The ends of an open curve are not inside its domain.
    pub fn exact(polygon: &FloatPolygon, segments: &[SegmentFeatures]) -> Self {
        let count = segments.len().min(polygon.segments());
        let Some(segments) = segments
            .get(..count)
            .filter(|segments| !segments.is_empty())
        else {
            return Self::default();
        };
        let assembly = Assembly { polygon, segments };
        let mut features = Self {
            cusps: assembly.cusps(),
            ..Self::default()
        };
        let planar = polygon.is_planar();
        let mut singular: Vec<_> = features.cusps.iter().map(|cusp| cusp.u).collect();
        let found = features.decide(&assembly, Feature::Inflection, &singular);
        features.inflections = found.iter().map(root).collect();
        let quantity = Feature::CurvatureExtremum;
        let found = features.decide(&assembly, quantity, &singular);
        features.curvature_extrema = assembly.extrema(&found, quantity);
        features.monotone = features.verdict();
        if !planar {
            let found = features.decide(&assembly, Feature::TorsionZero, &singular);
            features.torsion_zeros = found.iter().map(root).collect();
            let flat = assembly.flat_knots();
            singular.extend(&flat);
            let quantity = Feature::TorsionExtremum;
            let found = features.decide(&assembly, quantity, &singular);
            features.torsion_extrema = assembly.extrema(&found, quantity);
            features.doubt_jumps(&flat);
        }
        features
    }

    /// Find the changes of a feature's sign, and the trends of the curvature between those of its slope.
    /// Those that doubles cannot tell apart are joined. Those at a singular place, or at
    /// an end of an undecided piece, which may hold another change, are added to the undecided
    /// pieces instead, together with the walk's own.
    fn decide(
        &mut self,
        assembly: &Assembly,
        quantity: Feature,
        singular: &[[f64; 2]],
    ) -> Vec<ChangeInterval> {
        let walk = assembly.walk(quantity);
        let mut found = assembly.find(quantity, &walk, singular);
        if quantity == Feature::CurvatureExtremum {
            let end = assembly.segments.len() as f64;
            self.trends = trends(&walk.runs, &found, &self.cusps, end);
        }
        let doubt = |u, certain| Undecided {
            u,
            quantity,
            certain,
        };
        let doubts = assembly.doubts(&walk);
        found.retain(|found| {
            let is_singular = assembly.touches(singular, found.u);
            let is_doubtful = is_singular || assembly.touches(&doubts, found.u);
            if is_doubtful {
                self.undecided.push(doubt(found.u, !is_singular));
            }
            !is_doubtful
        });
        join_neighbours(&mut found, assembly.joint());
        for found in &walk.doubts {
            let u = assembly.interval(found.places);
            let certain = found.changed && !assembly.touches(singular, u);
            self.undecided.push(doubt(u, certain));
        }
        found
    }

    /// Leave open whether the torsion jumps at knots without curvature, and makes extrema there.
    fn doubt_jumps(&mut self, knots: &[[f64; 2]]) {
        for u in knots {
            let doubt = Undecided {
                u: *u,
                quantity: Feature::TorsionExtremum,
                certain: false,
            };
            if !self.undecided.contains(&doubt) {
                self.undecided.push(doubt);
            }
        }
    }

    pub(super) fn verdict(&self) -> Verdict {
        let mut doubts = self
            .undecided
            .iter()
            .filter(|doubt| doubt.quantity == Feature::CurvatureExtremum)
            .peekable();
        if !self.curvature_extrema.is_empty() {
            Verdict::Disproved
        } else if doubts.peek().is_none() && self.cusps.is_empty() {
            Verdict::Proved
        } else if doubts.any(|doubt| doubt.certain) {
            Verdict::Disproved
        } else {
            Verdict::Undecided
        }
    }
}

/// A curve with the proofs of its segments.
struct Assembly<'a> {
    polygon: &'a FloatPolygon,
    segments: &'a [SegmentFeatures],
}

impl Assembly<'_> {
    fn is_periodic(&self) -> bool {
        self.polygon.is_periodic() && self.segments.len() == self.polygon.segments()
    }

    /// The parameter of the joint of a periodic curve.
    fn joint(&self) -> Option<f64> {
        self.is_periodic().then_some(self.segments.len() as f64)
    }

    /// Whether an interval meets a singular place, across the joint of a periodic curve as well.
    fn touches(&self, singular: &[[f64; 2]], [low, high]: [f64; 2]) -> bool {
        let turn = self.joint().unwrap_or(0.0);
        let meets = |place: &[f64; 2]| {
            [-turn, 0.0, turn]
                .iter()
                .any(|by| place[0] + by <= high && low <= place[1] + by)
        };
        singular.iter().any(meets)
    }

    fn walk(&self, quantity: Feature) -> SignWalk {
        // The quantity whose derivative is walked along jumps at the knots of this degree.
        let jumping = match quantity {
            Feature::CurvatureExtremum => Some(2),
            Feature::TorsionExtremum => Some(3),
            Feature::Inflection | Feature::TorsionZero => None,
        };
        let jumps = jumping == Some(self.polygon.degree());
        let pieces = |segment: usize| self.pieces(quantity, segment);
        let jump = |segment: usize| {
            if jumps {
                self.jump(quantity, segment)
            } else {
                0
            }
        };
        SignWalk::new((self.segments.len(), self.is_periodic()), pieces, jump)
    }

    /// The pieces in which the walk could not count changes.
    fn doubts(&self, walk: &SignWalk) -> Vec<[f64; 2]> {
        let pieces = walk.doubts.iter();
        pieces.map(|piece| self.interval(piece.places)).collect()
    }

    /// Find the intervals of the changes of a sign, in the order of u. Roots that touch another
    /// one, a singular place or an undecided piece are narrowed.
    fn find(
        &self,
        quantity: Feature,
        walk: &SignWalk,
        singular: &[[f64; 2]],
    ) -> Vec<ChangeInterval> {
        let changes = walk.changes.iter();
        let mut found: Vec<_> = changes
            .map(|change| ChangeInterval::new(*change, self.interval(change.places)))
            .collect();
        // A walk round a periodic curve sees its joint last: a change at the joint itself comes
        // before a root whose interval begins there.
        found.sort_by(|a, b| {
            let order = a.u[0].total_cmp(&b.u[0]);
            order.then(a.u[1].total_cmp(&b.u[1]))
        });
        let narrow = |found: &mut ChangeInterval| found.narrow(self.polygon, quantity);
        narrow_neighbours(&mut found, self.joint(), narrow);
        let doubts = self.doubts(walk);
        for found in &mut found {
            if self.touches(singular, found.u) || self.touches(&doubts, found.u) {
                narrow(found);
            }
        }
        found
    }

    fn pieces(&self, quantity: Feature, segment: usize) -> &[SignPiece] {
        let segment = &self.segments[segment];
        match quantity {
            Feature::Inflection => &segment.curvature,
            Feature::CurvatureExtremum => &segment.curvature_slope,
            Feature::TorsionZero => &segment.torsion,
            Feature::TorsionExtremum => &segment.torsion_slope,
        }
    }

    /// The sign of the jump at the start of a segment.
    fn jump(&self, quantity: Feature, segment: usize) -> i8 {
        let count = self.segments.len();
        let before = (segment + count - 1) % count;
        let [left, right] = [before, segment % count].map(|k| &self.segments[k]);
        let ([_, left], [right, _]) = if quantity == Feature::CurvatureExtremum {
            (left.end_curvature, right.end_curvature)
        } else {
            (left.end_torsion, right.end_torsion)
        };
        if left[1] < right[0] {
            1
        } else if right[1] < left[0] {
            -1
        } else if left == right && left[0] == left[1] {
            0
        } else {
            let [left, right] = ExactSegment::pair(self.polygon, before, self.polygon.is_planar());
            left.jump(&right, quantity)
        }
    }

    /// List the knots of a space curve at which the curvature is 0 and the torsion, which is
    /// divided by it, may jump at any degree.
    fn flat_knots(&self) -> Vec<[f64; 2]> {
        let count = self.segments.len();
        let before = |knot: usize| (knot + count - 1) % count;
        let unknown = |bounds: [f64; 2]| bounds[0] == f64::NEG_INFINITY;
        let may_be_flat = |knot: &usize| {
            let [left, right] = [before(*knot), *knot].map(|k| &self.segments[k]);
            unknown(left.end_torsion[1]) || unknown(right.end_torsion[0])
        };
        let is_flat = |knot: &usize| {
            let [left, right] = ExactSegment::pair(self.polygon, before(*knot), false);
            left.flattens(true) || right.flattens(false)
        };
        // Below degree 3 there is no torsion.
        let first = if self.polygon.degree() < 3 {
            count
        } else {
            usize::from(!self.is_periodic())
        };
        let knots = (first..count).filter(may_be_flat).filter(is_flat);
        knots.map(|knot| [knot as f64; 2]).collect()
    }

    fn interval(&self, [low, high]: [Place; 2]) -> [f64; 2] {
        self.within([low.rounded_down(), high.rounded_up()])
    }

    /// Take an interval that begins at the end of a periodic curve, or behind it, to its start.
    fn within(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        let end = self.segments.len() as f64;
        if self.is_periodic() && low >= end {
            [low - end, high - end]
        } else {
            [low, high]
        }
    }

    fn extrema(&self, found: &[ChangeInterval], quantity: Feature) -> Vec<Extremum> {
        let found = found.iter();
        found.map(|found| self.extremum(found, quantity)).collect()
    }

    fn extremum(&self, found: &ChangeInterval, quantity: Feature) -> Extremum {
        let change = found.change;
        let maximum = change.from > 0;
        let value = if change.is_root {
            change.value
        } else {
            let [low, high] = change.places.map(|place| self.value(place, quantity));
            let choose = if maximum { f64::max } else { f64::min };
            [choose(low[0], high[0]), choose(low[1], high[1])]
        };
        let kind = if maximum {
            ExtremumKind::Maximum
        } else {
            ExtremumKind::Minimum
        };
        Extremum {
            u: found.u,
            count: found.count,
            kind,
            value,
        }
    }

    /// Bound the curvature or torsion at an end of a segment, seen from inside.
    fn value(&self, place: Place, quantity: Feature) -> [f64; 2] {
        let index = place.segment % self.segments.len();
        let segment = &self.segments[index];
        let end = usize::from(place.t == 1.0);
        let bounds = match quantity {
            Feature::CurvatureExtremum => segment.end_curvature[end],
            _ => segment.end_torsion[end],
        };
        let exact = || ExactSegment::new(self.polygon, index, self.polygon.is_planar());
        if !values::is_known(bounds)
            && let Some(exact) = exact()
        {
            narrower(bounds, exact.enclose(quantity, [place.t; 2]))
        } else {
            bounds
        }
    }

    /// List the cusps of all segments; those that touch, as they do at knots, become one.
    fn cusps(&self) -> Vec<Cusp> {
        let mut cusps: Vec<Cusp> = Vec::new();
        for (segment, features) in self.segments.iter().enumerate() {
            for cusp in &features.cusps {
                let [low, high] = cusp.t.map(|t| Place { segment, t });
                let u = [low.rounded_down(), high.rounded_up()];
                cusps.push(Cusp {
                    u,
                    proved: cusp.proved,
                });
            }
        }
        cusps.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]));
        cusps.dedup_by(|next, last| join_cusps(last, next));
        let end = self.segments.len() as f64;
        // Across the joint of a periodic curve the last and the first may be one.
        if let [first, .., last] = cusps.as_mut_slice()
            && self.is_periodic()
            && join_cusps(
                last,
                &Cusp {
                    u: first.u.map(|u| u + end),
                    ..*first
                },
            )
        {
            *first = *last;
            first.u = self.within(last.u);
            let over_the_joint = first.u[0] > 0.0;
            cusps.pop();
            cusps.rotate_left(usize::from(over_the_joint));
        }
        cusps
    }
}

/// Lengthen a cusp's interval by the next one if they touch.
fn join_cusps(last: &mut Cusp, next: &Cusp) -> bool {
    let touch = next.u[0] <= last.u[1];
    if touch {
        last.u[1] = last.u[1].max(next.u[1]);
        last.proved |= next.proved;
    }
    touch
}

fn root(found: &ChangeInterval) -> Root {
    Root {
        u: found.u,
        count: found.count,
    }
}
