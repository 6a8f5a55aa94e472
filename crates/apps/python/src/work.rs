//! Work of the crates without the interpreter: released, protected from panics.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;

use crate::errors::runtime_error;

/// Runs `work` while other threads of Python run. A panic, which is a fault of Periplus, is a `RuntimeError` that
/// names `what`.
pub(crate) fn released<T: Send>(
    py: Python<'_>,
    what: &str,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work))).map_err(|panic| panicked(what, &*panic))
}

/// Runs short work with the interpreter held; a panic is a `RuntimeError` that names `what`.
pub(crate) fn guarded<T>(what: &str, work: impl FnOnce() -> T) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| panicked(what, &*panic))
}

fn panicked(what: &str, panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    runtime_error(format!("{what} failed, which is a fault of Periplus: {text}"))
}

/// Locks a mutex, also after a panic.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Locks a mutex and works with its value, without the interpreter: another thread of Python may hold the lock.
pub(crate) fn with_locked<T: Send, R: Send>(
    py: Python<'_>,
    what: &str,
    mutex: &Mutex<T>,
    work: impl FnOnce(&mut T) -> R + Send,
) -> PyResult<R> {
    released(py, what, || work(&mut lock(mutex)))
}

thread_local! {
    /// True while this thread runs code of a plugin.
    static IN_PLUGIN: Cell<bool> = const { Cell::new(false) };
}

/// Runs code of a plugin, which a locked simulation calls.
pub(crate) fn in_plugin<T>(work: impl FnOnce() -> T) -> T {
    /// Restores the mark, also after a panic.
    struct Outer(bool);
    impl Drop for Outer {
        fn drop(&mut self) {
            IN_PLUGIN.set(self.0);
        }
    }
    let _outer = Outer(IN_PLUGIN.replace(true));
    work()
}

/// Returns true within [`in_plugin`].
pub(crate) fn is_in_plugin() -> bool {
    IN_PLUGIN.get()
}
