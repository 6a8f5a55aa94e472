//! Network settings and the environment variables for them.

use periplus_diagnostics::Diagnostics;
use periplus_resources::Host;
use periplus_transport::environment;

/// Network settings. The default is domain 0 through a router on this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// `ROS_DOMAIN_ID`: programs in another domain are invisible.
    pub domain_id: u32,
    /// Endpoints of the router to connect to.
    pub connect: Vec<String>,
    /// Endpoints at which peers can connect, announced through the router.
    pub listen: Vec<String>,
    /// `ZENOH_SESSION_CONFIG_URI`: a file that replaces the two above and all other defaults.
    pub file: Option<String>,
    /// `ZENOH_CONFIG_OVERRIDE`: single settings that override everything else,
    /// `path=value;path=value`.
    pub more: String,
    /// Security enclave announced to other programs.
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
    /// Reads the environment variables of `rmw_zenoh`; missing variables are as in
    /// [`Settings::default`].
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

    /// Parses `ZENOH_CONFIG_OVERRIDE` into paths and values.
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

    /// Describes the router or configuration for messages.
    #[must_use]
    pub fn way(&self) -> String {
        let overrides = self.overrides().unwrap_or_default();
        let given = overrides.iter().rfind(|(path, _)| *path == "connect/endpoints");
        match (given, &self.file) {
            (Some((_, ends)), _) => format!("the router at {ends}"),
            (None, Some(file)) => format!("the configuration {file}"),
            (None, None) => format!("the router at {}", self.connect.join(", ")),
        }
    }

    /// Default session configuration of `rmw_zenoh`: gossip scouting through the router, no
    /// multicast; messages are time-stamped, which retained messages need.
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
        assert_eq!(settings.way(), "the configuration /etc/session.json5");
        assert_eq!(Settings::default().way(), "the router at tcp/localhost:7447");
        let more = "connect/endpoints=[\"tcp/robot:7447\"]".to_owned();
        let given = Settings { more, ..settings.clone() };
        assert_eq!(given.way(), "the router at [\"tcp/robot:7447\"]");
        let bad = Settings { more: "a=1;b".to_owned(), ..settings };
        assert_eq!(bad.overrides(), Err("b"));
        assert_eq!(Settings::from_environment(&MemoryHost::default()).0, Settings::default());
    }
}
