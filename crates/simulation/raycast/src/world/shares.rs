//! Many rays over several threads.

use std::sync::{Mutex, PoisonError};

use super::many::BAND;
use crate::ray::Ray;

/// Below this many rays a second thread costs more than it brings.
const SPLIT_MIN: usize = 8192;
/// About as many rays are taken at once: few enough that no thread waits long for the last.
const SHARE: usize = 2048;

/// Gives `work` rays in rows of so many `columns`, and the places for their answers: all at once,
/// or in shares of whole rows, as many as go together.
pub(super) fn in_shares<T: Send>(
    rays: &[Ray],
    columns: usize,
    threads: usize,
    places: &mut [T],
    work: impl Fn(&[Ray], usize, &mut [T]) + Sync,
) {
    assert_eq!(rays.len(), places.len(), "one place for every ray");
    let columns = columns.clamp(1, rays.len().max(1));
    if threads < 2 || rays.len() < SPLIT_MIN {
        work(rays, columns, places);
        return;
    }
    let share = if columns == rays.len() {
        SHARE
    } else {
        columns * SHARE.div_ceil(columns).next_multiple_of(BAND)
    };
    let shares = Mutex::new(rays.chunks(share).zip(places.chunks_mut(share)));
    let next = || shares.lock().unwrap_or_else(PoisonError::into_inner).next();
    let help = || {
        while let Some((rays, places)) = next() {
            work(rays, columns.min(rays.len()), places);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(rays.len().div_ceil(share)) {
            scope.spawn(help);
        }
        help();
    });
}
