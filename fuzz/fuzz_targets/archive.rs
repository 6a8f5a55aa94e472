//! Any bytes as an archive: files with names that stay below their folder, or the reason.
#![no_main]

use std::path::Component;

use libfuzzer_sys::fuzz_target;
use periplus_tab::unpack::read;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(contents) = read(bytes) {
        for (path, _) in &contents.files {
            assert!(path.components().all(|it| matches!(it, Component::Normal(_))), "{path:?}");
        }
    }
});
