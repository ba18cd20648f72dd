//! Which numbers of features change, in words.

use crate::geometry::FloatPolygon;
use crate::geometry::features::{Feature, Features};

/// Say which numbers of features differ between a polygon and another one.
pub fn feature_change(before: &FloatPolygon, now: &FloatPolygon) -> Option<String> {
    changed_features([before, now].map(feature_counts))
}

/// How many curvature extrema and inflections a curve has.
pub fn feature_counts(polygon: &FloatPolygon) -> [usize; 2] {
    let features = Features::new(polygon);
    [Feature::CurvatureExtremum, Feature::Inflection].map(|kind| features.count(kind))
}

/// Say which numbers of features change.
pub fn changed_features(features: [[usize; 2]; 2]) -> Option<String> {
    let kinds = ["extrema", "inflections"].into_iter().enumerate();
    let changed = kinds.filter_map(|(kind, name)| {
        let [before, now] = features.map(|counts| counts[kind]);
        (before != now).then(|| format!("{name} {before} before, {now} now"))
    });
    let changed: Vec<String> = changed.collect();
    (!changed.is_empty()).then(|| changed.join(", "))
}
