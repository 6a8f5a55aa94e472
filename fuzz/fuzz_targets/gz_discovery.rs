//! Discovery packets of Gazebo Transport: no panic for any bytes, and a parsed packet can be written and
//! parsed again.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|packet: &[u8]| {
    if periplus_gz_transport::fuzz_discovery(packet) {
        return;
    }
    // With a length that fits, more of them are packets.
    let length = u16::try_from(packet.len()).unwrap_or(u16::MAX);
    let _ = periplus_gz_transport::fuzz_discovery(&[&length.to_le_bytes()[..], packet].concat());
});
