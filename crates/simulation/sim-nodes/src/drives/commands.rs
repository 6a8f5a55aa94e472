//! Velocity commands.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Mailbox, Node, Qos, Sample};
use periplus_msgs::{Message, geometry_msgs};
use periplus_physics::Twist;

use super::build_context::BuildContext;
use crate::subscription_qos;

/// The last velocity command. It has no timeout, as in Gazebo. Non-finite commands are ignored.
pub(crate) struct Commands {
    inbox: Inbox,
    first: geometry_msgs::Twist,
    last: geometry_msgs::Twist,
    has_new_command: bool,
}

/// The current command, and messages that wait.
#[derive(Clone)]
pub(crate) struct CommandsState {
    pending: Vec<Sample>,
    last: geometry_msgs::Twist,
    has_new_command: bool,
}

impl Commands {
    pub(crate) fn new(
        context: &BuildContext<'_>,
        node: &Node,
        topic: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let qos = subscription_qos(&context.plugin.ros, topic, Qos::reliable(1));
        let inbox = if is_stamped(context, node, topic) {
            Inbox::Stamped(context.accept(node.mailbox(topic, qos), diagnostics)?)
        } else {
            Inbox::Plain(context.accept(node.mailbox(topic, qos), diagnostics)?)
        };
        let (first, last) = Default::default();
        Some(Self { inbox, first, last, has_new_command: false })
    }

    /// Sets the command that applies before the first message.
    pub(crate) fn starting_with(self, first: geometry_msgs::Twist) -> Self {
        Self { last: first.clone(), first, ..self }
    }

    /// Returns the current command along and about all axes.
    pub(crate) fn full(&mut self) -> &geometry_msgs::Twist {
        let newest = match &self.inbox {
            Inbox::Plain(inbox) => inbox.latest().map(|twist| (*twist).clone()),
            Inbox::Stamped(inbox) => inbox.latest().map(|stamped| stamped.twist.clone()),
        };
        if let Some(twist) = newest.filter(is_finite) {
            self.last = twist;
            self.has_new_command = true;
        }
        &self.last
    }

    /// Returns the current command in the plane.
    pub(crate) fn planar(&mut self) -> Twist {
        let geometry_msgs::Twist { linear, angular } = self.full();
        Twist { x_m_s: linear.x, y_m_s: linear.y, yaw_rad_s: angular.z }
    }

    /// Returns true if a command arrived since the last call.
    pub(crate) fn take_new_command(&mut self) -> bool {
        std::mem::take(&mut self.has_new_command)
    }

    /// Sets the command to zero.
    pub(crate) fn stop(&mut self) {
        self.last = geometry_msgs::Twist::default();
    }

    /// Resets to the initial state and discards pending messages.
    pub(crate) fn reset(&mut self) {
        match &self.inbox {
            Inbox::Plain(inbox) => drop(inbox.drain()),
            Inbox::Stamped(inbox) => drop(inbox.drain()),
        }
        self.last = self.first.clone();
    }

    pub(crate) fn save(&self) -> CommandsState {
        let pending = match &self.inbox {
            Inbox::Plain(inbox) => inbox.pending(),
            Inbox::Stamped(inbox) => inbox.pending(),
        };
        let Self { last, has_new_command, .. } = self;
        CommandsState { pending, last: last.clone(), has_new_command: *has_new_command }
    }

    pub(crate) fn restore(&mut self, saved: &CommandsState) {
        let CommandsState { pending, last, has_new_command } = saved;
        match &self.inbox {
            Inbox::Plain(inbox) => inbox.set_pending(pending),
            Inbox::Stamped(inbox) => inbox.set_pending(pending),
        }
        self.last = last.clone();
        self.has_new_command = *has_new_command;
    }
}

enum Inbox {
    Plain(Mailbox<geometry_msgs::Twist>),
    Stamped(Mailbox<geometry_msgs::TwistStamped>),
}

/// Returns true if commands are `TwistStamped`, as from Nav2 and current controllers: when the
/// plugin has the ROS parameter `use_stamped_vel`, as `diff_drive_controller` had, or when a
/// publisher of that type exists. A topic has one type.
fn is_stamped(context: &BuildContext<'_>, node: &Node, topic: &str) -> bool {
    let parameters = &context.plugin.ros.parameters;
    if let Some(parameter) = parameters.iter().find(|parameter| parameter.name == "use_stamped_vel")
    {
        return matches!(parameter.value.trim(), "true" | "True" | "1");
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
