//! Unique ids.

/// Creates a random UUID (version 4) as text.
pub(super) fn new() -> String {
    let mut bytes = [0_u8; 16];
    if getrandom::fill(&mut bytes).is_err() {
        // Without a source of randomness, the clock: two programs do not start in the same
        // nanosecond.
        bytes[..8].copy_from_slice(&periplus_transport::unix_ns().to_le_bytes());
        bytes[8..12].copy_from_slice(&std::process::id().to_le_bytes());
    }
    bytes[6] = bytes[6] & 0x0f | 0x40;
    bytes[8] = bytes[8] & 0x3f | 0x80;
    let mut text = String::with_capacity(36);
    for (index, byte) in bytes.iter().enumerate() {
        if matches!(index, 4 | 6 | 8 | 10) {
            text.push('-');
        }
        text.push_str(&format!("{byte:02x}"));
    }
    text
}

#[test]
fn no_two_are_equal() {
    let (a, b) = (new(), new());
    assert_ne!(a, b);
    assert_eq!((a.len(), &a[14..15]), (36, "4"));
}
