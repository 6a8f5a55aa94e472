//! Web page of a run or a network.

mod assets;
mod remote_topics;

use std::collections::BTreeMap;
use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use periplus_dds::Remote;
use periplus_graph::Graph;
use periplus_os::{Machine, unix_ns};
use periplus_resources::Host as _;
use periplus_web::foxglove::Hub;
use periplus_web::foxglove::Settings;
use periplus_web::server::{WebServer, WebServerSettings, token};

use crate::terminal;

/// Default port of Foxglove programs.
pub(crate) const PORT: u16 = 8765;

/// Options of the page.
#[derive(Debug, Args)]
pub(crate) struct PageOptions {
    /// Serve the page at 127.0.0.1:8765 or at another address; Lichtblick and Foxglove connect
    /// there too
    #[arg(
        long,
        value_name = "ADDRESS:PORT",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "127.0.0.1",
        value_parser = address
    )]
    pub(crate) page: Option<SocketAddr>,
    /// Token that admits other machines and pages from elsewhere [default: a new one if other
    /// machines reach the address]
    #[arg(long, value_name = "TOKEN", requires = "page")]
    pub(crate) token: Option<String>,
}

/// Context of a page.
#[derive(Debug, Default)]
pub(crate) struct About {
    /// The world that is simulated.
    pub(crate) world: Option<String>,
    /// Files whose surrounding folders the page may read.
    pub(crate) files: Vec<PathBuf>,
    /// Folders searched for packages and models.
    pub(crate) resource_path: Vec<PathBuf>,
    /// RViz file that the page opens.
    pub(crate) view: Option<PathBuf>,
    /// Fixed frame of the display, overriding the one in `view`.
    pub(crate) fixed_frame: Option<String>,
}

/// Running page.
#[derive(Debug)]
pub(crate) struct Page {
    // Declared first, so that no client connects while the rest is dropped.
    server: WebServer,
    hub: Arc<Hub>,
}

impl Page {
    /// Opens the page on a graph, if requested.
    ///
    /// # Errors
    /// A message when it cannot be opened.
    pub(crate) fn join(
        graph: &Graph,
        options: &PageOptions,
        about: About,
    ) -> Result<Option<Self>, String> {
        options.page.map(|at| Self::open(graph, at, options.token.clone(), about)).transpose()
    }

    /// Opens the page on a graph.
    ///
    /// # Errors
    /// A message when it cannot be opened.
    pub(crate) fn open(
        graph: &Graph,
        address: SocketAddr,
        given: Option<String>,
        about: About,
    ) -> Result<Self, String> {
        let version = env!("CARGO_PKG_VERSION");
        let mut metadata = BTreeMap::from([("periplus".to_owned(), version.to_owned())]);
        if let Some(world) = about.world {
            metadata.insert("world".to_owned(), world);
        }
        if let Some(frame) = about.fixed_frame {
            metadata.insert("fixed_frame".to_owned(), frame);
        }
        if let Some(view) = &about.view {
            let text = Machine.read(view).map_err(|error| error.to_string());
            match text.and_then(|text| String::from_utf8(text).map_err(|error| error.to_string())) {
                Ok(text) => {
                    let name = view.file_name().unwrap_or_default().to_string_lossy().into_owned();
                    metadata.insert("rviz".to_owned(), text);
                    metadata.insert("rviz_file".to_owned(), name);
                }
                Err(why) => {
                    terminal::warn(&format!("{} is not opened: {why}", view.display()));
                }
            }
        }
        let settings = Settings {
            name: format!("periplus {version}"),
            session_id: format!("{:x}", unix_ns()),
            metadata,
            ..Settings::default()
        };
        let is_open = !address.ip().is_loopback();
        let token = match given {
            None if is_open => Some(token()?),
            given => given,
        };
        let hub = Hub::open(graph, settings).map_err(|error| error.to_string())?;
        hub.serve_assets(assets::fetch(about.files, about.resource_path));
        let hub = Arc::new(hub);
        let open =
            |address, token| WebServer::open(hub.clone(), WebServerSettings { address, token });
        let is_taken = |error: &std::io::Error| error.kind() == std::io::ErrorKind::AddrInUse;
        let server = match open(address, token.clone()) {
            // Another run has the default port: any other will do unless one was requested.
            Err(error) if is_taken(&error) && address.port() == PORT => {
                terminal::say(&format!("port {PORT} is in use; the page uses another port"));
                open(SocketAddr::new(address.ip(), 0), token)
            }
            opened => opened,
        };
        let server = server.map_err(|error| {
            let advice = "; choose another port, such as --page=8766, or 0 for any free port";
            let why = periplus_diagnostics::plain_words(&error);
            format!("no page at {address}: {why}{}", if is_taken(&error) { advice } else { "" })
        })?;
        Ok(Self { server, hub })
    }

    /// Updates the topics of remote nodes.
    pub(crate) fn set_remote(&self, remote: &Remote) {
        self.hub.set_network_endpoints(remote_topics::remote_topics(remote));
    }

    /// URL of the page.
    pub(crate) fn url(&self) -> String {
        self.server.url()
    }
}

/// Parses `ADDRESS:PORT`, one of them, or `localhost`.
pub(crate) fn address(word: &str) -> Result<SocketAddr, String> {
    let loopback = IpAddr::from([127, 0, 0, 1]);
    let named = word.replacen("localhost", "127.0.0.1", 1);
    if let Ok(address) = named.parse::<SocketAddr>() {
        return Ok(address);
    }
    if let Ok(port) = named.parse::<u16>() {
        return Ok(SocketAddr::new(loopback, port));
    }
    let bare = named.trim_start_matches('[').trim_end_matches(']');
    match bare.parse::<IpAddr>() {
        Ok(ip) => Ok(SocketAddr::new(ip, PORT)),
        Err(_) => Err("expected an address of this machine, a port, or both: \
                       127.0.0.1:8765; 0.0.0.0 opens it to others"
            .into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_an_address_is_enough() {
        let check = |word: &str, expected: &str| {
            assert_eq!(address(word).map(|one| one.to_string()).as_deref(), Ok(expected));
        };
        check("8766", "127.0.0.1:8766");
        check("localhost", "127.0.0.1:8765");
        check("localhost:1", "127.0.0.1:1");
        check("0.0.0.0", "0.0.0.0:8765");
        check("[::1]:9", "[::1]:9");
        check("::1", "[::1]:8765");
        assert!(address("robot").is_err() && address("99999").is_err());
    }
}
