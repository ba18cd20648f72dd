//! The proved features of a curve, as `batten inspect` prints them.

use serde::Serialize;
use serde_json::value::RawValue;

use crate::geometry::features::{
    Extremum, ExtremumKind, Feature, Features, Root, Undecided, Verdict, certain_text,
};

/// The most digits of a number that are printed.
const DIGITS: usize = 17;

/// The lists, each in the order of u.
#[derive(Serialize)]
pub(super) struct FeatureLists {
    inflections: Vec<Place>,
    curvature_extrema: Vec<CurvatureExtremum>,
    torsion_zeros: Vec<Place>,
    torsion_extrema: Vec<TorsionExtremum>,
    cusps: Vec<PossibleCusp>,
    undecided: Vec<[f64; 2]>,
    undecided_of: Vec<UndecidedPiece>,
    monotone: &'static str,
}

#[derive(Serialize)]
struct Place {
    u: [f64; 2],
    #[serde(skip_serializing_if = "is_one")]
    count: usize,
}

#[derive(Serialize)]
struct CurvatureExtremum {
    u: [f64; 2],
    #[serde(skip_serializing_if = "is_one")]
    count: usize,
    kind: &'static str,
    /// All digits are certain; null if none is.
    curvature: Option<Box<RawValue>>,
}

#[derive(Serialize)]
struct TorsionExtremum {
    u: [f64; 2],
    #[serde(skip_serializing_if = "is_one")]
    count: usize,
    kind: &'static str,
    /// All digits are certain; null if none is.
    torsion: Option<Box<RawValue>>,
}

#[derive(Serialize)]
struct PossibleCusp {
    u: [f64; 2],
    proved: bool,
}

/// An undecided piece and the list that features may be missing from.
#[derive(Serialize)]
struct UndecidedPiece {
    u: [f64; 2],
    quantity: &'static str,
}

impl FeatureLists {
    /// List the proved features.
    pub(super) fn of(features: &Features) -> Self {
        let place = |root: &Root| Place {
            u: root.u,
            count: root.count,
        };
        let curvature = |extremum: &Extremum| CurvatureExtremum {
            u: extremum.u,
            count: extremum.count,
            kind: kind(extremum),
            curvature: digits(extremum),
        };
        let torsion = |extremum: &Extremum| TorsionExtremum {
            u: extremum.u,
            count: extremum.count,
            kind: kind(extremum),
            torsion: digits(extremum),
        };
        let cusps = features.cusps.iter().map(|cusp| PossibleCusp {
            u: cusp.u,
            proved: cusp.proved,
        });
        let mut doubts = features.undecided.clone();
        doubts.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]).then(a.u[1].total_cmp(&b.u[1])));
        let mut undecided: Vec<_> = doubts.iter().map(|doubt| doubt.u).collect();
        undecided.dedup();
        let piece = |doubt: &Undecided| UndecidedPiece {
            u: doubt.u,
            quantity: list_of(doubt.quantity),
        };
        Self {
            inflections: features.inflections.iter().map(place).collect(),
            curvature_extrema: features.curvature_extrema.iter().map(curvature).collect(),
            torsion_zeros: features.torsion_zeros.iter().map(place).collect(),
            torsion_extrema: features.torsion_extrema.iter().map(torsion).collect(),
            cusps: cusps.collect(),
            undecided,
            undecided_of: doubts.iter().map(piece).collect(),
            monotone: match features.monotone {
                Verdict::Proved => "proved",
                Verdict::Disproved => "disproved",
                Verdict::Undecided => "undecided",
            },
        }
    }
}

/// The certain digits of an extremum's value, as they are written.
fn digits(extremum: &Extremum) -> Option<Box<RawValue>> {
    RawValue::from_string(certain_text(extremum.value, DIGITS)?).ok()
}

fn kind(extremum: &Extremum) -> &'static str {
    match extremum.kind {
        ExtremumKind::Maximum => "max",
        ExtremumKind::Minimum => "min",
    }
}

/// The list that features of a kind are in.
fn list_of(quantity: Feature) -> &'static str {
    match quantity {
        Feature::Inflection => "inflections",
        Feature::CurvatureExtremum => "curvature_extrema",
        Feature::TorsionZero => "torsion_zeros",
        Feature::TorsionExtremum => "torsion_extrema",
    }
}

fn is_one(count: &usize) -> bool {
    *count == 1
}
