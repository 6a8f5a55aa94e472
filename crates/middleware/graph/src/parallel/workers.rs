//! Threads that run namespaces.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use super::ParallelNamespace;
use crate::common::{Common, lock};
use crate::live;

/// Threads that wait for rounds of namespaces to run. The thread that advances time helps them.
#[derive(Default)]
pub(crate) struct Workers {
    shared: Arc<Shared>,
    threads: usize,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    /// A round starts, or the threads have to end.
    started: Condvar,
}

#[derive(Default)]
struct State {
    /// Number of the last round.
    number: u64,
    round: Option<Arc<Round>>,
    is_closed: bool,
}

/// Namespaces to run once each.
struct Round {
    namespaces: Vec<Arc<ParallelNamespace>>,
    common: Arc<Common>,
    limit: u64,
    next: AtomicUsize,
    progress: Mutex<Progress>,
    ended: Condvar,
}

#[derive(Default)]
struct Progress {
    done: usize,
    panic: Option<Box<dyn Any + Send>>,
}

impl Round {
    /// Runs namespaces until none is left.
    fn help(&self) {
        while let Some(namespace) = self.namespaces.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            let run = AssertUnwindSafe(|| namespace.run(&self.common, self.limit));
            let outcome = catch_unwind(run);
            let mut progress = lock(&self.progress);
            progress.done += 1;
            if let Err(panic) = outcome {
                progress.panic.get_or_insert(panic);
            }
            if progress.done == self.namespaces.len() {
                self.ended.notify_all();
            }
        }
    }

    /// Waits until all have run; panics as one of them did.
    fn wait(&self) {
        let mut progress = lock(&self.progress);
        while progress.done < self.namespaces.len() {
            progress = self.ended.wait(progress).unwrap_or_else(PoisonError::into_inner);
        }
        if let Some(panic) = progress.panic.take() {
            drop(progress);
            resume_unwind(panic);
        }
    }
}

impl Workers {
    /// Starts this number of threads. They end when this is dropped.
    pub(crate) fn new(threads: usize) -> Self {
        let shared = Arc::<Shared>::default();
        for index in 1..=threads {
            let shared = shared.clone();
            live::spawn(&format!("namespaces {index}"), move || shared.serve());
        }
        Self { shared, threads }
    }

    /// Number of the threads.
    pub(crate) fn threads(&self) -> usize {
        self.threads
    }

    /// Runs each of these namespaces until nothing of it is due.
    pub(crate) fn run(
        &self,
        namespaces: &[Arc<ParallelNamespace>],
        common: &Arc<Common>,
        limit: u64,
    ) {
        let is_alone = namespaces.len() == 1 || self.threads == 0;
        let round = Arc::new(Round {
            namespaces: namespaces.to_vec(),
            common: common.clone(),
            limit,
            next: AtomicUsize::new(0),
            progress: Mutex::default(),
            ended: Condvar::new(),
        });
        if !is_alone {
            let mut state = lock(&self.shared.state);
            state.number += 1;
            state.round = Some(round.clone());
            drop(state);
            self.shared.started.notify_all();
        }
        round.help();
        round.wait();
        if !is_alone {
            lock(&self.shared.state).round = None;
        }
    }
}

impl Shared {
    /// Helps in every round until the threads have to end.
    fn serve(&self) {
        let mut last = 0;
        let mut state = lock(&self.state);
        while !state.is_closed {
            if state.number == last {
                state = self.started.wait(state).unwrap_or_else(PoisonError::into_inner);
                continue;
            }
            last = state.number;
            let round = state.round.clone();
            drop(state);
            if let Some(round) = round {
                round.help();
            }
            state = lock(&self.state);
        }
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        lock(&self.shared.state).is_closed = true;
        self.shared.started.notify_all();
    }
}
