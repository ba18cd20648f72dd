//! The plane of turning angles and length ratios, with a proof in every place.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::configuration::{Configuration, Format};
use crate::geometry::features::{Features, SegmentProver, Verdict};
use crate::geometry::progress::Progress;

/// Number of places of an atlas across and up.
pub const ATLAS_SIZE: usize = 200;

/// Spacing of the coarse picture's places.
const COARSE: usize = 8;

/// Points of the drawn bound of Bézier curves.
const BOUND_POINTS: usize = 128;

/// Describe an atlas: turning angles from 0° to 180° across, length ratios from 2⁻ᵒ to 2ᵒ up on a
/// logarithmic scale, where o is the number of octaves. Places are pairs of coordinates from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atlas {
    /// The polygon that the points are.
    pub format: Format,
    /// The number of legs.
    pub legs: usize,
    /// The torsion angle, in radians.
    pub torsion: f64,
    /// Octaves of ratios on either side of 1.
    pub octaves: f64,
    /// Whether the angles turn to the right: they count as negative then.
    pub clockwise: bool,
}

/// Proofs of an atlas's places so far.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasVerdicts {
    /// One a place, row by row from the lowest ratio up; those not proved yet have the verdict of
    /// the nearest place that is.
    verdicts: Vec<Verdict>,
    /// Spacing of the proved places.
    stride: usize,
}

/// Prove the places of an atlas, from a coarse picture to the finest.
#[derive(Debug)]
pub struct AtlasSearch {
    atlas: Atlas,
    prover: SegmentProver,
    found: AtlasVerdicts,
}

impl Atlas {
    /// Describe the atlas on which a configuration lies, of as many octaves as that needs, but two
    /// at least.
    pub fn around(configuration: &Configuration, format: Format, legs: usize) -> Self {
        /// The fewest octaves.
        const FEWEST: f64 = 2.0;
        Self {
            format,
            legs,
            torsion: configuration.torsion,
            octaves: configuration.ratio.log2().abs().ceil().max(FEWEST),
            clockwise: configuration.turn < 0.0,
        }
    }

    /// The turning angle in radians and the length ratio of a place; coordinates beyond 0 and 1 are
    /// those of the edge.
    pub fn at(&self, [across, up]: [f64; 2]) -> (f64, f64) {
        let sign = if self.clockwise { -1.0 } else { 1.0 };
        let turn = sign * PI * across.clamp(0.0, 1.0);
        let ratio = (self.octaves * (2.0 * up.clamp(0.0, 1.0) - 1.0)).exp2();
        (turn, ratio)
    }

    /// The place of a turning angle and a length ratio.
    pub fn place(&self, turn: f64, ratio: f64) -> [f64; 2] {
        let up = 0.5 + 0.5 * ratio.log2() / self.octaves;
        [turn.abs() / PI, up]
    }

    /// The bound between monotone and other curvatures of planar Bézier curves, s cos θ = 1 and
    /// s = cos θ, as two chains of places; nothing in space.
    pub fn bezier_bound(&self) -> Option<[Vec<[f64; 2]>; 2]> {
        let last = (-self.octaves).exp2().acos().min(FRAC_PI_2);
        let turns = (0..=BOUND_POINTS).map(|index| last * index as f64 / BOUND_POINTS as f64);
        let chain = |ratio: fn(f64) -> f64| -> Vec<[f64; 2]> {
            let turns = turns.clone();
            turns.map(|turn| self.place(turn, ratio(turn))).collect()
        };
        (self.torsion == 0.0).then(|| [chain(|turn| 1.0 / turn.cos()), chain(f64::cos)])
    }

    /// Prove whether the curvature is monotone at a turning angle in radians and a length ratio.
    ///
    /// As κ(u + 1) = κ(u) / s on a float polygon, one segment tells of all: from degree 3 on κ is
    /// continuous at the knots. At degree 2 it jumps there, and there are two segments to prove if
    /// the curve has several. Of planar Bézier curves the closed form is the proof,
    /// [`Configuration::bezier_extremum`]; in space the derivative of the curvature has a closed form too, whose
    /// signs are proved.
    pub fn verdict(&self, turn: f64, ratio: f64, prover: &mut SegmentProver) -> Verdict {
        let configuration = Configuration {
            start: DVec3::ZERO,
            first_leg: DVec3::X,
            ratio,
            turn,
            torsion: self.torsion,
        };
        let legs = match self.format {
            Format::Bezier if self.torsion == 0.0 => {
                // A single leg is straight.
                let extremum = configuration.bezier_extremum().filter(|_| self.legs > 1);
                return extremum.map_or(Verdict::Proved, |_| Verdict::Disproved);
            }
            Format::Bezier => {
                let velocity = configuration.bezier_velocity(self.legs);
                match prover.power_velocity(&velocity) {
                    // The float polygon nearest to the curve tells, with more digits.
                    Verdict::Undecided => self.legs,
                    verdict => return verdict,
                }
            }
            Format::Float { degree } => {
                let segments = if degree == 2 { 2 } else { 1 };
                self.legs.min(degree + segments - 1)
            }
        };
        let Ok(curve) = configuration.curve(self.format, legs) else {
            return Verdict::Undecided;
        };
        let polygon = curve.polygon;
        let segments = 0..polygon.segments();
        let proved: Vec<_> = segments
            .map(|segment| prover.segment(&polygon, segment))
            .collect();
        Features::assemble(&polygon, &proved).monotone
    }

    /// The place in the middle of a cell.
    fn cell(&self, column: usize, row: usize) -> (f64, f64) {
        let middle = |index: usize| (index as f64 + 0.5) / ATLAS_SIZE as f64;
        self.at([middle(column), middle(row)])
    }
}

impl AtlasVerdicts {
    /// The verdict of the cell in a column, counted from the smallest angle, and a row, counted from
    /// the lowest ratio.
    ///
    /// # Panics
    /// If there is no such cell.
    pub fn verdict(&self, column: usize, row: usize) -> Verdict {
        self.verdicts[row * ATLAS_SIZE + column]
    }

    /// Spacing in cells of the places with a proof of their own.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Whether every cell has a proof of its own.
    pub fn is_finest(&self) -> bool {
        self.stride == 1
    }
}

impl AtlasSearch {
    /// Prepare to prove an atlas.
    pub fn new(atlas: Atlas) -> Self {
        Self {
            atlas,
            prover: SegmentProver::new(atlas.torsion == 0.0),
            found: AtlasVerdicts {
                verdicts: vec![Verdict::Undecided; ATLAS_SIZE * ATLAS_SIZE],
                stride: 2 * COARSE,
            },
        }
    }

    /// Prove the places of the next finer picture. Returns whether it was done: not if `progress` is
    /// cancelled meanwhile.
    pub fn refine(&mut self, progress: &Progress) -> bool {
        if self.found.is_finest() {
            return true;
        }
        let (before, stride) = (self.found.stride, self.found.stride / 2);
        let is_first = stride == COARSE;
        for row in (0..ATLAS_SIZE).step_by(stride) {
            if progress.is_cancelled() {
                return false;
            }
            for column in (0..ATLAS_SIZE).step_by(stride) {
                let known = row.is_multiple_of(before) && column.is_multiple_of(before);
                if is_first || !known {
                    let (turn, ratio) = self.atlas.cell(column, row);
                    let verdict = self.atlas.verdict(turn, ratio, &mut self.prover);
                    self.found.verdicts[row * ATLAS_SIZE + column] = verdict;
                }
            }
        }
        self.found.stride = stride;
        self.fill();
        true
    }

    /// The proofs so far.
    pub fn found(&self) -> &AtlasVerdicts {
        &self.found
    }

    /// Give cells without a proof the verdict of the nearest one that has one.
    fn fill(&mut self) {
        let stride = self.found.stride;
        let last = (ATLAS_SIZE - 1) / stride * stride;
        let nearest = |index: usize| ((index + stride / 2) / stride * stride).min(last);
        for row in 0..ATLAS_SIZE {
            for column in 0..ATLAS_SIZE {
                let verdict = self.found.verdict(nearest(column), nearest(row));
                self.found.verdicts[row * ATLAS_SIZE + column] = verdict;
            }
        }
    }
}
