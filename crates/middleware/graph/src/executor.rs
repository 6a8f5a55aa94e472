//! Lets time pass in lockstep.

use std::collections::BTreeSet;
use std::sync::TryLockError;

use periplus_diagnostics::Diagnostic;

use crate::agenda::{Key, Rank};
use crate::graph::Core;

/// Most things that may happen without time moving. A thousand robots with a hundred messages each
/// in one step are a tenth of it; a loop gets here in about a second.
pub const MOST_REACTIONS: u64 = 1_000_000;

/// After the bound, so many more are let happen to see who goes in circles.
const LISTED: u64 = 64;

/// Counts what happens at one time.
#[derive(Default)]
pub(crate) struct Turn {
    /// The bound, if it is not [`MOST_REACTIONS`].
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
    let most = turn.most.unwrap_or(MOST_REACTIONS);
    let mut count = 0;
    let mut circle = BTreeSet::new();
    while let Some((key, event)) = core.agenda.next_due(target_ns) {
        if clock.now_ns() < key.time_ns {
            clock.set(key.time_ns);
            count = 0;
            circle.clear();
        }
        count += 1;
        if most < count && key.rank != Rank::Timer {
            circle.insert(format!("`{}` reacts to `{}`", key.node, key.name));
            if most + LISTED < count {
                break_circle(core, &key, &circle);
                continue;
            }
        }
        event.happen(&key);
    }
    clock.set(target_ns);
}

/// Drops everything that is due now, except timers, and says why.
fn break_circle(core: &Core, last: &Key, circle: &BTreeSet<String>) {
    core.agenda.drop_due(last.time_ns);
    let who: Vec<&str> = circle.iter().map(String::as_str).collect();
    let message = format!(
        "at {} s nodes react to each other without end, so what they said was dropped: {}",
        last.time_ns as f64 / 1e9,
        who.join(", ")
    );
    core.common.report(
        Diagnostic::error("endless-reactions", message)
            .help("let one of them publish from a timer, or only when something changed"),
    );
}

fn refuse(core: &Core) {
    let finding = Diagnostic::error(
        "time-moved-twice",
        "somebody lets time pass while it passes already: a callback called `advance_to`, \
         `settle` or `jump_to`, or two threads did",
    );
    core.common.report(finding.help("only one place may move time; callbacks just return"));
}

pub(crate) fn jump(core: &Core, time_ns: i64) {
    let clock = &core.common.clock;
    if let Some(live) = &core.live {
        clock.set(time_ns);
        live.rebase(time_ns);
        return core.common.jumps.tell(time_ns);
    }
    advance(core, clock.now_ns());
    let _turn = match core.turn.try_lock() {
        Ok(turn) => turn,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        Err(TryLockError::WouldBlock) => return,
    };
    clock.set(time_ns);
    core.agenda.rebase(time_ns);
    core.common.jumps.tell(time_ns);
}
