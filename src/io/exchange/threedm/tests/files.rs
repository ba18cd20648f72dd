//! Small files of every version, made by hand.

use glam::DVec3;

use super::super::chunks::{CHECKED, checksum};
use super::super::classes;

pub const REFERENCE: u128 = 0xF9CFB638_B9D4_4340_87E3_C56E7865D96A;
const DEFINITION: u128 = 0x26F8BFF6_2618_417F_A158_153D64A94989;

/// Bytes of a file of a version.
#[derive(Clone)]
pub struct File {
    pub bytes: Vec<u8>,
    version: u32,
}

impl File {
    pub fn part(&self) -> Self {
        Self {
            bytes: Vec::new(),
            version: self.version,
        }
    }

    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        self.bytes.extend_from_slice(bytes);
        self
    }

    pub fn ints(self, ints: &[i32]) -> Self {
        ints.iter()
            .fold(self, |file, int| file.bytes(&int.to_le_bytes()))
    }

    pub fn numbers(self, numbers: &[f64]) -> Self {
        numbers
            .iter()
            .fold(self, |file, number| file.bytes(&number.to_le_bytes()))
    }

    pub fn counted(self, numbers: &[f64], size: usize) -> Self {
        self.ints(&[(numbers.len() / size) as i32]).numbers(numbers)
    }

    pub fn text(self, text: &str) -> Self {
        let units: Vec<u16> = text.encode_utf16().chain([0]).collect();
        let file = self.ints(&[units.len() as i32]);
        units
            .iter()
            .fold(file, |file, unit| file.bytes(&unit.to_le_bytes()))
    }

    pub fn id(self, id: u128) -> Self {
        let [a, b, c, d, e, f, g, h, tail @ ..] = id.to_be_bytes();
        self.bytes(&[d, c, b, a, f, e, h, g]).bytes(&tail)
    }

    fn head(self, code: u32, value: i64) -> Self {
        let file = self.bytes(&code.to_le_bytes());
        if file.version < 50 {
            file.ints(&[value as i32])
        } else {
            file.bytes(&value.to_le_bytes())
        }
    }

    pub fn short(self, code: u32, value: i64) -> Self {
        self.head(code, value)
    }

    pub fn chunk(self, code: u32, body: Self) -> Self {
        let sum = checksum(&body.bytes).to_le_bytes();
        let tail = if code & CHECKED == 0 { &[] } else { &sum[..] };
        self.head(code, (body.bytes.len() + tail.len()) as i64)
            .bytes(&body.bytes)
            .bytes(tail)
    }

    pub fn table(self, code: u32, body: Self) -> Self {
        self.chunk(code, body.short(0xFFFF_FFFF, 0))
    }

    pub fn object(self, class: u128, data: Self) -> Self {
        let id = self.part().id(class);
        let body = self.part().chunk(0x2_FFFB, id).chunk(0x2_FFFC, data);
        // User data of another program, which is skipped.
        let user = self.part().bytes(b"anything");
        self.chunk(0x2_7FFA, body.chunk(0x2_7FFD, user).short(0x8002_7FFF, 0))
    }

    pub fn record(self, class: u128, data: Self, attributes: &Attributes) -> Self {
        let body = self.part().short(0x8200_0071, 4).object(class, data);
        let attributes = attributes.write(self.part());
        self.chunk(
            0x2000_8070,
            body.chunk(0x0200_8072, attributes).short(0x8200_007F, 0),
        )
    }

    pub fn layer(self, index: i32, name: &str, colour: [u8; 4], parent: i32) -> Self {
        let data = self
            .part()
            .bytes(&[0x16])
            .ints(&[0, index, -1, -1, 0])
            .bytes(&colour);
        let data = data.bytes(&[0; 20]).text(name).bytes(&[1]).ints(&[-1, -1]);
        let data = data
            .numbers(&[0.0])
            .bytes(&[0])
            .id(layer_id(index))
            .id(layer_id(parent));
        let object = self.part().object(classes::LAYER, data.bytes(&[1]));
        self.chunk(0x2000_8050, object)
    }

    pub fn definition(self, id: u128, name: &str, members: &[u128]) -> Self {
        let write = |file: File| {
            let file = file.ints(&[members.len() as i32]);
            members.iter().fold(file, |file, member| file.id(*member))
        };
        let data = if self.version < 60 {
            write(self.part().bytes(&[0x10]).id(id)).text(name)
        } else {
            let unit = self.part().ints(&[1, 0, 2]).numbers(&[1e-3]).text("");
            let known = self
                .part()
                .ints(&[1, 0])
                .bytes(&[1])
                .ints(&[1, 2, 3])
                .bytes(&[1])
                .id(id);
            let known = known
                .bytes(&[1])
                .ints(&[9])
                .bytes(&[1])
                .ints(&[0])
                .bytes(&[1])
                .text(name);
            let body = self
                .part()
                .ints(&[1, 0])
                .chunk(0x4000_8002, known)
                .ints(&[1]);
            let body = body.chunk(0x4000_8000, unit).text("").text("").text("");
            let body = write(body.numbers(&[0.0; 6]).bytes(&[1])).bytes(&[0]);
            self.part().chunk(0x4000_8000, body)
        };
        let object = self.part().object(DEFINITION, data);
        self.chunk(0x2000_8076, object)
    }
}

fn layer_id(index: i32) -> u128 {
    if index < 0 { 0 } else { 0x1000 + index as u128 }
}

/// Attributes of an object.
#[derive(Clone, Default)]
pub struct Attributes {
    pub id: u128,
    pub layer: i32,
    pub name: &'static str,
    pub colour: [u8; 4],
    pub source: u8,
    pub mode: u8,
    pub paper: bool,
}

impl Attributes {
    fn write(&self, file: File) -> File {
        if file.version < 50 {
            let file = file
                .bytes(&[0x16])
                .id(self.id)
                .ints(&[self.layer, -1])
                .bytes(&self.colour);
            let file = file
                .bytes(&[0; 20])
                .ints(&[1])
                .bytes(&[self.mode, self.source, 0, 0]);
            let file = file.text(self.name).ints(&[0, 1, 7]).bytes(&[1]).ints(&[0]);
            return file
                .bytes(&[0; 22])
                .bytes(&[u8::from(self.paper)])
                .ints(&[0]);
        }
        let render = file.part().ints(&[1, 3, 0, 0]).bytes(&[0; 3]);
        let file = file.bytes(&[0x2D]).id(self.id).ints(&[self.layer]);
        let file = file
            .bytes(&[1])
            .text(self.name)
            .bytes(&[2])
            .text("url")
            .bytes(&[5]);
        let file = file
            .chunk(0x4000_8000, render)
            .bytes(&[6])
            .bytes(&self.colour);
        let file = file
            .bytes(&[8])
            .numbers(&[0.5])
            .bytes(&[12, self.mode, 13, self.source]);
        let file = file
            .bytes(&[18])
            .ints(&[1, 7])
            .bytes(&[19, u8::from(self.paper)]);
        // Of later versions, not understood.
        file.bytes(&[33, 1, 2, 3])
    }
}

/// The tables of a file.
pub struct Tables {
    pub unit: i32,
    pub layers: File,
    pub definitions: File,
    pub objects: File,
}

/// Nothing of a version.
pub fn start(version: u32) -> Tables {
    let part = File {
        bytes: Vec::new(),
        version,
    };
    Tables {
        unit: 2,
        layers: part.clone(),
        definitions: part.clone(),
        objects: part,
    }
}

impl Tables {
    pub fn record(&mut self, class: u128, data: File, attributes: &Attributes) {
        self.objects = self.objects.clone().record(class, data, attributes);
    }

    pub fn part(&self) -> File {
        self.objects.part()
    }

    pub fn reference(&mut self, definition: u128, rows: [f64; 16], attributes: &Attributes) {
        let data = self
            .part()
            .bytes(&[0x10])
            .id(definition)
            .numbers(&rows)
            .numbers(&[0.0; 6]);
        self.record(REFERENCE, data, attributes);
    }

    /// All bytes of the file.
    pub fn finish(self) -> Vec<u8> {
        let version = self.objects.version;
        let head = self.part().bytes(b"3D Geometry File Format ");
        let head = head.bytes(format!("{version:>8}").as_bytes());
        let comment = head.part().bytes(b"test");
        let properties = head.part().short(0xA000_0026, 200_912_310);
        let units = head
            .part()
            .ints(&[100, self.unit])
            .numbers(&[1e-3, 1.0, 0.01]);
        let settings = head.part().chunk(0x2000_8031, units);
        let length = head.part().ints(&[0]);
        head.chunk(1, comment)
            .table(0x1000_0014, properties)
            .table(0x1000_0015, settings)
            .table(0x1000_0011, self.layers)
            .table(0x1000_0013, self.objects)
            .table(0x1000_0021, self.definitions)
            .chunk(0x7FFF, length)
            .bytes
    }
}

/// The data of a curve on knots without the first and the last.
pub fn nurbs(file: File, order: i32, inner: &[f64], points: &[f64], rational: bool) -> File {
    let size = if rational { 4 } else { 3 };
    let count = (points.len() / size) as i32;
    let file = file
        .bytes(&[0x10])
        .ints(&[3, i32::from(rational), order, count, 0, 0]);
    file.numbers(&[0.0; 6])
        .counted(inner, 1)
        .counted(points, size)
}

/// The data of a line.
pub fn line(file: File, from: DVec3, to: DVec3) -> File {
    let file = file
        .bytes(&[0x10])
        .numbers(&from.to_array())
        .numbers(&to.to_array());
    file.numbers(&[0.0, 1.0]).ints(&[3])
}

/// The data of an arc about (1, 2, 3) with radius 2, its axes turned by a right angle.
pub fn arc(file: File, from: f64, to: f64) -> File {
    let file = file
        .bytes(&[0x10])
        .numbers(&[1.0, 2.0, 3.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]);
    let file = file
        .numbers(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, -3.0, 2.0])
        .numbers(&[0.0; 9]);
    file.numbers(&[from, to, from, to]).ints(&[3])
}
