//! Network settings and the environment variables for them.

use std::net::{IpAddr, Ipv4Addr, UdpSocket};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_resources::Host;
use periplus_transport::environment::variable;

use crate::error::Ros1Error;
use crate::rpc;

/// Port of a master.
pub const MASTER_PORT: u16 = 11_311;

/// Programs that can connect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ros1Reach {
    /// Those on this machine.
    #[default]
    Machine,
    /// All that reach this machine.
    Network,
}

/// Network settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Address of the master, such as `http://localhost:11311`.
    pub master_uri: String,
    /// Programs that can connect.
    pub reach: Ros1Reach,
    /// Name or address under which others reach this machine.
    pub host: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            master_uri: format!("http://localhost:{MASTER_PORT}"),
            reach: Ros1Reach::Machine,
            host: "localhost".to_owned(),
        }
    }
}

impl Settings {
    /// Reads `ROS_MASTER_URI`, `ROS_HOSTNAME` and `ROS_IP`. Without the last two the host is `localhost`, or with
    /// [`Ros1Reach::Network`] the address of the default route.
    #[must_use]
    pub fn from_environment(host: &dyn Host, reach: Ros1Reach) -> (Self, Diagnostics) {
        let mut findings = Diagnostics::new();
        let mut settings = Self { reach, ..Self::default() };
        if let Some(uri) = variable(host, "ROS_MASTER_URI") {
            uri.trim().clone_into(&mut settings.master_uri);
        }
        let given = ["ROS_HOSTNAME", "ROS_IP"].iter().find_map(|name| {
            let value = variable(host, name)?;
            Some((*name, value.trim().to_owned()))
        });
        match (reach, given) {
            (Ros1Reach::Network, Some((_, name))) => settings.host = name,
            (Ros1Reach::Network, None) => {
                if let Some(address) = address_of_default_route() {
                    settings.host = address.to_string();
                }
            }
            (Ros1Reach::Machine, Some((variable, name))) if !is_here(&name) => {
                let message =
                    format!("the environment variable {variable} is `{name}` and is not used");
                findings.push(Diagnostic::warning("ros1-environment", message).help(
                    "only programs on this machine can connect; open the run to others with `--ros1 network`",
                ));
            }
            (Ros1Reach::Machine, Some((_, name))) => settings.host = name,
            (Ros1Reach::Machine, None) => {}
        }
        (settings, findings)
    }

    /// Address to listen at.
    #[must_use]
    pub fn address(&self) -> IpAddr {
        match self.reach {
            Ros1Reach::Machine => Ipv4Addr::LOCALHOST.into(),
            Ros1Reach::Network => Ipv4Addr::UNSPECIFIED.into(),
        }
    }

    /// Host and port of the master.
    ///
    /// # Errors
    /// When `ROS_MASTER_URI` is no address.
    pub fn master(&self) -> Result<(String, u16), Ros1Error> {
        rpc::host_and_port(&self.master_uri)
            .ok_or_else(|| Ros1Error::MasterUri(self.master_uri.clone()))
    }
}

/// True if a name or address is that of this machine for itself.
pub(crate) fn is_here(name: &str) -> bool {
    name == "localhost" || name.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
}

/// Address of the interface through which other networks are reached; nothing is sent.
fn address_of_default_route() -> Option<IpAddr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9)).ok()?;
    Some(socket.local_addr().ok()?.ip())
}

/// True if an address belongs to this machine, so that a master can be started there.
pub(crate) fn is_own(host: &str) -> bool {
    use std::net::ToSocketAddrs as _;
    is_here(host)
        || (host, 0).to_socket_addrs().is_ok_and(|mut all| {
            all.any(|address| {
                address.ip().is_loopback() || UdpSocket::bind((address.ip(), 0)).is_ok()
            })
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_resources::MemoryHost;

    #[test]
    fn the_environment_names_master_and_host() {
        let host = MemoryHost::default()
            .with_variable("ROS_MASTER_URI", " http://robot:11411 ")
            .with_variable("ROS_IP", "10.0.0.7");
        let (settings, findings) = Settings::from_environment(&host, Ros1Reach::Network);
        assert_eq!(settings.master().expect("an address"), ("robot".to_owned(), 11_411));
        assert_eq!((settings.host.as_str(), findings.iter().count()), ("10.0.0.7", 0));
        let (settings, findings) = Settings::from_environment(&host, Ros1Reach::Machine);
        assert_eq!((settings.host.as_str(), findings.iter().count()), ("localhost", 1));
        assert_eq!(settings.address(), IpAddr::from([127, 0, 0, 1]));
    }

    #[test]
    fn an_address_of_a_master_is_checked() {
        let wrong = Settings { master_uri: "localhost".into(), ..Settings::default() };
        assert_eq!(wrong.master(), Err(Ros1Error::MasterUri("localhost".into())));
    }
}
