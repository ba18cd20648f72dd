//! Guides for moving vertices, found beside the frame: the safe region of a vertex, and the shortest
//! moves that lose a feature.

use std::sync::Arc;
use std::time::Duration;

use crate::document::Curve;
use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;
use crate::geometry::features::{Quantity, SegmentFeatures};
use crate::geometry::mineur_farin::{Atlas, AtlasSearch, AtlasVerdicts};
use crate::geometry::vertex_moves::{FeatureLoss, LossSearch, MoveError, RegionSearch, SafeRegion};

/// Find the guides of one vertex, of one feature and of one operation at a time.
#[derive(Debug, Default)]
pub struct Guides {
    /// The safe region of a vertex.
    pub regions: Finding<VertexOf, RegionStep>,
    /// The moves that lose a feature.
    pub losses: Finding<FeatureOf, Vec<FeatureLoss>>,
    /// What is proved of the plane of two parameters.
    pub atlas: Finding<Atlas, AtlasStep>,
}

/// Find what belongs to one question at a time: a newer one replaces it.
#[derive(Debug)]
pub struct Finding<Q, T> {
    worker: Worker<Found<T>>,
    question: Option<Q>,
    /// The number of the question, by which its answers are told from those to older ones.
    number: u64,
    answer: Option<Result<T, MoveError>>,
    /// Whether it failed, which would be a fault of the program.
    failed: bool,
}

/// An answer with the number of its question; nothing if the search was cancelled.
type Found<T> = (u64, Option<Result<T, MoveError>>);

/// A vertex of a curve.
#[derive(Clone, Debug)]
pub struct VertexOf {
    /// The curve.
    pub curve: Arc<Curve>,
    /// The vertex.
    pub vertex: usize,
}

/// A feature of a curve.
#[derive(Clone, Debug)]
pub struct FeatureOf {
    /// The curve.
    pub curve: Arc<Curve>,
    /// What the feature is.
    pub quantity: Quantity,
    /// Where it is.
    pub u: f64,
}

/// An atlas as far as it is found.
#[derive(Debug)]
pub struct AtlasStep {
    found: AtlasVerdicts,
    /// What finds the next level.
    search: Option<Box<AtlasSearch>>,
}

/// A safe region as far as it is found.
#[derive(Debug)]
pub struct RegionStep {
    region: SafeRegion,
    /// What finds the next level.
    search: Option<Box<RegionSearch>>,
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

impl<Q: PartialEq, T: Send + 'static> Default for Finding<Q, T> {
    /// Find at once, however long it takes.
    fn default() -> Self {
        Self::with(Worker::inline())
    }
}

impl Guides {
    /// Find on threads; `wake` is called when something is found later.
    pub fn background(wake: impl Fn() + Clone + Send + 'static) -> Self {
        Self {
            regions: Finding::with(Worker::background("safe region", wake.clone())),
            losses: Finding::with(Worker::background("feature losses", wake.clone())),
            atlas: Finding::with(Worker::background("atlas", wake)),
        }
    }
}

impl<Q: PartialEq, T: Send + 'static> Finding<Q, T> {
    /// What was found for the question that was asked last; an error says why nothing can be.
    pub fn answer(&self) -> Option<&Result<T, MoveError>> {
        self.answer.as_ref()
    }

    /// The question that was asked last.
    pub fn question(&self) -> Option<&Q> {
        self.question.as_ref()
    }

    /// Whether finding failed, for a fault of the program.
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    /// Forget the question.
    pub fn forget(&mut self) {
        if self.question.take().is_some() {
            self.worker.cancel();
            self.answer = None;
        }
    }

    fn with(worker: Worker<Found<T>>) -> Self {
        Self {
            worker,
            question: None,
            number: 0,
            answer: None,
            failed: false,
        }
    }

    /// Ask another question, unless it is the one that was asked last. Returns whether it is new.
    fn ask(&mut self, question: &Q) -> bool
    where
        Q: Clone,
    {
        if self.question.as_ref() == Some(question) {
            return false;
        }
        self.question = Some(question.clone());
        self.answer = None;
        self.failed = false;
        self.number += 1;
        true
    }

    /// Start a job for the present question, and don't wait for it.
    fn start(
        &mut self,
        job: impl FnOnce(&Progress) -> Option<Result<T, MoveError>> + Send + 'static,
    ) {
        let number = self.number;
        let job = move |progress: &Progress| (number, job(progress));
        let ready = self.worker.start(job, Duration::ZERO);
        self.take(ready);
    }

    /// Take what is ready.
    fn receive(&mut self) {
        let ready = self.worker.take();
        self.take(ready);
    }

    fn take(&mut self, ready: impl IntoIterator<Item = Outcome<Found<T>>>) {
        for outcome in ready {
            match outcome {
                Outcome::Done((number, Some(answer)))
                    if number == self.number && self.question.is_some() =>
                {
                    self.answer = Some(answer);
                }
                // It was asked before something else was, or cancelled.
                Outcome::Done(_) => {}
                Outcome::Panicked(_) => self.failed = true,
            }
        }
    }
}

impl Finding<VertexOf, RegionStep> {
    /// See to it that the safe region of a vertex is found, from coarse to fine, and take what is.
    pub fn advance(&mut self, vertex: &VertexOf) {
        self.receive();
        if self.ask(vertex) {
            let VertexOf { curve, vertex } = vertex.clone();
            let job = move |progress: &Progress| {
                let proved =
                    SegmentFeatures::of_curve(&curve.polygon, |_| !progress.is_cancelled())?;
                match RegionSearch::new(&curve.polygon, &proved, vertex) {
                    Ok(search) => next_level(Box::new(search), progress),
                    Err(error) => Some(Err(error)),
                }
            };
            self.start(job);
        } else if let Some(Ok(step)) = &mut self.answer
            && let Some(search) = step.search.take()
        {
            // One level a frame.
            let job = move |progress: &Progress| next_level(search, progress);
            self.start(job);
        }
    }

    /// The region as far as it is found.
    pub fn region(&self) -> Option<&SafeRegion> {
        let step = self.answer.as_ref()?.as_ref().ok()?;
        Some(&step.region)
    }
}

impl Finding<FeatureOf, Vec<FeatureLoss>> {
    /// See to it that the moves that lose a feature are found, and take them.
    pub fn advance(&mut self, feature: &FeatureOf) {
        self.receive();
        if self.ask(feature) {
            let FeatureOf { curve, quantity, u } = feature.clone();
            let job = move |progress: &Progress| {
                let polygon = &curve.polygon;
                let proved = &SegmentFeatures::of_curve(polygon, |_| !progress.is_cancelled())?;
                let search = LossSearch {
                    polygon,
                    proved,
                    quantity,
                    u,
                };
                search.run(progress).transpose()
            };
            self.start(job);
        }
    }
}

impl Finding<Atlas, AtlasStep> {
    /// See to it that an atlas is found, from coarse to fine, and take what is.
    pub fn advance(&mut self, atlas: &Atlas) {
        self.receive();
        if self.ask(atlas) {
            let search = Box::new(AtlasSearch::new(*atlas));
            self.start(move |progress: &Progress| next_picture(search, progress));
        } else if let Some(Ok(step)) = &mut self.answer
            && let Some(search) = step.search.take()
        {
            // One picture a frame.
            self.start(move |progress: &Progress| next_picture(search, progress));
        }
    }

    /// The atlas as far as it is found.
    pub fn found(&self) -> Option<&AtlasVerdicts> {
        let step = self.answer.as_ref()?.as_ref().ok()?;
        Some(&step.found)
    }
}

/// Find the next picture of an atlas; `None` if it is cancelled.
fn next_picture(
    mut search: Box<AtlasSearch>,
    progress: &Progress,
) -> Option<Result<AtlasStep, MoveError>> {
    let found = search.refine(progress);
    found.then(|| {
        let found = search.found().clone();
        Ok(AtlasStep {
            search: (!found.is_finest()).then_some(search),
            found,
        })
    })
}

/// Find the next level of a region; `None` if it is cancelled.
fn next_level(
    mut search: Box<RegionSearch>,
    progress: &Progress,
) -> Option<Result<RegionStep, MoveError>> {
    let found = search.refine(progress);
    found.then(|| {
        Ok(RegionStep {
            region: search.region().clone(),
            search: (!search.is_done()).then_some(search),
        })
    })
}
