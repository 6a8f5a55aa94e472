//! Velocity commands.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Mailbox, Node, Qos};
use periplus_msgs::{Message, geometry_msgs};
use periplus_physics::Twist;

use super::order::Order;
use crate::subscription_qos;

/// The last velocity command. It holds for ever, as in Gazebo: no command is no reason to stop.
/// Commands that are no numbers are passed over.
pub(crate) struct Commands {
    inbox: Inbox,
    first: geometry_msgs::Twist,
    last: geometry_msgs::Twist,
    has_news: bool,
}

impl Commands {
    pub(crate) fn new(
        order: &Order<'_>,
        node: &Node,
        topic: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let qos = subscription_qos(&order.plugin.ros, topic, Qos::reliable(1));
        let inbox = if is_stamped(order, node, topic) {
            Inbox::Stamped(order.accept(node.mailbox(topic, qos), diagnostics)?)
        } else {
            Inbox::Plain(order.accept(node.mailbox(topic, qos), diagnostics)?)
        };
        let (first, last) = Default::default();
        Some(Self { inbox, first, last, has_news: false })
    }

    /// With a command that holds before the first one comes.
    pub(crate) fn starting_with(self, first: geometry_msgs::Twist) -> Self {
        Self { last: first.clone(), first, ..self }
    }

    /// What is asked for now, along and about all axes.
    pub(crate) fn full(&mut self) -> &geometry_msgs::Twist {
        let newest = match &self.inbox {
            Inbox::Plain(inbox) => inbox.latest().map(|twist| (*twist).clone()),
            Inbox::Stamped(inbox) => inbox.latest().map(|stamped| stamped.twist.clone()),
        };
        if let Some(twist) = newest.filter(is_finite) {
            self.last = twist;
            self.has_news = true;
        }
        &self.last
    }

    /// What is asked for now, on the plane.
    pub(crate) fn planar(&mut self) -> Twist {
        let geometry_msgs::Twist { linear, angular } = self.full();
        Twist { x_m_s: linear.x, y_m_s: linear.y, yaw_rad_s: angular.z }
    }

    /// Whether a command came since this was last asked.
    pub(crate) fn take_news(&mut self) -> bool {
        std::mem::take(&mut self.has_news)
    }

    /// Forgets what was asked for.
    pub(crate) fn stop(&mut self) {
        self.last = geometry_msgs::Twist::default();
    }

    /// As after its making; what lies in the boxes is thrown away.
    pub(crate) fn reset(&mut self) {
        match &self.inbox {
            Inbox::Plain(inbox) => drop(inbox.drain()),
            Inbox::Stamped(inbox) => drop(inbox.drain()),
        }
        self.last = self.first.clone();
    }
}

enum Inbox {
    Plain(Mailbox<geometry_msgs::Twist>),
    Stamped(Mailbox<geometry_msgs::TwistStamped>),
}

/// Whether commands come as `TwistStamped`, as from Nav2 and controllers of today's ROS: where the
/// plugin has the ROS parameter `use_stamped_vel`, as `diff_drive_controller` had, or where somebody
/// sends them so already. A topic has one type.
fn is_stamped(order: &Order<'_>, node: &Node, topic: &str) -> bool {
    let parameters = &order.plugin.ros.parameters;
    if let Some(told) = parameters.iter().find(|parameter| parameter.name == "use_stamped_vel") {
        return matches!(told.value.trim(), "true" | "True" | "1");
    }
    let Ok(name) = node.names().topic(topic) else { return false };
    let type_name = <geometry_msgs::TwistStamped as Message>::TYPE_NAME;
    node.graph().topics().iter().any(|known| known.name == name && known.type_name == type_name)
}

fn is_finite(twist: &geometry_msgs::Twist) -> bool {
    [&twist.linear, &twist.angular]
        .iter()
        .all(|vector| vector.x.is_finite() && vector.y.is_finite() && vector.z.is_finite())
}
