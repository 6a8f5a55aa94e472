//! Network settings and the environment variables for them.

use periplus_cyclonedds_sys as dds;
use periplus_diagnostics::{Diagnostics, closest};
use periplus_resources::Host;
use periplus_transport::environment::{self, not_used};

/// Domain tag that isolates a participant.
const OFF_TAG: &str = "periplus_discovery_off";

/// Discovery range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiscoveryRange {
    /// No discovery in either direction, static peers included, as in `rmw_fastrtps`.
    Off,
    /// This machine only.
    #[default]
    Localhost,
    /// The subnet reached by multicast.
    Subnet,
    /// The default of the DDS implementation.
    SystemDefault,
}

impl DiscoveryRange {
    const NAMES: [(&'static str, Self); 4] = [
        ("OFF", Self::Off),
        ("LOCALHOST", Self::Localhost),
        ("SUBNET", Self::Subnet),
        ("SYSTEM_DEFAULT", Self::SystemDefault),
    ];
}

/// Network settings. The default is domain 0 on this machine only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// `ROS_DOMAIN_ID`: programs in another domain are invisible.
    pub domain_id: u32,
    /// `ROS_AUTOMATIC_DISCOVERY_RANGE`, or `ROS_LOCALHOST_ONLY`.
    pub range: DiscoveryRange,
    /// `ROS_STATIC_PEERS`: additional machines to discover.
    pub peers: Vec<String>,
    /// Use multicast for discovery.
    pub multicast: bool,
    /// Security enclave announced to other participants.
    pub enclave: String,
    /// `CYCLONEDDS_URI`: settings of Cyclone DDS as XML or the URI of a file; they override the
    /// others.
    pub cyclone: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            domain_id: 0,
            range: DiscoveryRange::default(),
            peers: Vec::new(),
            multicast: true,
            enclave: "/".to_owned(),
            cyclone: String::new(),
        }
    }
}

impl Settings {
    /// Reads the environment; missing variables are as in [`Settings::default`].
    #[must_use]
    pub fn from_environment(host: &dyn Host) -> (Self, Diagnostics) {
        let mut settings = Self::default();
        let mut findings = Diagnostics::default();
        let variable = |name| environment::variable(host, name);
        settings.domain_id = environment::domain_id(host, &mut findings);
        if let Some(value) = variable("ROS_AUTOMATIC_DISCOVERY_RANGE") {
            let asked = value.trim().to_uppercase();
            match DiscoveryRange::NAMES.iter().find(|(name, _)| *name == asked) {
                Some((_, range)) => settings.range = *range,
                None => {
                    let names = DiscoveryRange::NAMES.map(|(name, _)| name);
                    let near = closest(&asked, names);
                    let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
                    findings.push(not_used("ROS_AUTOMATIC_DISCOVERY_RANGE", &value).help(format!(
                        "{near}it must be one of {}; LOCALHOST is used",
                        names.join(", ")
                    )));
                }
            }
        }
        if let Some(value) = variable("ROS_LOCALHOST_ONLY") {
            match value.trim() {
                "1" => settings.range = DiscoveryRange::Localhost,
                "0" => {}
                _ => {
                    findings.push(not_used("ROS_LOCALHOST_ONLY", &value).help("it must be 0 or 1"));
                }
            }
        }
        if let Some(value) = variable("ROS_STATIC_PEERS") {
            let peers = value.split(';').map(str::trim).filter(|peer| !peer.is_empty());
            settings.peers = peers.map(str::to_owned).collect();
        }
        settings.cyclone = variable("CYCLONEDDS_URI").unwrap_or_default();
        (settings, findings)
    }

    pub(crate) fn config(&self) -> dds::ParticipantConfig {
        let here = "127.0.0.1".to_owned();
        let (network, multicast, mut peers) = match self.range {
            DiscoveryRange::Off => (dds::NetworkSelection::Loopback, false, Vec::new()),
            // Static peers must be reachable, too.
            DiscoveryRange::Localhost if !self.peers.is_empty() => {
                (dds::NetworkSelection::Any, false, vec![here])
            }
            DiscoveryRange::Localhost => {
                (dds::NetworkSelection::Loopback, self.multicast, vec![here])
            }
            // ROS 2 nodes with range LOCALHOST do not listen to multicast.
            DiscoveryRange::Subnet | DiscoveryRange::SystemDefault => {
                (dds::NetworkSelection::Any, self.multicast, vec![here])
            }
        };
        if self.range != DiscoveryRange::Off {
            peers.extend(self.peers.iter().cloned());
        }
        // No announcement is sent; the tag makes this participant ignore those of others.
        let tag =
            if self.range == DiscoveryRange::Off { OFF_TAG.to_owned() } else { String::new() };
        let more = self.cyclone.clone();
        dds::ParticipantConfig { domain_id: self.domain_id, network, multicast, peers, tag, more }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};
    use periplus_resources::MemoryHost;

    fn check(variables: &[(&str, &str)], expected: Settings, findings: Expect) {
        let host = variables
            .iter()
            .fold(MemoryHost::default(), |host, (name, value)| host.with_variable(name, value));
        let (settings, found) = Settings::from_environment(&host);
        assert_eq!(settings, expected);
        let lines = found.iter().map(|one| format!("{}: {}\n", one.message, one.help.join(" ")));
        findings.assert_eq(&lines.collect::<String>());
    }

    #[test]
    fn the_environment_is_read() {
        check(&[], Settings::default(), expect![""]);
        check(
            &[
                ("ROS_DOMAIN_ID", " 42 "),
                ("ROS_AUTOMATIC_DISCOVERY_RANGE", "subnet"),
                ("ROS_STATIC_PEERS", "192.168.1.5; robot.local;"),
                ("CYCLONEDDS_URI", "file:///c.xml"),
            ],
            Settings {
                domain_id: 42,
                range: DiscoveryRange::Subnet,
                peers: vec!["192.168.1.5".into(), "robot.local".into()],
                cyclone: "file:///c.xml".into(),
                ..Settings::default()
            },
            expect![""],
        );
    }

    #[test]
    fn what_it_says_wrong_is_told() {
        check(
            &[
                ("ROS_DOMAIN_ID", "233"),
                ("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNETT"),
                ("ROS_LOCALHOST_ONLY", "yes"),
            ],
            Settings::default(),
            expect![[r#"
                the environment variable ROS_DOMAIN_ID is `233` and is not used: it must be a number from 0 to 232; domain 0 is used
                the environment variable ROS_AUTOMATIC_DISCOVERY_RANGE is `SUBNETT` and is not used: did you mean SUBNET? it must be one of OFF, LOCALHOST, SUBNET, SYSTEM_DEFAULT; LOCALHOST is used
                the environment variable ROS_LOCALHOST_ONLY is `yes` and is not used: it must be 0 or 1
            "#]],
        );
    }

    #[test]
    fn peers_elsewhere_need_a_network() {
        let settings = Settings { peers: vec!["10.0.0.7".into()], ..Settings::default() };
        let config = settings.config();
        assert_eq!((config.network, config.multicast), (dds::NetworkSelection::Any, false));
        assert_eq!(config.peers, ["127.0.0.1", "10.0.0.7"]);
        let config = Settings::default().config();
        assert_eq!((config.network, config.multicast), (dds::NetworkSelection::Loopback, true));
    }
}
