//! Network settings and the environment variables for them.

use std::net::Ipv4Addr;
use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_gz_msgs::Dialect;
use periplus_resources::Host;
use periplus_transport::environment::variable;

/// Reach of discovery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiscoveryReach {
    /// Programs on this machine.
    #[default]
    Machine,
    /// All programs within reach of multicast.
    Network,
}

/// Network settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Partition; programs in another partition are invisible.
    pub partition: String,
    /// Reach of discovery.
    pub reach: DiscoveryReach,
    /// Address of the interface; by default that of the loopback interface, or with
    /// [`DiscoveryReach::Network`] that of the default route.
    pub address: Option<Ipv4Addr>,
    /// Multicast group of discovery.
    pub group: Ipv4Addr,
    /// Discovery port for topics.
    pub topic_port: u16,
    /// Discovery port for services.
    pub service_port: u16,
    /// Type names used in advertisements; both dialects are accepted.
    pub dialect: Dialect,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            partition: "localhost:user".to_owned(),
            reach: DiscoveryReach::Machine,
            address: None,
            group: Ipv4Addr::new(239, 255, 0, 7),
            topic_port: 10_317,
            service_port: 10_318,
            dialect: Dialect::Gz,
        }
    }
}

impl Settings {
    /// Reads the environment variables of `gz-transport` in all its releases: `GZ_PARTITION` or
    /// `IGN_PARTITION`, and so on. The default partition is `hostname:username`.
    #[must_use]
    pub fn from_environment(host: &dyn Host) -> (Self, Diagnostics) {
        let mut settings = Self::default();
        let mut findings = Diagnostics::new();
        settings.partition = match either(host, "PARTITION") {
            Some((_, partition)) => partition,
            None => usual_partition(host),
        };
        if let Some((name, value)) = either(host, "IP") {
            match value.parse() {
                Ok(address) => settings.address = Some(address),
                Err(_) => {
                    findings.push(not_used(&name, &value, "an IPv4 address such as 127.0.0.1"));
                }
            }
        }
        if let Some((name, value)) = either(host, "DISCOVERY_MULTICAST_IP") {
            match value.parse::<Ipv4Addr>() {
                Ok(group) if group.is_multicast() => settings.group = group,
                _ => findings.push(not_used(&name, &value, "an address from 224.0.0.0 on")),
            }
        }
        for (what, port) in [
            ("DISCOVERY_MSG_PORT", &mut settings.topic_port),
            ("DISCOVERY_SRV_PORT", &mut settings.service_port),
        ] {
            let Some((name, value)) = either(host, what) else { continue };
            match value.parse() {
                Ok(number @ 1..) => *port = number,
                _ => findings.push(not_used(&name, &value, "a number from 1 to 65535")),
            }
        }
        for what in
            ["RELAY", "TRANSPORT_USERNAME", "TRANSPORT_PASSWORD", "TRANSPORT_TOPIC_STATISTICS"]
        {
            if let Some((name, _)) = either(host, what) {
                let message = format!("the environment variable {name} is not used");
                findings.push(Diagnostic::warning("gz-environment", message).help(
                    "relays, authentication and statistics of Gazebo Transport are not supported: programs \
                     that require them do not see this one",
                ));
            }
        }
        (settings, findings)
    }
}

/// Reads a variable by its current (`GZ_`) or old (`IGN_`) name.
fn either(host: &dyn Host, what: &str) -> Option<(String, String)> {
    ["GZ", "IGN"].iter().find_map(|front| {
        let name = format!("{front}_{what}");
        let value = variable(host, &name)?;
        Some((name, value.trim().to_owned()))
    })
}

fn not_used(name: &str, value: &str, wanted: &str) -> Diagnostic {
    let message = format!("the environment variable {name} is `{value}` and is not used");
    Diagnostic::warning("gz-environment", message).help(format!("it must be {wanted}"))
}

/// Default partition: host and user name.
fn usual_partition(host: &dyn Host) -> String {
    let text = |path: &str| {
        let bytes = host.read(Path::new(path)).unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let machine = text("/proc/sys/kernel/hostname").trim().to_owned();
    let machine = if machine.is_empty() { variable(host, "HOSTNAME") } else { Some(machine) };
    let status = text("/proc/self/status");
    let id = status.lines().find_map(|line| line.strip_prefix("Uid:")?.split_whitespace().next());
    let users = text("/etc/passwd");
    let by_id = users.lines().find_map(|line| {
        let mut parts = line.split(':');
        let name = parts.next()?;
        (parts.nth(1) == id && id.is_some()).then(|| name.to_owned())
    });
    let user = by_id.or_else(|| variable(host, "USER"));
    let or = |name: Option<String>, other: &str| name.unwrap_or_else(|| other.to_owned());
    format!("{}:{}", or(machine, "localhost"), or(user, "user"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_resources::MemoryHost;

    #[test]
    fn the_newer_names_win_over_the_older() {
        let host = MemoryHost::default()
            .with_variable("GZ_PARTITION", "new")
            .with_variable("IGN_PARTITION", "old")
            .with_variable("IGN_IP", "127.0.0.1")
            .with_variable("GZ_DISCOVERY_MSG_PORT", "11319");
        let (settings, findings) = Settings::from_environment(&host);
        assert_eq!(settings.partition, "new");
        assert_eq!(settings.address, Some(Ipv4Addr::LOCALHOST));
        assert_eq!((settings.topic_port, settings.service_port), (11_319, 10_318));
        assert_eq!(findings.iter().count(), 0);
    }

    #[test]
    fn what_means_nothing_is_told() {
        let host = MemoryHost::default()
            .with_variable("GZ_IP", "localhost")
            .with_variable("GZ_DISCOVERY_MULTICAST_IP", "10.0.0.1")
            .with_variable("GZ_DISCOVERY_SRV_PORT", "0")
            .with_variable("GZ_RELAY", "10.0.0.1");
        let (settings, findings) = Settings::from_environment(&host);
        assert_eq!(
            settings,
            Settings { partition: settings.partition.clone(), ..Settings::default() }
        );
        assert_eq!(findings.iter().count(), 4);
    }
}
