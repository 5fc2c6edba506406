//! All cores where there are any, one where there is one, the same bits in either case: work is
//! shared out by place, and sums are taken over blocks that do not depend on how. Where there is one,
//! the caller does it all: handing it over would cost more than it takes off.

#[cfg(feature = "threads")]
fn shared() -> bool {
    rayon::current_num_threads() > 1
}

/// Calls `work` on every index of `0..count` and returns the answers in order.
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "threads")]
    if shared() {
        use rayon::prelude::*;
        return (0..count)
            .into_par_iter()
            .with_min_len(64)
            .map(work)
            .collect();
    }
    (0..count).map(work).collect()
}

/// The same where each call is long: however few there are, all cores share them.
pub(crate) fn map_long<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "threads")]
    if shared() {
        use rayon::prelude::*;
        return (0..count)
            .into_par_iter()
            .with_max_len(1)
            .map(work)
            .collect();
    }
    (0..count).map(work).collect()
}

/// Calls `work` on every index of `0..count` and hands the answers to `take`, in order: a batch of them
/// at a time, so that they need not be stored.
pub(crate) fn in_turn<T: Send>(
    count: usize,
    work: impl Fn(usize) -> T + Sync + Send,
    mut take: impl FnMut(usize, T),
) {
    const BATCH: usize = 2048;
    for first in (0..count).step_by(BATCH) {
        let answers = map(BATCH.min(count - first), |k| work(first + k));
        for (k, answer) in answers.into_iter().enumerate() {
            take(first + k, answer);
        }
    }
}

/// Terms that are summed one after the other: a sum has the same bits however it is shared out.
const BLOCK: usize = 1024;

/// The sum of `term` over `0..count`, block by block.
pub(crate) fn sum(count: usize, term: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    blocks(count, |block| block.map(&term).sum())
        .into_iter()
        .sum()
}

/// The greatest `term` over `0..count`, and no less than 0.
pub(crate) fn most(count: usize, term: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    blocks(count, |block| block.map(&term).fold(0.0, f64::max))
        .into_iter()
        .fold(0.0, f64::max)
}

/// What `work` makes of each block.
fn blocks(count: usize, work: impl Fn(core::ops::Range<usize>) -> f64 + Sync + Send) -> Vec<f64> {
    let block = |k: usize| work(k * BLOCK..count.min((k + 1) * BLOCK));
    let blocks = count.div_ceil(BLOCK);
    #[cfg(feature = "threads")]
    if shared() {
        use rayon::prelude::*;
        return (0..blocks).into_par_iter().map(block).collect();
    }
    (0..blocks).map(block).collect()
}

/// Calls `work` on every chunk of `length` entries (the last may be shorter), with its number.
pub(crate) fn for_each_chunk<T: Send>(
    entries: &mut [T],
    length: usize,
    work: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        // Below this, waking another core costs more than it takes off.
        if entries.len() > 1 << 15 && shared() {
            entries
                .par_chunks_mut(length)
                .enumerate()
                .for_each(|(k, chunk)| work(k, chunk));
            return;
        }
    }
    for (k, chunk) in entries.chunks_mut(length).enumerate() {
        work(k, chunk);
    }
}

/// Calls `work` on parts of at least `grain` entries, with the number of each part's first.
pub(crate) fn for_each_part<T: Send>(
    entries: &mut [T],
    grain: usize,
    work: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        let threads = rayon::current_num_threads();
        if threads > 1 && entries.len() > 2 * grain {
            let length = entries.len().div_ceil(threads).max(grain);
            entries
                .par_chunks_mut(length)
                .enumerate()
                .for_each(|(k, part)| work(k * length, part));
            return;
        }
    }
    work(0, entries);
}

/// Calls `work` on every row of `length` entries, with its number: rows are shared out by eights.
pub(crate) fn for_each_row<T: Send>(
    entries: &mut [T],
    length: usize,
    work: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    let rows = |(k, rows): (usize, &mut [T])| {
        for (row, entries) in rows.chunks_mut(length).enumerate() {
            work(8 * k + row, entries);
        }
    };
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        // Below this, waking another core costs more than it takes off.
        if entries.len() > 1 << 10 && shared() {
            entries
                .par_chunks_mut(8 * length)
                .enumerate()
                .for_each(rows);
            return;
        }
    }
    entries.chunks_mut(8 * length).enumerate().for_each(rows);
}

/// Does both, side by side where there are cores for it.
pub(crate) fn both<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "threads")]
    if shared() {
        return rayon::join(one, other);
    }
    (one(), other())
}
