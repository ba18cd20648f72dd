//! Running operations on the built-in examples.

use std::sync::Arc;

use batten::document::{Curve, CurveId, Document, Edit, LockedVertices, Reference};
use batten::geometry::end_correction::EndTarget;
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{End, FloatPolygon, Progress};
use batten::io::examples::{EXAMPLES, Example};
use batten::operations::{
    self, Inputs, Operands, Operation, OperationError, Outcome, Report, Value,
};

/// Rounding of points on a curve, in units of its size.
pub const ROUNDING: f64 = 1e-13;

/// A document with one curve, which is chosen.
pub struct Runner {
    pub input: Operands,
}

impl Runner {
    pub fn example(name: &str) -> Self {
        let example = Example::find(name).expect("an example");
        let curves = example.read().expect("an example").curves;
        Self::curves(curves.into_iter().map(Arc::unwrap_or_clone).collect())
    }

    pub fn of(polygon: FloatPolygon) -> Self {
        Self::curves(vec![Curve::new("curve", polygon)])
    }

    /// Choose the first of some curves.
    pub fn curves(curves: Vec<Curve>) -> Self {
        let document = Document::from_curves(curves);
        let first = document.ids().next().expect("a curve");
        let input = Operands::new(&document, [first]).expect("it is there");
        Self { input }
    }

    pub fn id(&self) -> CurveId {
        self.input.curve().expect("a curve").0
    }

    pub fn curve(&self) -> &Curve {
        self.input.curve().expect("a curve").1
    }

    pub fn polygon(&self) -> &FloatPolygon {
        &self.curve().polygon
    }

    /// Make an edit beforehand.
    pub fn edited(self, edit: Edit) -> Self {
        let mut document = self.input.document().clone();
        document.apply(edit).expect("an edit that can be made");
        let input = Operands::new(&document, [self.id()]).expect("it is there");
        Self { input }
    }

    /// Give an end a target beforehand.
    pub fn with_target(self, end: End, target: EndTarget) -> Self {
        let curve = self.id();
        let target = Some(target);
        self.edited(Edit::SetTarget { curve, end, target })
    }

    /// What an operation works on here: the curve, none if it makes its own, or its vertices as points.
    pub fn input_of(&self, operation: &Operation) -> Operands {
        match operation.inputs {
            Inputs::None => Operands::new(self.input.document(), []).expect("none is there"),
            Inputs::Two => self.with_copy(),
            Inputs::Points => {
                let none = Operands::new(self.input.document(), []).expect("none is there");
                none.with_points(self.polygon().vertices().to_vec())
            }
            Inputs::References => {
                let curve = ReferenceCurve::from_text("clothoid:a=3").expect("a reference");
                let document = self.input.document().clone();
                let document = document.with_references([Reference::new("clothoid", curve)]);
                let id = document.references().next().map(|(id, _)| id);
                let input = Operands::choose(&document, operation.inputs, id, &[]);
                input.expect("a reference")
            }
            _ => self.input.clone(),
        }
    }

    /// Choose the curve and a copy of it that begins beyond its end.
    fn with_copy(&self) -> Operands {
        let mut copy = self.curve().clone();
        copy.locked_vertices = LockedVertices::default();
        let polygon = &copy.polygon;
        let by = 1.5 * (polygon.vertex(polygon.vertices().len() - 1) - polygon.vertex(0));
        let moved = polygon.vertices().iter().map(|vertex| *vertex + by);
        let weights = polygon.weights().map(<[f64]>::to_vec);
        let moved = FloatPolygon::new(
            polygon.degree(),
            moved.collect(),
            weights,
            polygon.is_periodic(),
        );
        copy.polygon = moved.expect("a polygon");
        let mut document = self.input.document().clone();
        let id = document.next_id();
        let added = document.apply(Edit::Add(Box::new(copy)));
        added.expect("a curve that can be added");
        Operands::new(&document, [self.id(), id]).expect("both are there")
    }

    pub fn run(&self, name: &str, given: &[(&str, Value)]) -> Result<Outcome, OperationError> {
        let operation = operation(name);
        let input = self.input_of(operation);
        let values = operation.values(&input, given.iter().cloned())?;
        operation.run(&input, &values, &Progress::default())
    }

    /// Run an operation that reaches what is asked of it.
    #[track_caller]
    pub fn done(&self, name: &str, given: &[(&str, Value)]) -> (Outcome, Vec<Curve>) {
        let outcome = self.run(name, given).expect("it can run");
        assert!(outcome.reached, "{outcome:?}");
        let after = outcome.applied_to(self.input.document());
        let after = after.expect("edits that can be made");
        let curves = after.curves().map(|(_, curve)| Curve::clone(curve));
        (outcome, curves.collect())
    }

    /// Run an operation that cannot run, and return why.
    #[track_caller]
    pub fn refused(&self, name: &str, given: &[(&str, Value)]) -> String {
        let refused = self.run(name, given);
        refused.expect_err("it cannot run").to_string()
    }

    pub fn report(&self, name: &str, given: &[(&str, Value)]) -> Report {
        let outcome = self.run(name, given).expect("it can run");
        let progress = Progress::default();
        let input = self.input_of(operation(name));
        let report = Report::of(operation(name), &input, &outcome, &progress);
        report.expect("nobody cancels")
    }
}

pub fn operation(name: &str) -> &'static Operation {
    operations::find(name).expect("an operation")
}

/// Every example, with targets beside both ends where it has ends.
pub fn examples() -> Vec<(&'static str, Runner)> {
    let runner = |example: Example| {
        let mut runner = Runner::example(example.name);
        if !runner.polygon().is_periodic() {
            for end in End::BOTH {
                let target = beside(runner.polygon(), end, 0.01, 0.1);
                runner = runner.with_target(end, target);
            }
        }
        (example.name, runner)
    };
    EXAMPLES.into_iter().map(runner).collect()
}

/// A target beside an end: off by a share of the curve's size, and turned by an angle.
pub fn beside(polygon: &FloatPolygon, end: End, share: f64, angle: f64) -> EndTarget {
    let jet = polygon.end_jet(end);
    let along = jet.first.truncate();
    let away = along.perp().normalize() * share * polygon.size();
    EndTarget {
        point: jet.point + away.extend(0.0),
        direction: Some(glam::DVec2::from_angle(angle).rotate(along).extend(0.0)),
        ..EndTarget::default()
    }
}

/// The largest distance of two curves at some parameters of the first, which `other` takes to
/// those of the second.
pub fn apart(a: &FloatPolygon, b: &FloatPolygon, other: impl Fn(f64) -> f64) -> f64 {
    let steps = 40 * a.segments();
    let parameters = (0..=steps).map(|step| step as f64 / 40.0);
    let distances = parameters.map(|u| a.point(u).distance(b.point(other(u))));
    distances.fold(0.0, f64::max)
}
