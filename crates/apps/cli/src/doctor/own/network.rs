//! Sockets: connections to this machine, multicast, the port of the page.

use std::io::{ErrorKind, Read as _, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::time::Duration;

use periplus_session::page::DEFAULT_PORT;

use super::SelfCheck;
use crate::doctor::network_test;

/// Timeout of a connection to this machine.
const TIMEOUT: Duration = Duration::from_secs(2);

pub(super) fn all() -> [SelfCheck; 3] {
    let outcome = connection().map_err(|error| error.to_string());
    let port = TcpListener::bind((Ipv4Addr::LOCALHOST, DEFAULT_PORT)).map(drop);
    [
        loopback(outcome),
        multicast(network_test::comes_back()),
        page_port(port.map_err(|error| error.kind())),
    ]
}

/// Sends a byte over a connection from this machine to itself.
fn connection() -> std::io::Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
    let SocketAddr::V4(address) = listener.local_addr()? else {
        return Err(ErrorKind::AddrNotAvailable.into());
    };
    let mut sender = TcpStream::connect_timeout(&address.into(), TIMEOUT)?;
    let (mut receiver, _) = listener.accept()?;
    receiver.set_read_timeout(Some(TIMEOUT))?;
    sender.write_all(b"p")?;
    let mut byte = [0];
    receiver.read_exact(&mut byte)?;
    if byte == *b"p" { Ok(()) } else { Err(ErrorKind::InvalidData.into()) }
}

fn loopback(outcome: Result<(), String>) -> SelfCheck {
    match outcome {
        Ok(()) => SelfCheck::ok("loopback", "connections to 127.0.0.1 work"),
        Err(why) => SelfCheck::error(
            "loopback",
            format!("no connection to 127.0.0.1: {why}"),
            "bring the interface up (`ip link set lo up`), and let the firewall pass it: the page \
             and ROS 2 need it",
        ),
    }
}

fn multicast(comes_back: Option<bool>) -> SelfCheck {
    match comes_back {
        Some(true) => {
            SelfCheck::ok("multicast", "packets of DDS discovery (239.255.0.1) come back")
        }
        Some(false) => SelfCheck::warning(
            "multicast",
            "packets of DDS discovery (239.255.0.1) do not come back",
            "nodes of ROS 2 on other machines may not be discovered: allow multicast on the interface, or name the \
             machines in ROS_STATIC_PEERS",
        ),
        None => SelfCheck::warning(
            "multicast",
            "no UDP socket can be opened",
            "ROS 2 and Gazebo need UDP: allow it in the sandbox or the firewall",
        ),
    }
}

fn page_port(free: Result<(), ErrorKind>) -> SelfCheck {
    match free {
        Ok(()) => SelfCheck::ok("port 8765", "free for the page"),
        Err(ErrorKind::AddrInUse) => SelfCheck::warning(
            "port 8765",
            "in use by another program, perhaps another Periplus",
            "end it, or use another port: `--page=8766`",
        ),
        Err(kind) => SelfCheck::warning(
            "port 8765",
            format!("cannot be opened: {kind}"),
            "allow listening on 127.0.0.1, or use another port: `--page=8766`",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::CheckStatus;
    use super::*;

    #[test]
    fn this_machine_connects_to_itself() {
        connection().unwrap();
        assert_eq!(loopback(Err("refused".to_owned())).status, CheckStatus::Error);
    }

    #[test]
    fn a_port_in_use_is_reported() {
        let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let again = TcpListener::bind(taken.local_addr().unwrap()).map(drop);
        let check = page_port(again.map_err(|error| error.kind()));
        assert_eq!(check.status, CheckStatus::Warning);
        assert!(check.found.contains("in use"), "{check:?}");
        assert_eq!(page_port(Ok(())).status, CheckStatus::Ok);
    }

    #[test]
    fn multicast_that_is_lost_is_a_warning() {
        assert_eq!(multicast(Some(true)).status, CheckStatus::Ok);
        assert_eq!(multicast(Some(false)).status, CheckStatus::Warning);
        assert_eq!(multicast(None).status, CheckStatus::Warning);
    }
}
