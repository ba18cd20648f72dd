//! Random scripts of everything that a designer can do, checked after every input.
//!
//! A run is at least 10 000 steps from a seed that is always the same, so that a red run is
//! repeatable. Another seed, or more steps:
//!
//! ```sh
//! BATTEN_MODEL_SEED=7 BATTEN_MODEL_STEPS=200000 cargo test --test editor_scripts model -- --nocapture
//! ```
//!
//! What fails is shortened to a script of a few events, which is printed with the seed.

use std::cell::Cell;
use std::path::Path;

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace};
use batten::editor::{Button, Command, EndFitAction, Key, Modifiers, Transformation};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{Continuity, End, PolygonKind};
use batten::io::disk;
use batten::io::examples::EXAMPLES;
use batten::operations::{ALL, Value};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

use super::common::Kind;
use super::documents::{Foreign, picture, symmetric, with_targets};
use super::events::{Event, Player};
use super::laws::{check_read, check_written};
use super::places::Place;
use super::window::{CANVAS, OfCurve, OfFile, Panel, Replacement};

/// The seed of a run without another.
const SEED: u64 = 2026;

/// The steps of a run without another number.
const STEPS: usize = 10_000;

/// The most events of one script.
const SCRIPT: usize = 240;

/// After how many events all that panels read is made, and a file is written and read.
const OFTEN: usize = 12;

/// The most vertices that a document may have before growing it is passed over: what is slow is
/// tested elsewhere.
const MOST_VERTICES: usize = 60;

/// The highest degree that is raised further.
const HIGHEST: usize = 7;

#[test]
fn random_scripts_keep_every_law() {
    let seed = number("BATTEN_MODEL_SEED").unwrap_or(SEED);
    let wanted = number("BATTEN_MODEL_STEPS").map_or(STEPS, |steps| steps as usize);
    println!("BATTEN_MODEL_SEED={seed} BATTEN_MODEL_STEPS={wanted}");
    let config = Config {
        failure_persistence: None,
        max_shrink_time: 60_000,
        ..Config::default()
    };
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let mut runner = TestRunner::new_with_rng(config, random);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("document.batten");
    let strategy = (documents(), prop::collection::vec(event(), 1..=SCRIPT));
    let (mut played, mut scripts) = (0, 0);
    while played < wanted {
        let script = strategy.new_tree(&mut runner).expect("a script");
        let steps = Cell::new(0);
        let result = runner.run_one(script, |(start, events)| {
            steps.set(0);
            play(start, &events, &file, &steps).map_err(TestCaseError::fail)
        });
        match result {
            Ok(_) => {}
            Err(TestError::Fail(reason, (start, events))) => {
                panic!(
                    "seed {seed}, after {played} steps: {reason}\n{start:#?}\n{}",
                    listed(&events)
                )
            }
            Err(error) => panic!("seed {seed}: {error}"),
        }
        played += steps.get();
        scripts += 1;
    }
    println!("{played} steps in {scripts} scripts");
}

/// Read a number from the environment.
fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name}={text}")))
}

fn listed(events: &[Event]) -> String {
    let lines: Vec<String> = events.iter().map(|event| format!("{event:?}")).collect();
    lines.join("\n")
}

/// Play a script and count its steps; every so often make what panels read, write a file and
/// read it, and at the end undo all and redo all.
fn play(start: Start, events: &[Event], file: &Path, steps: &Cell<usize>) -> Result<(), String> {
    let mut player = Player::new(start.document());
    for (number, event) in events.iter().enumerate() {
        if is_too_much(event, &player) {
            continue;
        }
        player.play(std::slice::from_ref(event))?;
        steps.set(steps.get() + 1);
        if number % OFTEN == 0 {
            player.window.read_panels();
            check_written(player.window.document())?;
        }
        if number % (2 * OFTEN) == 0 {
            save_in_between(&mut player, file)?;
        }
    }
    player.window.read_panels();
    player.settle()?;
    save(&mut player, file)
}

/// Save whatever is going on: a drawing ends, everything else goes on, and the file is without it.
fn save_in_between(player: &mut Player, file: &Path) -> Result<(), String> {
    let window = &player.window;
    let (shown, in_gesture, tries) = (
        window.document().clone(),
        window.is_in_gesture(),
        window.is_trying(),
    );
    let (values, draws) = (window.values(), window.undoes_points());
    player.save(file)?;
    let window = &player.window;
    let goes_on = window.is_in_gesture() == in_gesture
        && window.is_trying() == tries
        && window.values() == values
        && window.document().is_same(&shown);
    if !goes_on && !draws {
        return Err("saving ended what was going on".into());
    }
    check_read(window.settled(), disk::read_file(file))
}

/// Save, read what was saved, export it and import it again.
fn save(player: &mut Player, file: &Path) -> Result<(), String> {
    player.save(file)?;
    if player.window.is_modified() {
        return Err("saved, and still modified".into());
    }
    check_read(player.window.document(), disk::read_file(file))?;
    for (extension, polygon) in [("dxf", PolygonKind::Float), ("csv", PolygonKind::Clamped)] {
        let file = file.with_extension(extension);
        player.window.export(&file, extension, polygon);
    }
    player.import(file)?;
    player.settle()
}

/// Whether an event would make a document too large for a quick test.
fn is_too_much(event: &Event, player: &Player) -> bool {
    let document = player.window.document();
    let vertices = document
        .curves()
        .map(|(_, curve)| curve.polygon.vertices().len());
    let is_large = vertices.sum::<usize>() > MOST_VERTICES;
    let is_high = document
        .curves()
        .any(|(_, curve)| curve.polygon.degree() >= HIGHEST);
    match event {
        Event::Command(Command::Operation(operation))
        | Event::Panel(Panel::Operate(operation, _)) => {
            is_large || is_high && operation.name.ends_with("degree")
        }
        Event::Command(Command::Duplicate) => is_large,
        Event::Panel(Panel::SetValue(..) | Panel::Paste(_) | Panel::CopyAndPaste) => is_large,
        Event::Panel(Panel::File(OfFile::Import(_) | OfFile::AnswerUnit(_))) => is_large,
        _ => false,
    }
}

/// A document that a script begins with.
#[derive(Clone, Debug)]
struct Start {
    curves: Vec<Drawn>,
    matches: Vec<Matched>,
    unit: Option<LengthUnit>,
    pictured: bool,
}

/// An end that follows a place of another curve. Curves are counted from 0 and round again.
#[derive(Clone, Debug)]
struct Matched {
    curve: usize,
    end: End,
    source: usize,
    /// A share of the way along the source; its ends are ends.
    along: f64,
    continuity: Continuity,
    reversed: bool,
}

impl Start {
    /// Make the document. Matches that cannot be, as of periodic curves, are left out.
    fn document(self) -> Document {
        let curves = self.curves.into_iter().map(Drawn::curve);
        let document = Document::from_curves(curves).with_unit(self.unit);
        let pictures = self.pictured.then(picture);
        let document = document.with_references(pictures);
        let ids: Vec<CurveId> = document.ids().collect();
        let set = |document: Document, matched: Matched| {
            let edit = matched.edit(&ids, &document);
            let edited = edit.and_then(|edit| document.edited([edit]).ok());
            edited.unwrap_or(document)
        };
        self.matches.into_iter().fold(document, set)
    }
}

impl Matched {
    fn edit(self, ids: &[CurveId], document: &Document) -> Option<Edit> {
        let id = |number: usize| ids.get(number.checked_rem(ids.len())?).copied();
        let source = id(self.source)?;
        let place = match self.along {
            0.0 => MatchPlace::End(End::Start),
            1.0 => MatchPlace::End(End::Finish),
            share => MatchPlace::Parameter(share * document.shape(source)?.pieces() as f64),
        };
        Some(Edit::SetMatch(EndMatch {
            curve: id(self.curve)?,
            end: self.end,
            source,
            place,
            continuity: self.continuity,
            reversed: self.reversed,
        }))
    }
}

/// A curve that is drawn at random.
#[derive(Clone, Debug)]
struct Drawn {
    kind: Kind,
    visible: bool,
    locked: bool,
    targets: bool,
}

impl Drawn {
    fn curve(self) -> Curve {
        let polygon = self.kind.polygon();
        let curve = Curve::new(format!("curve {}", self.kind.seed), polygon);
        let curve = if self.targets {
            with_targets(curve)
        } else {
            curve
        };
        let curve = match self.kind.seed % 3 {
            0 => symmetric(curve),
            _ => curve,
        };
        Curve {
            visible: self.visible,
            locked: self.locked,
            ..curve
        }
    }
}

fn documents() -> impl Strategy<Value = Start> {
    let curves = prop::collection::vec(drawn(), 0..4);
    let matches = prop::collection::vec(matched(), 0..3);
    (curves, matches, unit()).prop_map(|(curves, matches, unit)| Start {
        // The largest documents have a picture behind them.
        pictured: curves.len() == 3,
        curves,
        matches,
        unit,
    })
}

fn matched() -> impl Strategy<Value = Matched> {
    let along = prop_oneof![Just(0.0), Just(1.0), 0.1..0.9f64];
    let curves = (0..4usize, 0..4usize);
    (curves, end(), along, continuity(), any::<bool>()).prop_map(
        |((curve, source), end, along, continuity, reversed)| Matched {
            curve,
            end,
            source,
            along,
            continuity,
            reversed,
        },
    )
}

fn continuity() -> impl Strategy<Value = Continuity> {
    select(&Continuity::ALL[..])
}

fn unit() -> impl Strategy<Value = Option<LengthUnit>> {
    prop::option::of(select(&LengthUnit::ALL[..]))
}

fn foreign() -> impl Strategy<Value = Foreign> {
    let follows = prop::option::of(continuity());
    (unit(), 0..1000u64, follows).prop_map(|(unit, seed, follows)| Foreign {
        unit,
        seed,
        follows,
    })
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let flags = (any::<bool>(), any::<bool>(), any::<bool>());
    let rare = || prop::bool::weighted(0.15);
    let kind = (1..=4usize, 0..=4usize, flags, 0..1000u64);
    (kind, prop::bool::weighted(0.85), rare(), rare()).prop_map(
        |((degree, extra, (periodic, rational, in_space), seed), visible, locked, targets)| {
            let kind = Kind {
                degree,
                extra,
                periodic,
                rational,
                in_space,
                seed,
            };
            Drawn {
                kind,
                visible,
                locked,
                targets,
            }
        },
    )
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        40 => pointer(),
        12 => key(),
        22 => select(every_command()).prop_map(Event::Command),
        26 => panel().prop_map(Event::Panel),
    ]
}

/// Every command there is; the tools more often, for most of the others leave them.
fn every_command() -> Vec<Command> {
    let all = super::window::every_command();
    let is_tool = |command: &Command| matches!(command, Command::Tool(_));
    let tools: Vec<Command> = all.iter().copied().filter(is_tool).collect();
    let mut commands = all;
    for _ in 0..3 {
        commands.extend(&tools);
    }
    commands
}

fn pointer() -> impl Strategy<Value = Event> {
    let button = || {
        prop_oneof![
            8 => Just(Button::Primary),
            1 => Just(Button::Secondary),
            1 => Just(Button::Middle),
        ]
    };
    prop_oneof![
        6 => (place(), by()).prop_map(|(place, by)| Event::Move(place, by)),
        4 => (button(), place()).prop_map(|(button, place)| Event::Press(button, place)),
        5 => button().prop_map(Event::Release),
        8 => (button(), place()).prop_map(|(button, place)| Event::Click(button, place)),
        1 => place().prop_map(Event::DoubleClick),
        10 => (button(), place(), by()).prop_map(|(button, place, by)| Event::Drag(button, place, by)),
        1 => Just(Event::Leave),
        1 => (place(), 0.5..2.0).prop_map(|(place, factor)| Event::Zoom(place, factor)),
        1 => by().prop_map(Event::Pan),
    ]
}

fn place() -> impl Strategy<Value = Place> {
    let canvas = (0.0..CANVAS.x, 0.0..CANVAS.y).prop_map(|(x, y)| Place::At(DVec2::new(x, y)));
    prop_oneof![
        4 => (0..4usize, 0..9usize).prop_map(|(curve, vertex)| Place::Vertex(curve, vertex)),
        4 => (0..9usize).prop_map(Place::Own),
        2 => (0..9usize).prop_map(Place::Other),
        3 => (0..9usize, 0.0..1.0).prop_map(|(leg, share)| Place::Leg(leg, share)),
        2 => (0.0..1.0).prop_map(Place::Curve),
        2 => (0..9usize).prop_map(Place::Clamped),
        1 => (0..9usize).prop_map(Place::Tooth),
        1 => end().prop_map(Place::End),
        1 => (-3.0..3.0).prop_map(Place::Ring),
        1 => Just(Place::Target),
        1 => Just(Place::Arrow),
        1 => Just(Place::Pivot),
        3 => canvas,
    ]
}

fn end() -> impl Strategy<Value = End> {
    select(&End::BOTH[..])
}

fn by() -> impl Strategy<Value = DVec2> {
    prop_oneof![
        1 => Just(DVec2::ZERO),
        1 => (-3.0..3.0, -3.0..3.0).prop_map(DVec2::from),
        4 => (-120.0..120.0, -120.0..120.0).prop_map(DVec2::from),
    ]
}

fn key() -> impl Strategy<Value = Event> {
    let keys = [
        Key::Escape,
        Key::Enter,
        Key::Delete,
        Key::Backspace,
        Key::Tab,
        Key::Space,
        Key::Left,
        Key::Right,
        Key::Up,
        Key::Down,
    ];
    let plain = select(keys.to_vec()).boxed();
    let keys = || {
        let letters: Vec<char> = ('a'..='z').chain('0'..='9').chain(['+', '-']).collect();
        let letters = select(letters).prop_map(Key::Character);
        let functions = (1..=12u8).prop_map(Key::Function);
        prop_oneof![6 => plain.clone(), 4 => letters, 1 => functions]
    };
    prop_oneof![
        10 => (modifiers(), keys()).prop_map(|(held, key)| Event::Key(held, key)),
        3 => (modifiers(), keys(), 1..5usize)
            .prop_map(|(held, key, times)| Event::Repeat(held, key, times)),
        3 => modifiers().prop_map(Event::Hold),
        1 => prop::bool::weighted(0.2).prop_map(Event::Space),
        1 => prop::option::of(0..3usize).prop_map(Event::Axis),
    ]
}

fn modifiers() -> impl Strategy<Value = Modifiers> {
    prop_oneof![
        4 => Just(Modifiers::NONE),
        3 => (any::<bool>(), any::<bool>(), any::<bool>())
            .prop_map(|(shift, ctrl, alt)| Modifiers { shift, ctrl, alt }),
    ]
}

fn panel() -> impl Strategy<Value = Panel> {
    prop_oneof![
        10 => table(),
        8 => list(),
        2 => Just(Panel::SelectItems),
        6 => end_fit().prop_map(Panel::EndFit),
        6 => dialogs(),
        6 => files().prop_map(Panel::File),
        14 => operations(),
        5 => view(),
    ]
}

/// What the vertex table asks for, and typed transformations.
fn table() -> impl Strategy<Value = Panel> {
    let vertex = || (0..4usize, 0..9usize);
    let angle = (-7.0..7.0).prop_map(Transformation::Rotate);
    let factor = number_of_any_kind().prop_map(Transformation::Scale);
    prop_oneof![
        3 => (vertex(), point()).prop_map(|((c, v), to)| Panel::PreviewVertex(c, v, to)),
        1 => (vertex(), number_of_any_kind()).prop_map(|((c, v), to)| Panel::PreviewWeight(c, v, to)),
        2 => Just(Panel::CommitField),
        1 => Just(Panel::AbortField),
        2 => (vertex(), point()).prop_map(|((c, v), to)| Panel::TypeVertex(c, v, to)),
        2 => (vertex(), number_of_any_kind()).prop_map(|((c, v), to)| Panel::TypeWeight(c, v, to)),
        2 => (vertex(), any::<bool>()).prop_map(|((c, v), add)| Panel::SelectVertex(c, v, add)),
        1 => prop_oneof![angle, factor].prop_map(Panel::Transform),
        1 => prop::option::of(by()).prop_map(Panel::SetPivot),
    ]
}

/// What the list of curves and the inspector ask for.
fn list() -> impl Strategy<Value = Panel> {
    let names = select(&["stem", "", "  ", "“hull”\n2", "curve 1"][..]);
    let asked = prop_oneof![
        4 => Just(OfCurve::Activate),
        4 => Just(OfCurve::Toggle),
        1 => names.prop_map(OfCurve::Rename),
        1 => any::<Option<[u8; 3]>>().prop_map(OfCurve::Recolour),
        1 => (0..5usize).prop_map(OfCurve::Reorder),
        2 => (0..9usize).prop_map(OfCurve::SetDegree),
        2 => any::<bool>().prop_map(OfCurve::SetPeriodic),
        2 => prop::bool::weighted(0.7).prop_map(OfCurve::SetVisible),
        2 => prop::bool::weighted(0.3).prop_map(OfCurve::SetLocked),
    ];
    (0..4usize, asked).prop_map(|(curve, asked)| Panel::OfCurve(curve, asked))
}

fn end_fit() -> impl Strategy<Value = EndFitAction> {
    prop_oneof![
        1 => end().prop_map(EndFitAction::Choose),
        1 => any::<bool>().prop_map(EndFitAction::ShowClosed),
        2 => Just(EndFitAction::TargetActual),
        2 => point().prop_map(EndFitAction::SetPoint),
        2 => prop::option::of(point()).prop_map(EndFitAction::SetDirection),
        1 => prop::option::of(number_of_any_kind()).prop_map(EndFitAction::SetCurvature),
        1 => prop::option::of(point()).prop_map(EndFitAction::SetNormal),
        1 => prop::option::of(number_of_any_kind()).prop_map(EndFitAction::SetSlope),
        1 => Just(EndFitAction::ClearTarget),
        2 => Just(EndFitAction::PickFromCurve),
        1 => continuity().prop_map(EndFitAction::SetContinuity),
        2 => any::<bool>().prop_map(EndFitAction::KeepMatched),
        1 => Just(EndFitAction::TurnRound),
        2 => Just(EndFitAction::Translate),
        2 => Just(EndFitAction::Rotate),
        2 => Just(EndFitAction::Repeat),
        2 => Just(EndFitAction::BothAtOnce),
        1 => number_of_any_kind().prop_map(EndFitAction::SetTolerance),
    ]
}

/// What happens to files.
fn files() -> impl Strategy<Value = OfFile> {
    prop_oneof![
        3 => Just(OfFile::Save),
        3 => foreign().prop_map(OfFile::Change),
        3 => Just(OfFile::Reload),
        3 => foreign().prop_map(OfFile::Import),
        1 => prop::collection::vec(foreign(), 1..3).prop_map(OfFile::Open),
        2 => unit().prop_map(OfFile::AnswerUnit),
    ]
}

/// What dialogs and the clipboard ask for.
fn dialogs() -> impl Strategy<Value = Panel> {
    let replacement = prop_oneof![
        Just(Replacement::Empty),
        (0..EXAMPLES.len()).prop_map(Replacement::Example),
        Just(Replacement::MissingFile),
    ];
    prop_oneof![
        4 => (0..10usize).prop_map(Panel::Paste),
        3 => Just(Panel::CopyAndPaste),
        1 => Just(Panel::Copy),
        1 => Just(Panel::Cut),
        1 => Just(Panel::DismissMessage),
        1 => replacement.prop_map(Panel::Replace),
    ]
}

/// What the operation panel asks for.
fn operations() -> impl Strategy<Value = Panel> {
    let number =
        || prop_oneof![3 => 0.0..4.0, 2 => (0..4u8).prop_map(f64::from), 1 => number_of_any_kind()];
    let any_value = prop_oneof![
        any::<usize>().prop_map(Value::Whole),
        any::<f64>().prop_map(Value::Real),
        (0..4usize).prop_map(Value::Choice),
        any::<bool>().prop_map(Value::Switch),
    ];
    let numbers = [number(), number(), number()];
    prop_oneof![
        8 => (0..3usize, number()).prop_map(|(at, number)| Panel::SetValue(at, number)),
        1 => (0..3usize, any_value).prop_map(|(at, value)| Panel::SetAnyValue(at, value)),
        6 => Just(Panel::Apply),
        2 => Just(Panel::Leave),
        3 => (select(ALL), numbers)
            .prop_map(|(operation, numbers)| Panel::Operate(operation, numbers)),
    ]
}

/// What changes only how things are seen.
fn view() -> impl Strategy<Value = Panel> {
    let size = (1.0..2000.0, 1.0..1500.0).prop_map(DVec2::from);
    let hovered = (prop::option::of(0.0..50.0), prop::option::of(0..20usize));
    prop_oneof![
        3 => hovered.prop_map(|(length, vertex)| Panel::Hover(length, vertex)),
        1 => size.prop_map(Panel::SetCanvasSize),
        2 => by().prop_map(Panel::Orbit),
        1 => (number_of_any_kind(), 0..99usize)
            .prop_map(|(scale, density)| Panel::SetComb(scale, density)),
        1 => (0.0..9.0).prop_map(Panel::GoTo),
    ]
}

/// A point near the others, mostly: the rest is zeros, far away, and what is no number.
fn point() -> impl Strategy<Value = DVec3> {
    let near = || -12.0..12.0f64;
    prop_oneof![
        6 => (near(), near(), near()).prop_map(DVec3::from),
        6 => (near(), near(), Just(0.0)).prop_map(DVec3::from),
        1 => (number_of_any_kind(), near(), Just(0.0)).prop_map(DVec3::from),
    ]
}

/// A number as anybody types it, and what nobody should.
fn number_of_any_kind() -> impl Strategy<Value = f64> {
    let odd = [
        0.0,
        -0.0,
        -1.0,
        1e-300,
        1e-9,
        1e6,
        1e99,
        1e101,
        f64::INFINITY,
        f64::NAN,
    ];
    prop_oneof![3 => 0.1..5.0f64, 1 => select(odd.to_vec())]
}
