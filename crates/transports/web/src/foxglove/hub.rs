//! Connection of a graph to all clients.

mod calls;
mod channels;
mod clients;
mod connections;
mod mismatches;
mod parameters;
mod services;
mod state;

use std::sync::{Arc, Condvar, Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_graph::{Graph, GraphError, Node, NodeSettings};
use periplus_transport::lock;

use crate::foxglove::network_endpoints::NetworkEndpoints;
use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::AssetAnswer;
use crate::foxglove::recordings::Recordings;
use crate::foxglove::session::ClientSession;
use crate::foxglove::settings::Settings;

use parameters::News;
pub(crate) use state::State;

/// Period at which changes of the graph are checked and clients get the time.
const LOOK: Duration = Duration::from_millis(20);

/// Returns files by their URI.
pub(crate) type Assets = Arc<dyn Fn(&str) -> AssetAnswer + Send + Sync>;

/// Connects clients to a graph until it is dropped: they see its topics, services and parameters,
/// subscribe, publish and call. One node of the graph represents all clients.
pub struct Hub {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

/// State shared by the hub's thread and its sessions.
pub(crate) struct Shared {
    pub(crate) graph: Graph,
    /// The node that represents all clients.
    pub(crate) node: Node,
    pub(crate) settings: Settings,
    pub(crate) state: Mutex<State>,
    pub(crate) assets: Mutex<Option<Assets>>,
    pub(crate) recordings: OnceLock<Arc<Recordings>>,
    /// Responses of nodes to parameter requests, with the id of the request.
    news: Arc<Mutex<Vec<(u64, News)>>>,
    is_closing: Mutex<bool>,
    closing: Condvar,
}

impl Hub {
    /// Creates a hub for a graph.
    ///
    /// # Errors
    /// When the graph has a node `/viewers` already.
    pub fn open(graph: &Graph, settings: Settings) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("viewers").bare().keep_names())?;
        let shared = Arc::new(Shared {
            graph: graph.clone(),
            node,
            settings,
            state: Mutex::default(),
            assets: Mutex::default(),
            recordings: OnceLock::new(),
            news: Arc::default(),
            is_closing: Mutex::new(false),
            closing: Condvar::new(),
        });
        lock(&shared.state).look(&shared);
        if cfg!(target_family = "wasm") {
            return Ok(Self { shared, thread: None });
        }
        let (looking, builder) = (shared.clone(), std::thread::Builder::new());
        let run = move || looking.run();
        let thread = builder.name("viewers".to_owned()).spawn(run);
        Ok(Self { shared, thread: Some(thread.expect("the system starts a thread")) })
    }

    /// Looks for changes of the graph and sends the time once, as a thread of the hub does every 20 ms. In
    /// WebAssembly, which has no threads, the caller does it instead.
    pub fn spin_once(&self) {
        self.shared.spin_once();
    }

    /// Sets the source of files that clients request by URI. The callback decides which files may
    /// be read.
    pub fn serve_assets(&self, fetch: impl Fn(&str) -> AssetAnswer + Send + Sync + 'static) {
        *lock(&self.shared.assets) = Some(Arc::new(fetch));
    }

    /// Serves recordings to clients that join from now on. The first call counts.
    pub fn serve_recordings(&self, recordings: Arc<Recordings>) {
        let _ = self.shared.recordings.set(recordings);
    }

    /// Sets the remote endpoints. Call it when they have changed.
    pub fn set_network_endpoints(&self, network: NetworkEndpoints) {
        lock(&self.shared.state).set_network_endpoints(&self.shared, network);
    }

    /// Adds a client. None if there are too many.
    #[must_use]
    pub fn join(&self) -> Option<ClientSession> {
        let outbox = Arc::new(Outbox::new(self.shared.settings.limits.waiting));
        let id = lock(&self.shared.state).join(&self.shared, &outbox)?;
        Some(ClientSession::new(id, self.shared.clone(), outbox))
    }

    /// Number of clients.
    #[must_use]
    pub fn clients(&self) -> usize {
        lock(&self.shared.state).clients.len()
    }

    /// Settings of the hub.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.shared.settings
    }
}

impl Drop for Hub {
    fn drop(&mut self) {
        *lock(&self.shared.is_closing) = true;
        self.shared.closing.notify_all();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        lock(&self.shared.state).end(&self.shared.graph);
        if let Some(recordings) = self.shared.recordings.get() {
            recordings.end();
        }
    }
}

impl Shared {
    fn run(&self) {
        let mut is_closing = lock(&self.is_closing);
        while !*is_closing {
            drop(is_closing);
            self.spin_once();
            let waited = self.closing.wait_timeout(lock(&self.is_closing), LOOK);
            is_closing = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn spin_once(&self) {
        let is_recording = self.recordings.get().is_some_and(|recordings| {
            recordings.tick();
            recordings.is_recording()
        });
        let mut state = lock(&self.state);
        state.look(self);
        state.record_network(self, is_recording);
        state.go_on(self);
        state.tell_time(self.graph.now_ns());
    }
}

impl std::fmt::Debug for Hub {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Hub").finish_non_exhaustive()
    }
}
