//! Operations that take a curve as it is and give it another polygon: degrees, subdivision,
//! extension, division, rounding. Each says how far the curve moved.

use crate::analysis::FeatureProof;
use crate::document::{Curve, CurveId, Edit};
use crate::editor::Editor;
use crate::editor::reply::{Note, Reply};
use crate::geometry::features::{Features, Quantity, Undecided};
use crate::geometry::{
    Amplification, Approximation, ClampedPolygon, End, FloatPolygon, MAX_DEGREE, PolygonError,
    PolygonKind, figure,
};

/// Where a curve is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Division {
    /// Into the parts before and behind a parameter.
    Split(f64),
    /// Keep what lies between two parameters.
    Trim(f64, f64),
}

/// What dividing a curve would come to.
#[derive(Clone, Debug, PartialEq)]
pub struct DivisionReport {
    /// The parts: one or two.
    pub parts: Vec<Approximation>,
}

impl DivisionReport {
    /// Whether every part is the curve itself.
    pub fn is_exact(&self) -> bool {
        self.parts.iter().all(|part| part.exact)
    }

    /// How far the parts are off the curve at most.
    pub fn deviation(&self) -> f64 {
        let parts = self.parts.iter().map(|part| part.deviation);
        parts.fold(0.0, f64::max)
    }
}

/// What rounding a polygon's coordinates would come to.
#[derive(Debug)]
pub struct RoundingReport {
    /// The float polygon afterwards.
    pub polygon: FloatPolygon,
    /// The largest move of a vertex of the polygon that is rounded.
    pub moved: f64,
    /// The largest move of a vertex of the float polygon.
    pub float_moved: f64,
    /// How far the curve moves at most.
    pub deviation: f64,
    /// The proofs of the features before and afterwards.
    proofs: [FeatureProof; 2],
}

impl RoundingReport {
    /// Go on counting the curvature extrema before and afterwards, for a while.
    pub fn extrema(&mut self) -> [Option<ExtremaCount>; 2] {
        let count = |proof: &mut FeatureProof| proof.advance().map(ExtremaCount::of);
        self.proofs.each_mut().map(count)
    }
}

/// How many curvature extrema a curve has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExtremaCount {
    /// Those that are proved.
    pub proved: usize,
    /// The pieces on which their number is undecided.
    pub undecided: usize,
}

impl ExtremaCount {
    fn of(features: &Features) -> Self {
        let doubts = features.undecided.iter();
        let own = |doubt: &&Undecided| doubt.quantity == Quantity::CurvatureExtremum;
        Self {
            proved: features.count(Quantity::CurvatureExtremum),
            undecided: doubts.filter(own).count(),
        }
    }
}

impl Editor {
    /// Try to divide the active curve; `subdivisions` tells how often its segments may be halved
    /// so that the cuts fall on knots.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn try_division(
        &self,
        division: Division,
        subdivisions: u32,
    ) -> Result<DivisionReport, String> {
        let (_, curve) = self.active_curve().ok_or("There is no curve")?;
        let polygon = &curve.polygon;
        let parts = match division {
            Division::Split(at) => polygon.split(at, subdivisions).map(|(a, b)| vec![a, b]),
            Division::Trim(from, to) => polygon
                .trimmed(from, to, subdivisions)
                .map(|part| vec![part]),
        };
        let parts = parts.map_err(|error| error.to_string())?;
        Ok(DivisionReport { parts })
    }

    /// Divide the active curve as one step. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be divided so.
    pub fn divide(&mut self, division: Division, subdivisions: u32) -> Reply {
        let reply = self.divided(division, subdivisions);
        self.tell(reply)
    }

    fn divided(&mut self, division: Division, subdivisions: u32) -> Reply {
        let (id, curve) = self.active_curve().ok_or("There is no curve")?;
        let report = self.try_division(division, subdivisions)?;
        let label = match division {
            Division::Split(_) => "Split curve",
            Division::Trim(..) => "Trim curve",
        };
        let mut text = off(label, report.is_exact(), report.deviation());
        let count = |polygon: &FloatPolygon| {
            let mut proof = FeatureProof::new(polygon.clone());
            proof.advance().map(ExtremaCount::of)
        };
        let parts = report.parts.iter().map(|part| count(&part.polygon));
        text += &extrema_told(count(&curve.polygon), &parts.collect::<Vec<_>>());
        let mut edits = Vec::new();
        for (number, part) in report.parts.into_iter().enumerate() {
            if number == 0 {
                // The new ends have no targets of their own.
                edits.extend(forgotten_targets(id, &curve, division));
                let polygon = part.polygon;
                edits.push(Edit::SetPolygon { curve: id, polygon });
            } else {
                let mut second = Curve::new(self.document().free_name(&curve.name), part.polygon);
                second.colour = curve.colour;
                second.targets.finish = curve.targets.finish;
                edits.push(Edit::Add(Box::new(second)));
            }
        }
        let reply = self.reshaped(label, edits, text);
        self.hand.selection.clear();
        reply
    }

    /// Try to round the coordinates of one of the active curve's polygons to some digits behind
    /// the decimal point.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn try_rounding(&self, kind: PolygonKind, digits: usize) -> Result<RoundingReport, String> {
        let (_, curve) = self.active_curve().ok_or("There is no curve")?;
        rounding(&curve.polygon, kind, digits).map_err(|error| error.to_string())
    }

    /// Round the coordinates of one of the active curve's polygons as one step. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be rounded so.
    pub fn round(&mut self, kind: PolygonKind, digits: usize) -> Reply {
        let reply = self.rounded(kind, digits);
        self.tell(reply)
    }

    fn rounded(&mut self, kind: PolygonKind, digits: usize) -> Reply {
        let (curve, _) = self.active_curve().ok_or("There is no curve")?;
        let mut report = self.try_rounding(kind, digits)?;
        let [before, after] = report.extrema();
        let mut text = format!(
            "Rounded to {digits} digits: vertices moved by at most {}, the curve by at most {}",
            figure(report.moved),
            figure(report.deviation)
        );
        text += &extrema_told(before, &[after]);
        let polygon = report.polygon;
        let edits = vec![Edit::SetPolygon { curve, polygon }];
        self.reshaped("Round coordinates", edits, text)
    }

    /// Raise or lower the active curve's degree so that the curve stays as nearly as it can.
    pub(in crate::editor) fn change_degree(&mut self, raise: bool) -> Reply {
        let (curve, found) = self.active_curve().ok_or("There is no curve")?;
        let degree = found.polygon.degree();
        let degree = if raise { degree + 1 } else { degree - 1 };
        let changed = found.polygon.with_degree(degree);
        let changed = changed.map_err(|error| error.to_string())?;
        let mut text = off(
            &format!("Degree {degree}"),
            changed.exact,
            changed.deviation,
        );
        if raise && !changed.exact {
            text += ". With more than one segment, raising the degree would double the \
                     knots: a uniform curve can only come near";
        }
        let polygon = changed.polygon;
        let edits = vec![Edit::SetPolygon { curve, polygon }];
        self.reshaped("Change degree", edits, text)
    }

    /// Halve every segment of the active curve.
    pub(in crate::editor) fn subdivide(&mut self) -> Reply {
        let (curve, found) = self.active_curve().ok_or("There is no curve")?;
        let polygon = found.polygon.subdivided();
        let polygon = polygon.map_err(|error| error.to_string())?;
        let count = polygon.segments();
        let edits = vec![Edit::SetPolygon { curve, polygon }];
        self.reshaped(
            "Subdivide",
            edits,
            format!("{count} segments, the same curve"),
        )
    }

    /// Extend the active curve by a segment that continues its end.
    pub(in crate::editor) fn extend(&mut self, end: End) -> Reply {
        let (curve, found) = self.active_curve().ok_or("There is no curve")?;
        let polygon = found.polygon.extended(end, 1);
        let polygon = polygon.map_err(|error| error.to_string())?;
        let edits = vec![Edit::SetPolygon { curve, polygon }];
        let text = format!("Extended by a segment at the {}", end.name());
        self.reshaped(&format!("Extend {}", end.name()), edits, text)
    }

    /// Whether the active curve's degree can be changed by one while the curve stays.
    pub(in crate::editor) fn can_change_degree(&self, raise: bool) -> bool {
        let degree = self.active_curve().map(|(_, curve)| curve.polygon.degree());
        degree.is_some_and(|degree| {
            if raise {
                degree < MAX_DEGREE
            } else {
                degree > 1
            }
        })
    }

    fn reshaped(&mut self, label: &str, edits: Vec<Edit>, text: String) -> Reply {
        self.apply(label, edits)?;
        Ok(Note::done(text))
    }
}

/// How much an error in a vertex of the closed S-polygon grows in the float S-polygon.
pub(in crate::editor) fn clamped_amplification(polygon: &FloatPolygon) -> Option<Amplification> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    Amplification::of(PolygonKind::Clamped, PolygonKind::Float, degree, segments).ok()
}

fn rounding(
    polygon: &FloatPolygon,
    kind: PolygonKind,
    digits: usize,
) -> Result<RoundingReport, PolygonError> {
    let (rounded, moved, deviation) = match kind {
        PolygonKind::Float | PolygonKind::Bezier => {
            let rounded = polygon.rounded(digits)?;
            (rounded.polygon, rounded.moved, rounded.deviation)
        }
        PolygonKind::Clamped => {
            let rounded = ClampedPolygon::from_float(polygon).rounded(digits)?;
            let float = if polygon.is_periodic() {
                rounded.polygon.nearest_periodic_float()?.polygon
            } else {
                rounded.polygon.to_float()?
            };
            (float, rounded.moved, rounded.deviation)
        }
    };
    let pairs = polygon.vertices().iter().zip(rounded.vertices());
    let float_moved = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    let proofs = [polygon, &rounded].map(|polygon| FeatureProof::new(polygon.clone()));
    Ok(RoundingReport {
        proofs,
        polygon: rounded,
        moved,
        float_moved,
        deviation,
    })
}

/// Say whether what was done is exact, or how far the curve is off.
fn off(what: &str, exact: bool, deviation: f64) -> String {
    if exact {
        format!("{what}: the curve is the same")
    } else {
        format!("{what}: off the curve by at most {}", figure(deviation))
    }
}

/// Say how many curvature extrema there were and are in the parts, as far as that was proved
/// without a delay that is felt.
fn extrema_told(before: Option<ExtremaCount>, parts: &[Option<ExtremaCount>]) -> String {
    let parts: Option<Vec<String>> = parts
        .iter()
        .map(|count| Some((*count)?.proved.to_string()))
        .collect();
    match (before, parts) {
        (Some(before), Some(parts)) => format!(
            "; curvature extrema: {} before, {} now",
            before.proved,
            parts.join(" and ")
        ),
        _ => "; how many curvature extrema there are is still being proved".into(),
    }
}

/// The edits that take away the targets of ends that a division cuts off.
fn forgotten_targets(id: CurveId, curve: &Curve, division: Division) -> Vec<Edit> {
    let last = curve.polygon.segments() as f64;
    let is_cut = |end: End| match (division, end) {
        (Division::Split(_), End::Start) => false,
        (Division::Split(_), End::Finish) => true,
        (Division::Trim(from, _), End::Start) => from > 0.0,
        (Division::Trim(_, to), End::Finish) => to < last,
    };
    let cut = End::BOTH.into_iter();
    let cut = cut.filter(|end| is_cut(*end) && curve.targets.get(*end).is_some());
    cut.map(|end| Edit::SetTarget {
        curve: id,
        end,
        target: None,
    })
    .collect()
}
