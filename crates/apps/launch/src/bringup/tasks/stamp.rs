//! `twist_stamper`: velocities with a time stamp.

use periplus_graph::{Mailbox, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::Header;

use super::{Done, Task, TaskContext};

/// Forwards velocities of `cmd_vel_in` to `cmd_vel_out` with the current time and a frame.
pub(crate) struct TwistStamper {
    frame: String,
    plain: Mailbox<Twist>,
    stamped: Publisher<TwistStamped>,
}

impl TwistStamper {
    /// Creates the task.
    ///
    /// # Errors
    /// A message when a topic cannot be created.
    pub(crate) fn new(node: &Node, frame: String) -> Result<Self, String> {
        let words = |error: periplus_graph::GraphError| error.to_string();
        let plain = node.mailbox("cmd_vel_in", Qos::reliable(10)).map_err(words)?;
        let stamped = node.publisher("cmd_vel_out", Qos::reliable(10)).map_err(words)?;
        Ok(Self { frame, plain, stamped })
    }
}

impl Task for TwistStamper {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        for twist in self.plain.drain() {
            let header = Header::at(stage.now_ns, &self.frame);
            self.stamped.publish(TwistStamped { header, twist: (*twist).clone() });
        }
        Done::No
    }
}
