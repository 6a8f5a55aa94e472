//! Packets by which programs of Gazebo find each other: any bytes are survived, and what is understood is
//! understood again when it is written anew.
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
