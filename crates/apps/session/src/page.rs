//! Web page of a session or a network.

#[cfg(target_family = "wasm")]
mod absent;
mod assets;
#[cfg(not(target_family = "wasm"))]
pub mod browser;
mod recordings;
#[cfg(not(target_family = "wasm"))]
mod remote_topics;
#[cfg(not(target_family = "wasm"))]
mod server;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;
#[cfg(not(target_family = "wasm"))]
use std::io;
#[cfg(not(target_family = "wasm"))]
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(not(target_family = "wasm"))]
use periplus_diagnostics::plain_words;
use periplus_graph::{Graph, GraphError};
use periplus_os::{Machine, unix_ns};
use periplus_resources::Host as _;
use periplus_sim::Composition;
use periplus_web::foxglove::{Hub, Recordings, Settings};
#[cfg(not(target_family = "wasm"))]
use periplus_web::server::TokenError;

#[cfg(target_family = "wasm")]
pub use absent::{NoPage as Page, NoPageSettings as PageSettings};
#[cfg(not(target_family = "wasm"))]
pub use server::{DEFAULT_PORT, Page, PageSettings, default_address};

use crate::rerun::ReportWriter;
use crate::terminal;

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

/// Reasons that a page cannot be opened.
#[derive(Debug)]
pub enum PageError {
    /// No token can be generated.
    #[cfg(not(target_family = "wasm"))]
    Token(TokenError),
    /// The graph refused the node of the page.
    Graph(GraphError),
    /// The address cannot be used.
    #[cfg(not(target_family = "wasm"))]
    Address(SocketAddr, io::Error),
    /// A recording cannot be opened, with the reason.
    Recording(String),
}

impl fmt::Display for PageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            #[cfg(not(target_family = "wasm"))]
            Self::Token(error) => error.fmt(f),
            Self::Graph(error) => error.fmt(f),
            Self::Recording(why) => f.write_str(why),
            #[cfg(not(target_family = "wasm"))]
            Self::Address(address, error) => {
                write!(f, "no page at {address}: {}", plain_words(error))?;
                if server::is_taken(error) {
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

/// A graph in the protocol of the page, without a port.
#[derive(Clone, Debug)]
pub struct PageHub {
    /// Connection of the graph to all clients.
    pub hub: Arc<Hub>,
    /// Recordings of the page.
    pub recordings: Arc<Recordings>,
}

impl PageHub {
    /// Connects a graph, with the contents that the page shows.
    ///
    /// # Errors
    /// When the graph refuses the node of the page, or a recording cannot be opened.
    pub fn open(graph: &Graph, context: &PageContext) -> Result<Self, PageError> {
        let version = env!("CARGO_PKG_VERSION");
        let settings = Settings {
            name: format!("periplus {version}"),
            session_id: format!("{:x}", unix_ns()),
            metadata: metadata(context),
            ..Settings::default()
        };
        let hub = Hub::open(graph, settings).map_err(PageError::Graph)?;
        let around: Vec<PathBuf> =
            context.files.iter().chain(&context.recordings).cloned().collect();
        hub.serve_assets(assets::fetch(&around, &context.resource_path));
        let recordings = recordings::open(context).map_err(PageError::Recording)?;
        hub.serve_recordings(recordings.clone());
        Ok(Self { hub: Arc::new(hub), recordings })
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
