//! The reader: from the index of instances to a drawing.

use std::cell::RefCell;
use std::collections::HashSet;

use super::assembly::Assembly;
use super::curves::Curves;
use super::expansion::Placement;
use super::instances::Instances;
use super::items::{Role, Walk, role};
use super::representations::Representations;
use super::styles::{Style, Styles};
use super::units::Units;
use crate::io::exchange::drawing::{Drawing, Unreadable};
use crate::io::exchange::remarks::Remarks;

/// Read a STEP file: free curves and points, and the edges of solids.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let mut remarks = Remarks::default();
    let file = Instances::index(bytes, &mut remarks)?;
    let reader = Reader {
        styles: Styles::read(&file),
        file,
        remarks: RefCell::new(remarks),
    };
    let mut drawing = Drawing::of_file(bytes.len());
    reader.representations(&mut drawing);
    if drawing.items.is_empty() {
        reader.leftovers(&mut drawing);
    }
    reader.external_files(&mut drawing);
    if reader.file.is_exhausted() || drawing.items.len() >= reader.file.most_items() {
        let reason = "it grows beyond what a file of this length may need; the rest is left out";
        reader.remarks.borrow_mut().add_at(1, "file", reason);
    }
    drawing.remarks = reader.remarks.into_inner().finish();
    Ok(drawing)
}

struct Reader<'a> {
    file: Instances<'a>,
    styles: Styles<'a>,
    remarks: RefCell<Remarks>,
}

impl<'a> Reader<'a> {
    fn representations(&self, drawing: &mut Drawing) {
        let found = Representations::read(&self.file);
        drawing.unit = found.list.iter().find_map(|it| it.units.length);
        let mut remarks = self.remarks.take();
        let assembly = Assembly::read(&self.file, &found, &self.styles, drawing.unit, &mut remarks);
        self.remarks.replace(remarks);
        for (place, representation) in found.list.iter().enumerate() {
            let mut walk = self.walk(representation.units, assembly.of(place), drawing);
            let style = self.styles.of(representation.id, Style::default());
            if let Some(holder) = self.file.get(representation.id) {
                walk.items(&holder, representation.items.clone(), style);
            }
        }
        for (name, line) in &found.properties {
            drawing.count_other(&format!("{name} of a property"), *line);
        }
    }

    /// Take what nothing refers to: the representation may have been lost with the end of the file.
    fn leftovers(&self, drawing: &mut Drawing) {
        let used: HashSet<u64> = self
            .file
            .all()
            .flat_map(|it| it.references())
            .filter(|id| self.file.has(*id))
            .collect();
        let context = self
            .file
            .all()
            .find(|it| it.is("GLOBAL_UNIT_ASSIGNED_CONTEXT"));
        let units = context
            .map(|it| Units::of_context(&self.file, it.id))
            .unwrap_or_default();
        let own = [Placement::default()];
        let unit = drawing.unit.or(units.length);
        let mut walk = self.walk(units, &own, drawing);
        let mut first = None;
        for item in self.file.all().filter(|it| !used.contains(&it.id)) {
            if matches!(
                role(&item),
                Role::Set | Role::Topology | Role::Wireframe | Role::Curve
            ) {
                first = first.or(Some(item.line));
                walk.item(&item, Style::default());
            }
        }
        if let Some(line) = first {
            drawing.unit = unit;
            let reason = "none holds a curve; curves that nothing refers to are taken as they are";
            self.remarks
                .borrow_mut()
                .add_at(line, "REPRESENTATION", reason);
        }
    }

    /// Parts of an assembly may be files of their own.
    fn external_files(&self, drawing: &mut Drawing) {
        for document in self.file.all().filter(|it| it.is("DOCUMENT_FILE")) {
            drawing.count_other("DOCUMENT_FILE", document.line);
            let name = document
                .label()
                .map(super::text::decode)
                .unwrap_or_default();
            let entity = format!("#{} DOCUMENT_FILE", document.id);
            let reason = format!("'{name}' is a file of its own: open it to see its curves");
            self.remarks
                .borrow_mut()
                .add_at(document.line, &entity, &reason);
        }
    }

    fn walk<'r>(
        &'r self,
        units: Units,
        placements: &'r [Placement<'a>],
        drawing: &'r mut Drawing,
    ) -> Walk<'a, 'r> {
        Walk {
            file: &self.file,
            curves: Curves {
                file: &self.file,
                remarks: &self.remarks,
                angle: units.angle.unwrap_or(1.0),
                open: RefCell::default(),
            },
            styles: &self.styles,
            placements,
            remarks: &self.remarks,
            drawing,
            seen: HashSet::new(),
            in_set: false,
        }
    }
}
