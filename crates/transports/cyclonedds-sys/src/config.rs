//! How Cyclone is set up.

use std::fmt::Write as _;

/// Which network.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Network {
    /// This machine only.
    Loopback,
    /// The interface that Cyclone chooses, and this machine: programs on this machine may reach no
    /// other address than 127.0.0.1.
    Any,
    /// The interface of this name or address.
    Interface(String),
}

/// How to take part. The defaults are those that large samples need: fragments as large as UDP
/// carries them, for the standard 1344 bytes lose most of a point cloud on the way, and receive
/// buffers as large as the system gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Config {
    /// Number of the domain; ports follow from it.
    pub domain_id: u32,
    /// Which network.
    pub network: Network,
    /// Whether others are found by multicast. Data never goes that way.
    pub multicast: bool,
    /// Machines to look at, by name or address: at the ports of the first participants of each,
    /// every second as long as it runs.
    pub peers: Vec<String>,
    /// Participants with another tag are ignored, as are those without one unless this is empty.
    pub tag: String,
    /// More of Cyclone's XML, or URIs of files with it, as `CYCLONEDDS_URI` has them; what stands
    /// here wins.
    pub more: String,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            domain_id: 0,
            network: Network::Loopback,
            multicast: true,
            peers: vec!["127.0.0.1".to_owned()],
            tag: String::new(),
            more: String::new(),
        }
    }
}

/// So many participants are looked for on each peer; it is how many of one machine can be found
/// without multicast.
const PARTICIPANTS: u32 = 60;

impl Config {
    /// As Cyclone reads it. `has_network`: the machine has an interface besides loopback; Cyclone
    /// refuses to use one interface twice.
    #[must_use]
    pub(crate) fn xml(&self, has_network: bool) -> String {
        let mut xml = String::from("<General><Interfaces>");
        // The loopback interface of most systems can multicast but does not say so.
        let loopback = format!("address=\"127.0.0.1\" multicast=\"{}\"", self.multicast);
        let interfaces = match &self.network {
            Network::Loopback => vec![loopback],
            Network::Any if has_network => vec!["autodetermine=\"true\"".to_owned(), loopback],
            Network::Any => vec![loopback],
            Network::Interface(name) if name.parse::<std::net::IpAddr>().is_ok() => {
                vec![format!("address=\"{}\"", escape(name))]
            }
            Network::Interface(name) => vec![format!("name=\"{}\"", escape(name))],
        };
        for interface in interfaces {
            let _ = write!(xml, "<NetworkInterface {interface}/>");
        }
        xml.push_str("</Interfaces>");
        let multicast = if self.multicast { "spdp" } else { "false" };
        let _ = write!(xml, "<AllowMulticast>{multicast}</AllowMulticast>");
        xml.push_str("<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>");
        xml.push_str("</General><Internal>");
        // What the system does not give it does without.
        xml.push_str("<SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>");
        xml.push_str("</Internal><Discovery>");
        let _ = write!(xml, "<ExternalDomainId>{}</ExternalDomainId>", self.domain_id);
        if !self.tag.is_empty() {
            let _ = write!(xml, "<Tag>{}</Tag>", escape(&self.tag));
        }
        // Ports that others can guess.
        xml.push_str("<ParticipantIndex>auto</ParticipantIndex>");
        let _ = write!(xml, "<MaxAutoParticipantIndex>{PARTICIPANTS}</MaxAutoParticipantIndex>");
        if !self.peers.is_empty() {
            // Who starts later is to be found too, and soon.
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
