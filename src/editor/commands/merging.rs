//! Adding documents that were read, in the document's unit. Where only they state a unit, the window asks
//! for that of the document.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::document::{Document, Edit, MergeError, Reference, free_name};
use crate::editor::Editor;
use crate::editor::jobs::file_reading::{FileAnswer, Purpose};
use crate::editor::jobs::filing::{FileTask, Incoming, UnitQuestion};
use crate::editor::reply::{Note, Refusal, Reply, with_lines};
use crate::editor::view::Look;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::Placement;
use crate::io::counted_content;

/// Merged documents: the edits that add them, their remarks, and the receiving document afterwards.
struct Merged {
    edits: Vec<Edit>,
    lines: Vec<String>,
    document: Document,
}

impl Editor {
    /// Answer the question of files for the document's unit, a table's columns or what is taken of other programs'
    /// files; `None` adds nothing. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if the files cannot be read or added; nothing is changed then.
    pub fn answer_files(&mut self, answer: Option<FileAnswer>) -> Reply {
        let filing = &mut self.filing;
        let (unit, columns) = (filing.question.take(), filing.column_question.take());
        let import = filing.import_question.take();
        let reply = match (answer, unit, columns, import) {
            (Some(FileAnswer::Unit(unit)), Some(question), ..) => {
                self.merge(question.waiting, Some(unit))
            }
            (Some(FileAnswer::Columns(choice)), _, Some(question), _) => {
                let mut files = question.waiting;
                files.answers.push((question.columns, choice));
                return self.start_file_task(FileTask::Read(files));
            }
            (Some(FileAnswer::Import(choices)), .., Some(question)) => {
                let mut files = question.waiting;
                let paths = question.files.into_iter().map(|file| file.path);
                files.choices.extend(paths.zip(choices));
                files.asks = false;
                return self.start_file_task(FileTask::Read(files));
            }
            (Some(FileAnswer::Anew), ..) => match self.filing.choosing_anew(&self.workspace) {
                Some(files) => return self.start_file_task(FileTask::Read(files)),
                None => Err(Refusal::from("Nothing came in to choose from")),
            },
            (None, Some(question), ..) if question.has_retaken => {
                self.workspace.redo();
                self.document_changed();
                Ok(Note::silent())
            }
            _ => Ok(Note::silent()),
        };
        self.tell(reply)
    }

    /// Merge documents by the one rule for units; `assumed` is the unit of those that state none.
    pub(in crate::editor) fn merge(
        &mut self,
        incoming: Incoming,
        assumed: Option<LengthUnit>,
    ) -> Reply {
        let lost = self.interrupt().lost;
        lost.before(merge_idle(self, incoming, assumed))
    }
}

/// Merge documents once nothing is previewed.
fn merge_idle(editor: &mut Editor, incoming: Incoming, assumed: Option<LengthUnit>) -> Reply {
    let retakes = incoming.files.as_ref().and_then(|files| files.retakes);
    let has_retaken =
        retakes == Some(editor.workspace.revision()) && incoming.purpose == Purpose::Import;
    if has_retaken {
        // The same files come in anew.
        editor.workspace.undo();
        editor.document_changed();
    }
    let receiving = match incoming.purpose {
        Purpose::Open | Purpose::Edit => Document::default(),
        Purpose::Import | Purpose::Paste => editor.document().clone(),
    };
    let merged = match merged(receiving, &incoming, assumed) {
        Err(MergeError::NoUnit { incoming: unit }) => {
            editor.filing.question = Some(UnitQuestion {
                incoming: unit,
                waiting: incoming,
                has_retaken,
            });
            return Ok(Note::silent());
        }
        merged => merged.map_err(|error| Refusal(error.to_string()))?,
    };
    let documents = incoming.documents.iter().map(|read| &read.document);
    let counted = counted_content(documents);
    let lines = merged.lines.join("\n");
    match incoming.purpose {
        Purpose::Open | Purpose::Edit => {
            editor.replace(merged.document, None);
            let files = incoming.documents.len();
            let text = format!("{counted} read from {files} files");
            let note = Note::told(with_lines(text, &lines));
            Ok(editor
                .filing
                .note_imported(incoming.files, note, &editor.workspace))
        }
        Purpose::Import => {
            editor.add("Import curves", merged.edits)?;
            editor.look(Look::All);
            let note = Note::done(with_lines(
                format!("{counted} added to the document"),
                &lines,
            ));
            Ok(editor
                .filing
                .note_imported(incoming.files, note, &editor.workspace))
        }
        Purpose::Paste => {
            // Matches are not pasted.
            let (mut curves, mut references, mut others) = (Vec::new(), Vec::new(), Vec::new());
            for edit in merged.edits {
                match edit {
                    Edit::Add(curve) => curves.push(*curve),
                    Edit::AddReference(reference) => references.push(*reference),
                    Edit::SetMatch(_) => {}
                    other => others.push(other),
                }
            }
            editor.add_copies("Paste", curves, references, others)?;
            Ok(Note::done(with_lines(format!("{counted} pasted"), &lines)))
        }
    }
}

/// The space between pictures side by side, as a share of the width of the new one.
const BETWEEN_PICTURES: f64 = 0.05;

/// Put a picture to the right of the others if it would lie on one of them.
fn beside_others(document: &Document, picture: Reference) -> Reference {
    let Some((_, frame)) = picture.framed() else {
        return picture;
    };
    let [_, across, up] = frame;
    let axes = [across, up].map(|it| it.normalize_or_zero());
    let depth = axes[0].cross(axes[1]);
    // The sides of a frame as the new picture is seen, and how far it is before or behind it.
    let extent = |[corner, across, up]: [DVec3; 3]| {
        let corners = [corner, corner + across, corner + up, corner + across + up];
        let along = |axis: DVec3| {
            let places = corners.map(|it| it.dot(axis));
            let low = places.into_iter().fold(f64::INFINITY, f64::min);
            [low, places.into_iter().fold(f64::NEG_INFINITY, f64::max)]
        };
        [along(axes[0]), along(axes[1]), along(depth)]
    };
    let own = extent(frame);
    let frames = document.references().filter_map(|(_, it)| it.framed());
    let others: Vec<_> = frames.map(|(_, frame)| extent(frame)).collect();
    let width = across.length();
    let covers = |other: &[[f64; 2]; 3]| {
        let mut sides = own.iter().zip(other);
        let meets = |([low, high], [from, to]): (&[f64; 2], &[f64; 2])| low <= to && from <= high;
        sides.all(meets)
    };
    if !others.iter().any(covers) {
        return picture;
    }
    let right = others.iter().map(|[[_, right], ..]| *right);
    let most = right.fold(f64::NEG_INFINITY, f64::max);
    let by = most + BETWEEN_PICTURES * width - own[0][0];
    let placement = *picture.curve.placement();
    let translation = placement.translation() + by * axes[0];
    match Placement::new(placement.rotation(), placement.scale(), translation) {
        Ok(placement) => Reference {
            curve: picture.curve.clone().placed(placement),
            ..picture
        },
        Err(_) => picture,
    }
}

fn merged(
    mut document: Document,
    incoming: &Incoming,
    assumed: Option<LengthUnit>,
) -> Result<Merged, MergeError> {
    let (mut edits, mut lines) = (Vec::new(), Vec::new());
    for read in &incoming.documents {
        let merge = document.merging(&read.document, assumed)?;
        let own: BTreeSet<&str> = document.names().collect();
        let mut taken: BTreeSet<String> = read.document.names().map(str::to_owned).collect();
        let mut free = |name: &mut String| {
            // Names that are alike in the file stay so.
            if own.contains(name.as_str()) {
                let is_taken = |name: &str| own.contains(name) || taken.contains(name);
                *name = free_name(name, is_taken);
                taken.insert(name.clone());
            }
        };
        let placed = merge.edits.into_iter().map(|edit| match edit {
            Edit::Add(mut curve) => {
                free(&mut curve.name);
                Edit::Add(curve)
            }
            Edit::AddReference(reference) => {
                let mut reference = beside_others(&document, *reference);
                free(&mut reference.name);
                Edit::AddReference(Box::new(reference))
            }
            edit => edit,
        });
        let placed: Vec<Edit> = placed.collect();
        document = document.edited(placed.clone())?;
        edits.extend(placed);
        let remark = merge.remark.map(|remark| remark.to_string());
        let remarks = read.remarks.lines().map(str::to_owned).chain(remark);
        lines.extend(remarks.map(|remark| format!("{}{remark}", read.name)));
    }
    Ok(Merged {
        edits,
        lines,
        document,
    })
}
