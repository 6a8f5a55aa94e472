//! One command.

use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::{EncodeError, Message};

/// A message that is sent at its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// When, in simulated time \[ns\].
    pub time_ns: i64,
    /// The topic, such as `/cmd_vel`; none is the one on which the robot listens.
    pub topic: Option<String>,
    /// What.
    pub body: Body,
}

/// The message of a command.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A velocity [m/s, rad/s].
    Twist(Twist),
    /// A velocity with time and frame [m/s, rad/s].
    TwistStamped(TwistStamped),
}

impl Body {
    /// The full name of its type.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Twist(_) => Twist::TYPE_NAME,
            Self::TwistStamped(_) => TwistStamped::TYPE_NAME,
        }
    }

    /// The velocity [m/s, rad/s].
    #[must_use]
    pub fn twist(&self) -> &Twist {
        match self {
            Self::Twist(twist) => twist,
            Self::TwistStamped(stamped) => &stamped.twist,
        }
    }

    /// The message as CDR.
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

/// Commands in the order in which they are sent; those of one time stay in their order.
pub(crate) fn sort(commands: &mut [Command]) {
    commands.sort_by_key(|command| command.time_ns);
}
