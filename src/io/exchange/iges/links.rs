//! What entities refer to: placements, colours, names, levels, groups, and the parts of subfigures.

use std::collections::HashMap;

use super::directory::{Directory, Entry};
use super::entities;
use super::parameters::{Delimiters, Parameters};
use super::records::Records;
use crate::io::exchange::drawing::Affine;

/// How deep transformations, groups, subfigures and composite curves may nest.
pub(super) const NESTING: usize = 64;

/// The eight colours of colour numbers 1 to 8.
pub(super) const COLOURS: [[u8; 3]; 8] = [
    [0, 0, 0],
    [255, 0, 0],
    [0, 255, 0],
    [0, 0, 255],
    [255, 255, 0],
    [255, 0, 255],
    [0, 255, 255],
    [255, 255, 255],
];

/// A group (type 402).
struct Group {
    /// Its properties, one of which may name it.
    properties: Vec<u32>,
    /// Its name without such a property.
    fallback: String,
    /// Whether the group is of the model, no part of something else but of a group.
    is_free: bool,
}

/// A subfigure's definition (type 308).
pub(super) struct Subfigure {
    pub name: String,
    pub parts: Vec<u32>,
}

/// The lookups of a file, all by the number of the entity.
#[derive(Default)]
pub(super) struct Links {
    /// Own placements, with the number of the placement that applies to the result.
    places: HashMap<u32, (Affine, u32)>,
    colours: HashMap<u32, [u8; 3]>,
    names: HashMap<u32, String>,
    levels: HashMap<i32, String>,
    /// The first levels of lists of levels.
    level_lists: HashMap<u32, i32>,
    groups: HashMap<u32, Group>,
    /// The group of a member.
    members: HashMap<u32, u32>,
    /// The subfigures by number.
    pub subfigures: HashMap<u32, Subfigure>,
    /// What is drawn as a part of a composite curve or of a subfigure alone, with the first of these.
    parts: HashMap<u32, u32>,
    /// Damage found on the way: the entry's line, its type and the reason.
    pub faults: Vec<(u64, u32, String)>,
}

impl Links {
    /// Read what other entities refer to.
    pub fn read(records: &Records, delimiters: Delimiters, directory: &Directory) -> Self {
        let mut links = Self::default();
        for entry in &directory.entries {
            if let Err(reason) = links.add(entry, records, delimiters) {
                links.faults.push((entry.line, entry.entity, reason));
            }
        }
        links
    }

    fn add(
        &mut self,
        entry: &Entry,
        records: &Records,
        delimiters: Delimiters,
    ) -> Result<(), String> {
        if !matches!(entry.entity, 102 | 124 | 308 | 314 | 402 | 406) {
            return Ok(());
        }
        let from = match parameters(entry, records, delimiters) {
            Err(_) if entry.entity == 102 => return Ok(()),
            other => other?,
        };
        match (entry.entity, entry.form) {
            // The reader tells what is wrong with it.
            (102, _) => self.add_parts(entry.number, &from.pointers(1).unwrap_or_default()),
            (124, _) => {
                let place = entities::transformation(&from)?;
                self.places.insert(entry.number, (place, entry.matrix));
            }
            (308, _) => self.add_subfigure(entry, &from)?,
            (314, _) => self.add_colour(entry, &from)?,
            (402, 1 | 7 | 14 | 15) => self.add_group(entry, &from)?,
            (406, form) => self.add_property(entry, form, &from),
            _ => {}
        }
        Ok(())
    }

    fn add_parts(&mut self, owner: u32, parts: &[u32]) {
        for part in parts {
            self.parts.entry(*part).or_insert(owner);
        }
    }

    fn add_subfigure(&mut self, entry: &Entry, from: &Parameters) -> Result<(), String> {
        let parts = from.pointers(3)?;
        self.add_parts(entry.number, &parts);
        let name = from.text(2).unwrap_or_else(|| format!("D{}", entry.number));
        self.subfigures
            .insert(entry.number, Subfigure { name, parts });
        Ok(())
    }

    fn add_colour(&mut self, entry: &Entry, from: &Parameters) -> Result<(), String> {
        let mut colour = [0_u8; 3];
        for (index, value) in colour.iter_mut().enumerate() {
            let percent = from.number(index.saturating_add(1))?;
            *value = (percent.clamp(0.0, 100.0) * 2.55).round() as u8;
        }
        self.colours.insert(entry.number, colour);
        Ok(())
    }

    fn add_group(&mut self, entry: &Entry, from: &Parameters) -> Result<(), String> {
        let used = from.count(1)?.saturating_add(2);
        for member in from.pointers(1)? {
            self.members.entry(member).or_insert(entry.number);
        }
        let ordinal = self.groups.len().saturating_add(1);
        let group = Group {
            properties: from.properties(used),
            fallback: entry
                .label
                .clone()
                .unwrap_or_else(|| format!("Group {ordinal}")),
            is_free: entry.usage == 0 && matches!(entry.subordinate, 0 | 2),
        };
        self.groups.insert(entry.number, group);
        Ok(())
    }

    /// Properties: lists of levels (form 1), a level's name (form 3), an entity's name (form 15).
    fn add_property(&mut self, entry: &Entry, form: i32, from: &Parameters) {
        match form {
            1 => {
                let first = from
                    .integer(2)
                    .ok()
                    .and_then(|level| i32::try_from(level).ok());
                self.level_lists
                    .insert(entry.number, first.unwrap_or_default());
            }
            3 => {
                if let Some(name) = from.text(3).filter(|_| entry.level > 0) {
                    self.levels.entry(entry.level).or_insert(name);
                }
            }
            15 => {
                if let Some(name) = from.text(2) {
                    self.names.insert(entry.number, name);
                }
            }
            _ => {}
        }
    }

    /// Say whether an entity is drawn as a part of another alone.
    pub fn is_part(&self, number: u32) -> bool {
        self.parts.contains_key(&number)
    }

    /// Say whether an entity is a part of itself.
    pub fn is_own_part(&self, number: u32) -> bool {
        let next = |part: &u32| self.parts.get(part).copied();
        std::iter::successors(next(&number), next)
            .take(NESTING)
            .any(|owner| owner == number)
    }

    /// Give the placement of an entity in what it is part of.
    ///
    /// # Errors
    /// A reason if a transformation is missing or the chain does not end.
    pub fn place(&self, entry: &Entry) -> Result<Affine, String> {
        let mut place = Affine::default();
        let mut next = entry.matrix;
        for _ in 0..NESTING {
            if next == 0 {
                return Ok(place);
            }
            let (outer, after) = self
                .places
                .get(&next)
                .ok_or_else(|| format!("its transformation D{next} cannot be read"))?;
            place = outer.of(&place);
            next = *after;
        }
        Err(format!(
            "its transformations nest more than {NESTING} deep, or in a circle"
        ))
    }

    /// Give the colour of an entity.
    pub fn colour(&self, entry: &Entry) -> Option<[u8; 3]> {
        if entry.colour < 0 {
            return self.colours.get(&entry.colour.unsigned_abs()).copied();
        }
        let index = usize::try_from(entry.colour).ok()?.checked_sub(1)?;
        COLOURS.get(index).copied()
    }

    /// Give the name of an entity by its properties, else by its label.
    pub fn name(&self, entry: &Entry, properties: &[u32]) -> Option<String> {
        let named = properties
            .iter()
            .find_map(|property| self.names.get(property));
        named.or(entry.label.as_ref()).cloned()
    }

    /// Give the path of level and groups of an entity.
    pub fn group(&self, entry: &Entry) -> Vec<String> {
        let mut path = self.level(entry);
        let mut groups = Vec::new();
        let mut number = entry.number;
        while let Some(outer) = self.members.get(&number).filter(|_| groups.len() < NESTING) {
            groups.push(self.group_name(*outer));
            number = *outer;
        }
        path.extend(groups.into_iter().rev());
        path
    }

    /// Say whether an entity is part of nothing but of free groups.
    pub fn is_group_member(&self, entry: &Entry) -> bool {
        let mut number = entry.number;
        let mut is_member = false;
        for _ in 0..NESTING {
            let Some(outer) = self.members.get(&number) else {
                return is_member;
            };
            is_member = self.groups.get(outer).is_some_and(|group| group.is_free);
            if !is_member {
                return false;
            }
            number = *outer;
        }
        false
    }

    fn level(&self, entry: &Entry) -> Vec<String> {
        let level = match entry.level {
            0.. => entry.level,
            _ => self
                .level_lists
                .get(&entry.level.unsigned_abs())
                .copied()
                .unwrap_or_default(),
        };
        match (self.levels.get(&level), level) {
            (_, 0) => Vec::new(),
            (Some(name), _) => name.split('/').map(str::to_owned).collect(),
            (None, _) => vec![level.to_string()],
        }
    }

    fn group_name(&self, number: u32) -> String {
        let Some(group) = self.groups.get(&number) else {
            return String::new();
        };
        let named = group
            .properties
            .iter()
            .find_map(|property| self.names.get(property));
        named.unwrap_or(&group.fallback).clone()
    }
}

/// Read the parameters of an entry.
///
/// # Errors
/// A reason if there are none, or they are those of another type.
pub(super) fn parameters(
    entry: &Entry,
    records: &Records,
    by: Delimiters,
) -> Result<Parameters, String> {
    let start = usize::try_from(entry.parameters.start).unwrap_or(usize::MAX);
    let end = usize::try_from(entry.parameters.end).unwrap_or(usize::MAX);
    let lines = records.parameters.get(start..end).unwrap_or_default();
    let mut text = Vec::with_capacity(lines.len().saturating_mul(64));
    for line in lines {
        let columns = line.text.get(..line.text.len().min(64)).unwrap_or_default();
        text.extend_from_slice(columns);
        text.extend(std::iter::repeat_n(
            b' ',
            64_usize.saturating_sub(columns.len()),
        ));
    }
    let found = Parameters::split(text, by);
    if found.len() == 0 {
        return Err("it has no parameters".to_owned());
    }
    let entity = found.integer(0)?;
    if entity != i64::from(entry.entity) {
        return Err(format!("its parameters are those of type {entity}"));
    }
    Ok(found)
}
