//! The line above a table that says which curve its vertices make, or how its points are called.

use super::error::Problem;
use crate::geometry::PolygonKind;

/// The header of a table: `# degree=9 polygon=float periodic=false name=arc`, or `# name=scan`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TableHeader {
    /// Which curve the vertices make; `None` if they are points.
    pub curve: Option<CurveHeader>,
    /// The name, if the line says it.
    pub name: Option<String>,
}

/// The header's figures of a curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveHeader {
    /// The degree; any whole number, the polygon checks it.
    pub degree: usize,
    /// Which polygon the vertices make; the float polygon if the line does not say.
    pub kind: PolygonKind,
    /// Whether the curve is periodic; open if the line does not say.
    pub periodic: bool,
}

const KEYS: [&str; 4] = ["degree", "polygon", "periodic", "name"];

impl TableHeader {
    /// Write the line. A name that could be mistaken is written as a JSON string.
    pub(super) fn to_line(&self) -> String {
        let mut line = "#".to_owned();
        if let Some(curve) = &self.curve {
            line.push_str(&format!(
                " degree={} polygon={} periodic={}",
                curve.degree, curve.kind, curve.periodic
            ));
        }
        if let Some(name) = &self.name {
            line.push_str(" name=");
            if is_plain(name) {
                line.push_str(name);
            } else {
                line.push_str(&serde_json::Value::from(name.as_str()).to_string());
            }
        }
        line
    }

    /// Read the line. Its parts are separated by blanks, commas or semicolons.
    ///
    /// # Errors
    /// [`Problem`] if something is missing, unknown, there twice or unusable.
    pub(super) fn parse(line: &str) -> Result<Self, Problem> {
        let mut values: [Option<String>; 4] = [const { None }; 4];
        let mut rest = skipped(line.trim_start_matches('#'));
        while !rest.is_empty() {
            let Some((index, after)) = key_at(rest) else {
                let word = rest.split(is_separator).next().unwrap_or(rest);
                return Err(Problem::UnknownKey(word.to_owned()));
            };
            let (value, after) = match KEYS[index] {
                "name" => name_value(after)?,
                _ => {
                    let end = after.find(is_separator).unwrap_or(after.len());
                    (after[..end].to_owned(), &after[end..])
                }
            };
            if values[index].replace(value).is_some() {
                return Err(Problem::Repeated(KEYS[index]));
            }
            rest = skipped(after);
        }
        let [degree, polygon, periodic, name] = values;
        let name = name.filter(|name| !name.trim().is_empty());
        if degree.is_none() && polygon.is_none() && periodic.is_none() {
            return Ok(Self { curve: None, name });
        }
        let degree = degree.ok_or(Problem::NoDegree)?;
        let curve = CurveHeader {
            degree: usable(
                "degree",
                degree,
                "a whole number from 1 to 25 is needed",
                |text| text.parse().ok(),
            )?,
            kind: polygon.map_or(Ok(PolygonKind::Float), |text| {
                let needed = "float, clamped or bezier is needed";
                usable("polygon", text, needed, PolygonKind::from_name)
            })?,
            periodic: periodic.map_or(Ok(false), |text| {
                usable("periodic", text, "true or false is needed", |text| {
                    text.parse().ok()
                })
            })?,
        };
        Ok(Self {
            curve: Some(curve),
            name,
        })
    }
}

/// Whether a line that begins with `#` begins a table: it has a degree, or its first word is one of the
/// keys, also a misspelled degree. Otherwise it is a comment.
pub(super) fn begins_table(line: &str) -> bool {
    let begun = skipped(line.trim_start_matches(['\u{feff}', '"', ' ', '\t', '#']));
    let word = begun.split(is_separator).next().unwrap_or_default();
    let misspelled = word.starts_with("deg") && word.contains('=');
    line.contains("degree=") || key_at(begun).is_some() || misspelled
}

/// Find one of the keys, with its `=`, at the beginning of the text.
fn key_at(text: &str) -> Option<(usize, &str)> {
    KEYS.iter()
        .enumerate()
        .find_map(|(index, key)| Some((index, text.strip_prefix(key)?.strip_prefix('=')?)))
}

/// Take a name: a JSON string, or everything up to the next key or the end of the line.
fn name_value(text: &str) -> Result<(String, &str), Problem> {
    if text.starts_with('"') {
        let mut strings = serde_json::Deserializer::from_str(text).into_iter::<String>();
        if let Some(Ok(name)) = strings.next() {
            return Ok((name, &text[strings.byte_offset()..]));
        }
        return Err(Problem::BadValue {
            key: "name",
            value: text.to_owned(),
            needed: "a name in quotation marks needs one at its end, and \\\" and \\\\ for such marks in it",
        });
    }
    let next_key = text
        .char_indices()
        .filter(|(_, character)| is_separator(*character))
        .map(|(index, character)| index + character.len_utf8())
        .find(|index| key_at(&text[*index..]).is_some());
    let (name, rest) = text.split_at(next_key.unwrap_or(text.len()));
    // A name with "=" is written in quotation marks: without them it is a key misspelled.
    if let Some(word) = name.split(is_separator).find(|word| word.contains('=')) {
        return Err(Problem::UnknownKey(word.to_owned()));
    }
    Ok((name.trim_matches(is_separator).to_owned(), rest))
}

fn usable<T>(
    key: &'static str,
    text: String,
    needed: &'static str,
    parse: impl Fn(&str) -> Option<T>,
) -> Result<T, Problem> {
    parse(&text).ok_or_else(|| Problem::BadValue {
        key,
        value: text.clone(),
        needed,
    })
}

/// Whether a name reads back as it is when written without quotation marks.
fn is_plain(name: &str) -> bool {
    let odd = |c: char| c.is_control() || "\"=,;#\u{2028}\u{2029}".contains(c);
    !name.is_empty() && name.trim() == name && !name.contains(odd)
}

fn is_separator(character: char) -> bool {
    character.is_whitespace() || character == ',' || character == ';'
}

fn skipped(text: &str) -> &str {
    text.trim_start_matches(is_separator)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(name: &str) -> TableHeader {
        TableHeader {
            curve: Some(CurveHeader {
                degree: 9,
                kind: PolygonKind::Clamped,
                periodic: true,
            }),
            name: Some(name.to_owned()),
        }
    }

    #[test]
    fn a_line_without_a_degree_names_points() {
        let points = TableHeader {
            curve: None,
            name: Some("scan 3".to_owned()),
        };
        assert_eq!(points.to_line(), "# name=scan 3");
        assert_eq!(TableHeader::parse("# name=scan 3"), Ok(points));
        for (line, begins) in [
            ("# name=scan", true),
            ("# degree=3", true),
            ("# hull, degree=3", true),
            ("# degre=1", true),
            ("# points", false),
            ("# measured by scanner=7", false),
            ("#", false),
        ] {
            assert_eq!(begins_table(line), begins, "{line:?}");
        }
    }

    #[test]
    fn the_line_is_plain_for_a_plain_name() {
        assert_eq!(
            header("my arc").to_line(),
            "# degree=9 polygon=clamped periodic=true name=my arc"
        );
    }

    #[test]
    fn every_name_survives() {
        for name in [
            "arc",
            "my arc",
            "a,b",
            "a=b",
            "x degree=3",
            "say \"so\"",
            "two\nlines",
            "\\",
            "#1",
            " padded ",
            "Bézier 曲线 🚤",
            "a;b",
            "\"",
            "tab\there",
            "a\u{2028}b",
            "a\r\n",
            "name=",
        ] {
            let line = header(name).to_line();
            assert!(!line.contains(['\n', '\r']), "{line:?}");
            assert_eq!(TableHeader::parse(&line), Ok(header(name)), "{line:?}");
        }
    }

    #[test]
    fn hand_written_lines_are_read() {
        let check = |line: &str, degree, kind, periodic, name: Option<&str>| {
            let name = name.map(str::to_owned);
            let curve = Some(CurveHeader {
                degree,
                kind,
                periodic,
            });
            let expected = TableHeader { curve, name };
            assert_eq!(TableHeader::parse(line), Ok(expected), "{line:?}");
        };
        check("#degree=3", 3, PolygonKind::Float, false, None);
        check(
            "# degree=3, polygon=bezier",
            3,
            PolygonKind::Bezier,
            false,
            None,
        );
        check(
            "# name=a b, degree=3",
            3,
            PolygonKind::Float,
            false,
            Some("a b"),
        );
        check(
            "# periodic=true;degree=26;name=",
            26,
            PolygonKind::Float,
            true,
            None,
        );
    }

    #[test]
    fn what_cannot_be_used_is_named() {
        let check = |line: &str, expected: &str| {
            assert_eq!(TableHeader::parse(line).unwrap_err().to_string(), expected);
        };
        check(
            "# polygon=float",
            "the line lacks the degree: add, for example, degree=3 (from 1 to 25)",
        );
        check(
            "# degree=three",
            "degree=three cannot be used: a whole number from 1 to 25 is needed",
        );
        check(
            "# degree=-1",
            "degree=-1 cannot be used: a whole number from 1 to 25 is needed",
        );
        check(
            "# degree=3 polygon=closed",
            "polygon=closed cannot be used: float, clamped or bezier is needed",
        );
        check(
            "# degree=3 periodic=yes",
            "periodic=yes cannot be used: true or false is needed",
        );
        check("# degree=3 degree=4", "degree is given twice");
        check(
            "# degree=3 vertices=1000000000",
            "“vertices=1000000000” is not known here: a line above a table holds degree=…, polygon=…, periodic=… and, last, name=…",
        );
        check(
            "# degree=3 name=\"open",
            "name=\"open cannot be used: a name in quotation marks needs one at its end, and \\\" and \\\\ for such marks in it",
        );
    }
}
