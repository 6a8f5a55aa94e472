//! Any text as a script: commands in the order of time, of finite numbers, or findings.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{Diagnostics, SourceMap};

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("script.yaml", text);
    let script = periplus_sim::script::read(file, &sources, &mut findings);
    assert!(script.commands.is_sorted_by_key(|command| command.time_ns));
    let again = periplus_sim::script::read(file, &sources, &mut Diagnostics::new());
    assert_eq!(script, again, "the same text, the same script");
});
