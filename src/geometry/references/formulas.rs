//! Kinds of curves by plain formulas, a row each.

use std::f64::consts::TAU;

use super::kind::{Coordinates, EVERYWHERE, ReferenceKind};
use crate::geometry::coefficient::Coefficient;
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The size a of the spirals about a pole.
const POLE_DISTANCE: Parameter<Number> = Parameter::new(
    "a",
    "Size a",
    "The distance from the pole at t = 0",
    Number::size(1.0),
);

/// The growth b of the spirals of constant slope to their radius.
const LOGARITHMIC_GROWTH: Parameter<Number> = Parameter::new(
    "b",
    "Growth b",
    "How fast the logarithm of the radius grows by the angle",
    Number::any(0.2),
);

/// The catenary is 1e86 times as high as its size at this distance.
const MOST_CATENARY: f64 = 200.0;

/// The circle.
pub static CIRCLE: ReferenceKind = ReferenceKind {
    name: "circle",
    label: "Circle",
    help: "(r cos t, r sin t): curvature 1/r",
    parameters: &[Parameter::new(
        "radius",
        "Radius",
        "The radius r",
        Number::size(1.0),
    )],
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(circle, Some(circle)),
};

/// The ellipse.
pub static ELLIPSE: ReferenceKind = ReferenceKind {
    name: "ellipse",
    label: "Ellipse",
    help: "(a cos t, b sin t)",
    parameters: &[
        Parameter::new(
            "a",
            "Half axis a",
            "Half the axis along x",
            Number::size(2.0),
        ),
        Parameter::new(
            "b",
            "Half axis b",
            "Half the axis along y",
            Number::size(1.0),
        ),
    ],
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(ellipse, Some(ellipse)),
};

/// The parabola.
pub static PARABOLA: ReferenceKind = ReferenceKind {
    name: "parabola",
    label: "Parabola",
    help: "(t, t²/(4f)), with its vertex at t = 0",
    parameters: &[Parameter::new(
        "focus",
        "Focal length",
        "The distance f of the focus from the vertex",
        Number::size(1.0),
    )],
    interval: |values| [-2.0 * values[0], 2.0 * values[0]],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(parabola, Some(parabola)),
};

/// The catenary.
pub static CATENARY: ReferenceKind = ReferenceKind {
    name: "catenary",
    label: "Catenary",
    help: "(t, a cosh(t/a)), with its vertex at t = 0",
    parameters: &[Parameter::new(
        "a",
        "Size a",
        "The radius of curvature at the vertex, and its height",
        Number::size(1.0),
    )],
    interval: |values| [-2.0 * values[0], 2.0 * values[0]],
    domain: |values| [-MOST_CATENARY * values[0], MOST_CATENARY * values[0]],
    coordinates: Coordinates::Planar(catenary, Some(catenary)),
};

/// The involute of a circle.
pub static CIRCLE_INVOLUTE: ReferenceKind = ReferenceKind {
    name: "circle-involute",
    label: "Circle involute",
    help: "r (cos t + t sin t, sin t − t cos t): curvature 1/(r t), with a cusp at t = 0",
    parameters: &[Parameter::new(
        "radius",
        "Radius",
        "The radius r of the circle",
        Number::size(1.0),
    )],
    interval: |_| [1.0, TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(circle_involute, Some(circle_involute)),
};

/// The logarithmic spiral.
pub static LOGARITHMIC_SPIRAL: ReferenceKind = ReferenceKind {
    name: "logarithmic-spiral",
    label: "Logarithmic spiral",
    help: "a e^(bt) (cos t, sin t): turned, it is itself in another size",
    parameters: &[POLE_DISTANCE, LOGARITHMIC_GROWTH],
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(logarithmic_spiral, Some(logarithmic_spiral)),
};

/// The Archimedean spiral.
pub static ARCHIMEDEAN_SPIRAL: ReferenceKind = ReferenceKind {
    name: "archimedean-spiral",
    label: "Archimedean spiral",
    help: "(a + bt) (cos t, sin t): its windings lie 2πb apart",
    parameters: &[
        Parameter::new("a", "Start a", "The radius at t = 0", Number::any(1.0)),
        Parameter::new(
            "b",
            "Growth b",
            "How fast the radius grows by the angle",
            Number::any(0.2),
        ),
    ],
    interval: |_| [0.0, 2.0 * TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Planar(archimedean_spiral, Some(archimedean_spiral)),
};

/// The helix on a cylinder.
pub static HELIX: ReferenceKind = ReferenceKind {
    name: "helix",
    label: "Helix",
    help: "(r cos t, r sin t, p t/2π): curvature and torsion are constant",
    parameters: &[
        Parameter::new(
            "radius",
            "Radius",
            "The radius r of the cylinder",
            Number::size(1.0),
        ),
        Parameter::new(
            "pitch",
            "Pitch",
            "How far p it rises in a turn",
            Number::any(1.0),
        ),
    ],
    interval: |_| [0.0, 2.0 * TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Spatial(helix, Some(helix)),
};

/// The cubic helix.
pub static CUBIC_HELIX: ReferenceKind = ReferenceKind {
    name: "cubic-helix",
    label: "Cubic helix",
    help: "a (t, t², 2t³/3): of constant slope, curvature and torsion are both 2/(a (1 + 2t²)²)",
    parameters: &[Parameter::new(
        "a",
        "Size a",
        "The length a",
        Number::size(1.0),
    )],
    interval: |_| [-1.0, 1.0],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Spatial(cubic_helix, Some(cubic_helix)),
};

/// The helix on a cone.
pub static CONICAL_HELIX: ReferenceKind = ReferenceKind {
    name: "conical-helix",
    label: "Conical helix",
    help: "a e^(bt) (cos t, sin t, c): both radii, of curvature and torsion, grow with the arc length",
    parameters: &[
        POLE_DISTANCE,
        LOGARITHMIC_GROWTH,
        Parameter::new(
            "rise",
            "Rise c",
            "The height of the cone by its radius",
            Number::any(1.0),
        ),
    ],
    interval: |_| [0.0, 2.0 * TAU],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Spatial(conical_helix, Some(conical_helix)),
};

/// The conical spiral (paper, section 5).
pub static CONICAL_SPIRAL: ReferenceKind = ReferenceKind {
    name: "conical-spiral",
    label: "Conical spiral",
    help: "(t cos t, t sin t, b t): an Archimedean spiral that rises with its radius",
    parameters: &[Parameter::new(
        "rise",
        "Rise",
        "How far b it rises where its radius grows by 1",
        Number::any(1.0),
    )],
    interval: |_| [0.0, 15.5],
    domain: |_| EVERYWHERE,
    coordinates: Coordinates::Spatial(conical_spiral, Some(conical_spiral)),
};

fn circle<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (sine, cosine) = t.sin_cos();
    [cosine.times(T::of(values[0])), sine.times(T::of(values[0]))]
}

fn ellipse<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (sine, cosine) = t.sin_cos();
    [cosine.times(T::of(values[0])), sine.times(T::of(values[1]))]
}

fn parabola<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    [t.clone(), t.squared().times(T::of(0.25) / T::of(values[0]))]
}

fn catenary<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (_, cosine) = t.clone().times(T::of(1.0) / T::of(values[0])).sinh_cosh();
    [t.clone(), cosine.times(T::of(values[0]))]
}

fn circle_involute<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (sine, cosine) = t.sin_cos();
    let [x, y] = [&cosine + &(t * &sine), &sine - &(t * &cosine)];
    [x.times(T::of(values[0])), y.times(T::of(values[0]))]
}

fn logarithmic_spiral<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    polar(
        &t.clone()
            .times(T::of(values[1]))
            .exp()
            .times(T::of(values[0])),
        t,
    )
}

fn archimedean_spiral<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    polar(&t.clone().times(T::of(values[1])).plus(T::of(values[0])), t)
}

fn helix<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
    let (sine, cosine) = t.sin_cos();
    let [x, y] = [cosine.times(T::of(values[0])), sine.times(T::of(values[0]))];
    [x, y, t.clone().times(T::of(values[1]) / T::of(TAU))]
}

fn cubic_helix<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
    let square = t.squared();
    let cube = (&square * t).times(T::of(values[0]) * T::of(2.0) / T::of(3.0));
    [
        t.clone().times(T::of(values[0])),
        square.times(T::of(values[0])),
        cube,
    ]
}

fn conical_helix<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
    let radius = t
        .clone()
        .times(T::of(values[1]))
        .exp()
        .times(T::of(values[0]));
    let [x, y] = polar(&radius, t);
    [x, y, radius.times(T::of(values[2]))]
}

fn conical_spiral<T: Coefficient>(values: &[f64], t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
    let [x, y] = polar(t, t);
    [x, y, t.clone().times(T::of(values[0]))]
}

/// The point at a radius and an angle.
fn polar<T: Coefficient>(radius: &PowerSeries<T>, angle: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (sine, cosine) = angle.sin_cos();
    [radius * &cosine, radius * &sine]
}
