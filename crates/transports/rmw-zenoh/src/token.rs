//! Liveliness tokens: each node and each endpoint declares one, and its key expression describes
//! it.
//!
//! Source: `rmw_zenoh`'s design document, "Graph Cache", and "Topic and Service name mapping".

use periplus_graph::Qos;
use periplus_transport::names;
use xxhash_rust::xxh3::xxh3_128;

use crate::attachment::Gid;
use crate::qos;

/// Prefix of every token. Keys with wildcards do not match it.
const SPACE: &str = "@ros2_lv";

/// Hash of a type without hash, as in `rosidl`.
const NO_HASH: &str = "TypeHashNotSupported";

/// Kind of the entity that a token describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EntityKind {
    /// A node.
    Node,
    /// A publisher.
    Publisher,
    /// A subscription.
    Subscription,
    /// A service server.
    Server,
    /// A service client.
    Client,
}

impl EntityKind {
    const NAMES: [(Self, &'static str); 5] = [
        (Self::Node, "NN"),
        (Self::Publisher, "MP"),
        (Self::Subscription, "MS"),
        (Self::Server, "SS"),
        (Self::Client, "SC"),
    ];
}

/// Content of a token.
#[derive(Clone, Debug, PartialEq)]
pub struct EntityToken {
    /// Domain id.
    pub domain_id: u32,
    /// The session that declares it.
    pub session: String,
    /// Id of its node in that session.
    pub node_id: u64,
    /// Id of the entity in that session; that of a node equals `node_id`.
    pub id: u64,
    /// Kind of the entity.
    pub kind: EntityKind,
    /// Security enclave of its node.
    pub enclave: String,
    /// Full name of its node.
    pub node: String,
    /// The topic or service; none for nodes.
    pub end: Option<End>,
}

/// An endpoint of a topic or service.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// Full name of the topic or service.
    pub name: String,
    /// Type, such as `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// Type hash; none if the remote program does not know it.
    pub type_hash: Option<String>,
    /// QoS offered or requested.
    pub qos: Qos,
}

impl End {
    /// Key expression of its messages or requests.
    #[must_use]
    pub fn key(&self, domain_id: u32) -> String {
        key(domain_id, &self.name, &self.type_name, self.type_hash.as_deref().unwrap_or(NO_HASH))
    }

    /// Key expression of the endpoints that it matches: any type hash if it has none.
    #[must_use]
    pub fn keys(&self, domain_id: u32) -> String {
        key(domain_id, &self.name, &self.type_name, self.type_hash.as_deref().unwrap_or("*"))
    }

    /// True if this endpoint matches the other one.
    #[must_use]
    pub fn hears(&self, other: &Self) -> bool {
        (&self.name, &self.type_name) == (&other.name, &other.type_name)
            && (self.type_hash.is_none() || self.type_hash == other.type_hash)
    }
}

/// Key expression of the messages of a topic, or the requests of a service.
fn key(domain_id: u32, name: &str, type_name: &str, hash: &str) -> String {
    let (name, type_name) = (name.trim_matches('/'), names::type_of(type_name));
    format!("{domain_id}/{name}/{type_name}/{hash}")
}

/// Key expression of all tokens of a domain.
#[must_use]
pub fn all(domain_id: u32) -> String {
    format!("{SPACE}/{domain_id}/**")
}

/// Id of the entity of this token.
#[must_use]
pub fn gid(token: &str) -> Gid {
    xxh3_128(token.as_bytes()).to_le_bytes()
}

/// Replaces slashes, which would start another part of the key.
fn mangled(name: &str) -> String {
    name.replace('/', "%")
}

impl EntityToken {
    /// Encodes the key expression.
    #[must_use]
    pub fn write(&self) -> String {
        let Self { domain_id, session, node_id, id, .. } = self;
        let kind = EntityKind::NAMES
            .iter()
            .find(|(kind, _)| *kind == self.kind)
            .map_or("", |(_, name)| name);
        let (namespace, node) = self.node.rsplit_once('/').unwrap_or(("", &self.node));
        let namespace = mangled(if namespace.is_empty() { "/" } else { namespace });
        let enclave = mangled(&self.enclave);
        let mut out = format!(
            "{SPACE}/{domain_id}/{session}/{node_id}/{id}/{kind}/{enclave}/{namespace}/{node}"
        );
        if let Some(end) = &self.end {
            let (name, type_name) = (mangled(&end.name), names::type_of(&end.type_name));
            let hash = end.type_hash.as_deref().unwrap_or(NO_HASH);
            out.push_str(&format!("/{name}/{type_name}/{hash}/{}", qos::write(&end.qos)));
        }
        out
    }

    /// Decodes a key expression; none if it is malformed.
    #[must_use]
    pub fn read(key: &str) -> Option<Self> {
        let parts: Vec<&str> = key.split('/').collect();
        let (head, rest) = parts.split_first_chunk::<9>()?;
        let [space, domain, session, node_id, id, kind, enclave, namespace, node] = *head;
        let is_whole = parts.iter().all(|part| !part.is_empty());
        if space != SPACE || !is_whole {
            return None;
        }
        let (kind, _) = *EntityKind::NAMES.iter().find(|(_, name)| *name == kind)?;
        let plain = |name: &str| name.replace('%', "/");
        let end = match (kind, rest) {
            (EntityKind::Node, _) => None,
            (_, [name, type_name, hash, qos]) => Some(End {
                name: plain(name),
                type_name: names::message(type_name)?,
                type_hash: Some((*hash).to_owned()).filter(|hash| hash != NO_HASH),
                qos: qos::read(qos)?,
            }),
            _ => return None,
        };
        Some(Self {
            domain_id: domain.parse().ok()?,
            session: session.to_owned(),
            node_id: node_id.parse().ok()?,
            id: id.parse().ok()?,
            kind,
            enclave: plain(enclave),
            node: format!("{}/{node}", plain(namespace).trim_end_matches('/')),
            end,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const HASH: &str = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18";

    fn talker() -> EntityToken {
        EntityToken {
            domain_id: 2,
            session: "8b20917502ee955ac4476e0266340d5c".into(),
            node_id: 0,
            id: 10,
            kind: EntityKind::Publisher,
            enclave: "/".into(),
            node: "/talker".into(),
            end: Some(End {
                name: "/chatter".into(),
                type_name: "std_msgs/msg/String".into(),
                type_hash: Some(HASH.into()),
                qos: Qos::reliable(7),
            }),
        }
    }

    #[track_caller]
    fn check(token: &EntityToken, key: &str) {
        assert_eq!(token.write(), key);
        assert_eq!(EntityToken::read(key).as_ref(), Some(token));
    }

    #[test]
    fn tokens_are_those_of_rmw_zenoh() {
        // Examples of the design document.
        let session = "8b20917502ee955ac4476e0266340d5c";
        let end = format!("%chatter/std_msgs::msg::dds_::String_/{HASH}/::,7:,:,:,,");
        check(&talker(), &format!("@ros2_lv/2/{session}/0/10/MP/%/%/talker/{end}"));
        let node = EntityToken { id: 0, kind: EntityKind::Node, end: None, ..talker() };
        check(&node, &format!("@ros2_lv/2/{session}/0/0/NN/%/%/talker"));
        let deep = EntityToken { node: "/demo/sub/wheels".into(), ..node };
        check(&deep, &format!("@ros2_lv/2/{session}/0/0/NN/%/%demo%sub/wheels"));
    }

    #[test]
    fn keys_are_those_of_rmw_zenoh() {
        let chatter = |name| key(0, name, "std_msgs/msg/String", HASH);
        let tail = format!("std_msgs::msg::dds_::String_/{HASH}");
        assert_eq!(chatter("/chatter"), format!("0/chatter/{tail}"));
        assert_eq!(chatter("/robot1/chatter"), format!("0/robot1/chatter/{tail}"));
        let service = End {
            name: "/add_two_ints".into(),
            type_name: "example_interfaces/srv/AddTwoInts".into(),
            type_hash: None,
            qos: Qos::reliable(10),
        };
        let head = "2/add_two_ints/example_interfaces::srv::dds_::AddTwoInts_/";
        assert_eq!(service.key(2), format!("{head}TypeHashNotSupported"));
        assert_eq!(service.keys(2), format!("{head}*"));
        let known = End { type_hash: Some(HASH.into()), ..service.clone() };
        assert_eq!(known.keys(2), format!("{head}{HASH}"));
        assert!(service.hears(&known) && !known.hears(&service) && known.hears(&known));
        assert_eq!(all(7), "@ros2_lv/7/**");
    }

    /// The reference is `xxh128sum`, which prints the high half first.
    #[test]
    fn names_are_sums_with_the_low_half_first() {
        let high = [0xb5, 0xe9, 0xc1, 0xad, 0x07, 0x1b, 0x3e, 0x7f];
        let low = [0xc7, 0x79, 0xcf, 0xaa, 0x5e, 0x52, 0x38, 0x18];
        // The hash of the empty text is 99aa06d3014798d86001c324468d497f.
        assert_eq!(gid("")[..8], 0x6001_c324_468d_497f_u64.to_le_bytes());
        assert_eq!(gid("")[8..], 0x99aa_06d3_0147_98d8_u64.to_le_bytes());
        // The hash of "hello" is b5e9c1ad071b3e7fc779cfaa5e523818.
        let reversed = |mut half: [u8; 8]| {
            half.reverse();
            half
        };
        assert_eq!(gid("hello")[..8], reversed(low));
        assert_eq!(gid("hello")[8..], reversed(high));
    }

    #[test]
    fn what_is_none_is_none() {
        let key = talker().write();
        for end in 0..key.len() {
            assert_eq!(
                EntityToken::read(&key[..end]).map(|token| token.kind),
                None,
                "{}",
                &key[..end]
            );
        }
        for bad in [
            key.replace("MP", "XX"),
            key.replace("@ros2_lv", "ros2_lv"),
            key.replace("/10/", "/ten/"),
            key.replace("/talker/", "//"),
            format!("{key}/more"),
        ] {
            assert_eq!(EntityToken::read(&bad), None, "{bad}");
        }
        let old =
            EntityToken { end: talker().end.map(|end| End { type_hash: None, ..end }), ..talker() };
        check(&old, &key.replace(HASH, NO_HASH));
    }

    proptest! {
        #[test]
        fn any_key_is_survived(
            head in "@ros2_lv/[0-9]{1,3}/[a-f0-9]{1,4}/[0-9]/[0-9]/(NN|MP|SS)(/[a-z%]{1,6}){3}",
            rest in "(/[a-z%]{1,6}/[a-z]:{0,2}[a-z]::dds_::[A-Z]_/[a-z]{1,3}/[0-9:,]{5,20})?",
            cut in 0_usize..100,
        ) {
            let key = head + &rest;
            let _ = EntityToken::read(&key[..cut.min(key.len())]);
            if let Some(token) = EntityToken::read(&key) {
                prop_assert_eq!(EntityToken::read(&token.write()), Some(token));
            }
        }
    }
}
