//! References as `batten inspect` prints them.

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::analysis::{ReferenceAnalysis, SampledFeature, SampledKind};
use crate::document::Reference;
use crate::geometry::references::ReferenceForm;

/// The printed figures of a reference.
#[derive(Serialize)]
pub(super) struct InspectedReference {
    name: String,
    /// The path of its group; empty if it has none.
    group: String,
    kind: &'static str,
    /// As the command line reads it; points have no text.
    text: Option<String>,
    /// Numbers by their names, or formulas by their coordinates.
    parameters: Map<String, Value>,
    /// Points as they are placed, if it is a list of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<[f64; 3]>>,
    interval: [f64; 2],
    placement: Placement,
    features: SampledFeatures,
}

/// What samples show of a smooth curve, by its parameter t: nothing is proved.
#[derive(Serialize)]
struct SampledFeatures {
    sampled: bool,
    inflections: Vec<f64>,
    curvature_extrema: Vec<SampledExtremum>,
    cusps: Vec<f64>,
    curvature_jumps: Vec<f64>,
}

#[derive(Serialize)]
struct SampledExtremum {
    t: f64,
    kind: &'static str,
    curvature: f64,
}

/// A rotation about the origin, then a scale, then a translation.
#[derive(Serialize)]
struct Placement {
    /// The quaternion x, y, z, w.
    rotation: [f64; 4],
    scale: f64,
    translation: [f64; 3],
}

impl InspectedReference {
    /// Collect the printed figures.
    pub(super) fn of(reference: &Reference) -> Self {
        let curve = &reference.curve;
        let placement = curve.placement();
        let points = reference.points();
        Self {
            name: reference.name.clone(),
            group: reference.group.to_string(),
            kind: curve.form().name(),
            text: curve.form().has_text().then(|| curve.to_string()),
            parameters: parameters(curve.form()),
            points: points.map(|points| points.iter().map(|it| it.to_array()).collect()),
            interval: curve.interval(),
            placement: Placement {
                rotation: placement.rotation().to_array(),
                scale: placement.scale(),
                translation: placement.translation().to_array(),
            },
            features: match curve.form().is_smooth() {
                true => SampledFeatures::of(reference),
                false => SampledFeatures::none(),
            },
        }
    }
}

impl SampledFeatures {
    /// Straight lines have none.
    fn none() -> Self {
        Self {
            sampled: true,
            inflections: Vec::new(),
            curvature_extrema: Vec::new(),
            cusps: Vec::new(),
            curvature_jumps: Vec::new(),
        }
    }

    fn of(reference: &Reference) -> Self {
        let analysis = ReferenceAnalysis::new(Arc::new(reference.clone()));
        let at = |feature: &SampledFeature| reference.curve.parameter(feature.u);
        let places = |kind: SampledKind| {
            let features = analysis.features().iter();
            let found = features.filter(|feature| feature.kind == kind).map(at);
            found.collect()
        };
        let extremum = |feature: &SampledFeature| {
            let kind = match feature.kind {
                SampledKind::Maximum => "max",
                SampledKind::Minimum => "min",
                SampledKind::Inflection | SampledKind::Cusp | SampledKind::Jump => return None,
            };
            Some(SampledExtremum {
                t: at(feature),
                kind,
                curvature: feature.curvature,
            })
        };
        Self {
            sampled: true,
            inflections: places(SampledKind::Inflection),
            curvature_extrema: analysis.features().iter().filter_map(extremum).collect(),
            cusps: places(SampledKind::Cusp),
            curvature_jumps: places(SampledKind::Jump),
        }
    }
}

fn parameters(form: &ReferenceForm) -> Map<String, Value> {
    match form {
        ReferenceForm::Analytic(form) => {
            let parameters = form.kind().parameters.iter().zip(form.values());
            let named = parameters.map(|(it, value)| (it.name.to_owned(), json!(value)));
            named.collect()
        }
        ReferenceForm::Formula(formula) => {
            let texts = ["x", "y", "z"].into_iter().zip(formula.texts());
            let given = texts.filter_map(|(name, text)| Some((name.to_owned(), json!(text?))));
            given.collect()
        }
        ReferenceForm::Points(_) => Map::new(),
        ReferenceForm::Frame(frame) => {
            let size = [("width", frame.size().x), ("height", frame.size().y)].into_iter();
            size.map(|(name, value)| (name.to_owned(), json!(value)))
                .collect()
        }
        ReferenceForm::Nurbs(nurbs) => {
            let points = nurbs.points().iter().map(|it| it.to_array());
            let points: Vec<[f64; 3]> = points.collect();
            let named = [
                ("degree", json!(nurbs.degree())),
                ("knots", json!(nurbs.knots())),
                ("points", json!(points)),
                ("weights", json!(nurbs.weights())),
                ("periodic", json!(nurbs.is_periodic())),
            ];
            let named = named.into_iter();
            named
                .map(|(name, value)| (name.to_owned(), value))
                .collect()
        }
    }
}
