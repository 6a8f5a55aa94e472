//! Events worth finding: errors, goals, collisions, lost localization.

mod contacts;
mod goals;
mod localization;
mod log;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use periplus_bags::BagTopic;
use periplus_transport::lock;

use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::{self, MarkText, TimeNs};

use contacts::ContactMarks;
use goals::{ActionMarks, GoalMarks};
use localization::LocalizationMarks;
use log::LogMarks;

/// Maximum number of marks; more would hide each other.
const MAX_MARKS: usize = 5_000;

/// Maximum number of warnings among them, which must not displace what is worse.
const MAX_WARNINGS: usize = 3_000;

/// Maximum length of the text of a mark \[bytes\].
const MAX_TEXT_BYTES: usize = 500;

/// Kind of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MarkKind {
    Error,
    Warning,
    Goal,
    GoalReached,
    GoalAborted,
    GoalCanceled,
    Collision,
    LocalizationLost,
    LocalizationFound,
    QosMismatch,
}

impl MarkKind {
    fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Goal => "goal",
            Self::GoalReached => "goalReached",
            Self::GoalAborted => "goalAborted",
            Self::GoalCanceled => "goalCanceled",
            Self::Collision => "collision",
            Self::LocalizationLost => "localizationLost",
            Self::LocalizationFound => "localizationFound",
            Self::QosMismatch => "qosMismatch",
        }
    }
}

/// An event.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mark {
    pub(super) time_ns: i64,
    pub(super) kind: MarkKind,
    pub(super) text: String,
}

impl Mark {
    pub(super) fn new(time_ns: i64, kind: MarkKind, text: impl Into<String>) -> Self {
        Self { time_ns, kind, text: text.into() }
    }
}

/// Finds events in the messages of a topic, which come in the order of time.
pub(super) enum MarkDetector {
    Log(LogMarks),
    Goal(GoalMarks),
    Action(ActionMarks),
    Contact(ContactMarks),
    Localization(LocalizationMarks),
}

impl MarkDetector {
    /// Detector of each topic; none if its messages have no events.
    pub(super) fn of_topics(topics: &[BagTopic]) -> Vec<Option<Self>> {
        let has_status = topics.iter().any(LocalizationMarks::is_status);
        let new = |topic: &BagTopic| {
            if topic.encoding != "cdr" {
                return None;
            }
            None.or_else(|| LogMarks::new(topic).map(Self::Log))
                .or_else(|| GoalMarks::new(topic).map(Self::Goal))
                .or_else(|| ActionMarks::new(topic).map(Self::Action))
                .or_else(|| ContactMarks::new(topic).map(Self::Contact))
                .or_else(|| LocalizationMarks::new(topic, has_status).map(Self::Localization))
        };
        topics.iter().map(new).collect()
    }

    /// Events of a message; messages that cannot be decoded have none.
    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        match self {
            Self::Log(marks) => marks.detect(time_ns, data),
            Self::Goal(marks) => marks.detect(time_ns, data),
            Self::Action(marks) => marks.detect(time_ns, data),
            Self::Contact(marks) => marks.detect(time_ns, data),
            Self::Localization(marks) => marks.detect(time_ns, data),
        }
    }
}

/// A client that waits for more marks.
pub(super) struct MarkWatcher {
    pub(super) request_id: u32,
    pub(super) outbox: Arc<Outbox>,
    pub(super) is_cancelled: Arc<AtomicBool>,
    /// Frees the id of the request; called before the last answer.
    pub(super) done: Box<dyn FnOnce() + Send>,
}

/// Marks of a recording, found in the background.
#[derive(Default)]
pub(super) struct MarkList(Mutex<Marks>);

#[derive(Default)]
struct Marks {
    marks: Vec<MarkText>,
    /// Number of warnings among them.
    warnings: usize,
    is_complete: bool,
    watchers: Vec<MarkWatcher>,
    /// Number of marks that watchers have.
    sent: usize,
}

impl MarkList {
    /// Adds marks; those beyond the limit are dropped.
    pub(super) fn add(&self, topic: &BagTopic, found: Vec<Mark>) {
        let mut list = lock(&self.0);
        for mark in found {
            let is_warning = mark.kind == MarkKind::Warning;
            if list.marks.len() >= MAX_MARKS || (is_warning && list.warnings >= MAX_WARNINGS) {
                continue;
            }
            list.warnings += usize::from(is_warning);
            list.marks.push(text(topic, mark));
        }
    }

    /// Sends new marks to the clients that wait for them.
    pub(super) fn send(&self, is_complete: bool) {
        let mut list = lock(&self.0);
        let is_news = list.sent != list.marks.len() || is_complete;
        list.is_complete = is_complete;
        if is_news {
            list.sent = list.marks.len();
            list.send();
        }
    }

    /// Sends the marks to a client, now and when there are more.
    pub(super) fn watch(&self, watcher: MarkWatcher) {
        let mut list = lock(&self.0);
        let others = std::mem::replace(&mut list.watchers, vec![watcher]);
        list.send();
        list.watchers.extend(others);
    }
}

impl Marks {
    fn send(&mut self) {
        for watcher in std::mem::take(&mut self.watchers) {
            let id = watcher.request_id;
            if watcher.is_cancelled.load(Ordering::Relaxed) {
                (watcher.done)();
                watcher.outbox.push(protocol::fetch_failure(id, "the request was cancelled"));
            } else if self.is_complete {
                (watcher.done)();
                watcher.outbox.push(protocol::marks(id, &self.marks, true));
            } else {
                watcher.outbox.push(protocol::marks(id, &self.marks, false));
                self.watchers.push(watcher);
            }
        }
    }
}

fn text(topic: &BagTopic, mark: Mark) -> MarkText {
    let mut text = mark.text;
    if text.len() > MAX_TEXT_BYTES {
        let mut end = MAX_TEXT_BYTES;
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        text.truncate(end);
        text.push('…');
    }
    MarkText {
        time_ns: TimeNs(mark.time_ns),
        kind: mark.kind.name(),
        topic: topic.name.clone(),
        text,
    }
}
