//! This process and its threads.
#![allow(
    clippy::disallowed_methods,
    reason = "the edge through which all other code starts threads"
)]

use std::io;

/// Number of this process, for names of temporary files. In WebAssembly there is one process.
#[must_use]
pub fn process_id() -> u32 {
    if cfg!(target_family = "wasm") { 1 } else { std::process::id() }
}

/// Number of threads that can run in parallel.
#[must_use]
pub fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs work on a separate thread, which is not joined. WebAssembly has no threads: there the work is done
/// when this returns, so that it must not wait for later calls.
///
/// # Errors
/// When the system starts no thread.
pub fn start_thread(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    if cfg!(target_family = "wasm") {
        work();
        return Ok(());
    }
    std::thread::Builder::new().name(name.to_owned()).spawn(work).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_done_on_a_thread_of_this_name() {
        let (give, take) = std::sync::mpsc::channel();
        let work = move || give.send(std::thread::current().name().map(str::to_owned)).unwrap();
        start_thread("worker", work).unwrap();
        assert_eq!(take.recv().unwrap().as_deref(), Some("worker"));
        assert!(processors() >= 1 && process_id() >= 1);
    }
}
