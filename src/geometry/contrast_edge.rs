//! The edge of contrast near a place of a picture, between pixels.
//!
//! The brightness is smoothed by a Gaussian; an edge is where its slope is steepest along its own direction (Canny 1986).
//! The slope is evaluated at any place, not at pixels alone, so an edge has no steps of a pixel. On a curved edge of
//! radius r the smoothing moves it by about σ²/(2r) to the inside: 0.07 pixels where r is 16.

use std::f64::consts::TAU;

use glam::DVec2;

/// The standard deviation of the smoothing in pixels. Less follows noise, more rounds corners off.
const SMOOTHING: f64 = 1.5;

/// Pixels farther than this from a place do not count in its slope: the Gaussian has fallen to 4e-6. Where it is cut
/// sooner, pixels that come and go move the edge by hundredths.
const SUPPORT: f64 = 5.0 * SMOOTHING;

/// A step of brightness below this is no edge: noise of 2 % makes steps of about 0.02.
const LEAST_STEP: f64 = 0.06;

/// Edges with at least this share of the strongest slope are as strong; the nearest of them is meant.
const AS_STRONG: f64 = 0.7;

/// Steps by which the place on the edge is refined; it moves by less than 1e-3 pixels after four.
const REFINEMENTS: usize = 8;

/// The steps of the search for the steepest place along a normal, in pixels.
const STEPS: [f64; 2] = [0.5, 0.1];

/// Find the point of the strongest edge that is nearest to a place, within `reach`. Pixel (i, j) covers the square from
/// (i, j) to (i + 1, j + 1); `brightness` tells that of the pixels of a picture of this `size`, from 0 to 1.
///
/// The result is `None` outside of the picture, and where no step of brightness is stronger than noise.
pub fn nearest_edge(
    brightness: impl Fn([u32; 2]) -> f64,
    size: [u32; 2],
    place: DVec2,
    reach: f64,
) -> Option<DVec2> {
    let high = DVec2::from(size.map(f64::from));
    if !(place.cmpge(DVec2::ZERO).all() && place.cmplt(high).all()) {
        return None;
    }
    let window = Window::around(brightness, size, place, reach + SUPPORT + 2.0);
    let mut at = window.strong_pixel(place, reach)?;
    for _ in 0..REFINEMENTS {
        let normal = window.slope(at).try_normalize()?;
        at = window.steepest(at, normal)?;
        // The foot of the place on the edge's tangent.
        let along = normal.perp();
        let by = (place - at).dot(along).clamp(-1.0, 1.0);
        at += by * along;
    }
    let normal = window.slope(at).try_normalize()?;
    let at = window.steepest(at, normal)?;
    (at.distance(place) <= reach).then_some(at)
}

/// The brightness of the pixels around a place.
struct Window {
    low: DVec2,
    width: usize,
    /// Row by row; beyond the picture that of the nearest pixel in it, so that its border is no edge.
    values: Vec<f64>,
}

impl Window {
    fn around(
        brightness: impl Fn([u32; 2]) -> f64,
        size: [u32; 2],
        place: DVec2,
        half: f64,
    ) -> Self {
        let low = (place - half).floor();
        let width = (2.0 * half).ceil() as usize + 1;
        let pixel = |axis: usize, step: usize| {
            let last = f64::from(size[axis].saturating_sub(1));
            (low[axis] + step as f64).clamp(0.0, last) as u32
        };
        let places = (0..width).flat_map(|y| (0..width).map(move |x| [x, y]));
        let values = places.map(|[x, y]| brightness([pixel(0, x), pixel(1, y)]));
        Self {
            low,
            width,
            values: values.collect(),
        }
    }

    /// The slope of the smoothed brightness at a place.
    fn slope(&self, at: DVec2) -> DVec2 {
        let local = at - self.low;
        let pixels = |middle: f64| {
            let from = (middle - 0.5 - SUPPORT).ceil().max(0.0) as usize;
            let to = (middle - 0.5 + SUPPORT).floor().max(0.0) as usize;
            from..=to.min(self.width - 1)
        };
        let off = |pixel: usize, middle: f64| pixel as f64 + 0.5 - middle;
        let weight = |off: f64| (-off * off / (2.0 * SMOOTHING * SMOOTHING)).exp();
        let columns = pixels(local.x).map(|x| (x, off(x, local.x), weight(off(x, local.x))));
        let columns: Vec<(usize, f64, f64)> = columns.collect();
        let [mut slope, mut moment] = [DVec2::ZERO; 2];
        let [mut weights, mut mean] = [0.0; 2];
        for y in pixels(local.y) {
            let (off_y, weight_y) = (off(y, local.y), weight(off(y, local.y)));
            for (x, off_x, weight_x) in &columns {
                let by = DVec2::new(*off_x, off_y);
                let weight = weight_x * weight_y;
                let value = self.values[y * self.width + x];
                weights += weight;
                moment += weight * by;
                mean += weight * value;
                slope += weight * value * by;
            }
        }
        if weights == 0.0 {
            return DVec2::ZERO;
        }
        // A constant brightness has no slope, wherever the pixels lie.
        (slope - mean / weights * moment) / (weights * SMOOTHING * SMOOTHING)
    }

    /// The pixel with the nearest of the strongest edges within `reach` of a place.
    fn strong_pixel(&self, place: DVec2, reach: f64) -> Option<DVec2> {
        let reaches = -(reach.ceil() as i64)..=reach.ceil() as i64;
        let middle = place.floor() + 0.5;
        let steps = reaches
            .clone()
            .flat_map(|y| reaches.clone().map(move |x| [x, y]));
        let places = steps.map(|[x, y]| middle + DVec2::new(x as f64, y as f64));
        let near = places.filter(|at| at.distance(place) <= reach);
        let slopes: Vec<(DVec2, f64)> = near.map(|at| (at, self.slope(at).length())).collect();
        let strongest = slopes.iter().map(|(_, slope)| *slope).fold(0.0, f64::max);
        // The slope of a smoothed step.
        if strongest < LEAST_STEP / (SMOOTHING * TAU.sqrt()) {
            return None;
        }
        let strong = slopes
            .iter()
            .filter(|(_, slope)| *slope >= AS_STRONG * strongest);
        let at = strong.min_by(|(a, _), (b, _)| a.distance(place).total_cmp(&b.distance(place)));
        at.map(|(at, _)| *at)
    }

    /// The place of the steepest slope on a normal, within two pixels.
    fn steepest(&self, at: DVec2, normal: DVec2) -> Option<DVec2> {
        let slope = |share: f64| self.slope(at + share * normal).dot(normal).abs();
        let steps = (-4..=4).map(|step| f64::from(step) * STEPS[0]);
        let mut best = steps.max_by(|a, b| slope(*a).total_cmp(&slope(*b)))?;
        for step in STEPS {
            let [before, there, after] = [best - step, best, best + step].map(slope);
            let bend = before - 2.0 * there + after;
            // The top of the parabola through the three.
            if bend < 0.0 {
                best += (0.5 * step * (before - after) / bend).clamp(-step, step);
            }
        }
        Some(at + best * normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of a pixel that a disc covers, from 16 × 16 places in it.
    fn covered(pixel: [u32; 2], centre: DVec2, radius: f64) -> f64 {
        let places = (0..256).map(|index| {
            let by = DVec2::new(f64::from(index % 16), f64::from(index / 16)) / 16.0;
            DVec2::from(pixel.map(f64::from)) + by + 1.0 / 32.0
        });
        let inside = places.filter(|place| place.distance(centre) < radius);
        inside.count() as f64 / 256.0
    }

    /// A number from −1 to 1 that looks random.
    fn noise([x, y]: [u32; 2]) -> f64 {
        let mut bits =
            u64::from(x).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ u64::from(y).rotate_left(32);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    #[test]
    fn points_near_a_circle_go_to_it() {
        let centre = DVec2::new(60.3, 57.8);
        // Smoothing moves the edge inwards; the share that a pixel is covered is known to 1/256.
        let inwards = |radius: f64| SMOOTHING * SMOOTHING / (2.0 * radius) + 0.03;
        for (radius, share, tolerance) in [
            (40.0, 0.0, inwards(40.0)),
            (16.0, 0.0, inwards(16.0)),
            (40.0, 0.02, 0.35),
        ] {
            // Even noise of this standard deviation.
            let brightness = |pixel| {
                1.0 - 0.8 * covered(pixel, centre, radius) + share * 3f64.sqrt() * noise(pixel)
            };
            let mut worst = 0.0_f64;
            for step in 0..48 {
                let angle = f64::from(step) * TAU / 48.0;
                let off = [-6.0, -2.0, 0.0, 3.0, 6.5][step as usize % 5];
                let place = centre + (radius + off) * DVec2::from_angle(angle);
                let found = nearest_edge(brightness, [120; 2], place, 8.0).expect("an edge");
                worst = worst.max((found.distance(centre) - radius).abs());
                // It is the foot of the place, not another point of the edge.
                let foot = centre + radius * DVec2::from_angle(angle);
                assert!(found.distance(foot) < 1.0, "{found} {foot}");
            }
            assert!(worst < tolerance, "radius {radius}: {worst}");
        }
    }

    #[test]
    fn even_and_noisy_ground_has_no_edge() {
        let noisy = |pixel| 0.5 + 0.02 * 3f64.sqrt() * noise(pixel);
        let size = [2000; 2];
        for step in 0..200 {
            let place = DVec2::new(40.2, 31.7) + 7.3 * f64::from(step) * DVec2::new(0.6, 0.8);
            assert_eq!(nearest_edge(noisy, size, place, 8.0), None);
            assert_eq!(nearest_edge(|_| 0.4, size, place, 8.0), None);
        }
    }

    #[test]
    fn the_border_of_a_picture_is_no_edge() {
        for place in [
            DVec2::new(1.0, 25.0),
            DVec2::new(48.5, 48.5),
            DVec2::new(50.5, 3.0),
        ] {
            assert_eq!(nearest_edge(|_| 0.2, [50; 2], place, 8.0), None);
        }
        // A place outside of it has none, however near the edge in it.
        let step = |[x, _]: [u32; 2]| if x < 3 { 0.0 } else { 1.0 };
        assert_eq!(
            nearest_edge(step, [50; 2], DVec2::new(-0.5, 9.0), 8.0),
            None
        );
        assert!(nearest_edge(step, [50; 2], DVec2::new(0.5, 9.0), 8.0).is_some());
    }
}
