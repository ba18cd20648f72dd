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

/// The names of coordinates x, y and, in space, z, in the order of preference.
const COORDINATES: [[&[&str]; 3]; 2] = [
    [&["x"], &["y"], &["z"]],
    [&["easting"], &["northing"], &["elevation", "z"]],
];

/// The names of longitude and latitude, in degrees.
const POSITION: [&[&str]; 2] = [&["lon", "long", "lng", "longitude"], &["lat", "latitude"]];

/// What stands behind the names of longitude and latitude: degrees, and the sense in which they grow.
const DEGREES: [&str; 5] = ["deg", "degree", "degrees", "°", "dd"];
const SENSES: [(&str, f64); 8] = [
    ("north", 1.0),
    ("n", 1.0),
    ("east", 1.0),
    ("e", 1.0),
    ("south", -1.0),
    ("s", -1.0),
    ("west", -1.0),
    ("w", -1.0),
];

/// Units of length that documents do not have, as lines below names spell them.
const OTHER_LENGTHS: [&str; 17] = [
    "ft",
    "feet",
    "foot",
    "inch",
    "inches",
    "um",
    "µm",
    "μm",
    "nm",
    "mil",
    "yd",
    "km",
    "px",
    "pt",
    "millimeter",
    "millimetre",
    "meter",
];

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

/// Whether a line below names of columns has their units: there is one of length, and no number.
pub(super) fn are_units(fields: &Fields, names: &ColumnNames) -> bool {
    let is_length = |field: &Cow<str>| {
        let unit = unbracketed(field).to_lowercase();
        LengthUnit::of_symbol(&unit).is_some() || OTHER_LENGTHS.contains(&unit.as_str())
    };
    !fields.have_numbers(1)
        && fields.values.len() <= names.count()
        && fields.values.iter().any(is_length)
        && names.coordinates().is_some()
        && ColumnNames::of(fields).coordinates().is_none()
}

/// The inside of a text in brackets; any other text as it is.
fn unbracketed(text: &str) -> &str {
    let inside = text.strip_prefix(['[', '(']);
    let inside = inside.and_then(|it| it.strip_suffix([']', ')']));
    inside.unwrap_or(text).trim()
}

/// The columns of the coordinates of points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Coordinates {
    /// The columns of x, y and, in space, z, counted from 0.
    pub(super) places: Vec<usize>,
    /// The signs of x and y where they are longitude and latitude in degrees: east and north count positive.
    pub(super) on_earth: Option<[f64; 2]>,
}

impl Coordinates {
    /// Coordinates that are lengths.
    pub(super) fn of_lengths(places: Vec<usize>) -> Self {
        Self {
            places,
            on_earth: None,
        }
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

    /// Put the units of a line below the names behind them.
    pub(super) fn with_units(mut self, units: &Fields) -> Self {
        for (name, unit) in self.0.iter_mut().zip(&units.values) {
            let unit = unbracketed(unit);
            if !unit.is_empty() && !name.is_empty() {
                *name += &format!(" [{unit}]");
            }
        }
        self
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

    /// The columns of coordinates by their names; `None` if no two of them are there once.
    pub(super) fn coordinates(&self) -> Option<Coordinates> {
        let lengths = COORDINATES.iter().find_map(|[x, y, z]| {
            let plane = [self.only(x)?, self.only(y)?].into_iter();
            Some(plane.chain(self.only(z)).collect())
        });
        let lengths = lengths.map(Coordinates::of_lengths);
        lengths.or_else(|| {
            let [longitude, latitude] = POSITION.map(|words| self.only(words));
            let [longitude, latitude] = [longitude?, latitude?];
            let signs = [
                self.sign_of_degrees(longitude)?,
                self.sign_of_degrees(latitude)?,
            ];
            Some(Coordinates {
                places: vec![longitude, latitude],
                on_earth: Some(signs),
            })
        })
    }

    /// The only column with one of some names.
    fn only(&self, words: &[&str]) -> Option<usize> {
        let is_named = |place: &usize| {
            let name = self.get(*place);
            name.is_some_and(|name| words.iter().any(|word| unit_behind(name, word).is_some()))
        };
        let mut places = (0..self.count()).filter(is_named);
        places.next().filter(|_| places.next().is_none())
    }

    /// The sign of the degrees in a column; `None` if it has another unit.
    fn sign_of_degrees(&self, place: usize) -> Option<f64> {
        self.unit(place).map_or(Some(1.0), sign_of_degrees)
    }

    /// Whether there is a column of weights.
    pub(super) fn has_weights(&self) -> bool {
        (0..self.count()).any(|place| self.axis(place) == Some(WEIGHT))
    }

    /// The word in the place of a unit in the name of a column.
    pub(super) fn unit(&self, place: usize) -> Option<&str> {
        let name = self.get(place)?;
        let words = COORDINATES.as_flattened().iter().chain(&POSITION);
        let mut words = words.copied().flatten().chain([&COLUMNS[WEIGHT]]);
        let unit = words.find_map(|word| unit_behind(name, word));
        let unit = unit.unwrap_or_else(|| bracketed(name));
        unit.filter(|unit| !NO_UNIT.contains(&unit.to_lowercase().as_str()))
    }

    fn axis(&self, place: usize) -> Option<usize> {
        let name = self.get(place)?;
        let mut words = COLUMNS.iter();
        words.position(|word| unit_behind(name, word).is_some())
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

/// Take a name such as `x`, `x/c`, `X [mm]`, `y(m)` or `z_in` apart: the word in the place of a unit, which may be
/// left out, behind a word; `None` if the name is another one.
fn unit_behind<'a>(name: &'a str, word: &str) -> Option<Option<&'a str>> {
    let (start, rest) = name.trim().split_at_checked(word.len())?;
    if !start.eq_ignore_ascii_case(word) {
        return None;
    }
    let is_bracket = rest.trim_start().starts_with(['[', '(']);
    let unit = bracketed(rest).filter(|_| is_bracket);
    let unit = unit.or_else(|| rest.strip_prefix('/'));
    let bare = rest.strip_prefix(['_', ' ']);
    let unit = unit.or_else(|| bare.filter(|it| is_unit(it)));
    match (rest, unit) {
        ("" | ".", _) => Some(None),
        (_, Some(unit)) if !unit.contains(' ') || is_unit(unit) => Some(Some(unit.trim())),
        _ => None,
    }
}

/// Whether a word is a unit of length, or degrees.
fn is_unit(word: &str) -> bool {
    let is_sense = SENSES
        .iter()
        .any(|(sense, _)| word.eq_ignore_ascii_case(sense));
    LengthUnit::of_symbol(word).is_some() || (!is_sense && sign_of_degrees(word).is_some())
}

/// The sign of degrees such as `deg`, `N`, `°N`, `deg W` or `degrees_east`: those to the south and to the west count
/// negative. `None` for another unit.
fn sign_of_degrees(unit: &str) -> Option<f64> {
    let unit = unit.to_lowercase();
    let sense = SENSES.iter().find_map(|(sense, sign)| {
        let degrees = unit.strip_suffix(sense)?.trim_end_matches([' ', '_']);
        (degrees.is_empty() || DEGREES.contains(&degrees)).then_some(*sign)
    });
    sense.or_else(|| DEGREES.contains(&unit.as_str()).then_some(1.0))
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
        for (word, name, expected) in [
            ("x", "x", Some(None)),
            ("x", "X [mm]", Some(Some("mm"))),
            ("y", "y(m)", Some(Some("m"))),
            ("z", "z_in", Some(Some("in"))),
            ("y", "y/c", Some(Some("c"))),
            ("x", "x mm", Some(Some("mm"))),
            ("weight", "Weight", Some(None)),
            ("lat", "Lat_deg", Some(Some("deg"))),
            ("lat", "lateral", None),
            ("x", "x velocity", None),
            ("x", "xy", None),
            ("x", "chord", None),
            ("x", "ξ", None),
        ] {
            assert_eq!(unit_behind(name, word), expected, "{name}");
        }
        let names = |line| ColumnNames::of(&Fields::of(line, ' '));
        let places = |line| names(line).coordinates().map(|it| it.places);
        assert_eq!(places("X (mm) Y (mm) note"), Some(vec![0, 1]));
        assert_eq!(names("X (mm) Y (mm)").unit(1), Some("mm"));
        assert_eq!(names("x/c y/c").unit(0), None);
        assert_eq!(places("x x y"), None);
    }

    #[test]
    fn longitude_and_latitude_are_told_by_their_names() {
        let told = |line| ColumnNames::of(&Fields::of(line, ',')).coordinates();
        for line in [
            "lat,lon",
            "LATITUDE,Longitude",
            "lat [deg],long (°)",
            "lat_deg,lng_deg,ele",
            "\"Lat.\",\"Lon.\"",
            "Latitude (deg N),Longitude (deg E)",
            "latitude [degrees_north],longitude [degrees_east]",
            "Latitude (N),Longitude (E)",
        ] {
            let found = told(line).unwrap_or_else(|| panic!("{line}"));
            assert_eq!(found.places, [1, 0]);
            assert_eq!(found.on_earth, Some([1.0, 1.0]));
        }
        for line in [
            "lat [m],lon [m]",
            "lat,lat,lon",
            "lateral,longitudinal",
            "lat (rad),lon (rad)",
        ] {
            assert_eq!(told(line), None, "{line}");
        }
        // Who has projected the positions already has done so for a reason.
        let both = told("lat,lon,x,y").map(|it| (it.places, it.on_earth));
        assert_eq!(both, Some((vec![2, 3], None)));
        let west = told("Latitude (N),Longitude (W)").and_then(|it| it.on_earth);
        assert_eq!(west, Some([-1.0, 1.0]));
        let south = told("lat (°S),lon (deg)").and_then(|it| it.on_earth);
        assert_eq!(south, Some([1.0, -1.0]));
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
