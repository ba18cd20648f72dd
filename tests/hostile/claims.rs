//! What is said of a curve, in one form for all quantities.

use batten::geometry::features::{Extremum, ExtremumKind, Feature, Features, Root};

/// A proved feature, or several.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    pub u: [f64; 2],
    pub count: usize,
    pub extremum: Option<(ExtremumKind, [f64; 2])>,
}

/// The proved features of a quantity.
pub fn claims(features: &Features, quantity: Feature) -> Vec<Claim> {
    match quantity {
        Feature::Inflection => of_roots(&features.inflections),
        Feature::CurvatureExtremum => of_extrema(&features.curvature_extrema),
        Feature::TorsionZero => of_roots(&features.torsion_zeros),
        Feature::TorsionExtremum => of_extrema(&features.torsion_extrema),
    }
}

fn of_roots(roots: &[Root]) -> Vec<Claim> {
    let claim = |root: &Root| Claim {
        u: root.u,
        count: root.count,
        extremum: None,
    };
    roots.iter().map(claim).collect()
}

fn of_extrema(extrema: &[Extremum]) -> Vec<Claim> {
    let claim = |extremum: &Extremum| Claim {
        u: extremum.u,
        count: extremum.count,
        extremum: Some((extremum.kind, extremum.value)),
    };
    extrema.iter().map(claim).collect()
}
