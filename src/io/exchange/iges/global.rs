//! The global section: delimiters and the unit.

use super::parameters::{Delimiters, Parameters};

/// Unit flags, names and millimetres; flag 3 leaves the unit to the name.
pub(super) const UNITS: [(i64, &str, f64); 10] = [
    (1, "INCH", 25.4),
    (2, "MM", 1.0),
    (4, "FT", 304.8),
    (5, "MI", 1_609_344.0),
    (6, "M", 1000.0),
    (7, "KM", 1.0e6),
    (8, "MIL", 0.0254),
    (9, "UM", 0.001),
    (10, "CM", 10.0),
    (11, "UIN", 2.54e-5),
];

/// What the reader needs of the global section.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Global {
    pub delimiters: Delimiters,
    /// The unit in millimetres.
    pub unit: Option<f64>,
    pub remarks: Vec<String>,
}

impl Global {
    /// Read the text of the section.
    pub fn read(text: Vec<u8>) -> Self {
        let mut global = Self {
            delimiters: delimiters(&text),
            ..Self::default()
        };
        if text.is_empty() {
            global
                .remarks
                .push("the global section is missing: the unit is unknown".to_owned());
            return global;
        }
        let fields = Parameters::split(text, global.delimiters);
        global.read_unit(&fields);
        global
    }

    fn read_unit(&mut self, fields: &Parameters) {
        let name = fields.text(14).map(|name| name.to_ascii_uppercase());
        let of_name = name.as_deref().and_then(named_unit);
        let flag = fields
            .field(13)
            .filter(|field| !field.is_empty())
            .and_then(|_| fields.integer(13).ok());
        let of_flag = UNITS
            .iter()
            .find(|unit| Some(unit.0) == flag)
            .map(|unit| unit.2);
        self.unit = of_flag.or(of_name);
        let name = name.unwrap_or_default();
        match (of_flag, of_name) {
            (Some(a), Some(b)) if a != b => self.remarks.push(format!(
                "global section: unit flag {} and unit name {name} differ; the flag is taken",
                flag.unwrap_or_default()
            )),
            (None, None) => self.remarks.push(match flag {
                Some(3) => format!("global section: the unit name \"{name}\" is unknown"),
                Some(flag) => format!("global section: the unit flag {flag} is unknown"),
                None => "global section: no unit (the standard's default is the inch)".to_owned(),
            }),
            _ => {}
        }
        let scale = fields.number(12).unwrap_or(1.0);
        if scale != 1.0 && scale != 0.0 {
            self.remarks.push(format!(
                "global section: the model's scale {scale} is not applied"
            ));
        }
    }
}

/// The first two parameters, `1H,` and `1H;`, or nothing for these two.
fn delimiters(text: &[u8]) -> Delimiters {
    let mut found = Delimiters::default();
    let text = text.trim_ascii_start();
    let mut rest = text;
    if let Some([parameter, after @ ..]) = text.strip_prefix(b"1H") {
        found.parameter = *parameter;
        rest = after;
    }
    let second = rest.trim_ascii_start().split_first();
    if let Some((_, after)) = second.filter(|(first, _)| **first == found.parameter)
        && let Some([record, ..]) = after.trim_ascii_start().strip_prefix(b"1H")
    {
        found.record = *record;
    }
    found
}

/// Names as the standard abbreviates them, and as programs write them.
fn named_unit(name: &str) -> Option<f64> {
    let of_table = UNITS.iter().find(|unit| unit.1 == name).map(|unit| unit.2);
    let of_others = match name {
        "IN" | "INCHES" | "\"" => 25.4,
        "MILLIMETER" | "MILLIMETERS" | "MILLIMETRE" | "MILLIMETRES" => 1.0,
        "FOOT" | "FEET" | "'" => 304.8,
        "MILE" | "MILES" => 1_609_344.0,
        "METER" | "METERS" | "METRE" | "METRES" => 1000.0,
        "KILOMETER" | "KILOMETERS" | "KILOMETRE" | "KILOMETRES" => 1.0e6,
        "MILS" => 0.0254,
        "MICRON" | "MICRONS" | "MICROMETER" | "MICROMETERS" | "MICROMETRE" => 0.001,
        "CENTIMETER" | "CENTIMETERS" | "CENTIMETRE" | "CENTIMETRES" => 10.0,
        "MICROINCH" | "MICROINCHES" => 2.54e-5,
        "YD" | "YARD" | "YARDS" => 914.4,
        "DM" | "DECIMETER" | "DECIMETERS" | "DECIMETRE" => 100.0,
        _ => return of_table,
    };
    Some(of_others)
}
