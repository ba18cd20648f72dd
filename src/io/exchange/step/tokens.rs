//! Tokens of a Part 21 file, read in place: lists stay slices of the file until somebody iterates them.

/// The parameters between two parentheses, as an iterator of their values.
#[derive(Clone, Debug, Default)]
pub struct Params<'a> {
    rest: &'a [u8],
}

/// One parameter.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// `$`, or nothing between two commas, or beyond the last parameter.
    Missing,
    /// `*`: derived in a subtype.
    Derived,
    /// An integer or a real.
    Number(f64),
    /// `#12`
    Ref(u64),
    /// The characters between two quotes, with all escapes.
    Text(&'a [u8]),
    /// `.T.`, without the dots.
    Word(&'a str),
    /// `(…)`
    List(Params<'a>),
    /// `NAME(…)`, without its name.
    Typed(Params<'a>),
    /// What no rule of Part 21 allows.
    Bad,
}

impl<'a> Params<'a> {
    /// Read what stands between two parentheses.
    pub fn new(inside: &'a [u8]) -> Self {
        Self { rest: inside }
    }

    /// Take the first values; `Missing` stands for those that are not there.
    pub fn first<const N: usize>(mut self) -> [Value<'a>; N] {
        std::array::from_fn(|_| self.next().unwrap_or(Value::Missing))
    }

    /// Take the references among the values.
    pub fn refs(self) -> impl Iterator<Item = u64> {
        self.filter_map(|value| value.reference())
    }
}

impl<'a> Iterator for Params<'a> {
    type Item = Value<'a>;

    fn next(&mut self) -> Option<Value<'a>> {
        let rest = skip_space(self.rest);
        if rest.is_empty() {
            return None;
        }
        let (value, rest) = value(rest);
        let rest = skip_space(rest);
        self.rest = rest.strip_prefix(b",").unwrap_or(rest);
        Some(value)
    }
}

impl<'a> Value<'a> {
    /// Take a number, plain or as a measure such as `PARAMETER_VALUE(0.5)`.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Typed(params) => match params.clone().next() {
                Some(Self::Number(number)) => Some(number),
                _ => None,
            },
            _ => None,
        }
    }

    /// Take a count or degree.
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Number(number) if (0.0..=9e15).contains(number) && number.fract() == 0.0 => {
                Some(*number as usize)
            }
            _ => None,
        }
    }

    /// Take the number of an instance.
    pub fn reference(&self) -> Option<u64> {
        match self {
            Self::Ref(id) => Some(*id),
            _ => None,
        }
    }

    /// Take a list; none if it is no list.
    pub fn list(&self) -> Option<Params<'a>> {
        match self {
            Self::List(list) => Some(list.clone()),
            _ => None,
        }
    }

    /// Whether it is the enumeration value `.word.`
    pub fn is(&self, word: &str) -> bool {
        matches!(self, Self::Word(own) if own.eq_ignore_ascii_case(word))
    }
}

/// Drop white space and comments in front.
pub fn skip_space(mut bytes: &[u8]) -> &[u8] {
    loop {
        bytes = bytes.trim_ascii_start();
        match bytes {
            [0, rest @ ..] => bytes = rest,
            [b'/', b'*', rest @ ..] => bytes = after(rest, comment_end(rest)),
            _ => return bytes,
        }
    }
}

/// Split a keyword off; empty if there is none.
pub fn keyword(bytes: &[u8]) -> (&str, &[u8]) {
    let rest = bytes.strip_prefix(b"!").unwrap_or(bytes);
    let length = count_while(rest, |byte| {
        byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-')
    });
    let (word, rest) = rest.split_at(length);
    (std::str::from_utf8(word).unwrap_or(""), rest)
}

/// Split the inside of a list off, after its opening parenthesis; a list without an end runs on to the end.
pub fn split_list(bytes: &[u8]) -> (Params<'_>, &[u8]) {
    let mut depth = 0usize;
    let mut at = 0;
    while let Some(byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'(' => depth += 1,
            b')' if depth == 0 => break,
            b')' => depth -= 1,
            _ => at += skipped(*byte, bytes.get(at..).unwrap_or_default()),
        }
    }
    let closed = bytes.get(at.wrapping_sub(1)) == Some(&b')');
    let inside = bytes.get(..at - usize::from(closed)).unwrap_or_default();
    (Params::new(inside), after(bytes, at))
}

/// Count the bytes to jump over after `byte`: the rest of a string or of a comment.
pub fn skipped(byte: u8, rest: &[u8]) -> usize {
    match byte {
        b'\'' => string_end(rest).1,
        b'"' => rest
            .iter()
            .position(|it| *it == b'"')
            .map_or(rest.len(), |end| end + 1),
        b'/' if rest.first() == Some(&b'*') => {
            let inside = after(rest, 1);
            1 + comment_end(inside)
        }
        _ => 0,
    }
}

/// Split `12` of `#12` off.
pub fn number_of(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let length = count_while(bytes, |byte| byte.is_ascii_digit());
    let (digits, rest) = bytes.split_at(length);
    let id = std::str::from_utf8(digits).ok()?.parse().ok()?;
    Some((id, rest))
}

fn value(bytes: &[u8]) -> (Value<'_>, &[u8]) {
    let Some((&head, rest)) = bytes.split_first() else {
        return (Value::Missing, bytes);
    };
    match head {
        b',' => (Value::Missing, bytes),
        b'$' => (Value::Missing, rest),
        b'*' => (Value::Derived, rest),
        b'#' => number_of(rest).map_or((Value::Bad, rest), |(id, rest)| (Value::Ref(id), rest)),
        b'(' => {
            let (list, rest) = split_list(rest);
            (Value::List(list), rest)
        }
        b'\'' => {
            let (inside, end) = string_end(rest);
            (
                Value::Text(rest.get(..inside).unwrap_or_default()),
                after(rest, end),
            )
        }
        b'"' => (Value::Bad, after(rest, skipped(b'"', rest))),
        b'.' if !rest.first().is_some_and(u8::is_ascii_digit) => word(rest),
        b'0'..=b'9' | b'+' | b'-' | b'.' => number(bytes),
        b'!' | b'_' | b'A'..=b'Z' | b'a'..=b'z' => typed(bytes),
        _ => (Value::Bad, rest),
    }
}

fn word(bytes: &[u8]) -> (Value<'_>, &[u8]) {
    let length = count_while(bytes, |byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let (word, rest) = bytes.split_at(length);
    match rest.strip_prefix(b".") {
        Some(rest) => (Value::Word(std::str::from_utf8(word).unwrap_or("")), rest),
        None => (Value::Bad, rest),
    }
}

fn number(bytes: &[u8]) -> (Value<'_>, &[u8]) {
    let length = count_while(bytes, |byte| {
        byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.' | b'e' | b'E')
    });
    let (digits, rest) = bytes.split_at(length);
    let number: Option<f64> = std::str::from_utf8(digits)
        .ok()
        .and_then(|it| it.parse().ok());
    match number {
        Some(number) if number.is_finite() => (Value::Number(number), rest),
        _ => (Value::Bad, after(bytes, length.max(1))),
    }
}

fn typed(bytes: &[u8]) -> (Value<'_>, &[u8]) {
    let (_, rest) = keyword(bytes);
    match skip_space(rest).strip_prefix(b"(") {
        Some(rest) => {
            let (list, rest) = split_list(rest);
            (Value::Typed(list), rest)
        }
        None => (Value::Bad, rest),
    }
}

/// Where a string ends and where its closing quote is behind, after its opening quote.
fn string_end(bytes: &[u8]) -> (usize, usize) {
    let mut at = 0;
    while let Some(length) = after(bytes, at).iter().position(|byte| *byte == b'\'') {
        at += length + 1;
        if bytes.get(at) != Some(&b'\'') {
            return (at - 1, at);
        }
        at += 1;
    }
    (bytes.len(), bytes.len())
}

fn comment_end(bytes: &[u8]) -> usize {
    bytes
        .windows(2)
        .position(|pair| pair == b"*/")
        .map_or(bytes.len(), |end| end + 2)
}

fn count_while(bytes: &[u8], test: impl Fn(u8) -> bool) -> usize {
    bytes
        .iter()
        .position(|byte| !test(*byte))
        .unwrap_or(bytes.len())
}

fn after(bytes: &[u8], count: usize) -> &[u8] {
    bytes.get(count..).unwrap_or_default()
}
