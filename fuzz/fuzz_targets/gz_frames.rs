//! Bytes of a ZeroMQ connection: no panic for any bytes, and written messages are read back unchanged.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    periplus_gz_transport::fuzz_frames(bytes);
});
