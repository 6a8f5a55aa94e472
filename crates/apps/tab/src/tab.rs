//! A session with one client.

use std::fmt;
use std::time::Duration;

use periplus_os::Stopwatch;
use periplus_session::demo::DemoTask;
use periplus_session::{PageHub, RunError, SimulationSession};
use periplus_sim::{Diverged, RealTimePacer, RecordError, RecordingSummary};
use periplus_web::foxglove::{ClientSession, FrameKind, OutboxItem};

use crate::opened::OpenedSession;
use crate::options::TabOptions;

/// Period of announcements and of the time to the client, as on a server.
const HUB_PERIOD: Duration = Duration::from_millis(20);

/// Wait for requests while the world is paused, at most.
const PAUSED_WAIT: Duration = Duration::from_millis(20);

/// A message to the client.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TabFrame {
    /// JSON.
    Text(Vec<u8>),
    /// A binary message.
    Binary(Vec<u8>),
    /// The client is disconnected, with the reason.
    End(String),
}

/// Reasons that a tab cannot start or continue.
#[derive(Debug)]
pub enum TabError {
    /// The options are not those of a tab.
    Options(serde_json::Error),
    /// The session cannot start.
    Run(RunError),
    /// The client cannot join.
    NoClient,
    /// A body diverged.
    Diverged(Diverged),
    /// The recording is incomplete.
    Recording(RecordError),
    /// A folder cannot be created in memory.
    Folder(std::io::Error),
    /// Options that do not go together, with the reason and what to do.
    Refused(String),
}

impl fmt::Display for TabError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Options(error) => write!(f, "the options are not valid: {error}"),
            Self::Run(error) => error.fmt(f),
            Self::NoClient => f.write_str("the page cannot join its session"),
            Self::Diverged(error) => error.fmt(f),
            Self::Recording(error) => write!(f, "the bag is incomplete: {error}"),
            Self::Folder(error) => write!(f, "the folder of the results: {error}"),
            Self::Refused(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for TabError {}

impl From<RunError> for TabError {
    fn from(error: RunError) -> Self {
        Self::Run(error)
    }
}

/// A session that its caller steps, with one client.
pub struct Tab {
    // Fields are dropped in this order: the client leaves before its hub, and the hub before the graph.
    client: Option<ClientSession>,
    hub: Option<PageHub>,
    task: DemoTask,
    session: SimulationSession,
    pace: RealTimePacer,
    since_hub: Stopwatch,
}

impl Tab {
    /// Starts a session from options in JSON; see [`TabOptions`].
    ///
    /// # Errors
    /// When the options are not valid, or a part cannot start.
    pub fn open_json(options: &[u8]) -> Result<Self, TabError> {
        Self::open(&serde_json::from_slice(options).map_err(TabError::Options)?)
    }

    /// Starts a session.
    ///
    /// # Errors
    /// When a part cannot start.
    pub fn open(options: &TabOptions) -> Result<Self, TabError> {
        let OpenedSession { mut session, task, context } = OpenedSession::open(options)?;
        let hub = context.map(|context| session.open_hub(&context)).transpose()?;
        let client =
            hub.as_ref().map(|hub| hub.hub.join().ok_or(TabError::NoClient)).transpose()?;
        let pace = RealTimePacer::new(session.factor(), session.simulation().time_ns());
        Ok(Self { client, hub, task, session, pace, since_hub: Stopwatch::start() })
    }

    /// Steps at the real-time factor of the world until no step is due or this much wall time has passed, and serves
    /// the requests of the client. Returns the time until the next step is due. Time that was lost, as by a hidden
    /// page, is skipped.
    ///
    /// # Errors
    /// When the motion of a body diverges.
    pub fn run_paced(&mut self, budget: Duration) -> Result<Duration, TabError> {
        let stopwatch = Stopwatch::start();
        loop {
            let before_ns = self.time_ns();
            self.session.serve();
            let time_ns = self.time_ns();
            if let Some(factor) = self.session.take_factor() {
                self.pace = RealTimePacer::new(factor, time_ns);
            }
            let is_paused = self.session.is_paused();
            if is_paused || time_ns < before_ns {
                self.pace.restart(time_ns);
            }
            let wait = if is_paused { Some(PAUSED_WAIT) } else { self.pace.until(time_ns) };
            if wait.is_none() {
                self.step(i64::MAX)?;
            }
            if self.since_hub.elapsed() >= HUB_PERIOD {
                self.since_hub = Stopwatch::start();
                self.spin_hub();
            }
            match wait {
                Some(wait) => return Ok(wait.min(HUB_PERIOD)),
                None if stopwatch.elapsed() >= budget => return Ok(Duration::ZERO),
                None => {}
            }
        }
    }

    fn step(&mut self, end_ns: i64) -> Result<(), TabError> {
        self.session.step_until(end_ns).map_err(TabError::Diverged)?;
        self.task.spin_once(self.session.simulation().time_ns());
        Ok(())
    }

    fn spin_hub(&self) {
        if let Some(hub) = &self.hub {
            hub.hub.spin_once();
        }
    }

    /// Steps until a simulated time, and serves the requests of the client. Only serves while the world is paused, and
    /// ends where a client sets the time back.
    ///
    /// # Errors
    /// When the motion of a body diverges.
    pub fn step_until(&mut self, end_ns: i64) -> Result<(), TabError> {
        let mut reached_ns = self.time_ns();
        self.session.serve();
        while (reached_ns..end_ns).contains(&self.time_ns()) && !self.session.is_paused() {
            reached_ns = self.time_ns();
            self.step(end_ns)?;
        }
        self.spin_hub();
        Ok(())
    }

    /// Simulated time \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.session.simulation().time_ns()
    }

    /// Processes a JSON message of the client; a headless session has none.
    pub fn text(&mut self, text: &str) {
        if let Some(client) = &mut self.client {
            client.text(text);
        }
    }

    /// Processes a binary message of the client; a headless session has none.
    pub fn binary(&mut self, bytes: &[u8]) {
        if let Some(client) = &mut self.client {
            client.binary(bytes);
        }
    }

    /// Takes the next message to the client.
    #[must_use]
    pub fn take(&self) -> Option<TabFrame> {
        match self.client.as_ref()?.outbox().try_take() {
            OutboxItem::Frame(frame) => {
                let bytes = frame.parts().concat();
                Some(if frame.kind() == FrameKind::Text {
                    TabFrame::Text(bytes)
                } else {
                    TabFrame::Binary(bytes)
                })
            }
            OutboxItem::Nothing => None,
            OutboxItem::End(why) => Some(TabFrame::End(why)),
        }
    }

    /// The session.
    pub(crate) fn session(&self) -> &SimulationSession {
        &self.session
    }

    /// Closes the recording, if there is one; its file is complete then.
    ///
    /// # Errors
    /// When the recording is incomplete.
    pub fn close_recording(&mut self) -> Result<Option<RecordingSummary>, TabError> {
        self.session.graph().settle();
        self.session.stop_recording().map_err(TabError::Recording)
    }
}

impl fmt::Debug for Tab {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tab").field("time_ns", &self.time_ns()).finish_non_exhaustive()
    }
}
