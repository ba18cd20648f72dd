//! What is stated of hostile curves against exact arithmetic with multiplicities: nothing stated may
//! be wrong, intervals are disjoint, and the digits of values are right.
//!
//! `cargo test --test hostile` takes 500 curves. The longer run takes 10 000, of all degrees to 25,
//! and prints what was found by family:
//!
//!     cargo test --release --test hostile -- --ignored --nocapture
//!
//! `HOSTILE_CURVES=N` takes N curves instead, `HOSTILE_SEED=S` others. A failure names family and
//! seed; `HOSTILE_ONLY='family:seed'` repeats it.

#[path = "../common/mod.rs"]
mod common;
#[path = "../witness/mod.rs"]
mod witness;

mod check;
mod claims;
mod coincident;
mod cusps;
mod double_roots;
mod families;
mod form;
mod nearly;
mod prescribed;
mod quotient_rule;
mod scales;
mod symmetric;
mod tally;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use batten::geometry::FloatPolygon;

use check::check;
use families::{FAMILIES, Family};
use form::Reach;
use tally::Tally;

/// The degrees of the short run.
const SHORT: Reach = Reach {
    planar: 25,
    planar_rational: 12,
    space: 12,
    space_rational: 9,
};

/// The degrees of the longer run.
const LONG: Reach = Reach {
    planar: 25,
    planar_rational: 25,
    space: 25,
    space_rational: 25,
};

/// The seed of the first curve of a family.
const SEED: u64 = 1;

/// Check one curve; returns what is wrong, with all that makes the curve.
fn check_seed(family: &Family, seed: u64, reach: Reach, tally: &mut Tally) -> Option<String> {
    let curve = family.curve(seed, reach);
    let checked = catch_unwind(AssertUnwindSafe(|| check(&curve, tally)));
    let wrong = checked.unwrap_or_else(|_| vec!["a panic, printed above".into()]);
    tally.wrong += usize::from(!wrong.is_empty());
    (!wrong.is_empty()).then(|| {
        let wrong = wrong.join("\n  ");
        format!("{}:{seed}: {}\n  {wrong}\n", family.name, written(&curve))
    })
}

/// The curve as text from which it can be typed in.
fn written(curve: &FloatPolygon) -> String {
    let vertices = curve.vertices().iter();
    let vertices: Vec<_> = vertices
        .map(|vertex| {
            if curve.is_planar() {
                vec![vertex.x, vertex.y]
            } else {
                vertex.to_array().to_vec()
            }
        })
        .collect();
    format!(
        "degree {}, periodic {}, vertices {vertices:?}, weights {:?}",
        curve.degree(),
        curve.is_periodic(),
        curve.weights()
    )
}

fn check_family(family: &Family, count: u64) {
    let mut tally = Tally::default();
    let seeds = SEED..SEED + count;
    let wrong: Vec<_> = seeds
        .filter_map(|seed| check_seed(family, seed, SHORT, &mut tally))
        .collect();
    println!("{}: {tally}", family.name);
    assert!(wrong.is_empty(), "{}", wrong.concat());
    assert_eq!(tally.curves as u64, count);
    assert!(tally.proved > 0, "nothing was compared");
}

#[test]
fn nearly_straight_curves() {
    check_family(&families::NEARLY_STRAIGHT, 50);
}

#[test]
fn nearly_circular_curves() {
    check_family(&families::NEARLY_CIRCULAR, 50);
}

#[test]
fn curves_symmetric_about_a_knot() {
    check_family(&families::SYMMETRIC, 45);
}

#[test]
fn curves_with_extrema_on_knots() {
    check_family(&families::EXTREMA_ON_KNOTS, 45);
}

#[test]
fn curves_with_repeated_vertices() {
    check_family(&families::REPEATED, 45);
}

#[test]
fn curves_with_collinear_vertices() {
    check_family(&families::COLLINEAR, 45);
}

#[test]
fn curves_with_an_exact_cusp() {
    check_family(&families::CUSP, 45);
}

#[test]
fn curves_with_several_cusps_in_a_segment() {
    check_family(&families::CUSPS, 45);
}

#[test]
fn curves_with_a_near_cusp() {
    check_family(&families::NEAR_CUSP, 45);
}

#[test]
fn curves_whose_numerators_have_multiple_roots() {
    check_family(&families::MULTIPLE_ROOTS, 45);
}

#[test]
fn curves_of_mixed_scales() {
    check_family(&families::MIXED_SCALES, 40);
}

#[test]
#[ignore = "the longer run: see above"]
fn ten_thousand_hostile_curves() {
    let setting = |name: &str| std::env::var(name).ok();
    if let Some(only) = setting("HOSTILE_ONLY") {
        let (name, seed) = only.split_once(':').expect("family:seed");
        let family = FAMILIES
            .iter()
            .find(|family| family.name == name)
            .expect("a family");
        let seed = seed.parse().expect("a seed");
        for reach in [SHORT, LONG] {
            println!("{}", written(&family.curve(seed, reach)));
            let wrong = check_seed(family, seed, reach, &mut Tally::default());
            println!("{}", wrong.unwrap_or_default());
        }
        return;
    }
    let number = |name: &str, usual: u64| {
        setting(name).map_or(usual, |value| value.parse().expect("a whole number"))
    };
    let [count, seed] = [
        number("HOSTILE_CURVES", 10_000),
        number("HOSTILE_SEED", 1_000_000),
    ];
    let count = count as usize;
    let next = AtomicUsize::new(0);
    let results = Mutex::new((
        vec![(Tally::default(), Duration::ZERO, Duration::ZERO); FAMILIES.len()],
        Vec::new(),
    ));
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                break;
            }
            let family = index % FAMILIES.len();
            let mut tally = Tally::default();
            let start = Instant::now();
            let wrong = check_seed(&FAMILIES[family], seed + index as u64, LONG, &mut tally);
            let took = start.elapsed();
            let mut results = results.lock().expect("no panic");
            let (sum, all, longest) = &mut results.0[family];
            sum.join(&tally);
            *all += took;
            *longest = took.max(*longest);
            if let Some(wrong) = wrong {
                println!("{wrong}");
                results.1.push(wrong);
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let (tallies, wrong) = results.into_inner().expect("no panic");
    let mut sum = Tally::default();
    for (family, (tally, all, longest)) in FAMILIES.iter().zip(&tallies) {
        println!("{}: {tally}; {all:.1?}, at most {longest:.1?}", family.name);
        sum.join(tally);
    }
    println!("all: {sum}");
    assert!(
        wrong.is_empty(),
        "{} curves with wrong statements",
        wrong.len()
    );
    assert_eq!(sum.curves, count);
}
