//! The columns of a table: their names, with a unit, and a choice among them.

use std::borrow::Cow;
use std::str::FromStr;

use super::error::Problem;
use super::table_column::TableColumn;
use super::table_lines::Fields;
use crate::document::quoted;
use crate::geometry::expressions::LengthUnit;

/// The columns that a table of vertices can have, in the order in which they are written.
pub(super) const COLUMNS: [&str; 4] = ["x", "y", "z", "weight"];

/// The column of weights, which points have only where it is chosen.
pub(super) const WEIGHT: usize = 3;

/// Words behind x or y that are no unit: of a chord, or of nothing.
const NO_UNIT: [&str; 5] = ["c", "chord", "-", "1", ""];

/// The columns that hold x, y and, in space, z, and that of the points' weights: by their numbers, counted from 1,
/// or by their names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ColumnChoice {
    /// None where the table tells.
    coordinates: Vec<Pick>,
    weight: Option<Pick>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Pick {
    Number(usize),
    Name(String),
}

impl ColumnChoice {
    /// Choose columns by their numbers, counted from 1; `None` if these are not 2 or 3 different ones.
    pub fn of_numbers(numbers: &[usize]) -> Option<Self> {
        Self::of(numbers.iter().map(|number| Pick::Number(*number)).collect())
    }

    fn of(picks: Vec<Pick>) -> Option<Self> {
        let is_known = |(place, pick): (usize, &Pick)| {
            *pick != Pick::Number(0) && !picks[..place].contains(pick)
        };
        let fits = (2..=3).contains(&picks.len()) && picks.iter().enumerate().all(is_known);
        fits.then_some(Self {
            coordinates: picks,
            weight: None,
        })
    }

    /// Choose the column of weights too, by its number, counted from 1, or its name.
    ///
    /// # Errors
    /// What a column is.
    pub fn with_weights(self, column: &str) -> Result<Self, &'static str> {
        let weight = Pick::of(column).filter(|pick| *pick != Pick::Number(0));
        let weight = Some(weight.ok_or("a column is needed, by its name or number from 1")?);
        Ok(Self { weight, ..self })
    }

    /// Whether the columns of coordinates are chosen.
    pub(super) fn has_coordinates(&self) -> bool {
        !self.coordinates.is_empty()
    }

    /// Whether a column is chosen by its name.
    pub(super) fn has_names(&self) -> bool {
        let mut picks = self.coordinates.iter().chain(&self.weight);
        picks.any(|pick| matches!(pick, Pick::Name(_)))
    }

    /// Find the columns of coordinates, counted from 0, in a table with these names and this number of columns.
    ///
    /// # Errors
    /// [`Problem::NoSuchColumn`].
    pub(super) fn places(
        &self,
        names: Option<&ColumnNames>,
        count: usize,
    ) -> Result<Vec<usize>, Problem> {
        let places = self.coordinates.iter();
        places.map(|pick| pick.place(names, count)).collect()
    }

    /// Find the column of weights likewise.
    ///
    /// # Errors
    /// [`Problem::NoSuchColumn`].
    pub(super) fn weight(
        &self,
        names: Option<&ColumnNames>,
        count: usize,
    ) -> Result<Option<usize>, Problem> {
        let weight = self.weight.as_ref();
        weight.map(|pick| pick.place(names, count)).transpose()
    }
}

impl Pick {
    fn of(text: &str) -> Option<Self> {
        match (text.trim().parse(), text.trim()) {
            (_, "") => None,
            (Ok(number), _) => Some(Self::Number(number)),
            (Err(_), name) => Some(Self::Name(name.to_owned())),
        }
    }

    fn place(&self, names: Option<&ColumnNames>, count: usize) -> Result<usize, Problem> {
        let found = match self {
            Self::Number(number) => number.checked_sub(1).filter(|place| *place < count),
            Self::Name(name) => names.and_then(|names| names.place_of(name)),
        };
        found.ok_or_else(|| Problem::NoSuchColumn {
            column: match self {
                Self::Number(number) => number.to_string(),
                Self::Name(name) => quoted(name),
            },
            known: columns(names, 0..count),
        })
    }
}

impl FromStr for ColumnChoice {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let picks: Option<Vec<Pick>> = text.split(',').map(Pick::of).collect();
        let choice = picks.and_then(Self::of);
        choice.ok_or(
            "2 or 3 different columns are needed, by their names or numbers from 1, as in 2,3",
        )
    }
}

/// The line of a table that names its columns.
#[derive(Clone, Debug)]
pub(super) struct ColumnNames(Vec<String>);

impl ColumnNames {
    /// Take the names from a line; a unit in brackets belongs to the name before it.
    pub(super) fn of(fields: &Fields) -> Self {
        let mut names: Vec<String> = Vec::new();
        for field in &fields.values {
            match names.last_mut() {
                Some(name) if field.starts_with(['[', '(']) && !name.is_empty() => {
                    *name += " ";
                    *name += field;
                }
                _ => names.push(field.trim_matches('"').trim().to_owned()),
            }
        }
        Self(names)
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// The name of a column, counted from 0.
    pub(super) fn get(&self, place: usize) -> Option<&str> {
        let name = self.0.get(place).map(String::as_str);
        name.filter(|name| !name.is_empty())
    }

    /// The columns x, y and, if there is one, z, counted from 0; `None` if x or y is not there once.
    pub(super) fn coordinates(&self) -> Option<Vec<usize>> {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let mut places = (0..self.count()).filter(|place| self.axis(*place) == Some(axis));
            places.next().filter(|_| places.next().is_none())
        });
        Some([x?, y?].into_iter().chain(z).collect())
    }

    /// Whether there is a column of weights.
    pub(super) fn has_weights(&self) -> bool {
        (0..self.count()).any(|place| self.axis(place) == Some(WEIGHT))
    }

    /// The word in the place of a unit in the name of a column.
    pub(super) fn unit(&self, place: usize) -> Option<&str> {
        let name = self.get(place)?;
        let unit = parts(name).map_or_else(|| bracketed(name), |(_, unit)| unit);
        unit.filter(|unit| !NO_UNIT.contains(&unit.to_lowercase().as_str()))
    }

    fn axis(&self, place: usize) -> Option<usize> {
        parts(self.get(place)?).map(|(axis, _)| axis)
    }

    fn place_of(&self, name: &str) -> Option<usize> {
        let mut whole = (0..self.count()).filter(|place| {
            let known = self.get(*place);
            known.is_some_and(|known| known.eq_ignore_ascii_case(name))
        });
        let axis = COLUMNS.iter().position(|it| it.eq_ignore_ascii_case(name));
        let mut named =
            (0..self.count()).filter(|place| axis.is_some() && self.axis(*place) == axis);
        whole.next().or_else(|| named.next())
    }
}

/// List some columns of a table, counted from 0, with their names.
pub(super) fn columns(
    names: Option<&ColumnNames>,
    places: impl IntoIterator<Item = usize>,
) -> Vec<TableColumn> {
    let column = |place: usize| TableColumn {
        number: place + 1,
        name: names.and_then(|names| names.get(place)).map(str::to_owned),
    };
    places.into_iter().map(column).collect()
}

/// Take a name such as `x`, `x/c`, `X [mm]`, `y(m)` or `z_in` apart: which of [`COLUMNS`] it is, and the word
/// in the place of a unit.
fn parts(name: &str) -> Option<(usize, Option<&str>)> {
    let name = name.trim();
    COLUMNS.iter().enumerate().find_map(|(axis, column)| {
        let (start, rest) = name.split_at_checked(column.len())?;
        if !start.eq_ignore_ascii_case(column) {
            return None;
        }
        let is_bracket = rest.trim_start().starts_with(['[', '(']);
        let unit = bracketed(rest).filter(|_| is_bracket);
        let unit = unit.or_else(|| rest.strip_prefix('/'));
        let bare = rest.strip_prefix(['_', ' ']);
        let unit = unit.or_else(|| bare.filter(|it| LengthUnit::of_symbol(it).is_some()));
        match (rest, unit) {
            ("", _) => Some((axis, None)),
            (_, Some(unit)) if !unit.contains(' ') => Some((axis, Some(unit.trim()))),
            _ => None,
        }
    })
}

/// The word in brackets at the end of a name.
fn bracketed(name: &str) -> Option<&str> {
    let (_, word) = name.rsplit_once(['[', '('])?;
    Some(word.strip_suffix([']', ')'])?.trim())
}

/// Find the [`COLUMNS`] of a table of vertices, each by its plain name.
///
/// # Errors
/// [`Problem`] if a name is unknown or there twice, or x or y is missing.
pub(super) fn vertex_columns(names: &[Cow<str>]) -> Result<Vec<usize>, Problem> {
    let mut columns = Vec::with_capacity(COLUMNS.len());
    for name in names {
        let known = COLUMNS
            .iter()
            .position(|column| name.eq_ignore_ascii_case(column));
        match known {
            Some(column) if !columns.contains(&column) => columns.push(column),
            _ if columns.is_empty() && name.parse::<f64>().is_ok() => {
                return Err(Problem::NoColumns);
            }
            _ => return Err(Problem::BadColumn(name.to_string())),
        }
    }
    for needed in [0, 1] {
        if !columns.contains(&needed) {
            return Err(Problem::MissingColumn(COLUMNS[needed]));
        }
    }
    Ok(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_taken_apart_into_axis_and_unit() {
        for (name, expected) in [
            ("x", Some((0, None))),
            ("X [mm]", Some((0, Some("mm")))),
            ("y(m)", Some((1, Some("m")))),
            ("z_in", Some((2, Some("in")))),
            ("y/c", Some((1, Some("c")))),
            ("x mm", Some((0, Some("mm")))),
            ("Weight", Some((3, None))),
            ("x velocity", None),
            ("xy", None),
            ("chord", None),
            ("ξ", None),
        ] {
            assert_eq!(parts(name), expected, "{name}");
        }
        let names = |line| ColumnNames::of(&Fields::of(line, ' '));
        assert_eq!(names("X (mm) Y (mm) note").coordinates(), Some(vec![0, 1]));
        assert_eq!(names("X (mm) Y (mm)").unit(1), Some("mm"));
        assert_eq!(names("x/c y/c").unit(0), None);
        assert_eq!(names("x x y").coordinates(), None);
    }

    #[test]
    fn a_choice_is_of_two_or_three_different_columns() {
        for text in ["2", "1,2,3,4", "1,1", "0,1", "1,", ""] {
            assert!(text.parse::<ColumnChoice>().is_err(), "{text}");
        }
        let names = ColumnNames::of(&Fields::of("s;X [mm];half breadth", ';'));
        let places = |text: &str| {
            let choice: ColumnChoice = text.parse().unwrap();
            choice.places(Some(&names), 3)
        };
        assert_eq!(places("2,3"), Ok(vec![1, 2]));
        assert_eq!(places("Half Breadth, x"), Ok(vec![2, 1]));
        let missing = places("1,4").unwrap_err().to_string();
        assert_eq!(
            missing,
            "the table has no column 4: it has 1 “s”, 2 “X [mm]”, 3 “half breadth”"
        );
    }
}
