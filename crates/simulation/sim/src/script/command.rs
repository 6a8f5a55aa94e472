//! Commands of a script.

use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::{EncodeError, Message};

/// A message with its time.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityCommand {
    /// Simulated time of publishing \[ns\].
    pub time_ns: i64,
    /// Topic, such as `/cmd_vel`; `None` is the topic that the robot subscribes to.
    pub topic: Option<String>,
    /// Message.
    pub body: CommandMessage,
}

/// Message of a command.
#[derive(Clone, Debug, PartialEq)]
pub enum CommandMessage {
    /// A velocity [m/s, rad/s].
    Twist(Twist),
    /// A velocity with time and frame [m/s, rad/s].
    TwistStamped(TwistStamped),
}

impl CommandMessage {
    /// Returns the full name of its type.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Twist(_) => Twist::TYPE_NAME,
            Self::TwistStamped(_) => TwistStamped::TYPE_NAME,
        }
    }

    /// Returns the velocity [m/s, rad/s].
    #[must_use]
    pub fn twist(&self) -> &Twist {
        match self {
            Self::Twist(twist) => twist,
            Self::TwistStamped(stamped) => &stamped.twist,
        }
    }

    /// Returns the message as CDR.
    ///
    /// # Errors
    /// When its frame has a name longer than 4 GiB.
    pub fn to_cdr(&self) -> Result<Vec<u8>, EncodeError> {
        match self {
            Self::Twist(twist) => twist.to_cdr(),
            Self::TwistStamped(stamped) => stamped.to_cdr(),
        }
    }
}

/// Sorts commands by time; the sort is stable.
pub(crate) fn sort(commands: &mut [VelocityCommand]) {
    commands.sort_by_key(|command| command.time_ns);
}
