//! A document to the bit, so that −0 and 0 differ.

use std::fmt;

use batten::document::{Curve, CurveId, Document};
use batten::geometry::End;
use glam::DVec3;

/// Hold every bit of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    curves: Vec<(CurveId, Bits)>,
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
    /// The targets of start and end.
    pub targets: [Option<TargetBits>; 2],
}

/// Every bit of a target's point and direction.
type TargetBits = ([Bit; 3], Option<[Bit; 3]>);

/// A number that equals only the same bits.
#[derive(Clone, Copy)]
pub struct Bit(f64);

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
            Some((bits(target.point), target.direction.map(bits)))
        };
        let (degree, periodic) = (polygon.degree(), polygon.is_periodic());
        Self {
            named: (curve.name.clone(), curve.colour.map(|colour| colour.0)),
            visible: curve.visible,
            locked: curve.locked,
            shape: (degree, periodic, vertices.collect(), weights),
            targets: End::BOTH.map(target),
        }
    }
}

impl Snapshot {
    /// Take every bit of a document.
    pub fn of(document: &Document) -> Self {
        let curves = document.curves();
        Self {
            curves: curves.map(|(id, curve)| (id, Bits::of(curve))).collect(),
        }
    }

    /// List the curves.
    pub fn curves(&self) -> &[(CurveId, Bits)] {
        &self.curves
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
