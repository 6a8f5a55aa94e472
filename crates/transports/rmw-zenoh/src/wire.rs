//! Handle of the Zenoh transport.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, Node};
use periplus_transport::{Bell, lock, stand_in, wait_until};
use zenoh::{Config, Session, Wait};

use crate::link::Link;
use crate::outgoing::{Job, Lane};
use crate::{EntityToken, Settings, ZenohError, token};

/// Time for sending the remaining messages when the transport is dropped.
const LAST_CHANCE: Duration = Duration::from_millis(300);

/// A Zenoh session for one graph. It leaves the network when this is dropped.
pub struct ZenohTransport {
    shared: Arc<Shared>,
    session: Session,
    lane: Lane,
    threads: Vec<JoinHandle<()>>,
}

/// State shared by the handle, the threads and Zenoh's threads.
#[derive(Default)]
pub(crate) struct Shared {
    /// Remote tokens by key, and their change counter.
    others: Mutex<(BTreeMap<String, EntityToken>, u64)>,
    /// Notified when the tokens have changed.
    changed: Condvar,
    /// Rings when the link thread has work.
    bell: Bell,
    findings: Mutex<Diagnostics>,
    /// A graph to attach, with the node that represents all remote programs.
    pub(crate) joining: Mutex<Option<(Graph, Node)>>,
    is_closing: AtomicBool,
    is_attached: AtomicBool,
}

impl Shared {
    pub(crate) fn report(&self, finding: Diagnostic) {
        lock(&self.findings).push(finding);
    }

    /// Wakes the link thread.
    pub(crate) fn wake(&self) {
        self.bell.ring();
    }

    /// Sleeps until the link thread has work, at most for the timeout; false when the transport is
    /// closed.
    pub(crate) fn sleep(&self, timeout: Duration) -> bool {
        self.bell.wait(timeout);
        !self.is_closing.load(Ordering::Acquire)
    }

    /// Accesses the remote tokens and their change counter.
    pub(crate) fn others<T>(
        &self,
        look: impl FnOnce(&BTreeMap<String, EntityToken>, u64) -> T,
    ) -> T {
        let others = lock(&self.others);
        look(&others.0, others.1)
    }

    /// Adds or removes a token.
    fn note(&self, key: &str, is_alive: bool) {
        let Some(token) = EntityToken::read(key) else { return };
        let mut others = lock(&self.others);
        if is_alive {
            others.0.insert(key.to_owned(), token);
        } else {
            others.0.remove(key);
        }
        others.1 += 1;
        drop(others);
        self.changed.notify_all();
        self.wake();
    }
}

/// Builds Zenoh's configuration: a file as it is, or the defaults, with the overrides on top.
fn configuration(settings: &Settings) -> Result<Config, ZenohError> {
    let wrong = |what: &str, why: &dyn std::fmt::Display| ZenohError::Setting {
        what: what.to_owned(),
        why: why.to_string(),
    };
    let mut config = match &settings.file {
        Some(file) => Config::from_file(file)
            .map_err(|why| wrong(&format!("ZENOH_SESSION_CONFIG_URI `{file}`"), &why))?,
        None => Config::from_json5(&settings.config())
            .map_err(|why| wrong("the endpoints to connect to and to listen at", &why))?,
    };
    let overrides = settings
        .overrides()
        .map_err(|part| wrong(&format!("ZENOH_CONFIG_OVERRIDE `{part}`"), &"it has no `=`"))?;
    for (path, value) in overrides {
        config
            .insert_json5(path, value)
            .map_err(|why| wrong(&format!("ZENOH_CONFIG_OVERRIDE `{path}={value}`"), &why))?;
    }
    Ok(config)
}

impl ZenohTransport {
    /// Joins the network.
    ///
    /// # Errors
    /// When a setting is invalid, or Zenoh cannot listen at an endpoint.
    pub fn open(settings: &Settings) -> Result<Self, ZenohError> {
        let network = |error: zenoh::Error| ZenohError::Network {
            way: settings.way(),
            why: error.to_string(),
        };
        let session = zenoh::open(configuration(settings)?).wait().map_err(network)?;
        let shared = Arc::new(Shared::default());
        if session.info().routers_zid().wait().next().is_none() {
            let message = format!("no Zenoh router answers at {}", settings.way());
            shared.report(Diagnostic::warning("zenoh-router", message).help(
                "programs discover each other through it: `ros2 run rmw_zenoh_cpp rmw_zenohd`; the \
                 connection is retried",
            ));
        }
        let own = session.zid().to_string();
        let noting = shared.clone();
        session
            .liveliness()
            .declare_subscriber(token::all(settings.domain_id))
            .history(true)
            .callback(move |sample| {
                let key = sample.key_expr().as_str();
                if key.split('/').nth(2) != Some(&own) {
                    noting.note(key, sample.kind() == zenoh::sample::SampleKind::Put);
                }
            })
            .background()
            .wait()
            .map_err(network)?;
        let (lane, sending) = Lane::start("zenoh-send", Job::perform);
        let link = Link::new(session.clone(), shared.clone(), lane.clone(), settings);
        let thread = std::thread::Builder::new().name("zenoh".to_owned());
        let linking = thread.spawn(move || link.run()).expect("the system starts a thread");
        Ok(Self { shared, session, lane, threads: vec![linking, sending] })
    }

    /// Attaches a graph for the lifetime of this handle: its endpoints become visible on the
    /// network, and remote endpoints are connected to it. A node whose name begins with `_wire`
    /// represents all remote programs in the graph.
    ///
    /// # Errors
    /// When a graph is attached already.
    pub fn attach(&self, graph: &Graph) -> Result<(), ZenohError> {
        if self.shared.is_attached.swap(true, Ordering::AcqRel) {
            return Err(ZenohError::Attached);
        }
        let node = stand_in(graph, &self.session.zid().to_le_bytes())?;
        *lock(&self.shared.joining) = Some((graph.clone(), node));
        self.shared.wake();
        Ok(())
    }

    /// Remote tokens, sorted by key. Discovery takes a moment: see [`ZenohTransport::wait_for`].
    #[must_use]
    pub fn remote(&self) -> Vec<EntityToken> {
        self.shared.others(|others, _| others.values().cloned().collect())
    }

    /// Waits until the remote side satisfies the condition, at most for the timeout; true if it
    /// does.
    pub fn wait_for(
        &self,
        timeout: Duration,
        mut wanted: impl FnMut(&[EntityToken]) -> bool,
    ) -> bool {
        let others = lock(&self.shared.others);
        let mut seen = None;
        let waited =
            self.shared.changed.wait_timeout_while(others, timeout, |(others, changes)| {
                // Skip the check while nothing has changed.
                if seen.replace(*changes) == Some(*changes) {
                    return true;
                }
                let others: Vec<EntityToken> = others.values().cloned().collect();
                !wanted(&others)
            });
        !waited.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Waits until everything published so far was handed to the network, at most for the timeout;
    /// true if it was.
    #[must_use]
    pub fn flush(&self, timeout: Duration) -> bool {
        wait_until(timeout, || self.lane.is_idle())
    }

    /// Returns the findings since the last call.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut *lock(&self.shared.findings))
    }
}

impl Drop for ZenohTransport {
    fn drop(&mut self) {
        let _ = self.flush(LAST_CHANCE);
        self.shared.is_closing.store(true, Ordering::Release);
        self.shared.wake();
        self.lane.end();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
        let _ = self.session.close().wait();
    }
}

impl std::fmt::Debug for ZenohTransport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ZenohTransport")
            .field("session", &self.session.zid())
            .finish_non_exhaustive()
    }
}
