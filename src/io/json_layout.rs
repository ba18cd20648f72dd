//! How JSON is laid out: objects a key a line, rows of numbers on one line. A vertex is then one
//! line, which reads well and compares well in version control.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, Serializer};

/// Write a value as JSON text that ends with a new line. Numbers have the digits that it takes
/// to read the very same number again; what is infinite or not a number becomes `null`.
///
/// # Panics
/// If the value has maps whose keys are not strings, or a `Serialize` of its own that fails.
pub fn to_text<T: Serialize>(value: &T) -> String {
    let mut bytes = Vec::new();
    let result = write(value, &mut bytes);
    result.expect("plain data can be written to memory");
    String::from_utf8(bytes).expect("JSON is UTF-8")
}

/// Write a value as [`to_text`] lays it out, bit by bit.
///
/// # Errors
/// What the writer says.
pub fn write<T: Serialize>(value: &T, mut writer: impl Write) -> io::Result<()> {
    let mut serializer = Serializer::with_formatter(&mut writer, Layout::default());
    value.serialize(&mut serializer)?;
    writer.write_all(b"\n")
}

/// Write a value as JSON text of a single line, with the numbers of [`to_text`].
///
/// # Panics
/// As [`to_text`].
pub fn to_line<T: Serialize>(value: &T) -> String {
    let result = serde_json::to_string(value);
    result.expect("plain data can be written to memory") + "\n"
}

/// Lay out arrays by their content: what separates two elements is written when it is known
/// whether the next one is a scalar, which stays on the line, or not.
#[derive(Default)]
struct Layout {
    /// For each open array or object whether it has elements on lines of their own.
    open: Vec<bool>,
    /// Set while an array's element is begun but not known; whether it is the first.
    pending: Option<bool>,
}

impl Layout {
    fn scalar<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        match self.pending.take() {
            Some(false) => writer.write_all(b", "),
            _ => Ok(()),
        }
    }

    fn begin<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if let Some(first) = self.pending.take() {
            self.separate(writer, first)?;
        }
        self.open.push(false);
        writer.write_all(bracket)
    }

    fn end<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if self.open.pop() == Some(true) {
            self.new_line(writer)?;
        }
        writer.write_all(bracket)
    }

    fn separate<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if let Some(lines) = self.open.last_mut() {
            *lines = true;
        }
        if !first {
            writer.write_all(b",")?;
        }
        self.new_line(writer)
    }

    fn new_line<W: ?Sized + Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.open.len()).try_for_each(|_| writer.write_all(b"  "))
    }
}

macro_rules! scalars {
    ($($method:ident($($value:ident: $type:ty)?);)*) => {$(
        fn $method<W: ?Sized + Write>(
            &mut self,
            writer: &mut W,
            $($value: $type,)?
        ) -> io::Result<()> {
            self.scalar(writer)?;
            CompactFormatter.$method(writer, $($value)?)
        }
    )*};
}

impl Formatter for Layout {
    scalars! {
        write_null();
        write_bool(value: bool);
        write_i8(value: i8);
        write_i16(value: i16);
        write_i32(value: i32);
        write_i64(value: i64);
        write_i128(value: i128);
        write_u8(value: u8);
        write_u16(value: u16);
        write_u32(value: u32);
        write_u64(value: u64);
        write_u128(value: u128);
        write_f32(value: f32);
        write_f64(value: f64);
        write_raw_fragment(value: &str);
        begin_string();
    }

    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"[")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, _: &mut W, first: bool) -> io::Result<()> {
        self.pending = Some(first);
        Ok(())
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"]")
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"{")
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn check(value: Value, expected: &str) {
        let text = to_text(&value);
        assert_eq!(text, expected);
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }

    #[test]
    fn rows_of_numbers_stay_on_one_line() {
        check(
            json!({"rows": [[1.0, 2.5], [3, null]], "empty": [], "none": {}}),
            "{\n  \"empty\": [],\n  \"none\": {},\n  \"rows\": [\n    [1.0, 2.5],\n    [3, null]\n  ]\n}\n",
        );
    }

    #[test]
    fn arrays_that_mix_scalars_and_objects_are_separated() {
        check(
            json!([1, "two", {"three": true}, -4, [[]]]),
            "[1, \"two\",\n  {\n    \"three\": true\n  }, -4,\n  [\n    []\n  ]\n]\n",
        );
    }

    #[test]
    fn strings_are_escaped() {
        check(
            json!({"a\"b": "c\\\n\u{1}ü"}),
            "{\n  \"a\\\"b\": \"c\\\\\\n\\u0001ü\"\n}\n",
        );
    }

    #[test]
    fn numbers_that_json_lacks_become_null() {
        assert_eq!(
            to_text(&[f64::NAN, f64::INFINITY, 1e-7]),
            "[null, null, 1e-7]\n"
        );
    }
}
