//! Positions on the earth in metres: GPS devices and tables give latitude and longitude.
//!
//! Positions go to the plane that touches the WGS 84 ellipsoid in their middle, x to the east and y to the
//! north, by orthogonal projection: 1 m is lost at 60 km from the middle. Elevations are left out.

use glam::{DMat3, DVec3};

use super::error::Problem;

/// The semi-major axis of the ellipsoid in metres.
const EQUATOR: f64 = 6_378_137.0;

/// The flattening of the ellipsoid.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// The position at a latitude and a longitude in degrees, in metres from the centre of the earth.
///
/// # Errors
/// [`Problem::NoPosition`] for what is missing or out of range.
pub(super) fn position(latitude: Option<f64>, longitude: Option<f64>) -> Result<DVec3, Problem> {
    let angle = |degrees: Option<f64>, name: &'static str, most: f64| {
        let degrees = degrees.filter(|degrees| degrees.abs() <= most);
        let angle = degrees.map(f64::to_radians);
        angle.ok_or(Problem::NoPosition { name, most })
    };
    let latitude = angle(latitude, "latitude", 90.0)?;
    Ok(on_ellipsoid(
        latitude,
        angle(longitude, "longitude", 180.0)?,
    ))
}

/// The point of the ellipsoid at a latitude and a longitude in radians.
fn on_ellipsoid(latitude: f64, longitude: f64) -> DVec3 {
    let squeezed = (1.0 - FLATTENING).powi(2);
    let (sine, cosine) = latitude.sin_cos();
    let normal = EQUATOR / (cosine * cosine + squeezed * sine * sine).sqrt();
    let (east, north) = longitude.sin_cos();
    DVec3::new(cosine * north, cosine * east, squeezed * sine) * normal
}

/// The plane that touches the ellipsoid at a place.
pub(super) struct TangentPlane {
    /// The latitude of the place, in radians.
    pub(super) latitude: f64,
    /// The longitude.
    pub(super) longitude: f64,
    origin: DVec3,
    /// East, north and up, as columns.
    axes: DMat3,
}

impl TangentPlane {
    /// Touch the ellipsoid in the direction of a vector from the centre of the earth; `None` if it is 0.
    pub(super) fn below(middle: DVec3) -> Option<Self> {
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
            origin: on_ellipsoid(latitude, longitude),
            axes: DMat3::from_cols(axes[0], axes[1], axes[2]),
        })
    }

    /// Project a position along the normal of the plane, x to the east and y to the north.
    pub(super) fn point(&self, position: DVec3) -> DVec3 {
        let [east, north, _] = (self.axes.transpose() * (position - self.origin)).to_array();
        DVec3::new(east, north, 0.0)
    }
}
