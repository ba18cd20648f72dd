//! Chains of model points as lines on the screen: mapped, cut at gaps and clipped before they
//! become single precision, so that nothing far away overflows.

use eframe::egui::{Pos2, Rect};
use glam::DVec2;

use crate::editor::Viewport;

/// Screen points beyond the canvas within which lines are kept whole.
const MARGIN: f64 = 64.0;

/// Map model points to the screen.
#[derive(Clone, Copy, Debug)]
pub struct Screen<'a> {
    /// The viewport.
    pub viewport: &'a Viewport,
    origin: DVec2,
    low: DVec2,
    high: DVec2,
}

impl<'a> Screen<'a> {
    /// The map for a canvas.
    pub fn new(viewport: &'a Viewport, rect: Rect) -> Self {
        let origin = DVec2::new(f64::from(rect.min.x), f64::from(rect.min.y));
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        Self {
            viewport,
            origin,
            low: origin - MARGIN,
            high: origin + size + MARGIN,
        }
    }

    /// Screen points a unit of the model.
    pub fn scale(&self) -> f64 {
        self.viewport.scale
    }

    /// Map a point, in double precision.
    pub fn exact(&self, point: DVec2) -> DVec2 {
        self.origin + self.viewport.to_screen(point)
    }

    /// Map a point if it is on the canvas or close to it.
    pub fn point(&self, point: DVec2) -> Option<Pos2> {
        let place = self.exact(point);
        self.holds(place).then(|| single(place))
    }

    /// Map a point, however far away it is.
    pub fn pos(&self, point: DVec2) -> Pos2 {
        single(self.exact(point))
    }

    fn holds(&self, place: DVec2) -> bool {
        place.cmpge(self.low).all() && place.cmple(self.high).all()
    }

    /// Map a segment, if it is on the canvas or close to it.
    pub fn segment(&self, [from, to]: [DVec2; 2]) -> Option<[Pos2; 2]> {
        let (from, to) = (self.exact(from), self.exact(to));
        let (from, to) = self.clip(from, to)?;
        Some([single(from), single(to)])
    }

    /// Map a chain to one line for each of its pieces: gaps and far points break it.
    pub fn lines(&self, chain: &[DVec2]) -> Vec<Vec<Pos2>> {
        let mut lines = Vec::new();
        let mut line: Vec<Pos2> = Vec::new();
        let mut last: Option<DVec2> = None;
        for point in chain {
            let place = self.exact(*point);
            let before = last.replace(place);
            let Some(before) = before else {
                continue;
            };
            match self.clip(before, place) {
                Some((from, to)) => {
                    if line.is_empty() || from != before {
                        finish(&mut line, &mut lines);
                        line.push(single(from));
                    }
                    line.push(single(to));
                    if to != place {
                        finish(&mut line, &mut lines);
                    }
                }
                None => finish(&mut line, &mut lines),
            }
        }
        finish(&mut line, &mut lines);
        lines
    }

    /// The part of a segment within the margin; `None` if there is none or an end is not a
    /// number.
    fn clip(&self, from: DVec2, to: DVec2) -> Option<(DVec2, DVec2)> {
        if self.holds(from) && self.holds(to) {
            return Some((from, to));
        }
        if !from.is_finite() || !to.is_finite() {
            return None;
        }
        if self.holds(to) {
            // Measured from the far end, the near one would be lost to rounding.
            return self.clip(to, from).map(|(to, from)| (from, to));
        }
        let along = to - from;
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in 0..2 {
            if along[axis] == 0.0 {
                if from[axis] < self.low[axis] || from[axis] > self.high[axis] {
                    return None;
                }
                continue;
            }
            let a = (self.low[axis] - from[axis]) / along[axis];
            let b = (self.high[axis] - from[axis]) / along[axis];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter < leave).then(|| {
            let at = |t: f64, end: DVec2, whole: bool| if whole { end } else { from + along * t };
            (at(enter, from, enter == 0.0), at(leave, to, leave == 1.0))
        })
    }
}

fn finish(line: &mut Vec<Pos2>, lines: &mut Vec<Vec<Pos2>>) {
    if line.len() > 1 {
        lines.push(std::mem::take(line));
    } else {
        line.clear();
    }
}

fn single(place: DVec2) -> Pos2 {
    Pos2::new(place.x as f32, place.y as f32)
}

#[cfg(test)]
mod tests {
    use eframe::egui::{pos2, vec2};

    use super::*;
    use crate::editor::GAP;

    fn check(chain: &[DVec2], expected: &[usize]) {
        let viewport = Viewport {
            centre: DVec2::ZERO,
            scale: 1.0,
            size: DVec2::new(200.0, 100.0),
            ..Viewport::default()
        };
        let screen = Screen::new(
            &viewport,
            Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 100.0)),
        );
        let lines = screen.lines(chain);
        let lengths: Vec<usize> = lines.iter().map(Vec::len).collect();
        assert_eq!(lengths, expected, "{lines:?}");
        for place in lines.iter().flatten() {
            assert!(place.x.abs() < 400.0 && place.y.abs() < 400.0, "{place:?}");
        }
    }

    #[test]
    fn gaps_break_a_chain() {
        let at = |x: f64| DVec2::new(x, 0.0);
        check(&[at(0.0), at(1.0), at(2.0)], &[3]);
        check(&[at(0.0), at(1.0), GAP, at(2.0), at(3.0)], &[2, 2]);
        check(&[GAP, at(1.0), GAP], &[]);
    }

    #[test]
    fn far_points_are_cut_off_and_never_join_what_is_apart() {
        let far = 1e250;
        check(
            &[DVec2::new(-far, 0.0), DVec2::ZERO, DVec2::new(far, far)],
            &[3],
        );
        check(&[DVec2::new(0.0, far), DVec2::new(1.0, far)], &[]);
        let out_and_back = [
            DVec2::ZERO,
            DVec2::new(1e9, 0.0),
            DVec2::new(1e9, 9.0),
            DVec2::ZERO,
        ];
        check(&out_and_back, &[2, 2]);
    }
}
