//! `periplus bag play`.

use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_bags::files::{Bag, BagError, PlaySettings, Player};
use periplus_graph::Arguments;
use periplus_os::{Stopwatch, sleep};
use periplus_session::{LiveGraph, stop};

use super::options::{PlayOptions, SelectOptions};
use crate::error::CliError;
use crate::terminal;

/// Longest sleep of the loop, so that Ctrl-C and ENTER are handled within this time.
const POLL_PERIOD: Duration = Duration::from_millis(10);

/// Time that subscribers have to fetch the last messages.
const FLUSH_TIMEOUT: Duration = Duration::from_secs(2);

/// Time for discovery: messages published before are lost to subscribers that have not matched yet.
const DISCOVERY_DELAY: Duration = Duration::from_millis(500);

pub(super) fn run(options: &PlayOptions) -> Result<ExitCode, CliError> {
    let bag = super::open(&options.bag)?;
    let select = options.select();
    if let Some(name) = select.unknown(std::slice::from_ref(&bag)).next() {
        return Err(CliError::usage(format!("the recording has no topic `{name}`")));
    }
    let live = options.network.open(Arguments::default())?;
    let settings = options.settings(&select, &bag);
    let stop = stop::on_signal();
    let player = Player::new(bag, &live.graph, settings);
    let played = player.and_then(|mut player| play(&mut player, &live, options.delay, &stop));
    if !live.end(FLUSH_TIMEOUT) {
        terminal::complain("a subscriber did not acknowledge all messages before the end");
    }
    played?;
    let is_stopped = stop.load(Ordering::Relaxed);
    Ok(if is_stopped { ExitCode::from(terminal::INTERRUPTED) } else { ExitCode::SUCCESS })
}

fn play(
    player: &mut Player,
    live: &LiveGraph,
    delay_ns: i64,
    stop: &Arc<AtomicBool>,
) -> Result<(), BagError> {
    let keys = enter_keys();
    let delay = Duration::from_nanos(delay_ns.unsigned_abs()).max(DISCOVERY_DELAY);
    let watch = Stopwatch::start();
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        if keys.swap(false, Ordering::Relaxed) {
            player.set_paused(!player.is_paused());
            terminal::say(if player.is_paused() { "paused" } else { "resumed" });
        }
        let wall = watch.elapsed();
        let Some(wall) = wall.checked_sub(delay) else {
            sleep(POLL_PERIOD.min(delay - wall));
            continue;
        };
        let wall_ns = i64::try_from(wall.as_nanos()).unwrap_or(i64::MAX);
        let Some(next_ns) = player.advance_to(wall_ns)? else { break };
        let left = Duration::from_nanos(next_ns.saturating_sub(wall_ns).max(0).unsigned_abs());
        sleep(left.min(POLL_PERIOD));
        super::tell(&player.take_findings()).ok();
        live.print_findings();
    }
    super::tell(&player.take_findings()).ok();
    terminal::say(&format!("{} messages", player.published()));
    Ok(())
}

/// Returns a flag that each ENTER sets.
fn enter_keys() -> Arc<AtomicBool> {
    let pressed = Arc::new(AtomicBool::new(false));
    let flag = pressed.clone();
    std::thread::spawn(move || {
        for line in io::stdin().lines() {
            if line.is_err() {
                break;
            }
            flag.store(true, Ordering::Relaxed);
        }
    });
    pressed
}

impl PlayOptions {
    fn select(&self) -> SelectOptions {
        SelectOptions {
            names: self.names.clone(),
            start_offset: self.start_offset,
            duration: self.playback_duration,
            start: None,
            end: self.playback_until_sec,
        }
    }

    fn settings(&self, select: &SelectOptions, bag: &Bag) -> PlaySettings {
        PlaySettings {
            rate: self.rate,
            is_looped: self.is_looped,
            selection: select.of(std::slice::from_ref(bag)),
            remaps: self.remap.clone(),
            clock_hz: self.clock,
            is_paused: self.start_paused,
            read_ahead: self.read_ahead_queue_size,
        }
    }
}
