//! XML text with line numbers, guarded: `roxmltree` spends time and memory without bounds on some hostile
//! files (namespaces nested in one another, thousands of attributes, entities of entities), which are refused
//! here. A file that ends early is cut behind its last whole tag, so that what comes before it can be read.

use roxmltree::{Document, Node, ParsingOptions};

use crate::io::exchange::drawing::Unreadable;
use crate::io::text::Lines;

/// The most elements inside one another; drawings have about ten, and each costs a copy of its namespaces.
const DEPTH_LIMIT: usize = 256;
/// The most attributes of an element, which are compared in pairs; drawings have up to about forty.
const ATTRIBUTE_LIMIT: usize = 256;
/// The most declarations of namespaces; each is copied into all elements within that declare further ones.
const NAMESPACE_LIMIT: usize = 10_000;
/// The most entity declarations, which are searched one after another; Illustrator writes about twelve.
const ENTITY_LIMIT: usize = 100;
/// The most bytes that all references to entities can add.
const EXPANSION_LIMIT: usize = 4 << 20;
/// The memory for the nodes and attributes of a file of up to 11 MB; larger files get ten times their size.
const TREE_LIMIT: usize = 110 << 20;
/// The most prefixes that are declared for a file, each at the cost of parsing it once more.
const PREFIX_LIMIT: usize = 4;
/// The prefixes of drawings that people forget to declare when they edit files.
const PREFIXES: [(&str, &str); 3] = [
    ("xlink", "http://www.w3.org/1999/xlink"),
    ("inkscape", "http://www.inkscape.org/namespaces/inkscape"),
    (
        "sodipodi",
        "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd",
    ),
];
/// About what the tree spends on an element or attribute.
const NODE_SIZE: usize = 88;

/// The text of an XML file.
pub(super) struct Source {
    text: String,
    lines: Lines,
    /// What was repaired.
    pub(super) remarks: Vec<String>,
}

impl Source {
    /// Decode a file and repair its end.
    pub(super) fn new(bytes: &[u8]) -> Result<Self, Unreadable> {
        let mut remarks = Vec::new();
        let mut source = Self::of(decode(bytes, &mut remarks)?, remarks);
        if source.check()? {
            if let Err(error) = source.declare_prefixes() {
                source.repair(source.position(&error), &error)?;
            }
        } else {
            source.repair(source.text.len(), &roxmltree::Error::UnexpectedEndOfStream)?;
        }
        Ok(source)
    }

    /// Parse the text.
    pub(super) fn document(&self) -> Result<Document<'_>, Unreadable> {
        parse(&self.text).map_err(|error| unreadable(&error))
    }

    /// Get the text, and how many bytes of its file are before it; `None` if it is not the file's own text.
    pub(super) fn within<'s>(&'s self, bytes: &[u8]) -> Option<(&'s str, usize)> {
        let before = bytes.len().checked_sub(self.text.len())?;
        let is_own = bytes.get(before..)? == self.text.as_bytes();
        is_own.then_some((self.text.as_str(), before))
    }

    /// Get the line of a byte, from 1.
    pub(super) fn line(&self, position: usize) -> u64 {
        self.lines.number(position) as u64
    }

    /// Get the line of an element, from 1.
    pub(super) fn line_of(&self, node: Node) -> u64 {
        self.line(node.range().start)
    }

    /// Get about how much memory the tree takes.
    pub(super) fn tree_size(&self) -> usize {
        let marks = self.text.bytes().filter(|it| matches!(it, b'<' | b'='));
        marks.count().saturating_mul(NODE_SIZE)
    }

    fn of(text: String, remarks: Vec<String>) -> Self {
        let lines = Lines::of(&text);
        Self {
            text,
            lines,
            remarks,
        }
    }

    /// Refuse what the parser cannot bear, and tell whether the last tag ends.
    fn check(&self) -> Result<bool, Unreadable> {
        let scan = Scan::of(&self.text, self.text.len());
        let refuse = |at, what: &str| {
            Err(Unreadable {
                at: Some(self.line(at)),
                reason: format!("this XML file has {what}: save it once more, or in parts"),
            })
        };
        if let Some(at) = scan.too_deep {
            return refuse(at, "more than 256 elements inside one another");
        }
        if let Some(at) = scan.too_wide {
            return refuse(at, "an element of more than 256 attributes");
        }
        if scan.namespaces > NAMESPACE_LIMIT {
            return refuse(0, "more than 10000 declarations of namespaces");
        }
        let expansion = scan.references.saturating_mul(scan.doctype.len());
        if scan.entities > ENTITY_LIMIT || scan.nested_entities || expansion > EXPANSION_LIMIT {
            return refuse(0, "entities that expand without bounds");
        }
        let limit = TREE_LIMIT.max(self.text.len().saturating_mul(10));
        if self.tree_size() > limit {
            return refuse(0, "too many elements for its size");
        }
        Ok(scan.whole)
    }

    /// Declare the prefixes that the file forgot to declare, until the text is whole or has another error.
    fn declare_prefixes(&mut self) -> Result<(), roxmltree::Error> {
        for _ in 0..PREFIX_LIMIT {
            match parse(&self.text) {
                Ok(_) => return Ok(()),
                Err(roxmltree::Error::UnknownNamespace(prefix, _)) if !prefix.is_empty() => {
                    let Some(at) = Scan::of(&self.text, self.text.len()).root else {
                        break;
                    };
                    let known = PREFIXES.iter().find(|it| it.0 == prefix);
                    let uri = known.map_or(prefix.as_str(), |it| it.1);
                    let mut text = self.text.clone();
                    text.insert_str(at, &format!(" xmlns:{prefix}=\"{uri}\""));
                    let mut remarks = std::mem::take(&mut self.remarks);
                    remarks.push(format!(
                        "line {}: the prefix “{prefix}” is not declared",
                        self.line(at)
                    ));
                    *self = Self::of(text, remarks);
                }
                Err(error) => return Err(error),
            }
        }
        parse(&self.text).map(|_| ())
    }

    /// Cut the text before an error, and close the elements that are open there.
    fn repair(&mut self, position: usize, error: &roxmltree::Error) -> Result<(), Unreadable> {
        let scan = Scan::of(&self.text, position);
        let (Some(kept), false) = (self.text.get(..scan.end), scan.open.is_empty()) else {
            return Err(unreadable(error));
        };
        let mut text = kept.to_owned();
        for name in scan.open.iter().rev() {
            text.push_str("</");
            text.push_str(name);
            text.push('>');
        }
        if parse(&text).is_err() {
            return Err(unreadable(error));
        }
        let line = self.line(scan.end);
        self.remarks.push(format!(
            "line {line}: the file is damaged ({error}), so everything behind this line is missing"
        ));
        self.text = text;
        Ok(())
    }

    /// Get the byte of an error.
    fn position(&self, error: &roxmltree::Error) -> usize {
        use roxmltree::Error::{UnclosedRootNode, UnexpectedEndOfStream};
        if matches!(error, UnclosedRootNode | UnexpectedEndOfStream) {
            return self.text.len();
        }
        let place = error.pos();
        let start = self.lines.start(place.row as usize);
        let start = start.unwrap_or(self.text.len());
        let line = self.text.get(start..).unwrap_or_default();
        let before: usize = line
            .chars()
            .take((place.col as usize).saturating_sub(1))
            .map(char::len_utf8)
            .sum();
        start + before
    }
}

fn parse(text: &str) -> Result<Document<'_>, roxmltree::Error> {
    let options = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options)
}

fn unreadable(error: &roxmltree::Error) -> Unreadable {
    Unreadable {
        at: Some(u64::from(error.pos().row)),
        reason: format!("this is no whole XML file: {error}"),
    }
}

fn decode(bytes: &[u8], remarks: &mut Vec<String>) -> Result<String, Unreadable> {
    let refuse = |reason: &str| {
        Err(Unreadable {
            at: Some(1),
            reason: reason.to_owned(),
        })
    };
    match bytes {
        [0x1f, 0x8b, ..] => refuse("this file is compressed (SVGZ): save it as plain SVG"),
        [0xff, 0xfe, rest @ ..] => Ok(utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Ok(utf16(rest, u16::from_be_bytes)),
        [0xef, 0xbb, 0xbf, rest @ ..] => Ok(utf8(rest, remarks)),
        _ if bytes.contains(&0) => refuse("this is no XML file, but a binary one"),
        _ => Ok(utf8(bytes, remarks)),
    }
}

fn utf16(bytes: &[u8], join: fn([u8; 2]) -> u16) -> String {
    let pairs = bytes.chunks_exact(2).filter_map(|it| it.try_into().ok());
    char::decode_utf16(pairs.map(join))
        .map(|it| it.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect()
}

fn utf8(bytes: &[u8], remarks: &mut Vec<String>) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(error) => {
            remarks.push(format!(
                "byte {}: the text is not UTF-8, so it is read as Latin-1",
                error.valid_up_to().saturating_add(1)
            ));
            bytes.iter().copied().map(char::from).collect()
        }
    }
}

/// What a quick look at the tags of a text shows.
#[derive(Default)]
struct Scan<'t> {
    /// The names of the elements that are open at the end.
    open: Vec<&'t str>,
    /// The end of the name of the first element.
    root: Option<usize>,
    /// The end of the last whole tag.
    end: usize,
    /// Whether nothing but whole tags was found.
    whole: bool,
    /// The first element that is too deep.
    too_deep: Option<usize>,
    /// The first element of too many attributes.
    too_wide: Option<usize>,
    namespaces: usize,
    doctype: &'t str,
    entities: usize,
    nested_entities: bool,
    /// How many references to entities of the file's own there are.
    references: usize,
}

impl<'t> Scan<'t> {
    fn of(text: &'t str, end: usize) -> Self {
        let mut scan = Self::default();
        let mut at = 0;
        while let Some(rest) = text.get(at..end) {
            let Some(start) = rest.find('<') else {
                scan.whole = true;
                break;
            };
            let tag = rest.get(start..).unwrap_or_default();
            let Some(length) = markup_length(tag) else {
                break;
            };
            let markup = tag.get(..length).unwrap_or_default();
            scan.take(markup, at + start);
            at += start + length;
        }
        let inside = text.find(scan.doctype).unwrap_or_default() + scan.doctype.len();
        scan.references = references(text.get(inside..).unwrap_or_default());
        scan
    }

    fn take(&mut self, markup: &'t str, at: usize) {
        if markup.starts_with("<!DOCTYPE") {
            self.doctype = markup;
            self.entities = markup.matches("<!ENTITY").count();
            self.nested_entities = references(markup) > 0;
        } else if let Some(name) = markup.strip_prefix("</") {
            let name = name.trim_end_matches('>').trim_end();
            if self.open.last() == Some(&name) {
                self.open.pop();
                self.end = at + markup.len();
            }
        } else if !markup.starts_with("<!") && !markup.starts_with("<?") {
            self.open_tag(markup, at);
        }
    }

    fn open_tag(&mut self, markup: &'t str, at: usize) {
        self.end = at + markup.len();
        if markup.bytes().filter(|&it| it == b'=').count() > ATTRIBUTE_LIMIT {
            let attributes = unquoted(markup).filter(|&it| it == b'=').count();
            if attributes > ATTRIBUTE_LIMIT {
                self.too_wide.get_or_insert(at);
            }
        }
        let name = markup.trim_start_matches('<');
        let length = name
            .find(|it: char| it.is_ascii_whitespace() || it == '>' || it == '/')
            .unwrap_or(name.len());
        self.root
            .get_or_insert(at + markup.len() - name.len() + length);
        self.namespaces += markup.matches("xmlns").count();
        if markup.ends_with("/>") {
            return;
        }
        self.open.push(name.get(..length).unwrap_or_default());
        if self.open.len() > DEPTH_LIMIT {
            self.too_deep.get_or_insert(at);
        }
    }
}

/// The length of the tag, comment or declaration at the start of a text.
fn markup_length(text: &str) -> Option<usize> {
    let end = |mark: &str| text.find(mark).map(|at| at + mark.len());
    if text.starts_with("<!--") {
        text.get(4..)?.find("-->").map(|at| at + 7)
    } else if text.starts_with("<![CDATA[") {
        end("]]>")
    } else if text.starts_with("<?") {
        end("?>")
    } else {
        tag_length(text)
    }
}

/// The length of a tag or a document type, which ends at `>` outside of quotes and brackets.
fn tag_length(text: &str) -> Option<usize> {
    let mut quote = None;
    let mut brackets = 0_usize;
    let mut skip = 0;
    for (at, byte) in text.bytes().enumerate() {
        if at < skip {
            continue;
        }
        match (quote, byte) {
            (Some(open), _) if open == byte => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'[') => brackets += 1,
            (None, b'<') if text.get(at..).is_some_and(|it| it.starts_with("<!--")) => {
                skip = at + markup_length(text.get(at..)?)?;
            }
            (None, b']') => brackets = brackets.saturating_sub(1),
            (None, b'>') if brackets == 0 => return Some(at + 1),
            _ => {}
        }
    }
    None
}

fn unquoted(text: &str) -> impl Iterator<Item = u8> {
    let mut quote = None;
    text.bytes().filter(move |&byte| match quote {
        Some(open) => {
            if byte == open {
                quote = None;
            }
            false
        }
        None => {
            if matches!(byte, b'"' | b'\'') {
                quote = Some(byte);
            }
            true
        }
    })
}

/// How many references to entities a text holds, other than those that XML defines.
fn references(text: &str) -> usize {
    let known = ["#", "amp;", "lt;", "gt;", "quot;", "apos;"];
    text.split('&')
        .skip(1)
        .filter(|rest| !known.iter().any(|it| rest.starts_with(it)))
        .count()
}

/// Escape a text for an attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", u32::from(letter))),
            // XML has no other control characters, not even escaped.
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push(char::REPLACEMENT_CHARACTER),
            _ => escaped.push(letter),
        }
    }
    escaped
}
