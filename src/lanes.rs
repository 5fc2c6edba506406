//! Numbers side by side: as many at once as the processor takes, found out when the program runs.
//!
//! Every operation acts on each number by itself and rounds as the same operation on one number
//! does: none is fused with another, none adds up lanes. So a result has the same bits whether one,
//! four or eight numbers are taken at once.

use core::ops::{Add, AddAssign, Mul, Neg, Sub};
#[cfg(test)]
pub(crate) use pulp::Scalar as OneByOne;
pub(crate) use pulp::{Simd, WithSimd};

/// Numbers that no processor exceeds at once: lists are filled up to a multiple of this.
pub(crate) const WIDEST: usize = 8;

/// Does a work with the widest lanes there are.
pub(crate) fn widest<Work: WithSimd>(work: Work) -> Work::Output {
    pulp::Arch::new().dispatch(work)
}

const TWO_TO_52: f64 = 4_503_599_627_370_496.0;
/// The bits of 2⁵², of 1, and of a number's part after the point.
const TWO_52: u64 = 0x4330_0000_0000_0000;
const ONE: u64 = 0x3FF0_0000_0000_0000;
const MANTISSA: u64 = 0x000F_FFFF_FFFF_FFFF;
/// `log₂((1 + t)/(1 − t))` over t, in t², for numbers from 1/√2 to √2: Chebyshev's interpolation,
/// within 10⁻¹³.
const ATANH: [f64; 6] = [
    2.885_390_081_777_850_4,
    0.961_796_694_112_359_5,
    0.577_077_942_630_261_8,
    0.412_209_227_330_524_45,
    0.319_906_660_889_147_4,
    0.282_887_182_630_735_65,
];
/// `2ˣ` from −½ to ½: Chebyshev's interpolation, within 2·10⁻¹⁴.
const EXP2: [f64; 10] = [
    1.000_000_000_000_013_5,
    0.693_147_180_559_946_2,
    0.240_226_506_956_403_4,
    0.055_504_108_664_651_67,
    0.009_618_129_193_934_313,
    0.001_333_355_820_079_459_2,
    0.000_154_034_337_512_510_1,
    0.000_015_252_672_924_850_737,
    0.000_001_325_964_524_488_711,
    0.000_000_102_059_054_137_655_95,
];

/// Numbers side by side, each as wide as a line of the cache: what lies across two takes twice as long.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Lanes<S: Simd>(S, S::f64s);

impl<S: Simd> Lanes<S> {
    /// How many there are.
    pub(crate) const COUNT: usize = S::F64_LANES;

    /// The same number in each.
    #[inline(always)]
    pub(crate) fn of(simd: S, number: f64) -> Self {
        Self(simd, simd.splat_f64s(number))
    }

    /// The first numbers of a list; 0 where it ends.
    #[inline(always)]
    pub(crate) fn read(simd: S, numbers: &[f64]) -> Self {
        match S::as_simd_f64s(numbers).0.first() {
            Some(lanes) => Self(simd, *lanes),
            None => Self(simd, simd.partial_load_f64s(numbers)),
        }
    }

    /// Writes them to the front of a list.
    #[inline(always)]
    pub(crate) fn write(self, numbers: &mut [f64]) {
        match S::as_mut_simd_f64s(numbers).0.first_mut() {
            Some(lanes) => *lanes = self.1,
            None => self.0.partial_store_f64s(numbers, self.1),
        }
    }

    /// Each by a function of one number.
    #[inline(always)]
    pub(crate) fn each(self, of: impl Fn(f64) -> f64) -> Self {
        let mut numbers = [0.0; WIDEST];
        self.write(&mut numbers);
        for number in &mut numbers[..Self::COUNT] {
            *number = of(*number);
        }
        Self::read(self.0, &numbers)
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        Self(self.0, self.0.abs_f64s(self.1))
    }

    #[inline(always)]
    pub(crate) fn over(self, other: Self) -> Self {
        Self(self.0, self.0.div_f64s(self.1, other.1))
    }

    /// The greater of both.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        other.less_than(self).choose(self, other)
    }

    /// The lesser of both.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.less_than(other).choose(self, other)
    }

    /// Where it is less than another.
    #[inline(always)]
    pub(crate) fn less_than(self, other: Self) -> Where<S> {
        Where(self.0, self.0.less_than_f64s(self.1, other.1))
    }

    /// Whether one of them is below a number.
    #[inline(always)]
    pub(crate) fn any_below(self, number: f64) -> bool {
        self.less_than(Self::of(self.0, number)).anywhere()
    }

    /// Whether one of them is above a number.
    #[inline(always)]
    pub(crate) fn any_above(self, number: f64) -> bool {
        Self::of(self.0, number).less_than(self).anywhere()
    }

    /// A polynomial of each of some, its coefficients from the constant one up. Each term waits for the
    /// one before it, several times as long as it takes: so several are summed up in step.
    #[inline(always)]
    pub(crate) fn polynomials<const N: usize>(
        numbers: [Self; N],
        coefficients: &[f64],
    ) -> [Self; N] {
        let (last, others) = coefficients.split_last().unwrap_or((&0.0, &[]));
        let mut sums = numbers;
        for sum in &mut sums {
            *sum = Self::of(sum.0, *last);
        }
        for coefficient in others.iter().rev() {
            for (sum, number) in sums.iter_mut().zip(numbers) {
                *sum = *sum * number + Self::of(number.0, *coefficient);
            }
        }
        sums
    }

    /// Positive numbers to a power each, by polynomials for logarithm and exponential: within 10⁻¹² of the
    /// result for powers up to 4 of numbers above 10⁻⁶. Numbers below 10⁻³⁰ are taken as 10⁻³⁰.
    #[inline(always)]
    pub(crate) fn powers<const N: usize>(numbers: [Self; N], exponents: [f64; N]) -> [Self; N] {
        let mut powers = Self::logarithms(numbers);
        for (power, exponent) in powers.iter_mut().zip(exponents) {
            let simd = power.0;
            let least = Self::of(simd, -1000.0);
            *power = (*power * exponent).max(least).min(Self::of(simd, 1000.0));
        }
        Self::powers_of_two(powers)
    }

    /// Logarithms to the base of 2 of numbers above 0.
    #[inline(always)]
    fn logarithms<const N: usize>(numbers: [Self; N]) -> [Self; N] {
        let (mut wholes, mut parts, mut squares) = (numbers, numbers, numbers);
        for k in 0..N {
            (wholes[k], parts[k]) = numbers[k].split();
            squares[k] = parts[k] * parts[k];
        }
        let series = Self::polynomials(squares, &ATANH);
        for k in 0..N {
            wholes[k] = wholes[k] + parts[k] * series[k];
        }
        wholes
    }

    /// n and t of numbers 2ⁿ·(1 + t)/(1 − t) above 0, |t| < 0.172.
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let simd = self.0;
        let one = Self::of(simd, 1.0);
        let number = self.max(Self::of(simd, 1e-30));
        let whole =
            number.each(|x| f64::from_bits(x.to_bits() >> 52 | TWO_52) - (TWO_TO_52 + 1023.0));
        let part = number.each(|x| f64::from_bits(x.to_bits() & MANTISSA | ONE));
        let large = Self::of(simd, core::f64::consts::SQRT_2).less_than(part);
        let part = large.choose(part * 0.5, part);
        let whole = large.choose(whole + one, whole);
        (whole, (part - one).over(part + one))
    }

    /// 2 to powers between −1000 and 1000.
    #[inline(always)]
    fn powers_of_two<const N: usize>(powers: [Self; N]) -> [Self; N] {
        let (mut wholes, mut parts) = (powers, powers);
        for (whole, part) in wholes.iter_mut().zip(&mut parts) {
            let magic = Self::of(part.0, 1.5 * TWO_TO_52);
            *whole = (*part + magic) - magic;
            *part = *part - *whole;
        }
        let mut results = Self::polynomials(parts, &EXP2);
        let scale = |n: f64| f64::from_bits((n + (TWO_TO_52 + 1023.0)).to_bits() << 52);
        for (result, whole) in results.iter_mut().zip(wholes) {
            *result = *result * whole.each(scale);
        }
        results
    }

    /// The lanes' own kind, to make others of.
    #[inline(always)]
    pub(crate) fn kind(self) -> S {
        self.0
    }
}

/// Lanes in which something holds.
#[derive(Clone, Copy)]
pub(crate) struct Where<S: Simd>(S, S::m64s);

impl<S: Simd> Where<S> {
    /// Whether it holds in one of them.
    #[inline(always)]
    pub(crate) fn anywhere(self) -> bool {
        self.0.first_true_m64s(self.1) < S::F64_LANES
    }

    /// One number where it holds, the other elsewhere.
    #[inline(always)]
    pub(crate) fn choose(self, here: Lanes<S>, elsewhere: Lanes<S>) -> Lanes<S> {
        Lanes(self.0, self.0.select_f64s(self.1, here.1, elsewhere.1))
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0, self.0.add_f64s(self.1, other.1))
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0, self.0.sub_f64s(self.1, other.1))
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0, self.0.mul_f64s(self.1, other.1))
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, number: f64) -> Self {
        self * Self::of(self.0, number)
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.neg_f64s(self.1))
    }
}

/// Points side by side.
#[derive(Clone, Copy)]
pub(crate) struct Points<S: Simd>(pub(crate) [Lanes<S>; 3]);

impl<S: Simd> Points<S> {
    /// All at the origin.
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self([Lanes::of(simd, 0.0); 3])
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Lanes<S> {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    #[inline(always)]
    pub(crate) fn norm(self) -> Lanes<S> {
        self.dot(self).sqrt()
    }
}

impl<S: Simd> Add for Points<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a + d, b + e, c + f])
    }
}

impl<S: Simd> Sub for Points<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a - d, b - e, c - f])
    }
}

impl<S: Simd> Mul<Lanes<S>> for Points<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Lanes<S>) -> Self {
        let [a, b, c] = self.0;
        Self([a * factor, b * factor, c * factor])
    }
}

impl<S: Simd> AddAssign for Points<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Powers<'a>(&'a [f64], f64);

    impl WithSimd for Powers<'_> {
        type Output = Vec<f64>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
            let mut powers = vec![0.0; self.0.len()];
            for (numbers, powers) in self
                .0
                .chunks(Lanes::<S>::COUNT)
                .zip(powers.chunks_mut(Lanes::<S>::COUNT))
            {
                let [power] = Lanes::powers([Lanes::read(simd, numbers)], [self.1]);
                power.write(powers);
            }
            powers
        }
    }

    #[test]
    fn powers_are_libms_to_one_in_ten_to_the_twelve_and_the_same_bits_one_at_a_time() {
        let numbers: Vec<f64> = (0..997)
            .map(|k| 1e-6 * libm::exp(0.014 * f64::from(k)))
            .collect();
        for exponent in [0.0, 0.7, 1.8, 2.8, 4.0] {
            let wide = widest(Powers(&numbers, exponent));
            assert_eq!(wide, Powers(&numbers, exponent).with_simd(OneByOne));
            for (number, power) in numbers.iter().zip(wide) {
                let expected = libm::pow(*number, exponent);
                assert!(
                    (power - expected).abs() <= 1e-12 * expected,
                    "{number} ^ {exponent}"
                );
            }
        }
    }
}
