//! The witness's own witness: values of curves by de Boor's algorithm and the quotient rule, and
//! polynomials with known roots.

use batten::geometry::FloatPolygon;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::SHORT;
use crate::families::FAMILIES;
use crate::witness::{ExactSegment, Polynomial, Root, exact};

type Vector = [BigRational; 3];

/// The derivatives C′, C″, C‴, C⁗ of a segment at t.
fn derivatives(curve: &FloatPolygon, segment: usize, t: &BigRational) -> [Vector; 4] {
    let homogeneous = |index: usize| {
        let weight = exact(curve.weight(index));
        let [x, y, z] = curve
            .vertex(index)
            .to_array()
            .map(|part| exact(part) * &weight);
        [x, y, z, weight]
    };
    let mut vertices: Vec<_> = (segment..=segment + curve.degree())
        .map(homogeneous)
        .collect();
    let mut jets: Vec<[BigRational; 4]> = Vec::new();
    for _ in 0..5 {
        jets.push(de_boor(&vertices, t));
        // The derivative's vertices are the differences.
        let differences = vertices.windows(2);
        vertices = differences
            .map(|pair| [0, 1, 2, 3].map(|axis| &pair[1][axis] - &pair[0][axis]))
            .collect();
    }
    let mut points: Vec<Vector> = Vec::new();
    for order in 0..5 {
        let [x, y, z, _] = &jets[order];
        let mut point = [x.clone(), y.clone(), z.clone()];
        let mut binomial = BigInt::from(1);
        for j in 1..=order {
            binomial = binomial * (order - j + 1) / j;
            for axis in 0..3 {
                point[axis] -= &jets[j][3] * &points[order - j][axis] * &binomial;
            }
        }
        points.push(point.map(|part| part / &jets[0][3]));
    }
    points.remove(0);
    points.try_into().expect("four")
}

fn de_boor(vertices: &[[BigRational; 4]], t: &BigRational) -> [BigRational; 4] {
    let mut values = vertices.to_vec();
    let degree = values.len() as i64 - 1;
    if degree < 0 {
        return [(); 4].map(|()| BigRational::zero());
    }
    for level in 1..=degree {
        let pairs = values.windows(2).enumerate();
        let between = |(index, pair): (usize, &[[BigRational; 4]])| {
            let first = BigRational::from_integer(BigInt::from(index as i64 - degree + level));
            let part = (t - first) / BigInt::from(degree - level + 1);
            [0, 1, 2, 3].map(|axis| &pair[0][axis] + (&pair[1][axis] - &pair[0][axis]) * &part)
        };
        values = pairs.map(between).collect();
    }
    values.remove(0)
}

fn dot(a: &Vector, b: &Vector) -> BigRational {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

fn sign(value: &BigRational) -> i32 {
    i32::from(value.is_positive()) - i32::from(value.is_negative())
}

#[test]
fn the_exact_segments_agree_with_the_quotient_rule() {
    let three = BigInt::from(3);
    for seed in 0..6 {
        for family in FAMILIES {
            let curve = family.curve(seed, SHORT);
            let segments = ExactSegment::all(&curve);
            let index = seed as usize % segments.len();
            let segment = &segments[index];
            for part in [0, 3, 7, 10] {
                let t = BigRational::new(BigInt::from(part), BigInt::from(10));
                let [first, second, third, fourth] = derivatives(&curve, index, &t);
                let [normal, slope] = [&second, &third].map(|other| cross(&first, other));
                let [speed, square] = [&first, &normal].map(|vector| dot(vector, vector));
                let along = dot(&first, &second) * &three;
                let in_plane = &speed * &slope[2] - &along * &normal[2];
                let in_space = &speed * dot(&normal, &slope) - &along * &square;
                let determinant = dot(&normal, &third);
                let twist = dot(&normal, &fourth) * &square
                    - &determinant * dot(&normal, &slope) * BigInt::from(2);
                let mut pairs = vec![
                    (segment.space_curvature_slope(), sign(&in_space)),
                    (segment.torsion(), sign(&determinant)),
                    (segment.torsion_slope(), sign(&twist)),
                ];
                if curve.is_planar() {
                    pairs.push((segment.curvature(), sign(&normal[2])));
                    pairs.push((segment.curvature_slope(), sign(&in_plane)));
                }
                for (polynomial, expected) in pairs {
                    assert_eq!(
                        polynomial.sign(&t),
                        expected,
                        "{}:{seed} at {t}",
                        family.name
                    );
                }
                if !speed.is_zero() {
                    let value = &square / (&speed * &speed * &speed);
                    let found = segment.curvature_at(&t, false).expect("no cusp");
                    assert_eq!(found.rational(), value);
                }
                if !square.is_zero() {
                    let found = segment.torsion_at(&t).expect("curvature");
                    assert_eq!(found.rational(), &determinant / &square);
                }
            }
        }
    }
}

fn linear(root: i64, level: u32) -> Polynomial {
    Polynomial::new(vec![BigInt::from(-root), BigInt::from(1) << level])
}

fn product(factors: &[(Polynomial, usize)]) -> Polynomial {
    let all = factors
        .iter()
        .flat_map(|(factor, times)| std::iter::repeat_n(factor, *times));
    all.fold(Polynomial::constant(-7), |product, factor| {
        product.times(factor)
    })
}

#[test]
fn multiplicities_are_taken_out() {
    // (2 t² − 1) is irreducible; (t² + 1) has no real root.
    let irrational = Polynomial::new([-1, 0, 2].map(BigInt::from).to_vec());
    let complex = Polynomial::new([1, 0, 1].map(BigInt::from).to_vec());
    let all = [
        (linear(5, 4), 3),
        (linear(3, 2), 1),
        (linear(1, 1), 2),
        (irrational, 3),
        (complex, 1),
    ];
    let factors = product(&all).factors_by_multiplicity();
    let degrees: Vec<_> = factors.iter().map(Polynomial::degree).collect();
    assert_eq!(degrees, [3, 1, 3]);
    let roots = product(&all).odd_roots();
    assert_eq!(roots.len(), 3);
    let half = BigRational::new(BigInt::from(1), BigInt::from(2));
    assert_eq!(factors[1].sign(&half), 0);
}

#[test]
fn roots_are_found_however_close_they_are() {
    let level = 60;
    let middle = 1_i64 << (level - 1);
    let close = product(&[
        (linear(middle, level), 1),
        (linear(middle + 1, level), 1),
        (linear(1, 0), 1),
        (linear(0, 0), 1),
    ]);
    let odd = close.odd_part();
    let roots = odd.simple_roots();
    assert_eq!(roots.len(), 2);
    let t = |numerator: i64| BigRational::new(BigInt::from(numerator), BigInt::from(1) << level);
    let orders = |root: &Root| {
        [middle, middle + 1].map(|numerator| root.compare(&odd, &t(numerator)) as i32)
    };
    assert_eq!(orders(&roots[0]), [0, -1]);
    assert_eq!(orders(&roots[1]), [1, 0]);
    // Powers with small gaps between the roots, as long polynomials have them.
    let comb: Vec<_> = (1..40).map(|k| (linear(3 * k, 7), 1)).collect();
    assert_eq!(product(&comb).roots_inside(), 39);
}
