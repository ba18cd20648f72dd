//! Tracks and routes of GPS devices in GPX, read only: each makes a list of points in metres.

use roxmltree::Node;

use super::error::{Place, Problem, ReadError};
use super::exchange::short_names::short;
use super::format::{FileUnit, Format};
use super::reading::{Reading, Remark};
use super::table_points::{PointReader, Row};
use super::tangent_plane::position;
use super::xml::Source;
use crate::geometry::counted;
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
    let source = Source::new(bytes).map_err(|error| error.into_error(false))?;
    let document = source.document().map_err(|error| error.into_error(false))?;
    let root = document.root_element();
    if root.tag_name().name() != "gpx" {
        return Err(Problem::NotGpx(root.tag_name().name().to_owned()).into());
    }
    let (mut paths, mut bad) = (Vec::new(), Vec::new());
    for path in root.children() {
        let name = name(path);
        match path.tag_name().name() {
            "rte" => paths.push(Path::of(path, name, "rtept", &source, &mut bad)),
            "trk" => {
                for segment in named(path, "trkseg") {
                    paths.push(Path::of(segment, name, "trkpt", &source, &mut bad));
                }
            }
            _ => {}
        }
    }
    let mut points = PointReader::new(None, ' ', Some(LengthUnit::Metre), bytes.len());
    for path in paths {
        match path.rows.len() {
            0 | 1 => points.skip(path.line),
            _ => points.add(path.line, path.name, path.rows, true)?,
        }
    }
    let mut reading = Reading::default();
    for told in &source.remarks {
        reading.remarks.add(Remark::Drawn(told.clone()));
    }
    points.finish(&mut reading)?;
    for error in &bad {
        let told = format!("{error}: it is left out");
        reading.remarks.add(Remark::Drawn(told));
    }
    let places = named(root, "wpt").count();
    if places > 0 {
        let places = counted(places, "waypoint", "waypoints");
        let told = format!("{places} left out: only tracks and routes are read");
        reading.remarks.add(Remark::Drawn(told));
    }
    if let (true, Some(first)) = (reading.is_empty(), bad.into_iter().next()) {
        return Err(first);
    }
    match (reading.is_empty(), source.remarks.first()) {
        (false, _) => Ok(reading),
        (true, Some(damage)) => Err(Problem::Drawing(damage.clone()).into()),
        (true, None) => Err(Problem::NoTrack.into()),
    }
}

impl Path {
    /// Take the points of a track's segment or of a route, but those that are bad.
    fn of(
        path: Node,
        name: Option<&str>,
        points: &str,
        source: &Source,
        bad: &mut Vec<ReadError>,
    ) -> Self {
        let rows = named(path, points).map(|point| row(point, source));
        let rows = rows.filter_map(|row| row.map_err(|error| bad.push(error)).ok());
        Self {
            line: source.line_of(path) as usize,
            name: name.map(short),
            rows: rows.collect(),
        }
    }
}

/// The elements of a name in another one.
fn named<'a, 'input>(node: Node<'a, 'input>, name: &str) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children()
        .filter(move |it| it.tag_name().name() == name)
}

/// The name of a track or a route.
fn name<'a>(path: Node<'a, '_>) -> Option<&'a str> {
    let name = named(path, "name").next()?.text()?.trim();
    (!name.is_empty()).then_some(name)
}

fn row(point: Node, source: &Source) -> Result<Row, ReadError> {
    let line = source.line_of(point) as usize;
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
    <trkseg><trkpt lat="54.0" lon="10.0"/><trkpt lat="54.0" lon="10.0"/></trkseg>
  </trk>
  <rte><rtept lat="54.0" lon="10.0"/><rtept lat="54.01" lon="10.0"/></rte>
</gpx>"#;

    #[test]
    fn a_track_that_is_cut_off_is_read_in_part() {
        let text = &TRACK[..TRACK.find("<trkpt lat=\"54.01\"").unwrap() + 12];
        let reading = GPX.read(text.as_bytes()).unwrap();
        let points = reading.references[0].points().unwrap();
        assert_eq!(points.len(), 2);
        let told = reading.remarks.to_string();
        assert!(told.contains("line 8: the file is damaged"), "{told}");
    }

    #[test]
    fn tracks_and_routes_are_read_in_metres() {
        let reading = GPX.read(TRACK.as_bytes()).unwrap();
        assert_eq!(reading.unit, Some(LengthUnit::Metre));
        let names: Vec<&str> = reading
            .references
            .iter()
            .map(|it| it.name.as_str())
            .collect();
        assert_eq!(names, ["Bay", "points 3"]);
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
        assert!(told.contains("lines 8 and 12 were left out"), "{told}");
        assert!(told.contains("line 11 was skipped"), "{told}");
        assert!(told.contains("1 waypoint left out"), "{told}");
        let bad = TRACK.replacen("54.01", "north", 1);
        let reading = GPX.read(bad.as_bytes()).unwrap();
        assert_eq!(reading.references[0].points().unwrap().len(), 2);
        let told = reading.remarks.to_string();
        assert!(told.contains("line 9: a point needs a latitude"), "{told}");
    }

    #[test]
    fn what_is_no_track_is_refused_with_its_place() {
        let check = |text: &str, expected: &str| {
            let error = GPX.read(text.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        };
        check(
            "<gpx>\n<trk></gpx>",
            "line 2: the file is damaged (expected",
        );
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
