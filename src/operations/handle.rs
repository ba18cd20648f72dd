//! Points on the canvas that set parameters when they are dragged.

use glam::DVec3;

use super::value::Value;
use crate::geometry::End;
use crate::geometry::mineur_farin::Configuration;

/// Describe a point on the canvas that sets parameters when it is dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Where it is, in model space.
    pub at: DVec3,
    /// What it sets, in words.
    pub label: &'static str,
    /// What it sets.
    pub sets: Sets,
}

/// What a handle sets; parameters are named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sets {
    /// A list: the coordinates of the point.
    Point(&'static str),
    /// A list: the vector to the point.
    Vector {
        /// The list.
        parameter: &'static str,
        /// Where the vector begins.
        from: DVec3,
    },
    /// Two numbers: how long the vector to the point is, as a multiple of another vector, and the
    /// angle from that to it.
    RatioAndAngle {
        /// The multiple.
        ratio: &'static str,
        /// The angle.
        angle: &'static str,
        /// Where the vector begins.
        from: DVec3,
        /// The other vector.
        base: DVec3,
        /// The direction about which the angle turns.
        normal: DVec3,
    },
    /// Two numbers of a Mineur–Farin configuration, such that its last point follows.
    LastPoint {
        /// The length ratio.
        ratio: &'static str,
        /// The turning angle.
        angle: &'static str,
        /// The configuration.
        configuration: Configuration,
        /// The number of its legs.
        legs: usize,
    },
    /// What the parameter of a point on the operation's curve sets.
    OnCurve(OnCurve),
}

/// What a handle on the operation's curve sets by the parameter u of its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OnCurve {
    /// A number: u.
    Number(&'static str),
    /// One of two numbers, between which a part of the curve lies.
    PartEnd {
        /// Where the part begins, and where it ends.
        parameters: [&'static str; 2],
        /// Their values.
        part: [f64; 2],
        /// Which of them the handle sets.
        end: End,
        /// The number of segments of a periodic curve: there the part may go over the seam.
        turn: Option<f64>,
    },
    /// A count of segments by which the curve is continued beyond an end.
    Beyond {
        /// The count.
        segments: &'static str,
        /// The end.
        end: End,
        /// Its parameter.
        from: f64,
    },
}

impl OnCurve {
    /// The values that a point with the parameter u sets; none where a part would be empty.
    pub fn values(&self, u: f64) -> Vec<(&'static str, Value)> {
        match *self {
            Self::Number(parameter) => vec![(parameter, Value::Real(u))],
            Self::PartEnd {
                parameters: [from, to],
                part,
                end,
                turn,
            } => {
                let [begin, stop] = match (end, turn) {
                    (End::Start, None) => [u, part[1]],
                    (End::Finish, None) => [part[0], u],
                    // The start lies in the first turn, the end up to a turn behind it.
                    (End::Start, Some(turn)) => {
                        let begin = u.rem_euclid(turn);
                        [begin, behind(begin, part[1], turn)]
                    }
                    (End::Finish, Some(turn)) => [part[0], behind(part[0], u, turn)],
                };
                match begin < stop {
                    true => vec![(from, Value::Real(begin)), (to, Value::Real(stop))],
                    false => Vec::new(),
                }
            }
            Self::Beyond { segments, from, .. } => {
                let count = (u - from).abs().round().max(1.0);
                vec![(segments, Value::Whole(count as usize))]
            }
        }
    }
}

/// The parameter of the same point of a periodic curve in the turn that follows `begin`.
fn behind(begin: f64, u: f64, turn: f64) -> f64 {
    let ahead = (u - begin).rem_euclid(turn);
    begin + if ahead > 0.0 { ahead } else { turn }
}

impl Handle {
    /// The names of the parameters that the handle sets.
    pub fn parameters(&self) -> Vec<&'static str> {
        match self.sets {
            Sets::Point(one) | Sets::Vector { parameter: one, .. } => vec![one],
            Sets::RatioAndAngle { ratio, angle, .. } | Sets::LastPoint { ratio, angle, .. } => {
                vec![ratio, angle]
            }
            Sets::OnCurve(OnCurve::Number(one) | OnCurve::Beyond { segments: one, .. }) => {
                vec![one]
            }
            Sets::OnCurve(OnCurve::PartEnd {
                parameters: [from, to],
                end,
                ..
            }) => vec![if end == End::Start { from } else { to }],
        }
    }

    /// The values that the handle sets when it is dragged to a point; none of a handle [`OnCurve`].
    pub fn values(&self, point: DVec3) -> Vec<(&'static str, Value)> {
        let coordinates = |vector: DVec3| {
            let planar = vector.z == 0.0;
            let coordinates = &vector.to_array()[..if planar { 2 } else { 3 }];
            Value::List(coordinates.to_vec())
        };
        match self.sets {
            Sets::Point(parameter) => vec![(parameter, coordinates(point))],
            Sets::Vector { parameter, from } => vec![(parameter, coordinates(point - from))],
            Sets::RatioAndAngle {
                ratio,
                angle,
                from,
                base,
                normal,
            } => {
                let vector = point - from;
                let (sine, cosine) = (base.cross(vector).dot(normal), base.dot(vector));
                vec![
                    (ratio, Value::Real(vector.length() / base.length())),
                    (angle, Value::Real(sine.atan2(cosine))),
                ]
            }
            Sets::LastPoint {
                ratio,
                angle,
                configuration,
                legs,
            } => {
                let found = configuration.reaching(legs, point);
                vec![
                    (ratio, Value::Real(found.ratio)),
                    (angle, Value::Real(found.turn)),
                ]
            }
            Sets::OnCurve(_) => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(end: End, part: [f64; 2], turn: Option<f64>) -> OnCurve {
        OnCurve::PartEnd {
            parameters: ["from", "to"],
            part,
            end,
            turn,
        }
    }

    fn numbers(values: Vec<(&'static str, Value)>) -> Vec<f64> {
        let number = |(_, value)| match value {
            Value::Real(number) => number,
            other => panic!("{other:?}"),
        };
        values.into_iter().map(number).collect()
    }

    #[test]
    fn a_part_of_an_open_curve_stays_in_order() {
        let start = part(End::Start, [1.0, 3.0], None);
        assert_eq!(numbers(start.values(2.5)), [2.5, 3.0]);
        assert!(start.values(3.0).is_empty());
        let end = part(End::Finish, [1.0, 3.0], None);
        assert_eq!(numbers(end.values(4.0)), [1.0, 4.0]);
        assert!(end.values(0.5).is_empty());
    }

    #[test]
    fn a_part_of_a_periodic_curve_goes_over_the_seam() {
        let end = part(End::Finish, [4.0, 5.0], Some(6.0));
        assert_eq!(numbers(end.values(1.0)), [4.0, 7.0]);
        assert_eq!(numbers(end.values(4.0)), [4.0, 10.0]);
        let start = part(End::Start, [4.0, 7.0], Some(6.0));
        assert_eq!(numbers(start.values(0.5)), [0.5, 1.0]);
        assert_eq!(numbers(start.values(2.0)), [2.0, 7.0]);
    }
}
