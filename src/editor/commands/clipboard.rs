//! Copy and paste, as the text of a project: other programs and other windows can read it.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use crate::document::{
    Curve, CurveId, Document, Edit, Extras, LockedVertices, Reference, free_name, quoted,
};
use crate::editor::Editor;
use crate::editor::commands::command::Command;
use crate::editor::commands::items;
use crate::editor::jobs::file_reading::Purpose;
use crate::editor::jobs::filing::{Incoming, ReadDocument};
use crate::editor::reply::{Note, Refusal, Reply, with_lines};
use crate::editor::selection::Selection;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::Placement;
use crate::geometry::{FloatPolygon, PolygonKind, counted};
use crate::io::{
    Decoded, Export, ExportChoice, PICTURE, PROJECT, ReadError, Reading, Scope, TAB_TABLE, TABLE,
    WriteError, formats, svg_path,
};

/// The distance of copies from their originals, in screen points, right and down.
const OFFSET: f64 = 24.0;

impl Editor {
    /// Add what the clipboard holds as one step: curves and references of a text, which is a project, a table, a drawing
    /// or the data of an SVG path, or a picture, which is embedded. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be read; nothing is changed then.
    pub fn paste<'a>(&mut self, pasted: impl Into<Pasted<'a>>) -> Reply {
        let reply = pasted.into().read().and_then(|(read, purpose)| {
            if read.is_empty() {
                return Ok(Note::told("There are no curves on the clipboard"));
            }
            let remarks = read.remarks.to_string();
            let read = ReadDocument {
                document: read.into_document()?,
                name: String::new(),
                remarks,
            };
            let incoming = Incoming {
                purpose,
                documents: vec![read],
                files: None,
            };
            self.merge(incoming, None)
        });
        self.tell(reply)
    }

    /// Make the text of what is selected, or of the active curve or reference if nothing is. The message shows the
    /// result, with what a form for other programs cannot hold.
    ///
    /// # Errors
    /// [`Refusal`] if there is nothing to copy, or the form cannot hold it.
    pub fn copy(&mut self, form: CopyForm) -> Result<String, Refusal> {
        let (selection, document) = (&self.hand.selection, self.document());
        let copied = match form {
            CopyForm::Own => {
                text_of(selection, document).map(|text| (text, copied_note(selection, document)))
            }
            _ => form.of(selection, document),
        };
        let reply = copied.clone().map(|(_, note)| note);
        self.tell(reply)?;
        copied.map(|(text, _)| text)
    }

    /// Copy the selected vertices and remove just them, or the selected references, as one step. The message shows
    /// the result.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be removed; nothing is changed then.
    pub fn cut(&mut self) -> Result<String, Refusal> {
        let lost = self.interrupt().lost;
        let copied = text_of(&self.hand.selection, self.document());
        let (selection, document) = (&self.hand.selection, self.document());
        let mut items = selection.items().into_iter();
        let of_references =
            selection.is_empty() && items.all(|id| document.reference(id).is_some());
        let reply = copied.clone().and_then(|_| match of_references {
            true => self.execute_on_items(Command::DeleteCurve),
            false => self.delete("Cut", "cut", true),
        });
        self.tell(lost.before(reply))?;
        copied
    }

    /// Add copies, a little aside where they would cover what they are copies of, named anew, they and their vertices
    /// unlocked, and not matched. What their file said of the curves that Batten does not know, such as a number of
    /// their own, is not copied. The step begins with other edits. The copies are selected.
    pub(in crate::editor) fn add_copies(
        &mut self,
        label: &str,
        curves: Vec<Curve>,
        references: Vec<Reference>,
        mut edits: Vec<Edit>,
    ) -> Reply {
        let step = OFFSET * self.view.pane.viewport.pixel() * DVec3::new(1.0, -1.0, 0.0);
        let covers = covers(self.document(), curves.first(), references.first());
        let offset = if covers { step } else { DVec3::ZERO };
        let mut names: Vec<String> = self.document().names().map(str::to_owned).collect();
        let mut free = |name: &str| {
            let name = free_name(name, |name| names.iter().any(|taken| taken == name));
            names.push(name.clone());
            name
        };
        for curve in curves {
            let mut copy = curve.clone();
            copy.locked = false;
            copy.locked_vertices = LockedVertices::default();
            copy.visible = true;
            copy.extras = Extras::default();
            copy.name = free(&curve.name);
            let vertices = curve.polygon.vertices().iter().enumerate();
            let moved: Vec<(usize, DVec3)> =
                vertices.map(|(i, vertex)| (i, *vertex + offset)).collect();
            if copy.polygon.move_vertices(moved).is_ok() {
                for end in crate::geometry::End::BOTH {
                    let target = copy.targets.get(end).map(|mut target| {
                        target.point += offset;
                        target
                    });
                    copy.targets.set(end, target);
                }
            }
            edits.push(Edit::Add(Box::new(copy)));
        }
        for reference in references {
            let placement = *reference.curve.placement();
            let place = placement.translation() + offset;
            let moved = Placement::new(placement.rotation(), placement.scale(), place);
            edits.push(Edit::AddReference(Box::new(Reference {
                name: free(&reference.name),
                locked: false,
                visible: true,
                extras: Extras::default(),
                curve: reference.curve.placed(moved.unwrap_or(placement)),
                ..reference
            })));
        }
        let before: BTreeSet<CurveId> = self.document().all_ids().collect();
        let reply = self.add(label, edits)?;
        let added = self.document().all_ids().filter(|id| !before.contains(id));
        let added: Vec<CurveId> = added.collect();
        self.hand.selection.set_items(added);
        Ok(reply)
    }
}

/// Whether the first copies have the shape and the place of something in the document.
fn covers(document: &Document, curve: Option<&Curve>, reference: Option<&Reference>) -> bool {
    let is_curve = |copy: &Curve| {
        document
            .curves()
            .any(|(_, own)| own.polygon == copy.polygon)
    };
    let is_reference = |copy: &Reference| {
        document
            .references()
            .any(|(_, own)| own.curve == copy.curve)
    };
    curve.is_some_and(is_curve) || reference.is_some_and(is_reference)
}

/// The form of a copy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CopyForm {
    /// Whole curves as a project, which keeps all of them, otherwise tables of the selected vertices.
    Own,
    /// The data of an SVG path: cubic Béziers in the plane, with y going down.
    SvgPath,
    /// The vertices of float polygons and the points of lists, in columns between tabs.
    Table,
}

impl CopyForm {
    /// The forms for other programs, in the order in which they are offered.
    pub const OTHERS: [Self; 2] = [Self::SvgPath, Self::Table];

    /// The text of what is selected, and a note on it.
    fn of(self, selection: &Selection, document: &Document) -> Result<(String, Note), Refusal> {
        let items = selection.items();
        let scope = ExportChoice {
            scope: Scope::Selected,
            ..ExportChoice::new(&TAB_TABLE)
        };
        let chosen = scope.chosen(document, &items);
        let chosen = chosen.map_err(|_| Refusal::from("There is no curve"))?;
        let refused = |error: WriteError| Refusal(error.to_string());
        let (text, losses, form) = match self {
            Self::SvgPath => {
                let (text, losses) = svg_path(&chosen).map_err(refused)?;
                (text, losses.to_string(), "an SVG path")
            }
            Self::Own | Self::Table => {
                let export = scope.write(&chosen).map_err(refused)?;
                let text = String::from_utf8_lossy(&export.bytes).into_owned();
                (text, export.losses.to_string(), "a table")
            }
        };
        let names = items::named(document, &items);
        Ok((
            text,
            Note::told(with_lines(format!("{names} copied as {form}"), &losses)),
        ))
    }
}

/// The content of the clipboard.
#[derive(Clone, Copy, Debug)]
pub enum Pasted<'a> {
    /// A text.
    Text(&'a str),
    /// The pixels of a picture.
    Picture(&'a Decoded),
}

impl<'a> From<&'a str> for Pasted<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text)
    }
}

impl<'a> From<&'a String> for Pasted<'a> {
    fn from(text: &'a String) -> Self {
        Self::Text(text)
    }
}

impl<'a> From<&'a Decoded> for Pasted<'a> {
    fn from(picture: &'a Decoded) -> Self {
        Self::Picture(picture)
    }
}

impl Pasted<'_> {
    fn read(self) -> Result<(Reading, Purpose), Refusal> {
        match self {
            Self::Text(text) => read(text),
            Self::Picture(picture) => {
                let bytes = picture.to_png();
                let bytes = bytes.map_err(|error| Refusal(error.to_string()))?;
                let read = PICTURE.read(&bytes);
                let read = read.map_err(|error| Refusal(error.to_string()))?;
                Ok((read, Purpose::Import))
            }
        }
    }
}

/// Read a text from the clipboard: a project or a table, of which copies are added, or a drawing of another program or
/// the data of an SVG path, which keep their places.
fn read(text: &str) -> Result<(Reading, Purpose), Refusal> {
    let unreadable = |error: ReadError| {
        Refusal(format!(
            "The clipboard holds no curve that can be read: {error}"
        ))
    };
    if let Some(format) = formats::of_text(text) {
        let read = format.read(text.as_bytes()).map_err(unreadable)?;
        return Ok((read, Purpose::Import));
    }
    if is_path(text) {
        let path = format!("<svg xmlns=\"{SVG}\"><path d=\"{}\"/></svg>", text.trim());
        let svg = formats::of_text(&path).ok_or("No format holds paths")?;
        let read = svg.read(path.as_bytes()).map_err(unreadable)?;
        return Ok((read, Purpose::Import));
    }
    let project = PROJECT.read(text.as_bytes());
    let read = match &project {
        Ok(_) => project,
        // A text that begins like a project is read as one only.
        Err(_) if text.trim_start().starts_with('{') => project,
        Err(_) => TABLE.read(text.as_bytes()),
    };
    Ok((read.map_err(unreadable)?, Purpose::Paste))
}

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";

/// Whether a text is the data of an SVG path, which begins with a move, and has nothing else than commands and numbers.
fn is_path(text: &str) -> bool {
    let text = text.trim();
    let begins = text.starts_with(['M', 'm']);
    let is_data = |letter: char| {
        letter.is_ascii_digit()
            || letter.is_whitespace()
            || "MmLlHhVvCcSsQqTtAaZz,.+-eE".contains(letter)
    };
    begins && text.contains(|letter: char| letter.is_ascii_digit()) && text.chars().all(is_data)
}

/// The text of the selected vertices, or of the selected curves and references.
fn text_of(selection: &Selection, document: &Document) -> Result<String, Refusal> {
    let selected: Vec<(CurveId, Arc<Curve>)> = document
        .curves()
        .filter(|(id, _)| selection.of_curve(*id).next().is_some())
        .map(|(id, curve)| (id, curve.clone()))
        .collect();
    let is_whole = |(id, curve): &(CurveId, Arc<Curve>)| {
        selection.of_curve(*id).count() == curve.polygon.vertices().len()
    };
    let unit = document.unit();
    let text = if selected.iter().all(is_whole) {
        let whole: Vec<CurveId> = match selected.is_empty() {
            true => selection.items(),
            false => selected.iter().map(|(id, _)| *id).collect(),
        };
        let (mut curves, mut references) = items::copies(document, &whole);
        if curves.is_empty() && references.is_empty() {
            return Err("There is no curve".into());
        }
        for extras in (curves.iter_mut().map(|it| &mut it.extras))
            .chain(references.iter_mut().map(|it| &mut it.extras))
        {
            *extras = Extras::default();
        }
        let copied = Document::from_curves(curves).with_references(references);
        exported(PROJECT.write(&copied.with_unit(unit), None))
    } else {
        let tables = selected
            .iter()
            .map(|(id, curve)| selected_table(selection, unit, *id, curve));
        let tables: Result<Vec<String>, String> = tables.collect();
        tables.map(|tables| tables.join("\n"))
    };
    text.map_err(Refusal)
}

/// The note that names the copied items.
fn copied_note(selection: &Selection, document: &Document) -> Note {
    Note::told(match selection.vertices().len() {
        0 => format!("{} copied", items::named(document, &selection.items())),
        count => format!("{} copied", counted(count, "vertex", "vertices")),
    })
}

/// The selected vertices of a curve as a table, with a header line if they make a curve: its
/// degree is lowered if they are few. A single vertex is just its coordinates.
fn selected_table(
    selection: &Selection,
    unit: Option<LengthUnit>,
    id: CurveId,
    curve: &Curve,
) -> Result<String, String> {
    let polygon = &curve.polygon;
    let indices: Vec<usize> = selection.of_curve(id).collect();
    if let [only] = indices.as_slice() {
        let DVec3 { x, y, z } = polygon.vertex(*only);
        return Ok(if polygon.is_planar() {
            format!("{x},{y}\n")
        } else {
            format!("{x},{y},{z}\n")
        });
    }
    let vertices: Vec<DVec3> = indices.iter().map(|index| polygon.vertex(*index)).collect();
    let weights = polygon
        .is_rational()
        .then(|| indices.iter().map(|index| polygon.weight(*index)).collect());
    let degree = polygon.degree().min(indices.len().saturating_sub(1)).max(1);
    let part = FloatPolygon::new(degree, vertices, weights, false);
    let part = part.map_err(|error| format!("{}: {error}", quoted(&curve.name)))?;
    let part = Curve::new(curve.name.clone(), part).in_group(curve.group.clone());
    let part = Document::from_curves([part]).with_unit(unit);
    exported(TABLE.write(&part, Some(PolygonKind::Float)))
}

/// The text of an export, or why there is none.
fn exported(export: Result<Export, WriteError>) -> Result<String, String> {
    let export = export.map_err(|error| error.to_string())?;
    Ok(String::from_utf8_lossy(&export.bytes).into_owned())
}
