//! Partition of batches over threads.

use std::sync::{Mutex, PoisonError};

use super::batch::BAND_ROWS;
use crate::ray::Ray;

/// Minimum number of rays for which a second thread pays off.
const MIN_PARALLEL_RAYS: usize = 8192;
/// Approximate number of rays per chunk: small enough that no thread waits long for the last chunk.
const CHUNK_RAYS: usize = 2048;

/// Calls `work` with rays in rows of `columns` and their output slots: all at once, or in chunks of
/// whole rows that are multiples of a band.
pub(super) fn for_each_chunk<T: Send>(
    rays: &[Ray],
    columns: usize,
    threads: usize,
    slots: &mut [T],
    work: impl Fn(&[Ray], usize, &mut [T]) + Sync,
) {
    assert_eq!(rays.len(), slots.len(), "one output slot per ray");
    let columns = columns.clamp(1, rays.len().max(1));
    if threads < 2 || rays.len() < MIN_PARALLEL_RAYS {
        work(rays, columns, slots);
        return;
    }
    let chunk = if columns == rays.len() {
        CHUNK_RAYS
    } else {
        columns * CHUNK_RAYS.div_ceil(columns).next_multiple_of(BAND_ROWS)
    };
    let chunks = Mutex::new(rays.chunks(chunk).zip(slots.chunks_mut(chunk)));
    let next = || chunks.lock().unwrap_or_else(PoisonError::into_inner).next();
    let help = || {
        while let Some((rays, slots)) = next() {
            work(rays, columns.min(rays.len()), slots);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(rays.len().div_ceil(chunk)) {
            scope.spawn(help);
        }
        help();
    });
}
