//! Any text as `metadata.yaml`: refused with a finding, or read; what was read is written and read
//! again, in both styles.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_bags::{Metadata, Stored, Style, read_metadata};
use periplus_diagnostics::{Diagnostics, SourceMap};

fn read(text: &str) -> (Option<Metadata>, Diagnostics) {
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("metadata.yaml", text);
    (read_metadata(file, &sources, &mut findings), findings)
}

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let (metadata, findings) = read(&text);
    let Some(metadata) = metadata else {
        assert!(findings.has_errors());
        return;
    };
    for style in [Style::Humble, Style::Jazzy] {
        let stored = Stored {
            storage: "sqlite3".into(),
            compression: metadata.compression.clone(),
            compression_mode: metadata.compression_mode.clone(),
        };
        let again = read(&metadata.info.to_yaml_for(style, &stored)).0.expect("ours is right");
        let names = |metadata: &Metadata| -> Vec<String> {
            metadata.info.topics.iter().map(|topic| topic.name.clone()).collect()
        };
        assert_eq!(names(&again), names(&metadata));
        assert_eq!(again.info.files.len(), metadata.info.files.len());
        assert_eq!(again.storage, "sqlite3");
    }
});
