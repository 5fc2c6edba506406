//! All cores where there are any, one where there is one, the same bits in either case: work is
//! shared out by place, and nothing is summed across places.

/// Calls `work` on every index of `0..count` and returns the answers in order.
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        (0..count)
            .into_par_iter()
            .with_min_len(64)
            .map(work)
            .collect()
    }
    #[cfg(not(feature = "threads"))]
    {
        (0..count).map(work).collect()
    }
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
        if entries.len() > 1 << 15 {
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

/// Does both, side by side where there are cores for it.
pub(crate) fn both<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "threads")]
    {
        rayon::join(one, other)
    }
    #[cfg(not(feature = "threads"))]
    {
        (one(), other())
    }
}
