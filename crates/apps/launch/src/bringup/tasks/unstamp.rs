//! Conversion of stamped velocities, as `ros_gz_bridge` does from `geometry_msgs/msg/TwistStamped`
//! to `gz.msgs.Twist`.

use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};

use super::{Done, Task, TaskContext};

/// Forwards velocities from one topic to another.
pub(crate) struct Unstamp {
    stamped: Mailbox<TwistStamped>,
    plain: Publisher<Twist>,
}

impl Unstamp {
    /// Forwards from a name in the node's scope to a full name.
    ///
    /// # Errors
    /// A message when it cannot be created.
    pub(crate) fn new(node: &Node, from: &str, graph: &Graph, to: &str) -> Result<Self, String> {
        let words = |error: periplus_graph::GraphError| error.to_string();
        let stamped = node.mailbox(from, Qos::reliable(10)).map_err(words)?;
        // A node without remappings: the Gazebo topic has a fixed name.
        let name = format!("{}_{}", node.names().name(), to.replace('/', "_").trim_matches('_'));
        let settings = NodeSettings::new(name).namespace(node.names().namespace());
        let names = graph.node(settings.bare().keep_names()).map_err(words)?;
        let plain = names.publisher(to, Qos::reliable(10)).map_err(words)?;
        Ok(Self { stamped, plain })
    }
}

impl Task for Unstamp {
    fn work(&mut self, _stage: &mut TaskContext<'_>) -> Done {
        for message in self.stamped.drain() {
            self.plain.publish(message.twist.clone());
        }
        Done::No
    }
}
