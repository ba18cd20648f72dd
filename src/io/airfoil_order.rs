//! The two orders in which airfoil files list the points of a section.
//!
//! Selig: from the trailing edge over the upper side to the leading edge, then over the lower side back.
//! Lednicer: a line with the number of points of either side, then each from the leading edge on. The line may be
//! left out.

use std::fmt;

use glam::DVec3;

/// The share of a section's size within which points count as one end of it.
const NEAR: f64 = 0.1;

/// The greatest thickness of a section as a share of its chord, and the greatest gap at its trailing edge:
/// of 2173 sections of a public collection two are thicker, and none is more open.
const THICKEST: f64 = 0.605;
const OPENEST: f64 = 0.25;

/// The greatest turn, in degrees, at a point of the body: the sharpest of that collection is 20°. Outlines of other
/// things have corners.
const SHARPEST: f64 = 30.0;

/// The share of the chord at either edge that does not belong to the body.
const EDGE: f64 = 0.15;

/// How near the chord of sides without counts is to 0 to 1, or to 0 to 100, where they are believed.
const NORMAL: f64 = 0.02;

/// The largest share of steps of one side that may go back along the chord, as at a blunt leading edge.
const STEPS_BACK: f64 = 0.1;

/// The order of the points of an airfoil file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AirfoilOrder {
    /// Around the section.
    Selig,
    /// Both sides from the leading edge, below a line with their counts.
    Lednicer,
    /// The same without the line.
    Uncounted,
}

impl fmt::Display for AirfoilOrder {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Selig => "Selig",
            Self::Lednicer | Self::Uncounted => "Lednicer",
        })
    }
}

/// The two sides of a section in Lednicer order.
#[derive(Debug, PartialEq)]
pub(super) struct Sides {
    /// Where the lower side begins among the points below the counts.
    pub(super) split: usize,
    /// Whether the counts are those of the sides.
    pub(super) are_counted: bool,
}

/// Find the sides of a section in Lednicer order, from all points of a table: the first is the line with
/// the counts. `breaks` are the places below which a blank line, or the end of the file, follows.
///
/// Both sides begin at about the same point. Counts that do not fit are tolerated where blank lines
/// divide two sides.
pub(super) fn lednicer(points: &[DVec3], breaks: &[usize]) -> Option<Sides> {
    let (counts, rest) = points.split_first()?;
    let is_count = |count: f64| count >= 2.0 && count.fract() == 0.0;
    if !is_count(counts.x) || !is_count(counts.y) || counts.z != 0.0 {
        return None;
    }
    let size = extent(rest).length();
    let meets = |split: usize| {
        let pair = rest.first().zip(rest.get(split));
        let meets = pair.is_some_and(|(a, b)| a.distance(*b) <= NEAR * size);
        meets && split >= 2 && rest.len() >= split + 2
    };
    let counted = counts.x as usize;
    if counts.x + counts.y == rest.len() as f64 && meets(counted) {
        let (split, are_counted) = (counted, true);
        return Some(Sides { split, are_counted });
    }
    let mut inner = breaks
        .iter()
        .filter(|place| (2..points.len()).contains(*place));
    let split = inner.next().map(|place| place - 1);
    let split = split.filter(|split| inner.next().is_none() && meets(*split))?;
    let are_counted = false;
    Some(Sides { split, are_counted })
}

/// The two sides of a section below no line with their counts.
#[derive(Debug, PartialEq)]
pub(super) struct UncountedSides {
    /// Where the second side begins.
    pub(super) split: usize,
    /// Whether the second side is the upper one.
    pub(super) is_upper_second: bool,
    /// Whether they can be nothing else: lines of a hull look alike.
    pub(super) is_certain: bool,
}

/// Find the sides of a section that both run from its leading edge: a blank line divides them, or the leading edge
/// begins both. `breaks` are as for [`lednicer`].
pub(super) fn uncounted(points: &[DVec3], breaks: &[usize]) -> Option<UncountedSides> {
    let mut inner = breaks.iter().filter(|place| **place < points.len());
    let (first, others) = points.split_first()?;
    let (split, is_divided) = match (inner.next(), inner.next()) {
        (Some(place), None) => (*place, true),
        (None, _) => (1 + others.iter().position(|it| it == first)?, false),
        _ => return None,
    };
    let meets = points.get(split)?.distance(*first) <= NORMAL * extent(points).x;
    let is_upper_second = [false, true].into_iter().find(|is_upper_second| {
        let (rows, split) = upper_first(points, split, *is_upper_second);
        let sides = rows.split_at_checked(split);
        let nose = sides.is_some_and(|(upper, lower)| [upper, lower].map(runs_on) == [true; 2]);
        nose && is_selig(&around(&rows, split, |a, b| a == b))
    })?;
    let size = extent(points);
    let is_normal = [1.0, 100.0].into_iter().any(|chord| {
        let near = |value: f64, wanted: f64| (value - wanted).abs() <= NORMAL * chord;
        near(first.x, 0.0) && near(first.y, 0.0) && near(size.x, chord)
    });
    meets.then_some(UncountedSides {
        split,
        is_upper_second,
        is_certain: !is_divided || is_normal,
    })
}

/// Whether a side runs from its least x to its greatest.
fn runs_on(side: &[DVec3]) -> bool {
    let back = side.windows(2).filter(|pair| pair[1].x < pair[0].x);
    back.count() as f64 <= STEPS_BACK * side.len() as f64
}

/// Bring the upper side before the lower one; returns where that begins.
pub(super) fn upper_first<T: Copy>(
    rows: &[T],
    split: usize,
    is_upper_second: bool,
) -> (Vec<T>, usize) {
    let mut rows = rows.to_vec();
    if !is_upper_second {
        return (rows, split);
    }
    let split = split.min(rows.len());
    rows.rotate_left(split);
    let upper = rows.len() - split;
    (rows, upper)
}

/// Bring two sides that begin at the leading edge into the order around the section; the leading edge
/// stands there once.
pub(super) fn around<T: Copy>(rows: &[T], split: usize, is_same: impl Fn(T, T) -> bool) -> Vec<T> {
    let (upper, lower) = rows.split_at(split.min(rows.len()));
    let meet = upper.first().zip(lower.first());
    let shared = meet.is_some_and(|(a, b)| is_same(*a, *b));
    let lower = lower.iter().skip(usize::from(shared));
    upper.iter().rev().chain(lower).copied().collect()
}

/// Whether points run around a section: from its trailing edge, where x is greatest, to the leading edge
/// and back, the upper side first. It is thin, nearly closed, and has no corner between the edges.
pub(super) fn is_selig(points: &[DVec3]) -> bool {
    let size = extent(points);
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return false;
    };
    let greatest = points
        .iter()
        .map(|point| point.x)
        .fold(f64::NEG_INFINITY, f64::max);
    let ends = [first, last]
        .into_iter()
        .all(|end| greatest - end.x <= NEAR * size.x);
    let order = |a: &usize, b: &usize| points[*a].x.total_cmp(&points[*b].x);
    let nose = (0..points.len()).min_by(order).unwrap_or_default();
    let (upper, lower) = (&points[..=nose], &points[nose..]);
    let forward: Vec<DVec3> = upper.iter().rev().copied().collect();
    let mean = |side: &[DVec3]| side.iter().map(|it| it.y).sum::<f64>() / side.len() as f64;
    let body = (greatest - (1.0 - EDGE) * size.x)..(greatest - EDGE * size.x);
    let is_corner = |three: &[DVec3]| {
        let turn = (three[1] - three[0]).angle_between(three[2] - three[1]);
        body.contains(&three[1].x) && turn > SHARPEST.to_radians()
    };
    ends && size.z == 0.0
        && size.y <= THICKEST * size.x
        && first.distance(*last) <= OPENEST * size.x
        && upper.len() > 2
        && lower.len() > 2
        && runs_on(&forward)
        && runs_on(lower)
        && mean(upper) > mean(lower)
        && !points.windows(3).any(is_corner)
}

/// The size of the box around points.
fn extent(points: &[DVec3]) -> DVec3 {
    let low = points.iter().copied().reduce(DVec3::min);
    let high = points.iter().copied().reduce(DVec3::max);
    high.unwrap_or_default() - low.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(values: &[(f64, f64)]) -> Vec<DVec3> {
        values
            .iter()
            .map(|(x, y)| DVec3::new(*x, *y, 0.0))
            .collect()
    }

    #[test]
    fn counts_are_told_from_a_first_point() {
        let sides = [
            (0.0, 0.0),
            (0.5, 0.1),
            (1.0, 0.0),
            (0.0, 0.0),
            (0.5, -0.1),
            (1.0, 0.0),
        ];
        let with = |first: (f64, f64)| points(&[&[first], &sides[..]].concat());
        let split = |first, breaks: &[usize]| lednicer(&with(first), breaks).map(|it| it.split);
        assert_eq!(split((3.0, 3.0), &[]), Some(3));
        assert_eq!(split((3.0, 3.0), &[1, 4]), Some(3));
        // Wrong counts are believed only where a blank line divides the sides.
        assert_eq!(split((4.0, 4.0), &[1, 4]), Some(3));
        assert_eq!(split((4.0, 4.0), &[]), None);
        assert_eq!(split((4.0, 2.0), &[]), None);
        assert_eq!(split((1.0, 0.1), &[]), None);
        let order = around(&sides, 3, |a, b| a == b);
        assert_eq!(
            order,
            [(1.0, 0.0), (0.5, 0.1), (0.0, 0.0), (0.5, -0.1), (1.0, 0.0)]
        );
    }

    #[test]
    fn sides_without_counts_are_told_where_nothing_else_is_likely() {
        let upper = [(0.0, 0.0), (0.1, 0.06), (0.5, 0.1), (1.0, 0.01)];
        let lower = [(0.0, 0.0), (0.1, -0.05), (0.5, -0.02), (1.0, -0.01)];
        let told = |sides: [&[(f64, f64)]; 2], breaks: &[usize], scale: f64| {
            let points = points(&sides.concat()).into_iter();
            let points: Vec<DVec3> = points.map(|point| point * scale).collect();
            let found = uncounted(&points, breaks)?;
            Some((found.split, found.is_upper_second, found.is_certain))
        };
        for scale in [1.0, 100.0] {
            assert_eq!(
                told([&upper, &lower], &[4, 8], scale),
                Some((4, false, true))
            );
            assert_eq!(
                told([&lower, &upper], &[4, 8], scale),
                Some((4, true, true))
            );
        }
        // Waterlines of a hull may have this shape, but stand in metres.
        assert_eq!(
            told([&upper, &lower], &[4, 8], 12.0),
            Some((4, false, false))
        );
        assert_eq!(told([&upper, &lower], &[8], 12.0), Some((4, false, true)));
        assert_eq!(told([&upper, &upper], &[4, 8], 1.0), None);
        assert_eq!(told([&upper, &lower[1..]], &[4, 7], 1.0), None);
        assert_eq!(told([&upper, &lower], &[2, 4, 8], 1.0), None);
        assert_eq!(told([&upper, &[]], &[4], 1.0), None);
        assert_eq!(told([&[], &[]], &[], 1.0), None);
    }

    #[test]
    fn an_arc_and_a_line_are_no_sections() {
        let section = [
            (1.0, 0.01),
            (0.5, 0.1),
            (0.1, 0.05),
            (0.0, 0.0),
            (0.1, -0.05),
            (0.5, -0.02),
            (1.0, -0.01),
        ];
        assert!(is_selig(&points(&section)));
        let mut reversed = section;
        reversed.reverse();
        assert!(!is_selig(&points(&reversed)));
        assert!(!is_selig(&points(&section[..4])));
        // Thick, open and with a corner: an outline of something else.
        let changed = |change: fn(&mut [(f64, f64); 7])| {
            let mut outline = section;
            change(&mut outline);
            is_selig(&points(&outline))
        };
        assert!(changed(|_| {}));
        assert!(!changed(|it| it
            .iter_mut()
            .for_each(|point| point.1 *= 5.0)));
        assert!(!changed(|it| it[0].1 = 0.3));
        assert!(!changed(|it| it[5].1 = 0.3));
        assert!(!is_selig(&points(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])));
        assert!(!is_selig(&[]));
    }
}
