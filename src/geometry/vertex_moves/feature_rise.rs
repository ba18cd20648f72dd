//! Which proved counts are greater than before.

use crate::geometry::features::{Feature, Features};
use crate::geometry::wording::noun;

/// Count the features that are there after a move in addition to those before, of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FeatureRise {
    /// Extrema of the curvature.
    pub curvature_extrema: usize,
    /// Inflections.
    pub inflections: usize,
    /// Cusps.
    pub cusps: usize,
    /// Places where features may lie that could not be counted.
    pub undecided: usize,
}

impl FeatureRise {
    /// Compare the counts of a planar curve: for each kind, how many more there are, at least 0.
    pub fn between(before: &Features, after: &Features) -> Self {
        let rise = |count: fn(&Features) -> usize| count(after).saturating_sub(count(before));
        Self {
            curvature_extrema: rise(|features| features.count(Feature::CurvatureExtremum)),
            inflections: rise(|features| features.count(Feature::Inflection)),
            cusps: rise(proved_cusps),
            undecided: rise(doubts),
        }
    }

    /// Whether nothing was added: a curvature that is proved to be monotone stays so.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// Name the added features: "+1 curvature extremum, +2 inflections", "undecided".
    pub fn text(self) -> String {
        let added = |count: usize, one: &str, many: &str| {
            (count > 0).then(|| format!("+{count} {}", noun(count, one, many)))
        };
        let parts = [
            added(
                self.curvature_extrema,
                "curvature extremum",
                "curvature extrema",
            ),
            added(self.inflections, "inflection", "inflections"),
            added(self.cusps, "cusp", "cusps"),
            (self.undecided > 0).then(|| "undecided".to_owned()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// Count the places where something may lie that could not be counted.
pub(super) fn doubts(features: &Features) -> usize {
    features.undecided.len() + features.cusps.len() - proved_cusps(features)
}

fn proved_cusps(features: &Features) -> usize {
    features.cusps.iter().filter(|cusp| cusp.proved).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_added_is_named() {
        let rise = FeatureRise {
            curvature_extrema: 1,
            inflections: 2,
            ..FeatureRise::default()
        };
        assert_eq!(rise.text(), "+1 curvature extremum, +2 inflections");
        let doubt = FeatureRise {
            undecided: 3,
            ..FeatureRise::default()
        };
        assert_eq!(doubt.text(), "undecided");
        assert!(!doubt.is_none() && FeatureRise::default().is_none());
    }
}
