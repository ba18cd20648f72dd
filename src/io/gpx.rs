//! Tracks and routes of GPS devices in GPX, read only: each makes a list of points in metres.
//!
//! Positions go to the plane that touches the WGS 84 ellipsoid in their middle, x to the east and y to the
//! north, by orthogonal projection: 1 m is lost at 60 km from the middle. Elevations are left out.

use glam::{DMat3, DVec3};
use roxmltree::{Document, Node};

use super::error::{Place, Problem, ReadError};
use super::format::Format;
use super::reading::{Reading, Remark};
use super::table_points::{PointReader, Row};
use super::text::text;
use crate::document::escaped;
use crate::geometry::expressions::LengthUnit;

/// The row of the table of formats.
pub static GPX: Format = Format {
    name: "GPX",
    extensions: &["gpx"],
    read: Some(read),
    read_chosen: None,
    write: None,
    holds_documents: false,
    exports: &[],
};

/// The semi-major axis of the ellipsoid in metres.
const EQUATOR: f64 = 6_378_137.0;

/// The flattening of the ellipsoid.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

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
    let root = document.root_element();
    if root.tag_name().name() != "gpx" {
        return Err(Problem::NotGpx(root.tag_name().name().to_owned()).into());
    }
    let mut paths = Vec::new();
    for path in root.children() {
        match path.tag_name().name() {
            "rte" => paths.push(Path::of(path, path, "rtept")?),
            "trk" => {
                let segments = path
                    .children()
                    .filter(|it| it.tag_name().name() == "trkseg");
                for segment in segments {
                    paths.push(Path::of(path, segment, "trkpt")?);
                }
            }
            _ => {}
        }
    }
    let rows = paths.iter().flat_map(|path| &path.rows);
    let sum: DVec3 = rows.map(|row| row.point).sum();
    let Some(plane) = TangentPlane::below(sum) else {
        return Err(Problem::NoTrack.into());
    };
    let mut points = PointReader::new(None, ' ', Some(LengthUnit::Metre));
    for mut path in paths {
        path.rows
            .iter_mut()
            .for_each(|row| row.point = plane.point(row.point));
        match path.rows.len() {
            0 | 1 => points.skip(path.line),
            _ => points.add(path.line, path.name, path.rows)?,
        }
    }
    let mut reading = Reading::default();
    let [latitude, longitude] = [plane.latitude, plane.longitude].map(f64::to_degrees);
    reading.remarks.add(Remark::TangentPlane {
        latitude,
        longitude,
    });
    points.finish(&mut reading);
    match reading.is_empty() {
        true => Err(Problem::NoTrack.into()),
        false => Ok(reading),
    }
}

impl Path {
    /// Take the points of a track's segment or of a route, which has the name.
    fn of(named: Node, path: Node, points: &str) -> Result<Self, ReadError> {
        let mut names = named.children().filter(|it| it.tag_name().name() == "name");
        let name = names.next().and_then(|it| it.text()).map(str::trim);
        let points = path.children().filter(|it| it.tag_name().name() == points);
        Ok(Self {
            line: line(path),
            name: name.filter(|name| !name.is_empty()).map(str::to_owned),
            rows: points.map(row).collect::<Result<_, _>>()?,
        })
    }
}

fn line(node: Node) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

fn row(point: Node) -> Result<Row, ReadError> {
    let line = line(point);
    let degrees = |attribute: &str, name: &'static str, most: f64| {
        let value = point
            .attribute(attribute)
            .and_then(|it| it.trim().parse().ok());
        let value = value.filter(|value: &f64| value.abs() <= most);
        value.ok_or_else(|| Place::line(line).problem(Problem::NoPosition { name, most }))
    };
    let latitude = degrees("lat", "latitude", 90.0)?;
    let longitude = degrees("lon", "longitude", 180.0)?;
    let point = position(latitude.to_radians(), longitude.to_radians());
    Ok(Row {
        line,
        point,
        weight: None,
    })
}

/// The point of the ellipsoid at a latitude and a longitude, in metres from the centre of the earth.
fn position(latitude: f64, longitude: f64) -> DVec3 {
    let squeezed = (1.0 - FLATTENING).powi(2);
    let (sine, cosine) = latitude.sin_cos();
    let normal = EQUATOR / (cosine * cosine + squeezed * sine * sine).sqrt();
    let (east, north) = longitude.sin_cos();
    DVec3::new(cosine * north, cosine * east, squeezed * sine) * normal
}

/// The plane that touches the ellipsoid at a place.
struct TangentPlane {
    latitude: f64,
    longitude: f64,
    origin: DVec3,
    /// East, north and up, as columns.
    axes: DMat3,
}

impl TangentPlane {
    /// Touch the ellipsoid in the direction of a vector from the centre of the earth; `None` if it is 0.
    fn below(middle: DVec3) -> Option<Self> {
        let middle = middle.try_normalize()?;
        let squeezed = (1.0 - FLATTENING).powi(2);
        let latitude = middle.z.atan2(squeezed * middle.truncate().length());
        let longitude = middle.y.atan2(middle.x);
        let ((s, c), (east, north)) = (latitude.sin_cos(), longitude.sin_cos());
        let axes = [
            DVec3::new(-east, north, 0.0),
            DVec3::new(-s * north, -s * east, c),
            DVec3::new(c * north, c * east, s),
        ];
        Some(Self {
            latitude,
            longitude,
            origin: position(latitude, longitude),
            axes: DMat3::from_cols(axes[0], axes[1], axes[2]),
        })
    }

    fn point(&self, position: DVec3) -> DVec3 {
        let [east, north, _] = (self.axes.transpose() * (position - self.origin)).to_array();
        DVec3::new(east, north, 0.0)
    }
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
