//! The drive of the comparison: commands that start at whole seconds, when controllers of every usual rate act.

use periplus_graph::{Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::{Message as _, std_msgs};
use periplus_sim::Simulation;

/// Start \[s\], speed \[m/s\], turn rate \[rad/s\].
const SCRIPT: [(i64, f64, f64); 7] = [
    (0, 0.0, 0.0),
    (1, 0.3, 0.0),
    (6, 0.3, 0.4),
    (10, 0.0, 0.5),
    (13, -0.2, 0.0),
    (16, 0.2, -0.4),
    (19, 0.0, 0.0),
];

/// Duration of the drive \[s\].
pub(super) const DURATION_S: i64 = 20;

/// Interval of repeated commands, since drives may have a timeout \[ns\].
pub(super) const COMMAND_PERIOD_NS: i64 = 100_000_000;

/// Script in words.
pub(super) const DRIVE_WORDS: &str = "1 s rest, 5 s straight at 0.3 m/s, 4 s curve at 0.3 m/s and 0.4 rad/s, 3 s turn at 0.5 rad/s, \
                                      3 s back at 0.2 m/s, 3 s curve at 0.2 m/s and -0.4 rad/s, 1 s rest";

/// Publishers of commands to every drive.
pub(super) struct CommandPublishers {
    plain: Vec<Publisher<Twist>>,
    stamped: Vec<Publisher<TwistStamped>>,
}

impl CommandPublishers {
    /// Publishers for all topics of velocity commands.
    pub(super) fn of(simulation: &Simulation, node: &Node) -> Self {
        let mut publishers = Self { plain: Vec::new(), stamped: Vec::new() };
        let topics = simulation.graph().topics();
        for topic in topics.iter().filter(|topic| !topic.subscriptions.is_empty()) {
            let qos = Qos::reliable(10);
            if topic.type_name == Twist::TYPE_NAME {
                publishers.plain.extend(node.publisher(&topic.name, qos));
            } else if topic.type_name == TwistStamped::TYPE_NAME {
                publishers.stamped.extend(node.publisher(&topic.name, qos));
            }
        }
        publishers
    }

    /// Names of the topics.
    pub(super) fn topics(&self) -> Vec<String> {
        let plain = self.plain.iter().map(|publisher| publisher.topic().to_owned());
        let stamped = self.stamped.iter().map(|publisher| publisher.topic().to_owned());
        plain.chain(stamped).collect()
    }

    /// Publishes the command of a time.
    pub(super) fn publish(&self, time_ns: i64) {
        let second = time_ns / 1_000_000_000;
        let current = SCRIPT.iter().rev().find(|(start_s, ..)| *start_s <= second);
        let Some((_, speed_m_s, turn_rad_s)) = current else { return };
        let mut twist = Twist::default();
        twist.linear.x = *speed_m_s;
        twist.angular.z = *turn_rad_s;
        for publisher in &self.plain {
            publisher.publish(twist.clone());
        }
        let header = std_msgs::Header::at(time_ns, "");
        for publisher in &self.stamped {
            publisher.publish(TwistStamped { header: header.clone(), twist: twist.clone() });
        }
    }
}
