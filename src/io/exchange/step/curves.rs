//! Curves of every kind, bounded.

use std::cell::RefCell;
use std::f64::consts::TAU;

use glam::DVec3;

use super::cuts::chain_reversed;
use super::flaw::Flaw;
use super::form::Form;
use super::instances::{Instance, Instances};
use super::placements::{direction, half_axes, operator, point};
use super::splines::{is_spline, spline};
use super::tokens::Value;
use super::trims::{Cutting, Trim, between, trimmed};
use crate::io::exchange::drawing::{Conic, Kind, Shape};
use crate::io::exchange::remarks::Remarks;

/// How deep curves may refer to curves.
const DEEPEST: usize = 64;

/// A reader of curves in one context.
pub struct Curves<'a, 'r> {
    /// The file.
    pub file: &'r Instances<'a>,
    /// Where to say what was repaired.
    pub remarks: &'r RefCell<Remarks>,
    /// The radians of the context's plane angle.
    pub angle: f64,
    /// The curves that are being read, each within the one before.
    pub open: RefCell<Vec<u64>>,
}

/// A curve with ends, or a closed one.
pub struct Bounded<'a> {
    /// The file's entity.
    pub kind: Kind,
    /// Its name, raw.
    pub name: Option<&'a [u8]>,
    /// Its pieces.
    pub shapes: Vec<Shape>,
}

/// A curve that was read.
struct Curve<'a> {
    /// The file's entity; of trimmed curves that of their basis.
    kind: Kind,
    name: Option<&'a [u8]>,
    form: Form,
}

type Read<'a> = Result<Curve<'a>, Flaw>;

impl<'a> Curves<'a, '_> {
    fn cutting(&self) -> Cutting<'_, 'a> {
        Cutting {
            file: self.file,
            angle: self.angle,
        }
    }

    /// Read a curve that has ends, or is closed.
    pub fn bounded(&self, instance: &Instance<'a>) -> Result<Bounded<'a>, Flaw> {
        let curve = self.curve(instance, 0)?;
        match curve.form {
            Form::Shapes(shapes) => Ok(Bounded {
                kind: curve.kind,
                name: curve.name,
                shapes,
            }),
            Form::Line { .. } => Err(Flaw::damaged(instance, "it has no ends")),
        }
    }

    /// Read an EDGE_CURVE.
    pub fn edge(&self, edge: &Instance<'a>) -> Result<Bounded<'a>, Flaw> {
        let params = edge.part("EDGE_CURVE").unwrap_or_default();
        let mut values: Vec<Value> = params.take(6).collect();
        if edge.params().next().is_some() {
            values.drain(..1.min(values.len()));
        } else if let Some(ends) = edge.part("EDGE") {
            values.splice(0..0, ends.take(2));
        }
        let reference = |place: usize| values.get(place).and_then(Value::reference);
        let vertex = |place: usize| reference(place).and_then(|id| self.vertex(id));
        let damaged = |reason: &str| Flaw::damaged(edge, reason);
        let start = vertex(0).ok_or_else(|| damaged("its first vertex is missing or damaged"))?;
        let end = vertex(1).ok_or_else(|| damaged("its last vertex is missing or damaged"))?;
        let forward = !values.get(3).is_some_and(|sense| sense.is("F"));
        let curve = self.basis(edge, values.get(2).unwrap_or(&Value::Missing), 0)?;
        let shapes = match between(&self.cutting(), curve.form, start, end, forward) {
            Ok(shapes) => shapes,
            Err((reason, whole)) if !whole.is_empty() => {
                self.remark(edge, &format!("{reason}; the whole curve is taken"));
                whole
            }
            Err((reason, _)) => return Err(damaged(&reason)),
        };
        self.pay(edge, &shapes)?;
        let kind = kind_of(curve.kind, &shapes);
        Ok(Bounded {
            kind,
            name: edge.label().or(curve.name),
            shapes,
        })
    }

    /// Read the point of a vertex.
    pub fn vertex(&self, id: u64) -> Option<DVec3> {
        let vertex = self.file.get(id)?;
        let params = vertex.part("VERTEX_POINT")?;
        point(self.file, params.last()?.reference()?)
    }

    /// Add a remark on an instance.
    pub fn remark(&self, instance: &Instance, reason: &str) {
        let entity = format!("#{} {}", instance.id, instance.name());
        self.remarks
            .borrow_mut()
            .add_at(instance.line, &entity, reason);
    }

    fn curve(&self, curve: &Instance<'a>, depth: usize) -> Read<'a> {
        if depth > DEEPEST {
            return Err(Flaw::damaged(
                curve,
                "curves refer to curves more than 64 deep",
            ));
        }
        if self.open.borrow().contains(&curve.id) {
            return Err(Flaw::damaged(curve, "it refers to itself"));
        }
        self.open.borrow_mut().push(curve.id);
        let read = self.by_kind(curve, depth);
        self.open.borrow_mut().pop();
        let mut read = read?;
        if let Form::Shapes(shapes) = &read.form {
            self.pay(curve, shapes)?;
        }
        read.name = curve.label().or(read.name);
        Ok(read)
    }

    fn by_kind(&self, curve: &Instance<'a>, depth: usize) -> Read<'a> {
        let damaged = |reason: String| Flaw::damaged(curve, &reason);
        if is_spline(curve) {
            let (kind, nurbs) = spline(self.file, curve).map_err(damaged)?;
            return Ok(whole(kind, vec![Shape::Nurbs(nurbs)]));
        }
        match curve.name() {
            "LINE" => self.line(curve),
            "CIRCLE" | "ELLIPSE" => self.conic(curve),
            "POLYLINE" => self.polyline(curve),
            "TRIMMED_CURVE" => self.trimmed_curve(curve, depth),
            "COMPOSITE_CURVE"
            | "COMPOSITE_CURVE_ON_SURFACE"
            | "BOUNDARY_CURVE"
            | "OUTER_BOUNDARY_CURVE" => self.composite(curve, depth),
            "SURFACE_CURVE" | "SEAM_CURVE" | "INTERSECTION_CURVE" | "BOUNDED_SURFACE_CURVE" => {
                let [_, basis] = curve.named_params::<2>("SURFACE_CURVE");
                self.basis(curve, &basis, depth)
            }
            "CURVE_REPLICA" => self.replica(curve, depth),
            _ => Err(Flaw::unknown(curve)),
        }
    }

    fn line(&self, curve: &Instance<'a>) -> Read<'a> {
        let read = || {
            let [_, origin, vector] = curve.params().first::<3>();
            let vector = self.file.get(vector.reference()?)?;
            let [_, along, length] = vector.part("VECTOR")?.first::<3>();
            let along = direction(self.file, along.reference()?)?.normalize();
            let step = along * length.number().filter(|it| *it > 0.0)?;
            Some((point(self.file, origin.reference()?)?, step))
        };
        let (point, step) =
            read().ok_or_else(|| Flaw::damaged(curve, "its point or vector is damaged"))?;
        Ok(Curve {
            kind: Kind::Line,
            name: None,
            form: Form::Line { point, step },
        })
    }

    fn conic(&self, curve: &Instance<'a>) -> Read<'a> {
        let is_circle = curve.name() == "CIRCLE";
        let read = || {
            let [_, place, first, second] = curve.params().first::<4>();
            let first = first.number().filter(|it| *it > 0.0)?;
            let second = if is_circle {
                Some(first)
            } else {
                second.number().filter(|it| *it > 0.0)
            };
            half_axes(self.file, place.reference()?, first, second?)
        };
        let (centre, x, y) =
            read().ok_or_else(|| Flaw::damaged(curve, "its placement or size is damaged"))?;
        let conic = Conic {
            centre,
            x,
            y,
            from: 0.0,
            to: TAU,
        };
        let kind = if is_circle {
            Kind::Circle
        } else {
            Kind::Ellipse
        };
        Ok(whole(kind, vec![Shape::Conic(conic)]))
    }

    fn polyline(&self, curve: &Instance<'a>) -> Read<'a> {
        let [_, list] = curve.params().first::<2>();
        let mut points = Vec::new();
        for id in list.list().unwrap_or_default().refs() {
            let point = point(self.file, id);
            points.push(point.ok_or_else(|| {
                Flaw::damaged(curve, &format!("its point #{id} is missing or damaged"))
            })?);
        }
        if points.len() < 2 {
            return Err(Flaw::damaged(curve, "it has less than two points"));
        }
        let closed = points.len() > 2 && points.first() == points.last();
        if closed {
            points.pop();
        }
        Ok(whole(
            Kind::Polyline,
            vec![Shape::Polyline { points, closed }],
        ))
    }

    fn trimmed_curve(&self, curve: &Instance<'a>, depth: usize) -> Read<'a> {
        let values = curve.named_params::<6>("TRIMMED_CURVE");
        let [_, basis, first, last, sense, master] = values;
        let basis = self.basis(curve, &basis, depth)?;
        let trim = |value: &Value<'a>| {
            let trim = Trim::read(self.file, value.list().unwrap_or_default());
            trim.ok_or_else(|| Flaw::damaged(curve, "it has no point or parameter of an end"))
        };
        let (first, last) = (trim(&first)?, trim(&last)?);
        let by_points = master.is("CARTESIAN");
        let forward = !sense.is("F");
        let (shapes, repaired) = trimmed(
            &self.cutting(),
            basis.form,
            [first, last],
            forward,
            by_points,
        )
        .map_err(|reason| Flaw::damaged(curve, &reason))?;
        if let Some(repair) = repaired {
            self.remark(curve, repair);
        }
        Ok(Curve {
            kind: kind_of(basis.kind, &shapes),
            name: basis.name,
            form: Form::Shapes(shapes),
        })
    }

    fn composite(&self, curve: &Instance<'a>, depth: usize) -> Read<'a> {
        let [_, segments] = curve.named_params::<2>("COMPOSITE_CURVE");
        let mut shapes = Vec::new();
        for id in segments.list().unwrap_or_default().refs() {
            match self.segment(curve, id, depth) {
                Ok(pieces) => shapes.extend(pieces),
                Err(Flaw::TooLarge { .. }) => return Err(Flaw::too_large(curve)),
                // The limit is the cause, and told.
                Err(_) if self.file.is_exhausted() => break,
                Err(Flaw::Damaged {
                    line,
                    entity,
                    reason,
                }) => {
                    self.remarks.borrow_mut().add_at(
                        line,
                        &entity,
                        &format!("{reason}; the piece is left out"),
                    );
                }
                Err(Flaw::Unknown { line, entity }) => {
                    let reason = "this kind of curve is not read; the piece is left out";
                    self.remarks.borrow_mut().add_at(line, &entity, reason);
                }
            }
        }
        if shapes.is_empty() {
            return Err(Flaw::damaged(curve, "it has no pieces"));
        }
        Ok(whole(Kind::Polycurve, shapes))
    }

    fn segment(&self, curve: &Instance<'a>, id: u64, depth: usize) -> Result<Vec<Shape>, Flaw> {
        let segment = self
            .file
            .get(id)
            .ok_or_else(|| Flaw::damaged(curve, &format!("its piece #{id} is missing")))?;
        let params = segment
            .part("COMPOSITE_CURVE_SEGMENT")
            .unwrap_or_else(|| segment.params());
        let [_, sense, parent] = params.first::<3>();
        let read = self.basis(&segment, &parent, depth)?;
        let Form::Shapes(shapes) = read.form else {
            return Err(Flaw::damaged(curve, "a piece is a line without ends"));
        };
        Ok(if sense.is("F") {
            chain_reversed(shapes)
        } else {
            shapes
        })
    }

    fn replica(&self, curve: &Instance<'a>, depth: usize) -> Read<'a> {
        let [_, parent, place] = curve.params().first::<3>();
        let place = place.reference().and_then(|id| operator(self.file, id));
        let place = place.ok_or_else(|| Flaw::damaged(curve, "its transformation is damaged"))?;
        let mut read = self.basis(curve, &parent, depth)?;
        read.form = match read.form {
            Form::Line { point, step } => Form::Line {
                point: place.point(point),
                step: place.vector(step),
            },
            Form::Shapes(shapes) => Form::Shapes(
                shapes
                    .into_iter()
                    .map(|shape| shape.placed(&place))
                    .collect(),
            ),
        };
        Ok(read)
    }

    fn basis(&self, curve: &Instance<'a>, basis: &Value, depth: usize) -> Read<'a> {
        let basis = basis.reference().and_then(|id| self.file.get(id));
        let basis = basis.ok_or_else(|| Flaw::damaged(curve, "the curve in it is missing"))?;
        self.curve(&basis, depth + 1)
    }

    fn pay(&self, curve: &Instance, shapes: &[Shape]) -> Result<(), Flaw> {
        let paid = shapes.iter().all(|shape| self.file.spend(shape.memory()));
        paid.then_some(()).ok_or_else(|| Flaw::too_large(curve))
    }
}

/// Name the trimmed curve after its basis: an arc where a circle does not close.
fn kind_of(basis: Kind, shapes: &[Shape]) -> Kind {
    let [Shape::Conic(conic)] = shapes else {
        return basis;
    };
    let is_whole = conic.to - conic.from >= TAU * (1.0 - 1e-12);
    match (basis, is_whole) {
        (Kind::Circle, false) => Kind::Arc,
        (Kind::Arc, true) => Kind::Circle,
        _ => basis,
    }
}

fn whole<'a>(kind: Kind, shapes: Vec<Shape>) -> Curve<'a> {
    Curve {
        kind,
        name: None,
        form: Form::Shapes(shapes),
    }
}
