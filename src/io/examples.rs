//! The examples that come with the program.

use super::error::ReadError;
use super::project::PROJECT;
use super::reading::Reading;

/// An example: a project that is part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// The description, in one sentence.
    pub description: &'static str,
    text: &'static str,
}

/// The name of the example that an editor without a file opens.
pub const FIRST: &str = "s-curve";

/// Every example, in the order in which they are offered.
pub const EXAMPLES: [Example; 8] = [
    Example {
        name: "arc",
        title: "Ninth-degree arc",
        description: "One segment of degree 9 on ten corners of a regular dodecagon: as near to a circle as 6e-8 of its evolute.",
        text: include_str!("../../assets/examples/arc.batten"),
    },
    Example {
        name: "figure2",
        title: "Mineur–Farin polygon",
        description: "Five vertices whose legs double at every right-angled turn: a float polygon of degree 4 whose curvature falls all along.",
        text: include_str!("../../assets/examples/figure2.batten"),
    },
    Example {
        name: "hexagon",
        title: "Cubic on a hexagon",
        description: "One cubic segment on four corners of a regular hexagon, whose evolute shows how far it is from a circle.",
        text: include_str!("../../assets/examples/hexagon.batten"),
    },
    Example {
        name: "s-curve",
        title: "S-curve",
        description: "A symmetric S of degree 5 with one inflection in the middle and a curvature extremum near either end.",
        text: include_str!("../../assets/examples/s-curve.batten"),
    },
    Example {
        name: "periodic",
        title: "Egg",
        description: "A periodic curve of degree 5 on twelve vertices, with four curvature extrema, the fewest that an oval can have.",
        text: include_str!("../../assets/examples/periodic.batten"),
    },
    Example {
        name: "bottle",
        title: "Bottle",
        description: "Half the profile of a bottle 235 mm high: base, corner, barrelled body, shoulder and neck in one curve of degree 5 with one inflection.",
        text: include_str!("../../assets/examples/bottle.batten"),
    },
    Example {
        name: "hull",
        title: "Waterline",
        description: "Half the waterline of a hull 8.4 m long: fine entry, full midbody and a transom, with one curvature extremum.",
        text: include_str!("../../assets/examples/hull.batten"),
    },
    Example {
        name: "composite",
        title: "Composite log-aesthetic curve",
        description: "A clothoid and a logarithmic spiral, with their vertices on them, joined by a bridge of five vertices: one curve of degree 5, smooth up to the fourth derivative, whose curvature rises all along.",
        text: include_str!("../../assets/examples/composite.batten"),
    },
];

impl Example {
    /// Find an example by its name.
    pub fn find(name: &str) -> Option<Self> {
        EXAMPLES.into_iter().find(|example| example.name == name)
    }

    /// Read the example.
    ///
    /// # Errors
    /// None for the examples there are: a test reads them all.
    pub fn read(&self) -> Result<Reading, ReadError> {
        PROJECT.read(self.text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;
    use crate::geometry::paper::regular_polygon;

    fn polygon(name: &str) -> FloatPolygon {
        let mut curves = Example::find(name).unwrap().read().unwrap().curves;
        assert_eq!(curves.len(), 1, "{name}");
        assert_eq!(curves[0].name, name);
        curves.remove(0).polygon.clone()
    }

    /// Count the sign changes of the signed curvature and of its derivative by u, sampled 400
    /// times a segment; round the whole curve if it is periodic.
    fn inflections_and_extrema(polygon: &FloatPolygon) -> (usize, usize) {
        let samples = 400 * polygon.segments();
        let jets = (0..=samples).map(|sample| polygon.jet(sample as f64 / 400.0));
        let signs = |value: f64, last: &mut f64| {
            let changes = value * *last < 0.0;
            if value != 0.0 {
                *last = value;
            }
            usize::from(changes)
        };
        let (mut inflections, mut extrema) = (0, 0);
        let (mut last_curvature, mut last_slope) = (0.0, 0.0);
        for jet in jets {
            let (first, second) = (jet.first.truncate(), jet.second.truncate());
            let third = jet.third.truncate();
            let slope = first.length_squared() * first.perp_dot(third)
                - 3.0 * first.dot(second) * first.perp_dot(second);
            inflections += signs(first.perp_dot(second), &mut last_curvature);
            extrema += signs(slope, &mut last_slope);
        }
        (inflections, extrema)
    }

    #[test]
    fn the_examples_are_fair() {
        let check = |name: &str, expected: (usize, usize)| {
            assert_eq!(inflections_and_extrema(&polygon(name)), expected, "{name}");
        };
        check("arc", (0, 1));
        check("figure2", (0, 0));
        check("hexagon", (0, 1));
        check("s-curve", (1, 2));
        check("periodic", (0, 4));
        check("bottle", (1, 4));
        check("hull", (0, 1));
        check("composite", (0, 0));
    }

    #[test]
    fn the_names_are_the_known_ones() {
        let names = EXAMPLES.map(|example| example.name);
        assert_eq!(
            names,
            [
                "arc",
                "figure2",
                "hexagon",
                "s-curve",
                "periodic",
                "bottle",
                "hull",
                "composite"
            ]
        );
        assert_eq!(Example::find("Arc"), None);
    }

    #[test]
    fn the_arc_and_the_hexagon_lie_on_regular_polygons() {
        for (name, degree, sides) in [("arc", 9, 12), ("hexagon", 3, 6)] {
            let expected = regular_polygon(degree, sides, 10.0).unwrap();
            let found = polygon(name);
            assert_eq!(found.degree(), degree);
            for (found, expected) in found.vertices().iter().zip(expected.vertices()) {
                assert!(
                    found.distance(*expected) < 1e-14,
                    "{name}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn the_bottle_and_the_hull_have_their_proportions() {
        let near = |found: f64, expected: f64| {
            let allowed = 0.05 + 1e-3 * expected;
            assert!(
                (found - expected).abs() < allowed,
                "{found} is not {expected}"
            );
        };
        let bottle = polygon("bottle");
        let (base, lip) = (bottle.point(0.0), bottle.point(bottle.segments() as f64));
        let body = (0..=290).map(|i| bottle.point(0.1 * f64::from(i)).x);
        near(base.x, 0.0);
        near(base.y, 0.0);
        near(lip.x, 13.5);
        near(lip.y, 235.0);
        near(body.fold(0.0, f64::max), 37.5);
        let hull = polygon("hull");
        let (bow, transom) = (hull.point(0.0), hull.point(hull.segments() as f64));
        near(bow.y, 0.0);
        near(transom.x, 8400.0);
        near(transom.y, 570.0);
    }

    #[test]
    fn the_examples_are_written_as_projects_are() {
        for example in EXAMPLES {
            let document = example.read().unwrap().into_document().unwrap();
            let written = PROJECT.write(&document, None).unwrap().bytes;
            assert_eq!(
                String::from_utf8(written).unwrap(),
                example.text,
                "{}",
                example.name
            );
        }
    }
}
