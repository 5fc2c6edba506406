//! Numbers as matrices store them: in 64 bits, or in 32 where what they lead to is checked by others
//! and half the memory counts for more than digits.
//!
//! As in [`lanes`](crate::lanes), every operation acts on each number by itself and rounds as the same
//! operation on one number does.

use crate::lanes::Simd;
use core::{
    fmt::Debug,
    ops::{Add, AddAssign, Div, Mul, Sub, SubAssign},
};

/// A number as it is stored, by itself or beside others.
pub(super) trait Number:
    Copy
    + Default
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
{
    /// As many as no processor exceeds at once.
    const WIDEST: usize;
    /// As many as the processor takes at once.
    type Many<S: Simd>: Copy;

    fn of(number: f64) -> Self;
    fn number(self) -> f64;
    fn root(self) -> Self;

    /// The same number in each lane.
    fn each<S: Simd>(self, simd: S) -> Self::Many<S>;
    /// The first numbers of a list; 0 where it ends.
    fn read<S: Simd>(simd: S, numbers: &[Self]) -> Self::Many<S>;
    /// Writes them to the front of a list, as far as it goes.
    fn write<S: Simd>(simd: S, many: Self::Many<S>, numbers: &mut [Self]);
    fn sum<S: Simd>(simd: S, a: Self::Many<S>, b: Self::Many<S>) -> Self::Many<S>;
    fn difference<S: Simd>(simd: S, a: Self::Many<S>, b: Self::Many<S>) -> Self::Many<S>;
    fn product<S: Simd>(simd: S, a: Self::Many<S>, b: Self::Many<S>) -> Self::Many<S>;
    fn quotient<S: Simd>(simd: S, a: Self::Many<S>, b: Self::Many<S>) -> Self::Many<S>;

    /// How many the processor takes at once.
    #[inline(always)]
    fn count<S: Simd>() -> usize {
        size_of::<Self::Many<S>>() / size_of::<Self>()
    }
}

macro_rules! number {
    ($number:ty, $many:ident, $widest:literal, $each:ident, $as:ident, $as_mut:ident, $load:ident,
     $store:ident, $add:ident, $sub:ident, $mul:ident, $div:ident) => {
        impl Number for $number {
            const WIDEST: usize = $widest;
            type Many<S: Simd> = S::$many;

            #[inline(always)]
            fn of(number: f64) -> Self {
                number as Self
            }

            #[inline(always)]
            fn number(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn each<S: Simd>(self, simd: S) -> S::$many {
                simd.$each(self)
            }

            #[inline(always)]
            fn read<S: Simd>(simd: S, numbers: &[Self]) -> S::$many {
                match S::$as(numbers).0.first() {
                    Some(many) => *many,
                    None => simd.$load(numbers),
                }
            }

            #[inline(always)]
            fn write<S: Simd>(simd: S, many: S::$many, numbers: &mut [Self]) {
                match S::$as_mut(numbers).0.first_mut() {
                    Some(place) => *place = many,
                    None => simd.$store(numbers, many),
                }
            }

            #[inline(always)]
            fn sum<S: Simd>(simd: S, a: S::$many, b: S::$many) -> S::$many {
                simd.$add(a, b)
            }

            #[inline(always)]
            fn difference<S: Simd>(simd: S, a: S::$many, b: S::$many) -> S::$many {
                simd.$sub(a, b)
            }

            #[inline(always)]
            fn product<S: Simd>(simd: S, a: S::$many, b: S::$many) -> S::$many {
                simd.$mul(a, b)
            }

            #[inline(always)]
            fn quotient<S: Simd>(simd: S, a: S::$many, b: S::$many) -> S::$many {
                simd.$div(a, b)
            }
        }
    };
}

number!(
    f64,
    f64s,
    8,
    splat_f64s,
    as_simd_f64s,
    as_mut_simd_f64s,
    partial_load_f64s,
    partial_store_f64s,
    add_f64s,
    sub_f64s,
    mul_f64s,
    div_f64s
);
number!(
    f32,
    f32s,
    16,
    splat_f32s,
    as_simd_f32s,
    as_mut_simd_f32s,
    partial_load_f32s,
    partial_store_f32s,
    add_f32s,
    sub_f32s,
    mul_f32s,
    div_f32s
);
