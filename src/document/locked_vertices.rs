//! Which vertices of a curve are locked.

use std::collections::HashSet;

use crate::geometry::FloatPolygon;

/// Hold the numbers of a curve's locked vertices: no edit moves them, changes their weights or
/// deletes them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LockedVertices(Vec<usize>);

impl LockedVertices {
    /// Whether a vertex is locked.
    pub fn contains(&self, vertex: usize) -> bool {
        self.0.binary_search(&vertex).is_ok()
    }

    /// Whether no vertex is.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// List the locked vertices in rising order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = usize> + DoubleEndedIterator + '_ {
        self.0.iter().copied()
    }

    /// Lock a vertex or unlock it.
    pub fn set(&mut self, vertex: usize, locked: bool) {
        match (self.0.binary_search(&vertex), locked) {
            (Ok(place), false) => {
                self.0.remove(place);
            }
            (Err(place), true) => self.0.insert(place, vertex),
            _ => {}
        }
    }

    /// Find the locked vertices after all vertices got other numbers; `number` tells the new
    /// number of an old one, or that it is gone.
    pub fn renumbered(&self, number: impl FnMut(usize) -> Option<usize>) -> Self {
        self.iter().filter_map(number).collect()
    }

    /// Find the vertices of another polygon that are locked vertices of this one: the same point
    /// with the same weight. Where several are, each of them.
    ///
    /// # Panics
    /// If `from` does not have a locked vertex.
    pub fn carried(&self, from: &FloatPolygon, to: &FloatPolygon) -> Self {
        let locked: HashSet<[u64; 4]> = self.iter().map(|old| bits(from, old)).collect();
        let all = 0..to.vertices().len();
        all.filter(|new| locked.contains(&bits(to, *new))).collect()
    }
}

impl FromIterator<usize> for LockedVertices {
    fn from_iter<I: IntoIterator<Item = usize>>(vertices: I) -> Self {
        let mut vertices: Vec<usize> = vertices.into_iter().collect();
        vertices.sort_unstable();
        vertices.dedup();
        Self(vertices)
    }
}

/// The bits of a vertex and of its weight; −0 counts as 0.
fn bits(polygon: &FloatPolygon, vertex: usize) -> [u64; 4] {
    let numbers = polygon.vertex(vertex).extend(polygon.weight(vertex));
    numbers.to_array().map(|number| (number + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[(f64, f64)]) -> FloatPolygon {
        FloatPolygon::planar(1, points).expect("a valid polygon")
    }

    #[test]
    fn vertices_are_locked_once_and_listed_in_order() {
        let mut locked: LockedVertices = [7, 2, 7, 4].into_iter().collect();
        locked.set(4, true);
        locked.set(0, true);
        locked.set(7, false);
        locked.set(3, false);
        assert_eq!(locked.iter().collect::<Vec<_>>(), [0, 2, 4]);
        assert!(locked.contains(2) && !locked.contains(7));
        assert!(!locked.is_empty() && LockedVertices::default().is_empty());
    }

    #[test]
    fn other_numbers_keep_their_order_and_leave_out_what_is_gone() {
        let locked: LockedVertices = [0, 2, 4].into_iter().collect();
        let reversed = locked.renumbered(|vertex| (vertex > 0).then(|| 4 - vertex));
        assert_eq!(reversed.iter().collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn a_lock_goes_with_its_point_and_weight() {
        let from = polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (3.0, 1.0)]);
        let to = polygon(&[(3.0, 1.0), (1.0, 0.0), (5.0, 5.0), (1.0, 0.0)]);
        let locked: LockedVertices = [1, 2, 3].into_iter().collect();
        let carried = locked.carried(&from, &to);
        assert_eq!(carried.iter().collect::<Vec<_>>(), [0, 1, 3]);

        let mut heavier = to.clone();
        heavier.set_weight(0, 2.0).expect("a weight");
        let carried = locked.carried(&from, &heavier);
        assert_eq!(carried.iter().collect::<Vec<_>>(), [1, 3]);
    }
}
