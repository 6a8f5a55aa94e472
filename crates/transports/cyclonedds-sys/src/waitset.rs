//! Waitsets.

use std::sync::Arc;

use crate::discovery::Discovery;
use crate::error::check;
use crate::participant::{Entity, Participant};
use crate::reader::DataReader;
use crate::writer::DataWriter;
use crate::{Error, ffi};

/// Events of `shim.h`.
const GUARD: i32 = 0;
const DATA: i32 = 1;
const MATCHED: i32 = 2;

/// Maximum number of events per call; further events are reported by the next call.
const ROOM: usize = 256;

/// Identifies a watched entity in the result of [`Waitset::wait`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct WaitToken(i32);

/// Lets a thread sleep until one of the watched entities has an event. Each event is reported once,
/// handled or not, so that an unhandled event never keeps the thread awake. Take all samples of a
/// reader when its token is reported.
pub struct Waitset {
    waitset: Entity,
    guard: Arc<Entity>,
    participant: Participant,
}

/// Wakes the thread of a [`Waitset`] from another thread.
#[derive(Clone)]
pub struct Waker {
    guard: Arc<Entity>,
    _participant: Participant,
}

impl Waker {
    /// Wakes the thread.
    pub fn wake(&self) {
        // SAFETY: a number.
        let _ = unsafe { ffi::pp_guard_set(self.guard.0, 1) };
    }
}

impl Waitset {
    pub(crate) fn new(participant: Participant) -> Result<Self, Error> {
        let what = || "create a waitset".to_owned();
        let of = participant.0.entity;
        // SAFETY: numbers.
        let waitset = Entity(check(unsafe { ffi::pp_waitset(of) }, what)?);
        // SAFETY: numbers.
        let guard = Arc::new(Entity(check(unsafe { ffi::pp_guard(of) }, what)?));
        // SAFETY: numbers.
        check(unsafe { ffi::pp_watch(waitset.0, guard.0, GUARD) }, what)?;
        Ok(Self { waitset, guard, participant })
    }

    /// Creates a handle that wakes this waitset.
    #[must_use]
    pub fn waker(&self) -> Waker {
        Waker { guard: self.guard.clone(), _participant: self.participant.clone() }
    }

    fn watch(&self, entity: i32, event: i32) -> Result<WaitToken, Error> {
        // SAFETY: numbers.
        let code = unsafe { ffi::pp_watch(self.waitset.0, entity, event) };
        check(code, || "watch an entity".to_owned()).map(|_| WaitToken(entity))
    }

    /// Watches a reader for samples, until the reader is dropped.
    ///
    /// # Errors
    /// When it is watched already.
    pub fn watch_reader(&self, reader: &DataReader) -> Result<WaitToken, Error> {
        self.watch(reader.entity(), DATA)
    }

    /// Watches a writer for matched and unmatched readers; [`DataWriter::readers`] returns their
    /// number.
    ///
    /// # Errors
    /// When it is watched already.
    pub fn watch_writer(&self, writer: &DataWriter) -> Result<WaitToken, Error> {
        self.watch(writer.entity(), MATCHED)
    }

    /// Watches a discovery reader for samples.
    ///
    /// # Errors
    /// When it is watched already.
    pub fn watch_discovery(&self, discovery: &Discovery) -> Result<WaitToken, Error> {
        self.watch(discovery.entity(), DATA)
    }

    /// Waits at most for the timeout and returns the tokens of entities with events; none when it
    /// was woken or timed out.
    ///
    /// # Errors
    /// When memory is exhausted.
    pub fn wait(&self, timeout_ns: i64) -> Result<Vec<WaitToken>, Error> {
        let mut entities = [0_isize; ROOM];
        // SAFETY: the buffer has this size.
        let code =
            unsafe { ffi::pp_wait(self.waitset.0, entities.as_mut_ptr(), ROOM, timeout_ns.max(0)) };
        let count = check(code, || "wait".to_owned())?;
        let count = usize::try_from(count).unwrap_or(0).min(ROOM);
        let entities = entities[..count].iter().filter_map(|one| i32::try_from(*one).ok());
        let mut tokens = Vec::with_capacity(count);
        for entity in entities {
            if entity == self.guard.0 {
                // SAFETY: a number.
                let _ = unsafe { ffi::pp_guard_set(self.guard.0, 0) };
            } else {
                tokens.push(WaitToken(entity));
            }
        }
        Ok(tokens)
    }
}
