//! Bytes of a TCPROS connection: no panic for any bytes, memory only for what arrives, and headers are read back
//! unchanged.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    periplus_ros1::fuzz_tcpros(bytes);
});
