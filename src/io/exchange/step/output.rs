//! Instances on their way into a file.

use glam::DVec3;

use super::text::encode;

/// The data section as it grows.
pub struct Output {
    text: String,
    count: u64,
}

impl Output {
    /// Begin with a header.
    pub fn new(header: String) -> Self {
        Self {
            text: header,
            count: 0,
        }
    }

    /// Add an instance; returns its number.
    pub fn add(&mut self, entity: &str) -> u64 {
        self.count += 1;
        self.text.push_str(&format!("#{}={entity};\n", self.count));
        self.count
    }

    /// Add a CARTESIAN_POINT.
    pub fn point(&mut self, name: &str, point: DVec3) -> u64 {
        self.add(&format!(
            "CARTESIAN_POINT({},{})",
            string(name),
            triple(point)
        ))
    }

    /// Add a DIRECTION.
    pub fn direction(&mut self, direction: DVec3) -> u64 {
        self.add(&format!("DIRECTION('',{})", triple(direction)))
    }

    /// Add an AXIS2_PLACEMENT_3D.
    pub fn axes(&mut self, origin: DVec3, z: DVec3, x: DVec3) -> u64 {
        let (origin, z, x) = (self.point("", origin), self.direction(z), self.direction(x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',#{origin},#{z},#{x})"))
    }

    /// End the file.
    pub fn finish(mut self) -> Vec<u8> {
        self.text.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
        self.text.into_bytes()
    }
}

/// Write a string with its quotes.
pub fn string(text: &str) -> String {
    format!("'{}'", encode(text))
}

/// Write a real so that it reads back as the same double: Part 21 wants a point, and a capital E.
pub fn real(number: f64) -> String {
    let text = format!("{number:?}");
    match text.split_once('e') {
        Some((digits, exponent)) => {
            let point = if digits.contains('.') { "" } else { "." };
            format!("{digits}{point}E{exponent}")
        }
        None => text,
    }
}

/// Write a list.
pub fn list(entries: impl IntoIterator<Item = String>) -> String {
    let entries: Vec<String> = entries.into_iter().collect();
    format!("({})", entries.join(","))
}

/// Write a list of references.
pub fn refs(ids: &[u64]) -> String {
    list(ids.iter().map(|id| format!("#{id}")))
}

fn triple(point: DVec3) -> String {
    list(point.to_array().map(real))
}
