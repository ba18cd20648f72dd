//! The features of a whole curve, put together from those of its segments.

use super::exact_numerators::ExactSegment;
use super::feature::{
    Cusp, Extremum, ExtremumKind, Features, Quantity, Trend, TrendPiece, Undecided, Verdict,
};
use super::segment_features::{SegmentFeatures, SegmentProver};
use super::sign_piece::SignPiece;
use super::sign_walk::{Change, Place, SignWalk};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;

impl Features {
    /// Prove the features of a whole curve.
    ///
    /// To follow a drag, keep the segments' features ([`SegmentProver::segment`]), redo those of
    /// the n + 1 segments that a vertex touches and put them together again with
    /// [`Features::assemble`].
    pub fn new(polygon: &FloatPolygon) -> Self {
        let mut prover = SegmentProver::new(polygon.is_planar());
        let segments = 0..polygon.segments();
        let segments: Vec<_> = segments.map(|k| prover.segment(polygon, k)).collect();
        Self::assemble(polygon, &segments)
    }

    /// Put the features of all segments together, joining them at the knots, in time
    /// proportional to their number. Segments that are missing end the curve.
    ///
    /// At a knot κ is continuous from degree 3 on and κ′ from degree 4 on (torsion: 4 and 5). An
    /// extremum sits on the knot where the slope changes its sign there. At degree 2 (torsion:
    /// 3) the quantity itself jumps, and the jump counts as a vertical piece of its graph: rising,
    /// up, falling is one maximum; rising, down, rising is a maximum and a minimum, both at the
    /// knot; rising, up, rising is none. Polylines, of degree 1, have curvature 0; their corners
    /// are not features. The ends of an open curve are not inside its domain.
    pub fn assemble(polygon: &FloatPolygon, segments: &[SegmentFeatures]) -> Self {
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
        let walk = assembly.walk(Quantity::Inflection);
        features.inflections = features.take(&assembly, Quantity::Inflection, &walk, interval);
        let walk = assembly.walk(Quantity::CurvatureExtremum);
        let planar = polygon.is_planar();
        let curvature = |jet: Jet| jet.curvature_of(planar);
        features.curvature_extrema = features.take(
            &assembly,
            Quantity::CurvatureExtremum,
            &walk,
            |change, u| assembly.extremum(change, u, curvature),
        );
        features.trends = trends(&walk);
        features.monotone = features.verdict();
        if !planar {
            let walk = assembly.walk(Quantity::TorsionZero);
            features.torsion_zeros =
                features.take(&assembly, Quantity::TorsionZero, &walk, interval);
            let walk = assembly.walk(Quantity::TorsionExtremum);
            features.torsion_extrema =
                features.take(&assembly, Quantity::TorsionExtremum, &walk, |change, u| {
                    assembly.extremum(change, u, |jet| jet.torsion())
                });
        }
        features
    }

    /// Turn the changes of a sign into features, but for those at a cusp, which are added to
    /// the undecided pieces together with the walk's own.
    fn take<T>(
        &mut self,
        assembly: &Assembly,
        quantity: Quantity,
        walk: &SignWalk,
        feature: impl Fn(&Change, [f64; 2]) -> T,
    ) -> Vec<T> {
        let mut features = Vec::with_capacity(walk.changes.len());
        for change in &walk.changes {
            let u = assembly.interval(change.places);
            if assembly.touches(&self.cusps, u) {
                self.undecided.push(Undecided {
                    u,
                    quantity,
                    certain: false,
                });
            } else {
                features.push(feature(change, u));
            }
        }
        for doubt in &walk.doubts {
            let u = assembly.interval(doubt.places);
            let certain = doubt.changed && !assembly.touches(&self.cusps, u);
            self.undecided.push(Undecided {
                u,
                quantity,
                certain,
            });
        }
        features
    }

    fn verdict(&self) -> Verdict {
        let mut doubts = self
            .undecided
            .iter()
            .filter(|doubt| doubt.quantity == Quantity::CurvatureExtremum)
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

/// A curve and what is known of its segments.
struct Assembly<'a> {
    polygon: &'a FloatPolygon,
    segments: &'a [SegmentFeatures],
}

impl Assembly<'_> {
    fn is_periodic(&self) -> bool {
        self.polygon.is_periodic() && self.segments.len() == self.polygon.segments()
    }

    /// Whether an interval meets that of a cusp, across the joint of a periodic curve as well.
    fn touches(&self, cusps: &[Cusp], [low, high]: [f64; 2]) -> bool {
        let turn = if self.is_periodic() {
            self.segments.len() as f64
        } else {
            0.0
        };
        let meets = |cusp: &Cusp| {
            [-turn, 0.0, turn]
                .iter()
                .any(|by| cusp.u[0] + by <= high && low <= cusp.u[1] + by)
        };
        cusps.iter().any(meets)
    }

    fn walk(&self, quantity: Quantity) -> SignWalk {
        // The quantity whose derivative is walked along jumps at the knots of this degree.
        let jumping = match quantity {
            Quantity::CurvatureExtremum => Some(2),
            Quantity::TorsionExtremum => Some(3),
            Quantity::Inflection | Quantity::TorsionZero => None,
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

    fn pieces(&self, quantity: Quantity, segment: usize) -> &[SignPiece] {
        let segment = &self.segments[segment];
        match quantity {
            Quantity::Inflection => &segment.curvature,
            Quantity::CurvatureExtremum => &segment.curvature_slope,
            Quantity::TorsionZero => &segment.torsion,
            Quantity::TorsionExtremum => &segment.torsion_slope,
        }
    }

    /// The sign of the jump at the start of a segment.
    fn jump(&self, quantity: Quantity, segment: usize) -> i8 {
        let count = self.segments.len();
        let before = (segment + count - 1) % count;
        let [left, right] = [before, segment % count].map(|k| &self.segments[k]);
        let ([_, left], [right, _]) = if quantity == Quantity::CurvatureExtremum {
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

    fn extremum(&self, change: &Change, u: [f64; 2], quantity: impl Fn(Jet) -> f64) -> Extremum {
        let maximum = change.from > 0;
        let at = |place: Place| {
            let segment = place.segment % self.segments.len();
            quantity(self.polygon.segment_jet(segment, place.t))
        };
        let value = change.value.unwrap_or_else(|| {
            let [low, high] = change.places.map(at);
            if maximum {
                low.max(high)
            } else {
                low.min(high)
            }
        });
        let kind = if maximum {
            ExtremumKind::Maximum
        } else {
            ExtremumKind::Minimum
        };
        Extremum { u, kind, value }
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

fn interval(_: &Change, u: [f64; 2]) -> [f64; 2] {
    u
}

fn trends(walk: &SignWalk) -> Vec<TrendPiece> {
    let pieces = walk.runs.iter().map(|run| TrendPiece {
        u: [run.places[0].rounded_up(), run.places[1].rounded_down()],
        trend: match run.sign {
            0 => Trend::Constant,
            sign if sign > 0 => Trend::Rising,
            _ => Trend::Falling,
        },
    });
    pieces.collect()
}
