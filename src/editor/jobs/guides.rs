//! Guides for moving vertices: the safe region of a vertex, the shortest moves that lose a feature, and
//! the atlas of an operation. Regions and atlases arrive from coarse to fine, one level a frame.

use std::sync::Arc;

use super::Client;
use crate::document::Curve;
use crate::geometry::Progress;
use crate::geometry::features::{Feature, SegmentFeatures};
use crate::geometry::mineur_farin::{Atlas, AtlasSearch, AtlasVerdicts};
use crate::geometry::vertex_moves::{FeatureLoss, LossSearch, MoveError, RegionSearch, SafeRegion};

/// Find the guides of one vertex, of one feature and of one operation at a time.
#[derive(Debug, Default)]
pub struct Guides {
    /// The safe region of a vertex.
    pub regions: Guide<VertexOf, Step<SafeRegion, RegionSearch>>,
    /// The moves that lose a feature.
    pub losses: Guide<FeatureOf, Vec<FeatureLoss>>,
    /// The verdicts on the plane of two parameters.
    pub atlas: Guide<Atlas, Step<AtlasVerdicts, AtlasSearch>>,
}

/// A client whose searches can fail with a reason for the user.
pub type Guide<Q, T> = Client<Q, Result<T, MoveError>>;

/// A vertex of a curve.
#[derive(Clone, Debug)]
pub struct VertexOf {
    /// The curve.
    pub curve: Arc<Curve>,
    /// The number of the vertex.
    pub vertex: usize,
}

/// A feature of a curve.
#[derive(Clone, Debug)]
pub struct FeatureOf {
    /// The curve.
    pub curve: Arc<Curve>,
    /// The quantity that has the feature.
    pub quantity: Feature,
    /// The parameter of the feature.
    pub u: f64,
}

/// One level of a search.
#[derive(Debug)]
pub struct Step<T, S> {
    /// The result at this level.
    pub level: T,
    /// The search for the next level; `None` at the finest.
    search: Option<Box<S>>,
}

/// A search from coarse to fine.
pub trait Search<T>: Sized {
    /// Find the next level, unless it is cancelled.
    fn next_level(self: Box<Self>, progress: &Progress)
    -> Option<Result<Step<T, Self>, MoveError>>;
}

impl PartialEq for VertexOf {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.curve, &other.curve) && self.vertex == other.vertex
    }
}

impl PartialEq for FeatureOf {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.curve, &other.curve)
            && self.quantity == other.quantity
            && self.u == other.u
    }
}

impl Search<SafeRegion> for RegionSearch {
    fn next_level(
        mut self: Box<Self>,
        progress: &Progress,
    ) -> Option<Result<Step<SafeRegion, Self>, MoveError>> {
        self.refine(progress).then(|| {
            Ok(Step {
                level: self.region().clone(),
                search: (!self.is_done()).then_some(self),
            })
        })
    }
}

impl Search<AtlasVerdicts> for AtlasSearch {
    fn next_level(
        mut self: Box<Self>,
        progress: &Progress,
    ) -> Option<Result<Step<AtlasVerdicts, Self>, MoveError>> {
        self.refine(progress).then(|| {
            let level = self.found().clone();
            Ok(Step {
                search: (!level.is_finest()).then_some(self),
                level,
            })
        })
    }
}

impl Guides {
    /// Find guides on threads, which call `wake` when one is found.
    pub fn background(wake: impl Fn() + Clone + Send + 'static) -> Self {
        Self {
            regions: Client::background("safe region", wake.clone()),
            losses: Client::background("feature losses", wake.clone()),
            atlas: Client::background("atlas", wake),
        }
    }

    /// Search for what is to be shown, forget the rest, and take the results.
    pub fn advance(
        &mut self,
        vertex: Option<VertexOf>,
        feature: Option<FeatureOf>,
        atlas: Option<Atlas>,
    ) {
        let search = |VertexOf { curve, vertex }| {
            move |progress: &Progress| {
                let polygon = &curve.polygon;
                let proved = SegmentFeatures::of_curve(polygon, |_| !progress.is_cancelled())?;
                match RegionSearch::new(polygon, &proved, vertex) {
                    Ok(search) => Box::new(search).next_level(progress),
                    Err(error) => Some(Err(error)),
                }
            }
        };
        if !self.regions.advance(vertex, None, search) {
            refine(&mut self.regions);
        }
        self.losses.advance(feature, None, |feature| {
            move |progress: &Progress| {
                let polygon = &feature.curve.polygon;
                let proved = &SegmentFeatures::of_curve(polygon, |_| !progress.is_cancelled())?;
                let FeatureOf { quantity, u, .. } = feature;
                let search = LossSearch {
                    polygon,
                    proved,
                    quantity,
                    u,
                };
                search.run(progress).transpose()
            }
        });
        let search =
            |atlas| move |progress: &_| Box::new(AtlasSearch::new(atlas)).next_level(progress);
        if !self.atlas.advance(atlas, None, search) {
            refine(&mut self.atlas);
        }
    }
}

/// Start the search for the next level if one has arrived.
fn refine<Q, T, S>(guide: &mut Guide<Q, Step<T, S>>)
where
    T: Send + 'static,
    S: Search<T> + Send + 'static,
{
    if let Some(Ok(step)) = guide.result_mut()
        && let Some(search) = step.search.take()
    {
        guide.go_on(move |progress: &Progress| search.next_level(progress), None);
    }
}
