//! Safe regions against a dense march and bisection with proofs of the whole curve.

use std::f64::consts::TAU;

use batten::geometry::features::Features;
use batten::geometry::vertex_moves::{
    FeatureRise, PRECISION, RayBorder, RegionSearch, SafeRegion, reach,
};
use batten::geometry::{FloatPolygon, Progress};
use glam::DVec2;

use crate::common::Random;
use crate::curves::{Case, case, moved, proved};

/// The factor from one distance of the march to the next.
const MARCH: f64 = 1.03;

/// How exactly the witness finds a border, as a share of its distance.
const WITNESS: f64 = 1e-4;

/// Count what was compared.
#[derive(Debug, Default)]
struct Tally {
    cases: usize,
    monotone: usize,
    rays: usize,
    /// Borders within the limit.
    borders: usize,
    /// Borders at the vertex itself.
    closed: usize,
    /// Rays on which the march found a border further in than it was said to be.
    missed: usize,
    /// Places inside outlines, and how many of them are not safe.
    between: usize,
    unsafe_between: usize,
}

/// The proofs of the whole curve that the region is compared with.
struct Witness<'a> {
    polygon: &'a FloatPolygon,
    vertex: usize,
    before: Features,
}

impl Witness<'_> {
    fn rise(&self, by: DVec2) -> FeatureRise {
        let place = self.polygon.vertices()[self.vertex] + by.extend(0.0);
        let after = Features::new(&moved(self.polygon, self.vertex, place));
        FeatureRise::between(&self.before, &after)
    }

    fn is_safe(&self, by: DVec2) -> bool {
        self.rise(by).is_none()
    }

    /// Find the first border on a ray by a dense march and bisection, up to a distance.
    fn border(&self, ray: &RayBorder, limit: f64) -> Option<f64> {
        let first = ray.beyond.map_or(1e-4 * limit, |(fails, _)| fails / 30.0);
        let mut holds = 0.0;
        let mut distance = first.min(1e-4 * limit);
        while distance < limit {
            if !self.is_safe(distance * ray.direction) {
                let mut fails = distance;
                while fails - holds > WITNESS * fails {
                    let middle = 0.5 * (holds + fails);
                    if self.is_safe(middle * ray.direction) {
                        holds = middle;
                    } else {
                        fails = middle;
                    }
                }
                return Some(fails);
            }
            (holds, distance) = (distance, MARCH * distance);
        }
        None
    }
}

/// Compare the finest region of a case on every so manieth ray.
fn check(number: usize, every: usize, random: &mut Random, tally: &mut Tally) {
    let Case {
        polygon,
        vertex,
        monotone,
    } = case(number);
    let mut search = RegionSearch::new(&polygon, &proved(&polygon), vertex)
        .expect("a planar curve without doubts");
    while !search.is_done() {
        assert!(search.refine(&Progress::default()));
    }
    let region = search.region();
    let witness = Witness {
        before: Features::new(&polygon),
        polygon: &polygon,
        vertex,
    };
    tally.cases += 1;
    tally.monotone += usize::from(monotone);
    for ray in region.rays.iter().step_by(every) {
        check_ray(number, &witness, ray, region.limit, tally);
    }
    check_between(&witness, region, random, tally);
}

fn check_ray(number: usize, witness: &Witness, ray: &RayBorder, limit: f64, tally: &mut Tally) {
    tally.rays += 1;
    let RayBorder {
        direction,
        safe,
        beyond,
    } = *ray;
    assert!(witness.is_safe(safe * direction), "case {number}: {ray:?}");
    let said = match beyond {
        Some((fails, rise)) => {
            tally.borders += 1;
            tally.closed += usize::from(safe == 0.0);
            assert_eq!(witness.rise(fails * direction), rise, "case {number}");
            let near = fails - safe <= PRECISION * fails || fails <= 1e-9 * limit;
            assert!(near, "case {number}: {ray:?}");
            fails
        }
        None => {
            assert_eq!(safe, limit);
            limit
        }
    };
    if let Some(border) = witness.border(ray, said)
        && border < (1.0 - PRECISION) * said
    {
        tally.missed += 1;
        println!("case {number}: {border} is not safe, said to be up to {said}");
    }
}

/// Try as many places inside the outline as it has rays, evenly by area.
fn check_between(witness: &Witness, region: &SafeRegion, random: &mut Random, tally: &mut Tally) {
    let corners: Vec<DVec2> = region
        .rays
        .iter()
        .map(|ray| ray.safe * ray.direction)
        .collect();
    let next = |index: usize| corners[(index + 1) % corners.len()];
    let areas = (0..corners.len()).scan(0.0, |sum, index| {
        *sum += corners[index].perp_dot(next(index));
        Some(*sum)
    });
    let areas: Vec<f64> = areas.collect();
    let whole = areas.last().copied().unwrap_or(0.0);
    for _ in &corners {
        let share = random.between(0.0, whole);
        let index = areas.iter().position(|area| *area >= share).unwrap_or(0);
        let (out, aside) = (random.between(0.0, 1.0).sqrt(), random.between(0.0, 1.0));
        let by = out * corners[index].lerp(next(index), aside);
        tally.between += 1;
        tally.unsafe_between += usize::from(!witness.is_safe(by));
    }
}

fn compare(cases: impl Iterator<Item = usize>, every: usize) -> Tally {
    let mut tally = Tally::default();
    let mut random = Random(1000);
    for number in cases {
        check(number, every, &mut random, &mut tally);
    }
    println!("{tally:?}");
    println!(
        "{:.4} % of the places between rays are not safe",
        100.0 * tally.unsafe_between as f64 / tally.between as f64
    );
    tally
}

/// What holds of so many cases.
fn check_tally(tally: &Tally) {
    assert!(tally.monotone * 5 >= tally.cases, "{tally:?}");
    assert!(tally.borders * 2 >= tally.rays, "{tally:?}");
    assert_eq!(tally.missed, 0, "{tally:?}");
}

#[test]
fn borders_on_rays_are_right_to_a_hundredth() {
    // Every degree, and every kind of curve.
    check_tally(&compare((0..1000).step_by(71), 24));
}

#[test]
#[ignore = "takes minutes: cargo test --release --test vertex_moves -- --ignored --nocapture"]
fn borders_of_a_thousand_cases_are_right_to_a_hundredth() {
    check_tally(&compare(0..1000, 12));
}

#[test]
fn finer_levels_keep_to_the_coarse_ones() {
    let Case {
        polygon, vertex, ..
    } = case(20);
    let mut search = RegionSearch::new(&polygon, &proved(&polygon), vertex).expect("a region");
    let mut before = 0;
    while !search.is_done() {
        assert!(search.refine(&Progress::default()));
        let count = search.region().rays.len();
        assert!(count >= 2 * before);
        before = count;
        let region = search.region();
        assert_eq!(region.outline().count(), count);
        let turn = |ray: &RayBorder| ray.direction.to_angle().rem_euclid(TAU);
        assert!(region.rays.is_sorted_by(|a, b| turn(a) < turn(b)));
    }
    assert_eq!(search.region().limit, reach(&polygon, vertex));
}

#[test]
fn a_cancelled_search_keeps_what_it_had() {
    let Case {
        polygon, vertex, ..
    } = case(3);
    let mut search = RegionSearch::new(&polygon, &proved(&polygon), vertex).expect("a region");
    assert!(search.refine(&Progress::default()));
    let coarse = search.region().clone();
    let cancelled = Progress::default();
    cancelled.cancel();
    assert!(!search.refine(&cancelled));
    assert_eq!(*search.region(), coarse);
}

#[test]
fn degenerate_polygons_have_a_region_too() {
    // All in one place: there is no length to look within.
    let point = FloatPolygon::planar(3, &[(1.0, 2.0); 6]).expect("a polygon");
    let features = Features::new(&point);
    if features.undecided.is_empty() && features.cusps.iter().all(|cusp| cusp.proved) {
        let search = RegionSearch::new(&point, &proved(&point), 2).expect("a region");
        assert!(search.is_done() && search.region().limit == 0.0);
    }
    // On a straight line every step aside adds an extremum, and none along it does.
    let line: Vec<(f64, f64)> = (0..9).map(|x| (f64::from(x), 0.0)).collect();
    let line = FloatPolygon::planar(4, &line).expect("a polygon");
    let mut search = RegionSearch::new(&line, &proved(&line), 4).expect("a region");
    assert!(search.refine(&Progress::default()));
    let rays = &search.region().rays;
    assert!(rays[0].safe > 0.0);
    let aside = rays.iter().filter(|ray| ray.direction.y.abs() > 0.4);
    for ray in aside {
        assert!(ray.safe == 0.0 && ray.beyond.is_some(), "{ray:?}");
    }
}
