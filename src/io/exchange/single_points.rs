//! The single points of a drawing, of which lists are made.

use std::collections::HashMap;
use std::hash::Hash;

use glam::DVec3;

use super::drawing::{Item, Shape};

/// A point that is an item of its own.
#[derive(Clone, Copy)]
pub(super) struct SinglePoint<'d> {
    /// The point.
    pub(super) point: DVec3,
    /// The item.
    pub(super) item: &'d Item,
}

impl<'d> SinglePoint<'d> {
    /// The points of an item that are single ones.
    pub(super) fn of(item: &'d Item) -> impl Iterator<Item = Self> {
        item.shapes.iter().filter_map(move |shape| match shape {
            Shape::Point(point) => Some(Self {
                point: *point,
                item,
            }),
            _ => None,
        })
    }
}

/// Divide single points into lists: those of one name, then the others of one layer or block, then all others. Hidden
/// ones stay apart. A list of one point is no reference.
pub(super) fn lists<'d>(points: Vec<SinglePoint<'d>>) -> Vec<Vec<SinglePoint<'d>>> {
    let place = |it: &SinglePoint<'d>| {
        let Item { group, block, .. } = it.item;
        (&group[..], block.as_deref(), it.item.hidden)
    };
    let (mut lists, rest) = divided(points, |it| (place(it), it.item.name.as_deref()));
    let (of_places, rest) = divided(rest, place);
    let (of_others, rest) = divided(rest, |it| it.item.hidden);
    lists.extend(of_places);
    lists.extend(of_others);
    lists.extend(rest.into_iter().map(|it| vec![it]));
    lists
}

/// Divide points by a key. Returns the lists of two or more, and the points that are alone.
fn divided<'d, K: Eq + Hash>(
    points: Vec<SinglePoint<'d>>,
    key: impl Fn(&SinglePoint<'d>) -> K,
) -> (Vec<Vec<SinglePoint<'d>>>, Vec<SinglePoint<'d>>) {
    let mut places: HashMap<K, usize> = HashMap::new();
    let mut lists: Vec<Vec<SinglePoint>> = Vec::new();
    for point in points {
        let place = *places.entry(key(&point)).or_insert(lists.len());
        match lists.get_mut(place) {
            Some(list) => list.push(point),
            None => lists.push(vec![point]),
        }
    }
    let (several, alone): (Vec<_>, Vec<_>) = lists.into_iter().partition(|it| it.len() > 1);
    (several, alone.into_iter().flatten().collect())
}

/// The value that all points of a list have, if they have the same.
pub(super) fn common<'d, V: PartialEq>(
    list: &[SinglePoint<'d>],
    value: impl Fn(&'d Item) -> V,
) -> Option<V> {
    let mut values = list.iter().map(|it| value(it.item));
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
}
