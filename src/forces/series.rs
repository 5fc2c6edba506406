//! Laws of angles by their cosines, for many angles at once and without a sine, a cosine or their
//! inverses: with c the cosine between two rods, the law `½·k·(θ − θ₀)²` has the slope
//! `k·(θ₀ − θ)/sin θ` by c, and `θ/sin θ` is a polynomial of `1 − c`.
//!
//! Angles that are little bent or sheared, as most are, need few terms. Which polynomial an angle
//! takes depends on nothing but itself, so that results do not depend on which angles stand together.

use crate::lanes::{Lanes, Simd};

/// `θ/sin θ` in `1 − cos θ`, from 0° to 90°: Chebyshev's interpolation, within 6·10⁻¹⁰.
const ARC_OVER_SINE: [f64; 12] = [
    0.999_999_999_723_412_5,
    0.333_333_412_856_133_6,
    0.133_329_574_986_237_5,
    0.057_211_907_885_685_725,
    0.024_746_922_870_720_806,
    0.015_116_314_108_640_3,
    -0.006_956_934_755_601_454,
    0.029_797_453_221_689_956,
    -0.038_254_705_381_013_7,
    0.036_507_088_698_214_035,
    -0.018_817_364_088_836_14,
    0.004_782_656_130_823_653,
];
/// The same up to [`LITTLE_BENT`] (26°), within 3·10⁻¹⁰.
const ARC_OVER_SINE_LITTLE_BENT: [f64; 5] = [
    1.000_000_000_253_59,
    0.333_333_206_655_499_1,
    0.133_343_418_393_145_37,
    0.056_863_496_710_065_16,
    0.028_513_697_273_955_543,
];
const LITTLE_BENT: f64 = 0.1;

/// `(π/2 − θ)/(sin θ·cos θ)` in `cos² θ`, up to [`NEARLY_SQUARE`]: Chebyshev's interpolation,
/// within 3·10⁻⁹.
const SHEAR_OVER_COSINE: [f64; 9] = [
    1.000_000_001_330_611_2,
    0.666_666_069_168_655,
    0.533_377_113_607_841_7,
    0.455_919_970_565_827_8,
    0.423_245_723_164_520_73,
    0.240_614_543_893_685_28,
    0.900_963_914_635_905_2,
    -1.022_494_759_414_104_3,
    1.796_122_027_024_888,
];
/// The same up to [`LITTLE_SHEARED`] (16°), within 4·10⁻⁹.
const SHEAR_OVER_COSINE_LITTLE_SHEARED: [f64; 5] = [
    1.000_000_002_859_550_6,
    0.666_664_882_092_657_8,
    0.533_510_404_494_458_5,
    0.451_051_369_768_998_84,
    0.490_076_960_054_683_15,
];
const LITTLE_SHEARED: f64 = 0.08;
/// Corners sheared by less than this (37°), by the square of the sine, need no square root.
const NEARLY_SQUARE: f64 = 0.36;

/// Slopes of a straight angle's law by cosines, `−θ/sin θ`, where none of the angles is obtuse.
#[inline(always)]
pub(super) fn straight_slopes<S: Simd, const N: usize>(cosines: [Lanes<S>; N]) -> [Lanes<S>; N] {
    let mut slopes = arcs_over_sines(cosines);
    for slope in &mut slopes {
        *slope = -*slope;
    }
    slopes
}

/// Whether one of some angles is obtuse.
#[inline(always)]
pub(super) fn any_obtuse<S: Simd, const N: usize>(cosines: [Lanes<S>; N]) -> bool {
    let mut least = cosines[0];
    for cosine in &cosines[1..] {
        least = least.min(*cosine);
    }
    least.any_below(0.0)
}

/// Slopes of any bends' laws by their cosines, with these angles at rest, given those of straight ones.
#[inline(always)]
pub(super) fn bend_slopes<S: Simd, const N: usize>(
    cosines: [Lanes<S>; N],
    rests: [Lanes<S>; N],
    straight: [Lanes<S>; N],
) -> [Lanes<S>; N] {
    let mut slopes = straight;
    for ((slope, cosine), rest) in slopes.iter_mut().zip(cosines).zip(rests) {
        let straight = *slope;
        let number = |number| Lanes::of(cosine.kind(), number);
        let any = any_slope(cosine, -straight, rest, over_sine(cosine));
        // Straight rods at rest: 0/0, in the limit −1.
        let little = number(0.5).less_than(cosine);
        let bent = number(0.0).less_than(rest);
        *slope = bent.choose(any, little.choose(straight, any));
    }
    slopes
}

/// Slopes of right corners' laws by their cosines, where none is sheared by more than 37°.
#[inline(always)]
pub(super) fn right_slopes<S: Simd, const N: usize>(
    cosines: [Lanes<S>; N],
    squares: [Lanes<S>; N],
) -> [Lanes<S>; N] {
    let mut slopes = series(
        squares,
        &SHEAR_OVER_COSINE_LITTLE_SHEARED,
        LITTLE_SHEARED,
        &SHEAR_OVER_COSINE,
    );
    for (slope, cosine) in slopes.iter_mut().zip(cosines) {
        *slope = *slope * cosine;
    }
    slopes
}

/// Whether one of some corners, by the squares of their cosines, is sheared by more than 37°.
#[inline(always)]
pub(super) fn any_oblique<S: Simd, const N: usize>(squares: [Lanes<S>; N]) -> bool {
    greatest(squares).any_above(NEARLY_SQUARE)
}

/// Slopes of any corners' laws by their cosines, with these angles at rest, and 1/sin² θ, given both of
/// nearly square ones.
#[inline(always)]
pub(super) fn corner_slopes<S: Simd, const N: usize>(
    cosines: [Lanes<S>; N],
    rests: [Lanes<S>; N],
    (right, nearly_one): ([Lanes<S>; N], [Lanes<S>; N]),
) -> ([Lanes<S>; N], [Lanes<S>; N]) {
    let (mut slopes, mut factors) = (right, nearly_one);
    for k in 0..N {
        let (cosine, rest) = (cosines[k], rests[k]);
        let number = |number| Lanes::of(cosine.kind(), number);
        let square = cosine * cosine;
        let over_sine = over_sine(cosine);
        let off = (rest - number(core::f64::consts::FRAC_PI_2)).abs();
        let beyond = square - square.min(number(NEARLY_SQUARE));
        let nearly = (off + beyond).less_than(number(1e-12));
        let [arc] = arcs_over_sines([cosine]);
        let any = any_slope(cosine, arc, rest, over_sine);
        slopes[k] = nearly.choose(slopes[k], any);
        factors[k] = nearly.choose(factors[k], over_sine * over_sine);
    }
    (slopes, factors)
}

#[inline(always)]
fn over_sine<S: Simd>(cosine: Lanes<S>) -> Lanes<S> {
    let number = |number| Lanes::of(cosine.kind(), number);
    // As in `turn`, rods folded onto each other have no direction to open.
    let square = (number(1.0) - cosine * cosine).max(number(1e-18));
    number(1.0).over(square.sqrt())
}

/// `(θ₀ − θ)/sin θ`, with `θ/sin θ` of the acute one of the angle and its supplement.
#[inline(always)]
fn any_slope<S: Simd>(
    cosine: Lanes<S>,
    acute: Lanes<S>,
    rest: Lanes<S>,
    over_sine: Lanes<S>,
) -> Lanes<S> {
    let number = |number| Lanes::of(cosine.kind(), number);
    let blunt = cosine.less_than(number(0.0));
    // An obtuse angle is π less an acute one.
    let from = blunt.choose(rest - number(core::f64::consts::PI), rest);
    from * over_sine + blunt.choose(acute, -acute)
}

/// `θ/sin θ` of the acute ones of angles with these cosines and their supplements.
#[inline(always)]
fn arcs_over_sines<S: Simd, const N: usize>(cosines: [Lanes<S>; N]) -> [Lanes<S>; N] {
    let mut from_one = cosines;
    for number in &mut from_one {
        *number = Lanes::of(number.kind(), 1.0) - number.abs();
    }
    series(
        from_one,
        &ARC_OVER_SINE_LITTLE_BENT,
        LITTLE_BENT,
        &ARC_OVER_SINE,
    )
}

/// One polynomial of numbers up to a limit, another beyond.
#[inline(always)]
fn series<S: Simd, const N: usize>(
    numbers: [Lanes<S>; N],
    short: &[f64],
    limit: f64,
    long: &[f64],
) -> [Lanes<S>; N] {
    let mut sums = Lanes::polynomials(numbers, short);
    if greatest(numbers).any_above(limit) {
        let longer = Lanes::polynomials(numbers, long);
        for ((sum, longer), number) in sums.iter_mut().zip(longer).zip(numbers) {
            let limit = Lanes::of(number.kind(), limit);
            *sum = limit.less_than(number).choose(longer, *sum);
        }
    }
    sums
}

#[inline(always)]
fn greatest<S: Simd, const N: usize>(numbers: [Lanes<S>; N]) -> Lanes<S> {
    let mut greatest = numbers[0];
    for number in &numbers[1..] {
        greatest = greatest.max(*number);
    }
    greatest
}
