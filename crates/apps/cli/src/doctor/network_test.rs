//! Checks of the network configuration.
#![allow(clippy::disallowed_methods, reason = "waits for a packet that it sent")]

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::path::Path;
use std::time::Duration;

use periplus_dds::{DiscoveryRange, Settings};
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros2cli::doctor::{NetworkSettings, domains_in};

/// Multicast group of DDS discovery.
const DISCOVERY_GROUP: Ipv4Addr = Ipv4Addr::new(239, 255, 0, 1);

/// Timeout for the multicast packet to return.
const LOOPBACK_TIMEOUT: Duration = Duration::from_millis(300);

/// Reads the environment and tests the network.
pub(super) fn look() -> NetworkSettings {
    let (settings, _) = Settings::from_environment(&Machine);
    let text = |path: &str| {
        let bytes = Machine.read(Path::new(path)).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    };
    let is_loopback = matches!(settings.range, DiscoveryRange::Localhost | DiscoveryRange::Off);
    NetworkSettings {
        domain_id: settings.domain_id,
        is_loopback,
        has_multicast: if is_loopback { None } else { comes_back() },
        domains: text("/proc/net/udp").map(|table| domains_in(&table)).unwrap_or_default(),
        max_receive_buffer_bytes: text("/proc/sys/net/core/rmem_max")
            .and_then(|text| text.trim().parse().ok()),
    }
}

/// Returns true if a multicast packet loops back; `None` when no socket can be opened.
pub(super) fn comes_back() -> Option<bool> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.set_read_timeout(Some(LOOPBACK_TIMEOUT)).ok()?;
    let SocketAddr::V4(own) = socket.local_addr().ok()? else { return None };
    if socket.join_multicast_v4(&DISCOVERY_GROUP, &Ipv4Addr::UNSPECIFIED).is_err() {
        return Some(false);
    }
    if socket.send_to(b"periplus", (DISCOVERY_GROUP, own.port())).is_err() {
        return Some(false);
    }
    let mut bytes = [0; 16];
    Some(matches!(socket.recv(&mut bytes), Ok(8)) && bytes.starts_with(b"periplus"))
}
