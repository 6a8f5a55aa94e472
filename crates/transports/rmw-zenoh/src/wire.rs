//! The handle of a wire.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, Node};
use periplus_transport::{Since, lock, stand_in};
use zenoh::{Config, Session, Wait};

use crate::link::Link;
use crate::outgoing::{Job, Lane};
use crate::{Settings, Token, WireError, token};

/// How often a flush looks again.
const LOOK_AGAIN: Duration = Duration::from_millis(5);

/// What is left when a wire is dropped gets so long to go.
const LAST_CHANCE: Duration = Duration::from_millis(300);

/// A place in the network. It is left when this is dropped.
pub struct Wire {
    shared: Arc<Shared>,
    session: Session,
    lane: Lane,
    threads: Vec<JoinHandle<()>>,
}

/// What the threads of a wire, Zenoh's own and its handle have in common.
#[derive(Default)]
pub(crate) struct Shared {
    /// Those of others, by key, and how often they changed.
    others: Mutex<(BTreeMap<String, Token>, u64)>,
    /// Rung when the tokens have changed.
    changed: Condvar,
    /// Set when the link has something to look at, and rung.
    due: Mutex<bool>,
    rung: Condvar,
    findings: Mutex<Diagnostics>,
    /// A graph to take part, with the node that stands in it for all others.
    pub(crate) joining: Mutex<Option<(Graph, Node)>>,
    is_closing: AtomicBool,
    is_attached: AtomicBool,
}

impl Shared {
    pub(crate) fn report(&self, finding: Diagnostic) {
        lock(&self.findings).push(finding);
    }

    /// Lets the link look again.
    pub(crate) fn wake(&self) {
        *lock(&self.due) = true;
        self.rung.notify_one();
    }

    /// Sleeps until there is something to look at, at most so long; false when all is over.
    pub(crate) fn sleep(&self, timeout: Duration) -> bool {
        let due = lock(&self.due);
        let waited = self.rung.wait_timeout_while(due, timeout, |due| !*due);
        *waited.unwrap_or_else(PoisonError::into_inner).0 = false;
        !self.is_closing.load(Ordering::Acquire)
    }

    /// Those of others, and how often they changed.
    pub(crate) fn others<T>(&self, look: impl FnOnce(&BTreeMap<String, Token>, u64) -> T) -> T {
        let others = lock(&self.others);
        look(&others.0, others.1)
    }

    /// One came or went.
    fn note(&self, key: &str, is_alive: bool) {
        let Some(token) = Token::read(key) else { return };
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

/// As Zenoh wants it: a file as it is, or the defaults, and single settings on top.
fn configuration(settings: &Settings) -> Result<Config, WireError> {
    let wrong = |what: &str, why: &dyn std::fmt::Display| WireError::Setting {
        what: what.to_owned(),
        why: why.to_string(),
    };
    let mut config = match &settings.file {
        Some(file) => Config::from_file(file)
            .map_err(|why| wrong(&format!("ZENOH_SESSION_CONFIG_URI `{file}`"), &why))?,
        None => Config::from_json5(&settings.config())
            .map_err(|why| wrong("where to connect to and to listen", &why))?,
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

impl Wire {
    /// Joins the network.
    ///
    /// # Errors
    /// When a setting is none, or Zenoh cannot listen where it should.
    pub fn open(settings: &Settings) -> Result<Self, WireError> {
        let network = |error: zenoh::Error| WireError::Network {
            way: settings.way(),
            why: error.to_string(),
        };
        let session = zenoh::open(configuration(settings)?).wait().map_err(network)?;
        let shared = Arc::new(Shared::default());
        if session.info().routers_zid().wait().next().is_none() {
            let message = format!("no router of Zenoh answers, looked for by {}", settings.way());
            shared.report(Diagnostic::warning("zenoh-router", message).help(
                "programs find each other by way of it: `ros2 run rmw_zenoh_cpp rmw_zenohd`; it is \
                 looked for again and again",
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
        let (lane, sending) = Lane::start();
        let link = Link::new(session.clone(), shared.clone(), lane.clone(), settings);
        let thread = std::thread::Builder::new().name("zenoh".to_owned());
        let linking = thread.spawn(move || link.run()).expect("the system gives a thread");
        Ok(Self { shared, session, lane, threads: vec![linking, sending] })
    }

    /// Lets a graph take part, as long as the wire is there: its nodes are seen elsewhere, and what
    /// is elsewhere comes to it. In the graph one node whose name begins with `_wire` stands for
    /// all others.
    ///
    /// # Errors
    /// When the wire has a graph already.
    pub fn attach(&self, graph: &Graph) -> Result<(), WireError> {
        if self.shared.is_attached.swap(true, Ordering::AcqRel) {
            return Err(WireError::Attached);
        }
        let node = stand_in(graph, &self.session.zid().to_le_bytes())?;
        *lock(&self.shared.joining) = Some((graph.clone(), node));
        self.shared.wake();
        Ok(())
    }

    /// Who else is there now, sorted by their keys. Others need a moment to be found: see
    /// [`Wire::wait_for`].
    #[must_use]
    pub fn remote(&self) -> Vec<Token> {
        self.shared.others(|others, _| others.values().cloned().collect())
    }

    /// Waits until the others are as wanted, at most so long; whether they are.
    pub fn wait_for(&self, timeout: Duration, mut wanted: impl FnMut(&[Token]) -> bool) -> bool {
        let others = lock(&self.shared.others);
        let mut seen = None;
        let waited =
            self.shared.changed.wait_timeout_while(others, timeout, |(others, changes)| {
                // Not looked at twice as long as nothing has changed.
                if seen.replace(*changes) == Some(*changes) {
                    return true;
                }
                let others: Vec<Token> = others.values().cloned().collect();
                !wanted(&others)
            });
        !waited.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Waits until everything published so far was handed to the network, at most so long; whether it
    /// was.
    #[must_use]
    pub fn flush(&self, timeout: Duration) -> bool {
        let start = Since::now();
        loop {
            if self.lane.is_idle() {
                return true;
            }
            if start.elapsed() >= timeout {
                return false;
            }
            std::thread::sleep(LOOK_AGAIN);
        }
    }

    /// What was wrong since the last call.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut *lock(&self.shared.findings))
    }
}

impl Drop for Wire {
    fn drop(&mut self) {
        let _ = self.flush(LAST_CHANCE);
        self.shared.is_closing.store(true, Ordering::Release);
        self.shared.wake();
        self.lane.schedule(Job::End);
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
        let _ = self.session.close().wait();
    }
}

impl std::fmt::Debug for Wire {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Wire").field("session", &self.session.zid()).finish_non_exhaustive()
    }
}
