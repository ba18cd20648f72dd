//! The records of a file: an entity, a row of a table, or the start or end of a section or block.

use glam::DVec3;

use super::groups::{Group, Groups, Trouble};

/// The group that starts what only newer programs read, under codes of its own.
const EMBEDDED: i32 = 101;
/// The group of the braces around what an application stores.
const APPLICATION: i32 = 102;

/// A group 0 and the groups up to the next one.
#[derive(Clone, Debug)]
pub struct Record<'a> {
    /// The name of the entity.
    pub name: &'a str,
    /// The line of the name or the byte of its group, from 1.
    pub at: u64,
    /// The cursor before the record, through the rest of the file.
    pub start: Groups<'a>,
    /// What belongs to the record.
    body: Groups<'a>,
}

/// The records from a cursor on. Damage comes between the record in which it lies and the next one.
#[derive(Clone, Debug)]
pub struct Records<'a> {
    groups: Groups<'a>,
}

impl<'a> Records<'a> {
    /// Start at a cursor.
    pub fn new(groups: Groups<'a>) -> Self {
        Self { groups }
    }

    /// The cursor after the last record.
    pub fn rest(&self) -> &Groups<'a> {
        &self.groups
    }

    fn skip_body(&mut self) {
        loop {
            let here = self.groups.clone();
            match self.groups.next() {
                Some(Ok(group)) if group.code != 0 => {}
                _ => {
                    self.groups = here;
                    return;
                }
            }
        }
    }
}

impl<'a> Iterator for Records<'a> {
    type Item = Result<Record<'a>, Trouble>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let start = self.groups.clone();
            let group = match self.groups.next()? {
                Ok(group) => group,
                Err(trouble) => return Some(Err(trouble)),
            };
            if group.code != 0 {
                continue;
            }
            let body = self.groups.clone();
            self.skip_body();
            return Some(Ok(Record {
                name: std::str::from_utf8(group.value.text()).unwrap_or("?"),
                at: group.at,
                start,
                body: body.until(&self.groups),
            }));
        }
    }
}

impl<'a> Record<'a> {
    /// List the groups, but for those of applications and of embedded objects.
    pub fn groups(&self) -> impl Iterator<Item = Group<'a>> {
        let mut is_foreign = false;
        let groups = self.body.clone().flatten();
        groups
            .take_while(|group| group.code != EMBEDDED)
            .filter(move |group| {
                if group.code == APPLICATION {
                    is_foreign = group.value.text().starts_with(b"{");
                }
                !is_foreign
            })
    }

    /// Find the first group of a code.
    pub fn find(&self, code: i32) -> Option<Group<'a>> {
        self.groups().find(|group| group.code == code)
    }

    /// Take a string.
    pub fn text(&self, code: i32) -> Option<&'a [u8]> {
        self.find(code).map(|group| group.value.text())
    }

    /// Take a number that may be missing.
    ///
    /// # Errors
    /// [`Trouble`] if it is no finite number.
    pub fn real(&self, code: i32) -> Result<Option<f64>, Trouble> {
        self.find(code).map(real).transpose()
    }

    /// Take a number that must be there.
    ///
    /// # Errors
    /// [`Trouble`] if it is missing or no finite number.
    pub fn required_real(&self, code: i32) -> Result<f64, Trouble> {
        self.real(code)?.ok_or_else(|| self.missing(code))
    }

    /// Take a whole number, 0 where it is missing.
    ///
    /// # Errors
    /// [`Trouble`] if it is no whole number.
    pub fn integer(&self, code: i32) -> Result<i64, Trouble> {
        let integer = self.find(code).map(|group| {
            let wrong = || wrong(group, "no whole number");
            group.value.integer().ok_or_else(wrong)
        });
        Ok(integer.transpose()?.unwrap_or(0))
    }

    /// Take a point or a direction by the code of its x. What has no z lies at the elevation.
    ///
    /// # Errors
    /// [`Trouble`] if its y is missing, or a coordinate is no finite number.
    pub fn point(&self, code: i32) -> Result<Option<DVec3>, Trouble> {
        let Some(x) = self.real(code)? else {
            return Ok(None);
        };
        let y = self.required_real(code + 10)?;
        let z = match self.real(code + 20)? {
            Some(z) => z,
            None => self.real(38)?.unwrap_or(0.0),
        };
        Ok(Some(DVec3::new(x, y, z)))
    }

    /// Take a point that must be there.
    ///
    /// # Errors
    /// [`Trouble`] if it is missing or damaged.
    pub fn required_point(&self, code: i32) -> Result<DVec3, Trouble> {
        self.point(code)?.ok_or_else(|| self.missing(code))
    }

    /// Say something about the whole record.
    pub fn trouble(&self, reason: impl Into<String>) -> Trouble {
        Trouble {
            at: self.at,
            reason: reason.into(),
        }
    }

    fn missing(&self, code: i32) -> Trouble {
        self.trouble(format!("group {code} is missing"))
    }
}

/// Take the number of a group.
///
/// # Errors
/// [`Trouble`] if it is no finite number.
pub fn real(group: Group<'_>) -> Result<f64, Trouble> {
    let real = group.value.real().filter(|real| real.is_finite());
    real.ok_or_else(|| wrong(group, "no finite number"))
}

fn wrong(group: Group<'_>, what: &str) -> Trouble {
    let (code, value) = (group.code, group.value.quoted());
    Trouble {
        at: group.at,
        reason: format!("group {code} holds {value}, {what}"),
    }
}
