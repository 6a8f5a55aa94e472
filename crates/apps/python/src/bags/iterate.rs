//! Iteration over messages.

use std::sync::{Arc, Mutex, TryLockError};

use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyInt, PyString, PyTuple};

use super::prefetch::{Batch, Entry, Prefetch};
use super::source::{Source, Wanted};
use crate::messages::{TapeReader, build};
use crate::work::{lock, released};

/// Iterator over the messages of a bag: ``(topic, message, time_ns)``.
///
/// Made by a loop over a :class:`Bag`, or by :meth:`Bag.messages`.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 0)
/// ...     next(periplus.open_bag(f"{folder}/run.mcap").messages(raw=True))
/// ('/chatter', b'\x00\x01\x00\x00\x03\x00\x00\x00hi\x00', 0)
#[pyclass(name = "BagMessages", module = "periplus", frozen)]
pub(crate) struct PyBagMessages {
    source: Arc<Source>,
    state: Mutex<State>,
    names: Vec<Py<PyString>>,
    raw: bool,
    faults: Arc<Mutex<Vec<String>>>,
}

struct State {
    prefetch: Prefetch,
    current: Option<Current>,
}

/// Batch that is being given out.
struct Current {
    entries: std::vec::IntoIter<Entry>,
    tape: TapeReader,
    bytes: Vec<u8>,
    /// Offset of the next raw message.
    at: usize,
}

impl Current {
    fn of(batch: Batch) -> Self {
        Self {
            entries: batch.entries.into_iter(),
            tape: batch.tape.read(),
            bytes: batch.bytes,
            at: 0,
        }
    }
}

impl PyBagMessages {
    pub(super) fn new(
        py: Python<'_>,
        source: Arc<Source>,
        wanted: &Wanted,
        raw: bool,
        faults: Arc<Mutex<Vec<String>>>,
    ) -> PyResult<Self> {
        if !raw {
            for topic in source.topics() {
                if let (Err(why), true) = (&topic.plan, wanted.takes(&topic.topic.name)) {
                    let text = format!(
                        "the messages of `{}` are skipped: {why}; read them with raw=True",
                        topic.topic.name
                    );
                    let text = std::ffi::CString::new(text).unwrap_or_default();
                    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
                }
            }
        }
        let prefetch = Prefetch::start(&source, wanted, raw)?;
        let names = source.topics().iter();
        let names = names.map(|topic| PyString::intern(py, &topic.topic.name).unbind()).collect();
        let state = Mutex::new(State { prefetch, current: None });
        Ok(Self { source, state, names, raw, faults })
    }

    fn advance<'py>(
        &self,
        py: Python<'py>,
        state: &mut State,
    ) -> PyResult<Option<Bound<'py, PyTuple>>> {
        loop {
            if let Some(current) = &mut state.current
                && let Some(entry) = current.entries.next()
            {
                return self.item(py, current, entry).map(Some);
            }
            if let Some(current) = state.current.take() {
                state.prefetch.recycle(current.bytes);
            }
            let batch = state.prefetch.next(py)?;
            if !state.prefetch.faults.is_empty() {
                let mut faults = lock(&self.faults);
                for fault in state.prefetch.faults.drain(..) {
                    if !faults.contains(&fault) {
                        faults.push(fault);
                    }
                }
            }
            let Some(batch) = batch else { return Ok(None) };
            state.current = Some(Current::of(batch));
        }
    }

    fn item<'py>(
        &self,
        py: Python<'py>,
        current: &mut Current,
        entry: Entry,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let message = if self.raw {
            let end = current.at + entry.length;
            let bytes = current.bytes.get(current.at..end).unwrap_or_default();
            current.at = end;
            PyBytes::new(py, bytes).into_any()
        } else {
            match &self.source.topics()[entry.topic].plan {
                Ok((plan, _)) => build(py, plan, &mut current.tape)?,
                Err(_) => py.None().into_bound(py),
            }
        };
        let time = PyInt::new(py, entry.time_ns).into_any();
        PyTuple::new(py, [self.names[entry.topic].bind(py).clone().into_any(), message, time])
    }
}

#[pymethods]
impl PyBagMessages {
    fn __iter__(this: PyRef<'_, Self>) -> PyRef<'_, Self> {
        this
    }

    fn __next__<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyTuple>>> {
        loop {
            // The lock is never waited for with the interpreter: its holder may wait for the interpreter.
            match self.state.try_lock() {
                Ok(mut state) => return self.advance(py, &mut state),
                Err(TryLockError::Poisoned(state)) => {
                    return self.advance(py, &mut state.into_inner());
                }
                Err(TryLockError::WouldBlock) => {
                    released(py, "waiting for a message", || {
                        std::thread::sleep(std::time::Duration::from_micros(100));
                    })?;
                }
            }
        }
    }
}
