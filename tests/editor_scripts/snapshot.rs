//! A document to the bit, so that −0 and 0 differ.

use std::fmt;

use batten::document::{Curve, CurveId, Document, MatchPlace};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{Continuity, End};
use glam::DVec3;

/// Hold every bit of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    unit: Option<LengthUnit>,
    curves: Vec<(CurveId, Bits)>,
    /// References, written out, so that −0 and 0 differ.
    references: Vec<(CurveId, String)>,
    matches: Vec<MatchBits>,
}

/// Every bit of a match: the end that follows, the curve and place that it follows, how much, and
/// whether it runs the other way.
type MatchBits = ((CurveId, End), (CurveId, PlaceBits), Continuity, bool);

/// Every bit of a place: an end, or a parameter.
#[derive(Clone, Debug, PartialEq)]
enum PlaceBits {
    End(End),
    Parameter(Bit),
}

/// Hold every bit of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Bits {
    /// Its name and colour.
    pub named: (String, Option<[u8; 3]>),
    /// Whether it is visible.
    pub visible: bool,
    /// Whether it is locked.
    pub locked: bool,
    /// Degree, whether it is periodic, vertices and weights.
    pub shape: (usize, bool, Vec<[Bit; 3]>, Option<Vec<Bit>>),
    /// Its locked vertices.
    pub locked_vertices: Vec<usize>,
    /// The targets of start and end.
    pub targets: [Option<TargetBits>; 2],
    /// Through which points, with which normals, the planes of its symmetry go.
    pub symmetry: Vec<[[Bit; 3]; 2]>,
}

/// Every bit of a target: point, direction, normal, curvature and slope.
type TargetBits = ([Bit; 3], [Option<[Bit; 3]>; 2], [Option<Bit>; 2]);

/// A number that equals only the same bits.
#[derive(Clone, Copy)]
pub struct Bit(f64);

impl Bit {
    /// The weight of a vertex of a polynomial curve.
    pub const ONE: Self = Self(1.0);

    /// Whether the one number is the other with the other sign.
    pub fn is_opposite(&self, other: &Self) -> bool {
        self.0 == -other.0
    }
}

impl PartialEq for Bit {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl fmt::Debug for Bit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:?}", self.0)
    }
}

impl Bits {
    fn of(curve: &Curve) -> Self {
        let polygon = &curve.polygon;
        let vertices = polygon.vertices().iter().map(|vertex| bits(*vertex));
        let weights = polygon.weights();
        let weights = weights.map(|all| all.iter().map(|weight| Bit(*weight)).collect());
        let target = |end| {
            let target = curve.targets.get(end)?;
            let vectors = [target.direction, target.normal];
            let numbers = [target.curvature, target.slope];
            Some((
                bits(target.point),
                vectors.map(|vector| vector.map(bits)),
                numbers.map(|number| number.map(Bit)),
            ))
        };
        let (degree, periodic) = (polygon.degree(), polygon.is_periodic());
        Self {
            named: (curve.name.clone(), curve.colour.map(|colour| colour.0)),
            visible: curve.visible,
            locked: curve.locked,
            shape: (degree, periodic, vertices.collect(), weights),
            locked_vertices: curve.locked_vertices.iter().collect(),
            targets: End::BOTH.map(target),
            symmetry: planes(curve).map(|plane| plane.map(bits)).collect(),
        }
    }
}

/// The planes of a curve's symmetry: a point and the normal of each.
fn planes(curve: &Curve) -> impl Iterator<Item = [DVec3; 2]> {
    let symmetry = curve.symmetry.into_iter();
    let mirrors = symmetry.flat_map(|it| [Some(it.mirror()), it.second()]);
    mirrors.flatten().filter_map(|mirror| mirror.plane())
}

impl Snapshot {
    /// Take every bit of a document.
    pub fn of(document: &Document) -> Self {
        let curves = document.curves();
        let matches = document.matches().map(|matched| {
            let place = match matched.place {
                MatchPlace::End(end) => PlaceBits::End(end),
                MatchPlace::Parameter(u) => PlaceBits::Parameter(Bit(u)),
            };
            let own = (matched.curve, matched.end);
            (
                own,
                (matched.source, place),
                matched.continuity,
                matched.reversed,
            )
        });
        let references = document.references();
        let references = references.map(|(id, reference)| (id, format!("{reference:?}")));
        Self {
            unit: document.unit(),
            references: references.collect(),
            matches: matches.collect(),
            curves: curves.map(|(id, curve)| (id, Bits::of(curve))).collect(),
        }
    }

    /// List the curves.
    pub fn curves(&self) -> &[(CurveId, Bits)] {
        &self.curves
    }

    /// Whether an end of a curve is matched to another.
    pub fn follows(&self, id: CurveId) -> bool {
        let mut matches = self.matches.iter();
        matches.any(|((curve, _), ..)| *curve == id)
    }

    /// Find a curve.
    pub fn curve(&self, id: CurveId) -> Option<&Bits> {
        let found = self.curves.iter().find(|(other, _)| *other == id);
        found.map(|(_, bits)| bits)
    }
}

fn bits(vector: DVec3) -> [Bit; 3] {
    vector.to_array().map(Bit)
}
