//! Any bytes as the head of a request: refused, incomplete, or read; and a client that is admitted without a
//! token is on this machine.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_web::server::{Authorization, Head, LONGEST_HEAD};

fuzz_target!(|bytes: &[u8]| {
    let Ok(Some((head, length))) = Head::read(bytes) else { return };
    assert!(length <= bytes.len() && length <= LONGEST_HEAD);
    let shut = Authorization { is_loopback: false, token: Some("0123456789abcdef".to_owned()) };
    if head.query("token") != Some("0123456789abcdef") {
        assert!(shut.admit(&head).is_err());
    }
    let own = Authorization { is_loopback: true, token: None };
    if own.admit(&head).is_ok() {
        let origin = head.header("origin").unwrap_or_default();
        let is_own = ["localhost", "127.", "[", "file://"]
            .iter()
            .any(|own| origin.to_ascii_lowercase().contains(own));
        assert!(origin.is_empty() && head.header("origin").is_none() || is_own, "{origin}");
    }
});
