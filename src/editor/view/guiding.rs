//! The guides for moving vertices on the canvas: the safe region of the selected vertex, and the moves
//! that lose the chosen feature.

use std::sync::Arc;

use glam::DVec2;

use crate::document::Curve;
use crate::editor::jobs::guides::{FeatureOf, VertexOf};
use crate::editor::view::feature_report::FeatureKind;
use crate::editor::view::layers::Layer;
use crate::editor::view::outline::GAP;
use crate::editor::view::overlay::Overlay;
use crate::editor::view::scene::{GuideLabel, GuideScene, LossArrow};
use crate::editor::view::shown::Shown;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;
use crate::geometry::features::Feature;
use crate::geometry::mineur_farin::{Atlas, AtlasVerdicts};
use crate::geometry::vertex_moves::{FeatureLoss, FeatureRise, RayBorder, SafeRegion};
use crate::geometry::{FloatPolygon, significant};

/// The most texts at the border of a safe region.
const BORDER_LABELS: usize = 5;

/// The least share of the rays that a text at the border speaks of.
const LEAST_SHARE: f64 = 1.0 / 40.0;

/// The most moves that lose a feature with their distance written at them.
const MOVE_LABELS: usize = 3;

/// The digits of distances.
const DIGITS: usize = 3;

impl View {
    /// The middle of the interval of the feature that is chosen.
    pub fn chosen_feature(&self) -> Option<f64> {
        self.chosen.as_ref().map(|feature| feature.u)
    }

    /// The plane of an operation's atlas and the verdicts proved so far, while a panel shows it.
    pub fn atlas(&self) -> Option<(&Atlas, &AtlasVerdicts)> {
        let step = self.guides.atlas.result()?.as_ref().ok()?;
        Some((self.guides.atlas.request()?, &step.level))
    }

    pub(super) fn choose_feature(&mut self, u: f64, shown: Shown<'_>) {
        let chosen = self.sight(shown).feature_at(u);
        let is_same = chosen.is_some() && chosen == self.chosen;
        self.chosen = chosen.filter(|_| !is_same);
    }

    /// Request the guides that are to be shown, and take those that are found.
    pub(in crate::editor) fn guide(&mut self, shown: Shown<'_>, overlay: &Overlay) {
        let settled = shown.settled_active();
        let counts =
            |feature: &FeatureOf| settled.is_some_and(|curve| Arc::ptr_eq(curve, &feature.curve));
        self.chosen = self.chosen.take().filter(counts);
        let vertex = guided_vertex(shown).filter(|_| overlay.guides);
        let atlas = overlay.atlas.filter(|_| self.shows_atlas);
        self.guides.advance(vertex, self.chosen.clone(), atlas);
    }
}

/// The vertex whose safe region is to be shown: the only one that is selected, of the active curve, where it
/// can be moved and its images do not move the same segments.
fn guided_vertex(shown: Shown<'_>) -> Option<VertexOf> {
    if !shown.layers.shows(Layer::SafeRegion) {
        return None;
    }
    let (id, vertex) = shown.only_vertex()?;
    let curve = shown
        .settled_active()
        .filter(|_| shown.active() == Some(id))?;
    curve.check_editable().ok()?;
    curve.check_vertices_unlocked([vertex]).ok()?;
    let curve = curve.clone();
    (!overlaps_image(&curve, vertex)).then_some(VertexOf { curve, vertex })
}

impl Sight<'_> {
    fn feature_at(self, u: f64) -> Option<FeatureOf> {
        let rows = self.features()?.rows.iter();
        let row = rows.into_iter().find(|row| row.middle == u)?;
        let quantity = match row.kind {
            FeatureKind::Inflection => Feature::Inflection,
            FeatureKind::CurvatureMaximum | FeatureKind::CurvatureMinimum => {
                Feature::CurvatureExtremum
            }
            _ => return None,
        };
        let curve = self.shown.settled_active()?.clone();
        Some(FeatureOf { curve, quantity, u })
    }

    /// Draw the guides that are still valid for the curve on the canvas.
    pub(super) fn draw_guides(self, scene: &mut GuideScene) {
        scene.clear();
        let active = self.active().and_then(|id| self.document().curve(id));
        let Some(shown) = active.filter(|curve| curve.visible) else {
            return;
        };
        let own = self.shown.only_vertex();
        let own = own.filter(|(id, _)| Some(*id) == self.active());
        let own = own.filter(|_| self.shown.layers.shows(Layer::SafeRegion));
        if let Some((_, vertex)) = own.filter(|(_, vertex)| overlaps_image(shown, *vertex)) {
            let at = shown.polygon.vertex(vertex).truncate();
            let text = "No safe region: its image moves the same segments".to_owned();
            scene.labels.push(self.guide_label(at, DVec2::Y, text));
        }
        let regions = &self.view.guides.regions;
        if let Some(VertexOf { curve, vertex }) = regions.request()
            && differs_at_most_at(curve, &shown.polygon, Some(*vertex))
        {
            let failure = match regions.result() {
                Some(Err(reason)) => Some(format!("No safe region: {reason}")),
                Some(Ok(step)) => {
                    self.draw_region(&step.level, scene);
                    None
                }
                None => regions.failure().map(|_| {
                    "The safe region could not be found: please report this curve".to_owned()
                }),
            };
            let at = curve.polygon.vertex(*vertex).truncate();
            let label = failure.map(|text| self.guide_label(at, DVec2::Y, text));
            scene.labels.extend(label);
        }
        let losses = &self.view.guides.losses;
        if let Some(feature) = losses.request()
            && differs_at_most_at(&feature.curve, &shown.polygon, None)
        {
            let found = match losses.result() {
                Some(Ok(found)) => Ok(found.as_slice()),
                Some(Err(reason)) => Err(reason.to_string()),
                None if losses.failure().is_some() => {
                    Err("Moves could not be found: please report this curve".to_owned())
                }
                None => Err("Looking for the shortest move that loses this…".to_owned()),
            };
            self.draw_losses(feature, found, scene);
        }
    }

    fn draw_region(self, region: &SafeRegion, scene: &mut GuideScene) {
        let corners: Vec<DVec2> = region.outline().collect();
        let rays = &region.rays;
        let seen = corners.iter().map(|corner| self.seen(*corner)).collect();
        scene.region = Some((self.seen(region.centre.truncate()), seen));
        for (index, corner) in corners.iter().enumerate() {
            let next = (index + 1) % corners.len();
            let is_open = |index: usize| rays[index].beyond.is_none();
            let chain = if is_open(index) && is_open(next) {
                &mut scene.limit
            } else {
                &mut scene.border
            };
            let ends = [*corner, corners[next]].map(|corner| self.seen(corner));
            if chain.last() != Some(&ends[0]) {
                chain.extend([GAP, ends[0]]);
            }
            chain.push(ends[1]);
        }
        let mut runs = runs(rays);
        runs.sort_by_key(|run| std::cmp::Reverse(run.length));
        let least = LEAST_SHARE * rays.len() as f64;
        let runs = runs.iter().filter(|run| run.length as f64 >= least);
        for run in runs.take(BORDER_LABELS) {
            let middle = (run.first + run.length / 2) % rays.len();
            let text = match run.rise {
                Some(rise) => rise.text(),
                None => format!("Nothing added within {}", significant(region.limit, DIGITS)),
            };
            let label = self.guide_label(corners[middle], rays[middle].direction, text);
            scene.labels.push(label);
        }
    }

    fn draw_losses(
        self,
        feature: &FeatureOf,
        found: Result<&[FeatureLoss], String>,
        scene: &mut GuideScene,
    ) {
        let at = feature.curve.polygon.point(feature.u).truncate();
        let losses = match found {
            Ok(losses) => losses,
            Err(text) => {
                scene.labels.push(self.guide_label(at, DVec2::Y, text));
                return;
            }
        };
        let locked = &feature.curve.locked_vertices;
        let mut moves: Vec<(f64, &FeatureLoss)> = losses
            .iter()
            .filter(|loss| !locked.contains(loss.vertex))
            .filter_map(|loss| Some((loss.distance()?, loss)))
            .collect();
        moves.sort_by(|a, b| a.0.total_cmp(&b.0));
        if moves.is_empty() {
            let limits = losses.iter().map(|loss| loss.limit);
            let text = format!(
                "No move of one vertex found within {} that loses this",
                significant(limits.fold(0.0, f64::max), DIGITS)
            );
            scene.labels.push(self.guide_label(at, DVec2::Y, text));
        }
        for (rank, (distance, loss)) in moves.iter().enumerate() {
            let Some(to) = loss.to else {
                continue;
            };
            let [from, to] = [loss.from, to].map(|place| place.truncate());
            scene.arrows.push(LossArrow {
                ends: [self.seen(from), self.seen(to)],
                is_shortest: rank == 0,
            });
            if rank < MOVE_LABELS {
                let text = format!("Vertex {}: {}", loss.vertex, significant(*distance, DIGITS));
                let outwards = (to - from).normalize_or(DVec2::Y);
                scene.labels.push(self.guide_label(to, outwards, text));
            }
        }
    }

    /// A text at a place of the plane, on the side of a direction.
    fn guide_label(self, at: DVec2, outwards: DVec2, text: String) -> GuideLabel {
        GuideLabel {
            at: self.seen(at),
            outwards: self.seen(outwards) - self.seen(DVec2::ZERO),
            text,
        }
    }

    /// Where a place of the plane z = 0 is seen.
    fn seen(self, place: DVec2) -> DVec2 {
        self.viewport().flatten(place.extend(0.0))
    }
}

/// Neighbouring rays beyond whose borders the same is added.
struct Run {
    first: usize,
    length: usize,
    rise: Option<FeatureRise>,
}

/// List the runs of rays, round the vertex.
fn runs(rays: &[RayBorder]) -> Vec<Run> {
    let rise = |index: usize| rays[index % rays.len()].beyond.map(|(_, rise)| rise);
    let count = rays.len();
    let starts = (0..count).filter(|index| rise(index + count - 1) != rise(*index));
    let starts: Vec<usize> = starts.collect();
    if starts.is_empty() {
        // A single text stands below: what is told of the vertex stands above.
        let heights = rays.iter().map(|ray| ray.direction.y).enumerate();
        let lowest = heights.min_by(|a, b| a.1.total_cmp(&b.1));
        let all = lowest.map(|(lowest, _)| Run {
            first: lowest + count - count / 2,
            length: count,
            rise: rise(0),
        });
        return all.into_iter().collect();
    }
    let ends = starts.iter().skip(1).copied();
    let ends = ends.chain([starts[0] + count]);
    let runs = starts.iter().zip(ends).map(|(first, end)| Run {
        first: *first,
        length: end - first,
        rise: rise(*first),
    });
    runs.collect()
}

/// Whether a polygon is that of a curve but for one vertex, a given one or any, and its images.
fn differs_at_most_at(curve: &Curve, now: &FloatPolygon, vertex: Option<usize>) -> bool {
    let before = &curve.polygon;
    if std::ptr::eq(before, now) {
        return true;
    }
    let pairs = before.vertices().iter().zip(now.vertices());
    let moved = pairs.enumerate().filter(|(_, (before, now))| before != now);
    let mut moved = moved.map(|(index, _)| index).peekable();
    let own = vertex.or(moved.peek().copied());
    let own = own.map_or_else(Vec::new, |vertex| curve.dependents(vertex));
    let alike = before.has_numbers_of(now) && before.weights() == now.weights();
    alike && moved.all(|index| own.contains(&index))
}

/// Whether a vertex moves segments of the curve that an image of it moves too.
fn overlaps_image(curve: &Curve, vertex: usize) -> bool {
    let polygon = &curve.polygon;
    let (count, degree) = (polygon.vertices().len(), polygon.degree());
    curve.dependents(vertex).iter().skip(1).any(|image| {
        let apart = image.abs_diff(vertex);
        let apart = match polygon.is_periodic() {
            true => apart.min(count - apart),
            false => apart,
        };
        apart <= degree
    })
}
