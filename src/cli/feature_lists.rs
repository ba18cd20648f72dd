//! The proved features of a curve, as `batten inspect` prints them.

use serde::Serialize;

use crate::geometry::features::{Extremum, ExtremumKind, Features, Verdict};

/// The lists, each in the order of u.
#[derive(Serialize)]
pub(super) struct FeatureLists {
    inflections: Vec<Place>,
    curvature_extrema: Vec<CurvatureExtremum>,
    torsion_zeros: Vec<Place>,
    torsion_extrema: Vec<TorsionExtremum>,
    cusps: Vec<PossibleCusp>,
    undecided: Vec<[f64; 2]>,
    monotone: &'static str,
}

#[derive(Serialize)]
struct Place {
    u: [f64; 2],
}

#[derive(Serialize)]
struct CurvatureExtremum {
    u: [f64; 2],
    kind: &'static str,
    curvature: f64,
}

#[derive(Serialize)]
struct TorsionExtremum {
    u: [f64; 2],
    kind: &'static str,
    torsion: f64,
}

#[derive(Serialize)]
struct PossibleCusp {
    u: [f64; 2],
    proved: bool,
}

impl FeatureLists {
    /// Write down what was proved.
    pub(super) fn of(features: &Features) -> Self {
        let place = |u: &[f64; 2]| Place { u: *u };
        let curvature = |extremum: &Extremum| CurvatureExtremum {
            u: extremum.u,
            kind: kind(extremum),
            curvature: extremum.value,
        };
        let torsion = |extremum: &Extremum| TorsionExtremum {
            u: extremum.u,
            kind: kind(extremum),
            torsion: extremum.value,
        };
        let cusps = features.cusps.iter().map(|cusp| PossibleCusp {
            u: cusp.u,
            proved: cusp.proved,
        });
        let mut undecided: Vec<_> = features.undecided.iter().map(|doubt| doubt.u).collect();
        undecided.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        undecided.dedup();
        Self {
            inflections: features.inflections.iter().map(place).collect(),
            curvature_extrema: features.curvature_extrema.iter().map(curvature).collect(),
            torsion_zeros: features.torsion_zeros.iter().map(place).collect(),
            torsion_extrema: features.torsion_extrema.iter().map(torsion).collect(),
            cusps: cusps.collect(),
            undecided,
            monotone: match features.monotone {
                Verdict::Proved => "proved",
                Verdict::Disproved => "disproved",
                Verdict::Undecided => "undecided",
            },
        }
    }
}

fn kind(extremum: &Extremum) -> &'static str {
    match extremum.kind {
        ExtremumKind::Maximum => "max",
        ExtremumKind::Minimum => "min",
    }
}
