//! Basic shapes: rectangles, ellipses, lines and polygons.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;
use roxmltree::Node;
use svgtypes::{NumberListParser, PointsParser};

use super::super::pieces::Pieces;
use super::lengths::{Along, Viewport, length};
use crate::io::exchange::drawing::{Conic, Shape};

/// Make the pieces of a basic shape, or say why nothing of it is drawn.
pub(super) fn shape(node: Node, viewport: Viewport) -> Result<Vec<Shape>, &'static str> {
    let get = |name, along| length(node, name, along, viewport);
    let x = |name| get(name, Along::Width).unwrap_or_default();
    let y = |name| get(name, Along::Height).unwrap_or_default();
    match node.tag_name().name() {
        "rect" => {
            let radii = (get("rx", Along::Width), get("ry", Along::Height));
            rectangle(
                DVec3::new(x("x"), y("y"), 0.0),
                x("width"),
                y("height"),
                radii,
            )
        }
        "circle" => {
            let radius = get("r", Along::Diagonal).unwrap_or_default();
            ellipse(DVec3::new(x("cx"), y("cy"), 0.0), radius, radius)
        }
        "ellipse" => {
            let (rx, ry) = (get("rx", Along::Width), get("ry", Along::Height));
            let (rx, ry) = (rx.or(ry).unwrap_or_default(), ry.or(rx).unwrap_or_default());
            ellipse(DVec3::new(x("cx"), y("cy"), 0.0), rx, ry)
        }
        "line" => Ok(vec![Shape::Polyline {
            points: vec![
                DVec3::new(x("x1"), y("y1"), 0.0),
                DVec3::new(x("x2"), y("y2"), 0.0),
            ],
            closed: false,
        }]),
        name => polygon(
            node.attribute("points").unwrap_or_default(),
            name == "polygon",
        ),
    }
}

fn rectangle(
    corner: DVec3,
    width: f64,
    height: f64,
    (rx, ry): (Option<f64>, Option<f64>),
) -> Result<Vec<Shape>, &'static str> {
    if !(width > 0.0 && height > 0.0) {
        return Err("its width or height is not above 0");
    }
    let (rx, ry) = (rx.filter(|&it| it >= 0.0), ry.filter(|&it| it >= 0.0));
    let (rx, ry) = (rx.or(ry).unwrap_or_default(), ry.or(rx).unwrap_or_default());
    let (rx, ry) = (rx.min(0.5 * width), ry.min(0.5 * height));
    let at = |x: f64, y: f64| corner + DVec3::new(x, y, 0.0);
    if !(rx > 0.0 && ry > 0.0) {
        let points = vec![
            at(0.0, 0.0),
            at(width, 0.0),
            at(width, height),
            at(0.0, height),
        ];
        return Ok(vec![Shape::Polyline {
            points,
            closed: true,
        }]);
    }
    let mut pieces = Pieces::new(at(rx, 0.0));
    let corners = [
        (
            at(width - rx, 0.0),
            at(width - rx, ry),
            at(width, ry),
            -FRAC_PI_2,
        ),
        (
            at(width, height - ry),
            at(width - rx, height - ry),
            at(width - rx, height),
            0.0,
        ),
        (
            at(rx, height),
            at(rx, height - ry),
            at(0.0, height - ry),
            FRAC_PI_2,
        ),
        (at(0.0, ry), at(rx, ry), at(rx, 0.0), 2.0 * FRAC_PI_2),
    ];
    for (line_end, centre, to, from) in corners {
        if pieces.end() != line_end {
            pieces.line(line_end);
        }
        let arc = Conic {
            centre,
            x: DVec3::new(rx, 0.0, 0.0),
            y: DVec3::new(0.0, ry, 0.0),
            from,
            to: from + FRAC_PI_2,
        };
        pieces.arc(arc, to);
    }
    Ok(pieces.finish())
}

fn ellipse(centre: DVec3, rx: f64, ry: f64) -> Result<Vec<Shape>, &'static str> {
    if !(rx > 0.0 && ry > 0.0) {
        return Err("its radius is not above 0");
    }
    Ok(vec![Shape::Conic(Conic {
        centre,
        x: DVec3::new(rx, 0.0, 0.0),
        y: DVec3::new(0.0, ry, 0.0),
        from: 0.0,
        to: TAU,
    })])
}

fn polygon(points: &str, closed: bool) -> Result<Vec<Shape>, &'static str> {
    let points: Vec<_> = PointsParser::from(points)
        .map(|(x, y)| DVec3::new(x, y, 0.0))
        .collect();
    if points.len() < 2 {
        return Err("it has fewer than two points");
    }
    Ok(vec![Shape::Polyline { points, closed }])
}

/// Tell whether a list of points ends in something else than pairs of numbers.
pub(super) fn has_damaged_points(node: Node) -> bool {
    let Some(points) = node.attribute("points") else {
        return false;
    };
    let mut count = 0_usize;
    for number in NumberListParser::from(points) {
        if number.is_err() {
            return true;
        }
        count += 1;
    }
    count % 2 == 1
}
