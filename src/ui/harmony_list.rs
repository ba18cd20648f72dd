//! The harmony of the active curve in the inspector: each a sentence with its figure.

use std::time::Duration;

use eframe::egui::text::LayoutJob;
use eframe::egui::{Response, Role, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2};
use lucide_icons::Icon;

use super::theme::{RADIUS, STEP, Tokens};
use super::{figures, widgets};
use crate::analysis::CurveAnalysis;
use crate::editor::{Editor, Look};
use crate::geometry::counted;
use crate::geometry::features::ExtremumKind;
use crate::geometry::harmony::{
    Event, EventCounts, Harmony, HarmonyFigures, IrregularityKind, Isogeometry, LogarithmicPiece,
    Match, Mismatch, Regularity, VertexFigure,
};

/// How often the list checks whether the measurement is done.
const PROGRESS: Duration = Duration::from_millis(100);

/// A change that is no more than this is rounding.
const EVEN: f64 = 1e-9;

/// Where on the curve a sentence points.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Vertex(usize),
    Parameter(f64),
}

/// A sentence with its judgement (`None` for a mere figure) and the place that it is
/// about.
#[derive(Clone, Debug, PartialEq)]
struct Sentence {
    text: String,
    is_good: Option<bool>,
    place: Option<Place>,
}

impl Sentence {
    fn new(text: String, is_good: Option<bool>, place: Option<Place>) -> Self {
        Self {
            text,
            is_good,
            place,
        }
    }
}

/// The place under the pointer, and whether it was pressed.
type Pointed = (Place, bool);

fn pointed(place: Option<Place>, response: &Response) -> Option<Pointed> {
    let is_chosen = response.clicked();
    let place = place.filter(|_| is_chosen || response.hovered())?;
    Some((place, is_chosen))
}

/// Show the harmony of the active curve; hovering a sentence marks its place, choosing one selects
/// its vertex or goes to its parameter.
pub fn harmony_list_ui(ui: &mut Ui, editor: &mut Editor) {
    editor.view_mut().harmony = true;
    let Some(harmony) = editor.sight().harmony() else {
        widgets::caption(ui, "Measuring…");
        ui.ctx().request_repaint_after(PROGRESS);
        return;
    };
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut found = None;
    for sentence in sentences(harmony) {
        found = sentence_ui(ui, &sentence).or(found);
    }
    let fairness = harmony.fairness;
    let energy = |energy: Option<f64>| match energy {
        Some(energy) => figures::significant(energy, 6),
        None => "infinite".to_owned(),
    };
    widgets::figure_row(ui, "Bending energy", &energy(fairness.bending_energy))
        .on_hover_text("∫κ² ds times the length: independent of the curve's size");
    widgets::figure_row(ui, "Variation", &energy(fairness.variation))
        .on_hover_text("∫(dκ/ds)² ds times the length cubed: independent of the curve's size");
    found = pieces_ui(ui, &harmony.slopes).or(found);
    if let Some(found) = found {
        follow(editor, found);
    }
}

/// Mark the hovered place, and go to the chosen one.
fn follow(editor: &mut Editor, (place, is_chosen): Pointed) {
    let Some(id) = editor.active() else {
        return;
    };
    match place {
        Place::Vertex(vertex) => {
            editor.view_mut().hover_vertex(vertex);
            if is_chosen {
                editor.select_vertex(id, vertex, false);
            }
        }
        Place::Parameter(u) => {
            let Some(sampled) = editor.view().analysis(id).map(CurveAnalysis::sampled) else {
                return;
            };
            // On a periodic curve it may lie behind the joint.
            let last = sampled.curve.pieces() as f64;
            let u = if u > last { u - last } else { u };
            let length = sampled.length_at(u);
            editor.view_mut().hover_length(length);
            if is_chosen {
                editor.look(Look::Around(u));
            }
        }
    }
}

fn sentences(harmony: &Harmony) -> Vec<Sentence> {
    let torsion = harmony.torsion.as_ref();
    // In space the curvature has no sign.
    let inflections = torsion.is_none().then_some(["inflection", "inflections"]);
    let mut sentences = vec![isogeometry(
        "Discrete curvature",
        inflections,
        &harmony.curvature,
    )];
    let zeros = Some(["zero", "zeros"]);
    sentences.extend(torsion.map(|torsion| isogeometry("Discrete torsion", zeros, torsion)));
    sentences.push(regularity(&harmony.regularity));
    sentences.extend(evenness(&harmony.figures));
    sentences
}

/// Compare a polygon's extrema and sign changes with those of its curve. `zeros` names
/// sign changes, one and several; `None` where there are none.
fn isogeometry(name: &str, zeros: Option<[&str; 2]>, isogeometry: &Isogeometry) -> Sentence {
    let counts = |counts: EventCounts| {
        let all = |count: usize, [one, several]: [&str; 2]| match count {
            0 => format!("no {several}"),
            _ => counted(count, one, several),
        };
        let extrema = all(counts.extrema, ["extremum", "extrema"]);
        zeros.map_or(extrema.clone(), |zeros| {
            format!("{extrema}, {}", all(counts.sign_changes, zeros))
        })
    };
    let curve = isogeometry.curve;
    let zero = zeros.map_or("zero", |zeros| zeros[0]);
    let place = |u: f64| figures::to_resolution(u, 0.01);
    let (text, at) = match isogeometry.verdict {
        Match::Agrees => {
            let has_events = curve.extrema + curve.sign_changes > 0;
            let order = if has_events { " in the same order" } else { "" };
            let text = format!("{name} follows the curve: {}{order}", counts(curve));
            return Sentence::new(text, Some(true), None);
        }
        Match::Differs(Mismatch::OfPolygon { event, vertex }) => {
            let event = article(event, zero);
            let at = format!("vertex {vertex}: {event} that the curve does not have");
            (
                format!("{name} differs first at {at}"),
                Place::Vertex(vertex),
            )
        }
        Match::Differs(Mismatch::OfCurve { event, u }) => {
            let event = article(event, zero);
            let at = format!("u {}: the curve has {event} there", place(u));
            (format!("{name} differs first at {at}"), Place::Parameter(u))
        }
        Match::Undecided([low, _]) => {
            let why = format!("the curve's features are undecided at u {}", place(low));
            (format!("{name} not compared: {why}"), Place::Parameter(low))
        }
    };
    Sentence::new(text, Some(false), Some(at))
}

fn article(event: Event, zero: &str) -> String {
    match event {
        Event::Extremum(ExtremumKind::Maximum) => "a maximum".to_owned(),
        Event::Extremum(ExtremumKind::Minimum) => "a minimum".to_owned(),
        Event::SignChange if zero.starts_with('i') => format!("an {zero}"),
        Event::SignChange => format!("a {zero}"),
    }
}

fn regularity(regularity: &Regularity) -> Sentence {
    let Regularity { order, highest, .. } = *regularity;
    let Some(found) = regularity.irregularity else {
        let text = format!("Regular to order {order}, the highest of this degree");
        return Sentence::new(text, Some(true), None);
    };
    let happens = match found.kind {
        IrregularityKind::ZeroLeg => "vanish",
        IrregularityKind::TurnsBack => "turn back",
    };
    let (next, vertex) = (ordinal(order + 1), found.vertex);
    let differences = format!("the {next} differences {happens} at vertex {vertex}");
    let text = format!("Regular to order {order} of {highest}; {differences}");
    Sentence::new(text, Some(false), Some(Place::Vertex(vertex)))
}

fn ordinal(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (1, last) if last != 11 => "st",
        (2, last) if last != 12 => "nd",
        (3, last) if last != 13 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}

/// Name the vertices where the flow is least even.
fn evenness(figures: &HarmonyFigures) -> Vec<Sentence> {
    let even = |name: &str, figure: Option<VertexFigure>, text: &dyn Fn(f64) -> String| {
        let VertexFigure { value, vertex } = figure?;
        if value <= EVEN {
            return Some(Sentence::new(format!("{name} even throughout"), None, None));
        }
        let text = format!("{name} least even at vertex {vertex}: Δ² {}", text(value));
        Some(Sentence::new(text, None, Some(Place::Vertex(vertex))))
    };
    let log = |value: f64| match value.is_finite() {
        true => format!("log {}", figures::significant(value, 3)),
        false => "∞, no length".to_owned(),
    };
    let extrema = counted(figures.curvature_extrema, "extremum", "extrema");
    let sharpest = figures.sharpest.map(|sharpest| sharpest.vertex);
    let text = match sharpest {
        Some(vertex) => format!("Discrete κ: {extrema}, sharpest at vertex {vertex}"),
        None => "Discrete curvature has no extremum".to_owned(),
    };
    let sharpest = Sentence::new(text, None, sharpest.map(Place::Vertex));
    let sentences = [
        even("Legs", figures.legs, &log),
        even("Turning", figures.turns, &figures::small_angle),
        even("Torsion", figures.torsions, &figures::small_angle),
        Some(sharpest),
    ];
    sentences.into_iter().flatten().collect()
}

/// Show a sentence: a judgement on two lines, others on one.
fn sentence_ui(ui: &mut Ui, sentence: &Sentence) -> Option<Pointed> {
    let tokens = Tokens::of(ui);
    let judgement = sentence.is_good.map(|is_good| match is_good {
        true => (Icon::Check, tokens.good),
        false => (Icon::TriangleAlert, tokens.warning),
    });
    let lines = if judgement.is_some() { 2 } else { 1 };
    let height = lines as f32 * ui.text_style_height(&TextStyle::Body) + 1.5 * STEP;
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let pointed = pointed(sentence.place, &response);
    if pointed.is_some() {
        ui.painter().rect_filled(rect, RADIUS, tokens.button[0]);
    }
    let mut left = rect.left();
    if let Some((icon, colour)) = judgement {
        widgets::icon(ui, rect.with_max_x(left + 4.0 * STEP), icon, colour);
        left += 6.0 * STEP;
    }
    let font = TextStyle::Body.resolve(ui.style());
    let text = sentence.text.clone();
    let mut job = LayoutJob::simple(text, font, tokens.text, rect.right() - left);
    job.wrap.max_rows = lines;
    let galley = ui.painter().layout_job(job);
    let at = pos2(left, rect.center().y - 0.5 * galley.size().y);
    let is_cut = galley.elided;
    ui.painter().galley(at, galley, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &sentence.text));
    if is_cut {
        response.on_hover_text(&sentence.text);
    }
    pointed
}

/// Show the slope of the logarithmic curvature graph on each monotone piece.
fn pieces_ui(ui: &mut Ui, pieces: &[LogarithmicPiece]) -> Option<Pointed> {
    widgets::fact_row(ui, "Logarithmic graph", "slope α and R²");
    if pieces.is_empty() {
        widgets::caption(ui, "The curvature is constant");
    }
    let mut found = None;
    for piece in pieces {
        let middle = 0.5 * (piece.u[0] + piece.u[1]);
        let row = piece_ui(ui, piece);
        found = pointed(Some(Place::Parameter(middle)), &row).or(found);
    }
    found
}

fn piece_ui(ui: &mut Ui, piece: &LogarithmicPiece) -> Response {
    let (rect, response) = widgets::row(ui, Sense::click(), false);
    let [from, to] = piece.u.map(|u| figures::to_resolution(u, 0.01));
    let slope = figures::to_resolution(piece.slope, 0.001);
    let straightness = figures::to_resolution(piece.straightness, 0.0001);
    let place = format!("u {from} … {to}");
    let colour = Tokens::of(ui).text;
    let rect = rect.shrink2(vec2(STEP, 0.0));
    widgets::label_in(ui, rect, &place, colour);
    let left = rect.with_max_x(rect.right() - 18.0 * STEP);
    widgets::number_in(ui, left, &slope, colour);
    widgets::number_in(ui, rect, &straightness, colour);
    let told = format!("{place}: slope α {slope}, R² {straightness}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &told));
    let tooltip = "Slope α of the logarithmic curvature graph, and R²: 1 on a log-aesthetic curve";
    response.on_hover_text(tooltip)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;
    use crate::geometry::features::Features;

    fn said(points: &[(f64, f64)]) -> Vec<String> {
        let polygon = FloatPolygon::planar(5, points).expect("a polygon");
        let harmony = Harmony::of(&polygon, &Features::new(&polygon));
        let sentences = sentences(&harmony).into_iter();
        sentences.map(|sentence| sentence.text).collect()
    }

    #[test]
    fn a_spiral_is_said_to_be_in_harmony() {
        let mut at = (0.0, 0.0);
        let points = (0..14).map(|index| {
            let (leg, angle) = (1.2_f64.powi(index), 0.3 * f64::from(index));
            let point = at;
            at = (at.0 + leg * angle.cos(), at.1 + leg * angle.sin());
            point
        });
        let expected = [
            "Discrete curvature follows the curve: no extrema, no inflections",
            "Regular to order 4, the highest of this degree",
            "Legs even throughout",
            "Turning even throughout",
            "Discrete curvature has no extremum",
        ];
        assert_eq!(said(&points.collect::<Vec<_>>()), expected);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        // A crest: the third differences change their direction there.
        let crest = |x: i32| (f64::from(x), (0.3 * (f64::from(x) - 0.3)).cos());
        let said = said(&(-3..=4).map(crest).collect::<Vec<_>>());
        let follows =
            "Discrete curvature follows the curve: 1 extremum, no inflections in the same order";
        assert_eq!(said[0], follows);
        let regular = "Regular to order 2 of 4; the 3rd differences turn back at vertex ";
        assert!(said[1].starts_with(regular), "{said:?}");
        assert!(
            said[2].starts_with("Legs least even at vertex "),
            "{said:?}"
        );
        assert!(
            said[4].starts_with("Discrete κ: 1 extremum, sharpest at vertex 3"),
            "{said:?}"
        );
    }

    #[test]
    fn what_differs_is_said_with_its_place() {
        let differs = |verdict| {
            let counts = Default::default();
            let compared = Isogeometry {
                polygon: counts,
                curve: counts,
                verdict,
            };
            let sentence = isogeometry("Discrete torsion", Some(["zero", "zeros"]), &compared);
            (sentence.text, sentence.place)
        };
        let (event, vertex, u) = (Event::SignChange, 7, 3.25);
        let of_polygon = differs(Match::Differs(Mismatch::OfPolygon { event, vertex }));
        let text =
            "Discrete torsion differs first at vertex 7: a zero that the curve does not have";
        assert_eq!(of_polygon, (text.to_owned(), Some(Place::Vertex(7))));
        let event = Event::Extremum(ExtremumKind::Minimum);
        let of_curve = differs(Match::Differs(Mismatch::OfCurve { event, u }));
        let text = "Discrete torsion differs first at u 3.25: the curve has a minimum there";
        assert_eq!(of_curve, (text.to_owned(), Some(Place::Parameter(3.25))));
        let undecided = differs(Match::Undecided([3.25, 3.5]));
        let text = "Discrete torsion not compared: the curve's features are undecided at u 3.25";
        assert_eq!(undecided, (text.to_owned(), Some(Place::Parameter(3.25))));
    }

    #[test]
    fn ordinals_are_english() {
        let said: Vec<String> = [1, 2, 3, 4, 11, 12, 13, 21, 22, 23].map(ordinal).to_vec();
        let expected = [
            "1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "22nd", "23rd",
        ];
        assert_eq!(said, expected);
    }
}
