//! The law of curves that stay symmetric.

use batten::document::Curve;
use batten::geometry::{End, Mirror};

/// A curve that stays symmetric is its own mirror image: bit for bit where coordinates change their signs, elsewhere the
/// vertices behind the first of each are its images. Locks and targets are images too.
pub fn check_symmetry(curve: &Curve) -> Result<(), String> {
    let Some(symmetry) = curve.symmetry else {
        return Ok(());
    };
    let (name, polygon) = (&curve.name, &curve.polygon);
    let count = polygon.vertices().len();
    let is_signed = matches!(symmetry.mirror(), Mirror::Signs(_));
    for (index, vertex) in polygon.vertices().iter().enumerate() {
        let partner = symmetry.partner(index, count);
        let image = symmetry.mirror().point(*vertex);
        let is_image = match (is_signed, index == partner) {
            (true, _) => image == polygon.vertex(partner),
            (false, true) => image.distance(*vertex) <= 1e-14 * (1.0 + image.length()),
            // The first of several leads.
            (false, false)
                if symmetry
                    .dependents(index, count)
                    .iter()
                    .any(|it| *it < index) =>
            {
                true
            }
            (false, false) => image == polygon.vertex(partner),
        };
        if !is_image {
            let found = polygon.vertex(partner);
            return Err(format!(
                "“{name}”: {partner} is {found}, not {image}, the image of {index}"
            ));
        }
        if polygon.weight(index) != polygon.weight(partner) {
            return Err(format!("“{name}”: {index} and {partner} differ in weight"));
        }
        let locks = [index, partner].map(|it| curve.locked_vertices.contains(it));
        if locks[0] != locks[1] {
            return Err(format!("“{name}”: {index} and {partner} differ in locks"));
        }
        if let Some(second) = symmetry.second()
            && is_signed
        {
            let image = second.point(*vertex);
            if image != polygon.vertex((partner + count / 2) % count) {
                return Err(format!(
                    "“{name}”: {index} has no image in the second plane"
                ));
            }
        }
    }
    let targets = [End::Start, End::Finish].map(|end| curve.targets.get(end));
    match targets {
        _ if polygon.is_periodic() => Ok(()),
        [None, None] => Ok(()),
        [Some(start), Some(finish)] => {
            let image = symmetry.mirror().point(start.point);
            let off = image.distance(finish.point) / (1.0 + image.length());
            (off <= 1e-12)
                .then_some(())
                .ok_or(format!("“{name}”: targets are no images, by {off:e}"))
        }
        _ => Err(format!("“{name}”: one end has a target")),
    }
}
