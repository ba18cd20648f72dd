//! Joints: where ends of visible curves and references meet, or nearly do.

use std::collections::BTreeMap;

use glam::DVec3;

use super::cache::AnalysisCache;
use super::item::Item;
use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace};
use crate::geometry::{Continuity, End, Jet, Joint};

/// The distance within which ends meet, by the length of the longest curve, unless the user gives one.
const MEETS: f64 = 1e-3;

/// The largest gap of a joint, by the length of the shorter curve: both ends of a short one are no joint.
const SHORT: f64 = 0.5;

/// The most joints that are listed.
const MOST: usize = 10_000;

/// Where two ends meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveJoint {
    /// Both ends: the second curve goes on from the first. They may be those of one curve.
    pub ends: [(CurveId, End); 2],
    /// The middle between them.
    pub point: DVec3,
    /// The differences, with the second curve passed away from the joint.
    pub joint: Joint,
    /// The highest level that holds; `None` of matched ends that do not meet.
    pub continuity: Option<Continuity>,
    /// The length of the shorter curve.
    pub size: f64,
}

impl CurveJoint {
    /// The name of the level that holds.
    pub fn name(&self) -> &'static str {
        self.continuity.map_or("open", Continuity::name)
    }

    /// The match that makes one of the two curves, 0 or 1, follow the other here.
    fn matched(&self, follower: usize, continuity: Continuity) -> Option<EndMatch> {
        let (curve, end) = *self.ends.get(follower)?;
        let (source, source_end) = *self.ends.get(1 - follower)?;
        Some(EndMatch {
            curve,
            end,
            source,
            place: MatchPlace::End(source_end),
            continuity,
            reversed: end == source_end,
        })
    }

    /// The edits by which one of the two curves, 0 or 1, follows the other here; what followed it no longer does.
    pub fn matching(
        &self,
        document: &Document,
        follower: usize,
        continuity: Continuity,
    ) -> Vec<Edit> {
        let back = self.match_in(document, 1 - follower);
        let remove = back.map(|it| Edit::RemoveMatch {
            curve: it.curve,
            end: it.end,
        });
        let set = self.matched(follower, continuity).map(Edit::SetMatch);
        remove.into_iter().chain(set).collect()
    }

    /// The match by which one of the two curves, 0 or 1, follows the other here, if a document has it.
    pub fn match_in<'a>(&self, document: &'a Document, follower: usize) -> Option<&'a EndMatch> {
        let asked = self.matched(follower, Continuity::G0)?;
        let found = document.match_of(asked.curve, asked.end)?;
        ((found.source, found.place) == (asked.source, asked.place)).then_some(found)
    }
}

/// The joints of a document, found again where it changed.
#[derive(Debug, Default)]
pub struct Joints {
    items: BTreeMap<CurveId, EndsOf>,
    matches: Vec<EndMatch>,
    tolerance: f64,
    found: Vec<CurveJoint>,
    is_cut: bool,
}

/// The ends of an open curve in a state.
#[derive(Debug)]
struct EndsOf {
    item: Item,
    planar: bool,
    length: f64,
    /// The jets at its start and its finish, along the curve.
    jets: [Jet; 2],
}

/// An end where joints are looked for.
#[derive(Clone, Copy)]
struct Place<'a> {
    id: CurveId,
    end: End,
    of: &'a EndsOf,
}

impl Joints {
    /// Find the joints within a distance, or within the usual one, of a document whose analyses are up to date.
    pub fn update(
        &mut self,
        document: &Document,
        analyses: &AnalysisCache,
        tolerance: Option<f64>,
    ) {
        let is_seen = |id: &CurveId| document.is_visible(*id);
        let count = self.items.len();
        self.items
            .retain(|id, ends| is_seen(id) && ends.item.is_of(document, *id));
        let mut changed = self.items.len() != count;
        for id in document.all_ids().filter(is_seen) {
            if self.items.contains_key(&id) {
                continue;
            }
            if let Some(ends) = EndsOf::find(document, analyses, id) {
                self.items.insert(id, ends);
                changed = true;
            }
        }
        if !self.matches.iter().eq(document.matches()) {
            self.matches = document.matches().copied().collect();
            changed = true;
        }
        let lengths = self.items.values().map(|it| it.length);
        let tolerance = tolerance.unwrap_or(MEETS * lengths.fold(0.0, f64::max));
        if changed || self.tolerance != tolerance {
            self.tolerance = tolerance;
            self.find();
        }
    }

    /// The joints, in the order of the curves.
    pub fn all(&self) -> &[CurveJoint] {
        &self.found
    }

    /// Whether there are more than are listed.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// The distance within which ends meet.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn find(&mut self) {
        let mut found = Vec::new();
        let places = self
            .items
            .iter()
            .flat_map(|(id, of)| End::BOTH.map(|end| Place { id: *id, end, of }));
        let places: Vec<Place> = places.collect();
        let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (index, place) in places.iter().enumerate() {
            let cell = self.cell(place.point());
            for near in neighbours(cell) {
                for other in cells.get(&near).into_iter().flatten() {
                    let joint = joint_of(places[*other], *place, self.tolerance);
                    found.extend(joint);
                }
            }
            if found.len() > MOST {
                break;
            }
            cells.entry(cell).or_default().push(index);
        }
        self.is_cut = found.len() > MOST;
        found.truncate(MOST);
        let open = self.matches.iter().filter_map(|it| self.open(it));
        found.extend(open);
        found.sort_by_key(|joint| joint.ends);
        self.found = found;
    }

    /// The joint of matched ends that do not meet.
    fn open(&self, matched: &EndMatch) -> Option<CurveJoint> {
        let MatchPlace::End(source_end) = matched.place else {
            return None;
        };
        let place = |id: CurveId, end: End| {
            let of = self.items.get(&id)?;
            Some(Place { id, end, of })
        };
        let own = place(matched.curve, matched.end)?;
        let source = place(matched.source, source_end)?;
        let [one, other] = match own.id < source.id {
            true => [own, source],
            false => [source, own],
        };
        let joint = of_ends(one, other, self.tolerance);
        joint.continuity.is_none().then_some(joint)
    }

    /// The cell of a grid in which ends that meet lie at most one apart.
    fn cell(&self, point: DVec3) -> [i64; 3] {
        let step = self.tolerance.max(f64::MIN_POSITIVE);
        // The cast takes what is too large to the last cell.
        (point / step).floor().to_array().map(|it| it as i64)
    }
}

/// A cell and those around it.
fn neighbours(cell: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let around = |at: i64| [at.saturating_sub(1), at, at.saturating_add(1)];
    let [x, y, z] = cell.map(around);
    let mut all: Vec<[i64; 3]> = Vec::with_capacity(27);
    for x in x {
        for y in y {
            all.extend(z.map(|z| [x, y, z]));
        }
    }
    all.dedup();
    all.into_iter()
}

impl EndsOf {
    /// The ends of a curve or a reference; `None` if it has none, as points and what is closed.
    fn find(document: &Document, analyses: &AnalysisCache, id: CurveId) -> Option<Self> {
        let reference = document.reference(id);
        if reference.is_some_and(|it| !it.curve.form().is_smooth()) {
            return None;
        }
        let shape = document.shape(id)?;
        let at = |end: End| MatchPlace::End(end).jet(shape);
        let jets = [at(End::Start)?, at(End::Finish)?];
        Some(Self {
            item: Item::of(document, id)?,
            planar: shape.is_planar(),
            length: analyses.sampled(id)?.samples.length(),
            jets,
        })
    }
}

impl Place<'_> {
    fn jet(&self, end: End) -> &Jet {
        match end {
            End::Start => &self.of.jets[0],
            End::Finish => &self.of.jets[1],
        }
    }

    fn point(&self) -> DVec3 {
        self.jet(self.end).point
    }

    /// The jet here, passed so that the curve ends here or begins here.
    fn passed(&self, finishes: bool) -> Jet {
        let jet = self.jet(self.end);
        match (self.end == End::Finish) == finishes {
            true => *jet,
            false => jet.turned(),
        }
    }
}

/// The joint of two ends, the one of the earlier curve given first, if they meet.
fn joint_of(one: Place<'_>, other: Place<'_>, tolerance: f64) -> Option<CurveJoint> {
    let found = of_ends(one, other, tolerance);
    let is_joint = found.continuity.is_some() && found.joint.gap <= SHORT * found.size;
    is_joint.then_some(found)
}

/// The differences of two ends, the one of the earlier curve given first.
fn of_ends(one: Place<'_>, other: Place<'_>, tolerance: f64) -> CurveJoint {
    // A curve that finishes here comes first.
    let [before, after] = match (one.end, other.end) {
        (End::Start, End::Finish) => [other, one],
        _ => [one, other],
    };
    let planar = one.of.planar && other.of.planar;
    let joint = Joint::between(&before.passed(true), &after.passed(false), planar);
    let size = one.of.length.min(other.of.length);
    CurveJoint {
        ends: [before, after].map(|it| (it.id, it.end)),
        point: before.point().midpoint(after.point()),
        joint,
        continuity: joint.continuity(tolerance, size),
        size,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::FloatPolygon;

    fn polygon(points: &[(f64, f64)]) -> FloatPolygon {
        FloatPolygon::planar(3, points).expect("a polygon")
    }

    /// Three parts of a curve, cut at knots, the middle one turned round.
    fn parts() -> Document {
        let points = (0..14).map(|it| (f64::from(it), (0.7 * f64::from(it)).sin()));
        let whole = polygon(&points.collect::<Vec<_>>());
        let cut = |from: f64, to: f64| whole.trimmed(from, to, 0).expect("a part").polygon;
        let parts = [cut(0.0, 4.0), cut(4.0, 7.0).reversed(), cut(7.0, 11.0)];
        let curves = parts.map(|polygon| Curve::new("part", polygon));
        Document::from_curves(curves)
    }

    fn joints(document: &Document, tolerance: Option<f64>) -> Joints {
        let mut analyses = AnalysisCache::default();
        analyses.update(document);
        let mut joints = Joints::default();
        joints.update(document, &analyses, tolerance);
        joints
    }

    #[test]
    fn parts_of_a_curve_meet_with_all_that_it_has() {
        let document = parts();
        let ids: Vec<CurveId> = document.ids().collect();
        let found = joints(&document, Some(1e-9));
        let ends: Vec<_> = found.all().iter().map(|it| it.ends).collect();
        let expected = [
            [(ids[0], End::Finish), (ids[1], End::Finish)],
            [(ids[1], End::Start), (ids[2], End::Start)],
        ];
        assert_eq!(ends, expected);
        for joint in found.all() {
            // A cubic is C² at its knots.
            assert_eq!(joint.continuity, Some(Continuity::G2));
            assert!(joint.joint.gap < 1e-14 && joint.joint.angle < 1e-7);
            assert!(joint.joint.curvature.abs() < 1e-12);
        }
    }

    #[test]
    fn a_match_made_of_a_joint_holds_its_level() {
        for follower in [0, 1] {
            let mut document = parts();
            let joint = joints(&document, None).all()[0];
            let matched = joint.matched(follower, Continuity::G3).expect("a match");
            assert_eq!(joint.match_in(&document, follower), None);
            let back = joint.matching(&document, 1 - follower, Continuity::G1);
            document = document.edited(back).expect("an edit");
            let edits = joint.matching(&document, follower, Continuity::G3);
            document = document.edited(edits).expect("an edit");
            assert!(document.meets(&matched));
            assert_eq!(joint.match_in(&document, follower), Some(&matched));
            assert_eq!(joint.match_in(&document, 1 - follower), None);
            let after = joints(&document, None).all()[0];
            assert_eq!(after.continuity, Some(Continuity::G3));
        }
    }

    #[test]
    fn hidden_and_periodic_curves_have_no_joints() {
        let mut document = parts();
        let middle = document.ids().nth(1).expect("a curve");
        let mut analyses = AnalysisCache::default();
        let mut joints = Joints::default();
        let mut count = |document: &Document| {
            analyses.update(document);
            joints.update(document, &analyses, None);
            joints.all().len()
        };
        assert_eq!(count(&document), 2);
        let hide = |visible| Edit::SetVisible {
            curve: middle,
            visible,
        };
        document = document.edited([hide(false)]).expect("an edit");
        assert_eq!(count(&document), 0);
        document = document.edited([hide(true)]).expect("an edit");
        assert_eq!(count(&document), 2);
        let ring = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        let ring = FloatPolygon::new(3, ring.vertices().to_vec(), None, true);
        let ring = Curve::new("ring", ring.expect("a polygon"));
        assert_eq!(count(&Document::from_curves([ring])), 0);
    }

    #[test]
    fn the_ends_of_one_curve_meet_unless_it_is_short() {
        let turn = |it: i32| 0.5 * std::f64::consts::PI * f64::from(it);
        let round = (0..7).map(|it| (turn(it).cos(), turn(it).sin()));
        let closed = polygon(&round.collect::<Vec<_>>());
        let document = Document::from_curves([Curve::new("closed", closed)]);
        let found = joints(&document, None);
        let id = document.ids().next().expect("a curve");
        let ends: Vec<_> = found.all().iter().map(|it| it.ends).collect();
        assert_eq!(ends, [[(id, End::Finish), (id, End::Start)]]);
        let wide = joints(&document, Some(1e3));
        assert_eq!(wide.all().len(), 1);
        let line = polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
        let document = Document::from_curves([Curve::new("line", line)]);
        assert_eq!(joints(&document, Some(10.0)).all(), []);
    }

    #[test]
    fn a_star_of_many_ends_is_listed_in_part_and_says_so() {
        let ray = |index: i32| {
            let (sine, cosine) = f64::from(index).sin_cos();
            let at = |radius: f64| (radius * cosine, radius * sine);
            let points = [at(-1.0), at(1.0), at(2.0), at(3.0)];
            Curve::new("ray", FloatPolygon::planar(2, &points).expect("a polygon"))
        };
        let star = |count| Document::from_curves((0..count).map(ray));
        let few = joints(&star(20), None);
        assert_eq!((few.all().len(), few.is_cut()), (20 * 19 / 2, false));
        let many = joints(&star(200), None);
        assert_eq!((many.all().len(), many.is_cut()), (MOST, true));
    }
}
