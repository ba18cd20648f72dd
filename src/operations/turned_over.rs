//! Curves that an operation turns over.

use crate::geometry::features::Turning;
use crate::geometry::{FloatPolygon, curve_crossing, significant};

/// Say that a planar polynomial curve turns by whole turns more or less than before, beyond what its ends turn: it has
/// a loop, or is inside out. `None` where it only lost a loop.
pub(super) fn turned_over(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let both = [before, after];
    if both.iter().any(|it| !it.is_planar() || it.is_rational()) {
        return None;
    }
    let [old, new] = both.map(Turning::new);
    let turns_over = new.rounds_since(&old) != 0;
    let lost_loop = || curve_crossing(before).is_some() && curve_crossing(after).is_none();
    (turns_over && !lost_loop()).then(|| {
        let [old, new] = [old, new].map(|it| significant(it.total().to_degrees(), 3));
        format!("The curve turns by {new}° in all, before by {old}°")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_told_and_a_bend_is_not() {
        let planar = |points: &[(f64, f64)]| FloatPolygon::planar(2, points).expect("a polygon");
        let straight = planar(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (4.0, 0.0)]);
        let bent = planar(&[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 3.0)]);
        let looped = planar(&[(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, -1.0)]);
        assert_eq!(turned_over(&straight, &bent), None);
        assert_eq!(turned_over(&looped, &straight), None);
        let told = turned_over(&straight, &looped).expect("a remark");
        assert!(told.contains("270°") && told.contains("by 0°"), "{told}");
    }
}
