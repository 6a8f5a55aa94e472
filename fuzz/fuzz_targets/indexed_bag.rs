//! Any bytes as a recording with random access: refused or read in the order of time, the newest
//! messages are among those of the whole span, and all have the requested topic.
#![no_main]

use std::fs;
use std::ops::ControlFlow;

use libfuzzer_sys::fuzz_target;
use periplus_bags::files::{ChunkUse, IndexedBag, MessageLocation, OpenProgress};

/// Messages read at once.
const PAGE: usize = 16;

fuzz_target!(|bytes: &[u8]| {
    let path = std::env::temp_dir().join(format!("periplus-fuzz-{}.indexed", std::process::id()));
    fs::write(&path, bytes).expect("the folder for temporary files can be written");
    if let Ok(bag) = IndexedBag::open(&path, &OpenProgress::default()) {
        check(&bag);
    }
    let _ = fs::remove_file(&path);
});

fn check(bag: &IndexedBag) {
    let topics: Vec<usize> = (0..bag.topics().len()).collect();
    let (mut last, mut count, mut from_ns) = (None, 0_usize, Some(i64::MIN));
    while let Some(start_ns) = from_ns {
        let Ok(page) = bag.between(&topics, start_ns, i64::MAX, PAGE) else { return };
        for location in &page.locations {
            assert!(location.topic < topics.len());
            assert!(last.is_none_or(|last| last < *location), "in order");
            last = Some(*location);
        }
        let visit = &mut |_: &MessageLocation, _: &[u8]| ControlFlow::Continue(());
        if bag.read(&page.locations, ChunkUse::Keep, visit).is_err() {
            return;
        }
        count += page.locations.len();
        assert!(page.next_ns.is_none_or(|next_ns| next_ns > start_ns), "it ends");
        // Files of a few kilobytes may unfold to very many messages.
        if count > 100_000 {
            return;
        }
        from_ns = page.next_ns;
    }
    for &topic in &topics {
        for at_ns in [0, 1_000_000_000, i64::MAX - 1] {
            let Ok(newest) = bag.newest(topic, at_ns, 3) else { return };
            assert!(newest.len() <= 3 && newest.is_sorted());
            assert!(newest.iter().all(|one| one.topic == topic && one.time_ns <= at_ns));
        }
    }
}
