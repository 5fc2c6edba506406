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
/// `log₂((1 + t)/(1 − t)) = 2/ln 2·(t + t³/3 + …)`, over t, in t².
const ATANH: [f64; 8] = {
    let mut terms = [0.0; 8];
    let mut k = 0;
    while k < 8 {
        terms[k] = 2.0 * core::f64::consts::LOG2_E / (2 * k + 1) as f64;
        k += 1;
    }
    terms
};
/// `2ˣ = Σ (x·ln 2)ᵏ/k!`.
const EXP2: [f64; 13] = {
    let mut terms = [1.0; 13];
    let mut k = 1;
    while k < 13 {
        terms[k] = terms[k - 1] * core::f64::consts::LN_2 / k as f64;
        k += 1;
    }
    terms
};

/// Numbers side by side.
#[derive(Clone, Copy)]
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

    /// A polynomial of it, its coefficients from the constant one up.
    #[inline(always)]
    pub(crate) fn polynomial(self, coefficients: &[f64]) -> Self {
        let mut sum = Self::of(self.0, 0.0);
        for coefficient in coefficients.iter().rev() {
            sum = sum * self + Self::of(self.0, *coefficient);
        }
        sum
    }

    /// Positive numbers to a power, by polynomials for logarithm (Mercator's series of
    /// atanh, to t¹⁵) and exponential (Taylor's, to x¹²): within 10⁻¹² of the result for powers up
    /// to 4 of numbers above 10⁻⁶. Numbers below 10⁻³⁰ are taken as 10⁻³⁰.
    #[inline(always)]
    pub(crate) fn power(self, exponent: f64) -> Self {
        let simd = self.0;
        let number = self.max(Self::of(simd, 1e-30));
        let whole =
            number.each(|x| f64::from_bits(x.to_bits() >> 52 | TWO_52) - (TWO_TO_52 + 1023.0));
        let part = number.each(|x| f64::from_bits(x.to_bits() & MANTISSA | ONE));
        let large = Self::of(simd, core::f64::consts::SQRT_2).less_than(part);
        let part = large.choose(part * 0.5, part);
        let whole = large.choose(whole + Self::of(simd, 1.0), whole);
        let one = Self::of(simd, 1.0);
        let t = (part - one).over(part + one);
        let logarithm = whole + t * (t * t).polynomial(&ATANH);
        let power = (logarithm * exponent)
            .max(Self::of(simd, -1000.0))
            .min(Self::of(simd, 1000.0));
        let magic = Self::of(simd, 1.5 * TWO_TO_52);
        let whole = (power + magic) - magic;
        let scale = whole.each(|n| f64::from_bits((n + (TWO_TO_52 + 1023.0)).to_bits() << 52));
        (power - whole).polynomial(&EXP2) * scale
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
                Lanes::read(simd, numbers).power(self.1).write(powers);
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
