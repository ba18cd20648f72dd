//! Chains: the pieces of a polycurve or a path. Readers give them a group of its name and numbers in that; writers of
//! formats that have such curves join them again.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::drawing::{Item, Kind, Shape};
use super::splines::at;
use crate::io::loss::{Loss, LossReport};

/// Pieces meet that are no farther apart, in units of the largest coordinate of their ends: conversion to float polygons
/// and back moves ends by less, and nobody places them so near by hand.
const MEET: f64 = 1e-10;

/// A chain among the items of a drawing.
struct Chain {
    /// The places of its pieces, in its order.
    pieces: Vec<usize>,
    item: Item,
}

/// Name a piece of a chain by its number from 1.
pub(super) fn piece_name(chain: &str, number: usize) -> String {
    format!("{chain} {number}")
}

/// Join the pieces of each chain whose names, ends, colours and visibility still fit, if `holds` allows it.
/// Losses of the pieces become those of the chain; `report` adds that of its group.
pub(super) fn joined(
    items: Vec<Item>,
    holds: impl Fn(&Item) -> bool,
    losses: &mut LossReport,
    report: impl Fn(&Item, &mut LossReport),
) -> Vec<Item> {
    let chains = chains(&items);
    let chains = chains.into_iter().filter(|chain| holds(&chain.item));
    let mut items: Vec<Option<Item>> = items.into_iter().map(Some).collect();
    let mut pieces: HashSet<String> = HashSet::new();
    let mut heads: HashMap<String, String> = HashMap::new();
    for Chain { pieces: own, item } in chains {
        let name = item.name.clone().unwrap_or_default();
        heads.insert(piece_name(&name, 1), name);
        let names = own
            .iter()
            .filter_map(|place| items.get(*place)?.as_ref()?.name.clone());
        pieces.extend(names);
        report(&item, losses);
        let first = own.iter().min().copied();
        for place in own {
            if let Some(old) = items.get_mut(place) {
                *old = (Some(place) == first).then(|| item.clone());
            }
        }
    }
    losses.losses.retain_mut(|(name, loss)| match loss {
        Loss::Group { .. } => !pieces.contains(name),
        Loss::Unnamed | Loss::Colour if pieces.contains(name) => {
            let chain = heads.get(name);
            *name = chain.cloned().unwrap_or_default();
            chain.is_some()
        }
        _ => true,
    });
    items.into_iter().flatten().collect()
}

fn chains(items: &[Item]) -> Vec<Chain> {
    let mut groups: HashMap<&[String], Vec<(usize, usize)>> = HashMap::new();
    for (place, item) in items.iter().enumerate() {
        if !item.group.is_empty() {
            let number = number_in_chain(item).unwrap_or_default();
            groups.entry(&item.group).or_default().push((number, place));
        }
    }
    let mut chains: Vec<Chain> = groups
        .into_values()
        .filter_map(|mut numbered| {
            numbered.sort_unstable();
            let numbers = numbered.iter().map(|(number, _)| *number);
            if numbered.len() < 2 || !numbers.eq(1..=numbered.len()) {
                return None;
            }
            let pieces = numbered.iter().map(|(_, place)| *place);
            let pieces: Vec<usize> = pieces.collect();
            let item = chain(pieces.iter().filter_map(|place| items.get(*place)))?;
            Some(Chain { pieces, item })
        })
        .collect();
    chains.sort_by_key(|chain| chain.pieces.iter().min().copied());
    chains
}

/// The number of a piece, by the name of its group.
fn number_in_chain(item: &Item) -> Option<usize> {
    let (name, chain) = (item.name.as_deref()?, item.group.last()?);
    let number = name.strip_prefix(chain.as_str())?.strip_prefix(' ')?;
    let number = number.parse().ok()?;
    (piece_name(chain, number) == name).then_some(number)
}

/// One item of pieces that go on from each other and look alike.
fn chain<'i>(pieces: impl Iterator<Item = &'i Item> + Clone) -> Option<Item> {
    let first = pieces.clone().next()?;
    let looks = |item: &Item| (item.colour, item.hidden, item.space, item.block.clone());
    if !pieces.clone().all(|it| looks(it) == looks(first)) {
        return None;
    }
    let shapes = pieces.map(|item| match &item.shapes[..] {
        [shape] => Some(shape.clone()),
        _ => None,
    });
    let mut shapes: Vec<Shape> = shapes.collect::<Option<_>>()?;
    join(&mut shapes)?;
    let (name, path) = first.group.split_last()?;
    Some(Item {
        kind: Kind::Polycurve,
        shapes,
        group: path.into(),
        name: Some(name.clone()),
        ..first.clone()
    })
}

/// Put ends that meet but for rounding onto each other; `None` if some do not meet.
fn join(shapes: &mut [Shape]) -> Option<()> {
    let ends: Vec<[DVec3; 2]> = shapes.iter().map(ends).collect::<Option<_>>()?;
    let sizes = ends.iter().flatten().map(|it| it.abs().max_element());
    let near = MEET * sizes.fold(0.0, f64::max);
    let meet = |end: DVec3, start: DVec3| end.distance(start) <= near;
    if !ends.windows(2).all(|pair| meet(pair[0][1], pair[1][0])) {
        return None;
    }
    for index in 1..shapes.len() {
        let (before, behind) = shapes.split_at_mut(index);
        weld(before.last_mut()?, behind.first_mut()?)?;
    }
    if let [first, .., last] = shapes
        && meet(ends.last()?[1], ends.first()?[0])
    {
        weld(last, first)?;
    }
    Some(())
}

/// Let a shape begin where another one ends. Arcs keep their numbers.
fn weld(before: &mut Shape, behind: &mut Shape) -> Option<()> {
    let (end, start) = (ends(before)?[1], ends(behind)?[0]);
    match (before, behind) {
        (_, Shape::Nurbs(nurbs)) => *nurbs.points.first_mut()? = end,
        (_, Shape::Polyline { points, .. }) => *points.first_mut()? = end,
        (Shape::Nurbs(nurbs), _) => *nurbs.points.last_mut()? = start,
        (Shape::Polyline { points, .. }, _) => *points.last_mut()? = start,
        _ => {}
    }
    Some(())
}

/// The ends of a shape that begins and ends in points of its own.
fn ends(shape: &Shape) -> Option<[DVec3; 2]> {
    match shape {
        Shape::Nurbs(nurbs) => {
            let (n, count) = (nurbs.degree, nurbs.points.len());
            let is_one = |knots: Option<&[f64]>| {
                knots.is_some_and(|knots| knots.windows(2).all(|pair| pair[0] == pair[1]))
            };
            // The first and the last knot have no effect.
            let is_clamped = is_one(nurbs.knots.get(1..=n))
                && is_one(nurbs.knots.get(count..(count + n).max(count)));
            let ends = [*nurbs.points.first()?, *nurbs.points.last()?];
            is_clamped.then_some(ends)
        }
        Shape::Polyline {
            points,
            closed: false,
        } => Some([*points.first()?, *points.last()?]),
        Shape::Conic(conic) => Some([conic.from, conic.to].map(|it| at(conic, it))),
        Shape::Polyline { .. } | Shape::Point(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::io::exchange::drawing::{Conic, Drawing, Nurbs};
    use crate::io::formats;

    fn item(name: Option<&str>, kind: Kind, shapes: Vec<Shape>) -> Item {
        Item {
            group: ["Deck".to_owned()].into(),
            name: name.map(str::to_owned),
            ..Item::new(kind, shapes)
        }
    }

    fn line(points: &[[f64; 2]]) -> Shape {
        let points = points.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0));
        Shape::Polyline {
            points: points.collect(),
            closed: false,
        }
    }

    fn cubic(points: [[f64; 2]; 4]) -> Shape {
        Shape::Nurbs(Nurbs {
            degree: 3,
            knots: [[0.0; 4], [1.0; 4]].concat(),
            points: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            weights: None,
            periodic: false,
        })
    }

    /// A closed contour with a name, one without, and one of the same name as the first.
    fn drawing() -> Drawing {
        let contour = |x: f64| {
            vec![
                line(&[[x, 0.1], [x + 3.0, 0.1]]),
                cubic([
                    [x + 3.0, 0.1],
                    [x + 4.0, 1.3],
                    [x + 3.7, 2.9],
                    [x + 1.0, 3.3],
                ]),
                line(&[[x + 1.0, 3.3], [x, 0.1]]),
            ]
        };
        Drawing {
            unit: Some(1.0),
            items: vec![
                item(Some("hull"), Kind::Polycurve, contour(0.0)),
                item(None, Kind::Polycurve, contour(10.0)),
                item(Some("hull"), Kind::Polycurve, contour(20.0)),
            ],
            ..Drawing::default()
        }
    }

    fn document() -> Document {
        drawing().reading().into_document().expect("a document")
    }

    #[test]
    fn polycurves_come_back_as_one() {
        for extension in ["step", "igs", "3dm", "brep", "svg", "glif"] {
            let format = formats::find(extension).expect("a format");
            let export = format.write(&document(), None).expect("written");
            let found = format.draw(&export.bytes).expect("a drawing");
            let counts: Vec<usize> = found.items.iter().map(|it| it.shapes.len()).collect();
            assert_eq!(counts, [3; 3], "{extension}");
            for item in &found.items {
                let ends: Vec<_> = item.shapes.iter().filter_map(ends).collect();
                for index in 0..3 {
                    let gap = ends[index][1].distance(ends[(index + 1) % 3][0]);
                    assert!(gap < 1e-12, "{extension}: {gap}");
                }
            }
            if ["step", "3dm"].contains(&extension) {
                let names = found.items.iter().filter_map(|it| it.name.as_deref());
                let names: Vec<&str> = names.collect();
                assert_eq!(names, ["hull", "polycurve 1", "hull 2"], "{extension}");
                assert!(found.items.iter().all(|it| *it.group == ["Deck"]));
            }
        }
    }

    #[test]
    fn pieces_that_do_not_fit_stay_apart() {
        let pieces = |change: fn(&mut Item)| {
            let names = ["hull 1", "hull 2"];
            let shapes = [
                line(&[[0.0, 0.0], [1.0, 0.0]]),
                line(&[[1.0, 0.0], [1.0, 1.0]]),
            ];
            let made = names.into_iter().zip(shapes).map(|(name, shape)| Item {
                group: ["Deck", "hull"].map(str::to_owned).into(),
                ..item(Some(name), Kind::Line, vec![shape])
            });
            let mut items: Vec<Item> = made.collect();
            items.iter_mut().skip(1).for_each(change);
            let mut losses = LossReport::new("STEP");
            joined(items, |_| true, &mut losses, |_, _| {}).len()
        };
        assert_eq!(pieces(|_| {}), 1);
        assert_eq!(pieces(|it| it.hidden = true), 2);
        assert_eq!(pieces(|it| it.colour = Some([1, 2, 3])), 2);
        assert_eq!(pieces(|it| it.name = Some("hull 3".to_owned())), 2);
        assert_eq!(pieces(|it| it.name = Some("mast".to_owned())), 2);
        let far = |it: &mut Item| it.shapes = vec![line(&[[1.0, 1e-3], [1.0, 1.0]])];
        assert_eq!(pieces(far), 2);
        let round = |it: &mut Item| {
            it.shapes = vec![Shape::Conic(Conic {
                centre: DVec3::new(2.0, 0.0, 0.0),
                x: DVec3::X,
                y: DVec3::Y,
                from: std::f64::consts::PI,
                to: 5.0,
            })];
        };
        assert_eq!(pieces(round), 1);
    }
}
