//! What comes over a connection of ZeroMQ: any bytes are survived, and messages come back as they are.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    periplus_gz_transport::fuzz_frames(bytes);
});
