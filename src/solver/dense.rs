//! Dense Cholesky of the first columns of a front, in tiles of 4×4 that stay in registers.
//!
//! Every number is the sum of the same products in the same order whatever the machine: no fused
//! multiply-add, no sum split over lanes. Trailing columns may be shared out over cores.

use crate::threads;

/// Columns that are factored before the rest of the front is updated with them.
const PANEL: usize = 48;
/// Side of a register tile.
const TILE: usize = 4;

/// Factors the first `pivots` columns of a symmetric matrix (lower half, column-major, `order`
/// rows) in place: on return they hold L, and the rest holds the Schur complement.
///
/// `false` when a pivot is not positive: the matrix is not positive definite.
pub(super) fn factor(matrix: &mut [f64], order: usize, pivots: usize) -> bool {
    let mut start = 0;
    while start < pivots {
        let width = PANEL.min(pivots - start);
        if !factor_panel(matrix, order, start, width) {
            return false;
        }
        update_trailing(matrix, order, start, width);
        start += width;
    }
    true
}

/// Factors the columns `start..start + width`, rows below included.
fn factor_panel(matrix: &mut [f64], order: usize, start: usize, width: usize) -> bool {
    for column in start..start + width {
        let (before, here) = matrix.split_at_mut(column * order);
        let here = &mut here[column..order];
        for earlier in start..column {
            let column_earlier = &before[earlier * order + column..(earlier + 1) * order];
            let factor = column_earlier[0];
            for (entry, other) in here.iter_mut().zip(column_earlier) {
                *entry -= factor * other;
            }
        }
        let pivot = here[0];
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let root = pivot.sqrt();
        here[0] = root;
        for entry in &mut here[1..] {
            *entry /= root;
        }
    }
    true
}

/// Takes the panel's outer product off the columns after it.
fn update_trailing(matrix: &mut [f64], order: usize, start: usize, width: usize) {
    let first = start + width;
    if first >= order {
        return;
    }
    let strips = pack(matrix, order, start, width, first);
    let trailing = &mut matrix[first * order..];
    threads::for_each_chunk(trailing, TILE * order, |block, columns| {
        update_columns(columns, order, first, block, width, &strips);
    });
}

/// The panel's rows from `first` on, four rows at a time, so that a tile reads them in order.
fn pack(matrix: &[f64], order: usize, start: usize, width: usize, first: usize) -> Vec<f64> {
    let strips = (order - first).div_ceil(TILE);
    let mut packed = vec![0.0; strips * width * TILE];
    for (k, column) in matrix[start * order..(start + width) * order]
        .chunks_exact(order)
        .enumerate()
    {
        for (row, value) in column[first..].iter().enumerate() {
            packed[(row / TILE * width + k) * TILE + row % TILE] = *value;
        }
    }
    packed
}

/// Updates the columns of one block of four.
fn update_columns(
    columns: &mut [f64],
    order: usize,
    first: usize,
    block: usize,
    width: usize,
    strips: &[f64],
) {
    let size = width * TILE;
    let across = &strips[block * size..(block + 1) * size];
    let count = columns.len() / order;
    for (strip, down) in strips.chunks_exact(size).enumerate().skip(block) {
        let tile = multiply(down, across);
        let top = first + strip * TILE;
        let rows = TILE.min(order - top);
        for (c, sums) in tile.iter().enumerate().take(count) {
            let entries = &mut columns[c * order + top..c * order + top + rows];
            for (entry, sum) in entries.iter_mut().zip(sums) {
                *entry -= sum;
            }
        }
    }
}

/// The 4×4 product of two packed strips, by columns.
fn multiply(down: &[f64], across: &[f64]) -> [[f64; TILE]; TILE] {
    let mut tile = [[0.0; TILE]; TILE];
    for (d, a) in down.chunks_exact(TILE).zip(across.chunks_exact(TILE)) {
        for (sums, factor) in tile.iter_mut().zip(a) {
            for (sum, value) in sums.iter_mut().zip(d) {
                *sum += factor * value;
            }
        }
    }
    tile
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use proptest::prelude::*;

    /// A unit lower triangle, from numbers between −1 and 1.
    fn triangle(order: usize, numbers: &[f64]) -> DMatrix<f64> {
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
            let lower = triangle(order, &numbers);
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
            let lower = triangle(order, &numbers);
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

    #[test]
    fn no_pivots_are_always_found_positive() {
        assert!(factor(&mut [], 0, 0));
        assert!(factor(&mut [-1.0], 1, 0));
        assert!(!factor(&mut [0.0], 1, 1));
    }
}
