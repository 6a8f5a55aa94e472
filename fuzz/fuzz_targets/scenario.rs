//! Any text as a scenario: a scenario with assertions and the same result again, or findings with an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_scenarios::Scenario;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let read = || Scenario::read("scenario.yaml".as_ref(), text.clone(), &[]);
    match (read(), read()) {
        (Ok(one), Ok(two)) => {
            assert!(!one.assertions.is_empty());
            assert_eq!(format!("{one:?}"), format!("{two:?}"), "the same text, the same scenario");
        }
        (Err(one), Err(two)) => {
            assert!(one.diagnostics.has_errors(), "a refused scenario has an error");
            assert_eq!(one.diagnostics.errors(), two.diagnostics.errors());
        }
        _ => panic!("the same text is a scenario only once"),
    }
});
