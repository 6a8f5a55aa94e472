//! Performance metrics. They depend on the wall clock, so they are published only with subscribers:
//! bags are the same from run to run.

use std::time::Duration;

use periplus_graph::{GraphError, Node};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::gazebo_msgs::PerformanceMetrics;
use periplus_msgs::ros_gz_interfaces::WorldStatistics;
use periplus_msgs::std_msgs::Header;
use periplus_os::Stopwatch;

use super::gz_sim::name_of;
use super::pause_state::PauseState;
use super::topics::OnDemand;
use crate::Simulation;

/// Wall time between two messages, as in Harmonic and close to Classic.
const PERIOD: Duration = Duration::from_millis(100);

pub(super) struct Metrics {
    node: Node,
    classic: OnDemand<PerformanceMetrics>,
    gz_sim: OnDemand<WorldStatistics>,
    since_last: Stopwatch,
    last_ns: i64,
    real: Duration,
    paused: Duration,
    iterations: u64,
}

impl Metrics {
    pub(super) fn new(node: &Node, world: &str, now_ns: i64) -> Self {
        Self {
            node: node.clone(),
            classic: OnDemand::new("/performance_metrics"),
            gz_sim: OnDemand::new(name_of(world, "stats")),
            since_last: Stopwatch::start(),
            last_ns: now_ns,
            real: Duration::ZERO,
            paused: Duration::ZERO,
            iterations: 0,
        }
    }

    /// Advertises the statistics of the world also without subscribers, so that viewers find the
    /// topic.
    ///
    /// # Errors
    /// When a topic of this name has another type.
    pub(super) fn offer(&mut self) -> Result<(), GraphError> {
        self.gz_sim.keep(&self.node)
    }

    /// Counts a step.
    pub(super) fn count_step(&mut self) {
        self.iterations += 1;
    }

    /// Publishes metrics that are due by the wall clock.
    ///
    /// # Errors
    /// When a topic of this name has another type.
    pub(super) fn publish(
        &mut self,
        simulation: &Simulation,
        tempo: PauseState,
    ) -> Result<(), GraphError> {
        if self.since_last.elapsed() < PERIOD {
            return Ok(());
        }
        let elapsed = self.since_last.lap();
        if tempo.may_step() {
            self.real += elapsed;
        } else {
            self.paused += elapsed;
        }
        let now_ns = simulation.time_ns();
        let factor = factor(now_ns - self.last_ns, elapsed);
        self.last_ns = now_ns;
        let graph = simulation.graph();
        self.classic.look(&self.node, graph)?;
        self.gz_sim.look(&self.node, graph)?;
        if let Some(publisher) = self.classic.heard() {
            publisher.publish(PerformanceMetrics {
                header: Header::at(now_ns, ""),
                real_time_factor: factor,
                sensors: Vec::new(),
            });
        }
        if let Some(publisher) = self.gz_sim.heard() {
            publisher.publish(WorldStatistics {
                header: Header::at(now_ns, ""),
                sim_time: Time::of_ns(now_ns),
                pause_time: wall(self.paused),
                real_time: wall(self.real),
                paused: !tempo.may_step(),
                iterations: self.iterations,
                model_count: i32::try_from(simulation.models().count()).unwrap_or(i32::MAX),
                real_time_factor: factor,
                step_size: Time::of_ns(if tempo.may_step() { simulation.step_ns() } else { 0 }),
                stepping: tempo.is_stepping(),
                ..WorldStatistics::default()
            });
        }
        Ok(())
    }
}

fn wall(time: Duration) -> Time {
    Time::of_ns(i64::try_from(time.as_nanos()).unwrap_or(i64::MAX))
}

/// Returns the real-time factor; a jump back counts as zero.
#[expect(clippy::cast_precision_loss, reason = "times between two messages are short")]
fn factor(simulated_ns: i64, wall: Duration) -> f64 {
    simulated_ns.max(0) as f64 * 1e-9 / wall.as_secs_f64().max(1e-9)
}
