//! The page on a port.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;

use periplus_dds::Remote;
use periplus_graph::Graph;
use periplus_ros1::SystemState;
use periplus_web::foxglove::Recordings;
use periplus_web::server::{WebServer, WebServerSettings, token};

use super::{PageContext, PageError, PageHub, browser, remote_topics};
use crate::terminal;

/// Default port of Foxglove programs.
pub const DEFAULT_PORT: u16 = 8765;

/// Default address: this machine only.
#[must_use]
pub fn default_address() -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], DEFAULT_PORT))
}

/// Settings of a page.
#[derive(Clone, Debug)]
pub struct PageSettings {
    /// Address and port of the page.
    pub address: SocketAddr,
    /// Token that admits other machines; by default a new one if they reach the address.
    pub token: Option<String>,
    /// Contents besides the topics.
    pub context: PageContext,
    /// True if a page that cannot be opened is an error; otherwise it is a warning.
    pub is_required: bool,
    /// True to open a browser.
    pub opens_browser: bool,
    /// True to print neither the URL nor a missing browser.
    pub is_quiet: bool,
    /// Text printed after the URL.
    pub hint: &'static str,
}

impl PageSettings {
    pub(crate) fn context(&self) -> &PageContext {
        &self.context
    }

    pub(crate) fn context_mut(&mut self) -> &mut PageContext {
        &mut self.context
    }

    /// Required page at an address, without a browser.
    #[must_use]
    pub fn at(address: SocketAddr, token: Option<String>, context: PageContext) -> Self {
        Self {
            address,
            token,
            context,
            is_required: true,
            opens_browser: false,
            is_quiet: false,
            hint: "",
        }
    }
}

pub(super) fn is_taken(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::AddrInUse
}

/// Running page.
#[derive(Debug)]
pub struct Page {
    // Declared first, so that no client connects while the rest is dropped.
    server: WebServer,
    hub: PageHub,
}

impl Page {
    /// Opens the page on a graph, prints its URL, and opens a browser if requested. `None` if a
    /// page that is not required cannot be opened.
    ///
    /// # Errors
    /// When a required page cannot be opened.
    pub fn open(graph: &Graph, settings: &PageSettings) -> Result<Option<Self>, PageError> {
        let page = match Self::serve(graph, settings) {
            Ok(page) => page,
            Err(error) if settings.is_required => return Err(error),
            Err(error) => {
                terminal::warn(&format!("{error}; running without"));
                return Ok(None);
            }
        };
        let url = page.url();
        if !settings.is_quiet {
            terminal::say(&format!("page: {url}{}", settings.hint));
            if let Some(view) = &settings.context.view {
                terminal::say(&format!("it shows {}", view.display()));
            }
        }
        if settings.opens_browser && !browser::open(&url) && !settings.is_quiet {
            terminal::say("no browser could be started; open the page yourself");
        }
        Ok(Some(page))
    }

    /// Opens the page on a graph, and prints nothing.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub fn serve(graph: &Graph, settings: &PageSettings) -> Result<Self, PageError> {
        let address = settings.address;
        let token = match settings.token.clone() {
            None if !address.ip().is_loopback() => Some(token().map_err(PageError::Token)?),
            given => given,
        };
        let hub = PageHub::open(graph, &settings.context)?;
        let open =
            |address, token| WebServer::open(hub.hub.clone(), WebServerSettings { address, token });
        let server = match open(address, token.clone()) {
            // Another run has the default port: any other will do unless one was requested.
            Err(error) if is_taken(&error) && address.port() == DEFAULT_PORT => {
                terminal::say(&format!(
                    "port {DEFAULT_PORT} is in use; the page uses another port"
                ));
                open(SocketAddr::new(address.ip(), 0), token)
            }
            opened => opened,
        };
        let server = server.map_err(|error| PageError::Address(address, error))?;
        Ok(Self { server, hub })
    }

    /// Updates the topics of remote nodes.
    pub fn set_remote(&self, remote: Option<&Remote>, ros1: Option<&SystemState>) {
        let mut endpoints = remote.map(remote_topics::remote_topics).unwrap_or_default();
        if let Some(state) = ros1 {
            remote_topics::add_ros1(&mut endpoints, state);
        }
        self.hub.hub.set_network_endpoints(endpoints);
    }

    /// Recordings of the page.
    #[must_use]
    pub fn recordings(&self) -> &Arc<Recordings> {
        &self.hub.recordings
    }

    /// URL of the page.
    #[must_use]
    pub fn url(&self) -> String {
        self.server.url()
    }
}
