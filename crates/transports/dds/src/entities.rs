//! `ros_discovery_info`: the nodes of a participant and their endpoints.
//!
//! Source: `rmw_dds_common/msg/ParticipantEntitiesInfo.msg`. A GID has 16 bytes since Iron and had
//! 24 until Humble, in a message of the same name. Both forms are read; the form of the other
//! participants is written.

/// DDS topic.
pub const TOPIC: &str = "ros_discovery_info";

/// DDS type.
pub const TYPE: &str = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// Type hash, since Iron.
pub const HASH: &str = "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e";

/// Length of a GID in the message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GidForm {
    /// 16 bytes: Iron and later.
    #[default]
    Iron,
    /// 24 bytes: Humble and before.
    Humble,
}

impl GidForm {
    const fn gid(self) -> usize {
        match self {
            Self::Iron => 16,
            Self::Humble => 24,
        }
    }
}

/// Content of `ros_discovery_info`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Entities {
    /// GUID of the participant.
    pub participant: [u8; 16],
    /// Its nodes.
    pub nodes: Vec<NodeEntities>,
}

/// A node and its endpoints.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NodeEntities {
    /// Namespace and name.
    pub name: String,
    /// GUIDs of its readers.
    pub readers: Vec<[u8; 16]>,
    /// GUIDs of its writers.
    pub writers: Vec<[u8; 16]>,
}

/// Encodes the message as CDR.
#[must_use]
pub fn encode(entities: &Entities, form: GidForm) -> Vec<u8> {
    let mut out = vec![0, 1, 0, 0];
    put_gid(&mut out, &entities.participant, form);
    put_length(&mut out, entities.nodes.len());
    for node in &entities.nodes {
        let (namespace, name) = node.name.rsplit_once('/').unwrap_or(("", &node.name));
        put_text(&mut out, if namespace.is_empty() { "/" } else { namespace });
        put_text(&mut out, name);
        for gids in [&node.readers, &node.writers] {
            put_length(&mut out, gids.len());
            gids.iter().for_each(|gid| put_gid(&mut out, gid, form));
        }
    }
    out
}

fn put_length(out: &mut Vec<u8>, length: usize) {
    out.resize(out.len().next_multiple_of(4), 0);
    out.extend(u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    put_length(out, text.len() + 1);
    out.extend(text.bytes());
    out.push(0);
}

fn put_gid(out: &mut Vec<u8>, gid: &[u8; 16], form: GidForm) {
    out.extend(gid);
    out.resize(out.len() + form.gid() - 16, 0);
}

/// Decodes a message in either form; none if it is neither.
#[must_use]
pub fn decode(bytes: &[u8]) -> Option<(Entities, GidForm)> {
    [GidForm::Iron, GidForm::Humble].into_iter().find_map(|form| Some((read(bytes, form)?, form)))
}

fn read(bytes: &[u8], form: GidForm) -> Option<Entities> {
    let (header, rest) = bytes.split_at_checked(4)?;
    let is_little = match header[..2] {
        [0, 1] => true,
        [0, 0] => false,
        _ => return None,
    };
    let mut reader = Reader { bytes: rest, at: 0, is_little, form };
    let participant = reader.gid()?;
    // Minimum size of a node: two texts and two lists, all empty.
    let count = reader.length(16)?;
    let mut nodes = Vec::with_capacity(count);
    for _ in 0..count {
        let (namespace, name) = (reader.text()?, reader.text()?);
        let name = format!("{}/{name}", namespace.trim_end_matches('/'));
        nodes.push(NodeEntities { name, readers: reader.gids()?, writers: reader.gids()? });
    }
    // The sender may add padding.
    (rest.len() - reader.at < 4).then_some(Entities { participant, nodes })
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_little: bool,
    form: GidForm,
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..self.at.checked_add(length)?)?;
        self.at += length;
        Some(taken)
    }

    fn number(&mut self) -> Option<usize> {
        self.at = self.at.next_multiple_of(4);
        let bytes = self.take(4)?.try_into().ok()?;
        let number =
            if self.is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) };
        usize::try_from(number).ok()
    }

    /// Number of the elements that follow, each of at least `min_bytes`.
    fn length(&mut self, least_bytes: usize) -> Option<usize> {
        let length = self.number()?;
        (length <= (self.bytes.len() - self.at) / least_bytes).then_some(length)
    }

    fn text(&mut self) -> Option<&'a str> {
        let length = self.number()?;
        let text = self.take(length)?;
        std::str::from_utf8(text.strip_suffix(&[0]).unwrap_or(text)).ok()
    }

    fn gid(&mut self) -> Option<[u8; 16]> {
        let (gid, rest) = self.take(self.form.gid())?.split_at(16);
        // The bytes after a GID of Humble are zero; GIDs of others are shorter.
        rest.iter().all(|byte| *byte == 0).then(|| gid.try_into().ok())?
    }

    fn gids(&mut self) -> Option<Vec<[u8; 16]>> {
        let count = self.length(self.form.gid())?;
        (0..count).map(|_| self.gid()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sample() -> Entities {
        let node = |name: &str, readers: &[u8], writers: &[u8]| NodeEntities {
            name: name.into(),
            readers: readers.iter().map(|byte| [*byte; 16]).collect(),
            writers: writers.iter().map(|byte| [*byte; 16]).collect(),
        };
        Entities {
            participant: [7; 16],
            nodes: vec![node("/scan", &[1], &[2, 3]), node("/demo/sub/wheels", &[], &[])],
        }
    }

    #[test]
    fn both_forms_come_back() {
        for form in [GidForm::Iron, GidForm::Humble] {
            let bytes = encode(&sample(), form);
            assert_eq!(decode(&bytes), Some((sample(), form)));
            // Padding as in a packet.
            let mut padded = bytes.clone();
            padded.resize(bytes.len().next_multiple_of(4), 0);
            assert_eq!(decode(&padded), Some((sample(), form)));
            for end in 0..bytes.len() {
                assert_ne!(decode(&bytes[..end]), Some((sample(), form)), "cut at {end}");
            }
        }
    }

    #[test]
    fn the_bytes_are_those_of_ros() {
        let one = Entities {
            participant: [9; 16],
            nodes: vec![NodeEntities {
                name: "/n".into(),
                readers: vec![],
                writers: vec![[5; 16]],
            }],
        };
        let mut expected = vec![0, 1, 0, 0];
        expected.extend([9; 16]);
        expected.extend([1, 0, 0, 0]);
        expected.extend([2, 0, 0, 0, b'/', 0, 0, 0]);
        expected.extend([2, 0, 0, 0, b'n', 0, 0, 0]);
        expected.extend([0, 0, 0, 0, 1, 0, 0, 0]);
        expected.extend([5; 16]);
        assert_eq!(encode(&one, GidForm::Iron), expected);
    }

    proptest! {
        #[test]
        fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = decode(&bytes);
        }
    }
}
