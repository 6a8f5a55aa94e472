//! Cache of decompressed chunks.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};

use super::lock;

/// Maximum size of the kept chunks \[bytes\]; a larger chunk is not kept.
const MAX_BYTES: usize = 64 << 20;

/// File and block of a chunk.
pub(super) type ChunkKey = (usize, usize);

/// Decompressed chunks; the least recently used ones are dropped first.
#[derive(Default)]
pub(super) struct ChunkCache(Mutex<Kept>);

#[derive(Default)]
struct Kept {
    chunks: HashMap<ChunkKey, (u64, Arc<Vec<u8>>)>,
    /// Chunks by the time of their last use.
    by_use: BTreeMap<u64, ChunkKey>,
    uses: u64,
    bytes: usize,
}

impl ChunkCache {
    pub(super) fn get(&self, key: ChunkKey) -> Option<Arc<Vec<u8>>> {
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

    pub(super) fn put(&self, key: ChunkKey, chunk: &Arc<Vec<u8>>) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_recently_used_chunk_is_dropped_first() {
        let cache = ChunkCache::default();
        let half = Arc::new(vec![0; MAX_BYTES / 2]);
        cache.put((0, 0), &half);
        cache.put((0, 1), &half);
        assert!(cache.get((0, 0)).is_some());
        cache.put((0, 2), &half);
        let is_kept = [0, 1, 2].map(|block| cache.get((0, block)).is_some());
        assert_eq!(is_kept, [true, false, true]);
        assert_eq!(lock(&cache.0).bytes, MAX_BYTES);
    }

    #[test]
    fn a_chunk_that_is_replaced_counts_once() {
        let cache = ChunkCache::default();
        let chunk = Arc::new(vec![0; 10]);
        cache.put((0, 0), &chunk);
        cache.put((0, 0), &chunk);
        assert_eq!(lock(&cache.0).bytes, 10);
    }

    #[test]
    fn a_chunk_larger_than_the_cache_replaces_nothing() {
        let cache = ChunkCache::default();
        cache.put((0, 0), &Arc::new(vec![0; 10]));
        cache.put((0, 1), &Arc::new(vec![0; MAX_BYTES + 1]));
        assert!(cache.get((0, 0)).is_some() && cache.get((0, 1)).is_none());
    }
}
