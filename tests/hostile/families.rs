//! The hostile families by name.

use batten::geometry::FloatPolygon;

use crate::common::Random;
use crate::form::{Form, Reach};
use crate::{coincident, cusps, double_roots, nearly, scales, symmetric};

/// A way to make curves from random numbers; `None` where the form asked for leaves none.
type Generator = fn(&mut Random, Form) -> Option<FloatPolygon>;

/// A family of curves that are hard to judge.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    pub name: &'static str,
    generator: Generator,
}

pub const NEARLY_STRAIGHT: Family = family("nearly straight", nearly::straight);
pub const NEARLY_CIRCULAR: Family = family("nearly circular", nearly::circular);
pub const SYMMETRIC: Family = family("symmetric about a knot", symmetric::about_a_knot);
pub const EXTREMA_ON_KNOTS: Family = family("extrema on knots", symmetric::extrema_on_knots);
pub const REPEATED: Family = family("repeated vertices", coincident::repeated);
pub const COLLINEAR: Family = family("collinear vertices", coincident::collinear);
pub const CUSP: Family = family("exact cusp", cusps::one);
pub const CUSPS: Family = family("several cusps in a segment", cusps::several);
pub const NEAR_CUSP: Family = family("near-cusp", cusps::near);
pub const MULTIPLE_ROOTS: Family = family("multiple roots", double_roots::multiple_roots);
pub const MIXED_SCALES: Family = family("mixed scales", scales::mixed);

/// All of them.
pub const FAMILIES: [Family; 11] = [
    NEARLY_STRAIGHT,
    NEARLY_CIRCULAR,
    SYMMETRIC,
    EXTREMA_ON_KNOTS,
    REPEATED,
    COLLINEAR,
    CUSP,
    CUSPS,
    NEAR_CUSP,
    MULTIPLE_ROOTS,
    MIXED_SCALES,
];

const fn family(name: &'static str, generator: Generator) -> Family {
    Family { name, generator }
}

impl Family {
    /// Make the curve of a seed: the same one whenever it is asked for.
    pub fn curve(&self, seed: u64, reach: Reach) -> FloatPolygon {
        let name = self.name.bytes().fold(seed, |hash, byte| {
            hash.wrapping_mul(0x0100_0000_01b3) ^ u64::from(byte)
        });
        let mut random = Random(name);
        let mut attempt = || {
            let form = Form::random(&mut random, reach);
            (self.generator)(&mut random, form)
        };
        let curve = (0..1000).find_map(|_| attempt());
        curve.expect("one of a thousand forms can be made")
    }
}
