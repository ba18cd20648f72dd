//! Conics in a plane of their own, as types 100 and 104 need them.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DMat3, DVec3};

use crate::io::exchange::drawing::{Affine, Conic};

/// How far axes may differ from perpendicular or alike, relative to them.
const ROUNDING: f64 = 4.0e-15;

/// An arc by its half-axes along the first two axes of a placement.
pub(super) struct Frame {
    /// The placement: right-handed unit axes, and the centre.
    pub place: Affine,
    /// The half-axes.
    pub halves: [f64; 2],
    /// The first and last parameter.
    pub range: [f64; 2],
}

impl Frame {
    /// Find the frame of a conic; `None` where it has no plane.
    pub fn of(conic: &Conic) -> Option<Self> {
        let (conic, size) = (principal(conic), conic.x.length().max(conic.y.length()));
        let halves = [conic.x.length(), conic.y.length()];
        let (x, y) = (conic.x / halves[0], conic.y / halves[1]);
        let normal = x.cross(y).try_normalize()?;
        if !(halves[0].min(halves[1]) > 0.0) || !size.is_finite() {
            return None;
        }
        Some(Self {
            place: Affine {
                linear: DMat3::from_cols(x, normal.cross(x), normal),
                origin: conic.centre,
            },
            halves,
            range: [conic.from, conic.to],
        })
    }

    /// Say whether the conic is a circle.
    pub fn is_circle(&self) -> bool {
        (self.halves[0] - self.halves[1]).abs() <= ROUNDING * self.halves[0]
    }

    /// Say whether the conic closes.
    pub fn is_whole(&self) -> bool {
        self.range[1] - self.range[0] >= TAU * (1.0 - 1.0e-15)
    }

    /// The ends in the frame: start and end.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        let end = |t: f64| [self.halves[0] * t.cos(), self.halves[1] * t.sin()];
        let start = end(self.range[0]);
        [
            start,
            if self.is_whole() {
                start
            } else {
                end(self.range[1])
            },
        ]
    }
}

/// Turn conjugate half-axes into perpendicular ones, the longer one first: OpenCascade misreads others.
fn principal(conic: &Conic) -> Conic {
    let (x, y) = (conic.x, conic.y);
    let angle = if x.dot(y).abs() > ROUNDING * x.length() * y.length() {
        0.5 * (2.0 * x.dot(y)).atan2(x.length_squared() - y.length_squared())
    } else if y.length() > x.length() * (1.0 + ROUNDING) {
        return Conic {
            x: y,
            y: -x,
            from: conic.from - FRAC_PI_2,
            to: conic.to - FRAC_PI_2,
            ..*conic
        };
    } else {
        return conic.clone();
    };
    let (sine, cosine) = angle.sin_cos();
    let turned = |a: DVec3, b: DVec3| a * cosine + b * sine;
    Conic {
        centre: conic.centre,
        x: turned(x, y),
        y: turned(y, -x),
        from: conic.from - angle,
        to: conic.to - angle,
    }
}
