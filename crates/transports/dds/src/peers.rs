//! Remote participants and endpoints, from discovery.

use std::collections::{BTreeMap, BTreeSet};

use periplus_cyclonedds_sys::{BuiltinTopic, DiscoverySample, Guid, Vendor};
use periplus_graph::{History, Qos};

use crate::entities::{self, GidForm, NodeEntities};
use crate::names::{self, Use};
use crate::qos;
use crate::remote::{
    DiscoveryProgress, Remote, RemoteEndpoint, RemoteNode, RemoteService, RemoteTopic,
};
use crate::user_data;

/// Maximum number of endpoints stored, which bounds the memory on a faulty network.
const MOST: usize = 50_000;

/// A remote writer or reader.
#[derive(Clone, Debug)]
pub(crate) struct Endpoint {
    pub(crate) is_writer: bool,
    /// DDS topic name.
    pub(crate) topic: String,
    /// DDS type name.
    pub(crate) type_name: String,
    pub(crate) type_hash: Option<String>,
    pub(crate) qos: Qos,
    pub(crate) participant: Guid,
    pub(crate) vendor: Vendor,
}

#[derive(Clone, Debug)]
struct Participant {
    vendor: Vendor,
    enclave: String,
    /// True if `USER_DATA` has an enclave, which exactly the participants of ROS 2 have.
    is_ros: bool,
    nodes: Option<Vec<NodeEntities>>,
}

/// All remote participants.
#[derive(Debug, Default)]
pub(crate) struct Peers {
    own: Guid,
    participants: BTreeMap<Guid, Participant>,
    endpoints: BTreeMap<Guid, Endpoint>,
    /// Node of each endpoint.
    nodes: BTreeMap<Guid, String>,
    /// Form of `ros_discovery_info` of each participant.
    forms: BTreeMap<Guid, GidForm>,
    /// Counts changes.
    changes: u64,
}

/// QoS announced by an endpoint. Fast DDS does not announce history and depth, and Cyclone DDS,
/// which reads them, fills in the DDS default; these are unknown, as `ros2 topic info` prints them.
fn announced(qos: &periplus_cyclonedds_sys::DdsQos, vendor: Vendor) -> Qos {
    let announced = qos::from_dds(qos);
    if vendor == Vendor::FAST {
        return Qos { history: History::KeepLast, depth: 0, ..announced };
    }
    announced
}

impl Peers {
    pub(crate) fn new(own: Guid) -> Self {
        Self { own, ..Self::default() }
    }

    pub(crate) fn changes(&self) -> u64 {
        self.changes
    }

    /// Processes a discovery sample.
    pub(crate) fn note(&mut self, kind: BuiltinTopic, found: DiscoverySample) {
        if found.participant == self.own || found.guid.participant() == self.own {
            return;
        }
        self.changes += 1;
        if kind == BuiltinTopic::Participants {
            self.note_participant(found);
        } else if !found.is_alive {
            self.endpoints.remove(&found.guid);
        } else if self.endpoints.len() < MOST || self.endpoints.contains_key(&found.guid) {
            let endpoint = Endpoint {
                is_writer: kind == BuiltinTopic::Writers,
                type_hash: user_data::hash_of(&found.user_data),
                topic: found.topic,
                type_name: found.type_name,
                qos: announced(&found.qos, found.vendor),
                participant: found.participant,
                vendor: found.vendor,
            };
            self.endpoints.insert(found.guid, endpoint);
        }
    }

    fn note_participant(&mut self, found: DiscoverySample) {
        if !found.is_alive {
            self.participants.remove(&found.guid);
            self.forms.remove(&found.guid);
            self.nodes.retain(|endpoint, _| endpoint.participant() != found.guid);
            return;
        }
        if self.participants.len() == MOST {
            return;
        }
        let enclave = user_data::value(&found.user_data, "enclave").unwrap_or("/").to_owned();
        let one = self.participants.entry(found.guid).or_insert(Participant {
            vendor: found.vendor,
            enclave: String::new(),
            is_ros: false,
            nodes: None,
        });
        (one.vendor, one.enclave) = (found.vendor, enclave);
        one.is_ros |= user_data::value(&found.user_data, "enclave").is_some();
    }

    /// Processes a `ros_discovery_info` message; false if it is malformed.
    pub(crate) fn hear(&mut self, bytes: &[u8], vendor: Vendor) -> bool {
        let Some((said, form)) = entities::decode(bytes) else { return false };
        let guid = Guid(said.participant);
        if guid == self.own || self.participants.len() == MOST {
            return true;
        }
        self.changes += 1;
        self.forms.insert(guid, form);
        self.nodes.retain(|endpoint, _| endpoint.participant() != guid.participant());
        for node in &said.nodes {
            for endpoint in node.readers.iter().chain(&node.writers) {
                if self.nodes.len() < MOST {
                    self.nodes.insert(Guid(*endpoint), node.name.clone());
                }
            }
        }
        let one = self.participants.entry(guid).or_insert(Participant {
            vendor,
            enclave: "/".to_owned(),
            is_ros: true,
            nodes: None,
        });
        one.nodes = Some(said.nodes);
        true
    }

    /// Form in which to publish our own nodes: that of the other participants, or the newer one if
    /// they differ.
    pub(crate) fn form(&self) -> GidForm {
        let is_old =
            !self.forms.is_empty() && self.forms.values().all(|one| *one == GidForm::Humble);
        if is_old { GidForm::Humble } else { GidForm::Iron }
    }

    pub(crate) fn node_of(&self, endpoint: Guid) -> Option<&str> {
        self.nodes.get(&endpoint).map(String::as_str)
    }

    /// Endpoints of a DDS topic.
    pub(crate) fn ends<'a>(
        &'a self,
        topic: &'a str,
        is_writer: bool,
    ) -> impl Iterator<Item = (Guid, &'a Endpoint)> {
        let all = self.endpoints.iter().map(|(guid, endpoint)| (*guid, endpoint));
        all.filter(move |(_, end)| end.is_writer == is_writer && end.topic == topic)
    }

    /// Servers of a service: participants that read requests and write responses.
    pub(crate) fn servers(&self, name: &str) -> Vec<(Guid, Vendor)> {
        let (request, reply) = names::service(name);
        let answering: BTreeSet<Guid> =
            self.ends(&reply, true).map(|(_, end)| end.participant).collect();
        let asked = self.ends(&request, false).map(|(_, end)| (end.participant, end.vendor));
        let both = asked.filter(|(participant, _)| answering.contains(participant));
        both.collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// Progress of discovery.
    pub(crate) fn progress(&self) -> DiscoveryProgress {
        // Participants with an endpoint that belongs to none of their nodes.
        let nodeless: BTreeSet<Guid> = self
            .endpoints
            .iter()
            .filter(|(guid, end)| {
                !self.nodes.contains_key(guid) && names::of_ros(&end.topic).is_some()
            })
            .map(|(_, end)| end.participant)
            .collect();
        let is_complete = |guid: &Guid, one: &Participant| {
            let Some(nodes) = &one.nodes else { return false };
            let ends = |node: &NodeEntities| {
                let mut ends = node.readers.iter().chain(&node.writers);
                ends.all(|end| self.endpoints.contains_key(&Guid(*end)))
            };
            !nodeless.contains(guid) && nodes.iter().all(ends)
        };
        let ros = self.participants.iter().filter(|(_, one)| one.is_ros);
        DiscoveryProgress {
            changes: self.changes,
            participants: self.participants.len(),
            incomplete: ros.filter(|(guid, one)| !is_complete(guid, one)).count(),
        }
    }

    /// Returns everything as plain data.
    pub(crate) fn view(&self) -> Remote {
        let mut remote = Remote::default();
        for (guid, one) in &self.participants {
            remote.nodes.extend(one.nodes.iter().flatten().map(|node| RemoteNode {
                name: node.name.clone(),
                enclave: one.enclave.clone(),
                vendor: one.vendor,
                participant: *guid,
            }));
        }
        remote.nodes.sort_by(|a, b| (&a.name, a.participant).cmp(&(&b.name, b.participant)));
        let mut topics: BTreeMap<&str, RemoteTopic> = BTreeMap::new();
        let mut services: BTreeMap<&str, RemoteService> = BTreeMap::new();
        for (guid, end) in &self.endpoints {
            let Some((kind, name)) = names::of_ros(&end.topic) else { continue };
            if kind == Use::Topic {
                let Some(type_name) = names::message(&end.type_name) else { continue };
                let topic = topics.entry(name).or_default();
                let ends =
                    if end.is_writer { &mut topic.publishers } else { &mut topic.subscriptions };
                insert(&mut topic.type_names, &type_name);
                ends.push(RemoteEndpoint {
                    guid: *guid,
                    node: self.node_of(*guid).map(str::to_owned),
                    type_name,
                    type_hash: end.type_hash.clone(),
                    qos: end.qos,
                    vendor: end.vendor,
                });
            } else if let Some(type_name) = names::service_of(&end.type_name) {
                let service = services.entry(name).or_default();
                insert(&mut service.type_names, &type_name);
                let answers = end.is_writer == (kind == Use::Reply);
                let nodes = if answers { &mut service.servers } else { &mut service.clients };
                insert(nodes, self.node_of(*guid).unwrap_or(NAMELESS));
            }
        }
        let by_node =
            |a: &RemoteEndpoint, b: &RemoteEndpoint| (&a.node, a.guid).cmp(&(&b.node, b.guid));
        remote.topics = topics
            .into_iter()
            .map(|(name, mut topic)| {
                topic.publishers.sort_by(by_node);
                topic.subscriptions.sort_by(by_node);
                RemoteTopic { name: name.to_owned(), ..topic }
            })
            .collect();
        remote.services = services
            .into_iter()
            .map(|(name, service)| RemoteService { name: name.to_owned(), ..service })
            .collect();
        remote
    }
}

/// Name shown for a program without nodes.
pub(crate) const NAMELESS: &str = "(a program without nodes)";

fn insert(sorted: &mut Vec<String>, name: &str) {
    if let Err(place) = sorted.binary_search_by(|other| other.as_str().cmp(name)) {
        sorted.insert(place, name.to_owned());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entities::Entities;
    use expect_test::expect;

    const OTHER: [u8; 16] = [7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 0, 0, 1, 0xc1];

    fn guid(number: u8) -> [u8; 16] {
        let mut guid = OTHER;
        guid[12..].copy_from_slice(&[0, 0, number, 3]);
        guid
    }

    fn found(number: u8, topic: &str, type_name: &str) -> DiscoverySample {
        DiscoverySample {
            guid: Guid(guid(number)),
            participant: Guid(OTHER),
            is_alive: true,
            vendor: Vendor::FAST,
            topic: topic.into(),
            type_name: type_name.into(),
            qos: periplus_cyclonedds_sys::DdsQos::default(),
            user_data: Vec::new(),
        }
    }

    #[test]
    fn endpoints_become_nodes_topics_and_services() {
        let mut peers = Peers::new(Guid([1; 16]));
        peers.note(
            BuiltinTopic::Participants,
            DiscoverySample { guid: Guid(OTHER), ..found(0, "", "") },
        );
        let scan = "sensor_msgs::msg::dds_::LaserScan_";
        peers.note(BuiltinTopic::Writers, found(1, "rt/scan", scan));
        peers.note(BuiltinTopic::Readers, found(2, "rt/scan", "std_msgs::msg::dds_::String_"));
        peers.note(
            BuiltinTopic::Readers,
            found(3, "rq/goRequest", "std_srvs::srv::dds_::Trigger_Request_"),
        );
        peers.note(
            BuiltinTopic::Writers,
            found(4, "rr/goReply", "std_srvs::srv::dds_::Trigger_Response_"),
        );
        peers.note(BuiltinTopic::Writers, found(5, "Square", "ShapeType"));
        let node = NodeEntities {
            name: "/lidar".into(),
            readers: vec![guid(3)],
            writers: vec![guid(1), guid(4)],
        };
        let said = Entities { participant: OTHER, nodes: vec![node] };
        assert!(peers.hear(&entities::encode(&said, GidForm::Iron), Vendor::FAST));
        let told = |remote: &Remote| {
            let nodes = remote.nodes.iter().map(|node| format!("{} {}\n", node.name, node.enclave));
            let topics = remote.topics.iter().map(|topic| {
                let node = |end: &RemoteEndpoint| end.node.clone().unwrap_or_default();
                let publishers: Vec<_> = topic.publishers.iter().map(node).collect();
                let count = topic.subscriptions.len();
                format!("{} {:?} {publishers:?} {count}\n", topic.name, topic.type_names)
            });
            let services = remote
                .services
                .iter()
                .map(|one| format!("{} {:?} {:?}\n", one.name, one.type_names, one.servers));
            nodes.chain(topics).chain(services).collect::<String>()
        };
        expect![[r#"
            /lidar /
            /scan ["sensor_msgs/msg/LaserScan", "std_msgs/msg/String"] ["/lidar"] 1
            /go ["std_srvs/srv/Trigger"] ["/lidar"]
        "#]]
        .assert_eq(&told(&peers.view()));
        assert_eq!(peers.servers("/go"), [(Guid(OTHER), Vendor::FAST)]);

        // The participant leaves.
        peers.note(BuiltinTopic::Writers, DiscoverySample { is_alive: false, ..found(1, "", "") });
        let gone = DiscoverySample { guid: Guid(OTHER), is_alive: false, ..found(0, "", "") };
        peers.note(BuiltinTopic::Participants, gone);
        expect![[r#"
            /scan ["std_msgs/msg/String"] [] 1
            /go ["std_srvs/srv/Trigger"] ["(a program without nodes)"]
        "#]]
        .assert_eq(&told(&peers.view()));
    }

    #[test]
    fn among_old_ones_we_write_as_they_do() {
        let mut peers = Peers::new(Guid([1; 16]));
        assert_eq!(peers.form(), GidForm::Iron);
        let mut say = |participant: u8, form| {
            let said = Entities { participant: [participant; 16], nodes: Vec::new() };
            assert!(peers.hear(&entities::encode(&said, form), Vendor::CYCLONE));
            peers.form()
        };
        assert_eq!(say(2, GidForm::Humble), GidForm::Humble);
        assert_eq!(say(3, GidForm::Iron), GidForm::Iron);
        assert!(!peers.hear(b"nonsense", Vendor::CYCLONE));
    }
}
