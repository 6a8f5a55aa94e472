//! Discovery packets: a length of two bytes, then a [`Discovery`] message.

use periplus_gz_msgs::{Discovery, DiscoveryKind, DiscoveryPublisher, Message};

use crate::Name;

/// Protocol version; other versions are ignored.
const VERSION: u32 = 10;

/// Protocol version of programs that count messages.
const COUNTING: u32 = 110;

/// Maximum length of a process or node id \[bytes\]; UUIDs are shorter.
const MOST_ID: usize = 128;

/// Maximum length of an address \[bytes\]: `tcp://`, host and port.
const MOST_ADDRESS: usize = 256;

/// Encodes a packet of this program.
pub(super) fn write(
    process: &str,
    kind: DiscoveryKind,
    fill: impl FnOnce(&mut Discovery),
) -> Vec<u8> {
    let mut told = Discovery {
        version: VERSION,
        process_uuid: process.to_owned(),
        r#type: kind,
        ..Discovery::default()
    };
    fill(&mut told);
    let body = told.encode();
    let mut packet = u16::try_from(body.len()).unwrap_or(u16::MAX).to_le_bytes().to_vec();
    packet.extend_from_slice(&body);
    packet
}

/// Decodes a packet; none if it is malformed or of another version.
pub(super) fn read(packet: &[u8]) -> Option<Discovery> {
    let (length, body) = packet.split_first_chunk::<2>()?;
    let body = body.get(..u16::from_le_bytes(*length).into())?;
    let told = Discovery::decode(body).ok()?;
    let is_ours = matches!(told.version, VERSION | COUNTING);
    let is_named = !told.process_uuid.is_empty() && told.process_uuid.len() <= MOST_ID;
    (is_ours && is_named).then_some(told)
}

/// Name of an advertisement; none if it is incomplete.
pub(super) fn name_of(offer: &DiscoveryPublisher) -> Option<Name> {
    let is_sound = offer.address.len() <= MOST_ADDRESS
        && offer.node_uuid.len() <= MOST_ID
        && offer.process_uuid.len() <= MOST_ID
        && !offer.process_uuid.is_empty();
    if is_sound { Name::read(&offer.topic) } else { None }
}

/// Entry point for fuzzing: decodes a packet; true if it is valid.
///
/// # Panics
/// When encoding and decoding it again gives another packet, which would be a bug.
#[doc(hidden)]
#[must_use]
pub fn fuzz(packet: &[u8]) -> bool {
    let Some(told) = read(packet) else { return false };
    if let Some(offer) = &told.r#pub {
        let _ = name_of(offer).map(|name| name.topic().len());
        let _ = super::sockets::address(&offer.address);
    }
    let again = write(&told.process_uuid, told.r#type, |again| *again = told.clone());
    // Encoding may exceed the maximum packet size.
    assert!(again.len() > usize::from(u16::MAX) || read(&again) == Some(told));
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_gz_msgs::DiscoverySubscriber;
    use proptest::prelude::*;

    #[test]
    fn packets_come_back() {
        let packet = write("p", DiscoveryKind::SUBSCRIBE, |told| {
            told.sub = Some(DiscoverySubscriber { topic: "@/a@/b".into() });
        });
        // Length, version 10, process, kind, topic.
        assert_eq!(packet, b"\x11\0\x10\x0a\x1a\x01p\x20\x02\x32\x08\x0a\x06@/a@/b");
        let told = read(&packet).expect("a packet");
        assert_eq!(told.sub.map(|sub| sub.topic).as_deref(), Some("@/a@/b"));
    }

    #[test]
    fn other_versions_and_broken_packets_are_not_heard() {
        let packet = write("p", DiscoveryKind::BYE, |_| {});
        assert!(read(&packet).is_some());
        assert!(read(&packet[..packet.len() - 1]).is_none());
        assert!(read(&write("p", DiscoveryKind::BYE, |told| told.version = 9)).is_none());
        assert!(read(&write("", DiscoveryKind::BYE, |_| {})).is_none());
        assert!(read(&[]).is_none() && read(&[0, 0]).is_none());
    }

    proptest! {
        #[test]
        fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = fuzz(&bytes);
            let mut framed = u16::try_from(bytes.len()).expect("short").to_le_bytes().to_vec();
            framed.extend(bytes);
            let _ = fuzz(&framed);
        }
    }
}
