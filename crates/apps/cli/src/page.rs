//! The page: a run or a network in a browser.

mod assets;
mod far;

use std::collections::BTreeMap;
use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use periplus_dds::Remote;
use periplus_graph::Graph;
use periplus_os::{Machine, unix_ns};
use periplus_resources::Host as _;
use periplus_server::{Hub, Server, ServerSettings, token};
use periplus_wire_live::Settings;

use crate::terminal;

/// The port that Foxglove's programs look at first.
pub(crate) const PORT: u16 = 8765;

/// Where it is shown.
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

/// What a page tells of where it comes from.
#[derive(Debug, Default)]
pub(crate) struct About {
    /// The world that is simulated.
    pub(crate) world: Option<String>,
    /// Files whose neighbourhood may be asked for.
    pub(crate) files: Vec<PathBuf>,
    /// Folders in which packages and models are looked for.
    pub(crate) resource_path: Vec<PathBuf>,
    /// RViz file that the page opens.
    pub(crate) view: Option<PathBuf>,
    /// Frame that the page draws in, in place of the one in `view`.
    pub(crate) fixed_frame: Option<String>,
}

/// An open page.
#[derive(Debug)]
pub(crate) struct Page {
    // First, so that nobody comes in while the rest goes.
    server: Server,
    hub: Arc<Hub>,
}

impl Page {
    /// Opens it before a graph, if it is asked for.
    ///
    /// # Errors
    /// Why it cannot be.
    pub(crate) fn join(
        graph: &Graph,
        options: &PageOptions,
        about: About,
    ) -> Result<Option<Self>, String> {
        options.page.map(|at| Self::open(graph, at, options.token.clone(), about)).transpose()
    }

    /// Opens it before a graph.
    ///
    /// # Errors
    /// Why it cannot be.
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
        let open = |address, token| Server::open(hub.clone(), ServerSettings { address, token });
        let is_taken = |error: &std::io::Error| error.kind() == std::io::ErrorKind::AddrInUse;
        let server = match open(address, token.clone()) {
            // Another run has the usual port: any other does where none was asked for.
            Err(error) if is_taken(&error) && address.port() == PORT => {
                terminal::say(&format!("port {PORT} is taken, the page gets another"));
                open(SocketAddr::new(address.ip(), 0), token)
            }
            opened => opened,
        };
        let server = server.map_err(|error| {
            let advice = "; name another port, such as --page=8766, or 0 for any that is free";
            let why = periplus_diagnostics::plain_words(&error);
            format!("no page at {address}: {why}{}", if is_taken(&error) { advice } else { "" })
        })?;
        Ok(Self { server, hub })
    }

    /// What others have on a network that the graph is on.
    pub(crate) fn set_remote(&self, remote: &Remote) {
        self.hub.set_far(far::far(remote));
    }

    /// What to type into a browser.
    pub(crate) fn url(&self) -> String {
        self.server.url()
    }
}

/// `ADDRESS:PORT`, one of them, or `localhost`.
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
        Err(_) => Err("it has to be an address of this machine, a port, or both: \
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
