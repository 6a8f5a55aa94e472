//! Any text as the values of a swept parameter: an error, or values that are read again as themselves.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_sweeps::{ParameterRange, grid};

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let Ok(range) = text.parse::<ParameterRange>() else { return };
    assert!(!range.name().is_empty());
    match range.interval() {
        Some([low, high]) => assert!(low < high && range.values().is_empty()),
        None => {
            let points = grid(std::slice::from_ref(&range)).expect("a list is a grid");
            assert_eq!(points.len(), range.values().len());
            assert!(range.values().iter().all(|value| !value.is_empty()));
        }
    }
});
