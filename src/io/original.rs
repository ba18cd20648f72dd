//! A file of another program as it was opened, into which changes are written.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::error::WriteError;
use super::exchange::changes::{Changes, ItemChange};
use super::exchange::drawing::{Affine, Drawing, Item};
use super::exchange::writing::Manner;
use super::format::Format;
use super::loss::{Export, Loss, LossReport};
use crate::document::{Colour, Curve, CurveId, Document, Group, Reference};

/// A file of another program as it was opened, with the document that was made of it.
#[derive(Clone, Debug)]
pub struct Original {
    format: &'static Format,
    bytes: Arc<[u8]>,
    document: Document,
}

/// What is written back to a file.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenBack {
    /// The bytes of the file with their losses.
    pub export: Export,
    /// What becomes of everything else in the file.
    pub rest: Rest,
}

/// What becomes of that in a file which is neither a curve nor a reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Rest {
    /// It stays as it was, to the byte.
    Kept,
    /// It is lost; the reason, if the format would allow to keep it.
    Lost(Option<String>),
}

/// A curve or a reference of a document.
#[derive(Clone, Copy)]
enum Part<'d> {
    Curve(&'d Curve),
    Reference(&'d Reference),
}

impl Original {
    /// Keep the bytes of a file with the document that was made of all its free items.
    pub fn new(format: &'static Format, bytes: Vec<u8>, document: Document) -> Self {
        Self {
            format,
            bytes: bytes.into(),
            document,
        }
    }

    /// Write a document back to the file. What has not changed keeps its bytes where the format allows it.
    ///
    /// # Errors
    /// As [`Format::write_back`].
    pub fn written_back(&self, document: &Document) -> Result<WrittenBack, WriteError> {
        let kept = |bytes: Vec<u8>, losses: LossReport| WrittenBack {
            export: Export { bytes, losses },
            rest: Rest::Kept,
        };
        let mut losses = LossReport::new(self.format.name);
        if document.is_same(&self.document) {
            return Ok(kept(self.bytes.to_vec(), losses));
        }
        match self.rewritten(document, &mut losses) {
            Some(Ok(bytes)) => {
                losses.add_matches(document, |_| true);
                losses.add_document(document);
                Ok(kept(bytes, losses))
            }
            other => {
                let reason = other.and_then(Result::err);
                Ok(WrittenBack {
                    export: self.format.write_back(document)?,
                    rest: Rest::Lost(reason),
                })
            }
        }
    }

    /// List what the file has beside curves, with counts.
    pub fn others(&self) -> Vec<String> {
        let drawing = self.format.draw(&self.bytes).unwrap_or_default();
        let others = drawing.other.iter();
        others
            .map(|other| format!("{} {}", other.count, other.kind))
            .collect()
    }

    /// Write the changes into the bytes; `None` if the format has no way to do so, the reason if they cannot be.
    fn rewritten(
        &self,
        document: &Document,
        losses: &mut LossReport,
    ) -> Option<Result<Vec<u8>, String>> {
        let rewriter = self.format.rewrite.as_ref()?;
        let written = self
            .changes(document, &rewriter.manner, losses)
            .and_then(|changes| match changes.is_empty() {
                true => Ok(self.bytes.to_vec()),
                false => (rewriter.write)(&self.bytes, &changes, losses),
            });
        Some(written)
    }

    /// What has become of the items of the file.
    fn changes(
        &self,
        document: &Document,
        manner: &Manner,
        losses: &mut LossReport,
    ) -> Result<Changes, String> {
        let drawing = self.format.draw(&self.bytes);
        let drawing = drawing.map_err(|error| error.to_string())?;
        let sources: Vec<_> = drawing.sources().concat();
        let old: Vec<(CurveId, Part)> = parts(&self.document).collect();
        if sources.len() != old.len() {
            return Err("the file is not the one that was opened".to_owned());
        }
        let now: HashMap<CurveId, Part> = parts(document).collect();
        let mut heirs = Heirs::new(&old, document);
        let to_file = scaling(document, &drawing);
        let mut items = |part: Part| -> Vec<Item> {
            let items = part.items(manner, losses).into_iter();
            items.map(|item| placed(item, &to_file)).collect()
        };
        let mut changes = Changes::default();
        for (place, (id, old)) in sources.into_iter().zip(&old) {
            let own = now.get(id).copied();
            let is_same = own.is_some_and(|part| part.has_shape_of(old));
            if is_same && self.document.unit() == document.unit() {
                continue;
            }
            let stand: Vec<Part> = match own {
                Some(part) => vec![part],
                None => heirs.take(old.name()),
            };
            let [index, shape] = place.ok_or("single points cannot be moved within the file")?;
            let items = stand.into_iter().flat_map(&mut items);
            let shapes = items.flat_map(|item| item.shapes).collect();
            let change = changes.items.entry(index).or_insert_with(|| ItemChange {
                name: old.name().to_owned(),
                shapes: Vec::new(),
            });
            let count = (shape + 1).max(change.shapes.len());
            change.shapes.resize(count, None);
            if let Some(stands) = change.shapes.get_mut(shape) {
                *stands = Some(shapes);
            }
        }
        let rest = heirs.rest();
        changes.added = rest.iter().copied().flat_map(&mut items).collect();
        for part in rest {
            let (group, _) = part.marks();
            losses.add_group(part.name(), group, Group::default());
        }
        for (id, old) in &old {
            if let Some(now) = now.get(id) {
                now.report_kept(old, losses);
            }
        }
        Ok(changes)
    }
}

/// The curves, then the references of a document.
fn parts(document: &Document) -> impl Iterator<Item = (CurveId, Part<'_>)> {
    let curves = document.curves();
    let curves = curves.map(|(id, curve)| (id, Part::Curve(curve)));
    let references = document.references();
    curves.chain(references.map(|(id, it)| (id, Part::Reference(it))))
}

/// What brings lengths of a document to those of its file.
fn scaling(document: &Document, drawing: &Drawing) -> Affine {
    let units = document.unit().zip(drawing.unit);
    let factor = units.map(|(own, unit)| own.millimetres() / unit);
    Affine::scaling(factor.unwrap_or(1.0))
}

fn placed(item: Item, place: &Affine) -> Item {
    let shapes = item.shapes.into_iter();
    Item {
        shapes: shapes.map(|it| it.placed(place)).collect(),
        ..item
    }
}

impl<'d> Part<'d> {
    fn name(self) -> &'d str {
        match self {
            Self::Curve(curve) => &curve.name,
            Self::Reference(reference) => &reference.name,
        }
    }

    fn marks(self) -> (&'d Group, Option<Colour>) {
        match self {
            Self::Curve(curve) => (&curve.group, curve.colour),
            Self::Reference(reference) => (&reference.group, reference.colour),
        }
    }

    fn items(self, manner: &Manner, losses: &mut LossReport) -> Vec<Item> {
        match self {
            Self::Curve(curve) => Vec::from_iter(Item::of_curve(curve, manner, losses)),
            Self::Reference(reference) => Item::of_reference(reference, manner, losses),
        }
    }

    fn has_shape_of(self, other: &Part) -> bool {
        match (self, other) {
            (Self::Curve(own), Part::Curve(other)) => own.polygon == other.polygon,
            (Self::Reference(own), Part::Reference(other)) => own.curve == other.curve,
            _ => false,
        }
    }

    /// Add what has changed beside the shape, which the file keeps as it was.
    fn report_kept(self, old: &Part, losses: &mut LossReport) {
        let (group, colour) = self.marks();
        let (old_group, old_colour) = old.marks();
        let changed = [
            ("name", self.name() != old.name()),
            ("group", group != old_group),
            ("colour", colour != old_colour),
        ];
        for (what, _) in changed.into_iter().filter(|(_, is_changed)| *is_changed) {
            let name = self.name().to_owned();
            losses.losses.push((name, Loss::Kept { what }));
        }
    }
}

/// The curves and references that are new in a document. They stand for those of their name that are gone, as what is
/// made of a reference does.
struct Heirs<'d> {
    parts: Vec<Option<Part<'d>>>,
    by_name: HashMap<&'d str, Vec<usize>>,
}

impl<'d> Heirs<'d> {
    fn new(old: &[(CurveId, Part<'d>)], document: &'d Document) -> Self {
        let ids: HashSet<CurveId> = old.iter().map(|(id, _)| *id).collect();
        let new = parts(document).filter(|(id, _)| !ids.contains(id));
        let parts: Vec<Part> = new.map(|(_, part)| part).collect();
        let known: HashSet<&str> = old.iter().map(|(_, part)| part.name()).collect();
        let mut by_name: HashMap<&str, Vec<usize>> = HashMap::new();
        for (index, part) in parts.iter().enumerate() {
            let name = part.name();
            let of = match known.contains(name) {
                true => name,
                false => without_number(name),
            };
            by_name.entry(of).or_default().push(index);
        }
        Self {
            parts: parts.into_iter().map(Some).collect(),
            by_name,
        }
    }

    /// Take those that stand for one that is gone.
    fn take(&mut self, name: &str) -> Vec<Part<'d>> {
        let places = self.by_name.remove(name).unwrap_or_default();
        let parts = places.into_iter();
        parts
            .filter_map(|index| self.parts.get_mut(index)?.take())
            .collect()
    }

    /// The others.
    fn rest(self) -> Vec<Part<'d>> {
        self.parts.into_iter().flatten().collect()
    }
}

/// A name without the number behind it, which parts between corners have.
fn without_number(name: &str) -> &str {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|it| it.is_ascii_digit());
    match name.rsplit_once(' ') {
        Some((name, number)) if is_number(number) => name,
        _ => name,
    }
}
