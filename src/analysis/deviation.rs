//! The deviation between two curves or references, from both sides.

use glam::DVec3;

use crate::analysis::item::Item;
use crate::geometry::distance::{CurveSide, DistanceError, SideDeviation, Whisker};
use crate::geometry::{ParametricCurve, Progress};

/// The columns of the table.
const TABLE: [&str; 10] = [
    "side",
    "at",
    "nearest at",
    "distance",
    "x",
    "y",
    "z",
    "nearest x",
    "nearest y",
    "nearest z",
];

/// The deviation between two curves or references: true distances, from each of them to the nearest points of the
/// other. Points count from their side alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// How far the first is from the second, and the second from the first, where that side counts.
    pub sides: [Option<SideDeviation>; 2],
}

impl Deviation {
    /// Measure the deviation between two curves or references; `None` between two lists of points.
    ///
    /// # Errors
    /// As [`SideDeviation::of_curve`].
    pub fn measure(items: [&Item; 2], progress: &Progress) -> Result<Option<Self>, DistanceError> {
        let [first, second] = items.map(Shape::of);
        let sides = match (&first, &second) {
            (Shape::Curve(first), Shape::Curve(second)) => {
                let there = SideDeviation::of_curve(*first, *second, progress)?;
                let back = SideDeviation::of_curve(*second, *first, progress)?;
                [Some(there), Some(back)]
            }
            (Shape::Curve(curve), Shape::Points(points)) => {
                [None, SideDeviation::of_points(points, *curve, progress)?]
            }
            (Shape::Points(points), Shape::Curve(curve)) => {
                [SideDeviation::of_points(points, *curve, progress)?, None]
            }
            (Shape::Points(_), Shape::Points(_)) => return Ok(None),
        };
        Ok(Some(Self { sides }))
    }

    /// The largest distance of both sides, and the number of its side.
    pub fn largest(&self) -> Option<(usize, &Whisker)> {
        let sides = self.sides.iter().enumerate();
        let known = sides.filter_map(|(side, it)| Some((side, &it.as_ref()?.largest)));
        known.reduce(|best, it| match it.1.distance() > best.1.distance() {
            true => it,
            false => best,
        })
    }

    /// The whiskers of both sides.
    pub fn whiskers(&self) -> impl Iterator<Item = &Whisker> {
        let sides = self.sides.iter().flatten();
        sides.flat_map(|side| &side.whiskers)
    }

    /// The mean distance, over the arc length of both sides or over the points.
    pub fn mean(&self) -> f64 {
        self.average(|side| side.mean)
    }

    /// The root of the mean square of the distance, over the same.
    pub fn rms(&self) -> f64 {
        self.average(|side| side.rms * side.rms).sqrt()
    }

    /// The mean distance of the places on each side of the other curve, and their share of all: from the first curve or
    /// the points, of which every whisker stands for as much. Empty in space.
    pub fn by_side(&self) -> Vec<(CurveSide, f64, f64)> {
        let sides = self.sides.iter().flatten();
        let mut sides = sides.filter(|side| side.whiskers.iter().any(|it| it.side.is_some()));
        let whiskers = sides.next().map_or(&[][..], |side| &side.whiskers);
        let means = CurveSide::ALL.into_iter().filter_map(|side| {
            let own = whiskers.iter().filter(|it| it.side == Some(side));
            let (sum, count) = own.fold((0.0, 0.0), |(sum, count), it| {
                (sum + it.distance(), count + 1.0)
            });
            (count > 0.0).then(|| (side, sum / count, count / whiskers.len() as f64))
        });
        means.collect()
    }

    /// How many whiskers lie past an end of the other curve, and the longest of the others; `None` if none does. So a
    /// scan that reaches farther than a curve tells how far it is from what there is.
    pub fn past_ends(&self) -> Option<(usize, f64)> {
        let past = self.whiskers().filter(|it| it.past_end).count();
        let others = self.whiskers().filter(|it| !it.past_end);
        let longest = others.map(Whisker::distance).fold(0.0, f64::max);
        (past > 0).then_some((past, longest))
    }

    /// The deviation without the points past an end of the curve; `None` between two curves, or if all of the points lie
    /// there or none.
    pub fn within_ends(&self) -> Option<Self> {
        let within = |points: &SideDeviation| {
            let own = points.whiskers.iter().filter(|it| !it.past_end).copied();
            let own: Vec<Whisker> = own.collect();
            let is_less = own.len() < points.whiskers.len();
            SideDeviation::of_whiskers(own).filter(|_| is_less)
        };
        let sides = match &self.sides {
            [Some(points), None] => [Some(within(points)?), None],
            [None, Some(points)] => [None, Some(within(points)?)],
            _ => return None,
        };
        Some(Self { sides })
    }

    /// Write the whiskers as a table with tabs, a line each, those of the first side first: the side (1 or 2), the place
    /// there (u, or the number of a point) and on the other side, the distance, and both points.
    pub fn table(&self) -> String {
        let mut text = TABLE.join("\t");
        for (number, side) in self.sides.iter().enumerate() {
            for whisker in side.iter().flat_map(|side| &side.whiskers) {
                let [one, other] = whisker.places.map(|place| place.to_array());
                let numbers = [whisker.at, whisker.nearest_at, whisker.distance()];
                let numbers = numbers.into_iter().chain(one).chain(other);
                let cells = numbers.map(|number| format!("\t{number:?}"));
                text += &format!("\n{}{}", number + 1, cells.collect::<String>());
            }
        }
        text + "\n"
    }

    fn average(&self, value: impl Fn(&SideDeviation) -> f64) -> f64 {
        let sides = self.sides.iter().flatten();
        let (sum, extent) = sides.fold((0.0, 0.0), |(sum, extent), side| {
            (sum + value(side) * side.extent, extent + side.extent)
        });
        if extent > 0.0 { sum / extent } else { 0.0 }
    }
}

/// What distances are measured of.
enum Shape<'a> {
    Curve(&'a dyn ParametricCurve),
    Points(Vec<DVec3>),
}

impl<'a> Shape<'a> {
    fn of(item: &'a Item) -> Self {
        match item {
            Item::Curve(curve) => Self::Curve(&curve.polygon),
            Item::Reference(reference) => match reference.points() {
                Some(points) => Self::Points(points),
                None => Self::Curve(&reference.curve),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::document::{Curve, Reference};
    use crate::geometry::FloatPolygon;
    use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};

    fn line(y: f64) -> Item {
        let points = [(0.0, y), (1.0, y), (2.0, y)];
        let polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        Item::Curve(Arc::new(Curve::new("line".to_owned(), polygon)))
    }

    #[test]
    fn the_table_has_each_whisker_to_the_bit() {
        let slope = [(0.0, 0.1), (1.0, 0.7), (2.0, 1.3)];
        let slope = FloatPolygon::planar(2, &slope).expect("a polygon");
        let slope = Item::Curve(Arc::new(Curve::new("slope".to_owned(), slope)));
        let measured = Deviation::measure([&line(0.0), &slope], &Progress::default());
        let measured = measured.expect("curves have points").expect("two curves");
        let table = measured.table();
        let mut lines = table.lines();
        assert_eq!(lines.next(), Some(TABLE.join("\t").as_str()));
        let mut sides = [0, 0];
        for (line, whisker) in lines.by_ref().zip(measured.whiskers()) {
            let numbers: Result<Vec<f64>, _> = line.split('\t').map(str::parse).collect();
            let numbers = numbers.expect("numbers");
            assert_eq!(numbers.len(), TABLE.len());
            assert_eq!(numbers[3], whisker.distance());
            assert_eq!(numbers[4..7], whisker.places[0].to_array());
            sides[numbers[0] as usize - 1] += 1;
        }
        assert_eq!(lines.next(), None);
        let expected = measured
            .sides
            .each_ref()
            .map(|side| side.as_ref().map_or(0, |side| side.whiskers.len()));
        assert_eq!(sides, expected);
    }

    #[test]
    fn whiskers_past_the_ends_are_told_apart() {
        let long = [(-1.0, 0.5), (4.0, 0.5)];
        let long = FloatPolygon::planar(1, &long).expect("a polygon");
        let long = Item::Curve(Arc::new(Curve::new("long".to_owned(), long)));
        let measured = Deviation::measure([&long, &line(0.0)], &Progress::default());
        let measured = measured.expect("curves have points").expect("two curves");
        // The short one goes from 0.5 to 1.5: four of five parts lie past its ends.
        let (past, longest) = measured.past_ends().expect("some are past the ends");
        let of_long = measured.sides[0].as_ref().map_or(0, |it| it.whiskers.len());
        let share = past as f64 / of_long as f64;
        assert!((share - 0.8).abs() <= 2.0 / of_long as f64, "{share}");
        assert!((longest - 0.5).abs() <= 1e-12, "{longest}");
        let measured = Deviation::measure([&line(1.0), &line(0.0)], &Progress::default());
        let measured = measured.expect("curves have points").expect("two curves");
        assert_eq!(measured.past_ends(), None);
    }

    #[test]
    fn points_past_the_ends_can_be_left_out() {
        let points = [(0.2, 9.0), (0.6, 1.0), (1.0, 3.0), (1.4, 2.0), (7.0, 1.0)];
        let points = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let points = PointList::new(points).expect("points");
        let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
        let points = Item::Reference(Arc::new(Reference::new("points", points)));
        for items in [[&points, &line(0.0)], [&line(0.0), &points]] {
            let measured = Deviation::measure(items, &Progress::default());
            let measured = measured.expect("they have points").expect("a curve");
            assert_eq!(measured.past_ends(), Some((2, 3.0)));
            let within = measured.within_ends().expect("some are within");
            let largest = within.largest().map(|(_, it)| it.distance());
            assert_eq!(largest, Some(3.0));
            assert_eq!(within.whiskers().count(), 3);
            assert!((within.mean() - 2.0).abs() <= 1e-15);
            let rms = (14.0_f64 / 3.0).sqrt();
            assert!((within.rms() - rms).abs() <= 1e-15 * rms);
            assert_eq!((within.past_ends(), within.within_ends()), (None, None));
        }
        let lines = Deviation::measure([&line(0.0), &line(1.0)], &Progress::default());
        let lines = lines.expect("curves have points").expect("two curves");
        assert_eq!(lines.within_ends(), None);
    }

    #[test]
    fn distances_on_both_sides_have_means_of_their_own() {
        // From 1 below to 3 above, in even steps: a quarter of it is to the right, with a mean of a half.
        let slope = [(0.0, -1.0), (1.0, 3.0)];
        let slope = FloatPolygon::planar(1, &slope).expect("a polygon");
        let slope = Item::Curve(Arc::new(Curve::new("slope".to_owned(), slope)));
        let long = [(-9.0, 0.0), (1.0, 0.0), (11.0, 0.0)];
        let long = FloatPolygon::planar(2, &long).expect("a polygon");
        let long = Item::Curve(Arc::new(Curve::new("long".to_owned(), long)));
        let measured = Deviation::measure([&slope, &long], &Progress::default());
        let measured = measured.expect("curves have points").expect("two curves");
        let by_side = measured.by_side();
        let sides: Vec<CurveSide> = by_side.iter().map(|it| it.0).collect();
        assert_eq!(sides, [CurveSide::Left, CurveSide::Right]);
        // As fine as the steps.
        let step = 2.0 / measured.whiskers().count() as f64;
        for ((_, mean, share), [its_mean, its_share]) in
            by_side.into_iter().zip([[1.5, 0.75], [0.5, 0.25]])
        {
            assert!((mean - its_mean).abs() <= 4.0 * step, "{mean}");
            assert!((share - its_share).abs() <= step, "{share}");
        }
    }

    #[test]
    fn a_cancelled_measurement_has_no_deviation() {
        let (first, second) = (line(0.0), line(1.0));
        let progress = Progress::default();
        let measured = Deviation::measure([&first, &second], &progress);
        let measured = measured.expect("curves have points").expect("two curves");
        assert_eq!(measured.largest().map(|(_, it)| it.distance()), Some(1.0));
        progress.cancel();
        let cancelled = Deviation::measure([&first, &second], &progress);
        assert_eq!(cancelled, Err(DistanceError::Cancelled));
    }
}
