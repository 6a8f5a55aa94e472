//! How fast it goes, for who wants to know. These numbers come from the wall's clock, so nothing of
//! this is published unless somebody subscribes: a bag stays the same from run to run.

use std::time::Duration;

use periplus_graph::{GraphError, Node};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::gazebo_msgs::PerformanceMetrics;
use periplus_msgs::ros_gz_interfaces::WorldStatistics;
use periplus_msgs::std_msgs::Header;
use periplus_os::Stopwatch;

use super::harmonic::name_of;
use super::tempo::Tempo;
use super::topics::{OnDemand, subscribed};
use crate::Simulation;

/// Wall time between two messages: Harmonic's, and near Classic's.
const PERIOD: Duration = Duration::from_millis(100);

pub(super) struct Metrics {
    node: Node,
    classic: OnDemand<PerformanceMetrics>,
    harmonic: OnDemand<WorldStatistics>,
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
            harmonic: OnDemand::new(name_of(world, "stats")),
            since_last: Stopwatch::start(),
            last_ns: now_ns,
            real: Duration::ZERO,
            paused: Duration::ZERO,
            iterations: 0,
        }
    }

    /// Offers the statistics of the world also while nobody subscribes: programs that show the world
    /// find them among its topics.
    ///
    /// # Errors
    /// When a topic of this name has another type.
    pub(super) fn offer(&mut self) -> Result<(), GraphError> {
        self.harmonic.keep(&self.node)
    }

    /// A step was taken.
    pub(super) fn count_step(&mut self) {
        self.iterations += 1;
    }

    /// Publishes what is due by the wall's clock.
    ///
    /// # Errors
    /// When a topic of this name has another type.
    pub(super) fn publish(
        &mut self,
        simulation: &Simulation,
        tempo: Tempo,
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
        let wanted = subscribed(simulation);
        self.classic.look(&self.node, &wanted)?;
        self.harmonic.look(&self.node, &wanted)?;
        if let Some(publisher) = self.classic.heard() {
            publisher.publish(PerformanceMetrics {
                header: Header::at(now_ns, ""),
                real_time_factor: factor,
                sensors: Vec::new(),
            });
        }
        if let Some(publisher) = self.harmonic.heard() {
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

/// Simulated seconds per second of the wall; a jump back counts as standing still.
#[expect(clippy::cast_precision_loss, reason = "times between two messages are short")]
fn factor(simulated_ns: i64, wall: Duration) -> f64 {
    simulated_ns.max(0) as f64 * 1e-9 / wall.as_secs_f64().max(1e-9)
}
