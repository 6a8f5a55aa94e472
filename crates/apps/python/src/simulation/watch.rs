//! A watch over callbacks that do not return.

use std::sync::{Arc, Mutex, Weak};
use std::time::Duration;

use periplus::os::{Stopwatch, sleep};
use periplus_session::terminal::warn;

use crate::work::lock;

/// Time after which a callback is named.
const PATIENCE: Duration = Duration::from_secs(5);

/// Polling period.
const PERIOD: Duration = Duration::from_millis(500);

/// Callback that runs at the moment.
struct Current {
    since: Stopwatch,
    name: String,
    is_told: bool,
}

/// Names callbacks that stall a simulation, on stderr.
#[derive(Default)]
pub(crate) struct CallbackWatch(Mutex<Option<Arc<Mutex<Option<Current>>>>>);

impl CallbackWatch {
    /// Runs a callback under the watch. The first call starts the thread that watches.
    pub(crate) fn over<T>(&self, name: &str, run: impl FnOnce() -> T) -> T {
        let slot = lock(&self.0).get_or_insert_with(start).clone();
        let current = Current { since: Stopwatch::start(), name: name.to_owned(), is_told: false };
        let outer = lock(&slot).replace(current);
        let result = run();
        *lock(&slot) = outer;
        result
    }
}

fn start() -> Arc<Mutex<Option<Current>>> {
    let slot = Arc::new(Mutex::new(None));
    let seen = Arc::downgrade(&slot);
    // Without a thread, a slow callback is only not named.
    let _ = std::thread::Builder::new()
        .name("periplus-callback-watch".to_owned())
        .spawn(move || watch(&seen));
    slot
}

fn watch(seen: &Weak<Mutex<Option<Current>>>) {
    while let Some(slot) = seen.upgrade() {
        if let Some(current) = lock(&slot).as_mut()
            && !current.is_told
            && current.since.elapsed() > PATIENCE
        {
            current.is_told = true;
            warn(&format!(
                "{} has not returned for {} s; the simulation waits for it",
                current.name,
                PATIENCE.as_secs()
            ));
        }
        drop(slot);
        sleep(PERIOD);
    }
}
