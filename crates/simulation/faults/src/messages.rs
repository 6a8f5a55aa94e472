//! Faults of messages between publishers and subscribers.

mod readings;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Stream;
use periplus_graph::{InterceptedMessage, Interceptor, TopicInfo};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_sim::{OpticalSurface, Simulation};

use crate::kinds::FaultKind;
use crate::models::{ChannelState, GyroBias, delay_s, is_burst, reported_range_m};
use crate::read::InjectedFault;
use readings::{
    Unchanged, decoded, with_content_of, with_readings, with_sector, with_shifted_stamp,
};

/// Maximum number of messages that are held back on all topics; more are delivered at once.
const MAX_HELD_COUNT: usize = 100_000;

/// Interceptor of the messages that faults change, hold back or drop.
pub(crate) struct MessageFaults {
    state: Mutex<State>,
}

struct State {
    seed: u64,
    now_ns: i64,
    faults: Vec<RunningFault>,
    /// Messages to deliver, by time \[ns\] and number.
    held: BTreeMap<(i64, u64), HeldMessage>,
    held_count: u64,
    /// Latest delivery of each topic with latency \[ns\].
    latest_ns: BTreeMap<String, i64>,
    findings: Diagnostics,
}

/// A fault of messages with its state.
struct RunningFault {
    fault: InjectedFault,
    topic: String,
    /// Name of its random streams.
    stream: String,
    memory: Memory,
    /// Time of the last message \[ns\], and the number of messages before it at this time.
    last: (i64, u64),
    /// Types that it does not change, as reported.
    reported: BTreeSet<String>,
    has_seen_any: bool,
}

/// Memory of a fault of earlier messages.
enum Memory {
    Nothing,
    Channel(ChannelState),
    Gyro(GyroBias),
    First(Option<Vec<u8>>),
}

/// A message that waits, and the models whose surfaces are optical for it.
struct HeldMessage {
    message: InterceptedMessage,
    optics: Vec<(String, OpticalSurface)>,
}

/// Effect of a fault on a message.
enum Effect {
    Drop,
    Change(InterceptedMessage),
    Delay(i64),
    DelayInOrder(i64),
    Repeat,
    Optics(String, OpticalSurface),
    Nothing,
}

impl MessageFaults {
    pub(crate) fn new(seed: u64) -> Self {
        let state = State {
            seed,
            now_ns: 0,
            faults: Vec::new(),
            held: BTreeMap::new(),
            held_count: 0,
            latest_ns: BTreeMap::new(),
            findings: Diagnostics::new(),
        };
        Self { state: Mutex::new(state) }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a fault of messages; `number` is its number among all faults.
    pub(crate) fn add(&self, number: usize, fault: &InjectedFault) {
        let Some(topic) = fault.kind.topic() else { return };
        let topic = format!("/{}", topic.trim_start_matches('/'));
        let memory = match fault.kind {
            FaultKind::PacketLoss(_) => Memory::Channel(ChannelState::default()),
            FaultKind::GyroDrift(_) => Memory::Gyro(GyroBias::default()),
            FaultKind::StuckReadings(_) => Memory::First(None),
            _ => Memory::Nothing,
        };
        self.lock().faults.push(RunningFault {
            fault: fault.clone(),
            stream: format!("fault {number}: {} {topic}", fault.kind.word()),
            topic,
            memory,
            last: (i64::MIN, 0),
            reported: BTreeSet::new(),
            has_seen_any: false,
        });
    }

    /// Sets the time \[ns\] and delivers the messages that are due.
    pub(crate) fn release(&self, simulation: &mut Simulation) {
        let now_ns = simulation.time_ns();
        let mut state = self.lock();
        if now_ns < state.now_ns {
            // The clock was set back: what was held belongs to another run.
            state.held.clear();
            state.latest_ns.clear();
        }
        state.now_ns = now_ns;
        loop {
            let Some(entry) = state.held.first_entry() else { return };
            if entry.key().0 > now_ns {
                return;
            }
            let HeldMessage { message, optics } = entry.remove();
            // A delivery may run callbacks that publish.
            drop(state);
            through_optics(simulation, &message, &optics).unwrap_or(message).forward();
            state = self.lock();
        }
    }

    /// Returns and clears the findings; at the end of a run also faults whose topic had no messages.
    pub(crate) fn take_findings(&self, is_end: bool) -> Diagnostics {
        let mut state = self.lock();
        let mut findings = std::mem::take(&mut state.findings);
        let now_s = state.now_ns as f64 * 1e-9;
        for running in state.faults.iter().filter(|it| is_end && !it.has_seen_any) {
            if running.fault.from_s <= now_s {
                findings.push(
                    Diagnostic::warning(
                        "fault-without-messages",
                        format!("no message of `{}` reached the fault", running.topic),
                    )
                    .at(running.fault.origin)
                    .help("check the name of the topic, and that something subscribes to it"),
                );
            }
        }
        findings
    }
}

impl Interceptor for MessageFaults {
    fn wants(&self, topic: &TopicInfo) -> bool {
        self.lock().faults.iter().any(|running| running.topic == topic.name)
    }

    fn intercept(&self, message: InterceptedMessage) {
        let deliveries = self.lock().process(message);
        deliveries.iter().for_each(InterceptedMessage::forward);
    }
}

impl State {
    /// Applies the faults in their order. Returns the messages that are delivered now.
    fn process(&mut self, mut message: InterceptedMessage) -> Vec<InterceptedMessage> {
        let (now_ns, seed) = (self.now_ns, self.seed);
        let now_s = now_ns as f64 * 1e-9;
        let topic = message.topic().to_owned();
        let (mut due_ns, mut count, mut optics, mut in_order) = (now_ns, 1, Vec::new(), false);
        for running in self.faults.iter_mut().filter(|running| running.topic == topic) {
            if !running.fault.is_active_at(now_s) {
                if let Memory::First(first) = &mut running.memory {
                    *first = None;
                }
                continue;
            }
            running.has_seen_any = true;
            match running.effect(&message, now_ns, seed, &mut self.findings) {
                Effect::Drop => return Vec::new(),
                Effect::Change(changed) => message = changed,
                Effect::Delay(delay_ns) => due_ns += delay_ns,
                Effect::DelayInOrder(delay_ns) => {
                    due_ns += delay_ns;
                    in_order = true;
                }
                Effect::Repeat => count += 1,
                Effect::Optics(model, surface) => optics.push((model, surface)),
                Effect::Nothing => {}
            }
        }
        // Messages behind late ones wait for them.
        let latest_ns = self.latest_ns.get(&topic).copied().unwrap_or(now_ns);
        if in_order || due_ns == now_ns {
            due_ns = due_ns.max(latest_ns);
        }
        if in_order {
            self.latest_ns.insert(topic, due_ns);
        }
        if (due_ns <= now_ns && optics.is_empty()) || self.held.len() >= MAX_HELD_COUNT {
            return vec![message; count];
        }
        for _ in 0..count {
            self.held_count += 1;
            let held = HeldMessage { message: message.clone(), optics: optics.clone() };
            self.held.insert((due_ns, self.held_count), held);
        }
        Vec::new()
    }
}

impl RunningFault {
    fn effect(
        &mut self,
        message: &InterceptedMessage,
        now_ns: i64,
        seed: u64,
        findings: &mut Diagnostics,
    ) -> Effect {
        let mut stream = self.next_stream(now_ns, seed);
        let since_s = now_ns as f64 * 1e-9 - self.fault.from_s;
        let changed = match (&self.fault.kind, &mut self.memory) {
            (FaultKind::Dropout(it), _) => {
                return if stream.unit() < it.probability { Effect::Drop } else { Effect::Nothing };
            }
            (FaultKind::PacketLoss(it), Memory::Channel(state)) => {
                let is_lost;
                (*state, is_lost) = state.next(it, &mut stream);
                return if is_lost { Effect::Drop } else { Effect::Nothing };
            }
            (FaultKind::Latency(it), _) => {
                return Effect::DelayInOrder(ns(delay_s(it.mean_s, it.jitter_s, &mut stream)));
            }
            (FaultKind::Duplicate(it), _) => {
                return if stream.unit() < it.probability {
                    Effect::Repeat
                } else {
                    Effect::Nothing
                };
            }
            (FaultKind::Reorder(it), _) => {
                let is_held = stream.unit() < it.probability;
                return if is_held { Effect::Delay(ns(it.delay_s)) } else { Effect::Nothing };
            }
            (FaultKind::Glass(it), _) => {
                return Effect::Optics(it.model.clone(), OpticalSurface::Glass);
            }
            (FaultKind::Mirror(it), _) => {
                return Effect::Optics(it.model.clone(), OpticalSurface::Mirror);
            }
            (FaultKind::ClockJump(it), _) => with_shifted_stamp(message, ns(it.offset_s)),
            (FaultKind::Bias(it), _) => {
                with_readings(message, &mut |reading| reading * it.scale_factor + it.offset)
            }
            (FaultKind::Noise(it), _) if is_burst(it, since_s, seed, &self.stream) => {
                with_readings(message, &mut |reading| reading + it.stddev * stream.normal())
            }
            (FaultKind::StuckReadings(_), Memory::First(Some(first))) => {
                with_content_of(message, first)
            }
            (FaultKind::StuckReadings(_), Memory::First(first)) => {
                *first = message.cdr().ok().map(<[u8]>::to_vec);
                return Effect::Nothing;
            }
            (FaultKind::BlockedSector(it), _) => {
                let sector = [it.min_angle_rad, it.max_angle_rad];
                with_sector(message, sector, it.range_m.unwrap_or(f64::INFINITY))
            }
            (FaultKind::GyroDrift(it), Memory::Gyro(bias)) => {
                let bias_rad_s = bias.update(it, since_s, &mut stream);
                with_readings(message, &mut |reading| reading + bias_rad_s)
            }
            _ => return Effect::Nothing,
        };
        match changed {
            Ok(message) => Effect::Change(message),
            Err(reason) => {
                self.report(message.type_name(), reason, findings);
                Effect::Nothing
            }
        }
    }

    /// Stream of the next message: of its time, and its number among those at this time.
    fn next_stream(&mut self, now_ns: i64, seed: u64) -> Stream {
        let (last_ns, number) = self.last;
        self.last = if last_ns == now_ns { (now_ns, number + 1) } else { (now_ns, 0) };
        let name = format!("{} {}", self.stream, self.last.1);
        Stream::keyed(seed, &name, now_ns.unsigned_abs())
    }

    fn report(&mut self, type_name: &str, reason: Unchanged, findings: &mut Diagnostics) {
        if !self.reported.insert(type_name.to_owned()) {
            return;
        }
        let (topic, word) = (&self.topic, self.fault.kind.word());
        let message = match reason {
            Unchanged::Type => {
                format!("`{word}` does not change `{topic}`: {type_name} has no such reading")
            }
            Unchanged::Content => {
                format!("`{word}` does not change a message of `{topic}`: it cannot be decoded")
            }
        };
        findings.push(
            Diagnostic::warning("fault-without-effect", message)
                .at(self.fault.origin)
                .help("`docs/faults.md` lists the types of messages that each fault changes"),
        );
    }
}

/// Nanoseconds of a time \[s\].
fn ns(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// Returns a scan as the lidar measures it with glass and mirrors; `None` if nothing changes. Each range keeps its
/// noise: it changes by the difference of the exact ranges.
fn through_optics(
    simulation: &mut Simulation,
    message: &InterceptedMessage,
    optics: &[(String, OpticalSurface)],
) -> Option<InterceptedMessage> {
    if optics.is_empty() {
        return None;
    }
    let mut scan = decoded::<LaserScan>(message).ok()?;
    let (first_rad, step_rad) = (f64::from(scan.angle_min), f64::from(scan.angle_increment));
    let angle_rad = |index: usize| first_rad + step_rad * index as f64;
    let angles_rad: Vec<f64> = (0..scan.ranges.len()).map(angle_rad).collect();
    let surface = |model: &str| {
        let found = optics.iter().find(|(name, _)| name == model);
        found.map_or(OpticalSurface::Diffuse, |(_, surface)| *surface)
    };
    let exact = simulation.optical_ranges(message.topic(), &angles_rad, &surface);
    let (min_m, max_m) = (f64::from(scan.range_min), f64::from(scan.range_max));
    for (range, exact) in scan.ranges.iter_mut().zip(exact) {
        let Some(exact) = exact else { continue };
        let noise_m = f64::from(*range) - exact.first_m;
        let noise_m = if noise_m.is_finite() { noise_m } else { 0.0 };
        *range = reported_range_m(exact.measured_m + noise_m, min_m, max_m) as f32;
    }
    Some(message.with_message(scan))
}
