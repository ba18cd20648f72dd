//! Polygons that are their own mirror images.

use glam::DVec3;

use super::error::PolygonError;
use super::float_polygon::FloatPolygon;
use super::mirror::Mirror;
use super::vector;

/// Relative differences up to this are rounding.
const ROUNDING: f64 = 1e-12;

/// The rounding of a few operations on the coordinates of a point.
const ULPS: f64 = 8.0 * f64::EPSILON;

/// The rule that a polygon is its own mirror image, run through the other way: vertex s − i is the image of vertex i.
///
/// An open polygon has s = N − 1; of a periodic one numbers count modulo N, and any s is possible. A periodic polygon
/// with an even N can be its own image in the perpendicular plane too, as an oval is: then vertex i + N / 2 is the
/// vertex i turned by half a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetry {
    mirror: Mirror,
    second: Option<Mirror>,
    /// The sum of the numbers of two partners.
    sum: usize,
}

/// A vertex that depends on another one: its number, and whose image it is, in the first and in the second plane.
type Member = (usize, [bool; 2]);

impl Symmetry {
    /// The rule that moves the vertices of a polygon least.
    pub fn about(mirror: Mirror, polygon: &FloatPolygon) -> Self {
        let sum = match polygon.is_periodic() {
            true => least_sum(polygon.vertices(), &mirror),
            false => polygon.vertices().len() - 1,
        };
        Self {
            mirror,
            second: None,
            sum,
        }
    }

    /// The rule with the perpendicular plane too; `None` for an open polygon or an odd number of vertices, and for a
    /// plane that is not vertical.
    pub fn about_both(mirror: Mirror, polygon: &FloatPolygon) -> Option<Self> {
        let is_possible = polygon.is_periodic() && polygon.vertices().len().is_multiple_of(2);
        let second = mirror.perpendicular().filter(|_| is_possible)?;
        Some(Self {
            second: Some(second),
            ..Self::about(mirror, polygon)
        })
    }

    /// The rule that a polygon follows within a share of its size: about the coordinates' vertical planes through the
    /// origin, both of them if it can be, or about a plane of its own.
    pub fn found(polygon: &FloatPolygon, share: f64) -> Option<Self> {
        let [across, level] = [0, 1].map(Mirror::of_coordinate);
        let own = |mirror| Self::about(mirror, polygon).following(polygon);
        let candidates = [
            Self::about_both(across, polygon),
            Some(Self::about(across, polygon)),
            Some(Self::about(level, polygon)),
            own(across),
            own(level),
        ];
        let limit = share * polygon.size();
        let mut candidates = candidates.into_iter().flatten();
        candidates.find(|it| it.mismatch(polygon) <= limit)
    }

    /// The same rule for a polygon with another number of vertices; without the second plane where that needs an even
    /// number.
    pub fn renumbered(&self, polygon: &FloatPolygon) -> Self {
        let both = self
            .second
            .and_then(|_| Self::about_both(self.mirror, polygon));
        both.unwrap_or_else(|| Self::about(self.mirror, polygon))
    }

    /// The rule about the plane that a polygon has by its own vertices: through their mean, perpendicular to the
    /// lines between partners. `None` if all of them lie in the plane.
    pub fn following(&self, polygon: &FloatPolygon) -> Option<Self> {
        let count = polygon.vertices().len();
        let between = (0..count).map(|index| {
            let partner = self.partner(index, count);
            polygon.vertex(index) - polygon.vertex(partner)
        });
        let between: Vec<DVec3> = between.collect();
        let by_length = |a: &&DVec3, b: &&DVec3| a.length().total_cmp(&b.length());
        let longest = *between.iter().max_by(by_length)?;
        let turned = between.iter().map(|it| match it.dot(longest) < 0.0 {
            true => -*it,
            false => *it,
        });
        let normal = along_axis(vector::direction(turned.sum())?);
        let shares = polygon.vertices().iter().map(|it| *it / count as f64);
        let through = shares.sum::<DVec3>();
        let rounding = ROUNDING * polygon.size();
        let is_at_origin = match self.second {
            Some(_) => through.truncate().length() <= rounding,
            None => through.dot(normal).abs() <= rounding,
        };
        let own = Mirror::Plane { through, normal };
        let at_origin = Mirror::of_plane(DVec3::ZERO, normal);
        let mirror = match (is_at_origin, at_origin) {
            (true, Mirror::Signs(_)) => at_origin,
            _ => own,
        };
        let second = match self.second {
            Some(_) => Some(mirror.perpendicular()?),
            None => None,
        };
        Some(Self {
            mirror,
            second,
            ..*self
        })
    }

    /// The mirror plane.
    pub fn mirror(&self) -> Mirror {
        self.mirror
    }

    /// The perpendicular plane, if the polygon is its own image there too.
    pub fn second(&self) -> Option<Mirror> {
        self.second
    }

    /// The planes, each by a point and its normal of length 1; none of half a turn.
    pub fn planes(&self) -> impl Iterator<Item = [DVec3; 2]> + use<> {
        let mirrors = [Some(self.mirror), self.second];
        let mirrors = mirrors.into_iter().flatten();
        mirrors.filter_map(|mirror| mirror.plane())
    }

    /// The rule of a polygon that was moved by a vector; `None` for half a turn.
    pub fn translated(&self, by: DVec3) -> Option<Self> {
        let [through, normal] = self.mirror.plane()?;
        let through = match self.second {
            Some(_) => through + by,
            // Without a share along the plane: it is one of a coordinate again where it comes back to the origin.
            None => (through.dot(normal) + by.dot(normal)) * normal,
        };
        let mirror = Mirror::of_plane(through, normal);
        Some(Self {
            mirror,
            second: self.second.and_then(|_| mirror.perpendicular()),
            ..*self
        })
    }

    /// The number of the vertex that is the image of another one, of `count` vertices.
    pub fn partner(&self, index: usize, count: usize) -> usize {
        (self.sum + count - index % count) % count
    }

    /// The vertices that depend on one, of `count`: itself first.
    pub fn dependents(&self, index: usize, count: usize) -> Vec<usize> {
        let mut all: Vec<usize> = Vec::with_capacity(4);
        for (member, _) in self.orbit(index, count) {
            if !all.contains(&member) {
                all.push(member);
            }
        }
        all
    }

    /// Add the images of moved vertices whose partners do not move on their own.
    pub fn with_images(&self, moves: &[(usize, DVec3)], count: usize) -> Vec<(usize, DVec3)> {
        let mut all = moves.to_vec();
        for (index, place) in moves {
            for (member, images) in self.orbit(*index, count) {
                if all.iter().all(|(other, _)| *other != member) {
                    all.push((member, self.image(*place, images)));
                }
            }
        }
        all
    }

    /// The insertions that a vertex with a number means, each by the number that it gets and its place, as if it came
    /// alone: that one first, then those of its images.
    pub fn insertions(
        &self,
        polygon: &FloatPolygon,
        index: usize,
        vertex: DVec3,
    ) -> Vec<(usize, DVec3)> {
        let (count, periodic) = (polygon.vertices().len(), polygon.is_periodic());
        // The legs on both sides of a partner change places.
        let mirrored = match periodic {
            true => (self.partner(index, count) + 1) % count,
            false => count - index.min(count),
        };
        let opposite = |index: usize| (index + count / 2) % count;
        let mut all = vec![(index, vertex)];
        let first = [(mirrored, [true, false])];
        let second = [
            (opposite(mirrored), [false, true]),
            (opposite(index), [true, true]),
        ];
        let second = self.second.map(|_| second).into_iter().flatten();
        for (at, images) in first.into_iter().chain(second) {
            let is_same = |other: usize| other == at || periodic && other % count == at % count;
            match all.iter().position(|(other, _)| is_same(*other)) {
                // A leg that is its own image: its vertex lies in the plane.
                Some(place) => all[place].1 = self.foot(all[place].1, images),
                None => all.push((at, self.image(vertex, images))),
            }
        }
        all
    }

    /// The largest distance of a vertex from the image of its partner; a relative difference of weights counts as
    /// that share of the polygon's size.
    pub fn mismatch(&self, polygon: &FloatPolygon) -> f64 {
        let (count, size) = (polygon.vertices().len(), polygon.size());
        let of_pair = |index: usize, (member, images): Member| {
            let image = self.image(polygon.vertex(index), images);
            let [a, b] = [index, member].map(|it| polygon.weight(it));
            image
                .distance(polygon.vertex(member))
                .max((a - b).abs() / a.max(b) * size)
        };
        let all = (0..count).flat_map(|index| {
            let orbit = self.orbit(index, count);
            orbit.map(move |member| of_pair(index, member))
        });
        all.fold(0.0, f64::max)
    }

    /// Whether the rule holds but for rounding.
    pub fn holds(&self, polygon: &FloatPolygon) -> bool {
        self.mismatch(polygon) <= ROUNDING * (polygon.size() + self.offset())
    }

    /// How far the plane is from the origin.
    fn offset(&self) -> f64 {
        self.mirror
            .plane()
            .map_or(0.0, |[through, _]| through.length())
    }

    /// Make the rule hold. Of vertices that depend on each other those lead that `leads` says; if none does or
    /// several do, their mean counts. Those for which the rule holds to the bit stay.
    ///
    /// The vertices behind the first of each are computed as its images, bit for bit where coordinates change their
    /// signs; a vertex that is its own partner is projected. Weights become equal.
    ///
    /// # Errors
    /// [`PolygonError`] if numbers overflow.
    pub fn completed(
        &self,
        polygon: &FloatPolygon,
        leads: impl Fn(usize) -> bool,
    ) -> Result<FloatPolygon, PolygonError> {
        let count = polygon.vertices().len();
        let mut vertices = polygon.vertices().to_vec();
        let mut weights = polygon.weights().map(<[f64]>::to_vec);
        for first in 0..count {
            let orbit: Vec<Member> = self.orbit(first, count).collect();
            let is_known = orbit.iter().any(|(member, _)| *member < first);
            if is_known || self.is_exact(polygon, first, &orbit) {
                continue;
            }
            let leaders = orbit.iter().filter(|(member, _)| leads(*member));
            let mut leaders: Vec<&Member> = leaders.collect();
            if leaders.is_empty() {
                leaders = orbit.iter().collect();
            }
            let share = 1.0 / leaders.len() as f64;
            let images = leaders
                .iter()
                .map(|(member, images)| share * self.image(vertices[*member], *images));
            let mut mean = images.sum::<DVec3>();
            for (member, images) in &orbit {
                if *member == first {
                    mean = self.foot(mean, *images);
                }
            }
            for (member, images) in &orbit[1..] {
                if *member != first {
                    vertices[*member] = self.image(mean, *images);
                }
            }
            vertices[first] = mean;
            if let Some(weights) = &mut weights {
                let mean = leaders.iter().map(|(member, _)| share * weights[*member]);
                let mean: f64 = mean.sum();
                for (member, _) in &orbit {
                    weights[*member] = mean;
                }
            }
        }
        FloatPolygon::new(polygon.degree(), vertices, weights, polygon.is_periodic())
    }

    /// Make the rule hold, so that of vertices that depend on each other the nearest to a place of the curve leads.
    ///
    /// # Errors
    /// As [`Symmetry::completed`].
    pub fn completed_from(
        &self,
        polygon: &FloatPolygon,
        parameter: f64,
    ) -> Result<FloatPolygon, PolygonError> {
        let count = polygon.vertices().len();
        let place = parameter - polygon.greville(0);
        let distance = |index: usize| {
            let straight = (index as f64 - place).abs();
            match polygon.is_periodic() {
                true => straight.min((straight - count as f64).abs()),
                false => straight,
            }
        };
        self.completed(polygon, |index| {
            let all = self.orbit(index, count).map(|(it, _)| distance(it));
            let nearest = all.fold(f64::INFINITY, f64::min);
            distance(index) <= nearest + ROUNDING * count as f64
        })
    }

    /// Whether the rule holds to the bit for the vertices that depend on one.
    fn is_exact(&self, polygon: &FloatPolygon, first: usize, orbit: &[Member]) -> bool {
        let vertex = polygon.vertex(first);
        orbit.iter().all(|(member, images)| {
            let image = self.image(vertex, *images);
            let is_image = match *member == first {
                true => image.distance(vertex) <= self.rounding(vertex),
                false => image == polygon.vertex(*member),
            };
            is_image && polygon.weight(first) == polygon.weight(*member)
        })
    }

    /// How far the image of a point of the plane is from it by rounding.
    fn rounding(&self, point: DVec3) -> f64 {
        match self.mirror {
            Mirror::Signs(_) => 0.0,
            Mirror::Plane { through, .. } => ULPS * (point.length() + through.length()),
        }
    }

    /// The vertices that depend on one, itself first, each by one image; one that lies in a plane comes twice, by itself
    /// and by its image there.
    fn orbit(&self, index: usize, count: usize) -> impl Iterator<Item = Member> + use<> {
        let partner = self.partner(index, count);
        let opposite = |index: usize| (index + count / 2) % count;
        let first = [(index, [false, false]), (partner, [true, false])];
        let second = self.second.map(|_| (opposite(partner), [false, true]));
        // In a plane, half a turn gives what the other plane does, but for rounding.
        let is_in_plane = partner == index || partner == opposite(index);
        let both = self.second.filter(|_| !is_in_plane);
        let both = both.map(|_| (opposite(index), [true, true]));
        first.into_iter().chain(second).chain(both)
    }

    fn image(&self, point: DVec3, [first, second]: [bool; 2]) -> DVec3 {
        let point = if first {
            self.mirror.point(point)
        } else {
            point
        };
        match self.second.filter(|_| second) {
            Some(mirror) => mirror.point(point),
            None => point,
        }
    }

    fn foot(&self, point: DVec3, [first, second]: [bool; 2]) -> DVec3 {
        let point = if first {
            self.mirror.foot(point)
        } else {
            point
        };
        match self.second.filter(|_| second) {
            Some(mirror) => mirror.foot(point),
            None => point,
        }
    }
}

/// A direction along an axis but for rounding, as that axis.
fn along_axis(direction: DVec3) -> DVec3 {
    let axis = DVec3::from_array(direction.to_array().map(f64::round));
    match (direction - axis).length() <= ROUNDING && axis.length() == 1.0 {
        true => axis,
        false => direction,
    }
}

impl FloatPolygon {
    /// Make the polygon its own mirror image, in reversed order, by the mean of both: see [`Symmetry::completed`].
    ///
    /// # Errors
    /// [`PolygonError`] if numbers overflow.
    pub fn symmetrised(&self, mirror: &Mirror) -> Result<Self, PolygonError> {
        Symmetry::about(*mirror, self).completed(self, |_| true)
    }
}

/// The sum of the numbers of partners with which a closed polygon moves least to its mean with its mirror image.
fn least_sum(vertices: &[DVec3], mirror: &Mirror) -> usize {
    let count = vertices.len();
    let images: Vec<DVec3> = vertices.iter().map(|it| mirror.point(*it)).collect();
    let moves = |sum: usize| -> f64 {
        let pairs = vertices.iter().enumerate();
        let squares = pairs.map(|(index, vertex)| {
            let partner = (sum + count - index) % count;
            vertex.distance_squared(images[partner])
        });
        squares.sum()
    };
    (0..count)
        .min_by(|a, b| moves(*a).total_cmp(&moves(*b)))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_becomes_its_own_image_bit_for_bit() {
        let mirror = Mirror::Signs([true, false, false]);
        for count in [6, 7, 12, 13] {
            let vertex = |index: usize| {
                let t = index as f64 - 0.5 * (count - 1) as f64;
                (
                    t + 0.1 * (7.0 * t).sin(),
                    0.3 * t * t + 0.2 * (3.0 * t).cos(),
                )
            };
            let vertices: Vec<(f64, f64)> = (0..count).map(vertex).collect();
            let polygon = FloatPolygon::planar(4, &vertices).expect("a polygon");
            let symmetric = polygon.symmetrised(&mirror).expect("a polygon");
            for index in 0..count {
                let image = mirror.point(symmetric.vertex(index));
                assert_eq!(symmetric.vertex(count - 1 - index), image);
            }
            assert_eq!(symmetric.symmetrised(&mirror), Ok(symmetric));
        }
    }

    #[test]
    fn a_closed_polygon_keeps_its_place_in_its_order() {
        let mirror = Mirror::Signs([false, true, false]);
        for (count, shift) in [(12, 0.0), (12, 0.5), (13, 3.0), (10, 4.5)] {
            let vertex = |index: usize| {
                let angle = std::f64::consts::TAU * (index as f64 + shift) / count as f64;
                DVec3::new(
                    3.0 * angle.cos(),
                    2.0 * angle.sin() + 0.01 * angle.cos(),
                    0.0,
                )
            };
            let vertices: Vec<DVec3> = (0..count).map(vertex).collect();
            let polygon = FloatPolygon::new(3, vertices, None, true).expect("a polygon");
            let symmetric = polygon.symmetrised(&mirror).expect("a polygon");
            let pairs = polygon.vertices().iter().zip(symmetric.vertices());
            let moved = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(moved < 0.0101, "{count} {shift}: {moved}");
            for vertex in symmetric.vertices() {
                let image = mirror.point(*vertex);
                assert!(
                    symmetric.vertices().contains(&image),
                    "{count} {shift}: {vertex}"
                );
            }
        }
    }

    /// A closed polygon that is nearly its own image in both coordinates' planes.
    fn oval(count: usize, shift: f64) -> FloatPolygon {
        let vertex = |index: usize| {
            let angle = std::f64::consts::TAU * (index as f64 + shift) / count as f64;
            DVec3::new(3.0 * angle.cos(), 2.0 * angle.sin(), 0.0)
        };
        let vertices: Vec<DVec3> = (0..count).map(vertex).collect();
        FloatPolygon::new(3, vertices, None, true).expect("a polygon")
    }

    #[test]
    fn an_oval_has_two_axes_and_each_vertex_four_places() {
        for (count, shift) in [(12, 0.0), (12, 0.5), (10, 0.5), (6, 0.0)] {
            let polygon = oval(count, shift);
            let symmetry = Symmetry::found(&polygon, 1e-9).expect("a rule");
            assert!(symmetry.second().is_some(), "{count} {shift}");
            let symmetric = symmetry.completed(&polygon, |_| true).expect("a polygon");
            let mut moved = symmetric.clone();
            let place = symmetric.vertex(1) + DVec3::new(0.25, 0.125, 0.0);
            moved.move_vertices([(1, place)]).expect("a polygon");
            let led = symmetry
                .completed(&moved, |index| index == 1)
                .expect("a polygon");
            assert!(symmetry.mismatch(&led) == 0.0, "{count} {shift}");
            let changed = (0..count).filter(|i| led.vertex(*i) != symmetric.vertex(*i));
            let mut dependents = symmetry.dependents(1, count);
            dependents.sort_unstable();
            assert_eq!(changed.collect::<Vec<_>>(), dependents, "{count} {shift}");
        }
        // An odd number of vertices has one axis.
        let odd = Symmetry::found(&oval(9, 0.0), 1e-9).expect("a rule");
        assert_eq!(odd.second(), None);
    }

    #[test]
    fn a_polygon_that_is_turned_takes_its_plane_along() {
        let points = [(-3.0, 0.0), (-2.0, 2.0), (0.0, 3.0), (2.0, 2.0), (3.0, 0.0)];
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        let symmetry = Symmetry::found(&polygon, 1e-12).expect("a rule");
        assert_eq!(symmetry.mirror(), Mirror::of_coordinate(0));
        let turn = glam::DMat3::from_rotation_z(0.7);
        let by = DVec3::new(20.0, -7.0, 0.0);
        let vertices = polygon.vertices().iter().map(|it| turn * *it + by);
        let turned = FloatPolygon::new(3, vertices.collect(), None, false).expect("a polygon");
        let moved = symmetry.following(&turned).expect("a rule");
        assert!(moved.holds(&turned));
        let [through, normal] = moved.mirror().plane().expect("a plane");
        assert!((normal.dot(turn * DVec3::X).abs() - 1.0).abs() < 1e-14);
        assert!((through - by).dot(normal).abs() < 1e-13);
        // Back at the origin the coordinate changes its sign to the bit again.
        assert_eq!(symmetry.following(&polygon), Some(symmetry));
    }

    #[test]
    fn a_vertex_leads_its_partners_and_of_several_the_mean_does() {
        let points = [(-3.0, 0.0), (-1.0, 2.0), (1.0, 2.0), (3.0, 0.0)];
        let mut polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        let symmetry = Symmetry::about(Mirror::of_coordinate(0), &polygon);
        polygon
            .move_vertices([(2, DVec3::new(1.5, 2.5, 0.0))])
            .expect("a polygon");
        let led = symmetry
            .completed(&polygon, |index| index == 2)
            .expect("a polygon");
        assert_eq!(led.vertex(1), DVec3::new(-1.5, 2.5, 0.0));
        let mean = symmetry.completed(&polygon, |_| false).expect("a polygon");
        assert_eq!(mean.vertex(1), DVec3::new(-1.25, 2.25, 0.0));
        let from_start = symmetry.completed_from(&polygon, 0.0).expect("a polygon");
        assert_eq!(from_start.vertex(2), DVec3::new(1.0, 2.0, 0.0));
    }

    #[test]
    fn an_inserted_vertex_has_its_image_in_the_mirrored_leg() {
        let points = [(-3.0, 0.0), (-1.0, 2.0), (1.0, 2.0), (3.0, 0.0)];
        let polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        let symmetry = Symmetry::about(Mirror::of_coordinate(0), &polygon);
        let at = DVec3::new(2.0, 1.0, 0.0);
        let image = DVec3::new(-2.0, 1.0, 0.0);
        assert_eq!(symmetry.insertions(&polygon, 3, at), [(3, at), (1, image)]);
        assert_eq!(
            symmetry.insertions(&polygon, 0, image),
            [(0, image), (4, at)]
        );
        let middle = DVec3::new(0.0, 1.0, 0.0);
        assert_eq!(symmetry.insertions(&polygon, 2, at), [(2, middle)]);
    }
}
