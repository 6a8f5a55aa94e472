//! What this machine's network is like.
#![allow(clippy::disallowed_methods, reason = "a packet that is sent is waited for")]

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::path::Path;
use std::time::Duration;

use periplus_dds::{Range, Settings};
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros2cli::doctor::{Surroundings, domains_in};

/// Where DDS looks for others.
const GROUP: Ipv4Addr = Ipv4Addr::new(239, 255, 0, 1);

/// How long a packet may take to come back.
const PATIENCE: Duration = Duration::from_millis(300);

/// Looks at the environment and the network.
pub(super) fn look() -> Surroundings {
    let (settings, _) = Settings::from_environment(&Machine);
    let text = |path: &str| {
        let bytes = Machine.read(Path::new(path)).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    };
    let is_loopback = matches!(settings.range, Range::Localhost | Range::Off);
    Surroundings {
        domain_id: settings.domain_id,
        is_loopback,
        has_multicast: if is_loopback { None } else { comes_back() },
        domains: text("/proc/net/udp").map(|table| domains_in(&table)).unwrap_or_default(),
        most_held: text("/proc/sys/net/core/rmem_max").and_then(|text| text.trim().parse().ok()),
    }
}

/// Whether a packet to all comes back; none when no socket can be had.
fn comes_back() -> Option<bool> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.set_read_timeout(Some(PATIENCE)).ok()?;
    let SocketAddr::V4(own) = socket.local_addr().ok()? else { return None };
    if socket.join_multicast_v4(&GROUP, &Ipv4Addr::UNSPECIFIED).is_err() {
        return Some(false);
    }
    if socket.send_to(b"periplus", (GROUP, own.port())).is_err() {
        return Some(false);
    }
    let mut bytes = [0; 16];
    Some(matches!(socket.recv(&mut bytes), Ok(8)) && bytes.starts_with(b"periplus"))
}
