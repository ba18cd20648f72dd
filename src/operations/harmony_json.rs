//! The harmony of a curve as JSON.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::geometry::features::ExtremumKind;
use crate::geometry::harmony::{
    Event, EventCounts, Harmony, Irregularity, IrregularityKind, Isogeometry, LogarithmicPiece,
    Match, Mismatch, VertexFigure,
};

/// Write the harmony with the keys `leg_change`, `turning_change` and `torsion_change` (the largest
/// second differences of the legs' natural logarithms, and of angles in degrees),
/// `discrete_curvature_extrema` and `sharpest_extremum`, `isogeometry` and `torsion_isogeometry`,
/// `regular_order` of `highest_order` and `irregularity`, `length`, `bending_energy`, `variation`
/// and `logarithmic_graph`. What there is not, or is not finite, is null.
pub(super) fn serialize<S: Serializer>(
    harmony: &Harmony,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let (figures, regularity) = (harmony.figures, harmony.regularity);
    let degrees = |figure: Option<VertexFigure>| {
        figure.map(|figure| VertexFigure {
            value: figure.value.to_degrees(),
            ..figure
        })
    };
    let pieces: Vec<Value> = harmony.slopes.iter().map(piece).collect();
    let fairness = harmony.fairness;
    let value = json!({
        "leg_change": figures.legs.map(figure),
        "turning_change": degrees(figures.turns).map(figure),
        "torsion_change": degrees(figures.torsions).map(figure),
        "discrete_curvature_extrema": figures.curvature_extrema,
        "sharpest_extremum": figures.sharpest.map(figure),
        "isogeometry": isogeometry(&harmony.curvature),
        "torsion_isogeometry": harmony.torsion.as_ref().map(isogeometry),
        "regular_order": regularity.order,
        "highest_order": regularity.highest,
        "irregularity": regularity.irregularity.map(|found| irregularity(found, regularity.order)),
        "length": fairness.length,
        "bending_energy": fairness.bending_energy,
        "variation": fairness.variation,
        "logarithmic_graph": pieces,
    });
    value.serialize(serializer)
}

fn figure(figure: VertexFigure) -> Value {
    json!({ "value": figure.value, "vertex": figure.vertex })
}

fn piece(piece: &LogarithmicPiece) -> Value {
    json!({ "u": piece.u, "slope": piece.slope, "straightness": piece.straightness })
}

fn irregularity(found: Irregularity, order: usize) -> Value {
    let kind = match found.kind {
        IrregularityKind::ZeroLeg => "zero-leg",
        IrregularityKind::TurnsBack => "turns-back",
    };
    json!({ "differences": order + 1, "kind": kind, "vertex": found.vertex })
}

fn isogeometry(isogeometry: &Isogeometry) -> Value {
    let counts = |counts: EventCounts| json!({ "extrema": counts.extrema, "sign_changes": counts.sign_changes });
    let (verdict, first) = match isogeometry.verdict {
        Match::Agrees => ("agrees", Value::Null),
        Match::Differs(mismatch) => ("differs", first_mismatch(mismatch)),
        Match::Undecided(u) => ("undecided", json!({ "u": u })),
    };
    json!({
        "verdict": verdict,
        "first": first,
        "polygon": counts(isogeometry.polygon),
        "curve": counts(isogeometry.curve),
    })
}

fn first_mismatch(mismatch: Mismatch) -> Value {
    match mismatch {
        Mismatch::OfPolygon { event, vertex } => json!({ "vertex": vertex, "event": name(event) }),
        Mismatch::OfCurve { event, u } => json!({ "u": u, "event": name(event) }),
    }
}

fn name(event: Event) -> &'static str {
    match event {
        Event::Extremum(ExtremumKind::Maximum) => "maximum",
        Event::Extremum(ExtremumKind::Minimum) => "minimum",
        Event::SignChange => "sign-change",
    }
}
