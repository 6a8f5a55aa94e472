//! Network interfaces and multicast sockets.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};
use std::time::Duration;

use socket2::{Domain, Protocol, Socket, Type};

use crate::{DiscoveryReach, Settings};

/// Timeout of receiving threads, after which they check for shutdown.
pub(super) const LOOK: Duration = Duration::from_millis(100);

/// Addresses of this machine.
#[derive(Clone, Debug)]
pub(super) struct Ways {
    reach: DiscoveryReach,
    /// Interfaces used for sending and receiving.
    own: Vec<Ipv4Addr>,
    /// Address announced to other programs.
    pub(super) told: Ipv4Addr,
}

impl Ways {
    pub(super) fn of(settings: &Settings) -> Self {
        let reach = settings.reach;
        if let Some(address) = settings.address {
            return Self { reach, own: vec![address], told: address };
        }
        let outs = [settings.group, Ipv4Addr::new(8, 8, 8, 8)];
        let mut own: Vec<Ipv4Addr> = outs.into_iter().filter_map(way_to).collect();
        own.dedup();
        own.retain(|address| !address.is_loopback());
        let told = match (reach, own.first()) {
            (DiscoveryReach::Network, Some(first)) => *first,
            _ => Ipv4Addr::LOCALHOST,
        };
        // Gazebo programs without `GZ_IP` use the default route, also among each other.
        own.push(Ipv4Addr::LOCALHOST);
        Self { reach, own, told }
    }

    /// True if packets from this address are accepted.
    pub(super) fn is_for(&self, address: SocketAddr) -> bool {
        match (self.reach, address) {
            (DiscoveryReach::Network, _) => true,
            (DiscoveryReach::Machine, SocketAddr::V4(address)) => {
                address.ip().is_loopback() || self.own.contains(address.ip())
            }
            (DiscoveryReach::Machine, SocketAddr::V6(address)) => address.ip().is_loopback(),
        }
    }

    /// Address that the multicast socket is bound to. On Linux a socket bound to the group receives
    /// nothing that is sent to an address of the machine.
    fn listens_at(&self, group: Ipv4Addr) -> Ipv4Addr {
        match self.reach {
            DiscoveryReach::Machine if cfg!(target_os = "linux") => group,
            _ => Ipv4Addr::UNSPECIFIED,
        }
    }

    /// Opens the receive socket of the group, shared with all programs on this machine.
    pub(super) fn receiver(&self, group: Ipv4Addr, port: u16) -> io::Result<UdpSocket> {
        let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        socket.set_reuse_address(true)?;
        #[cfg(unix)]
        socket.set_reuse_port(true)?;
        socket.bind(&SocketAddr::from((self.listens_at(group), port)).into())?;
        let mut joined = Err(io::Error::from(io::ErrorKind::AddrNotAvailable));
        for own in &self.own {
            let result = socket.join_multicast_v4(&group, own);
            // One is enough, and a network may be listed twice.
            if joined.is_err() {
                joined = result;
            }
        }
        joined?;
        socket.set_read_timeout(Some(LOOK))?;
        Ok(socket.into())
    }

    /// Opens the send sockets. With [`DiscoveryReach::Machine`](crate::settings::DiscoveryReach) packets do not leave
    /// the machine.
    pub(super) fn senders(&self) -> io::Result<Vec<UdpSocket>> {
        let mut senders = Vec::new();
        let mut failed = None;
        for own in &self.own {
            match self.sender(*own) {
                Ok(sender) => senders.push(sender),
                Err(error) => failed = Some(error),
            }
        }
        match failed {
            Some(error) if senders.is_empty() => Err(error),
            _ => Ok(senders),
        }
    }

    fn sender(&self, own: Ipv4Addr) -> io::Result<UdpSocket> {
        let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        socket.bind(&SocketAddr::from((own, 0)).into())?;
        socket.set_multicast_if_v4(&own)?;
        socket.set_multicast_loop_v4(true)?;
        socket.set_multicast_ttl_v4(u32::from(self.reach == DiscoveryReach::Network))?;
        Ok(socket.into())
    }
}

/// Local address of the route to another address; nothing is sent.
fn way_to(other: Ipv4Addr) -> Option<Ipv4Addr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.connect(SocketAddrV4::new(other, 9)).ok()?;
    match socket.local_addr().ok()? {
        SocketAddr::V4(own) if !own.ip().is_unspecified() => Some(*own.ip()),
        _ => None,
    }
}

/// Parses an address such as `tcp://127.0.0.1:4000`.
pub(super) fn address(text: &str) -> Option<SocketAddr> {
    text.strip_prefix("tcp://")?.parse().ok()
}

#[test]
fn addresses_are_numbers() {
    assert!(address("tcp://127.0.0.1:4000").is_some());
    for wrong in ["127.0.0.1:4000", "tcp://localhost:4000", "tcp://127.0.0.1", "inproc://a", ""] {
        assert_eq!(address(wrong), None, "{wrong}");
    }
}

#[test]
fn what_is_for_this_machine_does_not_hear_others() {
    let ways = Ways::of(&Settings::default());
    assert!(ways.is_for(([127, 0, 0, 1], 1).into()));
    assert!(!ways.is_for(([192, 0, 2, 7], 1).into()));
    let ways = Ways::of(&Settings { reach: DiscoveryReach::Network, ..Settings::default() });
    assert!(ways.is_for(([192, 0, 2, 7], 1).into()));
}

#[test]
#[cfg(target_os = "linux")]
fn the_socket_of_this_machine_alone_takes_the_group_only() {
    use std::io::ErrorKind;

    let settings = Settings::default();
    let ways = Ways::of(&settings);
    let socket = ways.receiver(settings.group, 0).unwrap();
    let port = socket.local_addr().unwrap().port();
    assert_eq!(socket.local_addr().unwrap().ip(), settings.group);
    let other = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    other.send_to(b"to the machine", (Ipv4Addr::LOCALHOST, port)).unwrap();
    let mut packet = [0; 64];
    let error = socket.recv(&mut packet).unwrap_err();
    assert!(matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut), "{error}");
    for sender in ways.senders().unwrap() {
        sender.send_to(b"to the group", (settings.group, port)).unwrap();
    }
    let length = socket.recv(&mut packet).unwrap();
    assert_eq!(&packet[..length], b"to the group");
}
