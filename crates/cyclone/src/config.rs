//! How Cyclone is set up.

use std::fmt::Write as _;

/// Which network.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Network {
    /// This machine only.
    Loopback,
    /// Whatever interface Cyclone chooses.
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
    /// Whether others are found by multicast. If not, they are looked for at the peers' ports.
    pub multicast: bool,
    /// Machines to look at, by name or address.
    pub peers: Vec<String>,
    /// How often it says that it is there \[ns\]; none for Cyclone's own choice.
    pub announce_ns: Option<i64>,
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
            peers: Vec::new(),
            announce_ns: None,
            more: String::new(),
        }
    }
}

/// So many participants are looked for on each peer where there is no multicast.
const PARTICIPANTS: u32 = 60;

impl Config {
    /// As Cyclone reads it.
    #[must_use]
    pub fn xml(&self) -> String {
        let mut xml = String::from("<General>");
        // On a loopback interface without the flag MULTICAST it must be said that it is not wanted,
        // and on one with it that it is.
        let multicast = if self.multicast { "true" } else { "false" };
        let interface = match &self.network {
            Network::Loopback => format!("address=\"127.0.0.1\" multicast=\"{multicast}\""),
            Network::Any => "autodetermine=\"true\"".to_owned(),
            Network::Interface(name) if name.parse::<std::net::IpAddr>().is_ok() => {
                format!("address=\"{}\"", escape(name))
            }
            Network::Interface(name) => format!("name=\"{}\"", escape(name)),
        };
        let _ = write!(xml, "<Interfaces><NetworkInterface {interface}/></Interfaces>");
        let _ = write!(xml, "<AllowMulticast>{multicast}</AllowMulticast>");
        xml.push_str("<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>");
        xml.push_str("</General><Internal>");
        // What the system does not give it does without; 4 MB is what stock kernels give.
        xml.push_str("<SocketReceiveBufferSize min=\"default\" max=\"16MB\"/>");
        xml.push_str("</Internal><Discovery>");
        let _ = write!(xml, "<ExternalDomainId>{}</ExternalDomainId>", self.domain_id);
        let mut peers = self.peers.clone();
        if !self.multicast {
            xml.push_str("<ParticipantIndex>auto</ParticipantIndex>");
            let _ =
                write!(xml, "<MaxAutoParticipantIndex>{PARTICIPANTS}</MaxAutoParticipantIndex>");
            if self.network == Network::Loopback && !peers.iter().any(|peer| peer == "127.0.0.1") {
                peers.push("127.0.0.1".to_owned());
            }
        }
        if !peers.is_empty() {
            xml.push_str("<Peers>");
            for peer in &peers {
                let _ = write!(xml, "<Peer address=\"{}\"/>", escape(peer));
            }
            xml.push_str("</Peers>");
        }
        if let Some(announce_ns) = self.announce_ns {
            let _ = write!(xml, "<SPDPInterval>{announce_ns}ns</SPDPInterval>");
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
