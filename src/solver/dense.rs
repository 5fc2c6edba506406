//! Dense Cholesky of the first columns of a front, panel by panel, in tiles that stay in registers.
//!
//! 1. The panel's own triangle is factored.
//! 2. The rows below it are laid out in strips, as wide as the widest processor's lanes (eight numbers
//!    of 64 bits, sixteen of 32), each solved with the triangle.
//! 3. What the strips make with each other is taken off the columns after the panel.
//!
//! Every number is the sum of the same products in the same order whatever the machine: no fused
//! multiply-add, no sum split over lanes. Strips and trailing columns may be shared out over cores.

use super::number::Number;
use crate::{
    lanes::{Simd, WithSimd, widest},
    threads,
};

/// Columns that are factored before the rest of the front is updated with them.
const PANEL: usize = 48;

/// Factors the first `pivots` columns of a symmetric matrix (lower half, column-major, `order`
/// rows) in place: on return they hold L, and the rest holds the Schur complement.
///
/// `false` when a pivot is not positive: the matrix is not positive definite.
pub(super) fn factor<T: Number>(matrix: &mut [T], order: usize, pivots: usize) -> bool {
    let mut start = 0;
    while start < pivots {
        let width = PANEL.min(pivots - start);
        if !factor_triangle(matrix, order, start, width) {
            return false;
        }
        let below = start + width;
        let mut strips = pack(matrix, order, start, width);
        let triangle = triangle(matrix, order, start, width);
        threads::for_each_chunk(&mut strips, width * T::WIDEST, |_, strip| {
            widest(Solve {
                triangle: &triangle,
                strip,
            });
        });
        unpack(&strips, matrix, order, start, width);
        threads::for_each_chunk(
            &mut matrix[below * order..],
            T::WIDEST * order,
            |block, columns| {
                widest(Update {
                    columns,
                    order,
                    below,
                    block,
                    size: width * T::WIDEST,
                    strips: &strips,
                });
            },
        );
        start = below;
    }
    true
}

/// Factors the rows and columns `start..start + width`.
fn factor_triangle<T: Number>(matrix: &mut [T], order: usize, start: usize, width: usize) -> bool {
    let below = start + width;
    for column in start..below {
        let (before, here) = matrix.split_at_mut(column * order);
        let here = &mut here[column..below];
        for earlier in before[start * order..].chunks_exact(order) {
            let earlier = &earlier[column..below];
            let factor = earlier[0];
            for (entry, other) in here.iter_mut().zip(earlier) {
                *entry -= factor * *other;
            }
        }
        let pivot = here[0].number();
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let root = here[0].root();
        here[0] = root;
        for entry in &mut here[1..] {
            *entry = *entry / root;
        }
    }
    true
}

/// The rows of the panel's triangle one after the other, each up to its diagonal.
fn triangle<T: Number>(matrix: &[T], order: usize, start: usize, width: usize) -> Vec<T> {
    let row = |k: usize| (0..=k).map(move |c| matrix[(start + c) * order + start + k]);
    (0..width).flat_map(row).collect()
}

/// The panel's rows below its triangle, strip by strip, so that a tile reads them in order; rows that
/// the last strip lacks are 0.
fn pack<T: Number>(matrix: &[T], order: usize, start: usize, width: usize) -> Vec<T> {
    let below = start + width;
    let size = width * T::WIDEST;
    let mut strips = vec![T::default(); (order - below).div_ceil(T::WIDEST) * size];
    let columns = matrix[start * order..below * order].chunks_exact(order);
    for (k, column) in columns.enumerate() {
        let rows = column[below..].chunks(T::WIDEST);
        for (strip, rows) in strips.chunks_exact_mut(size).zip(rows) {
            strip[k * T::WIDEST..][..rows.len()].copy_from_slice(rows);
        }
    }
    strips
}

/// The strips back in their places.
fn unpack<T: Number>(strips: &[T], matrix: &mut [T], order: usize, start: usize, width: usize) {
    let below = start + width;
    let columns = matrix[start * order..below * order].chunks_exact_mut(order);
    for (k, column) in columns.enumerate() {
        let rows = column[below..].chunks_mut(T::WIDEST);
        for (strip, rows) in strips.chunks_exact(width * T::WIDEST).zip(rows) {
            rows.copy_from_slice(&strip[k * T::WIDEST..][..rows.len()]);
        }
    }
}

/// A strip of the rows below a triangle, to be solved with it.
struct Solve<'a, T> {
    /// The triangle's rows, each up to its diagonal.
    triangle: &'a [T],
    /// The strip's numbers for each of its columns.
    strip: &'a mut [T],
}

impl<T: Number> WithSimd for Solve<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match T::WIDEST / T::count::<S>() {
            1 => self.by::<S, 1>(simd),
            2 => self.by::<S, 2>(simd),
            4 => self.by::<S, 4>(simd),
            8 => self.by::<S, 8>(simd),
            _ => self.by::<S, 16>(simd),
        }
    }
}

impl<T: Number> Solve<'_, T> {
    /// A strip's rows by so many lanes' full.
    #[inline(always)]
    fn by<S: Simd, const LANES: usize>(self, simd: S) {
        let mut row = self.triangle;
        for column in 0..self.strip.len() / T::WIDEST {
            let (factors, rest) = row.split_at(column + 1);
            row = rest;
            let (solved, here) = self.strip.split_at_mut(column * T::WIDEST);
            let mut sums = strip::<T, S, LANES>(simd, here);
            for (rows, factor) in solved.chunks_exact(T::WIDEST).zip(factors) {
                let factor = factor.each(simd);
                for (sum, other) in sums.iter_mut().zip(strip::<T, S, LANES>(simd, rows)) {
                    *sum = T::difference(simd, *sum, T::product(simd, factor, other));
                }
            }
            let root = factors[column].each(simd);
            for (sum, to) in sums.iter().zip(here.chunks_exact_mut(T::count::<S>())) {
                T::write(simd, T::quotient(simd, *sum, root), to);
            }
        }
    }
}

/// The columns of one block after a panel, as many as a strip has rows, and the panel's strips.
struct Update<'a, T> {
    columns: &'a mut [T],
    order: usize,
    /// First row and column below the panel.
    below: usize,
    /// Which block of columns this is.
    block: usize,
    /// Numbers of a strip.
    size: usize,
    strips: &'a [T],
}

impl<T: Number> WithSimd for Update<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match T::WIDEST / T::count::<S>() {
            1 => self.by::<S, 1, 8>(simd),
            2 => self.by::<S, 2, 4>(simd),
            4 => self.by::<S, 4, 2>(simd),
            8 => self.by::<S, 8, 1>(simd),
            _ => self.by::<S, 16, 1>(simd),
        }
    }
}

impl<T: Number> Update<'_, T> {
    /// By tiles of a strip's rows, in so many lanes' full, and of so many columns.
    #[inline(always)]
    fn by<S: Simd, const LANES: usize, const WIDE: usize>(self, simd: S) {
        let across = &self.strips[self.block * self.size..][..self.size];
        let strips = self.strips.chunks_exact(self.size).enumerate();
        for (strip, down) in strips.skip(self.block) {
            let top = self.below + strip * T::WIDEST;
            let rows = T::WIDEST.min(self.order - top);
            let columns = self.columns.chunks_exact_mut(self.order);
            let mut columns = columns.map(|column| &mut column[top..top + rows]);
            for first in (0..T::WIDEST).step_by(WIDE) {
                let tile = tile::<T, S, LANES, WIDE>(simd, down, across, first);
                for (sums, entries) in tile.iter().zip(columns.by_ref().take(WIDE)) {
                    subtract::<T, S, LANES>(simd, sums, entries);
                }
            }
        }
    }
}

/// The product of a strip's rows with some of the columns that another is of, by columns.
#[inline(always)]
fn tile<T: Number, S: Simd, const LANES: usize, const WIDE: usize>(
    simd: S,
    down: &[T],
    across: &[T],
    first: usize,
) -> [[T::Many<S>; LANES]; WIDE] {
    let mut tile = [[T::default().each(simd); LANES]; WIDE];
    let across = across.chunks_exact(T::WIDEST);
    for (down, across) in down.chunks_exact(T::WIDEST).zip(across) {
        let rows = strip::<T, S, LANES>(simd, down);
        for (sums, factor) in tile.iter_mut().zip(&across[first..first + WIDE]) {
            let factor = factor.each(simd);
            for (sum, row) in sums.iter_mut().zip(rows) {
                *sum = T::sum(simd, *sum, T::product(simd, factor, row));
            }
        }
    }
    tile
}

/// Takes sums off a strip's entries, or fewer.
#[inline(always)]
fn subtract<T: Number, S: Simd, const LANES: usize>(
    simd: S,
    sums: &[T::Many<S>; LANES],
    entries: &mut [T],
) {
    for (sum, entries) in sums.iter().zip(entries.chunks_mut(T::count::<S>())) {
        let less = T::difference(simd, T::read(simd, entries), *sum);
        T::write(simd, less, entries);
    }
}

/// The first numbers of a list, as many as a strip has rows.
#[inline(always)]
fn strip<T: Number, S: Simd, const LANES: usize>(simd: S, numbers: &[T]) -> [T::Many<S>; LANES] {
    let mut strip = [T::default().each(simd); LANES];
    for (many, numbers) in strip.iter_mut().zip(numbers.chunks_exact(T::count::<S>())) {
        *many = T::read(simd, numbers);
    }
    strip
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::OneByOne;
    use nalgebra::DMatrix;
    use proptest::prelude::*;

    /// A unit lower triangle, from numbers between −1 and 1.
    fn lower(order: usize, numbers: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(order, order, |r, c| match r.cmp(&c) {
            core::cmp::Ordering::Less => 0.0,
            core::cmp::Ordering::Equal => 1.0,
            core::cmp::Ordering::Greater => {
                numbers[(r * order + c) % numbers.len()] / (order as f64).sqrt()
            }
        })
    }

    /// Its order, how many pivots are factored, and numbers to fill it with: on both sides of a
    /// panel and of two, and off the tiles.
    fn sizes() -> impl Strategy<Value = (usize, usize, Vec<f64>)> {
        let numbers = prop::collection::vec(-1.0..1.0f64, 997);
        (1..130usize, numbers)
            .prop_flat_map(|(order, numbers)| (Just(order), 0..=order, Just(numbers)))
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn the_columns_are_choleskys_and_the_rest_is_schurs((order, pivots, numbers) in sizes()) {
            let lower = lower(order, &numbers);
            let matrix = &lower * lower.transpose();
            let mut factored = matrix.as_slice().to_vec();
            prop_assert!(factor(&mut factored, order, pivots));
            let factored = DMatrix::from_vec(order, order, factored);
            // A pivot of 1 on the whole diagonal: the triangle is Cholesky's own, and Schur's
            // complement is what its last columns make.
            let last = lower.columns_range(pivots..);
            let rest = last * last.transpose();
            for column in 0..order {
                let expected = if column < pivots { &lower } else { &rest };
                for row in column..order {
                    let error = (factored[(row, column)] - expected[(row, column)]).abs();
                    prop_assert!(error <= 1e-12, "({row}, {column}): {error}");
                }
            }
            let by_nalgebra = matrix.cholesky().unwrap().l();
            let columns = factored.columns_range(..pivots).lower_triangle();
            let error = (columns - by_nalgebra.columns_range(..pivots)).amax();
            prop_assert!(pivots == 0 || error <= 1e-12, "{error}");
        }

        #[test]
        fn a_pivot_that_is_not_positive_is_refused_and_one_beyond_is_not_looked_at(
            (order, pivots, numbers) in sizes(),
            place in any::<prop::sample::Index>(),
            bad in prop::sample::select(&[-1.0, -1e-6, f64::NAN, f64::NEG_INFINITY][..]),
        ) {
            let place = place.index(order);
            let lower = lower(order, &numbers);
            let mut diagonal = DMatrix::identity(order, order);
            diagonal[(place, place)] = bad.max(-1.0);
            let mut matrix = &lower * diagonal * lower.transpose();
            if bad.is_nan() || bad.is_infinite() {
                matrix[(place, place)] = bad;
            }
            let factored = factor(matrix.as_mut_slice(), order, pivots);
            prop_assert_eq!(factored, place >= pivots);
        }
    }

    /// The widest lanes of this machine, and none.
    #[test]
    fn a_strip_and_a_tile_have_the_same_bits_in_any_lanes() {
        same_bits_in_any_lanes::<f64>();
        same_bits_in_any_lanes::<f32>();
    }

    fn same_bits_in_any_lanes<T: Number>() {
        let number = |k| T::of(libm::sin(f64::from(k) * 1.7));
        let numbers: Vec<T> = (0..997).map(number).collect();
        let (width, order, below) = (5, 37, 3);
        let size = width * T::WIDEST;
        let triangle: Vec<T> = numbers[..15].iter().map(|n| T::of(2.0) + *n).collect();
        let solved = |by: fn(Solve<'_, T>)| {
            let mut strip = numbers[..size].to_vec();
            by(Solve {
                triangle: &triangle,
                strip: &mut strip,
            });
            strip
        };
        assert_eq!(
            solved(|work| widest(work)),
            solved(|work| work.with_simd(OneByOne))
        );
        let updated = |by: fn(Update<'_, T>)| {
            let mut columns = numbers[..6 * order].to_vec();
            by(Update {
                columns: &mut columns,
                order,
                below,
                block: 1,
                size,
                strips: &numbers[400..][..3 * size],
            });
            columns
        };
        assert_eq!(
            updated(|work| widest(work)),
            updated(|work| work.with_simd(OneByOne))
        );
    }

    /// An error of 32 bits' rounding in each of the sums, not more.
    #[test]
    fn thirty_two_bits_give_the_same_columns_but_for_their_rounding() {
        let numbers: Vec<f64> = (0..997).map(|k| libm::sin(f64::from(k) * 1.7)).collect();
        let (order, pivots) = (117, 70);
        let lower = lower(order, &numbers);
        let matrix = &lower * lower.transpose();
        let mut exact = matrix.as_slice().to_vec();
        let mut short: Vec<f32> = exact.iter().map(|number| f32::of(*number)).collect();
        assert!(factor(&mut exact, order, pivots) && factor(&mut short, order, pivots));
        let mut greatest = 0.0_f64;
        for column in 0..order {
            for place in column * order + column..(column + 1) * order {
                greatest = greatest.max((exact[place] - short[place].number()).abs());
            }
        }
        assert!((1e-8..1e-5).contains(&greatest), "{greatest}");
    }

    #[test]
    fn no_pivots_are_always_found_positive() {
        assert!(factor::<f64>(&mut [], 0, 0));
        assert!(factor(&mut [-1.0], 1, 0));
        assert!(!factor(&mut [0.0], 1, 1));
    }
}
