//! The live figures of the pages, beside what the paper prints.

use std::collections::HashMap;

use super::{PaperPage, spiral_deviations};
use crate::editor::Editor;
use crate::geometry::paper::{
    CircleComparison, PAPER_RADIUS, RoundingTest, Shortening, evolute_reach, paper_sides,
};
use crate::geometry::significant;

/// The largest number of digits in the rounding test.
const MOST_DIGITS: usize = 15;

/// The degree of figure 1.
const ARC_DEGREE: usize = 9;

/// The printed figures of Table 1: degree, Bézier curve, B-spline.
const PRINTED: [(usize, &str, &str); 4] = [
    (3, "8.17283e-1", "8.33333e-1"),
    (5, "8.06272e-2", "1.11371e-3"),
    (7, "4.65855e-2", "7.85284e-6"),
    (ARC_DEGREE, "3.19524e-2", "5.92221e-8"),
];

/// The printed result of the rounding test, with coordinates cut off after three digits.
const PRINTED_ROUNDING: (usize, &str) = (3, "3.06354e-1");

/// Hold the settings of the pages and the figures computed so far.
pub struct Figures {
    /// The digits that the rounding test keeps.
    pub digits: usize,
    /// The way in which it shortens.
    pub shortening: Shortening,
    circles: HashMap<usize, Option<CircleComparison>>,
    tests: HashMap<(usize, Shortening), Option<RoundingTest>>,
    /// The largest distances from the spiral, by the number of vertices.
    spirals: HashMap<usize, Option<[f64; 2]>>,
}

impl Default for Figures {
    fn default() -> Self {
        Self {
            digits: MOST_DIGITS,
            shortening: Shortening::CutOff,
            circles: HashMap::new(),
            tests: HashMap::new(),
            spirals: HashMap::new(),
        }
    }
}

impl Figures {
    /// The degrees in the table of circles.
    pub const DEGREES: std::ops::RangeInclusive<usize> = 2..=15;

    /// The digits that the rounding test can keep.
    pub const DIGITS: std::ops::RangeInclusive<usize> = 0..=MOST_DIGITS;

    /// The numbers of vertices near the spiral, and the steps of s that they make.
    pub const SPIRALS: [(usize, &'static str); 2] = [(20, "Steps of 1"), (32, "Steps of ½")];

    /// Give the rounding test all its digits again.
    pub fn reset(&mut self) {
        self.digits = MOST_DIGITS;
    }

    /// List the figures of a page: name and value. The table of circles is [`Figures::circle`].
    pub fn rows(&mut self, page: PaperPage, editor: &Editor) -> Vec<(&'static str, String)> {
        match page {
            PaperPage::Arc => {
                let [_, _, printed] = self.printed_circle(ARC_DEGREE).unwrap_or_default();
                let [_, _, exact] = self.circle(ARC_DEGREE);
                let now = reach(editor).map_or("–".to_owned(), distance);
                vec![
                    ("Printed in the paper", printed),
                    ("Exact", exact),
                    ("The active curve now", now),
                ]
            }
            PaperPage::Rounding => self.rounding_rows(),
            PaperPage::Spiral { vertices } => {
                let far = self.spirals.entry(vertices);
                let far = far.or_insert_with(|| spiral_deviations(vertices).ok());
                let far = |place: usize| {
                    let value = far.and_then(|far| far.get(place).copied());
                    value.map_or("–".to_owned(), |value| significant(value, 6))
                };
                vec![
                    ("Vertices on the spiral", far(0)),
                    ("Quasi-interpolation", far(1)),
                ]
            }
            _ => Vec::new(),
        }
    }

    /// Run the rounding test with the present settings.
    pub fn rounding(&mut self) -> Option<&RoundingTest> {
        let (digits, shortening) = (self.digits, self.shortening);
        let test = self.tests.entry((digits, shortening));
        let test = test.or_insert_with(|| RoundingTest::new(digits, shortening).ok());
        test.as_ref()
    }

    fn rounding_rows(&mut self) -> Vec<(&'static str, String)> {
        let mut rows = Vec::new();
        if let Some(test) = self.rounding() {
            rows = vec![
                ("Vertex x", test.after.x.to_string()),
                ("Vertex y", test.after.y.to_string()),
                ("Float vertices move", significant(test.moved, 6)),
                ("Evolute from centre", scientific(Some(test.evolute_reach))),
            ];
        }
        let (digits, printed) = PRINTED_ROUNDING;
        let is_printed = self.digits == digits && self.shortening == Shortening::CutOff;
        let printed = if is_printed { printed } else { "–" };
        rows.push(("Printed in the paper", printed.to_owned()));
        rows
    }

    /// Return a row of the table of circles: degree, Bézier curve, B-spline.
    pub fn circle(&mut self, degree: usize) -> [String; 3] {
        let row = self.circles.entry(degree);
        let row = *row.or_insert_with(|| {
            CircleComparison::new(degree, paper_sides(degree), PAPER_RADIUS).ok()
        });
        [
            degree.to_string(),
            scientific(row.map(|row| row.bezier)),
            scientific(row.map(|row| row.bspline)),
        ]
    }

    /// Return what the paper prints for a row, if it has the degree.
    pub fn printed_circle(&self, degree: usize) -> Option<[String; 3]> {
        let mut printed = PRINTED.iter();
        let (_, bezier, bspline) = printed.find(|(of, ..)| *of == degree)?;
        Some(["printed", bezier, bspline].map(str::to_owned))
    }
}

/// Measure how far the active curve's evolute lies from the origin.
fn reach(editor: &Editor) -> Option<f64> {
    let curve = editor.document().curve(editor.active()?)?;
    Some(evolute_reach(&curve.polygon)).filter(|reach| reach.is_finite())
}

/// Write a number as the paper prints it.
pub fn scientific(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.5e}"))
}

/// Write a small distance as the paper prints it, a larger one plainly.
fn distance(value: f64) -> String {
    if value < 0.1 {
        scientific(Some(value))
    } else {
        significant(value, 6)
    }
}
