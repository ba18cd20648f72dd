//! Transforms, and the fitting of view boxes.

use glam::{DMat3, DVec3};
use svgtypes::{Align, AspectRatio, TransformListParser, TransformListToken, ViewBox};

use crate::io::exchange::drawing::Affine;

/// Read a `transform` attribute: its transforms up to the first error, and the error.
pub(super) fn transform(text: &str) -> (Affine, Option<svgtypes::Error>) {
    let mut place = Affine::default();
    for token in TransformListParser::from(text) {
        match token {
            Ok(token) => place = place.of(&single(token)),
            Err(error) => return (place, Some(error)),
        }
    }
    (place, None)
}

/// Make the transform (x, y) ↦ (a·x + c·y + e, b·x + d·y + f).
pub(super) fn matrix([a, b, c, d, e, f]: [f64; 6]) -> Affine {
    Affine {
        linear: DMat3::from_cols(DVec3::new(a, b, 0.0), DVec3::new(c, d, 0.0), DVec3::Z),
        origin: DVec3::new(e, f, 0.0),
    }
}

/// Make the transform from a view box into a viewport of a width and a height.
pub(super) fn fit(view: ViewBox, (width, height): (f64, f64), aspect: AspectRatio) -> Affine {
    let (mut x, mut y) = (width / view.w, height / view.h);
    if aspect.align != Align::None {
        let both = if aspect.slice { x.max(y) } else { x.min(y) };
        (x, y) = (both, both);
    }
    let (across, up) = alignment(aspect.align);
    let left = across * (width - view.w * x) - view.x * x;
    let top = up * (height - view.h * y) - view.y * y;
    matrix([x, 0.0, 0.0, y, left, top])
}

fn single(token: TransformListToken) -> Affine {
    match token {
        TransformListToken::Matrix { a, b, c, d, e, f } => matrix([a, b, c, d, e, f]),
        TransformListToken::Translate { tx, ty } => matrix([1.0, 0.0, 0.0, 1.0, tx, ty]),
        TransformListToken::Scale { sx, sy } => matrix([sx, 0.0, 0.0, sy, 0.0, 0.0]),
        TransformListToken::Rotate { angle } => {
            let (sin, cos) = sin_cos_degrees(angle);
            matrix([cos, sin, -sin, cos, 0.0, 0.0])
        }
        TransformListToken::SkewX { angle } => {
            matrix([1.0, 0.0, angle.to_radians().tan(), 1.0, 0.0, 0.0])
        }
        TransformListToken::SkewY { angle } => {
            matrix([1.0, angle.to_radians().tan(), 0.0, 1.0, 0.0, 0.0])
        }
    }
}

/// Get sine and cosine of an angle in degrees, exactly at quarter turns.
pub(super) fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    match angle.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => angle.to_radians().sin_cos(),
    }
}

/// Which share of the space left over is put to the left and above.
fn alignment(align: Align) -> (f64, f64) {
    match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    }
}
