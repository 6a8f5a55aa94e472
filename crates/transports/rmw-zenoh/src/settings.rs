//! Which network a wire is on, and what the environment says about that.

use periplus_diagnostics::Diagnostics;
use periplus_resources::Host;
use periplus_transport::environment;

/// Which network a wire is on. The default is domain 0 by way of a router on this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// `ROS_DOMAIN_ID`: who has another is not heard.
    pub domain_id: u32,
    /// Where to connect to: the router by which others are found.
    pub connect: Vec<String>,
    /// Where others may connect to us, once the router has told them.
    pub listen: Vec<String>,
    /// `ZENOH_SESSION_CONFIG_URI`: a file that takes the place of the two above and of all other
    /// defaults.
    pub file: Option<String>,
    /// `ZENOH_CONFIG_OVERRIDE`: single settings that win over all, `path=value;path=value`.
    pub more: String,
    /// The security enclave that others are told.
    pub enclave: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            domain_id: 0,
            connect: vec!["tcp/localhost:7447".to_owned()],
            listen: vec!["tcp/localhost:0".to_owned()],
            file: None,
            more: String::new(),
            enclave: "/".to_owned(),
        }
    }
}

impl Settings {
    /// What the environment says, in the variables that `rmw_zenoh` reads; what it does not say is as
    /// in [`Settings::default`].
    #[must_use]
    pub fn from_environment(host: &dyn Host) -> (Self, Diagnostics) {
        let mut findings = Diagnostics::default();
        let file = environment::variable(host, "ZENOH_SESSION_CONFIG_URI");
        let settings = Self {
            domain_id: environment::domain_id(host, &mut findings),
            file: file.map(|file| file.trim().to_owned()),
            more: environment::variable(host, "ZENOH_CONFIG_OVERRIDE").unwrap_or_default(),
            ..Self::default()
        };
        (settings, findings)
    }

    /// The single settings that win over all: path and value. The text of what is none is an error.
    ///
    /// # Errors
    /// The part that has no `=`.
    pub fn overrides(&self) -> Result<Vec<(&str, &str)>, &str> {
        let parts = self.more.split(';').map(str::trim).filter(|part| !part.is_empty());
        parts
            .map(|part| {
                let (path, value) = part.split_once('=').ok_or(part)?;
                Ok((path.trim(), value.trim()))
            })
            .collect()
    }

    /// By which way others are found, in words.
    #[must_use]
    pub fn way(&self) -> String {
        let overrides = self.overrides().unwrap_or_default();
        let given = overrides.iter().rfind(|(path, _)| *path == "connect/endpoints");
        match (given, &self.file) {
            (Some((_, ends)), _) => format!("the router at {ends}"),
            (None, Some(file)) => format!("what {file} says"),
            (None, None) => format!("the router at {}", self.connect.join(", ")),
        }
    }

    /// The defaults that `rmw_zenoh` gives to a session, as Zenoh reads them: found by gossip of the
    /// router and not by multicast; messages have times, or nothing is kept for latecomers.
    #[must_use]
    pub fn config(&self) -> String {
        let list = |ends: &[String]| {
            let quoted: Vec<String> = ends.iter().map(|end| format!("{end:?}")).collect();
            quoted.join(", ")
        };
        format!(
            r#"{{
  mode: "peer",
  connect: {{ timeout_ms: {{ peer: -1, client: 0 }}, exit_on_failure: {{ peer: false }}, endpoints: [{}] }},
  listen: {{ endpoints: [{}] }},
  scouting: {{
    multicast: {{ enabled: false }},
    gossip: {{
      enabled: true,
      target: {{ router: ["router", "peer"], peer: ["router"] }},
      autoconnect_strategy: {{ peer: {{ to_router: "always", to_peer: "greater-zid" }} }},
    }},
  }},
  timestamping: {{ enabled: {{ router: true, peer: true, client: true }} }},
  queries_default_timeout: 60000,
}}"#,
            list(&self.connect),
            list(&self.listen)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_resources::MemoryHost;

    #[test]
    fn the_environment_is_read() {
        let host = MemoryHost::default()
            .with_variable("ROS_DOMAIN_ID", "7")
            .with_variable("ZENOH_SESSION_CONFIG_URI", "/etc/session.json5")
            .with_variable("ZENOH_CONFIG_OVERRIDE", "mode=\"client\"; scouting/delay = 1;");
        let (settings, findings) = Settings::from_environment(&host);
        assert!(findings.iter().next().is_none());
        assert_eq!((settings.domain_id, settings.file.as_deref()), (7, Some("/etc/session.json5")));
        let expected = vec![("mode", "\"client\""), ("scouting/delay", "1")];
        assert_eq!(settings.overrides(), Ok(expected));
        assert_eq!(settings.way(), "what /etc/session.json5 says");
        assert_eq!(Settings::default().way(), "the router at tcp/localhost:7447");
        let more = "connect/endpoints=[\"tcp/robot:7447\"]".to_owned();
        let given = Settings { more, ..settings.clone() };
        assert_eq!(given.way(), "the router at [\"tcp/robot:7447\"]");
        let bad = Settings { more: "a=1;b".to_owned(), ..settings };
        assert_eq!(bad.overrides(), Err("b"));
        assert_eq!(Settings::from_environment(&MemoryHost::default()).0, Settings::default());
    }
}
