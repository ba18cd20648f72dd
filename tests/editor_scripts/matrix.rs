//! Every tool and every command over every kind of document, undone and redone to the bit.

use std::collections::BTreeMap;

use batten::document::Document;
use batten::editor::{Button, Command, Key, Layer, Modifiers, ToolKind};
use batten::geometry::End;
use batten::io::examples::EXAMPLES;
use batten::operations::{ALL, Operation};
use glam::DVec2;

use super::documents::{Case, cases};
use super::events::{AFTER, Event, Player};
use super::places::Place;
use super::window::{Panel, Replacement, Window};

/// How far drags of the matrix go, in screen points: off to the side, and not along an axis.
const DRAG: DVec2 = DVec2::new(47.0, -31.0);

/// Collect what fails, by what does not hold, so that one run tells all.
#[derive(Default)]
struct Failures {
    cases: usize,
    failed: BTreeMap<String, Vec<String>>,
}

impl Failures {
    fn check(&mut self, name: impl FnOnce() -> String, result: Result<(), String>) {
        self.cases += 1;
        if let Err(error) = result {
            let (law, after) = error.split_once(AFTER).unwrap_or((&error, ""));
            let case = format!("{} ({after})", name());
            self.failed.entry(law.to_owned()).or_default().push(case);
        }
    }

    #[track_caller]
    fn none(self) {
        assert!(self.cases > 0);
        let failed: usize = self.failed.values().map(Vec::len).sum();
        let told = self.failed.iter().map(|(error, names)| {
            let first = names.iter().take(2).map(String::as_str);
            let first: Vec<&str> = first.collect();
            format!("{error}\n    {} cases: {}", names.len(), first.join("; "))
        });
        let told: Vec<String> = told.collect();
        assert_eq!(failed, 0, "of {} cases:\n{}", self.cases, told.join("\n"));
    }
}

/// What is selected or goes on when a command is given.
const SITUATIONS: [(&str, &[Event]); 11] = [
    ("a curve selected", &[]),
    ("nothing selected", &[Event::Command(Command::SelectNone)]),
    ("several selected", &[Event::Panel(Panel::SelectItems)]),
    (
        "a vertex selected",
        &[Event::Click(Button::Primary, Place::Own(1))],
    ),
    (
        "two vertices selected",
        &[
            Event::Click(Button::Primary, Place::Own(1)),
            Event::Hold(Modifiers::SHIFT),
            Event::Click(Button::Primary, Place::Own(2)),
            Event::Hold(Modifiers::NONE),
        ],
    ),
    (
        "all of a curve selected",
        &[Event::Command(Command::SelectAll)],
    ),
    (
        "all curves selected",
        &[
            Event::Command(Command::SelectAll),
            Event::Command(Command::SelectAll),
        ],
    ),
    (
        "a vertex of another curve selected",
        &[Event::Click(Button::Primary, Place::Other(1))],
    ),
    (
        "in the middle of a drag",
        &[
            Event::Press(Button::Primary, Place::Own(1)),
            Event::Move(Place::Own(1), DRAG),
        ],
    ),
    (
        "while a field is dragged",
        &[Event::Panel(Panel::PreviewVertex(
            0,
            2,
            glam::DVec3::new(3.5, 1.25, 0.0),
        ))],
    ),
    (
        "while a polygon is drawn",
        &[
            Event::Command(Command::Tool(ToolKind::Draw)),
            Event::Click(Button::Primary, Place::At(DVec2::new(20.0, 20.0))),
            Event::Click(Button::Primary, Place::At(DVec2::new(80.0, 20.0))),
            Event::Click(Button::Primary, Place::At(DVec2::new(90.0, 60.0))),
        ],
    ),
];

/// Operations that search for seconds are tried in some situations alone: they do the same in all.
const SLOW: [&str; 1] = ["close"];

fn is_slow(operation: &Operation) -> bool {
    SLOW.contains(&operation.name)
}

#[test]
fn every_command_in_every_situation_is_undone_to_the_bit() {
    let mut failures = Failures::default();
    for case in cases() {
        for (number, (situation, events)) in SITUATIONS.into_iter().enumerate() {
            for asked in every_command().into_iter().chain(every_replacement()) {
                let is_slow =
                    matches!(&asked, Event::Command(Command::Operation(it)) if is_slow(it));
                if is_slow && number % 5 != 0 {
                    continue;
                }
                let played = play(&case, |player| {
                    player.play(events)?;
                    player.play(std::slice::from_ref(&asked))?;
                    player.play(&[Event::Move(Place::Own(1), 2.0 * DRAG)])
                });
                let name = || format!("{}, {situation}, {asked:?}", case.name);
                failures.check(name, played);
            }
        }
    }
    failures.none();
}

#[test]
fn every_step_of_every_command_is_undone_and_redone_between_others() {
    let mut failures = Failures::default();
    for case in cases() {
        failures.check(
            || case.name.to_owned(),
            play(&case, |player| player.play(&every_command())),
        );
        failures.check(
            || format!("{}, operations", case.name),
            play(&case, |player| {
                ALL.iter().try_for_each(|operation| {
                    player.play(&[tried(operation), Event::Panel(Panel::Apply)])
                })
            }),
        );
    }
    failures.none();
}

/// Try an operation out.
fn tried(operation: &'static Operation) -> Event {
    Event::Command(Command::Operation(operation))
}

#[test]
fn every_operation_applied_or_cancelled_is_undone_to_the_bit() {
    let mut failures = Failures::default();
    let plain = |key| Event::Key(Modifiers::NONE, key);
    let endings = [
        vec![Event::Panel(Panel::Apply)],
        vec![plain(Key::Enter)],
        vec![Event::Panel(Panel::Apply), Event::Command(Command::Undo)],
        vec![Event::Panel(Panel::Leave)],
        vec![plain(Key::Escape)],
        vec![Event::Command(Command::Undo)],
    ];
    for case in cases() {
        for operation in ALL {
            for (number, ending) in endings.iter().enumerate() {
                let cancels = number > 1;
                if is_slow(operation) && number % 3 != 0 {
                    continue;
                }
                let played = play(&case, |player| {
                    let before = player.window.document().clone();
                    let has_parameters = !operation.parameters.is_empty();
                    player.play(&[tried(operation)])?;
                    if player.window.is_trying() && !has_parameters {
                        return Err("without parameters there is nothing to try out".into());
                    }
                    let tries = player.window.is_trying();
                    let changes = !player.window.document().is_same(&before);
                    if tries && (changes || number < 2) {
                        player.play(ending)?;
                    }
                    if tries && cancels && !player.window.document().is_same(&before) {
                        return Err("the operation left a trace".into());
                    }
                    Ok(())
                });
                let name = || format!("{}, {}, {ending:?}", case.name, operation.name);
                failures.check(name, played);
            }
        }
    }
    failures.none();
}

/// Where clicks and drags of a tool begin: what every tool may meet, and handles of its own.
fn places(tool: ToolKind) -> Vec<Place> {
    let mut places = vec![
        Place::Own(1),
        Place::Own(0),
        Place::Other(1),
        Place::Leg(1, 0.37),
        Place::Curve(0.31),
        Place::Clamped(1),
        Place::Tooth(0),
        Place::At(DVec2::new(20.0, 6.0)),
        // On a ruler.
        Place::At(DVec2::new(8.0, 300.0)),
    ];
    match tool {
        ToolKind::EndFit => places.extend([
            Place::End(End::Start),
            Place::End(End::Finish),
            Place::Ring(1.0),
            Place::Target,
            Place::Arrow,
        ]),
        ToolKind::Rotate | ToolKind::Scale => places.push(Place::Pivot),
        _ => {}
    }
    places
}

/// What is done there: what comes between the press and the release, if there is a drag.
fn gestures() -> Vec<(String, Gesture)> {
    let mut all = vec![
        ("click".to_owned(), Gesture::Click(Modifiers::NONE)),
        (
            "click with Shift".to_owned(),
            Gesture::Click(Modifiers::SHIFT),
        ),
        (
            "click with Ctrl".to_owned(),
            Gesture::Click(Modifiers::CTRL),
        ),
        ("click with Alt".to_owned(), Gesture::Click(ALT)),
        ("double click".to_owned(), Gesture::DoubleClick),
        ("drag".to_owned(), Gesture::Drag(Vec::new())),
    ];
    for held in [
        Modifiers::SHIFT,
        Modifiers::CTRL,
        ALT,
        Modifiers::CTRL_SHIFT,
    ] {
        let name = format!("drag with {held:?}");
        all.push((name, Gesture::DragWith(held)));
        let name = format!("drag with {held:?} from the middle");
        all.push((name, Gesture::Drag(vec![Event::Hold(held)])));
    }
    for axis in 0..3 {
        let name = format!("drag along axis {axis}");
        all.push((name, Gesture::Drag(vec![Event::Axis(Some(axis))])));
    }
    for (held, key) in keys() {
        let name = format!("drag, {held:?} {key:?} in the middle");
        all.push((name, Gesture::Drag(vec![Event::Key(held, key)])));
    }
    for button in [Button::Secondary, Button::Middle] {
        let name = format!("drag, {button:?} clicked in the middle");
        all.push((name, Gesture::Drag(vec![Event::Release(button)])));
        let name = format!("drag with {button:?}");
        all.push((name, Gesture::DragBy(button)));
    }
    for key in [Key::Left, Key::Tab] {
        let name = format!("drag, {key:?} held in the middle");
        let held = vec![Event::Repeat(Modifiers::NONE, key, 2)];
        all.push((name, Gesture::Drag(held)));
    }
    let leave = vec![Event::Leave];
    all.push(("drag off the canvas".to_owned(), Gesture::Drag(leave)));
    all
}

/// Alt alone.
const ALT: Modifiers = Modifiers {
    shift: false,
    ctrl: false,
    alt: true,
};

enum Gesture {
    Click(Modifiers),
    DoubleClick,
    Drag(Vec<Event>),
    DragWith(Modifiers),
    DragBy(Button),
}

impl Gesture {
    /// The events, at a place.
    fn events(&self, at: DVec2) -> Vec<Event> {
        let place = Place::At(at);
        let drag = |between: &[Event], button: Button| {
            let mut events = vec![
                Event::Press(button, place),
                Event::Move(Place::At(at + 0.5 * DRAG), DVec2::ZERO),
            ];
            events.extend_from_slice(between);
            events.push(Event::Move(Place::At(at + DRAG), DVec2::ZERO));
            events.push(Event::Release(button));
            events
        };
        match self {
            Self::Click(held) => vec![
                Event::Hold(*held),
                Event::Click(Button::Primary, place),
                Event::Hold(Modifiers::NONE),
            ],
            Self::DoubleClick => vec![Event::DoubleClick(place)],
            Self::Drag(between) => drag(between, Button::Primary),
            Self::DragBy(button) => drag(&[], *button),
            Self::DragWith(held) => {
                let mut events = vec![Event::Hold(*held)];
                events.extend(drag(&[], Button::Primary));
                events.push(Event::Hold(Modifiers::NONE));
                events
            }
        }
    }
}

/// The keys that are pressed in the middle of a drag: the canvas's own, and the tools' letters.
fn keys() -> Vec<(Modifiers, Key)> {
    let plain = [
        Key::Escape,
        Key::Delete,
        Key::Backspace,
        Key::Enter,
        Key::Tab,
        Key::Space,
        Key::Left,
        Key::Right,
        Key::Up,
        Key::Down,
        Key::Character('1'),
    ];
    let letters = ToolKind::ALL.map(|tool| Key::Character(tool.key()));
    let held = ['z', 'x', 'c', 'v', 'a', 'd'].map(Key::Character);
    let plain = plain.into_iter().chain(letters);
    let mut keys: Vec<(Modifiers, Key)> = plain.map(|key| (Modifiers::NONE, key)).collect();
    keys.extend(held.map(|key| (Modifiers::CTRL, key)));
    keys.push((Modifiers::CTRL_SHIFT, Key::Character('z')));
    keys
}

fn check_tool(tool: ToolKind) {
    let mut failures = Failures::default();
    let gestures = gestures();
    for case in cases() {
        for place in places(tool) {
            for (gesture_name, gesture) in &gestures {
                let played = play(&case, |player| {
                    player.play(&[
                        // Combs and closed S-polygons can be hit where they are shown.
                        Event::Command(Command::ToggleLayer(Layer::Comb)),
                        Event::Command(Command::Tool(tool)),
                    ])?;
                    let Some(at) = place.find(&mut player.window) else {
                        return Ok(());
                    };
                    player.play(&gesture.events(at))
                });
                let name = || format!("{}, {tool:?}, {place:?}, {gesture_name}", case.name);
                failures.check(name, played);
            }
        }
    }
    failures.none();
}

#[test]
fn escape_in_the_middle_of_a_drag_leaves_no_trace() {
    let mut failures = Failures::default();
    for case in cases() {
        let of_tool = |tool: &ToolKind| {
            let tool = *tool;
            places(tool).into_iter().map(move |place| (tool, place))
        };
        for (tool, place) in ToolKind::ALL.iter().flat_map(of_tool) {
            let played = play(&case, |player| {
                player.play(&[
                    Event::Command(Command::ToggleLayer(Layer::Comb)),
                    Event::Command(Command::Tool(tool)),
                ])?;
                let Some(at) = place.find(&mut player.window) else {
                    return Ok(());
                };
                let (comb, view) = (player.window.comb(), *player.window.viewport());
                let active = player.window.active();
                let drag = Gesture::Drag(vec![Event::Key(Modifiers::NONE, Key::Escape)]);
                player.play(&drag.events(at))?;
                if *player.window.viewport() != view {
                    return Err("the view is not as it was".into());
                }
                // A curve that is pressed stays the active one, and the comb suits it.
                if player.window.comb() != comb && player.window.active() == active {
                    return Err("the comb is not as it was".into());
                }
                Ok(())
            });
            failures.check(|| format!("{}, {tool:?}, {place:?}", case.name), played);
        }
    }
    failures.none();
}

/// A test for each tool, so that they run side by side.
macro_rules! check_tools {
    ($($name:ident: $tool:expr,)*) => {
        $(#[test]
        fn $name() {
            check_tool($tool);
        })*

        /// Every tool has a test of its own.
        #[test]
        fn every_tool_is_in_the_matrix() {
            let tested = [$($tool),*];
            assert_eq!(tested, ToolKind::ALL);
        }
    };
}

check_tools! {
    selecting_is_undone_to_the_bit: ToolKind::Select,
    adding_vertices_is_undone_to_the_bit: ToolKind::AddVertex,
    inserting_is_undone_to_the_bit: ToolKind::Insert,
    deleting_is_undone_to_the_bit: ToolKind::Delete,
    drawing_is_undone_to_the_bit: ToolKind::Draw,
    rotating_is_undone_to_the_bit: ToolKind::Rotate,
    scaling_is_undone_to_the_bit: ToolKind::Scale,
    measuring_is_undone_to_the_bit: ToolKind::Measure,
    end_fitting_is_undone_to_the_bit: ToolKind::EndFit,
}

/// Every command there is, whatever will be added, and copying and cutting.
fn every_command() -> Vec<Event> {
    let commands = Window::open(Document::default()).commands();
    let panels = [Panel::Copy, Panel::CopyAndPaste, Panel::Cut].map(Event::Panel);
    commands
        .into_iter()
        .map(Event::Command)
        .chain(panels)
        .collect()
}

/// What is asked for to work on another document.
fn every_replacement() -> impl Iterator<Item = Event> {
    let examples = (0..EXAMPLES.len()).map(Replacement::Example);
    let others = [Replacement::Empty, Replacement::MissingFile];
    let all = others.into_iter().chain(examples);
    all.map(|replacement| Event::Panel(Panel::Replace(replacement)))
}

/// Open a document, play, let go, and undo and redo everything.
fn play(case: &Case, play: impl FnOnce(&mut Player) -> Result<(), String>) -> Result<(), String> {
    let mut player = case.open()?;
    play(&mut player)?;
    player.settle()
}
