//! One machine in front of all tools: presses and moves become clicks, drags and pans.

use glam::DVec2;

use crate::editor::hand::input::{Button, Input, Key};

/// The pointer must move this far, in screen points, before a press becomes a drag.
pub const THRESHOLD: f64 = 3.0;

/// A drag that ends this near to where it began, in screen points, may have been meant as a click.
const HASTY: f64 = 8.0;

/// Whether a drag from here to there may have been meant as a click: for tools that set points.
pub fn is_hasty_click(from: DVec2, to: DVec2) -> bool {
    from.distance(to) <= HASTY
}

/// A gesture on the canvas, in screen points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gesture {
    /// The primary button was pressed and released in one place.
    Click(DVec2),
    /// The primary button was clicked twice.
    DoubleClick(DVec2),
    /// The second button was clicked.
    SecondaryClick(DVec2),
    /// A drag has begun: where the button went down.
    DragStart(DVec2),
    /// The drag goes on here.
    Drag(DVec2),
    /// The drag ends here.
    DragEnd(DVec2),
    /// The drag is called off.
    Cancel,
    /// A key that is no command's.
    Key(Key),
    /// The view is pushed by some screen points.
    Pan(DVec2),
    /// The view is turned by a drag of some screen points.
    Orbit(DVec2),
    /// The view is scaled about a place.
    Zoom(DVec2, f64),
}

/// The state of the hand on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GestureMachine {
    state: State,
    space: bool,
    /// Where the pointer is, if it is on the canvas.
    pointer: Option<DVec2>,
    /// Where it has rested since it came there.
    rested: Option<DVec2>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    #[default]
    Idle,
    Pressed {
        origin: DVec2,
    },
    Dragging,
    Panning {
        last: DVec2,
        button: Button,
    },
    /// The second button is held: a drag turns the view, otherwise it is a click.
    Orbiting {
        last: DVec2,
        turned: bool,
    },
    /// A drag was called off; nothing happens until the button is released.
    Spent,
}

impl GestureMachine {
    /// Where the pointer is, if it is on the canvas.
    pub fn pointer(&self) -> Option<DVec2> {
        self.pointer
    }

    /// Where the pointer has rested since it came there, before a press.
    pub fn rested(&self) -> Option<DVec2> {
        self.rested
    }

    /// Whether a drag is going on.
    pub fn is_dragging(&self) -> bool {
        self.state == State::Dragging
    }

    /// Whether the primary button is held: a drag goes on, or may begin.
    pub fn is_holding(&self) -> bool {
        matches!(self.state, State::Pressed { .. } | State::Dragging)
    }

    /// Whether no button is held.
    pub fn is_free(&self) -> bool {
        self.state == State::Idle
    }

    /// Whether the view is being pushed, or would be by a press.
    pub fn is_panning(&self) -> bool {
        self.space || matches!(self.state, State::Panning { .. })
    }

    /// Whether the view is being turned.
    pub fn is_orbiting(&self) -> bool {
        matches!(self.state, State::Orbiting { turned: true, .. })
    }

    /// Forget a press or drag, as when the tool changes under it.
    pub fn reset(&mut self) {
        if self.state != State::Idle {
            self.state = State::Spent;
        }
    }

    /// Turn one input into gestures, in order.
    pub fn input(&mut self, input: Input) -> Vec<Gesture> {
        match input {
            Input::Moved { at } => self.moved(at),
            Input::Pressed { button, at } => self.pressed(button, at),
            Input::Released { button, at } => self.released(button, at),
            Input::DoubleClicked { at } => vec![Gesture::DoubleClick(at)],
            Input::Rested { at } => {
                self.rested = Some(at);
                Vec::new()
            }
            Input::Left => {
                self.pointer = None;
                self.rested = None;
                Vec::new()
            }
            Input::Zoomed { at, factor } => vec![Gesture::Zoom(at, factor)],
            Input::Panned { by } => vec![Gesture::Pan(by)],
            Input::Key(Key::Escape) if self.state == State::Dragging => {
                self.state = State::Spent;
                vec![Gesture::Cancel]
            }
            Input::Key(key) | Input::KeyRepeated(key) => vec![Gesture::Key(key)],
            Input::SpaceHeld(held) => {
                self.space = held;
                Vec::new()
            }
            Input::Modifiers(_) | Input::AxisHeld(_) | Input::KeepingHeld(_) => {
                match (self.state, self.pointer) {
                    // A constraint came or went: the drag is seen anew under the resting pointer.
                    (State::Dragging, Some(at)) => vec![Gesture::Drag(at)],
                    _ => Vec::new(),
                }
            }
        }
    }

    fn moved(&mut self, at: DVec2) -> Vec<Gesture> {
        self.pointer = Some(at);
        if self.state == State::Idle {
            self.rested = self.rested.filter(|it| it.distance(at) < THRESHOLD);
        }
        match self.state {
            State::Idle | State::Spent => Vec::new(),
            State::Pressed { origin } if origin.distance(at) < THRESHOLD => Vec::new(),
            State::Pressed { origin } => {
                self.state = State::Dragging;
                vec![Gesture::DragStart(origin), Gesture::Drag(at)]
            }
            State::Dragging => vec![Gesture::Drag(at)],
            State::Panning { last, button } => {
                self.state = State::Panning { last: at, button };
                vec![Gesture::Pan(at - last)]
            }
            State::Orbiting {
                last,
                turned: false,
            } if last.distance(at) < THRESHOLD => Vec::new(),
            State::Orbiting { last, .. } => {
                self.state = State::Orbiting {
                    last: at,
                    turned: true,
                };
                vec![Gesture::Orbit(at - last)]
            }
        }
    }

    fn pressed(&mut self, button: Button, at: DVec2) -> Vec<Gesture> {
        self.pointer = Some(at);
        // A release may be lost outside the window: a new press ends what was called off.
        if !matches!(self.state, State::Idle | State::Spent) {
            return Vec::new();
        }
        let pans = button == Button::Middle || (self.space && button == Button::Primary);
        if pans {
            self.state = State::Panning { last: at, button };
        } else if button == Button::Primary {
            self.state = State::Pressed { origin: at };
        } else if button == Button::Secondary {
            self.state = State::Orbiting {
                last: at,
                turned: false,
            };
        }
        Vec::new()
    }

    fn released(&mut self, button: Button, at: DVec2) -> Vec<Gesture> {
        self.pointer = Some(at);
        let gestures = match (self.state, button) {
            (State::Pressed { origin }, Button::Primary) => vec![Gesture::Click(origin)],
            (State::Dragging, Button::Primary) => vec![Gesture::DragEnd(at)],
            (State::Orbiting { turned: false, .. }, Button::Secondary) => {
                vec![Gesture::SecondaryClick(at)]
            }
            (State::Panning { button: held, .. }, released) if held == released => Vec::new(),
            (State::Spent, Button::Primary) | (State::Orbiting { .. }, Button::Secondary) => {
                Vec::new()
            }
            _ => return Vec::new(),
        };
        self.state = State::Idle;
        gestures
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: DVec2 = DVec2::new(10.0, 10.0);

    fn at(x: f64) -> DVec2 {
        ORIGIN + DVec2::new(x, 0.0)
    }

    fn press(button: Button) -> Input {
        Input::Pressed { button, at: ORIGIN }
    }

    fn check(inputs: &[Input], expected: &[Gesture]) {
        let mut machine = GestureMachine::default();
        let gestures: Vec<Gesture> = inputs
            .iter()
            .flat_map(|input| machine.input(*input))
            .collect();
        assert_eq!(gestures, expected);
    }

    #[test]
    fn a_press_that_hardly_moves_is_a_click_where_it_began() {
        check(
            &[
                press(Button::Primary),
                Input::Moved { at: at(2.0) },
                Input::Released {
                    button: Button::Primary,
                    at: at(2.0),
                },
            ],
            &[Gesture::Click(ORIGIN)],
        );
    }

    #[test]
    fn a_drag_starts_where_the_button_went_down() {
        check(
            &[
                press(Button::Primary),
                Input::Moved { at: at(3.0) },
                Input::Released {
                    button: Button::Primary,
                    at: at(9.0),
                },
            ],
            &[
                Gesture::DragStart(ORIGIN),
                Gesture::Drag(at(3.0)),
                Gesture::DragEnd(at(9.0)),
            ],
        );
    }

    #[test]
    fn escape_calls_a_drag_off_and_the_rest_of_it_does_nothing() {
        check(
            &[
                press(Button::Primary),
                Input::Moved { at: at(5.0) },
                Input::Key(Key::Escape),
                Input::Moved { at: at(20.0) },
                Input::Released {
                    button: Button::Primary,
                    at: at(20.0),
                },
            ],
            &[
                Gesture::DragStart(ORIGIN),
                Gesture::Drag(at(5.0)),
                Gesture::Cancel,
            ],
        );
    }

    #[test]
    fn the_middle_button_and_space_pan() {
        let pan = [Gesture::Pan(DVec2::new(4.0, 0.0))];
        let drag = |button| {
            [
                press(button),
                Input::Moved { at: at(4.0) },
                Input::Released {
                    button,
                    at: at(4.0),
                },
            ]
        };
        check(&drag(Button::Middle), &pan);
        let mut held = vec![Input::SpaceHeld(true)];
        held.extend(drag(Button::Primary));
        check(&held, &pan);
    }
}
