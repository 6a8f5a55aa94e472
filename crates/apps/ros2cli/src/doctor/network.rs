//! Checks of the network of this machine.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::SystemObservation;

/// Network settings of the machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NetworkSettings {
    /// ROS domain.
    pub domain_id: u32,
    /// True if discovery is limited to this machine.
    pub is_loopback: bool,
    /// True if multicast packets are received; `None` if not tested.
    pub has_multicast: Option<bool>,
    /// Domains of participants on this machine.
    pub domains: BTreeSet<u32>,
    /// Maximum receive buffer of a socket \[bytes\].
    pub max_receive_buffer_bytes: Option<u64>,
}

/// Receive buffer that point clouds and maps need \[bytes\].
const MIN_RECEIVE_BUFFER_BYTES: u64 = 2_000_000;

pub(super) fn examine(observation: &SystemObservation, found: &mut Diagnostics) {
    let Some(around) = &observation.network_settings else { return };
    let is_alone = observation.seen.nodes.is_empty() && observation.seen.topics.is_empty();
    if is_alone {
        let others: Vec<String> = around
            .domains
            .iter()
            .filter(|domain| **domain != around.domain_id)
            .map(u32::to_string)
            .collect();
        let domain = around.domain_id;
        let finding =
            Diagnostic::error("nobody", format!("no participant found in domain {domain}"));
        found.push(if !others.is_empty() {
            finding
                .note(format!("programs on this machine are in domain {}", others.join(", ")))
                .help(format!("set ROS_DOMAIN_ID={}", others.join(" or ")))
        } else if around.is_loopback {
            finding.help(
                "start a node; programs on other machines are discovered with \
                 ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET and without ROS_LOCALHOST_ONLY",
            )
        } else {
            finding.help("start a node, or set ROS_DOMAIN_ID to the domain of the others")
        });
    }
    if around.has_multicast == Some(false) && !around.is_loopback {
        found.push(
            Diagnostic::warning(
                "multicast",
                "packets to 239.255.0.1 are not received: multicast is blocked",
            )
            .note("discovery of other machines needs it")
            .help(
                "allow UDP to 239.255.0.1 in the firewall, or list the other machines in ROS_STATIC_PEERS",
            ),
        );
    }
    let carries_much = observation.seen.topics.iter().any(|topic| {
        topic.types.iter().any(|name| {
            matches!(name.as_str(), "sensor_msgs/msg/PointCloud2" | "sensor_msgs/msg/Image")
        })
    });
    if let Some(held) = around
        .max_receive_buffer_bytes
        .filter(|held| *held < MIN_RECEIVE_BUFFER_BYTES && carries_much)
    {
        found.push(
            Diagnostic::hint(
                "socket-buffers",
                format!("the maximum receive buffer is {held} bytes: images and point clouds lose packets"),
            )
            .help("sudo sysctl -w net.core.rmem_max=4194304"),
        );
    }
}

/// Domains whose ports are open, from a table in the format of `/proc/net/udp`. Multicast discovery
/// listens at 7400 + 250 x domain (DDSI-RTPS 2.5, section 9.6.2).
#[must_use]
pub fn domains_in(table: &str) -> BTreeSet<u32> {
    let port = |line: &str| {
        let local = line.split_whitespace().nth(1)?;
        u32::from_str_radix(local.rsplit(':').next()?, 16).ok()
    };
    let ports = table.lines().skip(1).filter_map(port);
    let domains = ports.filter_map(|port| port.checked_sub(7400));
    domains
        .filter(|above| above % 250 == 0)
        .map(|above| above / 250)
        .filter(|id| *id < 233)
        .collect()
}

#[test]
fn ports_tell_domains() {
    let table = "  sl  local_address rem_address\n\
                 1: 00000000:1CE8 00000000:0000 07\n\
                 2: 0100007F:3A34 00000000:0000 07\n\
                 3: 0100007F:1CF2 00000000:0000 07\n";
    assert_eq!(domains_in(table).into_iter().collect::<Vec<_>>(), [0, 30]);
}
