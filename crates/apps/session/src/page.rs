//! Web page of a session or a network.

mod assets;
pub mod browser;
mod recordings;
mod remote_topics;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;
use std::io;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_dds::Remote;
use periplus_diagnostics::plain_words;
use periplus_graph::{Graph, GraphError};
use periplus_os::{Machine, unix_ns};
use periplus_resources::Host as _;
use periplus_sim::Composition;
use periplus_web::foxglove::{Hub, Recordings, Settings};
use periplus_web::server::{TokenError, WebServer, WebServerSettings, token};

use crate::rerun::ReportWriter;
use crate::terminal;

/// Default port of Foxglove programs.
pub const DEFAULT_PORT: u16 = 8765;

/// Default address: this machine only.
#[must_use]
pub fn default_address() -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], DEFAULT_PORT))
}

/// Contents that a page shows besides the topics.
#[derive(Clone, Debug, Default)]
pub struct PageContext {
    /// The world that is simulated.
    pub world: Option<String>,
    /// Files whose surrounding folders the page may read.
    pub files: Vec<PathBuf>,
    /// Folders searched for packages and models.
    pub resource_path: Vec<PathBuf>,
    /// RViz file that the page opens.
    pub view: Option<PathBuf>,
    /// Fixed frame of the display, overriding the one in `view`.
    pub fixed_frame: Option<String>,
    /// Recordings that the page opens.
    pub recordings: Vec<PathBuf>,
    /// File to which the page may write the changed world.
    pub world_out: Option<PathBuf>,
    /// Facts of the run by name, which recordings made by the page contain.
    pub description: BTreeMap<String, String>,
    /// Writer of the reports that the page offers; none to offer no reports.
    pub report: Option<ReportWriter>,
}

impl PageContext {
    /// World and files of a composition.
    #[must_use]
    pub fn of(composition: &Composition, resource_path: &[PathBuf]) -> Self {
        Self {
            world: Some(composition.world.name.clone()),
            files: composition.files.iter().map(|file| file.path.clone()).collect(),
            resource_path: resource_path.to_vec(),
            ..Self::default()
        }
    }

    /// Folders around the files.
    pub(crate) fn folders(&self) -> Vec<PathBuf> {
        self.files.iter().filter_map(|file| file.parent()).map(Path::to_owned).collect()
    }
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

/// Reasons that a page cannot be opened.
#[derive(Debug)]
pub enum PageError {
    /// No token can be generated.
    Token(TokenError),
    /// The graph refused the node of the page.
    Graph(GraphError),
    /// The address cannot be used.
    Address(SocketAddr, io::Error),
    /// A recording cannot be opened, with the reason.
    Recording(String),
}

impl fmt::Display for PageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Token(error) => error.fmt(f),
            Self::Graph(error) => error.fmt(f),
            Self::Recording(why) => f.write_str(why),
            Self::Address(address, error) => {
                write!(f, "no page at {address}: {}", plain_words(error))?;
                if is_taken(error) {
                    f.write_str(
                        "; choose another port, such as --page=8766, or 0 for any free port",
                    )?;
                }
                Ok(())
            }
        }
    }
}

impl Error for PageError {}

fn is_taken(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::AddrInUse
}

/// Running page.
#[derive(Debug)]
pub struct Page {
    // Declared first, so that no client connects while the rest is dropped.
    server: WebServer,
    hub: Arc<Hub>,
    recordings: Arc<Recordings>,
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
        let (address, context) = (settings.address, &settings.context);
        let version = env!("CARGO_PKG_VERSION");
        let hub_settings = Settings {
            name: format!("periplus {version}"),
            session_id: format!("{:x}", unix_ns()),
            metadata: metadata(context),
            ..Settings::default()
        };
        let token = match settings.token.clone() {
            None if !address.ip().is_loopback() => Some(token().map_err(PageError::Token)?),
            given => given,
        };
        let hub = Hub::open(graph, hub_settings).map_err(PageError::Graph)?;
        let around: Vec<PathBuf> =
            context.files.iter().chain(&context.recordings).cloned().collect();
        hub.serve_assets(assets::fetch(&around, &context.resource_path));
        let recordings = recordings::open(context).map_err(PageError::Recording)?;
        hub.serve_recordings(recordings.clone());
        let hub = Arc::new(hub);
        let open =
            |address, token| WebServer::open(hub.clone(), WebServerSettings { address, token });
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
        Ok(Self { server, hub, recordings })
    }

    /// Updates the topics of remote nodes.
    pub fn set_remote(&self, remote: &Remote) {
        self.hub.set_network_endpoints(remote_topics::remote_topics(remote));
    }

    /// Recordings of the page.
    #[must_use]
    pub fn recordings(&self) -> &Arc<Recordings> {
        &self.recordings
    }

    /// URL of the page.
    #[must_use]
    pub fn url(&self) -> String {
        self.server.url()
    }
}

/// Metadata for the page: version, world, and the display configuration.
fn metadata(context: &PageContext) -> BTreeMap<String, String> {
    let version = env!("CARGO_PKG_VERSION");
    let mut metadata = BTreeMap::from([("periplus".to_owned(), version.to_owned())]);
    if !context.recordings.is_empty() {
        metadata.insert("mode".to_owned(), "replay".to_owned());
    }
    if let Some(world) = &context.world {
        metadata.insert("world".to_owned(), world.clone());
    }
    if let Some(frame) = &context.fixed_frame {
        metadata.insert("fixed_frame".to_owned(), frame.clone());
    }
    let Some(view) = &context.view else { return metadata };
    let text = Machine.read(view).map_err(|error| error.to_string());
    match text.and_then(|text| String::from_utf8(text).map_err(|error| error.to_string())) {
        Ok(text) => {
            let name = view.file_name().unwrap_or_default().to_string_lossy().into_owned();
            metadata.insert("rviz".to_owned(), text);
            metadata.insert("rviz_file".to_owned(), name);
        }
        Err(why) => terminal::warn(&format!("{} is not opened: {why}", view.display())),
    }
    metadata
}
