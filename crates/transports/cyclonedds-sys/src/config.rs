//! Configuration of Cyclone DDS.

use std::fmt::Write as _;

/// Network interfaces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NetworkSelection {
    /// This machine only.
    Loopback,
    /// The interface that Cyclone chooses, and loopback: programs on this machine may reach no
    /// other address than 127.0.0.1.
    Any,
    /// The interface with this name or address.
    Interface(String),
}

/// Settings of a participant. The defaults support large samples: fragments of the maximum UDP
/// size, since the standard 1344 bytes lose most of a point cloud in transit, and the largest
/// receive buffers that the system allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParticipantConfig {
    /// Domain id, which determines the ports.
    pub domain_id: u32,
    /// Network interfaces.
    pub network: NetworkSelection,
    /// Use multicast for discovery. Data never uses multicast.
    pub multicast: bool,
    /// Machines to discover, by name or address: at the ports of the first participants of each,
    /// every second.
    pub peers: Vec<String>,
    /// Domain tag: participants with another tag are ignored.
    pub tag: String,
    /// Additional Cyclone XML, or URIs of files with it, as in `CYCLONEDDS_URI`; it overrides the
    /// other settings.
    pub more: String,
}

impl Default for ParticipantConfig {
    fn default() -> Self {
        Self {
            domain_id: 0,
            network: NetworkSelection::Loopback,
            multicast: true,
            peers: vec!["127.0.0.1".to_owned()],
            tag: String::new(),
            more: String::new(),
        }
    }
}

/// Number of participants that are looked for on each peer, and that can be discovered on one
/// machine without multicast.
const PARTICIPANTS: u32 = 60;

impl ParticipantConfig {
    /// Configuration as XML. `has_network`: the machine has an interface besides loopback; Cyclone
    /// refuses to use one interface twice.
    #[must_use]
    pub(crate) fn xml(&self, has_network: bool) -> String {
        let mut xml = String::from("<General><Interfaces>");
        // The loopback interface of most systems supports multicast without declaring it.
        let loopback = format!("address=\"127.0.0.1\" multicast=\"{}\"", self.multicast);
        let interfaces = match &self.network {
            NetworkSelection::Loopback => vec![loopback],
            NetworkSelection::Any if has_network => {
                vec!["autodetermine=\"true\"".to_owned(), loopback]
            }
            NetworkSelection::Any => vec![loopback],
            NetworkSelection::Interface(name) if name.parse::<std::net::IpAddr>().is_ok() => {
                vec![format!("address=\"{}\"", escape(name))]
            }
            NetworkSelection::Interface(name) => vec![format!("name=\"{}\"", escape(name))],
        };
        for interface in interfaces {
            let _ = write!(xml, "<NetworkInterface {interface}/>");
        }
        xml.push_str("</Interfaces>");
        let multicast = if self.multicast { "spdp" } else { "false" };
        let _ = write!(xml, "<AllowMulticast>{multicast}</AllowMulticast>");
        xml.push_str("<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>");
        xml.push_str("</General><Internal>");
        // A smaller buffer is accepted if the system does not allow more.
        xml.push_str("<SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>");
        xml.push_str("</Internal><Discovery>");
        let _ = write!(xml, "<ExternalDomainId>{}</ExternalDomainId>", self.domain_id);
        if !self.tag.is_empty() {
            let _ = write!(xml, "<Tag>{}</Tag>", escape(&self.tag));
        }
        // Predictable ports, for discovery without multicast.
        xml.push_str("<ParticipantIndex>auto</ParticipantIndex>");
        let _ = write!(xml, "<MaxAutoParticipantIndex>{PARTICIPANTS}</MaxAutoParticipantIndex>");
        if !self.peers.is_empty() {
            // Programs that start later are discovered within a second.
            xml.push_str("<SPDPInterval>1s</SPDPInterval>");
            xml.push_str("<InitialLocatorPruneDelay>inf</InitialLocatorPruneDelay><Peers>");
            for peer in &self.peers {
                let _ = write!(xml, "<Peer Address=\"{}\"/>", escape(peer));
            }
            xml.push_str("</Peers>");
        }
        xml.push_str("</Discovery>");
        let mut all = format!("<CycloneDDS><Domain Id=\"any\">{xml}</Domain></CycloneDDS>");
        if !self.more.trim().is_empty() {
            all.push(',');
            all.push_str(self.more.trim());
        }
        all
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
