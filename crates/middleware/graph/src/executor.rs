//! Advances time in lockstep.

use std::collections::BTreeSet;
use std::sync::TryLockError;

use periplus_diagnostics::Diagnostic;

use crate::event_queue::{Key, Rank};
use crate::graph::Core;

/// Maximum number of events without progress of time. A thousand robots with a hundred messages
/// each per step need a tenth of it; an endless loop reaches it in about a second.
pub const MAX_REACTIONS: u64 = 1_000_000;

/// Number of events executed after the limit to list the nodes in the loop.
const LISTED_REACTIONS: u64 = 64;

/// Counts the events at one time.
#[derive(Default)]
pub(crate) struct Turn {
    /// The limit, if it is not [`MAX_REACTIONS`].
    pub(crate) most: Option<u64>,
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
    let most = turn.most.unwrap_or(MAX_REACTIONS);
    let mut count = 0;
    let mut cycle = BTreeSet::new();
    while let Some((key, event)) = core.event_queue.next_due(target_ns) {
        if clock.now_ns() < key.time_ns {
            clock.set(key.time_ns);
            count = 0;
            cycle.clear();
        }
        count += 1;
        if most < count && key.rank != Rank::Timer {
            cycle.insert(format!("`{}` reacts to `{}`", key.node, key.name));
            if most + LISTED_REACTIONS < count {
                break_cycle(core, &key, &cycle);
                continue;
            }
        }
        event.happen(&key);
    }
    clock.set(target_ns);
}

/// Drops everything that is due now, except timers, and reports the loop.
fn break_cycle(core: &Core, last: &Key, cycle: &BTreeSet<String>) {
    core.event_queue.drop_due(last.time_ns);
    let who: Vec<&str> = cycle.iter().map(String::as_str).collect();
    let message = format!(
        "at {} s nodes react to each other in an endless loop; their messages were dropped: {}",
        last.time_ns as f64 / 1e9,
        who.join(", ")
    );
    core.common.report(
        Diagnostic::error("endless-reactions", message)
            .help("make one of them publish from a timer, or only on change"),
    );
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
    core.common.jumps.notify(time_ns);
}
