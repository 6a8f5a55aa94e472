//! Cache of decompressed chunks.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};

use super::lock;

/// Maximum size of the kept chunks \[bytes\]; a larger chunk is not kept.
const MAX_BYTES: usize = 64 << 20;

/// File and block of a chunk.
pub(super) type ChunkKey = (usize, usize);

/// Decompressed chunks of one or several recordings, at most 64 MiB; the least recently used ones are
/// dropped first.
#[derive(Default)]
pub struct ChunkCache(Mutex<Kept>);

/// Recording, file and block of a chunk.
type CacheKey = (u64, ChunkKey);

/// Chunks of one recording in a cache, removed with it.
pub(super) struct CachedChunks {
    cache: Arc<ChunkCache>,
    recording: u64,
}

#[derive(Default)]
struct Kept {
    recordings: u64,
    chunks: HashMap<CacheKey, (u64, Arc<Vec<u8>>)>,
    /// Chunks by the time of their last use.
    by_use: BTreeMap<u64, CacheKey>,
    uses: u64,
    bytes: usize,
}

impl ChunkCache {
    fn get(&self, key: CacheKey) -> Option<Arc<Vec<u8>>> {
        let mut kept = lock(&self.0);
        kept.uses += 1;
        let now = kept.uses;
        let (used, chunk) = kept.chunks.get_mut(&key)?;
        let before = std::mem::replace(used, now);
        let chunk = chunk.clone();
        kept.by_use.remove(&before);
        kept.by_use.insert(now, key);
        Some(chunk)
    }

    fn put(&self, key: CacheKey, chunk: &Arc<Vec<u8>>) {
        if chunk.len() > MAX_BYTES {
            return;
        }
        let mut kept = lock(&self.0);
        kept.uses += 1;
        let now = kept.uses;
        if let Some((used, old)) = kept.chunks.insert(key, (now, chunk.clone())) {
            kept.by_use.remove(&used);
            kept.bytes -= old.len();
        }
        kept.by_use.insert(now, key);
        kept.bytes += chunk.len();
        while kept.bytes > MAX_BYTES {
            let Some((_, oldest)) = kept.by_use.pop_first() else { break };
            if let Some((_, chunk)) = kept.chunks.remove(&oldest) {
                kept.bytes -= chunk.len();
            }
        }
    }
}

impl CachedChunks {
    pub(super) fn new(cache: Arc<ChunkCache>) -> Self {
        let recording = {
            let mut kept = lock(&cache.0);
            kept.recordings += 1;
            kept.recordings
        };
        Self { cache, recording }
    }

    pub(super) fn get(&self, key: ChunkKey) -> Option<Arc<Vec<u8>>> {
        self.cache.get((self.recording, key))
    }

    pub(super) fn put(&self, key: ChunkKey, chunk: &Arc<Vec<u8>>) {
        self.cache.put((self.recording, key), chunk);
    }
}

impl Drop for CachedChunks {
    fn drop(&mut self) {
        let mut kept = lock(&self.cache.0);
        let is_own = |key: &CacheKey| key.0 == self.recording;
        kept.by_use.retain(|_, key| !is_own(key));
        kept.chunks.retain(|key, _| !is_own(key));
        kept.bytes = kept.chunks.values().map(|(_, chunk)| chunk.len()).sum();
    }
}

impl std::fmt::Debug for ChunkCache {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ChunkCache").field("bytes", &lock(&self.0).bytes).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_recently_used_chunk_is_dropped_first() {
        let cache = CachedChunks::new(Arc::default());
        let half = Arc::new(vec![0; MAX_BYTES / 2]);
        cache.put((0, 0), &half);
        cache.put((0, 1), &half);
        assert!(cache.get((0, 0)).is_some());
        cache.put((0, 2), &half);
        let is_kept = [0, 1, 2].map(|block| cache.get((0, block)).is_some());
        assert_eq!(is_kept, [true, false, true]);
        assert_eq!(lock(&cache.cache.0).bytes, MAX_BYTES);
    }

    #[test]
    fn a_chunk_that_is_replaced_counts_once() {
        let cache = CachedChunks::new(Arc::default());
        let chunk = Arc::new(vec![0; 10]);
        cache.put((0, 0), &chunk);
        cache.put((0, 0), &chunk);
        assert_eq!(lock(&cache.cache.0).bytes, 10);
    }

    #[test]
    fn a_chunk_larger_than_the_cache_replaces_nothing() {
        let cache = CachedChunks::new(Arc::default());
        cache.put((0, 0), &Arc::new(vec![0; 10]));
        cache.put((0, 1), &Arc::new(vec![0; MAX_BYTES + 1]));
        assert!(cache.get((0, 0)).is_some() && cache.get((0, 1)).is_none());
    }

    #[test]
    fn recordings_share_the_cache_and_remove_their_chunks() {
        let shared = Arc::<ChunkCache>::default();
        let (one, two) = (CachedChunks::new(shared.clone()), CachedChunks::new(shared.clone()));
        one.put((0, 0), &Arc::new(vec![1; 10]));
        two.put((0, 0), &Arc::new(vec![2; 20]));
        assert_eq!(one.get((0, 0)).map(|chunk| chunk.len()), Some(10));
        drop(two);
        assert_eq!(lock(&shared.0).bytes, 10);
        one.put((0, 1), &Arc::new(vec![0; MAX_BYTES]));
        assert!(one.get((0, 0)).is_none());
    }
}
