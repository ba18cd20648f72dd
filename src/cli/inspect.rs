//! `batten inspect`: curves and references as JSON.

use anyhow::bail;
use glam::DVec3;
use serde::Serialize;

use super::ends::Source;
use super::feature_lists::FeatureLists;
use super::inspected_reference::InspectedReference;
use super::output::{self, Messages, OneByOne};
use super::progress::Progress;
use crate::document::Curve;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::features::Features;
use crate::geometry::{ClampedPolygon, End, FloatPolygon, Jet};
use crate::io::{Place, Reading};

/// Levels of curvature and torsion that are printed.
const LEVELS: usize = 3;

/// The relative error allowed in lengths.
const LENGTH_TOLERANCE: f64 = 1e-13;

/// Print the curves of a file, evaluated at some parameters, and its references.
pub(super) fn run(source: &Source, at: &[f64]) -> anyhow::Result<()> {
    let Reading {
        curves,
        references,
        unit,
        ..
    } = source.read(&Messages::Printed)?;
    for (index, curve) in curves.iter().enumerate() {
        let last = curve.polygon.segments() as f64;
        if let Some(u) = at.iter().find(|u| !(0.0..=last).contains(*u)) {
            let place = Place::curve(index + 1, &curve.name);
            bail!(
                "{}: {place}: the parameter {u} of --at lies outside the curve's domain, 0 to {last}",
                source.name()
            );
        }
    }
    let mut progress = Progress::new();
    let count = curves.len();
    let features = curves.iter().enumerate().map(|(index, curve)| {
        let segments = curve.polygon.segments();
        let told = |segment| {
            let (curve, segment) = (index + 1, segment + 1);
            progress.tell(format_args!(
                "proving features: curve {curve} of {count}, segment {segment} of {segments}"
            ));
            true
        };
        Features::proved(&curve.polygon, told).unwrap_or_default()
    });
    let features: Vec<Features> = features.collect();
    drop(progress);
    let unit = unit.map(LengthUnit::symbol);
    let curves = curves.iter().zip(&features);
    let curves = OneByOne::new(curves.map(|(curve, features)| inspected(curve, at, features)));
    let references = OneByOne::new(references.iter().map(|it| InspectedReference::of(it)));
    output::print_json(&Report {
        unit,
        curves,
        references,
    })
}

#[derive(Serialize)]
#[serde(bound = "")]
struct Report<C: Iterator<Item = Inspected>, R: Iterator<Item = InspectedReference>> {
    /// The unit of all coordinates; null if the file says none.
    unit: Option<&'static str>,
    curves: OneByOne<C>,
    references: OneByOne<R>,
}

#[derive(Serialize)]
struct Inspected {
    name: String,
    /// The path of its group; empty if it has none.
    group: String,
    degree: usize,
    dimension: usize,
    periodic: bool,
    float: Vec<Vec<f64>>,
    weights: Option<Vec<f64>>,
    clamped: Vec<Vec<f64>>,
    clamped_weights: Option<Vec<f64>>,
    domain: [f64; 2],
    length: f64,
    ends: Option<Ends>,
    at: Vec<At>,
    features: FeatureLists,
}

#[derive(Serialize)]
struct Ends {
    start: EndReport,
    end: EndReport,
}

#[derive(Serialize)]
struct EndReport {
    point: Vec<f64>,
    tangent: Option<Vec<f64>>,
    curvature: f64,
}

#[derive(Serialize)]
struct At {
    u: f64,
    point: Vec<f64>,
    d1: Vec<f64>,
    d2: Vec<f64>,
    d3: Vec<f64>,
    /// By level; numbers that are infinite or none become null.
    curvature: [f64; LEVELS],
    /// By level, in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    torsion: Option<[f64; LEVELS]>,
    evolute: Option<Vec<f64>>,
}

/// How the vectors and curvatures of a curve are printed: planar ones with 2 numbers and signed.
struct Space {
    dimension: usize,
}

impl Space {
    fn of(polygon: &FloatPolygon) -> Self {
        Self {
            dimension: if polygon.is_planar() { 2 } else { 3 },
        }
    }

    fn vector(&self, vector: DVec3) -> Vec<f64> {
        vector.to_array()[..self.dimension].to_vec()
    }

    fn vectors(&self, vectors: &[DVec3]) -> Vec<Vec<f64>> {
        vectors.iter().map(|vector| self.vector(*vector)).collect()
    }

    fn curvature(&self, jet: &Jet) -> f64 {
        jet.curvature_of(self.dimension == 2)
    }
}

fn inspected(curve: &Curve, at: &[f64], features: &Features) -> Inspected {
    let polygon = &curve.polygon;
    let space = Space::of(polygon);
    let clamped = ClampedPolygon::from_float(polygon);
    let end = |end| {
        let jet = polygon.end_jet(end);
        EndReport {
            point: space.vector(jet.point),
            tangent: jet.tangent().map(|tangent| space.vector(tangent)),
            curvature: space.curvature(&jet),
        }
    };
    Inspected {
        name: curve.name.clone(),
        group: curve.group.to_string(),
        degree: polygon.degree(),
        dimension: space.dimension,
        periodic: polygon.is_periodic(),
        float: space.vectors(polygon.vertices()),
        weights: polygon.weights().map(<[f64]>::to_vec),
        clamped: space.vectors(clamped.vertices()),
        clamped_weights: clamped.weights().map(<[f64]>::to_vec),
        domain: [0.0, polygon.segments() as f64],
        length: polygon.arc_length(LENGTH_TOLERANCE),
        ends: (!polygon.is_periodic()).then(|| Ends {
            start: end(End::Start),
            end: end(End::Finish),
        }),
        at: at.iter().map(|u| evaluated(polygon, &space, *u)).collect(),
        features: FeatureLists::of(features),
    }
}

/// The levels that are printed.
fn lowest(levels: [f64; 4]) -> [f64; LEVELS] {
    std::array::from_fn(|level| levels[level])
}

fn evaluated(polygon: &FloatPolygon, space: &Space, u: f64) -> At {
    let jet = polygon.jet(u);
    let levels = polygon.curvature_levels(u, 1.0);
    At {
        u,
        point: space.vector(jet.point),
        d1: space.vector(jet.first),
        d2: space.vector(jet.second),
        d3: space.vector(jet.third),
        curvature: lowest(levels.curvature),
        torsion: levels.torsion.map(lowest),
        evolute: jet.centre_of_curvature().map(|centre| space.vector(centre)),
    }
}
