//! `/clock`.

use periplus_graph::{Graph, GraphError, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rosgraph_msgs;

use crate::drives::RateTimer;
use crate::{Device, DeviceState, SenseContext};

/// Publishes the simulated time on `/clock`, best effort with depth 1 as `rclcpp::ClockQoS` asks.
pub struct ClockPublisher {
    publisher: Publisher<rosgraph_msgs::Clock>,
    publish_timer: RateTimer,
}

impl ClockPublisher {
    /// At a rate \[Hz\]; 0 is each step, as in gz-sim. Classic's are 10 (ROS 2) and 100 (ROS 1).
    ///
    /// # Errors
    /// When the graph has a node `/clock` already.
    pub fn new(graph: &Graph, rate_hz: f64, start_ns: i64) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("clock").keep_names())?;
        let publisher = node.publisher("/clock", Qos::clock())?;
        Ok(Self { publisher, publish_timer: RateTimer::for_publisher(rate_hz, start_ns) })
    }
}

impl Device for ClockPublisher {
    fn name(&self) -> &str {
        "clock"
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        if self.publish_timer.due(now_ns) {
            self.publisher.publish(rosgraph_msgs::Clock { clock: Time::of_ns(now_ns) });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.publish_timer.next_ns().filter(|_| self.publisher.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.publish_timer.restart(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.publish_timer.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.publish_timer)
    }
}
