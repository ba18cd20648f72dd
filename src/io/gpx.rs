//! Tracks and routes of GPS devices in GPX, read only: each makes a list of points in metres.

use roxmltree::{Document, Node};

use super::error::{Place, Problem, ReadError};
use super::format::{FileUnit, Format};
use super::reading::Reading;
use super::table_points::{PointReader, Row};
use super::tangent_plane::position;
use super::text::{Lines, text};
use crate::document::escaped;
use crate::geometry::expressions::LengthUnit;

/// The row of the table of formats.
pub static GPX: Format = Format {
    name: "GPX",
    extensions: &["gpx"],
    read: Some(read),
    read_chosen: None,
    draw: None,
    write: None,
    write_back: None,
    rewrite: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[],
};

/// The points of a route, or of a segment of a track.
struct Path {
    line: usize,
    name: Option<String>,
    /// The positions in metres from the centre of the earth.
    rows: Vec<Row>,
}

/// Read the tracks and routes.
///
/// # Errors
/// [`ReadError`] with the line where the XML is malformed or a point has no position, or if there is
/// neither a track nor a route.
fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    let document = Document::parse(text(bytes)?).map_err(|error| {
        let place = Place {
            line: Some(error.pos().row as usize),
            column: Some(error.pos().col as usize),
            ..Place::default()
        };
        place.problem(Problem::Xml(escaped(&error.to_string())))
    })?;
    let lines = Lines::of(document.input_text());
    let root = document.root_element();
    if root.tag_name().name() != "gpx" {
        return Err(Problem::NotGpx(root.tag_name().name().to_owned()).into());
    }
    let mut paths = Vec::new();
    for path in root.children() {
        match path.tag_name().name() {
            "rte" => paths.push(Path::of(path, path, "rtept", &lines)?),
            "trk" => {
                let segments = path
                    .children()
                    .filter(|it| it.tag_name().name() == "trkseg");
                for segment in segments {
                    paths.push(Path::of(path, segment, "trkpt", &lines)?);
                }
            }
            _ => {}
        }
    }
    let mut points = PointReader::new(None, ' ', Some(LengthUnit::Metre));
    for path in paths {
        match path.rows.len() {
            0 | 1 => points.skip(path.line),
            _ => points.add(path.line, path.name, path.rows, true),
        }
    }
    let mut reading = Reading::default();
    points.finish(&mut reading)?;
    match reading.is_empty() {
        true => Err(Problem::NoTrack.into()),
        false => Ok(reading),
    }
}

impl Path {
    /// Take the points of a track's segment or of a route, which has the name.
    fn of(named: Node, path: Node, points: &str, lines: &Lines) -> Result<Self, ReadError> {
        let mut names = named.children().filter(|it| it.tag_name().name() == "name");
        let name = names.next().and_then(|it| it.text()).map(str::trim);
        let points = path.children().filter(|it| it.tag_name().name() == points);
        Ok(Self {
            line: line(path, lines),
            name: name.filter(|name| !name.is_empty()).map(str::to_owned),
            rows: points
                .map(|point| row(point, lines))
                .collect::<Result<_, _>>()?,
        })
    }
}

fn line(node: Node, lines: &Lines) -> usize {
    lines.number(node.range().start)
}

fn row(point: Node, lines: &Lines) -> Result<Row, ReadError> {
    let line = line(point, lines);
    let degrees = |attribute: &str| point.attribute(attribute)?.trim().parse().ok();
    let point = position(degrees("lat"), degrees("lon"));
    let point = point.map_err(|problem| Place::line(line).problem(problem))?;
    Ok(Row {
        line,
        point,
        weight: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRACK: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1">
  <wpt lat="10" lon="10"><name>no point of a track</name></wpt>
  <trk><name>Bay</name>
    <trkseg>
      <trkpt lat="54.0" lon="10.0"><ele>3</ele></trkpt>
      <trkpt lat="54.0" lon="10.01"/>
      <trkpt lat="54.0" lon="10.01"/>
      <trkpt lat="54.01" lon="10.01"/>
    </trkseg>
    <trkseg><trkpt lat="54.0" lon="10.0"/></trkseg>
  </trk>
  <rte><rtept lat="54.0" lon="10.0"/><rtept lat="54.01" lon="10.0"/></rte>
</gpx>"#;

    #[test]
    fn tracks_and_routes_are_read_in_metres() {
        let reading = GPX.read(TRACK.as_bytes()).unwrap();
        assert_eq!(reading.unit, Some(LengthUnit::Metre));
        let names: Vec<&str> = reading
            .references
            .iter()
            .map(|it| it.name.as_str())
            .collect();
        assert_eq!(names, ["Bay", "points 2"]);
        let points = reading.references[0].points().unwrap();
        assert_eq!(points.len(), 3);
        assert!(points.iter().all(|point| point.z == 0.0));
        // Radii of curvature of WGS 84 at 54° N: 6 392 157.5 m east-west, 6 377 342.2 m north-south.
        let east = 6_392_157.5 * 54_f64.to_radians().cos() * 0.01_f64.to_radians();
        let north = 6_377_342.2 * 0.01_f64.to_radians();
        assert!(
            (points[0].distance(points[1]) - east).abs() < 0.01,
            "{points:?}"
        );
        assert!(
            (points[1].distance(points[2]) - north).abs() < 0.01,
            "{points:?}"
        );
        assert!(points[1].x > points[0].x && points[2].y > points[1].y);
        let told = reading.remarks.to_string();
        assert!(
            told.contains("x east and y north of latitude 54.00"),
            "{told}"
        );
        assert!(told.contains("line 8 was left out"), "{told}");
        assert!(told.contains("line 11 was skipped"), "{told}");
    }

    #[test]
    fn what_is_no_track_is_refused_with_its_place() {
        let check = |text: &str, expected: &str| {
            let error = GPX.read(text.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        };
        check("<gpx>\n<trk></gpx>", "line 2, column 6: expected");
        check("<kml/>", "this is not a GPX file: it begins with <kml>");
        check("<gpx/>", "there is no track and no route");
        check(
            "<gpx><rte>\n<rtept lat=\"91\" lon=\"0\"/></rte></gpx>",
            "line 2: a point needs a latitude, a number from -90 to 90",
        );
        check(
            "<gpx><rte>\n<rtept lat=\"9\"/></rte></gpx>",
            "line 2: a point needs a longitude, a number from -180 to 180",
        );
    }
}
