//! Advances time in lockstep.

use std::collections::BTreeSet;
use std::sync::{Arc, TryLockError};

use periplus_diagnostics::Diagnostic;

use crate::common::Common;
use crate::event_queue::{EventQueue, Rank};
use crate::graph::Core;
use crate::parallel::{ParallelNamespace, Workers};

/// Maximum number of events without progress of time. A thousand robots with a hundred messages
/// each per step need a tenth of it; an endless loop reaches it in about a second.
pub const MAX_REACTIONS: u64 = 1_000_000;

/// Number of events executed after the limit to list the nodes in the loop.
const LISTED_REACTIONS: u64 = 64;

/// Settings of execution.
#[derive(Default)]
pub(crate) struct Turn {
    /// The limit, if it is not [`MAX_REACTIONS`].
    pub(crate) most: Option<u64>,
    /// Threads that run namespaces beside the one that advances time.
    pub(crate) workers: Workers,
}

/// Counts the events at one time, and ends endless loops.
#[derive(Default)]
pub(crate) struct Reactions {
    time_ns: i64,
    count: u64,
    cycle: BTreeSet<String>,
}

impl Reactions {
    /// Executes everything that is due in a queue.
    pub(crate) fn run_due(&mut self, event_queue: &EventQueue, common: &Common, limit: u64) {
        let now_ns = common.clock.now_ns();
        if self.time_ns != now_ns {
            *self = Self { time_ns: now_ns, ..Self::default() };
        }
        while let Some((key, event)) = event_queue.next_due(now_ns) {
            self.count += 1;
            if limit < self.count && key.rank != Rank::Timer {
                self.cycle.insert(format!("`{}` reacts to `{}`", key.node, key.name));
                if limit + LISTED_REACTIONS < self.count {
                    event_queue.drop_due(now_ns);
                    common.report(self.endless());
                    continue;
                }
            }
            event.happen(&key);
        }
    }

    /// The report of a loop whose messages were dropped.
    fn endless(&self) -> Diagnostic {
        let who: Vec<&str> = self.cycle.iter().map(String::as_str).collect();
        let message = format!(
            "at {} s nodes react to each other in an endless loop; their messages were dropped: {}",
            self.time_ns as f64 / 1e9,
            who.join(", ")
        );
        Diagnostic::error("endless-reactions", message)
            .help("make one of them publish from a timer, or only on change")
    }
}

pub(crate) fn advance(core: &Core, time_ns: i64) {
    let clock = &core.common.clock;
    if time_ns < clock.now_ns() && !clock.is_paused() {
        return jump(core, time_ns);
    }
    if let Some(live) = &core.live {
        if !clock.is_paused() {
            clock.set(time_ns);
        }
        return live.advance_to(clock.now_ns());
    }
    let turn = match core.turn.try_lock() {
        Ok(turn) => turn,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        Err(TryLockError::WouldBlock) => return refuse(core),
    };
    let target_ns = if clock.is_paused() { clock.now_ns() } else { time_ns };
    let limit = turn.most.unwrap_or(MAX_REACTIONS);
    let namespaces = core.namespaces();
    let mut reactions = Reactions::default();
    while let Some(first_ns) = core.first_ns(&namespaces).filter(|first_ns| *first_ns <= target_ns)
    {
        clock.set(clock.now_ns().max(first_ns));
        reactions.run_due(&core.event_queue, &core.common, limit);
        let now_ns = clock.now_ns();
        let is_due = |it: &&Arc<ParallelNamespace>| it.event_queue.is_due(now_ns);
        let due: Vec<_> = namespaces.iter().filter(is_due).cloned().collect();
        if !due.is_empty() {
            turn.workers.run(&due, &core.common, limit);
            due.iter().for_each(|it| it.finish(&core.common));
        }
    }
    clock.set(target_ns);
}

fn refuse(core: &Core) {
    let finding = Diagnostic::error(
        "time-moved-twice",
        "time is advanced while it is already advancing: a callback called `advance_to`, \
         `settle` or `jump_to`, or two threads did",
    );
    core.common
        .report(finding.help("advance time from one thread only, and never from a callback"));
}

pub(crate) fn jump(core: &Core, time_ns: i64) {
    let clock = &core.common.clock;
    if let Some(live) = &core.live {
        clock.set(time_ns);
        live.rebase(time_ns);
        return core.common.jumps.notify(time_ns);
    }
    advance(core, clock.now_ns());
    let _turn = match core.turn.try_lock() {
        Ok(turn) => turn,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        Err(TryLockError::WouldBlock) => return,
    };
    clock.set(time_ns);
    core.event_queue.rebase(time_ns);
    for namespace in &*core.namespaces() {
        namespace.event_queue.rebase(time_ns);
    }
    core.common.jumps.notify(time_ns);
}
