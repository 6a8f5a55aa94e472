//! Graph connected to ROS 2, for programs whose nodes join the network.

mod monitor;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_dds::{DdsTransport, DiscoveryRange, Settings};
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Arguments, Graph, GraphError, Mailbox, Node, Qos};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_os::{Machine, sleep, unix_ns};
use periplus_ros1::{MasterUse, Ros1Reach, Ros1Transport};

use crate::Ros1Value;
use crate::error::RunError;
use crate::terminal;

pub use monitor::NodeMonitor;

/// Limits of the sleep between two passes.
#[derive(Clone, Copy, Debug)]
pub struct PollSleep {
    /// Minimum.
    pub min: Duration,
    /// Maximum; with `/clock` the minimum applies.
    pub max: Duration,
}

impl PollSleep {
    /// Fixed duration.
    #[must_use]
    pub const fn fixed(sleep: Duration) -> Self {
        Self { min: sleep, max: sleep }
    }
}

/// Live graph and its network connection.
pub struct LiveGraph {
    // Declared first, so that the network is left before the graph is dropped.
    /// Connection to ROS 2.
    pub wire: DdsTransport,
    /// Connection to ROS 1, if the program joined it.
    pub ros1: Option<Ros1Transport>,
    /// The graph.
    pub graph: Graph,
    /// ROS 2 domain.
    pub domain_id: u32,
    clock: Option<Mailbox<Clock>>,
}

impl LiveGraph {
    /// Joins the network that the environment selects; the arguments apply to its nodes.
    ///
    /// # Errors
    /// When the network cannot be joined.
    pub fn open(arguments: Arguments) -> Result<Self, RunError> {
        let (settings, findings) = Settings::from_environment(&Machine);
        print(&findings);
        Self::with(&settings, arguments)
    }

    fn with(settings: &Settings, arguments: Arguments) -> Result<Self, RunError> {
        let graph = Graph::live();
        graph.set_simulated_time(false);
        graph.advance_to(unix_ns());
        graph.set_arguments(arguments);
        let attached =
            DdsTransport::open(settings).and_then(|wire| wire.attach(&graph).map(|()| wire));
        let wire = attached.map_err(RunError::Join)?;
        Ok(Self { wire, ros1: None, graph, domain_id: settings.domain_id, clock: None })
    }

    /// Joins ROS 1 at the master that `ROS_MASTER_URI` names, in place of ROS 2.
    ///
    /// # Errors
    /// When no master answers.
    pub fn open_ros1(arguments: Arguments) -> Result<Self, RunError> {
        let settings = Settings { range: DiscoveryRange::Off, ..Settings::default() };
        let mut live = Self::with(&settings, arguments)?;
        let (settings, findings) =
            periplus_ros1::Settings::from_environment(&Machine, Ros1Reach::Machine);
        print(&findings);
        let wire = Ros1Transport::open(&settings, MasterUse::Join)?;
        wire.attach(&live.graph)?;
        live.ros1 = Some(wire);
        Ok(live)
    }

    /// Joins ROS 1 in place of ROS 2 and sets parameters of its server by full names; starts a master if none
    /// answers.
    ///
    /// # Errors
    /// When no master answers and none can be started.
    pub fn start_ros1(
        arguments: Arguments,
        reach: Ros1Reach,
        parameters: Vec<(String, Ros1Value)>,
        is_quiet: bool,
    ) -> Result<Self, RunError> {
        let settings = Settings { range: DiscoveryRange::Off, ..Settings::default() };
        let mut live = Self::with(&settings, arguments)?;
        live.ros1 = Some(crate::join_ros1(&live.graph, reach, parameters, is_quiet)?);
        Ok(live)
    }

    /// Follows `/clock` from now on; time does not advance until `/clock` has a publisher.
    ///
    /// # Errors
    /// An error when `/clock` has another type.
    pub fn follow_clock(&mut self, node: &Node) -> Result<(), GraphError> {
        self.graph.set_simulated_time(true);
        self.graph.jump_to(0);
        self.clock = Some(node.mailbox("/clock", Qos::clock())?);
        Ok(())
    }

    /// Processes everything due now.
    pub fn spin_once(&self) {
        match &self.clock {
            None => self.graph.advance_to(unix_ns()),
            Some(clock) => {
                if let Some(told) = clock.latest() {
                    let time_ns = told.clock.ns();
                    // Time jumped back: the simulation was reset. The first time is no time that passed.
                    if time_ns < self.graph.now_ns() || self.graph.now_ns() == 0 {
                        self.graph.jump_to(time_ns);
                    }
                    self.graph.advance_to(time_ns);
                }
            }
        }
    }

    /// Sleeps until something is due, within these limits. With `/clock` the shorter one applies,
    /// since the next time may arrive at any moment.
    fn sleep_until_due(&self, shortest: Duration, longest: Duration) {
        let until_due = |due_ns: i64| {
            let rest_ns = due_ns.saturating_sub(unix_ns());
            Duration::from_nanos(u64::try_from(rest_ns).unwrap_or_default())
        };
        sleep(match (&self.clock, self.graph.next_due_ns()) {
            (Some(_), _) => shortest,
            (None, due_ns) => due_ns.map_or(longest, until_due).clamp(shortest, longest),
        });
    }

    /// Prints the findings since the last call.
    pub fn print_findings(&self) {
        print(&self.wire.take_findings());
        if let Some(ros1) = &self.ros1 {
            print(&ros1.take_findings());
        }
        print(&self.graph.take_findings());
    }

    /// Prints the findings of starting the nodes, once all of them exist: also names and
    /// parameters of `--ros-args` that no node uses.
    ///
    /// # Errors
    /// A failed write.
    pub fn print_start_findings(&self) -> Result<(), RunError> {
        for findings in [self.graph.take_findings(), self.graph.unused_arguments()] {
            terminal::print_findings(&findings)?;
        }
        Ok(())
    }

    /// Monitors a node that was just started, and follows `/clock` if it uses simulated time.
    ///
    /// # Errors
    /// When the graph refuses a name or a type.
    pub fn monitor(&mut self, node: &Node, is_simulated: bool) -> Result<NodeMonitor, RunError> {
        let monitor = NodeMonitor::new(node)?;
        if is_simulated {
            self.follow_clock(node)?;
        }
        Ok(monitor)
    }

    /// Processes events until the flag is set, or until `each`, called after each pass, breaks.
    /// Returns true in the latter case.
    pub fn spin(
        &self,
        stop: &AtomicBool,
        sleep: PollSleep,
        mut each: impl FnMut() -> ControlFlow<()>,
    ) -> bool {
        while !stop.load(Ordering::Relaxed) {
            self.spin_once();
            self.sleep_until_due(sleep.min, sleep.max);
            if each().is_break() {
                return true;
            }
        }
        false
    }

    /// Flushes published messages within a timeout; returns false if some were not acknowledged.
    pub fn end(&self, timeout: Duration) -> bool {
        let is_sent = self.ros1.as_ref().is_none_or(|ros1| ros1.flush(timeout));
        let is_taken = self.wire.flush(timeout) && is_sent;
        self.print_findings();
        is_taken
    }
}

fn print(findings: &Diagnostics) {
    // A failing stderr cannot be reported.
    let _ = terminal::print_findings(findings);
}
