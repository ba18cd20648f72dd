//! Curves of the section `Curves`, and the part of a curve that an edge takes.

use std::f64::consts::TAU;

use glam::DVec3;

use super::spline_part::{check, cut};
use super::tokens::Tokens;
use crate::io::exchange::drawing::{Conic, Kind, Nurbs, Shape, Unreadable};

/// The highest degree taken: cutting a spline costs its square.
const DEGREE: usize = 128;

/// How deep trimmed and offset curves may nest.
const NESTING: usize = 64;

/// Numbers from here on are infinite to OpenCascade.
const INFINITE: f64 = 1.0e100;

/// A curve by OpenCascade's parameters.
pub(super) enum Curve {
    Line {
        origin: DVec3,
        direction: DVec3,
    },
    /// A circle or an ellipse with its half-axes.
    Ellipse {
        centre: DVec3,
        x: DVec3,
        y: DVec3,
        is_circle: bool,
    },
    /// origin + x·t² + y·t.
    Parabola {
        origin: DVec3,
        x: DVec3,
        y: DVec3,
    },
    /// centre + x·cosh t + y·sinh t.
    Hyperbola {
        centre: DVec3,
        x: DVec3,
        y: DVec3,
    },
    Bezier(Nurbs),
    Spline(Spline),
    /// An offset curve: no spline.
    Offset,
}

/// A B-spline by its knots and their multiplicities.
pub(super) struct Spline {
    degree: usize,
    knots: Vec<(f64, usize)>,
    points: Vec<DVec3>,
    weights: Option<Vec<f64>>,
    periodic: bool,
}

impl Curve {
    /// Read a curve.
    ///
    /// # Errors
    /// [`Unreadable`] with the line where the numbers are no curve's.
    pub fn read(from: &mut Tokens) -> Result<Self, Unreadable> {
        for _ in 0..NESTING {
            let curve = match from.integer()? {
                1 => Self::Line {
                    origin: from.point()?,
                    direction: from.point()?,
                },
                kind @ 2..=5 => Self::conic(kind, from)?,
                6 => bezier(from)?,
                7 => Self::Spline(spline(from)?),
                // A trimmed curve has the parameters of its basis.
                8 => {
                    from.number()?;
                    from.number()?;
                    continue;
                }
                9 => {
                    from.number()?;
                    from.point()?;
                    Self::read_basis(from)?;
                    Self::Offset
                }
                other => return Err(fault(from, format!("curve type {other} is unknown"))),
            };
            return Ok(curve);
        }
        Err(fault(from, format!("curves nest more than {NESTING} deep")))
    }

    /// Skip the basis of an offset curve, itself perhaps an offset curve.
    fn read_basis(from: &mut Tokens) -> Result<(), Unreadable> {
        for _ in 0..NESTING {
            if from.peek() != Some(b"9") {
                return Self::read(from).map(drop);
            }
            from.integer()?;
            from.number()?;
            from.point()?;
        }
        Err(fault(from, format!("curves nest more than {NESTING} deep")))
    }

    fn conic(kind: i64, from: &mut Tokens) -> Result<Self, Unreadable> {
        let (centre, _normal, x, y) = (from.point()?, from.point()?, from.point()?, from.point()?);
        let first = from.number()?;
        Ok(match kind {
            2 => Self::Ellipse {
                centre,
                x: x * first,
                y: y * first,
                is_circle: true,
            },
            4 if first == 0.0 => {
                return Err(fault(from, "a parabola's focal length is 0".to_owned()));
            }
            4 => Self::Parabola {
                origin: centre,
                x: x / (4.0 * first),
                y,
            },
            _ => {
                let (x, y) = (x * first, y * from.number()?);
                match kind {
                    3 => Self::Ellipse {
                        centre,
                        x,
                        y,
                        is_circle: false,
                    },
                    _ => Self::Hyperbola { centre, x, y },
                }
            }
        })
    }

    /// Give the curve as a whole; `None` if it is infinite.
    pub fn whole(&self) -> Option<Result<(Kind, Shape), String>> {
        match self {
            Self::Ellipse { .. } => Some(self.part(0.0, TAU)),
            Self::Bezier(_) => Some(self.part(0.0, 1.0)),
            Self::Spline(spline) => {
                let (from, to) = (spline.knots.first()?.0, spline.knots.last()?.0);
                Some(self.part(from, to))
            }
            Self::Line { .. } | Self::Parabola { .. } | Self::Hyperbola { .. } | Self::Offset => {
                None
            }
        }
    }

    /// Give the part from one parameter to another.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn part(&self, from: f64, to: f64) -> Result<(Kind, Shape), String> {
        if !(from < to) {
            return Err(format!("its parameters {from} to {to} do not rise"));
        }
        if from <= -INFINITE || to >= INFINITE {
            return Err("it is infinite".to_owned());
        }
        match self {
            Self::Line { origin, direction } => {
                let points = vec![*origin + *direction * from, *origin + *direction * to];
                Ok((
                    Kind::Line,
                    Shape::Polyline {
                        points,
                        closed: false,
                    },
                ))
            }
            Self::Ellipse {
                centre,
                x,
                y,
                is_circle,
            } => {
                let is_whole = to - from >= TAU * (1.0 - 1.0e-12);
                let to = if is_whole { from + TAU } else { to };
                let conic = Conic {
                    centre: *centre,
                    x: *x,
                    y: *y,
                    from,
                    to,
                };
                let kind = match (is_whole, is_circle) {
                    (_, false) => Kind::Ellipse,
                    (true, true) => Kind::Circle,
                    (false, true) => Kind::Arc,
                };
                Ok((kind, Shape::Conic(conic)))
            }
            Self::Parabola { origin, x, y } => {
                let blossom = |s: f64, t: f64| *origin + *x * (s * t) + *y * (0.5 * (s + t));
                Ok(segment(
                    [blossom(from, from), blossom(from, to), blossom(to, to)],
                    None,
                ))
            }
            Self::Hyperbola { centre, x, y } => {
                let at = |t: f64, weight: f64| *centre + (*x * t.cosh() + *y * t.sinh()) / weight;
                let weight = (0.5 * (to - from)).cosh();
                let points = [at(from, 1.0), at(0.5 * (from + to), weight), at(to, 1.0)];
                Ok(segment(points, Some(weight)))
            }
            Self::Bezier(nurbs) => {
                check(nurbs)?;
                Ok((
                    Kind::Bezier,
                    Shape::Nurbs(cut(nurbs.clone(), from.max(0.0), to.min(1.0))),
                ))
            }
            Self::Spline(spline) => Ok((Kind::Spline, Shape::Nurbs(spline.part(from, to)?))),
            Self::Offset => Err("an offset curve is no spline".to_owned()),
        }
    }
}

impl Spline {
    /// Give the part from one parameter to another, of a periodic spline also across its seam.
    fn part(&self, from: f64, to: f64) -> Result<Nurbs, String> {
        let nurbs = if self.periodic {
            self.unrolled(from, to)?
        } else {
            self.plain()
        };
        check(&nurbs)?;
        let domain = (nurbs.knots[nurbs.degree], nurbs.knots[nurbs.points.len()]);
        // Ends of edges come from computations.
        let near = 4.0 * f64::EPSILON * (domain.1 - domain.0 + domain.0.abs() + domain.1.abs());
        let from = if from <= domain.0 + near {
            domain.0
        } else {
            from
        };
        let to = if to >= domain.1 - near { domain.1 } else { to };
        if !(from < to) {
            return Err(format!(
                "its parameters {from} to {to} lie outside of its knots"
            ));
        }
        let periodic = self.periodic && (from, to) == domain;
        Ok(Nurbs {
            periodic,
            ..cut(nurbs, from, to)
        })
    }

    fn plain(&self) -> Nurbs {
        let knots = self
            .knots
            .iter()
            .flat_map(|(knot, count)| std::iter::repeat_n(*knot, *count));
        Nurbs {
            degree: self.degree,
            knots: knots.collect(),
            points: self.points.clone(),
            weights: self.weights.clone(),
            periodic: false,
        }
    }

    /// Complete the knots and points of a periodic spline for one or two periods.
    fn unrolled(&self, from: f64, to: f64) -> Result<Nurbs, String> {
        let (Some((first, multiplicity)), Some((last, _))) =
            (self.knots.first(), self.knots.last())
        else {
            return Err("it has no knots".to_owned());
        };
        let (count, period) = (self.points.len(), last - first);
        let inner = self
            .knots
            .get(..self.knots.len().saturating_sub(1))
            .unwrap_or_default();
        let inner = inner
            .iter()
            .flat_map(|(knot, times)| std::iter::repeat_n(*knot, *times));
        let once: Vec<f64> = inner.collect();
        if count == 0 || once.len() != count || !(period > 0.0) || *multiplicity > self.degree {
            return Err("its knots do not fit a periodic spline".to_owned());
        }
        let turn = ((from - first) / period + 1.0e-12).floor();
        let is_across = to - first - turn * period > period * (1.0 + 1.0e-12);
        let total =
            if is_across { 2 * count } else { count } + 2 * (self.degree + 1) - multiplicity;
        let before = self.degree + 1 - multiplicity;
        // Whole turns before the first knot that is needed, so that indices are not negative.
        let turns = before.div_ceil(count);
        let knots = (turns * count - before..).take(total).map(|index| {
            let number = (index / count) as f64 - turns as f64 + turn;
            once[index % count] + number * period
        });
        let all = (0..total - self.degree - 1).map(|index| index % count);
        Ok(Nurbs {
            degree: self.degree,
            knots: knots.collect(),
            points: all.clone().map(|index| self.points[index]).collect(),
            weights: self
                .weights
                .as_ref()
                .map(|weights| all.map(|index| weights[index]).collect()),
            periodic: true,
        })
    }
}

/// One segment of degree 2.
fn segment(points: [DVec3; 3], weight: Option<f64>) -> (Kind, Shape) {
    let nurbs = Nurbs {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        points: points.to_vec(),
        weights: weight.map(|weight| vec![1.0, weight, 1.0]),
        periodic: false,
    };
    (Kind::Spline, Shape::Nurbs(nurbs))
}

fn bezier(from: &mut Tokens) -> Result<Curve, Unreadable> {
    let is_rational = from.integer()? != 0;
    let degree = degree(from)?;
    let (points, weights) = poles(from, degree + 1, is_rational)?;
    let ends = [0.0, 1.0].into_iter();
    Ok(Curve::Bezier(Nurbs {
        degree,
        knots: ends
            .flat_map(|end| std::iter::repeat_n(end, degree + 1))
            .collect(),
        points,
        weights,
        periodic: false,
    }))
}

fn spline(from: &mut Tokens) -> Result<Spline, Unreadable> {
    let is_rational = from.integer()? != 0;
    let periodic = from.integer()? != 0;
    let degree = degree(from)?;
    let (count, knot_count) = (from.count()?, from.count()?);
    let (points, weights) = poles(from, count, is_rational)?;
    let mut knots = Vec::new();
    let mut total = 0_usize;
    for _ in 0..knot_count {
        let (knot, times) = (from.number()?, from.integer()?);
        let times = usize::try_from(times)
            .ok()
            .filter(|times| (1..=degree + 1).contains(times));
        let times =
            times.ok_or_else(|| fault(from, "a knot's multiplicity does not fit".to_owned()))?;
        total += times;
        knots.push((knot, times));
    }
    // Lists of equal knots cost memory that the file does not have.
    if total > count.saturating_add(2 * degree + 2) {
        return Err(fault(
            from,
            format!("{total} knots are too many for {count} points"),
        ));
    }
    Ok(Spline {
        degree,
        knots,
        points,
        weights,
        periodic,
    })
}

fn degree(from: &mut Tokens) -> Result<usize, Unreadable> {
    let degree = from.integer()?;
    let taken = usize::try_from(degree)
        .ok()
        .filter(|degree| (1..=DEGREE).contains(degree));
    taken.ok_or_else(|| fault(from, format!("degree {degree}")))
}

type Poles = (Vec<DVec3>, Option<Vec<f64>>);

fn poles(from: &mut Tokens, count: usize, is_rational: bool) -> Result<Poles, Unreadable> {
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for _ in 0..count {
        points.push(from.point()?);
        if is_rational {
            weights.push(from.number()?);
        }
    }
    let is_uneven = weights.windows(2).any(|pair| pair[0] != pair[1]);
    Ok((points, is_uneven.then_some(weights)))
}

fn fault(from: &mut Tokens, reason: String) -> Unreadable {
    Unreadable {
        at: Some(from.line()),
        reason,
    }
}
