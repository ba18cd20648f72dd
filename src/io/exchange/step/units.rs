//! Units of length and of plane angle, from the context of a representation.

use super::instances::{Instance, Instances};
use super::tokens::Value;

/// What lengths and angles of a representation mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Units {
    /// Millimetres, if the context says.
    pub length: Option<f64>,
    /// Radians, if the context says.
    pub angle: Option<f64>,
}

/// Units may be defined by others; more steps than this are damage.
const DEEPEST: usize = 8;

impl Units {
    /// Read the units of a context.
    pub fn of_context(file: &Instances, context: u64) -> Self {
        let mut units = Self::default();
        let assigned = file
            .get(context)
            .and_then(|it| it.part("GLOBAL_UNIT_ASSIGNED_CONTEXT"));
        let Some(list) = assigned.and_then(|it| it.first::<1>()[0].list()) else {
            return units;
        };
        for unit in list.refs().filter_map(|id| file.get(id)) {
            if unit.is("SOLID_ANGLE_UNIT") {
                continue;
            }
            match size(file, &unit, 0) {
                Some((size, true)) => units.length = units.length.or(Some(size)),
                Some((size, false)) => units.angle = units.angle.or(Some(size)),
                None => {}
            }
        }
        units
    }
}

/// Measure a unit in millimetres (true) or in radians (false).
fn size(file: &Instances, unit: &Instance, depth: usize) -> Option<(f64, bool)> {
    if let Some(si) = unit.part("SI_UNIT") {
        let values = si.first::<3>();
        return match &values {
            [Value::Derived, prefix, name] | [prefix, name, _] => si_size(prefix, name),
        };
    }
    let conversion = unit.part("CONVERSION_BASED_UNIT")?;
    let [.., Value::Ref(measure)] = conversion.first::<2>() else {
        return None;
    };
    let measure = file.get(measure).filter(|_| depth < DEEPEST)?;
    let (_, params) = measure.parts().find(|(name, params)| {
        name.ends_with("MEASURE_WITH_UNIT") && params.clone().next().is_some()
    })?;
    let [count, base] = params.first::<2>();
    let count = count.number().filter(|it| *it > 0.0)?;
    let (base, is_length) = size(file, &file.get(base.reference()?)?, depth + 1)?;
    Some((count * base, is_length)).filter(|(size, _)| size.is_normal())
}

fn si_size(prefix: &Value, name: &Value) -> Option<(f64, bool)> {
    let exponent = match prefix {
        Value::Word(prefix) => exponent(prefix)?,
        _ => 0,
    };
    if name.is("METRE") {
        Some((power(exponent + 3), true))
    } else if name.is("RADIAN") {
        Some((power(exponent), false))
    } else {
        None
    }
}

fn exponent(prefix: &str) -> Option<i32> {
    Some(match prefix {
        "EXA" => 18,
        "PETA" => 15,
        "TERA" => 12,
        "GIGA" => 9,
        "MEGA" => 6,
        "KILO" => 3,
        "HECTO" => 2,
        "DECA" => 1,
        "DECI" => -1,
        "CENTI" => -2,
        "MILLI" => -3,
        "MICRO" => -6,
        "NANO" => -9,
        "PICO" => -12,
        "FEMTO" => -15,
        "ATTO" => -18,
        _ => return None,
    })
}

fn power(exponent: i32) -> f64 {
    if exponent < 0 {
        1.0 / 10f64.powi(-exponent)
    } else {
        10f64.powi(exponent)
    }
}
