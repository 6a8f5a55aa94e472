//! Values that one call at a time works with, in slices or on a separate thread, so that Ctrl-C works.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::errors::runtime_error;
use crate::work::{lock, released};

/// Time between two checks for Ctrl-C.
const POLL_PERIOD: Duration = Duration::from_millis(10);

/// Stack of a thread: that of the main thread of a program.
const STACK_BYTES: usize = 8 << 20;

/// Makes the value again that a cancelled call works with.
pub(crate) type Restore<T> = Box<dyn FnOnce() -> Option<T> + Send>;

/// A value with which one call at a time works. It is away while a call on another thread has it.
pub(crate) struct SharedState<T>(Arc<Mutex<Option<T>>>);

impl<T: Send + 'static> SharedState<T> {
    pub(crate) fn new(value: T) -> Self {
        Self(Arc::new(Mutex::new(Some(value))))
    }

    /// Works with the value without the interpreter. Waits while another call has it; Ctrl-C ends the wait.
    pub(crate) fn with<R: Send>(
        &self,
        py: Python<'_>,
        what: &str,
        work: impl FnOnce(&mut T) -> R + Send,
    ) -> PyResult<R> {
        let mut work = Some(work);
        loop {
            let done = released(py, what, || {
                let mut slot = lock(&self.0);
                let value = slot.as_mut()?;
                work.take().map(|work| work(value))
            })?;
            if let Some(done) = done {
                return Ok(done);
            }
            py.detach(|| thread::sleep(POLL_PERIOD));
            py.check_signals()?;
        }
    }

    /// Works with the value on another thread, so that Ctrl-C raises `KeyboardInterrupt` at once. The thread then
    /// goes on to its end, and its result is dropped. `backup` makes what restores the value as it was; without it
    /// the value is away until the thread ends, and is then as the finished work leaves it.
    pub(crate) fn interruptible<R: Send + 'static>(
        &self,
        py: Python<'_>,
        what: &'static str,
        backup: impl FnOnce(&T) -> Option<Restore<T>> + Send,
        work: impl FnOnce(&mut T) -> R + Send + 'static,
    ) -> PyResult<R> {
        let (value, restore) = self.take(py, what, backup)?;
        // Taken by the thread, or back if there is none.
        let handover = Arc::new(Mutex::new(Some(value)));
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (sender, receiver) = mpsc::channel();
        let receiver = Mutex::new(receiver);
        let (slot, cancelled) = (Arc::clone(&self.0), Arc::clone(&is_cancelled));
        let taken = Arc::clone(&handover);
        let job = move || {
            let Some(mut value) = lock(&taken).take() else { return };
            let result = catch_unwind(AssertUnwindSafe(|| work(&mut value)));
            let mut slot = lock(&slot);
            if !cancelled.load(Ordering::Relaxed) {
                *slot = Some(value);
            }
            drop(slot);
            // No call receives it after Ctrl-C.
            let _ = sender.send(result);
        };
        let thread = thread::Builder::new().name(what.to_owned()).stack_size(STACK_BYTES);
        if let Err(error) = thread.spawn(job) {
            *lock(&self.0) = lock(&handover).take();
            return Err(runtime_error(format!("{what}: {error}")));
        }
        loop {
            let received = py.detach(|| lock(&receiver).recv_timeout(POLL_PERIOD));
            match received {
                Ok(Ok(result)) => return Ok(result),
                // The panic goes on here, and becomes an exception.
                Ok(Err(panic)) => {
                    return released(py, what, || std::panic::resume_unwind(panic));
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(runtime_error(format!("{what}: its thread has ended")));
                }
            }
            if let Err(interrupt) = py.check_signals() {
                if let Some(restore) = restore {
                    let restored = released(py, what, restore)?;
                    let mut slot = lock(&self.0);
                    if slot.is_none() && restored.is_some() {
                        is_cancelled.store(true, Ordering::Relaxed);
                        *slot = restored;
                    }
                }
                return Err(interrupt);
            }
        }
    }

    /// Takes the value away.
    fn take(
        &self,
        py: Python<'_>,
        what: &str,
        backup: impl FnOnce(&T) -> Option<Restore<T>> + Send,
    ) -> PyResult<(T, Option<Restore<T>>)> {
        let mut backup = Some(backup);
        loop {
            let taken = released(py, what, || {
                let mut slot = lock(&self.0);
                let restore =
                    backup.take_if(|_| slot.is_some()).and_then(|make| make(slot.as_ref()?));
                Some((slot.take()?, restore))
            })?;
            if let Some(taken) = taken {
                return Ok(taken);
            }
            py.detach(|| thread::sleep(POLL_PERIOD));
            py.check_signals()?;
        }
    }
}
